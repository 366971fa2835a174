//! Options that several subcommands take.

use super::{Exit, Stop};
use crate::cli::files::input::{Inputs, STDIN};
use crate::diagnostic::{Diagnostics, Severity};
use crate::driver;
use crate::expand;
use crate::fs::FolderWorld;
use crate::report::{Format, Report};
use crate::scene::Detail;
use crate::source::Limits;
use crate::text;
use clap::{Args, ValueEnum};
use std::io::{IsTerminal, Write};
use std::ops::Deref;
use std::path::{Path, PathBuf};

/// What is read, and how.
#[derive(Clone, Debug, Args)]
pub(super) struct Reading {
    /// Texts of houses; `-` reads standard input.
    #[arg(required = true, value_name = "IN")]
    pub(super) inputs: Vec<PathBuf>,

    #[command(flatten)]
    pub(super) manner: Manner,
}

impl Deref for Reading {
    type Target = Manner;

    fn deref(&self) -> &Manner {
        &self.manner
    }
}

/// How texts are read.
#[derive(Clone, Debug, Args)]
pub(super) struct Manner {
    /// Look for part pictures in this folder; may be given several times.
    ///
    /// Without it they are looked for in the folder of each text and in its folder `textures`.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,

    /// Set a parameter of the houses; may be given several times. `hsd params IN` lists them.
    #[arg(long = "param", value_name = "NAME=VALUE", value_parser = parameter)]
    parameters: Vec<(String, String)>,

    /// The folder below which included files lie; without it the folder of each text.
    #[arg(long, value_name = "DIR")]
    root: Option<PathBuf>,

    /// Take own parts from this file; may be given several times.
    ///
    /// A file `catalog.hsd` beside a text is taken without being named.
    #[arg(long = "catalog", value_name = "FILE")]
    pub(super) catalogs: Vec<PathBuf>,

    /// Draw everything random with this number instead of the seed of the house.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// Treat warnings as errors.
    #[arg(short = 'D', value_name = "warnings", value_parser = ["warnings"])]
    deny: Option<String>,

    /// Refuse files with more bytes.
    #[arg(long, value_name = "N", default_value_t = Limits::default().bytes)]
    max_bytes: usize,

    /// Refuse elements nested deeper.
    #[arg(long, value_name = "N", default_value_t = Limits::default().nesting)]
    max_nesting: usize,

    /// Refuse to include more files.
    #[arg(long, value_name = "N", default_value_t = Limits::default().includes)]
    max_includes: usize,

    /// Refuse houses with more parts, repeats counted out.
    #[arg(long, value_name = "N", default_value_t = Limits::default().parts)]
    max_parts: usize,

    /// Refuse pictures with more pixels.
    #[arg(long, value_name = "N", default_value_t = Limits::default().pixels)]
    max_pixels: u64,
}

/// How fine what is built is.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct Fineness {
    /// How much of the joinery is shape: 0 walls and roofs, 1 a picture for each part, 2 openings and heavy
    /// bars as shapes, 3 everything.
    #[arg(long, value_name = "0..3", default_value_t = 3, value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: u8,
}

impl Fineness {
    pub(super) fn detail(self) -> Detail {
        Detail::ALL[usize::from(self.detail)]
    }
}

impl Manner {
    pub(super) fn limits(&self) -> Limits {
        Limits {
            bytes: self.max_bytes.min(u32::MAX as usize), // spans count in 32 bits
            nesting: self.max_nesting,
            includes: self.max_includes,
            parts: self.max_parts,
            pixels: self.max_pixels,
        }
    }

    /// What a run is to do; all of the joinery is shape. The files of own parts are numbered behind the inputs.
    pub(super) fn options(
        &self,
        inputs: &Inputs,
        out: &mut Diagnostics,
    ) -> Result<driver::Options, Stop> {
        let expand = expand::Options {
            seed: self.seed,
            limits: self.limits(),
        };
        let first = inputs.sources.len();
        let catalogs = Inputs::from(first, &self.catalogs, self.max_bytes, out)?;
        Ok(driver::Options {
            expand,
            parameters: self.parameters.clone(),
            catalogs: catalogs.accepted().into_iter().cloned().collect(),
            ..driver::Options::default()
        })
    }

    /// The seed that draws begin with where nobody gives one.
    pub(super) fn first_seed(&self) -> u64 {
        self.seed.unwrap_or(0)
    }

    /// The texture folders for some of the inputs.
    pub(super) fn folders(&self, inputs: &[PathBuf]) -> Vec<PathBuf> {
        if !self.textures.is_empty() {
            return self.textures.clone();
        }
        let mut folders = vec![];
        for own in inputs.iter().map(|input| home(input)) {
            // Joined to ".", names in messages would begin with "./".
            let below = if own == Path::new(".") {
                Path::new("")
            } else {
                own
            };
            for folder in [own.to_owned(), below.join("textures")] {
                if !folders.contains(&folder) {
                    folders.push(folder);
                }
            }
        }
        folders
    }

    /// The folders of the files of own parts.
    pub(super) fn catalog_folders(&self) -> impl Iterator<Item = PathBuf> {
        self.catalogs.iter().map(|file| home(file).to_owned())
    }

    /// The world of some of the inputs.
    pub(super) fn world(&self, inputs: &[PathBuf]) -> FolderWorld {
        let pictures = FolderWorld::new(self.folders(inputs), self.max_pixels);
        pictures.with_roots(self.roots(inputs))
    }

    /// The folders below which texts may be included.
    pub(super) fn roots(&self, inputs: &[PathBuf]) -> Vec<PathBuf> {
        match &self.root {
            Some(root) => vec![root.clone()],
            None => inputs.iter().map(|input| home(input).to_owned()).collect(),
        }
    }

    /// Fails for folders that were named and are none.
    pub(super) fn check_folders(&self) -> Result<(), Stop> {
        let mut named = self.textures.iter().chain(&self.root);
        match named.find(|f| !f.is_dir()) {
            Some(f) => {
                let shown = f.display();
                Err(Stop::Io(text!(
                    "{shown}: there is no such folder",
                    "{shown}: そのようなフォルダーはありません"
                )))
            }
            None => Ok(()),
        }
    }

    /// Whether messages of this severity spoil a run.
    pub(super) fn spoils(&self, severity: Severity) -> bool {
        match severity {
            Severity::Error => true,
            Severity::Warning => self.deny.is_some(),
            Severity::Note => false,
        }
    }
}

/// The folder of an input.
fn home(input: &Path) -> &Path {
    match input.parent() {
        _ if input.as_os_str() == STDIN => Path::new("."),
        None => Path::new("."),
        Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
        Some(parent) => parent,
    }
}

/// `frontage=5`.
fn parameter(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.to_owned()))
        }
        _ => Err("a parameter is set as in `frontage=5`".into()),
    }
}

/// The formats of `--format`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(super) enum FormatArg {
    /// With the lines in question.
    #[default]
    Human,
    /// A line each, for editors.
    Short,
    /// One array, for programs.
    Json,
    /// SARIF 2.1.0, for code-scanning services.
    Sarif,
}

impl From<FormatArg> for Format {
    fn from(format: FormatArg) -> Format {
        match format {
            FormatArg::Human => Format::Human,
            FormatArg::Short => Format::Short,
            FormatArg::Json => Format::Json,
            FormatArg::Sarif => Format::Sarif,
        }
    }
}

/// Writes a report to a stream.
pub(super) fn report(
    report: &Report<'_>,
    format: Format,
    stream: &mut (impl Write + IsTerminal),
) -> Result<(), Stop> {
    let style = crate::cli::files::terminal::style(stream);
    let mut text = vec![];
    report.write(format, style, &mut text)?;
    stream.write_all(&text)?;
    Ok(stream.flush()?)
}

/// 1 where the input is spoiled.
pub(super) fn exit(spoiled: bool) -> Exit {
    if spoiled { Exit::Errors } else { Exit::Done }
}
