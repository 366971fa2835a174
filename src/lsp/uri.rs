//! File names as the protocol writes them.

use std::path::{Path, PathBuf};

/// The file that a URI names, if it names one of this machine.
pub(super) fn to_path(uri: &str) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    let rest = rest.strip_prefix("localhost").unwrap_or(rest);
    let path = decoded(rest.split(['?', '#']).next()?)?;
    // `/c:/houses` is a drive of Windows.
    let drive = path.as_bytes().get(1..3);
    let drive = drive.is_some_and(|d| d[0].is_ascii_alphabetic() && d[1] == b':');
    match cfg!(windows) && drive {
        true => Some(PathBuf::from(&path[1..])),
        false => path.starts_with('/').then(|| PathBuf::from(&path)),
    }
}

/// The URI of an absolute path.
pub(super) fn from_path(path: &Path) -> String {
    let text = path
        .to_string_lossy()
        .replace(std::path::MAIN_SEPARATOR, "/");
    let mut uri = String::from("file://");
    if !text.starts_with('/') {
        uri.push('/');
    }
    for byte in text.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => {
                uri.push(byte as char);
            }
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

fn decoded(text: &str) -> Option<String> {
    let (mut bytes, mut rest) = (vec![], text.as_bytes());
    while let [first, more @ ..] = rest {
        rest = more;
        if *first != b'%' {
            bytes.push(*first);
            continue;
        }
        let (digits, more) = rest.split_at_checked(2)?;
        let digits = std::str::from_utf8(digits).ok()?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        rest = more;
    }
    String::from_utf8(bytes).ok()
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
        for other in [
            "untitled:Untitled-1",
            "file:///a%ZZ",
            "file:///a%E5",
            "http://a/b",
        ] {
            assert_eq!(to_path(other), None);
        }
    }
}
