//! `{...}`: finds expressions in text, and replaces them by their values.

use super::{Expander, Scope, fixes};
use crate::messages::town;
use crate::parse::expr::{self, Expr, Problem};
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::text::{REPORTED, Text};
use hsd_ir::ast::Value;
use hsd_ir::messages::xml as say;
use std::ops::Range;
use std::rc::Rc;

/// The maximum length of a string: longer ones are no codes or names, and without a bound a few lines could exhaust
/// memory.
const LONGEST: usize = 4096;

/// A segment of text with braces.
pub(in crate::parse::xml) enum Segment {
    /// Plain text.
    Plain(Range<usize>),
    /// An expression with its braces.
    Expression(Range<usize>),
    /// A brace without a partner, and its likely expression.
    Loose(Range<usize>),
}

/// Returns true if text contains braces, and so may contain expressions.
pub(super) fn are_in(text: &Text<'_>) -> bool {
    brace(text.as_str()).is_some()
}

/// Returns the place of the first brace.
fn brace(text: &str) -> Option<usize> {
    text.bytes().position(|b| matches!(b, b'{' | b'}'))
}

/// Divides text into segments; an expression ends with its line.
pub(in crate::parse::xml) fn segments(text: &str) -> Vec<Segment> {
    let (mut found, mut start) = (vec![], 0);
    while let Some(open) = brace(&text[start..]).map(|i| start + i) {
        if open > start {
            found.push(Segment::Plain(start..open));
        }
        if text[open..].starts_with('}') {
            found.push(Segment::Loose(open..open + 1));
            start = open + 1;
            continue;
        }
        let (end, closed) = end_of(text, open + 1);
        found.push(if closed {
            Segment::Expression(open..end)
        } else {
            Segment::Loose(open..end)
        });
        start = end;
    }
    if start < text.len() {
        found.push(Segment::Plain(start..text.len()));
    }
    found
}

/// Returns the end of the expression that begins here, and whether it ends with its brace. Braces in quotes do not
/// count.
fn end_of(text: &str, from: usize) -> (usize, bool) {
    let mut at = from;
    while let Some(c) = text[at..].chars().next() {
        let next = at + c.len_utf8();
        match c {
            '}' => return (next, true),
            '{' | '\n' | '\r' => return (at, false),
            '\'' | '"' => {
                let end = text[next..].find([c, '\n', '\r']).map(|i| next + i);
                let end = end.filter(|end| text[*end..].starts_with(c));
                at = end.map_or(next, |end| end + 1);
            }
            _ => at = next,
        }
    }
    (at, false)
}

impl<'a> Expander<'a, '_> {
    /// Returns the value of an attribute: that of its expression if it is nothing else, otherwise of its text; `None`
    /// if an error was reported.
    pub(super) fn value(&mut self, text: &Text<'_>, scope: &Scope<'a>) -> Option<Value> {
        let whole = text.as_str();
        if !are_in(text) {
            return Some(Value::read(whole));
        }
        let start = whole.len() - whole.trim_start_matches(is_blank).len();
        let end = whole.trim_end_matches(is_blank).len();
        if let [Segment::Expression(range)] = &segments(&whole[start..end])[..] {
            let range = start + range.start..start + range.end;
            return self.expression(text, range, scope);
        }
        let filled = self.filled(text, scope)?;
        Some(Value::Text(filled.as_str().to_owned()))
    }

    /// Returns the text of an attribute with the values of its expressions; `None` if an error was reported.
    pub(super) fn filled<'t>(&mut self, text: &Text<'t>, scope: &Scope<'a>) -> Option<Text<'t>> {
        let (mut filled, mut sound) = (text.part(0..0), true);
        for segment in segments(text.as_str()) {
            match segment {
                Segment::Plain(range) => filled.append(text.part(range)),
                Segment::Loose(range) => {
                    self.loose(text, range, true, scope);
                    sound = false;
                }
                Segment::Expression(range) => match self.expression(text, range.clone(), scope) {
                    Some(value) => {
                        let place = text.range(range);
                        filled.append(Text::instead(value.to_string(), place));
                    }
                    None => sound = false,
                },
            }
        }
        if filled.as_str().len() > LONGEST.max(text.as_str().len()) {
            self.reporter.at(&text.whole(), say::value_too_long);
            return None;
        }
        sound.then_some(filled)
    }

    /// Adds the text of a wall line to an element: the value of each expression as a run of its own.
    pub(super) fn codes(&mut self, text: &Text<'a>, scope: &Scope<'a>, into: usize) {
        if !are_in(text) {
            return self.add_text(text.clone(), into);
        }
        for segment in segments(text.as_str()) {
            match segment {
                Segment::Plain(range) => {
                    let blank = text.as_str()[range.clone()].chars().all(is_blank);
                    if !blank {
                        self.add_text(text.part(range), into);
                    }
                }
                Segment::Loose(range) => {
                    self.loose(text, range.clone(), false, scope);
                    let place = text.range(range);
                    self.add_text(Text::instead(REPORTED.to_string(), place), into);
                }
                Segment::Expression(range) => {
                    let value = self.expression(text, range.clone(), scope);
                    let code = value.map_or(REPORTED.to_string(), |v| v.to_string());
                    let place = text.range(range);
                    self.add_text(Text::instead(code, place), into);
                }
            }
        }
    }

    /// Reports a brace without a partner, in a value or among codes.
    fn loose(&mut self, text: &Text<'_>, range: Range<usize>, plain: bool, scope: &Scope<'a>) {
        let opens = text.as_str()[range.clone()].starts_with('{');
        let brace = range.start..range.start + 1;
        let partner = self.partner(text, range, plain, scope);
        // A number or a word cannot contain one; a value of several words may.
        let prose = || text.as_str().trim_matches(is_blank).contains(is_blank);
        let plain = plain && partner.is_none() && self.reporter.wanted() && prose();
        self.reporter.at(&text.range(brace), |s| {
            say::brace_alone(s, opens, partner, plain)
        });
    }

    /// Returns the value of an expression with its braces; `None` if an error was reported.
    fn expression(
        &mut self,
        text: &Text<'_>,
        range: Range<usize>,
        scope: &Scope<'a>,
    ) -> Option<Value> {
        let expr = self.parsed(text, &range)?;
        let names = super::feature::Names {
            expander: self,
            scope,
            drawn: Default::default(),
        };
        let trouble = match expr::evaluate(&expr, &names) {
            Ok(value) => {
                let place = self.reporter.span(&text.range(range));
                self.note(place, &value);
                return Some(value);
            }
            Err(trouble) => trouble,
        };
        let (start, inner) = (range.start + 1, trouble.range);
        let place = text.range(start + inner.start..start + inner.end);
        let whole = &text.as_str()[start..range.end - 1];
        let quoted = whole.get(inner.clone())?;
        let compared = fixes::is_compared(whole, &inner);
        self.trouble(&trouble.problem, &place, (quoted, compared), scope);
        None
    }

    fn parsed(&mut self, text: &Text<'_>, range: &Range<usize>) -> Option<Rc<Expr>> {
        let place = text.range(range.clone());
        if let Some(parsed) = self.parsed.get(&place.start) {
            return parsed.clone();
        }
        let inner = &text.as_str()[range.start + 1..range.end - 1];
        let parsed = if inner.chars().all(is_blank) {
            let alone = text.as_str().trim_matches(is_blank).len() == range.len();
            self.reporter.at(&place, |s| say::empty_braces(s, alone));
            None
        } else {
            let found = expr::parse(inner).map_err(|fault| {
                let (start, at) = (range.start + 1, fault.range);
                let quoted = &inner[at.clone()];
                // At the end the closing brace is the unexpected character.
                let end = if quoted.is_empty() {
                    at.end + 1
                } else {
                    at.end
                };
                let place = text.range(start + at.start..start + end);
                let fix = self.fixed(text, start..range.end - 1, &at);
                self.reporter.at(&place, |s| {
                    say::bad_expression(s, fault.wanted, quoted, fix)
                });
            });
            found.ok().map(Rc::new)
        };
        self.parsed.insert(place.start, parsed.clone());
        parsed
    }

    fn trouble(
        &mut self,
        problem: &Problem,
        place: &Range<usize>,
        (quoted, compared): (&str, bool),
        scope: &Scope<'a>,
    ) {
        match problem {
            Problem::Reported => {}
            Problem::Missing(name) => self.lacks(name, place),
            Problem::Unfound(argument, word, known) => {
                let near = self.suggest.among(word, known.iter().map(|n| &**n));
                self.reporter.at(place, |s| {
                    town::not_in_table(s, *argument, word, near, known)
                });
            }
            Problem::Unknown(name) => {
                let names = self.names_in(scope);
                let known = self.known(|| names);
                let near = self.suggest.among(name, known.iter().map(|n| &**n));
                self.reporter.at(place, |s| {
                    say::unknown_name(s, name, near, &known, compared)
                });
            }
            Problem::NoFunction(name) => {
                let known = self.functions(scope);
                let near = self.suggest.among(name, known.iter().copied());
                self.reporter
                    .at(place, |s| say::unknown_function(s, name, near, &known));
            }
            Problem::NoStorey => self.reporter.at(place, say::no_storey),
            Problem::Mismatch { wanted, found } => self
                .reporter
                .at(place, |s| say::wrong_type(s, quoted, *wanted, found)),
            Problem::Arguments {
                function,
                wanted,
                found,
            } => self.reporter.at(place, |s| {
                say::wrong_arguments(s, function, *wanted, *found)
            }),
            Problem::Division => self
                .reporter
                .at(place, |s| say::division_by_zero(s, quoted)),
            Problem::Bounds => {
                let swapped = self.swapped(place);
                self.reporter.at(place, |s| say::clamp_bounds(s, swapped));
            }
            Problem::NoValue => self.reporter.at(place, |s| say::without_value(s, quoted)),
            Problem::Overflow => self
                .reporter
                .at(place, |s| say::number_too_large(s, quoted)),
            Problem::TooLong => self.reporter.at(place, say::value_too_long),
        }
    }
}
