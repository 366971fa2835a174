//! The page, where it was built before the program (`view/` in the sources).

use crate::diagnostic::Text;
use crate::text;

/// The files of the page by their names, each packed with gzip.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// Whether there is a page to be shown.
pub fn there() -> bool {
    file("index.html").is_some()
}

/// How to make a program that has the page.
pub fn how_to_get_it() -> Text {
    text!(
        "this hsd is built without its page; with Node.js at hand, `npm ci --prefix view && npm run build --prefix view` and \
         `cargo build --release` make one that has it",
        "この hsd には画面が含まれていません。Node.js があれば `npm ci --prefix view && npm run build --prefix view` のあと \
         `cargo build --release` で含めて作れます"
    )
}

/// A file of the page and its media type.
pub(super) fn file(name: &str) -> Option<(&'static str, &'static [u8])> {
    let (_, bytes) = FILES.iter().find(|(own, _)| *own == name)?;
    let kind = match name.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        _ => "application/octet-stream",
    };
    Some((kind, bytes))
}
