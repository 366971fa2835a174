//! The cells of a line, and the units of its wall that each of them makes.

use crate::stroke::sheet::{Cell, Form, Home, Inner, Reason, Sheet, SheetRow, What, name};
use hsd_base::geometry::SAME;
use hsd_base::source::FileId;
use hsd_ir::ast::CodeText;
use hsd_ir::building::Wall;
use hsd_ir::catalog::Stance;
use hsd_ir::program::{Content, Unit};
use hsd_syntax::parse::syntax::Words;
use std::ops::Range;

impl Sheet<'_> {
    /// Reads a line of the legacy form.
    pub(super) fn line(&self, number: usize) -> SheetRow {
        let line = &self.outline.lines[number];
        let mut cells: Vec<Cell> = line
            .codes
            .iter()
            .map(|c| cell(c.clone(), Form::Code))
            .collect();
        cells.sort_by_key(|c| c.range.start);
        let end = cells.last().map_or(line.range.start, |c| c.range.end);
        let end = line.turn.as_ref().map_or(end, |t| t.end.max(end));
        let rest = self.text.get(end..line.range.end).unwrap_or_default();
        let fixed = (!rest.trim().is_empty()).then_some(Reason::Mistakes);
        SheetRow {
            home: Home::Line(number),
            cells,
            rightwards: false,
            fixed,
        }
    }

    /// Reads a `Row` or `Floor`.
    pub(super) fn element(&self, element: usize) -> SheetRow {
        let mut cells = vec![];
        let piece = self.gather(element, &mut cells);
        cells.sort_by_key(|c| c.range.start);
        let own = &self.outline.elements[element];
        let is_floor = name(own) == "Floor";
        let shared = is_floor
            && own
                .value("id")
                .is_some_and(|id| self.borrowing.contains(id));
        let borrowed = is_floor && cells.is_empty();
        let fixed = self.around_fixed(element).or(piece);
        let fixed = fixed.or(borrowed.then_some(Reason::Borrowed));
        SheetRow {
            home: Home::Element(element),
            cells,
            rightwards: is_floor && self.is_rightwards(element),
            fixed: fixed.or(shared.then_some(Reason::Shared)),
        }
    }

    /// Adds the cells of an element; returns the reason why none of them may be changed.
    fn gather(&self, element: usize, cells: &mut Vec<Cell>) -> Option<Reason> {
        let mut fixed = None;
        for words in &self.outline.elements[element].words {
            self.words(words, cells);
        }
        for child in self.children(element) {
            let own = &self.outline.elements[child];
            let form = match name(own) {
                "Row" => {
                    fixed = self.gather(child, cells).or(fixed);
                    continue;
                }
                "Part" if !self.computes(child) && own.value("code").is_some() => Form::Part(child),
                "repeat" => self.run(child).unwrap_or(Form::Block),
                "use" => {
                    fixed = Some(Reason::Piece);
                    Form::Block
                }
                _ => Form::Block,
            };
            cells.push(cell(own.range.clone(), form));
        }
        fixed
    }

    fn words(&self, words: &Words, cells: &mut Vec<Cell>) {
        cells.extend(words.codes.iter().map(|c| cell(c.clone(), Form::Code)));
        let blocks = words.expressions.iter();
        cells.extend(blocks.map(|e| cell(e.range.clone(), Form::Block)));
    }

    /// Returns true if any attribute of an element is computed.
    fn computes(&self, element: usize) -> bool {
        let attributes = &self.outline.elements[element].attributes;
        attributes.iter().any(|a| !a.expressions.is_empty())
    }

    /// Returns the form of a `repeat` of parts without attributes.
    fn run(&self, element: usize) -> Option<Form> {
        let own = &self.outline.elements[element];
        let num = own.attribute("num").filter(|_| !self.computes(element))?;
        let count: u32 = num.value.trim().parse().ok()?;
        let mut cells = vec![];
        self.gather(element, &mut cells);
        let bare = |cell: &Cell| match cell.form {
            Form::Code => true,
            Form::Part(part) => self.outline.elements[part].attributes.len() == 1,
            Form::Run(..) | Form::Block => false,
        };
        let plain = !cells.is_empty() && cells.iter().all(bare) && count > 0;
        plain.then(|| Form::Run(num.inner.clone(), count))
    }

    /// Assigns to each cell the units it produces. Cells that produce unexpected units become blocks.
    pub(super) fn match_units(&self, row: &mut SheetRow, wall: &Wall) -> Result<(), Reason> {
        let whole = match row.home {
            Home::Line(_) => self.a.source.text_range(wall.span),
            Home::Element(element) => self.outline.elements[element].range.clone(),
        };
        let mut places: Vec<Option<usize>> =
            wall.units.iter().map(|u| self.within(u, &whole)).collect();
        // Units left over from lines without length belong to other lines, and have no width.
        let mut foreign = wall.units.iter().zip(&places).filter(|(_, p)| p.is_none());
        if let Some((unit, _)) = foreign.find(|(u, _)| u.width > 0.0) {
            let other = unit.span.file != FileId(0);
            return Err(if other {
                Reason::Include
            } else {
                Reason::Borrowed
            });
        }
        let (count, rightwards) = (places.len(), row.rightwards);
        if rightwards {
            places.reverse();
        }
        let mut next = places.iter().position(Option::is_some).unwrap_or(0);
        let mut started = false;
        for cell in &mut row.cells {
            let first = next;
            while places
                .get(next)
                .copied()
                .flatten()
                .is_some_and(|at| at < cell.range.end)
            {
                next += 1;
            }
            cell.units = match rightwards {
                true => count - next..count - first,
                false => first..next,
            };
            self.fill(cell, &wall.units[cell.units.clone()]);
            started |= first < next;
            // Voids before the first part leave no unit.
            let lead = !started && cell.form == Form::Code;
            if !lead && first == next && cell.form != Form::Block {
                return Err(Reason::Mistakes);
            }
        }
        let left = places[next..].iter().flatten().count();
        if left > 0 {
            Err(Reason::Mistakes)
        } else {
            Ok(())
        }
    }

    /// Returns true if the parts of a floor run to the right.
    fn is_rightwards(&self, element: usize) -> bool {
        let mut around = self.outline.around(element);
        let structure = around.find(|e| name(&self.outline.elements[*e]) == "Structure");
        structure.is_some_and(|s| self.outline.elements[s].value("order") == Some("right"))
    }

    /// Returns the range of a unit in the file, if it is within this range.
    fn within(&self, unit: &Unit, whole: &Range<usize>) -> Option<usize> {
        if unit.span.file != FileId(0) {
            return None;
        }
        let at = self.a.source.text_range(unit.span).start;
        whole.contains(&at).then_some(at)
    }

    fn fill(&self, cell: &mut Cell, units: &[Unit]) {
        cell.width = units.iter().map(|u| u.width).sum();
        let Some(first) = units.first() else {
            cell.what = What::Void;
            return;
        };
        let (rounds, parts) = match &cell.form {
            Form::Code | Form::Part(_) => (1, 1),
            Form::Run(_, count) => (*count as usize, units.len() / *count as usize),
            Form::Block => (1, units.len()),
        };
        let alike =
            |(u, v): (&Unit, &Unit)| (u.width - v.width).abs() < SAME && u.content == v.content;
        let same = units.iter().zip(units.iter().skip(parts)).all(alike);
        if units.len() != rounds * parts || parts == 0 || !same {
            cell.form = Form::Block;
        }
        if matches!(cell.form, Form::Run(..)) && parts > 1 {
            cell.inner = units[..parts].iter().map(|u| self.inner(u)).collect();
            cell.what = What::Other;
            return;
        }
        if cell.form == Form::Block {
            cell.what = if cell.width > 0.0 {
                What::Other
            } else {
                What::Post
            };
            return;
        }
        cell.what = self.what(first);
        cell.code = self.code(first);
        cell.altered = self.is_altered(cell);
    }

    fn inner(&self, unit: &Unit) -> Inner {
        Inner {
            code: self.code(unit),
            what: self.what(unit),
            width: unit.width,
        }
    }

    /// Returns the kind of content of a unit.
    pub(crate) fn what(&self, unit: &Unit) -> What {
        match &unit.content {
            Content::Void => What::Void,
            _ if unit.width <= 0.0 => What::Post,
            Content::Part(id) => {
                let part = self.a.catalog().part(*id);
                // A part with a name of its own is not a plain wall.
                let wall = part.finish.is_some() && part.from.is_none() && part.code().len() <= 5;
                match wall && part.stance != Stance::Fence {
                    true => What::Plain,
                    false => What::Other,
                }
            }
            Content::Picture(_) | Content::Split(_) => What::Other,
        }
    }

    /// Returns the code of a unit, without blanks at its end.
    pub(crate) fn code(&self, unit: &Unit) -> String {
        let pictures = &self.a.checked.building.images;
        match &unit.content {
            Content::Part(id) => self.a.catalog().part(*id).code().trim_end().to_owned(),
            Content::Picture(id) => pictures
                .get(id.0 as usize)
                .map_or(String::new(), |p| p.name.clone()),
            Content::Void => ".....".to_owned(),
            Content::Split(_) => String::new(),
        }
    }

    /// Returns true if the result differs from the written code because of a random choice or a substitution.
    fn is_altered(&self, cell: &Cell) -> bool {
        let written = match &cell.form {
            Form::Part(element) => self.outline.elements[*element].value("code"),
            Form::Code => self.text.get(cell.range.clone()),
            _ => None,
        };
        let Some(written) = written.map(str::trim_end) else {
            return false;
        };
        let other = |w: &str| !w.is_empty() && w != cell.code && w.replace('_', " ") != cell.code;
        let known = self.a.catalog().find(&CodeText::new(written)).is_some();
        known && written.is_ascii() && cell.what != What::Void && other(written)
    }
}

fn cell(range: Range<usize>, form: Form) -> Cell {
    Cell {
        range,
        form,
        what: What::Other,
        code: String::new(),
        width: 0.0,
        units: 0..0,
        altered: false,
        inner: vec![],
    }
}
