//! The small roof of an oriel: a slab that slopes outwards, cheeks that close the gap to the box below it, and laths
//! that hold its boards down.

use crate::mesh::THIN;
use crate::mesh::panel::Rect;
use crate::part::bay::Bay;
use crate::part::boards::pieces;
use hsd_ir::catalog::body::Oriel;
use hsd_ir::material::SurfaceId;

/// Thickness of the covering, metres.
const COVER: f64 = 0.030;

/// Thickness of the boards below it, metres.
const DECK: f64 = 0.014;

/// Thickness of the laths on it, metres.
const LATH: f64 = 0.014;

/// Overhang beyond the sides of the box, metres.
const VERGE: f64 = 0.045;

/// Adds a roof over a box between two planes, given by their distance outside the wall's centre line; its underside
/// meets the top of the rectangle at the front of the box.
pub(crate) fn canopy(
    bay: &mut Bay<'_>,
    oriel: &Oriel,
    wood: SurfaceId,
    rect: Rect,
    (back, front): (f64, f64),
) {
    let room = bay.height - rect.z1 - COVER - DECK - LATH - THIN;
    let pitch = oriel.pitch.min(room / (front - back).max(0.05));
    if pitch <= 0.02 {
        return;
    }
    let slope = Slope {
        back,
        front,
        foot: rect.z1,
        pitch,
    };
    let eaves = front + oriel.eaves.0;
    let (x0, x1) = ((rect.x0 - VERGE).max(0.0), (rect.x1 + VERGE).min(bay.width));
    let deck = slope.layer((0.0, DECK), (back, eaves - 0.012));
    bay.profile(wood, &deck, x0 + 0.009, x1 - 0.009);
    let cover = slope.layer((DECK, DECK + COVER), (back, eaves));
    bay.profile(oriel.roof, &cover, x0, x1);
    // A board under the eaves.
    let edge = slope.layer((-0.028, 0.0), (eaves - 0.034, eaves - 0.014));
    bay.profile(wood, &edge, x0 + 0.013, x1 - 0.013);
    // Laths up the slope hold boards down; tiles lie by their weight.
    if oriel.roof == SurfaceId::named("board_roof") {
        slope.laths(bay, (x0, x1), eaves);
    } else {
        slope.flashing(bay, (x0, x1));
    }
    slope.cheeks(bay, wood, rect);
}

/// The slope of a small roof.
struct Slope {
    /// Distances of the wall and of the front of the box outside the centre line, metres.
    back: f64,
    front: f64,
    /// Height of the underside over the front of the box, metres.
    foot: f64,
    pitch: f64,
}

impl Slope {
    /// Returns the height of the underside at a distance out of the wall.
    fn under(&self, out: f64) -> f64 {
        self.foot + self.pitch * (self.front - out)
    }

    /// Returns the section between two heights above the underside and two distances out of the wall.
    fn layer(&self, (lo, hi): (f64, f64), (back, out): (f64, f64)) -> [(f64, f64); 4] {
        [
            (out, self.under(out) + lo),
            (out, self.under(out) + hi),
            (back, self.under(back) + hi),
            (back, self.under(back) + lo),
        ]
    }

    /// Adds the laths up the slope.
    fn laths(&self, bay: &mut Bay<'_>, (x0, x1): (f64, f64), eaves: f64) {
        let n = pieces(x1 - x0, 0.40);
        let top = DECK + COVER;
        let lath = self.layer((top, top + LATH), (self.back + 0.02, eaves - 0.010));
        for i in 0..=n {
            let x = x0 + 0.020 + (x1 - x0 - 0.040) * i as f64 / n as f64;
            bay.profile(SurfaceId::named("cedar"), &lath, x - 0.014, x + 0.014);
        }
    }

    /// Adds the row of tiles against the wall.
    fn flashing(&self, bay: &mut Bay<'_>, (x0, x1): (f64, f64)) {
        let back = self.back;
        let low = self.under(back) + DECK;
        let high = (low + COVER + 0.05).min(bay.height);
        let outline = [
            (back + 0.09, low - 0.01),
            (back + 0.09, high - 0.02),
            (back + 0.06, high),
            (back, high),
            (back, low),
        ];
        let tiles = SurfaceId::named("kawara_edge");
        bay.profile(tiles, &outline, x0 + 0.002, x1 - 0.002);
    }

    /// Adds the boards that close the sides between the box and the slope.
    fn cheeks(&self, bay: &mut Bay<'_>, wood: SurfaceId, rect: Rect) {
        let (low, out) = (self.foot - 0.010, self.front - 0.008);
        let outline = [
            (self.back, low),
            (out, low),
            (out, self.under(out) + 0.004),
            (self.back, self.under(self.back) + 0.004),
        ];
        for x in [rect.x0 + 0.006, rect.x1 - 0.026] {
            bay.profile(wood, &outline, x, x + 0.020);
        }
    }
}
