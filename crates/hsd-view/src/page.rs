//! The embedded files of the page, if it was built (`view/` in the sources).

use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_page::FILES;

/// Returns whether this build contains the page.
pub fn is_built() -> bool {
    file("index.html").is_some()
}

/// Returns the message for a build without the page.
pub fn how_to_build() -> Text {
    text!(
        "this hsd was built without its page; to build one with it (requires Node.js): \
         `npm ci --prefix view && npm run build --prefix view`, then `cargo build --release`",
        "この hsd は画面なしでビルドされています。Node.js があれば、`npm ci --prefix view && npm run build --prefix view` のあと \
         `cargo build --release` で使えるようになります"
    )
}

/// Returns the media type and the contents of a file.
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
