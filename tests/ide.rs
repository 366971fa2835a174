//! What an editor asks: names, symbols, folds, colours, hints, selections, layouts, completion, hover.

mod complete;
mod hints;
mod hostile;
mod hover;
mod names;
mod shape;
mod speed;
mod strokes;
mod words;

use hsd::Options;
use hsd::ide::{Analysis, SourcePlace};
use hsd::source::{FileId, IncludeError, PictureFile, Source, World};
use std::collections::BTreeMap;

/// Texts in memory, by path.
#[derive(Default)]
pub(crate) struct Texts(BTreeMap<String, String>);

impl World for Texts {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        // Three images a storey: a row ends where no image has the next number.
        let number = name
            .strip_prefix("f1f")
            .and_then(|rest| rest.split('f').nth(1));
        let numbered = number.is_some_and(|n| ["1", "2", "3"].contains(&n));
        let there = numbered || name == "SIGN";
        there.then(|| PictureFile {
            path: name.to_owned(),
            size: (64, 64),
        })
    }

    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
        Err(std::io::Error::other(path.to_owned()))
    }

    fn text(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
        let path = format!("{folder}/{href}");
        let path = path.trim_start_matches('/').to_owned();
        let there = self.0.contains_key(&path);
        there.then_some(path).ok_or(IncludeError::Missing)
    }

    fn text_bytes(&self, path: &str, _: usize) -> std::io::Result<Vec<u8>> {
        Ok(self.0[path].clone().into_bytes())
    }
}

/// A text and the files beside it, and the offset of the mark `‸` in it.
pub(crate) fn marked(files: &[(&str, &str)]) -> (Analysis, usize) {
    let (name, text) = files[0];
    let at = text.find('‸').unwrap_or(0);
    (analysis(name, &text.replacen('‸', "", 1), &files[1..]), at)
}

/// A text and the files beside it.
pub(crate) fn analysis(name: &str, text: &str, beside: &[(&str, &str)]) -> Analysis {
    let owned = |(n, t): &(&str, &str)| ((*n).to_owned(), (*t).to_owned());
    let world = Texts(beside.iter().map(owned).collect());
    let source = Source::new(FileId(0), name, text.as_bytes());
    Analysis::new(source, &world, &Options::default())
}

/// Places as `file:line text`.
pub(crate) fn shown(a: &Analysis, places: &[SourcePlace]) -> Vec<String> {
    let one = |place: &SourcePlace| {
        let source = a.file(place.file).unwrap();
        let (line, _) = source.line_column(source.span(place.range.clone()));
        let text = &source.text()[place.range.clone()];
        format!("{}:{line} {text}", source.name())
    };
    places.iter().map(one).collect()
}
