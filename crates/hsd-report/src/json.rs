//! One JSON array, one object per line (docs/contract.md 5). In addition to the contract, a label has a line and a
//! column.

use super::{Report, word};
use hsd_base::diagnostic::{Diagnostic, Origin};
use hsd_base::source::Span;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, Write};

/// A message as programs read it.
#[derive(Serialize)]
pub(super) struct Message<'a> {
    code: String,
    severity: &'static str,
    message: Cow<'a, str>,
    file: Option<&'a str>,
    line: Option<usize>,
    column: Option<usize>,
    span: Option<Bytes>,
    help: Cow<'a, str>,
    labels: Vec<Label<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    feature: Option<Feature<'a>>,
}

/// What a message is about instead of a file.
#[derive(Serialize)]
struct Feature<'a> {
    layer: &'a str,
    key: &'a str,
}

#[derive(Serialize)]
struct Label<'a> {
    message: Cow<'a, str>,
    file: &'a str,
    line: usize,
    column: usize,
    span: Bytes,
}

/// A range of bytes in the original file.
#[derive(Serialize)]
struct Bytes {
    start: u32,
    end: u32,
}

impl From<Span> for Bytes {
    fn from(Span { start, end, .. }: Span) -> Self {
        Bytes { start, end }
    }
}

/// Returns the messages of a report, in its order.
pub(super) fn messages<'a>(report: &'a Report<'_>) -> impl Iterator<Item = Message<'a>> {
    report.diagnostics.iter().map(|d| message(report, d))
}

pub(super) fn write(report: &Report<'_>, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "[")?;
    for (i, message) in messages(report).enumerate() {
        write!(out, "{}", if i == 0 { "\n" } else { ",\n" })?;
        serde_json::to_writer(&mut *out, &message)?;
    }
    writeln!(
        out,
        "{}]",
        if report.diagnostics.is_empty() {
            ""
        } else {
            "\n"
        }
    )
}

fn message<'a>(report: &'a Report<'_>, d: &'a Diagnostic) -> Message<'a> {
    let span = d.span();
    let at = span.map(|span| report.position(span));
    let feature = match &d.origin {
        Origin::Source(_) => None,
        Origin::Feature { layer, key } => Some(Feature { layer, key }),
    };
    let label = |l: &'a hsd_base::diagnostic::Label| {
        let at = report.position(l.span);
        Label {
            message: l.message.in_language(report.language),
            file: report.name(l.span.file),
            line: at.line,
            column: at.column,
            span: l.span.into(),
        }
    };
    Message {
        code: d.code.to_string(),
        severity: word(d.severity),
        message: d.message.in_language(report.language),
        file: span.map(|span| report.name(span.file)),
        line: at.map(|at| at.line),
        column: at.map(|at| at.column),
        span: span.map(Bytes::from),
        help: d.help.in_language(report.language),
        labels: d.labels.iter().map(label).collect(),
        feature,
    }
}
