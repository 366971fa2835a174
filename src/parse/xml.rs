//! The XML form (language.md 3), in two steps: [`tree`] reads the elements of any file, however broken, with their
//! places; the rest turns that tree into the document by the tables of [`schema`].
//!
//! What the contract leaves open is settled so:
//! - `true`, `false`, `1`, `0` are read as `yes` and `no`; attributes with a colon in their name, and `xmlns`, are
//!   other programs' business and passed over; a comment inside codes vanishes and joins what stands round it.
//! - Each line of codes is cut for itself (see [`codes`]). White space round line breaks may be full-width.
//! - `random` and `replace` may stand in whatever holds parts at any depth, and act on that; a `Floor` may hold its
//!   base row as `Row`.
//! - An unknown word that looks like a known one is read as that one, so that what stands in it is checked too.
//! - `{k}` in codes and ids is left to `expand`; other expressions are not read by this version.

mod codes;
mod facades;
mod house;
mod pieces;
mod read;
mod roofs;
mod scan;
mod schema;
mod slash;
mod suggest;
mod tag;
mod text;
mod tree;
mod values;

use super::faults::Faults;
use crate::ast::{Document, House};
use crate::diagnostic::Diagnostics;
use crate::source::{Limits, Source};
use read::{Node, Reader};
use schema::Tag;

/// Deeper nesting would overflow the stack of the passes, which recurse, whatever the limit is raised to.
const DEEPEST: usize = 256;

/// Reads a file in the XML form. Whatever is wrong with it is reported, and the rest of it read.
pub fn parse(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Document {
    parse_from(source, 0, limits, out)
}

/// Reads what stands from this offset of the text on.
pub(super) fn parse_from(
    source: &Source,
    at: usize,
    limits: &Limits,
    out: &mut Diagnostics,
) -> Document {
    let mut faults = Faults::new(source, out);
    let nesting = limits.nesting.min(DEEPEST);
    let tree = tree::read(&mut faults, at, nesting, schema::HABITS);
    let mut reader = Reader {
        tree: &tree,
        faults: &mut faults,
        suggest: suggest::Suggest::new(),
    };
    let houses = reader.houses();
    faults.finish();
    Document { houses }
}

impl Reader<'_, '_> {
    fn houses(&mut self) -> Vec<House> {
        let mut houses = vec![];
        for node in self.roots() {
            let Node::Element(schema, element) = node else {
                continue;
            };
            match schema.tag {
                Tag::House => houses.push(self.house(schema, element)),
                Tag::Structure => houses.push(self.lone_structure(schema, element)),
                _ => {
                    self.attributes(schema, element);
                    for node in self.children(element, &schema::HOUSES) {
                        if let Node::Element(schema, element) = node {
                            houses.push(self.house(schema, element));
                        }
                    }
                }
            }
        }
        houses
    }
}
