//! Long files, whose pieces are read when their houses are needed.

use super::Options;
use hsd_base::diagnostic::{Code, Diagnostics, Origin};
use hsd_base::source::{LongFile, Source, SourceCache, Span, World};
use hsd_ir::ast::{Document, House};
use hsd_syntax::parse::{self, Before, ReadContext};
use std::collections::BTreeSet;
use std::io;
use std::sync::Arc;

/// The sources of a streamed run.
#[derive(Clone, Copy, Debug)]
pub struct Feed<'a> {
    /// All sources; for a file that is read in pieces, what it is without its houses.
    pub sources: &'a [&'a Source],
    /// Those that are read in pieces.
    pub long: &'a [Arc<LongFile>],
}

impl<'a> Feed<'a> {
    /// Creates a feed of sources that are in memory.
    pub fn whole(sources: &'a [&'a Source]) -> Feed<'a> {
        Feed { sources, long: &[] }
    }

    /// Returns the file that a source stands for, if it is read in pieces.
    pub(super) fn long(self, source: &Source) -> Option<&'a Arc<LongFile>> {
        self.long.iter().find(|file| file.id() == source.id())
    }

    /// Returns the byte before a span, and what is written there.
    pub(super) fn written(self, span: Span, included: &[Source]) -> (Option<u8>, String) {
        if let Some(file) = self.long.iter().find(|file| file.id() == span.file) {
            return file.written(span);
        }
        let mut all = self.sources.iter().copied().chain(included);
        let Some(source) = all.find(|source| source.id() == span.file) else {
            return (None, " ".to_owned());
        };
        let place = source.text_range(span);
        let text = source.text();
        let before = place.start.checked_sub(1).map(|at| text.as_bytes()[at]);
        (before, text.get(place).unwrap_or_default().to_owned())
    }

    /// Returns the first line of a span; `included` are more files that are in memory.
    pub(super) fn first_line(self, span: Span, included: &[Source]) -> Span {
        if let Some(file) = self.long.iter().find(|file| file.id() == span.file) {
            return file.first_line(span);
        }
        let mut all = self.sources.iter().copied().chain(included);
        let source = all.find(|source| source.id() == span.file);
        source.map_or(span, |source| source.first_line(span))
    }
}

/// The houses of a file, piece by piece.
pub(super) struct Pieces<'a> {
    file: Arc<LongFile>,
    next: usize,
    before: Before,
    /// The houses of the current piece.
    houses: std::vec::IntoIter<House>,
    piece: Arc<Source>,
    /// The diagnostics of the piece.
    found: Diagnostics,
    /// The diagnostics of the head of the file, which is read with every piece.
    known: BTreeSet<(Origin, Code)>,
    world: &'a dyn World,
    options: &'a Options,
}

/// A house of a piece; `None` at the end of the file, if something was found after its last house.
pub(super) struct PieceHouse {
    pub(super) house: Option<House>,
    /// Its number in its file.
    pub(super) number: u64,
    pub(super) piece: Arc<Source>,
    /// What was found when its piece was read, with the first of its houses.
    pub(super) found: Diagnostics,
}

impl<'a> Pieces<'a> {
    /// Begins to read a file.
    pub(super) fn new(
        file: &Arc<LongFile>,
        stub: &Source,
        world: &'a dyn World,
        options: &'a Options,
    ) -> Pieces<'a> {
        Pieces {
            file: file.clone(),
            next: 0,
            before: Before::default(),
            houses: vec![].into_iter(),
            piece: Arc::new(stub.clone()),
            found: Diagnostics::new(),
            known: BTreeSet::new(),
            world,
            options,
        }
    }

    /// Reads the next piece.
    fn read(&mut self) -> io::Result<()> {
        let piece = self.file.piece(self.next)?;
        self.next += 1;
        let mut found = Diagnostics::new();
        let document = read(&piece, self.before, self.world, self.options, &mut found);
        self.piece = Arc::new(piece);
        self.houses = document.houses.into_iter();
        let (file, known) = (&self.file, &mut self.known);
        self.found.append(found.filtered(|d| {
            let in_head = d.span().is_some_and(|span| file.is_in_head(span));
            !in_head || known.insert((d.origin.clone(), d.code))
        }));
        Ok(())
    }

    fn house(&mut self, house: Option<House>) -> PieceHouse {
        let number = self.before.houses;
        self.before.houses += u64::from(house.is_some());
        PieceHouse {
            house,
            number,
            piece: self.piece.clone(),
            found: std::mem::take(&mut self.found),
        }
    }
}

impl Iterator for Pieces<'_> {
    type Item = io::Result<PieceHouse>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let house = self.houses.next();
            if house.is_some() {
                return Some(Ok(self.house(house)));
            }
            if self.next >= self.file.pieces() {
                let more = !self.found.is_empty();
                return more.then(|| Ok(self.house(None)));
            }
            if let Err(error) = self.read() {
                self.next = self.file.pieces();
                return Some(Err(error));
            }
        }
    }
}

/// Reads a piece of a file, which refers to no other file.
fn read(
    piece: &Source,
    before: Before,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Document {
    let cache = SourceCache::new(0, 0, 0);
    let setting = ReadContext {
        before: Some(before),
        ..super::setting(world, options, &cache)
    };
    parse::parse_in(piece, setting, &mut parse::xml::Trees::default(), out)
}
