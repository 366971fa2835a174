//! Lower roofs (of monuments mokoshi roofs, as on a gate or a pagoda): a storey that carries a smaller one is roofed as
//! a whole if its shape is hipped, and the walls of the upper storey cut the slopes (docs/evidence.md 7.10: planes from
//! -h to +c between two wall rectangles).

use crate::facet::{Cutter, Facet, cut, edges};
use crate::frame::{end_sides, near_side};
use crate::messages as say;
use crate::region::{Ridge, Side};
use crate::shape::end::{Cap, End};
use crate::shape::form::{Form, RoofDraft};
use crate::shape::look::Look;
use crate::shape::ridge_roof::RidgeRoof;
use crate::storey::forms::Context;
use crate::storey::headroom::gentler;
use glam::dvec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::SHAKU;
use hsd_base::geometry::plan::Cell;
use hsd_base::source::Span;
use hsd_ir::ast::{RoofShape, RoofStyle};
use hsd_ir::building::Storey;

/// A rectangle with the walls of the storey above inside it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Skirt<'h> {
    /// The walls below.
    cell: Cell,
    /// The walls above.
    upper: Cell,
    /// The storey above.
    storey: &'h Storey,
}

impl<'h> Skirt<'h> {
    /// Returns the lower roof of this shape over `cell`; `None` if no smaller storey stands on it.
    pub(crate) fn over(cell: Cell, shape: RoofShape, context: &Context<'h>) -> Option<Skirt<'h>> {
        let hipped = matches!(
            shape,
            RoofShape::Hip | RoofShape::Pyramid | RoofShape::HipAndGable | RoofShape::Temple
        );
        let above = context.above.filter(|_| hipped)?;
        let whole = |u: &Cell| cell.contains(u) && *u != cell;
        let upper = above.plan.as_cell().filter(whole)?;
        Some(Skirt {
            cell,
            upper,
            storey: above.storey,
        })
    }

    /// Returns the strips that it covers, with the side each falls to; those at the front and back have the corners.
    pub(crate) fn strips(&self) -> Vec<(Cell, Side)> {
        let (cell, upper) = (self.cell, self.upper);
        let (b0, b1) = (upper.b0, upper.b1);
        let all = [
            (Cell { b1: b0, ..cell }, Side::Front),
            (Cell { b0: b1, ..cell }, Side::Back),
            (
                Cell {
                    a0: upper.a1,
                    b0,
                    b1,
                    ..cell
                },
                Side::Left,
            ),
            (
                Cell {
                    a1: upper.a0,
                    b0,
                    b1,
                    ..cell
                },
                Side::Right,
            ),
        ];
        let open = |(c, _): &(Cell, Side)| c.width() > 0 && c.depth() > 0;
        all.into_iter().filter(open).collect()
    }

    /// Returns the direction its ridge would have without the upper walls.
    fn ridge(&self) -> Ridge {
        if self.cell.depth() > self.cell.width() {
            Ridge::B
        } else {
            Ridge::A
        }
    }

    /// Returns the setback of the upper walls from a side, metres.
    fn inset(&self, side: Side, context: &Context<'_>) -> f64 {
        let (cell, upper) = (&self.cell, &self.upper);
        context.metres(match side {
            Side::Front => upper.b0 - cell.b0,
            Side::Back => cell.b1 - upper.b1,
            Side::Left => cell.a1 - upper.a1,
            Side::Right => upper.a0 - cell.a0,
        })
    }

    /// Returns the roof. `span` is the place that requests it.
    pub(crate) fn planned(
        &self,
        context: &Context<'_>,
        base: f64,
        style: Option<&RoofStyle>,
        span: Span,
        out: &mut Diagnostics,
    ) -> RoofDraft {
        let near = near_side(self.ridge());
        let rect = context.rect(&self.cell);
        let look = context.gable_look(&self.cell, self.ridge(), style);
        let look = self.fit(context, base, look, span, out);
        let size = rect.max - rect.min;
        let cap = Cap::Hip {
            run: size.min_element() / 2.0,
        };
        let end = End {
            cap,
            rises: [true; 2],
            ..End::default()
        };
        let roof = RidgeRoof {
            rect,
            near,
            base,
            look,
            ends: end_sides(near).map(|_| end),
        };
        let mut form = roof.form();
        self.take_walls(&mut form, context, look.eaves);
        context.of_form(form, RoofShape::Hip, look, base)
    }

    /// Returns the look with a pitch that keeps it below the eaves or the top of the storey it surrounds.
    fn fit(
        &self,
        context: &Context<'_>,
        base: f64,
        mut look: Look,
        span: Span,
        out: &mut Diagnostics,
    ) -> Look {
        let half = context.metres(self.cell.width().min(self.cell.depth())) / 2.0;
        let insets = Side::ALL.map(|side| self.inset(side, context));
        let run = insets.into_iter().fold(0.0, f64::max).min(half);
        let lowest = context.headroom.lowest(&context.rect(&self.cell));
        let top = lowest.map_or(self.storey.z1, |eaves| eaves.min(self.storey.z1));
        let wish = look.pitch;
        look.pitch = gentler(&look, run, top - base);
        if look.pitch < wish {
            let rise = (base + wish * run + look.drop()) / SHAKU;
            let number = self.storey.number;
            out.push(say::high_skirt(
                span,
                rise,
                number,
                top / SHAKU,
                look.pitch * 10.0,
            ));
        }
        look
    }

    /// Cuts the upper walls out of the slopes; where they stand on a wall below, the slopes stop with their eaves.
    fn take_walls(&self, form: &mut Form, context: &Context<'_>, eaves: f64) {
        let mut rect = context.rect(&self.upper);
        let over = |side: Side| match self.inset(side, context) > 0.0 {
            true => 0.0,
            false => 2.0 * eaves + 0.1,
        };
        // x runs east, against a.
        rect.min -= dvec2(over(Side::Left), over(Side::Front));
        rect.max += dvec2(over(Side::Right), over(Side::Back));
        let body = rect.corners();
        let cutter = Cutter {
            body: &body,
            sides: &edges(&body),
            plane: None,
            first: true,
        };
        let rest = |facet: &Facet| {
            let pieces = cut(facet, vec![facet.outline.clone()], &cutter);
            let (plane, lowered) = (facet.plane, facet.lowered);
            pieces.into_iter().map(move |outline| Facet {
                body: outline.iter().map(|c| c.at).collect(),
                outline,
                plane,
                lowered,
            })
        };
        form.facets = form.facets.iter().flat_map(rest).collect();
    }
}
