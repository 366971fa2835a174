//! Walls given facade by facade (003): `Structure`, `Facades`, `Facade`, `Floor`, `Texture`.

use super::read::{Node, Reader};
use super::schema::{self, Schema, Tag};
use super::tree::Element;
use super::values::{SIZE, TURN};
use crate::ast::{Facade, Floor, StoreyKind, Structure, Texture};
use crate::diagnostic::messages::xml as say;
use crate::source::Spanned;

/// What a storey or a floor is for.
pub(super) const KINDS: &[(&str, StoreyKind)] = &[
    ("storey", StoreyKind::Storey),
    ("parapet", StoreyKind::Parapet),
];

impl<'t> Reader<'t, '_> {
    /// Reads a structure and the textures in it.
    pub(super) fn structure(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> (Structure, Vec<Texture>) {
        let of = self.attributes(schema, element);
        let order = self.choice(&of, "order", &[("left", false), ("right", true)]);
        let mut structure = Structure {
            span: self.start(element),
            size: self.number(&of, "size", SIZE),
            scale: self.number(&of, "scale", 1e-6..=1e6),
            rightwards: order.is_some_and(|o| o.value),
            facades: vec![],
        };
        let mut textures = vec![];
        for node in self.children(element, &schema::STRUCTURE) {
            match node {
                Node::Element(schema, child) if schema.tag == Tag::Texture => {
                    textures.extend(self.texture(schema, child));
                }
                Node::Element(schema, child) => {
                    self.attributes(schema, child);
                    let facades = self.items(child, &schema::FACADES, Self::facade);
                    structure.facades.extend(facades);
                }
                Node::Text(_) => {}
            }
        }
        (structure, textures)
    }

    fn facade(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Facade {
        let of = self.attributes(schema, element);
        let reflection = self.choice(&of, "reflection", &[("enable", true), ("disable", false)]);
        Facade {
            span: self.start(element),
            id: self.text(&of, "id"),
            ratio: self.number(&of, "ratio", 1e-6..=1e6),
            angle: self.number(&of, "angle", TURN),
            reflection: reflection.is_some_and(|r| r.value),
            floors: self.items(element, &schema::FACADE, Self::floor),
        }
    }

    fn floor(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Floor {
        let of = self.attributes(schema, element);
        let kind = self.choice(&of, "kind", KINDS);
        Floor {
            span: self.start(element),
            id: self.text(&of, "id"),
            height: self.number(&of, "height", SIZE),
            kind: kind.map_or(StoreyKind::Storey, |k| k.value),
            pieces: self.line(element, &schema::FLOOR, false).pieces,
        }
    }

    /// Reads the gloss of a texture; nothing where it does not say of which.
    pub(super) fn texture(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<Texture> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let reflection = self.number(&of, "reflection", 0.0..=100.0);
        let code = self.text(&of, "code");
        if let Some(src) = of.get("src") {
            let name = code.as_ref().map_or("", |c| c.value.as_str());
            self.faults.at(&src.range, |s| {
                say::src_not_yet(s, src.value.as_str(), name)
            });
        }
        Some(Texture {
            span: self.whole(element),
            reflection: reflection.map(|r| self.share(r)),
            code: code?,
        })
    }

    /// A share of light; more than the whole of it can only be meant as per cent.
    fn share(&mut self, given: Spanned<f64>) -> Spanned<f64> {
        if given.value <= 1.0 {
            return given;
        }
        let share = given.value / 100.0;
        self.faults
            .push(|| say::per_cent(given.span, given.value, share));
        Spanned::new(share, given.span)
    }
}
