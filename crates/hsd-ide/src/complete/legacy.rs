//! The legacy form: keys of the header, codes and turns of wall lines, and roof lines.

use super::{Completion, CompletionKind, Request, cells, parts, roofs};
use crate::vocabulary;
use hsd_base::diagnostic::{Text, noun};
use hsd_base::text;
use hsd_syntax::parse::syntax::LineKind;
use std::ops::Range;

/// The role of a line, as determined by the lines before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Before {
    /// Number of lines of numbers in the header of this house.
    pub(crate) numbers: usize,
    /// Number of wall lines in this house.
    pub(crate) walls: usize,
    /// Number of wall lines since the storey began.
    pub(crate) rows: usize,
    /// Number of finished storeys.
    pub(crate) storeys: usize,
    /// True if the previous line is blank or a roof.
    pub(crate) apart: bool,
}

/// Classifies the lines before the one that begins at `line`, as the reader does.
pub(crate) fn before(a: &crate::Analysis, line: usize) -> Before {
    let text = a.text();
    let mut before = Before::default();
    for other in a
        .outline()
        .lines
        .iter()
        .take_while(|l| l.range.start < line)
    {
        let written = &text[other.range.clone()];
        match other.kind {
            LineKind::Comment => continue,
            LineKind::Separator => before = Before::default(),
            LineKind::Blank => before.apart = true,
            LineKind::Roof => before.apart = true,
            LineKind::Header => {
                let number = written
                    .trim_start()
                    .starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
                before.numbers += usize::from(number);
                before.apart = false;
            }
            LineKind::Wall => {
                before.walls += 1;
                before.rows += 1;
                before.apart = false;
                if written.trim_end().ends_with('^') {
                    (before.storeys, before.rows) = (before.storeys + 1, 0);
                }
            }
        }
    }
    before
}

/// Returns the completions at the requested place.
pub(super) fn complete(request: &Request<'_>) -> Vec<Completion> {
    let start = request.text[..request.at]
        .rfind(['\n', '\r'])
        .map_or(0, |i| i + 1);
    let end = request.text[request.at..]
        .find(['\n', '\r'])
        .map_or(request.text.len(), |i| request.at + i);
    let line = start..end;
    let written = &request.text[line.clone()];
    if written.starts_with('#') {
        return vec![];
    }
    let before = before(request.a, start);
    let kind = request
        .a
        .outline()
        .line_at(request.at)
        .map(|l| request.a.outline().lines[l].kind);
    if before.walls > 0 && (before.apart || kind == Some(LineKind::Roof)) {
        return roofs::complete(request, &line);
    }
    let head = &request.text[start..request.at];
    if before.walls == 0 {
        let mut found = header(request, &line, head, before);
        let walls = before.numbers > 0 && kind != Some(LineKind::Header);
        if walls && (before.apart || !written.trim().is_empty()) {
            found.extend(wall(request, &line, before));
        }
        return found;
    }
    wall(request, &line, before)
}

/// Adds codes, and after complete ones the letters of turns.
fn wall(request: &Request<'_>, line: &Range<usize>, before: Before) -> Vec<Completion> {
    let written = &request.text[line.clone()];
    let shown = written.trim_end();
    let turn = shown.ends_with(" L") || shown.ends_with(" R") || shown.ends_with('^');
    let run = line.start
        ..line.end
            - if turn {
                written.len() - shown.len() + 1
            } else {
                0
            };
    if request.at > run.end {
        return vec![];
    }
    let cell = cells::under_way(request.text, run, request.at, &|code| {
        parts::meant(request.a, request.at, code).is_some()
    });
    let storey = parts::Storey {
        upper: before.storeys > 0,
        rear: before.rows > 0,
    };
    let mut found = parts::in_run(request, &cell, storey);
    let last = request.text[request.at..line.end].trim().is_empty();
    if last && cell.typed.is_empty() && cell.range.start > line.start {
        let place = cell.range.start..line.end;
        for (letter, about) in vocabulary::TURNS {
            found.push(
                Completion::word(letter, CompletionKind::Turn, (*about).into(), &place).sorted("3"),
            );
        }
    }
    found
}

/// Adds keys, their values, and the numbers that come first.
fn header(
    request: &Request<'_>,
    line: &Range<usize>,
    head: &str,
    before: Before,
) -> Vec<Completion> {
    let typed = head.trim_start();
    let word = line.start + head.len() - typed.len();
    let end = |from: usize| {
        let more = request.text[request.at..line.end].find(char::is_whitespace);
        from..more.map_or(line.end, |i| request.at + i)
    };
    let Some(key) = typed
        .split_whitespace()
        .next()
        .filter(|_| typed.contains(char::is_whitespace))
    else {
        return keys(request, &end(word), typed, before);
    };
    let value = typed.rfind(char::is_whitespace).map_or(0, |i| i + 1);
    let range = end(word + value);
    // A key has one value.
    if typed[key.len()..value].trim().is_empty() {
        let list = vocabulary::table("", key);
        let item = |(rank, (w, about)): (usize, &(&str, hsd_base::diagnostic::Noun))| {
            Completion::word(w, CompletionKind::Value, (*about).into(), &range)
                .sorted(format!("1{rank}"))
        };
        return match key {
            "roofs" | "method" | "street" | "era" => list.iter().enumerate().map(item).collect(),
            "unit" => UNITS.iter().enumerate().map(item).collect(),
            _ => vec![],
        };
    }
    vec![]
}

const UNITS: &[(&str, hsd_base::diagnostic::Noun)] = &[
    ("3.0", noun("Edo-ma", "江戸間")),
    ("3.15", noun("Chukyo-ma", "中京間")),
    ("3.25", noun("Kyo-ma", "京間")),
];

fn keys(
    request: &Request<'_>,
    range: &Range<usize>,
    typed: &str,
    before: Before,
) -> Vec<Completion> {
    let mut found = vec![];
    if typed.is_empty() && before.numbers < 2 {
        let (label, about): (&str, Text) = match before.numbers {
            0 => (
                "0 0 180",
                text!(
                    "x and y in metres, then where the front looks: 180 is south",
                    "x と y(m)、正面の向く方位(180 は南)"
                ),
            ),
            _ => (
                "9.0 7.5",
                text!("the heights of the storeys in shaku", "各階の高さ(尺)"),
            ),
        };
        found.push(Completion::word(label, CompletionKind::Value, about, range).sorted("0"));
    }
    if before.numbers == 0 && typed.is_empty() {
        return found;
    }
    let lines = &request.a.outline().lines;
    let there = |key: &str| {
        let own = lines.iter().filter(|l| {
            l.kind == LineKind::Header
                && !l.range.contains(&request.at)
                && l.range.end != request.at
        });
        own.map(|l| &request.text[l.range.clone()])
            .any(|l| l.split_whitespace().next() == Some(key))
    };
    for (rank, (key, about)) in vocabulary::KEYS.iter().enumerate() {
        if !key.starts_with(&typed.to_ascii_lowercase()) || there(key) {
            continue;
        }
        let list = vocabulary::table("", key);
        let list: Vec<&str> = list.iter().map(|(w, _)| *w).collect();
        let value = match list.is_empty() {
            true => format!("${{1:{}}}", sample(key)),
            false => format!("${{1|{}|}}", list.join(",")),
        };
        let word = Completion::word(key, CompletionKind::Key, (*about).into(), range);
        found.push(Completion {
            insert: format!("{key} "),
            snippet: Some(format!("{key} {value}")),
            ..word.sorted(format!("1{rank}"))
        });
    }
    found
}

/// Returns a sample value of a key.
fn sample(key: &str) -> &'static str {
    match key {
        "unit" => "3.25",
        "seed" => "1",
        "age" => "100",
        _ => "",
    }
}
