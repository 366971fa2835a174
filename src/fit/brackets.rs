//! Bracket complexes on the posts of a storey, the beams between them, and the purlins they carry under the eaves.

use super::undersides::Undersides;
use super::{metres, outward, paint, posts_of, rings, stands};
use crate::ast;
use crate::building::fittings::{Beam, Brackets, Head};
use crate::building::{House, Storey, Wall};
use crate::geometry::{SAME, SHAKU};
use glam::DVec2;

/// Side of a post by default, metres.
const POST: f64 = 0.1212;

/// Smallest height of a purlin, metres.
const LEAST: f64 = 0.12;

/// The bracket zone of a storey.
struct Zone<'a> {
    house: &'a House,
    /// Heights of the tops of the posts and of the storey.
    z: (f64, f64),
    reach: f64,
    post: f64,
    undersides: &'a Undersides,
}

/// Returns the brackets of a storey.
pub(super) fn brackets(
    house: &House,
    storey: &Storey,
    written: &ast::Brackets,
    undersides: &Undersides,
) -> Brackets {
    let posts = storey.order.posts.as_ref();
    let height = storey.z1 - storey.z0 - storey.wall_height();
    let zone = Zone {
        house,
        z: (storey.z1 - height, storey.z1),
        reach: written.reach() * SHAKU,
        post: posts.map_or(POST, |p| p.size * SHAKU),
        undersides,
    };
    let mut made = Brackets {
        heads: vec![],
        struts: vec![],
        beams: vec![],
        frieze: vec![],
        steps: written.steps,
        height,
        reach: zone.reach,
        purlin: f64::INFINITY,
        post: zone.post,
        bay: f64::INFINITY,
        paint: paint(written.paint.or(posts.map(|p| p.paint))),
    };
    for ring in rings(storey) {
        let n = ring.walls.len();
        for (i, wall) in ring.walls.iter().enumerate() {
            let (before, after) = (&ring.walls[(i + n - 1) % n], &ring.walls[(i + 1) % n]);
            zone.wall(&[before, wall, after], &mut made);
        }
    }
    // The height left for the steps, however low the purlin lies.
    let room = height - LEAST;
    made.purlin = made.purlin.min(room).max(room * 0.3).max(0.1);
    made
}

impl Zone<'_> {
    /// Adds everything over a wall, given its neighbours.
    fn wall(&self, walls: &[&Wall; 3], made: &mut Brackets) {
        let [before, wall, after] = *walls;
        let out = outward(wall);
        let at = |u: f64| metres(self.house, wall.from + wall.direction * u);
        let posts = posts_of(wall);
        for (k, u) in posts.iter().enumerate() {
            // The last post is the next wall's first.
            if k + 1 == posts.len() {
                continue;
            }
            let corner = (k == 0).then(|| outward(before));
            made.heads.push(Head {
                at: at(*u).extend(self.z.0),
                out,
                corner: corner.filter(|c| c.perp_dot(out).abs() > 0.05),
            });
        }
        for pair in posts.windows(2) {
            made.bay = made.bay.min((pair[1] - pair[0]) * self.house.unit);
            if bay_stands(wall, (pair[0] + pair[1]) / 2.0) {
                made.struts.push(Head {
                    at: at((pair[0] + pair[1]) / 2.0).extend(self.z.0),
                    out,
                    corner: None,
                });
            }
        }
        let turns = [bend(before, wall), bend(wall, after)];
        self.frieze(wall, made);
        self.beams(wall, turns, made);
    }

    /// Adds the wall between the tops of the posts and the storey's.
    fn frieze(&self, wall: &Wall, made: &mut Brackets) {
        // Its foot lies between the tie beam and the plate.
        let at = |p: DVec2| metres(self.house, p).extend(self.z.0 - 0.007);
        made.frieze.push(Beam {
            ends: [at(wall.from), at(wall.to)],
            width: 0.09,
            height: self.z.1 - self.z.0 + 0.027,
        });
    }

    /// Adds head tie beam, plate and purlin.
    fn beams(&self, wall: &Wall, turns: [f64; 2], made: &mut Brackets) {
        let (from, to) = (metres(self.house, wall.from), metres(self.house, wall.to));
        let (along, out) = ((to - from).normalize_or_zero(), outward(wall));
        // Those along the front lie a little higher, so that crossing ones share no plane.
        let lift = 0.006 * wall.direction.x.abs();
        let mut beam = |off: f64, ends: [f64; 2], foot: f64, width: f64, height: f64| {
            let at = |p: DVec2, by: f64| (p + along * by + out * off).extend(foot + lift);
            made.beams.push(Beam {
                ends: [at(from, -ends[0]), at(to, ends[1])],
                width,
                height,
            });
        };
        let convex = |turn: f64, by: f64| if turn > 0.05 { by } else { 0.0 };
        let noses = turns.map(|t| convex(t, 0.9 * self.post));
        let tie = self.post * 0.8;
        beam(0.0, noses, self.z.0 - tie, self.post * 0.6, tie - 0.01);
        let flat = self.post * 0.28;
        beam(0.0, noses, self.z.0 - 0.004, self.post * 1.1, flat);
        let reach = self.reach;
        let middle = (from + to) / 2.0 + out * reach;
        let top = self.under(middle).unwrap_or(self.z.1) - 0.01;
        let deep = (self.post * 0.45).max(LEAST);
        let ends = turns.map(|t| match t {
            t if t > 0.05 => reach + deep * 1.6,
            t if t < -0.05 => -reach,
            _ => 0.0,
        });
        beam(reach, ends, top - deep - lift, deep * 0.9, deep);
        made.purlin = made.purlin.min(top - deep - self.z.0);
    }

    /// Returns the lowest underside of a roof over a place, above the tops of the posts.
    fn under(&self, p: DVec2) -> Option<f64> {
        let (low, high) = (self.z.0, self.z.1 + self.reach + 1.0);
        self.undersides.lowest(p, low, high)
    }
}

/// Returns the sine of the turn between two walls; positive = convex.
fn bend(before: &Wall, wall: &Wall) -> f64 {
    match before.to.distance(wall.from) < SAME {
        true => before.direction.perp_dot(wall.direction),
        false => 0.0,
    }
}

/// Returns true if the bay at this place holds a part.
fn bay_stands(wall: &Wall, at: f64) -> bool {
    let mut end = 0.0;
    let bay = wall.units.iter().find(|u| {
        end += u.width;
        end > at
    });
    bay.is_some_and(|u| stands(&u.content))
}
