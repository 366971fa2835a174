//! Writes the stairs and fixtures of a house.

use super::{Place, relative};
use crate::plan::shape::Shape;
use std::fmt::Write as _;

/// Returns a line for each thing in the rooms; what the language does not have is a comment at its place.
pub(super) fn written(shape: &Shape, place: &dyn Fn((i32, i32)) -> Place, origin: Place) -> String {
    let mut text = String::new();
    for thing in &shape.things {
        let ((u, v), (w, d)) = (thing.at, thing.size);
        let (a, b) = relative(place((u + w, v + d)), origin);
        let name = thing.kind.name();
        let faces = match thing.faces {
            (1, 0) => "R",
            (-1, 0) => "L",
            (0, -1) => "B",
            _ => "F",
        };
        let _ = match thing.kind.is_fixture() {
            true => writeln!(
                text,
                "    <Fixture kind=\"{name}\" at=\"{a} {b}\" size=\"{w} {d}\" faces=\"{faces}\"/>"
            ),
            false => writeln!(
                text,
                "    <!-- drawn at {a} {b}, {w} by {d}: {name}, for which there is no Fixture -->"
            ),
        };
    }
    text
}
