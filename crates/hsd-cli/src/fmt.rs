//! `hsd fmt`: formats source files, in place or to other files.

use super::options::{InputArgs, report};
use super::{Exit, Failure, Outcome};
use crate::files::diff;
use crate::files::input::{Inputs, STDIN};
use crate::files::output::{Committer, Files};
use crate::files::terminal::{FILE, counted};
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::{Diagnostics, Language, visible};
use hsd_base::source::{Source, World};
use hsd_base::text;
use hsd_report::{Format, Report};
use hsd_syntax::print::{self, Form};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Format source files.
///
/// Part codes are aligned in columns, and each element gets its own line. Files are rewritten in place and keep their
/// encoding and line endings, comments, order and meaning. A file that cannot be parsed reliably (legacy form with
/// errors, XML that is not well-formed) is left unchanged.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd fmt shop.hsd                 format a source file in place
  hsd fmt --check *.hsd            list the files that would change (exit status 1)
  hsd fmt - < shop.hsd             format standard input to standard output
  hsd fmt --to xml shop.hsd -o shop-xml.hsd    convert to the XML form")]
pub(super) struct Fmt {
    #[command(flatten)]
    input_args: InputArgs,

    /// Write to this file, into this folder (`tidy/`), or to standard output (`-`) instead of in place.
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,

    /// List the files that would change and the first differences, without writing anything.
    #[arg(long, conflicts_with = "output")]
    check: bool,

    /// Convert to this form of the language; files already in it are only formatted.
    ///
    /// Anything the form cannot express is reported as an error. The legacy form has no repeats; they are expanded.
    #[arg(long, value_enum, value_name = "FORM")]
    to: Option<Notation>,
}

/// The forms of the language for `--to`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Notation {
    /// Elements and attributes.
    Xml,
    /// Lines of five-character codes.
    Legacy,
}

impl Notation {
    fn form(self) -> Form {
        match self {
            Notation::Xml => Form::Xml,
            Notation::Legacy => Form::Legacy,
        }
    }
}

/// The counts for the summary.
#[derive(Default)]
struct Tally {
    /// Files that were, or would be, changed.
    changed: usize,
    /// True if a file has errors.
    spoiled: bool,
}

impl Fmt {
    pub(super) fn run(&self, language: Language) -> Outcome {
        self.input_args.check_folders()?;
        let targets = self.targets()?;
        let committer = self.committer(&targets)?;
        let limits = self.input_args.limits();
        let mut out = Diagnostics::new();
        let inputs = Inputs::readable(&self.input_args.inputs, limits.bytes, &mut out);
        let options = self.input_args.options(&inputs, &mut out)?;
        let mut tally = Tally::default();
        let world = self.input_args.world(&self.input_args.inputs);
        let world = world.recorded_in(&committer.inputs);
        let files = self.input_args.inputs.iter().zip(&targets);
        let sources = inputs.sources.iter().zip(inputs.taken());
        for ((source, accepted), (input, target)) in sources.zip(files) {
            let text = accepted.then(|| self.text(source, &world, &options, &mut out));
            match text.flatten() {
                Some(text) => {
                    let target = (&**target, &committer.editing(input));
                    self.one(source, &text, target, &mut tally, language)?;
                }
                None => tally.spoiled = true,
            }
        }
        let list = out.into_sorted();
        if !list.is_empty() {
            let written = Report::new(&inputs.sources, &list).in_language(language);
            report(&written, Format::Human, &mut io::stderr())?;
        }
        self.sum_up(&tally, inputs.sources.len(), language)?;
        Ok(match () {
            () if inputs.failed() => Exit::Unread,
            () if tally.spoiled || self.check && tally.changed > 0 => Exit::Errors,
            () => Exit::Done,
        })
    }

    /// Returns the formatted or converted text; `None` if the source has errors.
    fn text(
        &self,
        source: &Source,
        world: &dyn World,
        options: &hsd_driver::Options,
        out: &mut Diagnostics,
    ) -> Option<String> {
        let here = Form::of(source);
        if self.to.is_none_or(|to| to.form() == here) {
            return print::format(source, &options.expand.limits, out);
        }
        hsd_driver::convert(source, world, options, out)
    }

    /// Writes one formatted text, or with `--check` prints how it would change.
    fn one(
        &self,
        source: &Source,
        text: &str,
        (target, committer): (&Path, &Committer),
        tally: &mut Tally,
        language: Language,
    ) -> Result<(), Failure> {
        let changes = text != source.text();
        tally.changed += usize::from(changes);
        if self.check {
            if changes {
                let lines = diff::short(source.text(), text, language).join("\n");
                writeln!(io::stdout(), "{}\n{lines}", visible::line(source.name()))?;
            }
            return Ok(());
        }
        let in_place = self.output.is_none() && target.as_os_str() != STDIN;
        if in_place && !changes {
            return Ok(());
        }
        if in_place && fs::metadata(target).is_ok_and(|m| m.permissions().readonly()) {
            let denied = io::Error::from(io::ErrorKind::PermissionDenied);
            return Err(Failure::at(target.display(), denied));
        }
        let bytes = print::encode(text, source);
        committer.write(target, Files::bytes(bytes)).map(drop)
    }

    /// Returns the committer of a run. Fails if an output is an input other than its own.
    fn committer(&self, targets: &[PathBuf]) -> Result<Committer, Failure> {
        let committer = Committer::reading(self.input_args.files());
        for (input, target) in self.input_args.inputs.iter().zip(targets) {
            committer.editing(input).check([target])?;
        }
        Ok(committer)
    }

    /// Returns the output path of each input.
    fn targets(&self) -> Result<Vec<PathBuf>, Failure> {
        let inputs = &self.input_args.inputs;
        let stdin = inputs.iter().filter(|i| i.as_os_str() == STDIN).count();
        if stdin > 1 {
            return Err(Failure::stdin_twice());
        }
        let Some(output) = &self.output else {
            return Ok(inputs.clone());
        };
        let folder = output
            .to_string_lossy()
            .ends_with(['/', std::path::MAIN_SEPARATOR]);
        if output.is_dir() || folder {
            fs::create_dir_all(output).map_err(|e| Failure::at(output.display(), e))?;
            return into_folder(inputs, output);
        }
        if inputs.len() > 1 {
            let shown = output.display();
            return Err(Failure::Usage(text!([shown]
                "{shown} is a single file; for several inputs name a folder, as in `-o {shown}/`",
                "{shown} に書けるテキストはひとつです。複数の場合は `-o {shown}/` のようにフォルダーを指定してください"
            )));
        }
        Ok(vec![output.clone()])
    }

    fn sum_up(&self, tally: &Tally, all: usize, language: Language) -> Result<(), Failure> {
        let stdout = |path: &PathBuf| path.as_os_str() == STDIN;
        if self.output.is_some() || self.input_args.inputs.iter().any(stdout) {
            return Ok(());
        }
        let (files, changed) = (counted(all, FILE), tally.changed);
        let written = if self.check {
            text!([files, changed]
                "{files}, {changed} would be reformatted",
                "{files}中 {changed} が整形の対象です"
            )
        } else {
            text!([files, changed] "{files}, {changed} reformatted", "{files}中 {changed} を整形しました")
        };
        writeln!(io::stderr(), "{}", written.in_language(language))?;
        Ok(())
    }
}

/// Returns a path in `folder` for each input, with the same file name.
fn into_folder(inputs: &[PathBuf], folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut taken = std::collections::BTreeMap::new();
    let mut targets = vec![];
    for input in inputs {
        let name = match input.as_os_str() == STDIN {
            true => Path::new("stdin.hsd").as_os_str(),
            false => input.file_name().unwrap_or_default(),
        };
        let target = folder.join(name);
        if let Some(other) = taken.insert(target.to_string_lossy().to_lowercase(), input) {
            return Err(Failure::one_output(other, input, &target));
        }
        targets.push(target);
    }
    Ok(targets)
}
