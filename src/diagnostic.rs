//! Diagnostics: the messages a pass reports about its input. Passes contain no prose: every message is one function of
//! [`messages`], in English and Japanese side by side ([`text!`](crate::text)); every code has a page for `hsd explain` in
//! `grammar/diagnostics/` and a Japanese one in `grammar/diagnostics/ja/`.

use crate::source::Span;
use std::collections::BTreeSet;

pub mod messages;
pub mod pages;
mod text;

pub use text::{Kept, Language, Noun, Text, Value, noun};

/// A stable number, shown as `HSD0104`. The hundreds tell the stage: 00 file, 01 legacy text, 02 XML,
/// 03 parts and operations, 04 plan, 05 roofs, 06 pictures and textures, 08 layouts, 09 limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(pub u16);

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "HSD{:04}", self.0)
    }
}

/// How bad it is. An error makes the exit status 1; a warning only with `-D warnings`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Good to know.
    Note,
    /// Built, but surely not as meant.
    Warning,
    /// Not built, or built with something left out.
    Error,
}

/// A second place that belongs to a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// The message for this place.
    pub message: Text,
}

/// One way to mend what a message complains of: what an editor offers to do at a click.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// The action, in the imperative and without a full stop.
    pub title: Text,
    /// The changes, all at once; none touches another.
    pub edits: Vec<Edit>,
}

/// One place of a text and what shall stand there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The text to replace; empty for a pure insertion.
    pub span: Span,
    /// The replacement.
    pub text: String,
}

impl Edit {
    /// Puts a text in the place of a span.
    pub fn new(span: Span, text: impl Into<String>) -> Edit {
        Edit {
            span,
            text: text.into(),
        }
    }
}

/// One message: what is wrong, where, why, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The number of its page.
    pub code: Code,
    /// How bad it is.
    pub severity: Severity,
    /// The problem, in one sentence without a full stop.
    pub message: Text,
    /// The exact place.
    pub span: Span,
    /// The mend.
    pub help: Text,
    /// Further places.
    pub labels: Vec<Label>,
    /// Fixes that can be applied without further thought, the likeliest first. Applying any of them resolves
    /// this diagnostic.
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
    /// An error.
    pub fn error(code: u16, span: Span, message: impl Into<Text>) -> Self {
        Self::new(Severity::Error, code, span, message.into())
    }

    /// A warning.
    pub fn warning(code: u16, span: Span, message: impl Into<Text>) -> Self {
        Self::new(Severity::Warning, code, span, message.into())
    }

    /// A note.
    pub fn note(code: u16, span: Span, message: impl Into<Text>) -> Self {
        Self::new(Severity::Note, code, span, message.into())
    }

    fn new(severity: Severity, code: u16, span: Span, message: Text) -> Self {
        Diagnostic {
            code: Code(code),
            severity,
            message,
            span,
            help: Text::default(),
            labels: vec![],
            fixes: vec![],
        }
    }

    /// Adds how to mend it.
    #[must_use]
    pub fn help(mut self, help: impl Into<Text>) -> Self {
        self.help = help.into();
        self
    }

    /// Adds a second place.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<Text>) -> Self {
        self.labels.push(Label {
            span,
            message: message.into(),
        });
        self
    }

    /// Adds a mend: this text in the place of the span.
    #[must_use]
    pub fn fix(self, title: impl Into<Text>, span: Span, text: impl Into<String>) -> Self {
        self.fix_all(title, vec![Edit::new(span, text)])
    }

    /// Adds a mend of several changes.
    #[must_use]
    pub fn fix_all(mut self, title: impl Into<Text>, edits: Vec<Edit>) -> Self {
        self.fixes.push(Fix {
            title: title.into(),
            edits,
        });
        self
    }
}

/// The collected messages of a run.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// An empty collection.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes one message.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    /// Takes all messages of another collection.
    pub fn append(&mut self, other: Diagnostics) {
        self.list.extend(other.list);
    }

    /// Takes the messages of another collection, one a place and code: what is wrong with a text is wrong with each
    /// house that is made of it.
    pub fn push_new(&mut self, other: Diagnostics) {
        let key = |d: &Diagnostic| (d.span.file, d.span.start, d.span.end, d.code);
        let mut known: BTreeSet<_> = self.list.iter().map(key).collect();
        let new = other.list.into_iter().filter(|d| known.insert(key(d)));
        self.list.extend(new.collect::<Vec<_>>());
    }

    /// Leaves out the mends of which a change is not to be made.
    pub fn retain_fixes(&mut self, keep: impl Fn(&Edit) -> bool) {
        let fixed = self.list.iter_mut().filter(|d| !d.fixes.is_empty());
        for found in fixed {
            found.fixes.retain(|fix| fix.edits.iter().all(&keep));
        }
    }

    /// Returns true if any diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|d| d.severity == Severity::Error)
    }

    /// How many of this severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.list.iter().filter(|d| d.severity == severity).count()
    }

    /// In the order of pushing.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// Sorted by file and start (stable), without exact repetitions.
    pub fn into_sorted(mut self) -> Vec<Diagnostic> {
        self.list
            .sort_by_key(|d| (d.span.file, d.span.start, d.span.end, d.code));
        self.list.dedup();
        self.list
    }
}
