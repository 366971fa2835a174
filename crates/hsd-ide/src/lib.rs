//! Answers to editors: hover, completion, definition, references and the like.
//!
//! Everything takes and returns plain types and byte offsets into [`Source::text`]; only `hsd-lsp` knows the
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

use hsd_base::diagnostic::{Diagnostic, Diagnostics, Origin, Text};
use hsd_base::source::{FileId, Source, Span, World};
use hsd_base::text;
use hsd_driver::{Checked, Options};
use hsd_ir::catalog::Catalog;
use hsd_syntax::parse::Seen;
use hsd_syntax::parse::syntax::Outline;
use hsd_town::TownFacts;
use std::cell::OnceCell;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// The analysis of a source file.
#[derive(Debug)]
pub struct Analysis {
    /// The file, file 0.
    pub source: Source,
    /// The diagnostics of `hsd check`, sorted.
    pub diagnostics: Vec<Diagnostic>,
    /// Parameters, other files, custom parts, walls and roofs.
    pub checked: Checked,
    /// The fields of its maps, if it is a town: as they were when it was last checked with them.
    pub town: Option<Arc<TownFacts>>,
    /// True if `town` is of this text, and its problems are among the diagnostics.
    is_town_checked: bool,
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
        let checked = hsd_driver::check(&[&source], world, &asked, &mut out);
        Analysis {
            source,
            diagnostics: out.into_sorted(),
            checked,
            town: None,
            is_town_checked: false,
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
            self.diagnostics.dedup();
        }
    }

    /// Adds what a check of this text as a town with its maps has found, and the files in which it was found.
    pub fn add_town(
        &mut self,
        town: Arc<TownFacts>,
        included: Vec<Source>,
        found: impl IntoIterator<Item = Diagnostic>,
    ) {
        self.town = Some(town);
        self.is_town_checked = true;
        self.checked.included = included;
        self.outlines = OnceCell::new();
        self.names = OnceCell::new();
        self.add(found);
    }

    /// Returns the values that were computed at a place.
    fn seen(&self, place: Span) -> Option<Seen> {
        let town = self.town.as_ref().filter(|_| self.is_town_checked);
        let of_features = || town?.values.get(&place).cloned();
        of_features().or_else(|| self.checked.values.at(place))
    }

    /// Returns the span at which an editor shows a diagnostic: one about a feature at the name of its layer.
    pub fn place_of(&self, diagnostic: &Diagnostic) -> Option<Span> {
        let Origin::Feature { layer, .. } = &diagnostic.origin else {
            return diagnostic.span();
        };
        let mut elements = self.outline().elements.iter();
        let named = elements.find_map(|e| {
            let is_layer = e.schema.is_some_and(|s| s.name == "Layer");
            let name = e.attribute("name").filter(|_| is_layer)?;
            (name.value.trim() == &**layer).then_some(name)
        });
        Some(self.source.span(named?.inner.clone()))
    }

    /// Returns the outline of the file.
    pub fn outline(&self) -> &Outline {
        let limits = &self.options.expand.limits;
        self.outline
            .get_or_init(|| hsd_syntax::parse::outline::of(&self.source, limits))
    }

    /// Returns the outlines of the included files.
    fn outlines(&self) -> &[Outline] {
        let limits = &self.options.expand.limits;
        self.outlines.get_or_init(|| {
            let files = self.checked.included.iter();
            files
                .map(|s| hsd_syntax::parse::outline::of(s, limits))
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
