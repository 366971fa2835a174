//! The house types that a `Place` may name: of the library and of the files that are read.

use crate::{Analysis, vocabulary};
use hsd_base::diagnostic::Text;
use hsd_base::source::{FileId, Limits, Source};
use hsd_base::text;
use hsd_syntax::parse::outline;
use hsd_syntax::parse::syntax::Outline;
use hsd_syntax::templates::{TYPES, Template};

/// A parameter of a house type.
pub(crate) struct TypeParameter {
    pub(crate) name: String,
    pub(crate) default: String,
    /// Its values, separated by commas, if they are listed.
    pub(crate) choices: String,
    /// In one line.
    pub(crate) about: Text,
}

/// Returns the types of the library with what each is.
pub(crate) fn library() -> impl Iterator<Item = (&'static Template, Text)> {
    TYPES.iter().map(|t| {
        let (en, ja) = (t.en, t.ja);
        (t, text!([ja, en] "{ja}: {en}", "{ja}"))
    })
}

/// Returns the parameters of a type, by the word that a `Place` has for it; none if it is unknown.
pub(crate) fn parameters(a: &Analysis, word: &str) -> Vec<TypeParameter> {
    if let Some(template) = Template::named(word) {
        let text = template.text();
        let source = Source::new(FileId(0), template.source_name(), text.as_bytes());
        return of(&outline::of(&source, &Limits::default()));
    }
    let end = format!("/{}", word.trim_start_matches("./"));
    let file = |source: &Source| {
        let name = source.name().replace('\\', "/");
        name == word || name.ends_with(&end)
    };
    let all = a.checked.included.iter().zip(a.outlines());
    let found = all.into_iter().find(|(source, _)| file(source));
    found.map_or(vec![], |(_, outline)| of(outline))
}

/// Returns the parameters in the outermost element of a file, or in its house.
fn of(outline: &Outline) -> Vec<TypeParameter> {
    let elements = &outline.elements;
    let depth = |mut element: usize| {
        let mut depth = 0;
        while let Some(parent) = elements[element].parent {
            (element, depth) = (parent, depth + 1);
        }
        depth
    };
    let is_param = |n: usize| elements[n].schema.is_some_and(|s| s.name == "Param");
    let found = (0..elements.len()).filter(|n| is_param(*n) && (1..=2).contains(&depth(*n)));
    found
        .map(|n| {
            let says = |name: &str| elements[n].value(name).unwrap_or_default().to_owned();
            let (unit, default) = (says("unit"), says("default"));
            let bounds = vocabulary::bounds(&says("choices"), &says("min"), &says("max"));
            let line = |doc: String| {
                let words = format!("{doc} = {default} {unit}");
                words.split_whitespace().collect::<Vec<_>>().join(" ") + &bounds
            };
            let (en, ja) = (line(says("doc")), line(says("doc_ja")));
            TypeParameter {
                name: says("name"),
                default: default.clone(),
                choices: says("choices"),
                about: text!([en, ja] "{en}", "{ja}"),
            }
        })
        .collect()
}
