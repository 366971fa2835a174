//! `hsd plan`: drawn floor plans become a house.

use crate::files::output::Committer;
use crate::files::terminal::counted;
use crate::options::{MemoryArgs, report};
use crate::{Exit, Failure, Outcome};
use clap::Args;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostics, Language, noun};
use hsd_base::source::{FileId, Source};
use hsd_base::text;
use hsd_driver::fs::FolderWorld;
use hsd_driver::plan_file::{PlanFile, PlanSheet};
use hsd_report::{Format, Report};
use hsd_scene::texture::{Packing, jpeg, png};
use hsd_trace::messages::drawn as say;
use hsd_trace::plan::flatten::Region;
use hsd_trace::plan::house::{self, House, Wanted};
use hsd_trace::plan::text::{Doubt, Era, Written};
use hsd_trace::plan::walls::pictures;
use hsd_trace::plan::{Stopped, again, marks, said, underlay};
use image::RgbImage;
use sheets::{Read, Sheet};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use values::{EraArg, Ken, Same, Side};

mod sheets;
mod walls;
pub(super) mod values;

/// Metres in a shaku.
const SHAKU: f64 = 10.0 / 33.0;
/// Shaku in half a ken where nothing else is said.
const EDO_MA: f64 = 3.0;
/// Quality of the plan that is shown under the house, 1 to 100.
const QUALITY: u8 = 75;

/// Turn pictures and drawings of floor plans into a house file.
///
/// Reads survey drawings, Edo sashizu and carpenters' board plans that were photographed or scanned, and drawings in SVG, DXF or
/// PDF: one file a storey, from the ground up. A plan that keeps to no grid of half ken is read wall by wall. What is not
/// certain is named in the text at its wall, ringed in OUT.review.png and reported. OUT.plan.json and OUT.sheet-1.jpg beside it
/// are for `hsd view`, which shows the plan under the house. An OUT that was read before and changed by hand keeps its changes.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd plan scan.jpg -o house.hsd                                      read the plan of one storey
  hsd plan ground.png upper.png -o house.hsd --unit kyo-ma            read two storeys; half a ken is 3.25 shaku
  hsd plan sheet.png -o house.hsd --region \"40,60 900,700\" --region \"950,60 1800,700\"
  hsd plan photo.jpg -o house.hsd --corners \"80,60 900,70 880,1240 90,1220\"
  hsd plan plan.dxf -o house.hsd                                      read a drawing by its layers and blocks
  hsd plan scan.jpg -o house.hsd --steps steps/                       also draw what each step has found")]
pub(crate) struct Plan {
    /// Plans, one a storey, from the ground up: PNG, JPEG, TIFF, WebP, SVG, DXF or PDF.
    #[arg(required = true, value_name = "IN")]
    inputs: Vec<PathBuf>,

    /// Write the house to this file.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,

    /// Read by this legend: survey, sashizu, itazu, cad, or a file; repeatable [default: the one that agrees best].
    #[arg(long = "legend", value_name = "NAME|FILE")]
    legends: Vec<String>,

    /// Set the length of half a ken in the picture, pixels.
    #[arg(long, value_name = "N", value_parser = values::pixels, conflicts_with = "ken")]
    unit_px: Option<f64>,

    /// Set the scale by two points of the picture and the ken between them.
    #[arg(long, value_name = "\"X,Y X,Y N\"", value_parser = values::ken)]
    ken: Option<Ken>,

    /// Read this page of a PDF; once for each PDF [default: 1].
    #[arg(long = "page", value_name = "N", value_parser = values::page)]
    pages: Vec<usize>,

    /// Set the corners of the sheet in the picture, pixels, clockwise from the upper left.
    #[arg(long, value_name = "\"X,Y X,Y X,Y X,Y\"", value_parser = values::corners)]
    corners: Option<[DVec2; 4]>,

    /// Read only the plan in this box, given by two corners; repeat it for the storeys on one sheet, the ground storey first.
    #[arg(long = "region", value_name = "\"X,Y X,Y\"", value_parser = values::region, allow_hyphen_values = true)]
    regions: Vec<Region>,

    /// Set how far the picture is turned, degrees clockwise.
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = values::degrees)]
    turn: Option<f64>,

    /// Set the side of the sheet where the street is.
    #[arg(long, value_enum, value_name = "SIDE", default_value = "bottom")]
    front: Side,

    /// Lay a further storey so that two points meet: one of the first picture, and the same of the further one; once for each
    /// further picture.
    #[arg(long = "register", value_name = "X,Y=X,Y", value_parser = values::same)]
    registered: Vec<Same>,

    /// Choose the parts that stand for walls, doors and windows.
    #[arg(long, value_enum, value_name = "ERA", default_value = "edo")]
    era: EraArg,

    /// Set the length of half a ken: edo-ma (3 shaku), kyo-ma (3.25), or a number of shaku [default: as a drawing says, else edo-ma].
    #[arg(long, value_name = "UNIT", value_parser = values::unit)]
    unit: Option<f64>,

    /// Set the height of a storey in shaku; once for each storey, from the ground up.
    #[arg(long = "height", value_name = "SHAKU", value_parser = values::height)]
    heights: Vec<f64>,

    /// Draw what each step has found into this folder.
    #[arg(long, value_name = "DIR")]
    steps: Option<PathBuf>,

    /// Replace a house that was changed by hand, or that was not read from a plan.
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    memory_args: MemoryArgs,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

impl Plan {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        let before = self.before()?;
        let mut out = Diagnostics::new();
        let mut sources = vec![];
        let committer = self.committer();
        let legends = self.legends(&committer, &mut sources, &mut out)?;
        committer.check(self.outputs())?;
        self.check_regions()?;
        let mut told = None;
        match self.sheets((legends.as_ref(), &committer), &mut sources, &mut out)? {
            Some(Read::Sheets(sheets)) => match self.house(&sheets) {
                Some(house) => {
                    let read = (&house, &*sheets, before);
                    told = Some(self.write(read, &committer, &mut sources, &mut out)?);
                }
                None => {
                    let sheet = sources.last().map(|source| source.span(0..0));
                    sheet.into_iter().for_each(|at| out.push(say::no_house(at)));
                }
            },
            Some(Read::Walls(sheets)) => {
                told = self.write_walls((&sheets, before), &committer, &mut sources, &mut out)?;
            }
            Some(Read::House(text)) => {
                told = Some(self.write_drawn(text, &committer, &mut sources, &mut out)?)
            }
            None => {}
        }
        let failed = out.has_errors();
        let list = out.into_sorted();
        if !list.is_empty() {
            let written = Report::new(&sources, &list).in_language(language);
            report(&written, Format::Human, &mut io::stderr())?;
        }
        if let Some(told) = told.filter(|_| !self.quiet) {
            writeln!(io::stderr(), "{}", told.in_language(language))?;
        }
        Ok(if failed { Exit::Errors } else { Exit::Done })
    }

    /// Returns the number of storeys that were asked for.
    fn storeys(&self) -> usize {
        self.inputs.len().max(self.regions.len())
    }

    /// Returns true if the length of half a ken was given, in the image or in shaku.
    fn has_unit(&self) -> bool {
        self.unit.is_some() || self.unit_px.is_some() || self.ken.is_some()
    }

    /// Fails unless boxes of plans are for one file, or one for each.
    fn check_regions(&self) -> Result<(), Failure> {
        let (files, boxes) = (self.inputs.len(), self.regions.len());
        if boxes == 0 || files == 1 || boxes == files {
            return Ok(());
        }
        Err(Failure::Usage(text!([boxes, files]
            "`--region` is given {boxes} times for {files} files; give it once for each file, or several times for one file",
            "`--region` が {boxes} 個、ファイルが {files} 個あります。ファイルごとに一つずつか、一つのファイルに複数を指定してください"
        )))
    }

    /// Returns the committer of a run, which knows the plans.
    fn committer(&self) -> Committer {
        let committer = Committer::reading(&self.inputs);
        match self.steps {
            Some(_) => committer.named_by("-o, --steps"),
            None => committer,
        }
    }

    /// Returns the outputs whose names are known before a plan is read.
    fn outputs(&self) -> Vec<PathBuf> {
        let storeys = 1..=self.storeys();
        let sheets = storeys.map(|storey| [self.sheet_path(storey), self.review_path(storey)]);
        let house = [self.output.clone(), self.beside("plan.json")];
        house.into_iter().chain(sheets.flatten()).collect()
    }

    /// Returns the path of the image of a storey for `hsd view`, counted from 1.
    fn sheet_path(&self, storey: usize) -> PathBuf {
        self.beside(&format!("sheet-{storey}.jpg"))
    }

    /// Returns the path of the image of a storey with its doubts, counted from 1.
    fn review_path(&self, storey: usize) -> PathBuf {
        match self.storeys() {
            1 => self.beside("review.png"),
            _ => self.beside(&format!("review-{storey}.png")),
        }
    }

    /// The text that is there, and what it was when it was read; fails if nothing says so.
    fn before(&self) -> Result<Option<(String, String)>, Failure> {
        if self.force || !self.output.exists() {
            return Ok(None);
        }
        let text = std::fs::read_to_string(&self.output).ok();
        let read = std::fs::read_to_string(self.beside("plan.json"))
            .ok()
            .and_then(|json| PlanFile::parse(&json)?.read);
        match text.zip(read) {
            Some(before) => Ok(Some(before)),
            None => {
                let name = self.output.display();
                Err(Failure::Usage(text!([name]
                    "{name} exists, and no plan.json beside it says what was read; `--force` replaces it",
                    "{name} はすでにあり、読んだときの記録 (plan.json) がありません。置き換えるなら `--force` を付けてください"
                )))
            }
        }
    }

    /// The house of some sheets.
    fn house(&self, sheets: &[Sheet]) -> Option<House> {
        let shapes: Vec<_> = sheets.iter().map(|s| &s.found.shape).collect();
        let ground = sheets.first()?;
        let shifts = sheets.iter().skip(1).zip(
            self.registered
                .iter()
                .map(Some)
                .chain(std::iter::repeat(None)),
        );
        let shifts = shifts.map(|(upper, same)| {
            let by = ground.units_of(same?.ground) - upper.units_of(same?.upper);
            Some((by.x.round() as i32, by.y.round() as i32))
        });
        let wanted = Wanted {
            name: self
                .output
                .file_stem()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            era: Era::named(self.era.name())?,
            heights: self.heights.clone(),
            unit: Some(self.shaku(sheets)).filter(|unit| *unit != EDO_MA),
            shifts: shifts.collect(),
        };
        let told: Vec<String> = sheets.iter().map(Sheet::told).collect();
        house::write(&shapes, &told, &wanted)
    }

    /// Shaku in half a ken.
    fn shaku(&self, sheets: &[Sheet]) -> f64 {
        let told = || sheets.iter().find_map(|sheet| sheet.shaku);
        self.unit.or_else(told).unwrap_or(EDO_MA)
    }

    /// Writes the house and what is beside it; says what was written.
    fn write(
        &self,
        (house, sheets, before): (&House, &[Sheet], Option<(String, String)>),
        committer: &Committer,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<hsd_base::diagnostic::Text, Failure> {
        let read = &house.written;
        let merged = before.map(|(edited, before)| again::merged(&before, &edited, &read.text));
        let kept = merged.as_ref().map(|m| m.kept.clone()).unwrap_or_default();
        let text = merged.map_or_else(|| read.text.clone(), |m| m.text);
        let source = Source::new(
            FileId(sources.len() as u32),
            self.output.display().to_string(),
            text.as_bytes(),
        );
        let doubts = self.doubts(read, sheets, &source, out);
        for place in kept {
            out.push(say::kept(source.span(place)));
        }
        hsd_driver::check(
            &[&source],
            &FolderWorld::new(vec![], 0),
            &hsd_driver::Options::default(),
            out,
        );
        sources.push(source);
        committer.write_all(self.files(house, sheets, text)?)?;
        let (name, rooms) = (
            self.output.display(),
            sheets.iter().map(|s| s.found.shape.rooms.len()).sum(),
        );
        let rooms = counted(rooms, noun("room", "部屋{}室"));
        let doubts = counted(doubts, noun("doubtful wall", "確かでない壁{}か所"));
        Ok(text!([name, rooms, doubts]
            "{name}: {rooms}, {doubts}; `hsd view {name}` shows it over the plan, `hsd build {name} -o OUT.glb` builds it",
            "{name}: {rooms}、{doubts}。`hsd view {name}` で図面に重ねて確かめ、`hsd build {name} -o OUT.glb` で作れます"
        ))
    }

    /// Writes the house of a drawing of `hsd draw` as it was; says what was written.
    fn write_drawn(
        &self,
        text: String,
        committer: &Committer,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<hsd_base::diagnostic::Text, Failure> {
        let name = self.output.display();
        let id = FileId(sources.len() as u32);
        let source = Source::new(id, name.to_string(), text.as_bytes());
        let (world, options) = (FolderWorld::new(vec![], 0), hsd_driver::Options::default());
        hsd_driver::check(&[&source], &world, &options, out);
        sources.push(source);
        committer.write_all(vec![(self.output.clone(), text.into_bytes())])?;
        Ok(text!([name]
            "{name}: the house as `hsd draw` had drawn it; `hsd build {name} -o OUT.glb` builds it",
            "{name}: `hsd draw` が描いた家に戻しました。`hsd build {name} -o OUT.glb` で作れます"
        ))
    }

    /// Says which walls are in doubt, those of one row that follow each other and were read alike together; returns how many
    /// such walls there are.
    fn doubts(
        &self,
        read: &Written,
        sheets: &[Sheet],
        source: &Source,
        out: &mut Diagnostics,
    ) -> usize {
        let follows = |a: &Doubt, b: &Doubt| {
            let between = read.text.get(a.span.end..b.span.start);
            let alike = (a.role, a.is_joined, a.storey) == (b.role, b.is_joined, b.storey);
            alike && between.is_some_and(|t| t.len() <= 2 && !t.contains('<'))
        };
        let runs = read.doubts.chunk_by(follows);
        let mut count = 0;
        for run in runs {
            let places: Vec<Range<usize>> = run
                .iter()
                .filter_map(|d| place(d, &read.text, source.text()))
                .collect();
            let (Some(first), Some(last), [doubt, ..]) = (places.first(), places.last(), run)
            else {
                continue;
            };
            let sheet = &sheets[doubt.storey];
            let middle = run.iter().map(|d| d.at).sum::<DVec2>() / run.len() as f64;
            let at = sheet.found.in_picture(middle) * sheet.shrink;
            out.push(said::doubt(
                source.span(first.start..last.end),
                doubt,
                &sheet.file,
                at,
            ));
            count += 1;
        }
        count
    }

    /// All files, with their paths.
    fn files(
        &self,
        house: &House,
        sheets: &[Sheet],
        text: String,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        let mut files = vec![];
        let mut kept = vec![];
        let metres = self.shaku(sheets) * SHAKU;
        for (k, (sheet, shift)) in sheets.iter().zip(&house.shifts).enumerate() {
            let (origin, storey) = (house.written.origin, k + 1);
            let (flat, to_house) = underlay::draw(
                &sheet.found,
                (origin.0 - shift.0, origin.1 - shift.1),
                metres,
            );
            let path = self.sheet_path(storey);
            kept.push(PlanSheet {
                storey: storey as u32,
                picture: name_of(&path),
                to_house,
            });
            files.push((path, jpeg(&flat, QUALITY)));
            let doubts: Vec<DVec2> = house
                .written
                .doubts
                .iter()
                .filter(|d| d.storey == k)
                .map(|d| d.at)
                .collect();
            files.push((
                self.review_path(storey),
                png(&marks::review(&sheet.found, &doubts), Packing::Quick),
            ));
            files.extend(self.steps(k, (&sheet.found).into())?);
        }
        let file = PlanFile::new(kept, house.written.text.clone());
        files.push((self.beside("plan.json"), file.json().into_bytes()));
        files.push((self.output.clone(), text.into_bytes()));
        Ok(files)
    }

    /// Pictures of what the steps have found on a sheet, where they are asked for, with their paths.
    fn steps(
        &self,
        sheet: usize,
        seen: marks::Seen<'_>,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        self.step_files(sheet, "", || marks::steps(seen))
    }

    /// Returns the images of what the steps found on a sheet without a plan, if they are asked for, with their paths.
    fn steps_of_stopped(
        &self,
        sheet: usize,
        stopped: Option<&Stopped>,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        let Some(stopped) = stopped else {
            return Ok(vec![]);
        };
        let mut files = self.steps(sheet, stopped.into())?;
        if let Some(reading) = &stopped.reading {
            let steps = || pictures::steps(&stopped.flat, reading);
            files.extend(self.step_files(sheet, "walls-", steps)?);
        }
        Ok(files)
    }

    /// Returns images of steps, if they are asked for, with their paths.
    fn step_files(
        &self,
        sheet: usize,
        prefix: &str,
        pictures: impl FnOnce() -> Vec<(&'static str, RgbImage)>,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        let Some(folder) = &self.steps else {
            return Ok(vec![]);
        };
        std::fs::create_dir_all(folder).map_err(|e| Failure::at(folder.display(), e))?;
        let named = |name: &str| match self.storeys() {
            1 => format!("{prefix}{name}"),
            _ => format!("{}-{prefix}{name}", sheet + 1),
        };
        let pictures = pictures().into_iter();
        Ok(pictures
            .map(|(name, picture)| (folder.join(named(name)), png(&picture, Packing::Quick)))
            .collect())
    }

    /// A file beside the house: its name with another ending.
    fn beside(&self, ending: &str) -> PathBuf {
        self.output.with_extension(ending)
    }
}

/// Where a doubt is in a text: at its part if the text is as it was read, otherwise at its entry in the comment, if that is
/// still there.
fn place(doubt: &Doubt, read: &str, text: &str) -> Option<Range<usize>> {
    if read == text {
        return Some(doubt.span.clone());
    }
    let start = text.find(&doubt.entry)?;
    Some(start..start + doubt.entry.len())
}

fn name_of(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
