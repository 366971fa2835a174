//! Parts of the upper surface of roofs that meet, with their filling: convex in plan, between a plane above
//! and a plane below. No two of them share any space.

use crate::facet::{
    Convex, Corner, HalfPlane, Higher, area, edges, is_outside, sides_of, split_off,
};
use crate::frame::Plane;
use crate::solid::INFILL_THICKNESS;
use crate::solid::massive::union::{Column, Side};
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::HEIGHT;
use hsd_ir::ast::RoofKind;
use hsd_ir::building::{Attic, Finish, Solid, Verge};

/// Parts with less area are left out, square metres.
const SLIVER: f64 = 2e-6;
/// Parts that share less than this in plan count as disjoint, square metres.
const HARDLY: f64 = 1e-7;
/// A part of the surface of one roof.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) outline: Convex,
    pub(super) top: Plane,
    /// Vertical thickness of the covering and its structure, metres; 0 for a wall.
    pub(super) drop: f64,
    /// The covering; none of a wall.
    pub(super) kind: Option<RoofKind>,
    /// Its lower end, at or under its own lower surface.
    pub(super) bottom: Plane,
}

impl Part {
    /// Creates a slab with nothing under it.
    pub(super) fn sheet(outline: Convex, top: Plane, drop: f64, kind: RoofKind) -> Part {
        Part {
            outline,
            top,
            drop,
            kind: Some(kind),
            bottom: top.raised(-drop),
        }
    }

    /// Adds a wall that any vertical line crosses once.
    pub(super) fn wall(solid: &Solid, parts: &mut Vec<Part>) {
        let (mut up, mut down) = (vec![], vec![]);
        for face in &solid.faces {
            let points = face.corners.iter().map(|c| solid.points[*c as usize]);
            let Some(plane) = Plane::around(points.clone()) else {
                continue;
            };
            let corner = |p: DVec3| Corner {
                at: p.truncate(),
                rim: false,
            };
            let mut outline: Convex = points.map(corner).collect();
            match area(&outline) {
                size if size > SLIVER => up.push((outline, plane)),
                size if size < -SLIVER => {
                    outline.reverse();
                    down.push((sides_of(&outline), plane));
                }
                _ => {}
            }
        }
        for (outline, top) in &up {
            for (sides, bottom) in &down {
                parts.extend(split(outline, sides, &mut vec![]).map(|outline| Part {
                    outline,
                    top: *top,
                    drop: 0.0,
                    kind: None,
                    bottom: *bottom,
                }));
            }
        }
    }

    fn with(&self, outline: Convex, bottom: Plane) -> Part {
        Part {
            outline,
            bottom,
            ..self.clone()
        }
    }

    /// Returns its parts over an attic, filled down to a plate, and beyond gable walls.
    pub(super) fn filled(mut self, attic: &Attic, plate: f64, parts: &mut Vec<Part>) {
        if let Some((_, by)) = attic.lowered.iter().find(|(v, _)| self.lies_in(v)) {
            self.top = self.top.raised(*by);
            self.bottom = self.bottom.raised(*by);
        }
        let mut pieces = vec![self.outline.clone()];
        for verge in attic.verges.iter().filter(|v| self.lies_in(v)) {
            let plan: Vec<DVec2> = verge.iter().map(|p| p.truncate()).collect();
            let sides = edges(&plan);
            let Some(line) = HalfPlane::left_of(plan[1], plan[0]) else {
                continue;
            };
            let mut left = vec![];
            for piece in pieces {
                let Some(inside) = split(&piece, &sides, &mut left) else {
                    left.push(piece);
                    continue;
                };
                // The wall is equally thick everywhere.
                let [wall, free] = line.moved_out(INFILL_THICKNESS / 2.0).halves(&inside);
                left.push(wall);
                if area(&free) > SLIVER {
                    parts.push(self.with(free, self.bottom));
                }
            }
            pieces = left;
        }
        for piece in pieces {
            self.down_to(piece, Plane::level(plate), parts);
        }
    }

    /// Returns true if it lies in the plane of a part of the surface.
    fn lies_in(&self, part: &Verge) -> bool {
        let off = |p: &DVec3| (self.top.at(p.truncate()) - p.z).abs();
        part.iter().all(|p| off(p) < HEIGHT)
    }

    /// Returns a piece of it, filled down to a plane where it is higher.
    fn down_to(&self, piece: Convex, plane: Plane, parts: &mut Vec<Part>) {
        let [over, under] = match HalfPlane::where_higher(self.bottom, plane) {
            Higher::Everywhere => [piece, Convex::new()],
            Higher::Nowhere => [Convex::new(), piece],
            Higher::Inside(side) => side.halves(&piece),
        };
        for (half, bottom) in [(over, plane), (under, self.bottom)] {
            if area(&half) > SLIVER {
                parts.push(self.with(half, bottom));
            }
        }
    }

    /// Returns the union of two parts that share space: their remainders, and the shared space once under the higher
    /// one. None if they share none.
    pub(super) fn together(&self, other: &Part) -> Option<Vec<Part>> {
        let common = self.common(other)?;
        let sides = sides_of(&common);
        let mut parts = vec![];
        for part in [self, other] {
            let mut off = vec![];
            split(&part.outline, &sides, &mut off);
            parts.extend(off.into_iter().map(|o| part.with(o, part.bottom)));
        }
        for (high, low) in [(self, other), (other, self)] {
            // The first counts as the higher one if they are level.
            let tops = match HalfPlane::where_higher(high.top, low.top) {
                Higher::Nowhere
                    if std::ptr::eq(high, other) || is_lower(high.top, low.top, &common) =>
                {
                    continue;
                }
                Higher::Inside(side) => Some(side),
                Higher::Nowhere | Higher::Everywhere => None,
            };
            let inside: Vec<HalfPlane> = sides.iter().copied().chain(tops).collect();
            if let Some(own) = split(&high.outline, &inside, &mut vec![]) {
                high.with(own.clone(), high.bottom)
                    .down_to(own, low.bottom, &mut parts);
            }
        }
        Some(parts)
    }

    /// Returns the plan outline of the space that two parts share.
    fn common(&self, other: &Part) -> Option<Convex> {
        let mut sides = sides_of(&other.outline);
        if is_outside(&self.outline, sides.iter()) {
            return None;
        }
        for (upper, lower) in [(self.top, other.bottom), (other.top, self.bottom)] {
            match HalfPlane::where_not_lower(upper, lower) {
                Higher::Nowhere => return None,
                Higher::Everywhere => {}
                Higher::Inside(side) => sides.push(side),
            }
        }
        split(&self.outline, &sides, &mut vec![])
    }

    /// Returns its columns: the slab, and the filling under it.
    pub(super) fn columns(&self) -> impl Iterator<Item = Column> {
        let low = self.top.raised(-self.drop);
        let gap = |c: &Corner| low.at(c.at) - self.bottom.at(c.at);
        let deep = self.outline.iter().map(gap).fold(f64::MIN, f64::max) > HEIGHT;
        let finishes = self
            .kind
            .map(|kind| [Finish::Edge(kind), Finish::Covering(kind)]);
        let ring = |of: &dyn Fn(&Corner) -> Finish| -> Vec<Side> {
            let side = |c: &Corner| Side {
                at: c.at,
                finish: of(c),
            };
            self.outline.iter().map(side).collect()
        };
        let sheet = finishes.map(|[edge, covering]| Column {
            ring: ring(&|c| if c.rim { edge } else { Finish::Plaster }),
            top: self.top,
            bottom: low,
            lid: Some(covering),
            floor: (!deep).then_some(Finish::Soffit),
        });
        let wall = sheet.is_none();
        let filling = deep.then(|| Column {
            ring: ring(&|_| Finish::Gable),
            top: low,
            bottom: self.bottom,
            lid: wall.then_some(Finish::Gable),
            floor: Some(if wall { Finish::Gable } else { Finish::Soffit }),
        });
        sheet.into_iter().chain(filling)
    }
}

/// Returns true if a plane lies below another over a piece, by the sum of height differences at its corners.
fn is_lower(plane: Plane, other: Plane, piece: &[Corner]) -> bool {
    let off = |c: &Corner| plane.at(c.at) - other.at(c.at);
    piece.iter().map(off).sum::<f64>() < -HEIGHT
}

/// Returns parts that share no space and fill the same volume together; `None` if that takes too long.
pub(super) fn settle(mut todo: Vec<Part>) -> Option<Vec<Part>> {
    let mut patience = 20 * todo.len() + 1000;
    let mut done: Vec<(Part, [DVec2; 2])> = Vec::with_capacity(todo.len());
    while let Some(part) = todo.pop() {
        if area(&part.outline) < SLIVER {
            continue;
        }
        let own = around(&part.outline);
        let near = |b: &[DVec2; 2]| own[0].cmplt(b[1]).all() && b[0].cmplt(own[1]).all();
        let mut others = done.iter().enumerate().filter(|(_, (_, b))| near(b));
        let met = others.find_map(|(n, (other, _))| Some((n, part.together(other)?)));
        match met {
            None => done.push((part, own)),
            Some((n, parts)) => {
                done.swap_remove(n);
                todo.extend(parts);
                patience = patience.checked_sub(1)?;
            }
        }
    }
    Some(done.into_iter().map(|d| d.0).collect())
}

fn around(outline: &[Corner]) -> [DVec2; 2] {
    let none = [DVec2::MAX, DVec2::MIN];
    let grow = |[lo, hi]: [DVec2; 2], c: &Corner| [lo.min(c.at), hi.max(c.at)];
    outline.iter().fold(none, grow)
}

/// Returns the part of a piece inside some sides; the rest goes to `off`. `None`, and no rest, if that part is a
/// sliver.
fn split(piece: &[Corner], sides: &[HalfPlane], off: &mut Vec<Convex>) -> Option<Convex> {
    if is_outside(piece, sides.iter()) {
        return None;
    }
    let before = off.len();
    let inside = split_off(Convex::from_slice(piece), sides.iter(), off);
    let inside = inside.filter(|i| area(i) > HARDLY);
    if inside.is_none() {
        off.truncate(before);
    }
    inside
}
