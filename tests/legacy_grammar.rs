//! The grammar of the legacy text, `grammar/legacy.ebnf`, held against the reader: what the grammar allows is read
//! without a mistake of syntax, what it does not allow has one. Its pictures in `grammar/pictures/legacy` are drawn
//! from it; `HSD_UPDATE=1 cargo test --release legacy_grammar` draws them anew.
mod draw;
mod ebnf;
mod recognise;
mod sentences;
use crate::support::{Numbers, assert_none, compile, root, stem, texts};
use ebnf::Grammar;
use std::fs;

const FILE: &str = "grammar/legacy.ebnf";
const PICTURES: &str = "grammar/pictures/legacy";

/// Mistakes of syntax: what no text of the grammar shows, and what every text outside shows.
const SYNTAX: &[u16] = &[
    101, 102, 103, 105, 106, 107, 110, 111, 113, 114, 115, 116, 117, 118, 120, 121, 122, 123, 124,
    125, 126, 128, 140, 141, 142, 143, 145, 146, 148, 149, 150, 151,
];

fn grammar() -> Grammar {
    let text = fs::read_to_string(root().join(FILE)).expect("the grammar is there");
    Grammar::read(&text)
}

/// The mistakes of syntax that the reader finds.
fn mistakes(text: &str) -> Vec<u16> {
    let run = compile("sentence.hsd", text.as_bytes());
    let codes = run.diagnostics.iter().map(|d| d.code.0);
    codes.filter(|c| SYNTAX.contains(c)).collect()
}

#[test]
fn every_rule_is_used_and_known() {
    let grammar = grammar();
    let named = grammar.named();
    for rule in grammar.rules.keys().filter(|r| *r != "file") {
        assert!(named.contains(rule.as_str()), "nothing uses {rule}");
    }
    for name in named {
        let known = grammar.rules.contains_key(&name) || ebnf::WORDS.contains(&&*name);
        assert!(known, "{name} is no rule");
    }
}

#[test]
fn what_the_grammar_allows_is_read() {
    let grammar = grammar();
    let mut numbers = Numbers(7);
    let mut wrong = vec![];
    for _ in 0..crate::support::part_of(4000) {
        let text = sentences::make(&grammar, &mut numbers);
        assert!(recognise::allows(&grammar, &text), "not its own:\n{text}");
        let codes = mistakes(&text);
        if !codes.is_empty() {
            wrong.push(format!("{codes:?} in\n{text}"));
        }
    }
    assert_none(&wrong);
}

#[test]
fn texts_with_mistakes_of_syntax_are_not_allowed() {
    let grammar = grammar();
    let (mut wrong, mut allowed, mut refused) = (vec![], 0, 0);
    let folders = ["tests/suite/diagnostics", "examples", "tests/corpus"];
    for path in folders.iter().flat_map(|folder| texts(folder)) {
        let bytes = fs::read(&path).expect("texts can be read");
        let Ok(text) = String::from_utf8(bytes) else {
            continue;
        };
        if text
            .trim_start_matches('\u{feff}')
            .trim_start()
            .starts_with(['<', '＜'])
        {
            continue;
        }
        let codes = mistakes(&text);
        let allows = recognise::allows(&grammar, &text);
        match allows {
            true => allowed += 1,
            false => refused += 1,
        }
        if allows && !codes.is_empty() {
            wrong.push(format!("{} is allowed, but {codes:?}", stem(&path)));
        }
        let name = stem(&path);
        let sound =
            name.starts_with("HSD03") || name.starts_with("HSD04") || !name.starts_with("HSD");
        if !allows && codes.is_empty() && sound && !ODD.contains(&&*name) {
            wrong.push(format!("{name} is not allowed, and nothing is said"));
        }
    }
    assert!(allowed > 10 && refused > 25, "{allowed} {refused}");
    assert_none(&wrong);
}

/// Texts without a house, of which another message tells, and one with names of parts in the place of codes.
const ODD: &[&str] = &["blank", "bom", "empty", "HSD0301_part_name_in_text"];

#[test]
fn the_pictures_are_those_of_the_grammar() {
    let grammar = grammar();
    let folder = root().join(PICTURES);
    let mut wrong = vec![];
    for (name, rule) in &grammar.rules {
        let svg = draw::picture(rule);
        let path = folder.join(format!("{name}.svg"));
        if std::env::var_os("HSD_UPDATE").is_some() {
            fs::create_dir_all(&folder).expect("the folder can be made");
            fs::write(&path, &svg).expect("the picture can be written");
        }
        if fs::read_to_string(&path).unwrap_or_default() != svg {
            wrong.push(format!(
                "{} is stale: HSD_UPDATE=1 cargo test --release legacy_grammar",
                path.display()
            ));
        }
    }
    assert_none(&wrong);
}
