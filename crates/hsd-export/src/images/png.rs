//! PNG files as chunks: their size, whether they are whole, and what of them is worth passing on.
//!
//! Chunks are read here, not by the decoder, because it unpacks colour profiles and texts on the way to the size:
//! a megabyte of them can hold a gigabyte.

use png::{Decoder, DecodingError};
use std::collections::BTreeSet;
use std::io::Cursor;
use std::sync::{Mutex, PoisonError};
use twox_hash::XxHash3_128;

/// The signature of a PNG.
pub const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Chunks with packed content that no output needs: colour profiles, which glTF tells readers to ignore, and texts.
const PACKED: [&[u8]; 3] = [b"iCCP", b"zTXt", b"iTXt"];

/// A chunk: its type, and all its bytes from the length to the checksum.
struct Chunk<'a> {
    kind: &'a [u8],
    whole: &'a [u8],
}

/// The complete chunks of a PNG up to the last one, in order; none of other files.
fn chunks(bytes: &[u8]) -> impl Iterator<Item = Chunk<'_>> {
    let mut rest = bytes.strip_prefix(PNG).unwrap_or_default();
    std::iter::from_fn(move || {
        let length = u32::from_be_bytes(*rest.first_chunk::<4>()?);
        // Length, type, data, checksum.
        let (whole, after) = rest.split_at_checked((length as usize).checked_add(12)?)?;
        let kind = &whole[4..8];
        rest = if kind == b"IEND" { &[] } else { after };
        Some(Chunk { kind, whole })
    })
}

/// Returns true if every chunk of a PNG is complete.
pub(super) fn is_whole(bytes: &[u8]) -> bool {
    chunks(bytes).any(|chunk| chunk.kind == b"IEND")
}

/// Returns true if all rows of a PNG can be read. They are read one by one, whatever their number, and files that were
/// found sound are known again by their content: editors read images at every key.
pub(super) fn is_sound(bytes: &[u8]) -> bool {
    static SOUND: Mutex<BTreeSet<u128>> = Mutex::new(BTreeSet::new());
    let sound = || SOUND.lock().unwrap_or_else(PoisonError::into_inner);
    let content = XxHash3_128::oneshot(bytes);
    if sound().contains(&content) {
        return true;
    }
    let all = is_whole(bytes) && rows(bytes).is_ok();
    if all {
        let mut sound = sound();
        if sound.len() >= MOST_KNOWN {
            sound.clear();
        }
        sound.insert(content);
    }
    all
}

/// The most files that are known to be sound.
const MOST_KNOWN: usize = 1 << 12;

/// Reads all rows.
fn rows(bytes: &[u8]) -> Result<(), DecodingError> {
    let mut reader = Decoder::new(Cursor::new(bytes)).read_info()?;
    while reader.next_row()?.is_some() {}
    reader.finish()
}

/// Returns the width and height in pixels; `None` for files that are no PNG.
pub(super) fn size(bytes: &[u8]) -> Option<(u32, u32)> {
    let header = bytes.strip_prefix(PNG)?.get(4..16)?.strip_prefix(b"IHDR")?;
    let (width, height) = header.split_first_chunk::<4>()?;
    let height = height.first_chunk::<4>()?;
    Some((u32::from_be_bytes(*width), u32::from_be_bytes(*height)))
}

/// Returns a PNG without the chunks that only unpacking could tell the size of, and then
/// without anything after its end.
///
/// A truncated PNG loses its last, incomplete chunk where it has such chunks.
pub(super) fn without_packed(bytes: Vec<u8>) -> Vec<u8> {
    let packed = |chunk: &Chunk<'_>| PACKED.contains(&chunk.kind);
    if !chunks(&bytes).any(|chunk| packed(&chunk)) {
        return bytes;
    }
    let kept = chunks(&bytes).filter(|chunk| !packed(chunk));
    let mut lean = PNG.to_vec();
    kept.for_each(|chunk| lean.extend_from_slice(chunk.whole));
    lean
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
        let length = (data.len() as u32).to_be_bytes();
        [&length, &kind[..], data, &[0; 4]].concat()
    }

    #[test]
    fn profiles_and_packed_texts_are_left_out() {
        let header = chunk(b"IHDR", &[0, 0, 0, 3, 0, 0, 0, 2, 8, 2, 0, 0, 0]);
        let end = chunk(b"IEND", &[]);
        let [profile, text] = [b"iCCP", b"zTXt"].map(|kind| chunk(kind, b"packed"));
        let file = [PNG, &header, &profile, &text, &end, b"more"].concat();
        assert_eq!((size(&file), is_whole(&file)), (Some((3, 2)), true));
        let lean = [PNG, &header, &end].concat();
        assert_eq!(without_packed(file.clone()), lean);
        assert_eq!(without_packed(lean.clone()), lean);
        let cut = &file[..file.len() - 8];
        assert!(!is_whole(cut));
        assert_eq!(without_packed(cut.to_vec()), [PNG, &header].concat());
        assert_eq!(without_packed(b"no PNG".to_vec()), b"no PNG");
    }

    #[test]
    fn broken_lengths_end_a_file() {
        for length in [u32::MAX, u32::MAX - 11, 100] {
            let file = [PNG, &length.to_be_bytes(), b"IHDR"].concat();
            assert!(!is_whole(&file) && size(&file).is_none());
        }
    }
}
