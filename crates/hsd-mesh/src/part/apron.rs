//! Inu-yarai: a curved screen of split bamboo laths in front of the foot of a wall, held by horizontal laths.

use crate::mesh::Axis;
use crate::mesh::panel::Rect;
use crate::part::bay::Bay;
use glam::{DVec2, dvec2};
use hsd_ir::catalog::body::{Apron, Place};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
use std::f64::consts::FRAC_PI_2;

/// Segments of the arc.
const STEPS: u32 = 8;

/// The same where the rest of the wall is flat: 4 mm off, half the thickness of a lath.
const FEW_STEPS: u32 = 5;

/// Adds the vertical laths and the horizontal ones over them.
pub(crate) fn apron(bay: &mut Bay<'_>, apron: &Apron, place: &Place, rect: Rect) {
    let arc = Arc {
        out: apron.out.0,
        height: rect.height(),
        foot: dvec2(place.front.0, rect.z0),
    };
    let pitch = rect.width() / f64::from(apron.count.max(1));
    let half = pitch * 0.43;
    let steps = match bay.detail > Detail::Flat {
        true => STEPS,
        false => FEW_STEPS,
    };
    let share = |i: u32| f64::from(i) / f64::from(steps);
    let outer = (0..=steps).map(|i| arc.point(share(i), 0.0));
    let inner = (0..=steps)
        .rev()
        .map(|i| arc.point(share(i), -place.thick.0));
    let lath: Vec<DVec2> = outer.chain(inner).collect();
    // The first and last lath stand half a pitch from the ends, so that neighbours go on evenly.
    for i in 0..apron.count {
        let x = rect.x0 + pitch * (f64::from(i) + 0.5);
        bay.bodies
            .rounded(place.finish, &lath, Axis::X, x - half, x + half);
    }
    for i in 0..apron.rails {
        // From a hand above the ground to just below the head.
        let at = 0.12 + 0.74 * f64::from(i) / f64::from(apron.rails.max(2) - 1);
        let rail = arc.rail(at);
        bay.bodies
            .rounded(SurfaceId::named("bamboo"), &rail, Axis::X, rect.x0, rect.x1);
    }
}

/// A quarter of an ellipse, vertical at the ground and horizontal at the wall.
struct Arc {
    out: f64,
    height: f64,
    /// The corner where it would meet the ground if it did not curve outwards: (out of the wall, up).
    foot: DVec2,
}

impl Arc {
    /// Returns the point (y, z) at a share of the way up, offset outwards.
    fn point(&self, share: f64, outwards: f64) -> DVec2 {
        let (a, b) = (self.out + outwards, self.height + outwards);
        let (sin, cos) = (libm::sin(FRAC_PI_2 * share), libm::cos(FRAC_PI_2 * share));
        dvec2(-(self.foot.x + a * cos), self.foot.y + b * sin)
    }

    /// Returns the outline of a split bamboo that lies on the laths.
    fn rail(&self, share: f64) -> Vec<DVec2> {
        let half = 0.016 / (FRAC_PI_2 * (self.out + self.height) / 2.0);
        let bow = [
            (-1.0, -0.002),
            (-0.7, 0.006),
            (0.0, 0.010),
            (0.7, 0.006),
            (1.0, -0.002),
        ];
        bow.map(|(along, out)| self.point(share + half * along, out))
            .to_vec()
    }
}
