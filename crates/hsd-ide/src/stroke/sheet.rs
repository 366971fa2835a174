//! A source file as a sheet to draw on: the cells of each wall's line, and those that a stroke may change.
//!
//! A [`Cell`] can be changed independently: a code, a `Part`, a `repeat` of one code. Everything else that makes parts is
//! a block, which may be kept, moved or removed as a whole. Cells stand in the order of the file; comments, line breaks
//! and blanks between them belong to no cell.

mod cells;
pub(crate) mod doubts;
pub(crate) mod first_line;
mod reason;
pub(crate) mod standing;

pub(crate) use reason::Reason;

use crate::Analysis;
use hsd_base::source::{FileId, Span};
use hsd_ir::building::{Ring, Wall};
use hsd_syntax::parse::syntax::LineKind;
use hsd_syntax::parse::syntax::{Element, Outline};
use std::collections::BTreeSet;
use std::ops::Range;

/// The place of a wall's line in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Home {
    /// A line of the legacy form.
    Line(usize),
    /// A `Row` or `Floor`.
    Element(usize),
}

/// The form in which a cell is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form {
    /// A code in its columns.
    Code,
    /// A `Part`.
    Part(usize),
    /// A `repeat` of plain parts: the range of its number, and the number.
    Run(Range<usize>, u32),
    /// Anything else.
    Block,
}

/// The content of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum What {
    /// A void: the walk continues without a wall.
    Void,
    /// A part without a width.
    Post,
    /// A wall of the storey's height.
    Plain,
    /// An opening, or anything else.
    Other,
}

/// A piece of the line of a wall.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    /// Its range in the file.
    pub(crate) range: Range<usize>,
    /// Its form.
    pub(crate) form: Form,
    /// The kind of content it produces.
    pub(crate) what: What,
    /// Its code as understood, without blanks at its end; empty for blocks.
    pub(crate) code: String,
    /// Its width in U.
    pub(crate) width: f64,
    /// The units of the wall that it makes.
    pub(crate) units: Range<usize>,
    /// True if something else changes the content as written.
    pub(crate) altered: bool,
    /// The parts of one round of a `repeat`.
    pub(crate) inner: Vec<Inner>,
}

/// A part in a `repeat`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Inner {
    /// Its code.
    pub(crate) code: String,
    /// The kind.
    pub(crate) what: What,
    /// Its width in U.
    pub(crate) width: f64,
}

/// The line of a wall.
#[derive(Clone, Debug)]
pub(crate) struct SheetRow {
    /// Its place.
    pub(crate) home: Home,
    /// Its cells, in the order of the file.
    pub(crate) cells: Vec<Cell>,
    /// True if the cells run against the walk.
    pub(crate) rightwards: bool,
    /// The reason why none of it may be changed.
    pub(crate) fixed: Option<Reason>,
}

impl SheetRow {
    /// Returns the reason why a unit cannot be replaced.
    pub(crate) fn unit_fixed(&self, unit: usize) -> Option<Reason> {
        let cell = self.cell_of(unit);
        let own = match cell.map(|c| &self.cells[c]) {
            None => Some(Reason::Computed),
            Some(cell) if cell.form == Form::Block || cell.altered => Some(Reason::Computed),
            Some(_) => None,
        };
        self.fixed.or(own)
    }

    /// Returns the same for all units of its wall.
    pub(crate) fn units_fixed(&self, count: usize) -> Vec<Option<Reason>> {
        let mut all = vec![self.fixed.or(Some(Reason::Computed)); count];
        for cell in &self.cells {
            let computed = cell.form == Form::Block || cell.altered;
            let own = self.fixed.or(computed.then_some(Reason::Computed));
            all.iter_mut()
                .take(cell.units.end)
                .skip(cell.units.start)
                .for_each(|r| *r = own);
        }
        all
    }

    /// Returns the number of leading voids, which lead to the start of the walk.
    pub(crate) fn leads(&self) -> usize {
        let lead = |c: &&Cell| c.units.is_empty() && c.form == Form::Code;
        self.cells.iter().take_while(lead).count()
    }

    /// Returns the cell that makes a unit.
    pub(crate) fn cell_of(&self, unit: usize) -> Option<usize> {
        self.cells.iter().position(|c| c.units.contains(&unit))
    }
}

/// A source file to draw on.
pub(crate) struct Sheet<'a> {
    pub(crate) a: &'a Analysis,
    pub(crate) text: &'a str,
    pub(crate) outline: &'a Outline,
    /// Names of floors that take their parts from another one of the same name.
    borrowing: BTreeSet<&'a str>,
}

impl<'a> Sheet<'a> {
    /// Creates the sheet of a source file.
    pub(crate) fn of(a: &'a Analysis) -> Sheet<'a> {
        let outline = a.outline();
        let mut owns = vec![false; outline.elements.len()];
        for element in &outline.elements {
            let part = matches!(
                name(element),
                "Part" | "split" | "repeat" | "Row" | "use" | "if"
            );
            if let Some(parent) = element.parent.filter(|_| part) {
                owns[parent] = true;
            }
        }
        let floors = outline.elements.iter().zip(owns);
        let bare = floors.filter(|(e, owns)| name(e) == "Floor" && !owns && e.words.is_empty());
        let borrowing = bare.filter_map(|(e, _)| e.value("id")).collect();
        let text = a.text();
        Sheet {
            a,
            text,
            outline,
            borrowing,
        }
    }

    /// Returns the line of a wall.
    pub(crate) fn row(&self, wall: &Wall) -> SheetRow {
        let fixed = |reason| SheetRow {
            home: Home::Line(usize::MAX),
            cells: vec![],
            rightwards: false,
            fixed: Some(reason),
        };
        if wall.span.file != FileId(0) {
            return fixed(Reason::Include);
        }
        let place = self.a.source.text_range(wall.span);
        let mut row = match self.home(&place) {
            Some(Home::Line(line)) => self.line(line),
            Some(Home::Element(element)) => self.element(element),
            None => return fixed(self.made_by(place.start)),
        };
        let matched = self.match_units(&mut row, wall);
        row.fixed = row.fixed.or(matched.err());
        if row.fixed.is_none() && self.has_mistakes(wall.span) {
            row.fixed = Some(Reason::Mistakes);
        }
        row
    }

    /// Returns the lines of the walls of a ring.
    pub(crate) fn rows(&self, ring: &Ring) -> Vec<SheetRow> {
        ring.walls.iter().map(|w| self.row(w)).collect()
    }

    /// Returns the reason why a wall of a ring cannot be moved.
    pub(crate) fn ring_fixed(&self, ring: &Ring, rows: &[SheetRow], wall: usize) -> Option<Reason> {
        let count = rows.len();
        if ring.is_lone_wall() && !ring.walls[wall].units.is_empty() {
            return rows[wall].fixed.or_else(|| self.start_fixed(&rows[0]));
        }
        if !ring.closed || count < 4 {
            return Some(Reason::Open);
        }
        let (before, after) = ((wall + count - 1) % count, (wall + 1) % count);
        let beside = [before, after].into_iter();
        let fixed = beside.clone().find_map(|w| rows[w].fixed);
        let own = rows[wall]
            .fixed
            .filter(|r| matches!(r, Reason::Include | Reason::Monument | Reason::Outline));
        let right = |w: usize| {
            ring.walls[w]
                .direction
                .dot(ring.walls[wall].direction)
                .abs()
                < 1e-9
        };
        let slanted = (!beside.clone().all(right)).then_some(Reason::Slanted);
        let reset = wall == 0 || after == 0;
        fixed
            .or(own)
            .or(slanted)
            .or_else(|| self.structure_fixed(&rows[wall], reset))
            .or_else(|| {
                if reset {
                    self.start_fixed(&rows[0])
                } else {
                    None
                }
            })
            .or_else(|| {
                let corners = [before, wall].into_iter();
                let bent = |w: usize| w + 1 < count && self.is_bent(rows[w].home, rows[w + 1].home);
                corners.clone().any(bent).then_some(Reason::Corner)
            })
    }

    /// Returns the reason why a wall of facades cannot be moved: it has a width of its own, or is at the start of the
    /// walk.
    fn structure_fixed(&self, row: &SheetRow, reset: bool) -> Option<Reason> {
        let element = self.floor(row)?;
        let elements = &self.outline.elements;
        let mut around = self.outline.around(element).map(|e| &elements[e]);
        let says = |e: &Element| e.value("ratio").is_some() || e.value("size").is_some();
        if around.any(says) {
            return Some(Reason::Scaled);
        }
        reset.then_some(Reason::First)
    }

    /// Returns the `Floor` of a facade that contains a line.
    pub(crate) fn floor(&self, row: &SheetRow) -> Option<usize> {
        match row.home {
            Home::Element(e) if name(&self.outline.elements[e]) == "Floor" => Some(e),
            _ => None,
        }
    }

    /// Returns the reason why a walk cannot begin elsewhere.
    fn start_fixed(&self, first: &SheetRow) -> Option<Reason> {
        let Home::Element(element) = first.home else {
            return first.fixed;
        };
        let elements = &self.outline.elements;
        let mut around = self.outline.around(element).skip(1);
        let owner = around.find(|e| matches!(name(&elements[*e]), "Storey" | "Loop"))?;
        let computed = elements[owner].attribute("start")?.expressions.first();
        computed.map(|_| Reason::Computed)
    }

    /// Returns true if other lines lie between those of two walls.
    fn is_bent(&self, one: Home, other: Home) -> bool {
        match (one, other) {
            (Home::Line(one), Home::Line(other)) => {
                let between = self.outline.lines.get(one + 1..other).unwrap_or_default();
                other < one || between.iter().any(|l| l.kind == LineKind::Wall)
            }
            (Home::Element(one), Home::Element(other)) => {
                let elements = &self.outline.elements;
                // A floor stands in its facade.
                let line = |e: usize| match name(&elements[e]) {
                    "Floor" => elements[e].parent.unwrap_or(e),
                    _ => e,
                };
                let (one, other) = (line(one), line(other));
                let end = elements[one].range.end;
                let between = elements.get(one + 1..other).unwrap_or_default();
                let row = |e: &Element| {
                    let makes = matches!(
                        name(e),
                        "Row" | "Facade" | "use" | "repeat" | "if" | "else" | ""
                    );
                    e.range.start >= end && makes
                };
                other < one
                    || elements[one].parent != elements[other].parent
                    || between.iter().any(row)
            }
            _ => true,
        }
    }

    fn home(&self, place: &Range<usize>) -> Option<Home> {
        if let Some(line) = self.outline.line_at(place.start) {
            let wall = self.outline.lines[line].kind == LineKind::Wall;
            return wall.then_some(Home::Line(line));
        }
        let element = self.outline.element_at(place.start)?;
        let own = &self.outline.elements[element];
        let row = own.range.start == place.start && matches!(name(own), "Row" | "Floor");
        row.then_some(Home::Element(element))
    }

    /// Returns the reason why what comes from no line cannot be changed: the element here that it comes from.
    pub(crate) fn made_by(&self, at: usize) -> Reason {
        let element = self.outline.element_at(at);
        match element.map(|e| name(&self.outline.elements[e])) {
            Some("Outline" | "Hole" | "Walls" | "Side") => Reason::Outline,
            _ => Reason::Monument,
        }
    }

    /// Returns true if the line has reported syntax errors. Full-width characters are read as their plain equivalents.
    fn has_mistakes(&self, span: Span) -> bool {
        let all = &self.a.diagnostics;
        let key = |s: Span| (s.file, s.start);
        let from = all.partition_point(|d| d.span().is_some_and(|s| key(s) < key(span)));
        let touches = |s: Span| s.file == span.file && s.start <= span.end;
        let here = all[from..].iter();
        let here = here.take_while(|d| d.span().is_some_and(touches));
        let wrong =
            |code: u16| matches!(code, 101 | 124..=127 | 130..=132 | 134 | 136..=139 | 200..=232);
        here.filter(|d| d.severity == hsd_base::diagnostic::Severity::Error)
            .any(|d| wrong(d.code.0))
    }

    /// Returns the reason why a stroke cannot change the content of an element, based on its ancestors up to the storey
    /// or facade.
    pub(crate) fn around_fixed(&self, element: usize) -> Option<Reason> {
        let mut around = self.outline.around(element).skip(1);
        around.find_map(|e| match name(&self.outline.elements[e]) {
            "repeat" => Some(Reason::Repeat),
            "define" | "use" => Some(Reason::Piece),
            "if" | "else" => Some(Reason::Condition),
            _ => None,
        })
    }

    /// Returns the children of an element.
    pub(crate) fn children(&self, element: usize) -> impl Iterator<Item = usize> + '_ {
        let elements = &self.outline.elements;
        let end = elements[element].range.end;
        let inside =
            (element + 1..elements.len()).take_while(move |e| elements[*e].range.start < end);
        inside.filter(move |e| elements[*e].parent == Some(element))
    }
}

/// Returns the name of an element in the language.
pub(crate) fn name(element: &Element) -> &'static str {
    element.schema.map_or("", |s| s.name)
}
