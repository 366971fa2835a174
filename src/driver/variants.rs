//! Many houses of one text: each variant is the text read and drawn with a seed of its own, the next one each time. So a
//! variant that pleases can be built alone, with its seed.

use super::Read;
use crate::ast::{Document, Variant};
use crate::building::Shell;
use crate::diagnostic::Diagnostics;
use crate::driver::{self, Options};
use crate::source::{Source, World};
use std::num::NonZeroU32;

/// Reads the sources once for each variant. What is said of one is not said again of the next.
pub(super) fn documents(
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    variants: NonZeroU32,
    out: &mut Diagnostics,
) -> Read {
    let mut all = Read {
        documents: vec![],
        included: vec![],
    };
    let first = options.expand.seed.unwrap_or(0);
    let mut options = options.clone();
    for number in 0..variants.get() {
        let seed = first.wrapping_add(u64::from(number));
        options.expand.seed = Some(seed);
        let mut said = Diagnostics::new();
        let read = driver::documents(sources, world, &options, &mut said);
        out.push_new(said);
        let of = |document: Document| Document {
            variant: Some(Variant { number, seed }),
            ..document
        };
        all.documents.extend(read.documents.into_iter().map(of));
        if number == 0 {
            all.included = read.included;
        }
    }
    all
}

/// Says in the name of each house which variant it is; draws have no more need of the name.
pub(super) fn name(shell: &mut Shell) {
    for house in &mut shell.houses {
        if let Some(variant) = house.variant {
            let number = variant.seed;
            house.name = match &*house.name {
                "" => number.to_string(),
                name => format!("{name} {number}"),
            };
        }
    }
}
