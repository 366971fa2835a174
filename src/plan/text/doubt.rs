//! Which walls may well be others than they were read as.

use super::super::legend::Role;
use super::super::shape::Wall;
use super::super::strokes::Read;

/// The least lead over another reading without doubt.
const LEAST_LEAD: f64 = 0.04;

/// Whether a wall may well be another than it was read as, or none: its symbol leads by little, it agrees little with it, or a wall
/// is unlike the others on its sheet. What likeness and unlikeness count beside the lead, and the bounds, are from 5,800 walls that
/// were drawn by the generator in `tests/plan_drawings`: each bound leaves about one in eight of the right ones below it.
pub fn is_doubtful(wall: &Wall) -> bool {
    let (likeness, unlike, least) = match wall.read.role {
        Role::Wall => (0.77, 0.5, 0.55),
        Role::Slide => (0.0, 0.0, 0.15),
        Role::Hinged => (1.0, 0.0, 1.004),
        Role::Window => (0.0, 0.0, 0.13),
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
