//! Many houses of one text: each variant is the text read and drawn with a seed of its own, the next one each time. So a
//! variant that pleases can be built alone, with its seed.

use super::Read;
use crate::ast::{Document, Variant};
use crate::building::Shell;
use crate::diagnostic::Diagnostics;
use crate::driver::Options;
use crate::parse::xml::Trees;
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
    let first = options.expand.seed.unwrap_or(0);
    let seeds = (0..variants.get()).map(|number| Variant {
        number,
        seed: first.wrapping_add(u64::from(number)),
    });
    let runs: Vec<(Variant, Options)> = seeds
        .map(|variant| {
            let mut options = options.clone();
            options.expand.seed = Some(variant.seed);
            (variant, options)
        })
        .collect();
    let cache = super::cache(sources, options);
    let mut trees = Trees::default();
    let mut documents = vec![];
    for (variant, options) in &runs {
        let mut said = Diagnostics::new();
        let read = super::read(
            sources,
            super::setting(world, options, &cache),
            &mut trees,
            &mut said,
        );
        out.push_new(said);
        documents.extend(read.into_iter().map(|document| Document {
            variant: Some(*variant),
            ..document
        }));
    }
    let setting = super::setting(world, options, &cache);
    let given = &options.catalogs;
    let catalog = super::catalog(sources, &documents, given, (setting, &mut trees), out);
    drop(trees);
    let given = options.catalogs.iter().cloned();
    Read {
        documents,
        included: given.chain(cache.into_sources()).collect(),
        catalog,
    }
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
