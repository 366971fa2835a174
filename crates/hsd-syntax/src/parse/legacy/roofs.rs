//! Roof lines: kind, direction, height, shape, two corners, options (docs/evidence.md 6).

use super::line::SourceLine;
use super::roof_words::OPTIONS;
use super::words::{Range64, Word, all, nearest, number, numeric, plain_words, within, words};
use crate::messages::legacy as say;
use crate::parse::meanings;
use crate::parse::reporter::Reporter;
use hsd_base::diagnostic::{Noun, noun};
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{RoofDirection, RoofKind, RoofLine, RoofShape, RoofStyle};

const HEIGHT: Range64 = Range64 {
    what: noun("the height of the eaves", "軒の高さ"),
    bounds: 0.1..=10_000.0,
    unit: noun("shaku", "尺"),
};
const CORNER: Range64 = Range64 {
    what: noun("a corner", "隅の位置"),
    bounds: -10_000.0..=10_000.0,
    unit: noun("units", "U"),
};

const DIRECTIONS: [(char, RoofDirection); 6] = [
    ('X', RoofDirection::AlongFront),
    ('Y', RoofDirection::AcrossFront),
    ('F', RoofDirection::Front),
    ('B', RoofDirection::Back),
    ('L', RoofDirection::Left),
    ('R', RoofDirection::Right),
];

/// Returns true if a line has the form of a roof line rather than of part codes: a letter and a short field, or
/// a shape and two numbers in a row. Codes have their letters first, so numbers never follow each other.
pub(super) fn looks_like_roof(text: &str) -> bool {
    let list: Vec<&str> = plain_words(text).take(16).collect();
    let letter = |w: &str| w == "*" || w.len() == 1 && w.starts_with(alphabetic);
    let field = |w: &str| w.chars().count() <= 2 || number(w).is_some() || shape(w).is_some();
    let fields = matches!(list[..], [kind, second, _, ..] if letter(kind) && field(second));
    let shaped = list
        .windows(3)
        .any(|w| shape(w[0]).is_some() && number(w[1]).is_some() && number(w[2]).is_some());
    fields || shaped
}

/// Reads one line; without its corners a roof has no place and is omitted.
pub(super) fn read(line: &SourceLine<'_>, reporter: &mut Reporter<'_>) -> Option<RoofLine> {
    reporter.fixed_fields(line);
    let words = words(line, reporter);
    let mut fields = Fields {
        rest: &words,
        end: line.whole(reporter.source).after(),
        lower: None,
        strange: false,
        reporter,
    };
    let mut style = RoofStyle::default();
    let (kind, direction) = fields.kind_and_direction();
    style.kind = kind;
    let height = fields.height();
    style.shape = fields.shape();
    let corners = fields.corners();
    fields.options(&mut style);
    if let Some(lower) = fields.lower {
        let capitals = fields.reporter.written(lower).to_ascii_uppercase();
        fields.reporter.say(say::lower_roof(lower, &capitals));
    }
    // A roof of another shape than its author meant would only cause more messages.
    let strange = fields.strange;
    let direction = fitting(direction, style.shape, reporter);
    let corners = corners.filter(|_| !strange)?;
    Some(RoofLine {
        span: line.whole(reporter.source),
        style,
        direction,
        height,
        corners,
    })
}

/// The remaining words of a line.
struct Fields<'w, 't, 's> {
    rest: &'w [Word<'w>],
    end: Span,
    /// The words in lower case, reported together.
    lower: Option<Span>,
    /// True if the shape is unknown.
    strange: bool,
    reporter: &'t mut Reporter<'s>,
}

impl<'w> Fields<'w, '_, '_> {
    fn peek(&self) -> Option<&'w Word<'w>> {
        self.rest.first()
    }

    fn next(&mut self) -> Option<&'w Word<'w>> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(first)
    }

    /// Returns the empty place of a missing field.
    fn gap(&self) -> Span {
        self.peek().map_or(self.end, |w| Span {
            end: w.span.start,
            ..w.span
        })
    }

    /// Reports a missing field.
    fn missing(&mut self, what: Noun) {
        let star = match self.peek() {
            Some(_) => "* ",
            None => " *",
        };
        self.reporter
            .say(say::missing_field(self.gap(), what, star));
    }

    /// Returns the word in capitals; lower case is recorded.
    fn capital(&mut self, word: &Word<'_>) -> String {
        if word.text.bytes().any(|b| b.is_ascii_lowercase()) {
            self.lower = Some(self.lower.map_or(word.span, |l| l.to(word.span)));
        }
        word.text.to_ascii_uppercase()
    }

    fn kind_and_direction(
        &mut self,
    ) -> (Option<Spanned<RoofKind>>, Option<Spanned<RoofDirection>>) {
        let Some(word) = self.letters(noun("its kind", "葺き方")) else {
            return (None, self.direction());
        };
        let text = self.capital(word);
        let mut letters = text.chars();
        let (first, second) = (letters.next().unwrap_or('*'), letters.next());
        let kind = RoofKind::from_letter(first).map(|k| Spanned::new(k, word.span));
        match second {
            None if kind.is_none() && first != '*' => {
                let near = meanings::called(word.text, &meanings::COVERINGS).map(|m| m.word);
                self.reporter
                    .say(say::unknown_kind(word.span, word.text, near));
                (None, self.direction())
            }
            None => (kind, self.direction()),
            Some(d) if letters.next().is_none() && kind.is_some() && direction(d).is_some() => {
                self.reporter.say(say::glued(word.span, word.text));
                (kind, direction(d).map(|d| Spanned::new(d, word.span)))
            }
            Some(_) => {
                let near = meanings::called(word.text, &meanings::COVERINGS).map(|m| m.word);
                self.reporter
                    .say(say::unknown_kind(word.span, word.text, near));
                (None, self.direction())
            }
        }
    }

    fn direction(&mut self) -> Option<Spanned<RoofDirection>> {
        let word = self.letters(noun("its direction", "向き"))?;
        let text = self.capital(word);
        let mut letters = text.chars();
        let found = letters
            .next()
            .and_then(direction)
            .filter(|_| letters.next().is_none());
        if found.is_none() && text != "*" {
            self.reporter
                .say(say::unknown_direction(word.span, word.text));
        }
        found.map(|d| Spanned::new(d, word.span))
    }

    /// Returns the next word, unless a number or a shape shows that a field of letters was omitted.
    fn letters(&mut self, what: Noun) -> Option<&'w Word<'w>> {
        match self.peek() {
            Some(w) if !numeric(w.text) && shape(w.text).is_none() => self.next(),
            _ => {
                self.missing(what);
                None
            }
        }
    }

    fn height(&mut self) -> Option<Spanned<f64>> {
        match self.peek() {
            Some(w) if shape(w.text).is_none() => {
                let word = self.next()?;
                if word.text == "*" {
                    return None;
                }
                within(word.text, word.span, &HEIGHT, self.reporter)
            }
            _ => {
                self.missing(noun("its height", "高さ"));
                None
            }
        }
    }

    fn shape(&mut self) -> Option<Spanned<RoofShape>> {
        let Some(word) = self.peek().filter(|w| !numeric(w.text)) else {
            self.missing(noun("its shape", "形"));
            return None;
        };
        self.next();
        let text = self.capital(word);
        let found = RoofShape::from_letters(&text);
        if found.is_none() && text != "*" {
            self.strange = true;
            let letters = RoofShape::ALL.map(|(letters, _)| letters);
            let near = meanings::called(word.text, &meanings::SHAPES).map(|m| m.word);
            let near = near.or_else(|| nearest(&text, &letters));
            self.reporter
                .say(say::unknown_shape(word.span, word.text, near));
        }
        found.map(|s| Spanned::new(s, word.span))
    }

    fn corners(&mut self) -> Option<Spanned<[f64; 4]>> {
        let count = self
            .rest
            .iter()
            .take(4)
            .take_while(|w| !is_option(w.text))
            .count();
        let (corners, rest) = self.rest.split_at(count);
        self.rest = rest;
        let mut values = [0.0; 4];
        let mut good = count == 4;
        for (word, value) in corners.iter().zip(&mut values) {
            match within(word.text, word.span, &CORNER, self.reporter) {
                Some(read) => *value = read.value,
                None => good = false,
            }
        }
        if count < 4 {
            let at = corners.last().map_or(self.gap(), |w| w.span.after());
            self.reporter.say(say::missing_corners(at, count));
        }
        let [a0, b0, a1, b1] = corners else {
            return None;
        };
        if !good {
            return None;
        }
        for (axis, from, to, same) in [
            ('a', a0, a1, values[0] == values[2]),
            ('b', b0, b1, values[1] == values[3]),
        ] {
            if same {
                self.reporter
                    .say(say::no_extent(to.span, from.span, axis, to.text));
                good = false;
            }
        }
        good.then(|| Spanned::new(values, all(corners, self.reporter.source)))
    }

    fn options(&mut self, style: &mut RoofStyle) {
        let mut seen: Vec<(char, &Word<'_>)> = vec![];
        while let Some(word) = self.next() {
            if numeric(word.text) {
                let place = self.reporter.with_blanks(word.span);
                self.reporter.say(say::surplus(
                    word.span,
                    place,
                    noun("the corners", "隅の数値"),
                ));
                continue;
            }
            let text = self.capital(word);
            let letter = text.chars().next().unwrap_or(' ');
            if let Some((_, before)) = seen.iter().find(|(l, _)| *l == letter) {
                let places = [*before, word].map(|w| {
                    // A separate number would be left over.
                    let whole = w.text.len() > 1 || letter == 'O';
                    whole.then(|| self.reporter.with_blanks(w.span))
                });
                let (key, before) = (letter.to_string(), before.span);
                self.reporter
                    .say(say::twice(word.span, &key, before, places));
            } else {
                seen.push((letter, word));
            }
            self.option(letter, word, style);
        }
    }

    fn option(&mut self, letter: char, word: &Word<'_>, style: &mut RoofStyle) {
        let rest = word.text.get(letter.len_utf8()..).unwrap_or_default();
        if letter == 'O' && rest.is_empty() {
            style.plain_ridge = Some(Spanned::new(true, word.span));
            return;
        }
        let known = OPTIONS.iter().find(|(l, _)| *l == letter);
        let Some((_, range)) = known.filter(|_| rest.is_empty() || !rest.starts_with(alphabetic))
        else {
            return self.reporter.say(say::unknown_option(word.span, word.text));
        };
        let (text, span) = if rest.is_empty() {
            let apart = self.peek().filter(|w| numeric(w.text));
            let value = apart.map(|w| w.text);
            let place = match apart {
                Some(number) => Span {
                    start: word.span.end,
                    end: number.span.start,
                    ..word.span
                },
                None => self.reporter.with_blanks(word.span),
            };
            self.reporter.say(say::bare_option(
                word.span, letter, range.what, value, place,
            ));
            let Some(apart) = self.next().filter(|_| value.is_some()) else {
                return;
            };
            (apart.text, word.span.to(apart.span))
        } else {
            (rest, word.span)
        };
        let Some(value) = within(text, span, range, self.reporter) else {
            return;
        };
        self.store(letter, value, text, style);
    }

    fn store(&mut self, letter: char, value: Spanned<f64>, text: &str, style: &mut RoofStyle) {
        match letter {
            'P' => style.pitch = Some(value),
            'E' => style.eaves = Some(value),
            'G' => style.verge = Some(value),
            'T' => style.thickness = Some(value),
            'S' => style.sori = Some(value),
            'C' => style.gable = Some(value),
            'R' => style.ratio = Some(value),
            _ if value.value.fract() == 0.0 => {
                style.noshi = Some(Spanned::new(value.value as u32, value.span));
            }
            _ => {
                let place = self.reporter.tail(value.span, text);
                let whole = place.map(|place| (place, value.value.round()));
                self.reporter
                    .say(say::no_whole_number(value.span, text, whole));
            }
        }
    }
}

/// Removes a direction that a shape cannot have: a ridge for one slope, a fall for two.
fn fitting(
    direction: Option<Spanned<RoofDirection>>,
    shape: Option<Spanned<RoofShape>>,
    reporter: &mut Reporter<'_>,
) -> Option<Spanned<RoofDirection>> {
    let (Some(d), Some(s)) = (direction, shape) else {
        return direction;
    };
    let ridge = matches!(
        d.value,
        RoofDirection::AlongFront | RoofDirection::AcrossFront
    );
    let fits = match s.value {
        RoofShape::LeanTo | RoofShape::Pent => !ridge,
        shape if shape.is_dormer() => !ridge,
        RoofShape::Flat => true,
        _ => ridge,
    };
    if !fits {
        // Attached to the kind, it has no place of its own.
        let own = reporter.written(d.span).chars().count() == 1;
        reporter.say(say::direction_misfit(
            d.span,
            s.span,
            s.value.letters(),
            ridge,
            own,
        ));
    }
    direction.filter(|_| fits)
}

fn alphabetic(c: char) -> bool {
    c.is_alphabetic()
}

fn direction(letter: char) -> Option<RoofDirection> {
    DIRECTIONS
        .iter()
        .find(|(l, _)| *l == letter)
        .map(|(_, d)| *d)
}

fn shape(word: &str) -> Option<RoofShape> {
    (word.len() == 3)
        .then(|| RoofShape::from_letters(&word.to_ascii_uppercase()))
        .flatten()
}

/// Returns true if a word ends the corners: an option letter, alone or before a number.
fn is_option(word: &str) -> bool {
    let mut chars = word.chars();
    let letter = chars.next().is_some_and(alphabetic);
    letter && (chars.as_str().is_empty() || number(chars.as_str()).is_some())
}
