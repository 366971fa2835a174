//! Messages about building law in towns (HSD1171).

use hsd_base::diagnostic::Diagnostic;
use hsd_base::source::Span;
use hsd_base::text;

/// A plan that guides the street scene but says no height.
#[cold]
pub fn no_guiding_height(span: Span) -> Diagnostic {
    let message = text!(
        "a guided plan lines heights up, and none is given",
        "街並み誘導の計画は高さをそろえますが、高さがありません"
    );
    Diagnostic::warning(1171, span, message).help(text!(
        "give the common height with `limit`, such as `limit=\"15\"`, and the line of the fronts with `setback`",
        "そろえる高さを `limit=\"15\"` のように `limit` に、壁面の線を `setback` に書いてください"
    ))
}
