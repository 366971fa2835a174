//! Start tags that were meant as end tags: `<Row>KTU  <Row>`, where the slash is forgotten.
//!
//! Such a tag has no attributes, is directly in an element of its name, and leaves two ends missing: its own and that
//! of its parent. If only one is missing, the end tag before it was forgotten altogether.

use crate::parse::schema::SchemaHints;

/// The maximum number of searches for end tags: they cost time, and a file may be full of such tags.
const SEARCHES: u32 = 50;
/// The maximum number of bytes that a search reads: no wall line is longer.
const FAR: usize = 1 << 16;

/// Judges start tags, within a limit of time.
pub(in crate::parse::xml) struct Slashes {
    left: u32,
}

impl Slashes {
    pub(in crate::parse::xml) fn new() -> Self {
        Slashes { left: SEARCHES }
    }

    /// Returns true if a tag without attributes, directly inside an element of the same name, was meant to close it.
    /// `rest` = the text after it; `open` = the names of the open elements, the outermost first.
    pub(in crate::parse::xml) fn forgotten<'a>(
        &mut self,
        name: &str,
        rest: &str,
        open: impl DoubleEndedIterator<Item = &'a str>,
        habits: SchemaHints,
    ) -> bool {
        if (habits.alone)(name) {
            return is_hollow(name, rest);
        }
        if !(habits.known)(name) || self.left == 0 {
            return false;
        }
        self.left -= 1;
        let mut count = 1;
        let mut others = open.rev().inspect(|n| count += usize::from(*n == name));
        let outer = others.find(|n| *n != name);
        missing(name, rest, outer, count).is_some_and(|n| n >= 2)
    }
}

/// Returns true if an element that begins here would have neither content nor an end tag.
fn is_hollow(name: &str, rest: &str) -> bool {
    let next = rest.trim_start();
    let Some(tag) = next.strip_prefix('<') else {
        return next.is_empty();
    };
    match tag.strip_prefix('/') {
        Some(end) => !is_tag(end, name),
        None => is_tag(tag, name),
    }
}

/// Returns the number of missing end tags of a name before the end of the element `outer`, with `open` of them open;
/// `None` = the end of `outer` is too far away.
fn missing(name: &str, rest: &str, outer: Option<&str>, open: usize) -> Option<usize> {
    let (mut open, mut depth) = (open, 1usize);
    for (i, _) in rest.match_indices('<') {
        if i > FAR {
            return None;
        }
        let tag = &rest[i + 1..];
        if let Some(end) = tag.strip_prefix('/') {
            if is_tag(end, name) {
                open = open.saturating_sub(1);
            } else if outer.is_some_and(|o| is_tag(end, o)) {
                depth -= 1;
                if depth == 0 {
                    break;
                }
            }
        } else if is_tag(tag, name) && !is_empty(tag) {
            open += 1;
        } else if outer.is_some_and(|o| is_tag(tag, o)) && !is_empty(tag) {
            depth += 1;
        }
    }
    Some(open)
}

/// Returns true if the text after `<` or `</` continues with exactly this name.
fn is_tag(text: &str, name: &str) -> bool {
    let after = text.strip_prefix(name);
    after.is_some_and(|a| a.starts_with(|c: char| c == '>' || c == '/' || c.is_whitespace()))
}

/// Returns true if the text after `<` is a tag that ends with `/>`.
fn is_empty(text: &str) -> bool {
    text.split(['<', '>'])
        .next()
        .is_some_and(|t| t.ends_with('/'))
}
