//! The chain from end to end: sources -> parse -> for each house expand, lower, roof, fit -> tessellate.
//!
//! [`compile`] runs all steps; each is also a function, so that a shell can stop after any of them. `house` makes one
//! house by itself. Nothing here reads a file: images come through a [`World`].

#![cfg_attr(not(feature = "models"), allow(dead_code))] // items for scenes

#[cfg(feature = "models")]
pub mod plan_file;
#[cfg(feature = "models")]
pub mod fs;
#[cfg(feature = "models")]
mod arrange;
#[cfg(feature = "models")]
mod beside;
mod convert;
mod gaps;
mod house;
#[cfg(feature = "models")]
mod models;
mod overlaps;
mod parts;
mod pieces;
#[cfg(feature = "models")]
mod places;
#[cfg(feature = "models")]
mod plainer;
#[cfg(feature = "models")]
mod stream;
#[cfg(feature = "models")]
mod tile;
#[cfg(feature = "models")]
mod variants;

#[cfg(feature = "models")]
pub use beside::is_put_aside;
pub use convert::convert;
pub use house::{FeatureHouse, HouseBuilder, LeftOut, house};
pub use hsd_passes::expand::{HouseContext, HouseId};
#[cfg(feature = "models")]
pub use models::{Compiled, Inspected, compile, compile_bytes, flaws, inspect, pictures, scene};
pub use parts::BESIDE as PARTS_BESIDE;
pub use parts::catalog;
pub use pieces::Feed;
#[cfg(feature = "models")]
pub use stream::{Outlet, Sink, Streamed, stream, stream_town};
#[cfg(feature = "models")]
pub use tile::{TileDriver, TileHouses, TileLooks, TileScene};

use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Source, SourceCache, World};
use hsd_ir::ast::{Document, NamedView, Parameter};
use hsd_ir::building::Building;
use hsd_ir::catalog::Catalog;
use hsd_ir::messages::xml;
use hsd_ir::program::Program;
use hsd_passes::expand;
use hsd_roof::{KeptRoofs, RoofCache};
#[cfg(feature = "models")]
use hsd_scene::{Detail, Shown};
use hsd_syntax::parse;
use hsd_syntax::parse::Values;
use hsd_syntax::parse::xml::Trees;
use std::borrow::Cow;
use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The options of a run.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Seed and limits.
    pub expand: expand::Options,
    /// Parameters of the sources and their values; the last value of a name counts.
    pub parameters: Vec<(String, String)>,
    /// The level of detail.
    #[cfg(feature = "models")]
    pub detail: Detail,
    /// How much of each house the model shows.
    #[cfg(feature = "models")]
    pub shown: Shown,
    /// Files of custom parts for all houses; later definitions of a part override earlier ones.
    pub catalogs: Arc<[Source]>,
    /// The number of variants of the sources to make, each with the next seed, placed in rows.
    pub variants: Option<NonZeroU32>,
    /// Roofs of earlier runs, where houses come back. They change nothing but the time.
    pub roofs: Option<KeptRoofs>,
    /// True if roofs have all that they can have even where the level of detail shows less: drawings have their edges.
    pub all_roofs: bool,
    /// True if a streamed run gives each house its own meshes, also those that houses before it had.
    pub own_meshes: bool,
    /// True if [`check`] records the values of expressions and names.
    pub notes_values: bool,
}

#[cfg(feature = "models")]
impl Options {
    /// Returns how houses are tessellated.
    pub fn shapes(&self) -> hsd_mesh::Options {
        hsd_mesh::Options {
            detail: self.detail,
            shown: self.shown,
            triangles: self.expand.limits.triangles,
            town: false,
        }
    }
}

impl Options {
    /// Returns a cache for roofs with all that they have.
    fn all_roofs(&self) -> RoofCache {
        self.roofs
            .as_ref()
            .map(KeptRoofs::cache)
            .unwrap_or_default()
    }

    /// Returns a cache for roofs with what the level of detail shows of them.
    fn shown_roofs(&self) -> RoofCache {
        #[cfg(feature = "models")]
        let afar = self.detail == Detail::Body && !self.all_roofs;
        #[cfg(not(feature = "models"))]
        let afar = false;
        self.all_roofs().from_afar(afar)
    }
}

/// The result of checking sources, without a scene.
#[derive(Debug)]
pub struct Checked {
    /// The parameters of the source files.
    pub parameters: Vec<Parameter>,
    /// The named views of the source files.
    pub views: Vec<NamedView>,
    /// Files that the sources include, for reports.
    pub included: Vec<Source>,
    /// The catalogue with the custom parts of the sources.
    pub catalog: Cow<'static, Catalog>,
    /// Walls and roofs.
    pub building: Building,
    /// The values of expressions and names, if requested.
    pub values: Values,
    /// True if one of the sources is a town, whose rules are evaluated with its maps.
    pub is_town: bool,
}

/// Runs the chain up to the roofs and reads the images, so that every error is reported.
pub fn check(
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Checked {
    let values = Values::default();
    let noted = options.notes_values.then_some(&values);
    let mut read = documents_noted(Feed::whole(sources), world, options, noted, out);
    let parameters = |d: &mut Document| std::mem::take(&mut d.parameters);
    let parameters = read.documents.iter_mut().flat_map(parameters).collect();
    let views = read.documents.iter_mut();
    let views = views.flat_map(|d| std::mem::take(&mut d.views)).collect();
    let is_town = read.documents.iter().any(|d| d.town.is_some());
    let building = house::houses(&mut read, (sources, false), world, options, out);
    let (included, catalog) = (read.included, read.catalog);
    #[cfg(feature = "models")]
    models::check_images(&building, world, &options.expand.limits, out);
    spare_expressions(Feed::whole(sources), &included, out);
    Checked {
        parameters,
        views,
        included,
        catalog,
        building,
        values,
        is_town,
    }
}

/// Removes fixes that would replace an expression by a word, or insert codes right after one: a computed value is not
/// fixed at its use, and blanks that pad a code belong to it.
fn spare_expressions(feed: Feed<'_>, included: &[Source], out: &mut Diagnostics) {
    out.retain_fixes(|edit| {
        let (before, there) = feed.written(edit.span, included);
        let computed = there.contains('{') || there.is_empty() && before == Some(b'}');
        !computed || edit.text.is_empty() || edit.text.contains('{')
    });
}

/// Reports towns among documents whose houses are asked for.
#[cfg(feature = "models")]
fn refuse_towns(documents: &[Document], out: &mut Diagnostics) {
    for town in documents.iter().filter_map(|d| d.town.as_ref()) {
        out.push(hsd_syntax::messages::town::is_town(town.span));
    }
}

/// Runs and times one stage.
pub fn timed<T>(
    times: &mut Vec<(&'static str, Duration)>,
    name: &'static str,
    step: impl FnOnce() -> T,
) -> T {
    // A module of WebAssembly has no clock.
    let start = (!cfg!(target_family = "wasm")).then(Instant::now);
    let made = step();
    times.extend(start.map(|start| (name, start.elapsed())));
    made
}

/// The result of parsing.
#[derive(Debug)]
pub struct Read {
    /// The documents of the sources, in their order.
    pub documents: Vec<Document>,
    /// Files that the sources include, for reports.
    pub included: Vec<Source>,
    /// The catalogue with the custom parts of the sources.
    pub catalog: Cow<'static, Catalog>,
}

/// Reads the sources. A file that several of them include is read once.
pub fn documents(
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Read {
    documents_of(Feed::whole(sources), world, options, out)
}

/// As [`documents`]; those of files that are read in pieces have no houses.
fn documents_of(
    feed: Feed<'_>,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Read {
    documents_noted(feed, world, options, None, out)
}

/// As [`documents`], and records the values of expressions and names.
fn documents_noted(
    feed: Feed<'_>,
    world: &dyn World,
    options: &Options,
    values: Option<&Values>,
    out: &mut Diagnostics,
) -> Read {
    let sources = feed.sources;
    let cache = cache(sources, options);
    let mut trees = Trees::default();
    let setting = parse::ReadContext {
        values,
        ..setting(world, options, &cache)
    };
    let documents = read(feed, setting, &mut trees, out);
    let catalog = catalog(
        sources,
        &documents,
        &options.catalogs,
        (setting, &mut trees),
        out,
    );
    drop(trees);
    let given = options.catalogs.iter().cloned();
    Read {
        documents,
        included: given.chain(cache.into_sources()).collect(),
        catalog,
    }
}

/// Creates the cache for the files that sources may include.
fn cache(sources: &[&Source], options: &Options) -> SourceCache {
    let all = sources.iter().copied().chain(options.catalogs.iter());
    let first = all.map(|s| s.id().0 as usize + 1).max();
    let limits = &options.expand.limits;
    SourceCache::new(first.unwrap_or(0), limits.includes, limits.included_bytes)
}

/// Returns the context in which files are read.
fn setting<'a>(
    world: &'a dyn World,
    options: &'a Options,
    cache: &'a SourceCache,
) -> parse::ReadContext<'a> {
    parse::ReadContext {
        limits: options.expand.limits,
        parameters: &options.parameters,
        seed: options.expand.seed,
        world,
        cache,
        values: None,
        before: None,
    }
}

/// Reads the sources; files and elements that were read before come from the cache.
fn read<'a>(
    feed: Feed<'a>,
    setting: parse::ReadContext<'a>,
    trees: &mut Trees<'a>,
    out: &mut Diagnostics,
) -> Vec<Document> {
    let documents = feed.sources.iter().map(|s| {
        if feed.long(s).is_none() {
            return parse::parse_in(s, setting, trees, out);
        }
        // What is wrong with it is reported with its pieces.
        let setting = parse::ReadContext {
            before: Some(parse::Before::default()),
            ..setting
        };
        parse::parse_in(s, setting, trees, &mut Diagnostics::new())
    });
    let documents: Vec<Document> = documents.collect();
    unknown_parameters(feed.sources, &documents, setting.parameters, out);
    documents
}

/// Reports values given for parameters that no source has.
fn unknown_parameters(
    sources: &[&Source],
    documents: &[Document],
    given: &[(String, String)],
    out: &mut Diagnostics,
) {
    let Some(source) = sources.first() else {
        return;
    };
    let known = || documents.iter().flat_map(|d| &d.parameters);
    for (name, _) in given {
        if known().any(|p| p.name == *name) {
            continue;
        }
        let mut all: Vec<Parameter> = vec![];
        for parameter in known() {
            if !all.iter().any(|p| p.name == parameter.name) {
                all.push(parameter.clone());
            }
        }
        let near = parse::nearest(name, all.iter().map(|p| &*p.name));
        out.push(xml::no_such_parameter(source.span(0..0), name, near, &all));
    }
}

/// Returns the program of all documents.
pub fn program(
    sources: &[&Source],
    documents: &[Document],
    catalog: &Catalog,
    world: &dyn World,
    options: &expand::Options,
    out: &mut Diagnostics,
) -> Program {
    // With variants, the documents of all sources occur several times.
    let pairs: Vec<(&Source, &Document)> = sources.iter().copied().cycle().zip(documents).collect();
    expand::expand(&pairs, catalog, world, options, out)
}

/// Builds walls, roofs and fittings of all houses of a program.
pub fn building(program: Program, catalog: &Catalog, out: &mut Diagnostics) -> Building {
    let mut cache = RoofCache::default();
    let houses = program.houses.into_iter();
    let houses = houses.map(|house| house::finish(house, catalog, &mut cache, out));
    Building {
        houses: houses.collect(),
        images: program.pictures,
    }
}
