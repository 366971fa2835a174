//! Variants of the sources: each is read with the next seed, so that any of them can be built alone with its seed.

use super::Read;
use super::pieces::Feed;
use crate::Options;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::diagnostic::messages::limits;
use hsd_base::source::{Source, World};
use hsd_ir::ast::{Document, Variant};
use hsd_ir::building::Building;
use hsd_syntax::parse::xml::Trees;
use std::num::NonZeroU32;

/// Reads the sources once for each variant. A diagnostic of one variant is not repeated for the next.
pub(super) fn documents(
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    variants: NonZeroU32,
    out: &mut Diagnostics,
) -> Read {
    let first = options.expand.seed.unwrap_or(0);
    let bytes = sources.iter().map(|source| source.size()).sum();
    let most = options.expand.limits.variants_of(bytes);
    if let Some(source) = sources.first().filter(|_| variants.get() > most) {
        let place = source.span(0..0);
        out.push(limits::too_many_variants(place, variants.get(), most));
    }
    let seeds = (0..variants.get().min(most)).map(|number| Variant {
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
        let mut found = Diagnostics::new();
        let read = super::read(
            Feed::whole(sources),
            super::setting(world, options, &cache),
            &mut trees,
            &mut found,
        );
        out.push_new(found);
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

/// Adds the seed of its variant to the name of each house, after all random choices are made.
pub(super) fn name(building: &mut Building) {
    for house in building.houses.iter_mut().map(|b| &mut b.house) {
        if let Some(variant) = house.variant {
            let number = variant.seed;
            house.name = match &*house.name {
                "" => number.to_string(),
                name => format!("{name} {number}"),
            };
        }
    }
}
