//! `hsd draw`: drawings to scale.

use crate::files::input::Inputs;
use crate::files::output::{Committer, Files};
use crate::options::{DetailArgs, InputArgs, exit, report};
use crate::{Exit, Failure, Outcome};
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::{Diagnostics, Language, visible};
use hsd_base::lettering::Font;
use hsd_base::text;
use hsd_drawing::letters::outlined;
use hsd_drawing::paper::{Sheet, View};
use hsd_drawing::sheet::Paper;
use hsd_drawing::subject::Subject;
use hsd_drawing::{Plane, SCALES, Settings, Wanted};
use hsd_ir::building::Building;
use hsd_report::{Format, Report};
use hsd_scene::texture;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

mod fonts;

/// Draw plans, elevations and sections of houses to scale.
///
/// All views stand on one sheet; a single view has paper of its own size. Where a plan or a section is cut, the drawing shows
/// the exact cut of the model. SVG and PDF are in millimetres on paper, DXF is in millimetres of the house.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd draw shop.hsd -o shop.svg                               draw all views on A3, as large as they fit
  hsd draw shop.hsd -o shop.pdf --scale 1:50                  draw them at 1:50 on the smallest sheet that holds them
  hsd draw shop.hsd -o plan.dxf --view plan-1                 draw the plan of the first storey for a CAD program
  hsd draw shop.hsd -o cut.svg --section a=3.5 --view section draw the house cut across, 3.5 units from its right end")]
pub(crate) struct Draw {
    #[command(flatten)]
    input_args: InputArgs,

    #[command(flatten)]
    detail_args: DetailArgs,

    /// Write the drawing to this file: .svg, .pdf, .dxf or .png.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,

    /// Select views, separated by commas: plan (all storeys), plan-1, plan-2, ..., roof, site, front, right, back, left,
    /// section [default: all].
    #[arg(long = "view", value_delimiter = ',', value_name = "VIEW", value_parser = wanted)]
    views: Vec<Wanted>,

    /// Cut a section there: `a=` units to the left along the first line, or `b=` units back; repeatable [default: one of
    /// each through the middle].
    #[arg(long = "section", value_name = "a=N|b=N", value_parser = plane)]
    sections: Vec<Plane>,

    /// Set the scale, as in 1:100 [default: the largest usual one that fits on the sheet].
    #[arg(long, value_name = "1:N", value_parser = scale)]
    scale: Option<u32>,

    /// Set the sheet: A4, A3, A2, A1 or A0 [default: A3, or with --scale the smallest that holds all views].
    #[arg(
        long,
        value_enum,
        value_name = "SIZE",
        ignore_case = true,
        hide_possible_values = true
    )]
    sheet: Option<SheetSize>,

    /// Draw only this house of the file: its name.
    #[arg(long, value_name = "NAME")]
    house: Option<String>,

    /// Draw texts as outlines of this font (.ttf, .otf, .ttc), so that they look the same everywhere.
    ///
    /// Images need a font; without this option they take a Japanese one of this machine.
    #[arg(long, value_name = "FILE")]
    font: Option<PathBuf>,

    /// Set the resolution of an image, pixels in an inch.
    #[arg(long, value_name = "N", default_value_t = 150, value_parser = clap::value_parser!(u16).range(20..=1200))]
    dpi: u16,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

/// The smallest scale at which joinery is still to be seen.
const LEGIBLE: u32 = 200;

/// The sizes of paper.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum SheetSize {
    /// 297 x 210 mm.
    A4,
    /// 420 x 297 mm.
    A3,
    /// 594 x 420 mm.
    A2,
    /// 841 x 594 mm.
    A1,
    /// 1189 x 841 mm.
    A0,
}

impl From<SheetSize> for Paper {
    fn from(size: SheetSize) -> Paper {
        match size {
            SheetSize::A4 => Paper::A4,
            SheetSize::A3 => Paper::A3,
            SheetSize::A2 => Paper::A2,
            SheetSize::A1 => Paper::A1,
            SheetSize::A0 => Paper::A0,
        }
    }
}

/// The format of a drawing.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Svg,
    Pdf,
    Dxf,
    Png,
}

impl Kind {
    fn of(path: &Path) -> Result<Kind, Failure> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Kind::Svg),
            Some("pdf") => Ok(Kind::Pdf),
            Some("dxf") => Ok(Kind::Dxf),
            Some("png") => Ok(Kind::Png),
            _ => {
                let shown = path.display();
                Err(Failure::Usage(text!([shown]
                    "{shown}: the extension of a drawing must be .svg, .pdf, .dxf or .png",
                    "{shown}: 図面の拡張子は .svg、.pdf、.dxf、.png のどれかにしてください"
                )))
            }
        }
    }
}

impl Draw {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        let kind = Kind::of(&self.output)?;
        self.input_args.check_folders()?;
        let committer = Committer::reading(self.input_args.files().chain(&self.font));
        committer.check([&self.output])?;
        let mut out = Diagnostics::new();
        let limit = self.input_args.limits().bytes;
        let inputs = Inputs::read(&self.input_args.inputs, limit, &mut out)?;
        let mut options = self.input_args.options(&inputs, &mut out)?;
        options.detail = self.detail_args.detail();
        options.all_roofs = true;
        options.shown = self.detail_args.shown();
        let world = self.input_args.world(&self.input_args.inputs);
        let world = world.recorded_in(&committer.inputs);
        let compiled = hsd_driver::compile(&inputs.accepted(), &world, &options, &mut out);
        let list = out.into_sorted();
        if !list.is_empty() {
            report(
                &Report::new(&inputs.and(compiled.included), &list).in_language(language),
                Format::Human,
                &mut io::stderr(),
            )?;
        }
        if list.iter().any(|d| self.input_args.spoils(d.severity)) {
            return Ok(Exit::Errors);
        }
        let building = &compiled.building;
        let chosen = |house: &hsd_ir::building::House| {
            self.house.as_ref().is_none_or(|name| house.name == *name)
        };
        let subject = Subject::new(building, chosen, &compiled.scene, &compiled.catalog);
        self.check_house(&subject, building)?;
        let sheet = self.sheet(&subject, language)?;
        let bytes = self.bytes(&sheet, kind, language)?;
        let length = committer.write(&self.output, Files::bytes(bytes))?;
        self.tell(&sheet, length, language)?;
        Ok(exit(false))
    }

    /// Fails if there is nothing to be drawn.
    fn check_house(&self, subject: &Subject<'_>, building: &Building) -> Result<(), Failure> {
        if !subject.houses.is_empty() {
            return Ok(());
        }
        let Some(name) = self.house.as_ref().map(|n| visible::line(n)) else {
            return Err(Failure::Usage(text!(
                "there is no house to draw",
                "描く家がありません"
            )));
        };
        let known: Vec<&str> = building.houses.iter().map(|b| &*b.house.name).collect();
        let known = visible::line(&known.join(", "));
        Err(Failure::Usage(text!([name, known]
            "no house is called {name}; there are: {known}",
            "「{name}」という家はありません。あるのは {known} です"
        )))
    }

    /// Returns the views on a sheet.
    fn sheet(&self, subject: &Subject<'_>, language: Language) -> Result<Sheet, Failure> {
        let settings = self.settings(subject, language);
        let wanted: &[Wanted] = match self.views.is_empty() {
            true => &Wanted::ALL,
            false => &self.views,
        };
        check_storeys(wanted, subject)?;
        let paper = self.sheet.map(Paper::from);
        let at = |scale: u32| {
            let settings = Settings {
                scale,
                ..settings.clone()
            };
            let rows = hsd_drawing::views(subject, wanted, &settings);
            (rows, settings)
        };
        if let Some(scale) = self.scale {
            let (rows, settings) = at(scale);
            let sheet = hsd_drawing::on_paper(&rows, paper, &settings);
            return sheet.ok_or_else(|| too_large(&rows, paper, scale));
        }
        let one = matches!(wanted, [w] if !matches!(w, Wanted::Plans | Wanted::Sections));
        if one && paper.is_none() {
            let (rows, settings) = at(100);
            let sheet = hsd_drawing::on_paper(&rows, None, &settings);
            return sheet.ok_or_else(|| too_large(&rows, None, 100));
        }
        let [low, high] = subject.bounds();
        let most = (high - low).max_element() * 1000.0;
        // Drawing takes longer than measuring what is drawn, so one scale tells which others fit.
        let about = |s: &u32| most / f64::from(*s) < 80.0;
        let first = SCALES
            .into_iter()
            .find(about)
            .unwrap_or(SCALES[SCALES.len() - 1]);
        let (rows, settings) = at(first);
        let Some((paper, scale)) = suited(paper, &rows, first) else {
            return Err(too_large(&rows, paper, first));
        };
        let (rows, settings) = match scale == first {
            true => (rows, settings),
            false => at(scale),
        };
        let sheet = hsd_drawing::on_paper(&rows, Some(paper), &settings);
        sheet.ok_or_else(|| too_large(&rows, Some(paper), scale))
    }

    fn settings(&self, subject: &Subject<'_>, language: Language) -> Settings {
        let first = subject.houses.first().map(|b| &b.house);
        let file = self.input_args.inputs.first();
        let source = file.and_then(|f| f.file_name());
        let source = visible::line(&source.map(|n| n.to_string_lossy()).unwrap_or_default());
        let name = first.map(|h| visible::line(&h.name)).unwrap_or_default();
        let sections = match self.sections.is_empty() {
            true => Plane::middle(subject),
            false => self.sections.clone(),
        };
        Settings {
            scale: 100,
            sections,
            language,
            title: if name.is_empty() {
                source.clone()
            } else {
                name
            },
            source,
            ken: first.map_or(0.0, |h| h.unit * 2.0),
        }
    }

    /// Returns a sheet as a file.
    fn bytes(&self, sheet: &Sheet, kind: Kind, language: Language) -> Result<Vec<u8>, Failure> {
        let font = match (&self.font, kind) {
            (Some(path), _) => {
                let bytes = std::fs::read(path).map_err(|e| Failure::at(path.display(), e))?;
                Some((path.clone(), bytes))
            }
            (None, Kind::Png) => fonts::of_machine(),
            (None, _) => None,
        };
        if kind == Kind::Png && font.is_none() {
            self.note(
                &text!(
                    "no Japanese font was found, so the image has no texts; name one with --font",
                    "日本語フォントが見つからないため、画像に文字がありません。--font で指定してください"
                )
                .in_language(language),
            )?;
        }
        let outlined = match &font {
            Some((path, bytes)) => Some(self.outlined(sheet, path, bytes, language)?),
            None => None,
        };
        let sheet = outlined.as_ref().unwrap_or(sheet);
        match kind {
            Kind::Svg => Ok(hsd_drawing::svg::write(sheet).into_bytes()),
            Kind::Dxf => Ok(hsd_drawing::dxf::write(sheet).into_bytes()),
            Kind::Pdf => Ok(hsd_drawing::pdf::write(sheet)),
            Kind::Png => self.image(sheet),
        }
    }

    fn outlined(
        &self,
        sheet: &Sheet,
        path: &Path,
        bytes: &[u8],
        language: Language,
    ) -> Result<Sheet, Failure> {
        let Some(font) = Font::read(bytes) else {
            let shown = path.display();
            return Err(Failure::Usage(text!([shown]
                "{shown} is no font that can be read; give a .ttf, .otf or .ttc file",
                "{shown} はフォントとして読めません。.ttf、.otf、.ttc のファイルを指定してください"
            )));
        };
        let (sheet, missing) = outlined(sheet, &font);
        if !missing.is_empty() {
            let letters = visible::line(&missing.iter().collect::<String>());
            self.note(
                &text!([letters]
                    "the font has no {letters}; these letters are left out",
                    "このフォントには「{letters}」がないため、描かれていません"
                )
                .in_language(language),
            )?;
        }
        Ok(sheet)
    }

    fn image(&self, sheet: &Sheet) -> Result<Vec<u8>, Failure> {
        let Some(image) = hsd_drawing::png::image(sheet, f64::from(self.dpi)) else {
            return Err(Failure::Usage(text!(
                "the image would have more than a hundred million pixels; choose a lower --dpi",
                "画像が1億画素を超えます。--dpi を小さくしてください"
            )));
        };
        Ok(texture::png(&image, texture::Packing::Quick))
    }

    /// Says what was drawn.
    fn tell(&self, sheet: &Sheet, length: u64, language: Language) -> Result<(), Failure> {
        if self.quiet || self.output.as_os_str() == "-" {
            return Ok(());
        }
        let named = sheet.views.iter().filter(|v| v.name != "sheet");
        let names: Vec<&str> = named.map(|v| &*v.name).collect();
        let (file, names) = (self.output.display(), names.join(", "));
        let (scale, w, h) = (sheet.scale, sheet.size.x.round(), sheet.size.y.round());
        let said = text!([file, names, scale, w, h, length]
            "{file}: {names} at 1:{scale} on {w} x {h} mm, {length} bytes",
            "{file}: {names}、縮尺 1:{scale}、用紙 {w} × {h} mm、{length} バイト"
        );
        self.note(&said.in_language(language))
    }

    fn note(&self, said: &str) -> Result<(), Failure> {
        Ok(writeln!(io::stderr(), "{said}")?)
    }
}

/// Returns the sheet and the largest usual scale at which views drawn at a scale fit on it. If no sheet is named, it is A3 or
/// the smallest larger one on which details are still to be seen.
fn suited(paper: Option<Paper>, rows: &[Vec<View>], drawn: u32) -> Option<(Paper, u32)> {
    let papers: &[Paper] = match &paper {
        Some(paper) => std::slice::from_ref(paper),
        None => &Paper::ALL[1..],
    };
    let largest = |paper: Paper, smallest: u32| {
        let usual = SCALES.into_iter().take_while(move |s| *s <= smallest);
        let times = |s: u32| f64::from(drawn) / f64::from(s);
        let mut fitting = usual.filter(|s| hsd_drawing::sheet::fits(rows, paper, times(*s)));
        fitting.next().map(|scale| (paper, scale))
    };
    let on_any = |smallest: u32| papers.iter().find_map(|p| largest(*p, smallest));
    let mut limits = SCALES.into_iter().filter(|s| *s >= LEGIBLE);
    limits.find_map(on_any)
}

/// Fails if the plan of a storey is wanted that the houses do not have.
fn check_storeys(wanted: &[Wanted], subject: &Subject<'_>) -> Result<(), Failure> {
    let storeys = hsd_drawing::storeys(subject);
    let missing = wanted.iter().find_map(|w| match w {
        Wanted::Plan(number) if !storeys.contains(number) => Some(*number),
        _ => None,
    });
    let Some(number) = missing else {
        return Ok(());
    };
    let highest = storeys.last().copied().unwrap_or_default();
    Err(Failure::Usage(text!([number, highest]
        "there is no storey {number} to draw; the highest is {highest}",
        "{number} 階はありません。最上階は {highest} 階です"
    )))
}

/// What to do about views that do not fit.
fn too_large(rows: &[Vec<View>], paper: Option<Paper>, scale: u32) -> Failure {
    let paper = paper.unwrap_or(Paper::A0).word();
    let sizes = rows.iter().flatten().map(|v| v.bounds().size());
    let widest = sizes.map(|s| s.x).fold(0.0, f64::max).round();
    Failure::Usage(text!([paper, scale, widest]
        "the views do not fit on {paper} at 1:{scale} (the widest takes {widest} mm); choose a smaller scale, a larger sheet, or fewer views with --view",
        "縮尺 1:{scale} では {paper} に収まりません（最も広い図は {widest} mm）。縮尺を小さくするか、用紙を大きくするか、--view で図を減らしてください"
    ))
}

fn wanted(text: &str) -> Result<Wanted, String> {
    let read = Wanted::read(text.trim());
    read.ok_or_else(|| {
        "expected plan, plan-1, ..., roof, site, front, right, back, left or section".to_owned()
    })
}

fn plane(text: &str) -> Result<Plane, String> {
    Plane::read(text).ok_or_else(|| "expected a=N or b=N, as in `a=3.5`".to_owned())
}

fn scale(text: &str) -> Result<u32, String> {
    let number = text.trim().strip_prefix("1:").unwrap_or(text.trim());
    match number.trim().parse() {
        Ok(n) if (1..=10_000).contains(&n) => Ok(n),
        _ => Err("expected 1:N, as in 1:100".to_owned()),
    }
}
