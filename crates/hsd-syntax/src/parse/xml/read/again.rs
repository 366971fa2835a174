//! Elements that stand in several places of a house are read once.

use crate::parse::xml::tree::Element;
use hsd_ir::ast::{Item, Piece, SideWall};

/// The parts of a house that have been read once and stand in several places, by the addresses of their elements.
#[derive(Default)]
pub(in crate::parse::xml) struct ReadSoFar {
    sides: Vec<(usize, SideWall)>,
    pieces: Vec<(usize, Option<Item<Piece>>)>,
}

fn find<T: Clone>(known: &[(usize, T)], element: &Element<'_>) -> Option<T> {
    let own = std::ptr::from_ref(element).addr();
    let mut known = known.iter().filter(|_| element.shared);
    known
        .find(|(at, _)| *at == own)
        .map(|(_, read)| read.clone())
}

fn keep<T: Clone>(known: &mut Vec<(usize, T)>, element: &Element<'_>, read: &T) {
    if element.shared {
        known.push((std::ptr::from_ref(element).addr(), read.clone()));
    }
}

impl ReadSoFar {
    /// Returns what was read of a wall.
    pub(in crate::parse::xml) fn side(&self, element: &Element<'_>) -> Option<SideWall> {
        find(&self.sides, element)
    }

    /// Keeps what was read of a wall.
    pub(in crate::parse::xml) fn keep_side(&mut self, element: &Element<'_>, read: &SideWall) {
        keep(&mut self.sides, element, read);
    }

    /// Returns what was read of a piece of a wall.
    pub(in crate::parse::xml) fn piece(
        &self,
        element: &Element<'_>,
    ) -> Option<Option<Item<Piece>>> {
        find(&self.pieces, element)
    }

    /// Keeps what was read of a piece of a wall.
    pub(in crate::parse::xml) fn keep_piece(
        &mut self,
        element: &Element<'_>,
        read: &Option<Item<Piece>>,
    ) {
        keep(&mut self.pieces, element, read);
    }
}
