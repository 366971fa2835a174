//! What the tests of strokes stand on: texts with the files beside them, plans without places in the text, and outlines
//! that are worked out without the tool.

use crate::ide::Texts;
use crate::support::Words;
use hsd::Options;
use hsd::diagnostic::{Language, Severity};
use hsd::ide::Analysis;
use hsd::ide::format::Edit;
use hsd::ide::plan::Plan;
use hsd::ide::stroke::{self, Stroke, take_back};
use hsd::source::{FileId, Source};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// A text on its way through strokes.
pub(crate) struct Board {
    pub(crate) name: String,
    pub(crate) bytes: Vec<u8>,
    beside: BTreeMap<String, String>,
}

impl Board {
    pub(crate) fn new(text: &str) -> Board {
        Board::of_bytes("a.hsd", text.as_bytes().to_vec())
    }

    pub(crate) fn of_bytes(name: &str, bytes: Vec<u8>) -> Board {
        let (name, beside) = (name.to_owned(), BTreeMap::new());
        Board {
            name,
            bytes,
            beside,
        }
    }

    /// A file of the repository with those beside it.
    pub(crate) fn open(path: &Path) -> Board {
        let folder = path.parent().unwrap();
        let mut beside = BTreeMap::new();
        texts_below(folder, folder, &mut beside);
        Board {
            name: path.file_name().unwrap().to_string_lossy().into_owned(),
            bytes: std::fs::read(path).unwrap(),
            beside,
        }
    }

    pub(crate) fn analysis(&self) -> Analysis {
        let source = Source::new(FileId(0), &*self.name, &self.bytes);
        Analysis::new(source, &Texts(self.beside.clone()), &Options::default())
    }

    pub(crate) fn text(&self) -> String {
        Source::new(FileId(0), "", &self.bytes).text().to_owned()
    }

    pub(crate) fn plan(&self) -> Value {
        serde_json::to_value(Plan::of(&self.analysis(), Language::English)).unwrap()
    }

    /// Draws, and looks at what every stroke promises; the words where it is refused.
    pub(crate) fn draw(&mut self, stroke: &Value) -> Result<Vec<Edit>, String> {
        let before = self.analysis();
        let read: Stroke = serde_json::from_value(stroke.clone()).unwrap();
        let edits = stroke::edits(&before, &read).map_err(|why| {
            assert!(!why.en().is_empty() && !why.ja().is_ascii());
            why.en()
        })?;
        assert!(!edits.is_empty(), "{}: {stroke} changes nothing", self.name);
        self.apply(&before, &edits, stroke);
        let after = self.analysis();
        assert_eq!(after.source.encoding(), before.source.encoding());
        assert_eq!(
            comments(&after),
            comments(&before),
            "{}: {stroke}",
            self.name
        );
        let (was, is) = (errors(&before), errors(&after));
        assert!(
            is.len() <= was.len(),
            "{}: {stroke}\nmakes errors of\n{}\nin\n{}\n{is:?}",
            self.name,
            before.text(),
            after.text()
        );
        Ok(edits)
    }

    /// Draws on a text that may be wrong; whether the stroke was made.
    pub(crate) fn draw_anyhow(&mut self, stroke: &Value) -> bool {
        let before = self.analysis();
        let read: Stroke = serde_json::from_value(stroke.clone()).unwrap();
        let Ok(edits) = stroke::edits(&before, &read) else {
            return false;
        };
        self.apply(&before, &edits, stroke);
        true
    }

    /// Makes a change that can be taken back and made again.
    fn apply(&mut self, before: &Analysis, edits: &[Edit], stroke: &Value) {
        self.keeps_order(edits, before.text());
        let applied = stroke::apply(&before.source, &self.bytes, edits);
        let undone = take_back(&applied.bytes, &applied.undo).unwrap();
        assert_eq!(
            undone.bytes, self.bytes,
            "{}: {stroke} cannot be taken back",
            self.name
        );
        let redone = take_back(&undone.bytes, &undone.undo).unwrap();
        assert_eq!(redone.bytes, applied.bytes);
        self.bytes = applied.bytes;
    }

    fn keeps_order(&self, edits: &[Edit], text: &str) {
        let mut end = None;
        for edit in edits {
            assert!(
                text.get(edit.range.clone()).is_some(),
                "{}: {edit:?}",
                self.name
            );
            assert!(
                end.is_none_or(|e| e < edit.range.start),
                "{}: {edits:?}",
                self.name
            );
            end = Some(edit.range.end);
        }
    }
}

fn texts_below(root: &Path, folder: &Path, found: &mut BTreeMap<String, String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            texts_below(root, &path, found);
        } else if path.extension().is_some_and(|e| e == "hsd") {
            let name = path
                .strip_prefix(root)
                .unwrap()
                .to_string_lossy()
                .into_owned();
            found.insert(name, std::fs::read_to_string(&path).unwrap());
        }
    }
}

/// The comments of a text, sorted.
fn comments(a: &Analysis) -> Vec<&str> {
    let all = a.outline().comments.iter();
    let mut all: Vec<&str> = all.map(|c| &a.text()[c.clone()]).collect();
    all.sort_unstable();
    all
}

pub(crate) fn errors(a: &Analysis) -> Vec<String> {
    let errors = a
        .diagnostics
        .iter()
        .filter(|d| d.severity == Severity::Error);
    errors
        .map(|d| format!("{}: {}", d.code, d.message.en()))
        .collect()
}

/// A plan without what tells of places in the text.
pub(crate) fn bare(mut plan: Value) -> Value {
    strip(&mut plan);
    plan
}

fn strip(value: &mut Value) {
    match value {
        Value::Object(map) => {
            for key in ["span", "file", "fixed", "reasons", "facade"] {
                map.remove(key);
            }
            map.values_mut().for_each(strip);
        }
        Value::Array(list) => list.iter_mut().for_each(strip),
        _ => {}
    }
}

/// A wall of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct At {
    pub(crate) house: usize,
    pub(crate) storey: usize,
    pub(crate) ring: usize,
    pub(crate) wall: usize,
}

impl At {
    pub(crate) fn ring<'p>(&self, plan: &'p Value) -> &'p Value {
        &plan["houses"][self.house]["storeys"][self.storey]["rings"][self.ring]
    }

    pub(crate) fn stroke(&self, what: &str, by: i64) -> Value {
        serde_json::json!({"do": what, "house": self.house, "storey": self.storey, "ring": self.ring,
            "wall": self.wall, "by": by})
    }
}

/// All walls of a plan.
pub(crate) fn walls(plan: &Value) -> Vec<At> {
    let mut found = vec![];
    let list = |v: &Value| v.as_array().map_or(0, Vec::len);
    for house in 0..list(&plan["houses"]) {
        let own = &plan["houses"][house];
        for storey in 0..list(&own["storeys"]) {
            let own = &own["storeys"][storey];
            for ring in 0..list(&own["rings"]) {
                let own = &own["rings"][ring];
                let walls = 0..list(&own["walls"]);
                found.extend(walls.map(|wall| At {
                    house,
                    storey,
                    ring,
                    wall,
                }));
            }
        }
    }
    found
}

pub(crate) type Point = (f64, f64);

pub(crate) fn point(value: &Value) -> Point {
    (value[0].as_f64().unwrap(), value[1].as_f64().unwrap())
}

/// The corners of a ring in walk order.
pub(crate) fn corners(ring: &Value) -> Vec<Point> {
    let walls = ring["walls"].as_array().unwrap();
    walls.iter().map(|w| point(&w["from"])).collect()
}

/// An outline without corners at which nothing turns, from its least corner on.
pub(crate) fn outline(corners: &[Point]) -> Vec<Point> {
    let mut all = corners.to_vec();
    loop {
        let n = all.len();
        let dead = (0..n).find(|&i| {
            let (p, q, r) = (all[(i + n - 1) % n], all[i], all[(i + 1) % n]);
            ((q.0 - p.0) * (r.1 - q.1) - (q.1 - p.1) * (r.0 - q.0)).abs() < 1e-6
        });
        match dead {
            Some(i) => drop(all.remove(i)),
            None => break,
        }
    }
    let key = |p: &Point| ((p.0 * 1e4).round() as i64, (p.1 * 1e4).round() as i64);
    let first = (0..all.len()).min_by_key(|&i| key(&all[i])).unwrap_or(0);
    all.rotate_left(first);
    let round = |x: f64| (x * 1e4).round() / 1e4 + 0.0;
    all.iter().map(|p| (round(p.0), round(p.1))).collect()
}

/// The corners of a ring one of whose walls has moved outward.
pub(crate) fn moved(ring: &Value, wall: usize, by: f64) -> Vec<Point> {
    let mut all = corners(ring);
    let (n, (from, to)) = (all.len(), (all[wall], all[(wall + 1) % all.len()]));
    let length = ((to.0 - from.0).powi(2) + (to.1 - from.1).powi(2)).sqrt();
    // Seen along the wall the house lies on the right; a runs to the left of the front, b away from it.
    let out = (
        (to.1 - from.1) / length * by,
        -(to.0 - from.0) / length * by,
    );
    for i in [wall, (wall + 1) % n] {
        all[i] = (all[i].0 + out.0, all[i].1 + out.1);
    }
    outline(&all)
}
