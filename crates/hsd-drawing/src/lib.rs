//! Drawings to scale: plans, elevations, sections, roof and site plans of houses, from the same scene as their models
//! (docs/contract.md, `hsd draw`).
//!
//! | step | module | result |
//! |---|---|---|
//! | what is drawn | [`subject`] | bodies of the houses in the frame of the first one, each with a role |
//! | how it is looked at | `look` | a parallel projection, and the plane that cuts |
//! | what is cut | `cut` | exact areas |
//! | what is seen | `edges`, `seen`, `merge` | edges without their hidden parts, each once |
//! | views | `views`, `roofs`, `dimension` | marks in millimetres on paper |
//! | paper | [`sheet`], [`paper`] | views on a sheet |
//! | files | [`svg`], [`dxf`], [`pdf`], [`png`] | bytes |
//!
//! Plans are level sections: what a plan shows of a door or a lattice is the cut of its model, not a symbol.

mod cut;
mod dimension;
pub mod dxf;
mod edges;
pub mod letters;
mod look;
mod merge;
pub mod paper;
pub mod pdf;
pub mod png;
mod roofs;
mod seen;
pub mod sheet;
pub mod subject;
pub mod svg;
mod views;

use dimension::short;
use glam::{DVec3, dvec2};
use hsd_base::diagnostic::Language;
use paper::{Sheet, View};
use sheet::Paper;
use subject::Subject;
use views::Side;

pub use views::Side as Elevation;

/// The usual scales, the largest first.
pub const SCALES: [u32; 9] = [10, 20, 30, 50, 100, 200, 300, 500, 1000];

/// How a subject is drawn.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Metres of the model in a metre on paper.
    pub scale: u32,
    /// Where sections are cut.
    pub sections: Vec<Plane>,
    /// The language of titles.
    pub language: Language,
    /// What the title block says.
    pub title: String,
    /// The name of the source file.
    pub source: String,
    /// Metres in a ken.
    pub ken: f64,
}

impl Settings {
    /// Returns the millimetres on paper in a metre.
    fn millimetres(&self) -> f64 {
        1000.0 / f64::from(self.scale)
    }
}

/// An upright plane that cuts a house, in units of the first house's plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plane {
    /// Across the front, so far to the left along the first line.
    A(f64),
    /// Along the front, so far back.
    B(f64),
}

impl Plane {
    /// Returns it as it is written: `a=3.5`.
    pub fn word(self) -> String {
        match self {
            Plane::A(at) => format!("a={}", short(at, 3)),
            Plane::B(at) => format!("b={}", short(at, 3)),
        }
    }

    /// Reads it as it is written.
    pub fn read(text: &str) -> Option<Plane> {
        let (axis, value) = text.split_once('=')?;
        let at: f64 = value.trim().parse().ok().filter(|v: &f64| v.is_finite())?;
        match axis.trim() {
            "a" | "A" => Some(Plane::A(at)),
            "b" | "B" => Some(Plane::B(at)),
            _ => None,
        }
    }

    /// Returns a point in it, in the frame of a subject.
    fn place(self, subject: &Subject<'_>) -> DVec3 {
        let Some(first) = subject.houses.first() else {
            return DVec3::ZERO;
        };
        let plan = match self {
            Plane::A(at) => dvec2(at, 0.0),
            Plane::B(at) => dvec2(0.0, at),
        };
        subject.plan_point(&first.house, plan).extend(0.0)
    }

    /// Returns one across and one along the middle of the first house, between its columns.
    pub fn middle(subject: &Subject<'_>) -> Vec<Plane> {
        let Some(first) = subject.houses.first() else {
            return vec![];
        };
        let rings = first.house.storeys.iter().flat_map(|s| &s.rings);
        let corners = rings.flat_map(|r| r.walls.iter().map(|w| w.from));
        let mut bounds = paper::Bounds::default();
        corners.for_each(|c| bounds.add(c));
        let middle = (bounds.low + bounds.high) / 2.0;
        let between = |at: f64| at.floor() + 0.5;
        match bounds.size().min_element() > 0.0 {
            true => vec![Plane::A(between(middle.x)), Plane::B(between(middle.y))],
            false => vec![],
        }
    }
}

/// A view that may be asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// The plans of all storeys.
    Plans,
    /// The plan of a storey, from 1.
    Plan(u32),
    /// An elevation.
    Elevation(Side),
    /// All sections.
    Sections,
    /// The roofs from above.
    Roof,
    /// The plot.
    Site,
}

impl Wanted {
    /// All views, in the order in which they stand on a sheet.
    pub const ALL: [Wanted; 8] = [
        Wanted::Plans,
        Wanted::Roof,
        Wanted::Site,
        Wanted::Elevation(Side::Front),
        Wanted::Elevation(Side::Right),
        Wanted::Elevation(Side::Back),
        Wanted::Elevation(Side::Left),
        Wanted::Sections,
    ];

    /// Reads one as it is written: `plan`, `plan-2`, `front`, `section`, `roof`, `site`.
    pub fn read(text: &str) -> Option<Wanted> {
        match text {
            "plan" => Some(Wanted::Plans),
            "section" => Some(Wanted::Sections),
            "roof" => Some(Wanted::Roof),
            "site" => Some(Wanted::Site),
            _ => {
                let side = Side::ALL.into_iter().find(|s| s.word() == text);
                let storey = || text.strip_prefix("plan-")?.parse().ok();
                side.map(Wanted::Elevation)
                    .or_else(|| storey().filter(|n| *n > 0).map(Wanted::Plan))
            }
        }
    }
}

/// Returns the views that are wanted in rows: plans, elevations, sections.
pub fn views(subject: &Subject<'_>, wanted: &[Wanted], settings: &Settings) -> Vec<Vec<View>> {
    let mut rows: Vec<Vec<View>> = vec![vec![], vec![], vec![]];
    for view in wanted {
        match *view {
            Wanted::Plans => {
                for number in storeys(subject) {
                    rows[0].push(views::plan(subject, number, settings));
                }
            }
            Wanted::Plan(number) => rows[0].push(views::plan(subject, number, settings)),
            Wanted::Roof => rows[0].push(views::roof_plan(subject, settings)),
            Wanted::Site => rows[0].push(views::site_plan(subject, settings)),
            Wanted::Elevation(side) => rows[1].push(views::elevation(subject, side, settings)),
            Wanted::Sections => {
                for plane in &settings.sections {
                    rows[2].push(views::section(subject, *plane, settings));
                }
            }
        }
    }
    rows.retain(|row| !row.is_empty());
    rows
}

/// Returns the numbers of the storeys of a subject; parapets have no plan.
pub fn storeys(subject: &Subject<'_>) -> Vec<u32> {
    let all = subject.houses.iter().flat_map(|b| &b.house.storeys);
    let storeys = all.filter(|s| s.kind == hsd_ir::ast::StoreyKind::Storey);
    let mut numbers: Vec<u32> = storeys.map(|s| s.number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Returns views on the smallest sheet that holds them; a single one on paper of its own size unless a sheet is named.
/// None if the largest sheet, or that which is named, is too small.
pub fn on_paper(rows: &[Vec<View>], paper: Option<Paper>, settings: &Settings) -> Option<Sheet> {
    match (paper, rows) {
        (Some(paper), _) => sheet::arranged(rows, paper, settings),
        (None, [row]) if row.len() == 1 => Some(sheet::single(&row[0], settings.scale)),
        (None, _) => Paper::ALL
            .into_iter()
            .find_map(|paper| sheet::arranged(rows, paper, settings)),
    }
}
