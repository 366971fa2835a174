//! Barge boards (hafu): the bent board under the edge of a verge (domain.md 4.4: 0.18-0.24 deep,
//! 0.03 thick, plain on houses).

use super::frame::Frame;
use super::gable_wall::SUNK;
use super::look::Look;
use super::solid::bent_board;
use crate::building::{Finish, Solid};

/// Height of the board, metres, measured upright.
const DEEP: f64 = 0.2;
/// Thickness, metres.
const THICK: f64 = 0.03;
/// How far it stands back from the verge, metres.
const BACK: f64 = 0.02;

/// The least verge that has room for a board, metres.
pub const LEAST_VERGE: f64 = 0.1;

/// The board at the verge's edge `u`; `open` says on which sides it runs down along the eaves.
pub fn barge(
    frame: &Frame,
    u: f64,
    outward: f64,
    base: f64,
    look: &Look,
    open: [bool; 2],
) -> Solid {
    let (half, pitch) = (frame.depth / 2.0, look.pitch);
    let u = u - outward * BACK;
    let over = |open: bool| {
        if open {
            (look.eaves - BACK).max(0.0)
        } else {
            0.0
        }
    };
    let points = |lowered: f64| {
        let at = |v: f64| {
            let z = base + pitch * (half - (v - half).abs()) + SUNK - lowered;
            frame.point(u, v, z)
        };
        [
            at(-over(open[0])),
            at(half),
            at(frame.depth + over(open[1])),
        ]
    };
    let by = (frame.along() * (-outward * THICK)).extend(0.0);
    bent_board(&points(0.0), &points(DEEP), by, Finish::Timber)
}
