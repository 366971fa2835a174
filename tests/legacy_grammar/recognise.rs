//! Whether a grammar allows a text: every way to read it is followed at once.

use crate::legacy_grammar::ebnf::{Grammar, Rule};
use std::collections::BTreeSet;

/// Places in a text that were reached.
type Places = BTreeSet<usize>;

/// Whether a text is a `file`.
pub fn allows(grammar: &Grammar, text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n");
    let lines = text.lines().filter(|l| !l.starts_with('#'));
    let lines = lines.map(|l| if l.trim().is_empty() { "" } else { l });
    let mut text = lines
        .collect::<Vec<_>>()
        .join("\n")
        .trim_matches('\n')
        .to_owned();
    text.push('\n');
    // Several blank lines count as one, and those round `%` for nothing.
    while text.contains("\n\n\n") {
        text = text.replace("\n\n\n", "\n\n");
    }
    let text = text.replace("\n\n%", "\n%").replace("%\n\n", "%\n");
    let reader = Reader {
        grammar,
        text: &text,
    };
    let ends = reader.named("file", &[0].into(), false);
    ends.contains(&text.len())
}

struct Reader<'a> {
    grammar: &'a Grammar,
    text: &'a str,
}

impl Reader<'_> {
    /// Where a rule may end that begins at some places; `tight` = its words stand together.
    fn rule(&self, rule: &Rule, from: &Places, tight: bool) -> Places {
        match rule {
            Rule::Words(word) => self.step(from, tight, |rest| {
                rest.starts_with(&**word).then_some(word.len())
            }),
            Rule::Named(name) => self.named(name, from, tight),
            Rule::Sequence(all) => all
                .iter()
                .fold(from.clone(), |at, one| self.rule(one, &at, tight)),
            Rule::Choice(all) => all
                .iter()
                .flat_map(|one| self.rule(one, from, tight))
                .collect(),
            Rule::Optional(one) => from.union(&self.rule(one, from, tight)).copied().collect(),
            Rule::Repeated(one) => {
                let (mut all, mut last) = (from.clone(), from.clone());
                while !last.is_empty() {
                    let next = self.rule(one, &last, tight);
                    last = next.difference(&all).copied().collect();
                    all.extend(&last);
                }
                all
            }
            Rule::Times(times, one) => {
                (0..*times).fold(from.clone(), |at, _| self.rule(one, &at, tight))
            }
        }
    }

    fn named(&self, name: &str, from: &Places, tight: bool) -> Places {
        let digits = |rest: &str| rest.bytes().take_while(u8::is_ascii_digit).count();
        match name {
            "EOL" => self.step(from, false, |rest| rest.starts_with('\n').then_some(1)),
            "BLANK" => self.step(from, true, |rest| rest.starts_with('\n').then_some(1)),
            "PRINTABLE" => self.step(from, true, |rest| {
                rest.starts_with(|c| (' '..='~').contains(&c)).then_some(1)
            }),
            "integer" => self.step(from, tight, |rest| Some(digits(rest)).filter(|n| *n > 0)),
            "number" => self.step(from, tight, |rest| {
                let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)));
                let word = &rest[..end.unwrap_or(rest.len())];
                word.parse::<f64>().is_ok().then_some(word.len())
            }),
            "text" => self.step(from, tight, |rest| rest.find('\n').filter(|n| *n > 0)),
            // Every column counts in walls, and letter and number of an option are one word.
            "perimeter" => self.rule(&self.grammar.rules[name], from, true),
            "measure" => {
                let starts = self.step(from, tight, |_| Some(0));
                self.rule(&self.grammar.rules[name], &starts, true)
            }
            _ => self.rule(&self.grammar.rules[name], from, tight),
        }
    }

    /// The places behind a word, blanks before it left out unless it stands tight. Behind a word that is not tight no
    /// letter or digit follows.
    fn step(&self, from: &Places, tight: bool, word: impl Fn(&str) -> Option<usize>) -> Places {
        let each = from.iter().filter_map(|at| {
            let rest = &self.text[*at..];
            let inner = if tight {
                rest
            } else {
                rest.trim_start_matches([' ', '\t'])
            };
            let length = word(inner)?;
            let end = *at + (rest.len() - inner.len()) + length;
            let joined = |c: char| c.is_ascii_alphanumeric() || c == '.' || c == '-';
            let apart = tight
                || length == 0
                || !(inner[..length].ends_with(joined) && self.text[end..].starts_with(joined));
            apart.then_some(end)
        });
        each.collect()
    }
}
