//! Automatic roofs: each region of a storey becomes a gable, a branch, a lean-to or a flat roof.

use crate::frame::{end_sides, near_side};
use crate::join::nearby::Nearby;
use crate::messages as say;
use crate::plan::outline::piece;
use crate::plan::sides::Sides;
use crate::region::{Region, Ridge, Side};
use crate::shape::end::End;
use crate::shape::form::RoofDraft;
use crate::shape::gable_wall::panel;
use crate::shape::lean_to::{Flank, LeanTo};
use crate::shape::look::Look;
use crate::solid::SUNK;
use crate::storey::forms::Context;
use crate::storey::written::Written;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::tolerance::CUT;
use hsd_ir::ast::RoofShape;
use hsd_ir::building::{Ceiling, Finish, rect_of};
use std::cell::OnceCell;

use glam::{DVec3, dvec2, dvec3};

/// The minimum height of an outer wall under a lean-to, metres.
const LEAST_WALL: f64 = 1.8;
/// Depth of a lean-to's upper edge below the wall plate of its trunk, metres.
const TUCKED: f64 = 0.10;

/// The data for roofing the regions of one storey.
pub(crate) struct Automatic<'c, 'h> {
    pub(crate) context: &'c Context<'h>,
    /// The regions, followed by the written roofs.
    pub(crate) regions: Vec<Region>,
    /// The number of regions.
    count: usize,
    written: &'c [Written],
    /// Height of the wall plates, metres.
    pub(crate) base: f64,
    /// The look of each region.
    pub(crate) looks: Vec<Look>,
    /// For each lean-to under the eaves of its trunk, its slope.
    tucked: Vec<Option<LeanTo>>,
    /// The lowest outer wall that a lean-to would have left, if some became gables for that, metres.
    too_low: Option<f64>,
    /// Neighbours along whole sides.
    pub(crate) sides: Option<Sides>,
    /// Spatial index of the regions, made on first use.
    nearby: OnceCell<Nearby>,
}

impl<'c, 'h> Automatic<'c, 'h> {
    pub(crate) fn new(
        context: &'c Context<'h>,
        mut regions: Vec<Region>,
        written: &'c [Written],
    ) -> Self {
        let base = context.level.storey.z1;
        let looks = regions.iter().map(|r| look(context, r, base));
        let looks = looks.chain(written.iter().map(|w| w.look)).collect();
        let count = regions.len();
        regions.extend(written.iter().map(|w| w.beside.roof));
        let cells = || -> Vec<Cell> { regions.iter().map(|r| r.cell).collect() };
        let sides = (regions.len() > 1).then(|| Sides::of(&cells()));
        let mut this = Automatic {
            context,
            regions,
            count,
            written,
            base,
            looks,
            tucked: vec![],
            too_low: None,
            sides,
            nearby: OnceCell::new(),
        };
        this.tuck_all();
        this
    }

    /// Places the lean-tos under their trunks' eaves, trunks first: by decreasing area. A lean-to that would leave too
    /// little of its outer wall becomes a gable.
    fn tuck_all(&mut self) {
        let leans = |r: &Region| r.fall.is_some() && r.over.is_some();
        self.tucked = vec![None; self.regions.len()];
        let mut order: Vec<usize> = (0..self.count)
            .filter(|n| leans(&self.regions[*n]))
            .collect();
        order.sort_by_key(|n| std::cmp::Reverse(self.regions[*n].cell.area()));
        for n in order {
            let Some(fall) = self.regions[n].fall else {
                continue;
            };
            let slope = self.tucked_slope(n, fall);
            let left = slope.low - self.context.level.storey.z0;
            if left >= LEAST_WALL {
                self.tucked[n] = Some(slope);
                continue;
            }
            let region = self.regions[n];
            self.regions[n] = Region {
                ridge: Some(along(fall)),
                street: region.street,
                ..Region::main(region.cell)
            };
            self.too_low = Some(self.too_low.map_or(left, |lowest| lowest.min(left)));
        }
    }

    /// Returns the regions as they are built.
    pub(crate) fn own_regions(&self) -> &[Region] {
        &self.regions[..self.count]
    }

    /// Reports lean-tos that do not fit, by the lowest.
    pub(crate) fn report(&self, out: &mut Diagnostics) {
        if let Some(lowest) = self.too_low {
            let storey = self.context.level.storey;
            out.push(say::low_lean_to(
                storey.span,
                storey.number,
                lowest.max(0.0),
            ));
        }
    }

    /// Returns a roof for every region, in their order; adds ceilings where walls end lower.
    pub(crate) fn roofs(&self, ceilings: &mut Vec<Ceiling>) -> Vec<RoofDraft> {
        let roof = |n: usize| {
            let region = &self.regions[n];
            match (region.ridge, region.fall) {
                (None, Some(fall)) => match &self.tucked[n] {
                    Some(slope) => self.tucked_roof(n, slope, ceilings),
                    None => {
                        let look = self.looks[n];
                        self.context
                            .lean_to_with(region.cell, fall, self.base, look)
                    }
                },
                (ridge, _) => self.ridge_roof(n, ridge.unwrap_or(Ridge::A)),
            }
        };
        (0..self.count).map(roof).collect()
    }

    fn ridge_roof(&self, n: usize, ridge: Ridge) -> RoofDraft {
        let (region, look) = (&self.regions[n], self.looks[n]);
        let near = near_side(ridge);
        let ends = end_sides(near).map(|side| {
            let plain = self.context.plain_end(&region.cell, side, &look);
            let joined = region.joins == Some(side) && ridge == side.ridge_into();
            match (region.through, region.over) {
                (Some(other), _) if joined => {
                    let across = self
                        .context
                        .metres(side.measure(&self.regions[other].cell).1);
                    End {
                        reach: across,
                        ..plain
                    }
                }
                (None, Some(trunk)) if joined => self.abut(n, trunk, side, plain),
                _ => self.mitred(n, side, self.other_end(n, side, plain)),
            }
        });
        self.context
            .ridge_roof_with(region.cell, ridge, self.base, look, ends)
    }

    /// Returns the end of roof `n` that joins no trunk. It may still lie on the slope of a higher roof, as at the far
    /// end of a wing between two halls: then it ends there as well.
    fn other_end(&self, n: usize, side: Side, plain: End) -> End {
        let region = &self.regions[n];
        let beyond = self
            .sides
            .as_ref()
            .and_then(|s| s.beyond(&region.cell, side));
        let level = |other: &usize| self.plate(*other) == self.base;
        let Some(other) = beyond.filter(level).filter(|_| plain.wall) else {
            return plain;
        };
        let end = self.abut(n, other, side, plain);
        if !end.wall {
            return end;
        }
        let neighbour = &self.regions[other];
        let leans = neighbour
            .fall
            .is_some_and(|f| f != side && f != side.opposite());
        if leans && neighbour.over.is_none() {
            let rise = self.looks[other].pitch * self.context.metres(neighbour.span()) / 2.0;
            let own = self.looks[n].pitch * self.context.metres(region.span()) / 2.0;
            if own < rise {
                // Its wall is higher: a verge would penetrate it.
                return End {
                    verge: 0.0,
                    ..plain
                };
            }
        }
        plain
    }

    /// Returns a lean-to under the eaves of its trunk: it lies below the wall plate, and walls below it end at its
    /// lower surface.
    fn tucked_roof(&self, n: usize, lean_to: &LeanTo, ceilings: &mut Vec<Ceiling>) -> RoofDraft {
        let region = &self.regions[n];
        let storey = self.context.level.storey;
        let soffit = lean_to.soffit();
        let unit = self.context.unit;
        ceilings.push(Ceiling {
            storey: storey.number,
            rect: rect_of(region.cell),
            z: soffit.z,
            slope: dvec2(-soffit.slope.x * unit, soffit.slope.y * unit),
        });
        let mut form = lean_to.form();
        form.under = region.over.map(|trunk| self.place(trunk));
        self.heads(n, lean_to, &mut form.solids);
        self.context
            .of_form(form, RoofShape::LeanTo, lean_to.look, self.base)
    }

    /// Returns the slope of a tucked lean-to, gentler if its outer wall would get too low.
    fn tucked_slope(&self, n: usize, fall: Side) -> LeanTo {
        let region = &self.regions[n];
        let depth = self.context.metres(fall.measure(&region.cell).1);
        let mut look = Look {
            // Walls end along a plane below it.
            sori: 0.0,
            ..self.looks[n]
        };
        let below = |joint: f64, look: &Look| {
            joint - self.tuck(n, fall, look) - look.drop() - look.pitch * depth
        };
        let joint = self.joint_height(n, fall.opposite());
        // Under a roof that is much higher it rises from the plate like one against a wall.
        let stands = below(joint, &look) >= self.base;
        let low = |look: &Look| match stands {
            true => self.base,
            false => below(joint.min(self.base), look),
        };
        let floor = self.context.level.storey.z0;
        if low(&look) - floor < LEAST_WALL {
            look.pitch = look.pitch.min(0.2);
        }
        let flank = |side: Side| {
            let over = if self.context.outline().whole(&region.cell, side) {
                look.verge
            } else {
                0.0
            };
            Flank { over, wall: stands }
        };
        LeanTo {
            rect: self.context.rect(&region.cell),
            near: fall,
            low: low(&look),
            look,
            ends: end_sides(fall).map(flank),
            high: Flank {
                over: 0.03,
                wall: stands,
            },
        }
    }

    /// Returns the height of the wall plate of a region or a written roof.
    fn plate(&self, n: usize) -> f64 {
        let written = n.checked_sub(self.count).and_then(|i| self.written.get(i));
        written.map_or(self.base, |w| w.base)
    }

    /// Returns the index of a trunk among the roofs of its height: written ones follow the regions.
    fn place(&self, trunk: usize) -> usize {
        let written = trunk
            .checked_sub(self.count)
            .and_then(|i| self.written.get(i));
        match written {
            None => trunk,
            Some(w) if w.beside.level => self.count + w.before,
            // It joins no roof here, but eaves of others are still cut back.
            Some(_) => usize::MAX,
        }
    }

    /// Returns the depth below the joint, metres, at which the upper surface starts, to clear the trunk's eaves.
    fn tuck(&self, n: usize, fall: Side, look: &Look) -> f64 {
        let Some(trunk) = self.regions[n].over else {
            return TUCKED;
        };
        let eaves_side = match self.regions[trunk].ridge {
            Some(ridge) => ridge != fall.ridge_into() || self.cap(trunk).has_corners(),
            None => true,
        };
        let trunk = &self.looks[trunk];
        let under_eaves = trunk.eaves * (trunk.pitch - look.pitch) + 0.03;
        if eaves_side {
            TUCKED.max(under_eaves)
        } else {
            TUCKED
        }
    }

    /// Returns the height of the trunk's plate along the joint; its own soffit if it is tucked as well.
    fn joint_height(&self, n: usize, side: Side) -> f64 {
        let Some(trunk) = self.regions[n].over else {
            return self.base;
        };
        let Some(slope) = &self.tucked[trunk] else {
            return self.plate(trunk);
        };
        let soffit = slope.soffit();
        let (from, to) = self.ends_of(n, side);
        soffit
            .at(from.truncate())
            .min(soffit.at(to.truncate()))
            .min(self.base)
    }

    /// Returns the ends of a whole side, at height 0.
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

    /// Returns the infills above a tucked lean-to where it opens to other rooms: from its surface to the plate.
    fn heads(&self, n: usize, lean_to: &LeanTo, solids: &mut Vec<hsd_ir::building::Solid>) {
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
                if (to - from).length() > CUT && top - from.z.max(to.z) > SUNK {
                    solids.push(panel(from, to, [top, top], Finish::Gable));
                }
            }
        }
    }

    /// Returns true if another tucked lean-to lies beyond this piece of a side.
    fn tucked_beyond(&self, n: usize, side: Side, line: i64, (lo, hi): (i64, i64)) -> bool {
        let beyond = |m: &usize| {
            let (theirs, from, to) = piece(&self.regions[*m].cell, side.opposite());
            *m != n && self.tucked[*m].is_some() && theirs == line && from < hi && lo < to
        };
        let index = self.nearby.get_or_init(|| {
            Nearby::new(
                self.regions
                    .iter()
                    .map(|r| self.context.rect(&r.cell))
                    .collect(),
            )
        });
        let about = self.context.rect(&self.regions[n].cell).grown(0.01);
        index.overlapping(&about).iter().any(beyond)
    }
}

/// Returns the look of a region's roof, gentle enough to stay below the eaves of the storeys above.
fn look(context: &Context<'_>, region: &Region, base: f64) -> Look {
    let look = match (region.ridge, region.fall) {
        (None, Some(fall)) => {
            let depth = context.metres(fall.measure(&region.cell).1);
            Look::lean_to(None, context.style, depth)
        }
        (ridge, _) => context.gable_look(&region.cell, ridge.unwrap_or(Ridge::A), None),
    };
    match region.fall.is_some() && region.over.is_some() {
        // Tucked under its trunk it rises no higher than its walls.
        true => look,
        false => {
            let rect = context.rect(&region.cell);
            context.headroom.fit(&rect, region, base, look)
        }
    }
}

/// Returns the direction of a ridge along the low side of a lean-to.
fn along(fall: Side) -> Ridge {
    match fall.ridge_into() {
        Ridge::A => Ridge::B,
        Ridge::B => Ridge::A,
    }
}
