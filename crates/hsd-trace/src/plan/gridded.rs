//! Reads a plan on the grid of half ken to which its strokes keep.

use super::flatten::{self, Flat, Region};
use super::grid::{Grid, MOST_CELLS};
use super::legend::Legend;
use super::several;
use super::shape::{self, Shape};
use super::sheet::{self, Ink};
use super::strokes::{self, Units};
use super::{Found, Front, Options, Picture, Refused, Stopped};
use glam::DMat3;
use image::RgbImage;
use rayon::prelude::*;

/// The share by which units along and across may differ on a sheet that was scanned.
const SCANNED: f64 = 0.012;
/// Such a share if perspective was taken away: the proportions of the sheet are guessed.
const PHOTOGRAPHED: f64 = 0.16;
/// The least share of ink on a sheet with a drawing.
const LEAST_INK: f64 = 0.001;
/// The least agreement of strokes with a grid.
const LEAST_FIT: f64 = 0.3;
/// The least agreement of strokes with a grid, or of walls seen round the house, with twice the share of the drawing that
/// is house. Images of streets reach 0.75, the smallest house on the largest sheet 0.87.
const LEAST_TRUST: f64 = 0.8;
/// With less agreement than that half of the outer walls have to be seen, not joined.
const CLEAR_FIT: f64 = 0.8;
/// The fewest cells of a room, in the middle of all: ruled paper has one to each.
const LEAST_ROOM: f64 = 1.3;
/// The greatest side of writing, units.
const WRITING: f64 = 0.8;
/// The greatest width of a part of a wall on a line of the grid, units.
const SLIM: f64 = 0.3;
/// The greatest distance from a line of the grid on it, units.
const ON_LINE: f64 = 0.06;
/// The least agreement of walls with a legend.
const LEAST_LIKENESS: f64 = 0.4;
/// The sway within a unit of strokes along a ruler, units, and what the pixels of a sheet add to that, pixels. On
/// 26 to 100 pixels a unit 0.0001 to 0.0018 were seen along a ruler, 0.0012 and more by hand.
const STRAIGHT: f64 = 0.0006;
const STRAIGHT_PIXELS: f64 = 0.02;
/// The sway beyond that of strokes that are surely drawn by hand, units: up to there it counts in part.
const SWAYS: f64 = 0.0006;
/// The share by which legends of strokes by hand agree the less with strokes along a ruler, and the others with strokes by hand.
/// Blur makes all legends agree equally.
const RULED: f64 = 0.1;
const BY_HAND: f64 = 0.03;
/// Such a share for legends of wood on paper, and for the others on wood.
const GROUND: f64 = 0.05;
/// The ink of a wall beside that of the walls of the outline. Edges of mats reach 0.57 on blurred sheets, walls have 0.6 and more.
const THIN: f64 = 0.58;
/// Such a share for windows and lattices between rooms. On scans of survey drawings most such edges have less, and hardly any true
/// one. Board plans draw whole walls with little more.
const THIN_PANE: f64 = 0.44;
/// The fewest cells of a house.
const LEAST_CELLS: usize = 4;

/// Finds the house in an image, by the legend that agrees best.
///
/// # Errors
/// If there is none; with what the steps had found.
pub fn find(
    picture: &Picture,
    legends: &[Legend],
    options: &Options,
) -> Result<Found, Box<Stopped>> {
    Gridded::of(picture, options)?.by_legend(legends)
}

/// A flat sheet and its grid.
pub(super) struct Gridded {
    pub(super) flat: Flat,
    pub(super) ink: Ink,
    pub(super) grid: Grid,
}

impl Gridded {
    /// Makes a sheet flat, and finds its ink and its grid in the box that was asked for, otherwise in that of the largest plan.
    pub(super) fn of(picture: &Picture, options: &Options) -> Result<Gridded, Box<Stopped>> {
        let mut flat = flatten::flatten(&picture.pixels, &options.given);
        turn(&mut flat, options.front);
        let ink = Ink::of(&flat.sheet);
        if let Some(region) = options.region {
            let region = flat.on_sheet(region);
            return Gridded::within(region, flat, ink, options);
        }
        match several::plans(&ink) {
            Some(several) => {
                flat.plans = several.regions;
                Gridded::within(several.largest, flat, ink, options)
            }
            None => Gridded::on(flat, ink, options),
        }
    }

    /// Finds the grid in a box of a sheet. The ink of all is known: a wall at the edge of the box is not the edge of a sheet.
    fn within(
        region: Region,
        mut flat: Flat,
        ink: Ink,
        options: &Options,
    ) -> Result<Gridded, Box<Stopped>> {
        match flat.crop(region) {
            Some([x, y, width, height]) => {
                let ink = ink.within([x, y], [width, height]);
                Gridded::on(flat, ink, options)
            }
            None => Err(Box::new(Stopped {
                why: Refused::Outside,
                flat,
                ink,
                grid: None,
                units: None,
                shape: None,
                reading: None,
            })),
        }
    }

    /// Finds the grid of a sheet.
    fn on(flat: Flat, ink: Ink, options: &Options) -> Result<Gridded, Box<Stopped>> {
        let share = ink.share();
        let aspect = match flat.corners {
            Some(_) => PHOTOGRAPHED,
            None => SCANNED,
        };
        let grid = match share < LEAST_INK {
            true => Err((Refused::Blank(share), None)),
            false => match Grid::find(&ink, options.unit, aspect) {
                None => Err((Refused::NoGrid(0.0), None)),
                Some(grid) if grid.fit < LEAST_FIT => Err((Refused::NoGrid(grid.fit), Some(grid))),
                Some(grid) if grid.cells() > MOST_CELLS => {
                    Err((Refused::TooFine(grid.cells()), Some(grid)))
                }
                Some(grid) => Ok(grid),
            },
        };
        match grid {
            Ok(grid) => Ok(Gridded { flat, ink, grid }),
            Err((why, grid)) => Err(Box::new(Stopped {
                why,
                flat,
                ink,
                grid,
                units: None,
                shape: None,
                reading: None,
            })),
        }
    }

    /// Finds the house by the legend that agrees best.
    pub(super) fn by_legend(self, legends: &[Legend]) -> Result<Found, Box<Stopped>> {
        let Gridded { flat, ink, grid } = &self;
        let straight = ink.without_slanting();
        let inks = (ink, &straight);
        let Some((units, legend)) = by_best_legend(inks, grid, legends, &flat.sheet) else {
            return Err(self.stopped(Refused::NoSymbols(0.0)));
        };
        if units.likeness < LEAST_LIKENESS {
            let why = Refused::NoSymbols(units.likeness);
            let units = Some(units);
            return Err(Box::new(Stopped {
                units,
                ..*self.stopped(why)
            }));
        }
        let thickness = Shape::of(&units).thickness();
        let units = units.without_thin_walls(THIN * thickness);
        let edges = Shape::of(&units).thin_panes(THIN_PANE * thickness);
        let units = units.with_mats(&edges);
        let shape = Shape::of(&units);
        if !is_house(&shape, grid) {
            let (units, shape) = (Some(units), Some(shape));
            return Err(Box::new(Stopped {
                units,
                shape,
                ..*self.stopped(Refused::NoHouse)
            }));
        }
        let shape = shape::inside::furnished(shape, &legend.things, inks, grid, legend.is_by_hand);
        Ok(Found {
            flat: self.flat,
            ink: self.ink,
            grid: self.grid,
            units,
            shape,
            legend: legend.name.clone(),
        })
    }

    pub(super) fn stopped(self, why: Refused) -> Box<Stopped> {
        Box::new(Stopped {
            why,
            flat: self.flat,
            ink: self.ink,
            grid: Some(self.grid),
            units: None,
            shape: None,
            reading: None,
        })
    }
}

/// Reads the units of a grid by each legend, from all ink and from that which does not run aslant. Returns those that agree best,
/// of two that agree equally the first. The sheet shows what it is made of.
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

/// Returns true for a house: not a few strokes of something else that happen to close, nor ruled paper.
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
