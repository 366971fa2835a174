//! A house is the unit of work: from its syntax and an id to walls, roofs and fittings. A run, a variant, a tile or a
//! thread is a loop over houses; one made alone with its id is identical to the last bit to the one in a run.

use super::Read;
use crate::ast;
use crate::building::{Building, Built};
use crate::catalog::Catalog;
use crate::diagnostic::Diagnostics;
use crate::expand::{self, Expander, HouseContext, HouseId};
use crate::fit;
use crate::lower;
use crate::program::{self, Picture};
use crate::roof::{self, RoofCache};
use crate::source::{Source, World};
use rayon::prelude::*;

/// Makes one house: expands its syntax, places its walls, roofs and fits it. Returns `None` if it would exceed a limit.
/// Parts refer by index to the images that are returned with it. To make many houses use a [`HouseBuilder`], which
/// shares work between them.
pub fn house(
    house: &ast::House,
    id: HouseId,
    context: HouseContext<'_>,
    (catalog, world): (&Catalog, &dyn World),
    options: &expand::Options,
    out: &mut Diagnostics,
) -> Option<(Built, Vec<Picture>)> {
    let mut builder = HouseBuilder::new(catalog, world, options);
    let built = builder.house(house, id, context, out)?;
    Some((built, builder.into_images()))
}

/// Makes houses one after another and caches what they have in common: looked-up codes and images, and the roofs of
/// houses with the same plan.
pub struct HouseBuilder<'a> {
    catalog: &'a Catalog,
    expander: Expander<'a>,
    roofs: RoofCache,
}

impl<'a> HouseBuilder<'a> {
    /// Creates a builder that has made no house yet.
    pub fn new(catalog: &'a Catalog, world: &'a dyn World, options: &'a expand::Options) -> Self {
        HouseBuilder {
            catalog,
            expander: Expander::new(catalog, world, options),
            roofs: RoofCache::default(),
        }
    }

    /// Makes one house, as [`house`] does; images are numbered for all houses of this builder.
    pub fn house(
        &mut self,
        house: &ast::House,
        id: HouseId,
        context: HouseContext<'_>,
        out: &mut Diagnostics,
    ) -> Option<Built> {
        let house = self.expander.house(house, id, context, out)?;
        Some(finish(house, self.catalog, &mut self.roofs, out))
    }

    /// Returns the images of all houses made so far.
    pub fn into_images(self) -> Vec<Picture> {
        self.expander.into_images()
    }
}

/// Makes walls, then roofs, then fittings of an expanded house.
pub(super) fn finish(
    house: program::House,
    catalog: &Catalog,
    cache: &mut RoofCache,
    out: &mut Diagnostics,
) -> Built {
    let house = lower::house(house, out);
    let mut roofs = roof::house(&house, cache, out);
    let fittings = fit::house(&house, &mut roofs, catalog, out);
    Built {
        house,
        roofs,
        fittings,
    }
}

/// The number of houses finished at a time: enough work for many threads, without keeping more syntax in memory.
const BATCH: usize = 512;

/// The number of houses that share a cache of roofs. It is fixed, so that nothing depends on the number of threads.
const CHUNK: usize = 32;

/// Makes all houses of the documents on the threads of the current `rayon` pool and drops the syntax of each when it is
/// expanded. The id of an unnamed house is its index in its document.
pub(super) fn houses(
    read: &mut Read,
    sources: &[&Source],
    world: &dyn World,
    options: &expand::Options,
    out: &mut Diagnostics,
) -> Building {
    let documents = std::mem::take(&mut read.documents);
    let catalog = &*read.catalog;
    let mut expander = Expander::new(catalog, world, options);
    let (mut batch, mut houses) = (Vec::new(), vec![]);
    // With variants there are the documents of all sources several times.
    let sources = sources.iter().copied().cycle();
    for (number, (source, document)) in sources.zip(documents).enumerate() {
        let variant = document.variant;
        for (index, house) in document.houses.into_iter().enumerate() {
            let context = HouseContext {
                source,
                scope: catalog.known_in(number, index),
                variant,
            };
            let mut found = Diagnostics::new();
            let house = expander.house(&house, HouseId(index as u64), context, &mut found);
            batch.push((house, found));
            if batch.len() == BATCH {
                finish_all(std::mem::take(&mut batch), catalog, &mut houses, out);
            }
        }
    }
    finish_all(batch, catalog, &mut houses, out);
    Building {
        houses,
        images: expander.into_images(),
    }
}

/// Finishes expanded houses in parallel; houses and diagnostics are collected in their order.
fn finish_all(
    expanded: Vec<(Option<program::House>, Diagnostics)>,
    catalog: &Catalog,
    houses: &mut Vec<Built>,
    out: &mut Diagnostics,
) {
    let chunks = expanded.into_par_iter().chunks(CHUNK).map(|chunk| {
        let mut cache = RoofCache::default();
        let finished = chunk.into_iter().map(|(house, mut found)| {
            let built = house.map(|house| finish(house, catalog, &mut cache, &mut found));
            (built, found)
        });
        finished.collect::<Vec<_>>()
    });
    for (built, found) in chunks.collect::<Vec<_>>().into_iter().flatten() {
        houses.extend(built);
        out.append(found);
    }
}
