//! `--messages`: what a command says while it makes something, to people on standard error or to a program on standard output
//! (docs/contract.md 5).

use crate::Failure;
use crate::files::input::STDIN;
use crate::files::terminal;
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::{Diagnostic, Language};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_report::{Format, Report};
use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};
use std::collections::BTreeSet;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// The form of messages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum MessageFormat {
    /// With source excerpts, on standard error.
    #[default]
    Human,
    /// JSON on standard output, an object a line, for programs.
    Json,
}

/// The option of commands that make something.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct MessageArgs {
    /// Set the form of messages.
    ///
    /// `json` writes nothing else: `{"kind":"built","output","messages","files"}` for each output, with the messages of
    /// `hsd check --format json`, `null` for an output that was not written, and the files that it was made from;
    /// before it, where it takes long, `{"kind":"progress","done","of"}`. What cannot be read or written is told on standard error.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    messages: MessageFormat,
}

impl MessageArgs {
    /// Returns what tells messages in this form.
    pub(crate) fn teller(self, language: Language) -> Teller {
        Teller {
            json: self.messages == MessageFormat::Json,
            language,
        }
    }

    /// Fails if an output goes where the messages go.
    pub(crate) fn check(self, output: &Path) -> Result<(), Failure> {
        match self.messages == MessageFormat::Json && output.as_os_str() == STDIN {
            true => Err(Failure::Usage(text!(
                "`--messages json` needs standard output: name a file with -o, as in `-o house.glb`",
                "`--messages json` は標準出力を使います。`-o house.glb` のように -o でファイルを指定してください"
            ))),
            false => Ok(()),
        }
    }
}

/// True once the program is part of another one, which asks for messages where it wants them.
static SILENT: AtomicBool = AtomicBool::new(false);

/// Leaves messages for people to the program that this one is part of.
pub(crate) fn leave_people() {
    SILENT.store(true, Ordering::Relaxed);
}

/// Tells messages to people or to a program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Teller {
    json: bool,
    /// That of the messages.
    pub(crate) language: Language,
}

/// Tells people.
impl From<Language> for Teller {
    fn from(language: Language) -> Teller {
        Teller {
            json: false,
            language,
        }
    }
}

/// The messages on an output that a program is still to be told of; none for people, who were.
#[derive(Debug)]
#[must_use]
pub(crate) struct Told(Option<Box<RawValue>>);

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Line<'a> {
    Progress {
        done: usize,
        of: usize,
    },
    Built {
        output: Option<String>,
        messages: &'a RawValue,
        files: BTreeSet<String>,
    },
}

impl Teller {
    /// Returns true if a program listens, so that nothing but messages is said.
    pub(crate) fn is_program(self) -> bool {
        self.json
    }

    /// Tells people the messages, and keeps them for a program.
    pub(crate) fn report(self, sources: &[Source], list: &[Diagnostic]) -> Result<Told, Failure> {
        let written = Report::new(sources, list).in_language(self.language);
        if self.json {
            let value = to_raw_value(&written.messages());
            return Ok(Told(Some(value.map_err(|e| Failure::json(&e))?)));
        }
        if !list.is_empty() && !SILENT.load(Ordering::Relaxed) {
            report(&written, Format::Human, &mut io::stderr())?;
        }
        Ok(Told(None))
    }

    /// Tells a program of an output, of what was found, and of the files it was made from. Those inside of hsd are left out.
    pub(crate) fn built(
        self,
        Told(messages): &Told,
        output: Option<&Path>,
        files: &[PathBuf],
    ) -> Result<(), Failure> {
        let Some(messages) = messages else {
            return Ok(());
        };
        let shown = |path: &Path| path.to_string_lossy().into_owned();
        let files = files.iter().map(|file| shown(file));
        self.line(&Line::Built {
            output: output.map(shown),
            messages,
            files: files
                .filter(|f| f != STDIN && !f.starts_with("hsd:"))
                .collect(),
        })
    }

    /// Tells a program how far a run is.
    pub(crate) fn progress(self, done: usize, of: usize) -> Result<(), Failure> {
        match self.json {
            true => self.line(&Line::Progress { done, of }),
            false => Ok(()),
        }
    }

    fn line(self, line: &Line<'_>) -> Result<(), Failure> {
        let mut text = serde_json::to_vec(line).map_err(|e| Failure::json(&e))?;
        text.push(b'\n');
        let mut stdout = io::stdout().lock();
        stdout.write_all(&text)?;
        Ok(stdout.flush()?)
    }
}

/// Writes a report to a stream, styled for a terminal if it is one.
pub(crate) fn report(
    written: &Report<'_>,
    format: Format,
    stream: &mut (impl Write + IsTerminal),
) -> Result<(), Failure> {
    let style = terminal::style(stream);
    let mut text = vec![];
    written.write(format, style, &mut text)?;
    stream.write_all(&text)?;
    Ok(stream.flush()?)
}
