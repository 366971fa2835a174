//! Makes a roof of a rectangle and options: the neighbours of each side determine its ends.

use crate::frame::{Frame, Rect, end_sides, metres, near_side};
use crate::plan::level::Level;
use crate::plan::outline::{Outline, piece};
use crate::region::{Ridge, Side};
use crate::shape::end::{Cap, End};
use crate::shape::flat;
use crate::shape::form::{Form, RoofDraft};
use crate::shape::lean_to::{Flank, LeanTo};
use crate::shape::look::Look;
use crate::shape::pent::Pent;
use crate::shape::ridge_roof::RidgeRoof;
use crate::storey::headroom::Headroom;
use glam::{DVec2, dvec2};
use hsd_base::geometry::SAME;
use hsd_base::geometry::plan::{Cell, Plan};
use hsd_ir::ast::{RoofShape, RoofStyle};
use hsd_ir::building::{Attic, Roof};
use std::cell::OnceCell;

/// Shared data of all roofs of one storey.
pub(crate) struct Context<'h> {
    /// One U in metres.
    pub(crate) unit: f64,
    /// The options of the house.
    pub(crate) style: &'h RoofStyle,
    /// True if corridors mitre at their corners.
    pub(crate) corridors: bool,
    /// The storey.
    pub(crate) level: &'h Level<'h>,
    /// The storey above, if it is closed and at right angles.
    pub(crate) above: Option<&'h Level<'h>>,
    /// The plan of the storey above.
    pub(crate) upper: Option<&'h Plan>,
    /// Top of the highest walls, metres.
    pub(crate) roof_top: f64,
    /// The space that the eaves of the storeys above leave to its roofs.
    pub(crate) headroom: Headroom,
    /// The fire walls that stand on its roofs.
    pub(crate) fire_walls: Vec<Cell>,
    pub(crate) outline: OnceCell<Outline>,
    pub(crate) upper_outline: OnceCell<Outline>,
}

impl Context<'_> {
    /// Returns the walls of the storey.
    pub(crate) fn outline(&self) -> &Outline {
        self.outline.get_or_init(|| match &self.level.plan {
            plan if !self.level.orthogonal || plan.loops.is_empty() => Outline::default(),
            plan if plan.loops.len() == 1 => Outline::of(plan),
            plan => Outline::of(&plan.clean()),
        })
    }

    /// Returns the walls of the storey above.
    fn upper_outline(&self) -> &Outline {
        self.upper_outline.get_or_init(|| {
            self.upper
                .map(|u| Outline::of(&u.clean()))
                .unwrap_or_default()
        })
    }

    /// Returns true if an upper wall stands along the whole side.
    pub(crate) fn is_walled(&self, cell: &Cell, side: Side) -> bool {
        self.upper.is_some() && self.upper_outline().whole(cell, side)
    }

    /// Returns true if a fire wall stands over a side: the roof ends in it, without a verge.
    fn ends_in_fire_wall(&self, cell: &Cell, side: Side) -> bool {
        let (line, lo, hi) = piece(cell, side);
        self.fire_walls.iter().any(|wall| {
            let ((one, from, to), (other, ..)) = (piece(wall, side), piece(wall, side.opposite()));
            let shared = hi.min(to) - lo.max(from);
            (one.min(other)..=one.max(other)).contains(&line) && 10 * shared > 9 * (hi - lo)
        })
    }

    /// Returns true if walls run along both sides up to the corner between them.
    fn is_corner(&self, cell: &Cell, side: Side, other: Side) -> bool {
        let reaches = |along: Side, end: Side| {
            let (_, lo, hi) = piece(cell, along);
            let walls = self.outline().along(cell, along);
            match end {
                Side::Left | Side::Back => walls.last().is_some_and(|w| w.1 == hi),
                Side::Right | Side::Front => walls.first().is_some_and(|w| w.0 == lo),
            }
        };
        reaches(side, other) && reaches(other, side)
    }

    /// Converts plan steps to metres.
    pub(crate) fn metres(&self, steps: i64) -> f64 {
        metres(steps, self.unit)
    }

    /// Converts a cell to the house frame, metres.
    pub(crate) fn rect(&self, cell: &Cell) -> Rect {
        Rect::of(cell, self.unit)
    }

    fn roof(&self, shape: RoofShape, look: &Look) -> Roof {
        let storey = self.level.storey.number;
        Roof {
            storey,
            span: None,
            shape,
            kind: look.kind,
            trim: look.trim(),
            attic: Attic::default(),
            whole: None,
            solids: vec![],
        }
    }

    /// Returns the look of a gable over a cell.
    pub(crate) fn gable_look(&self, cell: &Cell, ridge: Ridge, style: Option<&RoofStyle>) -> Look {
        let span = if ridge == Ridge::A {
            cell.depth()
        } else {
            cell.width()
        };
        Look::gable(style, self.style, self.metres(span), self.unit)
    }

    /// Returns the end of a roof that joins no other.
    pub(crate) fn plain_end(&self, cell: &Cell, side: Side, look: &Look) -> End {
        if self.is_walled(cell, side) {
            return End::default();
        }
        End {
            verge: match self.ends_in_fire_wall(cell, side) {
                true => 0.0,
                false => look.verge,
            },
            wall: true,
            ..End::default()
        }
    }

    /// Returns a two-sloped roof over a cell that joins no other.
    pub(crate) fn ridge_roof(
        &self,
        cell: Cell,
        ridge: Ridge,
        base: f64,
        style: Option<&RoofStyle>,
    ) -> RoofDraft {
        let look = self.gable_look(&cell, ridge, style);
        let near = near_side(ridge);
        let ends = end_sides(near).map(|side| self.plain_end(&cell, side, &look));
        self.ridge_roof_with(cell, ridge, base, look, ends)
    }

    /// Returns a two-sloped roof with given ends; the free ones get the treatment of its shape.
    pub(crate) fn ridge_roof_with(
        &self,
        cell: Cell,
        ridge: Ridge,
        base: f64,
        look: Look,
        mut ends: [End; 2],
    ) -> RoofDraft {
        let near = near_side(ridge);
        let (length, span) = match ridge {
            Ridge::A => (cell.width(), cell.depth()),
            Ridge::B => (cell.depth(), cell.width()),
        };
        let length = self.metres(length) + ends.iter().map(|e| e.reach).sum::<f64>();
        let free = ends.map(|e| e.wall && e.reach == 0.0);
        let cap = Cap::of(&look, length, self.metres(span) / 2.0, free == [true; 2]);
        for (i, side) in end_sides(near)
            .into_iter()
            .enumerate()
            .filter(|(i, _)| free[*i])
        {
            // A corridor that turns a corner has its hip already.
            if ends[i].cap == Cap::Gable {
                ends[i].cap = cap;
            }
            if look.sori > 0.0 && ends[i].cap.has_corners() {
                ends[i].rises =
                    [near, near.opposite()].map(|eaves| self.is_corner(&cell, side, eaves));
            }
        }
        let roof = RidgeRoof {
            rect: self.rect(&cell),
            near,
            base,
            look,
            ends,
        };
        RoofDraft {
            form: roof.form(),
            look,
            roof: self.roof(look.shape, &look),
            base,
        }
    }

    /// Returns the ridge of a written roof. Equal slopes on four sides have theirs along the long side, regardless of
    /// the author's direction.
    pub(crate) fn ridge(&self, cell: &Cell, style: &RoofStyle, wish: Option<Ridge>) -> Ridge {
        let shape = style.shape.map_or(RoofShape::Gable, |s| s.value);
        let ratio = style.ratio.or(self.style.ratio).is_some();
        let wish = wish.filter(|_| !shape.has_equal_slopes(ratio) || cell.width() == cell.depth());
        wish.unwrap_or_else(|| self.automatic_ridge(cell, shape))
    }

    /// Returns the default ridge direction of a shape.
    fn automatic_ridge(&self, cell: &Cell, shape: RoofShape) -> Ridge {
        let long = if cell.depth() > cell.width() {
            Ridge::B
        } else {
            Ridge::A
        };
        match (shape, long) {
            (RoofShape::BroadGable, Ridge::B) => Ridge::A,
            (RoofShape::BroadGable, Ridge::A) if cell.width() > cell.depth() => Ridge::B,
            _ => long,
        }
    }

    /// Returns a single slope that stands on the plate and falls to `near`.
    pub(crate) fn lean_to(
        &self,
        cell: Cell,
        near: Side,
        base: f64,
        style: Option<&RoofStyle>,
    ) -> RoofDraft {
        let (_, depth) = near.measure(&cell);
        let look = Look::lean_to(style, self.style, self.metres(depth));
        self.lean_to_with(cell, near, base, look)
    }

    /// Returns a single slope of a given look.
    pub(crate) fn lean_to_with(&self, cell: Cell, near: Side, base: f64, look: Look) -> RoofDraft {
        let flank = |side: Side| match self.is_walled(&cell, side) {
            true => Flank::default(),
            false => Flank {
                over: look.verge,
                wall: true,
            },
        };
        let lean_to = LeanTo {
            rect: self.rect(&cell),
            near,
            low: base,
            look,
            ends: end_sides(near).map(flank),
            high: flank(near.opposite()),
        };
        RoofDraft {
            form: lean_to.form(),
            look,
            roof: self.roof(RoofShape::LeanTo, &look),
            base,
        }
    }

    /// Returns a roof of a given form.
    pub(crate) fn of_form(&self, form: Form, shape: RoofShape, look: Look, base: f64) -> RoofDraft {
        RoofDraft {
            form,
            look,
            roof: self.roof(shape, &look),
            base,
        }
    }

    /// Returns a pent roof, and the height of its upper edge.
    pub(crate) fn pent(
        &self,
        cell: Cell,
        near: Side,
        height: f64,
        style: Option<&RoofStyle>,
    ) -> (RoofDraft, f64) {
        let depth = self.metres(near.measure(&cell).1);
        let mut look = Look::lean_to(style, self.style, depth);
        if style.and_then(|s| s.thickness).is_none() {
            // Small tiles on lath: thinner than the main roof.
            look.thickness = look.thickness.min(0.09);
        }
        let pent = Pent {
            rect: self.rect(&cell),
            near,
            height,
            look,
            posts: self.posts(&cell, near),
        };
        let bare = Look {
            eaves: 0.0,
            verge: 0.0,
            ..look
        };
        let planned = RoofDraft {
            form: pent.form(),
            look,
            roof: self.roof(RoofShape::Pent, &bare),
            base: height,
        };
        (planned, height + look.pitch * depth)
    }

    /// Returns where posts stand in the wall behind a cell that falls to `near`: between the units of the walls along it,
    /// and at their ends; metres from the left as seen from there, in order.
    fn posts(&self, cell: &Cell, near: Side) -> Vec<f64> {
        let frame = Frame::new(&self.rect(cell), near);
        let place = |p: DVec2| frame.place(dvec2(-p.x, p.y) * self.unit);
        let rings = self.level.storey.rings.iter().filter(|r| !r.inner);
        let mut posts: Vec<f64> = Vec::new();
        for wall in rings.flat_map(|ring| &ring.walls) {
            let [from, to] = [wall.from, wall.to].map(place);
            if [from, to].iter().any(|p| (p.y - frame.depth).abs() > SAME) {
                continue;
            }
            let along = (to.x - from.x).signum() * self.unit;
            let ends = wall.units.iter().scan(0.0, |offset, unit| {
                *offset += unit.width;
                Some(*offset)
            });
            posts.extend(std::iter::once(0.0).chain(ends).map(|u| from.x + along * u));
        }
        posts.retain(|u| (-SAME..=frame.length + SAME).contains(u));
        posts.sort_by(f64::total_cmp);
        posts
    }

    /// Returns a flat roof over cells that make up `plan`.
    pub(crate) fn flat(
        &self,
        cells: &[Cell],
        plan: &Plan,
        base: f64,
        style: Option<&RoofStyle>,
    ) -> RoofDraft {
        let (look, thick) = self.flat_look(style);
        let mut solids = flat::slab_of_cells(cells, self.unit, base, look.kind, thick);
        if !self.level.parapet {
            let borders = flat::borders(plan, self.outline(), self.unit);
            solids.extend(borders.iter().flat_map(|b| flat::upstands(b, base)));
        }
        self.flat_of(solids, look, base)
    }

    /// Returns the look of a flat roof and the thickness of its slab.
    pub(crate) fn flat_look(&self, style: Option<&RoofStyle>) -> (Look, f64) {
        let look = Look::lean_to(style, self.style, 0.0);
        let own = style.and_then(|s| s.thickness).or(self.style.thickness);
        (look, own.map_or(0.15, |_| look.thickness.max(0.1)))
    }

    /// Returns a flat roof of finished solids.
    pub(crate) fn flat_of(
        &self,
        solids: Vec<hsd_ir::building::Solid>,
        look: Look,
        base: f64,
    ) -> RoofDraft {
        let form = Form {
            solids,
            ..Form::default()
        };
        RoofDraft {
            form,
            look,
            roof: self.roof(RoofShape::Flat, &look),
            base,
        }
    }
}
