//! The sheets of `hsd plan`: legends and plans, as they are opened and read.

use super::walls::WallSheet;
use super::{EDO_MA, Plan, SHAKU, name_of};
use crate::Failure;
use crate::files::output::Committer;
use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{FileId, Source};
use hsd_base::text;
use hsd_trace::messages::drawn as say;
use hsd_trace::plan::drawing::{self, Content, DrawnPlan, NoPlan, Unopened};
use hsd_trace::plan::flatten::{Given, project};
use hsd_trace::plan::legend::Legend;
use hsd_trace::plan::vector::{self, lines::Lines, roles::Roles};
use hsd_trace::plan::walls::scale::Evidence;
use hsd_trace::plan::{self, Found, LEGENDS, Options, Picture, Stopped, said};

/// Names in the comment of a house, the most.
const NAMED: usize = 12;

/// A sheet that was read.
pub(super) struct Sheet {
    /// The name of its file.
    pub(super) file: String,
    /// The plan on it.
    pub(super) found: Found,
    /// Pixels of the file in one of the picture that was read.
    pub(super) shrink: f64,
    /// Whether it is a drawing, not a picture.
    is_drawing: bool,
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
        let (unit, of) = match self.is_drawing {
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
    /// Plans, one a storey.
    Sheets(Vec<Sheet>),
    /// A plan that was read wall by wall.
    Walls(Box<WallSheet>),
    /// A house that `hsd draw` had drawn: its text.
    House(String),
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
        let mut sheets = vec![];
        let mut pages = self.pages.iter().copied().chain(std::iter::repeat(1));
        for (k, path) in self.inputs.iter().enumerate() {
            let bytes = std::fs::read(path).map_err(|e| Failure::at(path.display(), e))?;
            let page = match drawing::is_pdf(&bytes) {
                true => pages.next().unwrap_or(1),
                false => 1,
            };
            let opened = drawing::open(&bytes, page, self.memory_args.max_memory);
            // What is told of a picture has no place in its bytes.
            let is_text = matches!(opened, Ok(Content::Lines(_)) | Err(Unopened::Drawing(_)));
            let text = if is_text { &bytes[..] } else { b"" };
            let number = FileId(sources.len() as u32);
            let source = Source::new(number, path.display().to_string(), text);
            let file = name_of(path);
            let read = match (opened, legends) {
                (Err(why), _) => Err((None, said::unopened(&source, &why))),
                (Ok(Content::House(text)), _) if self.inputs.len() == 1 => Ok(Read::House(text)),
                (Ok(Content::House(_)), _) => Err((None, say::whole_house(source.span(0..0)))),
                // What is wrong with the legends is reported already.
                (Ok(_), None) => Ok(Read::Sheets(vec![])),
                (Ok(Content::Picture(picture)), Some(legends)) => {
                    let read = self.picture(&picture, file, legends);
                    read.map_err(|stopped| {
                        let why = said::refused(source.span(0..0), stopped.why);
                        (Some(stopped), why)
                    })
                }
                (Ok(Content::Lines(lines)), Some(legends)) => {
                    self.is_for_drawings(&file)?;
                    let read = self.drawing(lines, file, legends);
                    read.map_err(|none| (none.stopped, said::drawing(&source, &none.why)))
                }
            };
            sources.push(source);
            match read {
                Ok(Read::Sheets(read)) => sheets.extend(read),
                Ok(whole) => return Ok(Some(whole)),
                Err((stopped, why)) => {
                    committer.write_all(self.steps_of_stopped(k, stopped.as_deref())?)?;
                    out.push(why);
                }
            }
        }
        Ok((sheets.len() == self.inputs.len()).then_some(Read::Sheets(sheets)))
    }

    fn picture(
        &self,
        picture: &Picture,
        file: String,
        legends: &Legends,
    ) -> Result<Read, Box<Stopped>> {
        let (shrink, options) = (picture.shrink, self.options(picture.shrink));
        // Storeys are laid over each other on their grids.
        let found = match self.inputs.len() {
            1 if self.legends.is_empty() => plan::read(picture, &legends.symbols, &options)?,
            _ => plan::Plan::Grid(Box::new(plan::find(picture, &legends.symbols, &options)?)),
        };
        Ok(match found {
            plan::Plan::Grid(found) => Read::Sheets(vec![Sheet {
                found: *found,
                file,
                shrink,
                is_drawing: false,
                shaku: None,
                unknown: vec![],
            }]),
            plan::Plan::Walls(mut found) => {
                // `--unit-px` and `--ken` count half ken, whose length `--unit` sets.
                if found.scale.evidence == Evidence::Given {
                    found.scale.metres *= self.unit.unwrap_or(EDO_MA) / EDO_MA;
                }
                Read::Walls(Box::new(WallSheet {
                    found: *found,
                    file,
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

    fn drawing(&self, lines: Lines, file: String, legends: &Legends) -> Result<Read, NoPlan> {
        let unit_mm = self.unit.map(|shaku| shaku * SHAKU * 1000.0);
        let front = self.front.into();
        let (roles, symbols) = (&legends.roles, &legends.symbols);
        let drawn = match self.inputs.len() {
            1 if self.legends.is_empty() => drawing::read(lines, roles, unit_mm, symbols, front)?,
            _ => {
                let drawn = drawing::find(lines, roles, unit_mm, symbols, front);
                let drawn = drawn.map_err(|why| NoPlan { why, stopped: None })?;
                DrawnPlan::Grid(Box::new(drawn))
            }
        };
        Ok(match drawn {
            DrawnPlan::Grid(drawn) => Read::Sheets(vec![Sheet {
                found: drawn.found,
                file,
                shrink: 1.0,
                is_drawing: true,
                shaku: drawn.shaku,
                unknown: drawn.unknown,
            }]),
            DrawnPlan::Walls(found) => Read::Walls(Box::new(WallSheet {
                found: *found,
                file,
                shrink: 1.0,
            })),
        })
    }

    /// The options for a picture, in pixels of the reduced picture: `shrink` is how many pixels of the file one of its pixels covers.
    fn options(&self, shrink: f64) -> Options {
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
        }
    }
}
