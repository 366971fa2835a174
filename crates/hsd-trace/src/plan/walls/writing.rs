//! The source file of a house with walls of any length and direction.

use super::Divided;
use super::graph::Graph;
use super::openings::{Piece, pieces};
use super::walks::{Step, Walks, corners, enclosed, ends, inner, rooms_of, start};
use crate::plan::text::Era;
use glam::{DVec2, dvec2};
use quick_xml::escape::escape;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Metres in a unit of the house.
pub const UNIT: f64 = 10.0 / 11.0;
/// Steps of a unit on which corners lie.
const STEPS: f64 = 100.0;

/// A storey of a house.
#[derive(Clone, Copy, Debug)]
pub struct Storey<'a> {
    /// The rooms.
    pub divided: &'a Divided,
    /// The walls.
    pub graph: &'a Graph,
    /// Metres of a pixel.
    pub metres: f64,
    /// The height, shaku.
    pub height: f64,
    /// Takes its places to those of the storey on the ground, to the right and down, metres.
    pub shift: DVec2,
}

/// A house as it is written.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The text.
    pub text: String,
    /// The storeys, from the ground up.
    pub storeys: Vec<Drawn>,
}

/// A storey as it is written. Places are pixels of its sheet.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The place over which the house begins: the right end of the front on the ground.
    pub origin: DVec2,
    /// The middles of pieces in doubt, each with the bytes of its text.
    pub doubts: Vec<(DVec2, std::ops::Range<usize>)>,
    /// The walls of the outline, once round.
    pub outline: Vec<DVec2>,
    /// The area of the outline, square metres.
    pub area: f64,
    /// The area of what is drawn apart from the house, square metres.
    pub apart: f64,
}

struct Writer<'a> {
    divided: &'a Divided,
    graph: &'a Graph,
    metres: f64,
    era: Era,
    origin: DVec2,
    text: String,
    doubts: Vec<(DVec2, std::ops::Range<usize>)>,
}

/// Writes a house, from the ground up; `None` if a storey encloses nothing. `lines` are those of the comment at its head.
pub fn write(storeys: &[Storey<'_>], (name, lines, era): (&str, &[String], Era)) -> Option<Traced> {
    let mut text = head(name, lines);
    let mut written: Vec<Drawn> = vec![];
    for storey in storeys {
        // The origin of the house, metres of the ground.
        let origin = written
            .first()
            .map(|ground| ground.origin * storeys[0].metres);
        written.push(write_storey(storey, origin, era, &mut text)?);
    }
    // A gable roof needs walls at right angles.
    let shape = match written.iter().all(|storey| is_square(&storey.outline)) {
        true => "KIR",
        false => "YOS",
    };
    let _ = writeln!(
        text,
        "  <Roofs kind=\"K\" shape=\"{shape}\" pitch=\"4.5\"/>\n</House>"
    );
    Some(Traced {
        text,
        storeys: written,
    })
}

/// Returns the comment at the head, and how the house begins.
fn head(name: &str, lines: &[String]) -> String {
    let mut text = "<!--\n".to_owned();
    for line in lines {
        // Two hyphens would end the comment.
        let _ = writeln!(text, "  {}", line.replace("--", "- -"));
    }
    let _ = writeln!(text, "-->\n<House name=\"{}\">", escape(name));
    text
}

/// Writes a storey of a house with this origin, metres of the ground; the ground itself has none yet.
fn write_storey(
    storey: &Storey<'_>,
    origin: Option<DVec2>,
    era: Era,
    text: &mut String,
) -> Option<Drawn> {
    let metres = storey.metres;
    let graph = &stepped(storey.graph, metres);
    let Walks {
        outline,
        holes,
        apart,
    } = Walks::of(graph)?;
    let around = corners(graph, &outline);
    let start = start(graph, &outline);
    let mut walk = outline;
    walk.rotate_left(start);
    let begins = corners(graph, &walk)[0];
    let origin = origin.map_or(begins, |origin| (origin - storey.shift) / metres);
    let mut w = Writer {
        divided: storey.divided,
        graph,
        metres,
        era,
        origin,
        text: std::mem::take(text),
        doubts: vec![],
    };
    w.storey(storey.height, begins);
    w.walk(&walk, 4, false, true);
    for hole in &holes {
        w.apart("hole", hole);
    }
    let indoors: BTreeSet<u32> = rooms_of(graph, &around);
    for run in inner(graph, &indoors) {
        w.apart("inner", &run);
    }
    w.rooms(&middles(storey.divided, &indoors));
    w.text.push_str("  </Storey>\n");
    *text = w.text;
    Some(Drawn {
        origin,
        doubts: w.doubts,
        area: enclosed(&around).abs() * metres * metres,
        apart: apart * metres * metres,
        outline: around,
    })
}

/// Puts all corners onto steps of a hundredth of a unit, so that walls that meet on the sheet meet in the text.
fn stepped(graph: &Graph, metres: f64) -> Graph {
    let step = UNIT / STEPS / metres;
    let corners = graph.corners.iter().map(|p| (*p / step).round() * step);
    Graph {
        corners: corners.collect(),
        lines: graph.lines.clone(),
    }
}

impl Writer<'_> {
    /// Writes how a storey begins, and where.
    fn storey(&mut self, height: f64, begins: DVec2) {
        let at = self.place(begins);
        let start = match at.abs().max_element() < 1e-6 {
            true => String::new(),
            false => format!(" start=\"{} {}\"", short(at.x), short(at.y)),
        };
        let _ = writeln!(self.text, "  <Storey height=\"{height}\"{start}>");
    }

    /// Writes a separate walk: a courtyard (`hole`) or walls inside (`inner`).
    fn apart(&mut self, kind: &str, walk: &[Step]) {
        let at = self.place(corners(self.graph, walk)[0]);
        let (a, b) = (short(at.x), short(at.y));
        let _ = writeln!(self.text, "    <Loop {kind}=\"yes\" start=\"{a} {b}\">");
        self.turned(walk, 6);
        let is_inner = kind == "inner";
        self.walk(walk, 6, is_inner, !is_inner);
        self.text.push_str("    </Loop>\n");
    }

    /// Writes the rooms, each by a place in it.
    fn rooms(&mut self, middles: &[DVec2]) {
        for (k, at) in middles.iter().enumerate() {
            let at = self.place(*at);
            let (n, a, b) = (k + 1, short(at.x), short(at.y));
            let _ = writeln!(self.text, "    <Room name=\"{n}\" at=\"{a} {b}\"/>");
        }
    }

    /// Returns a place as authors count: units to the left of the right end of the front, and back from it.
    fn place(&self, at: DVec2) -> DVec2 {
        (self.origin - at) * self.metres / UNIT
    }

    /// The direction of a step, degrees to the right of the direction in which a house begins: to the left on the sheet.
    fn heading(&self, step: Step) -> f64 {
        let [a, b] = ends(self.graph, step);
        let ahead = b - a;
        // To the left on the sheet is 0, up is 90.
        libm::atan2(-ahead.y, -ahead.x).to_degrees()
    }

    /// Writes the turn with which a walk begins.
    fn turned(&mut self, walk: &[Step], indent: usize) {
        let turn = turn(self.heading(walk[0]));
        if turn.abs() > 0.005 {
            let _ = writeln!(
                self.text,
                "{}<Row turn=\"{}\"/>",
                " ".repeat(indent),
                turn_name(turn)
            );
        }
    }

    /// Writes the rows of a walk.
    fn walk(&mut self, walk: &[Step], indent: usize, is_inner: bool, closes: bool) {
        let pad = " ".repeat(indent);
        for (k, step) in walk.iter().enumerate() {
            let next = match (walk.get(k + 1), closes) {
                (Some(next), _) => Some(*next),
                (None, true) => Some(walk[0]),
                (None, false) => None,
            };
            let turn = next.map_or(90.0, |next| turn(self.heading(next) - self.heading(*step)));
            let turn = match turn_name(turn).as_str() {
                "R" => String::new(),
                name => format!(" turn=\"{name}\""),
            };
            let parts = self.parts(*step, is_inner);
            let told = parts.iter().filter(|p| p.2.is_some());
            let told: Vec<String> = told
                .map(|(code, _, at)| {
                    let at = self.place(at.unwrap_or_default());
                    format!("{} at {} {}", code.trim_end(), tenth(at.x), tenth(at.y))
                })
                .collect();
            if !told.is_empty() {
                let _ = writeln!(self.text, "{pad}<!-- in doubt: {} -->", told.join(", "));
            }
            let _ = write!(self.text, "{pad}<Row{turn}>");
            for (code, widths, at) in parts {
                let start = self.text.len();
                for alike in widths.chunk_by(|a, b| (a - b).abs() < 1e-6) {
                    let (code, width) = (code.trim_end(), short(alike[0]));
                    let part = format!("<Part code=\"{code}\" width=\"{width}\"/>");
                    let _ = match alike.len() {
                        1 => write!(self.text, "{part}"),
                        n => write!(self.text, "<repeat num=\"{n}\">{part}</repeat>"),
                    };
                }
                if let Some(at) = at {
                    self.doubts.push((at, start..self.text.len()));
                }
            }
            self.text.push_str("</Row>\n");
        }
    }

    /// Returns the parts along a step: code, widths in units, and the middle of what is in doubt.
    fn parts(&self, step: Step, is_inner: bool) -> Vec<(&'static str, Vec<f64>, Option<DVec2>)> {
        let line = &self.graph.lines[step.line];
        let [a, b] = line.ends.map(|k| self.graph.corners[k]);
        let length = a.distance(b);
        let mut all: Vec<(f64, f64, Piece)> = vec![];
        let mut from = 0.0;
        for piece in pieces((self.divided, self.graph), line, self.metres) {
            all.push((from, piece.to, piece));
            from = piece.to;
        }
        if !step.forward {
            all.reverse();
            all.iter_mut()
                .for_each(|p| (p.0, p.1) = (length - p.1, length - p.0));
        }
        let unit = UNIT / self.metres;
        let stepped = |pixels: f64| match pixels >= length - 1e-9 {
            true => length / unit,
            false => (pixels / unit * STEPS).round() / STEPS,
        };
        let [a, b] = ends(self.graph, step);
        let part = |(from, to, piece): (f64, f64, Piece)| {
            let (code, usual) = self.era.part(piece.role, (to - from) / unit, is_inner);
            let count = ((to - from) / unit / usual).round().max(1.0);
            let cut = |k: f64| stepped(from + (to - from) * k / count);
            let widths = (0..count as usize).map(|k| cut(k as f64 + 1.0) - cut(k as f64));
            let middle = a.lerp(b, (from + to) / 2.0 / length);
            let doubt = piece.is_doubtful.then_some(middle);
            (code, widths.filter(|w| *w > 1e-6).collect(), doubt)
        };
        all.into_iter().map(part).collect()
    }
}

/// A turn within half a turn, degrees to the right.
fn turn(degrees: f64) -> f64 {
    let turned = (degrees + 180.0).rem_euclid(360.0) - 180.0;
    if turned <= -179.995 { 180.0 } else { turned }
}

/// The name of a turn in the language.
fn turn_name(degrees: f64) -> String {
    match degrees {
        d if (d - 90.0).abs() < 0.005 => "R".to_owned(),
        d if (d + 90.0).abs() < 0.005 => "L".to_owned(),
        d => short(d),
    }
}

/// A number with six decimals at most, so that long walks close.
fn short(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{}", rounded + 0.0)
}

fn tenth(value: f64) -> String {
    format!("{}", (value * 10.0).round() / 10.0 + 0.0)
}

/// Returns true if all sides run along the axes.
fn is_square(around: &[DVec2]) -> bool {
    let next = around.iter().cycle().skip(1);
    let mut sides = around.iter().zip(next).map(|(a, b)| (*b - *a).abs());
    sides.all(|side| side.min_element() < 1e-3)
}

/// The place in each room that is farthest from its walls, pixels.
fn middles(divided: &Divided, rooms: &BTreeSet<u32>) -> Vec<DVec2> {
    let of = &divided.faces.of;
    let rim = of.rims();
    let inner = super::outside::distances(&rim);
    let mut best: BTreeMap<u32, (f32, DVec2)> = BTreeMap::new();
    for y in 0..of.height {
        for x in 0..of.width {
            let room = of[(x, y)];
            if !rooms.contains(&room) {
                continue;
            }
            let depth = inner[(x, y)];
            let place = best.entry(room).or_insert((-1.0, DVec2::ZERO));
            if depth > place.0 {
                *place = (depth, dvec2(x as f64 + 0.5, y as f64 + 0.5));
            }
        }
    }
    best.into_values().map(|(_, at)| at).collect()
}
