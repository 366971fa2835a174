//! How many megabytes of source files a second: reading alone, expanding alone, and everything that `hsd check` does; and how
//! long a mebibyte of anything takes, which has to be less than a second (docs/contract.md 7).

#[path = "../tests/robust/heaps.rs"]
#[expect(dead_code)] // the tests use the rest
mod heaps;
mod texts;

use divan::counter::BytesCount;
use divan::{Bencher, black_box};
use hsd::Options;
use hsd::diagnostic::Diagnostics;
use hsd::driver;
use hsd::source::{FileId, Limits, NoFiles, Source};

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() {
    divan::main();
}

#[divan::bench(sample_count = 20)]
fn parse_a_megabyte(bencher: Bencher<'_, '_>) {
    let text = texts::legacy(1_000_000);
    let source = Source::new(FileId(0), "bench.hsd", text.as_bytes());
    bencher.counter(BytesCount::of_str(&text)).bench_local(|| {
        let mut out = Diagnostics::new();
        hsd::parse::parse(black_box(&source), &Limits::default(), &mut out)
    });
}

#[divan::bench(sample_count = 20)]
fn expand_a_megabyte(bencher: Bencher<'_, '_>) {
    let text = texts::legacy(1_000_000);
    let source = Source::new(FileId(0), "bench.hsd", text.as_bytes());
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let read = driver::documents(&[&source], &NoFiles, &options, &mut out);
    let (documents, options) = (read.documents, options.expand);
    bencher.counter(BytesCount::of_str(&text)).bench_local(|| {
        let (sources, documents) = (&[&source], black_box(&documents));
        driver::program(
            sources,
            documents,
            hsd::parse::builtin(),
            &NoFiles,
            &options,
            &mut out,
        )
    });
}

#[divan::bench(sample_count = 10)]
fn check_a_megabyte(bencher: Bencher<'_, '_>) {
    let text = texts::legacy(1_000_000);
    texts::building(&text);
    bencher
        .counter(BytesCount::of_str(&text))
        .bench_local(|| texts::check(black_box(&text)));
}

#[divan::bench(args = heaps::heaps().into_iter().map(|heap| heap.name), sample_count = 3)]
fn compile_a_mebibyte(bencher: Bencher<'_, '_>, name: &str) {
    let heap = heaps::heaps().into_iter().find(|heap| heap.name == name);
    let bytes = heap.expect("has a name").of(1 << 20);
    let source = Source::new(FileId(0), "bench.hsd", &bytes);
    let options = Options::default();
    bencher.bench_local(|| {
        let mut out = Diagnostics::new();
        hsd::compile(&[black_box(&source)], &NoFiles, &options, &mut out)
    });
}
