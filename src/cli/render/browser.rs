//! A browser of this machine that draws without being seen.

use crate::cli::Stop;
use crate::text;
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// What Chromium and its kin are called.
const NAMES: [&str; 7] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "msedge",
    "microsoft-edge",
];

/// Where they lie on systems that do not name them in PATH.
const PLACES: [&str; 3] = [
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
];

/// The same, below the folders of programs of Windows.
const BELOW: [&str; 3] = [
    r"Google\Chrome\Application\chrome.exe",
    r"Chromium\Application\chrome.exe",
    r"Microsoft\Edge\Application\msedge.exe",
];

/// No window, no network, no store of anything; triangles are drawn on the processor, so that every machine draws alike.
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
    // The shared memory of containers is small.
    "--disable-dev-shm-usage",
];

/// A program that can draw.
pub(super) struct Browser(PathBuf);

/// A browser at work; it ends with this.
pub(super) struct Running {
    child: Child,
    /// What it stores, until it ends.
    _profile: TempDir,
}

impl Browser {
    /// The one that HSD_CHROMIUM names, or the first that is found.
    pub(super) fn find() -> Result<Browser, Stop> {
        if let Some(named) = env::var_os("HSD_CHROMIUM").filter(|n| !n.is_empty()) {
            let path = PathBuf::from(named);
            let found = if path.is_file() {
                Some(path.clone())
            } else {
                in_path(&path)
            };
            return found.map(Browser).ok_or_else(|| {
                let shown = path.display();
                Stop::Io(text!(
                    "HSD_CHROMIUM={shown}: there is no such program",
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
            Stop::Io(text!(
                "pictures are drawn by Chromium, Chrome or Edge, and none is found; install one (`apt install chromium`, \
                 `brew install --cask chromium`) or name it by HSD_CHROMIUM",
                "画像は Chromium、Chrome、Edge のどれかで描きますが、見つかりません。インストールするか (`apt install chromium`、\
                 `brew install --cask chromium`)、HSD_CHROMIUM で指定してください"
            ))
        })
    }

    /// Opens a page where nobody sees it.
    pub(super) fn open(&self, url: &str) -> Result<Running, Stop> {
        let failed = |e| Stop::at(self.0.display(), e);
        let profile = tempfile::Builder::new().prefix("hsd-render-").tempdir();
        let profile = profile.map_err(failed)?;
        let mut command = Command::new(&self.0);
        command.args(FLAGS);
        let mut data = std::ffi::OsString::from("--user-data-dir=");
        data.push(profile.path());
        command.arg(data);
        if is_root() {
            // Chromium refuses to build its walls for the one who could tear them down.
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
        })
    }
}

impl Running {
    /// Whether it has ended by itself.
    pub(super) fn ended(&mut self) -> bool {
        !matches!(self.child.try_wait(), Ok(None))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended meanwhile.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A program by its name.
fn in_path(name: &Path) -> Option<PathBuf> {
    let folders = env::var_os("PATH")?;
    let found = env::split_paths(&folders).flat_map(|folder| {
        let plain = folder.join(name);
        [plain.with_extension("exe"), plain]
    });
    found.into_iter().find(|p| p.is_file())
}

/// Whether this program runs as the one who may do everything.
fn is_root() -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        // What a process is to the system belongs to its user.
        std::fs::metadata("/proc/self").is_ok_and(|own| own.uid() == 0)
    }
    #[cfg(not(unix))]
    false
}
