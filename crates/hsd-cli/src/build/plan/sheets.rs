//! The sheets of `hsd plan`: legends and plans, as they are opened and read.

use super::values::region_name;
use super::walls::WallSheet;
use super::{EDO_MA, Plan, SHAKU, name_of};
use crate::Failure;
use crate::files::output::Committer;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::source::{FileId, Source, Span};
use hsd_base::text;
use hsd_trace::messages::drawn as say;
use hsd_trace::plan::drawing::{self, Content, DrawnPlan, NoPlan, Unopened};
use hsd_trace::plan::flatten::{Flat, Given, Region, project};
use hsd_trace::plan::legend::Legend;
use hsd_trace::plan::vector::{self, lines::Lines, roles::Roles};
use hsd_trace::plan::walls;
use hsd_trace::plan::walls::scale::{Evidence, Scale};
use hsd_trace::plan::{self, Found, LEGENDS, Options, Picture, Stopped, said};
use std::path::Path;

/// Names in the comment of a house, the most.
const NAMED: usize = 12;

/// A sheet that was read.
pub(super) struct Sheet {
    /// The name of its file.
    pub(super) file: String,
    /// The plan on it.
    pub(super) found: Found,
    /// The place of messages about it.
    at: Span,
    /// Pixels of the file in one of the picture that was read.
    pub(super) shrink: f64,
    /// The lines of a drawing; an image has none.
    lines: Option<Lines>,
    /// Shaku in a unit of its grid, if it says so.
    pub(super) shaku: Option<f64>,
    /// Layers that stand for nothing.
    unknown: Vec<String>,
}

impl Sheet {
    /// Units of a pixel, or of a place in a drawing.
    pub(super) fn units_of(&self, place: DVec2) -> DVec2 {
        let back = self.found.flat.to_picture.inverse();
        let pixel = project(back, place / self.shrink);
        self.found.grid.units_of(pixel)
    }

    /// Where it comes from, for the comment of the house.
    pub(super) fn told(&self) -> String {
        let legend = &self.found.legend;
        let scale = self.found.flat.to_picture.transform_vector2(DVec2::X);
        let (unit, of) = match self.lines.is_some() {
            true => (
                self.found.grid.unit * scale.length(),
                "units of the drawing",
            ),
            false => (self.found.grid.unit * self.shrink, "pixels"),
        };
        let file = &self.file;
        let read =
            format!("Read by hsd plan from {file}: legend {legend}, half a ken is {unit:.1} {of}");
        let names: Vec<&str> = self
            .unknown
            .iter()
            .take(NAMED)
            .map(String::as_str)
            .collect();
        match names.is_empty() {
            true => read,
            false => format!("{read}; of no meaning to it: {}", names.join(", ")),
        }
    }
}

/// What the input files hold.
pub(super) enum Read {
    /// Plans, one a storey, on grids.
    Sheets(Vec<Sheet>),
    /// Plans, one a storey, that were read wall by wall.
    Walls(Vec<WallSheet>),
    /// A house that `hsd draw` had drawn: its text.
    House(String),
}

/// The plan of one storey.
enum Storey {
    Grid(Box<Sheet>),
    Walls(Box<WallSheet>),
}

impl Storey {
    fn flat(&self) -> &Flat {
        match self {
            Storey::Grid(sheet) => &sheet.found.flat,
            Storey::Walls(sheet) => &sheet.found.flat,
        }
    }

    /// Pixels of the file in one of the image that was read.
    fn shrink(&self) -> f64 {
        match self {
            Storey::Grid(sheet) => sheet.shrink,
            Storey::Walls(sheet) => sheet.shrink,
        }
    }

    /// Returns the plan read wall by wall; `None` if that gives no house.
    fn by_walls(self, plan: &Plan, roles: &Roles) -> Option<WallSheet> {
        let sheet = match self {
            Storey::Walls(sheet) => return Some(*sheet),
            Storey::Grid(sheet) => *sheet,
        };
        let found = match sheet.lines {
            Some(lines) => drawing::by_walls(lines, roles, plan.front.into())?,
            None => {
                let Found {
                    flat, ink, grid, ..
                } = &sheet.found;
                let options = Options {
                    metres: Some(plan.unit.unwrap_or(EDO_MA) * SHAKU / grid.unit),
                    ..Options::default()
                };
                let mut found = walls::found(flat, ink, &options)?;
                if !plan.has_unit() && found.scale.evidence == Evidence::Given {
                    found.scale.evidence = Evidence::HalfKen;
                }
                found
            }
        };
        Some(WallSheet {
            found,
            file: sheet.file,
            at: sheet.at,
            shrink: sheet.shrink,
        })
    }

    fn at(&self) -> Span {
        match self {
            Storey::Grid(sheet) => sheet.at,
            Storey::Walls(sheet) => sheet.at,
        }
    }
}

/// Legends of pictures, and of drawings.
pub(super) struct Legends {
    symbols: Vec<Legend>,
    roles: Roles,
}

impl Plan {
    /// The legends that were asked for, or all; drawings are read by those of CAD too.
    pub(super) fn legends(
        &self,
        committer: &Committer,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<Option<Legends>, Failure> {
        let known = |name: &str| LEGENDS.iter().find(|legend| legend.0 == name);
        let mut texts: Vec<(String, Vec<u8>)> = vec![];
        for name in self.legends.iter().filter(|name| *name != "cad") {
            let text = match known(name) {
                Some((_, text)) => text.as_bytes().to_vec(),
                None => {
                    committer.add_inputs([name]);
                    std::fs::read(name).map_err(|e| Failure::at(name, e))?
                }
            };
            texts.push((name.clone(), text));
        }
        let mut legends = Legends {
            symbols: vec![],
            roles: Roles::default(),
        };
        for (name, text) in texts {
            let source = Source::new(FileId(sources.len() as u32), name, &text);
            match Legend::read(source.text()) {
                Ok(legend) => legends.symbols.push(legend),
                Err(wrong) => out.push(say::legend(source.span(wrong.at.clone()), &wrong.what)),
            }
            match Roles::read(source.text()) {
                Ok(roles) => legends.roles = std::mem::take(&mut legends.roles).or(roles),
                // That is told already.
                Err(vector::Refused::NotXml { .. }) => {}
                Err(wrong) => out.push(said::drawing(&source, &wrong)),
            }
            sources.push(source);
        }
        // A legend may name layers alone.
        legends.symbols.retain(|legend| !legend.symbols.is_empty());
        if legends.symbols.is_empty() {
            let all = LEGENDS
                .iter()
                .filter_map(|(_, text)| Legend::read(text).ok());
            legends.symbols = all.collect();
        }
        if let Ok(cad) = Roles::read(vector::CAD) {
            legends.roles = legends.roles.or(cad);
        }
        Ok((!out.has_errors()).then_some(legends))
    }

    /// Reads all files; `None` if one of them has no plan.
    pub(super) fn sheets(
        &self,
        (legends, committer): (Option<&Legends>, &Committer),
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<Option<Read>, Failure> {
        let (mut storeys, mut tried) = (vec![], 0);
        let mut pages = self.pages.iter().copied().chain(std::iter::repeat(1));
        for (k, path) in self.inputs.iter().enumerate() {
            let (source, opened) = self.opened(path, sources.len(), &mut pages)?;
            let at = source.span(0..0);
            match (opened, legends) {
                (Err(why), _) => {
                    out.push(said::unopened(&source, &why));
                    tried += self.regions_of(k).len();
                }
                (Ok(Content::House(text)), _) if self.storeys() == 1 && self.regions.is_empty() => {
                    sources.push(source);
                    return Ok(Some(Read::House(text)));
                }
                (Ok(Content::House(_)), _) => {
                    out.push(say::whole_house(at));
                    tried += self.regions_of(k).len();
                }
                (Ok(content), Some(legends)) => {
                    for region in self.regions_of(k) {
                        match self.storey((&content, &source), region, legends)? {
                            Ok(storey) => {
                                let shrink = storey.shrink();
                                several(at, (storey.flat(), shrink, true), out);
                                storeys.push(storey);
                            }
                            Err((stopped, why)) => {
                                out.push(why);
                                if let Some(stopped) = &stopped {
                                    let shrink = content.shrink();
                                    several(at, (&stopped.flat, shrink, false), out);
                                }
                                let steps = self.steps_of_stopped(tried, stopped.as_deref())?;
                                committer.write_all(steps)?;
                            }
                        }
                        tried += 1;
                    }
                }
                // What is wrong with the legends is reported already.
                (Ok(_), None) => {}
            }
            sources.push(source);
        }
        match legends.filter(|_| storeys.len() == self.storeys()) {
            Some(legends) => Ok(self.together(storeys, &legends.roles, out)),
            None => Ok(None),
        }
    }

    /// Opens a file, whose place among all sources is given; of a PDF the next page that was asked for.
    fn opened(
        &self,
        path: &Path,
        number: usize,
        pages: &mut impl Iterator<Item = usize>,
    ) -> Result<(Source, Result<Content, Unopened>), Failure> {
        let bytes = std::fs::read(path).map_err(|e| Failure::at(path.display(), e))?;
        let page = match drawing::is_pdf(&bytes) {
            true => pages.next().unwrap_or(1),
            false => 1,
        };
        let opened = drawing::open(&bytes, page, self.memory_args.max_memory);
        // A diagnostic about an image has no position in its bytes.
        let is_text = matches!(opened, Ok(Content::Lines(_)) | Err(Unopened::Drawing(_)));
        let text = if is_text { &bytes[..] } else { b"" };
        let source = Source::new(FileId(number as u32), path.display().to_string(), text);
        Ok((source, opened))
    }

    /// Returns the boxes of the plans to read from a file; `None` is for all of it.
    fn regions_of(&self, input: usize) -> Vec<Option<Region>> {
        let regions = || self.regions.iter().copied().map(Some);
        match (self.inputs.len(), self.regions.len()) {
            (_, 0) => vec![None],
            (1, _) => regions().collect(),
            _ => regions().skip(input).take(1).collect(),
        }
    }

    /// Collects the storeys of a house, all read in the same way; `None` if one of them has no house.
    fn together(&self, storeys: Vec<Storey>, roles: &Roles, out: &mut Diagnostics) -> Option<Read> {
        let is_on_grid = |storey: &Storey| matches!(storey, Storey::Grid(_));
        if storeys.iter().all(is_on_grid) {
            let sheets = storeys.into_iter().filter_map(|storey| match storey {
                Storey::Grid(sheet) => Some(*sheet),
                Storey::Walls(_) => None,
            });
            return Some(Read::Sheets(sheets.collect()));
        }
        let mut sheets: Vec<WallSheet> = vec![];
        for storey in storeys {
            let at = storey.at();
            match storey.by_walls(self, roles) {
                Some(sheet) => sheets.push(sheet),
                None => out.push(say::not_by_walls(at)),
            }
        }
        share_scales(&mut sheets);
        (sheets.len() == self.storeys()).then_some(Read::Walls(sheets))
    }

    /// Reads the plan of a storey.
    #[expect(clippy::type_complexity, reason = "a reason with what was found")]
    fn storey(
        &self,
        (content, source): (&Content, &Source),
        region: Option<Region>,
        legends: &Legends,
    ) -> Result<Result<Storey, (Option<Box<Stopped>>, Diagnostic)>, Failure> {
        let file = (name_of(Path::new(source.name())), source.span(0..0));
        Ok(match content {
            Content::Picture(picture) => {
                let read = self.picture(picture, file, region, legends);
                read.map_err(|stopped| {
                    let why = said::refused(source.span(0..0), stopped.why);
                    (Some(stopped), why)
                })
            }
            Content::Lines(lines) => {
                self.is_for_drawings(&file.0)?;
                let read = self.drawing(lines.clone(), file, region, legends);
                read.map_err(|none| (none.stopped, said::drawing(source, &none.why)))
            }
            Content::House(_) => Err((None, say::whole_house(source.span(0..0)))),
        })
    }

    fn picture(
        &self,
        picture: &Picture,
        (file, at): (String, Span),
        region: Option<Region>,
        legends: &Legends,
    ) -> Result<Storey, Box<Stopped>> {
        let (shrink, options) = (picture.shrink, self.options(picture.shrink, region));
        let found = match self.legends.is_empty() {
            true => plan::read(picture, &legends.symbols, &options)?,
            false => plan::Plan::Grid(Box::new(plan::find(picture, &legends.symbols, &options)?)),
        };
        Ok(match found {
            plan::Plan::Grid(found) => Storey::Grid(Box::new(Sheet {
                found: *found,
                file,
                at,
                shrink,
                lines: None,
                shaku: None,
                unknown: vec![],
            })),
            plan::Plan::Walls(mut found) => {
                // `--unit-px` and `--ken` count half ken, whose length `--unit` sets.
                if found.scale.evidence == Evidence::Given {
                    found.scale.metres *= self.unit.unwrap_or(EDO_MA) / EDO_MA;
                }
                Storey::Walls(Box::new(WallSheet {
                    found: *found,
                    file,
                    at,
                    shrink,
                }))
            }
        })
    }

    /// Fails if something was given that only pictures have.
    fn is_for_drawings(&self, file: &str) -> Result<(), Failure> {
        let given = [
            ("--unit-px", self.unit_px.is_some()),
            ("--ken", self.ken.is_some()),
            ("--corners", self.corners.is_some()),
            ("--turn", self.turn.is_some()),
        ];
        let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given) else {
            return Ok(());
        };
        Err(Failure::Usage(text!([file, option]
            "`{option}` is for pictures, and {file} is a drawing; `--unit` sets the length of half a ken",
            "`{option}` は画像用で、{file} は線の図面です。半間の長さは `--unit` で指定してください"
        )))
    }

    fn drawing(
        &self,
        mut lines: Lines,
        (file, at): (String, Span),
        region: Option<Region>,
        legends: &Legends,
    ) -> Result<Storey, NoPlan> {
        if let Some(region) = region {
            lines.keep_within(region);
        }
        let unit_mm = self.unit.map(|shaku| shaku * SHAKU * 1000.0);
        let front = self.front.into();
        let (roles, symbols) = (&legends.roles, &legends.symbols);
        let drawn = match self.legends.is_empty() {
            true => drawing::read(lines.clone(), roles, unit_mm, symbols, front)?,
            false => {
                let drawn = drawing::find(lines.clone(), roles, unit_mm, symbols, front);
                let drawn = drawn.map_err(|why| NoPlan { why, stopped: None })?;
                DrawnPlan::Grid(Box::new(drawn))
            }
        };
        Ok(match drawn {
            DrawnPlan::Grid(drawn) => Storey::Grid(Box::new(Sheet {
                found: drawn.found,
                file,
                at,
                shrink: 1.0,
                lines: Some(lines),
                shaku: drawn.shaku,
                unknown: drawn.unknown,
            })),
            DrawnPlan::Walls(found) => Storey::Walls(Box::new(WallSheet {
                found: *found,
                file,
                at,
                shrink: 1.0,
            })),
        })
    }

    /// The options for a picture, in pixels of the reduced picture: `shrink` is how many pixels of the file one of its pixels covers.
    fn options(&self, shrink: f64, region: Option<Region>) -> Options {
        let unit = self.unit_px.or(self.ken.map(|ken| ken.unit));
        Options {
            given: Given {
                corners: self.corners.map(|c| c.map(|p| p / shrink)),
                turn: self.turn,
            },
            unit: unit.map(|u| u / shrink),
            metres: None,
            units: vec![],
            front: self.front.into(),
            region: region.map(|region| region.map(|p| p / shrink)),
        }
    }
}

/// Reports several plans on a sheet, one of which was read or none. `shrink` is the number of file pixels in a pixel of the image.
fn several(at: Span, (flat, shrink, is_read): (&Flat, f64, bool), out: &mut Diagnostics) {
    let regions = flat.plans.iter().map(|region| flat.in_picture(*region));
    let regions = regions.map(|region| region_name(region.map(|p| p * shrink)));
    let regions: Vec<String> = regions.collect();
    if !regions.is_empty() {
        out.push(say::several(at, &regions, is_read));
    }
}

/// Gives storeys of one file the surest of their scales. Their sheets may have pixels of different size.
fn share_scales(sheets: &mut [WallSheet]) {
    // Metres of a unit of the file.
    let of_file = |at: Span| {
        let scales = sheets.iter().filter(|sheet| sheet.at == at);
        let scales = scales.map(|sheet| Scale {
            metres: sheet.found.scale.metres / sheet.pixel(),
            ..sheet.found.scale
        });
        scales.reduce(Scale::surer)
    };
    let scales: Vec<Option<Scale>> = sheets.iter().map(|sheet| of_file(sheet.at)).collect();
    for (sheet, scale) in sheets.iter_mut().zip(scales) {
        if let Some(scale) = scale {
            sheet.found.scale = Scale {
                metres: scale.metres * sheet.pixel(),
                ..scale
            };
        }
    }
}
