//! Texts that the grammar allows, at random. What it leaves open is filled with what a house may have: codes of the
//! catalogue, numbers that are sizes, corners that differ.

use crate::legacy_grammar::ebnf::{Grammar, Rule};
use crate::support::Numbers;

const CODES: &[&str] = &["KSK  ", "APW  ", "TOD  ", "MMU 2", "GDE 2", "....."];

/// A text.
pub fn make(grammar: &Grammar, numbers: &mut Numbers) -> String {
    let mut maker = Maker {
        grammar,
        numbers,
        text: String::new(),
        last: 0,
    };
    maker.named("file");
    maker.text
}

struct Maker<'a> {
    grammar: &'a Grammar,
    numbers: &'a mut Numbers,
    text: String,
    /// Numbers so far: each is another.
    last: usize,
}

impl Maker<'_> {
    fn named(&mut self, name: &str) {
        match name {
            "EOL" => self.text.push('\n'),
            "BLANK" => self.text.push_str(&"\n".repeat(1 + self.numbers.below(2))),
            "number" => {
                self.last += 1;
                let text = format!("{}.{}", 1 + self.last % 7, self.last % 10);
                self.word(&text);
            }
            "integer" => {
                let text = (1 + self.numbers.below(9)).to_string();
                self.word(&text);
            }
            "text" => self.word("any words at all"),
            "code" => {
                let code = self.numbers.of(CODES);
                self.text.push_str(code);
            }
            "rest" => self.text.push_str("KSK"),
            "measure" => {
                // Letter and number are one word.
                let rule = self.grammar.rules[name].clone();
                let from = self.text.len();
                self.rule(&rule);
                let words: String = self.text[from..].split_whitespace().collect();
                self.text.truncate(from);
                self.word(&words);
            }
            _ => {
                let rule = self.grammar.rules[name].clone();
                self.rule(&rule);
            }
        }
    }

    /// A word, apart from the one before it.
    fn word(&mut self, word: &str) {
        if !self.text.is_empty() && !self.text.ends_with(['\n', ' ']) {
            self.text.push(' ');
        }
        self.text.push_str(word);
    }

    fn rule(&mut self, rule: &Rule) {
        match rule {
            // These stand right behind codes.
            Rule::Words(word) if ["^", "L", "R"].contains(&&**word) && !self.in_roof() => {
                self.text.push_str(word);
            }
            Rule::Words(word) => self.word(word),
            Rule::Named(name) => self.named(name),
            Rule::Sequence(all) => all.iter().for_each(|r| self.rule(r)),
            Rule::Choice(all) => {
                let one = self.numbers.below(all.len());
                self.rule(&all[one]);
            }
            Rule::Optional(one) => (0..self.numbers.below(2)).for_each(|_| self.rule(one)),
            Rule::Repeated(one) => (0..self.numbers.below(4)).for_each(|_| self.rule(one)),
            Rule::Times(times, one) => (0..*times).for_each(|_| self.rule(one)),
        }
    }

    /// Whether the line under way begins with a covering and a blank, as no wall here does.
    fn in_roof(&self) -> bool {
        let line = self.text.rsplit('\n').next().unwrap_or("");
        line.as_bytes().first().is_some_and(u8::is_ascii_uppercase)
            && (line.len() == 1 || line.as_bytes()[1] == b' ')
    }
}
