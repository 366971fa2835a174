//! What is said of a plan: refusals, and walls in doubt.

use super::drawing::Unopened;
use super::grid::MOST_CELLS;
use super::legend::Role;
use super::text::Doubt;
use super::{Refused, Unreadable, vector};
use crate::messages::drawn as say;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostic, Noun, noun};
use hsd_base::source::{Source, Span};
use std::ops::Range;

/// Says that a picture has no plan; `span` is the picture.
pub fn refused(span: Span, refused: Refused) -> Diagnostic {
    match refused {
        Refused::Blank(share) => say::blank(span, share),
        Refused::NoGrid(share) => say::no_grid(span, share),
        Refused::TooFine(cells) => say::too_fine(span, cells, MOST_CELLS),
        Refused::NoSymbols(share) => say::no_symbols(span, share),
        Refused::NoHouse => say::no_house(span),
        Refused::NoSize => say::no_size(span),
        Refused::Outside => say::outside(span),
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

/// Says that a file cannot be opened as a plan, at its place if it is text.
pub fn unopened(file: &Source, why: &Unopened) -> Diagnostic {
    match why {
        Unopened::Picture(why) => unreadable(file.span(0..0), why),
        Unopened::Drawing(why) => drawing(file, why),
    }
}

/// Says why a drawing has no plan, at its place in the file.
pub fn drawing(file: &Source, why: &vector::Refused) -> Diagnostic {
    let whole = || file.span(0..0);
    let line = |n: usize| file.span(line(file.text(), n));
    match why {
        vector::Refused::NotXml { at, what } => {
            let at = (*at as usize).min(file.text().len());
            say::no_svg(file.span(at..at), what)
        }
        vector::Refused::NotDxf { line: n, what } => say::no_dxf(line(*n), what),
        vector::Refused::Truncated { line: n } => say::dxf_ends(line(*n), *n),
        vector::Refused::TooLarge { what, most } => say::large_drawing(whole(), what, *most),
        vector::Refused::Exhausted(what) => {
            say::large_drawing(whole(), what.of.name(), what.limit as usize)
        }
        vector::Refused::NotPdf(what) => say::no_pdf(whole(), what),
        vector::Refused::NoPage { asked, pages } => say::no_page(whole(), *asked, *pages),
        vector::Refused::Picture(why) => unreadable(whole(), why),
        vector::Refused::Legend { at, what } => say::legend(file.span(at.clone()), what),
        vector::Refused::Unclear(what) => say::unclear(whole(), what),
        vector::Refused::Blank => say::nothing_drawn(whole()),
        vector::Refused::NoRoles(names) => say::no_roles(whole(), names),
        vector::Refused::NoGrid(strokes) => say::drawn_off_grid(whole(), *strokes),
        vector::Refused::NoHouse => say::drawn_open(whole()),
    }
}

/// The bytes of a line, counted from 1.
fn line(text: &str, n: usize) -> Range<usize> {
    let mut start = 0;
    for (k, line) in text.split_inclusive('\n').enumerate() {
        if k + 1 == n {
            return start..start + line.trim_end().len();
        }
        start += line.len();
    }
    start..start
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
