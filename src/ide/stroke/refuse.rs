//! Why a stroke is refused, and what to do instead.

use crate::diagnostic::Text;
use crate::text;

/// A stroke that the tool does not know how to make.
pub(super) fn not_yet() -> Text {
    text!(
        "this cannot be drawn; change the text instead",
        "これは図面では変えられません。テキストを書き換えてください"
    )
}
