//! The model of a run: its scene, its images, and the shapes that back ends leave out.

use super::house::Expansion;
use super::overlaps::{Ground, SpilledGrounds};
use super::pieces::Feed;
use super::places::{Places, provenance};
use super::{
    Options, Read, arrange, beside, documents, documents_of, house, refuse_towns,
    spare_expressions, timed, variants,
};
use hsd_base::diagnostic::messages::limits::too_many_triangles;
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::source::{FileId, Limits, NoFiles, Source, Span, World};
use hsd_export::images::{Library, PictureError};
use hsd_export::spool::NewSpool;
use hsd_export::{gltf, sound};
use hsd_ir::building::{Building, Built};
use hsd_ir::catalog::Catalog;
use hsd_ir::program::{Content, PictureId, Unit};
use hsd_passes::expand;
use hsd_passes::messages::pictures as say;
use hsd_scene::Scene;
use std::borrow::Cow;
use std::io;
use std::time::Duration;

/// The result of a run, and the duration of each stage.
#[derive(Debug)]
pub struct Compiled {
    /// Files that the sources include, for reports.
    pub included: Vec<Source>,
    /// The catalogue with the custom parts of the sources.
    pub catalog: Cow<'static, Catalog>,
    /// Walls and roofs.
    pub building: Building,
    /// The scene that back ends write.
    pub scene: Scene,
    /// The durations of the stages, in order.
    pub times: Vec<(&'static str, Duration)>,
}

/// The result of [`inspect`].
#[derive(Debug)]
pub struct Inspected {
    /// Files that the sources include, for reports.
    pub included: Vec<Source>,
    /// The number of houses.
    pub houses: usize,
}

/// Runs the chain up to the roofs as [`check`](super::check) does, and keeps nothing of a house but what is wrong with it.
///
/// # Errors
/// Those of the spool, and of files that are read in pieces.
pub fn inspect(
    feed: Feed<'_>,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
    new: NewSpool<'_>,
) -> io::Result<Inspected> {
    let Read {
        documents,
        included,
        catalog,
    } = documents_of(feed, world, options, out);
    let (mut houses, mut uses) = (0, ImageUses::default());
    let mut grounds = SpilledGrounds::new(feed.sources.len() == 1, new);
    let mut expansion = Expansion::new(documents, &catalog, feed, world, options);
    expansion.each(
        &catalog,
        &|| options.all_roofs(),
        &mut |built, found, images| {
            out.append(found);
            let Some(built) = built else {
                return Ok(());
            };
            houses += 1;
            uses.note(&built, images);
            grounds.add(Ground::of(&built.house, &catalog))
        },
    )?;
    grounds.report(|span| feed.first_line(span, &included), out)?;
    let images = expansion.into_images()?;
    let paths: Vec<String> = images.into_iter().map(|image| image.path).collect();
    let limits = &options.expand.limits;
    load(&paths, world, limits, out, |index| uses.first(index));
    spare_expressions(feed, &included, out);
    Ok(Inspected { included, houses })
}

/// The first place that refers to each image.
#[derive(Default)]
struct ImageUses(Vec<Option<Span>>);

impl ImageUses {
    /// Records the uses in a house, made when there were this many images.
    fn note(&mut self, built: &Built, images: usize) {
        self.0.resize(images.max(self.0.len()), None);
        if self.0.iter().any(Option::is_none) {
            units(built).for_each(|unit| self.note_unit(unit));
        }
    }

    fn note_unit(&mut self, unit: &Unit) {
        let own = match &unit.content {
            Content::Picture(own) => Some(*own),
            Content::Split(split) => {
                let halves = split.upper.iter().chain(&split.lower);
                halves.for_each(|half| self.note_unit(half));
                None
            }
            Content::Void | Content::Part(_) => None,
        };
        for id in unit.picture.into_iter().chain(own) {
            if let Some(first) = self.0.get_mut(id.0 as usize) {
                first.get_or_insert(unit.span);
            }
        }
    }

    fn first(&self, index: usize) -> Option<Span> {
        self.0.get(index).copied().flatten()
    }
}

/// Runs the whole chain. It does not stop at errors: everything valid is built.
pub fn compile(
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Compiled {
    let limits = &options.expand.limits;
    let mut times = vec![];
    let mut read = timed(&mut times, "parse", || match options.variants {
        Some(count) => variants::documents(sources, world, options, count, out),
        None => {
            let mut read = documents(sources, world, options, out);
            refuse_towns(&read.documents, out);
            beside::put(&mut read, sources, world, options, out);
            read
        }
    });
    let mut found = Diagnostics::new();
    let mut building = timed(&mut times, "houses", || {
        house::houses(&mut read, (sources, true), world, options, &mut found)
    });
    let (included, catalog) = (read.included, read.catalog);
    match options.variants {
        Some(_) => {
            variants::name(&mut building);
            arrange::arrange(&mut building);
            out.push_new(found);
        }
        None => out.append(found),
    }
    let scene = timed(&mut times, "tessellate", || {
        let mut scene = scene(&building, &catalog, options.shapes());
        let feed = Feed::whole(sources);
        Places::new(feed, &included, options).tell(scene.nodes.iter_mut());
        scene.provenance = provenance(sources, &included, options);
        let message = |place: &Span| too_many_triangles(*place, limits.triangles);
        scene
            .oversized
            .iter()
            .map(message)
            .for_each(|d| out.push(d));
        scene
    });
    spare_expressions(Feed::whole(sources), &included, out);
    Compiled {
        included,
        catalog,
        building,
        scene,
        times,
    }
}

/// Runs the whole chain on one file up to the bytes of a GLB without images, and returns their number. For fuzzing: no
/// input may make it panic. Houses have at most 20,000 parts, so that a fuzzer spends its time on unusual sources
/// rather than on `repeat num="1000000"`.
pub fn compile_bytes(name: &str, bytes: &[u8]) -> usize {
    let source = Source::new(FileId(0), name, bytes);
    let mut out = Diagnostics::new();
    let limits = Limits {
        parts: 20_000,
        ..Limits::default()
    };
    let expand = expand::Options {
        limits,
        ..expand::Options::default()
    };
    let options = Options {
        expand,
        ..Options::default()
    };
    let compiled = compile(&[&source], &NoFiles, &options, &mut out);
    flaws(&compiled, &mut out);
    gltf::glb(&compiled.scene, &Library::default()).len()
}

/// Builds the scene of a building: meshes, materials and nodes.
pub fn scene(
    building: &Building,
    catalog: &Catalog,
    options: impl Into<hsd_mesh::Options>,
) -> Scene {
    hsd_mesh::tessellate(building, catalog, options.into())
}

/// Loads the images of a building and reports those that cannot be shown. `paths` are those of [`Scene::pictures`], or
/// of the building if there is no scene.
pub fn pictures(
    paths: &[String],
    building: &Building,
    world: &dyn World,
    limits: &Limits,
    out: &mut Diagnostics,
) -> Library {
    load(paths, world, limits, out, |index| {
        let images = &mut building.images.iter();
        let id = images.position(|p| p.path == *paths[index])?;
        let mut houses = building.houses.iter();
        houses.find_map(|built| use_by(built, PictureId(id as u32)))
    })
}

/// Loads images and reports those that cannot be shown at their first uses.
fn load(
    paths: &[String],
    world: &dyn World,
    limits: &Limits,
    out: &mut Diagnostics,
    first_use: impl Fn(usize) -> Option<Span>,
) -> Library {
    Library::load(paths, world, limits.pixels, |index, trouble| {
        let path = &paths[index];
        let span = first_use(index).unwrap_or_default();
        out.push(not_shown(trouble, path, span, limits));
    })
}

/// Reports an image that cannot be shown.
pub(super) fn not_shown(
    error: PictureError,
    path: &str,
    span: Span,
    limits: &Limits,
) -> Diagnostic {
    match error {
        PictureError::Unreadable(why) => say::unreadable(span, path, &why),
        PictureError::NoPicture => say::no_picture(span, path),
        PictureError::TooLarge(pixels) => say::too_many_pixels(span, path, pixels, limits.pixels),
    }
}

/// Reports shapes that the back ends leave out.
pub fn flaws(compiled: &Compiled, out: &mut Diagnostics) {
    let house = compiled.building.houses.first();
    let place = house.map(|h| h.house.span).unwrap_or_default();
    let message =
        |f: sound::Flaw| -> Diagnostic { say::shape_left_out(f.span.unwrap_or(place), &f.name) };
    // One broken mesh may be shown a thousand times.
    sound::flaws(compiled.scene.whole())
        .take(20)
        .map(message)
        .for_each(|d| out.push(d));
}

/// Returns the first place of a house that refers to an image.
pub(super) fn use_by(built: &Built, id: PictureId) -> Option<Span> {
    units(built).find_map(|u| use_in(u, id))
}

/// Returns the units of all walls of a house.
fn units(built: &Built) -> impl Iterator<Item = &Unit> {
    let storeys = built.house.storeys.iter();
    let walls = storeys.flat_map(|s| &s.rings).flat_map(|r| &r.walls);
    walls.flat_map(|w| &w.units)
}

fn use_in(unit: &Unit, id: PictureId) -> Option<Span> {
    if unit.picture == Some(id) {
        return Some(unit.span);
    }
    match &unit.content {
        Content::Picture(own) => (*own == id).then_some(unit.span),
        Content::Split(split) => {
            let mut halves = split.upper.iter().chain(&split.lower);
            halves.find_map(|u| use_in(u, id))
        }
        Content::Void | Content::Part(_) => None,
    }
}

/// Reports the images that cannot be shown, without a scene.
pub(super) fn check_images(
    building: &Building,
    world: &dyn World,
    limits: &Limits,
    out: &mut Diagnostics,
) {
    let paths: Vec<String> = building.images.iter().map(|p| p.path.clone()).collect();
    pictures(&paths, building, world, limits, out);
}
