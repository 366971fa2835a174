//! Diagnostics: the messages a pass reports about its input. Passes contain no prose: every message is one function of
//! [`messages`], in English and Japanese side by side ([`text!`](crate::text)); every code has a page for `hsd explain` in
//! `grammar/diagnostics/` and a Japanese one in `grammar/diagnostics/ja/`.

use crate::source::{FileId, Span};
use crate::text;
use std::sync::Arc;

mod collected;
pub mod messages;
pub mod pages;
pub mod stored;
pub mod suggest;
mod text;
pub mod visible;

pub use collected::{Diagnostics, ENOUGH, ENOUGH_OF_LAYER};
pub use text::{Kept, Language, Noun, Text, Value, noun};

/// A stable number, shown as `HSD0104`. The hundreds tell the stage: 00 file, 01 legacy text, 02 XML,
/// 03 parts and operations, 04 plan, 05 roofs, 06 pictures and textures, 08 layouts, 09 limits, 10 maps, 11 towns, 12 drawn plans.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(pub u16);

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "HSD{:04}", self.0)
    }
}

/// The severity of a diagnostic. An error makes the exit status 1; a warning only with `-D warnings`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Information; nothing needs to change.
    Note,
    /// Built, but probably not as intended.
    Warning,
    /// Not built, or built incompletely.
    Error,
}

/// The origin of a diagnostic. Places in source files sort before features.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// A place in a source file.
    Source(Span),
    /// A feature of a map, which has no place in a source file.
    Feature {
        /// The name of its layer.
        layer: Arc<str>,
        /// Its key in the layer.
        key: Arc<str>,
    },
}

impl From<Span> for Origin {
    fn from(span: Span) -> Origin {
        Origin::Source(span)
    }
}

/// A related place of a diagnostic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The message for this place.
    pub message: Text,
}

/// A change that resolves a diagnostic, offered by editors as a quick fix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// The action, in the imperative and without a full stop.
    pub title: Text,
    /// The changes, applied together; no two touch each other.
    pub edits: Vec<Edit>,
}

/// The replacement of one place in a source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The place to replace; empty for an insertion.
    pub span: Span,
    /// The replacement.
    pub text: String,
}

impl Edit {
    /// Creates an edit that replaces a span.
    pub fn new(span: Span, text: impl Into<String>) -> Edit {
        Edit {
            span,
            text: text.into(),
        }
    }
}

/// A diagnostic: the problem, its place, the reason and the fix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The code, which has a page for `hsd explain`.
    pub code: Code,
    /// The severity.
    pub severity: Severity,
    /// The exact place. The field precedes the texts because it is cheaper to compare.
    pub origin: Origin,
    /// The problem, in one sentence without a full stop.
    pub message: Text,
    /// Advice on how to fix the problem.
    pub help: Text,
    /// Related places.
    pub labels: Vec<Label>,
    /// Fixes that can be applied without further thought, the likeliest first. Applying any of them resolves
    /// this diagnostic.
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
    /// Puts it at another place if it is in this file, without what leads into the file; returns whether it was.
    pub fn leave(&mut self, file: FileId, to: Span) -> bool {
        let is_there = self.span().is_some_and(|span| span.file == file);
        if is_there {
            self.origin = to.into();
            self.fixes.clear();
        }
        self.labels.retain(|label| label.span.file != file);
        is_there
    }

    /// Creates an error.
    pub fn error(code: u16, origin: impl Into<Origin>, message: impl Into<Text>) -> Self {
        Self::new(Severity::Error, code, origin.into(), message.into())
    }

    /// Creates a warning.
    pub fn warning(code: u16, origin: impl Into<Origin>, message: impl Into<Text>) -> Self {
        Self::new(Severity::Warning, code, origin.into(), message.into())
    }

    /// Creates a note.
    pub fn note(code: u16, origin: impl Into<Origin>, message: impl Into<Text>) -> Self {
        Self::new(Severity::Note, code, origin.into(), message.into())
    }

    fn new(severity: Severity, code: u16, origin: Origin, message: Text) -> Self {
        Diagnostic {
            code: Code(code),
            severity,
            message,
            origin,
            help: Text::default(),
            labels: vec![],
            fixes: vec![],
        }
    }

    /// Returns the place in a source file, if the message has one.
    pub fn span(&self) -> Option<Span> {
        match self.origin {
            Origin::Source(span) => Some(span),
            Origin::Feature { .. } => None,
        }
    }

    /// Returns the message, preceded by the feature if the diagnostic has no place in a source file.
    pub fn full_message(&self) -> Text {
        let message = &self.message;
        match &self.origin {
            Origin::Source(_) => message.clone(),
            Origin::Feature { layer, key } => text!([layer, key, message]
                "{layer}, feature {key}: {message}",
                "{layer} の地物 {key}: {message}"
            ),
        }
    }

    /// Sets the advice on how to fix the problem.
    #[must_use]
    pub fn help(mut self, help: impl Into<Text>) -> Self {
        self.help = help.into();
        self
    }

    /// Adds a related place.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<Text>) -> Self {
        self.labels.push(Label {
            span,
            message: message.into(),
        });
        self
    }

    /// Adds a fix that replaces a span.
    #[must_use]
    pub fn fix(self, title: impl Into<Text>, span: Span, text: impl Into<String>) -> Self {
        self.fix_all(title, vec![Edit::new(span, text)])
    }

    /// Adds a fix of several changes.
    #[must_use]
    pub fn fix_all(mut self, title: impl Into<Text>, edits: Vec<Edit>) -> Self {
        self.fixes.push(Fix {
            title: title.into(),
            edits,
        });
        self
    }
}
