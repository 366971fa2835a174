//! The ground of a town: grids of heights, seen from its frame. Where several have a height, the first one named counts.

use super::TownFrame;
use super::kept::KeptMaps;
use glam::DVec2;
use hsd_base::geometry::grid::Bounds;
use hsd_base::source::World;
use hsd_ir::ast::town::Layer;
use hsd_map::heights::{self, Heights};
use hsd_map::pack::{Packer, Unpacker};
use hsd_map::{Crs, Datums, Fault, Mismatch, Options, Transform};
use std::io;
use std::sync::Arc;

/// The ground of a town; empty where no layer has heights.
#[derive(Debug, Default)]
pub struct Ground {
    layers: Vec<GroundLayer>,
}

/// A grid of heights in a town.
#[derive(Debug)]
pub struct GroundLayer {
    /// As written.
    pub layer: Layer,
    heights: Arc<Heights>,
    /// The way from the plane of the town to the system of the grid.
    way: Transform,
    origin: DVec2,
    /// The smaller side of a cell, metres in the town.
    cell: f64,
}

/// Why a grid is no ground of a town.
#[derive(Debug)]
pub enum NoGround {
    /// It cannot be read.
    Fault(Fault),
    /// Nobody says in which system it lies.
    NoCrs,
    /// Its system cannot be converted.
    Mismatch(Mismatch),
    /// It lies elsewhere.
    Elsewhere,
}

/// How far beyond its features a town has ground, metres.
const MARGIN: f64 = 300.0;
/// How far a place without a height looks for one, metres.
const SEARCH: f64 = 200.0;
/// The points of each side of a box that are taken into another system.
const STEPS: usize = 8;

impl GroundLayer {
    /// Reads a grid, of which only what lies round the town is kept. `bounds` are those of the features.
    ///
    /// # Errors
    /// If it gives the town no ground.
    pub fn read(
        (world, kept): (&dyn World, Option<&KeptMaps>),
        path: &str,
        written: &Layer,
        (frame, bounds): (&TownFrame, Bounds),
        remarks: &mut Vec<Fault>,
    ) -> Result<GroundLayer, NoGround> {
        let named = written.crs.as_ref();
        let options = Options {
            crs: named.and_then(|crs| Crs::from_name(&crs.value)),
            ..Options::default()
        };
        let wide = [bounds[0] - MARGIN, bounds[1] + MARGIN];
        let window = |crs: &Crs| {
            let way = Transform::new(&frame.crs, crs, Datums::Exact).ok()?;
            over(&way, wide.map(|corner| corner + frame.origin))
        };
        let mut read = || heights::read(world, path, &options, &window, remarks).map(Arc::new);
        let heights = match kept {
            Some(kept) => kept.heights((world, path), written, (frame, wide), read),
            None => read(),
        };
        let heights = heights.map_err(NoGround::Fault)?;
        let crs = heights.crs.as_ref().ok_or(NoGround::NoCrs)?;
        let way = Transform::new(&frame.crs, crs, Datums::Exact).map_err(NoGround::Mismatch)?;
        if heights.is_empty() {
            return Err(NoGround::Elsewhere);
        }
        let centre = bounds[0].midpoint(bounds[1]) + frame.origin;
        let at = |off: DVec2| way.apply(centre + off);
        let (middle, east, north) = (at(DVec2::ZERO), at(DVec2::X), at(DVec2::Y));
        let (Some(middle), Some(east), Some(north)) = (middle, east, north) else {
            return Err(NoGround::Mismatch(Mismatch::Unusable));
        };
        // Cells in a metre to the east and to the north.
        let cells =
            ((east - middle) / heights.cell()).abs() + ((north - middle) / heights.cell()).abs();
        Ok(GroundLayer {
            layer: written.clone(),
            cell: 1.0 / cells.max_element().max(1e-6),
            origin: frame.origin,
            heights,
            way,
        })
    }

    /// Appends the part that places in a box of the town look at to bytes; all of it where that cannot be told.
    fn pack(&self, [low, high]: Bounds, out: &mut Packer<'_>) {
        let wide = [low - MARGIN, high + MARGIN].map(|corner| corner + self.origin);
        let window = over(&self.way, wide).unwrap_or(self.heights.bounds());
        out.text(&self.layer.name.value);
        out.float(self.cell);
        self.heights.pack(window, out);
    }

    fn unpack(
        from: &mut Unpacker<'_, '_>,
        frame: &TownFrame,
        layers: &[Layer],
    ) -> io::Result<GroundLayer> {
        let wrong = || io::Error::from(io::ErrorKind::InvalidData);
        let name = from.text()?;
        let cell = from.float()?;
        let heights = Heights::unpack(from)?;
        let layer = layers.iter().find(|layer| *layer.name.value == *name);
        let crs = heights.crs.as_ref().ok_or_else(wrong)?;
        Ok(GroundLayer {
            layer: layer.ok_or_else(wrong)?.clone(),
            way: Transform::new(&frame.crs, crs, Datums::Exact).map_err(|_| wrong())?,
            heights: Arc::new(heights),
            origin: frame.origin,
            cell,
        })
    }

    fn at(&self, place: DVec2) -> Option<f64> {
        self.heights.at(self.way.apply(place + self.origin)?)
    }
}

/// Returns the box of a box in another system; `None` if it lies where that has none.
fn over(way: &Transform, [low, high]: Bounds) -> Option<Bounds> {
    let mut found: Option<Bounds> = None;
    for i in 0..=STEPS {
        for j in 0..=STEPS {
            let share = DVec2::new(i as f64, j as f64) / STEPS as f64;
            let place = way.apply(low + (high - low) * share)?;
            let [a, b] = found.get_or_insert([place; 2]);
            (*a, *b) = (a.min(place), b.max(place));
        }
    }
    found
}

impl Ground {
    /// Returns the ground of these layers, the first of which counts before the others.
    pub fn new(layers: Vec<GroundLayer>) -> Ground {
        Ground { layers }
    }

    /// Appends what places in a box look at to bytes.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        out.count(self.layers.len());
        self.layers.iter().for_each(|layer| layer.pack(bounds, out));
    }

    /// Takes ground from the start of bytes; `layers` are those of the town file.
    ///
    /// # Errors
    /// If the bytes are not those that were written, or the town has no such layer.
    pub(crate) fn unpack(
        from: &mut Unpacker<'_, '_>,
        frame: &TownFrame,
        layers: &[Layer],
    ) -> io::Result<Ground> {
        let layers = (0..from.count()?).map(|_| GroundLayer::unpack(from, frame, layers));
        Ok(Ground::new(layers.collect::<io::Result<_>>()?))
    }

    /// Returns true if no layer has heights.
    pub fn is_empty(&self) -> bool {
        self.layers.is_empty()
    }

    /// Returns its layers.
    pub fn layers(&self) -> &[GroundLayer] {
        &self.layers
    }

    /// Returns the side of its smallest cell, metres.
    pub fn cell(&self) -> f64 {
        let cells = self.layers.iter().map(|layer| layer.cell);
        cells.fold(f64::INFINITY, f64::min)
    }

    /// Returns the height at a place in the frame of the town, if it is known.
    pub fn at(&self, place: DVec2) -> Option<f64> {
        self.layers.iter().find_map(|layer| layer.at(place))
    }

    /// Returns the height at a place, or the next one that is known round it.
    pub fn near(&self, place: DVec2) -> Option<f64> {
        const WAYS: usize = 8;
        const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
        let around: [(f64, f64); WAYS] = [
            (1.0, 0.0),
            (HALF, HALF),
            (0.0, 1.0),
            (-HALF, HALF),
            (-1.0, 0.0),
            (-HALF, -HALF),
            (0.0, -1.0),
            (HALF, -HALF),
        ];
        let first = self.at(place);
        if first.is_some() || self.is_empty() {
            return first;
        }
        let mut far = self.cell().max(1.0);
        while far <= SEARCH {
            let mut ways = around.iter();
            let found = ways.find_map(|way| self.at(place + DVec2::from(*way) * far));
            if found.is_some() {
                return found;
            }
            far *= 1.5;
        }
        None
    }

    /// Returns the lowest height along a line, which is looked at every metre.
    pub fn lowest(&self, [from, to]: [DVec2; 2]) -> Option<f64> {
        let steps = from.distance(to).ceil().clamp(1.0, 1000.0);
        let places = (0..=steps as usize).map(|n| from.lerp(to, n as f64 / steps));
        places.filter_map(|place| self.at(place)).reduce(f64::min)
    }
}
