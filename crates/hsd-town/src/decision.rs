//! The table of decisions: a line a feature, and what the report says of all.

mod envelopes;

pub use envelopes::ENVELOPES_HEAD;

use super::layer::Lot;
use super::plan::LotId;
use super::plot::Rectangle;
use super::rear::{RearDecision, RearPlace};
use super::shape::{Segment, azimuth};
use super::site::law::EnvelopeRow;
use super::site::{Decision, Footing, LotSite};
use hsd_base::diagnostic::{Code, Diagnostics, Language, Origin, Severity, Text};
use hsd_base::source::Span;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::PlaceOn;
use hsd_map::Fault;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::sync::Arc;

/// What became of a feature.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// A house at least stands on it.
    Built,
    /// The author wants nothing here: the reason.
    Skipped(String),
    /// No house can stand here.
    Refused(Text),
    /// No rule takes it.
    NoRule,
    /// Its rules make nothing.
    Nothing,
    /// A house behind a house has no room.
    NoRoom(Text),
    /// A house behind a house would stand behind none.
    NoHouse,
}

/// What was decided about a feature.
#[derive(Clone, Debug)]
pub struct Record {
    /// The feature.
    pub id: LotId,
    /// The place in the town file of the element that made its house.
    pub span: Option<Span>,
    /// Its layer.
    pub layer: Arc<str>,
    /// Its key.
    pub key: Box<str>,
    /// The number of the rule, from 1; 0 for none.
    pub rule: usize,
    /// The type of its house.
    pub kind: String,
    /// Where the house comes from.
    pub evidence: String,
    /// What became of it.
    pub outcome: Outcome,
    /// The number of its houses.
    pub houses: usize,
    /// The parameters of the house.
    pub parameters: Vec<(String, Value)>,
    /// The envelopes that its rules ask for.
    pub envelopes: Vec<EnvelopeRow>,
    /// The gravest problem while it was evaluated.
    pub problem: Option<(Severity, Code)>,
    /// The number of parts of its geometry that are left out.
    pub parts_left: usize,
    /// What the ground knows of its place.
    pub footing: Footing,
    /// True for a house behind the house of a feature, which is no feature of its own.
    pub is_part: bool,
    place: [f64; 2],
    access: &'static str,
    corner: bool,
    measures: String,
    decision: Option<Decision>,
}

/// The first line of the table.
pub const HEAD: &str = "key,layer,rule,type,x,y,facing,front_x1,front_y1,front_x2,front_y2,width,depth,access,corner,iou,iou_full,what,why,parameters,measures\n";

impl Record {
    /// Returns the parameters of the house as `name=value`.
    pub fn parameters(&self) -> String {
        let named = self.parameters.iter();
        let named = named.map(|(name, value)| format!("{name}={}", short(value)));
        named.collect::<Vec<String>>().join(" ")
    }

    /// Begins the record of a feature.
    pub fn new(id: LotId, layer: &Arc<str>, lot: &Lot, site: &LotSite<'_>) -> Record {
        let at = lot.shape.centre();
        let frontage = site.frontage();
        let mut measures = String::new();
        for name in [
            "area",
            "vertices",
            "orthogonal",
            "street",
            "left",
            "right",
            "through",
        ] {
            if let hsd_ir::ast::town::Known::Value(value) =
                hsd_ir::ast::town::Site::value(site, name)
            {
                let _ = write!(measures, "{name}={} ", short(&value));
            }
        }
        Record {
            id: (id.0, lot.number as usize),
            span: None,
            layer: layer.clone(),
            key: lot.key.clone(),
            rule: 0,
            kind: String::new(),
            evidence: String::new(),
            outcome: Outcome::NoRule,
            houses: 0,
            parameters: vec![],
            envelopes: vec![],
            problem: None,
            parts_left: lot.parts_left,
            footing: site.footing.get(),
            is_part: false,
            place: [at.x, at.y],
            access: frontage.map_or("", |f| f.access.word()),
            corner: frontage.is_some_and(|f| f.corner),
            measures,
            decision: None,
        }
    }

    /// Begins the record of a house behind the house of this feature.
    pub fn part(&self, key: &str, decision: &RearDecision) -> Record {
        let stands = match &decision.place {
            RearPlace::Stands(rectangle) => Some(*rectangle),
            RearPlace::NoRoom(_) | RearPlace::NoHouse => None,
        };
        let centre = stands.map(|r| r.corners().iter().sum::<glam::DVec2>() / 4.0);
        Record {
            key: key.into(),
            is_part: true,
            outcome: match &decision.place {
                RearPlace::Stands(_) => Outcome::Nothing,
                RearPlace::NoRoom(why) => Outcome::NoRoom(why.clone()),
                RearPlace::NoHouse => Outcome::NoHouse,
            },
            place: centre.map_or(self.place, |c| c.to_array()),
            parts_left: 0,
            footing: Footing::Known,
            envelopes: vec![],
            access: "",
            corner: false,
            measures: String::new(),
            decision: stands.map(|r| Decision {
                on: PlaceOn::Plot,
                front: r.front,
                depth: r.depth,
                iou: None,
                iou_full: None,
                refused: None,
            }),
            ..self.clone()
        }
    }

    /// Returns the corners of the rectangle that was decided.
    pub fn corners(&self) -> Option<[glam::DVec2; 4]> {
        let decision = self.decision.as_ref()?;
        let (front, depth) = (decision.front, decision.depth);
        Some(Rectangle { front, depth }.corners())
    }

    /// Records where its house stands.
    pub fn decide(&mut self, decisions: &[Decision]) {
        self.decision = decisions.last().cloned();
    }

    /// Returns true unless it is of a house behind a house that has no room.
    pub fn is_shown(&self) -> bool {
        self.houses > 0 || !self.is_part
    }

    /// Returns true if nothing is missing that the author wanted.
    pub fn is_wanted(&self) -> bool {
        let wanted = |outcome: &Outcome| matches!(outcome, Outcome::Built | Outcome::Skipped(_));
        // A rear that is full, or is not there, is no fault.
        self.is_part || wanted(&self.outcome)
    }

    /// Writes its line of the table.
    pub fn line(&self, out: &mut String) {
        let number = |n: f64| format!("{:.3}", n + 0.0);
        let of = |f: &dyn Fn(&Decision) -> Option<f64>| {
            self.decision
                .as_ref()
                .and_then(f)
                .map(number)
                .unwrap_or_default()
        };
        let front = |f: fn(Segment) -> f64| of(&|d| Some(f(d.front)));
        let (what, why) = self.what();
        let cells = [
            self.key.to_string(),
            self.layer.to_string(),
            self.rule.to_string(),
            self.kind.clone(),
            number(self.place[0]),
            number(self.place[1]),
            front(|f| azimuth(f.normal())),
            front(|f| f.from.x),
            front(|f| f.from.y),
            front(|f| f.to.x),
            front(|f| f.to.y),
            front(Segment::length),
            of(&|d| Some(d.depth)),
            self.access.to_owned(),
            if self.corner { "yes" } else { "no" }.to_owned(),
            of(&|d| d.iou),
            of(&|d| d.iou_full),
            what.to_owned(),
            why,
            self.parameters(),
            self.measures.trim_end().to_owned(),
        ];
        let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
        out.push_str(&cells.join(","));
        out.push('\n');
    }

    /// Returns what became of it and why.
    pub fn what(&self) -> (&'static str, String) {
        match &self.outcome {
            Outcome::NoRoom(why) => ("no room", why.in_language(Language::English).to_string()),
            Outcome::NoHouse => (
                "no room",
                "no house on the front of the lot leaves a rear".to_owned(),
            ),
            Outcome::Built if self.is_part => ("rear", String::new()),
            Outcome::Built => {
                let on = self.decision.as_ref().map_or("built", |d| d.on.word());
                let code = self
                    .problem
                    .map_or(String::new(), |(_, code)| code.to_string());
                (on, code)
            }
            Outcome::Skipped(because) => ("skipped", because.clone()),
            Outcome::Refused(why) => ("refused", why.in_language(Language::English).to_string()),
            Outcome::NoRule => ("no rule", String::new()),
            Outcome::Nothing => {
                let code = self
                    .problem
                    .map_or(String::new(), |(_, code)| code.to_string());
                ("nothing", code)
            }
        }
    }
}

/// What the ledger of a town keeps of a feature.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Entry {
    /// The feature.
    pub id: LotId,
    /// Its line of the table.
    pub line: String,
    /// True if something stands on it.
    pub built: bool,
    /// True for a house behind the house of a feature.
    pub is_part: bool,
    /// Why nothing does.
    pub skipped: Option<SkippedFeature>,
    /// How its geometry or its place was changed.
    pub corrected: Vec<SkippedFeature>,
    /// Its envelopes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub envelopes: Vec<EnvelopeRow>,
}

impl Entry {
    /// Returns what is kept of a record.
    pub fn of(record: &Record) -> Entry {
        let mut line = String::new();
        record.line(&mut line);
        let of = |code: &str, reason: String| SkippedFeature {
            layer: record.layer.to_string(),
            key: record.key.to_string(),
            code: code.to_owned(),
            reason,
        };
        let built = matches!(record.outcome, Outcome::Built);
        let left = record.parts_left;
        let parts = (left > 0).then(|| of("parts", format!("{left} smaller parts left out")));
        let off = match record.footing {
            Footing::Known => None,
            Footing::Near => Some("the ground has no height here: the next one counts"),
            Footing::Lost => Some("the ground has no height within 200 m"),
        };
        let off = off.map(|why| of("HSD1163", why.to_owned()));
        Entry {
            id: record.id,
            line,
            built,
            is_part: record.is_part,
            skipped: (!built).then(|| {
                let (what, why) = record.what();
                of(what, why)
            }),
            corrected: parts.into_iter().chain(off).collect(),
            envelopes: record.envelopes.clone(),
        }
    }
}

impl Entry {
    /// Returns what is kept of a feature whose tile could not be made.
    pub fn unmade(layer: usize, name: &str, lot: &Lot) -> Entry {
        const WHY: &str = "its tile was not made";
        let at = lot.shape.centre();
        let mut cells = vec![String::new(); HEAD.split(',').count()];
        cells[0] = quoted(&lot.key);
        cells[1] = quoted(name);
        cells[2] = "0".to_owned();
        (cells[4], cells[5]) = (format!("{:.3}", at.x + 0.0), format!("{:.3}", at.y + 0.0));
        (cells[17], cells[18]) = ("not made".to_owned(), WHY.to_owned());
        Entry {
            id: (layer, lot.number as usize),
            line: cells.join(",") + "\n",
            built: false,
            is_part: false,
            skipped: Some(SkippedFeature {
                layer: name.to_owned(),
                key: lot.key.to_string(),
                code: "not made".to_owned(),
                reason: WHY.to_owned(),
            }),
            corrected: vec![],
            envelopes: vec![],
        }
    }
}

/// Returns a value with at most three decimals.
fn short(value: &Value) -> String {
    match value {
        Value::Number(n) => Value::Number((n * 1000.0).round() / 1000.0).to_string(),
        other => other.to_string(),
    }
}

fn quoted(cell: &str) -> String {
    match cell.contains([',', '"', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

/// What became of a town: every feature is built or listed.
#[derive(Debug, Default, Serialize)]
pub struct TownReport {
    /// The number of features of the layers that rules name.
    pub features: usize,
    /// Those on which something stands.
    pub built: usize,
    /// The others.
    pub skipped: Vec<SkippedFeature>,
    /// Features that were changed before something was built on them.
    pub corrected: Vec<SkippedFeature>,
    /// Houses above the envelope of their lot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub above_envelope: Vec<SkippedFeature>,
}

/// A feature in a report.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct SkippedFeature {
    /// Its layer.
    pub layer: String,
    /// Its key.
    pub key: String,
    /// The code of a diagnostic, or a word.
    pub code: String,
    /// The reason.
    pub reason: String,
}

impl SkippedFeature {
    /// Returns a feature that cannot be read.
    pub fn unread(layer: &str, fault: &Fault) -> SkippedFeature {
        let found = hsd_map::diagnostic(fault, 1, Span::default().into());
        SkippedFeature {
            layer: layer.to_owned(),
            key: fault
                .feature
                .as_ref()
                .map_or(String::new(), |w| w.key().to_string()),
            code: found.code.to_string(),
            reason: found.message.in_language(Language::English).to_string(),
        }
    }
}

impl TownReport {
    /// Adds a feature that cannot be read.
    pub fn unread(&mut self, feature: SkippedFeature) {
        self.features += 1;
        self.skipped.push(feature);
    }

    /// Adds a feature; what stands behind its house is counted with it. Returns its envelopes.
    pub fn add(&mut self, entry: Entry) -> Vec<EnvelopeRow> {
        if entry.is_part {
            return vec![];
        }
        self.features += 1;
        self.built += usize::from(entry.built);
        self.corrected.extend(entry.corrected);
        self.skipped.extend(entry.skipped);
        let above = entry.envelopes.iter().filter_map(EnvelopeRow::above);
        self.above_envelope.extend(above);
        entry.envelopes
    }
}

/// Returns what was found in the houses of features while they were made.
pub fn problems(found: &Diagnostics) -> Vec<SkippedFeature> {
    let of = |d: &hsd_base::diagnostic::Diagnostic| match &d.origin {
        Origin::Feature { layer, key } => Some(SkippedFeature {
            layer: layer.to_string(),
            key: key.to_string(),
            code: d.code.to_string(),
            reason: d.message.in_language(Language::English).to_string(),
        }),
        Origin::Source(_) => None,
    };
    found.iter().filter_map(of).collect()
}
