//! A storey roofed as a whole: one hipped roof by the straight skeleton over each outline with its courts, whatever
//! its angles; the walls of the storey above cut it, and there are no eaves where they stand on its own walls.

use crate::frame::{Rect, metres};
use crate::messages as say;
use crate::plan::level::{Level, Point};
use crate::plan::necks::{Necks, Wing};
use crate::plan::{MOST_CORNERS, report, spans};
use crate::shape::deck;
use crate::shape::flat;
use crate::shape::form::RoofDraft;
use crate::shape::hipped::Hipped;
use crate::shape::look::Look;
use crate::skeleton::polygons::{Part, gathered, tagged};
use crate::skeleton::{Contours, Invalid};
use crate::storey::forms::Context;
use crate::storey::placed_line::PlacedLine;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::STEPS;
use hsd_base::geometry::plan::slabs;
use hsd_base::geometry::plan::{Cell, Plan};
use hsd_ir::ast::{RoofMethod, RoofMode, RoofShape};
use hsd_ir::building::{House, HouseRoofs, Ring, Wall};

/// A storey roofed as a whole.
pub(crate) struct Polygonal<'a, 'h> {
    pub(crate) house: &'a House,
    pub(crate) context: &'a Context<'h>,
    /// The storey above, if it bounds anything.
    pub(crate) upper: Option<&'a Level<'h>>,
    pub(crate) lines: &'a [&'a PlacedLine<'a>],
}

/// Returns true if a storey's roof is flat, because the source says so or a parapet surrounds it.
pub(crate) fn is_flat(house: &House, level: &Level<'_>) -> bool {
    let shape = house.roofs.style.shape;
    shape.map_or(level.parapet, |s| s.value == RoofShape::Flat)
}

/// Returns the convex parts of a storey's plan in the house frame, metres.
pub(crate) fn walls(house: &House, level: &Level<'_>) -> Vec<Vec<DVec2>> {
    if level.orthogonal {
        let strips = slabs::strips(&level.plan).into_iter();
        let rect = |c: Cell| Rect::of(&c, house.unit).corners().to_vec();
        return strips.map(rect).collect();
    }
    let parts = parts_of(house, level);
    parts.iter().flat_map(Part::pieces).collect()
}

/// Returns the parts of a storey in the house frame, metres.
fn parts_of(house: &House, level: &Level<'_>) -> Vec<Part> {
    let corners = |ring: &Ring| -> Vec<DVec2> {
        let place = |p: &DVec2| house.place(*p, 0.0).truncate();
        ring.corners().iter().map(place).collect()
    };
    let rings = level.rings(false).chain(level.rings(true));
    let rings: Vec<Vec<DVec2>> = rings.map(corners).filter(|r| r.len() > 2).collect();
    gathered(&rings)
}

impl Polygonal<'_, '_> {
    /// Returns the automatic roofs: none if the storey above repeats this one or automatic roofs are off.
    pub(crate) fn roofs(&self, done: &mut HouseRoofs, out: &mut Diagnostics) -> Vec<RoofDraft> {
        let level = self.context.level;
        let covered = self.upper.is_some_and(|u| same_plan(level, u));
        let wanted = self.house.roofs.mode == RoofMode::Auto && !covered;
        let parts = if wanted { self.open() } else { vec![] };
        let flat = self.becomes_flat(&parts, out);
        let shape = if flat {
            RoofShape::Flat
        } else {
            RoofShape::Hip
        };
        let unit = self.house.unit;
        let plan = |p: &Part| {
            let of = |c: &DVec2| dvec2(-c.x, c.y) / unit + 0.0;
            p.outline.iter().rev().map(of).collect()
        };
        done.plans.push(report::polygons(
            level,
            parts.iter().map(plan).collect(),
            shape,
        ));
        let walls: Vec<[DVec2; 2]> = match self.upper {
            Some(upper) if !flat => parts_of(self.house, upper)
                .iter()
                .flat_map(|p| p.edges().collect::<Vec<_>>())
                .collect(),
            _ => vec![],
        };
        let mut roof = |part: &Part| match flat {
            true => self.flat(part),
            false => self.hipped(part, &walls, out).unwrap_or_else(|why| {
                let (span, number) = (level.storey.span, level.storey.number);
                let touching = matches!(why, Invalid::Crosses { .. });
                out.push(say::no_hipped_roof(span, number, touching));
                self.flat(part)
            }),
        };
        parts.iter().map(&mut roof).collect()
    }

    /// Returns the roofs of wings at odd angles, which go on into those of the rest; their regions follow those of the rest.
    pub(crate) fn wings(
        &self,
        necks: &Necks,
        done: &mut HouseRoofs,
        out: &mut Diagnostics,
    ) -> Vec<RoofDraft> {
        let (level, unit) = (self.context.level, self.house.unit);
        let corners = |ring: &[Point]| -> Vec<DVec2> {
            let at = |steps: i64| steps as f64 / STEPS as f64;
            ring.iter().map(|p| dvec2(at(p.0), at(p.1))).collect()
        };
        let outlines = necks.wings.iter().map(|w| corners(&w.outline)).collect();
        let regions = report::polygons(level, outlines, RoofShape::Hip).regions;
        if let Some(plan) = done.plans.last_mut() {
            plan.regions.extend(regions);
        }
        if let (Some(wall), false) = (self.slanting_wall(), self.house.roofs.slant_told) {
            out.push(say::wings_at_angles(wall.span, level.storey.number));
        }
        let roof = |wing: &Wing| {
            let place = |p: &DVec2| dvec2(-p.x, p.y) * unit;
            let ring: Vec<DVec2> = corners(&wing.roof).iter().map(place).collect();
            let [part] = &gathered(&[ring])[..] else {
                return None;
            };
            let roof = self.hipped(part, &[], out);
            Some(roof.unwrap_or_else(|_| self.flat(part)))
        };
        necks.wings.iter().filter_map(roof).collect()
    }

    /// Returns true if the roofs over some parts are flat; reports where that or a hip roof may not be what the author
    /// expects.
    fn becomes_flat(&self, parts: &[Part], out: &mut Diagnostics) -> bool {
        let (level, roofs) = (self.context.level, &self.house.roofs);
        let corners = parts.iter().flat_map(Part::edges).count();
        if corners > MOST_CORNERS {
            let (span, number) = (level.storey.span, level.storey.number);
            out.push(say::too_many_corners(span, number, corners, MOST_CORNERS));
            return true;
        }
        if parts.is_empty() || is_flat(self.house, level) {
            return is_flat(self.house, level);
        }
        match roofs.style.shape {
            Some(s) if matches!(s.value, RoofShape::Hip | RoofShape::Pyramid) => {}
            Some(s) => out.push(say::hipped_only(s.span, s.value.letters())),
            None if roofs.method == RoofMethod::Skeleton || roofs.slant_told => {}
            None => {
                let wall = self.slanting_wall().map(|w| w.span);
                let number = level.storey.number;
                if let Some(span) = wall {
                    out.push(say::whole_hip(span, number));
                }
            }
        }
        false
    }

    /// Returns a wall that is parallel to no axis of the plan, of this storey or the one above.
    fn slanting_wall(&self) -> Option<&Wall> {
        let levels = [Some(self.context.level), self.upper].into_iter().flatten();
        let rings = levels.flat_map(|level| level.storey.rings.iter().filter(|r| r.closed));
        let mut walls = rings.flat_map(|ring| &ring.walls);
        walls.find(|w| w.direction.x != 0.0 && w.direction.y != 0.0)
    }

    /// Returns the parts that no roof line covers. Lines cut rectangles, so they cover all of a storey that is not
    /// orthogonal.
    fn open(&self) -> Vec<Part> {
        let level = self.context.level;
        let cells: Vec<Cell> = self
            .lines
            .iter()
            .filter(|l| l.covers())
            .map(|l| l.cell)
            .collect();
        if cells.is_empty() {
            return parts_of(self.house, level);
        }
        if !level.orthogonal || !level.plan.fits(Some(&Plan::from_cells(&cells))) {
            return vec![];
        }
        let open = level.plan.minus_cells(&cells).clean();
        let unit = self.house.unit;
        let place = |p: &(i64, i64)| dvec2(-metres(p.0, unit), metres(p.1, unit));
        let loops: Vec<Vec<DVec2>> = open
            .loops
            .iter()
            .map(|l| l.iter().map(place).collect())
            .collect();
        gathered(&loops)
    }

    fn hipped(
        &self,
        part: &Part,
        walls: &[[DVec2; 2]],
        out: &mut Diagnostics,
    ) -> Result<RoofDraft, Invalid> {
        let courts: Vec<_> = part.courts.iter().map(|c| tagged(c, walls)).collect();
        let contours = Contours::new(&tagged(&part.outline, walls), &courts)?;
        let hipped = Hipped::new(&contours)?;
        let base = self.context.level.storey.z1;
        let wide = hipped.span() > spans::WIDEST && self.context.style.shape.is_none();
        let span = match wide {
            true => spans::WIDEST,
            false => hipped.span(),
        };
        let look = Look::gable(None, self.context.style, span, self.context.unit);
        let mut form = hipped.form(base, &look);
        if wide {
            deck::end_at(&mut form, base + look.drop() + look.pitch * span / 2.0);
            out.push(say::deck(
                self.context.level.storey.span,
                self.context.level.storey.number,
            ));
        }
        Ok(self.context.of_form(form, RoofShape::Hip, look, base))
    }

    fn flat(&self, part: &Part) -> RoofDraft {
        let level = self.context.level;
        let base = level.storey.z1;
        let (look, thick) = self.context.flat_look(None);
        let mut solids = flat::slab(&part.outline, &part.courts, base, look.kind, thick);
        if !level.parapet && self.upper.is_none() {
            for border in std::iter::once(&part.outline).chain(&part.courts) {
                let border: flat::Border = border.iter().map(|p| (*p, true)).collect();
                solids.extend(flat::upstands(&border, base));
            }
        }
        self.context.flat_of(solids, look, base)
    }
}

/// Returns true if two storeys have the same corners, regardless of the starts of their walks.
fn same_plan(lower: &Level<'_>, upper: &Level<'_>) -> bool {
    let corners = |level: &Level<'_>| {
        let mut all: Vec<(i64, i64)> = level.plan.loops.iter().flatten().copied().collect();
        all.sort_unstable();
        all
    };
    let (p, q) = (corners(lower), corners(upper));
    // A tenth of a millimetre: placing walls spreads small errors over the corners.
    let near = |a: i64, b: i64| (a - b).abs() <= STEPS / 10_000;
    p.len() == q.len()
        && p.iter()
            .zip(&q)
            .all(|(p, q)| near(p.0, q.0) && near(p.1, q.1))
}
