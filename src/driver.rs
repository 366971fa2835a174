//! The chain from end to end: sources -> parse -> expand -> lower -> roof -> tessellate.
//!
//! Each step is a function of its own, so that a shell can stop after any of them; [`compile`] runs them all.
//! Nothing here reads a file: pictures come through a [`World`].

mod convert;

pub use convert::convert;

use crate::ast::Document;
use crate::backend::pictures::{Library, Trouble};
use crate::backend::{gltf, sound};
use crate::building::{Building, Shell};
use crate::catalog::Catalog;
use crate::diagnostic::messages::pictures as say;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::expand;
use crate::lower;
use crate::parse;
use crate::program::{Content, PictureId, Program, Unit};
use crate::roof;
use crate::scene::{Detail, Scene};
use crate::source::{FileId, Limits, NoPictures, Source, Span, World};
use crate::tessellate;
use std::time::{Duration, Instant};

/// What a shell may ask of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Seed and limits.
    pub expand: expand::Options,
    /// How much of the joinery is shape.
    pub detail: Detail,
}

/// What a run made, and how long each step took.
#[derive(Debug, Default)]
pub struct Compiled {
    /// Walls and roofs.
    pub building: Building,
    /// What the back ends write.
    pub scene: Scene,
    /// The steps in order.
    pub times: Vec<(&'static str, Duration)>,
}

/// Runs the whole chain. It never stops at an error: what is sound is built.
pub fn compile(
    sources: &[&Source],
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Compiled {
    let mut times = vec![];
    let documents = timed(&mut times, "parse", || {
        documents(sources, &options.expand.limits, out)
    });
    let program = timed(&mut times, "expand", || {
        program(sources, &documents, world, &options.expand, out)
    });
    drop(documents); // the next steps take their room
    let building = timed(&mut times, "lower and roof", || building(program, out));
    let scene = timed(&mut times, "tessellate", || {
        scene(&building, options.detail)
    });
    Compiled {
        building,
        scene,
        times,
    }
}

/// Runs the whole chain on one file up to the bytes of a GLB without pictures; returns how many there are.
/// For fuzzing: no input makes it panic. Houses are held to 20,000 parts, so that a fuzzer spends its time
/// on strange texts and not on writing out `repeat num="1000000"`.
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
    let compiled = compile(&[&source], &NoPictures, &options, &mut out);
    flaws(&compiled, &mut out);
    gltf::glb(&compiled.scene, &Library::default()).len()
}

/// Runs and times one step.
pub fn timed<T>(
    times: &mut Vec<(&'static str, Duration)>,
    name: &'static str,
    step: impl FnOnce() -> T,
) -> T {
    let start = Instant::now();
    let made = step();
    times.push((name, start.elapsed()));
    made
}

/// The documents of the sources, in their order.
pub fn documents(sources: &[&Source], limits: &Limits, out: &mut Diagnostics) -> Vec<Document> {
    let parsed = sources.iter().map(|s| parse::parse(s, limits, out));
    parsed.collect()
}

/// The program of all documents.
pub fn program(
    sources: &[&Source],
    documents: &[Document],
    world: &dyn World,
    options: &expand::Options,
    out: &mut Diagnostics,
) -> Program {
    let pairs: Vec<(&Source, &Document)> = sources.iter().copied().zip(documents).collect();
    expand::expand(&pairs, Catalog::builtin(), world, options, out)
}

/// Walls, then roofs.
pub fn building(program: Program, out: &mut Diagnostics) -> Building {
    let shell = lower::lower(program, out);
    roof::roof(shell, out)
}

/// What is to be seen.
pub fn scene(building: &Building, detail: Detail) -> Scene {
    tessellate::tessellate(building, Catalog::builtin(), detail)
}

/// Loads the pictures of a building, and says which of them cannot be shown. `paths` are those of
/// [`Scene::pictures`], or of the building where there is no scene.
pub fn pictures(
    paths: &[String],
    shell: &Shell,
    world: &dyn World,
    limits: &Limits,
    out: &mut Diagnostics,
) -> Library {
    Library::load(paths, world, limits.pixels, |index, trouble| {
        let path = &paths[index];
        let id = shell.pictures.iter().position(|p| p.path == *path);
        let used = id.and_then(|id| first_use(shell, PictureId(id as u32)));
        let span = used.unwrap_or_default();
        out.push(match trouble {
            Trouble::Unreadable(why) => say::unreadable(span, path, &why),
            Trouble::NoPicture => say::no_picture(span, path),
            Trouble::TooLarge(pixels) => say::too_many_pixels(span, path, pixels, limits.pixels),
        });
    })
}

/// Says which shapes the back ends leave out.
pub fn flaws(compiled: &Compiled, out: &mut Diagnostics) {
    let house = compiled.building.shell.houses.first();
    let place = house.map(|h| h.span).unwrap_or_default();
    let message =
        |f: sound::Flaw| -> Diagnostic { say::shape_left_out(f.span.unwrap_or(place), &f.name) };
    // One broken mesh may be shown a thousand times.
    sound::flaws(&compiled.scene)
        .take(20)
        .map(message)
        .for_each(|d| out.push(d));
}

/// Where a picture is first called for.
fn first_use(shell: &Shell, id: PictureId) -> Option<Span> {
    let storeys = shell.houses.iter().flat_map(|h| &h.storeys);
    let walls = storeys.flat_map(|s| &s.rings).flat_map(|r| &r.walls);
    let mut units = walls.flat_map(|w| &w.units);
    units.find_map(|u| use_in(u, id))
}

fn use_in(unit: &Unit, id: PictureId) -> Option<Span> {
    match &unit.content {
        Content::Picture(own) => (*own == id).then_some(unit.span),
        Content::Split(split) => {
            let mut halves = split.upper.iter().chain(&split.lower);
            halves.find_map(|u| use_in(u, id))
        }
        Content::Void | Content::Part(_) => None,
    }
}
