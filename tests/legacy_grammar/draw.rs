//! Rules as pictures, with rails for what may follow what.

use crate::legacy_grammar::ebnf::Rule;
use railroad::{
    Choice, Diagram, Empty, Node, NonTerminal, Optional, Repeat, Sequence, SimpleEnd, SimpleStart,
    Stylesheet, Terminal,
};

type Rails = Box<dyn Node>;

/// The picture of a rule.
pub fn picture(rule: &Rule) -> String {
    let all: Vec<Rails> = vec![Box::new(SimpleStart), rails(rule), Box::new(SimpleEnd)];
    let diagram = Diagram::new_with_stylesheet(Sequence::new(all), &Stylesheet::Light);
    format!("{diagram}\n")
}

fn rails(rule: &Rule) -> Rails {
    let each = |all: &[Rule]| -> Vec<Rails> { all.iter().map(rails).collect() };
    match rule {
        Rule::Words(words) => Box::new(Terminal::new(words.clone())),
        Rule::Named(name) => Box::new(NonTerminal::new(name.clone())),
        Rule::Sequence(all) => Box::new(Sequence::new(each(all))),
        Rule::Choice(all) => Box::new(Choice::new(each(all))),
        Rule::Optional(one) => Box::new(Optional::new(rails(one))),
        Rule::Repeated(one) => Box::new(Optional::new(Repeat::new(rails(one), Empty))),
        Rule::Times(times, one) => {
            let all: Vec<Rails> = (0..*times).map(|_| rails(one)).collect();
            Box::new(Sequence::new(all))
        }
    }
}
