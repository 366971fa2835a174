//! The stairs of a plan: an arrow the way one walks from here, up or down, with its word.

use crate::Settings;
use crate::paper::{Anchor, Mark, Role, Shape, arrow};
use crate::subject::Subject;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Language;
use hsd_ir::building::Fixture;

/// The height of words, and how far they stand before the flight, millimetres.
const WORD: (f64, f64) = (1.8, 1.8);

/// From the ends of a flight to those of its arrow, millimetres.
const WITHIN: f64 = 0.8;

/// Returns the arrows on the flights that begin in a storey, and on those that end in it.
pub(super) fn stairs(subject: &Subject<'_>, number: u32, settings: &Settings) -> Vec<Mark> {
    let mut marks = vec![];
    for built in &subject.houses {
        let place = |p: DVec2| subject.plan_point(&built.house, p) * settings.millimetres();
        for flight in built.fixtures.iter().filter(|f| f.kind.climbs()) {
            let up = flight.storey == number;
            if up || flight.storey + 1 == number {
                marks.extend(walked(flight, up, place, settings.language));
            }
        }
    }
    marks
}

fn walked(
    flight: &Fixture,
    up: bool,
    place: impl Fn(DVec2) -> DVec2,
    language: Language,
) -> Vec<Mark> {
    let low = flight.faces.outward();
    let (low, high) = (place(flight.edge(low)), place(flight.edge(-low)));
    let (from, to) = if up { (low, high) } else { (high, low) };
    let way = (to - from).normalize_or_zero();
    let word = match (up, language) {
        (true, Language::English) => "UP",
        (false, Language::English) => "DN",
        (true, Language::Japanese) => "上ル",
        (false, Language::Japanese) => "下ル",
    };
    // Words stand upright, with their middle before the flight.
    let at = from - way * WORD.1 - dvec2(0.0, WORD.0 * 0.4);
    vec![
        Mark::new(
            Role::Fall,
            Shape::Lines(arrow(from + way * WITHIN, to - way * WITHIN)),
        ),
        Mark::label(Role::Text, at, WORD.0, Anchor::Middle, word.to_owned()),
    ]
}
