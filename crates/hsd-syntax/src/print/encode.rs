//! Encodes files in the encoding of the file they came from.

use encoding_rs::Encoding;
use hsd_base::source::{FileId, Source};

const MARK: &str = "\u{feff}";

/// Returns the bytes of a source file in the encoding of a source, with a byte order mark if it has one; UTF-8 if that
/// encoding cannot represent the file, or could not be detected from the bytes.
pub fn encode(text: &str, source: &Source) -> Vec<u8> {
    let marked = source.span(0..0).start > 0;
    let bytes = in_encoding(text, source.encoding(), marked);
    let readable = |bytes: &Vec<u8>| Source::new(FileId::default(), "", bytes).text() == text;
    bytes.filter(readable).unwrap_or_else(|| utf8(text, marked))
}

/// Returns the name of a source's encoding in a declaration.
pub(super) fn label(source: &Source) -> &'static str {
    match source.encoding() {
        "UTF-16LE" | "UTF-16BE" => "UTF-16",
        other => other,
    }
}

fn utf8(text: &str, marked: bool) -> Vec<u8> {
    let mark = if marked { MARK } else { "" };
    [mark, text].concat().into_bytes()
}

fn in_encoding(text: &str, name: &str, marked: bool) -> Option<Vec<u8>> {
    let units = || MARK.encode_utf16().chain(text.encode_utf16());
    match name {
        "UTF-8" => Some(utf8(text, marked)),
        "UTF-16LE" => Some(units().flat_map(u16::to_le_bytes).collect()),
        "UTF-16BE" => Some(units().flat_map(u16::to_be_bytes).collect()),
        _ => {
            let encoding = Encoding::for_label(name.as_bytes())?;
            let (bytes, _, lost) = encoding.encode(text);
            (!lost).then(|| bytes.into_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_in_their_encoding() {
        let text = "# 町家\n0 0\n";
        let (shift_jis, ..) = encoding_rs::SHIFT_JIS.encode(text);
        let (euc, ..) = encoding_rs::EUC_JP.encode(text);
        let utf16: Vec<u8> = "\u{feff}# 町家\n0 0\n"
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        let marked = ["\u{feff}", text].concat();
        for bytes in [
            &shift_jis[..],
            &euc,
            &utf16,
            text.as_bytes(),
            marked.as_bytes(),
        ] {
            let source = Source::new(FileId(0), "a.hsd", bytes);
            assert_eq!(source.text(), text);
            assert_eq!(encode(text, &source), bytes, "{}", source.encoding());
        }
        let source = Source::new(FileId(0), "a.hsd", &shift_jis);
        assert_eq!(encode("# 🏠\n", &source), "# 🏠\n".as_bytes());
    }
}
