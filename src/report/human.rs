//! The report for people: each message with its lines, drawn by miette.

use super::excerpt::{Excerpt, restored};
use super::{Report, SHOWN, Style, clean, word};
use crate::diagnostic::{Code, Diagnostic, Severity};
use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use std::fmt::{self, Display};
use std::io::{self, Write};

pub(super) fn write(report: &Report<'_>, style: Style, out: &mut dyn Write) -> io::Result<()> {
    let theme = if style.color {
        GraphicalTheme::unicode()
    } else {
        GraphicalTheme::unicode_nocolor()
    };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_links(false)
        .without_syntax_highlighting()
        .with_width(style.width.max(40));
    let shown = shown(report.diagnostics);
    for d in &shown {
        let mut text = String::new();
        let drawn = handler.render_report(&mut text, &Message::new(report, d));
        drawn.map_err(io::Error::other)?;
        writeln!(out, "{}", restored(&text))?;
    }
    let more = report.diagnostics.len() - shown.len();
    if more > 0 {
        writeln!(
            out,
            "... and {more} more; `--format short` lists all of them"
        )?;
    }
    if let Some(summary) = report.summary() {
        writeln!(out, "{summary}")?;
    }
    let mut codes: Vec<Code> = shown.iter().map(|d| d.code).collect();
    codes.sort_unstable();
    codes.dedup();
    match &codes[..] {
        [] => Ok(()),
        [one] => writeln!(out, "`hsd explain {one}` tells more about it"),
        [first, rest @ ..] => {
            write!(out, "`hsd explain {first}` tells more, as for ")?;
            let others: Vec<String> = rest.iter().take(7).map(Code::to_string).collect();
            let more = if rest.len() > 7 { ", ..." } else { "" };
            writeln!(out, "{}{more}", others.join(", "))
        }
    }
}

/// The messages with their lines: errors before warnings before notes where they are too many, yet in the
/// order of the files.
fn shown(all: &[Diagnostic]) -> Vec<&Diagnostic> {
    let mut first: Vec<usize> = (0..all.len()).collect();
    first.sort_by_key(|i| std::cmp::Reverse(all[*i].severity)); // stable
    first.truncate(SHOWN);
    first.sort_unstable();
    first.into_iter().map(|i| &all[i]).collect()
}

/// A message as miette asks for it.
#[derive(Debug)]
struct Message {
    code: String,
    text: String,
    help: Option<String>,
    severity: Severity,
    excerpt: Option<Excerpt>,
    labels: Vec<LabeledSpan>,
}

impl Message {
    fn new(report: &Report<'_>, d: &Diagnostic) -> Message {
        let (here, elsewhere): (Vec<_>, Vec<_>) =
            d.labels.iter().partition(|l| l.span.file == d.span.file);
        let mut help = d.help.lines().map(clean::line).collect::<Vec<_>>();
        // A snippet shows one file; places in others are named.
        help.extend(elsewhere.iter().map(|l| {
            let (at, name) = (report.position(l.span), report.name(l.span.file));
            let text = format!("{name}:{}:{}: {}", at.line, at.column, l.message);
            clean::line(&text)
        }));
        let excerpt = report.lines(d.span.file).map(|lines| {
            let spans = std::iter::once(d.span).chain(here.iter().map(|l| l.span));
            let ranges: Vec<_> = spans.map(|s| lines.range(s)).collect();
            Excerpt::new(report.name(d.span.file), lines, &ranges)
        });
        let marks = excerpt.iter().flat_map(Excerpt::marks);
        let texts = std::iter::once(None).chain(here.iter().map(|l| Some(clean::line(&l.message))));
        let labels = marks.zip(texts).enumerate().map(|(i, (range, text))| {
            let span = (range.start, range.len());
            if i == 0 {
                LabeledSpan::new_primary_with_span(text, span)
            } else {
                LabeledSpan::new_with_span(text, span)
            }
        });
        let labels = labels.collect();
        Message {
            code: format!("{}[{}]", word(d.severity), d.code),
            text: clean::line(&d.message),
            help: (!help.is_empty()).then(|| help.join("\n")),
            severity: d.severity,
            labels,
            excerpt,
        }
    }
}

impl Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for Message {}

impl miette::Diagnostic for Message {
    fn code<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        Some(Box::new(&self.code))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
            Severity::Note => miette::Severity::Advice,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        self.help.as_ref().map(|h| Box::new(h) as Box<dyn Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.as_ref().map(|e| e as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }
}
