//! `hsd facade`: photographs of a wall become its parts and a text that builds it.

use super::plan::values::corners;
use crate::cli::files::output;
use crate::cli::files::terminal::counted;
use crate::cli::options::report;
use crate::cli::{Exit, Failure, Outcome};
use crate::diagnostic::messages::plan::photographed as say;
use crate::diagnostic::{Diagnostics, Language, noun};
use crate::driver;
use crate::front::{self, Front, Given, Lattice, Photo, Told, exif, record, sheet, whole};
use crate::fs::FolderWorld;
use crate::plan::Picture;
use crate::report::{Format, Report};
use crate::source::{FileId, Source, Span};
use crate::text;
use clap::Args;
use glam::DVec2;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{GrayImage, ImageEncoder, RgbImage};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

mod said;
mod values;

/// The most pixels of a part, as of all images of a house.
const PIXELS: u64 = 64_000_000;

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
pub(in crate::cli) struct Facade {
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

    /// Also write the whole wall, and its ground and upper storeys, as fronts of this name: NAME.N.png, for the next free N.
    #[arg(long, value_name = "NAME", value_parser = values::name)]
    fronts: Option<String>,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

impl Facade {
    pub(in crate::cli) fn run(&self, language: Language) -> Outcome {
        let mut out = Diagnostics::new();
        let mut sources = vec![];
        let mut told = None;
        if let Some(photos) = self.open(&mut sources, &mut out)? {
            match front::read(&photos, &self.given()) {
                Ok(front) => told = Some(self.write(&photos, &front, &mut sources, &mut out)?),
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
            let bytes = std::fs::read(path).map_err(|e| Failure::at(path.display(), e))?;
            let name = path.display().to_string();
            // What is told of a picture has no place in its bytes.
            let source = Source::new(FileId(sources.len() as u32), name, b"");
            match Picture::whole(&bytes) {
                Ok((picture, exif)) => {
                    let pixels = picture.pixels;
                    let focal = exif.and_then(|exif| exif::focal(&exif, pixels.dimensions()));
                    let mask = self
                        .masks
                        .get(k)
                        .map(|mask| opened_mask(mask, &pixels))
                        .transpose()?;
                    photos.push(Photo {
                        name: name_of(path),
                        pixels,
                        focal,
                        mask,
                    });
                }
                Err(why) => out.push(said::unreadable(source.span(0..0), &why)),
            }
            sources.push(source);
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
        }
    }

    /// Writes the folder; says what was written.
    fn write(
        &self,
        photos: &[Photo],
        front: &Front,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<crate::diagnostic::Text, Failure> {
        std::fs::create_dir_all(&self.output).map_err(|e| Failure::at(self.output.display(), e))?;
        let name = self.output.file_name().unwrap_or("front".as_ref());
        let path = self.output.join(format!("{}.hsd", name.to_string_lossy()));
        let text = front::text::write(front, &self.head(photos, front));
        self.doubts(front, sources[0].span(0..0), out);
        let source = Source::new(
            FileId(sources.len() as u32),
            path.display().to_string(),
            text.as_bytes(),
        );
        let mut files = self.files(photos, front)?;
        files.push((path.clone(), text.into_bytes()));
        output::write_all(files)?;
        let world = FolderWorld::new(vec![self.output.clone()], PIXELS);
        driver::check(&[&source], &world, &driver::Options::default(), out);
        sources.push(source);
        let replaced = front.shown.iter().filter(|s| s.is_replaced).count();
        let parts = counted(front.parts.len(), noun("part", "部材{}個"));
        let (path, cells) = (path.display(), front.cells.len());
        Ok(text!([path, cells, parts, replaced]
            "{path}: {parts} for {cells} places, {replaced} of them cleared of what stands before them; `hsd build {path} -o OUT.glb` builds it",
            "{path}: {cells} か所に{parts}。うち {replaced} か所は手前の物を取り除きました。`hsd build {path} -o OUT.glb` で作れます"
        ))
    }

    /// Says what is not certain.
    fn doubts(&self, front: &Front, place: Span, out: &mut Diagnostics) {
        if self.size.is_none() && front.views[0].focal == Told::Usual {
            out.push(say::guessed(place));
        }
        let is_whole = front.grid.columns.len() == 2 || front.grid.rows.len() == 2;
        if matches!(self.given().lattice, Lattice::Found) && is_whole {
            out.push(say::no_lattice(place));
        }
        for (cell, shown) in front.cells.iter().zip(&front.shown) {
            if shown.is_spoiled {
                out.push(say::spoiled(place, &front.name_at(cell.row, cell.column)));
            }
        }
    }

    /// All files but the text, with their paths.
    fn files(&self, photos: &[Photo], front: &Front) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        let path = |name: &str| self.output.join(name);
        let compared = sheet::draw(&photos[0], front);
        let mut files = vec![
            (
                path("facade.json"),
                record::json(photos, front).into_bytes(),
            ),
            (
                path("parts.csv"),
                front::text::catalogue(front).into_bytes(),
            ),
            (path("rectified.png"), png(&front.wall)?),
            (path("compared.png"), png(&compared)?),
        ];
        for part in &front.parts {
            files.push((path(&format!("{}.png", part.name)), png(&part.picture)?));
        }
        if let Some(name) = &self.fronts {
            files.extend(self.fronts(name, front)?);
        }
        Ok(files)
    }

    /// What the text says of where it comes from: everything that was assumed.
    fn head(&self, photos: &[Photo], front: &Front) -> Vec<String> {
        let names: Vec<&str> = photos.iter().map(|p| p.name.as_str()).collect();
        let mut head = vec![format!("Read by hsd facade from {}.", names.join(", "))];
        if self.size.is_none() {
            head.push(
                "Assumed: storeys are 3.5 m high; give --size W,H for the true size.".to_owned(),
            );
            if front.views[0].focal == Told::Usual {
                head.push(
                    "Assumed: a lens like that of most telephones, so the proportions are a guess."
                        .to_owned(),
                );
            }
        }
        let replaced = front
            .cells
            .iter()
            .zip(&front.shown)
            .filter(|(_, s)| s.is_replaced);
        let storeys = front.grid.rows.len() - 1;
        let places: Vec<String> = replaced
            .map(|(c, _)| format!("f1f{}f{}", storeys - c.row, c.column + 1))
            .collect();
        if !places.is_empty() {
            head.push(format!(
                "Hidden in the photograph, replaced by the same part: {}.",
                places.join(", ")
            ));
        }
        head
    }

    /// Pictures of whole fronts, for the next free number (000-43, 000-54 to -56).
    fn fronts(&self, name: &str, front: &Front) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        let is_free = |n: &usize| !self.output.join(format!("{name}.{n}.png")).exists();
        let number = (1..).find(is_free).unwrap_or(1);
        let pictures = whole::fronts(front).into_iter();
        pictures
            .map(|(piece, picture)| {
                Ok((
                    self.output.join(format!("{name}{piece}.{number}.png")),
                    png(&picture)?,
                ))
            })
            .collect()
    }
}

/// A picture as PNG, packed quickly: photographs do not pack well.
fn png(picture: &RgbImage) -> Result<Vec<u8>, Failure> {
    let mut bytes = vec![];
    let encoder =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive);
    let (width, height) = picture.dimensions();
    let written = encoder.write_image(picture, width, height, image::ExtendedColorType::Rgb8);
    written.map_err(|e| {
        let why = e.to_string();
        Failure::Io(text!([why] "the image cannot be written: {why}", "画像を書けません: {why}"))
    })?;
    Ok(bytes)
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

fn name_of(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
