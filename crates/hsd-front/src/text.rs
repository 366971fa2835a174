//! The text of a front: a `Structure` with its parts (003-08 to -11).

use super::{Front, Part};
use std::fmt::Write;

/// Shaku in a metre.
const SHAKU: f64 = 3.3;
/// Units of 3 shaku in a metre.
const UNITS: f64 = 1.1;
/// The most places, of a storey, that are written as exceptions from the one below it.
const EXCEPTIONS: f64 = 0.34;

/// A storey: its parts from the left, and their widths.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Storey {
    /// Its height, shaku.
    pub(super) height: f64,
    /// Its parts and their widths, units.
    pub(super) parts: Vec<(String, f64)>,
}

/// Writes the text; `head` are lines of its comment.
pub fn write(front: &Front, head: &[String]) -> String {
    let storeys = storeys(front);
    let mut text = String::new();
    let _ = writeln!(
        text,
        "<!-- {} -->",
        head.join("\n     ").replace("--", "- -")
    );
    let _ = writeln!(
        text,
        "<Structure size=\"{}\" order=\"right\">",
        number(front.size.x * 10.0, 3)
    );
    let _ = writeln!(
        text,
        "  <Facades>\n    <Facade id=\"1\" ratio=\"1\" angle=\"0\">"
    );
    let mut at = 0;
    while at < storeys.len() {
        let same = storeys[at..]
            .iter()
            .take_while(|s| **s == storeys[at])
            .count();
        let before = (at > 0).then(|| &storeys[at - 1]);
        let id = match same > 1 {
            true => "k".to_owned(),
            false => (at + 1).to_string(),
        };
        let indent = if same > 1 { "        " } else { "      " };
        if same > 1 {
            let _ = writeln!(text, "      <repeat num=\"{same}\">");
        }
        storey(&mut text, indent, &id, &storeys[at], before);
        sets(&mut text, indent, &storeys[at], front);
        let _ = writeln!(text, "{indent}</Floor>");
        if same > 1 {
            let _ = writeln!(text, "      </repeat>");
        }
        at += same;
    }
    text.push_str("    </Facade>\n  </Facades>\n</Structure>\n");
    text
}

/// The catalogue of the parts: names, pictures, sizes in metres, how many places show each, how many of them were hidden.
pub fn catalogue(front: &Front) -> String {
    let mut text = "part,picture,width_m,height_m,width_px,height_px,places,hidden\n".to_owned();
    for part in &front.parts {
        let cell = &front.cells[part.cell];
        let (u, v) = (
            &front.grid.columns[cell.column..],
            &front.grid.rows[cell.row..],
        );
        let own = front.shown.iter().filter(|s| s.as_cell == part.cell);
        let (places, hidden) = (own.clone().count(), own.filter(|s| s.is_replaced).count());
        let (width, height) = ((u[1] - u[0]) * front.size.x, (v[1] - v[0]) * front.size.y);
        let (wide, tall) = (number(width, 4), number(height, 4));
        for (name, picture) in part.names().iter().zip(part.pictures()) {
            let size = picture.dimensions();
            let _ = writeln!(
                text,
                "{name},{name}.png,{wide},{tall},{},{},{places},{hidden}",
                size.0, size.1
            );
        }
    }
    text
}

/// The storeys of a front, from the ground.
pub(super) fn storeys(front: &Front) -> Vec<Storey> {
    let columns = front.grid.columns.len() - 1;
    let rows = front.grid.rows.windows(2).enumerate();
    let storeys = rows.map(|(row, v)| Storey {
        height: (v[1] - v[0]) * front.size.y * SHAKU,
        parts: (0..columns)
            .map(|column| {
                let u = &front.grid.columns[column..];
                let width = (u[1] - u[0]) * front.size.x * UNITS;
                (front.name_at(row, column), width)
            })
            .collect(),
    });
    let mut storeys: Vec<Storey> = storeys.collect();
    storeys.reverse();
    // Equal storeys differ by errors of a pixel.
    for k in 1..storeys.len() {
        if (storeys[k].height / storeys[k - 1].height - 1.0).abs() < 0.01 {
            storeys[k].height = storeys[k - 1].height;
        }
    }
    storeys
}

fn storey(text: &mut String, indent: &str, id: &str, storey: &Storey, before: Option<&Storey>) {
    let height = number(storey.height, 3);
    let _ = writeln!(text, "{indent}<Floor id=\"{id}\" height=\"{height}\">");
    let differ = |other: &Storey| -> Vec<usize> {
        (0..storey.parts.len())
            .filter(|k| other.parts[*k] != storey.parts[*k])
            .collect()
    };
    let exceptions = before.map(differ).unwrap_or_default();
    let few = !exceptions.is_empty()
        && (exceptions.len() as f64) <= EXCEPTIONS * storey.parts.len() as f64;
    let base = before.filter(|_| few).unwrap_or(storey);
    let mut at = 0;
    while at < base.parts.len() {
        let part = &base.parts[at];
        let same = base.parts[at..]
            .iter()
            .take_while(|p| p.0 == part.0 && (p.1 / part.1 - 1.0).abs() < 0.02)
            .count();
        let line = format!(
            "<Part code=\"{}\" width=\"{}\"/>",
            part.0,
            number(part.1, 4)
        );
        let _ = match same > 1 {
            true => writeln!(text, "{indent}  <repeat num=\"{same}\">{line}</repeat>"),
            false => writeln!(text, "{indent}  {line}"),
        };
        at += same;
    }
    if few {
        for k in exceptions {
            let (was, is) = (&base.parts[k].0, &storey.parts[k].0);
            let _ = writeln!(
                text,
                "{indent}  <replace code=\"{was}\" with=\"{is}\" at=\"{}\"/>",
                k + 1
            );
        }
    }
}

/// The sets of pictures from which each place of a storey draws one (003-10).
fn sets(text: &mut String, indent: &str, storey: &Storey, front: &Front) {
    let is_here = |part: &&Part| storey.parts.iter().any(|p| p.0 == part.name);
    let several = front.parts.iter().filter(|p| !p.variations.is_empty());
    for part in several.filter(is_here) {
        let names = part.names().join(", ");
        let _ = writeln!(text, "{indent}  <random code=\"{names}\"/>");
    }
}

/// A number with so many decimals at the most.
pub(super) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
