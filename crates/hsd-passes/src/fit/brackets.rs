//! Bracket complexes on the posts of a storey, the beams between them, and the purlins they carry under the eaves.

use super::undersides::Undersides;
use super::{metres, outward, paint, posts_of, rings, stands};
use glam::DVec2;
use hsd_base::geometry::{SAME, SHAKU};
use hsd_ir::ast;
use hsd_ir::building::fittings::{Beam, Brackets, Head};
use hsd_ir::building::{House, Storey, Wall};

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
        zone.purlins(&ring.walls, &mut made);
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
        self.frieze(wall, made);
        self.beams(wall, [bend(before, wall), bend(wall, after)], made);
    }

    /// Adds the purlins outside the walls of a ring. Those of a round or many-sided body are one ring at the height of the
    /// lowest, as a square roof over it falls to the sides.
    fn purlins(&self, walls: &[Wall], made: &mut Brackets) {
        let n = walls.len();
        let turns: Vec<Turn> = (0..n)
            .map(|i| bend(&walls[i], &walls[(i + 1) % n]))
            .collect();
        let tops: Vec<f64> = walls.iter().map(|wall| self.top(wall)).collect();
        let lowest = tops.iter().copied().fold(f64::INFINITY, f64::min);
        for (i, wall) in walls.iter().enumerate() {
            let ends = [turns[(i + n - 1) % n], turns[i]];
            let top = match ends.iter().any(Turn::slants) {
                true => lowest,
                false => tops[i],
            };
            self.purlin(wall, ends, top, made);
        }
    }

    /// Returns the height under the roof over the purlin of a wall.
    fn top(&self, wall: &Wall) -> f64 {
        let middle = metres(self.house, (wall.from + wall.to) / 2.0);
        self.under(middle + outward(wall) * self.reach)
            .unwrap_or(self.z.1)
            - 0.01
    }

    /// Adds the purlin outside a wall.
    fn purlin(&self, wall: &Wall, turns: [Turn; 2], top: f64, made: &mut Brackets) {
        let deep = (self.post * 0.45).max(LEAST);
        // They cross at right corners, and meet at others.
        let beyond = turns.map(|t| self.reach * t.half() + deep * 1.6 * t.crossing());
        let out = outward(wall);
        let ends = [wall.from, wall.to].map(|p| metres(self.house, p) + out * self.reach);
        let along = (ends[1] - ends[0]).normalize_or_zero();
        made.beams.push(Beam {
            ends: [
                (ends[0] - along * beyond[0]).extend(top - deep),
                (ends[1] + along * beyond[1]).extend(top - deep),
            ],
            width: deep * 0.9,
            height: deep,
        });
        made.purlin = made.purlin.min(top - deep - self.z.0);
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

    /// Adds head tie beam and plate.
    fn beams(&self, wall: &Wall, turns: [Turn; 2], made: &mut Brackets) {
        let (from, to) = (metres(self.house, wall.from), metres(self.house, wall.to));
        let along = (to - from).normalize_or_zero();
        // Those along the front lie a little higher, so that crossing ones share no plane.
        let lift = 0.006 * wall.direction.x.abs();
        let noses = turns.map(|t| 0.9 * self.post * t.crossing());
        let mut beam = |foot: f64, width: f64, height: f64| {
            let at = |p: DVec2, by: f64| (p + along * by).extend(foot + lift);
            made.beams.push(Beam {
                ends: [at(from, -noses[0]), at(to, noses[1])],
                width,
                height,
            });
        };
        let tie = self.post * 0.8;
        beam(self.z.0 - tie, self.post * 0.6, tie - 0.01);
        beam(self.z.0 - 0.004, self.post * 1.1, self.post * 0.28);
    }

    /// Returns the lowest underside of a roof over a place, above the tops of the posts.
    fn under(&self, p: DVec2) -> Option<f64> {
        let (low, high) = (self.z.0, self.z.1 + self.reach + 1.0);
        self.undersides.lowest(p, low, high)
    }
}

/// The turn between two walls.
#[derive(Clone, Copy)]
struct Turn {
    /// Its sine; positive = convex.
    sin: f64,
    cos: f64,
}

impl Turn {
    /// Returns the tangent of half the turn: how far lines outside two walls reach past the corner, as a share of their distance.
    fn half(&self) -> f64 {
        match self.sin.abs() > 0.05 {
            true => self.sin / (1.0 + self.cos),
            false => 0.0,
        }
    }

    /// Returns how far beams cross at the corner as a share of a right corner's: only at outer ones.
    fn crossing(&self) -> f64 {
        match self.sin > 0.05 {
            true => self.sin * self.sin,
            false => 0.0,
        }
    }

    /// Returns true for a corner of a many-sided body.
    fn slants(&self) -> bool {
        (0.05..0.95).contains(&self.sin.abs())
    }
}

/// Returns the turn between two walls; none where they do not meet.
fn bend(before: &Wall, wall: &Wall) -> Turn {
    match before.to.distance(wall.from) < SAME {
        true => Turn {
            sin: before.direction.perp_dot(wall.direction),
            cos: before.direction.dot(wall.direction),
        },
        false => Turn { sin: 0.0, cos: 1.0 },
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
