//! The storeys of a house that is written row by row.

use super::codes::Mode;
use super::edits::{EditRef, Strip, numbered};
use super::outline::Surveyed;
use super::repeat::storey_edits;
use super::{Pass, bounds, positive};
use hsd_base::rng::Place;
use hsd_base::source::Spanned;
use hsd_ir::ast;
use hsd_ir::messages::parts as say;
use hsd_ir::program::{Drawn, Loop, Storey, WallLine};

/// Default storey height in shaku.
pub(super) const HEIGHT: f64 = 9.0;

/// Levels of lists in the keys of random choices; the depth of repetitions is added to them.
const ROWS: u64 = 0x100;
const STOREY: u64 = 0x200;
const STOREYS: u64 = 0x300;

impl Pass<'_, '_> {
    /// Returns all storeys, without repetitions. `place` is the house's place in the keys of random choices.
    pub(super) fn storeys(
        &mut self,
        house: &ast::House,
        place: Place,
        mut surveyed: Option<&mut Surveyed>,
    ) -> Vec<Storey> {
        // An outline alone is a house of one storey.
        let bare = house.outline.as_ref().map(|outline| ast::Storey {
            span: outline.span,
            ..ast::Storey::default()
        });
        let mut flat = self.flatten(&house.storeys, STOREYS);
        if flat.ones.is_empty() {
            flat.ones.extend(bare.as_ref());
        }
        let mut storeys = vec![];
        for (index, storey) in flat.ones.iter().enumerate() {
            let height = house.heights.get(index);
            let surveyed = surveyed.as_deref_mut();
            storeys.push(self.storey(storey, height, place.at(index as u64), surveyed));
            if self.stopped() {
                return storeys;
            }
        }
        for scoped in flat.edits {
            let storeys = storeys[scoped.from..scoped.to].iter_mut();
            for (index, storey) in (scoped.from..).zip(storeys) {
                let place = place.at(index as u64);
                self.edit_storey(scoped.edit, scoped.key, storey, place);
            }
        }
        storeys
    }

    fn storey(
        &mut self,
        storey: &ast::Storey,
        header: Option<&Spanned<f64>>,
        place: Place,
        surveyed: Option<&mut Surveyed>,
    ) -> Storey {
        self.charge(u64::from(storey.loops.is_empty()), storey.span);
        self.charge_frame(bounds::STOREY, storey.span);
        let given = storey.height.as_ref().or(header);
        let height = given.and_then(positive);
        let mut made = Storey {
            span: storey.span,
            height: height.unwrap_or(HEIGHT),
            kind: storey.kind,
            order: storey.order.clone(),
            loops: Vec::with_capacity(storey.loops.len()),
            rooms: storey.rooms.clone(),
            fixtures: storey.fixtures.clone(),
        };
        for (index, walk) in storey.loops.iter().enumerate() {
            let lines = self.walk(walk, place.at(index as u64));
            made.loops.push(Loop {
                span: walk.span,
                hole: walk.hole,
                inner: walk.inner,
                drawn: Drawn::Rows,
                start: self.start(walk, storey, index),
                lines,
            });
        }
        let outlined = self.outlined(storey, surveyed, place);
        let rings = outlined.len();
        made.loops.extend(outlined);
        for (edit, ordinal) in numbered(storey_edits(&storey.edits)) {
            self.edit_storey(edit, (STOREY << 32) | ordinal, &mut made, place);
        }
        // A courtyard without a place would only be reported again for what it cuts.
        let mut walks = storey.loops.iter();
        made.loops.retain(|_| {
            let walk = walks.next();
            walk.is_none_or(|walk| !walk.hole || walk.start.is_some())
        });
        made.loops.rotate_right(rings);
        made
    }

    /// Returns where a walk begins. The first walk begins where its storey does; the position of a courtyard
    /// cannot be inferred.
    fn start(&mut self, walk: &ast::Loop, storey: &ast::Storey, index: usize) -> (f64, f64) {
        let storeys = storey.start.as_ref().filter(|_| index == 0 && !walk.hole);
        match walk.start.as_ref().or(storeys) {
            Some(start) => start.value,
            None if walk.hole => {
                let span = self.head(walk.span);
                self.once(313, span, || say::hole_without_start(span));
                (0.0, 0.0)
            }
            None => (0.0, 0.0),
        }
    }

    /// Expands the lines of a walk.
    fn walk(&mut self, walk: &ast::Loop, place: Place) -> Vec<WallLine> {
        let flat = self.flatten(&walk.rows, ROWS);
        let turn = if walk.hole { -90.0 } else { 90.0 };
        let mut lines = Vec::with_capacity(flat.ones.len());
        for (index, row) in flat.ones.iter().enumerate() {
            let strip = self.strip(&row.pieces, place.at(index as u64), Mode::Row);
            self.charge(u64::from(strip.units.is_empty()), row.span);
            self.charge_frame(bounds::ROW, row.span);
            lines.push(WallLine {
                span: row.span,
                units: strip.units,
                turn: row.turn.as_ref().map_or(turn, |turn| turn.value),
                reflection: false,
            });
            if self.stopped() {
                return lines;
            }
        }
        for scoped in flat.edits {
            let lines = &mut lines[scoped.from..scoped.to];
            self.edit_lines(scoped.edit, scoped.key, lines, place, scoped.from);
        }
        lines
    }

    fn edit_storey(&mut self, edit: EditRef<'_>, key: u64, storey: &mut Storey, place: Place) {
        for (index, walk) in storey.loops.iter_mut().enumerate() {
            self.edit_lines(edit, key, &mut walk.lines, place.at(index as u64), 0);
        }
    }

    /// Applies an operation to rows, the first of which has this number in its walk.
    fn edit_lines(
        &mut self,
        edit: EditRef<'_>,
        key: u64,
        lines: &mut [WallLine],
        place: Place,
        first: usize,
    ) {
        for (index, line) in lines.iter_mut().enumerate() {
            let mut strip = Strip {
                units: std::mem::take(&mut line.units),
                place: place.at((first + index) as u64),
                mode: Mode::Row,
                natural: false,
            };
            self.edit(edit, key, &mut strip);
            line.units = strip.units;
        }
    }
}
