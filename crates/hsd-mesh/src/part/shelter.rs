//! Small roofs: over windows, along fences, on wing walls.

use crate::mesh::Bodies;
use crate::mesh::panel::Rect;
use crate::part::bay::Bay;
use glam::{DVec2, DVec3, dvec3};
use hsd_base::geometry::FOUNDATION;
use hsd_ir::catalog::body::{Coping, Place, Wing};
use hsd_ir::material::SurfaceId;
use std::f64::consts::FRAC_PI_2;

/// Thickness of a small roof, metres.
const SLAB: f64 = 0.035;

/// The course of stone under a wing on the ground: its top above the floor, and how far it stands out, metres.
const STONE_TOP: f64 = -0.12;
const STONE_OUT: f64 = 0.02;
/// The corbel under a wing upstairs: its depth at the wall and the straight rest of the foot at its nose, as shares of the wing's
/// projection; its flat foot at the wall, metres; the pieces of its curve.
const CORBEL: f64 = 0.6;
const CORBEL_NOSE: f64 = 0.1;
const CORBEL_FLAT: f64 = 0.07;
const CORBEL_STEPS: u32 = 5;

/// Adds a hood whose slab slopes from the top of its rectangle.
pub(crate) fn hood(bay: &mut Bay<'_>, pitch: f64, place: &Place, rect: Rect) {
    let (front, back) = (place.front.0, place.front.0 - place.thick.0);
    let foot = (rect.z1 - SLAB - pitch * (front - back)).max(rect.z0);
    let outline = [
        (front, foot),
        (front, foot + SLAB),
        (back, rect.z1),
        (back, foot - 0.02),
    ];
    bay.profile(place.finish, &outline, rect.x0, rect.x1);
}

/// Adds a small gable roof along a fence, or across it.
pub(crate) fn coping(bay: &mut Bay<'_>, coping: &Coping, place: &Place, rect: Rect) {
    let (front, heights) = (place.front.0, (rect.z0, rect.z1));
    let along = gable_of(coping, place, (rect.x0, rect.x1), heights);
    let gable = match coping.across {
        false => along,
        true => Gable {
            along: DVec3::NEG_Y,
            across: DVec3::X,
            origin: dvec3((rect.x0 + rect.x1) / 2.0, 0.0, 0.0),
            ends: (front - place.thick.0, front),
            half: (rect.x1 - rect.x0) / 2.0 + coping.out.0,
            ..along
        },
    };
    gable.draw(&mut bay.bodies);
}

/// Adds the outer corner of a fence roof: two slopes that meet in a hip. `outline` is the kite from the end of the
/// ridge to the eaves of this fence, the corner, and the eaves of the other.
pub(crate) fn coping_corner(
    coping: &Coping,
    place: &Place,
    heights: (f64, f64),
    outline: &[DVec2; 4],
) -> Bodies {
    let gable = gable_of(coping, place, (0.0, 0.0), heights);
    let (eaves, top) = gable.slope();
    let at = |i: usize, z: f64| outline[i].extend(z);
    let low = eaves - SLAB;
    let mut bodies = Bodies::default();
    let mut face = |corners: &[DVec3]| bodies.face(place.finish, corners);
    face(&[at(0, top), at(1, eaves), at(2, eaves)]);
    face(&[at(0, top), at(2, eaves), at(3, eaves)]);
    face(&[at(3, low), at(2, low), at(1, low), at(0, low)]);
    face(&[at(1, low), at(2, low), at(2, eaves), at(1, eaves)]);
    face(&[at(2, low), at(3, low), at(3, eaves), at(2, eaves)]);
    face(&[at(0, low), at(1, low), at(1, eaves), at(0, top)]);
    face(&[at(3, low), at(0, low), at(0, top), at(3, eaves)]);
    bodies
}

/// Returns the distance from the middle of a fence to the outer eaves of its roof, metres.
pub(crate) fn coping_reach(coping: &Coping, place: &Place) -> f64 {
    place.front.0 + coping.out.0
}

/// Returns the roof of a fence between two ends, and between its lowest and highest permitted heights.
fn gable_of(coping: &Coping, place: &Place, ends: (f64, f64), heights: (f64, f64)) -> Gable {
    let middle = place.front.0 - place.thick.0 / 2.0;
    Gable {
        along: DVec3::X,
        across: DVec3::NEG_Y,
        origin: dvec3(0.0, -middle, 0.0),
        ends,
        half: place.thick.0 / 2.0 + coping.out.0,
        heights,
        pitch: coping.pitch,
        finish: place.finish,
        rolls: coping.rolls.0,
    }
}

/// Adds a wing wall at right angles to the facade, under a gable roof whose ridge runs outwards.
pub(crate) fn wing(bay: &mut Bay<'_>, wing: &Wing, place: &Place, rect: Rect) {
    let half = place.thick.0 / 2.0;
    let (inner, outer) = (-place.front.0, wing.out.0);
    let roof = 0.280_f64.min(rect.height() / 3.0);
    let head = rect.z1 - roof * 0.6;
    if bay.grounded {
        grounded_wall(bay, place.finish, (inner, outer), (half, head));
    } else {
        // A millimetre above the feet of other walls.
        let outline = on_corbel((inner, outer), (rect.z0 + 0.001, head));
        bay.profile(place.finish, &outline, -half, half);
    }
    let gable = Gable {
        along: DVec3::NEG_Y,
        across: DVec3::X,
        origin: DVec3::ZERO,
        ends: (inner + 0.001, outer + 0.120),
        half: half + 0.120,
        heights: (rect.z1 - roof, rect.z1),
        pitch: 0.5,
        finish: wing.roof,
        rolls: wing.rolls.0,
    };
    gable.draw(&mut bay.bodies);
}

/// Adds the wall of a wing that stands on the ground, on a course of stone.
fn grounded_wall(
    bay: &mut Bay<'_>,
    finish: SurfaceId,
    (inner, outer): (f64, f64),
    (half, head): (f64, f64),
) {
    let (foot, stone) = (STONE_TOP - 0.01, half + STONE_OUT);
    let side =
        |out: f64, low: f64, high: f64| [(inner, low), (out, low), (out, high), (inner, high)];
    bay.profile(finish, &side(outer, foot, head), -half, half);
    let course = side(outer + STONE_OUT, -FOUNDATION, STONE_TOP);
    bay.profile(SurfaceId::named("stone"), &course, -stone, stone);
}

/// Returns the side of a wing that hangs on the wall of an upper storey, from its inner to its outer end and from foot to head:
/// a corbel (持送り mochiokuri) below it curves back to the wall.
fn on_corbel((inner, outer): (f64, f64), (foot, head): (f64, f64)) -> Vec<(f64, f64)> {
    let (run, deep) = (outer * (1.0 - CORBEL_NOSE), outer * CORBEL);
    let mut outline = vec![(inner, head), (inner, foot - deep)];
    for step in 0..=CORBEL_STEPS {
        // A quarter of an ellipse, hollow below.
        let angle = FRAC_PI_2 * f64::from(step) / f64::from(CORBEL_STEPS);
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        outline.push((
            CORBEL_FLAT + (run - CORBEL_FLAT) * (1.0 - cos),
            foot - deep * (1.0 - sin),
        ));
    }
    outline.extend([(outer, foot), (outer, head)]);
    outline
}

/// A small gable roof: a slab with a flat underside, rolls of round tiles down its slopes, and a ridge of two courses
/// under a round cap.
struct Gable {
    /// Direction of its ridge.
    along: DVec3,
    /// Direction in which one of its slopes falls.
    across: DVec3,
    /// Origin of distances along the ridge.
    origin: DVec3,
    /// Start and end along the ridge, metres.
    ends: (f64, f64),
    /// Distance from the ridge to the eaves in plan, metres.
    half: f64,
    /// Its lowest permitted height, and its top, metres.
    heights: (f64, f64),
    /// Slope of the roof, rise over run.
    pitch: f64,
    finish: SurfaceId,
    /// Approximate spacing of the rolls, metres; 0 = no rolls.
    rolls: f64,
}

/// Heights of a ridge above the slab, metres: each course, and the cap.
const COURSE: f64 = 0.035;
const CAP: f64 = 0.060;

/// Half the width from which a small roof has boards under its tiles, metres; and the upright thickness of those at the ridge.
const WIDE: f64 = 0.45;
const UPRIGHT: f64 = 0.05;
/// How far its boards lie within the tiles at the eaves and at the gables, and the height of barge boards, metres.
const RIM: f64 = 0.04;
const GABLE: f64 = 0.113;
const BARGE: f64 = 0.13;

/// Radius of a roll, metres.
const ROLL: f64 = 0.042;

impl Gable {
    /// Returns the point at distances along the ridge, across it, and up.
    fn at(&self, u: f64, v: f64, z: f64) -> DVec3 {
        self.origin + self.along * u + self.across * v + DVec3::Z * z
    }

    /// Returns the scale of its ridge: a low roof has a low ridge.
    fn scale(&self) -> f64 {
        let (low, high) = self.heights;
        ((high - low) / 3.0 / (2.0 * COURSE + CAP)).min(1.0)
    }

    /// Returns the heights of its slopes at the eaves and under the ridge.
    fn slope(&self) -> (f64, f64) {
        let (low, high) = self.heights;
        let top = high - self.scale() * (2.0 * COURSE + CAP - 0.012);
        let eaves = (top - self.pitch * self.half).max(low + SLAB);
        (eaves, top)
    }

    /// Adds what is under the tiles of a wide roof: boards that fill its gables and its underside, and barge boards.
    fn boards(&self, bodies: &mut Bodies, (eaves, top): (f64, f64)) {
        let wood = SurfaceId::named("boards");
        let (from, to) = self.ends;
        // Into the tiles above it; its foot a little over their edge.
        let under = |v: f64| top - UPRIGHT - (top - UPRIGHT - eaves + SLAB) * v.abs() / self.half;
        let mut body = |u: f64, long: f64, profile: &[(f64, f64)]| {
            let ring: Vec<DVec3> = profile.iter().map(|(v, z)| self.at(u, *v, *z)).collect();
            bodies.slide(wood, &ring, self.along * long, false);
        };
        let wide = self.half - RIM;
        let foot = eaves - SLAB + 0.003;
        let fill = [(wide, foot), (0.0, under(0.0) + 0.012), (-wide, foot)];
        body(from + GABLE, to - from - 2.0 * GABLE, &fill);
        let out = self.half - 0.02;
        let barge = [
            (out, under(out) + 0.008),
            (0.0, under(0.0) + 0.008),
            (-out, under(out) + 0.008),
            (-out, under(out) - BARGE),
            (0.0, under(0.0) - BARGE),
            (out, under(out) - BARGE),
        ];
        body(from + 0.02, 0.03, &barge);
        body(to - 0.05, 0.03, &barge);
    }

    fn draw(&self, bodies: &mut Bodies) {
        let (from, to) = self.ends;
        let way = self.along * (to - from);
        let edge = SurfaceId::named("kawara_edge");
        let scale = self.scale();
        let (course, cap) = (COURSE * scale, CAP * scale);
        let (eaves, top) = self.slope();
        let ring = |points: &[(f64, f64)]| -> Vec<DVec3> {
            points.iter().map(|(v, z)| self.at(from, *v, *z)).collect()
        };
        let mut slab = vec![
            (self.half, eaves - SLAB),
            (self.half, eaves),
            (0.0, top),
            (-self.half, eaves),
            (-self.half, eaves - SLAB),
        ];
        if self.half >= WIDE {
            slab.push((0.0, top - UPRIGHT));
            self.boards(bodies, (eaves, top));
        }
        bodies.slide(self.finish, &ring(&slab), way, false);
        if self.rolls > 0.0 {
            self.rolls(bodies, (eaves, top));
        }
        // The lower course lies on both slopes.
        let slope = (top - eaves) / self.half;
        let mut foot = top + course - 0.012 * scale;
        let (wide, narrow) = (0.100, 0.085);
        let lower = [
            (wide, top - slope * wide),
            (wide, foot),
            (-wide, foot),
            (-wide, top - slope * wide),
            (0.0, top),
        ];
        bodies.slide(edge, &ring(&lower), way, false);
        let head = foot + course;
        let upper = [
            (narrow, foot),
            (narrow, head),
            (-narrow, head),
            (-narrow, foot),
        ];
        bodies.slide(edge, &ring(&upper), way, false);
        foot = head;
        let r = 0.060;
        let round = [
            (r, foot),
            (r * 0.8, foot + cap * 0.6),
            (r * 0.3, foot + cap),
            (-r * 0.3, foot + cap),
            (-r * 0.8, foot + cap * 0.6),
            (-r, foot),
        ];
        bodies.slide(edge, &ring(&round), way, true);
    }

    /// Adds rolls of round tiles from the eaves to the ridge, half a spacing from each end.
    fn rolls(&self, bodies: &mut Bodies, (eaves, top): (f64, f64)) {
        let edge = SurfaceId::named("kawara_edge");
        let (from, to) = self.ends;
        let n = crate::part::boards::pieces(to - from, self.rolls);
        let cell = (to - from) / n as f64;
        for side in [1.0, -1.0] {
            // A little beyond the eaves, and into the ridge.
            let foot = self.half + 0.012;
            let way = self.at(0.0, 0.06 * side, top) - self.at(0.0, foot * side, eaves);
            for i in 0..n {
                let u = from + cell * (i as f64 + 0.5);
                let section = [
                    (ROLL, -0.012),
                    (ROLL, 0.008),
                    (ROLL * 0.7, ROLL * 0.78),
                    (0.0, ROLL * 1.05),
                    (-ROLL * 0.7, ROLL * 0.78),
                    (-ROLL, 0.008),
                    (-ROLL, -0.012),
                ];
                let ring = section.map(|(a, z)| self.at(u + a, foot * side, eaves + z));
                bodies.slide(edge, &ring, way, true);
            }
        }
    }
}
