//! The front in a street: a house behind it, between two town houses of the library.

use super::Front;
use super::text::{Storey, number, storeys};
use std::fmt::Write;

/// How deep the house behind the front is, metres.
const DEPTH: f64 = 8.0;
/// The frontages of its neighbours, metres.
const BESIDE: f64 = 7.0;
/// Units of 3 shaku in a metre.
const UNITS: f64 = 1.1;
/// What its other walls show.
const WALL: &str = "NRC";

/// Writes the text of the street; the pictures of the parts lie beside it.
pub fn write(front: &Front) -> String {
    let storeys = storeys(front);
    // The walls behind are as long as the parts of the front are together, as they are written.
    let written = |units: f64| (units * 1e4).round() / 1e4;
    let units = |storey: &Storey| -> f64 {
        let widths = storey.parts.iter().map(|(_, width)| written(*width));
        widths.sum()
    };
    let width = storeys.first().map_or(0.0, units) / UNITS;
    let mut text = "<!-- The front in a street. Its neighbours are types of the library: put others there, or a town. -->\n".to_owned();
    text += "<Houses>\n";
    let _ = writeln!(
        text,
        "  <Place type=\"so-nikai\" x=\"0\" y=\"0\" frontage=\"{BESIDE}\" depth=\"{DEPTH}\" seed=\"1\"/>"
    );
    let _ = writeln!(
        text,
        "  <House name=\"front\" x=\"{}\" y=\"0\">",
        number(width, 4)
    );
    let wall = |units: f64| {
        let units = number(units, 4);
        format!("<Row><Part code=\"{WALL}\" width=\"{units}\"/></Row>")
    };
    let beside = wall(DEPTH * UNITS);
    for storey in &storeys {
        let height = number(storey.height, 3);
        // Walls are written from right to left as seen from outside.
        let parts = storey.parts.iter().rev();
        let row: String = parts
            .map(|(code, width)| format!("<Part code=\"{code}\" width=\"{}\"/>", number(*width, 4)))
            .collect();
        let _ = writeln!(
            text,
            "    <Storey height=\"{height}\">\n      <Row>{row}</Row>\n      {beside}\n      {}\n      {beside}\n    </Storey>",
            wall(units(storey))
        );
    }
    // A house of three storeys and more is a modern one.
    if front.grid.rows.len() > 3 {
        text += "    <Roofs kind=\"T\" shape=\"RIK\"/>\n";
    }
    let _ = writeln!(
        text,
        "  </House>\n  <Place type=\"chu-nikai\" x=\"{}\" y=\"0\" frontage=\"{BESIDE}\" depth=\"{DEPTH}\" seed=\"2\"/>\n</Houses>",
        number(width + BESIDE, 4)
    );
    text
}
