//! Reasons to reject a drawing.

use crate::plan::Unreadable;
use hsd_base::budget::Exhausted;
use std::ops::Range;

/// Reason to reject a drawing as a plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Refused {
    /// The file is not the XML of an SVG.
    NotXml {
        /// Offset of the fault, bytes.
        at: u64,
        /// Reason.
        what: String,
    },
    /// The file is not a DXF.
    NotDxf {
        /// Line of the fault, from 1.
        line: usize,
        /// Reason.
        what: String,
    },
    /// The DXF ends too early.
    Truncated {
        /// Number of lines that were read.
        line: usize,
    },
    /// The file exceeds a limit.
    TooLarge {
        /// Counted thing, such as strokes.
        what: &'static str,
        /// Limit.
        most: usize,
    },
    /// The file expands to more than the run may take.
    Exhausted(Exhausted),
    /// No PDF that can be read, and why.
    NotPdf(String),
    /// The PDF does not have the requested page.
    NoPage {
        /// Requested page, from 1.
        asked: usize,
        /// Number of pages.
        pages: usize,
    },
    /// A PDF with one picture that cannot be read.
    Picture(Unreadable),
    /// The legend is not valid.
    Legend {
        /// Bytes of the fault.
        at: Range<usize>,
        /// Reason.
        what: String,
    },
    /// Drawn by `hsd draw` and changed so that it cannot be read: what is not as it should be.
    Unclear(String),
    /// Nothing that is drawn.
    Blank,
    /// No stroke that stands for a wall; the layers and classes that were found.
    NoRoles(Vec<String>),
    /// Walls that keep to no grid: of so many strokes.
    NoGrid(usize),
    /// No walls that close.
    NoHouse,
}

impl From<Exhausted> for Refused {
    fn from(exhausted: Exhausted) -> Refused {
        Refused::Exhausted(exhausted)
    }
}
