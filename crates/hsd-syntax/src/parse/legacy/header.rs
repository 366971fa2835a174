//! The header: the position of the house, the heights of its storeys, and its settings.

use super::line::SourceLine;
use super::words::{Range64, Word, all, nearest, number, numeric, plain_words, within, words};
use crate::messages::legacy as say;
use crate::parse::meanings;
use crate::parse::reporter::Reporter;
use hsd_base::diagnostic::noun;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{Era, House, RoofMethod, RoofMode};

/// Keys of header lines.
pub(super) const KEYS: [&str; 8] = [
    "unit", "seed", "roofs", "method", "street", "name", "age", "era",
];

/// Default height of a storey whose height cannot be read, shaku (docs/contract.md 1).
const HEIGHT: f64 = 9.0;

/// Least plausible heights of a ground storey and of an upper one, shaku. Nobody can stand upright below them, but a
/// tsushi-nikai may be 5 shaku high.
const LOW: (f64, f64) = (5.0, 4.0);

/// Greatest plausible height of a storey in shaku; the hall of a great temple is lower.
const HIGH: f64 = 40.0;

/// The first numbers of a header; the bounds cover a whole country.
const PLACE: [Range64; 3] = [
    Range64 {
        what: noun("x", "x"),
        bounds: -1e8..=1e8,
        unit: noun("metres", "メートル"),
    },
    Range64 {
        what: noun("y", "y"),
        bounds: -1e8..=1e8,
        unit: noun("metres", "メートル"),
    },
    Range64 {
        what: noun("the azimuth", "方位角"),
        bounds: -360.0..=360.0,
        unit: noun("degrees", "度"),
    },
];

const STOREY: Range64 = Range64 {
    what: noun("a storey height", "階高"),
    bounds: 0.1..=1000.0,
    unit: noun("shaku", "尺"),
};
const UNIT: Range64 = Range64 {
    what: noun("the unit", "基準単位"),
    bounds: 0.1..=100.0,
    unit: noun("shaku", "尺"),
};

const AGE: Range64 = Range64 {
    what: noun("the age", "築年数"),
    bounds: 0.0..=2000.0,
    unit: noun("years", "年"),
};

/// The header as read so far.
#[derive(Default)]
pub(super) struct Header {
    place: Option<Span>,
    heights: Option<Span>,
    keys: Vec<(&'static str, Span)>,
    /// True if a blank line has followed the lines read so far.
    pub(super) gap: bool,
}

impl Header {
    /// Returns true if any line was read.
    pub(super) fn begun(&self) -> bool {
        self.placed() || !self.keys.is_empty()
    }

    /// Returns true if the line with the place was read.
    pub(super) fn placed(&self) -> bool {
        self.place.is_some()
    }

    /// Returns true if a line belongs to the header; the first that does not begins the walls.
    pub(super) fn owns(&self, text: &str) -> bool {
        let first = plain_words(text).next().unwrap_or_default();
        if numeric(first) || key_of(first).is_some() {
            return true;
        }
        let strange = first.chars().any(|c| c.is_lowercase() || !c.is_ascii())
            && !first.chars().any(|c| c.is_ascii_uppercase());
        let word = first.len() > 1 && !first.starts_with('.');
        strange && word && (!self.gap || nearest(first, &KEYS).is_some())
    }

    /// Reads a line of the header into the house.
    pub(super) fn read(
        &mut self,
        line: &SourceLine<'_>,
        house: &mut House,
        reporter: &mut Reporter<'_>,
    ) {
        let first = plain_words(&line.text).next().unwrap_or_default();
        if !numeric(first) {
            return self.key(line, house, reporter);
        }
        reporter.fixed_fields(line);
        let words = words(line, reporter);
        let span = all(&words, reporter.source);
        match (self.place, self.heights) {
            (None, _) => {
                self.place = Some(span);
                place(&words, house, reporter);
            }
            (_, None) => {
                self.heights = Some(span);
                for word in &words {
                    let height = within(word.text, word.span, &STOREY, reporter);
                    // An unreadable height must not shift the ones after it.
                    let kept = height.unwrap_or(Spanned::new(HEIGHT, word.span));
                    house.heights.push(kept);
                }
            }
            (_, Some(heights)) => {
                let more = format!(" {}", reporter.written(span));
                let line = reporter.line_of(span);
                reporter.say(say::third_numbers(span, heights, line, more));
            }
        }
    }

    /// Checks the heights once the number of storeys is known: missing ones, and those apparently given in another
    /// unit.
    pub(super) fn judge(&self, house: &House, storeys: usize, reporter: &mut Reporter<'_>) {
        let heights = &house.heights;
        // Missing heights are the default by contract; extra numbers that look like heights are reported.
        let numbers = [&house.settings.x, &house.settings.y];
        let like_heights = numbers.iter().all(|n| {
            n.as_ref()
                .is_some_and(|n| (LOW.1..=HIGH).contains(&n.value))
        });
        if let (Some(place), None) = (self.place, self.heights)
            && like_heights
            && storeys > 0
        {
            let end = reporter.line_end_text();
            reporter.say(say::no_heights(place, end));
        }
        for (storey, height) in heights.iter().enumerate().take(storeys) {
            let least = if storey == 0 { LOW.0 } else { LOW.1 };
            if height.value < least || height.value > HIGH {
                reporter.say(say::odd_height(height.span, height.value));
            }
        }
    }

    fn key(&mut self, line: &SourceLine<'_>, house: &mut House, reporter: &mut Reporter<'_>) {
        let text = &*line.text;
        let start = text.len() - text.trim_start().len();
        let first = plain_words(text).next().unwrap_or_default();
        let (key, len) = key_of(first).unwrap_or(("", first.len()));
        let span = line.span(reporter.source, start..start + len);
        let free = line.written(start + len);
        if key == "name" {
            reporter.fixed_before(line, free);
        } else {
            reporter.fixed_fields(line);
        }
        if first != key {
            reporter.say(say::unknown_key(
                line.span(reporter.source, start..start + first.len()),
                first,
                nearest(key_word(first), &KEYS),
                first.strip_prefix(key_word(first)).unwrap_or_default(),
                &KEYS,
            ));
        }
        if key.is_empty() {
            return;
        }
        if let Some((_, before)) = self.keys.iter().find(|(k, _)| *k == key) {
            let (first, second) = (reporter.line_of(*before), reporter.line_of(span));
            reporter.say(say::twice(span, key, *before, [Some(first), Some(second)]));
        }
        self.keys.push((key, span));
        if key == "name" {
            name(line, free, span, house, reporter);
        } else {
            let words = words(line, reporter);
            setting(key, span, value(&words), house, reporter);
        }
    }
}

/// Returns the part of a word before `=` or `:`.
fn key_word(word: &str) -> &str {
    word.split(['=', ':']).next().unwrap_or_default()
}

/// Returns the key a word means, ignoring case, and its length in the word.
fn key_of(word: &str) -> Option<(&'static str, usize)> {
    let head = key_word(word);
    let same = |key: &&&'static str| key.eq_ignore_ascii_case(head);
    KEYS.iter().find(same).map(|key| (*key, head.len()))
}

/// Returns true if a line begins with a correctly written key.
pub(super) fn is_key_line(text: &str) -> bool {
    plain_words(text)
        .next()
        .is_some_and(|first| KEYS.contains(&first))
}

/// Returns the words after a key, or the value attached to it by `=` or `:`.
fn value<'w>(words: &'w [Word<'w>]) -> Vec<(&'w str, Span)> {
    let glued = words.first().and_then(|w| {
        let at = w.text.find(['=', ':'])?;
        Some((&w.text[at + 1..], w.span)).filter(|(text, _)| !text.is_empty())
    });
    let rest = words.iter().skip(1).map(|w| (w.text, w.span));
    glued
        .into_iter()
        .chain(rest.filter(|w| w.0 != "="))
        .collect()
}

fn place(words: &[Word<'_>], house: &mut House, reporter: &mut Reporter<'_>) {
    let settings = &mut *house.settings;
    let slots = [&mut settings.x, &mut settings.y, &mut settings.azimuth];
    let ranges = ["x", "y", "azimuth"].into_iter().zip(&PLACE);
    for ((word, range), slot) in words.iter().zip(ranges).zip(slots) {
        *slot = named(word.text, word.span, range, reporter);
    }
    if let [only] = words {
        reporter.say(say::missing_number(only.span.after(), "y"));
    }
    if let Some(surplus) = words.get(PLACE.len()..).filter(|w| !w.is_empty()) {
        let span = all(surplus, reporter.source);
        let place = reporter.with_blanks(span);
        reporter.say(say::surplus(span, place, PLACE[2].what));
    }
}

/// Reads a number within bounds, or one by its name: `south`, `京間`.
fn named(
    text: &str,
    span: Span,
    (attribute, range): (&str, &Range64),
    reporter: &mut Reporter<'_>,
) -> Option<Spanned<f64>> {
    let bare = text.trim_start_matches(['=', ':']);
    let Some(meant) = meanings::number_called(bare, attribute) else {
        return within(text, span, range, reporter);
    };
    let place = reporter.tail(span, text);
    let (word, noun) = (meant.word, meant.noun);
    reporter.say(say::named_number(span, text, range.what, word, noun, place));
    Some(Spanned::new(number(word)?, span))
}

/// Returns the rest of the line as written, since a name may contain any character.
fn name(
    line: &SourceLine<'_>,
    free: usize,
    key: Span,
    house: &mut House,
    reporter: &mut Reporter<'_>,
) {
    let rest = line.raw[free..].trim_start_matches(['=', ':']);
    let text = rest.trim();
    if text.is_empty() {
        let line = reporter.line_of(key);
        return reporter.say(say::missing_value(key, line, "name"));
    }
    let start = line.at + line.raw.len() - rest.trim_start().len();
    let span = reporter.source.span(start..start + text.len());
    house.name = Some(Spanned::new(text.to_owned(), span));
}

fn setting(
    key: &'static str,
    at: Span,
    value: Vec<(&str, Span)>,
    house: &mut House,
    reporter: &mut Reporter<'_>,
) {
    let Some(&(text, span)) = value.first() else {
        let line = reporter.line_of(at);
        return reporter.say(say::missing_value(at, line, key));
    };
    if let [_, second, ..] = value[..] {
        let last = value.last().map_or(second.1, |v| v.1);
        let span = second.1.to(last);
        let place = reporter.with_blanks(span);
        reporter.say(say::surplus(span, place, key));
    }
    let (settings, roofs) = (&mut house.settings, &mut house.roofs);
    match key {
        "unit" => settings.unit = named(text, span, ("unit", &UNIT), reporter),
        "seed" => settings.seed = seed(text, span, reporter),
        "street" => settings.street = choice(key, text, span, &STREET, reporter),
        "age" => settings.age = within(text, span, &AGE, reporter),
        "era" => {
            settings.era = choice(key, text, span, &Era::WORDS, reporter);
        }
        "roofs" => roofs.mode = choice(key, text, span, &MODES, reporter),
        _ => roofs.method = choice(key, text, span, &RoofMethod::ALL, reporter),
    }
}

const STREET: [(&str, bool); 2] = [("yes", true), ("no", false)];
const MODES: [(&str, RoofMode); 2] = [("auto", RoofMode::Auto), ("explicit", RoofMode::Explicit)];

fn choice<T: Copy>(
    key: &str,
    text: &str,
    span: Span,
    choices: &[(&'static str, T)],
    reporter: &mut Reporter<'_>,
) -> Option<Spanned<T>> {
    let find = |word: &str| choices.iter().find(|(w, _)| *w == word).map(|(_, v)| *v);
    let words: Vec<&str> = choices.iter().map(|(w, _)| *w).collect();
    let value = find(text).or_else(|| {
        let near = nearest(text, &words);
        let place = reporter.tail(span, text);
        reporter.say(say::bad_choice(span, place, key, text, near, &words));
        near.and_then(find)
    })?;
    Some(Spanned::new(value, span))
}

fn seed(text: &str, span: Span, reporter: &mut Reporter<'_>) -> Option<Spanned<u64>> {
    let value = text.parse().ok().filter(|_| !text.starts_with('+'));
    if value.is_none() {
        reporter.say(match number(text) {
            Some(_) => say::bad_seed(span, text),
            None => say::not_a_number(span, text, noun("the seed", "乱数の種"), None),
        });
    }
    value.map(|value| Spanned::new(value, span))
}
