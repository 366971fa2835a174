//! Folding ranges of a source file.

use super::{Analysis, sections};
use hsd_syntax::parse::syntax::LineKind;
use hsd_syntax::parse::syntax::Outline;
use std::ops::Range;

/// The kind of the folded range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoldKind {
    /// A comment, or several lines of them.
    Comment,
    /// An element, or a house or section of the legacy form.
    Region,
    /// Several includes.
    Imports,
}

/// A foldable range; it covers more than one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    /// From its start to the end of the last hidden line; its first line stays, and so does the line of an end tag.
    pub range: Range<usize>,
    /// The kind.
    pub kind: FoldKind,
}

/// Returns the foldable ranges, in the order of the file.
pub fn folds(a: &Analysis) -> Vec<Fold> {
    let (outline, text) = (a.outline(), a.text());
    let mut found = vec![];
    comments(outline, text, &mut found);
    legacy(outline, text, &mut found);
    elements(outline, text, &mut found);
    imports(outline, text, &mut found);
    found.retain(|fold| {
        let shown = &text[fold.range.clone()];
        shown.contains(['\n', '\r'])
    });
    found.sort_by_key(|f| (f.range.start, std::cmp::Reverse(f.range.end)));
    found.dedup_by_key(|f| f.range.start);
    found
}

/// Adds comments of several lines, and consecutive lines of comments.
fn comments(outline: &Outline, text: &str, found: &mut Vec<Fold>) {
    let mut open: Option<Range<usize>> = None;
    for comment in &outline.comments {
        let follows = open.as_ref().is_some_and(|o| {
            let between = &text[o.end..comment.start];
            between.trim().is_empty() && breaks(between) < 2
        });
        match &mut open {
            Some(open) if follows => open.end = comment.end,
            _ => {
                found.extend(open.take().map(comment_fold));
                open = Some(comment.clone());
            }
        }
    }
    found.extend(open.map(comment_fold));
}

fn comment_fold(range: Range<usize>) -> Fold {
    let kind = FoldKind::Comment;
    Fold { range, kind }
}

/// Returns the number of line ends in a source file.
fn breaks(text: &str) -> usize {
    let feeds = text.matches('\n').count();
    feeds.max(text.matches('\r').count())
}

/// Adds storeys and roofs of the legacy form, and houses if there are several.
fn legacy(outline: &Outline, text: &str, found: &mut Vec<Fold>) {
    let houses = sections::houses(outline, text);
    let several = houses.len() > 1;
    for house in houses {
        let mut add = |lines: &Range<usize>| {
            let range = sections::text_range(outline, lines);
            let kind = FoldKind::Region;
            found.push(Fold { range, kind });
        };
        if several {
            // A comment at its head has a fold of its own, and folds begin on different lines.
            let lines = house.lines.clone();
            let head = lines
                .clone()
                .find(|l| outline.lines[*l].kind != LineKind::Comment);
            add(&(head.unwrap_or(lines.start)..lines.end));
        }
        house.storeys.iter().chain(&house.roofs).for_each(add);
    }
}

/// Adds elements of several lines. The line of the end tag stays if it is alone there.
fn elements(outline: &Outline, text: &str, found: &mut Vec<Fold>) {
    for element in &outline.elements {
        let mut end = element.range.end;
        if let Some(name) = &element.end_name {
            let tag = name.start.saturating_sub(2).max(element.tag.end);
            let before = &text[element.tag.end..tag];
            let content = before.trim_end_matches([' ', '\t', '\u{3000}']);
            if content.ends_with(['\n', '\r']) {
                let content = content.strip_suffix('\n').unwrap_or(content);
                let content = content.strip_suffix('\r').unwrap_or(content);
                end = element.tag.end + content.len();
            }
        }
        found.push(Fold {
            range: element.range.start..end,
            kind: FoldKind::Region,
        });
    }
}

/// Adds consecutive includes.
fn imports(outline: &Outline, text: &str, found: &mut Vec<Fold>) {
    let includes = outline.elements.iter();
    let includes = includes.filter(|e| e.schema.is_some_and(|s| s.name == "include"));
    let mut open: Option<Range<usize>> = None;
    for include in includes.map(|e| &e.range) {
        match &mut open {
            // An unclosed element may contain the next.
            Some(open) if gap(text, open, include).is_some_and(str::is_empty) => {
                open.end = include.end;
            }
            _ => {
                found.extend(open.take().map(import_fold));
                open = Some(include.clone());
            }
        }
    }
    found.extend(open.map(import_fold));
}

/// Returns the source between two elements, without white space around it; `None` if one contains the other.
fn gap<'t>(text: &'t str, first: &Range<usize>, next: &Range<usize>) -> Option<&'t str> {
    text.get(first.end..next.start).map(str::trim)
}

fn import_fold(range: Range<usize>) -> Fold {
    let kind = FoldKind::Imports;
    Fold { range, kind }
}
