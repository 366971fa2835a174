//! An index of a storey's walls by line: gives the depth of the house behind an opening, and the surface of the gables
//! above.

use crate::roof::infill::{Faces, Flush, Infill};
use crate::wall::finish::{default_finish, finish_of};
use glam::DVec2;
use hsd_base::geometry::tolerance::SAME;
use hsd_ir::building::{House, Solid, Storey, Wall};
use hsd_ir::catalog::{Catalog, Stance};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;
use std::cell::OnceCell;

/// Clearance between the end of a passage and what is behind it, metres: half a wall and some air.
const CLEAR: f64 = 0.10;

/// Largest distance of a gable's fill from the line of its wall, metres.
const BESIDE: f64 = 0.08;

/// The walls of one storey that bound something and are parallel to an axis of the plan.
#[derive(Debug)]
pub(crate) struct WallIndex {
    /// Walls along b (first) and along a (second), sorted by line and start.
    walls: [Vec<Stretch>; 2],
    usual: OnceCell<SurfaceId>,
}

/// A wall on its line.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    /// In units of [`SAME`].
    line: i64,
    lo: f64,
    hi: f64,
    /// Its ring and its index there.
    at: (u32, u32),
}

/// A coordinate in units of [`SAME`].
fn line(u: f64) -> i64 {
    (u / SAME).round() as i64
}

impl WallIndex {
    /// Indexes the walls of a storey.
    pub(crate) fn of(storey: &Storey) -> WallIndex {
        let mut walls = [vec![], vec![]];
        for (r, ring) in storey.rings.iter().enumerate().filter(|(_, r)| r.closed) {
            for (w, wall) in ring.walls.iter().enumerate() {
                let along_a = wall.direction.y == 0.0;
                if along_a || wall.direction.x == 0.0 {
                    let (at, lo, hi) = place(wall, along_a);
                    walls[usize::from(along_a)].push(Stretch {
                        line: line(at),
                        lo,
                        hi,
                        at: (r as u32, w as u32),
                    });
                }
            }
        }
        for walls in &mut walls {
            walls.sort_by(|p, q| p.line.cmp(&q.line).then(p.lo.total_cmp(&q.lo)));
        }
        WallIndex {
            walls,
            usual: OnceCell::new(),
        }
    }

    /// Returns the walls on a range of lines that overlap an interval along them.
    fn across(&self, along_a: bool, (from, to): (i64, i64), (lo, hi): (f64, f64)) -> Vec<Stretch> {
        let walls = &self.walls[usize::from(along_a)];
        let mut found = vec![];
        let mut at = walls.partition_point(|w| w.line < from);
        while let Some(first) = walls.get(at).filter(|w| w.line <= to) {
            let end = at + walls[at..].partition_point(|w| w.line == first.line);
            // Walls on one line do not overlap, so they are sorted by their ends as well.
            let block = &walls[at..end];
            let start = block.partition_point(|w| w.hi <= lo);
            found.extend(block[start..].iter().take_while(|w| w.lo < hi));
            at = end;
        }
        found
    }

    /// Returns the depth of a passage through a wall, from one offset along it to another in U, so that it does not
    /// come out behind the house: metres, at most `most`.
    pub(crate) fn room(&self, wall: &Wall, offsets: (f64, f64), unit: f64, most: f64) -> f64 {
        let along_a = wall.direction.y == 0.0;
        if !along_a && wall.direction.x != 0.0 {
            return most;
        }
        let of = |u: f64| {
            let p = wall.from + wall.direction * u;
            if along_a { p.x } else { p.y }
        };
        let (p, q) = (of(offsets.0), of(offsets.1));
        let stretch = (p.min(q) + 0.01, p.max(q) - 0.01);
        let inward = wall.direction.perp();
        let (own, ahead) = match along_a {
            true => (wall.from.y, inward.y > 0.0),
            false => (wall.from.x, inward.x > 0.0),
        };
        let (own, reach) = (line(own), line((most + 1.0) / unit));
        let lines = match ahead {
            true => (own + 1, own + reach),
            false => (own - reach, own - 1),
        };
        let walls = self.across(along_a, lines, stretch).into_iter();
        let nearest = walls.map(|w| (w.line - own).abs()).min();
        nearest.map_or(most, |n| (n as f64 * SAME * unit - CLEAR).clamp(0.0, most))
    }

    /// Returns what a gable's fill takes from the wall under it: the most common finish there, and the faces that go with it.
    pub(crate) fn gable(&self, catalog: &Catalog, house: &House, at: Place<'_>) -> Infill {
        let unit = house.unit;
        let plan = at.solid.points.iter().map(|p| DVec2::new(-p.x, p.y) / unit);
        let (lo, hi) = plan.fold((DVec2::MAX, DVec2::MIN), |(l, h), p| (l.min(p), h.max(p)));
        let along_a = hi.x - lo.x > hi.y - lo.y;
        let (stretch, across) = match along_a {
            true => ((lo.x, hi.x), (lo.y + hi.y) / 2.0),
            false => ((lo.y, hi.y), (lo.x + hi.x) / 2.0),
        };
        let lines = (line(across - BESIDE / unit), line(across + BESIDE / unit));
        let below = self.across(along_a, lines, (stretch.0 + 0.1, stretch.1 - 0.1));
        let wall = |s: &Stretch| &at.storey.rings[s.at.0 as usize].walls[s.at.1 as usize];
        let mut shares = Shares::default();
        for found in &below {
            let whole = place(wall(found), along_a);
            shares.add(catalog, wall(found), |from, to| {
                // Offsets count from the wall's start, whichever way it runs.
                let forward = wall(found).direction.dot(DVec2::ONE) > 0.0;
                let (from, to) = match forward {
                    true => (whole.1 + from, whole.1 + to),
                    false => (whole.2 - to, whole.2 - from),
                };
                to.min(stretch.1) - from.max(stretch.0)
            });
        }
        if shares.0.is_empty() {
            below
                .iter()
                .for_each(|w| shares.add(catalog, wall(w), |from, to| to - from));
        }
        let Some(surface) = shares.most() else {
            return Infill::plain(*self.usual.get_or_init(|| usual(catalog, at.storey)));
        };
        let flush = below.first().zip(shares.faces(surface)).map(|(s, faces)| {
            let (from, out) = (wall(s).from * unit, -wall(s).direction.perp());
            let outward = DVec2::new(-out.x, out.y);
            let line = outward.dot(DVec2::new(-from.x, from.y));
            Flush {
                outward,
                line,
                faces,
            }
        });
        Infill { surface, flush }
    }
}

/// Returns true if most of a storey's walls are plastered over their posts, as in storehouses.
pub(crate) fn is_plastered(catalog: &Catalog, storey: &Storey) -> bool {
    let plaster = SurfaceId::named("plaster");
    let units = storey
        .rings
        .iter()
        .flat_map(|r| &r.walls)
        .flat_map(|w| &w.units);
    let (mut all, mut over) = (0.0, 0.0);
    for unit in units {
        if let Content::Part(id) = unit.content {
            let part = catalog.part(id);
            all += unit.width;
            if part.stance == Stance::Bare && part.finish == Some(plaster) {
                over += unit.width;
            }
        }
    }
    over > all / 2.0
}

/// A gable's fill and the storey under it.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) solid: &'a Solid,
    pub(crate) storey: &'a Storey,
}

/// Returns a wall's line, start and end.
fn place(wall: &Wall, along_a: bool) -> (f64, f64, f64) {
    let (p, q) = (wall.from, wall.to);
    match along_a {
        true => (p.y, p.x.min(q.x), p.x.max(q.x)),
        false => (p.x, p.y.min(q.y), p.y.max(q.y)),
    }
}

/// Returns the most common finish of a storey's walls.
fn usual(catalog: &Catalog, storey: &Storey) -> SurfaceId {
    let mut shares = Shares::default();
    let walls = || storey.rings.iter().flat_map(|r| &r.walls);
    walls().for_each(|w| shares.add(catalog, w, |from, to| to - from));
    shares.most().unwrap_or_else(|| {
        let first = walls().flat_map(|w| &w.units).next();
        first.map_or(SurfaceId::named("plaster"), |u| {
            default_finish(catalog, &u.content)
        })
    })
}

/// Lengths by finish and faces.
#[derive(Default)]
struct Shares(Vec<((SurfaceId, Option<Faces>), f64)>);

impl Shares {
    /// Adds the units of a wall with the length that `length` gives for their two offsets.
    fn add(&mut self, catalog: &Catalog, wall: &Wall, length: impl Fn(f64, f64) -> f64) {
        let mut offset = 0.0;
        for unit in &wall.units {
            let (from, to) = (offset, offset + unit.width);
            offset = to;
            let length = length(from, to);
            if length <= 0.0 {
                continue;
            }
            let Some(finish) = crown(catalog, &unit.content) else {
                continue;
            };
            let top = (finish, Faces::of(catalog, &unit.content));
            match self.0.iter_mut().find(|s| s.0 == top) {
                Some(share) => share.1 += length,
                None => self.0.push((top, length)),
            }
        }
    }

    /// Returns the most common finish.
    fn most(&self) -> Option<SurfaceId> {
        let mut finishes: Vec<(SurfaceId, f64)> = vec![];
        for ((finish, _), length) in &self.0 {
            match finishes.iter_mut().find(|f| f.0 == *finish) {
                Some(share) => share.1 += length,
                None => finishes.push((*finish, *length)),
            }
        }
        longest(finishes)
    }

    /// Returns the faces of most walls of a finish.
    fn faces(&self, of: SurfaceId) -> Option<Faces> {
        let faces = self.0.iter().filter(|((finish, _), _)| *finish == of);
        longest(faces.map(|((_, faces), length)| (*faces, *length))).flatten()
    }
}

/// Returns what has the greatest length, the first of equals.
fn longest<T>(shares: impl IntoIterator<Item = (T, f64)>) -> Option<T> {
    let longer = |best: (T, f64), share: (T, f64)| match share.1 > best.1 + SAME {
        true => share,
        false => best,
    };
    shares.into_iter().reduce(longer).map(|best| best.0)
}

/// Returns the finish of a wall part at its top.
fn crown(catalog: &Catalog, content: &Content) -> Option<SurfaceId> {
    match content {
        Content::Split(split) => {
            let halves = split.upper.iter().chain(&split.lower);
            halves.into_iter().find_map(|u| crown(catalog, &u.content))
        }
        content => finish_of(catalog, content),
    }
}
