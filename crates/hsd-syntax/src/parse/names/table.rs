//! The symbols of source files, with the places of their definitions and uses.

use super::SymbolKind;
use super::scopes::Scopes;
use hsd_base::source::FileId;
use std::ops::Range;

/// The role of an occurrence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// The definition of the symbol.
    Declares,
    /// A use of the symbol.
    Uses,
    /// A possible use: the name is computed.
    Computed,
}

/// A name in a source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occurrence {
    /// File that contains the name.
    pub file: FileId,
    /// Bytes of the name in the file.
    pub range: Range<usize>,
    /// Number of the symbol in [`NameTable::symbols`].
    pub symbol: usize,
    /// Definition or use.
    pub role: Role,
}

/// The symbol that a name means.
#[derive(Clone, Debug)]
pub struct NamedThing {
    /// Kind of the symbol.
    pub kind: SymbolKind,
    /// Name of the symbol.
    pub name: String,
}

/// All names of a source file and of the files that were read for it.
#[derive(Clone, Debug, Default)]
pub struct NameTable {
    /// Symbols in the order in which they were found.
    pub symbols: Vec<NamedThing>,
    /// By file and place.
    pub marks: Vec<Occurrence>,
    /// The names known at each place.
    pub scopes: Scopes,
    /// The representative of each symbol, if several turned out to be the same.
    pub(super) same: Vec<usize>,
}

impl NameTable {
    pub(super) fn root(&self, mut symbol: usize) -> usize {
        while self.same[symbol] != symbol {
            symbol = self.same[symbol];
        }
        symbol
    }

    pub(super) fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.same[one.max(other)] = one.min(other);
    }

    /// Adds a symbol and returns its number.
    pub fn add(&mut self, kind: SymbolKind, name: &str) -> usize {
        self.same.push(self.symbols.len());
        self.symbols.push(NamedThing {
            kind,
            name: name.to_owned(),
        });
        self.symbols.len() - 1
    }

    /// Returns the occurrences at an offset, those with the shortest range.
    pub fn at(&self, file: FileId, at: usize) -> impl Iterator<Item = &Occurrence> {
        let touches = move |m: &&Occurrence| m.range.start <= at && at <= m.range.end;
        let marks = self.in_file(file).iter().filter(touches);
        // Between two names the one that begins here counts.
        let better =
            move |m: &&Occurrence| (m.range.end == at && m.range.start < at, m.range.len());
        let best = marks.clone().map(|m| better(&m)).min();
        marks.filter(move |m| Some(better(m)) == best)
    }

    /// Returns the occurrences of a symbol.
    pub fn of_symbol(&self, symbol: usize) -> impl Iterator<Item = &Occurrence> {
        self.marks.iter().filter(move |m| m.symbol == symbol)
    }

    fn in_file(&self, file: FileId) -> &[Occurrence] {
        let start = self.marks.partition_point(|m| m.file < file);
        let end = self.marks.partition_point(|m| m.file <= file);
        &self.marks[start..end]
    }
}
