//! Expressions, parameters, conditions, named pieces and included files of the XML form.

mod commands;
mod draws;
mod files;
mod growth;
mod hostile;
mod machiya;
mod values;

use hsd::ast::{Document, Item, Piece, Row, Storey};
use hsd::diagnostic::{Diagnostic, Diagnostics};
use hsd::driver;
use hsd::source::{FileId, IncludeError, PictureFile, Source, World};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Texts in memory, by path; folders are not looked at.
#[derive(Default)]
pub(crate) struct Texts {
    files: BTreeMap<String, Vec<u8>>,
    read: AtomicUsize,
}

impl Texts {
    pub(crate) fn with(mut self, path: &str, text: impl AsRef<[u8]>) -> Texts {
        self.files.insert(path.to_owned(), text.as_ref().to_vec());
        self
    }
}

impl World for Texts {
    fn picture(&self, _: &str) -> Option<PictureFile> {
        None
    }

    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
        Err(std::io::Error::other(path.to_owned()))
    }

    fn text(&self, _: &str, href: &str) -> Result<String, IncludeError> {
        let there = self.files.contains_key(href);
        there.then(|| href.to_owned()).ok_or(IncludeError::Missing)
    }

    fn text_bytes(&self, path: &str, _: usize) -> std::io::Result<Vec<u8>> {
        self.read.fetch_add(1, Ordering::Relaxed);
        Ok(self.files[path].clone())
    }
}

/// What reading a text makes.
pub(crate) struct Done {
    pub(crate) source: Source,
    pub(crate) document: Document,
    pub(crate) included: Vec<Source>,
    pub(crate) list: Vec<Diagnostic>,
}

impl Done {
    /// Code and marked text of each message.
    pub(crate) fn faults(&self) -> Vec<(u16, String)> {
        let marked = |d: &Diagnostic| {
            let all = std::iter::once(&self.source).chain(&self.included);
            let source = all
                .into_iter()
                .find(|s| s.id() == d.span().unwrap().file)
                .unwrap();
            source.text()[source.text_range(d.span().unwrap())].to_owned()
        };
        self.list.iter().map(|d| (d.code.0, marked(d))).collect()
    }
}

pub(crate) fn options(parameters: &[(&str, &str)]) -> hsd::Options {
    let owned = parameters
        .iter()
        .map(|(n, v)| ((*n).to_owned(), (*v).to_owned()));
    hsd::Options {
        parameters: owned.collect(),
        ..hsd::Options::default()
    }
}

pub(crate) fn read_in(world: &dyn World, text: &str, parameters: &[(&str, &str)]) -> Done {
    let source = Source::new(FileId(0), "test.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    let mut read = driver::documents(&[&source], world, &options(parameters), &mut out);
    Done {
        document: read.documents.remove(0),
        included: read.included,
        list: out.into_sorted(),
        source,
    }
}

pub(crate) fn read(text: &str) -> Done {
    read_in(&Texts::default(), text, &[])
}

/// The document of a text of which there is nothing to be said.
pub(crate) fn clean(text: &str) -> Document {
    let done = read(text);
    assert!(done.list.is_empty(), "{:#?}", done.list);
    done.document
}

/// The storeys of the first house, repetitions undone.
pub(crate) fn storeys(document: &Document) -> Vec<&Storey> {
    ones(&document.houses[0].storeys)
}

fn ones<T>(items: &[Item<T>]) -> Vec<&T> {
    let mut found = vec![];
    for item in items {
        match item {
            Item::One(one) => found.push(one),
            Item::Repeat(repeat) => {
                for _ in 0..repeat.num.value {
                    found.extend(ones(&repeat.body));
                }
            }
            _ => {}
        }
    }
    found
}

/// The rows of a storey.
pub(crate) fn rows(storey: &Storey) -> Vec<&Row> {
    storey.loops.iter().flat_map(|l| ones(&l.rows)).collect()
}

/// The codes of a row, without blanks at their ends.
pub(crate) fn codes(row: &Row) -> Vec<String> {
    let pieces: Vec<&Piece> = ones(&row.pieces);
    let code = |p: &&Piece| Some(p.code()?.value.as_str().trim_end().to_owned());
    pieces.iter().filter_map(code).collect()
}

/// The codes of the only row of a house.
pub(crate) fn row_of(before: &str, row: &str) -> Vec<String> {
    let text = format!("<House>{before}<Storey><Row>{row}</Row></Storey></House>");
    let document = clean(&text);
    codes(rows(storeys(&document)[0])[0])
}

/// The messages of a house with this row.
pub(crate) fn faults_of(before: &str, row: &str) -> Vec<(u16, String)> {
    read(&format!(
        "<House>{before}<Storey><Row>{row}</Row></Storey></House>"
    ))
    .faults()
}
