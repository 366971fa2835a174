//! The water that the rules of a town make: streams and ponds know where others flow into them.

use super::roads::Roads;
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid, bounds, wider};
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// How far from the features of a part its ponds are kept, metres.
const PACKED: f64 = 120.0;

/// The rings of ponds that are looked at round a feature, at most. Of more the nearest count.
const MOST: usize = 4096;

/// All water of a town.
#[derive(Debug, Default)]
pub struct Waters {
    /// Along lines: the borders of a piece are its bank and its water.
    pub streams: Roads,
    ponds: Vec<Vec<DVec2>>,
    index: Grid,
}

impl Waters {
    /// Collects streams, and ponds as convex rings.
    pub fn new(streams: Roads, ponds: Vec<Vec<DVec2>>) -> Waters {
        let boxes = ponds.iter().map(|ring| bounds(ring.iter().copied()));
        Waters {
            streams,
            index: Grid::new(boxes.map(Option::unwrap_or_default).collect()),
            ponds,
        }
    }

    /// Returns the convex rings of ponds within `far` of a box; of very many the nearest.
    pub fn ponds_near(&self, bounds: Bounds, far: f64) -> Vec<&Vec<DVec2>> {
        let found = self.index.nearest(bounds, far, MOST).into_iter();
        found.map(|n| &self.ponds[n as usize]).collect()
    }

    /// Adds the water near a box.
    pub(crate) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        self.streams.pack(bounds, out);
        let ponds = self.index.near(wider(bounds, PACKED));
        out.count(ponds.len());
        for ring in ponds.iter().map(|n| &self.ponds[*n as usize]) {
            out.points(ring);
        }
    }

    /// Takes water from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(crate) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<Waters> {
        let streams = Roads::unpack(from)?;
        let ponds = (0..from.count()?).map(|_| from.points());
        Ok(Waters::new(streams, ponds.collect::<io::Result<_>>()?))
    }
}
