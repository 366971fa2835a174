//! `Pagoda`, `Gate`, `Hall`, `Shrine`: houses written short.

use super::read::{Attributes, Reader};
use super::roofs::KINDS;
use super::schema::{Schema, Tag};
use super::tree::Element;
use crate::ast::{Gate, Hall, House, Measures, Monument, Pagoda, Paint, RoofShape};
use std::ops::RangeInclusive;

/// Lengths that must be something, shaku.
const SIZE: RangeInclusive<f64> = 0.1..=1000.0;
/// Lengths that may be nothing, shaku.
const LENGTH: RangeInclusive<f64> = 0.0..=300.0;
/// Bays along a side.
const BAYS: RangeInclusive<f64> = 1.0..=60.0;

impl<'t> Reader<'t, '_> {
    /// Reads a house written short into its house, which holds one at most.
    pub(super) fn monument(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        house: &mut House,
    ) {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let span = self.start(element);
        let measures = self.measures(&of);
        let made = match schema.tag {
            Tag::Pagoda => Monument::Pagoda(Pagoda {
                span,
                measures,
                storeys: self.whole_number(&of, "storeys", 1..=15),
                width: self.number(&of, "width", SIZE),
                bays: self.whole_number(&of, "bays", 1..=9),
                taper: self.number(&of, "taper", 0.2..=0.99),
                rise: self.number(&of, "rise", 0.1..=3.0),
                sorin: self.number(&of, "sorin", LENGTH),
            }),
            Tag::Gate => Monument::Gate(Gate {
                span,
                measures,
                bays: self.whole_pair(&of, "bays", BAYS),
                bay: self.pair(&of, "bay", SIZE),
                storeys: self.whole_number(&of, "storeys", 1..=2),
                doors: self.whole_number(&of, "doors", 0..=60),
                inset: self.number(&of, "inset", LENGTH),
                upper: self.number(&of, "upper", SIZE),
            }),
            _ => Monument::Hall(Hall {
                span,
                shrine: schema.tag == Tag::Shrine,
                measures,
                bays: self.whole_pair(&of, "bays", BAYS),
                bay: self.pair(&of, "bay", SIZE),
                doors: self.whole_number(&of, "doors", 0..=60),
                aisle: self.number(&of, "aisle", LENGTH),
                upper: self.number(&of, "upper", SIZE),
                veranda: self.number(&of, "veranda", LENGTH),
                floor: self.number(&of, "floor", LENGTH),
                katsuogi: self.whole_number(&of, "katsuogi", 0..=99),
            }),
        };
        let first = house.monument.as_ref().map(Monument::span);
        house.monument.get_or_insert(made);
        self.only(schema, element, "House", first);
    }

    fn measures(&mut self, of: &Attributes<'t>) -> Measures {
        Measures {
            columns: self.number(of, "columns", SIZE),
            post: self.number(of, "post", 0.1..=20.0),
            paint: self.choice(of, "paint", &Paint::ALL),
            steps: self.whole_number(of, "steps", 0..=4),
            pitch: self.number(of, "pitch", 0.5..=30.0),
            eaves: self.number(of, "eaves", 0.0..=33.0),
            sori: self.number(of, "sori", -50.0..=50.0),
            thickness: self.number(of, "thickness", 0.05..=6.0),
            kind: self.choice(of, "kind", KINDS),
            shape: self.choice(of, "shape", &RoofShape::ALL),
            platform: self.number(of, "platform", LENGTH),
            margin: self.pair(of, "margin", LENGTH),
        }
    }
}
