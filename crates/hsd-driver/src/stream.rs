//! A run that hands its houses on as they are made and keeps none: a town of any size takes the memory of some hundred
//! houses. Long sources are read in pieces meanwhile; the others are in memory.

use super::house::{BATCH, Batch, Expansion, FeatureHouse, LeftOut, NewCache};
use super::models::{not_shown, use_by};
use super::overlaps::{Ground, SpilledGrounds};
use super::pieces::Feed;
use super::places::{Places, provenance};
use super::plainer::plainer;
use super::{Options, Read, beside, documents_of, refuse_towns, spare_expressions, timed};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::diagnostic::messages::limits::too_many_triangles;
use hsd_base::source::{Source, Span, World};
use hsd_export::images::Library;
use hsd_export::sound;
use hsd_export::spool::NewSpool;
use hsd_ir::catalog::Catalog;
use hsd_ir::program::PictureId;
use hsd_mesh::{HouseDrafts, SceneBuilder, Tessellator};
use hsd_passes::messages::pictures as say;
use hsd_scene::{Counter, Material, Provenance, ScenePart, Stats};
use std::borrow::Cow;
use std::io;
use std::time::Duration;

/// The result of a streamed run, whose houses have been handed on.
#[derive(Debug)]
pub struct Streamed {
    /// Files that the sources include, for reports.
    pub included: Vec<Source>,
    /// The catalogue with the custom parts of the sources.
    pub catalog: Cow<'static, Catalog>,
    /// The materials of all houses, by the numbers that their meshes give them.
    pub materials: Vec<Material>,
    /// The images of the materials.
    pub library: Library,
    /// The factor by which distances from the upper edge of each baked page have grown.
    pub grown: Vec<f32>,
    /// The paths of part textures.
    pub pictures: Vec<String>,
    /// What the model is made from.
    pub provenance: Provenance,
    /// The number of houses.
    pub houses: usize,
    /// The houses of a town that are left out, since they would exceed a limit.
    pub left_out: Vec<LeftOut>,
    /// Their triangles, meshes and nodes.
    pub stats: Stats,
    /// The durations of the stages, in order.
    pub times: Vec<(&'static str, Duration)>,
}

/// Takes houses in their order, with the images of their materials except baked pages.
pub type Sink<'s> = dyn FnMut(ScenePart<'_>, &Library) -> io::Result<()> + Send + 's;

/// Where houses go, and where the run keeps what it needs of all of them at its end.
pub type Outlet<'s, 'n> = (&'n mut Sink<'s>, NewSpool<'n>);

/// Runs the whole chain like [`compile`](super::compile), on the threads of the current `rayon` pool, and hands the houses
/// to the sink, some hundred at a time. It does not stop at errors of the sources: everything valid is built. Variants
/// are not made.
///
/// # Errors
/// Those of the sink and of the spool.
pub fn stream(
    feed: Feed<'_>,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
    outlet: Outlet<'_, '_>,
) -> io::Result<Streamed> {
    let mut times = vec![];
    let read = timed(&mut times, "parse", || {
        let mut read = documents_of(feed, world, options, out);
        refuse_towns(&read.documents, out);
        beside::put(&mut read, feed.sources, world, options, out);
        read
    });
    let Read {
        documents,
        included,
        catalog,
    } = read;
    let expansion = Expansion::new(documents, &catalog, feed, world, options);
    let run = (feed, world, options);
    let made = run_houses(
        run,
        (expansion, &mut std::iter::empty()),
        &catalog,
        &included,
        true,
        (out, outlet),
        &mut times,
    )?;
    Ok(made.with(included, catalog, times))
}

/// As [`stream`], of the houses of a town, whose file has been read, and of its ground behind them.
///
/// # Errors
/// Those of the sink and of the spool.
pub fn stream_town(
    (source, read): (&Source, Read),
    houses: impl Iterator<Item = FeatureHouse> + Send,
    ground: &mut dyn Iterator<Item = HouseDrafts>,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
    outlet: Outlet<'_, '_>,
) -> io::Result<Streamed> {
    let mut times = vec![];
    let (included, catalog) = (read.included, read.catalog);
    let expansion = Expansion::of_town(houses, &catalog, source, world, &options.expand);
    let sources = [source];
    let run = (Feed::whole(&sources), world, options);
    let made = run_houses(
        run,
        (expansion, ground),
        &catalog,
        &included,
        false,
        (out, outlet),
        &mut times,
    )?;
    Ok(made.with(included, catalog, times))
}

/// What a run leaves behind.
struct Left {
    materials: Vec<Material>,
    library: Library,
    grown: Vec<f32>,
    pictures: Vec<String>,
    provenance: Provenance,
    houses: usize,
    left_out: Vec<LeftOut>,
    stats: Stats,
}

impl Left {
    fn with(
        self,
        included: Vec<Source>,
        catalog: Cow<'static, Catalog>,
        times: Vec<(&'static str, Duration)>,
    ) -> Streamed {
        Streamed {
            included,
            catalog,
            materials: self.materials,
            library: self.library,
            grown: self.grown,
            pictures: self.pictures,
            provenance: self.provenance,
            houses: self.houses,
            left_out: self.left_out,
            stats: self.stats,
            times,
        }
    }
}

/// Makes the houses of an expansion; `apart` = they must not stand in each other, unlike those of a town.
fn run_houses(
    (feed, world, options): (Feed<'_>, &dyn World, &Options),
    (mut expansion, ground): (Expansion<'_>, &mut dyn Iterator<Item = HouseDrafts>),
    catalog: &Catalog,
    included: &[Source],
    apart: bool,
    (out, (sink, new)): (&mut Diagnostics, Outlet<'_, '_>),
    times: &mut Vec<(&'static str, Duration)>,
) -> io::Result<Left> {
    let shapes = shapes(options, apart);
    let tessellator = Tessellator::new(catalog, shapes);
    let places = Places::new(feed, included, options);
    let mut town = Town {
        world,
        options,
        scene: empty_scene(options),
        library: Library::default(),
        counter: Counter::default(),
        grounds: SpilledGrounds::new(apart, new),
        houses: 0,
        left_out: vec![],
        together: FIRST,
        first: Span::default(),
        flaws: 0,
        out,
        sink,
    };
    timed(times, "houses", || {
        town.build(&mut expansion, (&tessellator, &places, shapes), catalog)?;
        town.lay(ground)
    })?;
    let Town {
        scene,
        mut library,
        counter,
        grounds,
        houses,
        left_out,
        ..
    } = town;
    if apart {
        grounds.report(|span| feed.first_line(span, included), out)?;
    }
    let (materials, baked, grown) = scene.into_images();
    library.bake(&baked);
    let pictures = expansion.into_images()?;
    spare_expressions(feed, included, out);
    Ok(Left {
        materials,
        library,
        grown,
        pictures: pictures.into_iter().map(|p| p.path).collect(),
        provenance: provenance(feed.sources, included, options),
        houses,
        left_out,
        stats: counter.stats(),
    })
}

/// Returns the options of the meshes of a run; houses that need not stand apart are those of a town.
fn shapes(options: &Options, apart: bool) -> hsd_mesh::Options {
    hsd_mesh::Options {
        town: !apart,
        ..options.shapes()
    }
}

/// Returns a scene for the houses of a run.
fn empty_scene(options: &Options) -> SceneBuilder {
    let mut scene = SceneBuilder::new(options.detail);
    if options.own_meshes {
        scene.forget_twins();
    }
    scene
}

/// Houses that are made but not yet written.
struct Made {
    houses: Vec<HouseDrafts>,
    count: usize,
    /// The place of the first house.
    first: Option<Span>,
    found: Vec<Diagnostics>,
    left_out: Vec<LeftOut>,
    grounds: Vec<Ground>,
    /// New images by number, with the place that uses each first.
    images: Vec<(usize, Option<Span>)>,
}

impl Made {
    /// Makes the houses of a batch; the first has this number in the run.
    fn of(
        batch: Batch,
        number: usize,
        (tessellator, places, shapes): (&Tessellator<'_>, &Places<'_>, hsd_mesh::Options),
        (catalog, cache): (&Catalog, &NewCache<'_>),
    ) -> Made {
        let images = batch.images.clone();
        let chunks = batch.finish(catalog, cache, |first, houses| {
            let (mut built, mut found, mut features) = (vec![], vec![], vec![]);
            let mut left_out: Vec<LeftOut> = vec![];
            for house in houses {
                left_out.extend(house.left_out());
                found.push(house.found);
                if let Some(house_built) = house.built {
                    built.push(house_built);
                    features.push(house.on);
                }
            }
            let uses = |id: usize| built.iter().find_map(|b| use_by(b, PictureId(id as u32)));
            let mut drafts = tessellator.houses(&built, number + first);
            places.tell(drafts.nodes_mut());
            let oversized = drafts.take_oversized();
            let mut count = built.len() - oversized.len();
            let mut houses = vec![drafts];
            for (at, place) in oversized {
                let mut own = Diagnostics::new();
                match &features[at] {
                    None => own.push(too_many_triangles(place, shapes.triangles)),
                    Some(on) => {
                        let house = (&built[at], number + first + at);
                        match plainer(house, on, (catalog, shapes), &mut own) {
                            Ok(mut drafts) => {
                                places.tell(drafts.nodes_mut());
                                houses.push(drafts);
                                count += 1;
                            }
                            Err(left) => left_out.push(left),
                        }
                    }
                }
                found.push(own);
            }
            Made {
                houses,
                count,
                first: built.first().map(|b| b.house.span),
                found,
                left_out,
                grounds: built
                    .iter()
                    .filter_map(|b| Ground::of(&b.house, catalog))
                    .collect(),
                images: images.clone().map(|id| (id, uses(id))).collect(),
            }
        });
        let merged = chunks.into_iter().reduce(Made::and);
        merged.expect("no batch is empty")
    }

    fn and(mut self, next: Made) -> Made {
        self.houses.extend(next.houses);
        self.count += next.count;
        self.first = self.first.or(next.first);
        self.found.extend(next.found);
        self.left_out.extend(next.left_out);
        self.grounds.extend(next.grounds);
        for ((_, used), (_, also)) in self.images.iter_mut().zip(next.images) {
            *used = used.or(also);
        }
        self
    }
}

/// The maximum number of shapes reported as left out of a model.
const MOST_FLAWS: usize = 20;

/// The number of houses to make at a time before it is known how many bytes one has.
const FIRST: usize = 32;

/// The bytes of meshes to make at a time.
const BYTES: usize = 16 << 20;

/// Returns the next number of houses to make at a time, from the number of the last ones and their bytes. It depends on houses
/// alone, and no house depends on it.
fn paced(together: usize, houses: usize, bytes: usize) -> usize {
    let each = bytes / houses.max(1);
    (BYTES / each.max(1)).min(2 * together).clamp(1, BATCH)
}

/// The run so far.
struct Town<'a, 's> {
    world: &'a dyn World,
    options: &'a Options,
    scene: SceneBuilder,
    library: Library,
    counter: Counter,
    grounds: SpilledGrounds<'s>,
    houses: usize,
    left_out: Vec<LeftOut>,
    /// The number of houses to make at a time.
    together: usize,
    /// The place of the first house.
    first: Span,
    flaws: usize,
    out: &'a mut Diagnostics,
    sink: &'a mut Sink<'s>,
}

impl Town<'_, '_> {
    /// Makes all houses. While some are made, those before them are handed on and those after them expanded.
    fn build(
        &mut self,
        expansion: &mut Expansion<'_>,
        makers: (&Tessellator<'_>, &Places<'_>, hsd_mesh::Options),
        catalog: &Catalog,
    ) -> io::Result<()> {
        let cache = || self.options.shown_roofs();
        let (mut number, mut done) = (1, None);
        let mut next = expansion.batch(self.together);
        while let Some(batch) = next.take() {
            let count = batch.houses.len();
            let (made, ahead) = rayon::join(
                || Made::of(batch, number, makers, (catalog, &cache)),
                || {
                    let written = match done.take() {
                        Some(made) => self.add(made, expansion),
                        None => Ok(()),
                    };
                    written.map(|()| expansion.batch(self.together))
                },
            );
            number += count;
            done = Some(made);
            next = ahead?;
        }
        match done {
            Some(made) => self.add(made, expansion),
            None => Ok(()),
        }
    }

    /// Hands the ground on.
    fn lay(&mut self, ground: &mut dyn Iterator<Item = HouseDrafts>) -> io::Result<()> {
        for piece in ground {
            self.scene.add(piece);
            let part = self.scene.part();
            self.counter.add(part);
            (self.sink)(part, &self.library)?;
            self.scene.forget();
        }
        Ok(())
    }

    /// Hands houses on.
    fn add(&mut self, made: Made, expansion: &Expansion<'_>) -> io::Result<()> {
        for found in made.found {
            self.out.append(found);
        }
        self.left_out.extend(made.left_out);
        self.grounds.add(made.grounds)?;
        let limits = &self.options.expand.limits;
        for (id, used) in made.images {
            let path = &expansion.images()[id].path;
            self.library.add(path, self.world, limits.pixels, |error| {
                let span = used.unwrap_or_default();
                self.out.push(not_shown(error, path, span, limits));
            });
        }
        if self.houses == 0 {
            self.first = made.first.unwrap_or_default();
        }
        self.houses += made.count;
        let bytes: usize = made.houses.iter().map(HouseDrafts::bytes).sum();
        self.together = paced(self.together, made.count, bytes);
        made.houses.into_iter().for_each(|h| self.scene.add(h));
        let part = self.scene.part();
        // One broken mesh may be shown a thousand times.
        let before = self.flaws;
        for flaw in sound::flaws(part).take(MOST_FLAWS - before) {
            self.flaws += 1;
            let place = flaw.span.unwrap_or(self.first);
            self.out.push(say::shape_left_out(place, &flaw.name));
        }
        let part = ScenePart {
            sound: before < MOST_FLAWS && self.flaws == before,
            ..part
        };
        self.counter.add(part);
        (self.sink)(part, &self.library)?;
        self.scene.forget();
        Ok(())
    }
}
