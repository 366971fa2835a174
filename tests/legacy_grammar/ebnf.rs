//! The notation of ISO 14977, as far as the grammar needs it.

use std::collections::{BTreeMap, BTreeSet};

/// Words that are no rules: what they stand for is said in the head of the grammar.
pub const WORDS: &[&str] = &["number", "integer", "text", "EOL", "BLANK", "PRINTABLE"];

/// What a rule says.
#[derive(Clone, Debug)]
pub enum Rule {
    Words(String),
    Named(String),
    Sequence(Vec<Rule>),
    Choice(Vec<Rule>),
    Optional(Box<Rule>),
    Repeated(Box<Rule>),
    Times(usize, Box<Rule>),
}

/// The rules by their names.
pub struct Grammar {
    pub rules: BTreeMap<String, Rule>,
}

impl Grammar {
    pub fn read(text: &str) -> Grammar {
        let mut reader = Reader {
            tokens: tokens(text),
            at: 0,
        };
        let mut rules = BTreeMap::new();
        while reader.at < reader.tokens.len() {
            let name = reader.next();
            reader.expect("=");
            let rule = reader.choice();
            reader.expect(";");
            assert!(rules.insert(name.clone(), rule).is_none(), "{name} twice");
        }
        Grammar { rules }
    }

    /// Every name that a rule uses.
    pub fn named(&self) -> BTreeSet<String> {
        let mut found = BTreeSet::new();
        self.rules.values().for_each(|rule| names(rule, &mut found));
        found
    }
}

fn names(rule: &Rule, found: &mut BTreeSet<String>) {
    match rule {
        Rule::Words(_) => {}
        Rule::Named(name) => {
            found.insert(name.clone());
        }
        Rule::Sequence(all) | Rule::Choice(all) => all.iter().for_each(|r| names(r, found)),
        Rule::Optional(one) | Rule::Repeated(one) | Rule::Times(_, one) => names(one, found),
    }
}

/// Names, numbers, texts with their first quote, signs; without comments.
fn tokens(text: &str) -> Vec<String> {
    let (mut found, mut rest) = (vec![], text);
    loop {
        rest = rest.trim_start();
        if let Some(comment) = rest.strip_prefix("(*") {
            rest = comment.split_once("*)").expect("comments end").1;
            continue;
        }
        let Some(first) = rest.chars().next() else {
            return found;
        };
        let end = match first {
            '"' => 1 + rest[1..].find('"').expect("texts end"),
            c if c.is_alphanumeric() => rest
                .find(|c: char| !c.is_alphanumeric())
                .unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        found.push(rest[..end].to_owned());
        rest = rest[end..].trim_start_matches('"');
    }
}

struct Reader {
    tokens: Vec<String>,
    at: usize,
}

impl Reader {
    fn peek(&self) -> &str {
        self.tokens.get(self.at).map_or("", |t| t.as_str())
    }

    fn next(&mut self) -> String {
        self.at += 1;
        self.tokens[self.at - 1].clone()
    }

    fn expect(&mut self, token: &str) {
        let found = self.next();
        assert_eq!(found, token, "token {}", self.at);
    }

    fn list(
        &mut self,
        between: &str,
        item: fn(&mut Self) -> Rule,
        of: fn(Vec<Rule>) -> Rule,
    ) -> Rule {
        let mut all = vec![item(self)];
        while self.peek() == between {
            self.at += 1;
            all.push(item(self));
        }
        if all.len() == 1 {
            all.remove(0)
        } else {
            of(all)
        }
    }

    fn choice(&mut self) -> Rule {
        self.list("|", Self::sequence, Rule::Choice)
    }

    fn sequence(&mut self) -> Rule {
        self.list(",", Self::item, Rule::Sequence)
    }

    fn item(&mut self) -> Rule {
        let token = self.next();
        let inner = |reader: &mut Self, end: &str| {
            let rule = reader.choice();
            reader.expect(end);
            rule
        };
        match &*token {
            "(" => inner(self, ")"),
            "[" => Rule::Optional(Box::new(inner(self, "]"))),
            "{" => Rule::Repeated(Box::new(inner(self, "}"))),
            word if word.starts_with('"') => Rule::Words(word[1..].to_owned()),
            word => match word.parse() {
                Ok(times) => {
                    self.expect("*");
                    Rule::Times(times, Box::new(self.item()))
                }
                Err(_) => Rule::Named(token),
            },
        }
    }
}
