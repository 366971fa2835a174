//! `split`: a part of one storey divided into an upper and a lower half (003-09), to any depth. Both halves are as wide
//! as the part.

use super::Pass;
use super::codes::{Mode, Which};
use super::edits::Strip;
use super::rows::bare_unit;
use hsd_base::geometry::SAME;
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_ir::ast;
use hsd_ir::messages::parts as say;
use hsd_ir::program::{Content, Split, Unit};

/// Default share of the upper half.
pub(super) const EVEN: f64 = 0.5;

impl Pass<'_, '_> {
    /// Expands one split; returns whether its width comes only from images.
    pub(super) fn split(&mut self, split: &ast::Split, place: Place, mode: Mode) -> (Unit, bool) {
        let ratio = split.ratio.as_ref().map_or(EVEN, |ratio| ratio.value);
        // The readers admit only shares between 0 and 1; a document built otherwise does no harm.
        let ratio = if ratio > 0.0 && ratio < 1.0 {
            ratio
        } else {
            EVEN
        };
        let mut upper = self.half(&split.upper, place.at(1), mode.share(ratio));
        let mut lower = self.half(&split.lower, place.at(2), mode.share(1.0 - ratio));
        let (above, below) = (upper.width(), lower.width());
        let fixed = !upper.natural && !lower.natural;
        // A missing half has the place of the split, and was reported.
        let written = split.upper.span != split.span && split.lower.span != split.span;
        if fixed && written && (above - below).abs() >= SAME && !self.stopped() {
            let spans = (split.upper.span, split.lower.span);
            self.once(311, split.span, || {
                say::unequal_halves(split.span, spans, above, below)
            });
        }
        let natural = upper.natural && lower.natural;
        let width = common_width(&upper, &lower);
        fit(&mut upper, width, split.upper.span);
        fit(&mut lower, width, split.lower.span);
        (divided(split.span, ratio, width, upper, lower), natural)
    }
}

/// Returns the width of both halves: that of a half with a given width, otherwise the larger.
pub(super) fn common_width(upper: &Strip, lower: &Strip) -> f64 {
    match (upper.natural, lower.natural) {
        (false, true) if upper.width() > SAME => upper.width(),
        (true, false) if lower.width() > SAME => lower.width(),
        _ => upper.width().max(lower.width()),
    }
}

/// Creates the unit of two halves of this width.
pub(super) fn divided(span: Span, ratio: f64, width: f64, upper: Strip, lower: Strip) -> Unit {
    Unit {
        span,
        width,
        content: Content::Split(Box::new(Split {
            ratio,
            upper: upper.units,
            lower: lower.units,
        })),
        height: None,
        reflection: None,
        picture: None,
    }
}

/// Scales a row to a width; a row without any width becomes open.
pub(super) fn fit(strip: &mut Strip, width: f64, span: Span) {
    let now = strip.width();
    if now > SAME {
        if now != width {
            scale(&mut strip.units, width / now);
        }
    } else if width > SAME {
        strip.units.push(bare_unit(span, width, Which::Void));
    }
}

fn scale(units: &mut [Unit], factor: f64) {
    for unit in units {
        unit.width *= factor;
        if let Content::Split(split) = &mut unit.content {
            scale(&mut split.upper, factor);
            scale(&mut split.lower, factor);
        }
    }
}
