//! The source file of a house with walls of any length and direction.

use super::Divided;
use super::graph::Graph;
use super::openings::{Piece, pieces};
use crate::plan::text::Era;
use glam::{DVec2, dvec2};
use quick_xml::escape::escape;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Metres in a unit of the house.
pub const UNIT: f64 = 10.0 / 11.0;
/// Steps of a unit on which corners lie.
const STEPS: f64 = 100.0;

/// A house as it is written.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The text.
    pub text: String,
    /// The right end of the front, pixels of the sheet.
    pub origin: DVec2,
    /// The middles of pieces in doubt, pixels of the sheet, each with the bytes of its text.
    pub doubts: Vec<(DVec2, std::ops::Range<usize>)>,
    /// The walls of the outline, once round.
    pub outline: Vec<DVec2>,
    /// The area of the outline, square metres.
    pub area: f64,
    /// The area of what is drawn apart from the house, square metres.
    pub apart: f64,
}

/// A wall that is walked along.
#[derive(Clone, Copy)]
struct Step {
    line: usize,
    /// True from its first end to its second.
    forward: bool,
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

/// Writes a house; `None` if nothing is enclosed. `lines` are those of the comment at its head, `height` is in shaku.
pub fn write(
    (divided, graph): (&Divided, &Graph),
    metres: f64,
    (name, lines, height, era): (&str, &[String], f64, Era),
) -> Option<Traced> {
    let graph = &stepped(graph, metres);
    let Walks {
        outline,
        holes,
        apart,
    } = Walks::of(graph)?;
    let around = corners(graph, &outline);
    let start = start(graph, &outline);
    let mut walk = outline;
    walk.rotate_left(start);
    let origin = corners(graph, &walk)[0];
    let mut w = Writer {
        divided,
        graph,
        metres,
        era,
        origin,
        text: String::new(),
        doubts: vec![],
    };
    w.head(name, lines, height);
    w.walk(&walk, 4, false, true);
    for hole in &holes {
        w.apart("hole", hole);
    }
    let indoors: BTreeSet<u32> = rooms_of(graph, &around);
    for run in inner(graph, &indoors) {
        w.apart("inner", &run);
    }
    w.rooms(&middles(divided, &indoors));
    // A gable roof needs walls at right angles.
    let shape = if is_square(&around) { "KIR" } else { "YOS" };
    let _ = writeln!(
        w.text,
        "  </Storey>\n  <Roofs kind=\"K\" shape=\"{shape}\" pitch=\"4.5\"/>\n</House>"
    );
    Some(Traced {
        text: w.text,
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

/// The walks of the largest house on a sheet.
struct Walks {
    outline: Vec<Step>,
    holes: Vec<Vec<Step>>,
    /// The area of other houses, square pixels.
    apart: f64,
}

impl Walks {
    /// Returns `None` if nothing is enclosed.
    fn of(graph: &Graph) -> Option<Walks> {
        let mut loops = loops(graph);
        let area = |walk: &Vec<Step>| enclosed(&corners(graph, walk));
        loops.sort_by(|a, b| area(b).abs().total_cmp(&area(a).abs()));
        let others = loops.split_off(1.min(loops.len()));
        let outline = loops.pop().filter(|walk| area(walk).abs() > 0.0)?;
        let around = corners(graph, &outline);
        let (houses, courts): (Vec<_>, Vec<_>) = others
            .into_iter()
            .partition(|walk| area(walk) * area(&outline) > 0.0);
        let holes = courts.into_iter();
        Some(Walks {
            apart: houses.iter().map(|walk| area(walk).abs()).sum(),
            holes: holes
                .filter(|walk| inside(&around, corners(graph, walk)[0]))
                .collect(),
            outline,
        })
    }
}

impl Writer<'_> {
    /// Writes the comment at the head, and how the house and its storey begin.
    fn head(&mut self, name: &str, lines: &[String], height: f64) {
        self.text.push_str("<!--\n");
        for line in lines {
            // Two hyphens would end the comment.
            let _ = writeln!(self.text, "  {}", line.replace("--", "- -"));
        }
        let _ = writeln!(self.text, "-->\n<House name=\"{}\">", escape(name));
        let _ = writeln!(self.text, "  <Storey height=\"{height}\">");
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
        for piece in pieces(self.divided, self.graph, line) {
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

fn ends(graph: &Graph, step: Step) -> [DVec2; 2] {
    let [a, b] = graph.lines[step.line].ends.map(|k| graph.corners[k]);
    if step.forward { [a, b] } else { [b, a] }
}

fn corners(graph: &Graph, walk: &[Step]) -> Vec<DVec2> {
    walk.iter().map(|step| ends(graph, *step)[0]).collect()
}

/// Twice-signed area of a polygon, halved: positive if its inside is to the right on a sheet whose places run down.
fn enclosed(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let sum: f64 = corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum();
    sum / 2.0
}

/// Returns true if all sides run along the axes.
fn is_square(around: &[DVec2]) -> bool {
    let next = around.iter().cycle().skip(1);
    let mut sides = around.iter().zip(next).map(|(a, b)| (*b - *a).abs());
    sides.all(|side| side.min_element() < 1e-3)
}

fn inside(around: &[DVec2], at: DVec2) -> bool {
    let next = around.iter().cycle().skip(1);
    let crossed = around.iter().zip(next).filter(|(a, b)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

/// The walks along outer walls, each with the house on its right.
fn loops(graph: &Graph) -> Vec<Vec<Step>> {
    let mut starting: BTreeMap<usize, Vec<Step>> = BTreeMap::new();
    for (n, line) in graph.lines.iter().enumerate() {
        let forward = match line.rooms {
            [0, r] if r != 0 => true,
            [l, 0] if l != 0 => false,
            _ => continue,
        };
        let from = line.ends[usize::from(!forward)];
        starting
            .entry(from)
            .or_default()
            .push(Step { line: n, forward });
    }
    let end = |step: &Step| graph.lines[step.line].ends[usize::from(step.forward)];
    let mut out = vec![];
    while let Some(first) = starting.values().flatten().next().copied() {
        let begin = graph.lines[first.line].ends[usize::from(!first.forward)];
        let mut walk: Vec<Step> = vec![];
        let mut at = begin;
        while let Some(all) = starting.get_mut(&at) {
            // Where two corners of the house touch, the sharper turn to the right stays on one side.
            let sharpest = (0..all.len()).max_by(|a, b| {
                let bend = |k: &usize| {
                    let [p, q] = ends(graph, all[*k]);
                    let before = walk.last().map_or(DVec2::X, |s| {
                        let [a, b] = ends(graph, *s);
                        b - a
                    });
                    libm::atan2(before.perp_dot(q - p), before.dot(q - p))
                };
                bend(a).total_cmp(&bend(b))
            });
            let Some(k) = sharpest else { break };
            let step = all.swap_remove(k);
            if all.is_empty() {
                starting.remove(&at);
            }
            walk.push(step);
            at = end(&step);
            if at == begin {
                break;
            }
        }
        if at == begin && walk.len() > 2 {
            out.push(walk);
        }
    }
    out
}

/// Returns the step with which the walk round a house begins.
///
/// It runs to the left, as near to the street as any, and begins at the right end.
fn start(graph: &Graph, walk: &[Step]) -> usize {
    let front = |k: &usize| {
        let [a, b] = ends(graph, walk[*k]);
        let ahead = b - a;
        let level = -ahead.x > 0.98 * ahead.length();
        let before = walk[(*k + walk.len() - 1) % walk.len()];
        let [p, q] = ends(graph, before);
        let turns = (q - p)
            .normalize_or_zero()
            .perp_dot(ahead.normalize_or_zero())
            .abs()
            > 0.02;
        (level && turns).then_some(a)
    };
    let all = (0..walk.len()).filter_map(|k| Some((k, front(&k)?)));
    all.max_by(|(_, a), (_, b)| {
        (a.y, a.x)
            .partial_cmp(&(b.y, b.x))
            .unwrap_or(std::cmp::Ordering::Equal)
    })
    .map_or(0, |(k, _)| k)
}

/// The rooms within an outline.
fn rooms_of(graph: &Graph, around: &[DVec2]) -> BTreeSet<u32> {
    let mut out = BTreeSet::new();
    for line in &graph.lines {
        let [a, b] = line.ends.map(|k| graph.corners[k]);
        let side = (b - a).perp().normalize_or_zero();
        let middle = graph.middle(line);
        // On a sheet whose places run down, what is to the right of a line lies towards its perpendicular.
        for (room, at) in [
            (line.rooms[0], middle - side),
            (line.rooms[1], middle + side),
        ] {
            if room != 0 && inside(around, at) {
                out.insert(room);
            }
        }
    }
    out
}

/// The walls between rooms of a house, those in one line together.
fn inner(graph: &Graph, rooms: &BTreeSet<u32>) -> Vec<Vec<Step>> {
    let mut left: Vec<usize> = (0..graph.lines.len())
        .filter(|n| {
            graph.lines[*n]
                .rooms
                .iter()
                .all(|r| *r != 0 && rooms.contains(r))
        })
        .collect();
    let ahead = |step: Step| {
        let [a, b] = ends(graph, step);
        (b - a).normalize_or_zero()
    };
    // To the left or up on the sheet.
    let along = |n: usize| {
        let forward = ahead(Step {
            line: n,
            forward: true,
        });
        Step {
            line: n,
            forward: (forward.x + forward.y * 1.01) < 0.0,
        }
    };
    let mut out = vec![];
    while let Some(first) = left.pop() {
        let mut run = vec![along(first)];
        loop {
            let (head, tail) = (run[0], run[run.len() - 1]);
            let [from, _] = ends(graph, head);
            let [_, to] = ends(graph, tail);
            let fits = |n: &usize| {
                let step = along(*n);
                let [a, b] = ends(graph, step);
                let straight = ahead(step).dot(ahead(head)) > 0.9998;
                straight && (a.distance(to) < 1e-6 || b.distance(from) < 1e-6)
            };
            let Some(k) = left.iter().position(fits) else {
                break;
            };
            let step = along(left.swap_remove(k));
            match ends(graph, step)[0].distance(to) < 1e-6 {
                true => run.push(step),
                false => run.insert(0, step),
            }
        }
        out.push(run);
    }
    out.sort_by(|a, b| {
        let of = |run: &Vec<Step>| ends(graph, run[0])[0];
        let (a, b) = (of(a), of(b));
        b.y.total_cmp(&a.y).then(b.x.total_cmp(&a.x))
    });
    out
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
