//! A text and how it is read, and what hsd has to say of it.

use hsd::diagnostic::Origin;
use hsd::report::{Format, Report, Style};
use hsd::scene::Shown;
use hsd::source::Limits;
use hsd::town::{self, TownInput};
use hsd::{Detail, Diagnostics, FileId, FolderWorld, Language, Options, Severity, Source};
use pyo3::FromPyObject;
use std::io;
use std::path::{Path, PathBuf};

/// A text and how it is read; the package's `_Job`.
#[derive(Debug, FromPyObject)]
pub(crate) struct Job {
    /// The text; without one it is that of the file.
    text: Option<String>,
    /// The name of the file in messages.
    name: String,
    /// Images and included files are found here and in `textures` below it.
    folder: PathBuf,
    parameters: Vec<(String, String)>,
    seed: Option<u64>,
    /// 0 to 3, which Python has checked.
    detail: u8,
    cutaway: bool,
    storey: Option<u32>,
    japanese: bool,
}

/// A message: code, severity, message, fix, file, line and column from 1, and the layer and key of a feature. What it is about has a
/// place or is a feature.
pub(crate) type Told = (
    String,
    &'static str,
    String,
    String,
    Option<String>,
    Option<usize>,
    Option<usize>,
    Option<(String, String)>,
);

/// The messages, and these with excerpts.
type Messages = (Vec<Told>, String);

impl Job {
    /// Makes the model; without bytes if there are errors.
    ///
    /// # Errors If the file cannot be read.
    pub(crate) fn compile(self) -> io::Result<(Option<Vec<u8>>, Vec<Told>, String)> {
        let (source, world, options) = self.read()?;
        let mut out = Diagnostics::new();
        let compiled = hsd::compile(&[&source], &world, &options, &mut out);
        let glb = (!out.has_errors()).then(|| hsd::glb(&compiled, &world, &options, &mut out));
        let glb = glb.filter(|_| !out.has_errors());
        let (list, report) = self.told(source, compiled.included, out)?;
        Ok((glb, list, report))
    }

    /// Finds what is wrong; in a town with its maps.
    ///
    /// # Errors If the file cannot be read.
    pub(crate) fn check(self) -> io::Result<Messages> {
        let (source, world, options) = self.read()?;
        let mut out = Diagnostics::new();
        let mut checked = hsd::check(&[&source], &world, &options, &mut out);
        if checked.is_town {
            let input = TownInput::new(&source, &world, &options);
            town::check(input, &mut checked.included, &|| true, &mut out);
        }
        self.told(source, checked.included, out)
    }

    fn read(&self) -> io::Result<(Source, FolderWorld, Options)> {
        let bytes = match &self.text {
            Some(text) => text.clone().into_bytes(),
            None => std::fs::read(&self.name)?,
        };
        let mut options = Options {
            parameters: self.parameters.clone(),
            detail: Detail::ALL[usize::from(self.detail).min(3)],
            shown: match self.storey {
                Some(most) => Shown::Storeys(most),
                None if self.cutaway => Shown::Roofless,
                None => Shown::Whole,
            },
            ..Options::default()
        };
        options.expand.seed = self.seed;
        // Names in messages would begin with "./".
        let below = match self.folder == Path::new(".") {
            true => Path::new(""),
            false => &self.folder,
        };
        let folders = vec![self.folder.clone(), below.join("textures")];
        let world = FolderWorld::new(folders, Limits::default().pixels);
        let world = world.with_roots(vec![self.folder.clone()]);
        let source = Source::new(FileId(0), &self.name, &bytes);
        Ok((source, world, options))
    }

    fn told(
        &self,
        source: Source,
        included: Vec<Source>,
        out: Diagnostics,
    ) -> io::Result<Messages> {
        let language = match self.japanese {
            true => Language::Japanese,
            false => Language::English,
        };
        let list = out.into_sorted();
        let mut sources = vec![source];
        sources.extend(included);
        let one = |d: &hsd::Diagnostic| {
            let (place, feature) = match &d.origin {
                Origin::Source(span) => {
                    let source = sources.iter().find(|source| source.id() == span.file);
                    let place = source.map(|s| (s.name().to_owned(), s.line_column(*span)));
                    (place, None)
                }
                Origin::Feature { layer, key } => {
                    (None, Some((layer.to_string(), key.to_string())))
                }
            };
            let (file, (line, column)) = match place {
                Some((file, (line, column))) => (Some(file), (Some(line), Some(column))),
                None => (None, (None, None)),
            };
            let severity = match d.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Note => "note",
            };
            let message = d.full_message().in_language(language).into_owned();
            let help = d.help.in_language(language).into_owned();
            (
                d.code.to_string(),
                severity,
                message,
                help,
                file,
                line,
                column,
                feature,
            )
        };
        let told = list.iter().map(one).collect();
        let mut report = vec![];
        let written = Report::new(&sources, &list).in_language(language);
        written.write(Format::Human, Style::default(), &mut report)?;
        Ok((told, String::from_utf8_lossy(&report).into_owned()))
    }
}
