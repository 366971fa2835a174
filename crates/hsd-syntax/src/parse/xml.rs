//! The XML form (docs/contract.md 3), in three steps: [`tree`] reads the elements of any file, however malformed, with
//! their places; [`language`] computes expressions and definitions; the rest turns that tree into the document by the
//! tables of [`schema`](crate::parse::schema).
//!
//! Details that the contract leaves open:
//! - `true`, `false`, `1`, `0` are read as `yes` and `no`; attributes with a colon in their name, and `xmlns`, are
//!   ignored as belonging to other programs; a comment inside codes is dropped, which joins the text around it.
//! - Each line of codes is split separately (see [`read::codes`]). White space around line breaks may be full-width.
//! - `random` and `replace` may be in whatever holds parts at any depth, and act on that; a `Floor` may hold its
//!   base row as `Row`.
//! - An unknown word that looks like a known one is read as that one, so that its content is checked too.
//! - Expressions, conditions and definitions are computed on the tree, see [`language`].

mod edits;
mod language;
mod outline;
mod read;
mod suggest;
mod town;
mod tree;
mod trees;
mod written;

pub(super) use outline::outline;
pub use town::{FeatureMade, FeatureOf, MissingFields, RuleMade, features};
pub use trees::Trees;
pub use written::escaped;

use super::ReadContext;
use crate::parse::reporter::Reporter;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Limits, Source, SourceCache};
use hsd_ir::ast::Document;
use read::{ReadSoFar, Reader};

/// The maximum depth of elements whatever the limit is raised to: deeper nesting would overflow the stack of the
/// passes, which recurse.
const DEEPEST: usize = 256;

/// One unit in shaku where a house says nothing: Edo-ma.
const UNIT: f64 = 3.0;

/// Reads a self-contained file in the XML form: its parameters are at their defaults, and it can include nothing.
/// Errors are reported, and the rest is read.
pub fn parse(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Document {
    let cache = SourceCache::new(0, 0, 0);
    let setting = ReadContext::alone(limits, &cache);
    parse_from(source, 0, setting, &mut Trees::default(), out)
}

/// Returns the known word nearest to one.
pub fn nearest<'k>(word: &str, known: impl Iterator<Item = &'k str> + Clone) -> Option<&'k str> {
    suggest::Suggest::new().among(word, known)
}

/// Reads the text from this offset. Elements that were read before are taken from `trees`.
pub(super) fn parse_from<'a>(
    source: &'a Source,
    at: usize,
    setting: ReadContext<'a>,
    trees: &mut Trees<'a>,
    out: &mut Diagnostics,
) -> Document {
    let mut reporter = Reporter::new(source);
    let nesting = setting.limits.nesting.min(DEEPEST);
    let tree = match trees.find(source.id(), at) {
        Some(tree) => tree,
        None => {
            let tree = tree::read(
                &mut reporter,
                at,
                nesting,
                crate::parse::schema::SCHEMA_HINTS,
            );
            trees.keep(source.id(), at, tree)
        }
    };
    let made = language::compute(tree, setting, nesting, trees, &mut reporter);
    let mut reader = Reader {
        turn: None,
        unit: UNIT,
        tree: &made.tree,
        reporter: &mut reporter,
        suggest: suggest::Suggest::new(),
        views: vec![],
        again: ReadSoFar::default(),
    };
    let (mut parts, mut town) = (vec![], None);
    let houses = match made.over {
        true => vec![],
        false => reader.houses(&mut parts, (&mut town, made.facts)),
    };
    let views = reader.views;
    out.append(reporter.finish());
    Document {
        houses,
        views,
        town,
        parameters: made.parameters,
        variant: None,
        parts,
    }
}
