//! What an editor asks of a text: what stands here, what may stand here, where is it said, where is it used.
//!
//! Everything takes and gives plain types and byte offsets into [`Source::text`]; only [`lsp`](crate::lsp) knows the
//! protocol. An [`Analysis`] is all that is known of one text at one moment: nothing in it changes, and what is costly
//! and not always asked for is worked out when it is asked for.

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
mod words;

use crate::catalog::Catalog;
use crate::diagnostic::{Diagnostic, Diagnostics, Text};
use crate::driver::{self, Checked, Options};
use crate::parse::outline::Outline;
use crate::source::{FileId, Source, Span, World};
use crate::text;
use std::cell::OnceCell;
use std::ops::Range;
use std::path::Path;

/// All that is known of a text.
#[derive(Debug)]
pub struct Analysis {
    /// The text, file 0.
    pub source: Source,
    /// What `hsd check` says of it, sorted.
    pub diagnostics: Vec<Diagnostic>,
    /// Parameters, other files, own parts, walls and roofs.
    pub checked: Checked,
    options: Options,
    outline: OnceCell<Outline>,
    /// Of the included files.
    outlines: OnceCell<Vec<Outline>>,
    names: OnceCell<names::Names>,
}

/// A place in a text that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Which of [`Analysis::source`] and its included files.
    pub file: FileId,
    /// Where in its text.
    pub range: Range<usize>,
}

impl Analysis {
    /// Checks a text.
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

    /// What stands in the text.
    pub fn outline(&self) -> &Outline {
        let limits = &self.options.expand.limits;
        self.outline
            .get_or_init(|| Outline::of(&self.source, limits))
    }

    /// What stands in the included files.
    fn outlines(&self) -> &[Outline] {
        let limits = &self.options.expand.limits;
        self.outlines.get_or_init(|| {
            let files = self.checked.included.iter();
            files.map(|s| Outline::of(s, limits)).collect()
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

    /// Where something is said, in words: the line, and the file where that is another one.
    fn line_of(&self, source: &Source, span: Span) -> Text {
        let line = source.line_column(span).0;
        if source.id() == self.source.id() {
            return text!("line {line}", "{line} 行");
        }
        let path = Path::new(source.name());
        let name = path.file_name().unwrap_or(path.as_os_str()).display();
        text!("{name}, line {line}", "{name} {line} 行")
    }

    /// The text and the files that were read for it.
    pub fn sources(&self) -> impl Iterator<Item = &Source> {
        std::iter::once(&self.source).chain(&self.checked.included)
    }

    /// A file that was read for it.
    pub fn file(&self, id: FileId) -> Option<&Source> {
        self.sources().find(|s| s.id() == id)
    }
}
