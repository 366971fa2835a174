//! The front in a street: a house behind it, between two town houses of the library.

use super::Front;
use super::text::{number, storeys};
use std::fmt::Write;

/// How deep the house behind the front is, metres.
const DEPTH: f64 = 8.0;
/// The frontages of its neighbours, metres, and how far they stand off.
const BESIDE: (f64, f64) = (7.0, 0.1);
/// Units of 3 shaku in a metre.
const UNITS: f64 = 1.1;
/// What its other walls show.
const WALL: &str = "NRC";

/// Writes the text of the street; the pictures of the parts lie beside it.
pub fn write(front: &Front) -> String {
    let (width, off) = (front.size.x, BESIDE.1);
    let mut text = "<!-- The front in a street. Its neighbours are types of the library: put others there, or a town. -->\n".to_owned();
    text += "<Houses>\n";
    let _ = writeln!(
        text,
        "  <Place type=\"so-nikai\" x=\"{}\" y=\"0\" frontage=\"{}\" depth=\"{DEPTH}\" seed=\"1\"/>",
        number(-off, 3),
        BESIDE.0
    );
    let _ = writeln!(
        text,
        "  <House name=\"front\" x=\"{}\" y=\"0\">",
        number(width, 4)
    );
    let wall = |metres: f64| {
        let units = number(metres * UNITS, 4);
        format!("<Row><Part code=\"{WALL}\" width=\"{units}\"/></Row>")
    };
    let beside = wall(DEPTH);
    for storey in storeys(front) {
        let height = number(storey.height, 3);
        // Walls are written from right to left as seen from outside.
        let parts = storey.parts.iter().rev();
        let row: String = parts
            .map(|(code, width)| format!("<Part code=\"{code}\" width=\"{}\"/>", number(*width, 4)))
            .collect();
        let _ = writeln!(
            text,
            "    <Storey height=\"{height}\">\n      <Row>{row}</Row>\n      {beside}\n      {}\n      {beside}\n    </Storey>",
            wall(width)
        );
    }
    // A house of three storeys and more is a modern one.
    if front.grid.rows.len() > 3 {
        text += "    <Roofs kind=\"T\" shape=\"RIK\"/>\n";
    }
    let _ = writeln!(
        text,
        "  </House>\n  <Place type=\"chu-nikai\" x=\"{}\" y=\"0\" frontage=\"{}\" depth=\"{DEPTH}\" seed=\"2\"/>\n</Houses>",
        number(width + off + BESIDE.0, 4),
        BESIDE.0
    );
    text
}
