//! The frame of a wall: posts at corners and borders, wall plates, sills, foundation stones.

use crate::mesh::smooth::soft_bar;
use crate::mesh::{Axis, Bodies, Soup};
use crate::part::bay::Layer;
use crate::store::look::Look;
use crate::store::{Key, tenths};
use crate::wall::{Line, PlacedUnit};
use crate::{Level, Walker};
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_base::geometry::tolerance::STRAIGHT;
use hsd_base::geometry::{SAME, SHAKU};
use hsd_ir::catalog::Stance;
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;
use hsd_scene::{Detail, Kind, NodeId};

/// Side of a post: 4 sun (docs/evidence.md 5), metres.
pub(crate) const POST: f64 = 0.1212;

/// Side of a through post: 4.5 sun, metres.
const THROUGH: f64 = 0.1364;

/// Height of the wall plate, metres.
pub(crate) const PLATE: f64 = 0.150;

/// Height of the sill, metres.
pub(crate) const SILL: f64 = 0.105;

/// The height that the wall plate takes from openings.
pub(crate) struct LintelRoom;

impl LintelRoom {
    /// Returns it for a storey of a height, metres; in low storeys a tenth of the height.
    pub(crate) fn of(height: f64) -> f64 {
        (PLATE + 0.010).min(height / 10.0)
    }
}

/// A horizontal member: name, surface, half its depth, foot and top above the floor (`top` below the storey's top if it
/// is attached there).
struct Beam {
    name: &'static str,
    finish: &'static str,
    half: f64,
    z: (f64, f64),
}

/// The members by their number in [`Key::Member`]. Each is slightly shallower than posts (60.6 mm) or deeper than what
/// it carries, so that no two faces are coplanar.
static MEMBERS: [Beam; 5] = [
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
        z: (-SILL, 0.0),
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
    Beam {
        name: "foundation",
        finish: "stone",
        half: 0.380,
        z: (-0.285, 0.0),
    },
];

/// Numbers of the members.
const PLATES: u8 = 0;
const SILLS: u8 = 1;
const STONES: u8 = 2;
const PLINTHS: u8 = 3;
const FOOTINGS: u8 = 4;

/// The stone under a post on the ground: half its side, foot and top, metres. Its planes are offset from those of the
/// foundation.
const PAD: (f64, f64, f64) = (0.130, -0.284, -0.112);

/// Half its side between open bays, where it lies in the curb.
const IN_CURB: f64 = 0.079;

impl Walker<'_> {
    /// Adds posts at the borders of the units of a wall, at its start, and at its end if no wall follows.
    pub(crate) fn posts(
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
        let shows = |s: Option<&PlacedUnit<'_>>| s.is_some_and(|s| s.stance == Stance::Posts);
        let catalog = self.catalog;
        let open = |s: Option<&PlacedUnit<'_>>| {
            s.is_none_or(|s| match &s.unit.content {
                Content::Part(id) => catalog.part(*id).is_passage(),
                _ => false,
            })
        };
        let last = before.and_then(|b| b.end(true));
        let set = line.has_post(false) || before.is_some_and(|b| b.has_post(true));
        if !set && (shows(last) || shows(line.end(false))) {
            let convex = before.is_some_and(|b| bend(b, line) > STRAIGHT);
            let side = if convex { THROUGH } else { POST };
            let height = height(last, line.end(false));
            let curb = open(last) && open(line.end(false));
            self.post(level, facade, 0.0, (0.0, height), side, curb);
        }
        let mut previous: Option<&PlacedUnit<'_>> = None;
        let mut set = false;
        for placed in &line.units {
            if placed.is_post() {
                set = true;
                continue;
            }
            let inner = placed.offset > SAME;
            // Flat parts have the halves of their posts in their pictures.
            let own = level.storey.order.posts.is_some();
            let drawn = (own || self.detail > Detail::Flat) && !set;
            if inner && drawn && (shows(previous) || shows(Some(placed))) {
                let height = height(previous, Some(placed));
                let curb = open(previous) && open(Some(placed));
                self.post(level, facade, -placed.offset, (0.0, height), POST, curb);
            }
            set = false;
            previous = Some(placed);
        }
        if after.is_none() && shows(line.end(true)) && !line.has_post(true) {
            let height = height(line.end(true), None);
            let curb = open(line.end(true));
            self.post(level, facade, -line.length, (0.0, height), POST, curb);
        }
    }

    /// Adds a post centred on the line; its stone lies in the curb of open bays beside it.
    pub(crate) fn post(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        x: f64,
        z: (f64, f64),
        side: f64,
        curb: bool,
    ) {
        let own = level.storey.order.posts.as_ref();
        let low = level.framed() && level.storey.number == 1 && z.0 == 0.0;
        let pad = low && (level.grounded() || own.is_some() && level.on_stone());
        let side = own.map_or(side, |p| p.size * SHAKU);
        let round = own.is_some_and(|p| p.round);
        let finish = SurfaceId::named(own.map_or("cedar", |p| p.paint.surface()));
        let key = [
            tenths(side),
            tenths(z.1 - z.0),
            u32::from(pad) + u32::from(pad && curb),
            u32::from(round),
            finish.index() as u32,
        ];
        self.store.weather = self.frame(z);
        let mesh = self.store.bodies(Key::Post(key), "post", || {
            let mut bodies = Bodies::default();
            let [side, height] = [key[0], key[1]].map(|n| f64::from(n) / 10_000.0);
            let half = side / 2.0;
            // Without a stone below it reaches a little lower than the walls beside it.
            let foot = if pad { 0.0 } else { -0.0008 };
            // A millimetre lower than the walls, which lie over it.
            let top = dvec3(half, half, height - 0.001);
            match round {
                true => {
                    let ring = soft_bar((-half, half), (-half, half), half, 4, true);
                    bodies.rounded(finish, &ring, Axis::Z, foot, height - 0.001);
                }
                false => bodies.block(finish, dvec3(-half, -half, foot), top),
            }
            if pad && own.is_some() {
                base_stone(&mut bodies, half);
            } else if pad {
                let (half, foot, top) = PAD;
                let half = if curb { IN_CURB } else { half };
                let (lo, hi) = (dvec3(-half, -half, foot), dvec3(half, half, top));
                bodies.block(SurfaceId::named("stone"), lo, hi);
            }
            bodies
        });
        let node = self.node(Some(facade), Kind::Post, "post".into(), dvec3(x, 0.0, z.0));
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }

    /// Adds wall plate, sill and foundation, one piece per run of equal units.
    pub(crate) fn members(
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
        let ends = [
            before.map_or(0, |b| half_turn(b, line)),
            after.map_or(0, |a| half_turn(line, a)),
        ];
        let full = |s: &PlacedUnit<'_>| s.tops.0 == level.height && s.tops.1 == level.height;
        let posts = |s: &PlacedUnit<'_>| s.stance == Stance::Posts;
        self.run(level, facade, line, PLATES, ends, |s| posts(s) && full(s));
        if !level.grounded() {
            return;
        }
        let deep = MEMBERS[usize::from(PLINTHS)].half;
        let heavy = |s: &PlacedUnit<'_>| {
            matches!(s.stance, Stance::Bare | Stance::Modern | Stance::Fence) && s.width > 0.0
        };
        self.run(level, facade, line, SILLS, ends, posts);
        self.run(level, facade, line, STONES, ends, posts);
        self.run(level, facade, line, PLINTHS, ends, |s| {
            heavy(s) && s.face < deep
        });
        // Earth walls are thicker than others.
        self.run(level, facade, line, FOOTINGS, ends, |s| {
            heavy(s) && s.face >= deep && s.stance == Stance::Fence
        });
    }

    /// Adds a member under or over each run of units that `wants` it, with these mitres at the wall's start and end.
    fn run(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        line: &Line<'_>,
        kind: u8,
        [start, end]: [i32; 2],
        wants: impl Fn(&PlacedUnit<'_>) -> bool,
    ) {
        let mut open: Option<f64> = None;
        let wide = line.units.iter().filter(|s| !s.is_post());
        for placed in wide.map(Some).chain([None]) {
            match (open, placed.is_some_and(&wants)) {
                (None, true) => open = placed.map(|s| s.offset),
                (Some(from), false) => {
                    let to = placed.map_or(line.length, |s| s.offset);
                    let first = if from < SAME { start } else { 0 };
                    let last = if placed.is_none() { end } else { 0 };
                    self.member(level, facade, kind, (from, to), [first, last]);
                    open = None;
                }
                _ => {}
            }
        }
    }

    /// Adds one member between two offsets along the wall.
    fn member(
        &mut self,
        level: Level<'_>,
        facade: NodeId,
        kind: u8,
        (from, to): (f64, f64),
        ends: [i32; 2],
    ) {
        let member = &MEMBERS[usize::from(kind)];
        // A stub shorter than its mitres would turn inside out.
        let ends = if to - from > 4.0 * member.half {
            ends
        } else {
            [0, 0]
        };
        let length = tenths(to - from);
        let top = if kind == PLATES { level.height } else { 0.0 };
        self.store.weather = self.frame((top, top + 0.1));
        let mesh = self
            .store
            .bodies(Key::Member(kind, length, ends), member.name, || {
                member.bodies(length, ends)
            });
        let at = dvec3(-from, 0.0, top);
        let node = self.node(Some(facade), Kind::Member, member.name.into(), at);
        node.mesh = Some(mesh);
        node.storey = Some(level.storey.number);
    }
}

/// Adds the stone under a post written in the source file: a slab with a round seat.
fn base_stone(bodies: &mut Bodies, half: f64) {
    let (seat, slab) = (half * 1.25, half * 1.7);
    let ring = soft_bar((-seat, seat), (-seat, seat), seat, 4, true);
    let stone = SurfaceId::named("stone");
    bodies.rounded(stone, &ring, Axis::Z, -0.02, 0.06);
    bodies.block(stone, dvec3(-slab, -slab, -0.15), dvec3(slab, slab, 0.02));
}

impl Beam {
    /// Builds a beam to the left of its right end, its length in tenths of a millimetre, its ends mitred.
    fn bodies(&self, length: u32, ends: [i32; 2]) -> Bodies {
        let length = f64::from(length) / 10_000.0;
        let [start, end] = ends.map(|n| self.half * f64::from(n) / 10_000.0);
        let outline = [
            dvec2(start, -self.half),
            dvec2(-start, self.half),
            dvec2(end - length, self.half),
            dvec2(-end - length, -self.half),
        ];
        let mut bodies = Bodies::default();
        let finish = SurfaceId::named(self.finish);
        bodies.prism(finish, &outline, Axis::Z, self.z.0, self.z.1);
        bodies
    }
}

/// Returns the sine of the turn between two walls; positive = convex.
fn bend(before: &Line<'_>, line: &Line<'_>) -> f64 {
    before.wall.direction.perp_dot(line.wall.direction)
}

/// Returns the mitre between two walls: the tangent of half the turn in ten-thousandths, positive at convex corners,
/// where outer edges get longer; none where walls turn back.
fn half_turn(before: &Line<'_>, line: &Line<'_>) -> i32 {
    let cos = before.wall.direction.dot(line.wall.direction);
    let tangent = bend(before, line) / (1.0 + cos).max(1e-6);
    if tangent.abs() < 1.5 {
        (tangent * 10_000.0).round() as i32
    } else {
        0
    }
}

/// Returns the height of a post between two units: that of the higher one.
fn height(a: Option<&PlacedUnit<'_>>, b: Option<&PlacedUnit<'_>>) -> f64 {
    let posts = |s: &&PlacedUnit<'_>| s.stance == Stance::Posts;
    let a = a.filter(posts).map_or(0.0, |s| s.tops.1);
    let b = b.filter(posts).map_or(0.0, |s| s.tops.0);
    a.max(b)
}

/// Builds a closed panel from x = 0 and z = 0 whose front shows an image from 0 to 1, and whose other sides are
/// neutral.
pub(crate) fn panel(
    width: f64,
    height: f64,
    layer: Layer,
    front: Look,
    neutral: Look,
) -> Vec<(Look, Soup)> {
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
    vec![(front, picture), (neutral, rest)]
}
