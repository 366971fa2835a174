//! `Roofs` and `Roof`.

use crate::parse::schema::Schema;
use crate::parse::schema::vocabulary::{
    COVERINGS, RIDGE_DIRECTIONS, ROOF_MODES, ROOF_SHAPES, SHAPES_OF_HOUSES,
};
use crate::parse::xml::read::{AllowedChild, Attributes, Reader};
use crate::parse::xml::tree::Element;
use crate::parse::xml::tree::chars::is_blank;
use hsd_base::source::Spanned;
use hsd_ir::ast::{GableWall, Paint, RoofLine, RoofMethod, RoofShape, RoofStyle, Roofs};

impl<'t> Reader<'t, '_> {
    /// Reads a roof section.
    pub(in crate::parse::xml) fn roofs(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Roofs {
        let of = self.attributes(schema, element);
        let mut roofs = Roofs {
            span: Some(self.start(element)),
            mode: self.choice(&of, "mode", &ROOF_MODES),
            method: self.choice(&of, "method", &RoofMethod::ALL),
            style: RoofStyle::default(),
            by_use: None,
            lines: vec![],
        };
        let shape = self.choice(&of, "shape", &SHAPES_OF_HOUSES);
        roofs.by_use = shape.filter(|s| s.value.is_none()).map(|s| s.span);
        let written = shape.and_then(|s| Some(Spanned::new(s.value?, s.span)));
        roofs.style = self.style(&of, written);
        for node in self.children(element, schema.content()) {
            if let AllowedChild::Element(schema, child) = node {
                roofs.lines.extend(self.roof(schema, child));
            }
        }
        roofs
    }

    /// Reads a roof; nothing if its rectangle is unknown.
    fn roof(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<RoofLine> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let shape = self.choice(&of, "shape", &ROOF_SHAPES);
        let style = self.style(&of, shape);
        let direction = self.choice(&of, "ridge", &RIDGE_DIRECTIONS);
        let star = |h: &str| h.trim_matches(is_blank) == "*";
        let automatic = of.get("height").is_some_and(|h| star(h.value.as_str()));
        let height = (!automatic).then(|| self.number(&of, "height"));
        let corners = ["a0", "b0", "a1", "b1"].map(|name| self.number(&of, name));
        let [Some(a0), Some(b0), Some(a1), Some(b1)] = corners else {
            return None;
        };
        let span = [b0, a1, b1].iter().fold(a0.span, |s, c| s.to(c.span));
        let corners = [a0, b0, a1, b1].map(|c| c.value);
        Some(RoofLine {
            span: self.whole(element),
            style,
            direction,
            height: height.flatten(),
            corners: Spanned::new(corners, span),
        })
    }

    /// Reads the style of roofs of a given shape.
    fn style(&mut self, of: &Attributes<'t>, shape: Option<Spanned<RoofShape>>) -> RoofStyle {
        RoofStyle {
            kind: self.choice(of, "kind", &COVERINGS),
            shape,
            pitch: self.number(of, "pitch"),
            eaves: self.number(of, "eaves"),
            verge: self.number(of, "verge"),
            thickness: self.number(of, "thickness"),
            noshi: self
                .whole_number(of, "noshi")
                .map(|n| Spanned::new(u32::try_from(n.value).unwrap_or(0), n.span)),
            sori: self.number(of, "sori"),
            gable: self.number(of, "gable"),
            ratio: self.number(of, "ratio"),
            plain_ridge: self.yes_no(of, "plain_ridge"),
            gable_wall: self.choice(of, "gable_wall", &GableWall::ALL),
            offset: self.number(of, "offset"),
            paint: self.choice(of, "paint", &Paint::ALL),
        }
    }
}
