//! Layers of divided areas: the plots, blocks, streets or yards of each area take its place.

use super::divide::{Piece, divide};
use super::{Lot, Lots, Shape};
use hsd_ir::ast::town::{Divided, DividedPart};
use hsd_map::{Fault, Kind};
use rayon::prelude::*;

/// The greatest number of features that the areas of a layer may become.
const MOST: usize = 2_000_000;

/// Parts below this area are no features, square metres: maps draw their borders that far apart.
const SLIVER: f64 = 0.5;

/// The fields that parts of an area have besides its own: its key, and the width of the streets.
const QUARTER: &str = "quarter";
const WIDTH: &str = "width";

impl Lots {
    /// Returns the side of its features that is known to be their front: the first one of a plot lies along the street for
    /// which it was laid out.
    pub(crate) fn front_side(&self) -> Option<usize> {
        let divided = self.layer.divided.as_ref()?;
        (divided.part == DividedPart::Plots).then_some(0)
    }

    /// Puts the parts of its areas in their place, if the layer is one of divided areas. What is no area has no parts.
    pub fn divide(&mut self) {
        let Some(Divided { part, division }) = self.layer.divided.clone() else {
            return;
        };
        let areas = std::mem::take(&mut self.lots);
        let about: f64 = areas.iter().map(extent).sum();
        let limit = MOST as f64;
        if about / (division.frontage * division.depth.min(division.frontage)) > limit {
            self.refuse_all(&areas);
            return;
        }
        if part == DividedPart::Blocks {
            self.tell_others(&areas);
        }
        let (quarter, width) = (self.column(QUARTER), self.column(WIDTH));
        let parts = |lot: &Lot| -> Vec<Piece> {
            let Shape::Area(ring, holes) = &lot.shape else {
                return vec![];
            };
            let divided = divide(&Piece::new(ring, holes), &division);
            match part {
                DividedPart::Plots => divided.plots,
                DividedPart::Blocks => divided.blocks,
                DividedPart::Streets => divided.streets,
                DividedPart::Yards => divided.yards,
            }
        };
        let made = areas.par_iter().flat_map_iter(|lot| {
            let parts = parts(lot).into_iter().filter(|part| part.area() >= SLIVER);
            let parts = parts.enumerate();
            parts.map(|(n, piece)| {
                let mut fields = lot.fields.clone();
                let mut put = |column, value| {
                    fields.retain(|(own, _)| *own != column);
                    fields.push((column, value));
                };
                put(quarter, hsd_map::Value::Text((*lot.key).into()));
                if part == DividedPart::Streets {
                    put(width, hsd_map::Value::Number(division.street));
                }
                fields.sort_by_key(|(column, _)| *column);
                Lot {
                    number: 0,
                    key: format!("{}-{}", lot.key, n + 1).into(),
                    shape: Shape::Area(piece.ring, piece.holes),
                    fields,
                    z: lot.z,
                }
            })
        });
        self.lots = made.collect();
    }

    /// Reports that these areas would have too many plots.
    fn refuse_all(&mut self, areas: &[Lot]) {
        let what = Kind::TooLarge {
            what: "plots",
            limit: MOST as u64,
        };
        self.faults.push(Fault::of_file(&self.file, what.clone()));
        for lot in areas {
            let fault = Fault::of_file(&self.file, what.clone());
            let number = u64::from(lot.number);
            self.unread
                .push(fault.of_feature(number, Some((&*lot.key).into())));
        }
    }

    /// Tells which features are no areas, and so are not divided.
    fn tell_others(&mut self, lots: &[Lot]) {
        for lot in lots {
            let shape = match &lot.shape {
                Shape::Area(..) => continue,
                Shape::Lines(_) => "line",
                Shape::Point(_) => "point",
            };
            let number = u64::from(lot.number);
            let fault = Fault::of_file(&self.file, Kind::NotDivided { shape });
            let fault = fault.of_feature(number, Some((&*lot.key).into()));
            self.faults.push(fault.clone());
            self.unread.push(fault);
        }
    }

    /// Returns the column of a name, a new one if the map has none.
    fn column(&mut self, name: &str) -> usize {
        let next = self.columns.values().max().map_or(0, |last| last + 1);
        *self.columns.entry(name.into()).or_insert(next)
    }
}

/// Returns the size of the box around an area, square metres.
fn extent(lot: &Lot) -> f64 {
    let [low, high] = lot.shape.bounds();
    let size = high - low;
    size.x * size.y
}
