//! Diagnostics: the messages a pass reports about its input. Passes contain no prose: every message is one function of
//! [`messages`], in English and Japanese side by side ([`text!`](crate::text)); every code has a page for `hsd explain` in
//! `grammar/diagnostics/` and a Japanese one in `grammar/diagnostics/ja/`.

use crate::source::Span;
use crate::text;
use std::sync::Arc;

mod collected;
pub mod messages;
pub mod pages;
pub(crate) mod suggest;
mod text;
pub mod visible;

pub use collected::{Diagnostics, ENOUGH, ENOUGH_OF_LAYER};
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

/// Where a message comes from. Places in source files come before features.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// What somebody wrote.
    Source(Span),
    /// A feature of a map, which no house file mentions.
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
    /// The exact place. It stands before the texts, of which the comparison costs more.
    pub origin: Origin,
    /// The problem, in one sentence without a full stop.
    pub message: Text,
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
    pub fn error(code: u16, origin: impl Into<Origin>, message: impl Into<Text>) -> Self {
        Self::new(Severity::Error, code, origin.into(), message.into())
    }

    /// A warning.
    pub fn warning(code: u16, origin: impl Into<Origin>, message: impl Into<Text>) -> Self {
        Self::new(Severity::Warning, code, origin.into(), message.into())
    }

    /// A note.
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

    /// Returns the message, headed by the feature that it is about, where no place in a source file says so.
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
