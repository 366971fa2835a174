//! Diagnostics between two runs: what one process found, another reports. Their texts are kept in both languages, fixes are not,
//! which an editor alone applies.

use super::{Code, Diagnostic, Diagnostics, Label, Origin, Severity, Text};
use crate::diagnostic::Language;
use crate::source::{FileId, Span};
use serde::{Deserialize, Serialize};
use std::fmt::Formatter;

/// Diagnostics as they are stored.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct StoredDiagnostics {
    list: Vec<Stored>,
    /// Of each kind of which some are only counted, the last one kept and how many are not.
    more: Vec<(Place, u16, u8, usize)>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
struct Stored {
    code: u16,
    severity: u8,
    at: Place,
    message: Words,
    help: Words,
    labels: Vec<([u32; 3], Words)>,
}

/// The words in English and in Japanese.
#[derive(Clone, Debug, Deserialize, Serialize)]
struct Words(String, String);

/// File, first byte and end, or layer and key.
#[derive(Clone, Debug, Deserialize, Serialize)]
enum Place {
    Source([u32; 3]),
    Feature(String, String),
}

impl From<&Text> for Words {
    fn from(text: &Text) -> Words {
        let [en, ja] = [Language::English, Language::Japanese].map(|l| text.in_language(l));
        Words(en.into_owned(), ja.into_owned())
    }
}

impl From<Words> for Text {
    fn from(Words(en, ja): Words) -> Text {
        Text::written(move |language, f: &mut Formatter<'_>| f.write_str(language.choose(&en, &ja)))
    }
}

impl From<&Origin> for Place {
    fn from(origin: &Origin) -> Place {
        match origin {
            Origin::Source(span) => Place::Source(numbers(*span)),
            Origin::Feature { layer, key } => Place::Feature(layer.to_string(), key.to_string()),
        }
    }
}

impl From<Place> for Origin {
    fn from(place: Place) -> Origin {
        match place {
            Place::Source(numbers) => span(numbers).into(),
            Place::Feature(layer, key) => Origin::Feature {
                layer: layer.into(),
                key: key.into(),
            },
        }
    }
}

/// Returns file, first byte and end.
pub fn numbers(span: Span) -> [u32; 3] {
    [span.file.0, span.start, span.end]
}

/// Returns the place of these numbers.
pub fn span([file, start, end]: [u32; 3]) -> Span {
    Span {
        file: FileId(file),
        start,
        end,
    }
}

const SEVERITIES: [Severity; 3] = [Severity::Note, Severity::Warning, Severity::Error];

fn severity(number: u8) -> Severity {
    SEVERITIES[usize::from(number).min(2)]
}

impl From<&Diagnostics> for StoredDiagnostics {
    fn from(found: &Diagnostics) -> StoredDiagnostics {
        let one = |d: &Diagnostic| Stored {
            code: d.code.0,
            severity: d.severity as u8,
            at: (&d.origin).into(),
            message: (&d.message).into(),
            help: (&d.help).into(),
            labels: d
                .labels
                .iter()
                .map(|l| (numbers(l.span), (&l.message).into()))
                .collect(),
        };
        let more = found.left_out().into_iter();
        StoredDiagnostics {
            list: found.iter().map(one).collect(),
            more: more
                .map(|(at, code, severity, count)| (at.into(), code.0, severity as u8, count))
                .collect(),
        }
    }
}

impl From<StoredDiagnostics> for Diagnostics {
    fn from(stored: StoredDiagnostics) -> Diagnostics {
        let mut found = Diagnostics::new();
        for one in stored.list {
            let labels = one.labels.into_iter().map(|(at, words)| Label {
                span: span(at),
                message: words.into(),
            });
            found.push(Diagnostic {
                code: Code(one.code),
                severity: severity(one.severity),
                origin: one.at.into(),
                message: one.message.into(),
                help: one.help.into(),
                labels: labels.collect(),
                fixes: vec![],
            });
        }
        for (at, code, kind, count) in stored.more {
            found.count_more(at.into(), Code(code), severity(kind), count);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text;

    #[test]
    fn what_was_found_comes_back() {
        let mut found = Diagnostics::new();
        let feature = |key: usize| Origin::Feature {
            layer: "家".into(),
            key: format!("{key:03}").into(),
        };
        for key in 0..30 {
            let message = text!([key] "house {key}", "家 {key}");
            found.push(Diagnostic::warning(413, feature(key), message).help("help"));
        }
        let place = span([2, 5, 9]);
        let error = Diagnostic::error(410, place, "no wall").label(span([0, 1, 2]), "here");
        found.push(error.fix("mend", place, "x"));
        let json = serde_json::to_string(&StoredDiagnostics::from(&found)).expect("is JSON");
        let stored: StoredDiagnostics = serde_json::from_str(&json).expect("is the same");
        let mut wanted = found.clone();
        wanted.retain_fixes(|_| false);
        let back = Diagnostics::from(stored);
        assert_eq!(back.counts(), found.counts());
        assert_eq!(back.into_sorted(), wanted.into_sorted());
    }
}
