//! How long an editor waits for each answer on files of 2,000 and 20,000 lines of the XML form.

mod texts;

use divan::{Bencher, black_box};
use hsd::Options;
use hsd::diagnostic::Language;
use hsd::ide::plan::Plan;
use hsd::ide::stroke::{self, Stroke};
use hsd::ide::{Analysis, complete, folding, format, hover, inlay, names, symbols, tokens};
use hsd::source::{FileId, NoFiles, Source};

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const LINES: [usize; 2] = [2_000, 20_000];

fn main() {
    divan::main();
}

fn analysis(text: &str) -> Analysis {
    let source = Source::new(FileId(0), "bench.hsd", text.as_bytes());
    Analysis::new(source, &NoFiles, &Options::default())
}

/// Measures an answer on a file that was analysed before; `at` is a place in a code in its middle.
fn answer<T>(bencher: Bencher<'_, '_>, lines: usize, ask: impl Fn(&Analysis, usize) -> T) {
    let text = texts::xml_lines(lines);
    let a = analysis(&text);
    a.outline();
    let middle = text.floor_char_boundary(text.len() / 2);
    let at = middle + text[middle..].find("KSK").expect("the code is there");
    bencher.bench_local(|| ask(black_box(&a), at));
}

#[divan::bench(args = LINES, sample_count = 10)]
fn analyse(bencher: Bencher<'_, '_>, lines: usize) {
    let text = texts::xml_lines(lines);
    bencher.bench_local(|| analysis(black_box(&text)).outline().clone());
}

#[divan::bench(args = LINES, sample_count = 10)]
fn complete_a_code(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, at| {
        complete::complete(a, at + 1, &|_| vec![])
    });
}

#[divan::bench(args = LINES, sample_count = 10)]
fn draw_a_stroke(bencher: Bencher<'_, '_>, lines: usize) {
    let stroke = r#"{"do": "set-height", "house": 0, "storey": 0, "height": 10}"#;
    let stroke: Stroke = serde_json::from_str(stroke).expect("is a stroke");
    answer(bencher, lines, |a, _| stroke::edits(a, &stroke).is_ok());
}

#[divan::bench(args = LINES, sample_count = 10)]
fn find_references(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, at| names::references(a, at, true));
}

#[divan::bench(args = LINES, sample_count = 10)]
fn fold(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, _| folding::folds(a));
}

#[divan::bench(args = LINES, sample_count = 10)]
fn format_a_file(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, _| format::format(a));
}

#[divan::bench(args = LINES, sample_count = 10)]
fn highlight_codes(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, _| tokens::tokens(a));
}

#[divan::bench(args = LINES, sample_count = 10)]
fn hint(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, _| {
        inlay::inlays(a, 0..a.source.text().len(), Language::English)
    });
}

#[divan::bench(args = LINES, sample_count = 10)]
fn hover_over_a_code(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, at| {
        hover::hover(a, at + 1, Language::English, true)
    });
}

#[divan::bench(args = LINES, sample_count = 10)]
fn list_symbols(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, _| symbols::symbols(a));
}

#[divan::bench(args = LINES, sample_count = 10)]
fn plan(bencher: Bencher<'_, '_>, lines: usize) {
    answer(bencher, lines, |a, _| {
        serde_json::to_string(&Plan::of(a, Language::English)).is_ok()
    });
}
