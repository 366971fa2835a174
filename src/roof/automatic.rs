//! Automatic roofs: each region of a storey becomes a gable, a branch, a lean-to or a flat roof.

use super::facet::EPS;
use super::forms::{Context, Planned};
use super::frame::{end_sides, near_side};
use super::gable::End;
use super::gable_wall::{SUNK, panel};
use super::lean_to::{Flank, LeanTo};
use super::look::Look;
use super::outline::piece;
use super::plan::Cell;
use super::ridge::{Region, Ridge, Side};
use super::sides::Sides;
use crate::ast::RoofShape;
use crate::building::{Ceiling, Finish, rect_of};
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::roofs as say;
use glam::{DVec3, dvec2, dvec3};

/// The least height that an outer wall keeps under a lean-to, metres.
const LEAST_WALL: f64 = 1.8;
/// How far a lean-to's upper edge lies below the wall plate of its trunk, metres.
const TUCKED: f64 = 0.10;

/// The regions of one storey on their way to roofs.
pub(super) struct Automatic<'c, 'h> {
    pub(super) context: &'c Context<'h>,
    pub(super) regions: &'c [Region],
    /// Height of the wall plates, metres.
    pub(super) base: f64,
    /// Of each region.
    pub(super) looks: Vec<Look>,
    /// Who lies beyond whole sides.
    sides: Option<Sides>,
}

impl<'c, 'h> Automatic<'c, 'h> {
    pub(super) fn new(context: &'c Context<'h>, regions: &'c [Region]) -> Self {
        let look = |r: &Region| match (r.ridge, r.fall) {
            (None, Some(fall)) => {
                let depth = context.metres(fall.measure(&r.cell).1);
                Look::lean_to(None, context.style, depth)
            }
            (ridge, _) => context.gable_look(&r.cell, ridge.unwrap_or(Ridge::A), None),
        };
        let looks = regions.iter().map(look).collect();
        let cells = || -> Vec<Cell> { regions.iter().map(|r| r.cell).collect() };
        let sides = (regions.len() > 1).then(|| Sides::of(&cells()));
        Automatic { context, regions, base: context.level.storey.z1, looks, sides }
    }

    /// A roof for every region, in their order; ceilings where walls end lower.
    pub(super) fn roofs(&self, ceilings: &mut Vec<Ceiling>, out: &mut Diagnostics) -> Vec<Planned> {
        let roof = |n: usize| {
            let region = &self.regions[n];
            match (region.ridge, region.fall) {
                (None, Some(fall)) if region.over.is_some() => self.tucked(n, fall, ceilings, out),
                (None, Some(fall)) => self.context.lean_to(region.cell, fall, self.base, None),
                (ridge, _) => self.gable(n, ridge.unwrap_or(Ridge::A)),
            }
        };
        (0..self.regions.len()).map(roof).collect()
    }

    fn gable(&self, n: usize, ridge: Ridge) -> Planned {
        let (region, look) = (&self.regions[n], self.looks[n]);
        let near = near_side(ridge);
        let ends = end_sides(near).map(|side| {
            let plain = self.context.plain_end(&region.cell, near, side, &look);
            let joined = region.joins == Some(side) && ridge == side.ridge_into();
            match (region.through, region.over) {
                (Some(other), _) if joined => {
                    let across = self.context.metres(side.measure(&self.regions[other].cell).1);
                    End { reach: across, board: false, ..plain }
                }
                (None, Some(trunk)) if joined => self.run_in(n, trunk, side, plain),
                _ => self.other_end(n, side, plain),
            }
        });
        self.context.gable_with(region.cell, ridge, self.base, look, ends)
    }

    /// The end of gable `n` that joins no trunk. It may still lie on the slope of a roof that stands
    /// higher, as at the far end of a wing between two halls: then it dies there as well.
    fn other_end(&self, n: usize, side: Side, plain: End) -> End {
        let region = &self.regions[n];
        let beyond = self.sides.as_ref().and_then(|s| s.beyond(&region.cell, side));
        let Some(other) = beyond.filter(|_| plain.wall) else { return plain };
        let end = self.run_in(n, other, side, plain);
        if !end.wall {
            return end;
        }
        let neighbour = &self.regions[other];
        let leans = neighbour.fall.is_some_and(|f| f != side && f != side.opposite());
        if leans && neighbour.over.is_none() {
            let rise = self.looks[other].pitch * self.context.metres(neighbour.span()) / 2.0;
            let own = self.looks[n].pitch * self.context.metres(region.span()) / 2.0;
            if own < rise {
                // Its wall stands higher: a verge would stick into it.
                return End { verge: 0.0, free: false, ..plain };
            }
        }
        plain
    }

    /// The end of branch `n` that lies with `side` on its trunk: the ridge runs on until it dies in
    /// the trunk's slope (domain.md 3.7). Where it stands higher than the trunk, it ends over the
    /// trunk's ridge in a gable of its own.
    fn run_in(&self, n: usize, trunk: usize, side: Side, plain: End) -> End {
        let (own, other) = (&self.looks[n], &self.looks[trunk]);
        let region = &self.regions[trunk];
        let run = match (region.ridge, region.fall) {
            (Some(ridge), _) if ridge != side.ridge_into() => {
                side.measure(&region.cell).1 as f64 / 2.0
            }
            (None, Some(fall)) if fall == side.opposite() && region.over.is_none() => {
                side.measure(&region.cell).1 as f64
            }
            // Against the trunk's gable, or over a lean-to that lies lower.
            _ => return End { board: false, ..plain },
        };
        let run = run / crate::geometry::STEPS as f64 * self.context.unit;
        let span = self.context.metres(self.regions[n].span());
        let height = own.pitch * span / 2.0 + own.drop() - other.drop();
        if height > other.pitch * run + 1e-6 {
            return End { reach: run, board: false, ..plain };
        }
        let reach = (height / other.pitch + 0.02).clamp(0.02, run);
        End { reach, ..End::default() }
    }

    /// A lean-to under the eaves of its trunk: it lies below the wall plate, and walls below it end
    /// at its lower surface.
    fn tucked(&self, n: usize, fall: Side, ceilings: &mut Vec<Ceiling>, out: &mut Diagnostics) -> Planned {
        let region = &self.regions[n];
        let lean_to = self.tucked_slope(n, fall);
        let storey = self.context.level.storey;
        let left = lean_to.low - storey.z0;
        if left < LEAST_WALL - 1e-6 {
            out.push(say::low_lean_to(storey.span, storey.number, left));
        }
        let soffit = lean_to.soffit();
        let unit = self.context.unit;
        ceilings.push(Ceiling {
            storey: storey.number,
            rect: rect_of(region.cell),
            z: soffit.z,
            slope: dvec2(-soffit.slope.x * unit, soffit.slope.y * unit),
        });
        let mut form = lean_to.form();
        form.under = region.over;
        self.heads(n, &lean_to, &mut form.solids);
        self.context.of_form(form, RoofShape::LeanTo, lean_to.look, self.base)
    }

    /// Where a tucked lean-to lies: gentler where its outer wall would get too low.
    fn tucked_slope(&self, n: usize, fall: Side) -> LeanTo {
        let region = &self.regions[n];
        let depth = self.context.metres(fall.measure(&region.cell).1);
        let mut look = self.looks[n];
        let joint = self.joint_height(n, fall.opposite());
        let low = |look: &Look| joint - self.tuck(n, fall, look) - look.drop() - look.pitch * depth;
        let floor = self.context.level.storey.z0;
        if low(&look) - floor < LEAST_WALL {
            look.pitch = look.pitch.min(0.2);
        }
        let flank = |side: Side| {
            let over = if self.context.outline().whole(&region.cell, side) { look.verge } else { 0.0 };
            Flank { over, wall: false }
        };
        LeanTo {
            rect: self.context.rect(&region.cell),
            near: fall,
            low: low(&look),
            look,
            ends: end_sides(fall).map(flank),
            high: Flank { over: 0.03, wall: false },
        }
    }

    /// How far below the joint the upper surface starts, so that it stays below the trunk's eaves.
    fn tuck(&self, n: usize, fall: Side, look: &Look) -> f64 {
        let Some(trunk) = self.regions[n].over else { return TUCKED };
        let eaves_side = match self.regions[trunk].ridge {
            Some(ridge) => ridge != fall.ridge_into(),
            None => true,
        };
        let trunk = &self.looks[trunk];
        let under_eaves = trunk.eaves * (trunk.pitch - look.pitch) + 0.03;
        if eaves_side { TUCKED.max(under_eaves) } else { TUCKED }
    }

    /// Height of the trunk's plate along the joint; its own soffit where it is tucked as well.
    fn joint_height(&self, n: usize, side: Side) -> f64 {
        let Some(trunk) = self.regions[n].over else { return self.base };
        let region = &self.regions[trunk];
        let (Some(fall), true) = (region.fall, region.over.is_some()) else {
            return self.base;
        };
        let soffit = self.tucked_slope(trunk, fall).soffit();
        let (from, to) = self.ends_of(n, side);
        soffit.at(from.truncate()).min(soffit.at(to.truncate())).min(self.base)
    }

    /// The ends of a whole side, at height 0.
    fn ends_of(&self, n: usize, side: Side) -> (DVec3, DVec3) {
        let (line, lo, hi) = piece(&self.regions[n].cell, side);
        (self.on_side(side, line, lo), self.on_side(side, line, hi))
    }

    fn on_side(&self, side: Side, line: i64, at: i64) -> DVec3 {
        let (line, at) = (self.context.metres(line), self.context.metres(at));
        match side {
            Side::Front | Side::Back => dvec3(-at, line, 0.0),
            Side::Left | Side::Right => dvec3(-line, at, 0.0),
        }
    }

    /// Fills above a tucked lean-to where it opens to other rooms: from its surface to the plate.
    fn heads(&self, n: usize, lean_to: &LeanTo, solids: &mut Vec<crate::building::Solid>) {
        let cell = &self.regions[n].cell;
        let soffit = lean_to.soffit();
        for side in Side::ALL {
            let (line, _, _) = piece(cell, side);
            for (lo, hi) in self.context.outline().gaps(cell, side) {
                if self.tucked_beyond(n, side, line, (lo, hi)) {
                    continue;
                }
                let at = |p: i64| {
                    let point = self.on_side(side, line, p);
                    point + DVec3::Z * (soffit.at(point.truncate()) - 2.0 * SUNK)
                };
                let (from, to) = (at(lo), at(hi));
                let top = self.base + SUNK;
                if (to - from).length() > EPS && top - from.z.max(to.z) > SUNK {
                    solids.push(panel(from, to, [top, top], Finish::Gable));
                }
            }
        }
    }

    /// Whether another tucked lean-to lies beyond this piece of a side.
    fn tucked_beyond(&self, n: usize, side: Side, line: i64, (lo, hi): (i64, i64)) -> bool {
        let tucked = |r: &Region| r.fall.is_some() && r.over.is_some();
        self.regions.iter().enumerate().any(|(m, other)| {
            let (theirs, from, to) = piece(&other.cell, side.opposite());
            m != n && tucked(other) && theirs == line && from < hi && lo < to
        })
    }
}
