//! What a house costs at the back ends: `machiya` with all its parts, meshes shared, one thread.

use divan::{Bencher, counter::ItemsCount};
use hsd::Options;
use hsd::backend::images::Library;
use hsd::backend::{NoImages, gltf, obj, stl};
use hsd::diagnostic::Diagnostics;
use hsd::scene::Scene;
use hsd::source::{FileId, NoFiles, Source};

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() {
    divan::main();
}

fn machiya() -> Scene {
    let text = include_bytes!("../examples/machiya.hsd");
    let source = Source::new(FileId(0), "machiya.hsd", text);
    let options = Options::default();
    hsd::compile(&[&source], &NoFiles, &options, &mut Diagnostics::new()).scene
}

fn houses(bencher: Bencher<'_, '_>, mut write: impl FnMut(&Scene) -> usize) {
    let scene = machiya();
    bencher
        .counter(ItemsCount::new(1usize))
        .bench_local(|| write(&scene));
}

/// Shapes and plain colours.
#[divan::bench]
fn glb_plain(bencher: Bencher<'_, '_>) {
    houses(bencher, |scene| gltf::glb(scene, &NoImages).len());
}

/// Normals, tangents and texture coordinates; pictures are files beside the model, and copied all the same.
#[divan::bench]
fn glb_beside(bencher: Bencher<'_, '_>) {
    let library = Library::default();
    houses(bencher, |scene| {
        gltf::glb_beside(scene, &library, "house").len()
    });
}

/// A megabyte of pictures inside.
#[divan::bench]
fn glb_inside(bencher: Bencher<'_, '_>) {
    let library = Library::default();
    houses(bencher, |scene| gltf::glb(scene, &library).len());
}

#[divan::bench]
fn obj_text(bencher: Bencher<'_, '_>) {
    houses(bencher, |scene| obj::obj(scene, &NoImages, "house").len());
}

#[divan::bench]
fn stl_bytes(bencher: Bencher<'_, '_>) {
    houses(bencher, |scene| {
        stl::stl(scene, stl::Print::default()).len()
    });
}
