//! The roof section with its defaults filled in.

use hsd_base::source::Span;
use hsd_ir::ast;
use hsd_ir::program::Roofs;

/// Copies the section; roofs are made by `roof`, not here.
pub(super) fn roofs(roofs: &ast::Roofs) -> Roofs {
    Roofs {
        mode: roofs
            .mode
            .as_ref()
            .map_or_else(Default::default, |m| m.value),
        method: roofs
            .method
            .as_ref()
            .map_or_else(Default::default, |m| m.value),
        wished: wished(roofs),
        style: roofs.style.clone(),
        by_use: roofs.by_use,
        lines: roofs.lines.clone(),
        slant_told: false,
    }
}

/// Returns the place where roofs are requested. `explicit` without a line requests no roof at all.
fn wished(roofs: &ast::Roofs) -> Option<Span> {
    if let (Some(first), Some(last)) = (roofs.lines.first(), roofs.lines.last()) {
        return Some(first.span.to(last.span));
    }
    match &roofs.mode {
        Some(mode) if mode.value == ast::RoofMode::Explicit => None,
        Some(mode) => Some(mode.span),
        None => {
            let style = &roofs.style;
            let spans = [
                roofs.method.as_ref().map(|s| s.span),
                style.kind.as_ref().map(|s| s.span),
                style.shape.as_ref().map(|s| s.span),
                roofs.by_use,
                style.pitch.as_ref().map(|s| s.span),
                style.eaves.as_ref().map(|s| s.span),
                style.verge.as_ref().map(|s| s.span),
                style.thickness.as_ref().map(|s| s.span),
                style.noshi.as_ref().map(|s| s.span),
                style.sori.as_ref().map(|s| s.span),
                style.gable.as_ref().map(|s| s.span),
                style.ratio.as_ref().map(|s| s.span),
                style.plain_ridge.as_ref().map(|s| s.span),
                style.gable_wall.as_ref().map(|s| s.span),
                style.offset.as_ref().map(|s| s.span),
                style.paint.as_ref().map(|s| s.span),
            ];
            spans.into_iter().flatten().reduce(Span::to).or(roofs.span)
        }
    }
}
