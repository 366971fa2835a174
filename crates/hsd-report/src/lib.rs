//! Reports: diagnostics as text for people, lines for editors, JSON and SARIF for programs.
//!
//! Every format takes time linear in the size of the files and the number of messages: lines and characters are counted
//! once per file. The report for people shows at most [`SHOWN`] messages, errors first.

mod excerpt;
mod human;
mod json;
pub mod lines;
mod sarif;
mod short;

use hsd_base::diagnostic::{Diagnostic, Language, Noun, Origin, Severity, noun, visible};
use hsd_base::source::{FileId, Source, Span};
use lines::{Lines, Position};
use serde::Serialize;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::io::{self, Write};

/// The maximum number of messages in the report for people.
pub const SHOWN: usize = 50;

/// The format of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// With excerpts of the source, for people.
    #[default]
    Human,
    /// One line each: `file:line:column: error[HSD0104]: message (help: ...)`.
    Short,
    /// One array (docs/contract.md 5).
    Json,
    /// SARIF 2.1.0.
    Sarif,
}

/// The style of a report for people.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// True if the output may have colours.
    pub color: bool,
    /// Width of the output in columns.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Self {
        Style {
            color: false,
            width: 100,
        }
    }
}

/// Messages and the files they refer to.
#[derive(Debug)]
pub struct Report<'a> {
    language: Language,
    diagnostics: &'a [Diagnostic],
    files: Vec<(&'a Source, OnceCell<Lines<'a>>)>,
}

impl<'a> Report<'a> {
    /// Creates a report on sorted diagnostics. Sources may come in any order.
    pub fn new(sources: &'a [Source], diagnostics: &'a [Diagnostic]) -> Report<'a> {
        let mut files: Vec<_> = sources.iter().map(|s| (s, OnceCell::new())).collect();
        files.sort_by_key(|(source, _)| source.id());
        Report {
            language: Language::default(),
            diagnostics,
            files,
        }
    }

    /// Returns the same report in another language. Words that programs match stay as they are: codes, and the
    /// severities in short lines, JSON and SARIF.
    #[must_use]
    pub fn in_language(self, language: Language) -> Report<'a> {
        Report { language, ..self }
    }

    /// Writes the report.
    ///
    /// # Errors If `out` fails.
    pub fn write(&self, format: Format, style: Style, out: &mut dyn Write) -> io::Result<()> {
        match format {
            Format::Human => human::write(self, style, out),
            Format::Short => short::write(self, out),
            Format::Json => json::write(self, out),
            Format::Sarif => sarif::write(self, out),
        }
    }

    /// Returns the messages as [`Format::Json`] writes them, for a larger JSON.
    pub fn messages(&self) -> impl Serialize + use<'_, 'a> {
        json::messages(self).collect::<Vec<_>>()
    }

    /// Returns the counts by severity and file: `2 errors, 1 warning in shop.hsd`; `None` without messages.
    pub fn summary(&self) -> Option<String> {
        let severities = [Severity::Error, Severity::Warning, Severity::Note];
        let count = |s| self.diagnostics.iter().filter(|d| d.severity == s).count();
        let counts = severities.map(|severity| (count(severity), severity));
        let counted = counts.iter().filter(|(n, _)| *n > 0);
        let parts: Vec<String> = counted
            .map(|(n, severity)| self.counted(*n, *severity))
            .collect();
        let (mut files, mut layers) = (BTreeSet::new(), BTreeSet::new());
        for d in self.diagnostics {
            match &d.origin {
                Origin::Source(span) => files.insert(span.file),
                Origin::Feature { layer, .. } => layers.insert(&**layer),
            };
        }
        let japanese = self.language == Language::Japanese;
        let names: Vec<&str> = files.into_iter().map(|file| self.name(file)).collect();
        let place = match (
            &names[..],
            layers.into_iter().collect::<Vec<_>>().as_slice(),
        ) {
            ([], []) => return None,
            ([one], []) | ([], [one]) => visible::line(one),
            (many, []) if japanese => format!("{}ファイル", many.len()),
            (many, []) => format!("{} files", many.len()),
            ([], many) if japanese => format!("{}レイヤー", many.len()),
            ([], many) => format!("{} layers", many.len()),
            (files, layers) if japanese => {
                format!("{}ファイルと{}レイヤー", files.len(), layers.len())
            }
            (files, layers) => format!("{} files and {} layers", files.len(), layers.len()),
        };
        Some(if japanese {
            format!("{place}: {}", parts.join("、"))
        } else {
            format!("{} in {place}", parts.join(", "))
        })
    }

    fn counted(&self, count: usize, severity: Severity) -> String {
        match self.language {
            Language::English if count == 1 => format!("1 {}", word(severity)),
            Language::English => format!("{count} {}s", word(severity)),
            Language::Japanese => format!("{} {count}件", name(severity).ja),
        }
    }

    fn lines(&self, file: FileId) -> Option<&Lines<'a>> {
        let at = self
            .files
            .binary_search_by_key(&file, |(s, _)| s.id())
            .ok()?;
        let (source, lines) = &self.files[at];
        Some(lines.get_or_init(|| Lines::new(source)))
    }

    fn name(&self, file: FileId) -> &'a str {
        let at = self.files.binary_search_by_key(&file, |(s, _)| s.id());
        at.map_or("?", |at| self.files[at].0.name())
    }

    /// Returns the position at which a span begins.
    fn position(&self, span: Span) -> Position {
        let lines = self.lines(span.file);
        lines.map_or(Position::default(), |l| l.position(l.range(span).start))
    }
}

/// Returns the word of a severity for programs, equal in every format and language.
fn word(severity: Severity) -> &'static str {
    name(severity).en
}

/// Returns the word of a severity for people.
fn name(severity: Severity) -> Noun {
    match severity {
        Severity::Error => noun("error", "エラー"),
        Severity::Warning => noun("warning", "警告"),
        Severity::Note => noun("note", "注記"),
    }
}

/// Returns the title of a page of `hsd explain`: its first line without the code.
pub fn title(page: &str) -> &str {
    let line = page.lines().next().unwrap_or_default();
    line.split_once(": ")
        .map_or(line, |(_, title)| title.trim())
}
