//! The source file of a house that was found: outer walls, walls inside, rooms, and a comment at each wall in doubt.

mod doubt;
mod things;

use super::legend::Role;
use super::shape::{Shape, Wall};
use glam::DVec2;
use quick_xml::escape::escape;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

pub use doubt::is_doubtful;

/// The parts that stand for roles: what a plan cannot say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Era {
    /// The name.
    pub name: &'static str,
    wall: [&'static str; 2],
    slide: [[&'static str; 2]; 2],
    hinged: &'static str,
    window: &'static str,
    lattice: &'static str,
}

/// Parts by era: of walls outside and inside, of sliding doors of one and two units outside and inside, and of the rest.
pub const ERAS: [Era; 3] = [
    Era {
        name: "edo",
        wall: ["KTU  ", "KTU  "],
        slide: [["TSH  ", "TSH 2"], ["TSH  ", "TFU 2"]],
        hinged: "TCH  ",
        window: "MRE  ",
        lattice: "GSI  ",
    },
    Era {
        name: "meiji",
        wall: ["KSS  ", "KTU  "],
        slide: [["TSH  ", "TSH 2"], ["TSH  ", "TFU 2"]],
        hinged: "TCH  ",
        window: "MHI  ",
        lattice: "GSI  ",
    },
    Era {
        name: "showa",
        wall: ["KSS  ", "KTU  "],
        slide: [["TSH  ", "TGL 2"], ["TSH  ", "TFU 2"]],
        hinged: "TCH  ",
        window: "MGA  ",
        lattice: "GSI  ",
    },
];

impl Era {
    /// The era of a name.
    pub fn named(name: &str) -> Option<Era> {
        ERAS.into_iter().find(|era| era.name == name)
    }

    /// Returns the part for a role on a wall of a length in units, and the units that it usually takes.
    pub(super) fn part(&self, role: Role, units: f64, is_inner: bool) -> (&'static str, f64) {
        let side = usize::from(is_inner);
        match role {
            Role::Wall => (self.wall[side], 1.0),
            Role::Slide if units >= 1.5 => (self.slide[side][1], 2.0),
            Role::Slide => (self.slide[side][0], 1.0),
            Role::Hinged => (self.hinged, 1.0),
            Role::Window => (self.window, 1.0),
            Role::Lattice => (self.lattice, 1.0),
            Role::Open | Role::Empty | Role::Mat => ("AKI  ", 1.0),
        }
    }

    /// What stands for what, in words.
    pub fn lines(&self) -> Vec<String> {
        let sides = |of: [&str; 2]| match of {
            [outside, inside] if outside == inside => outside.trim_end().to_owned(),
            [outside, inside] => format!(
                "{} outside, {} inside",
                outside.trim_end(),
                inside.trim_end()
            ),
        };
        vec![
            format!(
                "parts of the era {}: wall {}; sliding doors {}",
                self.name,
                sides(self.wall),
                sides([self.slide[0][1], self.slide[1][1]])
            ),
            format!(
                "  hinged door {}; window {}; lattice {}; way without a door AKI",
                self.hinged.trim_end(),
                self.window.trim_end(),
                self.lattice.trim_end()
            ),
        ]
    }
}

/// A wall in doubt.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// Its place in the text: the codes of its part.
    pub span: std::ops::Range<usize>,
    /// Its middle in units: to the right and down on the sheet.
    pub at: DVec2,
    /// What it was taken for.
    pub role: Role,
    /// Whether nothing was seen there.
    pub is_joined: bool,
    /// Its storey, counted from 0.
    pub storey: usize,
    /// What the comment before its row says of it.
    pub entry: String,
}

/// A storey of a house.
#[derive(Clone, Copy, Debug)]
pub struct Level<'a> {
    /// Its walls.
    pub shape: &'a Shape,
    /// Takes its units to those of the storey on the ground, to the right and down.
    pub shift: (i32, i32),
    /// Its height, shaku.
    pub height: f64,
}

/// What the head of a text says.
#[derive(Clone, Debug)]
pub struct Head {
    /// The name of the house.
    pub name: String,
    /// Where it comes from, and how: lines of the comment at the head.
    pub lines: Vec<String>,
    /// Shaku in a unit, if they are not 3.
    pub unit: Option<f64>,
}

/// A place as authors count: units to the left of the right end of the front, and back from it.
type Place = (i32, i32);

/// A text, and what in it is in doubt.
#[derive(Clone, Debug, Default)]
pub struct Written {
    /// The text.
    pub text: String,
    /// Walls in doubt, in the order of the text.
    pub doubts: Vec<Doubt>,
    /// Where the house begins, units of the storey on the ground: to the right and down on its sheet.
    pub origin: (i32, i32),
}

/// A unit of a wall in the author's frame.
#[derive(Clone, Copy)]
struct Unit {
    from: Place,
    to: Place,
    wall: Wall,
}

/// Where the right end of a front would be, units: farther right and farther down than any cell.
fn right_end(ground: &Shape) -> Option<(i32, i32)> {
    let right = ground.cells.iter().map(|c| c.0).max()? + 1;
    let front = ground.cells.iter().map(|c| c.1).max()? + 1;
    Some((right, front))
}

/// Writes a house, storey by storey from the ground; `None` if an outline is none.
pub fn write(levels: &[Level<'_>], head: &Head, era: Era) -> Option<Written> {
    let (right, front) = right_end(levels.first()?.shape)?;
    let mut out = Written::default();
    out.text.push_str("<!--\n");
    for line in &head.lines {
        // Two hyphens would end the comment.
        let _ = writeln!(out.text, "  {}", line.replace("--", "- -"));
    }
    out.text.push_str("-->\n");
    let unit = head
        .unit
        .map(|u| format!(" unit=\"{u}\""))
        .unwrap_or_default();
    let _ = writeln!(out.text, "<House name=\"{}\"{unit}>", escape(&head.name));
    let mut origin: Option<Place> = None;
    for (storey, level) in levels.iter().enumerate() {
        let place = |(u, v): (i32, i32)| (right - u - level.shift.0, front - v - level.shift.1);
        let before = out.doubts.len();
        let loops = loops(level.shape, &place)?;
        let start = loops.first()?.first()?.from;
        let origin = *origin.get_or_insert(start);
        storey_of(level, &loops, &place, origin, era, &mut out);
        out.doubts[before..]
            .iter_mut()
            .for_each(|d| d.storey = storey);
    }
    let (a, b) = origin?;
    out.origin = (right - a, front - b);
    out.text
        .push_str("  <Roofs kind=\"K\" shape=\"KIR\" pitch=\"4.5\"/>\n</House>\n");
    Some(out)
}

/// Writes a storey.
fn storey_of(
    level: &Level<'_>,
    loops: &[Vec<Unit>],
    place: &dyn Fn((i32, i32)) -> Place,
    origin: Place,
    era: Era,
    out: &mut Written,
) {
    let start = loops[0]
        .first()
        .map_or((0, 0), |unit| relative(unit.from, origin));
    let start = if start == (0, 0) {
        String::new()
    } else {
        format!(" start=\"{} {}\"", start.0, start.1)
    };
    let _ = writeln!(out.text, "  <Storey height=\"{}\"{start}>", level.height);
    for (k, walk) in loops.iter().enumerate() {
        let indent = if k == 0 { 4 } else { 6 };
        if let (1.., Some(first)) = (k, walk.first()) {
            let start = relative(first.from, origin);
            let _ = writeln!(
                out.text,
                "    <Loop hole=\"yes\" start=\"{} {}\">",
                start.0, start.1
            );
        }
        rows(
            walk,
            Writing {
                era,
                origin,
                is_inner: false,
                indent,
            },
            out,
        );
        if k > 0 {
            out.text.push_str("    </Loop>\n");
        }
    }
    inner(level.shape, place, origin, era, out);
    for (k, room) in level.shape.rooms.iter().enumerate() {
        let Some(cell) = middle(room) else { continue };
        let (a, b) = relative(place(cell), origin);
        let floor = level.shape.floors.get(&k);
        let floor = floor.map_or(String::new(), |f| format!(" floor=\"{}\"", f.name()));
        let _ = writeln!(
            out.text,
            "    <Room name=\"{}\" at=\"{} {}\"{floor}/>",
            k + 1,
            f64::from(a) - 0.5,
            f64::from(b) - 0.5
        );
    }
    out.text
        .push_str(&things::written(level.shape, place, origin));
    out.text.push_str("  </Storey>\n");
}

/// How rows are written.
#[derive(Clone, Copy)]
struct Writing {
    era: Era,
    origin: Place,
    is_inner: bool,
    indent: usize,
}

fn relative(place: Place, origin: Place) -> Place {
    (place.0 - origin.0, place.1 - origin.1)
}

/// The cell of a room that lies farthest inside: the middle of its longest row of cells.
fn middle(room: &BTreeSet<(i32, i32)>) -> Option<(i32, i32)> {
    let depth = |(u, v): (i32, i32)| {
        (1..)
            .find(|k| {
                ![(u - k, v), (u + k, v), (u, v - k), (u, v + k)]
                    .iter()
                    .all(|c| room.contains(c))
            })
            .unwrap_or(1)
    };
    room.iter().copied().max_by_key(|c| (depth(*c), -c.1, -c.0))
}

/// The walks along outer walls, each with the house on its right: the outline first, from the right end of its front.
fn loops(shape: &Shape, place: &dyn Fn((i32, i32)) -> Place) -> Option<Vec<Vec<Unit>>> {
    let mut next: BTreeMap<Place, Vec<Unit>> = BTreeMap::new();
    for wall in &shape.outer {
        let level = wall.from.1 == wall.to.1;
        // The cell below or to the right of the wall.
        let beyond = shape.cells.contains(&wall.from);
        // With the house below it a wall runs to the right on the sheet; with the house to its right, upwards.
        let (from, to) = if level == beyond {
            (wall.from, wall.to)
        } else {
            (wall.to, wall.from)
        };
        let unit = Unit {
            from: place(from),
            to: place(to),
            wall: *wall,
        };
        next.entry(unit.from).or_default().push(unit);
    }
    let mut walks: Vec<Vec<Unit>> = Vec::new();
    while let Some(first) = next.values().flatten().next().copied() {
        let mut walk = Vec::new();
        let mut at = first;
        loop {
            let starting = next.get_mut(&at.from)?;
            starting.retain(|u| u.to != at.to);
            if starting.is_empty() {
                next.remove(&at.from);
            }
            walk.push(at);
            if at.to == first.from {
                break;
            }
            // Where two corners of the house touch, the sharper turn to the right stays on one side.
            let ahead = heading(&at);
            let turn = |u: &Unit| {
                let h = heading(u);
                ahead.0 * h.1 - ahead.1 * h.0
            };
            at = *next.get(&at.to)?.iter().max_by_key(|u| turn(u))?;
        }
        walks.push(walk);
    }
    for walk in &mut walks {
        let start = start(walk)?;
        walk.rotate_left(start);
    }
    walks.sort_by_key(|w| std::cmp::Reverse(w.len()));
    // Nothing of a court is as near to the street as the outline round it.
    let front = |k: &usize| walks[*k].iter().map(|u| u.from.1).min();
    let outline = (0..walks.len()).min_by_key(front)?;
    walks.swap(0, outline);
    Some(walks)
}

fn heading(unit: &Unit) -> (i32, i32) {
    (unit.to.0 - unit.from.0, unit.to.1 - unit.from.1)
}

/// Where a walk begins: at a corner, of those nearest to the street the one farthest to the right, from which it goes left.
fn start(walk: &[Unit]) -> Option<usize> {
    let corner = |k: usize| heading(&walk[k]) != heading(&walk[(k + walk.len() - 1) % walk.len()]);
    (0..walk.len())
        .filter(|k| corner(*k) && heading(&walk[*k]) == (1, 0))
        .min_by_key(|k| (walk[*k].from.1, walk[*k].from.0))
}

/// Writes the rows of a walk: one for each straight wall.
fn rows(walk: &[Unit], writing: Writing, out: &mut Written) {
    let mut from = 0;
    while from < walk.len() {
        let ahead = heading(&walk[from]);
        let mut end = from + 1;
        while end < walk.len() && heading(&walk[end]) == ahead {
            end += 1;
        }
        let turn = walk.get(end).map(heading).map_or("", |next| {
            let left = ahead.0 * next.1 - ahead.1 * next.0 < 0;
            if left { " turn=\"L\"" } else { "" }
        });
        row(&walk[from..end], writing, turn, out);
        from = end;
    }
}

/// Writes one straight wall.
fn row(units: &[Unit], writing: Writing, turn: &str, out: &mut Written) {
    let pad = " ".repeat(writing.indent);
    let codes = codes(units, writing.era, writing.is_inner);
    let told = |(code, k, _): &(&str, usize, bool)| {
        let (a, b) = relative(units[*k].from, writing.origin);
        format!("{} at {a} {b}", code.trim_end())
    };
    let doubts: Vec<String> = codes.iter().filter(|c| c.2).map(&told).collect();
    if !doubts.is_empty() {
        let _ = writeln!(out.text, "{pad}<!-- in doubt: {} -->", doubts.join(", "));
    }
    let _ = write!(out.text, "{pad}<Row{turn}>");
    for part in codes {
        let (code, k, doubtful) = part;
        let start = out.text.len();
        out.text.push_str(code);
        if doubtful {
            let w = units[k].wall;
            let at = |p: (i32, i32)| DVec2::new(f64::from(p.0), f64::from(p.1));
            out.doubts.push(Doubt {
                span: start..out.text.len(),
                at: (at(w.from) + at(w.to)) / 2.0,
                role: w.read.role,
                is_joined: w.is_joined,
                storey: 0,
                entry: told(&part),
            });
        }
    }
    out.text.push_str("</Row>\n");
}

/// The codes along a wall, each with its first unit and whether it is in doubt.
fn codes(units: &[Unit], era: Era, is_inner: bool) -> Vec<(&'static str, usize, bool)> {
    let side = usize::from(is_inner);
    let mut out = Vec::new();
    let mut k = 0;
    while k < units.len() {
        let role = units[k].wall.read.role;
        let pair = units.get(k + 1).is_some_and(|n| n.wall.read.role == role);
        let mut doubtful = is_doubtful(&units[k].wall);
        let (code, count) = match role {
            Role::Wall => (era.wall[side], 1),
            Role::Slide if pair => (era.slide[side][1], 2),
            Role::Slide => (era.slide[side][0], 1),
            Role::Hinged => (era.hinged, 1),
            Role::Window => (era.window, 1),
            Role::Lattice => (era.lattice, 1),
            Role::Open | Role::Empty | Role::Mat => ("AKI  ", 1),
        };
        if count == 2 {
            doubtful |= is_doubtful(&units[k + 1].wall);
        }
        out.push((code, k, doubtful));
        k += count;
    }
    out
}

/// Writes the walls inside: straight runs along the grid, to the left, then to the back.
fn inner(
    shape: &Shape,
    place: &dyn Fn((i32, i32)) -> Place,
    origin: Place,
    era: Era,
    out: &mut Written,
) {
    let mut units: Vec<Unit> = Vec::new();
    for wall in &shape.inner {
        units.push(Unit {
            from: place(wall.to),
            to: place(wall.from),
            wall: *wall,
        });
    }
    for upright in [false, true] {
        let mut lines: BTreeMap<i32, BTreeMap<i32, Unit>> = BTreeMap::new();
        for unit in units.iter().filter(|u| (heading(u).0 == 0) == upright) {
            let (line, at) = if upright {
                unit.from
            } else {
                (unit.from.1, unit.from.0)
            };
            lines.entry(line).or_default().insert(at, *unit);
        }
        for line in lines.values() {
            let mut run: Vec<Unit> = Vec::new();
            for unit in line.values() {
                if run.last().is_some_and(|last| last.to != unit.from) {
                    walk(&run, upright, origin, era, out);
                    run.clear();
                }
                run.push(*unit);
            }
            walk(&run, upright, origin, era, out);
        }
    }
}

fn walk(run: &[Unit], upright: bool, origin: Place, era: Era, out: &mut Written) {
    let Some(first) = run.first() else { return };
    let (a, b) = relative(first.from, origin);
    let _ = writeln!(out.text, "    <Loop inner=\"yes\" start=\"{a} {b}\">");
    if upright {
        out.text.push_str("      <Row turn=\"R\"/>\n");
    }
    row(
        run,
        Writing {
            era,
            origin,
            is_inner: true,
            indent: 6,
        },
        "",
        out,
    );
    out.text.push_str("    </Loop>\n");
}
