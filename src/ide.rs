//! Answers to editors: hover, completion, definition, references and the like.
//!
//! Everything takes and returns plain types and byte offsets into [`Source::text`]; only [`lsp`](crate::lsp) knows the
//! protocol. An [`Analysis`] holds everything known of one file at one moment: it is immutable, and expensive results
//! that are rarely needed are computed on demand.

pub mod card;
pub mod complete;
pub mod folding;
pub mod format;
pub mod hover;
pub mod inlay;
pub mod fix;
pub mod names;
pub mod plan;
mod sections;
pub mod selection;
pub mod stroke;
pub mod symbols;
pub mod tokens;
mod walked;
mod vocabulary;

use crate::catalog::Catalog;
use crate::diagnostic::{Diagnostic, Diagnostics, Text};
use crate::driver::{self, Checked, Options};
use crate::parse::syntax::Outline;
use crate::source::{FileId, Source, Span, World};
use crate::text;
use std::cell::OnceCell;
use std::ops::Range;
use std::path::Path;

/// The analysis of a source file.
#[derive(Debug)]
pub struct Analysis {
    /// The file, file 0.
    pub source: Source,
    /// The diagnostics of `hsd check`, sorted.
    pub diagnostics: Vec<Diagnostic>,
    /// Parameters, other files, custom parts, walls and roofs.
    pub checked: Checked,
    options: Options,
    outline: OnceCell<Outline>,
    /// The outlines of the included files.
    outlines: OnceCell<Vec<Outline>>,
    names: OnceCell<names::Names>,
}

/// A place in a source file that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourcePlace {
    /// The number of the file, [`Analysis::source`] or an included one.
    pub file: FileId,
    /// The range in its text.
    pub range: Range<usize>,
}

impl Analysis {
    /// Analyses a source file.
    pub fn new(source: Source, world: &dyn World, options: &Options) -> Analysis {
        let mut out = Diagnostics::new();
        let asked = Options {
            notes_values: true,
            ..options.clone()
        };
        let checked = driver::check(&[&source], world, &asked, &mut out);
        Analysis {
            source,
            diagnostics: out.into_sorted(),
            checked,
            options: options.clone(),
            outline: OnceCell::new(),
            outlines: OnceCell::new(),
            names: OnceCell::new(),
        }
    }

    /// Adds what was found after the check.
    pub fn add(&mut self, found: impl IntoIterator<Item = Diagnostic>) {
        let before = self.diagnostics.len();
        self.diagnostics.extend(found);
        if self.diagnostics.len() > before {
            let place = |d: &Diagnostic| (d.origin.clone(), d.code);
            self.diagnostics.sort_by_key(place);
        }
    }

    /// Returns the outline of the file.
    pub fn outline(&self) -> &Outline {
        let limits = &self.options.expand.limits;
        self.outline
            .get_or_init(|| crate::parse::outline::of(&self.source, limits))
    }

    /// Returns the outlines of the included files.
    fn outlines(&self) -> &[Outline] {
        let limits = &self.options.expand.limits;
        self.outlines.get_or_init(|| {
            let files = self.checked.included.iter();
            files
                .map(|s| crate::parse::outline::of(s, limits))
                .collect()
        })
    }

    /// Returns the text of the file.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// Returns the catalogue of the parts known in it.
    pub fn catalog(&self) -> &Catalog {
        &self.checked.catalog
    }

    /// Describes the place of a statement: the line, and the file if it is another one.
    fn line_of(&self, source: &Source, span: Span) -> Text {
        let line = source.line_column(span).0;
        if source.id() == self.source.id() {
            return text!([line] "line {line}", "{line} 行");
        }
        let path = Path::new(source.name());
        let name = path
            .file_name()
            .unwrap_or(path.as_os_str())
            .to_string_lossy();
        text!([name, line] "{name}, line {line}", "{name} {line} 行")
    }

    /// Returns the file and the files that it includes.
    pub fn sources(&self) -> impl Iterator<Item = &Source> {
        std::iter::once(&self.source).chain(&self.checked.included)
    }

    /// Returns a file that was read for it, by its number.
    pub fn file(&self, id: FileId) -> Option<&Source> {
        self.sources().find(|s| s.id() == id)
    }
}
