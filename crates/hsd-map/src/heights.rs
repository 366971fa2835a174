//! Grids of heights: the ground of a town. One reader a format, all behind [`read`]; what comes out is always a grid of
//! numbers with its place, so that nothing else in the program knows formats.
//!
//! | format | file |
//! |---|---|
//! | ESRI ASCII grid | `ascii` |
//! | GeoTIFF | `geotiff`, its tags in `geokeys` |
//! | GSI's elevation model in GML (DEM1A to DEM10B) | `gml` |
//! | GSI's elevation tiles of text (z/x/y.txt) | `tile` |
//!
//! Only the cells in a window are kept, so that memory follows the town, not the file. A cell without a height is NaN.

mod ascii;
mod cut;
mod geokeys;
mod geotiff;
mod gml;
mod packed;
mod tile;

use super::fault::{Fault, Kind};
use super::input::Input;
use super::{Crs, Options};
use cut::Cut;
use glam::DVec2;
use hsd_base::source::World;
use std::sync::Arc;

/// A grid of heights.
#[derive(Clone, Debug, PartialEq)]
pub struct Heights {
    /// The reference system of its places; `None` if the file does not say it.
    pub crs: Option<Crs>,
    /// The middle of the first cell.
    first: DVec2,
    /// From a cell to the next one of its row, and from a row to the next one.
    step: DVec2,
    columns: usize,
    rows: usize,
    /// Metres, row after row; NaN where there is none. The last cells may be left out if they have none.
    values: Vec<f32>,
    /// Which part of the grid `values` are; `None` for all of it.
    part: Option<Part>,
}

/// The cells of a grid that are here.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    /// The first column and row that are here.
    from: [usize; 2],
    /// The number of columns that are here.
    width: usize,
}

/// The box of places that are asked for, in the system of a file; `None` for all.
pub type Window<'w> = &'w dyn Fn(&Crs) -> Option<[DVec2; 2]>;

/// Heights beyond these are marks for cells without one, whether the file says so or not: the deepest trench, the highest peak.
const LOWEST: f64 = -12_000.0;
const HIGHEST: f64 = 9_000.0;

/// Returns a height as a grid keeps it.
fn height(value: f64) -> f32 {
    match value > LOWEST && value < HIGHEST {
        true => value as f32,
        false => f32::NAN,
    }
}

/// The forms of grids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Ascii,
    GeoTiff,
    Gml,
    /// Zoom, column and row of a tile of the web.
    Tile(u32, u32, u32),
}

/// Returns true if a file is a grid of heights, by its first bytes and its name. One that cannot be read is none.
pub fn is_grid(world: &dyn World, path: &str) -> bool {
    let file: Arc<str> = path.into();
    let form = Input::open(world, &file).and_then(|mut input| Ok(form(input.head(&file)?, path)));
    form.is_ok_and(|form| form.is_some())
}

/// Reads a grid of heights, a path that [`World::text`] has found; what is wrong with it but does not prevent that is put
/// into `remarks`.
///
/// # Errors
/// If it cannot be read, or is none of heights.
pub fn read(
    world: &dyn World,
    path: &str,
    options: &Options,
    window: Window<'_>,
    remarks: &mut Vec<Fault>,
) -> Result<Heights, Fault> {
    let file: Arc<str> = path.into();
    let mut input = Input::open(world, &file)?;
    let Some(form) = form(input.head(&file)?, path) else {
        return Err(Fault::of_file(&file, Kind::UnknownFormat));
    };
    let wish = Wish {
        world,
        file: &file,
        options,
        window,
    };
    let heights = match form {
        Form::Ascii => ascii::read(input, &wish, remarks)?,
        Form::Gml => gml::read(input, &wish, remarks)?,
        Form::Tile(zoom, x, y) => tile::read(input, &wish, (zoom, x, y), remarks)?,
        Form::GeoTiff => {
            drop(input);
            geotiff::read(&wish)?
        }
    };
    wish.check_place(&heights)?;
    Ok(heights)
}

/// Returns the form of a grid that begins with these bytes.
fn form(head: &[u8], path: &str) -> Option<Form> {
    if [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"].contains(&head.first_chunk()?) {
        return Some(Form::GeoTiff);
    }
    let text = String::from_utf8_lossy(&head[..head.len().min(16 << 10)]);
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('<') {
        return (text.contains("<DEM") && text.contains("coverage")).then_some(Form::Gml);
    }
    let word = text.split_whitespace().next()?.to_ascii_lowercase();
    if ascii::KEYS.contains(&&*word) {
        return Some(Form::Ascii);
    }
    tile::place(path, text).map(|(zoom, x, y)| Form::Tile(zoom, x, y))
}

/// What is asked of a reader.
struct Wish<'w> {
    world: &'w dyn World,
    file: &'w Arc<str>,
    options: &'w Options,
    window: Window<'w>,
}

impl Wish<'_> {
    fn fault(&self, kind: Kind) -> Fault {
        Fault::of_file(self.file, kind)
    }

    /// Returns the system that the layer names, else that of the file.
    fn crs(&self, own: Option<Crs>) -> Option<Crs> {
        self.options.crs.clone().or(own)
    }

    /// Refuses a grid whose corners cannot lie in its system.
    fn check_place(&self, heights: &Heights) -> Result<(), Fault> {
        let Some(crs) = &heights.crs else {
            return Ok(());
        };
        for corner in heights.bounds() {
            if let Some(seems) = crs.refuses(corner) {
                return Err(self.fault(Kind::OutsideCrs {
                    x: corner.x,
                    y: corner.y,
                    crs: crs.name.clone(),
                    seems,
                }));
            }
        }
        Ok(())
    }
}

impl Heights {
    fn of(crs: Option<Crs>, cut: Cut) -> Heights {
        Heights {
            crs,
            first: cut.first(),
            step: cut.step(),
            columns: cut.columns(),
            rows: cut.height(),
            values: cut.values,
            part: None,
        }
    }

    /// Returns the row behind the last one of which cells are here.
    fn end(&self) -> usize {
        let (from, width) = match &self.part {
            Some(part) => (part.from[1], part.width),
            None => (0, self.columns),
        };
        from + self.values.len().div_ceil(width.max(1))
    }

    /// Returns its corners, lowest and highest.
    pub fn bounds(&self) -> [DVec2; 2] {
        let half = self.step / 2.0;
        let cells = DVec2::new(self.columns as f64, self.rows as f64);
        let (a, b) = (self.first - half, self.first - half + cells * self.step);
        [a.min(b), a.max(b)]
    }

    /// Returns the sides of a cell in the units of its system.
    pub fn cell(&self) -> DVec2 {
        self.step.abs()
    }

    /// Returns true if no cell has a height.
    pub fn is_empty(&self) -> bool {
        self.values.iter().all(|h| h.is_nan())
    }

    /// Returns the bytes that it takes.
    pub fn bytes(&self) -> usize {
        self.values.len() * size_of::<f32>()
    }

    /// Returns the height of a cell; `None` for one that is not here.
    fn cell_at(&self, column: usize, row: usize) -> Option<f32> {
        let (x, y, width) = match &self.part {
            None => (column, row, self.columns),
            Some(part) => {
                let x = column.checked_sub(part.from[0])?;
                (x, row.checked_sub(part.from[1])?, part.width)
            }
        };
        (x < width).then(|| self.values.get(y * width + x).copied())?
    }

    /// Returns the height at a place: between the middles of four cells, at the edge that of the outer ones; `None` where a
    /// cell that counts has none.
    pub fn at(&self, place: DVec2) -> Option<f64> {
        let (columns, rows) = (self.columns as f64, self.rows as f64);
        let at = (place - self.first) / self.step;
        let inside = at.x >= -0.5 && at.y >= -0.5 && at.x <= columns - 0.5 && at.y <= rows - 0.5;
        if !inside {
            return None;
        }
        let at = at.clamp(DVec2::ZERO, DVec2::new(columns - 1.0, rows - 1.0));
        let low = at.floor();
        let part = at - low;
        let (mut sum, mut whole) = (0.0, 0.0);
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let share = |part: f64, d: usize| if d == 0 { 1.0 - part } else { part };
            let weight = share(part.x, dx) * share(part.y, dy);
            // On the middle of a cell, but for rounding, others do not count.
            if weight > 1e-6 {
                let height = self.cell_at(low.x as usize + dx, low.y as usize + dy)?;
                sum += weight * f64::from(height);
                whole += weight;
            }
        }
        sum.is_finite().then_some(sum / whole)
    }
}
