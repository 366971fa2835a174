//! `Pagoda`, `Gate`, `Hall`, `Shrine`: monuments.

use crate::parse::schema::vocabulary::{COVERINGS, ROOF_SHAPES};
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::read::{Attributes, Reader};
use crate::parse::xml::tree::Element;
use hsd_ir::ast::{Gate, Hall, House, Measures, Monument, Pagoda, Paint};

impl<'t> Reader<'t, '_> {
    /// Reads a monument into its house, which contains at most one.
    pub(in crate::parse::xml) fn monument(
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
                storeys: self.whole_number(&of, "storeys"),
                width: self.number(&of, "width"),
                bays: self.whole_number(&of, "bays"),
                top_bays: self.whole_number(&of, "top_bays"),
                taper: self.number(&of, "taper"),
                eaves_taper: self.number(&of, "eaves_taper"),
                rise: self.number(&of, "rise"),
                sorin: self.number(&of, "sorin"),
            }),
            Tag::Gate => Monument::Gate(Gate {
                span,
                measures,
                bays: self.whole_pair(&of, "bays"),
                bay: self.pair(&of, "bay"),
                storeys: self.whole_number(&of, "storeys"),
                doors: self.whole_number(&of, "doors"),
                inset: self.number(&of, "inset"),
                upper: self.number(&of, "upper"),
            }),
            _ => Monument::Hall(Hall {
                span,
                shrine: schema.tag == Tag::Shrine,
                measures,
                bays: self.whole_pair(&of, "bays"),
                bay: self.pair(&of, "bay"),
                doors: self.whole_number(&of, "doors"),
                aisle: self.number(&of, "aisle"),
                upper: self.number(&of, "upper"),
                veranda: self.number(&of, "veranda"),
                floor: self.number(&of, "floor"),
                katsuogi: self.whole_number(&of, "katsuogi"),
            }),
        };
        let first = house.monument.as_ref().map(|first| first.span());
        house.monument.get_or_insert_with(|| Box::new(made));
        self.only(schema, element, "House", first);
    }

    fn measures(&mut self, of: &Attributes<'t>) -> Measures {
        Measures {
            columns: self.number(of, "columns"),
            post: self.number(of, "post"),
            paint: self.choice(of, "paint", &Paint::ALL),
            steps: self.whole_number(of, "steps"),
            pitch: self.number(of, "pitch"),
            eaves: self.number(of, "eaves"),
            sori: self.number(of, "sori"),
            thickness: self.number(of, "thickness"),
            kind: self.choice(of, "kind", &COVERINGS),
            shape: self.choice(of, "shape", &ROOF_SHAPES),
            platform: self.number(of, "platform"),
            margin: self.pair(of, "margin"),
        }
    }
}
