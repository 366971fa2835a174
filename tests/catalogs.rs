//! Own parts: where they are found, what they take over, which pictures they show, and that no text makes too much of them.

mod parts;
mod pictures;

use hsd::ast::CodeText;
use hsd::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd::driver::{self, Compiled};
use hsd::program::{Content, PictureId, Unit};
use hsd::source::{FileId, IncludeError, PictureFile, Source, World};
use std::collections::{BTreeMap, BTreeSet};

/// Texts in folders and names of pictures.
#[derive(Default)]
struct Files {
    texts: BTreeMap<String, String>,
    pictures: BTreeSet<String>,
}

impl Files {
    fn with(mut self, path: &str, text: &str) -> Files {
        self.texts.insert(path.into(), text.into());
        self
    }

    fn pictured(mut self, names: &[&str]) -> Files {
        self.pictures.extend(names.iter().map(|n| (*n).to_owned()));
        self
    }
}

impl World for Files {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        let path = self.pictures.get(name)?.clone();
        let size = (200, 100);
        Some(PictureFile { path, size })
    }

    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
        Err(std::io::Error::other(path.to_owned()))
    }

    fn image(&self, from: &str, href: &str) -> Result<PictureFile, IncludeError> {
        let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
        let path = format!("{folder}/{href}");
        self.picture(&path).ok_or(IncludeError::Missing)
    }

    fn text(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        let path = match from.rsplit_once('/') {
            Some((folder, _)) => format!("{folder}/{href}"),
            None => href.to_owned(),
        };
        let there = self.texts.contains_key(&path);
        there.then_some(path).ok_or(IncludeError::Missing)
    }

    fn text_bytes(&self, path: &str, _: usize) -> std::io::Result<Vec<u8>> {
        Ok(self.texts[path].clone().into_bytes())
    }
}

/// What a run makes of texts, some of them catalogues for all.
fn run(files: &Files, texts: &[&str], given: &[&str]) -> (Compiled, Vec<Diagnostic>) {
    let source = |(id, name): (usize, &&str)| {
        let id = FileId(u32::try_from(id).unwrap());
        Source::new(id, *name, files.texts[*name].as_bytes())
    };
    let all: Vec<Source> = texts.iter().chain(given).enumerate().map(source).collect();
    let (texts, given) = all.split_at(texts.len());
    let options = hsd::Options {
        catalogs: given.into(),
        ..hsd::Options::default()
    };
    let mut out = Diagnostics::new();
    let sources: Vec<&Source> = texts.iter().collect();
    let made = driver::compile(&sources, files, &options, &mut out);
    (made, out.into_sorted())
}

fn clean(files: &Files, texts: &[&str], given: &[&str]) -> Compiled {
    let (made, list) = run(files, texts, given);
    assert_eq!(list, vec![]);
    made
}

/// Codes of the messages of one text.
fn codes(text: &str) -> Vec<u16> {
    let files = Files::default().with("a.hsd", text);
    let (_, list) = run(&files, &["a.hsd"], &[]);
    list.iter().map(|d| d.code.0).collect()
}

/// The units of a house's first storey in walk order.
fn units(made: &Compiled, house: usize) -> Vec<&Unit> {
    let storey = &made.building.houses[house].house.storeys[0];
    let walls = storey.rings.iter().flat_map(|r| &r.walls);
    walls.flat_map(|w| &w.units).collect()
}

/// The English name of a house's first part.
fn first_name(made: &Compiled, house: usize) -> String {
    let Content::Part(id) = units(made, house)[0].content else {
        panic!("a part stands first");
    };
    made.catalog.part(id).en.to_string()
}

/// A house of which the first part has this code.
fn legacy(code: &str) -> String {
    format!("0 0 180\n9\n\n{code:<5}KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n")
}

fn xml(head: &str, code: &str) -> String {
    let wall = "<Row>KSK  KSK</Row>";
    format!(
        "<House>{head}<Storey><Row><Part code='{code}'/>KSK</Row>{wall}{wall}{wall}</Storey></House>"
    )
}

fn parts(entries: &str) -> String {
    format!("<Catalog>{entries}</Catalog>")
}
