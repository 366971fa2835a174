//! The model of a run: its scene, its images, and the shapes that back ends leave out.

use super::{Options, arrange, documents, house, spare_expressions, timed, variants};
use crate::backend::images::{Library, PictureError};
use crate::backend::{gltf, sound};
use crate::building::Building;
use crate::catalog::Catalog;
use crate::diagnostic::messages::pictures as say;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::expand;
use crate::program::{Content, PictureId, Unit};
use crate::scene::{Detail, Scene};
use crate::source::{FileId, Limits, NoFiles, Source, Span, World};
use crate::tessellate;
use std::borrow::Cow;
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

/// Runs the whole chain. It does not stop at errors: everything valid is built.
pub fn compile(
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Compiled {
    let mut times = vec![];
    let mut read = timed(&mut times, "parse", || match options.variants {
        Some(count) => variants::documents(sources, world, options, count, out),
        None => documents(sources, world, options, out),
    });
    let mut found = Diagnostics::new();
    let mut building = timed(&mut times, "houses", || {
        house::houses(&mut read, sources, world, &options.expand, &mut found)
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
        scene(&building, &catalog, options.detail)
    });
    spare_expressions(sources, &included, out);
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
pub fn scene(building: &Building, catalog: &Catalog, detail: Detail) -> Scene {
    tessellate::tessellate(building, catalog, detail)
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
    Library::load(paths, world, limits.pixels, |index, trouble| {
        let path = &paths[index];
        let id = building.images.iter().position(|p| p.path == *path);
        let used = id.and_then(|id| first_use(building, PictureId(id as u32)));
        let span = used.unwrap_or_default();
        out.push(match trouble {
            PictureError::Unreadable(why) => say::unreadable(span, path, &why),
            PictureError::NoPicture => say::no_picture(span, path),
            PictureError::TooLarge(pixels) => {
                say::too_many_pixels(span, path, pixels, limits.pixels)
            }
        });
    })
}

/// Reports shapes that the back ends leave out.
pub fn flaws(compiled: &Compiled, out: &mut Diagnostics) {
    let house = compiled.building.houses.first();
    let place = house.map(|h| h.house.span).unwrap_or_default();
    let message =
        |f: sound::Flaw| -> Diagnostic { say::shape_left_out(f.span.unwrap_or(place), &f.name) };
    // One broken mesh may be shown a thousand times.
    sound::flaws(&compiled.scene)
        .take(20)
        .map(message)
        .for_each(|d| out.push(d));
}

/// Returns the first place that refers to an image.
fn first_use(building: &Building, id: PictureId) -> Option<Span> {
    let storeys = building.houses.iter().flat_map(|h| &h.house.storeys);
    let walls = storeys.flat_map(|s| &s.rings).flat_map(|r| &r.walls);
    let mut units = walls.flat_map(|w| &w.units);
    units.find_map(|u| use_in(u, id))
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
