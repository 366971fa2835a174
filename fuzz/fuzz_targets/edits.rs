//! What an editor asks of any text at any place, and what it changes: answers never fail, and every change lies inside the
//! text, at borders of characters, and leaves a text that can be read again.
//!
//! The first three bytes are the place and the stroke; the rest is the text.

#![no_main]

use hsd::diagnostic::Language;
use hsd::expand;
use hsd::ide::format::Edit;
use hsd::ide::stroke::{self, Stroke};
use hsd::ide::{Analysis, complete, fix, folding, format, hover, inlay, names, plan, selection};
use hsd::ide::{symbols, tokens};
use hsd::source::{FileId, Limits, NoFiles, Source};
use libfuzzer_sys::fuzz_target;
use std::ops::Range;

fn analysis(text: &str) -> Analysis {
    let limits = Limits {
        parts: 20_000,
        ..Limits::default()
    };
    let options = hsd::Options {
        expand: expand::Options {
            limits,
            ..expand::Options::default()
        },
        ..hsd::Options::default()
    };
    let source = Source::new(FileId(0), "fuzz.hsd", text.as_bytes());
    Analysis::new(source, &NoFiles, &options)
}

/// Applies edits, which must be in order and inside the text.
fn changed(text: &str, edits: &[Edit]) -> String {
    let (mut new, mut at) = (String::new(), 0);
    for Edit { range, text: own } in edits {
        assert!(at <= range.start && range.start <= range.end);
        new += &text[at..range.start];
        new += own;
        at = range.end;
    }
    new + &text[at..]
}

fn stroke(bytes: [u8; 2]) -> String {
    let [kind, number] = bytes;
    let (a, b) = (number & 3, number >> 2 & 3);
    let place = format!("\"house\":0,\"storey\":0,\"ring\":0,\"wall\":{a}");
    match kind % 7 {
        0 => format!("{{\"do\":\"set-part\",{place},\"unit\":{b},\"part\":\"KTU\"}}"),
        1 => format!("{{\"do\":\"move-wall\",{place},\"by\":{}}}", i32::from(b) - 1),
        2 => format!("{{\"do\":\"break-wall\",{place},\"from\":{b},\"to\":{},\"by\":1}}", b + 2),
        3 => "{\"do\":\"draw-house\",\"outline\":[[0,0],[6,0],[6,8],[0,8]]}".into(),
        4 => "{\"do\":\"add-storey\",\"house\":0,\"height\":8.5}".into(),
        5 => format!("{{\"do\":\"remove-storey\",\"house\":0,\"storey\":{a}}}"),
        _ => "{\"do\":\"set-height\",\"house\":0,\"storey\":0,\"height\":9.5}".into(),
    }
}

fuzz_target!(|bytes: &[u8]| {
    let [high, low, kind, number, rest @ ..] = bytes else {
        return;
    };
    let a = analysis(&String::from_utf8_lossy(rest));
    let text = a.text().to_owned();
    let mut at = usize::from(*high) << 8 | usize::from(*low);
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let within = |range: &Range<usize>| assert!(text.get(range.clone()).is_some());
    complete::complete(&a, at, &|_| vec![]);
    hover::hover(&a, at, Language::Japanese, false);
    selection::selection(&a, at).iter().for_each(within);
    names::highlights(&a, at).iter().for_each(|(r, _)| within(r));
    names::definition(&a, at);
    let _ = names::rename(&a, at, "other");
    folding::folds(&a);
    symbols::symbols(&a);
    tokens::tokens(&a);
    inlay::inlays(&a, 0..text.len(), Language::English);
    plan::Plan::of(&a, Language::English);
    if let Some(edits) = format::format(&a) {
        analysis(&changed(&text, &edits));
    }
    if let Some((_, edits)) = fix::fix_all(&a, &analysis, 3) {
        changed(&text, &edits);
    }
    let wanted: Stroke = serde_json::from_str(&stroke([*kind, *number])).expect("is a stroke");
    if let Ok(edits) = stroke::edits(&a, &wanted) {
        analysis(&changed(&text, &edits));
    }
});
