//! Walls given facade by facade (003): `Structure`, `Facades`, `Facade`, `Floor`, `Texture`.

use crate::parse::schema::vocabulary::{PART_ORDERS, REFLECTIONS, STOREY_KINDS};
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::read::{AllowedChild, Reader};
use crate::parse::xml::tree::Element;
use hsd_base::source::Spanned;
use hsd_ir::ast::{Facade, Floor, Picture, StoreyKind, Structure, Texture};
use hsd_ir::messages::xml as say;

impl<'t> Reader<'t, '_> {
    /// Reads a structure and the textures in it.
    pub(in crate::parse::xml) fn structure(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> (Structure, Vec<Texture>) {
        let of = self.attributes(schema, element);
        let order = self.choice(&of, "order", &PART_ORDERS);
        let mut structure = Structure {
            span: self.start(element),
            size: self.number(&of, "size"),
            scale: self.number(&of, "scale"),
            rightwards: order.is_some_and(|o| o.value),
            facades: vec![],
        };
        let mut textures = vec![];
        for node in self.children(element, schema.content()) {
            match node {
                AllowedChild::Element(schema, child) if schema.tag == Tag::Texture => {
                    textures.extend(self.texture(schema, child));
                }
                AllowedChild::Element(schema, child) => {
                    self.attributes(schema, child);
                    let facades = self.items(child, schema.content(), Self::facade);
                    structure.facades.extend(facades);
                }
                AllowedChild::Text(_) => {}
            }
        }
        (structure, textures)
    }

    fn facade(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Facade {
        let of = self.attributes(schema, element);
        let reflection = self.choice(&of, "reflection", &REFLECTIONS);
        Facade {
            span: self.start(element),
            id: self.text(&of, "id"),
            ratio: self.number(&of, "ratio"),
            angle: self.number(&of, "angle"),
            reflection: reflection.is_some_and(|r| r.value),
            floors: self.items(element, schema.content(), Self::floor),
        }
    }

    fn floor(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Floor {
        let of = self.attributes(schema, element);
        let kind = self.choice(&of, "kind", &STOREY_KINDS);
        Floor {
            span: self.start(element),
            id: self.text(&of, "id"),
            height: self.number(&of, "height"),
            kind: kind.map_or(StoreyKind::Storey, |k| k.value),
            pieces: self.line(element, schema.content(), false).pieces,
        }
    }

    /// Reads a texture: its gloss, its image; nothing if it does not name its part.
    pub(in crate::parse::xml) fn texture(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<Texture> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let reflection = self.number(&of, "reflection");
        let code = self.text(&of, "code");
        let from = || {
            self.reporter
                .source_at(element.range.start)
                .1
                .name()
                .to_owned()
        };
        let src = self.text(&of, "src");
        let src = src.map(|path| Picture { path, from: from() });
        Some(Texture {
            span: self.whole(element),
            reflection: reflection.map(|r| self.share(r)),
            code: code?,
            src,
        })
    }

    /// Checks a share of light; more than the whole of it can only be meant as per cent.
    fn share(&mut self, given: Spanned<f64>) -> Spanned<f64> {
        if given.value <= 1.0 {
            return given;
        }
        let share = given.value / 100.0;
        self.reporter
            .push(|| say::per_cent(given.span, given.value, share));
        Spanned::new(share, given.span)
    }
}
