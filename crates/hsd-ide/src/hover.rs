//! Hover in Markdown: parts with their cards, walls with what was built from them, words with their meanings,
//! expressions with their values.

mod built;
mod computed;
mod legacy;
mod xml;

use super::complete::parts;
use super::{Analysis, card};
use hsd_base::diagnostic::{Language, Text};
use hsd_syntax::print::Form;
use std::ops::Range;

/// The hover text of a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// The range that the hover describes; it contains the place.
    pub range: Range<usize>,
    /// The text, in Markdown.
    pub markdown: String,
}

/// Returns the hover text at an offset. `pictures`: cards of parts show an image, as a `data:` URI; some clients show
/// its raw text.
pub fn hover(a: &Analysis, at: usize, language: Language, pictures: bool) -> Option<Hover> {
    if !a.text().is_char_boundary(at) || a.outline().in_comment(at) {
        return None;
    }
    let request = Request {
        a,
        at,
        language,
        pictures,
    };
    let found = match Form::of(&a.source) {
        Form::Xml => xml::hover(&request),
        Form::Legacy => legacy::hover(&request),
    };
    found.filter(|h| !h.markdown.is_empty())
}

/// A hover request.
struct Request<'a> {
    a: &'a Analysis,
    at: usize,
    language: Language,
    pictures: bool,
}

impl Request<'_> {
    /// Joins paragraphs about a range; empty ones are left out.
    fn told(
        &self,
        range: &Range<usize>,
        paragraphs: impl IntoIterator<Item = Text>,
    ) -> Option<Hover> {
        let words = paragraphs.into_iter();
        let words: Vec<String> = words
            .map(|t| t.in_language(self.language).into_owned())
            .filter(|t| !t.is_empty())
            .collect();
        Some(Hover {
            range: range.clone(),
            markdown: words.join("\n\n"),
        })
    }

    /// Returns the card of the part that a code means.
    fn part(&self, range: &Range<usize>, code: &str) -> Option<Hover> {
        let id = parts::meant(self.a, self.at, code)?;
        let house = parts::house_at(self.a, self.at);
        let part = self.a.catalog().part(id);
        Some(Hover {
            range: range.clone(),
            markdown: card::card(self.a, part, house, self.language, self.pictures),
        })
    }
}

/// Returns true if a range contains an offset, its end included.
fn holds(range: &Range<usize>, at: usize) -> bool {
    range.start <= at && at <= range.end
}
