//! Finds the English of Rust files: comments, patterns of diagnostics, help of commands.
//!
//! This is a scanner of tokens, not a parser: it distinguishes comments, strings, characters and brackets. Messages
//! are the first string in a call of `text!` or `noun`, and strings assigned to one of [`HELP`].

use super::passage::{Block, Source};

/// Attributes of clap that hold help.
const HELP: &[&str] = &[
    "help",
    "long_help",
    "about",
    "long_about",
    "after_help",
    "after_long_help",
    "before_help",
];

/// Returns the blocks of a file in the order of their lines.
pub(crate) fn blocks(code: &str) -> Vec<Block> {
    let mut scanner = Scanner {
        code,
        at: 0,
        line: 1,
        blocks: Vec::new(),
        comment: None,
        calls: Vec::new(),
        word: "",
        before: Before::Nothing,
    };
    while scanner.at < code.len() {
        scanner.token();
    }
    scanner.blocks
}

/// The tokens before the present one, as far as they matter.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Before {
    Nothing,
    /// The word in `Scanner::word`.
    Word,
    /// That word and `!`.
    Macro,
    /// That word and `=`.
    Assignment,
}

/// A comment that takes the whole of its line, and may continue in the next.
struct OpenComment {
    marker: &'static str,
    /// Number of the line that would extend it.
    next: usize,
}

struct Scanner<'a> {
    code: &'a str,
    at: usize,
    line: usize,
    blocks: Vec<Block>,
    comment: Option<OpenComment>,
    /// Open brackets; true for those of a call whose next string is a message.
    calls: Vec<bool>,
    word: &'a str,
    before: Before,
}

impl<'a> Scanner<'a> {
    fn rest(&self) -> &'a str {
        &self.code[self.at..]
    }

    fn token(&mut self) {
        let rest = self.rest();
        let Some(first) = rest.chars().next() else {
            return;
        };
        if rest.starts_with("//") {
            self.line_comment();
        } else if rest.starts_with("/*") {
            self.block_comment();
        } else if first == '_' || first.is_alphanumeric() {
            self.word_or_string();
        } else if first == '"' {
            self.string(0, true);
        } else if first == '\'' {
            self.character();
        } else {
            self.sign(first);
        }
    }

    fn advance(&mut self, bytes: usize) {
        self.line += self.rest()[..bytes].matches('\n').count();
        self.at += bytes;
    }

    fn sign(&mut self, sign: char) {
        match sign {
            '(' | '[' | '{' => {
                let is_call = match self.before {
                    Before::Macro => self.word == "text",
                    Before::Word => self.word == "noun",
                    _ => false,
                };
                self.calls.push(is_call);
            }
            ')' | ']' | '}' => {
                self.calls.pop();
            }
            _ => {}
        }
        self.before = match (sign, self.before) {
            ('!', Before::Word) => Before::Macro,
            ('=', Before::Word) => Before::Assignment,
            (c, before) if c.is_whitespace() => before,
            _ => Before::Nothing,
        };
        self.advance(sign.len_utf8());
    }

    fn word_or_string(&mut self) {
        let rest = self.rest();
        let end = rest.find(|c: char| c != '_' && !c.is_alphanumeric());
        let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
        let hashes = after.len() - after.trim_start_matches('#').len();
        let quoted = after[hashes..].starts_with('"');
        let is_raw = quoted && matches!(word, "r" | "br" | "cr");
        if is_raw || (hashes == 0 && quoted && matches!(word, "b" | "c")) {
            self.advance(word.len() + hashes);
            self.string(hashes, !is_raw);
            return;
        }
        if word == "b" && after.starts_with('\'') {
            self.advance(1);
            self.character();
            return;
        }
        // A definition such as `fn noun(` is not a call.
        let is_definition =
            self.before == Before::Word && matches!(self.word, "fn" | "mod" | "use");
        self.word = if is_definition { "" } else { word };
        self.before = Before::Word;
        self.advance(word.len());
    }

    /// Reads a string that begins with its quotation mark.
    fn string(&mut self, hashes: usize, has_escapes: bool) {
        let rest = self.rest();
        let closing = format!("\"{}", "#".repeat(hashes));
        let mut end = 1;
        while end < rest.len() && !rest[end..].starts_with(&closing) {
            let is_escape = has_escapes && rest[end..].starts_with('\\');
            end += if is_escape { 1 } else { 0 };
            end += rest[end..].chars().next().map_or(0, char::len_utf8);
        }
        self.message(&rest[1..end.min(rest.len())], has_escapes);
        self.before = Before::Nothing;
        self.advance((end + closing.len()).min(rest.len()));
    }

    /// Keeps a string if it is a message.
    fn message(&mut self, text: &str, has_escapes: bool) {
        let is_help = self.before == Before::Assignment && HELP.contains(&self.word);
        let is_pattern = self.calls.last_mut().is_some_and(std::mem::take);
        if !is_help && !is_pattern {
            return;
        }
        let mut lines = Vec::new();
        let mut is_continued = false;
        for (number, line) in (self.line..).zip(text.split('\n')) {
            let line = if is_continued {
                line.trim_start()
            } else {
                line
            };
            is_continued = has_escapes && line.ends_with('\\');
            let plain = if has_escapes {
                unescaped(line)
            } else {
                line.to_owned()
            };
            // A string that begins with an escaped line break has no blank first line.
            if !(is_continued && plain.is_empty()) {
                lines.push((number, plain));
            }
        }
        let source = Source::Message;
        self.blocks.push(Block { source, lines });
    }

    /// Reads a character such as `'a'`, or the mark of a lifetime.
    fn character(&mut self) {
        let mut chars = self.rest().char_indices().skip(1);
        let (first, second) = (chars.next(), chars.next());
        let length = match (first, second) {
            (Some((_, '\\')), Some((at, escaped))) => {
                let from = at + escaped.len_utf8();
                self.rest()[from..]
                    .find('\'')
                    .map_or(from, |end| from + end + 1)
            }
            (_, Some((at, '\''))) => at + 1,
            _ => 1,
        };
        self.before = Before::Nothing;
        self.advance(length);
    }

    fn line_comment(&mut self) {
        let rest = self.rest();
        let text = rest.split('\n').next().unwrap_or_default();
        let is_doc = text.starts_with("///") && !text.starts_with("////");
        let marker = match text.get(..3) {
            Some("///") if is_doc => "///",
            Some("//!") => "//!",
            _ => "//",
        };
        let content = text[marker.len()..].trim_end();
        let content = content.strip_prefix(' ').unwrap_or(content).to_owned();
        let source = if marker == "//" {
            Source::Comment
        } else {
            Source::Doc
        };
        let head = self.code[..self.at].rsplit('\n').next().unwrap_or_default();
        let is_whole_line = head.trim().is_empty();
        let extends =
            |open: &OpenComment| is_whole_line && open.marker == marker && open.next == self.line;
        let line = (self.line, content);
        match self.blocks.last_mut() {
            Some(block) if self.comment.as_ref().is_some_and(extends) => block.lines.push(line),
            _ => self.blocks.push(Block {
                source,
                lines: vec![line],
            }),
        }
        let next = self.line + 1;
        self.comment = is_whole_line.then_some(OpenComment { marker, next });
        self.advance(text.len());
    }

    fn block_comment(&mut self) {
        let rest = self.rest();
        let (mut depth, mut end) = (0, 0);
        for (at, _) in rest.match_indices(['/', '*']) {
            if at < end {
                continue;
            }
            if rest[at..].starts_with("/*") {
                (depth, end) = (depth + 1, at + 2);
            } else if rest[at..].starts_with("*/") {
                (depth, end) = (depth - 1, at + 2);
            }
            if depth == 0 {
                break;
            }
        }
        let text = &rest[..end];
        let is_doc =
            text.starts_with("/*!") || (text.starts_with("/**") && !text.starts_with("/***"));
        let content = text
            .trim_start_matches(['/', '*', '!'])
            .trim_end_matches(['/', '*']);
        let clean = |line: &str| line.trim().trim_start_matches('*').trim_start().to_owned();
        let lines = (self.line..).zip(content.split('\n').map(clean)).collect();
        let source = if is_doc { Source::Doc } else { Source::Comment };
        self.blocks.push(Block { source, lines });
        self.comment = None;
        self.advance(end);
    }
}

/// Replaces the escapes of one line of a string by what they mean, line breaks by spaces.
fn unescaped(line: &str) -> String {
    let line = line.strip_suffix('\\').unwrap_or(line);
    [("\\\"", "\""), ("\\'", "'"), ("\\n", " "), ("\\t", " ")]
        .iter()
        .fold(line.to_owned(), |text, (escape, plain)| {
            text.replace(escape, plain)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(code: &str) -> Vec<(Source, usize, String)> {
        let text = |b: &Block| {
            b.lines
                .iter()
                .map(|l| l.1.trim())
                .collect::<Vec<_>>()
                .join(" ")
        };
        blocks(code)
            .iter()
            .map(|b| (b.source, b.lines[0].0, text(b)))
            .collect()
    }

    #[test]
    fn comments_are_joined_by_kind_and_line() {
        let code =
            "//! a\n//! b\n\n/// c\n/// d\nfn f() {} // e\n// f\n// g\n//// h\n/* i\n * j */";
        let expected = [
            (Source::Doc, 1, "a b"),
            (Source::Doc, 4, "c d"),
            (Source::Comment, 6, "e"),
            (Source::Comment, 7, "f g // h"),
            (Source::Comment, 10, "i j"),
        ];
        assert_eq!(found(code), expected.map(|(s, l, t)| (s, l, t.to_owned())));
    }

    #[test]
    fn english_patterns_are_messages() {
        let code = r##"
            let a = text!([x, (1, 2)] "an {x} \"b\"", "日本語");
            let b = noun("c", "d");
            fn noun(e: &str) { other("f"); noun(
                "g \
                 h",
                r#"i"#) }
            #[arg(long, help = "j", value_name = "k")]"##;
        let texts: Vec<_> = found(code).into_iter().map(|f| (f.1, f.2)).collect();
        let expected = [(2, "an {x} \"b\""), (3, "c"), (5, "g h"), (8, "j")];
        assert_eq!(texts, expected.map(|(l, t)| (l, t.to_owned())));
    }

    #[test]
    fn strings_and_characters_hide_comments() {
        let code = "let a = \"// b\"; let c = '\"'; let d: &'static str = r#\"\"// e\"#; let f = '\\''; let g = b'\"'; // h";
        assert_eq!(found(code), [(Source::Comment, 1, "h".to_owned())]);
    }
}
