//! SARIF 2.1.0, for code-scanning services. Rules come from the pages of `hsd explain`.

use super::{Report, title};
use hsd_base::diagnostic::{Code, Diagnostic, Fix, Language, Origin, pages};
use hsd_base::source::{FileId, Span};
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{self, Write};

const SCHEMA: &str = "https://json.schemastore.org/sarif-2.1.0.json";

#[derive(Serialize)]
struct Log<'a> {
    #[serde(rename = "$schema")]
    schema: &'static str,
    version: &'static str,
    runs: [Run<'a>; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Run<'a> {
    tool: Tool,
    column_kind: &'static str,
    results: Vec<Outcome<'a>>,
}

#[derive(Serialize)]
struct Tool {
    driver: Driver,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Driver {
    name: &'static str,
    semantic_version: &'static str,
    rules: Vec<Rule>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Rule {
    id: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    short_description: Option<Text<&'static str>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<Page>,
}

#[derive(Serialize)]
struct Text<T> {
    text: T,
}

#[derive(Serialize)]
struct Page {
    text: &'static str,
    markdown: &'static str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Outcome<'a> {
    rule_id: String,
    rule_index: usize,
    level: &'static str,
    message: Text<String>,
    locations: [Location<'a>; 1],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    related_locations: Vec<Location<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fixes: Vec<SarifFix<'a>>,
}

/// A fix.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SarifFix<'a> {
    description: Text<Cow<'a, str>>,
    artifact_changes: Vec<Change<'a>>,
}

/// The changes of a fix in one file.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Change<'a> {
    artifact_location: Artifact,
    replacements: Vec<Replacement<'a>>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Replacement<'a> {
    deleted_region: Region,
    inserted_content: Text<&'a str>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Location<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    physical_location: Option<SarifPlace>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    logical_locations: Vec<Logical<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    message: Option<Text<Cow<'a, str>>>,
}

/// A feature of a layer.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Logical<'a> {
    name: &'a str,
    fully_qualified_name: String,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SarifPlace {
    artifact_location: Artifact,
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<Region>,
}

#[derive(Serialize)]
struct Artifact {
    uri: String,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Region {
    start_line: usize,
    start_column: usize,
    end_line: usize,
    end_column: usize,
    byte_offset: u32,
    byte_length: u32,
    char_offset: usize,
    char_length: usize,
}

pub(super) fn write(report: &Report<'_>, out: &mut dyn Write) -> io::Result<()> {
    let mut codes: Vec<Code> = report.diagnostics.iter().map(|d| d.code).collect();
    codes.sort_unstable();
    codes.dedup();
    let driver = Driver {
        name: "hsd",
        semantic_version: env!("CARGO_PKG_VERSION"),
        rules: codes.iter().map(|c| rule(*c, report.language)).collect(),
    };
    let results = report
        .diagnostics
        .iter()
        .map(|d| outcome(report, &codes, d));
    let log = Log {
        schema: SCHEMA,
        version: "2.1.0",
        runs: [Run {
            tool: Tool { driver },
            column_kind: "unicodeCodePoints",
            results: results.collect(),
        }],
    };
    serde_json::to_writer(&mut *out, &log)?;
    writeln!(out)
}

/// Returns the rule of a code, with its page.
fn rule(code: Code, language: Language) -> Rule {
    let page = pages::page(code, language);
    Rule {
        id: code.to_string(),
        short_description: page.map(|p| Text { text: title(p) }),
        help: page.map(|p| Page {
            text: p,
            markdown: p,
        }),
    }
}

fn outcome<'a>(report: &Report<'_>, codes: &[Code], d: &'a Diagnostic) -> Outcome<'a> {
    let language = report.language;
    let (message, word) = (
        d.full_message().in_language(language).into_owned(),
        language.choose("help", "対処"),
    );
    let text = match &*d.help.in_language(language) {
        "" => message,
        help => format!("{message} ({word}: {help})"),
    };
    let label = |l: &'a hsd_base::diagnostic::Label| Location {
        physical_location: Some(place(report, l.span)),
        logical_locations: vec![],
        message: Some(Text {
            text: l.message.in_language(language),
        }),
    };
    Outcome {
        rule_id: d.code.to_string(),
        rule_index: codes.binary_search(&d.code).unwrap_or(0),
        level: super::word(d.severity),
        message: Text { text },
        locations: [Location {
            physical_location: d.span().map(|span| place(report, span)),
            logical_locations: logical(&d.origin),
            message: None,
        }],
        related_locations: d.labels.iter().map(label).collect(),
        fixes: d.fixes.iter().filter_map(|m| fix(report, m)).collect(),
    }
}

/// Returns a fix, unless it concerns a file that is not in the report: a change must have a region.
fn fix<'a>(report: &Report<'_>, fix: &'a Fix) -> Option<SarifFix<'a>> {
    let mut files = BTreeMap::<FileId, Vec<Replacement<'a>>>::new();
    for edit in &fix.edits {
        let replacement = Replacement {
            deleted_region: region(report, edit.span)?,
            inserted_content: Text { text: &edit.text },
        };
        files.entry(edit.span.file).or_default().push(replacement);
    }
    let change = |(file, replacements)| Change {
        artifact_location: artifact(report, file),
        replacements,
    };
    Some(SarifFix {
        description: Text {
            text: fix.title.in_language(report.language),
        },
        artifact_changes: files.into_iter().map(change).collect(),
    })
}

fn logical(origin: &Origin) -> Vec<Logical<'_>> {
    match origin {
        Origin::Source(_) => vec![],
        Origin::Feature { layer, key } => vec![Logical {
            name: key,
            fully_qualified_name: format!("{layer}/{key}"),
        }],
    }
}

fn place(report: &Report<'_>, span: Span) -> SarifPlace {
    SarifPlace {
        artifact_location: artifact(report, span.file),
        region: region(report, span),
    }
}

fn artifact(report: &Report<'_>, file: FileId) -> Artifact {
    Artifact {
        uri: uri(report.name(file)),
    }
}

fn region(report: &Report<'_>, span: Span) -> Option<Region> {
    report.lines(span.file).map(|lines| {
        let range = lines.range(span);
        let (from, to) = (lines.position(range.start), lines.position(range.end));
        let before = lines.characters(range.start);
        Region {
            start_line: from.line,
            start_column: from.column,
            end_line: to.line,
            end_column: to.column,
            byte_offset: span.start,
            byte_length: span.end - span.start,
            char_offset: before,
            char_length: lines.characters(range.end) - before,
        }
    })
}

/// Returns a path as a URI; a drive letter would be read as a scheme.
fn uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let drive = path.as_bytes().get(1) == Some(&b':');
    let path = if drive {
        format!("file:///{path}")
    } else {
        path
    };
    let mut out = String::with_capacity(path.len());
    for byte in path.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/:".contains(&byte) {
            out.push(byte.into());
        } else {
            out.push_str(&format!("%{byte:02X}"));
        }
    }
    out
}
