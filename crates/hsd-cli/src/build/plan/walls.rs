//! A plan that was read wall by wall becomes a house.

use super::{Plan, QUALITY, name_of};
use crate::Failure;
use crate::files::output::Committer;
use crate::files::terminal::counted;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostics, Text, noun};
use hsd_base::source::{FileId, Source, Span};
use hsd_base::text;
use hsd_driver::fs::FolderWorld;
use hsd_driver::plan_file::{PlanFile, PlanSheet};
use hsd_scene::texture::{Packing, jpeg, png};
use hsd_trace::messages::drawn as say;
use hsd_trace::plan::again;
use hsd_trace::plan::flatten::project;
use hsd_trace::plan::house::Wanted;
use hsd_trace::plan::text::Era;
use hsd_trace::plan::walls::scale::Evidence;
use hsd_trace::plan::walls::writing::{self, Drawn, Storey, Traced};
use hsd_trace::plan::walls::{Found, pictures, stacked};
use std::path::PathBuf;

/// The share of a house that another on the sheet has to be to count as one.
const ANOTHER: f64 = 0.1;

/// A plan that was read wall by wall.
pub(super) struct WallSheet {
    /// The name of its file.
    pub(super) file: String,
    /// The place of messages about it.
    pub(super) at: Span,
    /// The plan.
    pub(super) found: Found,
    /// Pixels of the file in one of the image that was read.
    pub(super) shrink: f64,
}

impl WallSheet {
    /// Returns a place of the sheet in the original image, pixels.
    fn in_picture(&self, at: DVec2) -> (i64, i64) {
        let at = self.found.in_picture(at) * self.shrink;
        (at.x.round() as i64, at.y.round() as i64)
    }

    /// Returns the side of a pixel of the sheet, pixels of the file or units of a drawing.
    pub(super) fn pixel(&self) -> f64 {
        let flat = &self.found.flat;
        flat.to_picture.transform_vector2(DVec2::X).length() * self.shrink
    }

    /// Returns a place of the original image on the sheet, metres.
    fn metres_of(&self, place: DVec2) -> DVec2 {
        let back = self.found.flat.to_picture.inverse();
        project(back, place / self.shrink) * self.found.scale.metres
    }

    /// Returns the lines of the comment of a house about this storey.
    fn told(&self, drawn: &Drawn) -> [String; 2] {
        let size = self.found.size(drawn);
        let explained = (self.found.reading.explained * 100.0).round();
        [
            format!(
                "Read by hsd plan from {}, wall by wall: {explained} % of the ink of walls is explained",
                self.file
            ),
            format!(
                "{:.2} x {:.2} m, {:.1} m2, {}",
                size.x,
                size.y,
                drawn.area,
                evidence(self.found.scale.evidence)
            ),
        ]
    }
}

/// Returns the lines of the comment of a house.
fn told(sheets: &[WallSheet], traced: &Traced, heights: &[f64], era: Era) -> Vec<String> {
    let storeys = sheets.iter().zip(&traced.storeys);
    let mut lines: Vec<String> = storeys
        .flat_map(|(sheet, drawn)| sheet.told(drawn))
        .collect();
    lines.push(String::new());
    lines.push("A plan does not say these; they are usual and may be changed:".to_owned());
    let named: Vec<String> = heights.iter().map(f64::to_string).collect();
    let of = match heights.len() {
        1 => "height of the storey",
        _ => "heights of storeys",
    };
    lines.push(format!(
        "  {of}: {} shaku; roof: tiles, 4.5 sun",
        named.join(", ")
    ));
    lines.extend(era.lines().into_iter().map(|line| format!("  {line}")));
    lines.push("Walls that were read with doubt are named in a comment before their row: correct the row, then delete the comment.".to_owned());
    lines
}

/// Says what the size of a plan is from, in the comment of a house.
fn evidence(of: Evidence) -> String {
    match of {
        Evidence::Given => "as it was given".to_owned(),
        Evidence::Printed(count) => format!("from {count} printed dimensions"),
        Evidence::Rooms(count) => format!("from {count} printed sizes of rooms"),
        Evidence::Mats(count) => {
            format!("from {count} printed numbers of mats, 1.62 m2 each")
        }
        Evidence::Doors(count) => format!("if its {count} swinging doors are 0.85 m wide"),
        Evidence::Openings => "if its usual opening is 0.85 m wide".to_owned(),
        Evidence::Unit(mm) => format!("if a unit of the drawing is {mm} mm"),
        Evidence::HalfKen => "if its walls stand at quarters of a ken of 1.818 m".to_owned(),
    }
}

impl Plan {
    /// Writes the house of plans that were read wall by wall; says what was written.
    pub(super) fn write_walls(
        &self,
        (sheets, before): (&[WallSheet], Option<(String, String)>),
        committer: &Committer,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<Option<Text>, Failure> {
        let Some((traced, file)) = self.traced(sheets)? else {
            let era = Era::named(self.era.name());
            let has_house = |sheet: &&WallSheet| {
                let storey = sheet.found.storey(1.0);
                era.is_some_and(|era| writing::write(&[storey], ("", &[], era)).is_some())
            };
            let none = sheets.iter().find(|sheet| !has_house(sheet));
            none.into_iter()
                .for_each(|sheet| out.push(say::no_house(sheet.at)));
            return Ok(None);
        };
        for (k, (sheet, drawn)) in sheets.iter().zip(&traced.storeys).enumerate() {
            // Storeys of one file have one scale.
            let is_reported = sheets[..k].iter().any(|other| other.at == sheet.at);
            size(sheet, drawn, is_reported, out);
        }
        let merged = before.map(|(edited, before)| again::merged(&before, &edited, &traced.text));
        let is_as_read = merged.as_ref().is_none_or(|m| m.text == traced.text);
        let kept = merged.as_ref().map(|m| m.kept.clone()).unwrap_or_default();
        let text = merged.map_or_else(|| traced.text.clone(), |m| m.text);
        let id = FileId(sources.len() as u32);
        let source = Source::new(id, self.output.display().to_string(), text.as_bytes());
        let storeys = || sheets.iter().zip(&traced.storeys);
        let doubts =
            storeys().flat_map(|(sheet, drawn)| drawn.doubts.iter().map(move |d| (sheet, d)));
        for (sheet, (at, span)) in doubts.filter(|_| is_as_read) {
            let place = sheet.in_picture(*at);
            out.push(say::joined(source.span(span.clone()), &sheet.file, place));
        }
        kept.into_iter()
            .for_each(|place| out.push(say::kept(source.span(place))));
        let (world, options) = (FolderWorld::new(vec![], 0), hsd_driver::Options::default());
        hsd_driver::check(&[&source], &world, &options, out);
        sources.push(source);
        let mut files = file;
        files.push((self.output.clone(), text.into_bytes()));
        committer.write_all(files)?;
        let name = self.output.display();
        let rooms = sheets.iter().map(|sheet| sheet.found.reading.rooms()).sum();
        let rooms = counted(rooms, noun("room", "部屋{}室"));
        let doubts = traced.storeys.iter().map(|drawn| drawn.doubts.len()).sum();
        let doubts = counted(doubts, noun("doubtful wall", "確かでない壁{}か所"));
        Ok(Some(text!([name, rooms, doubts]
            "{name}: {rooms}, {doubts}; `hsd view {name}` shows it over the plan, `hsd build {name} -o OUT.glb` builds it",
            "{name}: {rooms}、{doubts}。`hsd view {name}` で図面に重ねて確かめ、`hsd build {name} -o OUT.glb` で作れます"
        )))
    }

    /// Returns the shift that places each storey on the ground storey: to the right and down, metres.
    fn stacked(&self, sheets: &[WallSheet]) -> Vec<DVec2> {
        let plan =
            |sheet: &WallSheet| (sheet.found.reading.graph.clone(), sheet.found.scale.metres);
        let Some((ground, upper)) = sheets.split_first() else {
            return vec![];
        };
        let (below, metres) = plan(ground);
        let shift = |(k, sheet): (usize, &WallSheet)| match self.registered.get(k) {
            Some(same) => ground.metres_of(same.ground) - sheet.metres_of(same.upper),
            None => {
                let (above, of_above) = plan(sheet);
                stacked::register((&below, metres), (&above, of_above))
            }
        };
        let upper = upper.iter().enumerate().map(shift);
        std::iter::once(DVec2::ZERO).chain(upper).collect()
    }

    /// Writes the text of a house, and the files beside it.
    #[expect(clippy::type_complexity, reason = "files as the committer takes them")]
    fn traced(
        &self,
        sheets: &[WallSheet],
    ) -> Result<Option<(Traced, Vec<(PathBuf, Vec<u8>)>)>, Failure> {
        let Some(era) = Era::named(self.era.name()) else {
            return Ok(None);
        };
        let wanted = Wanted {
            name: String::new(),
            era,
            heights: self.heights.clone(),
            unit: None,
            shifts: vec![],
        };
        let heights = wanted.heights(sheets.len());
        let shifts = self.stacked(sheets);
        let all = sheets.iter().zip(&heights).zip(&shifts);
        let storeys: Vec<Storey<'_>> = all
            .map(|((sheet, height), shift)| Storey {
                shift: *shift,
                ..sheet.found.storey(*height)
            })
            .collect();
        let name = self
            .output
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy();
        let write = |lines: &[String]| writing::write(&storeys, (&name, lines, era));
        let first = write(&[]);
        let Some(traced) = first.and_then(|first| write(&told(sheets, &first, &heights, era)))
        else {
            return Ok(None);
        };
        let (mut files, mut kept) = (vec![], vec![]);
        for (k, (sheet, drawn)) in sheets.iter().zip(&traced.storeys).enumerate() {
            let found = &sheet.found;
            let (under, to_house) = pictures::underlay(found, drawn);
            let path = self.sheet_path(k + 1);
            kept.push(PlanSheet {
                storey: k as u32 + 1,
                picture: name_of(&path),
                to_house,
            });
            let doubts: Vec<DVec2> = drawn.doubts.iter().map(|doubt| doubt.0).collect();
            let review = pictures::review(&found.flat, &found.reading, &doubts);
            files.push((path, jpeg(&under, QUALITY)));
            files.push((self.review_path(k + 1), png(&review, Packing::Quick)));
            files.extend(self.step_files(k, "", || pictures::steps(&found.flat, &found.reading))?);
        }
        let record = PlanFile::new(kept, traced.text.clone());
        files.push((self.beside("plan.json"), record.json().into_bytes()));
        Ok(Some((traced, files)))
    }
}

/// Reports a size that was assumed, unless that is done already, and houses that were left out.
fn size(sheet: &WallSheet, drawn: &Drawn, is_reported: bool, out: &mut Diagnostics) {
    let by = match sheet.found.scale.evidence {
        Evidence::Given | Evidence::Printed(_) | Evidence::Rooms(_) => None,
        Evidence::Mats(count) => Some(text!([count]
            "{count} printed numbers of mats, at 1.62 m2 each,",
            "部屋に書かれた {count} か所の畳数を、一畳 1.62 m² と見て、そこ"
        )),
        Evidence::Doors(count) => Some(text!([count]
            "its {count} swinging doors, if they are 0.85 m wide,",
            "開き戸 {count} か所の幅を 0.85 m と見て、そこ"
        )),
        Evidence::Openings => Some(text!(
            "its usual openings, if they are 0.85 m wide,",
            "よくある開口の幅を 0.85 m と見て、そこ"
        )),
        Evidence::Unit(mm) => Some(text!([mm]
            "its lines, if a unit of the drawing is {mm} mm,",
            "図面の一単位を {mm} mm と見ると壁の厚さが合うので、そこ"
        )),
        Evidence::HalfKen => Some(text!(
            "its walls, if they stand at quarters of a ken of 1.818 m,",
            "壁が1間 1.818 m の四分の一ごとに立つと見て、そこ"
        )),
    };
    if let Some(by) = by.filter(|_| !is_reported) {
        let size = sheet.found.size(drawn).to_array();
        out.push(say::assumed_size(sheet.at, by, size));
    }
    if drawn.apart > ANOTHER * drawn.area {
        out.push(say::left_out(sheet.at, drawn.apart));
    }
}
