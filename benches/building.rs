//! How many houses a second: from text to triangles, and to the bytes of a file.

mod texts;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use hsd::backend::images::Library;
use hsd::diagnostic::Diagnostics;
use hsd::scene::Detail;
use hsd::source::{FileId, NoFiles, Source};
use std::num::NonZeroU32;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() {
    divan::main();
}

/// Rectangles, L and T with automatic roofs; the figure to set beside other roof makers.
#[divan::bench(args = [10_000], sample_count = 5)]
fn roofed_outlines(bencher: Bencher<'_, '_>, count: usize) {
    let text = texts::outlines(count);
    texts::building(&text);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let building = texts::building(black_box(&text));
        hsd::driver::scene(&building, hsd::parse::builtin(), Detail::Everything)
    });
}

/// The same as a city shows them: walls and roofs without joinery.
#[divan::bench(args = [10_000], sample_count = 5)]
fn roofed_bodies(bencher: Bencher<'_, '_>, count: usize) {
    let text = texts::outlines(count);
    texts::building(&text);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let building = texts::building(black_box(&text));
        hsd::driver::scene(&building, hsd::parse::builtin(), Detail::Body)
    });
}

/// Houses with lattices, doors and written roofs; their pictures are embedded once.
#[divan::bench(args = [1, 1000], sample_count = 5)]
fn dressed_machiya_to_glb(bencher: Bencher<'_, '_>, count: usize) {
    let text = texts::machiya(count);
    texts::building(&text);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let building = texts::building(black_box(&text));
        let scene = hsd::driver::scene(&building, hsd::parse::builtin(), Detail::Everything);
        let images = Library::load(&scene.pictures, &NoFiles, u64::MAX, |_, _| {});
        hsd::backend::gltf::glb(&scene, &images)
    });
}

/// One town house of the library, each time with another front, other heights and another frontage, from text to triangles.
#[divan::bench(args = [1000], sample_count = 5)]
fn variants_of_one_machiya(bencher: Bencher<'_, '_>, count: u32) {
    let text = hsd::templates::TYPES[1].text();
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let source = Source::new(FileId(0), "bench.hsd", black_box(text.as_bytes()));
        let options = hsd::Options {
            variants: NonZeroU32::new(count),
            ..hsd::Options::default()
        };
        let mut out = Diagnostics::new();
        hsd::compile(&[&source], &NoFiles, &options, &mut out).scene
    });
}

/// Whether time grows no faster than the house does.
#[divan::bench(args = [100, 1_000, 10_000, 100_000], sample_count = 5)]
fn parts_of_one_house(bencher: Bencher<'_, '_>, count: usize) {
    let text = texts::parts(count);
    texts::building(&text);
    bencher.counter(ItemsCount::new(count)).bench_local(|| {
        let building = texts::building(black_box(&text));
        hsd::driver::scene(&building, hsd::parse::builtin(), Detail::Everything)
    });
}
