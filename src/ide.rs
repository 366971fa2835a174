//! Answers to editors: hover, completion, definition, references and the like.
//!
//! Everything takes and gives plain types and byte offsets into [`Source::text`]; only [`lsp`](crate::lsp) knows the
//! protocol. An [`Analysis`] is all that is known of one file at one moment: nothing in it changes, and what is costly
//! and not always asked for is computed when it is asked for.

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

/// All that is known of a source file.
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
    /// Of the included files.
    outlines: OnceCell<Vec<Outline>>,
    names: OnceCell<names::Names>,
}

/// A place in a source file that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Which of [`Analysis::source`] and its included files.
    pub file: FileId,
    /// Where in its text.
    pub range: Range<usize>,
}

impl Analysis {
    /// Checks a source file.
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

    /// The text of the file.
    pub fn outline(&self) -> &Outline {
        let limits = &self.options.expand.limits;
        self.outline
            .get_or_init(|| crate::parse::outline::of(&self.source, limits))
    }

    /// The definitions of the included files.
    fn outlines(&self) -> &[Outline] {
        let limits = &self.options.expand.limits;
        self.outlines.get_or_init(|| {
            let files = self.checked.included.iter();
            files
                .map(|s| crate::parse::outline::of(s, limits))
                .collect()
        })
    }

    /// The text.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// The parts that are known in it.
    pub fn catalog(&self) -> &Catalog {
        &self.checked.catalog
    }

    /// Where something is stated, in words: the line, and the file where that is another one.
    fn line_of(&self, source: &Source, span: Span) -> Text {
        let line = source.line_column(span).0;
        if source.id() == self.source.id() {
            return text!("line {line}", "{line} 行");
        }
        let path = Path::new(source.name());
        let name = path.file_name().unwrap_or(path.as_os_str()).display();
        text!("{name}, line {line}", "{name} {line} 行")
    }

    /// The file and the files that it includes.
    pub fn sources(&self) -> impl Iterator<Item = &Source> {
        std::iter::once(&self.source).chain(&self.checked.included)
    }

    /// A file that was read for it.
    pub fn file(&self, id: FileId) -> Option<&Source> {
        self.sources().find(|s| s.id() == id)
    }
}
