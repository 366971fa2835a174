//! Definition, references and rename, read from the table of [`names`](hsd_syntax::parse::names) of a source file and the files
//! that it includes.
//!
//! | file | answers |
//! |---|---|
//! | `known` | the values and definitions known at a place |
//! | `rename` | the edits of a rename, and whether it is allowed |

mod known;
mod rename;

pub use rename::{Change, prepare_rename, rename, rename_symbol};

use super::{Analysis, SourcePlace};
use hsd_ir::ast::CodeText;
use hsd_syntax::parse;
pub use hsd_syntax::parse::names::SymbolKind;
pub(super) use hsd_syntax::parse::names::codes::{CodeForm, of_element as codes_of_element};
pub(super) use hsd_syntax::parse::names::file::word;
pub(super) use known::{KnownName, parameters, pieces, values};

use hsd_syntax::parse::names::codes::{CodeOccurrence, Codes};
use hsd_syntax::parse::names::file::File;
use hsd_syntax::parse::names::links::{self, Links};
use hsd_syntax::parse::names::resolve;
use hsd_syntax::parse::names::table::{NameTable, NamedThing, Occurrence, Role};
use std::ops::Range;

/// A named symbol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// The kind.
    pub kind: SymbolKind,
    /// Its name; a code with its padding.
    pub name: String,
    /// The file that defines it, by name, and the range in its text; `None` = it is built in, or undefined.
    pub defined: Option<(String, Range<usize>)>,
}

/// The names of a source file, computed once.
#[derive(Debug)]
pub(super) struct Names {
    links: Links,
    index: NameTable,
}

/// The symbol at an offset.
enum Found {
    /// Names; several if one is computed.
    Names(Vec<Occurrence>),
    /// A code.
    Code(CodeOccurrence),
}

impl Analysis {
    /// Returns the file and the files that it includes.
    fn files(&self) -> Vec<File<'_>> {
        let included = self.checked.included.iter().zip(self.outlines());
        let all = std::iter::once((&self.source, self.outline())).chain(included);
        all.map(|(source, outline)| File {
            id: source.id(),
            name: source.name(),
            text: source.text(),
            outline,
        })
        .collect()
    }

    fn names(&self, files: &[File<'_>]) -> &Names {
        self.names.get_or_init(|| {
            let links = Links::of(files);
            let index = resolve(files, &links);
            Names { links, index }
        })
    }

    fn codes<'a>(&self, files: &'a [File<'a>]) -> Codes<'a> {
        let given = self.options.catalogs.len();
        Codes::of(files, &self.names(files).links, given)
    }

    /// Returns the symbol at an offset of the file.
    fn found(&self, files: &[File<'_>], codes: &Codes<'_>, at: usize) -> Option<Found> {
        let marks = self.names(files).index.at(self.source.id(), at);
        let marks: Vec<Occurrence> = marks.cloned().collect();
        if !marks.is_empty() {
            return Some(Found::Names(marks));
        }
        let spot = codes.at(0, at)?;
        let known = |code: &str| parse::builtin().find(&CodeText::new(code)).is_some();
        let sure = spot.form != CodeForm::Perhaps
            || known(codes.text(&spot).trim())
            || codes.meaning(&spot).is_some();
        sure.then_some(Found::Code(spot))
    }
}

fn place_of_mark(mark: &Occurrence) -> SourcePlace {
    SourcePlace {
        file: mark.file,
        range: mark.range.clone(),
    }
}

fn place_of_spot(codes: &Codes<'_>, spot: &CodeOccurrence) -> SourcePlace {
    SourcePlace {
        file: codes.files[spot.file].id,
        range: spot.range.clone(),
    }
}

/// Returns the symbol at an offset.
pub fn symbol_at(a: &Analysis, at: usize) -> Option<Symbol> {
    let files = a.files();
    let codes = a.codes(&files);
    match a.found(&files, &codes, at)? {
        Found::Names(marks) => {
            let index = &a.names(&files).index;
            let symbol = marks.first()?.symbol;
            let declared = index.of_symbol(symbol).find(|m| m.role == Role::Declares);
            let named = &index.symbols[symbol];
            let file = |m: &Occurrence| files.iter().find(|f| f.id == m.file);
            let defined = declared.and_then(|m| Some((file(m)?.name.to_owned(), m.range.clone())));
            let to_itself = (named.kind == SymbolKind::File).then(|| (named.name.clone(), 0..0));
            Some(Symbol {
                kind: named.kind,
                name: named.name.clone(),
                defined: defined.or(to_itself),
            })
        }
        Found::Code(spot) => {
            let site = codes.meaning(&spot);
            let picture = site.is_some_and(|s| s.form == CodeForm::Picture);
            let kind = match picture {
                true => SymbolKind::Picture,
                false => SymbolKind::Part,
            };
            let name = CodeText::new(codes.text(&spot).trim()).as_str().to_owned();
            let defined = site.map(|s| (files[s.file].name.to_owned(), s.range.clone()));
            Some(Symbol {
                kind,
                name,
                defined,
            })
        }
    }
}

/// Returns the places that define the symbol at an offset.
pub fn definition(a: &Analysis, at: usize) -> Vec<SourcePlace> {
    let files = a.files();
    let codes = a.codes(&files);
    let index = &a.names(&files).index;
    match a.found(&files, &codes, at) {
        None => vec![],
        Some(Found::Code(spot)) => {
            let site = codes.meaning(&spot);
            site.map(|s| place_of_spot(&codes, s)).into_iter().collect()
        }
        Some(Found::Names(marks)) => {
            let mut places = vec![];
            for mark in &marks {
                let named = &index.symbols[mark.symbol];
                if named.kind == SymbolKind::File {
                    let target = files.iter().find(|f| f.name == named.name);
                    places.extend(target.map(|f| SourcePlace {
                        file: f.id,
                        range: 0..0,
                    }));
                }
                let all = index.of_symbol(mark.symbol);
                let declared = all.filter(|m| m.role == Role::Declares);
                places.extend(declared.map(place_of_mark));
            }
            places.dedup();
            places
        }
    }
}

/// Returns the places that use the symbol at an offset, in this file and the files that were read for it.
pub fn references(a: &Analysis, at: usize, with_declaration: bool) -> Vec<SourcePlace> {
    let found = occurrences(a, at).into_iter();
    let kept = found.filter(|(_, declares)| with_declaration || !declares);
    kept.map(|(place, _)| place).collect()
}

/// Returns the places of the symbol at an offset in this file, and for each whether it is its definition.
pub fn highlights(a: &Analysis, at: usize) -> Vec<(Range<usize>, bool)> {
    let found = occurrences(a, at).into_iter();
    let here = found.filter(|(place, _)| place.file == a.source.id());
    here.map(|(place, declares)| (place.range, declares))
        .collect()
}

/// Returns all places of the symbol at an offset, and for each whether it is its definition.
fn occurrences(a: &Analysis, at: usize) -> Vec<(SourcePlace, bool)> {
    let files = a.files();
    let codes = a.codes(&files);
    let index = &a.names(&files).index;
    match a.found(&files, &codes, at) {
        None => vec![],
        Some(Found::Code(spot)) => spots_like(&codes, &spot),
        Some(Found::Names(marks)) => {
            let mut symbols: Vec<usize> = marks.iter().map(|m| m.symbol).collect();
            symbols.dedup();
            let all = symbols.iter().flat_map(|s| index.of_symbol(*s));
            all.map(|m| (place_of_mark(m), m.role == Role::Declares))
                .collect()
        }
    }
}

fn spots_like(codes: &Codes<'_>, spot: &CodeOccurrence) -> Vec<(SourcePlace, bool)> {
    let alike = codes.alike(codes.text(spot), codes.meaning(spot));
    let declares = |s: &CodeOccurrence| matches!(s.form, CodeForm::Part | CodeForm::Picture);
    alike
        .iter()
        .map(|s| (place_of_spot(codes, s), declares(s)))
        .collect()
}

/// Returns the uses of a symbol that another file may define.
pub fn uses_of(a: &Analysis, symbol: &Symbol) -> Vec<SourcePlace> {
    let files = a.files();
    let codes = a.codes(&files);
    let uses = match target(a, &files, &codes, symbol) {
        None => vec![],
        Some(Target::Name(symbol)) => {
            let all = a.names(&files).index.of_symbol(symbol);
            all.map(|m| (place_of_mark(m), m.role == Role::Declares))
                .collect()
        }
        Some(Target::Code(site)) => spots_like(&codes, &site),
        Some(Target::Builtin) => {
            let alike = codes.alike(&symbol.name, None).into_iter();
            alike.map(|s| (place_of_spot(&codes, &s), false)).collect()
        }
    };
    let used = uses.into_iter().filter(|(_, declares)| !declares);
    used.map(|(place, _)| place).collect()
}

/// The meaning of a symbol in these files.
enum Target {
    /// A name, by its number in the index.
    Name(usize),
    /// A custom part, or an image.
    Code(CodeOccurrence),
    /// A built-in part.
    Builtin,
}

fn target(a: &Analysis, files: &[File<'_>], codes: &Codes<'_>, symbol: &Symbol) -> Option<Target> {
    let index = &a.names(files).index;
    let is_code = matches!(symbol.kind, SymbolKind::Part | SymbolKind::Picture);
    let Some((path, range)) = &symbol.defined else {
        return is_code.then_some(Target::Builtin);
    };
    let file = files.iter().find(|f| links::same(f.name, path))?;
    if is_code {
        let spot = codes.at(codes.number(file.id)?, range.start)?;
        let site = codes.meaning(&spot)?;
        return (site.range == *range).then(|| Target::Code(site.clone()));
    }
    if symbol.kind == SymbolKind::File {
        let is_it = |n: &NamedThing| n.kind == SymbolKind::File && n.name == file.name;
        return index.symbols.iter().position(is_it).map(Target::Name);
    }
    let mut marks = index.at(file.id, range.start);
    let mark = marks.find(|m| m.role == Role::Declares && m.range == *range)?;
    let same = index.symbols[mark.symbol].kind == symbol.kind;
    same.then_some(Target::Name(mark.symbol))
}
