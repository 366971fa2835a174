//! The table of decisions: a line a feature, and what the report says of all.

mod entry;
mod envelopes;
mod report;

pub use entry::{Entry, FeatureState, LostHouse, SkippedFeature};
pub use envelopes::ENVELOPES_HEAD;
pub use report::{LayerCount, TownReport, problems};

use super::layer::Lot;
use super::plan::LotId;
use super::plot::Rectangle;
use super::rear::{RearDecision, RearPlace};
use super::shape::{Segment, azimuth};
use super::site::law::EnvelopeRow;
use super::site::{Decision, Footing, LotSite};
use glam::DVec2;
use hsd_base::diagnostic::{Code, Language, Severity, Text};
use hsd_base::source::Span;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::PlaceOn;
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
    /// Nothing can be made here: the code of the diagnostic and the reason.
    Refused(Code, Text),
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

    /// Returns its line of the table.
    pub fn line(&self) -> DecisionLine {
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
        ];
        let after = [self.parameters(), self.measures.trim_end().to_owned()];
        DecisionLine {
            before: row(&cells),
            what: what.to_owned(),
            why,
            after: row(&after),
        }
    }

    /// Returns the code, or a word, and the reason why nothing was made of it.
    fn why_skipped(&self) -> (String, String) {
        let (what, why) = self.what();
        match (&self.outcome, self.problem) {
            (Outcome::Refused(code, _), _) => (code.to_string(), why),
            (Outcome::NoRule, _) => ("HSD1107".to_owned(), "no rule takes it".to_owned()),
            (Outcome::Nothing, Some((_, code))) => {
                (code.to_string(), "its rules make nothing".to_owned())
            }
            _ => (what.to_owned(), why),
        }
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
            Outcome::Refused(_, why) => ("refused", why.in_language(Language::English).to_string()),
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

/// A line of the table of decisions. What became of the feature can still change: a house may turn out to exceed a limit.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct DecisionLine {
    /// The cells before `what`.
    before: String,
    what: String,
    why: String,
    /// The cells after `why`.
    after: String,
}

impl DecisionLine {
    /// Returns the line of a feature of which no rule decides anything.
    fn undecided(layer: &str, key: &str, at: Option<DVec2>, (what, why): (&str, &str)) -> Self {
        let columns = HEAD.split(',');
        let mut cells = vec![String::new(); columns.take_while(|name| *name != "what").count()];
        (cells[0], cells[1], cells[2]) = (key.to_owned(), layer.to_owned(), "0".to_owned());
        if let Some(at) = at {
            (cells[4], cells[5]) = (format!("{:.3}", at.x + 0.0), format!("{:.3}", at.y + 0.0));
        }
        DecisionLine {
            before: row(&cells),
            what: what.to_owned(),
            why: why.to_owned(),
            after: row(&[String::new(), String::new()]),
        }
    }

    /// Returns it as it is written.
    pub fn text(&self) -> String {
        let (what, why) = (quoted(&self.what), quoted(&self.why));
        format!("{},{what},{why},{}\n", self.before, self.after)
    }
}

/// Returns cells of a line.
fn row(cells: &[String]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
    cells.join(",")
}

/// Returns a value with at most three decimals.
fn short(value: &Value) -> String {
    match value {
        Value::Number(n) => Value::Number((n * 1000.0).round() / 1000.0).to_string(),
        other => other.to_string(),
    }
}

/// Returns a cell of a table. One that a spreadsheet would run as a formula has an apostrophe before it; numbers stay numbers.
fn quoted(cell: &str) -> String {
    const RUN: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];
    let is_run = cell.starts_with(RUN) && cell.parse::<f64>().is_err();
    let lead = if is_run { "'" } else { "" };
    match is_run || cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{lead}{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreadsheets_run_no_cell() {
        for (cell, written) in [
            ("-3.5", "-3.5"),
            ("+1e3", "+1e3"),
            ("a-b", "a-b"),
            ("a, b", "\"a, b\""),
            ("=1+1", "\"'=1+1\""),
            ("-3.5 m", "\"'-3.5 m\""),
            ("@SUM(A1)", "\"'@SUM(A1)\""),
            ("+\"a\"", "\"'+\"\"a\"\"\""),
            ("-", "\"'-\""),
        ] {
            assert_eq!(quoted(cell), written);
        }
    }
}
