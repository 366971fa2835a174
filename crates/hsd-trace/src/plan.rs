//! `hsd plan`: reads the picture or drawing of a floor plan and writes the house that it shows (docs/contract.md 11).
//!
//! | step | file | result |
//! |---|---|---|
//! | bytes are told apart by their content | [`drawing`] | [`drawing::Content`] |
//! | drawings in lines | [`vector`] | the same as of a picture |
//! | plans of one sheet are separated | `several` | the boxes of the plans |
//! | an image is read on the grid of half ken, by a legend | [`hsd_scan`] | [`shape::Shape`] |
//! | floors, stairs and fixtures are recognised | [`shape::inside`] | the shape with them |
//! | storeys are laid over each other | [`register`] | a move in units |
//! | the source file is written | [`house`], [`text`] | [`house::House`] |
//! | the sheet is drawn for the review | [`underlay`] | a picture, and a map to the house |
//! | over an edited one | [`again`] | [`again::Merged`] |
//! | plans that keep to no grid are read wall by wall | [`walls`] | [`walls::Found`] |
//!
//! Each step is a function from one typed thing to the next; [`marks`] draws what each has found. The same picture gives the
//! same bytes. Lengths are pixels of the sheet or units of the grid (half a ken), places run to the right and down.

pub mod again;
pub mod drawing;
mod gridded;
pub mod house;
pub mod marks;
pub mod register;
pub mod said;
mod several;
pub mod text;
mod thicknesses;
pub mod underlay;
pub mod vector;
pub mod walls;

pub use gridded::find;
pub use hsd_scan::picture::{Picture, Unreadable};
pub use hsd_scan::{flatten, grid, legend, raster, shape, sheet, strokes};

use flatten::{Flat, Given, Region};
use glam::DVec2;
use grid::Grid;
use gridded::Gridded;
use legend::Legend;
use shape::Shape;
use sheet::Ink;
use strokes::Units;
use walls::scale::Evidence;

/// Legends of the program: names and texts.
pub use hsd_grammar::LEGENDS;

/// The agreement of strokes with a grid beyond which a plan is read on it. Plans of the drawn conventions reach 0.51 to 0.95. Real
/// plans off the grid 0.44 to 0.68, and 0.75 where walls stand at quarters of a ken.
const SURE_FIT: f64 = 0.7;
/// Half a ken where something else says how large a plan is, metres: edo-ma to kyo-ma.
const HALF_KEN: std::ops::RangeInclusive<f64> = 0.86..=1.03;
/// Units of a grid are longer than this, metres, even by a scale in doubt. Shorter ones belong to tiles or mats.
const FINE: f64 = 0.3;
/// The least share of the ink of walls that a reading wall by wall explains beyond that of the grid: above that agreement and below
/// it. `NEARLY_ALL` and `ALL` are shares it explains where less is enough.
const MUCH_MORE: f64 = 0.25;
const MORE: f64 = 0.1;
const NEARLY_ALL: f64 = 0.9;
const ALL: f64 = 0.97;
/// The share of doubtful walls above which a reading on a grid yields to walls that explain nearly all. Plans of the drawn
/// conventions have up to 0.1.
const DOUBTFUL: f64 = 0.15;
/// The share of doubtful walls above which a reading is rejected if few strokes agree with its grid. Western plans reach 0.59 to
/// 0.64 on a grid of agreement 0.6.
const MOSTLY_DOUBTFUL: f64 = 0.5;
/// The least share of the ink of walls that a house on a grid explains: streets reach 0.28, plans of the drawn conventions 0.53.
const LEAST_EXPLAINED: f64 = 0.4;

/// The side of the sheet where the street is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Front {
    /// At the lower edge, as most plans are drawn.
    #[default]
    Bottom,
    /// At the left edge.
    Left,
    /// At the upper edge.
    Top,
    /// At the right edge.
    Right,
}

/// What is known of a plan.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How the picture was taken.
    pub given: Given,
    /// The length of a unit, pixels of the flat sheet.
    pub unit: Option<f64>,
    /// The length of a pixel, metres, if the file says it.
    pub metres: Option<f64>,
    /// The units that a drawing without one may have: each its millimetres and the length of a pixel, metres.
    pub units: Vec<(f64, f64)>,
    /// Where the street is.
    pub front: Front,
    /// The box of the image with the plan, pixels. Otherwise the largest plan is read.
    pub region: Option<Region>,
}

/// What the steps have found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The flat sheet.
    pub flat: Flat,
    /// Its ink.
    pub ink: Ink,
    /// Its grid.
    pub grid: Grid,
    /// What its strokes stand for.
    pub units: Units,
    /// The house.
    pub shape: Shape,
    /// The name of the legend.
    pub legend: String,
}

impl Found {
    /// Pixels of the picture of a place in units.
    pub fn in_picture(&self, at: DVec2) -> DVec2 {
        raster::project(self.flat.to_picture, self.grid.at(at.x, at.y))
    }

    /// Returns the share of the walls that were read with doubt.
    fn doubtful(&self) -> f64 {
        let walls = || self.shape.outer.iter().chain(&self.shape.inner);
        let doubtful = walls().filter(|wall| text::is_doubtful(wall)).count();
        doubtful as f64 / walls().count().max(1) as f64
    }

    /// Returns true if strokes hardly agree with the grid and most walls are in doubt.
    fn is_unlike(&self) -> bool {
        self.grid.fit < SURE_FIT && self.doubtful() > MOSTLY_DOUBTFUL
    }

    fn stopped(self, why: Refused) -> Box<Stopped> {
        Box::new(Stopped {
            why,
            flat: self.flat,
            ink: self.ink,
            grid: Some(self.grid),
            units: Some(self.units),
            shape: Some(self.shape),
            reading: None,
        })
    }
}

/// The reason why there is no plan in an image. Numbers are shares of what is needed, if nothing else is stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// Nearly no ink.
    Blank(f64),
    /// Strokes that keep to no grid.
    NoGrid(f64),
    /// Strokes on a grid with more cells than a plan has: their number.
    TooFine(i64),
    /// Strokes on the grid that look like nothing in any legend.
    NoSymbols(f64),
    /// No walls that close.
    NoHouse,
    /// Closed walls whose size nothing shows.
    NoSize,
    /// Nothing in the box that was asked for.
    Outside,
}

/// What the steps had found when one of them found too little.
#[derive(Clone, Debug)]
pub struct Stopped {
    /// Why there is no plan.
    pub why: Refused,
    /// The flat sheet.
    pub flat: Flat,
    /// Its ink.
    pub ink: Ink,
    /// The grid that fits best.
    pub grid: Option<Grid>,
    /// What strokes would stand for.
    pub units: Option<Units>,
    /// What walls enclose.
    pub shape: Option<Shape>,
    /// The plan read wall by wall, which leaves walls out or has no size.
    pub reading: Option<walls::Reading>,
}

impl Stopped {
    fn at(self, why: Refused) -> Box<Stopped> {
        Box::new(Stopped { why, ..self })
    }

    fn with(self, reading: walls::Reading) -> Box<Stopped> {
        let reading = Some(reading);
        Box::new(Stopped { reading, ..self })
    }
}

/// A plan as it was read.
#[derive(Clone, Debug)]
pub enum Plan {
    /// On a grid of half ken, by a legend.
    Grid(Box<Found>),
    /// Wall by wall.
    Walls(Box<walls::Found>),
}

impl Plan {
    fn flat_mut(&mut self) -> &mut Flat {
        match self {
            Plan::Grid(found) => &mut found.flat,
            Plan::Walls(found) => &mut found.flat,
        }
    }
}

/// Reads the plan on an image on a grid of half ken and wall by wall; returns the result that explains more walls. Of several plans
/// it reads the largest; the flat sheet has the boxes of all.
///
/// # Errors
/// If there is no plan; with what the steps had found.
pub fn read(
    picture: &Picture,
    legends: &[Legend],
    options: &Options,
) -> Result<Plan, Box<Stopped>> {
    match Gridded::of(picture, options) {
        Err(stopped) if stopped.why == Refused::Outside => Err(stopped),
        sheet => read_sheet(sheet, legends, options),
    }
}

/// Reads the plan on a sheet, as [`read`] does.
fn read_sheet(
    sheet: Result<Gridded, Box<Stopped>>,
    legends: &[Legend],
    options: &Options,
) -> Result<Plan, Box<Stopped>> {
    let ink = match &sheet {
        Ok(sheet) => &sheet.ink,
        Err(stopped) => &stopped.ink,
    };
    let reading = walls::read(ink).map(|reading| {
        let scale = reading.scale(ink, options);
        (reading, scale)
    });
    let grid = sheet.and_then(|sheet| {
        let is_settled = reading
            .as_ref()
            .is_some_and(|(reading, scale)| surpasses(reading, *scale, &sheet.grid));
        let fit = sheet.grid.fit;
        match is_settled {
            true => Err(sheet.stopped(Refused::NoGrid(fit))),
            false => sheet.by_legend(legends),
        }
    });
    let flat = match &grid {
        Ok(found) => &found.flat,
        Err(stopped) => &stopped.flat,
    };
    let better = reading.filter(|(reading, scale)| is_better(reading, *scale, &grid));
    match better {
        // Both ways lose a part of the house.
        Some((reading, _)) if !reading.is_whole() => {
            let stopped = match grid {
                Ok(found) => found.stopped(Refused::NoHouse),
                Err(stopped) => stopped,
            };
            Err(stopped.with(reading))
        }
        Some((reading, Some(scale))) => Ok(Plan::Walls(Box::new(walls::Found::new(
            flat.clone(),
            reading,
            scale,
        )))),
        Some((reading, None)) => {
            let stopped = match grid {
                Ok(found) => found.stopped(Refused::NoSize),
                Err(stopped) => stopped.at(Refused::NoSize),
            };
            Err(stopped.with(reading))
        }
        None => {
            let found = grid?;
            // A house is missing if hardly any of the walls of a sheet belong to it.
            match found.is_unlike() || explained(&found) < LEAST_EXPLAINED {
                true => Err(found.stopped(Refused::NoHouse)),
                false => Ok(Plan::Grid(Box::new(found))),
            }
        }
    }
}

/// Returns the share of the ink of walls that belongs to a wall of a house on a grid.
fn explained(found: &Found) -> f64 {
    let mut strokes = walls::mask::Strokes::of(&found.ink);
    walls::letters::remove(&mut strokes);
    let at = |(u, v): (i32, i32)| found.grid.at(f64::from(u), f64::from(v));
    let walls = found.shape.outer.iter().chain(&found.shape.inner);
    strokes.explained(walls.map(|w| [at(w.from), at(w.to)]))
}

/// Returns true if no legend need be tried. Either the grid contradicts the scale of a reading wall by wall, or it is doubtful or
/// too fine. Then the reading has to explain the sheet.
fn surpasses(reading: &walls::Reading, scale: Option<walls::scale::Scale>, grid: &Grid) -> bool {
    let Some(scale) = scale.filter(|_| reading.is_whole()) else {
        return false;
    };
    let contradicts = scale.is_sure() && !HALF_KEN.contains(&(grid.unit * scale.metres));
    let is_on_grid = scale.is_sure() && scale.evidence != Evidence::Given;
    let is_in_doubt = grid.fit < SURE_FIT || grid.unit * scale.metres < FINE;
    contradicts || !is_on_grid && is_in_doubt && reading.explained >= ALL
}

/// Returns true if a reading wall by wall explains more of a sheet than one on a grid, or the grid contradicts printed dimensions.
fn is_better(
    reading: &walls::Reading,
    scale: Option<walls::scale::Scale>,
    grid: &Result<Found, Box<Stopped>>,
) -> bool {
    let found = match grid {
        Ok(found) => found,
        Err(stopped) => return !matches!(stopped.why, Refused::Blank(_)),
    };
    let sure = scale.filter(|scale| scale.is_sure() && reading.is_whole());
    if let Some(scale) = sure {
        let half_ken = found.grid.unit * scale.metres;
        if !HALF_KEN.contains(&half_ken) {
            return true;
        }
        if scale.evidence != Evidence::Given {
            return false;
        }
    }
    let more = reading.explained - explained(found);
    match found.grid.fit >= SURE_FIT {
        true => {
            let is_doubtful = found.doubtful() > DOUBTFUL && reading.explained >= NEARLY_ALL;
            let explains = if is_doubtful {
                more >= 0.0
            } else {
                more > MORE && reading.explained >= ALL
            };
            more > MUCH_MORE || explains
        }
        false => {
            let is_unlike = found.is_unlike() && reading.is_whole();
            is_unlike || more > MORE || more > 0.0 && reading.explained >= NEARLY_ALL
        }
    }
}
