//! Splits Markdown into passages: paragraphs, list items, headings and cells of tables. Code blocks are skipped.

use super::passage::{Block, Passage, Source};

/// Splits a block of lines into its passages, in the order of the file.
pub(crate) fn passages(block: &Block) -> Vec<Passage> {
    if block.source == Source::Message {
        return message(block);
    }
    let mut splitter = Splitter::new(block.source);
    for (number, line) in &block.lines {
        splitter.line(*number, line);
    }
    splitter.end_passage();
    splitter.passages
}

/// Splits a message at blank lines. Indented lines are examples of commands, which are not prose.
fn message(block: &Block) -> Vec<Passage> {
    let is_prose = |(_, line): &(usize, String)| !line.trim().is_empty() && !line.starts_with("  ");
    let parts = block.lines.split(|line| !is_prose(line));
    let parts = parts.filter(|lines| !lines.is_empty());
    parts
        .map(|lines| Passage::new(block.source, lines))
        .collect()
}

struct Splitter {
    source: Source,
    passages: Vec<Passage>,
    /// Lines of the passage that is being read.
    open: Vec<(usize, String)>,
    is_item: bool,
    /// True between the first item of a list and the next line that begins at the margin.
    in_list: bool,
    after_blank: bool,
    /// Marker that ends the code block being read, such as three backquotes.
    fence: Option<String>,
    in_html_comment: bool,
}

impl Splitter {
    fn new(source: Source) -> Splitter {
        Splitter {
            source,
            passages: Vec::new(),
            open: Vec::new(),
            is_item: false,
            in_list: false,
            after_blank: true,
            fence: None,
            in_html_comment: false,
        }
    }

    fn end_passage(&mut self) {
        if self.open.is_empty() {
            return;
        }
        let mut passage = Passage::new(self.source, &self.open);
        passage.is_first = self.passages.is_empty();
        passage.is_item = self.is_item;
        self.passages.push(passage);
        self.open.clear();
        self.is_item = false;
    }

    fn line(&mut self, number: usize, line: &str) {
        if self.skips(line) {
            return;
        }
        let text = line.trim();
        let indent = line.len() - line.trim_start().len();
        if text.is_empty() {
            self.end_passage();
            self.after_blank = true;
            return;
        }
        let was_blank = std::mem::replace(&mut self.after_blank, false);
        if indent >= 4 && self.open.is_empty() && was_blank && !self.in_list {
            self.after_blank = true; // the next line of the code block
            return;
        }
        let text = text.trim_start_matches("> ");
        if let Some(fence) = fence_of(text) {
            self.end_passage();
            self.fence = Some(fence);
        } else if text.starts_with("<!--") {
            self.end_passage();
            self.in_html_comment = !text.contains("-->");
        } else if text.starts_with('|') {
            self.end_passage();
            self.cells(number, text);
        } else if let Some(heading) = heading(text) {
            self.end_passage();
            self.open.push((number, heading.to_owned()));
            self.end_passage();
        } else if let Some(item) = item(text) {
            self.end_passage();
            (self.is_item, self.in_list) = (true, true);
            self.open.push((number, item.to_owned()));
        } else if is_rule(text) || is_link_definition(text) {
            self.end_passage();
        } else {
            self.in_list &= indent > 0 || !was_blank;
            self.open.push((number, text.to_owned()));
        }
    }

    /// Returns true for a line inside a code block or an HTML comment, and ends that at its last line.
    fn skips(&mut self, line: &str) -> bool {
        if let Some(fence) = &self.fence {
            let text = line.trim().trim_start_matches("> ");
            if text.starts_with(fence.as_str()) && text.trim_start_matches(&fence[..1]).is_empty() {
                self.fence = None;
            }
            return true;
        }
        let inside = self.in_html_comment;
        self.in_html_comment &= !line.contains("-->");
        inside
    }

    fn cells(&mut self, number: usize, row: &str) {
        if row.chars().all(|c| "|-: ".contains(c)) {
            return;
        }
        for cell in table_cells(row).into_iter().filter(|cell| !cell.is_empty()) {
            self.open.push((number, cell.to_owned()));
            self.end_passage();
            if let Some(passage) = self.passages.last_mut() {
                passage.is_cell = true;
            }
        }
    }
}

/// Splits a row of a table into its cells, without the outer bars. Bars in code spans and `\|` do not separate.
pub(crate) fn table_cells(row: &str) -> Vec<&str> {
    let row = row.trim();
    let row = row.strip_prefix('|').unwrap_or(row);
    let row = row.strip_suffix('|').unwrap_or(row);
    let (mut cells, mut start, mut in_code, mut escaped) = (Vec::new(), 0, false, false);
    for (at, c) in row.char_indices() {
        if c == '`' {
            in_code = !in_code;
        } else if c == '|' && !in_code && !escaped {
            cells.push(row[start..at].trim());
            start = at + 1;
        }
        escaped = c == '\\';
    }
    cells.push(row[start..].trim());
    cells
}

fn fence_of(text: &str) -> Option<String> {
    let mark = text.chars().next().filter(|c| "`~".contains(*c))?;
    let length = text.chars().take_while(|c| *c == mark).count();
    let is_fence = length >= 3 && !text[length..].contains('`');
    is_fence.then(|| mark.to_string().repeat(length))
}

fn heading(text: &str) -> Option<&str> {
    let rest = text.trim_start_matches('#');
    let level = text.len() - rest.len();
    (1..=6).contains(&level).then(|| rest.strip_prefix(' '))?
}

fn item(text: &str) -> Option<&str> {
    if let Some(rest) = text.strip_prefix(['-', '*', '+']) {
        return rest.strip_prefix(' ');
    }
    let rest = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let digits = text.len() - rest.len();
    let rest = rest.strip_prefix(['.', ')'])?.strip_prefix(' ')?;
    (1..=2).contains(&digits).then_some(rest)
}

fn is_rule(text: &str) -> bool {
    text.len() >= 3 && text.chars().all(|c| "-=*_".contains(c))
}

fn is_link_definition(text: &str) -> bool {
    text.starts_with('[')
        && !text.starts_with("[^")
        && text
            .split_once("]: ")
            .is_some_and(|(name, _)| !name.contains(']'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(markdown: &str) -> Vec<String> {
        let lines = (1..).zip(markdown.lines().map(str::to_owned)).collect();
        let source = Source::Markdown;
        passages(&Block { source, lines })
            .into_iter()
            .map(|p| p.raw)
            .collect()
    }

    #[test]
    fn paragraphs_items_headings_and_cells_are_separate() {
        let found = texts(
            "# Head\none\ntwo\n\n- a\n  b\n- c\n1. d\n\n> e\n> f\n\n| g | `h|i` |\n|---|---|\n| j\\|k | |",
        );
        assert_eq!(
            found,
            [
                "Head", "one two", "a b", "c", "d", "e f", "g", "`h|i`", "j\\|k"
            ]
        );
    }

    #[test]
    fn code_blocks_comments_and_link_definitions_are_skipped() {
        let found = texts(
            "a\n\n```rust\nb\n\nc\n```\n\n    d\n    e\n\n<!-- f\ng -->\n[h]: i.md\n[^1]: j\n\n~~~\n```\n~~~\nk",
        );
        assert_eq!(found, ["a", "[^1]: j", "k"]);
    }

    #[test]
    fn indented_lines_of_a_list_are_prose() {
        assert_eq!(texts("- a\n\n    b\n\nc\n\n    d"), ["a", "b", "c"]);
    }

    #[test]
    fn a_numbered_line_is_an_item_and_a_year_is_not() {
        assert_eq!(texts("a\n12. b\n1868. c"), ["a", "b 1868. c"]);
    }
}
