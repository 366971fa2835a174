//! The files that `include` elements refer to.

use crate::parse::names::file::{File, trimmed, word};
use std::ops::Range;

/// An `include`.
#[derive(Clone, Debug)]
pub struct Link {
    /// The including file, by number in the list of files.
    pub from: usize,
    /// Its element there.
    pub element: usize,
    /// Its path, without the quotes.
    pub range: Range<usize>,
    /// The included file.
    pub to: usize,
}

/// The links between files.
#[derive(Clone, Debug, Default)]
pub struct Links {
    /// Links in the order of the files and their elements.
    pub list: Vec<Link>,
}

impl Links {
    /// Collects the links between files.
    pub fn of(files: &[File<'_>]) -> Links {
        let mut list = vec![];
        let names: Vec<Vec<&str>> = files.iter().map(|f| steps(&[f.name])).collect();
        for (from, file) in files.iter().enumerate() {
            let elements = file.outline.elements.iter().enumerate();
            for (element, include) in elements.filter(|(_, e)| word(e) == "include") {
                let href = include
                    .attribute("href")
                    .filter(|a| a.expressions.is_empty());
                let Some(range) = href.and_then(|a| trimmed(file.text, a)) else {
                    continue;
                };
                let to = target(file.name, &file.text[range.clone()], &names);
                if let Some(to) = to {
                    list.push(Link {
                        from,
                        element,
                        range,
                        to,
                    });
                }
            }
        }
        Links { list }
    }
}

/// Returns the file that a path refers to: by its whole path or, if files have other names, the only one that ends so.
fn target(from: &str, href: &str, names: &[Vec<&str>]) -> Option<usize> {
    let folder = from.rfind(['/', '\\']).map_or("", |i| &from[..i]);
    let whole = steps(&[folder, href]);
    if let Some(found) = names.iter().position(|n| *n == whole) {
        return Some(found);
    }
    let end = steps(&[href]);
    let mut like = (1..names.len()).filter(|i| names[*i].ends_with(&end));
    let first = like.next()?;
    like.next().is_none().then_some(first)
}

/// Returns true if two paths are equal after normalization.
pub fn same(one: &str, other: &str) -> bool {
    one == other || steps(&[one]) == steps(&[other])
}

/// Returns the steps of consecutive paths, without `.` and with `..` resolved if possible.
fn steps<'p>(paths: &[&'p str]) -> Vec<&'p str> {
    let mut steps: Vec<&str> = vec![];
    for step in paths.iter().flat_map(|p| p.split(['/', '\\'])) {
        match step {
            "" | "." => {}
            ".." if steps.last().is_some_and(|s| *s != "..") => {
                steps.pop();
            }
            step => steps.push(step),
        }
    }
    steps
}
