//! The codes of parts: their places, and the custom part that each of them means.
//!
//! A code means the part known in its house: one of the house itself, of its file, of files named on the command line,
//! of the file beside the source file, and finally the built-in one (see [`catalog`](hsd_ir::catalog)).

use crate::parse::names::file::{File, word};
use crate::parse::names::links::Links;
use crate::parse::syntax::{Attribute, Element, Outline};
use hsd_base::source::FileId;
use hsd_ir::ast::CodeText;
use std::ops::Range;

/// The syntactic form of a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CodeForm {
    /// Five columns of a wall line; shorter if blanks at its end were left out.
    Columns,
    /// Text of an attribute or an expression.
    Value,
    /// The code of a `PartDef`.
    Part,
    /// The base of a `PartDef`.
    Base,
    /// An image that a `Texture` names, with a file of its own.
    Picture,
    /// The image that a `PartDef` shows.
    Shown,
    /// A value that may be a code: of a `let`, a parameter, a quoted string.
    Perhaps,
}

/// A code in a source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CodeOccurrence {
    /// The number of the file in the list of files.
    pub file: usize,
    /// Bytes of the code in its file.
    pub range: Range<usize>,
    /// Number of the element that contains the code; `None` in the legacy form.
    pub element: Option<usize>,
    /// Syntactic form.
    pub form: CodeForm,
}

/// The definition of a part or image in a source file, at its code.
pub type Site = CodeOccurrence;

/// The tables in which codes of a source file are looked up.
pub struct Codes<'a> {
    /// Source files; the first is the one that was asked about.
    pub files: &'a [File<'a>],
    sites: Vec<Site>,
    /// For each file the houses in which its parts are known; `None` = in all of them.
    homes: Vec<Option<Vec<usize>>>,
    /// The files that are read without being included: first those named on the command line, then the one beside the
    /// source file.
    given: usize,
}

/// Returns a code without its padding blanks.
pub fn key(code: &str) -> &str {
    code.trim()
}

impl<'a> Codes<'a> {
    /// Collects the definitions of source files. This many of them after the first are named on the command line.
    pub fn of(files: &'a [File<'a>], links: &Links, given: usize) -> Codes<'a> {
        let mut sites = vec![];
        for number in 0..files.len() {
            for element in 0..files[number].outline.elements.len() {
                let name = word(&files[number].outline.elements[element]);
                if matches!(name, "PartDef" | "Texture") {
                    let of = &mut |spot: CodeOccurrence| {
                        if matches!(spot.form, CodeForm::Part | CodeForm::Picture) {
                            sites.push(spot);
                        }
                    };
                    spots_of_element(files, number, element, of);
                }
            }
        }
        let mut codes = Codes {
            files,
            sites,
            homes: vec![Some(vec![]); files.len()],
            given,
        };
        codes.homes[0] = None;
        for link in links.list.iter().filter(|l| l.from == 0) {
            let house = codes.house(0, Some(link.element));
            codes.known_in(link.to, house, links);
        }
        codes
    }

    /// Records that a file and those it includes are known in a house, or everywhere.
    fn known_in(&mut self, file: usize, house: Option<usize>, links: &Links) {
        match (&mut self.homes[file], house) {
            (None, _) => return,
            (Some(houses), Some(house)) if houses.contains(&house) => return,
            (Some(houses), Some(house)) => houses.push(house),
            (homes, None) => *homes = None,
        }
        for link in links.list.iter().filter(|l| l.from == file) {
            self.known_in(link.to, house, links);
        }
    }

    /// Returns the text of a code.
    pub fn text(&self, spot: &CodeOccurrence) -> &'a str {
        &self.files[spot.file].text[spot.range.clone()]
    }

    /// Returns the house around an element.
    fn house(&self, file: usize, element: Option<usize>) -> Option<usize> {
        let outline = self.files[file].outline;
        let mut around = outline.around(element?);
        around.find(|e| word(&outline.elements[*e]) == "House")
    }

    /// Returns the part or image that a code means; `None` = a built-in one, or none at all.
    pub fn meaning(&self, spot: &CodeOccurrence) -> Option<&Site> {
        if spot.form == CodeForm::Part || spot.form == CodeForm::Picture {
            return self.sites.iter().find(|s| *s == spot);
        }
        let key = key(self.text(spot));
        let house = self.house(spot.file, spot.element);
        let itself = |s: &Site| {
            spot.form == CodeForm::Base && s.file == spot.file && s.element == spot.element
        };
        let of = |form: CodeForm| {
            let like = self.sites.iter().enumerate();
            let like = like.filter(move |(_, s)| {
                s.form == form && crate::parse::names::codes::key(self.text(s)) == key
            });
            like.filter(|(_, s)| !itself(s))
                .min_by_key(|(number, s)| (self.distance(s, spot.file, house), *number))
                .map(|(_, s)| s)
        };
        match spot.form {
            CodeForm::Shown => of(CodeForm::Picture),
            _ => of(CodeForm::Part).or_else(|| {
                let known = crate::parse::builtin().find(&CodeText::new(key)).is_some();
                of(CodeForm::Picture).filter(|_| !known)
            }),
        }
    }

    /// Returns the rank of a definition for a house of a file, the nearest first.
    fn distance(&self, site: &Site, file: usize, house: Option<usize>) -> usize {
        if file != 0 {
            // A definition means what the house that uses it knows; parts are based on those of their file.
            return usize::from(site.file != file);
        }
        let own = self.house(site.file, site.element);
        let beside = self.files.len();
        match (&self.homes[site.file], site.file) {
            (_, 0) if own.is_some() && own == house => 0,
            (Some(houses), _) if house.is_some_and(|h| houses.contains(&h)) => 1,
            (_, 0) if own.is_none() => 2,
            (None, _) => 3,
            (Some(houses), file) if houses.is_empty() && file <= self.given => {
                4 + self.given - file
            }
            (Some(houses), _) if houses.is_empty() => 5 + beside,
            _ => 6 + beside,
        }
    }

    /// Returns all codes of all files that mean the same as one of them, itself included.
    pub fn alike(&self, code: &str, meaning: Option<&Site>) -> Vec<CodeOccurrence> {
        let mut found = vec![];
        for number in 0..self.files.len() {
            self.each(number, &mut |spot| {
                let same = key(self.text(&spot)) == key(code);
                if same && self.meaning(&spot) == meaning {
                    found.push(spot);
                }
            });
        }
        found.sort_by_key(|s| (s.file, s.range.start));
        found.dedup_by_key(|s| (s.file, s.range.start));
        found
    }

    /// Returns the code at an offset of a file.
    pub fn at(&self, file: usize, at: usize) -> Option<CodeOccurrence> {
        let outline = self.files[file].outline;
        let mut found: Option<CodeOccurrence> = None;
        let mut take = |spot: CodeOccurrence| {
            // Between two codes the one that begins here counts.
            let behind = spot.range.end == at && found.is_some();
            if spot.range.start <= at && at <= spot.range.end && !behind {
                found = Some(spot);
            }
        };
        if let Some(element) = outline.element_at(at) {
            // At the end of a tag the text after it may begin.
            let outer = outline.elements[element].parent;
            for element in [Some(element), outer].into_iter().flatten() {
                spots_of_element(self.files, file, element, &mut take);
            }
        } else if let Some(line) = outline.line_at(at) {
            spots_of_line(self.files, file, line, &mut take);
        }
        found.filter(|s| !key(self.text(s)).is_empty())
    }

    /// Visits every code of a file.
    pub fn each(&self, file: usize, take: &mut dyn FnMut(CodeOccurrence)) {
        let outline = self.files[file].outline;
        for line in 0..outline.lines.len() {
            spots_of_line(self.files, file, line, take);
        }
        for element in 0..outline.elements.len() {
            spots_of_element(self.files, file, element, take);
        }
    }

    /// Returns the number of a file.
    pub fn number(&self, file: FileId) -> Option<usize> {
        self.files.iter().position(|f| f.id == file)
    }
}

fn spots_of_line(
    files: &[File<'_>],
    file: usize,
    line: usize,
    take: &mut dyn FnMut(CodeOccurrence),
) {
    for range in &files[file].outline.lines[line].codes {
        take(CodeOccurrence {
            file,
            range: range.clone(),
            element: None,
            form: CodeForm::Columns,
        });
    }
}

fn spots_of_element(
    files: &[File<'_>],
    file: usize,
    number: usize,
    take: &mut dyn FnMut(CodeOccurrence),
) {
    let File { text, outline, .. } = files[file];
    of_element(text, outline, number, &mut |range, form| {
        take(CodeOccurrence {
            file,
            range,
            element: Some(number),
            form,
        });
    });
}

/// Visits the codes of an element, those of its attributes and those directly in it.
pub fn of_element(
    text: &str,
    outline: &Outline,
    number: usize,
    take: &mut dyn FnMut(Range<usize>, CodeForm),
) {
    let element = &outline.elements[number];
    for words in &element.words {
        words
            .codes
            .iter()
            .for_each(|c| take(c.clone(), CodeForm::Columns));
        let expressions = words.expressions.iter();
        let quoted = expressions.flat_map(|e| quoted(text, &e.range));
        quoted.for_each(|range| take(range, CodeForm::Perhaps));
    }
    for attribute in &element.attributes {
        let Some(form) = form(element, attribute) else {
            continue;
        };
        if text.get(attribute.inner.clone()) != Some(&attribute.value) {
            continue;
        }
        let expressions = &attribute.expressions;
        let inside = expressions.iter().flat_map(|e| quoted(text, &e.range));
        inside.for_each(|range| take(range, CodeForm::Perhaps));
        if expressions.is_empty() {
            let single = matches!(form, CodeForm::Part | CodeForm::Base | CodeForm::Shown)
                || word(element) == "Part";
            let pieces = pieces(text, &attribute.inner, single);
            pieces.into_iter().for_each(|range| take(range, form));
        }
    }
}

/// Returns the form of codes in an attribute of an element.
fn form(element: &Element, attribute: &Attribute) -> Option<CodeForm> {
    let form = match (word(element), &*attribute.word) {
        ("PartDef", "code") => CodeForm::Part,
        ("PartDef", "base") => CodeForm::Base,
        ("PartDef", "texture") => CodeForm::Shown,
        ("Texture", "code") if element.attribute("src").is_some() => CodeForm::Picture,
        ("Part" | "Texture" | "random" | "replace", "code") | ("replace", "with") => {
            CodeForm::Value
        }
        ("use" | "define", "name") => return None,
        ("use" | "define", _) | ("let", "value") | ("Param", "default" | "choices") => {
            CodeForm::Perhaps
        }
        _ if attribute.expressions.is_empty() => return None,
        _ => CodeForm::Perhaps,
    };
    Some(form)
}

/// Returns the quoted strings in an expression, without their quotes.
fn quoted(text: &str, range: &Range<usize>) -> Vec<Range<usize>> {
    let (mut found, mut at) = (vec![], range.start);
    let text = &text[..range.end];
    while let Some(open) = text[at..].find(['\'', '"']).map(|i| at + i) {
        let quote = &text[open..=open];
        let Some(close) = text[open + 1..].find(quote).map(|i| open + 1 + i) else {
            break;
        };
        found.extend(trim(text, open + 1..close));
        at = close + 1;
    }
    found
}

/// Returns the pieces of a list of codes; a single one may contain blanks.
fn pieces(text: &str, range: &Range<usize>, single: bool) -> Vec<Range<usize>> {
    let written = &text[range.clone()];
    let known = |code: &str| crate::parse::builtin().find(&CodeText::new(code)).is_some();
    // `GDE 2` is one code, custom ones of this form as well.
    let one = |code: &str| {
        known(code) || (code.len() == 5 && code.is_ascii() && !code[..4].trim_end().contains(' '))
    };
    if single || (!written.contains(',') && one(written.trim())) {
        return Vec::from_iter(trim(text, range.clone()));
    }
    let comma = written.contains(',');
    let divides = |c: char| {
        if comma {
            c == ','
        } else {
            c.is_ascii_whitespace()
        }
    };
    let mut at = range.start;
    let pieces = written.split(divides).filter_map(|piece| {
        let start = at;
        at += piece.len() + 1;
        trim(text, start..start + piece.len())
    });
    pieces.collect()
}

/// Returns a range without the white space at its ends; `None` if nothing is left.
fn trim(text: &str, range: Range<usize>) -> Option<Range<usize>> {
    let written = &text[range.clone()];
    let start = range.start + written.len() - written.trim_start().len();
    let inner = start..start + written.trim().len();
    (!inner.is_empty()).then_some(inner)
}
