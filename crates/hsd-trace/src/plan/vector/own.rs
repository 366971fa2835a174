//! Plans that `hsd draw` has written as SVG: the house comes back as it was (grammar/drawings.md).
//!
//! Places are read off the paper; what a drawing cannot show (the unit, heights, which of the walks is a court) is told by the
//! `data-` attributes of its groups. Bays that somebody moved are read where they lie.

use super::refused::Refused;
use super::told::{self, Bay, Drawing, Frame, House, Level, Line, Walk};
use glam::{DVec2, dvec2};
use quick_xml::escape::escape;
use std::fmt::Write as _;

/// Degrees to which walls at odd angles are told where the paper leaves it open.
const ANGLES: [f64; 4] = [90.0, 15.0, 1.0, 0.1];

/// Reads the houses that a drawing of `hsd draw` tells; `None` if it is another drawing.
///
/// # Errors
/// If the file is no XML, or somebody has turned or shifted a group of it.
pub fn read(svg: &str) -> Result<Option<String>, Refused> {
    let Some(drawing) = told::collect(svg)? else {
        return Ok(None);
    };
    write(&drawing).map(Some)
}

/// A wall in the plan of its house.
struct Wall<'d> {
    /// Degrees to the right of the first heading.
    heading: f64,
    /// Where it ends.
    end: DVec2,
    bays: Vec<(&'d Bay, f64)>,
}

/// Writes the houses.
///
/// # Errors
/// If what is told does not say where a house stands.
pub(super) fn write(drawing: &Drawing) -> Result<String, Refused> {
    let houses: Vec<&House> = drawing.houses.values().collect();
    let several = houses.len() > 1;
    let first = houses.iter().find_map(|house| azimuth(house));
    let mut out = String::new();
    if several {
        out.push_str("<Houses>\n");
    }
    for house in houses {
        write_house(drawing, house, (first.unwrap_or(180.0), several), &mut out)?;
    }
    if several {
        out.push_str("</Houses>\n");
    }
    Ok(out)
}

fn azimuth(house: &House) -> Option<f64> {
    house
        .values()
        .find_map(|level| numbers(level.told.get("data-place")?).get(3).copied())
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace()
        .filter_map(|n| n.parse().ok())
        .filter(|n: &f64| n.is_finite() && n.abs() < 1e9)
        .collect()
}

fn write_house(
    drawing: &Drawing,
    house: &House,
    (front, several): (f64, bool),
    out: &mut String,
) -> Result<(), Refused> {
    let Some(told) = house
        .values()
        .map(|level| &level.told)
        .find(|t| !t.is_empty())
    else {
        return Ok(());
    };
    let place = told.get("data-place").map(numbers).unwrap_or_default();
    let &[east, north, up, azimuth] = &place[..] else {
        return Err(Refused::Unclear(
            "a house is not told its place (data-place)".to_owned(),
        ));
    };
    let unit = told
        .get("data-unit")
        .and_then(|u| u.parse::<f64>().ok())
        .filter(|u| *u > 0.01 && *u < 1000.0);
    let unit = unit
        .ok_or_else(|| Refused::Unclear("a house is not told its unit (data-unit)".to_owned()))?;
    let pad = if several { "  " } else { "" };
    let _ = write!(out, "{pad}<House");
    let name = told.get("data-name").unwrap_or_default();
    if !name.is_empty() {
        let _ = write!(out, " name=\"{}\"", escaped(name));
    }
    let values = [
        ("unit", unit, 3.0),
        ("azimuth", azimuth, 180.0),
        ("x", east, 0.0),
        ("y", north, 0.0),
        ("z", up, 0.0),
    ];
    for (key, value, _) in values
        .into_iter()
        .filter(|(_, value, usual)| value != usual)
    {
        let _ = write!(out, " {key}=\"{}\"", short(value));
    }
    if told.get("data-street") == Some("yes") {
        out.push_str(" street=\"yes\"");
    }
    out.push_str(">\n");
    for level in house.values() {
        // Houses turn clockwise with their azimuth, the paper with that of the first one.
        write_level(drawing, level, (unit, azimuth - front), pad, out)?;
    }
    let _ = writeln!(out, "{pad}</House>");
    Ok(())
}

fn write_level(
    drawing: &Drawing,
    level: &Level,
    (unit, turn): (f64, f64),
    pad: &str,
    out: &mut String,
) -> Result<(), Refused> {
    if level.walks.is_empty() {
        return Ok(());
    }
    let height = level
        .told
        .get("data-height")
        .and_then(|h| h.parse::<f64>().ok())
        .filter(|h| *h > 0.0);
    let height = height.map_or(String::new(), |h| format!(" height=\"{}\"", short(h)));
    let kind = level
        .told
        .get("data-kind")
        .map_or(String::new(), |k| format!(" kind=\"{}\"", escaped(k)));
    let mut walks: Vec<(&Walk, DVec2, Vec<Wall<'_>>)> = vec![];
    for walk in level.walks.iter().filter(|w| !w.lines.is_empty()) {
        let (start, walls) = placed(drawing, walk, (unit, turn))?;
        walks.push((walk, start, walls));
    }
    // The rows of a storey are its first walk, which is no court and no wall inside.
    let is_outer = |walk: &Walk| walk.kind == "outline" || walk.kind == "open";
    let rows = walks.first().is_some_and(|(walk, ..)| is_outer(walk));
    let start = walks
        .first()
        .filter(|(_, start, _)| rows && *start != DVec2::ZERO);
    let start = start.map_or(String::new(), |(_, start, _)| {
        format!(" start=\"{}\"", place(*start))
    });
    let _ = writeln!(out, "{pad}  <Storey{height}{kind}{start}>");
    for (k, (walk, start, walls)) in walks.iter().enumerate() {
        if rows && k == 0 {
            write_rows(walls, &walk.kind, &format!("{pad}    "), out);
            continue;
        }
        let kind = match walk.kind.as_str() {
            "court" => " hole=\"yes\"",
            "inner" => " inner=\"yes\"",
            _ => "",
        };
        let _ = writeln!(out, "{pad}    <Loop{kind} start=\"{}\">", place(*start));
        write_rows(walls, &walk.kind, &format!("{pad}      "), out);
        let _ = writeln!(out, "{pad}    </Loop>");
    }
    write_rooms(level, pad, out);
    let _ = writeln!(out, "{pad}  </Storey>");
    Ok(())
}

fn write_rooms(level: &Level, pad: &str, out: &mut String) {
    let attribute = |name: &str, value: &str| match value {
        "" => String::new(),
        value => format!(" {name}=\"{}\"", escaped(value)),
    };
    for room in &level.rooms {
        let (name, floor) = (
            attribute("name", &room.name),
            attribute("floor", &room.floor),
        );
        let _ = writeln!(
            out,
            "{pad}    <Room{name} at=\"{}\"{floor}/>",
            escaped(&room.at)
        );
    }
}

/// Where a walk starts, and its walls with the widths of their bays.
fn placed<'d>(
    drawing: &Drawing,
    walk: &'d Walk,
    (unit, turn): (f64, f64),
) -> Result<(DVec2, Vec<Wall<'d>>), Refused> {
    let told = walk.lines[0]
        .told
        .get("data-start")
        .map(numbers)
        .unwrap_or_default();
    let &[a, b] = &told[..] else {
        return Err(Refused::Unclear(
            "a walk is not told its start (data-start)".to_owned(),
        ));
    };
    let start = dvec2(a, b);
    let frame = Frame::new(drawing, unit, turn, (walk.lines[0].bays[0].from, start));
    let mut walls: Vec<Wall<'_>> = walk
        .lines
        .iter()
        .filter_map(|line| wall(line, &frame))
        .collect();
    if walls.iter().all(|w| w.heading % 90.0 == 0.0) {
        square(start, &mut walls, 2.0 * frame.exact());
    }
    Ok((start, walls))
}

/// Makes walls at right angles that end in one line on paper end in one line: only so does their walk close.
fn square(start: DVec2, walls: &mut [Wall<'_>], doubt: f64) {
    let mut at = start;
    let mut known = [vec![start.x], vec![start.y]];
    for wall in walls {
        let (axis, ahead) = match turned(wall.heading) {
            0.0 => (0, 1.0),
            90.0 => (1, 1.0),
            -90.0 => (1, -1.0),
            _ => (0, -1.0),
        };
        let end = wall.end[axis];
        let near = |p: &f64| (p - end).abs() <= doubt;
        let end = known[axis]
            .iter()
            .copied()
            .find(near)
            .or(Some(round(end)).filter(near))
            .unwrap_or(end);
        known[axis].push(end);
        let length: f64 = wall.bays.iter().map(|b| rounded(b.1)).sum();
        let off = (end - at[axis]) * ahead - length;
        if let Some(last) = wall
            .bays
            .iter_mut()
            .rev()
            .find(|b| b.1 > doubt)
            .filter(|_| off.abs() > 1e-9)
        {
            last.1 += off;
        }
        at[axis] = end;
    }
}

/// A place on quarter units.
fn round(at: f64) -> f64 {
    (at * 4.0).round() / 4.0
}

/// A width as it is written.
fn rounded(width: f64) -> f64 {
    (width * 1e6).round() / 1e6
}

/// A wall in the plan; none if it has no length.
fn wall<'d>(line: &'d Line, frame: &Frame) -> Option<Wall<'d>> {
    let from = frame.plan(line.bays.first()?.from);
    let whole = frame.plan(line.bays.last()?.to) - from;
    let length = whole.length();
    if length <= frame.exact() {
        return None;
    }
    let heading = libm::atan2(whole.y, whole.x).to_degrees();
    let doubt = (2.0 * frame.exact() / length).to_degrees();
    let round = |step: f64| (heading / step).round() * step;
    let heading = ANGLES
        .into_iter()
        .map(round)
        .find(|h| (h - heading).abs() <= doubt)
        .unwrap_or(heading);
    let ahead = whole / length;
    let mut off = 0.0;
    let bays = line.bays.iter().map(|bay| {
        // Bays are as wide as their ends on paper are apart.
        let to = (frame.plan(bay.to) - from).dot(ahead);
        let width = width(bay, (to - off).max(0.0), 2.0 * frame.exact());
        // What the width was rounded by is not handed on to the next bay.
        off += width;
        (bay, width)
    });
    Some(Wall {
        heading,
        end: from + whole,
        bays: bays.collect(),
    })
}

/// The width of a bay, units: that of its part, of quarter units, or as drawn.
fn width(bay: &Bay, drawn: f64, doubt: f64) -> f64 {
    let near = |w: &f64| (w - drawn).abs() <= doubt;
    let own = bay.code.as_deref().and_then(usual);
    let steps = [0.25, 0.1, 0.01, 0.001].map(|step| (drawn / step).round() * step);
    own.into_iter().chain(steps).find(near).unwrap_or(drawn)
}

/// The width of a part of the catalogue: what the last of its five columns says.
fn usual(code: &str) -> Option<f64> {
    match code.as_bytes() {
        [_, _, _, _, b' '] => Some(1.0),
        [_, _, _, _, b'2'] => Some(2.0),
        [_, _, _, _, b'h'] => Some(0.5),
        [_, _, _, _, b'0'] => Some(0.0),
        _ => None,
    }
}

fn write_rows(walls: &[Wall<'_>], kind: &str, pad: &str, out: &mut String) {
    let first = walls.first().map_or(0.0, |w| w.heading);
    if turned(first) != 0.0 {
        let _ = writeln!(out, "{pad}<Row turn=\"{}\"/>", angle(turned(first)));
    }
    // A court turns left unless it says otherwise.
    let usual = if kind == "court" { -90.0 } else { 90.0 };
    for (k, wall) in walls.iter().enumerate() {
        let turn = walls
            .get(k + 1)
            .map(|next| turned(next.heading - wall.heading));
        let turn = turn
            .filter(|t| (t - usual).abs() > 1e-9)
            .map_or(String::new(), |t| format!(" turn=\"{}\"", angle(t)));
        let _ = write!(out, "{pad}<Row{turn}>");
        for (bay, width) in &wall.bays {
            write_bay(bay, *width, out);
        }
        out.push_str("</Row>\n");
    }
}

/// Degrees between -180 and 180.
fn turned(degrees: f64) -> f64 {
    let turn = degrees.rem_euclid(360.0);
    if turn > 180.0 { turn - 360.0 } else { turn }
}

fn angle(degrees: f64) -> String {
    match degrees {
        90.0 => "R".to_owned(),
        -90.0 => "L".to_owned(),
        other => short(other),
    }
}

fn write_bay(bay: &Bay, width: f64, out: &mut String) {
    let code = bay.code.as_deref().unwrap_or(".....");
    let plain = |c: char| c.is_ascii_alphanumeric() || c == ' ' || c == '.';
    let is_usual = usual(code).or((code == ".....").then_some(1.0)) == Some(width);
    if is_usual && code.chars().all(plain) && !code.starts_with(' ') {
        out.push_str(code);
    } else {
        let _ = write!(
            out,
            "<Part code=\"{}\" width=\"{}\"/>",
            escaped(code),
            short(width)
        );
    }
}

fn place(p: DVec2) -> String {
    format!("{} {}", short(p.x), short(p.y))
}

fn short(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// A text in an attribute of a house, where braces would be formulas.
fn escaped(text: &str) -> String {
    escape(text).replace('{', "&#123;").replace('}', "&#125;")
}
