//! Bracket complexes (組物 kumimono): on each post a bearing block (大斗 daito), then arms (肘木 hijiki) with small blocks (斗
//! masu) that step out once per level, until the last carries the purlin. With three steps a tail rafter (尾垂木 odaruki)
//! bears down on it. At detail 1, a stepped corbel; at detail 0, a sloping one in one mesh with the beams.
//!
//! Frame of a complex: x along the wall, y into the house, z up from the top of the post.

use super::beam;
use crate::mesh::Bodies;
use crate::store::tenths;
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::building::fittings::{Brackets, Head};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
use std::f64::consts::FRAC_1_SQRT_2;

/// The form of a complex on a post.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Form {
    /// On a straight wall.
    Straight,
    /// At a corner: the outward direction of the other wall, in the frame of the complex, in thousandths.
    Corner([i32; 2]),
    /// Between posts: a strut with one block.
    Strut,
}

impl Form {
    /// The form for the head of a post.
    pub(super) fn of(head: &Head) -> Form {
        match head.corner {
            None => Form::Straight,
            Some(other) => {
                // x = to the right seen from outside, y = into the house.
                let right = dvec2(-head.out.y, head.out.x);
                let local = dvec2(other.dot(right), -other.dot(head.out)) * 1000.0;
                Form::Corner([local.x.round() as i32, local.y.round() as i32])
            }
        }
    }
}

/// The key of a complex's mesh: everything it depends on; lengths in tenths of a millimetre.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    form: Form,
    steps: u32,
    lengths: [u32; 5],
    paint: SurfaceId,
}

impl Key {
    pub(super) fn new(it: &Brackets, form: Form) -> Key {
        Key {
            form,
            steps: it.steps,
            lengths: [it.height, it.reach, it.purlin, it.post, it.bay].map(tenths),
            paint: it.paint,
        }
    }
}

/// Builds the beams along the walls; at detail 0 also a simple body in place of each complex.
pub(super) fn beams(it: &Brackets, detail: Detail) -> Bodies {
    let mut bodies = Bodies::default();
    for wall in &it.frieze {
        beam(&mut bodies, SurfaceId::named("plaster"), wall);
    }
    it.beams.iter().for_each(|b| beam(&mut bodies, it.paint, b));
    if detail == Detail::Body {
        it.heads
            .iter()
            .for_each(|head| slope(&mut bodies, it, head));
        let top = ComplexBuilder::new(it, detail).heights(0).1;
        for strut in &it.struts {
            let z = strut.at.z;
            let heights = (z + it.post * 0.28, z + top);
            let at = (strut.at.truncate(), strut.out);
            super::block(
                &mut bodies,
                it.paint,
                at,
                (-0.06, 0.07),
                it.post * 0.42,
                heights,
            );
        }
    }
    bodies
}

/// Adds a body that leans out as far as the arms of a complex would.
fn slope(bodies: &mut Bodies, it: &Brackets, head: &Head) {
    // At a corner both walls' arms meet on the diagonal.
    let out = head.out + head.corner.unwrap_or(DVec2::ZERO);
    let along = dvec2(-out.y, out.x).normalize_or_zero();
    let across = along * (it.post * (0.7 + 0.18 * f64::from(it.steps)));
    let at = |by: f64, z: f64| (head.at.truncate() + out * by - across).extend(head.at.z + z);
    let (near, far) = (it.post * 0.4, it.reach + it.post * 0.4);
    let ring = [
        at(-near, 0.001),
        at(near, 0.001),
        at(far, it.purlin),
        at(-near, it.purlin),
    ];
    bodies.slide(it.paint, &ring, (across * 2.0).extend(0.0), false);
}

/// Builds one complex.
pub(super) fn head(it: &Brackets, form: Form, detail: Detail) -> Bodies {
    let mut carver = ComplexBuilder::new(it, detail);
    match form {
        Form::Strut => carver.strut(),
        Form::Straight if detail < Detail::Openings => carver.corbel(DVec2::NEG_Y, 1.0),
        Form::Corner(_) if detail < Detail::Openings => carver.corbel(DVec2::NEG_Y, 1.0),
        Form::Straight => carver.complex(&[DVec2::NEG_Y], None),
        Form::Corner([x, y]) => {
            let other = dvec2(f64::from(x), f64::from(y)).normalize_or(DVec2::X);
            let between = (DVec2::NEG_Y + other).normalize_or(DVec2::NEG_Y);
            carver.complex(&[DVec2::NEG_Y, other], Some(between));
        }
    }
    carver.bodies
}

/// Builds the members of one complex.
struct ComplexBuilder<'a> {
    bodies: Bodies,
    it: &'a Brackets,
    /// Height from one arm to the next above it, metres.
    level: f64,
    /// Width of arms, metres.
    thick: f64,
    detail: Detail,
}

impl<'a> ComplexBuilder<'a> {
    fn new(it: &'a Brackets, detail: Detail) -> ComplexBuilder<'a> {
        ComplexBuilder {
            bodies: Bodies::default(),
            it,
            level: it.purlin / f64::from(it.steps + 1),
            thick: (it.post * 0.36).max(0.115),
            detail,
        }
    }

    /// Adds a block centred on a point, its lower part tapered (斗繰り).
    fn block(&mut self, at: DVec2, way: DVec2, width: f64, (foot, top): (f64, f64)) {
        let side = dvec2(-way.y, way.x);
        let half = width / 2.0;
        let ring = |half: f64, z: f64| {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(u, v)| (at + way * (half * u) + side * (half * v)).extend(z))
        };
        let waist = foot + (top - foot) * 0.42;
        let rings = [ring(half * 0.7, foot), ring(half, waist), ring(half, top)];
        let paint = self.it.paint;
        for pair in rings.windows(2) {
            for i in 0..4 {
                let j = (i + 1) % 4;
                let face = [pair[0][i], pair[0][j], pair[1][j], pair[1][i]];
                self.bodies.face(paint, &face);
            }
        }
        self.bodies.face(paint, &rings[2]);
        let mut foot = rings[0];
        foot.reverse();
        self.bodies.face(paint, &foot);
    }

    /// Adds an arm between two points of its centre line, its lower ends cut to a curve.
    fn arm(&mut self, from: DVec2, to: DVec2, (foot, top): (f64, f64), cut: [bool; 2]) {
        let way = (to - from).normalize_or_zero();
        let length = from.distance(to);
        let side = dvec2(-way.y, way.x) * (self.thick / 2.0);
        let deep = top - foot;
        let bow = (deep * 1.1).min(length * 0.3);
        let at = |u: f64, z: f64| (from + way * u - side).extend(z);
        let mut ring = vec![at(0.0, top)];
        if cut[0] {
            ring.extend([
                at(0.0, foot + deep * 0.55),
                at(bow * 0.35, foot + deep * 0.18),
                at(bow, foot),
            ]);
        } else {
            ring.push(at(0.0, foot));
        }
        if cut[1] {
            ring.extend([
                at(length - bow, foot),
                at(length - bow * 0.35, foot + deep * 0.18),
                at(length, foot + deep * 0.55),
            ]);
        } else {
            ring.push(at(length, foot));
        }
        ring.push(at(length, top));
        self.bodies
            .slide(self.it.paint, &ring, (side * 2.0).extend(0.0), false);
        if self.detail == Detail::Everything && self.painted() {
            for (at, out, cut) in [(from, -way, cut[0]), (to, way, cut[1])] {
                if cut {
                    self.end(at, out, (foot + deep * 0.56, top));
                }
            }
        }
    }

    /// Returns true if member ends are painted yellow: on red timber.
    fn painted(&self) -> bool {
        self.it.paint == SurfaceId::named("vermilion")
    }

    /// Adds the yellow end of a member.
    fn end(&mut self, at: DVec2, out: DVec2, z: (f64, f64)) {
        let ochre = SurfaceId::named("ochre");
        super::block(
            &mut self.bodies,
            ochre,
            (at, out),
            (-0.01, 0.006),
            self.thick - 0.01,
            (z.0, z.1 - 0.003),
        );
    }

    /// Returns the foot and top of the arms of a level, and the top of the blocks on them.
    fn heights(&self, k: u32) -> (f64, f64, f64) {
        let base = self.level * f64::from(k);
        let foot = if k == 0 { 0.22 } else { -0.10 };
        (
            base + self.level * foot,
            base + self.level * 0.66,
            base + self.level,
        )
    }

    /// Returns how far the arms of a level project, metres.
    fn offset(&self, k: u32) -> f64 {
        match self.it.steps {
            0 => 0.0,
            steps => self.it.reach * f64::from(k) / f64::from(steps),
        }
    }

    /// Adds a complex that steps out in some directions, at corners also diagonally.
    fn complex(&mut self, ways: &[DVec2], between: Option<DVec2>) {
        let post = self.it.post;
        let daito = post.max(self.thick * 2.4) * 1.08;
        self.block(DVec2::ZERO, DVec2::X, daito, (0.0, self.level * 0.42));
        for way in ways {
            self.steps(*way, 1.0, true);
        }
        if let Some(way) = between {
            // Farther out by as much as the corner is.
            let by = 1.0 / way.dot(ways[0]).max(0.3);
            self.steps(way, by, false);
        }
    }

    /// Adds the arms in one direction, their steps scaled by `by`, and cross arms where the direction leads out of a
    /// wall.
    fn steps(&mut self, way: DVec2, by: f64, wall: bool) {
        let (n, post) = (self.it.steps, self.it.post);
        let side = dvec2(-way.y, way.x);
        let small = (post * 0.58).max(self.thick * 1.35);
        for k in 0..=n {
            let (foot, top, next) = self.heights(k);
            let here = way * (self.offset(k) * by);
            if wall {
                // One at the step, and one in the wall, where every other one is longer.
                let half = (post * 1.65).min(self.it.bay * 0.3);
                let inner = half * if k % 2 == 0 { 1.0 } else { 1.25 };
                let both = [(here, half), (DVec2::ZERO, inner)];
                let apart = if here == DVec2::ZERO { 1 } else { 2 };
                for (at, half) in both.into_iter().take(apart) {
                    self.across((at, side), (half, small), (foot, top, next));
                }
            }
            if k < n {
                let out = way * ((self.offset(k + 1) * by) + small * 0.55);
                // A hair lower than the arm across it.
                let lower = 0.004;
                self.arm(
                    -way * (post * 0.5),
                    out,
                    (foot - lower, top - lower),
                    [false, true],
                );
                let place = way * (self.offset(k + 1) * by);
                self.block(place, way, small, (top - 0.003, next));
            }
        }
        if n >= 3 {
            self.tail(way, by);
        }
    }

    /// Adds an arm parallel to the wall with three blocks.
    fn across(
        &mut self,
        (at, side): (DVec2, DVec2),
        (half, small): (f64, f64),
        (foot, top, next): (f64, f64, f64),
    ) {
        self.arm(
            at - side * half,
            at + side * half,
            (foot, top),
            [true, true],
        );
        for u in [-1.0, 0.0, 1.0] {
            let place = at + side * (u * (half - small / 2.0));
            self.block(place, side, small, (top - 0.002, next));
        }
    }

    /// Adds the tail rafter under the last step, sloping down and outwards beyond it.
    fn tail(&mut self, way: DVec2, by: f64) {
        let reach = self.it.reach * by;
        let (deep, slope) = (self.level * 0.42, 0.32 / by);
        let nose = reach + self.it.post * 0.95 * by;
        let foot = self.level * f64::from(self.it.steps) - self.level * 0.30;
        let side = dvec2(-way.y, way.x) * (self.thick * 0.45);
        let at = |u: f64, up: f64| (way * u - side).extend(foot + (reach - u) * slope + up);
        let back = reach * 0.1;
        let ring = [
            at(back, 0.0),
            at(nose, 0.0),
            at(nose + 0.03, deep),
            at(back, deep),
        ];
        let across = (side * 2.0).extend(0.0);
        self.bodies.slide(self.it.paint, &ring, across, false);
        if self.painted() && self.detail == Detail::Everything {
            let lift = DVec3::Z * 0.008;
            let out = (way * 0.006).extend(0.0);
            let ring = [
                at(nose, 0.0) + lift,
                at(nose, 0.0) + out + lift,
                at(nose + 0.03, deep) + out - lift,
                at(nose + 0.03, deep) - lift,
            ];
            // Narrower than the rafter, so that no two faces share a plane.
            let ring = ring.map(|p| p + across * 0.04);
            self.bodies
                .slide(SurfaceId::named("ochre"), &ring, across * 0.92, false);
        }
    }

    /// Adds a strut with a block (間斗束 kentozuka).
    fn strut(&mut self) {
        let (_, top, next) = self.heights(0);
        let width = self.it.post * 0.42;
        let z = (self.it.post * 0.28 - 0.004, top);
        super::block(
            &mut self.bodies,
            self.it.paint,
            (DVec2::ZERO, DVec2::NEG_Y),
            (-0.06, 0.07),
            width,
            z,
        );
        if self.detail > Detail::Flat {
            let small = (self.it.post * 0.58).max(self.thick * 1.35);
            self.block(DVec2::ZERO, DVec2::X, small, (top, next));
        }
    }

    /// Adds boxes that step out as far as the arms would.
    fn corbel(&mut self, way: DVec2, by: f64) {
        let (n, post) = (self.it.steps, self.it.post);
        for k in 0..=n {
            let (foot, _, next) = self.heights(k);
            let out = self.offset(k) * by + post * 0.4;
            let wide = post * (1.4 + 0.5 * f64::from(k) * FRAC_1_SQRT_2);
            let z = (foot.max(0.0) + 0.001, next);
            super::block(
                &mut self.bodies,
                self.it.paint,
                (DVec2::ZERO, way),
                (-post * 0.3, out),
                wide,
                z,
            );
        }
    }
}
