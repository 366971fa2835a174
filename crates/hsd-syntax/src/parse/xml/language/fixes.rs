//! Fixes for expressions, conditions and definitions. Each is tested before it is offered.

use super::super::edits::tags;
use super::super::suggest::narrow_ascii;
use super::super::tree::{Child, Element};
use super::{ElementRef, Expander, Scope, Tag};
use crate::parse::expr::{self, Problem};
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::text::Text;
use hsd_base::diagnostic::{self, Edit};
use hsd_base::source::Span;
use hsd_ir::ast::Value;
use hsd_ir::messages::xml as say;
use std::ops::Range;

impl<'a> Expander<'a, '_> {
    /// Returns the value of a string as an expression.
    pub(super) fn worth(&self, text: &str, scope: &Scope<'a>) -> Option<Value> {
        let expr = expr::parse(text).ok()?;
        let names = |name: &str| {
            let number = self.storeys.number.map(|n| Value::Number(n as f64));
            let known = match name {
                "k" => number,
                name => scope.value(name).and_then(|bound| bound.value),
            };
            known.ok_or(Problem::Reported)
        };
        expr::evaluate(&expr, &names).ok()
    }

    /// Returns the span of an insertion point in a text.
    fn before(&self, text: &Text<'_>, at: usize) -> Span {
        self.reporter.span(&text.range(at..at))
    }

    /// Returns the fix for an invalid expression: a missing quote or parenthesis, or half-width signs. `inner` = the
    /// content of the braces, `at` = the offset of the error in it.
    pub(super) fn fixed(
        &self,
        text: &Text<'_>,
        inner: Range<usize>,
        at: &Range<usize>,
    ) -> Option<(diagnostic::Text, Vec<Edit>)> {
        if !self.reporter.wanted() {
            return None;
        }
        let whole = &text.as_str()[inner.clone()];
        let end = whole.trim_end_matches(is_blank).len();
        let first = whole[at.start..].chars().next();
        let narrow: String = whole
            .chars()
            .map(|c| narrow_ascii(c).unwrap_or(c))
            .collect();
        if first.is_some_and(|c| narrow_ascii(c).is_some()) && expr::parse(&narrow).is_ok() {
            let wide = whole.char_indices().filter_map(|(i, c)| {
                let start = inner.start + i;
                let place = text.range(start..start + c.len_utf8());
                let narrow = match narrow_ascii(c)? {
                    '<' => "&lt;".to_owned(),
                    '&' => "&amp;".to_owned(),
                    '"' => "&quot;".to_owned(),
                    c => c.to_string(),
                };
                Some(Edit::new(self.reporter.span(&place), narrow))
            });
            return Some((say::expression_fix(None), wide.collect()));
        }
        let quote = first.filter(|c| matches!(c, '\'' | '"'));
        let put = quote.unwrap_or(')');
        let place = text.range(inner.start + at.start..inner.start + at.end.max(at.start + 1));
        // A quote that is written literally may be written so again.
        let plain = quote.is_none_or(|c| self.reporter.quote(&place).starts_with(c));
        let lacks = plain && expr::parse(&format!("{}{put}", &whole[..end])).is_ok();
        let edit = Edit::new(self.before(text, inner.start + end), put);
        lacks.then(|| (say::expression_fix(Some(put)), vec![edit]))
    }

    /// Returns likely positions for the partner of a single brace; `plain` = the text is not a code, but a value.
    pub(super) fn partner(
        &self,
        text: &Text<'_>,
        range: Range<usize>,
        plain: bool,
        scope: &Scope<'a>,
    ) -> Option<Span> {
        /// The maximum length of an expression before a single brace.
        const LONGEST: usize = 1024;
        if !self.reporter.wanted() {
            return None;
        }
        let whole = text.as_str();
        let reads = |range: &Range<usize>| self.worth(&whole[range.clone()], scope).is_some();
        if whole[range.clone()].starts_with('{') {
            let inner = &whole[range.start + 1..range.end];
            let all = inner.trim_end_matches(is_blank).len();
            let word = inner.find(is_blank).unwrap_or(inner.len());
            let ends = [all, word].map(|length| range.start + 1 + length);
            let end = ends
                .into_iter()
                .find(|end| reads(&(range.start + 1..*end)))?;
            return Some(self.before(text, end));
        }
        let far = (range.start.saturating_sub(LONGEST)..).find(|at| whole.is_char_boundary(*at))?;
        let before = &whole[far..range.start];
        let line = before.rfind(['\n', '}']).map_or(0, |i| i + 1) + far;
        let word = before.trim_end_matches(|c| !is_blank(c)).len() + far;
        let line = if plain { line } else { word.max(line) };
        let starts = [line, word.max(line)];
        let start = starts
            .into_iter()
            .find(|start| reads(&(*start..range.start)))?;
        Some(self.before(text, start))
    }

    /// Returns the fix that swaps the bounds of a `clamp` at a place.
    pub(super) fn swapped(&self, place: &Range<usize>) -> Option<Vec<Edit>> {
        let written = self.reporter.quote(place);
        let inside = written.strip_suffix(')')?;
        let mut commas = inside.match_indices(',').map(|(i, _)| i);
        let (first, second) = (commas.next()?, commas.next()?);
        let plain = |part: &str| !part.contains(['(', ')', '\'', '"', '&']);
        if commas.next().is_some() || !plain(&inside[first..]) {
            return None;
        }
        let (least, most) = (&inside[first + 1..second], &inside[second + 1..]);
        let edit = |part: &str, from: usize, other: &str| {
            let start = place.start + from + (part.len() - part.trim_start().len());
            let span = self.reporter.span(&(start..start + part.trim().len()));
            Edit::new(span, other.trim())
        };
        Some(vec![
            edit(least, first + 1, most),
            edit(most, second + 1, least),
        ])
    }

    /// Returns the fix that closes a `use` in its start tag and leaves its content after it.
    pub(super) fn emptied(&self, element: &Element<'a>) -> Option<Vec<Edit>> {
        let tags = tags(self.reporter, element);
        let [_, end] = tags.whole[..] else {
            return None;
        };
        let at = element.tag.end - 1;
        let closed = self.reporter.quote(&(at..element.tag.end)) == ">";
        let slash = Edit::new(self.reporter.span(&(at..at)), "/");
        closed.then(|| vec![slash, Edit::new(end, "")])
    }

    /// Returns the fix that moves an `else` after the `if` before it in the same element.
    pub(super) fn behind_the_if(
        &self,
        element_ref: &ElementRef<'_, 'a>,
        parent: &ElementRef<'_, 'a>,
    ) -> Option<Vec<Edit>> {
        if !self.reporter.wanted() {
            return None;
        }
        let mut last = None;
        let mut open = false;
        for child in &parent.element().children {
            let Child::Element(index) = child else {
                open = false;
                continue;
            };
            let other = parent.child(*index);
            if *index == element_ref.index {
                break;
            }
            let tested = other.element().has_attribute("test");
            match other.tag() {
                Some(Tag::If) => (last, open) = (Some(*index), true),
                // Nothing can follow an `else` without a test.
                Some(Tag::Else) if open => last = Some(*index).filter(|_| tested),
                _ => open = false,
            }
        }
        let last = parent.child(last?);
        let place = last.element().range.end;
        let range = &element_ref.element().range;
        let moved = Edit::new(
            self.reporter.span(&(place..place)),
            self.reporter.quote(range).to_owned(),
        );
        Some(vec![moved, Edit::new(self.reporter.with_gap(range), "")])
    }

    /// Returns the edits that wrap a range in a `choice`.
    pub(super) fn chosen(&self, range: &Range<usize>) -> Vec<Edit> {
        let edit = |at: usize, tag: &str| Edit::new(self.reporter.span(&(at..at)), tag);
        vec![edit(range.start, "<choice>"), edit(range.end, "</choice>")]
    }
}

/// Returns the name with the first free number.
pub(super) fn free(name: &str, taken: impl Fn(&str) -> bool) -> String {
    let numbered = (2..).map(|number: u32| format!("{name}{number}"));
    let mut free = numbered.filter(|name| !taken(name));
    free.next().unwrap_or_default()
}

/// Returns true if a name is compared with something in an expression, so that it may be meant as text.
pub(super) fn is_compared(inner: &str, name: &Range<usize>) -> bool {
    let before = inner[..name.start].trim_end();
    let after = inner[name.end..].trim_start();
    let equals = before.ends_with('=') && !before.ends_with("<=") && !before.ends_with(">=");
    equals || after.starts_with('=') || after.starts_with("!=")
}
