//! Divides a file of the legacy form at its lines of `%` alone.

use super::{PIECE, Undivided};
use hsd_base::source::Layout;
use std::io::{self, BufRead};

/// Returns how a file is divided that begins at this byte.
pub(super) fn divide(
    mut reader: impl BufRead,
    mark: u64,
    size: u64,
) -> io::Result<Result<Layout, Undivided>> {
    let (mut cuts, mut at) = (vec![mark], mark);
    let (mut line, mut end): (Vec<u8>, Option<&[u8]>) = (vec![], None);
    loop {
        line.clear();
        let length = reader.read_until(b'\n', &mut line)? as u64;
        if length == 0 {
            break;
        }
        at += length;
        let content = line.strip_suffix(b"\n").unwrap_or(&line);
        let (content, own): (_, &[u8]) = match content.strip_suffix(b"\r") {
            Some(content) => (content, b"\r\n"),
            None => (content, b"\n"),
        };
        let whole = line.ends_with(b"\n");
        if content.contains(&b'\r') || whole && *end.get_or_insert(own) != own {
            return Ok(Err(Undivided::LineEnds));
        }
        if std::str::from_utf8(content).is_err() || content.contains(&0) {
            return Ok(Err(Undivided::Encoding));
        }
        if content.trim_ascii_start().starts_with(b"<") {
            return Ok(Err(Undivided::Element("Houses".to_owned())));
        }
        let last = cuts.last().copied().unwrap_or(mark);
        if content == b"%" && whole && at - last >= PIECE && at < size {
            cuts.push(at);
        }
    }
    if cuts.len() == 1 {
        return Ok(Err(Undivided::OneHouse));
    }
    cuts.push(at);
    Ok(Ok(Layout {
        head: mark..mark,
        cuts,
        tail: "",
    }))
}
