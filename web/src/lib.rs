//! hsd in a browser: compiles a text to a model, as `hsd build` does, the same bytes.
//!
//! A page writes a job as JSON to what [`input`] returns, calls [`compile`], and reads the model and the messages. A fault ends the
//! module, which the page then begins anew.

use hsd::diagnostic::Origin;
use hsd::{Detail, Diagnostic, Diagnostics, FileId, Language, NoFiles, Options, Severity, Source};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A text and how it is read.
#[derive(Debug, Deserialize)]
struct Job {
    /// The name of the text, in messages and in the model.
    name: String,
    text: String,
    parameters: BTreeMap<String, String>,
    /// 0 to 3.
    detail: u8,
    japanese: bool,
}

/// What came of it.
#[derive(Debug, Default)]
struct Made {
    /// A `.glb`; empty if the text has errors.
    model: Vec<u8>,
    /// What was found, a line each.
    messages: String,
}

static INPUT: Mutex<Vec<u8>> = Mutex::new(vec![]);
static MADE: Mutex<Made> = Mutex::new(Made {
    model: vec![],
    messages: String::new(),
});

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the place for a job of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn input(length: usize) -> *mut u8 {
    let mut input = locked(&INPUT);
    *input = vec![0; length];
    input.as_mut_ptr()
}

/// Does the job; returns the number of bytes of its model, 0 if there is none.
#[unsafe(no_mangle)]
pub extern "C" fn compile() -> usize {
    let made = made(&locked(&INPUT));
    let length = made.model.len();
    *locked(&MADE) = made;
    length
}

/// Returns the model, of as many bytes as [`compile`] has said.
#[unsafe(no_mangle)]
pub extern "C" fn model() -> *const u8 {
    locked(&MADE).model.as_ptr()
}

/// Returns the messages, UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn messages() -> *const u8 {
    locked(&MADE).messages.as_ptr()
}

/// Returns the number of their bytes.
#[unsafe(no_mangle)]
pub extern "C" fn messages_length() -> usize {
    locked(&MADE).messages.len()
}

fn made(job: &[u8]) -> Made {
    match serde_json::from_slice(job) {
        Ok(job) => compiled(job),
        Err(error) => Made {
            messages: error.to_string(),
            ..Made::default()
        },
    }
}

fn compiled(job: Job) -> Made {
    let options = Options {
        parameters: job.parameters.into_iter().collect(),
        detail: Detail::ALL[usize::from(job.detail).min(3)],
        ..Options::default()
    };
    let source = Source::new(FileId(0), &job.name, job.text.as_bytes());
    let mut out = Diagnostics::new();
    let compiled = hsd::compile(&[&source], &NoFiles, &options, &mut out);
    let glb = (!out.has_errors()).then(|| hsd::glb(&compiled, &NoFiles, &options, &mut out));
    let model = glb.filter(|_| !out.has_errors()).unwrap_or_default();
    let language = match job.japanese {
        true => Language::Japanese,
        false => Language::English,
    };
    let list = out.into_sorted();
    let lines = list.iter().map(|found| line(found, &source, language));
    Made {
        model,
        messages: lines.collect(),
    }
}

/// Returns a line for what was found: its place, if that is in the text, what it is, and what to do.
fn line(found: &Diagnostic, text: &Source, language: Language) -> String {
    let place = match found.origin {
        Origin::Source(span) if span.file == text.id() => {
            let (line, column) = text.line_column(span);
            format!("{line}:{column}: ")
        }
        _ => String::new(),
    };
    let severity = match found.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let message = found.full_message().in_language(language).into_owned();
    let help = found.help.in_language(language);
    format!("{place}{severity}[{}]: {message} ({help})\n", found.code)
}
