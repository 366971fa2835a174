//! Own parts: `PartDef` with its bodies as they are written. What they mean is the business of the catalogue.

use crate::ast::{BodyEntry, PartEntry, Said};
use crate::parse::xml::edits;
use crate::parse::xml::read::Reader;
use crate::parse::xml::schema::Schema;
use crate::parse::xml::tree::tag::{Attribute, is_blank};
use crate::parse::xml::tree::{Child, Element};
use crate::source::Spanned;

impl<'t> Reader<'t, '_> {
    /// Reads a part; nothing where it has no code.
    pub(in crate::parse::xml) fn part_entry(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<PartEntry> {
        let of = self.attributes(schema, element);
        let given = schema.attributes.iter().filter_map(|bears| {
            let attribute = of.get(bears.name)?;
            Some(self.said(bears.name, attribute))
        });
        let attributes = given.collect();
        let body = self.bodies(element);
        of.get("code")?;
        Some(PartEntry {
            span: self.faults.span(&element.name_range),
            whole: Some(self.faults.with_gap(&element.range)),
            attributes,
            body,
        })
    }

    fn bodies(&mut self, element: &'t Element<'t>) -> Vec<BodyEntry> {
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
                    let attributes = own.map(|a| self.said(a.name, a)).collect();
                    bodies.push(BodyEntry {
                        word: Spanned::new(
                            child.name.to_owned(),
                            self.faults.span(&child.name_range),
                        ),
                        end: edits::end_name(self.faults, child),
                        attributes,
                        children: self.bodies(child),
                    });
                }
            }
        }
        bodies
    }

    fn said(&self, name: &str, attribute: &Attribute<'_>) -> Said {
        let value = attribute.value.as_str().to_owned();
        Said {
            name: Spanned::new(name.to_owned(), self.faults.span(&attribute.name_range)),
            value: Spanned::new(value, self.value_span(attribute)),
        }
    }
}
