//! `hsd facade`: photographs of a wall become its parts and a text that builds it again (docs/contract.md 12; 003-01 to
//! 003-06).
//!
//! A wall is found or told by its corners, seen straight through lens and perspective, cut on a lattice of bays and storeys;
//! cells that show the same part share one clean picture, equally bright.

pub mod brush;
pub mod camera;
pub mod cells;
pub mod exif;
pub mod grid;
pub mod kinds;
pub mod messages;
pub mod parts;
pub mod record;
pub mod rectify;
pub mod sheet;
pub mod street;
pub mod text;
pub mod tone;
pub mod wall;
pub mod whole;

use camera::{Lens, focal_of};
use cells::Cell;
use glam::{DMat3, DVec2, dvec2};
use grid::Grid;
use hsd_scan::flatten::homography;
use image::{GrayImage, RgbImage};
use kinds::Shown;
use tone::Light;
use wall::settled::Known;
use wall::{Lost, Wall, lines, vanish};

/// The focal length where nothing says it, as a part of the diagonal of the photograph: 28 mm on film, as telephones have.
const USUAL_FOCAL: f64 = 0.647;
/// The height of a storey where no size is given, metres (3.5, as of a `Floor`).
pub const STOREY: f64 = 3.5;
/// The most cells of a lattice.
pub const MOST_CELLS: usize = 400;
/// The unit square, clockwise from its upper left corner.
const UNIT: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];

/// A photograph, upright.
#[derive(Clone, Debug)]
pub struct Photo {
    /// The name of its file.
    pub name: String,
    /// Its pixels.
    pub pixels: RgbImage,
    /// The focal length that its camera wrote, pixels.
    pub focal: Option<f64>,
    /// What stands before the wall: not black. Of the size of the photograph.
    pub mask: Option<GrayImage>,
    /// How its lens bends lines, where that has been found already ([`found`]).
    pub bend: Option<[f64; 2]>,
}

/// What is known of a wall and its photographs.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// Corners in each photograph, clockwise from the upper left, pixels; missing ones are looked for.
    pub corners: Vec<[DVec2; 4]>,
    /// Width and height, metres.
    pub size: Option<DVec2>,
    /// How the lens bends lines.
    pub bend: Option<[f64; 2]>,
    /// The focal length, pixels.
    pub focal: Option<f64>,
    /// The lattice.
    pub lattice: Lattice,
    /// The most further pictures of each part.
    pub variations: usize,
}

/// The lattice of a wall, as far as it is known.
#[derive(Clone, Debug, Default)]
pub enum Lattice {
    /// It is looked for.
    #[default]
    Found,
    /// So many equal bays and storeys.
    Even(usize, usize),
    /// Lines between bays from the left, and between storeys from above, metres.
    Lines(Vec<f64>, Vec<f64>),
    /// The same as parts of the wall.
    Shares(Vec<f64>, Vec<f64>),
}

/// Where a focal length comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Told {
    /// It is given.
    Given,
    /// The camera wrote it.
    Camera,
    /// The sides of the wall are square to each other.
    Square,
    /// It is that of most telephones.
    Usual,
}

/// How a photograph sees the wall.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The corners of the wall in the photograph.
    pub corners: [DVec2; 4],
    /// The lens.
    pub lens: Lens,
    /// Takes the unit square of the wall to the straight picture.
    pub map: DMat3,
    /// Width over height.
    pub aspect: f64,
    /// Where the focal length comes from.
    pub focal: Told,
    /// How far the sides were seen, 0 to 1; 1 for corners by hand.
    pub trust: f64,
}

/// A part: a picture and its name.
#[derive(Clone, Debug)]
pub struct Part {
    /// `f1f2f3`: facade, storey from the ground, place from the left (003-15).
    pub name: String,
    /// The cell it was cut from.
    pub cell: usize,
    /// The picture.
    pub picture: RgbImage,
    /// Further clean pictures of it.
    pub variations: Vec<RgbImage>,
}

impl Part {
    /// The names of its pictures: its own, and with `v1`, `v2` and so on for each variation (000-54).
    pub fn names(&self) -> Vec<String> {
        let further = (1..=self.variations.len()).map(|k| format!("{}v{k}", self.name));
        std::iter::once(self.name.clone()).chain(further).collect()
    }

    /// Its pictures, as they are named.
    pub fn pictures(&self) -> impl Iterator<Item = &RgbImage> {
        std::iter::once(&self.picture).chain(&self.variations)
    }
}

/// A wall that was read.
#[derive(Clone, Debug)]
pub struct Front {
    /// How each photograph sees it.
    pub views: Vec<View>,
    /// Width and height, metres.
    pub size: DVec2,
    /// The wall as the photographs show it, seen straight.
    pub wall: RgbImage,
    /// Its lattice.
    pub grid: Grid,
    /// The cells, row by row from above.
    pub cells: Vec<Cell>,
    /// What each cell shows.
    pub shown: Vec<Shown>,
    /// The light that was taken away.
    pub light: Light,
    /// The parts.
    pub parts: Vec<Part>,
}

/// Why there is no front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// The wall of a photograph was not found.
    Lost(usize, Lost),
    /// A lattice of too many cells, or with lines beyond the wall.
    Lattice,
}

impl Front {
    /// The name of the part at a place, rows from above.
    pub fn name_at(&self, row: usize, column: usize) -> String {
        let cell = self
            .cells
            .iter()
            .position(|c| (c.row, c.column) == (row, column));
        let shown = cell.map(|c| self.shown[c].as_cell);
        let part = self.parts.iter().find(|p| Some(p.cell) == shown);
        part.map(|p| p.name.clone()).unwrap_or_default()
    }

    /// The wall put together of its parts.
    pub fn rebuilt(&self) -> RgbImage {
        let mut out = RgbImage::new(self.wall.width(), self.wall.height());
        for (cell, shown) in self.cells.iter().zip(&self.shown) {
            if let Some(part) = self.parts.iter().find(|p| p.cell == shown.as_cell) {
                let (width, height) = cell.size();
                let fitted;
                let picture = match part.picture.dimensions() == (width, height) {
                    true => &part.picture,
                    false => {
                        fitted = image::imageops::resize(
                            &part.picture,
                            width,
                            height,
                            image::imageops::FilterType::Triangle,
                        );
                        &fitted
                    }
                };
                image::imageops::replace(
                    &mut out,
                    picture,
                    cell.frame[0].into(),
                    cell.frame[1].into(),
                );
            }
        }
        out
    }
}

/// The focal length that is known, and where it comes from.
fn told(photo: &Photo, given: &Given) -> Option<(f64, Told)> {
    let own = photo.focal.map(|focal| (focal, Told::Camera));
    given.focal.map(|focal| (focal, Told::Given)).or(own)
}

/// The lens before anything is known of the corners, and the usual focal length.
fn guessed(photo: &Photo, given: &Given, edges: &[lines::Edge]) -> (Lens, f64) {
    let size = dvec2(
        f64::from(photo.pixels.width()),
        f64::from(photo.pixels.height()),
    );
    let usual = USUAL_FOCAL * size.length();
    let mut lens = Lens {
        focal: told(photo, given).map_or(usual, |t| t.0),
        middle: size / 2.0,
        bend: [0.0; 2],
    };
    let bend = given.bend.or(photo.bend);
    let bend = bend.or_else(|| vanish::bending(edges, &lens, size.max_element()));
    lens.bend = bend.unwrap_or_default();
    (lens, usual)
}

/// Looks for the wall in a photograph, and keeps how its lens bends lines, so that it is not worked out again for other corners.
///
/// # Errors
/// If there is no wall.
pub fn found(photo: &mut Photo, given: &Given) -> Result<View, Lost> {
    let edges = wall::edges(&photo.pixels);
    let view = by_edges(photo, &edges, None, given);
    // In the unit of the guessed focal length, as it is used before the true one is known.
    let (lens, _) = guessed(photo, given, &edges);
    photo.bend = Some(view.map_or(lens.bend, |view| {
        let scale = lens.focal / view.lens.focal;
        let [k1, k2] = view.lens.bend;
        [k1 * scale.powi(2), k2 * scale.powi(4)]
    }));
    view
}

/// How a photograph sees the wall.
///
/// # Errors
/// If corners are looked for and there is no wall.
pub fn view(photo: &Photo, corners: Option<[DVec2; 4]>, given: &Given) -> Result<View, Lost> {
    let is_bent = given.bend.or(photo.bend).is_none();
    let edges = match is_bent || corners.is_none() {
        true => wall::edges(&photo.pixels),
        false => vec![],
    };
    by_edges(photo, &edges, corners, given)
}

fn by_edges(
    photo: &Photo,
    edges: &[lines::Edge],
    corners: Option<[DVec2; 4]>,
    given: &Given,
) -> Result<View, Lost> {
    let told = told(photo, given);
    let (mut lens, usual) = guessed(photo, given, edges);
    let wall = match corners {
        Some(corners) => Wall {
            corners,
            straight: corners.map(|c| lens.straight(c)),
            lens,
            trust: 1.0,
        },
        None => {
            let known = Known {
                focal: told.is_some(),
                bend: given.bend.or(photo.bend).is_some(),
            };
            wall::find(&photo.pixels, edges, &lens, known)?
        }
    };
    lens = wall.lens;
    let map = homography(UNIT, wall.straight);
    let square = focal_of(map, lens.middle).filter(|f| (0.3..4.0).contains(&(f / usual)));
    let focal = told
        .or(square.map(|f| (f, Told::Square)))
        .unwrap_or((usual, Told::Usual));
    // The same bending in another unit of length.
    let scale = focal.0 / lens.focal;
    let [k1, k2] = lens.bend;
    lens = Lens {
        focal: focal.0,
        bend: [k1 * scale.powi(2), k2 * scale.powi(4)],
        ..lens
    };
    let aspect = given
        .size
        .map_or_else(|| lens.aspect(map), |size| size.x / size.y);
    Ok(View {
        corners: wall.corners,
        lens,
        map,
        aspect,
        focal: focal.1,
        trust: wall.trust,
    })
}

/// Reads a wall from its photographs.
///
/// # Errors
/// If there is no wall, or the lattice that is given makes no sense.
pub fn read(photos: &[Photo], given: &Given) -> Result<Front, Refused> {
    let mut views = vec![];
    for (k, photo) in photos.iter().enumerate() {
        let view = view(photo, given.corners.get(k).copied(), given);
        views.push(view.map_err(|why| Refused::Lost(k, why))?);
    }
    let aspect = views[0].aspect;
    let size = rectify::size(views[0].corners, aspect);
    let (grid, metres) = lattice(&photos[0], &views[0], size, given)?;
    let size = rectify::even(size, [&grid.columns, &grid.rows]);
    let straight: Vec<(RgbImage, Vec<bool>)> = photos
        .iter()
        .zip(&views)
        .map(|(p, v)| straight(p, v, size))
        .collect();
    let (wall, seen) = parts::composed::composed(straight, &grid);
    let mut front = cut(wall, &seen, grid, given.variations);
    front.views = views;
    front.size = metres;
    Ok(front)
}

/// The wall of a photograph seen straight, and which of its pixels are seen.
pub fn straight(photo: &Photo, view: &View, size: (u32, u32)) -> (RgbImage, Vec<bool>) {
    let (wall, mut seen) = rectify::rectify(&photo.pixels, &view.lens, view.map, size);
    if let Some(mask) = &photo.mask {
        let by = dvec2(1.0 / f64::from(size.0), 1.0 / f64::from(size.1));
        for (k, seen) in seen.iter_mut().enumerate() {
            let (x, y) = (k as u32 % size.0, k as u32 / size.0);
            let at = dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5) * by;
            let at = view.lens.bent(hsd_scan::raster::project(view.map, at));
            let hidden = mask.get_pixel_checked(at.x.max(0.0) as u32, at.y.max(0.0) as u32);
            *seen &= hidden.is_none_or(|m| m[0] < 128);
        }
    }
    (wall, seen)
}

/// The lattice, and width and height of the wall in metres; `size` is that of the straight wall, pixels.
fn lattice(
    photo: &Photo,
    view: &View,
    size: (u32, u32),
    given: &Given,
) -> Result<(Grid, DVec2), Refused> {
    let metres = |storeys: usize| {
        let height = STOREY * storeys as f64;
        given.size.unwrap_or(dvec2(height * view.aspect, height))
    };
    let grid = match &given.lattice {
        Lattice::Found => {
            let size = rectify::within(size, grid::LONGEST);
            Grid::find(&straight(photo, view, size).0)
        }
        Lattice::Even(bays, storeys) => Grid::even(*bays, *storeys),
        Lattice::Lines(columns, rows) => {
            let size = metres(rows.len() + 1);
            let shares = |lines: &[f64], length: f64| lines.iter().map(|l| l / length).collect();
            Grid::with(shares(columns, size.x), shares(rows, size.y))
        }
        Lattice::Shares(columns, rows) => Grid::with(columns.clone(), rows.clone()),
    };
    let goes_on = |lines: &[f64]| lines.windows(2).all(|l| l[1] - l[0] > 0.004);
    let cells = (grid.columns.len() - 1) * (grid.rows.len() - 1);
    match cells <= MOST_CELLS && goes_on(&grid.columns) && goes_on(&grid.rows) {
        true => {
            let metres = metres(grid.rows.len() - 1);
            Ok((grid, metres))
        }
        false => Err(Refused::Lattice),
    }
}

/// Cuts a straight wall into parts, each with at most this number of variations.
fn cut(wall: RgbImage, seen: &[bool], grid: Grid, variations: usize) -> Front {
    let first = cells::cells(&wall, seen, &grid);
    let light = light(&first, &kinds::sorted(&first), &grid);
    let lit = parts::lit(&wall, &light);
    let cells = cells::cells(&lit, seen, &grid);
    let shown = kinds::sorted(&cells);
    let storeys = grid.rows.len() - 1;
    let mut front = Front {
        views: vec![],
        size: DVec2::ONE,
        wall,
        grid,
        cells,
        shown,
        light,
        parts: vec![],
    };
    let gains = parts::gains(&front.shown);
    let is_core = |k: &usize| front.shown.iter().any(|s| s.as_cell == *k);
    let parts = (0..front.cells.len()).filter(is_core).map(|k| {
        let cell = &front.cells[k];
        let (storey, place) = (storeys - cell.row, cell.column + 1);
        Part {
            name: format!("f1f{storey}f{place}"),
            cell: k,
            picture: parts::cut(&lit, cell, gains[k]),
            variations: parts::variations(&front, &lit, (k, gains[k]), variations),
        }
    });
    let mut parts: Vec<Part> = parts.collect();
    close(&mut parts, &front.cells, &front.shown);
    front.parts = parts;
    front
}

/// The light on a wall, from cells that show the same.
fn light(cells: &[Cell], shown: &[Shown], grid: &Grid) -> Light {
    let middle = |lines: &[f64], k: usize| (lines[k] + lines[k + 1]) / 2.0;
    let seen = cells
        .iter()
        .zip(shown)
        .filter(|(_, s)| !s.is_replaced && !s.is_spoiled);
    let seen = seen.map(|(cell, s)| {
        let place = (
            middle(&grid.columns, cell.column),
            middle(&grid.rows, cell.row),
        );
        (s.as_cell, place.0, place.1, -libm::log(f64::from(s.gain)))
    });
    Light::fitted(&seen.collect::<Vec<_>>())
}

/// Closes the seams between parts that stand side by side or one above the other.
fn close(parts: &mut [Part], cells: &[Cell], shown: &[Shown]) {
    let known: Vec<usize> = parts.iter().map(|p| p.cell).collect();
    let place = |row: usize, column: usize| {
        let cell = cells
            .iter()
            .position(|c| (c.row, c.column) == (row, column))?;
        known.iter().position(|p| *p == shown[cell].as_cell)
    };
    // A variation stands wherever its part does.
    let mut first = vec![];
    let mut pictures: Vec<RgbImage> = vec![];
    for part in parts.iter_mut() {
        first.push(pictures.len());
        pictures.push(std::mem::take(&mut part.picture));
        pictures.append(&mut part.variations);
    }
    first.push(pictures.len());
    let mut meetings = vec![];
    for cell in cells {
        let own = place(cell.row, cell.column);
        for (other, is_above) in [
            (place(cell.row, cell.column + 1), false),
            (place(cell.row + 1, cell.column), true),
        ] {
            if let Some((a, b)) = own.zip(other) {
                let all = |part: usize| first[part]..first[part + 1];
                meetings.extend(all(a).flat_map(|a| all(b).map(move |b| (a, b, is_above))));
            }
        }
    }
    parts::closed(&mut pictures, &meetings);
    let mut pictures = pictures.into_iter();
    for (part, own) in parts.iter_mut().zip(first.windows(2)) {
        part.picture = pictures.next().unwrap_or_default();
        part.variations = pictures.by_ref().take(own[1] - own[0] - 1).collect();
    }
}
