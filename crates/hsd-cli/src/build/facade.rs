//! `hsd facade`: photographs of a wall become its parts and a text that builds it.

use super::plan::values::corners;
use crate::files::output::Committer;
use crate::options::report;
use crate::{Exit, Failure, Outcome};
use clap::Args;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_front::{self as front, Given, Lattice, Photo};
use hsd_report::{Format, Report};
use hsd_trace::plan::Picture;
use image::{GrayImage, RgbImage};
use made::Made;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

pub(crate) mod made;
pub(crate) mod said;
mod values;

/// Turn photographs of a wall into its parts and a text that builds it.
///
/// The wall is seen straight, in its true proportions, and cut on its storeys and bays. What is the same shares one clean
/// picture: trees, wires and cars go where the same part is seen elsewhere without them. DIR gets a picture of each part, the text
/// DIR.hsd, its catalogue parts.csv, rectified.png, facade.json, and compared.png to judge it all by.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd facade front.jpg -o front                                       find the wall, its storeys and bays
  hsd facade front.jpg -o front --corners \"310,290 640,350 670,890 307,850\" --size 12.6,9.3 --grid 7x3
  hsd facade left.jpg right.jpg -o front --size 12.6,9.3              one wall, from where each part is seen best
  hsd facade front.jpg -o front --mask tree.png                       what is white in tree.png stands before the wall")]
pub(crate) struct Facade {
    /// Photographs of one wall: PNG, JPEG, TIFF or WebP.
    #[arg(required = true, value_name = "PHOTO")]
    photos: Vec<PathBuf>,

    /// Write the parts and the text into this folder.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Set the corners of the wall, pixels, clockwise from the upper left; once for each photograph [default: they are looked for].
    #[arg(long, value_name = "\"X,Y X,Y X,Y X,Y\"", value_parser = corners)]
    corners: Vec<[DVec2; 4]>,

    /// Set width and height of the wall, metres [default: storeys are 3.5 m high].
    #[arg(long, value_name = "W,H", value_parser = values::size)]
    size: Option<DVec2>,

    /// Set how the lens bends lines [default: long edges become straight].
    #[arg(long, value_name = "K1,K2", allow_hyphen_values = true, value_parser = values::lens)]
    lens: Option<[f64; 2]>,

    /// Set the focal length, pixels [default: as the camera wrote it].
    #[arg(long, value_name = "PX", value_parser = values::focal)]
    focal: Option<f64>,

    /// Set the number of equal bays and storeys [default: what repeats].
    #[arg(long, value_name = "BAYSxSTOREYS", value_parser = values::grid, conflicts_with_all = ["columns", "rows"])]
    grid: Option<(usize, usize)>,

    /// Set the lines between bays, metres from the left.
    #[arg(long, value_name = "M,M,...", value_parser = values::lines, requires = "size")]
    columns: Option<values::Lines>,

    /// Set the lines between storeys, metres from above.
    #[arg(long, value_name = "M,M,...", value_parser = values::lines, requires = "size")]
    rows: Option<values::Lines>,

    /// Leave out what is white in this picture, of the size of its photograph; once for each photograph.
    #[arg(long = "mask", value_name = "PNG")]
    masks: Vec<PathBuf>,

    /// Also write up to N further clean pictures of each part, as a `random` set of which every place draws one.
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true, value_parser = values::variations)]
    variations: usize,

    /// Also write the whole wall, and its ground and upper storeys, as fronts of this name: NAME.N.png, for the next free N.
    #[arg(long, value_name = "NAME", value_parser = values::name)]
    fronts: Option<String>,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

impl Facade {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        let mut out = Diagnostics::new();
        let mut sources = vec![];
        let mut told = None;
        let committer = Committer::reading(self.photos.iter().chain(&self.masks));
        committer.check(made::outputs_in(&self.output))?;
        if let Some(photos) = self.open(&mut sources, &mut out)? {
            let given = self.given();
            match front::read(&photos, &given) {
                Ok(front) => {
                    let made = Made {
                        output: &self.output,
                        photos: &photos,
                        front: &front,
                        given: &given,
                        fronts: self.fronts.as_deref(),
                        committer: &committer,
                    };
                    told = Some(made.write(&mut sources, &mut out)?);
                }
                Err(why) => out.push(said::refused(&sources, why)),
            }
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

    /// Reads the photographs; `None` if one of them is none.
    fn open(
        &self,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<Option<Vec<Photo>>, Failure> {
        let mut photos = vec![];
        for (k, path) in self.photos.iter().enumerate() {
            if let Some(mut photo) = made::opened(path, sources, out)? {
                let mask = self.masks.get(k);
                photo.mask = mask.map(|m| opened_mask(m, &photo.pixels)).transpose()?;
                photos.push(photo);
            }
        }
        Ok((photos.len() == self.photos.len()).then_some(photos))
    }

    fn given(&self) -> Given {
        let lines = |lines: &Option<values::Lines>| lines.clone().map(|l| l.0).unwrap_or_default();
        let lattice = match (self.grid, self.columns.is_some() || self.rows.is_some()) {
            (Some((bays, storeys)), _) => Lattice::Even(bays, storeys),
            (None, true) => Lattice::Lines(lines(&self.columns), lines(&self.rows)),
            (None, false) => Lattice::Found,
        };
        Given {
            corners: self.corners.clone(),
            size: self.size,
            bend: self.lens,
            focal: self.focal,
            lattice,
            variations: self.variations,
        }
    }
}

/// What stands before the wall in a photograph.
fn opened_mask(path: &Path, photo: &RgbImage) -> Result<GrayImage, Failure> {
    let bytes = std::fs::read(path).map_err(|e| Failure::at(path.display(), e))?;
    let name = path.display();
    let (picture, _) = Picture::whole(&bytes).map_err(|_| {
        Failure::Usage(text!([name] "{name} is no picture", "{name} は画像ではありません"))
    })?;
    if picture.pixels.dimensions() != photo.dimensions() {
        let (width, height) = photo.dimensions();
        return Err(Failure::Usage(text!([name, width, height]
            "{name} is not of the size of its photograph, {width} x {height}",
            "{name} の大きさが写真 ({width} x {height}) と違います"
        )));
    }
    Ok(image::imageops::grayscale(&picture.pixels))
}
