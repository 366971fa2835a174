//! The photographs of `hsd view --facade`: found, seen straight and built for the page as `hsd facade` does it.

use crate::Failure;
use crate::build::facade::made::{self, Made};
use crate::build::facade::said;
use crate::files::output::{self, Committer};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::{Diagnostics, Language, Text};
use hsd_base::source::{FileId, Source};
use hsd_base::text;
use hsd_driver::fs::InputRecord;
use hsd_front::brush::{Stroke, painted};
use hsd_front::grid::Grid;
use hsd_front::{self as front, Given, Lattice, Photo, Refused, STOREY, Told, rectify};
use hsd_report::{Format, Report, Style};
use hsd_scene::texture;
use hsd_view::{FrontHost, RecursiveMode};
use image::{GrayImage, Rgb, RgbImage, imageops};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The longer side of the photographs from which previews are made, and of previews, pixels: while something is dragged, and
/// afterwards.
const SMALL: [u32; 2] = [800, 1800];
const PREVIEW: [f64; 2] = [460.0, 1000.0];
/// The longer side of a photograph in the page, pixels: browsers draw no larger ones.
const SHOWN: u32 = 8000;
/// How good the pictures for the page are, of 100.
const QUALITY: u8 = 88;
/// Where corners are put that were not found, as a part of the photograph.
const LOST: f64 = 0.15;
/// The colour of what a mask hides, and how much of it is mixed in.
const VEIL: ([f32; 3], f32) = ([200.0, 67.0, 31.0], 0.55);
/// The file that keeps what was told by hand.
const BY_HAND: &str = "by-hand.json";

/// Photographs of one wall, and the folder for what is made of them.
pub(super) struct Photographs {
    /// The canonical path of the folder that holds it.
    pub(super) root: PathBuf,
    /// The folder, and its name in the other one.
    output: PathBuf,
    name: String,
    writes: bool,
    language: Language,
    all: Vec<Opened>,
    /// The files of the photographs.
    record: InputRecord,
}

/// A photograph.
struct Opened {
    photo: Photo,
    /// The same for previews, and how many times as large.
    small: [(Photo, f64); 2],
    corners: [DVec2; 4],
    /// Why the wall was not found, in words.
    lost: Option<String>,
}

/// What is told by hand: `Told` in `view/src/server/front.ts`.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct ByHand {
    photos: Vec<Marked>,
    /// Width and height, metres.
    size: Option<[f64; 2]>,
    /// Inner lines of the lattice, as parts of the wall.
    columns: Vec<f64>,
    rows: Vec<f64>,
}

/// What is told of a photograph.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Marked {
    corners: [[f64; 2]; 4],
    mask: Vec<Stroke>,
}

/// `StraightRequest` in `view/src/server/front.ts`.
#[derive(Deserialize)]
struct Asked {
    photo: usize,
    marked: Marked,
    size: Option<[f64; 2]>,
    /// Whether the lattice is to be found.
    finds: bool,
    /// Whether it is only for a moment.
    quick: bool,
}

impl Photographs {
    /// Reads photographs for a folder, and looks for the wall in each.
    ///
    /// `None` if one of them is none, which is reported.
    ///
    /// # Errors
    /// If a file cannot be read, or the folder that is to hold the other one does not exist.
    pub(super) fn open(
        photos: &[PathBuf],
        output: Option<&Path>,
        (writes, language): (bool, Language),
        (sources, out): (&mut Vec<Source>, &mut Diagnostics),
    ) -> Result<Option<Photographs>, Failure> {
        let mut all = vec![];
        for path in photos {
            let opened = made::opened(path, sources, out)?;
            let number = sources.len() - 1;
            all.extend(opened.map(|photo| Opened::of(photo, number, sources, language)));
        }
        if out.has_errors() {
            return Ok(None);
        }
        let output = output.map_or_else(|| photos[0].with_extension(""), Path::to_owned);
        let failed = |e| Failure::at(output.display(), e);
        let root = output::folder_of(&output).canonicalize().map_err(failed)?;
        let name = output.file_name().unwrap_or("front".as_ref());
        let name = name.to_string_lossy().into_owned();
        Ok(Some(Photographs {
            output: root.join(&name),
            root,
            name,
            writes,
            language,
            all,
            record: Committer::reading(photos).inputs,
        }))
    }

    /// The text that is built, as a path below the root.
    pub(super) fn file(&self) -> String {
        format!("{0}/{0}.hsd", self.name)
    }

    /// The text with the front in a street, as a path below the root.
    pub(super) fn street(&self) -> String {
        format!("{}/{}", self.name, made::street(&self.name))
    }

    /// What is watched for changes: the folder, where it is there already.
    pub(super) fn watched(&self) -> Vec<(PathBuf, RecursiveMode)> {
        let is_there = self.output.is_dir();
        let folder = is_there.then(|| (self.output.clone(), RecursiveMode::NonRecursive));
        folder.into_iter().collect()
    }

    /// What was told by hand the last time, of the same photographs.
    fn before(&self) -> Option<Value> {
        let kept = std::fs::read(self.output.join(BY_HAND)).ok()?;
        let kept: Value = serde_json::from_slice(&kept).ok()?;
        let names: Vec<&str> = self.all.iter().map(|o| &*o.photo.name).collect();
        let told: ByHand = serde_json::from_value(kept["told"].clone()).ok()?;
        let fits = kept["files"] == json!(names) && told.photos.len() == self.all.len();
        (fits && told.photos.iter().all(|m| quadrangle(m).is_some())).then(|| kept["told"].clone())
    }

    fn words(&self, text: &Text) -> String {
        text.in_language(self.language).into_owned()
    }

    /// Reads what is asked in JSON.
    fn read<T: DeserializeOwned>(&self, asked: Value) -> Result<T, String> {
        serde_json::from_value(asked).map_err(|e| e.to_string())
    }

    /// The corners of a wall, if they are some.
    fn corners(&self, marked: &Marked) -> Result<[DVec2; 4], String> {
        quadrangle(marked).ok_or_else(|| {
            self.words(&text!(
                "the corners have to go clockwise round the wall, from its upper left",
                "四隅は、壁面の左上から時計回りでなければなりません"
            ))
        })
    }

    /// What is known of the wall, with masks and corners in the photographs.
    fn given(&self, told: &ByHand) -> Result<(Vec<Photo>, Given), String> {
        let fits = told.photos.len() == self.all.len();
        let marks = told.photos.iter().zip(&self.all).filter(|_| fits);
        let (mut photos, mut corners) = (vec![], vec![]);
        for (marked, opened) in marks {
            corners.push(self.corners(marked)?);
            let mask = (!marked.mask.is_empty())
                .then(|| painted(opened.photo.pixels.dimensions(), &marked.mask, 1.0));
            photos.push(Photo {
                mask,
                ..opened.photo.clone()
            });
        }
        if photos.is_empty() {
            return Err("other photographs".to_owned());
        }
        let given = Given {
            corners,
            size: told.size.map(DVec2::from_array),
            lattice: Lattice::Shares(told.columns.clone(), told.rows.clone()),
            ..Given::default()
        };
        Ok((photos, given))
    }

    /// Writes the folder; returns what is said of it.
    fn write(&self, told: &ByHand, (photos, given): (&[Photo], &Given)) -> Result<Value, String> {
        let mut out = Diagnostics::new();
        let name = |o: &Opened| o.photo.name.clone();
        let mut sources: Vec<Source> = (self.all.iter().enumerate())
            .map(|(k, o)| Source::new(FileId(k as u32), name(o), b""))
            .collect();
        let mut written = None;
        match front::read(photos, given) {
            Ok(front) => {
                let committer = &Committer::knowing(self.record.clone());
                let made = Made {
                    output: &self.output,
                    photos,
                    front: &front,
                    given,
                    fronts: None,
                    committer,
                };
                let words = made.write(&mut sources, &mut out).and_then(|words| {
                    committer.write_all(self.kept(told, photos)?)?;
                    Ok(words)
                });
                written = Some(words.map_err(|failure| self.failed(&failure))?);
            }
            Err(why) => out.push(said::refused(&sources, why)),
        }
        let list = out.into_sorted();
        let mut messages = vec![];
        let report = Report::new(&sources, &list).in_language(self.language);
        (report.write(Format::Json, Style::default(), &mut messages)).map_err(|e| e.to_string())?;
        let messages: Value = serde_json::from_slice(&messages).map_err(|e| e.to_string())?;
        let said = written.as_ref().map(|words| self.words(words));
        Ok(json!({ "said": said, "messages": messages }))
    }

    /// Files with what was told by hand: for the page, and masks for `hsd facade`.
    fn kept(&self, told: &ByHand, photos: &[Photo]) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        let names: Vec<&str> = photos.iter().map(|p| &*p.name).collect();
        let kept = json!({ "files": names, "told": told });
        let kept = serde_json::to_vec(&kept).map_err(|e| Failure::json(&e))?;
        let mut files = vec![(self.output.join(BY_HAND), kept)];
        for (k, mask) in photos.iter().map(|p| &p.mask).enumerate() {
            if let Some(mask) = mask {
                let picture = image::DynamicImage::ImageLuma8(mask.clone()).into_rgb8();
                let path = self.output.join(format!("mask-{}.png", k + 1));
                files.push((path, texture::png(&picture, texture::Packing::Quick)));
            }
        }
        Ok(files)
    }

    fn failed(&self, failure: &Failure) -> String {
        match failure {
            Failure::Io(why) | Failure::Usage(why) => self.words(why),
            Failure::Pipe => String::new(),
        }
    }
}

impl Opened {
    fn of(mut photo: Photo, number: usize, sources: &[Source], language: Language) -> Opened {
        let view = front::found(&mut photo, &Given::default());
        let (width, height) = photo.pixels.dimensions();
        let inset = |x: f64, y: f64| dvec2(x * f64::from(width), y * f64::from(height));
        let (near, far) = (LOST, 1.0 - LOST);
        let square = [(near, near), (far, near), (far, far), (near, far)];
        let (corners, lost) = match view {
            Ok(view) => (view.corners, None),
            Err(why) => {
                let why = said::refused(sources, Refused::Lost(number, why));
                let why = why.message.in_language(language).into_owned();
                (square.map(|(x, y)| inset(x, y)), Some(why))
            }
        };
        let small = SMALL.map(|longest| {
            let scale = (f64::from(longest) / f64::from(width.max(height))).min(1.0);
            let small = Photo {
                name: photo.name.clone(),
                pixels: fitted(&photo.pixels, longest),
                focal: photo.focal.map(|focal| focal * scale),
                mask: None,
                bend: photo.bend,
            };
            (small, scale)
        });
        Opened {
            photo,
            small,
            corners,
            lost,
        }
    }
}

impl FrontHost for Photographs {
    fn about(&self) -> Value {
        let photos = self.all.iter().map(|o| {
            let size: [u32; 2] = o.photo.pixels.dimensions().into();
            let corners = o.corners.map(|c| c.to_array());
            json!({ "name": o.photo.name, "size": size, "corners": corners, "lost": o.lost })
        });
        let photos: Vec<Value> = photos.collect();
        json!({
            "photos": photos, "folder": self.name, "writes": self.writes, "storey": STOREY,
            "files": { "front": self.file(), "street": self.street() }, "told": self.before(),
        })
    }

    fn photo(&self, number: usize) -> Option<Vec<u8>> {
        let shown = fitted(&self.all.get(number)?.photo.pixels, SHOWN);
        Some(texture::jpeg(&shown, QUALITY))
    }

    fn straight(&self, asked: Value) -> Result<Value, String> {
        let asked: Asked = self.read(asked)?;
        let opened = self.all.get(asked.photo).ok_or("no such photograph")?;
        let level = usize::from(!asked.quick);
        let (small, scale) = &opened.small[level];
        let corners = self.corners(&asked.marked)?.map(|c| c * *scale);
        let given = Given {
            size: asked.size.map(DVec2::from_array),
            ..Given::default()
        };
        let view = front::view(small, Some(corners), &given);
        let view = view.map_err(|_| "no view".to_owned())?;
        let (width, height) = rectify::size(corners, view.aspect);
        let fit = (PREVIEW[level] / f64::from(width.max(height))).min(1.0);
        let size = [width, height].map(|s| ((f64::from(s) * fit).round() as u32).max(8));
        let mask = &asked.marked.mask;
        let mask = (!mask.is_empty()).then(|| painted(small.pixels.dimensions(), mask, *scale));
        let (wall, grid) = seen(small, mask, &view, size.into(), asked.finds);
        let picture = match asked.quick {
            true => ("bmp", plain(&wall)),
            false => ("jpeg", texture::jpeg(&wall, QUALITY)),
        };
        let picture = format!(
            "data:image/{};base64,{}",
            picture.0,
            BASE64_STANDARD.encode(picture.1)
        );
        let inner = |lines: &[f64]| lines[1..lines.len() - 1].to_vec();
        let lattice = grid.map(|g| json!({ "columns": inner(&g.columns), "rows": inner(&g.rows) }));
        Ok(json!({
            "picture": picture,
            "size": size,
            "aspect": view.aspect,
            "guessed": asked.size.is_none() && view.focal == Told::Usual,
            "lattice": lattice,
        }))
    }

    fn build(&self, told: Value) -> Result<Value, String> {
        if !self.writes {
            return Err(self.words(&text!(
                "this server writes nothing (--read-only)",
                "このサーバーは何も書きません (--read-only)"
            )));
        }
        let told: ByHand = self.read(told)?;
        let (photos, given) = self.given(&told)?;
        self.write(&told, (&photos, &given))
    }
}

/// The wall seen straight, what its mask hides veiled, and its lattice if it is asked for.
fn seen(
    small: &Photo,
    mask: Option<GrayImage>,
    view: &front::View,
    size: (u32, u32),
    finds: bool,
) -> (RgbImage, Option<Grid>) {
    let hides = mask.is_some();
    let masked = Photo {
        mask,
        ..small.clone()
    };
    let (mut wall, free) = front::straight(&masked, view, size);
    let grid = finds.then(|| Grid::find(&wall));
    if hides {
        let (tone, share) = VEIL;
        let hidden = wall.pixels_mut().zip(&free).filter(|(_, free)| !**free);
        for (pixel, _) in hidden {
            let mixed = |c: usize| f32::from(pixel[c]) * (1.0 - share) + tone[c] * share;
            *pixel = Rgb([mixed(0) as u8, mixed(1) as u8, mixed(2) as u8]);
        }
    }
    (wall, grid)
}

/// The corners of a wall, if they go clockwise round an area and are not beyond reason.
fn quadrangle(marked: &Marked) -> Option<[DVec2; 4]> {
    let corners = marked.corners.map(DVec2::from_array);
    let side = |k: usize| corners[(k + 1) % 4] - corners[k % 4];
    let turns = (0..4).all(|k| side(k).perp_dot(side(k + 1)) > 1.0);
    let near = corners.iter().all(|c| c.abs().max_element() < 1e6);
    (turns && near).then_some(corners)
}

/// A picture with no side longer than this.
fn fitted(picture: &RgbImage, longest: u32) -> RgbImage {
    let (width, height) = picture.dimensions();
    let scale = f64::from(longest) / f64::from(width.max(height));
    if scale >= 1.0 {
        return picture.clone();
    }
    let side = |s: u32| ((f64::from(s) * scale).round() as u32).max(1);
    imageops::thumbnail(picture, side(width), side(height))
}

/// A picture as BMP, which takes no time to make: rows from below, of blue, green and red, filled up to four bytes.
fn plain(picture: &RgbImage) -> Vec<u8> {
    const HEAD: u32 = 54;
    let (width, height) = picture.dimensions();
    let long = (3 * width).next_multiple_of(4);
    let mut bytes = b"BM".to_vec();
    let whole = HEAD + long * height;
    for number in [
        whole,
        0,
        HEAD,
        40,
        width,
        height,
        24 << 16 | 1,
        0,
        0,
        0,
        0,
        0,
        0,
    ] {
        bytes.extend(number.to_le_bytes());
    }
    for row in picture.rows().rev() {
        let start = bytes.len();
        row.for_each(|pixel| bytes.extend(pixel.0.iter().rev()));
        bytes.resize(start + long as usize, 0);
    }
    bytes
}
