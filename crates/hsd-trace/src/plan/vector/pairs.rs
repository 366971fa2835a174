//! DXF as pairs of a group code and a value, from text or binary files.

use super::refused::Refused;
use std::borrow::Cow;

/// How a binary file begins.
const BINARY: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// A pair.
pub(super) type Pair<'b> = (i32, Cow<'b, str>);

/// Splits a file into pairs.
///
/// # Errors
/// If it is no DXF, or ends within a pair.
pub(super) fn read<'b>(bytes: &'b [u8], text: &'b mut String) -> Result<Vec<Pair<'b>>, Refused> {
    if let Some(rest) = bytes.strip_prefix(BINARY) {
        return binary(rest);
    }
    if bytes.starts_with(b"AC10") {
        return Err(Refused::NotDxf {
            line: 1,
            what: "this is a DWG; save it as DXF".to_owned(),
        });
    }
    *text = decoded(bytes);
    let mut pairs = vec![];
    let mut lines = text.lines().enumerate();
    while let Some((k, line)) = lines.next() {
        if line.trim().is_empty() && pairs.is_empty() {
            continue;
        }
        let wrong = |what: &str| Refused::NotDxf {
            line: k + 1,
            what: what.to_owned(),
        };
        let Ok(code) = line.trim().parse::<i32>() else {
            // What stands after the end is nobody's business.
            if pairs.last().is_some_and(is_end) {
                break;
            }
            return Err(wrong("a group code (a whole number) was looked for"));
        };
        let Some((_, value)) = lines.next() else {
            return Err(wrong("the file ends after a group code"));
        };
        let value = value.strip_suffix('\r').unwrap_or(value);
        pairs.push((code, Cow::Borrowed(value)));
    }
    match pairs.iter().any(is_end) {
        true => Ok(pairs),
        false => Err(Refused::Truncated {
            line: text.lines().count(),
        }),
    }
}

fn is_end((code, value): &Pair<'_>) -> bool {
    *code == 0 && value.trim() == "EOF"
}

/// Letters from bytes: UTF-8, else Shift_JIS if the file says so or nothing speaks against it.
fn decoded(bytes: &[u8]) -> String {
    if let Ok(text) = std::str::from_utf8(bytes) {
        return text.trim_start_matches('\u{feff}').to_owned();
    }
    // Programs name the code page of their makers, whatever the letters are. Bytes that begin a letter of Shift_JIS are rare signs
    // in western ones.
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(20_000)]).to_uppercase();
    let is_western = (head.contains("ANSI_125") || head.contains("ISO8859"))
        && !bytes.iter().any(|b| (0x81..=0x9f).contains(b));
    let (text, _, is_wrong) = encoding_rs::SHIFT_JIS.decode(bytes);
    match is_western || is_wrong && !head.contains("932") {
        true => encoding_rs::WINDOWS_1252.decode(bytes).0.into_owned(),
        false => text.into_owned(),
    }
}

/// What stands in a pair of a binary file.
enum Kind {
    Text,
    Real,
    Whole(usize),
    Bytes,
}

fn kind(code: i32) -> Kind {
    match code {
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Kind::Real,
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Kind::Whole(2),
        90..=99 | 420..=429 | 440..=459 | 1071 => Kind::Whole(4),
        160..=169 => Kind::Whole(8),
        290..=299 => Kind::Whole(1),
        310..=319 | 1004 => Kind::Bytes,
        _ => Kind::Text,
    }
}

fn binary(bytes: &[u8]) -> Result<Vec<Pair<'_>>, Refused> {
    // Until R12 a group code has one byte.
    let is_old = bytes.get(1).is_some_and(|b| *b != 0);
    let mut at = 0;
    let mut pairs: Vec<Pair<'_>> = vec![];
    let take = |at: &mut usize, count: usize| -> Option<&[u8]> {
        let taken = bytes.get(*at..at.checked_add(count)?)?;
        *at += count;
        Some(taken)
    };
    loop {
        let cut = Refused::Truncated {
            line: pairs.len() * 2,
        };
        let pair = (|| {
            let short = |b: &[u8]| i32::from(i16::from_le_bytes([b[0], b[1]]));
            let code = match is_old {
                true => match take(&mut at, 1)?[0] {
                    255 => short(take(&mut at, 2)?),
                    code => i32::from(code),
                },
                false => short(take(&mut at, 2)?),
            };
            let value = match kind(code) {
                Kind::Real => f64::from_le_bytes(take(&mut at, 8)?.try_into().ok()?)
                    .to_string()
                    .into(),
                Kind::Whole(size) => {
                    let mut whole = [0; 8];
                    let taken = take(&mut at, size)?;
                    whole[..size].copy_from_slice(taken);
                    // The sign is in the highest byte that is there.
                    let shift = 64 - 8 * size as u32;
                    ((i64::from_le_bytes(whole) << shift) >> shift)
                        .to_string()
                        .into()
                }
                Kind::Bytes => {
                    let size = usize::from(take(&mut at, 1)?[0]);
                    take(&mut at, size)?;
                    Cow::Borrowed("")
                }
                Kind::Text => {
                    let size = bytes.get(at..)?.iter().position(|b| *b == 0)?;
                    let text = decoded(take(&mut at, size)?);
                    take(&mut at, 1)?;
                    text.into()
                }
            };
            Some((code, value))
        })();
        let pair = pair.ok_or(cut)?;
        let ends = is_end(&pair);
        pairs.push(pair);
        if ends {
            return Ok(pairs);
        }
    }
}
