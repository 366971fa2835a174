//! Edits on the bytes of a file: in its encoding, and so that undo restores the exact bytes.

use super::Edit;
use hsd_base::source::Source;
use hsd_syntax::print;
use std::ops::Range;

/// A replacement of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Patch {
    /// The bytes to remove.
    pub range: Range<usize>,
    /// The new bytes.
    pub bytes: Vec<u8>,
}

/// A file after a stroke.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Applied {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The edits that undo it: see [`take_back`].
    pub undo: Patch,
}

/// Applies edits of the text of a source to its bytes. If the encoding of the file cannot represent the new text, the
/// whole file becomes UTF-8.
pub fn apply(source: &Source, bytes: &[u8], edits: &[Edit]) -> Applied {
    let text = source.text();
    let (mut new, mut at) = (String::with_capacity(text.len() + 64), 0);
    for edit in edits {
        let end = edit.range.end.min(text.len());
        let start = edit.range.start.clamp(at, end.max(at));
        new += text.get(at..start).unwrap_or_default();
        new += &edit.text;
        at = end.max(at);
    }
    new += text.get(at..).unwrap_or_default();
    let new = spliced(source, bytes, edits).unwrap_or_else(|| print::encode(&new, source));
    let undo = difference(&new, bytes);
    Applied { bytes: new, undo }
}

/// Applies edits to the bytes in place, if the new text is ASCII in an encoding that contains ASCII.
fn spliced(source: &Source, bytes: &[u8], edits: &[Edit]) -> Option<Vec<u8>> {
    let wide = source.encoding().starts_with("UTF-16");
    let utf8 = source.encoding() == "UTF-8";
    if wide || bytes.len() != source.size() || source.malformed() {
        return None;
    }
    let (mut new, mut at) = (Vec::with_capacity(bytes.len() + 64), 0);
    for edit in edits {
        let span = source.span(edit.range.clone());
        let (start, end) = (span.start as usize, span.end as usize);
        let plain = utf8 || edit.text.is_ascii();
        new.extend_from_slice(bytes.get(at..start).filter(|_| plain)?);
        new.extend_from_slice(edit.text.as_bytes());
        at = end;
    }
    new.extend_from_slice(bytes.get(at..)?);
    // With fewer non-ASCII letters its encoding could no longer be detected.
    let again = Source::new(source.id(), source.name(), &new);
    (again.encoding() == source.encoding() || new.is_ascii()).then_some(new)
}

/// Returns the change that turns some bytes into others.
fn difference(from: &[u8], to: &[u8]) -> Patch {
    let head = from.iter().zip(to).take_while(|(a, b)| a == b).count();
    let (rest, other) = (&from[head..], &to[head..]);
    let ends = rest.iter().rev().zip(other.iter().rev());
    let tail = ends.take_while(|(a, b)| a == b).count();
    Patch {
        range: head..from.len() - tail,
        bytes: other[..other.len() - tail].to_vec(),
    }
}

/// Returns the bytes as they were before, and the change that redoes the stroke.
pub fn take_back(bytes: &[u8], undo: &Patch) -> Option<Applied> {
    let gone = bytes.get(undo.range.clone())?;
    let old = [
        &bytes[..undo.range.start],
        &undo.bytes,
        &bytes[undo.range.end..],
    ]
    .concat();
    let range = undo.range.start..undo.range.start + undo.bytes.len();
    let bytes = gone.to_vec();
    Some(Applied {
        bytes: old,
        undo: Patch { range, bytes },
    })
}
