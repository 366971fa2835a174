//! Why a drawing has no plan.

use crate::plan::Unreadable;
use std::ops::Range;

/// Why a drawing has no plan: what was looked for, and what was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Refused {
    /// Not the XML of an SVG: at which byte, and why.
    NotXml { at: u64, what: String },
    /// No DXF: at which line, and why.
    NotDxf { line: usize, what: String },
    /// A DXF that ends too early, after so many lines.
    Truncated { line: usize },
    /// More of something than is read.
    TooLarge { what: &'static str, most: usize },
    /// No PDF that can be read, and why.
    NotPdf(String),
    /// A PDF without the page that was asked for.
    NoPage { asked: usize, pages: usize },
    /// A PDF with one picture that cannot be read.
    Picture(Unreadable),
    /// A legend that is none: at which bytes, and why.
    Legend { at: Range<usize>, what: String },
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
