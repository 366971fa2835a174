//! Reads plans that keep to no grid, wall by wall (plans.md 2).
//!
//! | step | file | result |
//! |---|---|---|
//! | strokes are measured; the thick ones are walls | [`mask`] | [`mask::Strokes`] |
//! | letters are removed, dashes joined | [`letters`] | the strokes without them |
//! | walls of two lines are filled | [`hollow`] | the strokes with them |
//! | lines of floors and stairs are removed | [`hatching`] | the strokes without them |
//! | lines that run from wall to wall are walls too | [`thin`] | [`bars::Bar`]s |
//! | gaps between walls in one line are openings | [`gaps`] | [`gaps::Gap`]s |
//! | what a wide disc reaches is outside | [`outside`] | chords that close the outline |
//! | what walls and openings enclose are rooms | [`faces`] | [`faces::Faces`] |
//! | flights and landings are joined | `stairs` | the rooms |
//! | the lines between rooms become straight walls | [`chains`], [`graph`] | [`graph::Graph`] |
//! | printed dimensions, sizes of rooms, doors or half ken give the size | [`digits`], `measures`, `sizes`, [`scale`] | [`scale::Scale`] |
//! | stretches of walls in another colour are marked | `tints` | [`Stuff::Tinted`] |
//! | pieces of walls get their roles | [`openings`] | [`openings::Piece`]s |
//! | storeys are laid over each other | [`stacked`] | a move in metres |
//! | the source file is written | [`writing`] | [`writing::Traced`] |
//!
//! Places are pixels of the flat sheet, to the right and down. Only the least lengths are numbers of pixels. All others are
//! shares of the thickness of walls or of the diagonal of the plan.

pub mod bars;
pub mod chains;
pub mod digits;
pub mod dimensions;
pub mod faces;
pub mod field;
pub mod gaps;
pub mod graph;
pub mod hatching;
pub mod hollow;
pub mod letters;
pub mod mask;
mod measures;
pub mod openings;
pub mod outside;
mod partitions;
pub mod pictures;
mod reach;
pub mod scale;
mod sizes;
pub mod stacked;
mod stairs;
mod swing;
pub mod thin;
mod tints;
mod walks;
pub mod writing;

use super::Options;
use super::flatten::Flat;
use super::sheet::{self, Ink};
use faces::Faces;
use field::Field;
use gaps::Gap;
use glam::DVec2;
use graph::Graph;
use mask::Strokes;
use rayon::prelude::*;
use scale::{Evidence, Scale};
use writing::Storey;

/// Radii of the discs by which the outside is found, as shares of the plan's diagonal.
const RADII: [f64; 4] = [0.04, 0.055, 0.075, 0.1];
/// The share of the largest area that a smaller radius has to enclose.
const ENCLOSED: f64 = 0.95;

/// The part of a wall at a pixel, between two rooms or a room and the outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stuff {
    /// Nothing.
    Free,
    /// A wall.
    Wall,
    /// A stretch of a wall in another colour.
    Tinted,
    /// Lines that run from wall to wall.
    Thin,
    /// An opening.
    Gap,
    /// A line that closes the outline where nothing is drawn.
    Chord,
}

/// The diagonals of houses, metres.
const HOUSES: std::ops::RangeInclusive<f64> = 2.5..=300.0;
/// The least share of walls that a reading explains.
const EXPLAINED: f64 = 0.77;

/// A plan, its sheet and its size.
#[derive(Clone, Debug)]
pub struct Found {
    /// The flat sheet.
    pub flat: Flat,
    /// The plan.
    pub reading: Reading,
    /// The size of its pixels.
    pub scale: Scale,
}

impl Found {
    /// Adds to a reading what only the colours of its sheet show.
    pub fn new(flat: Flat, mut reading: Reading, scale: Scale) -> Found {
        tints::mark(&mut reading.divided, &sheet::tints(&flat.sheet));
        Found {
            flat,
            reading,
            scale,
        }
    }

    /// Returns the plan as the storey on the ground, of a height in shaku.
    pub fn storey(&self, height: f64) -> Storey<'_> {
        Storey {
            divided: &self.reading.divided,
            graph: &self.reading.graph,
            metres: self.scale.metres,
            height,
            shift: DVec2::ZERO,
        }
    }
}

/// A plan as it was read.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The rooms, pixel by pixel.
    pub divided: Divided,
    /// The walls between them.
    pub graph: Graph,
    /// The share of the ink of walls that belongs to a wall of a room.
    pub explained: f64,
}

impl Reading {
    /// Returns the number of rooms.
    pub fn rooms(&self) -> usize {
        let rooms = self.graph.lines.iter().flat_map(|line| line.rooms);
        let rooms: std::collections::BTreeSet<u32> = rooms.filter(|room| *room != 0).collect();
        rooms.len()
    }

    /// Returns the size of its pixels: by the author, the file, printed numbers, the unit of the drawing or doors, in this order.
    pub(super) fn scale(&self, ink: &Ink, options: &Options) -> Option<Scale> {
        let by_unit = options.unit.map(|unit| writing::UNIT / unit);
        let by_file = options.metres.filter(|m| self.is_as_large_as_a_house(*m));
        let scale = scale::of(self, ink, by_unit.or(by_file));
        let is_printed = |scale: Scale| matches!(scale.evidence, Evidence::Rooms(_));
        if scale.is_some_and(|scale| scale.is_sure() || is_printed(scale)) {
            return scale;
        }
        scale::by_unit(self, &options.units).or(scale)
    }

    /// Returns the mean area of its rooms, pixels.
    fn room(&self) -> f64 {
        let faces = &self.divided.faces.of;
        let inside = faces.iter().filter(|face| *face != 0).count();
        inside as f64 / self.rooms().max(1) as f64
    }

    /// Returns true if most walls belong to the house.
    pub fn is_whole(&self) -> bool {
        self.explained >= EXPLAINED
    }

    /// Returns true if the plan has the size of a house when a pixel has this length, metres. Some files name the wrong unit.
    pub fn is_as_large_as_a_house(&self, metres: f64) -> bool {
        HOUSES.contains(&(self.divided.diagonal * metres))
    }
}

/// Reads the plan on a sheet; `None` if its walls enclose nothing.
pub fn read(ink: &Ink) -> Option<Reading> {
    let divided = divide(ink);
    let graph = Graph::of(&divided.faces, divided.strokes.usual);
    if graph.lines.is_empty() {
        return None;
    }
    let lines = graph
        .lines
        .iter()
        .map(|line| line.ends.map(|k| graph.corners[k]));
    let explained = divided.strokes.explained(lines);
    Some(Reading {
        divided,
        graph,
        explained,
    })
}

/// Reads the plan on a sheet and its size; `None` if either is missing or walls are left out.
///
/// The options give the length of a pixel or the units that a drawing may have.
pub fn found(flat: &Flat, ink: &Ink, options: &Options) -> Option<Found> {
    let reading = read(ink).filter(Reading::is_whole)?;
    let scale = reading.scale(ink, options)?;
    Some(Found::new(flat.clone(), reading, scale))
}

/// A plan divided into rooms.
#[derive(Clone, Debug)]
pub struct Divided {
    /// The strokes, without letters.
    pub strokes: Strokes,
    /// The walls and openings, pixel by pixel.
    pub stuff: Field<Stuff>,
    /// The rooms.
    pub faces: Faces,
    /// Openings.
    pub gaps: Vec<Gap>,
    /// The diagonal of the plan.
    pub diagonal: f64,
}

/// Divides the plan on a sheet into rooms.
pub fn divide(ink: &Ink) -> Divided {
    let mut strokes = Strokes::of(ink);
    let drawn = letters::remove(&mut strokes);
    hollow::fill(&mut strokes, drawn);
    let treads = hatching::remove(&mut strokes, drawn);
    // Letters that touched the hatching are separate now.
    letters::remove(&mut strokes);
    partitions::include(&mut strokes, drawn);
    let solid = reach::of_plan(&strokes, drawn);
    let solid = strokes.joined(&solid);
    let bounds = faces::bounds(&solid);
    let diagonal = bounds.diagonal();
    let thin = thin::thin(&strokes, &solid, (bounds, diagonal));
    let mut walls = solid.clone();
    thin.iter().for_each(|bar| thin::draw(&mut walls, bar));
    let door = gaps::door(&strokes, &solid, diagonal);
    let mut gaps = gaps::gaps((&strokes, &walls), &walls, (&door, diagonal));
    let clean = letters::without_specks(&strokes, &walls);
    gaps.extend(gaps::gaps((&strokes, &walls), &clean, (&door, diagonal)));
    let closed = faces::closed(&walls, &gaps);
    gaps.extend(gaps::gaps((&strokes, &walls), &closed, (&door, diagonal)));
    let closed = faces::closed(&closed, &gaps);
    let (network, bounds) = faces::largest(&closed);
    let diagonal = bounds.diagonal();
    let (faces, network) = enclosed(&network, diagonal);
    let stuff = Field::new(network.width, network.height, |x, y| {
        let p = (x, y);
        match (network[p], solid[p], walls[p], closed[p]) {
            (false, ..) => Stuff::Free,
            (_, true, ..) => Stuff::Wall,
            (_, _, true, _) => Stuff::Thin,
            (_, _, _, true) => Stuff::Gap,
            _ => Stuff::Chord,
        }
    });
    let faces = stairs::joined(faces.merged(&stuff, diagonal), &treads);
    Divided {
        strokes,
        stuff,
        faces,
        gaps,
        diagonal,
    }
}

/// Closes the network of walls against the outside by the smallest disc that leaves nothing out, and divides it. Each disc is tried
/// on what smaller ones have closed, so that a wide opening joins no rooms that are closed already.
fn enclosed(network: &Field<bool>, diagonal: f64) -> (Faces, Field<bool>) {
    // The disc must reach every wall, even at the edge of the sheet.
    let margin = (RADII[RADII.len() - 1] * diagonal).ceil() as isize + 2;
    let window = network.window(margin);
    let mut walls = network.within(window);
    let mut free = outside::distances(&walls);
    let mut closed = vec![];
    for share in RADII {
        let chords = outside::chords((&walls, &free), share * diagonal);
        if chords.is_empty() && !closed.is_empty() {
            continue;
        }
        chords
            .into_iter()
            .for_each(|chord| outside::draw(&mut walls, chord));
        free = outside::distances(&walls);
        closed.push(walls.clone());
    }
    let divided = closed.into_par_iter();
    let tried: Vec<_> = divided
        .map(|walls| (Faces::of(&walls, diagonal), walls))
        .collect();
    let area = |faces: &Faces| faces.of.iter().filter(|f| *f != 0).count() as f64;
    let most = tried.iter().map(|t| area(&t.0)).fold(0.0, f64::max);
    let mut tried = tried.into_iter();
    let (faces, walls) = tried
        .find(|t| area(&t.0) >= ENCLOSED * most)
        .expect("the largest is one of them");
    let back = [
        -window[0],
        -window[1],
        network.width as isize,
        network.height as isize,
    ];
    let of = faces.of.within(back);
    (Faces { of, ..faces }, walls.within(back))
}
