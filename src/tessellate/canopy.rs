//! The little roof of an oriel: its slab falls outwards, cheeks close the gap to the box below it, laths hold its
//! boards down.

use super::bay::{Bay, Rect};
use super::boards::pieces;
use super::mesh::THIN;
use crate::catalog::body::Oriel;
use crate::material::SurfaceId;

/// Thickness of the covering, metres.
const COVER: f64 = 0.030;

/// Thickness of the boards below it.
const DECK: f64 = 0.014;

/// Thickness of the laths on it.
const LATH: f64 = 0.014;

/// How far it reaches over the sides of its box.
const VERGE: f64 = 0.045;

/// A roof over a box between two planes out of the wall's centre line; its underside meets the top of the rectangle
/// at the front of the box.
pub(super) fn canopy(
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
    let eaves = front + oriel.eaves.0;
    // The underside at a distance out of the wall.
    let under = |out: f64| rect.z1 + pitch * (front - out);
    let slab = |lo: f64, hi: f64, back: f64, out: f64| {
        [
            (out, under(out) + lo),
            (out, under(out) + hi),
            (back, under(back) + hi),
            (back, under(back) + lo),
        ]
    };
    let (x0, x1) = ((rect.x0 - VERGE).max(0.0), (rect.x1 + VERGE).min(bay.width));
    bay.profile(
        wood,
        &slab(0.0, DECK, back, eaves - 0.012),
        x0 + 0.006,
        x1 - 0.006,
    );
    bay.profile(oriel.roof, &slab(DECK, DECK + COVER, back, eaves), x0, x1);
    // A board under the eaves.
    let edge = slab(-0.028, 0.0, eaves - 0.034, eaves - 0.014);
    bay.profile(wood, &edge, x0 + 0.010, x1 - 0.010);
    // Laths up the slope hold boards down; tiles lie by their weight.
    if oriel.roof == SurfaceId::named("board_roof") {
        let n = pieces(x1 - x0, 0.40);
        let lath = slab(
            DECK + COVER,
            DECK + COVER + LATH,
            back + 0.02,
            eaves - 0.010,
        );
        for i in 0..=n {
            let x = x0 + 0.020 + (x1 - x0 - 0.040) * i as f64 / n as f64;
            bay.profile(SurfaceId::named("cedar"), &lath, x - 0.014, x + 0.014);
        }
    } else {
        let high = (under(back) + DECK + COVER + 0.05).min(bay.height);
        let low = under(back) + DECK;
        let ridge = [
            (back + 0.09, low - 0.01),
            (back + 0.09, high - 0.02),
            (back + 0.06, high),
            (back, high),
            (back, low),
        ];
        bay.profile(
            SurfaceId::named("kawara_edge"),
            &ridge,
            x0 + 0.002,
            x1 - 0.002,
        );
    }
    for x in [rect.x0 + 0.006, rect.x1 - 0.026] {
        let low = rect.z1 - 0.010;
        let cheek = [
            (back, low),
            (front - 0.008, low),
            (front - 0.008, under(front - 0.008) + 0.004),
            (back, under(back) + 0.004),
        ];
        bay.profile(wood, &cheek, x, x + 0.020);
    }
}
