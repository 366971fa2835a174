//! A house is the unit of work: from its syntax and an id to walls, roofs and fittings. A run, a variant, a tile or a
//! thread is a loop over houses; one made alone with its id is identical to the last bit to the one in a run.

mod feature;

pub(super) use feature::OnFeature;
pub use feature::{FeatureHouse, LeftOut};

use super::overlaps::{Ground, Grounds};
use super::pieces::{Feed, PieceHouse, Pieces};
use super::{Options, Read};
use feature::OfFeature;
use hsd_base::diagnostic::{Diagnostics, Origin};
use hsd_base::source::{Source, World};
use hsd_ir::ast::{self, Document, Variant};
use hsd_ir::building::{Building, Built};
use hsd_ir::catalog::{Catalog, ScopeId};
use hsd_ir::program::{self, Picture};
use hsd_passes::expand::{self, Expander, HouseContext, HouseId};
use hsd_passes::fit;
use hsd_passes::lower;
use hsd_roof::RoofCache;
use rayon::prelude::*;
use std::io;
use std::ops::Range;
use std::sync::Arc;

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
    let mut roofs = hsd_roof::house(&house, cache, out);
    let fittings = fit::house(&house, &mut roofs, catalog, out);
    let (rooms, fixtures) = fit::rooms(&house, catalog, out);
    Built {
        house,
        roofs,
        fittings,
        rooms,
        fixtures,
    }
}

/// The maximum number of houses finished at a time. At the end of a batch all threads wait for its last chunk, so that a batch
/// should have many more houses than a chunk.
pub(super) const BATCH: usize = 512;

/// The number of wall lines after which a batch takes no more houses: roofs of plans with many corners need most of the
/// memory.
const BATCH_LINES: usize = 4 * BATCH;

/// The number of parts after which it takes no more houses.
const BATCH_PARTS: usize = 64 * BATCH;

/// The number of houses that share a cache of roofs. It is fixed, so that nothing depends on the number of threads.
const CHUNK: usize = 16;

/// Expands the houses of documents batch by batch, and drops the syntax of each when it is expanded.
pub(super) struct Expansion<'a> {
    expander: Expander<'a>,
    houses: Box<Houses<'a>>,
    /// The feature whose house was replaced last; the plain body stands for its other houses too.
    replaced: Option<Origin>,
    /// The error that ended the houses.
    failure: Option<io::Error>,
}

/// Houses to be expanded.
type Houses<'a> = dyn Iterator<Item = io::Result<NextHouse<'a>>> + Send + 'a;

/// Receives houses.
pub(super) type Each<'e> = dyn FnMut(Option<Built>, Diagnostics, usize) -> io::Result<()> + 'e;

/// Makes the cache of roofs for some houses.
pub(super) type NewCache<'c> = dyn Fn() -> RoofCache + Sync + 'c;

/// A house to be expanded; with the feature that it stands on, in a town.
struct NextHouse<'a> {
    /// `None` = what was found after the last house.
    house: Option<ast::House>,
    id: HouseId,
    source: Written<'a>,
    scope: ScopeId,
    variant: Option<Variant>,
    feature: Option<OfFeature>,
    /// Diagnostics of the piece of source that it is written in.
    found: Diagnostics,
}

/// The source that a house is written in.
enum Written<'a> {
    Whole(&'a Source),
    Piece(Arc<Source>),
}

impl Written<'_> {
    fn source(&self) -> &Source {
        match self {
            Written::Whole(source) => source,
            Written::Piece(piece) => piece,
        }
    }
}

/// A finished house.
pub(super) struct Finished {
    /// `None` for one that would exceed a limit.
    pub(super) built: Option<Built>,
    /// The diagnostics that were found in it.
    pub(super) found: Diagnostics,
    /// The feature, in a town.
    pub(super) on: Option<OnFeature>,
}

#[cfg(feature = "models")]
impl Finished {
    /// Returns the house of a feature that is left out, if this is one.
    pub(super) fn left_out(&self) -> Option<LeftOut> {
        let on = self.on.as_ref().filter(|_| self.built.is_none())?;
        Some(on.without_house(&self.found))
    }
}

/// Expanded houses with what was found in them; `None` for one that would exceed a limit.
#[derive(Default)]
pub(super) struct Batch {
    pub(super) houses: Vec<(Option<program::House>, Diagnostics, Option<OnFeature>)>,
    /// The number of their wall lines, and of the parts in them.
    lines: usize,
    parts: usize,
    /// The images that no house before these uses, by number.
    pub(super) images: Range<usize>,
}

impl<'a> Expansion<'a> {
    /// The id of an unnamed house is its index in its document.
    pub(super) fn new(
        documents: Vec<Document>,
        catalog: &'a Catalog,
        feed: Feed<'a>,
        world: &'a dyn World,
        options: &'a Options,
    ) -> Expansion<'a> {
        // With variants there are the documents of all sources several times.
        let sources = feed.sources.iter().copied().cycle();
        let documents = sources.zip(documents).enumerate();
        let houses = documents.flat_map(move |(number, (source, document))| {
            let next = move |house, id, source| NextHouse {
                house,
                id: HouseId(id),
                source,
                scope: catalog.known_in(number, id as usize),
                variant: document.variant,
                feature: None,
                found: Diagnostics::new(),
            };
            let houses: Box<Houses<'a>> =
                match feed.long(source) {
                    Some(file) => {
                        let pieces = Pieces::new(file, source, world, options);
                        Box::new(pieces.map(move |house| {
                            let PieceHouse {
                                house,
                                number,
                                piece,
                                found,
                            } = house?;
                            Ok(NextHouse {
                                found,
                                ..next(house, number, Written::Piece(piece))
                            })
                        }))
                    }
                    None => {
                        let houses = document.houses.into_iter().zip(0..);
                        Box::new(houses.map(move |(house, id)| {
                            Ok(next(Some(house), id, Written::Whole(source)))
                        }))
                    }
                };
            houses
        });
        Expansion {
            expander: Expander::new(catalog, world, &options.expand),
            houses: Box::new(houses),
            replaced: None,
            failure: None,
        }
    }

    /// Expands the houses of a town. Draws are keyed by seeds of their own, not by their number.
    pub(super) fn of_town(
        houses: impl Iterator<Item = FeatureHouse> + Send + 'a,
        catalog: &'a Catalog,
        source: &'a Source,
        world: &'a dyn World,
        options: &'a expand::Options,
    ) -> Expansion<'a> {
        let houses = houses.map(move |made| {
            Ok(NextHouse {
                house: Some(made.house),
                id: HouseId(0),
                source: Written::Whole(source),
                scope: catalog.known_in(0, 0),
                variant: None,
                feature: Some(OfFeature {
                    on: OnFeature {
                        feature: made.feature,
                        origin: made.origin,
                        name: made.name,
                    },
                    plain: made.plain,
                    within: made.within,
                }),
                found: Diagnostics::new(),
            })
        });
        Expansion {
            expander: Expander::new(catalog, world, options),
            houses: Box::new(houses),
            replaced: None,
            failure: None,
        }
    }

    /// Expands the next houses, at most this many; `None` if there are none.
    pub(super) fn batch(&mut self, most: usize) -> Option<Batch> {
        let before = self.expander.images().len();
        let mut batch = Batch::default();
        while !batch.is_full(most)
            && let Some(next) = self.houses.next()
        {
            match next {
                Ok(next) => self.expand(next, &mut batch),
                Err(error) => {
                    self.failure.get_or_insert(error);
                }
            }
        }
        batch.images = before..self.expander.images().len();
        (!batch.houses.is_empty()).then_some(batch)
    }

    fn expand(&mut self, next: NextHouse<'_>, batch: &mut Batch) {
        let NextHouse {
            house,
            id,
            source,
            scope,
            variant,
            feature,
            mut found,
        } = next;
        let Some(house) = house else {
            batch.push(None, found, None);
            return;
        };
        let context = HouseContext {
            source: source.source(),
            scope,
            variant,
        };
        if let Some(feature) = &feature
            && self.replaced.as_ref() == Some(&feature.on.origin)
        {
            return;
        }
        let mut made = self.expander.house(&house, id, context, &mut found);
        let Some(feature) = feature else {
            batch.push(made, found, None);
            return;
        };
        let message = feature.unfit(&house, made.as_ref(), &found);
        if let Some(message) = message {
            found = Diagnostics::new();
            let mut ignored = Diagnostics::new();
            let plain = feature.plain.as_deref();
            made = plain.and_then(|h| self.expander.house(h, id, context, &mut ignored));
            self.replaced = made.is_some().then(|| feature.on.origin.clone());
            found.push(message);
        }
        if let Some(house) = &mut made {
            house.name.clone_from(&feature.on.name);
        }
        let found = found.of_feature(&feature.on.origin);
        batch.push(made, found, Some(feature.on));
    }

    /// Makes all houses on the threads of the current `rayon` pool: while some are finished, those after them are expanded.
    /// `each` receives them in their order, `None` for one that would exceed a limit, with what was found in it and the
    /// number of images so far.
    ///
    /// # Errors
    /// Those of `each`.
    pub(super) fn each(
        &mut self,
        catalog: &Catalog,
        cache: &NewCache<'_>,
        each: &mut Each<'_>,
    ) -> io::Result<()> {
        let mut next = self.batch(BATCH);
        while let Some(batch) = next {
            let images = self.expander.images().len();
            let (finished, ahead) = rayon::join(
                || batch.finish(catalog, cache, |_, houses| houses),
                || self.batch(BATCH),
            );
            for house in finished.into_iter().flatten() {
                each(house.built, house.found, images)?;
            }
            next = ahead;
        }
        Ok(())
    }

    /// Returns the images of all houses so far.
    pub(super) fn images(&self) -> &[Picture] {
        self.expander.images()
    }

    /// Returns the images of all houses.
    ///
    /// # Errors
    /// The one that ended the houses: a long file could not be read to its end.
    pub(super) fn into_images(self) -> io::Result<Vec<Picture>> {
        match self.failure {
            Some(error) => Err(error),
            None => Ok(self.expander.into_images()),
        }
    }
}

impl Batch {
    fn push(&mut self, house: Option<program::House>, found: Diagnostics, on: Option<OnFeature>) {
        let storeys = house.iter().flat_map(|house| &house.storeys);
        let loops = storeys.flat_map(|storey| &storey.loops);
        for line in loops.flat_map(|walk| &walk.lines) {
            self.lines += 1;
            self.parts += line.units.len();
        }
        self.houses.push((house, found, on));
    }

    fn is_full(&self, most: usize) -> bool {
        self.houses.len() >= most || self.lines >= BATCH_LINES || self.parts >= BATCH_PARTS
    }

    /// Finishes the houses in parallel, some at a time, and hands them to `then`; returns its results in order.
    pub(super) fn finish<T: Send>(
        self,
        catalog: &Catalog,
        cache: &NewCache<'_>,
        then: impl Fn(usize, Vec<Finished>) -> T + Sync,
    ) -> Vec<T> {
        let chunks = self.houses.into_par_iter().chunks(CHUNK).enumerate();
        // One chunk at a time, so that no thread waits long for the last of another.
        let chunks = chunks.with_max_len(1).map(|(number, chunk)| {
            let mut cache = cache();
            let finished = chunk.into_iter().map(|(house, mut found, on)| {
                let placed = house
                    .as_ref()
                    .and_then(|house| Some((house.placed?, house.span)));
                let built = house.map(|house| finish(house, catalog, &mut cache, &mut found));
                // What is wrong with a type of the library is mended where it is placed.
                let found = match (&on, placed) {
                    (Some(on), _) => found.of_feature(&on.origin),
                    (None, Some((by, span))) if by.library => found.moved(span.file, by.span),
                    (None, _) => found,
                };
                Finished { built, found, on }
            });
            then(number * CHUNK, finished.collect())
        });
        chunks.collect()
    }
}

/// Makes all houses of the documents and drops the syntax of each when it is expanded. The id of an unnamed house is its
/// index in its document. `together` is true if the sources make one scene, so that their houses must not stand in each
/// other.
pub(super) fn houses(
    read: &mut Read,
    (sources, together): (&[&Source], bool),
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Building {
    let documents = std::mem::take(&mut read.documents);
    let feed = Feed::whole(sources);
    let mut expansion = Expansion::new(documents, &read.catalog, feed, world, options);
    let mut grounds = Grounds::new(together || sources.len() == 1);
    let mut houses = vec![];
    let cache = || match together {
        true => options.shown_roofs(),
        false => options.all_roofs(),
    };
    let made = expansion.each(&read.catalog, &cache, &mut |built, found, _| {
        if let Some(built) = built {
            // Variants are placed in rows later.
            let ground = Some(&built.house).filter(|house| house.variant.is_none());
            grounds.add(ground.and_then(|house| Ground::of(house, &read.catalog)));
            houses.push(built);
        }
        out.append(found);
        Ok(())
    });
    grounds.report(|span| feed.first_line(span, &read.included), out);
    let images = made.and_then(|()| expansion.into_images());
    let images = images.expect("all sources are in memory");
    Building { houses, images }
}
