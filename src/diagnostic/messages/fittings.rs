//! Messages about what stands at a house (HSD07xx): platforms, verandas, finials, and houses written short.

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// A platform or a veranda round walls that do not close.
#[cold]
pub fn nothing_to_stand_at(span: Span, what: &str) -> Diagnostic {
    Diagnostic::warning(701, span, format!("there are no closed walls for this {what} to lie round"))
        .help("close the walls of the storey, or remove it")
}

/// A finial on a house without a roof.
#[cold]
pub fn no_roof_below(span: Span) -> Diagnostic {
    Diagnostic::warning(702, span, "there is no roof below this finial")
        .help("write a roof under it, or remove `at` so that it stands on the highest roof")
}

/// Storeys beside a house written short.
#[cold]
pub fn storeys_beside(span: Span, name: &str, storey: Span) -> Diagnostic {
    let text = format!("`{name}` is a whole house; the storeys beside it are left out");
    Diagnostic::error(703, span, text)
        .help(format!("remove the storeys, or write them out instead of `{name}`"))
        .label(storey, "the storeys begin here")
}

/// Measures that leave no room for something.
#[cold]
pub fn no_room(span: Span, what: &str, has: f64, needs: f64) -> Diagnostic {
    let text = format!("{what} has {has:.1} shaku, too little to stand: {needs:.1} are taken");
    Diagnostic::warning(704, span, text)
        .help("let the storeys taper less, set them back less, or make them higher")
}
