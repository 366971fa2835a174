//! Blocks: the polygons of layers without houses, by place.

use crate::layer::{Lots, Shape};
use crate::shape::contains;
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid, bounds};
use hsd_map::pack::{Packer, Unpacker};
use std::io;

/// The blocks of a town.
#[derive(Debug, Default)]
pub(super) struct Blocks {
    all: Vec<(Box<str>, Vec<DVec2>)>,
    index: Grid,
}

impl Blocks {
    /// Collects the polygons of some layers.
    pub(super) fn new<'l>(layers: impl Iterator<Item = &'l Lots>) -> Blocks {
        let (mut all, mut boxes) = (vec![], vec![]);
        for lot in layers.flat_map(|layer| &layer.lots) {
            if let Shape::Area(ring, _) = &lot.shape {
                all.push((lot.key.clone(), ring.clone()));
                boxes.push(lot.shape.bounds());
            }
        }
        Blocks {
            all,
            index: Grid::new(boxes),
        }
    }

    /// Appends those that meet a box to bytes.
    pub(super) fn pack(&self, bounds: Bounds, out: &mut Packer<'_>) {
        let near = self.index.near(bounds);
        out.count(near.len());
        for (key, ring) in near.iter().map(|n| &self.all[*n as usize]) {
            out.text(key);
            out.points(ring);
        }
    }

    /// Takes blocks from the start of bytes.
    ///
    /// # Errors
    /// If the bytes are not those that were written.
    pub(super) fn unpack(from: &mut Unpacker<'_, '_>) -> io::Result<Blocks> {
        let all = (0..from.count()?).map(|_| Ok((from.text()?, from.points()?)));
        let all = all.collect::<io::Result<Vec<(Box<str>, Vec<DVec2>)>>>()?;
        let boxes = all.iter().map(|(_, ring)| bounds(ring.iter().copied()));
        Ok(Blocks {
            index: Grid::new(boxes.map(Option::unwrap_or_default).collect()),
            all,
        })
    }

    /// Returns the key of the first one that a place lies in.
    pub(super) fn at(&self, p: DVec2) -> Option<&str> {
        let near = self.index.near([p, p]).into_iter();
        let mut near = near.map(|n| &self.all[n as usize]);
        near.find(|(_, ring)| contains(ring, p))
            .map(|(key, _)| &**key)
    }
}
