//! The turns of an outline as a word (002-08).

use crate::frontage::Frontage;
use glam::DVec2;

/// Returns the turns of the walk round the outline, clockwise from the front: `R` and `L` (002-08).
pub(super) fn word(ring: &[DVec2], frontage: Option<&Frontage>) -> String {
    let n = ring.len();
    let first = frontage
        .and_then(|f| f.front.sides.first())
        .copied()
        .unwrap_or(0);
    let turn = |at: usize| {
        let (p, q, r) = (ring[(at + n - 1) % n], ring[at % n], ring[(at + 1) % n]);
        if (q - p).perp_dot(r - q) > 0.0 {
            'R'
        } else {
            'L'
        }
    };
    // Clockwise, the walk meets the corners of the ring backwards.
    (0..n).map(|step| turn((first + n - step) % n)).collect()
}
