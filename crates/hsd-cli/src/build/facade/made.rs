//! What `hsd facade` and the page of photographs make of them: how photographs are opened, and the folder that is written.

use super::said;
use crate::Failure;
use crate::files::output::Committer;
use crate::files::terminal::counted;
use hsd_base::diagnostic::{Diagnostics, Text, noun};
use hsd_base::source::{FileId, Source, Span};
use hsd_base::text;
use hsd_driver::fs::FolderWorld;
use hsd_front::messages as say;
use hsd_front::{self as front, Front, Given, Lattice, Photo, Told, exif, record, sheet, whole};
use hsd_scene::texture::{Packing, png};
use hsd_trace::plan::Picture;
use std::path::{Path, PathBuf};

/// The most pixels of a part, as of all images of a house.
const PIXELS: u64 = 64_000_000;

/// The record of what was read.
const FACADE: &str = "facade.json";

/// The catalogue of the parts.
const PARTS: &str = "parts.csv";

/// The whole wall, seen straight.
const RECTIFIED: &str = "rectified.png";

/// The photograph beside the wall.
const COMPARED: &str = "compared.png";

/// A wall that was read, and the folder for it.
pub(crate) struct Made<'m> {
    /// The folder.
    pub(crate) output: &'m Path,
    /// The photographs.
    pub(crate) photos: &'m [Photo],
    /// What was read from them.
    pub(crate) front: &'m Front,
    /// What was known.
    pub(crate) given: &'m Given,
    /// The name of whole fronts that are also written.
    pub(crate) fronts: Option<&'m str>,
    /// The committer, which knows the photographs.
    pub(crate) committer: &'m Committer,
}

impl Made<'_> {
    /// Writes the folder; says what was written.
    pub(crate) fn write(
        &self,
        sources: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> Result<Text, Failure> {
        std::fs::create_dir_all(self.output).map_err(|e| Failure::at(self.output.display(), e))?;
        let [path, street] = sources_in(self.output);
        let text = front::text::write(self.front, &self.head());
        self.doubts(sources[0].span(0..0), out);
        let source = Source::new(
            FileId(sources.len() as u32),
            path.display().to_string(),
            text.as_bytes(),
        );
        let mut files = self.files();
        files.push((street, front::street::write(self.front).into_bytes()));
        files.push((path.clone(), text.into_bytes()));
        self.committer.write_all(files)?;
        let world = FolderWorld::new(vec![self.output.to_owned()], PIXELS);
        hsd_driver::check(&[&source], &world, &hsd_driver::Options::default(), out);
        sources.push(source);
        let replaced = self.front.shown.iter().filter(|s| s.is_replaced).count();
        let parts = counted(self.front.parts.len(), noun("part", "部材{}個"));
        let (path, cells) = (path.display(), self.front.cells.len());
        Ok(text!([path, cells, parts, replaced]
            "{path}: {parts} for {cells} places, {replaced} of them cleared of what stands before them; `hsd build {path} -o OUT.glb` builds it",
            "{path}: {cells} か所に{parts}。うち {replaced} か所は手前の物を取り除きました。`hsd build {path} -o OUT.glb` で作れます"
        ))
    }

    /// Says what is not certain.
    fn doubts(&self, place: Span, out: &mut Diagnostics) {
        let front = self.front;
        if self.given.size.is_none() && front.views[0].focal == Told::Usual {
            out.push(say::guessed(place));
        }
        let is_whole = front.grid.columns.len() == 2 || front.grid.rows.len() == 2;
        if matches!(self.given.lattice, Lattice::Found) && is_whole {
            out.push(say::no_lattice(place));
        }
        for (cell, shown) in front.cells.iter().zip(&front.shown) {
            if shown.is_spoiled {
                out.push(say::spoiled(place, &front.name_at(cell.row, cell.column)));
            }
        }
    }

    /// All files but the text, with their paths.
    fn files(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let (photos, front) = (self.photos, self.front);
        let path = |name: &str| self.output.join(name);
        let compared = sheet::draw(&photos[0], front);
        let mut files = vec![
            (path(FACADE), record::json(photos, front).into_bytes()),
            (path(PARTS), front::text::catalogue(front).into_bytes()),
            (path(RECTIFIED), png(&front.wall, Packing::Quick)),
            (path(COMPARED), png(&compared, Packing::Quick)),
        ];
        for part in &front.parts {
            for (name, picture) in part.names().iter().zip(part.pictures()) {
                files.push((path(&format!("{name}.png")), png(picture, Packing::Quick)));
            }
        }
        if let Some(name) = self.fronts {
            files.extend(self.fronts(name));
        }
        files
    }

    /// What the text says of where it comes from: everything that was assumed.
    fn head(&self) -> Vec<String> {
        let (photos, front) = (self.photos, self.front);
        let names: Vec<&str> = photos.iter().map(|p| p.name.as_str()).collect();
        let mut head = vec![format!("Read by hsd facade from {}.", names.join(", "))];
        if self.given.size.is_none() {
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
    fn fronts(&self, name: &str) -> Vec<(PathBuf, Vec<u8>)> {
        let is_free = |n: &usize| !self.output.join(format!("{name}.{n}.png")).exists();
        let number = (1..).find(is_free).unwrap_or(1);
        let pictures = whole::fronts(self.front).into_iter();
        pictures
            .map(|(piece, picture)| {
                let path = self.output.join(format!("{name}{piece}.{number}.png"));
                (path, png(&picture, Packing::Quick))
            })
            .collect()
    }
}

/// Returns the paths of the source files that are written into a folder: the front, and the front in a street.
fn sources_in(folder: &Path) -> [PathBuf; 2] {
    let name = folder.file_name().unwrap_or("front".as_ref());
    let name = name.to_string_lossy();
    [format!("{name}.hsd"), street(&name)].map(|file| folder.join(file))
}

/// Returns the outputs in a folder whose names are known before the photographs are read.
pub(super) fn outputs_in(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let others = [FACADE, PARTS, RECTIFIED, COMPARED].map(|name| folder.join(name));
    others.into_iter().chain(sources_in(folder))
}

/// The name of the text that puts the front of a folder into a street.
pub(crate) fn street(name: &str) -> String {
    format!("{name}-street.hsd")
}

/// Reads a photograph, whose name becomes a source; `None` if it is none.
pub(crate) fn opened(
    path: &Path,
    sources: &mut Vec<Source>,
    out: &mut Diagnostics,
) -> Result<Option<Photo>, Failure> {
    let bytes = std::fs::read(path).map_err(|e| Failure::at(path.display(), e))?;
    let name = path.display().to_string();
    // What is told of a picture has no place in its bytes.
    let source = Source::new(FileId(sources.len() as u32), name, b"");
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let photo = match Picture::whole(&bytes) {
        Ok((picture, exif)) => {
            let pixels = picture.pixels;
            let focal = exif.and_then(|exif| exif::focal(&exif, pixels.dimensions()));
            Some(Photo {
                name: name.into_owned(),
                pixels,
                focal,
                mask: None,
                bend: None,
            })
        }
        Err(why) => {
            out.push(said::unreadable(source.span(0..0), &why));
            None
        }
    };
    sources.push(source);
    Ok(photo)
}
