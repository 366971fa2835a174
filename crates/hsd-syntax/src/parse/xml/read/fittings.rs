//! `Platform`, `Posts`, `Veranda`, `Brackets`, `Finial`, `Put`, `Ground`: fittings of a house.

use crate::parse::schema::vocabulary::{RAILS, SIDES};
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::edits;
use crate::parse::xml::read::{Attributes, Reader};
use crate::parse::xml::tree::Element;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{
    Brackets, CodeText, Finial, FinialKind, Ground, GroundSurface, House, Order, Paint, Platform,
    Posts, Put, Rail, Side, Veranda,
};
use hsd_ir::messages::xml as say;

impl<'t> Reader<'t, '_> {
    /// Reads a fitting of a house. Returns false for other elements.
    pub(in crate::parse::xml) fn fitting(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        house: &mut House,
    ) -> bool {
        let fittings = &mut house.fittings;
        let first = match schema.tag {
            Tag::Platform => {
                let read = self.platform(schema, element);
                keep(&mut fittings.platform, read, |p| p.span)
            }
            Tag::Posts => {
                let read = self.posts(schema, element);
                keep(&mut fittings.posts, read, |p| p.span)
            }
            Tag::Brackets => {
                let read = self.brackets(schema, element);
                keep(&mut fittings.brackets, read, |b| b.span)
            }
            Tag::Finial => {
                fittings.finials.extend(self.finial(schema, element));
                None
            }
            Tag::Put => {
                fittings.puts.extend(self.put(schema, element));
                None
            }
            Tag::Ground => {
                fittings.grounds.extend(self.ground(schema, element));
                None
            }
            _ => return false,
        };
        self.only(schema, element, "House", first);
        true
    }

    /// Reads a fitting of a storey. Returns false for other elements.
    pub(in crate::parse::xml) fn order(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        order: &mut Order,
    ) -> bool {
        let first = match schema.tag {
            Tag::Posts => {
                let read = self.posts(schema, element);
                keep(&mut order.posts, read, |p| p.span)
            }
            Tag::Veranda => {
                let read = self.veranda(schema, element);
                keep(&mut order.veranda, read, |v| v.span)
            }
            Tag::Brackets => {
                let read = self.brackets(schema, element);
                keep(&mut order.brackets, read, |b| b.span)
            }
            _ => return false,
        };
        self.only(schema, element, "Storey", first);
        true
    }

    /// Reports a duplicate of an element that may occur once.
    pub(in crate::parse::xml) fn only(
        &mut self,
        schema: &'static Schema,
        element: &Element<'_>,
        parent: &str,
        first: Option<Span>,
    ) {
        if let Some(first) = first {
            let fixes = edits::of_two(self.reporter, self.tree, first, element);
            self.reporter.at(&element.name_range, |s| {
                say::second_of(s, schema.name, parent, first, fixes)
            });
        }
    }

    fn platform(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Platform {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let margin = self.pair(&of, "margin");
        Platform {
            span: self.start(element),
            height: self.usual(&of, "height"),
            margin: margin.map_or([of.usual("margin"); 2], |m| m.value),
            stairs: self.sides(&of, "stairs"),
            width: self.number(&of, "width").map(|w| w.value),
        }
    }

    fn posts(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Posts {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let nageshi = self.whole_number(&of, "nageshi");
        Posts {
            span: self.start(element),
            size: self.usual(&of, "size"),
            round: self.yes_no(&of, "round").is_some_and(|r| r.value),
            paint: self.paint(&of).unwrap_or_default(),
            nageshi: nageshi.map_or(0, |n| n.value as u32),
        }
    }

    fn veranda(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Veranda {
        let of = self.attributes(schema, element);
        self.no_children(element);
        Veranda {
            span: self.start(element),
            width: self.usual(&of, "width"),
            height: self.usual(&of, "height"),
            rail: self
                .choice(&of, "rail", &RAILS)
                .map_or(Rail::None, |r| r.value),
            stairs: self.sides(&of, "stairs"),
            paint: self.paint(&of),
        }
    }

    fn brackets(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Brackets {
        let of = self.attributes(schema, element);
        self.no_children(element);
        Brackets {
            span: self.start(element),
            steps: self
                .whole_number(&of, "steps")
                .map_or(0, |s| s.value as u32),
            height: self.number(&of, "height").map(|h| h.value),
            out: self.number(&of, "out").map(|o| o.value),
            paint: self.paint(&of),
        }
    }

    fn finial(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Finial> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let count = self.whole_number(&of, "count");
        Some(Finial {
            span: self.start(element),
            kind: self.choice(&of, "kind", &FinialKind::ALL)?.value,
            height: self.number(&of, "height").map(|h| h.value),
            count: count.map(|c| c.value as u32),
            at: self.point(&of, "at"),
        })
    }

    fn put(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Put> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let code = self.text(&of, "code");
        let at = self.point(&of, "at");
        let turn = self.usual(&of, "turn");
        let [width, height] = ["width", "height"].map(|name| self.number(&of, name));
        let code = code?;
        Some(Put {
            span: self.start(element),
            code: Spanned::new(CodeText::new(&code.value), code.span),
            at: at?,
            turn,
            width: width.map(|w| w.value),
            height: height.map(|h| h.value),
        })
    }

    fn ground(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Ground> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let surface = self.choice(&of, "surface", &GroundSurface::ALL);
        let at = self.point(&of, "at");
        let size = self.pair(&of, "size");
        let turn = self.usual(&of, "turn");
        Some(Ground {
            span: self.start(element),
            surface: surface?.value,
            at: at?.value,
            size: size?.value,
            turn,
        })
    }

    fn paint(&mut self, of: &Attributes<'t>) -> Option<Paint> {
        self.choice(of, "paint", &Paint::ALL).map(|p| p.value)
    }

    /// Reads sides such as `"F B"`, each once.
    fn sides(&mut self, of: &Attributes<'t>, name: &str) -> Vec<Side> {
        let mut sides = vec![];
        for side in self.words(of, name, &SIDES) {
            if !sides.contains(&side) {
                sides.push(side);
            }
        }
        sides
    }
}

/// Keeps the first of an element that may occur once; returns its span for a duplicate.
fn keep<T>(place: &mut Option<T>, read: T, span: fn(&T) -> Span) -> Option<Span> {
    let first = place.as_ref().map(span);
    place.get_or_insert(read);
    first
}
