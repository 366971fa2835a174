//! Custom parts: `PartDef` with its bodies as written. The catalogue interprets them.

use crate::parse::schema::Schema;
use crate::parse::xml::edits;
use crate::parse::xml::read::Reader;
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::token::Attribute;
use crate::parse::xml::tree::{Child, Element};
use hsd_base::source::Spanned;
use hsd_ir::ast::{WrittenAttribute, WrittenBody, WrittenPart};

impl<'t> Reader<'t, '_> {
    /// Reads a part; nothing if it has no code.
    pub(in crate::parse::xml) fn written_part(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<WrittenPart> {
        let of = self.attributes(schema, element);
        let given = schema.attributes.iter().filter_map(|attribute_schema| {
            let attribute = of.get(attribute_schema.name)?;
            Some(self.written_attribute(attribute_schema.name, attribute))
        });
        let attributes = given.collect();
        let body = self.bodies(element);
        of.get("code")?;
        Some(WrittenPart {
            span: self.reporter.span(&element.name_range),
            whole: Some(self.reporter.with_gap(&element.range)),
            attributes,
            body,
        })
    }

    fn bodies(&mut self, element: &'t Element<'t>) -> Vec<WrittenBody> {
        let mut bodies = vec![];
        for child in &element.children {
            match child {
                Child::Text(text) => {
                    let words = text.as_str().trim_matches(is_blank);
                    self.misplaced(&text.whole(), words, element.name);
                }
                Child::Element(index) => {
                    let child = &self.tree.elements[*index];
                    let own = child.attributes.iter().filter(|a| !a.is_foreign());
                    let attributes = own.map(|a| self.written_attribute(a.name, a)).collect();
                    bodies.push(WrittenBody {
                        word: Spanned::new(
                            child.name.to_owned(),
                            self.reporter.span(&child.name_range),
                        ),
                        end: edits::end_name(self.reporter, child),
                        attributes,
                        children: self.bodies(child),
                    });
                }
            }
        }
        bodies
    }

    fn written_attribute(&self, name: &str, attribute: &Attribute<'_>) -> WrittenAttribute {
        let value = attribute.value.as_str().to_owned();
        WrittenAttribute {
            name: Spanned::new(name.to_owned(), self.reporter.span(&attribute.name_range)),
            value: Spanned::new(value, self.value_span(attribute)),
        }
    }
}
