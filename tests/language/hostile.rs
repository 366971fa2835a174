//! No text whatever disturbs the reader: texts full of expressions with random damage, as many as `HSD_DAMAGED` says.

use super::{Texts, read_in};
use crate::support::Words;
use crate::support::{Numbers, root, texts};

const SPLINTERS: [&str; 32] = [
    "{",
    "}",
    "{}",
    "{k}",
    "{k + 1}",
    "{1 / 0}",
    "{w",
    "'",
    "\"",
    "(",
    "{((((",
    "{-",
    "{not not",
    "&#123;",
    "&lt;",
    "<if test='{k > 1}'>",
    "</if>",
    "<else>",
    "</else>",
    "<use name='a'/>",
    "<define name='a'>",
    "</define>",
    "<let name='w' value='{w}'/>",
    "<Param name='w' default='1'/>",
    "<repeat num='{k}'>",
    "<Storey height='{k}'>",
    "</Storey>",
    "<include href='a.hsd'/>",
    "町",
    "\u{3000}",
    "\0",
    "{min(1,,2)}",
];

fn damaged(text: &str, numbers: &mut Numbers) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    for _ in 0..=numbers.below(6) {
        let at = numbers.below(characters.len() + 1);
        let end = (at + numbers.below(40)).min(characters.len());
        match numbers.below(3) {
            0 => drop(characters.drain(at..end)),
            1 => {
                let copy: Vec<char> = characters[at..end].to_vec();
                characters.splice(at..at, copy);
            }
            _ => drop(characters.splice(at..at, numbers.of(&SPLINTERS).chars())),
        }
    }
    characters.into_iter().collect()
}

#[test]
fn damaged_texts_are_read_and_messages_lie_in_them() {
    let count = std::env::var("HSD_DAMAGED")
        .ok()
        .and_then(|n| n.parse().ok());
    let mut seeds: Vec<String> = vec![
        "<House><define name='a' w='2'><Storey height='{8 + k}'><Row>{w}{'KSK'}</Row></Storey></define>\
         <repeat num='3'><use name='a' w='{1 + 1}'/></repeat><include href='a.hsd'/></House>"
            .into(),
    ];
    let example = root().join("examples/param-machiya.hsd");
    seeds.push(std::fs::read_to_string(example).unwrap());
    let fixtures = texts("tests/suite/diagnostics").into_iter();
    let fixtures = fixtures.filter_map(|p| std::fs::read_to_string(p).ok());
    seeds.extend(fixtures.filter(|t| t.len() < 2000 && t.contains(['{', '}'])));
    let world = Texts::default().with("a.hsd", "<Catalog><define name='b'>{k}</define></Catalog>");
    let mut numbers = Numbers(5);
    for _ in 0..count.unwrap_or(1500) {
        let seed = numbers.of(&seeds).clone();
        let text = damaged(&seed, &mut numbers);
        let done = read_in(&world, &text, &[("frontage", "7"), ("w", "{k}")]);
        for d in &done.list {
            for span in d.labels.iter().map(|l| l.span).chain([d.span().unwrap()]) {
                let all = std::iter::once(&done.source).chain(&done.included);
                let source = all.into_iter().find(|s| s.id() == span.file).unwrap();
                assert!(
                    span.start <= span.end && span.end as usize <= source.size(),
                    "{text}"
                );
                let range = source.text_range(span);
                assert_eq!(source.span(range), span, "{} in {text}", d.message.en());
            }
            assert!(!d.help.is_empty() && !d.message.is_empty());
        }
    }
}
