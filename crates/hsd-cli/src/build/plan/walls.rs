//! A plan that was read wall by wall becomes a house.

use super::{Plan, QUALITY, name_of};
use crate::Failure;
use crate::files::output::Committer;
use crate::files::terminal::counted;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostics, Text, noun};
use hsd_base::source::{FileId, Source};
use hsd_base::text;
use hsd_driver::fs::FolderWorld;
use hsd_driver::plan_file::{PlanFile, PlanSheet};
use hsd_scene::texture::{Packing, jpeg, png};
use hsd_trace::messages::drawn as say;
use hsd_trace::plan::again;
use hsd_trace::plan::house::Wanted;
use hsd_trace::plan::text::Era;
use hsd_trace::plan::walls::scale::Evidence;
use hsd_trace::plan::walls::writing::{self, Traced};
use hsd_trace::plan::walls::{Found, pictures};
use std::path::PathBuf;

/// The share of a house that another on the sheet has to be to count as one.
const ANOTHER: f64 = 0.1;

/// A plan that was read wall by wall.
pub(super) struct WallSheet {
    /// The name of its file.
    pub(super) file: String,
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

    /// Returns the lines of the comment of a house.
    fn told(&self, traced: &Traced, height: f64, era: Era) -> Vec<String> {
        let size = self.found.size(traced);
        let explained = (self.found.reading.explained * 100.0).round();
        let mut lines = vec![
            format!(
                "Read by hsd plan from {}, wall by wall: {explained} % of the ink of walls is explained",
                self.file
            ),
            format!(
                "{:.2} x {:.2} m, {:.1} m2, {}",
                size.x,
                size.y,
                traced.area,
                evidence(self.found.scale.evidence)
            ),
            String::new(),
            "A plan does not say these; they are usual and may be changed:".to_owned(),
            format!("  height of the storey: {height} shaku; roof: tiles, 4.5 sun"),
        ];
        lines.extend(era.lines().into_iter().map(|line| format!("  {line}")));
        lines.push("Walls that were read with doubt are named in a comment before their row: correct the row, then delete the comment.".to_owned());
        lines
    }
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
    /// Writes the house of a plan that was read wall by wall; says what was written.
    pub(super) fn write_walls(
        &self,
        (sheet, before): (&WallSheet, Option<(String, String)>),
        committer: &Committer,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<Option<Text>, Failure> {
        let picture = sources.last().map(|source| source.span(0..0));
        let Some((traced, file)) = self.traced(sheet)? else {
            picture
                .into_iter()
                .for_each(|at| out.push(say::no_house(at)));
            return Ok(None);
        };
        if let Some(at) = picture {
            self.size(sheet, &traced, at, out);
        }
        let merged = before.map(|(edited, before)| again::merged(&before, &edited, &traced.text));
        let is_as_read = merged.as_ref().is_none_or(|m| m.text == traced.text);
        let kept = merged.as_ref().map(|m| m.kept.clone()).unwrap_or_default();
        let text = merged.map_or_else(|| traced.text.clone(), |m| m.text);
        let id = FileId(sources.len() as u32);
        let source = Source::new(id, self.output.display().to_string(), text.as_bytes());
        for (at, span) in traced.doubts.iter().filter(|_| is_as_read) {
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
        let rooms = counted(sheet.found.reading.rooms(), noun("room", "部屋{}室"));
        let doubts = counted(
            traced.doubts.len(),
            noun("doubtful wall", "確かでない壁{}か所"),
        );
        Ok(Some(text!([name, rooms, doubts]
            "{name}: {rooms}, {doubts}; `hsd view {name}` shows it over the plan, `hsd build {name} -o OUT.glb` builds it",
            "{name}: {rooms}、{doubts}。`hsd view {name}` で図面に重ねて確かめ、`hsd build {name} -o OUT.glb` で作れます"
        )))
    }

    /// Writes the text of a house, and the files beside it.
    #[expect(clippy::type_complexity, reason = "files as the committer takes them")]
    fn traced(
        &self,
        sheet: &WallSheet,
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
        let height = wanted.heights(1)[0];
        let found = &sheet.found;
        let name = self
            .output
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy();
        let (divided, graph, metres) = (
            &found.reading.divided,
            &found.reading.graph,
            found.scale.metres,
        );
        let write = |lines: &[String]| {
            writing::write((divided, graph), metres, (&name, lines, height, era))
        };
        let first = write(&[]);
        let Some(traced) = first.and_then(|first| write(&sheet.told(&first, height, era))) else {
            return Ok(None);
        };
        let (under, to_house) = pictures::underlay(found, &traced);
        let path = self.sheet_path(1);
        let kept = PlanSheet {
            storey: 1,
            picture: name_of(&path),
            to_house,
        };
        let doubts: Vec<DVec2> = traced.doubts.iter().map(|doubt| doubt.0).collect();
        let mut files = vec![
            (path, jpeg(&under, QUALITY)),
            (
                self.review_path(1),
                png(
                    &pictures::review(&found.flat, &found.reading, &doubts),
                    Packing::Quick,
                ),
            ),
        ];
        files.extend(self.step_files(0, "", || pictures::steps(&found.flat, &found.reading))?);
        let record = PlanFile::new(vec![kept], traced.text.clone());
        files.push((self.beside("plan.json"), record.json().into_bytes()));
        Ok(Some((traced, files)))
    }

    /// Reports a size that was assumed, and houses that were left out.
    fn size(
        &self,
        sheet: &WallSheet,
        traced: &Traced,
        at: hsd_base::source::Span,
        out: &mut Diagnostics,
    ) {
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
        if let Some(by) = by {
            out.push(say::assumed_size(
                at,
                by,
                sheet.found.size(traced).to_array(),
            ));
        }
        if traced.apart > ANOTHER * traced.area {
            out.push(say::left_out(at, traced.apart));
        }
    }
}
