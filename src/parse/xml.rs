//! Reads the XML form.

use crate::ast::Document;
use crate::diagnostic::Diagnostics;
use crate::source::{Limits, Source};

/// Reads a file of the XML form.
pub fn parse(_source: &Source, _limits: &Limits, _out: &mut Diagnostics) -> Document {
    Document::default()
}
