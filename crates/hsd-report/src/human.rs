//! The report for people: each message with its lines, rendered by miette.

use super::excerpt::{Excerpt, restored};
use super::{Report, SHOWN, Style, name};
use hsd_base::diagnostic::visible;
use hsd_base::diagnostic::{Code, Diagnostic, Language, Severity};
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
        writeln!(out, "{}", restored(&worded(&text, report.language)))?;
    }
    let more = report.diagnostics.len() - shown.len();
    if more > 0 {
        let line = match report.language {
            Language::English => format!("... and {more} more; `--format short` lists all of them"),
            Language::Japanese => format!("ほかに{more}件; `--format short` ですべて表示します"),
        };
        writeln!(out, "{line}")?;
    }
    if let Some(summary) = report.summary() {
        writeln!(out, "{summary}")?;
    }
    let mut codes: Vec<Code> = shown.iter().map(|d| d.code).collect();
    codes.sort_unstable();
    codes.dedup();
    hint(&codes, report.language, out)
}

/// Writes where to read more.
fn hint(codes: &[Code], language: Language, out: &mut dyn Write) -> io::Result<()> {
    let (first, rest) = match codes {
        [] => return Ok(()),
        [first, rest @ ..] => (first, rest),
    };
    let others: Vec<String> = rest.iter().take(7).map(Code::to_string).collect();
    let (others, more) = (others.join(", "), rest.len() > 7);
    match (language, rest.is_empty()) {
        (Language::English, true) => writeln!(out, "`hsd explain {first}` tells more about it"),
        (Language::English, false) => {
            let more = if more { ", ..." } else { "" };
            writeln!(
                out,
                "`hsd explain {first}` tells more, as for {others}{more}"
            )
        }
        (Language::Japanese, true) => writeln!(out, "詳しくは `hsd explain {first}`"),
        (Language::Japanese, false) => {
            let more = if more { " など" } else { "" };
            writeln!(
                out,
                "詳しくは `hsd explain {first}` ({others}{more} も同様)"
            )
        }
    }
}

/// Translates miette's word for the fix. Only that word begins a line after two blanks; both words take as many
/// columns, which the lines below it rely on.
fn worded(drawn: &str, language: Language) -> String {
    let line = |line: &str| match line.find("  help: ") {
        Some(at) if language == Language::Japanese && is_style(&line[..at]) => {
            line.replacen("  help: ", "  対処: ", 1)
        }
        _ => line.to_owned(),
    };
    drawn.split_inclusive('\n').map(line).collect()
}

/// Returns true if a string is at most one escape sequence of colours.
fn is_style(text: &str) -> bool {
    let inner = text
        .strip_prefix("\u{1b}[")
        .and_then(|t| t.strip_suffix('m'));
    text.is_empty() || inner.is_some_and(|t| t.bytes().all(|b| b.is_ascii_digit() || b == b';'))
}

/// Returns the messages that are shown: errors before warnings before notes if they are too many, but in the order of
/// the files.
fn shown(all: &[Diagnostic]) -> Vec<&Diagnostic> {
    let mut first: Vec<usize> = (0..all.len()).collect();
    first.sort_by_key(|i| std::cmp::Reverse(all[*i].severity)); // stable
    first.truncate(SHOWN);
    first.sort_unstable();
    first.into_iter().map(|i| &all[i]).collect()
}

/// A message in the interface of miette.
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
        let own = d.span();
        let (here, elsewhere): (Vec<_>, Vec<_>) = d
            .labels
            .iter()
            .partition(|l| own.is_some_and(|own| l.span.file == own.file));
        let language = report.language;
        let mut help = d
            .help
            .in_language(language)
            .lines()
            .map(visible::line)
            .collect::<Vec<_>>();
        // A snippet shows one file; places in others are named.
        help.extend(elsewhere.iter().map(|l| {
            let (at, name) = (report.position(l.span), report.name(l.span.file));
            let text = format!(
                "{name}:{}:{}: {}",
                at.line,
                at.column,
                l.message.in_language(language)
            );
            visible::line(&text)
        }));
        let excerpt = own.and_then(|own| {
            let lines = report.lines(own.file)?;
            let spans = std::iter::once(own).chain(here.iter().map(|l| l.span));
            let ranges: Vec<_> = spans.map(|s| lines.range(s)).collect();
            Some(Excerpt::new(report.name(own.file), lines, &ranges))
        });
        let marks = excerpt.iter().flat_map(Excerpt::marks);
        let texts = std::iter::once(None).chain(
            here.iter()
                .map(|l| Some(visible::line(&l.message.in_language(language)))),
        );
        let labels = marks.zip(texts).enumerate().map(|(i, (range, text))| {
            let span = (range.start, range.len());
            if i == 0 {
                LabeledSpan::new_primary_with_span(text, span)
            } else {
                LabeledSpan::new_with_span(text, span)
            }
        });
        let labels = labels.collect();
        let word = name(d.severity);
        Message {
            code: format!("{}[{}]", language.choose(word.en, word.ja), d.code),
            text: visible::line(&d.full_message().in_language(language)),
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
