//! An installed browser, run headless.

use crate::Failure;
use crate::files::temporary::Guarded;
use hsd_base::text;
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

/// Program names of Chromium-based browsers.
const NAMES: [&str; 7] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "msedge",
    "microsoft-edge",
];

/// Their locations on macOS, where they are not in PATH.
const PLACES: [&str; 3] = [
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
];

/// Their locations below the program folders of Windows.
const BELOW: [&str; 3] = [
    r"Google\Chrome\Application\chrome.exe",
    r"Chromium\Application\chrome.exe",
    r"Microsoft\Edge\Application\msedge.exe",
];

/// No window, no background network traffic; rendering on the CPU, so that all machines produce the same image.
const FLAGS: [&str; 15] = [
    "--headless=new",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-sync",
    "--disable-extensions",
    "--disable-background-timer-throttling",
    "--disable-renderer-backgrounding",
    "--no-first-run",
    "--no-default-browser-check",
    "--hide-scrollbars",
    // Containers have little shared memory.
    "--disable-dev-shm-usage",
];

/// The path of a browser.
pub(super) struct Browser(PathBuf);

/// A running browser, killed on drop.
pub(super) struct Running {
    child: Child,
    /// The profile folder, deleted on drop.
    _profile: TempDir,
    _guarded: Guarded,
}

impl Browser {
    /// Returns the browser named by HSD_CHROMIUM, or the first one found.
    pub(super) fn find() -> Result<Browser, Failure> {
        if let Some(named) = env::var_os("HSD_CHROMIUM").filter(|n| !n.is_empty()) {
            let path = PathBuf::from(named);
            let found = if path.is_file() {
                Some(path.clone())
            } else {
                in_path(&path)
            };
            return found.map(Browser).ok_or_else(|| {
                let shown = path.display();
                Failure::Io(text!([shown]
                    "HSD_CHROMIUM={shown}: no such program",
                    "HSD_CHROMIUM={shown}: そのようなプログラムはありません"
                ))
            });
        }
        let by_name = NAMES.iter().find_map(|name| in_path(Path::new(name)));
        let places = PLACES.iter().map(PathBuf::from);
        let folders = ["ProgramFiles", "ProgramFiles(x86)", "LocalAppData"];
        let folders = folders.iter().filter_map(env::var_os).map(PathBuf::from);
        let below = folders.flat_map(|folder| BELOW.map(|name| folder.join(name)));
        let found = by_name.or_else(|| places.chain(below).find(|p| p.is_file()));
        found.map(Browser).ok_or_else(|| {
            Failure::Io(text!(
                "rendering needs Chromium, Chrome or Edge, and none was found; install one (`apt install chromium`, \
                 `brew install --cask chromium`) or set HSD_CHROMIUM to its path",
                "画像は Chromium、Chrome、Edge のどれかで描きますが、見つかりません。インストールするか (`apt install chromium`、\
                 `brew install --cask chromium`)、HSD_CHROMIUM で指定してください"
            ))
        })
    }

    /// Opens a page in the headless browser.
    pub(super) fn open(&self, url: &str) -> Result<Running, Failure> {
        let failed = |e| Failure::at(self.0.display(), e);
        let made = || tempfile::Builder::new().prefix("hsd-render-").tempdir();
        let (profile, guarded) = Guarded::new(made, TempDir::path).map_err(failed)?;
        let mut command = Command::new(&self.0);
        command.args(FLAGS);
        let mut data = std::ffi::OsString::from("--user-data-dir=");
        data.push(profile.path());
        command.arg(data);
        if is_root() {
            // Chromium refuses to run as root with its sandbox.
            command.arg("--no-sandbox");
        }
        command.arg(url);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        Ok(Running {
            child: command.spawn().map_err(failed)?,
            _profile: profile,
            _guarded: guarded,
        })
    }
}

impl Running {
    /// Returns whether the browser has exited.
    pub(super) fn ended(&mut self) -> bool {
        !matches!(self.child.try_wait(), Ok(None))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Errors are ignored: it may have exited already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Finds a program in PATH.
fn in_path(name: &Path) -> Option<PathBuf> {
    let folders = env::var_os("PATH")?;
    let found = env::split_paths(&folders).flat_map(|folder| {
        let plain = folder.join(name);
        [plain.with_extension("exe"), plain]
    });
    found.into_iter().find(|p| p.is_file())
}

/// Returns whether this process runs as root.
fn is_root() -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        // /proc/self is owned by the effective user.
        std::fs::metadata("/proc/self").is_ok_and(|own| own.uid() == 0)
    }
    #[cfg(not(unix))]
    false
}
