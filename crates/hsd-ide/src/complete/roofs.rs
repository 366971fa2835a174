//! The words of roof lines, field by field.

use super::{Completion, CompletionKind, Request, parts};
use crate::vocabulary;
use crate::vocabulary::Table;
use hsd_base::diagnostic::{Noun, Text, noun};
use hsd_base::geometry::SHAKU;
use hsd_base::text;
use std::ops::Range;

/// The field of a roof line, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Field {
    Covering,
    Direction,
    Height,
    Shape,
    /// One of the four corner coordinates.
    Corner(usize),
    Option,
}

/// Returns the field of the word of a number.
pub(crate) fn field(number: usize) -> Field {
    match number {
        0 => Field::Covering,
        1 => Field::Direction,
        2 => Field::Height,
        3 => Field::Shape,
        4..=7 => Field::Corner(number - 4),
        _ => Field::Option,
    }
}

/// Returns the completions at the requested place.
pub(super) fn complete(request: &Request<'_>, line: &Range<usize>) -> Vec<Completion> {
    let head = &request.text[line.start..request.at];
    let start = head.rfind(char::is_whitespace).map_or(0, |i| {
        i + head[i..].chars().next().map_or(1, char::len_utf8)
    });
    let end = request.text[request.at..line.end]
        .find(char::is_whitespace)
        .map_or(line.end, |i| request.at + i);
    let range = line.start + start..end;
    let number = head[..start].split_whitespace().count();
    let typed = &head[start..];
    match field(number) {
        Field::Covering => words(vocabulary::COVERINGS, typed, &range),
        Field::Direction => directions(request, line, typed, &range),
        Field::Height => heights(request, &range),
        Field::Shape => words(vocabulary::ROOF_SHAPES, typed, &range),
        Field::Corner(0) => corners(request, line.end, &range),
        Field::Corner(_) => vec![],
        Field::Option => options(request, line, &range),
    }
}

/// Returns words of a table that begin with the typed string, or whose description does in either language.
fn words(table: &Table, typed: &str, range: &Range<usize>) -> Vec<Completion> {
    let lower = typed.to_lowercase();
    let fits = |word: &str, about: &Noun| {
        let begins = |text: &str| {
            text.to_lowercase()
                .split([' ', '('])
                .any(|w| w.starts_with(&lower))
        };
        typed.is_empty() || begins(word) || begins(about.en) || about.ja.contains(typed)
    };
    let fit = table
        .iter()
        .enumerate()
        .filter(|(_, (word, about))| fits(word, about));
    fit.map(|(rank, (word, about))| {
        let own = word.to_lowercase().starts_with(&lower);
        let found = Completion::word(word, CompletionKind::Value, (*about).into(), range);
        Completion {
            filter: format!("{typed} {word} {} {}", about.en, about.ja)
                .trim_start()
                .to_owned(),
            ..found.sorted(format!("{}{rank:02}", u8::from(!own)))
        }
    })
    .collect()
}

/// Returns ridges and falls; a shape that is written already allows one or the other.
fn directions(
    request: &Request<'_>,
    line: &Range<usize>,
    typed: &str,
    range: &Range<usize>,
) -> Vec<Completion> {
    let shape = request.text[range.end..line.end].split_whitespace().nth(1);
    let slope = shape.map(|s| matches!(s, "KAT" | "HIS"));
    let mut found = words(vocabulary::DIRECTIONS, typed, range);
    found.retain(|c| {
        let ridge = matches!(c.label.as_str(), "X" | "Y");
        slope.is_none_or(|slope| slope != ridge)
    });
    found
}

/// Returns `*` for the top of the walls, and the tops of the storeys.
fn heights(request: &Request<'_>, range: &Range<usize>) -> Vec<Completion> {
    const TOP: Noun = noun("the top of the walls there", "そこの壁の上端");
    let mut found =
        vec![Completion::word("*", CompletionKind::Value, TOP.into(), range).sorted("00")];
    let houses = &request.a.checked.building.houses;
    let storeys = houses
        .get(parts::house_at(request.a, request.at))
        .map_or(&[][..], |b| &b.house.storeys);
    for storey in storeys {
        let (height, number) = (storey.z1 / SHAKU, storey.number);
        let height = format!("{height:.2}");
        let height = height.trim_end_matches('0').trim_end_matches('.');
        let height = if height.contains('.') {
            height.to_owned()
        } else {
            format!("{height}.0")
        };
        let about = text!([number] "the top of storey {number}, shaku", "{number}階の上端(尺)");
        found.push(
            Completion::word(&height, CompletionKind::Value, about, range)
                .sorted(format!("1{number:02}")),
        );
    }
    found
}

/// Returns the rectangles of the storeys: corner, opposite corner.
fn corners(request: &Request<'_>, end: usize, range: &Range<usize>) -> Vec<Completion> {
    if !request.text[range.end..end].trim().is_empty() {
        return vec![];
    }
    let houses = &request.a.checked.building.houses;
    let storeys = houses
        .get(parts::house_at(request.a, request.at))
        .map_or(&[][..], |b| &b.house.storeys);
    let mut found: Vec<Completion> = vec![];
    for storey in storeys {
        let corners = storey
            .rings
            .iter()
            .filter(|r| !r.hole)
            .flat_map(|r| &r.walls)
            .map(|w| w.from);
        let start = (glam::DVec2::MAX, glam::DVec2::MIN);
        let (low, high) = corners.fold(start, |(l, h), p| (l.min(p), h.max(p)));
        if low.x > high.x {
            continue;
        }
        let [a0, b0, a1, b1] =
            [low.x, low.y, high.x, high.y].map(|n| (n * 100.0).round() / 100.0 + 0.0);
        let label = format!("{a0} {b0} {a1} {b1}");
        let number = storey.number;
        let about: Text = text!([number]
            "the bounds of storey {number}: a0 b0 a1 b1",
            "{number}階の範囲: a0 b0 a1 b1"
        );
        if found.iter().all(|c| c.label != label) {
            found.push(
                Completion::word(&label, CompletionKind::Value, about, range)
                    .sorted(format!("{number:02}")),
            );
        }
    }
    found
}

/// Returns options that the line does not have yet.
fn options(request: &Request<'_>, line: &Range<usize>, range: &Range<usize>) -> Vec<Completion> {
    let rest = [
        &request.text[line.start..range.start],
        &request.text[range.end..line.end],
    ];
    let there = |letter: &str| {
        rest.iter()
            .flat_map(|r| r.split_whitespace().skip(8))
            .any(|w| w.starts_with(letter))
    };
    let shape = request.text[line.clone()]
        .split_whitespace()
        .nth(3)
        .unwrap_or_default();
    let fits = |letter: &str| match letter {
        "C" => matches!(shape, "IRI" | "TER" | "HAK"),
        "R" => shape == "YOS",
        _ => true,
    };
    let open = vocabulary::OPTIONS
        .iter()
        .enumerate()
        .filter(|(_, (l, _))| !there(l) && fits(l));
    open.map(|(rank, (letter, about))| {
        let value = match *letter {
            "P" => "4.0",
            "E" => "2.5",
            "G" => "0.5",
            "T" => "0.4",
            "M" => "3",
            "S" => "2",
            "C" => "0.33",
            "R" => "0.4",
            _ => "",
        };
        let word = Completion::word(letter, CompletionKind::Value, (*about).into(), range);
        Completion {
            insert: format!("{letter}{value}"),
            snippet: Some(format!("{letter}${{1:{value}}}")).filter(|_| !value.is_empty()),
            ..word.sorted(format!("{rank:02}"))
        }
    })
    .collect()
}
