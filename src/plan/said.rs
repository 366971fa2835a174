//! What is said of a plan: refusals, and walls in doubt.

use super::legend::Role;
use super::text::Doubt;
use super::{Refused, Unreadable};
use crate::diagnostic::messages::plan::drawn as say;
use crate::diagnostic::{Diagnostic, Noun, noun};
use crate::source::Span;
use glam::DVec2;

/// Says that a picture has no plan; `span` is the picture.
pub fn refused(span: Span, refused: Refused) -> Diagnostic {
    match refused {
        Refused::Blank(share) => say::blank(span, share),
        Refused::NoGrid(share) => say::no_grid(span, share),
        Refused::NoSymbols(share) => say::no_symbols(span, share),
        Refused::NoHouse => say::no_house(span),
    }
}

/// Says that a picture cannot be read; `span` is the picture.
pub fn unreadable(span: Span, why: &Unreadable) -> Diagnostic {
    match why {
        Unreadable::Format => say::no_picture(span),
        Unreadable::TooLarge => say::too_large(span),
        Unreadable::Damaged(why) => say::damaged(span, why),
    }
}

/// Says that a wall is in doubt; `at` is its middle in the picture `sheet`, pixels.
pub fn doubt(span: Span, doubt: &Doubt, sheet: &str, at: DVec2) -> Diagnostic {
    let at = (at.x.round() as i64, at.y.round() as i64);
    match doubt.is_joined {
        true => say::joined(span, sheet, at),
        false => say::doubtful(span, name(doubt.role), sheet, at),
    }
}

fn name(role: Role) -> Noun {
    match role {
        Role::Wall => noun("a wall", "壁"),
        Role::Slide => noun("a sliding door", "引き戸"),
        Role::Hinged => noun("a hinged door", "開き戸"),
        Role::Window => noun("a window", "窓"),
        Role::Lattice => noun("a lattice", "格子"),
        Role::Open | Role::Empty | Role::Mat => noun("an open way", "開口"),
    }
}
