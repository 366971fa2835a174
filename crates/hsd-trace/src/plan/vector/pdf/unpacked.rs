//! The sizes of the streams of a PDF, unpacked. They are counted before the reader of its objects unpacks them without bounds.

use flate2::read::DeflateDecoder;
use hsd_base::budget::{Account, Exhausted, Resource};
use memchr::memmem;
use std::io::Read;
use weezl::BitOrder;
use weezl::decode::Decoder;

/// Filters in each other.
const DEEPEST: usize = 4;
/// The bytes before a stream in which its filters are named.
const DICTIONARY: usize = 2048;
/// Bytes that are unpacked at a time.
const PIECE: usize = 64 << 10;

/// Charges the account of a PDF with all that its streams unpack to.
///
/// # Errors
/// If it is more than the run may take.
pub(super) fn charge(bytes: &[u8], account: &Account) -> Result<(), Exhausted> {
    for at in memmem::find_iter(bytes, b"stream") {
        // The word ends each stream, too.
        if bytes[..at].ends_with(b"end") {
            continue;
        }
        let data = &bytes[at + b"stream".len()..];
        let data = data.strip_prefix(b"\r").unwrap_or(data);
        let data = data.strip_prefix(b"\n").unwrap_or(data);
        let dictionary = &bytes[at.saturating_sub(DICTIONARY)..at];
        if memmem::find(dictionary, b"LZW").is_some() {
            charge_lzw(data, account)?;
        }
        charge_deflated(data, account, 0)?;
    }
    Ok(())
}

/// Charges for what data unpack to if they are deflated, with the two bytes of zlib before them or without.
fn charge_deflated(data: &[u8], account: &Account, depth: usize) -> Result<(), Exhausted> {
    let is_zlib = |data: &[u8]| match data {
        [a, b, ..] => a & 0x0f == 8 && u16::from_be_bytes([*a, *b]).is_multiple_of(31),
        _ => false,
    };
    let packed = if is_zlib(data) { &data[2..] } else { data };
    let mut decoder = DeflateDecoder::new(packed);
    let (mut piece, mut inner) = (vec![0; PIECE], vec![]);
    let mut is_first = true;
    while let Ok(count @ 1..) = decoder.read(&mut piece) {
        account.charge(Resource::InflatedBytes, count as u64)?;
        // What is deflated twice is kept for a second look.
        if std::mem::take(&mut is_first) {
            inner = match depth < DEEPEST && is_zlib(&piece[..count]) {
                true => Vec::with_capacity(count),
                false => continue,
            };
        } else if inner.capacity() == 0 {
            continue;
        }
        inner.extend_from_slice(&piece[..count]);
    }
    match inner.is_empty() {
        true => Ok(()),
        false => charge_deflated(&inner, account, depth + 1),
    }
}

fn charge_lzw(data: &[u8], account: &Account) -> Result<(), Exhausted> {
    let mut decoder = Decoder::with_tiff_size_switch(BitOrder::Msb, 8);
    let (mut rest, mut piece) = (data, vec![0; PIECE]);
    loop {
        let step = decoder.decode_bytes(rest, &mut piece);
        account.charge(Resource::InflatedBytes, step.consumed_out as u64)?;
        rest = &rest[step.consumed_in..];
        let goes_on = matches!(step.status, Ok(weezl::LzwStatus::Ok));
        if !goes_on || step.consumed_in + step.consumed_out == 0 {
            return Ok(());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::charge;
    use flate2::Compression;
    use flate2::write::ZlibEncoder;
    use hsd_base::budget::{Account, Budget};
    use std::io::Write;
    use std::sync::Arc;

    fn deflated(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = ZlibEncoder::new(vec![], Compression::default());
        encoder.write_all(bytes).expect("is written");
        encoder.finish().expect("is written")
    }

    /// Returns true if a run with this memory takes a stream.
    fn is_taken(stream: &[u8], memory: u64) -> bool {
        let account = Account::new(Arc::new(Budget::new(memory)));
        let pdf = [b"<</Length 9>>stream\r\n", stream, b"\nendstream"].concat();
        charge(&pdf, &account).is_ok()
    }

    #[test]
    fn what_streams_unpack_to_is_charged() {
        let flat = vec![b' '; 1 << 20];
        assert!(is_taken(&flat, 0));
        assert!(is_taken(&deflated(&flat), 16 << 20));
        assert!(!is_taken(&deflated(&flat), 4 << 20));
    }

    #[test]
    fn streams_that_are_packed_twice_are_charged_for_both() {
        let twice = deflated(&deflated(&vec![b' '; 4 << 20]));
        assert!(!is_taken(&twice, 8 << 20));
        assert!(is_taken(&twice, 64 << 20));
    }
}
