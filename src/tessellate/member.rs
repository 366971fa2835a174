//! What carries the wall: posts at corners and borders, wall plates, sills, foundation stones.

use super::bay::Layer;
use super::facade::{Line, Stand};
use super::mesh::{Bodies, Soup};
use super::store::{Key, Share, primitive, tenths};
use super::{Level, Walker};
use crate::catalog::Stance;
use crate::geometry::SAME;
use crate::material::SurfaceId;
use crate::scene::{Kind, MaterialId, NodeId, Primitive};
use glam::{DVec2, DVec3, dvec2, dvec3};

/// Side of a post: four sun (domain.md 5).
pub(super) const POST: f64 = 0.1212;

/// Side of a through post: four and a half sun.
const THROUGH: f64 = 0.1364;

/// Height of the wall plate.
const PLATE: f64 = 0.150;

/// What the wall plate takes from the height of openings.
pub(super) struct LintelRoom;

impl LintelRoom {
    /// In a storey so high; low ones lose a tenth.
    pub(super) fn of(height: f64) -> f64 {
        (PLATE + 0.010).min(height / 10.0)
    }
}

/// A level member: name, surface, half its depth, foot and top above the floor (`top` below the
/// storey's top where it hangs there).
struct Beam {
    name: &'static str,
    finish: &'static str,
    half: f64,
    z: (f64, f64),
}

/// The members by their number in [`Key::Member`]. Each is a little shallower than posts (60.6 mm) or
/// deeper than what stands on it, so that no two faces lie in one plane.
const MEMBERS: [Beam; 4] = [
    Beam {
        name: "wall plate",
        finish: "cedar",
        half: 0.0555,
        z: (-PLATE, -0.002),
    },
    Beam {
        name: "sill",
        finish: "cedar",
        half: 0.0565,
        z: (-0.105, 0.0),
    },
    Beam {
        name: "foundation",
        finish: "stone",
        half: 0.075,
        z: (-0.285, -0.105),
    },
    Beam {
        name: "foundation",
        finish: "stone",
        half: 0.118,
        z: (-0.285, 0.0),
    },
];

/// Corners that bend less than this, in the sine of the turn, need no member of their own.
const STRAIGHT: f64 = 1e-6;

impl Walker<'_> {
    /// Posts at the borders of the units of a wall, at its start, and at its end if nothing follows.
    pub(super) fn posts(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        line: &Line<'_>,
        before: Option<&Line<'_>>,
        after: Option<&Line<'_>>,
    ) {
        if !level.framed() {
            return;
        }
        let shows = |s: Option<&Stand<'_>>| s.is_some_and(|s| s.stance == Stance::Posts);
        let last = before.and_then(|b| b.end(true));
        let set = line.has_post(false) || before.is_some_and(|b| b.has_post(true));
        if !set && (shows(last) || shows(line.end(false))) {
            let convex = before.is_some_and(|b| bend(b, line) > STRAIGHT);
            let side = if convex { THROUGH } else { POST };
            let height = height(last, line.end(false));
            self.post(level, facade, 0.0, (0.0, height), side);
        }
        let mut previous: Option<&Stand<'_>> = None;
        let mut set = false;
        for stand in &line.stands {
            if stand.is_post() {
                set = true;
                continue;
            }
            let inner = stand.offset > SAME;
            if inner && !set && (shows(previous) || shows(Some(stand))) {
                let height = height(previous, Some(stand));
                self.post(level, facade, -stand.offset, (0.0, height), POST);
            }
            set = false;
            previous = Some(stand);
        }
        if after.is_none() && shows(line.end(true)) && !line.has_post(true) {
            let height = height(line.end(true), None);
            self.post(level, facade, -line.length, (0.0, height), POST);
        }
    }

    /// A post with its middle on the line.
    pub(super) fn post(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        x: f64,
        z: (f64, f64),
        side: f64,
    ) {
        let key = [tenths(side), tenths(z.1 - z.0)];
        let mesh = self.store.mesh(Key::Post(key), |store| {
            let mut bodies = Bodies::default();
            let [side, height] = key.map(|n| f64::from(n) / 10_000.0);
            let half = side / 2.0;
            // A millimetre lower than the walls, which lie over it.
            let top = dvec3(half, half, height - 0.001);
            bodies.block(SurfaceId::named("cedar"), dvec3(-half, -half, 0.0), top);
            store.finish("post".into(), bodies, Share::default())
        });
        let node = self.node(Some(facade), Kind::Post, "post".into(), dvec3(x, 0.0, z.0));
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }

    /// Wall plate, sill and foundation, a piece each run of like units.
    pub(super) fn members(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        line: &Line<'_>,
        before: Option<&Line<'_>>,
        after: Option<&Line<'_>>,
    ) {
        if !level.framed() {
            return;
        }
        let full = |s: &Stand<'_>| s.tops.0 == level.height && s.tops.1 == level.height;
        let posts = |s: &Stand<'_>| s.stance == Stance::Posts;
        self.run(level, facade, line, 0, (0.0, 0.0), |s| posts(s) && full(s));
        if !level.grounded() {
            return;
        }
        let start = before.map_or(0.0, |b| bend_share(b, line));
        let end = after.map_or(0.0, |a| bend_share(line, a));
        let heavy = |s: &Stand<'_>| matches!(s.stance, Stance::Bare | Stance::Modern);
        self.run(level, facade, line, 1, (start, end), posts);
        self.run(level, facade, line, 2, (start, end), posts);
        self.run(level, facade, line, 3, (start, end), |s| {
            heavy(s) && s.face < 0.118
        });
    }

    /// A member under or over each run of units that `wants` it. At convex corners the wall that starts
    /// there takes the corner (`start`) and the one that ends there leaves it (`end`), as shares of half
    /// the member's depth.
    fn run(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        line: &Line<'_>,
        kind: usize,
        (start, end): (f64, f64),
        wants: impl Fn(&Stand<'_>) -> bool,
    ) {
        let half = MEMBERS[kind].half;
        let mut open: Option<f64> = None;
        let last = line.length;
        for i in 0..=line.stands.len() {
            let stand = line.stands.get(i);
            if stand.is_some_and(|s| s.is_post()) {
                continue;
            }
            match (open, stand.is_some_and(&wants)) {
                (None, true) => open = stand.map(|s| s.offset),
                (Some(from), false) => {
                    let to = stand.map_or(last, |s| s.offset);
                    let from = if from < SAME {
                        from - half * start
                    } else {
                        from
                    };
                    let to = if to > last - SAME {
                        to - half * end
                    } else {
                        to
                    };
                    self.member(level, facade, kind, from, to);
                    open = None;
                }
                _ => {}
            }
        }
    }

    /// One member between two offsets along the wall.
    fn member(&mut self, level: Level<'_>, facade: NodeId, kind: usize, from: f64, to: f64) {
        let member = &MEMBERS[kind];
        if to - from < 0.01 {
            return;
        }
        let length = tenths(to - from);
        let mesh = self.store.mesh(Key::Member(kind as u8, length), |store| {
            let mut bodies = Bodies::default();
            let x = f64::from(length) / 10_000.0;
            let (lo, hi) = (
                dvec3(-x, -member.half, member.z.0),
                dvec3(0.0, member.half, member.z.1),
            );
            bodies.block(SurfaceId::named(member.finish), lo, hi);
            store.finish(member.name.into(), bodies, Share::default())
        });
        let z = if kind == 0 { level.height } else { 0.0 };
        let node = self.node(
            Some(facade),
            Kind::Member,
            member.name.into(),
            dvec3(-from, 0.0, z),
        );
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }
}

/// Sine of the turn between two walls; positive = convex.
fn bend(before: &Line<'_>, line: &Line<'_>) -> f64 {
    before.wall.direction.perp_dot(line.wall.direction)
}

/// How much of its half depth a member reaches round a convex corner: the tangent of half the turn, at
/// most 1.
fn bend_share(before: &Line<'_>, line: &Line<'_>) -> f64 {
    let (sin, cos) = (
        bend(before, line),
        before.wall.direction.dot(line.wall.direction),
    );
    if sin <= STRAIGHT {
        return 0.0;
    }
    (sin / (1.0 + cos).max(1e-6)).min(1.0)
}

/// How high a post between two units is: as high as the higher one.
fn height(a: Option<&Stand<'_>>, b: Option<&Stand<'_>>) -> f64 {
    let posts = |s: &&Stand<'_>| s.stance == Stance::Posts;
    let a = a.filter(posts).map_or(0.0, |s| s.tops.1);
    let b = b.filter(posts).map_or(0.0, |s| s.tops.0);
    a.max(b)
}

/// A closed panel from x = 0 and z = 0 whose front shows a picture from 0 to 1, and whose other sides
/// are neutral.
pub(super) fn panel(
    width: f64,
    height: f64,
    layer: Layer,
    front: MaterialId,
    neutral: MaterialId,
) -> Vec<Primitive> {
    let (y0, y1) = (-layer.front, layer.thick - layer.front);
    let at = |x: f64, y: f64, z: f64| dvec3(x * width, y, z * height);
    let ring: [DVec2; 4] = [
        dvec2(0.0, 0.0),
        dvec2(1.0, 0.0),
        dvec2(1.0, 1.0),
        dvec2(0.0, 1.0),
    ];
    let mut picture = Soup::default();
    picture.face(&ring.map(|p| at(p.x, y0, p.y)), false);
    picture.uvs = ring.map(|p| p.as_vec2().to_array()).to_vec();
    let mut rest = Soup::default();
    let back: [DVec3; 4] = [3, 2, 1, 0].map(|i: usize| at(ring[i].x, y1, ring[i].y));
    rest.face(&back, false);
    for i in 0..4 {
        let (p, q) = (ring[i], ring[(i + 1) % 4]);
        // From the back to the front: the front's edge runs the other way round here.
        let side = [
            at(q.x, y0, q.y),
            at(p.x, y0, p.y),
            at(p.x, y1, p.y),
            at(q.x, y1, q.y),
        ];
        rest.face(&side, false);
    }
    vec![primitive(front, picture), primitive(neutral, rest)]
}
