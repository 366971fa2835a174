//! `hsd plan`: reads the picture or drawing of a floor plan and writes the house that it shows (docs/contract.md 11).
//!
//! | step | file | result |
//! |---|---|---|
//! | bytes are told apart by their content | [`drawing`] | [`drawing::Content`] |
//! | bytes of a picture are decoded and turned upright | `picture` | [`Picture`] |
//! | drawings in lines | [`vector`] | the same as of a picture |
//! | perspective and skew are taken away | [`flatten`] | [`flatten::Flat`] |
//! | ink is parted from paper | [`sheet`] | [`sheet::Ink`] |
//! | the grid of half ken is found | [`grid`] | [`grid::Grid`] |
//! | the strokes on each unit are compared with a legend | [`strokes`], [`legend`] | [`strokes::Units`] |
//! | outline and rooms follow | [`shape`] | [`shape::Shape`] |
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
pub mod flatten;
pub mod grid;
pub mod house;
pub mod legend;
pub mod marks;
mod picture;
pub(crate) mod raster;
pub mod register;
pub mod said;
pub mod shape;
pub mod sheet;
pub mod strokes;
pub mod text;
pub mod underlay;
pub mod vector;
pub mod walls;

pub use picture::{Picture, Unreadable};

use flatten::{Flat, Given};
use glam::{DMat3, DVec2};
use grid::Grid;
use image::RgbImage;
use legend::Legend;
use rayon::prelude::*;
use shape::Shape;
use sheet::Ink;
use strokes::Units;
use walls::scale::Evidence;

/// Legends of the program: names and texts.
pub use hsd_grammar::LEGENDS;

/// How much the units along and across may differ on a sheet that was scanned.
const SCANNED: f64 = 0.012;
/// The same, if its perspective was taken away: its proportions are guessed.
const PHOTOGRAPHED: f64 = 0.16;
/// The least share of ink on a sheet with a drawing.
const LEAST_INK: f64 = 0.001;
/// The least agreement of strokes with a grid.
const LEAST_FIT: f64 = 0.3;
/// The least agreement of strokes with a grid, or of walls seen round the house, with twice the share of the drawing that
/// is house: pictures of streets reach 0.75, the smallest house on the largest sheet 0.87.
const LEAST_TRUST: f64 = 0.8;
/// With less agreement than that half of the outer walls have to be seen, not joined.
const CLEAR_FIT: f64 = 0.8;
/// The fewest cells of a room, in the middle of all: ruled paper has one to each.
const LEAST_ROOM: f64 = 1.3;
/// What is smaller in both directions is writing, units.
const WRITING: f64 = 0.8;
/// What is narrower and lies on a line of the grid is part of a wall, units.
const SLIM: f64 = 0.3;
/// How far from a line of the grid that may be, units.
const ON_LINE: f64 = 0.06;
/// The least agreement of walls with a legend.
const LEAST_LIKENESS: f64 = 0.4;
/// How far strokes sway within a unit that are drawn along a ruler, units, and what the pixels of a sheet add to that, pixels. On
/// 26 to 100 pixels a unit 0.0001 to 0.0018 were seen along a ruler, 0.0012 and more by hand.
const STRAIGHT: f64 = 0.0006;
const STRAIGHT_PIXELS: f64 = 0.02;
/// How far beyond that strokes sway that are surely drawn by hand, units: up to there it counts in part.
const SWAYS: f64 = 0.0006;
/// The share by which legends of strokes by hand agree the less with strokes along a ruler, and the others with strokes by hand.
/// Blur makes all legends agree alike.
const RULED: f64 = 0.1;
const BY_HAND: f64 = 0.03;
/// The same for legends of wood on paper, and the others on wood.
const GROUND: f64 = 0.05;
/// The ink of a wall beside that of the walls of the outline: edges of mats reach 0.57 on blurred sheets, walls have 0.6 and more.
const THIN: f64 = 0.58;
/// The same for windows and lattices between rooms: on scans of survey drawings most such edges have less, and hardly any true
/// one, but board plans draw whole walls with little more.
const THIN_PANE: f64 = 0.44;
/// The agreement of strokes with a grid beyond which a plan is read on it. Plans of the drawn conventions reach 0.51 to 0.95. Real
/// plans off the grid 0.44 to 0.68, and 0.75 where walls stand at quarters of a ken.
const SURE_FIT: f64 = 0.7;
/// Half a ken where something else says how large a plan is, metres: edo-ma to kyo-ma.
const HALF_KEN: std::ops::RangeInclusive<f64> = 0.86..=1.03;
/// The least share of the ink of walls that a reading wall by wall explains beyond that of the grid: above that agreement and below
/// it. `NEARLY_ALL` and `ALL` are shares it explains where less is enough.
const MUCH_MORE: f64 = 0.25;
const MORE: f64 = 0.1;
const NEARLY_ALL: f64 = 0.9;
const ALL: f64 = 0.97;
/// The share of doubtful walls above which a reading on a grid yields to walls that explain nearly all. Plans of the drawn
/// conventions have up to 0.1.
const DOUBTFUL: f64 = 0.15;
/// The least share of the ink of walls that a house on a grid explains: streets reach 0.28, plans of the drawn conventions 0.53.
const LEAST_EXPLAINED: f64 = 0.4;
/// The fewest cells of a house.
const LEAST_CELLS: usize = 4;

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
    /// Where the street is.
    pub front: Front,
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

    fn stopped(self, why: Refused) -> Box<Stopped> {
        Box::new(Stopped {
            why,
            flat: self.flat,
            ink: self.ink,
            grid: Some(self.grid),
            units: Some(self.units),
            shape: Some(self.shape),
        })
    }
}

/// Why a picture has no plan: what was looked for, and how much of it was found (a share).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// Nearly no ink.
    Blank(f64),
    /// Strokes that keep to no grid.
    NoGrid(f64),
    /// Strokes on the grid that look like nothing in any legend.
    NoSymbols(f64),
    /// No walls that close.
    NoHouse,
    /// Closed walls whose size nothing shows.
    NoSize,
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
}

impl Stopped {
    fn at(self, why: Refused) -> Box<Stopped> {
        Box::new(Stopped { why, ..self })
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

/// Reads the plan on an image on a grid of half ken and wall by wall; returns the result that explains more walls.
///
/// # Errors
/// If there is no plan; with what the steps had found.
pub fn read(
    picture: &Picture,
    legends: &[Legend],
    options: &Options,
) -> Result<Plan, Box<Stopped>> {
    let grid = find(picture, legends, options);
    let (flat, ink) = match &grid {
        Ok(found) => (&found.flat, &found.ink),
        Err(stopped) => (&stopped.flat, &stopped.ink),
    };
    let by_unit = options.unit.map(|unit| walls::writing::UNIT / unit);
    let reading = walls::read(ink).map(|reading| {
        let by_file = options
            .metres
            .filter(|metres| reading.is_as_large_as_a_house(*metres));
        let scale = walls::scale::of(&reading, ink, by_unit.or(by_file));
        (reading, scale)
    });
    let better = reading.filter(|(reading, scale)| is_better(reading, *scale, &grid));
    match better {
        // Both ways lose a part of the house.
        Some((reading, _)) if !reading.is_whole() => Err(match grid {
            Ok(found) => found.stopped(Refused::NoHouse),
            Err(stopped) => stopped,
        }),
        Some((reading, Some(scale))) => Ok(Plan::Walls(Box::new(walls::Found {
            flat: flat.clone(),
            reading,
            scale,
        }))),
        Some((_, None)) => Err(match grid {
            Ok(found) => found.stopped(Refused::NoSize),
            Err(stopped) => stopped.at(Refused::NoSize),
        }),
        None => {
            let found = grid?;
            // A house is missing if hardly any of the walls of a sheet belong to it.
            match explained(&found) < LEAST_EXPLAINED {
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
            let least = if is_doubtful { 0.0 } else { MORE };
            more > MUCH_MORE || more > least && (is_doubtful || reading.explained >= ALL)
        }
        false => more > MORE || more > 0.0 && reading.explained >= NEARLY_ALL,
    }
}

/// Finds the house in a picture, by the legend that agrees best.
///
/// # Errors
/// If there is none; with what the steps had found.
pub fn find(
    picture: &Picture,
    legends: &[Legend],
    options: &Options,
) -> Result<Found, Box<Stopped>> {
    let mut flat = flatten::flatten(&picture.pixels, &options.given);
    turn(&mut flat, options.front);
    let ink = Ink::of(&flat.sheet);
    let share = ink.share();
    let aspect = match flat.corners {
        Some(_) => PHOTOGRAPHED,
        None => SCANNED,
    };
    let mut seen = Stopped {
        why: Refused::NoHouse,
        flat,
        ink,
        grid: None,
        units: None,
        shape: None,
    };
    if share < LEAST_INK {
        return Err(seen.at(Refused::Blank(share)));
    }
    let Some(grid) = Grid::find(&seen.ink, options.unit, aspect) else {
        return Err(seen.at(Refused::NoGrid(0.0)));
    };
    seen.grid = Some(grid);
    if grid.fit < LEAST_FIT {
        return Err(seen.at(Refused::NoGrid(grid.fit)));
    }
    let straight = seen.ink.without_slanting();
    let (inks, sheet) = ((&seen.ink, &straight), &seen.flat.sheet);
    let Some((units, legend)) = by_best_legend(inks, &grid, legends, sheet) else {
        return Err(seen.at(Refused::NoSymbols(0.0)));
    };
    if units.likeness < LEAST_LIKENESS {
        let why = Refused::NoSymbols(units.likeness);
        seen.units = Some(units);
        return Err(seen.at(why));
    }
    let thickness = Shape::of(&units).thickness();
    let units = units.without_thin_walls(THIN * thickness);
    let edges = Shape::of(&units).thin_panes(THIN_PANE * thickness);
    let units = units.with_mats(&edges);
    let shape = Shape::of(&units);
    if !is_house(&shape, &grid) {
        (seen.units, seen.shape) = (Some(units), Some(shape));
        return Err(seen.at(Refused::NoHouse));
    }
    let shape = shape::inside::furnished(shape, &legend.things, inks, &grid, legend.is_by_hand);
    Ok(Found {
        flat: seen.flat,
        ink: seen.ink,
        grid,
        units,
        shape,
        legend: legend.name.clone(),
    })
}

/// Reads the units of a grid by each legend, from all ink and from that which does not run aslant; returns those that agree best, of
/// two that agree equally the first. The sheet tells what it is of.
fn by_best_legend<'l>(
    (ink, straight): (&Ink, &Ink),
    grid: &Grid,
    legends: &'l [Legend],
    sheet: &RgbImage,
) -> Option<(Units, &'l Legend)> {
    let pen = strokes::pen(ink, grid);
    let walls = straight.without_writing(WRITING * grid.unit, |middle, size| {
        // Posts and the bars of lattices are small too, but stand on lines of the grid.
        let at = grid.units_of(middle);
        let off = (at - at.round()).abs();
        let (thin, flat) = (size.x < SLIM * grid.unit, size.y < SLIM * grid.unit);
        thin && off.x < ON_LINE || flat && off.y < ON_LINE
    });
    let lines = strokes::Lines::of(&walls, ink, grid);
    let look = |legend| (strokes::Look::of(&lines, legend, pen), legend);
    let looks: Vec<(strokes::Look, &Legend)> = legends.par_iter().map(look).collect();
    let along_ruler = STRAIGHT + STRAIGHT_PIXELS / grid.unit;
    // 0 along a ruler, 1 as soon as strokes surely sway, 2 twice as far beyond.
    let sways = ((lines.sway() - along_ruler) / SWAYS).clamp(0.0, 2.0);
    // What a legend with red strokes reads as such is unexplained by those without. Faint lines and grain have a red rim too.
    let reds = looks.iter().map(|look| look.0.red());
    let red = reds.fold(0.0, f64::max);
    let wood = sheet::ground::wood(sheet);
    let agreement = |(look, legend): &(strokes::Look, &Legend)| {
        let unexplained = if legend.has_red() { 0.0 } else { red };
        let ground = match legend.is_on_wood {
            true => GROUND * (1.0 - wood),
            false => GROUND * wood,
        };
        let doubt = match legend.is_by_hand {
            true => RULED * (1.0 - sways).max(0.0),
            false => BY_HAND * (sways - 1.0).max(0.0),
        };
        look.likeness * (1.0 - doubt) * (1.0 - unexplained) * (1.0 - ground)
    };
    let better = |a: (strokes::Look, &'l Legend), b: (strokes::Look, &'l Legend)| {
        if agreement(&b) > agreement(&a) { b } else { a }
    };
    let (best, legend) = looks.into_iter().reduce(better)?;
    Some((best.units(grid).with_cells(straight, grid), legend))
}

/// Whether what was found is a house: not a few strokes of something else that happen to close, nor ruled paper.
fn is_house(shape: &Shape, grid: &Grid) -> bool {
    let cells = shape.cells.len() as f64;
    let drawn = f64::from((grid.across.1 - grid.across.0) * (grid.down.1 - grid.down.0));
    let seen = shape
        .outer
        .iter()
        .filter(|w| !w.is_joined && w.read.role.parts())
        .count();
    let seen = seen as f64 / shape.outer.len().max(1) as f64;
    // Where few strokes keep to the grid, or few walls are seen, the house has to fill the drawing.
    let trust = grid.fit.max(0.15 + seen / 2.0) + 2.0 * cells / drawn;
    let is_seen = seen >= 0.5 || grid.fit >= CLEAR_FIT;
    is_seen
        && shape.cells.len() >= LEAST_CELLS
        && trust >= LEAST_TRUST
        && cells >= LEAST_ROOM * shape.rooms.len() as f64
}

/// Turns a sheet so that the street is at its lower edge.
fn turn(flat: &mut Flat, front: Front) {
    let (width, height) = (
        f64::from(flat.sheet.width()),
        f64::from(flat.sheet.height()),
    );
    // Takes pixels of the turned sheet to those of the sheet.
    let (sheet, back) = match front {
        Front::Bottom => return,
        Front::Top => (
            image::imageops::rotate180(&flat.sheet),
            DMat3::from_cols_array(&[-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, width, height, 1.0]),
        ),
        Front::Left => (
            image::imageops::rotate270(&flat.sheet),
            DMat3::from_cols_array(&[0.0, 1.0, 0.0, -1.0, 0.0, 0.0, width, 0.0, 1.0]),
        ),
        Front::Right => (
            image::imageops::rotate90(&flat.sheet),
            DMat3::from_cols_array(&[0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, height, 1.0]),
        ),
    };
    flat.sheet = sheet;
    flat.to_picture *= back;
}
