//! Values of attributes: numbers, choices, lists, places.

use crate::parse::meanings;
use crate::parse::schema::lengths::{length, units};
use crate::parse::xml::read::{Attributes, Reader};
use crate::parse::xml::suggest::narrow_ascii;
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::token::Attribute;
use hsd_base::source::{Span, Spanned};
use hsd_base::text;
use hsd_ir::messages::xml as say;
use std::ops::{Range, RangeInclusive};

const YES_NO: [(&str, bool); 2] = [("yes", true), ("no", false)];

impl<'t> Reader<'t, '_> {
    /// Returns the span of an attribute's value.
    pub(in crate::parse::xml) fn value_span(&self, attribute: &Attribute<'_>) -> Span {
        self.reporter.span(&attribute.value.whole())
    }

    /// Reads a string as it is, without blanks around it.
    pub(in crate::parse::xml) fn text(
        &self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<String>> {
        let value = &of.get(name)?.value;
        let text = value.as_str();
        if text == "     " {
            return Some(Spanned::new(
                text.to_owned(),
                self.reporter.span(&value.whole()),
            ));
        }
        let start = text.len() - text.trim_start_matches(is_blank).len();
        let end = text.trim_end_matches(is_blank).len();
        let span = self.reporter.span(&value.range(start..end));
        Some(Spanned::new(text[start..end].to_owned(), span))
    }

    /// Reads a number within the attribute's bounds.
    pub(in crate::parse::xml) fn number(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<f64>> {
        let attribute = of.get(name)?;
        let text = attribute.value.as_str();
        let value = self.number_in(of, name, 0..text.len())?;
        Some(Spanned::new(value, self.value_span(attribute)))
    }

    /// Reads a number, or returns the attribute's default.
    pub(in crate::parse::xml) fn usual(&mut self, of: &Attributes<'t>, name: &str) -> f64 {
        self.number(of, name)
            .map_or(of.usual(name), |given| given.value)
    }

    /// Reads a whole number within the attribute's bounds.
    pub(in crate::parse::xml) fn whole_number(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<u64>> {
        let attribute = of.get(name)?;
        let range = of.whole_bounds(name);
        let text = attribute.value.as_str().trim_matches(is_blank);
        let span = self.value_span(attribute);
        match text.parse::<u64>() {
            Ok(value) if range.contains(&value) => Some(Spanned::new(value, span)),
            Err(_) if text.parse::<f64>().is_err() => {
                let fix = narrowed(text).filter(|t| t.parse::<u64>().is_ok());
                self.reporter
                    .push(|| say::not_a_number(span, name, text, fix.as_deref()));
                fix?.parse().ok().map(|v| Spanned::new(v, span))
            }
            _ => {
                let (least, most) = (*range.start(), *range.end());
                self.reporter.push(|| {
                    let bounds = text!([least, most]
                        "a whole number from {least} to {most}",
                        "{least} から {most} までの整数"
                    );
                    let near = near_whole(text, &range).map(|n| n.to_string());
                    say::out_of_range(span, name, text, bounds, near.as_deref())
                });
                None
            }
        }
    }

    /// Reads `yes` or `no`; `true`, `false`, `1` and `0` are accepted for them without a message.
    pub(in crate::parse::xml) fn yes_no(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<bool>> {
        let attribute = of.get(name)?;
        let value = match attribute.value.as_str().trim_matches(is_blank) {
            "true" | "1" => true,
            "false" | "0" => false,
            _ => return self.choice(of, name, &YES_NO),
        };
        Some(Spanned::new(value, self.value_span(attribute)))
    }

    /// Reads one of several words.
    pub(in crate::parse::xml) fn choice<T: Copy>(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
        words: &[(&'static str, T)],
    ) -> Option<Spanned<T>> {
        let attribute = of.get(name)?;
        let text = attribute.value.as_str().trim_matches(is_blank);
        let span = self.value_span(attribute);
        let value = self.word(span, name, text, words)?;
        Some(Spanned::new(value, span))
    }

    /// Finds a word; an unknown one is reported and read as the nearest.
    pub(in crate::parse::xml) fn word<T: Copy>(
        &mut self,
        span: Span,
        name: &str,
        text: &str,
        words: &[(&'static str, T)],
    ) -> Option<T> {
        let find = |text: &str| words.iter().find(|(w, _)| *w == text).map(|(_, v)| *v);
        let found = find(text);
        if found.is_some() {
            return found;
        }
        let all: Vec<&str> = words.iter().map(|(w, _)| *w).collect();
        let near = match meanings::among(text, &all) {
            Some(meant) => Some((meant.word, meant.shown())),
            None => {
                let near = self.suggest.among(text, words.iter().map(|(w, _)| *w));
                near.map(|near| (near, None))
            }
        };
        self.reporter
            .push(|| say::not_a_choice(span, name, text, &all, near));
        near.and_then(|(near, _)| find(near))
    }

    /// Reads numbers separated by blanks or commas.
    pub(in crate::parse::xml) fn numbers(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<Vec<f64>>> {
        let attribute = of.get(name)?;
        let (mut list, mut good) = (vec![], true);
        let divides = |c| is_blank(c) || c == ',' || c == '、';
        for piece in self.lengths(of, name, divides) {
            match self.number_in(of, name, piece) {
                Some(value) => list.push(value),
                None => good = false,
            }
        }
        good.then(|| Spanned::new(list, self.value_span(attribute)))
    }

    /// Returns the pieces of a list; in lists of lengths a unit belongs to the number before it. Reports a list with units
    /// after some of its lengths only.
    pub(in crate::parse::xml) fn lengths(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
        divides: impl Fn(char) -> bool + Copy,
    ) -> Vec<Range<usize>> {
        let Some(attribute) = of.get(name) else {
            return vec![];
        };
        let text = attribute.value.as_str();
        let found = pieces(text, divides);
        if of.measure(name).is_none() {
            return found;
        }
        let list = with_units(text, found);
        let bare =
            |piece: &&Range<usize>| decimal(&text[(*piece).clone()]).is_some_and(|n| n != 0.0);
        let word = |piece: &Range<usize>| unit_after(&text[piece.clone()]);
        if let (Some(without), Some(unit)) = (list.iter().find(bare), list.iter().find_map(word)) {
            let span = self.reporter.span(&attribute.value.range(without.clone()));
            let number = &text[without.clone()];
            self.reporter
                .push(|| say::length_without_unit(span, number, unit));
        }
        list
    }

    /// Reads a point `"a b"`.
    pub(in crate::parse::xml) fn point(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<(f64, f64)>> {
        let list = self.numbers(of, name)?;
        if let [a, b] = list.value[..] {
            return Some(Spanned::new((a, b), list.span));
        }
        self.reporter
            .push(|| say::not_a_point(list.span, name, list.value.len()));
        None
    }

    /// Reads two numbers, or one that stands for both.
    pub(in crate::parse::xml) fn pair(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<[f64; 2]>> {
        let list = self.numbers(of, name)?;
        match list.value[..] {
            [both] => Some(Spanned::new([both; 2], list.span)),
            [one, two] => Some(Spanned::new([one, two], list.span)),
            _ => {
                self.reporter
                    .push(|| say::not_a_pair(list.span, name, &list.value));
                None
            }
        }
    }

    /// Reads two whole numbers, or one that stands for both.
    pub(in crate::parse::xml) fn whole_pair(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<[f64; 2]>> {
        let bounds = of.bounds(name);
        let (least, most) = (*bounds.start(), *bounds.end());
        let pair = self.pair(of, name)?;
        let Some(part) = pair.value.iter().find(|n| n.fract() != 0.0) else {
            return Some(pair);
        };
        self.reporter.push(|| {
            let bounds = text!([least, most]
                "whole numbers from {least} to {most}",
                "{least} から {most} までの整数"
            );
            let near = pair.value.map(|n| n.round().clamp(least, most));
            let near = format!("{} {}", near[0], near[1]);
            say::out_of_range(pair.span, name, &part.to_string(), bounds, Some(&near))
        });
        None
    }

    /// Reads words separated by blanks or commas; unknown ones are reported and read as the nearest, or left out.
    pub(in crate::parse::xml) fn words<T: Copy>(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
        words: &[(&'static str, T)],
    ) -> Vec<T> {
        let Some(attribute) = of.get(name) else {
            return vec![];
        };
        let text = attribute.value.as_str();
        let found = pieces(text, |c| is_blank(c) || c == ',' || c == '、');
        let word = |piece: Range<usize>| {
            let span = self.reporter.span(&attribute.value.range(piece.clone()));
            self.word(span, name, &text[piece], words)
        };
        found.into_iter().filter_map(word).collect()
    }

    /// Reads positions from 1 such as `"2,5-7"`, as inclusive ranges.
    pub(in crate::parse::xml) fn positions(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
    ) -> Option<Spanned<Vec<(u32, u32)>>> {
        let attribute = of.get(name)?;
        let text = attribute.value.as_str();
        let (mut list, mut good) = (vec![], true);
        for piece in pieces(text, |c| is_blank(c) || c == ',' || c == '、') {
            let quoted = &text[piece.clone()];
            let span = self.reporter.span(&attribute.value.range(piece));
            let found = position(quoted);
            let fixed = || found.or_else(|| position(&plain_dashes(quoted)));
            let Some((first, last)) = fixed() else {
                self.reporter
                    .push(|| say::not_a_position(span, quoted, None));
                good = false;
                continue;
            };
            let range = (first.min(last), first.max(last));
            if found.is_none() || first > last {
                self.reporter
                    .push(|| say::not_a_position(span, quoted, Some(range)));
            }
            list.push(range);
        }
        good.then(|| Spanned::new(list, self.value_span(attribute)))
    }

    /// Reads the number in a piece of a value.
    pub(in crate::parse::xml) fn number_in(
        &mut self,
        of: &Attributes<'t>,
        name: &str,
        piece: Range<usize>,
    ) -> Option<f64> {
        let (attribute, range) = (of.get(name)?, &of.bounds(name));
        let text = attribute.value.as_str()[piece.clone()].trim_matches(is_blank);
        let span = self.reporter.span(&attribute.value.range(piece));
        let (given, measure) = (attribute.name, of.measure(name));
        let with_unit = |text: &str| length(text, measure?, self.unit);
        let plain = decimal(text).or_else(|| with_unit(text));
        let fix = || {
            narrowed(text)
                .or_else(|| Some(text.replacen(',', ".", 1)))
                .filter(|t| decimal(t).is_some() || with_unit(t).is_some())
                .or_else(|| meanings::digits(text, range))
                .or_else(|| Some(meanings::number_called(text, name)?.word.to_owned()))
        };
        let value = match plain {
            Some(value) => value,
            None => {
                let fix = fix();
                let about = meanings::is_truth(text).and_then(|_| of.about(name));
                self.reporter.push(|| match about {
                    Some(about) => say::yes_for_a_number(span, given, text, about, fix.as_deref()),
                    None if measure.is_some() => {
                        say::not_a_length(span, given, text, fix.as_deref())
                    }
                    None => say::not_a_number(span, given, text, fix.as_deref()),
                });
                let fix = fix?;
                decimal(&fix).or_else(|| with_unit(&fix))?
            }
        };
        if range.contains(&value) {
            return Some(value);
        }
        let (least, most) = (*range.start(), *range.end());
        self.reporter.push(|| {
            let bounds = text!([least, most]
                "a number from {least} to {most}",
                "{least} から {most} までの数値"
            );
            let near = near_number(text, value, range);
            say::out_of_range(span, given, text, bounds, Some(&near))
        });
        None
    }
}

/// Joins numbers with the units that follow them after a blank.
fn with_units(text: &str, pieces: Vec<Range<usize>>) -> Vec<Range<usize>> {
    let mut list: Vec<Range<usize>> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let is_unit = units().any(|unit| unit == &text[piece.clone()]);
        match list.last_mut() {
            Some(last)
                if is_unit
                    && decimal(&text[last.clone()]).is_some()
                    && text[last.end..piece.start].chars().all(is_blank) =>
            {
                last.end = piece.end;
            }
            _ => list.push(piece),
        }
    }
    list
}

/// Returns the unit at the end of a length.
fn unit_after(length: &str) -> Option<&str> {
    let number = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.');
    let word = length.trim_start_matches(number).trim_start();
    units().find(|unit| *unit == word)
}

/// Returns the number within bounds nearest to one outside of them; without its sign, if that was the error.
fn near_number(text: &str, value: f64, bounds: &RangeInclusive<f64>) -> String {
    match bounds.contains(&-value) {
        true => text.trim_start_matches(['+', '-']).to_owned(),
        false => value.clamp(*bounds.start(), *bounds.end()).to_string(),
    }
}

/// Returns the whole number within bounds nearest to another number.
fn near_whole(text: &str, bounds: &RangeInclusive<u64>) -> Option<u64> {
    let (least, most) = (*bounds.start(), *bounds.end());
    let value: f64 = text.parse().ok()?;
    let whole = value.abs().round() as u64; // what is larger becomes the largest
    let near = if value < 0.0 && whole > most {
        0
    } else {
        whole
    };
    Some(near.clamp(least, most))
}

/// Parses a finite number in the usual form.
fn decimal(text: &str) -> Option<f64> {
    let form = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
    let value: f64 = text.chars().all(form).then(|| text.parse().ok())??;
    value.is_finite().then_some(value)
}

/// Returns the text in ASCII, if it contained full-width characters.
fn narrowed(text: &str) -> Option<String> {
    let narrow = |c| match c {
        '−' | 'ー' | '‐' | '–' => '-',
        c => narrow_ascii(c).unwrap_or(c),
    };
    let plain: String = text.chars().map(narrow).collect();
    (plain != text).then_some(plain)
}

fn plain_dashes(text: &str) -> String {
    let plain = narrowed(text).unwrap_or_else(|| text.to_owned());
    plain
        .replace(['~', '〜', '～', '—', '–'], "-")
        .replace("..", "-")
}

/// Parses `5` or `5-7`.
fn position(text: &str) -> Option<(u32, u32)> {
    let number = |t: &str| {
        let digits = !t.is_empty() && t.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| t.parse().ok()).flatten().filter(|n| *n > 0)
    };
    match text.split_once('-') {
        Some((first, last)) => Some((number(first)?, number(last)?)),
        None => number(text).map(|n| (n, n)),
    }
}

/// Returns the ranges between separators, without empty ones.
pub(in crate::parse::xml) fn pieces(
    text: &str,
    divides: impl Fn(char) -> bool + Copy,
) -> Vec<Range<usize>> {
    let (mut found, mut start) = (vec![], 0);
    for (end, mark) in text.match_indices(divides).chain([(text.len(), "")]) {
        if end > start {
            found.push(start..end);
        }
        start = end + mark.len();
    }
    found
}
