//! Prose without its code: the unit that the rules of style examine.

use std::ops::Range;

/// Origin of a passage. Some rules apply to one of them only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// Doc comment of Rust.
    Doc,
    /// Plain comment of Rust.
    Comment,
    /// English pattern of a diagnostic, or help of a command.
    Message,
    /// Markdown file.
    Markdown,
}

/// Consecutive lines of a file from one source, each with its line number. The first line is 1.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Origin of the lines.
    pub(crate) source: Source,
    /// Lines without comment markers and quotation marks.
    pub(crate) lines: Vec<(usize, String)>,
}

/// A paragraph, list item, heading or cell of a table, joined to one line.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    /// Origin of the text.
    pub(crate) source: Source,
    /// True for the first passage of its block.
    pub(crate) is_first: bool,
    /// True for an item of a list.
    pub(crate) is_item: bool,
    /// True for a cell of a table.
    pub(crate) is_cell: bool,
    /// The text as written.
    pub(crate) raw: String,
    /// The text with code and addresses replaced by backquotes; offsets are those of `raw`.
    pub(crate) prose: String,
    /// Offset at which each line begins, with its number.
    starts: Vec<(usize, usize)>,
}

impl Passage {
    /// Joins lines with spaces and masks what is not prose.
    pub(crate) fn new(source: Source, lines: &[(usize, String)]) -> Passage {
        let mut raw = String::new();
        let mut starts = Vec::with_capacity(lines.len());
        for (number, line) in lines {
            if !raw.is_empty() {
                raw.push(' ');
            }
            starts.push((raw.len(), *number));
            raw.push_str(line.trim());
        }
        let prose = masked(&raw, source);
        Passage {
            source,
            is_first: false,
            is_item: false,
            is_cell: false,
            raw,
            prose,
            starts,
        }
    }

    /// Returns the number of the line that holds an offset.
    pub(crate) fn line_at(&self, offset: usize) -> usize {
        let after = self.starts.partition_point(|(start, _)| *start <= offset);
        self.starts
            .get(after.saturating_sub(1))
            .map_or(0, |(_, line)| *line)
    }
}

/// Replaces code spans, addresses, tags, paths and placeholders by backquotes of the same length.
fn masked(raw: &str, source: Source) -> String {
    let mut bytes = raw.as_bytes().to_vec();
    mask_code_spans(&mut bytes);
    mask_links(&mut bytes);
    mask_pairs(&mut bytes, b'<', b'>');
    if source == Source::Message {
        mask_pairs(&mut bytes, b'{', b'}');
    }
    mask_paths(&mut bytes);
    String::from_utf8(bytes).expect("masks begin and end at ASCII characters")
}

fn fill(bytes: &mut [u8], range: Range<usize>) {
    bytes[range].fill(b'`');
}

fn position(bytes: &[u8], from: usize, wanted: u8) -> Option<usize> {
    let found = bytes.get(from..)?.iter().position(|b| *b == wanted)?;
    Some(from + found)
}

fn mask_code_spans(bytes: &mut [u8]) {
    let mut at = 0;
    while let Some(start) = position(bytes, at, b'`') {
        let ticks = run_of_ticks(bytes, start);
        at = start + ticks;
        let mut end = at;
        while let Some(next) = position(bytes, end, b'`') {
            let closing = run_of_ticks(bytes, next);
            end = next + closing;
            if closing == ticks {
                fill(bytes, start..end);
                at = end;
                break;
            }
        }
    }
}

fn run_of_ticks(bytes: &[u8], from: usize) -> usize {
    bytes[from..].iter().take_while(|b| **b == b'`').count()
}

/// Masks the targets of `[text](target)` and `[text][target]`.
fn mask_links(bytes: &mut [u8]) {
    let mut at = 0;
    while let Some(close) = position(bytes, at, b']') {
        at = close + 1;
        let (open, end) = match bytes.get(at) {
            Some(b'(') => (b'(', b')'),
            Some(b'[') => (b'[', b']'),
            _ => continue,
        };
        let mut depth = 0;
        for index in at..bytes.len() {
            if bytes[index] == open {
                depth += 1;
            } else if bytes[index] == end {
                depth -= 1;
            }
            if depth == 0 {
                // Closing brackets, so that the text of the link keeps its end.
                bytes[close..=index].fill(b']');
                at = index + 1;
                break;
            }
        }
    }
}

/// Masks tags (`<kbd>`) and placeholders (`{name}`), which begin with a letter, `/` or `!` after the bracket.
fn mask_pairs(bytes: &mut [u8], open: u8, close: u8) {
    let mut at = 0;
    while let Some(start) = position(bytes, at, open) {
        at = start + 1;
        let is_tag = matches!(
            bytes.get(at),
            Some(b'a'..=b'z' | b'A'..=b'Z' | b'/' | b'!' | b'}')
        );
        if let Some(end) = position(bytes, at, close).filter(|_| is_tag) {
            fill(bytes, start..end + 1);
            at = end + 1;
        }
    }
}

/// Masks addresses, identifiers and paths of files that are written without backquotes.
fn mask_paths(bytes: &mut [u8]) {
    let mut at = 0;
    while at < bytes.len() {
        let end = position(bytes, at, b' ').unwrap_or(bytes.len());
        let word = &bytes[at..end];
        let has = |part: &[u8]| word.windows(part.len()).any(|w| w == part);
        // A dot before two letters or figures: `roofs.md`, but not the abbreviation `e.g.`
        let is_name = |w: &[u8]| w[0] == b'.' && w[1..].iter().all(u8::is_ascii_alphanumeric);
        let is_file = word.windows(3).any(is_name);
        if has(b"::") || has(b"_") || has(b"://") || is_file {
            let kept = word
                .iter()
                .rev()
                .take_while(|b| b".,;:!?)".contains(b))
                .count();
            fill(bytes, at..end - kept);
        }
        at = end + 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prose(text: &str, source: Source) -> String {
        Passage::new(source, &[(1, text.to_owned())]).prose
    }

    #[test]
    fn code_and_addresses_are_masked() {
        let text = "See `of its own`, [told](told.md), told::f and https://told.jp.";
        let found = prose(text, Source::Doc);
        assert_eq!(found.len(), text.len());
        assert_eq!(found.matches("told").count(), 1, "{found}");
        assert!(!found.contains("own") && found.ends_with('.'), "{found}");
        assert_eq!(prose("a ``b ` c`` d", Source::Doc), "a ````````` d");
    }

    #[test]
    fn placeholders_are_masked_in_messages_only() {
        assert_eq!(
            prose("no {told:?} here", Source::Message),
            "no ```````` here"
        );
        assert_eq!(prose("a {told} here", Source::Doc), "a {told} here");
        assert_eq!(
            prose("if a < b, and <kbd>c</kbd>", Source::Doc),
            "if a < b, and `````c``````"
        );
    }

    #[test]
    fn lines_are_found_by_offset() {
        let lines = [(7, "one two".to_owned()), (8, "three".to_owned())];
        let passage = Passage::new(Source::Doc, &lines);
        assert_eq!(passage.raw, "one two three");
        assert_eq!([0, 7, 8, 12].map(|at| passage.line_at(at)), [7, 7, 8, 8]);
    }
}
