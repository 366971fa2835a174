//! What the program does without arguments on a desktop, as after a double click: it shows a folder of houses to change.

use crate::Failure;
use crate::files::output::Committer;
use hsd_base::diagnostic::Language;
use hsd_base::text;
use hsd_syntax::templates::{EXAMPLES, TYPES};
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;

/// The folder in that of the user, whose houses are theirs from then on.
const FOLDER: &str = "hsd-houses";

/// The first house of the README, and the name of its file.
const FIRST: (&str, &str) = (
    "first.hsd",
    "0 0 180\n9.5\n\nKKS  TKD 2MRE\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n",
);

/// The types of town houses, which stand first.
const TOWN_HOUSES: usize = 7;

/// The arguments to run: those given, or `view FOLDER` where there are none and a browser can be opened.
pub(crate) fn arguments(
    mut given: Vec<OsString>,
    language: Language,
) -> Result<Vec<OsString>, Failure> {
    let variable = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    if given.len() != 1 || !is_desktop(|name| variable(name).is_some()) || !hsd_view::is_built() {
        return Ok(given);
    }
    let Some(home) = variable("HOME").or_else(|| variable("USERPROFILE")) else {
        return Ok(given);
    };
    let folder = Path::new(&home).join(FOLDER);
    fill(&folder)?;
    let shown = folder.display();
    let hint = text!([shown]
        "houses to change are in {shown}; `hsd --help` lists the commands",
        "変えてよい家が {shown} にあります。コマンドは `hsd --help` で一覧できます"
    );
    writeln!(io::stderr(), "hsd: {}", hint.in_language(language))?;
    given.extend(["view".into(), folder.into()]);
    Ok(given)
}

/// Returns whether a browser can be opened for someone who sits before the machine.
fn is_desktop(is_set: impl Fn(&str) -> bool) -> bool {
    let remote = ["CI", "SSH_CONNECTION"].into_iter().any(&is_set);
    let windows = cfg!(any(windows, target_os = "macos"));
    !remote && (windows || ["DISPLAY", "WAYLAND_DISPLAY"].into_iter().any(&is_set))
}

/// Writes the houses into a folder that is not there yet. One that is there belongs to the user.
fn fill(folder: &Path) -> Result<(), Failure> {
    if folder.exists() {
        return Ok(());
    }
    std::fs::create_dir_all(folder).map_err(|e| Failure::at(folder.display(), e))?;
    let types = TYPES.iter().take(TOWN_HOUSES).chain(EXAMPLES);
    let types = types.map(|t| (format!("{}.hsd", t.word), t.text()));
    let first = std::iter::once((FIRST.0.to_owned(), FIRST.1.to_owned()));
    let files = first.chain(types);
    let files = files.map(|(name, text)| (folder.join(name), text.into_bytes()));
    Committer::default().write_all(files.collect())
}
