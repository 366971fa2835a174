//! Which walls may well be others than they were read as.

use super::super::legend::Role;
use super::super::shape::Wall;
use super::super::strokes::Read;

/// The least lead over another reading without doubt.
const LEAST_LEAD: f64 = 0.04;

/// Whether a wall may well be another than it was read as, or none: its symbol leads by little, it agrees little with it, or a wall
/// is unlike the others on its sheet. What likeness and unlikeness count beside the lead, and the bounds, are from 4,900 walls that
/// were drawn by the generator in `tests/plan_drawings` at 26 to 94 pixels a unit: four of five wrong ones lie below them, and one in
/// seven of the right walls and doors, a third of the windows.
pub fn is_doubtful(wall: &Wall) -> bool {
    let (likeness, unlike, least) = match wall.read.role {
        Role::Wall => (1.0, 0.2, 0.88),
        Role::Slide => (0.0, 0.0, 0.13),
        Role::Hinged => (0.4, 0.0, 0.42),
        Role::Window => (0.0, 0.0, 0.11),
        Role::Lattice => (0.0, 0.0, 0.12),
        Role::Open | Role::Empty | Role::Mat => return true,
    };
    let Read {
        likeness: agrees,
        lead,
        unlike: differs,
        ..
    } = wall.read;
    wall.is_joined || lead < LEAST_LEAD || lead + likeness * agrees - unlike * differs < least
}
