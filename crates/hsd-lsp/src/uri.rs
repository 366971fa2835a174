//! File URIs.

use hsd_base::source::reference;
use percent_encoding::percent_decode_str;
use std::path::{Path, PathBuf};

/// Returns the path of a file URI, if it is on this machine.
pub(super) fn to_path(uri: &str) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    let rest = rest.strip_prefix("localhost").unwrap_or(rest);
    let path = percent_decode_str(rest.split(['?', '#']).next()?);
    let path = path.decode_utf8().ok()?;
    // `/c:/houses` is a Windows drive.
    let drive = path.as_bytes().get(1..3);
    let drive = drive.is_some_and(|d| d[0].is_ascii_alphabetic() && d[1] == b':');
    match cfg!(windows) && drive {
        true => Some(PathBuf::from(&path[1..])),
        false => path.starts_with('/').then(|| PathBuf::from(&*path)),
    }
}

/// Returns the URI of an absolute path.
pub(super) fn from_path(path: &Path) -> String {
    let text = path
        .to_string_lossy()
        .replace(std::path::MAIN_SEPARATOR, "/");
    let root = if text.starts_with('/') { "" } else { "/" };
    format!("file://{root}{}", reference(&text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_both_ways() {
        for name in ["/町/家 1.hsd", "/a/b%c#d?.hsd", "/𠮷野.hsd"] {
            let uri = from_path(Path::new(name));
            assert!(uri.is_ascii());
            assert_eq!(to_path(&uri), Some(PathBuf::from(name)));
        }
        assert_eq!(to_path("file:///a/%E5%AE%B6.hsd"), Some("/a/家.hsd".into()));
        // As in browsers, for clients that do not escape `%`.
        assert_eq!(to_path("file:///a%b.hsd"), Some("/a%b.hsd".into()));
        for other in ["untitled:Untitled-1", "file:///a%E5", "http://a/b"] {
            assert_eq!(to_path(other), None);
        }
    }
}
