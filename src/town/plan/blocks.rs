//! Blocks: the polygons of layers without houses, by place.

use crate::town::grid::Grid;
use crate::town::layer::{Lots, Shape};
use crate::town::shape::contains;
use glam::DVec2;

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

    /// Returns the key of the first one that a place lies in.
    pub(super) fn at(&self, p: DVec2) -> Option<&str> {
        let near = self.index.near([p, p]).into_iter();
        let mut near = near.map(|n| &self.all[n as usize]);
        near.find(|(_, ring)| contains(ring, p))
            .map(|(key, _)| &**key)
    }
}
