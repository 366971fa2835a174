//! Messages of `hsd fmt` (HSD08xx).

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// A layout that would not say the same: a fault of ours, and no harm is done.
#[cold]
pub fn left_alone(span: Span) -> Diagnostic {
    Diagnostic::error(
        801,
        span,
        "the text is left as it is: laid out, it would not say the same",
    )
    .help("this is a fault of hsd; please report it, with the text")
}
