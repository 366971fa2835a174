//! Options shared by several subcommands.

use super::{Exit, Failure};
use crate::files::input::{Inputs, STDIN};
pub(super) use crate::files::messages::report;
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::{Diagnostics, Severity};
use hsd_base::source::Limits;
use hsd_base::text;
use hsd_driver::fs::FolderWorld;
use hsd_passes::expand;
use hsd_report::Format;
use hsd_scene::{Detail, Shown};
use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;
use std::ops::Deref;
use std::path::{Path, PathBuf};

/// Input files and the options for reading them.
#[derive(Clone, Debug, Args, Deserialize, Serialize)]
pub(super) struct InputArgs {
    /// House files to read; `-` for standard input.
    #[arg(required = true, value_name = "IN")]
    pub(super) inputs: Vec<PathBuf>,

    #[command(flatten)]
    pub(super) read_args: ReadArgs,
}

impl Deref for InputArgs {
    type Target = ReadArgs;

    fn deref(&self) -> &ReadArgs {
        &self.read_args
    }
}

/// Options for reading source files.
#[derive(Clone, Debug, Args, Deserialize, Serialize)]
pub(super) struct ReadArgs {
    /// Search this folder for part images; repeatable.
    ///
    /// By default, the folder of each source file and its `textures` subfolder are searched.
    #[arg(long, value_name = "DIR")]
    textures: Vec<PathBuf>,

    /// Set a parameter of the source files; repeatable.
    ///
    /// `hsd params IN` lists the parameters.
    #[arg(long = "param", value_name = "NAME=VALUE", value_parser = parameter)]
    parameters: Vec<(String, String)>,

    /// Set the parameter `year`: the date that a town is shown at.
    #[arg(long, value_name = "Y", allow_hyphen_values = true)]
    year: Option<i32>,

    /// Allow includes only below this folder [default: the folder of each source file].
    #[arg(long, value_name = "DIR")]
    root: Option<PathBuf>,

    /// Load custom parts from this file; repeatable.
    ///
    /// A file `catalog.hsd` in the folder of a source file is loaded automatically.
    #[arg(long = "catalog", value_name = "FILE")]
    pub(super) catalogs: Vec<PathBuf>,

    /// Override the random seed of every house.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// Treat warnings as errors.
    #[arg(short = 'D', value_name = "warnings", value_parser = ["warnings"])]
    deny: Option<String>,

    /// Reject files larger than N bytes.
    #[arg(long, value_name = "N", default_value_t = Limits::default().bytes)]
    max_bytes: usize,

    /// Reject elements nested more than N levels deep.
    #[arg(long, value_name = "N", default_value_t = Limits::default().nesting)]
    max_nesting: usize,

    /// Reject source files with more than N includes.
    #[arg(long, value_name = "N", default_value_t = Limits::default().includes)]
    max_includes: usize,

    /// Reject files that include more than N bytes together.
    #[arg(long, value_name = "N", default_value_t = Limits::default().included_bytes)]
    max_included_bytes: usize,

    /// Reject houses with more than N parts after expansion.
    #[arg(long, value_name = "N", default_value_t = Limits::default().parts)]
    max_parts: usize,

    /// Reject houses that bring the parts which repetitions add in all of them above N.
    #[arg(long, value_name = "N", default_value_t = Limits::default().repeated_parts)]
    max_repeated_parts: usize,

    /// Reject houses that show more than N triangles at the level of detail.
    #[arg(long, value_name = "N", default_value_t = Limits::default().triangles)]
    max_triangles: usize,

    /// Build at most N variants; fewer of source files above 16 KiB.
    #[arg(long, value_name = "N", default_value_t = Limits::default().variants)]
    max_variants: u32,

    /// Reject images with more than N pixels.
    #[arg(long, value_name = "N", default_value_t = Limits::default().pixels)]
    max_pixels: u64,

    #[command(flatten)]
    memory_args: MemoryArgs,

    /// Use N threads; one per processor by default.
    ///
    /// The result is the same for any number.
    #[arg(long, value_name = "N")]
    #[serde(skip)]
    threads: Option<NonZeroUsize>,
}

impl InputArgs {
    /// Returns the files that the command line names.
    pub(super) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.inputs.iter().chain(&self.catalogs)
    }

    /// Returns the same with other paths.
    pub(super) fn moved(self, to: &dyn Fn(&Path) -> PathBuf) -> InputArgs {
        let all = |paths: Vec<PathBuf>| paths.iter().map(|path| to(path)).collect();
        let read = self.read_args;
        InputArgs {
            inputs: all(self.inputs),
            read_args: ReadArgs {
                textures: all(read.textures),
                root: read.root.map(|root| to(&root)),
                catalogs: all(read.catalogs),
                ..read
            },
        }
    }
}

/// The memory of a run for what its files expand to.
#[derive(Clone, Copy, Debug, Args, Deserialize, Serialize)]
pub(super) struct MemoryArgs {
    /// Reject maps and plans that expand to more than about N bytes of memory beyond what they write out.
    #[arg(long, value_name = "N", default_value_t = Limits::default().memory)]
    pub(super) max_memory: u64,
}

/// The level of detail of a model.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct DetailArgs {
    /// Set the level of detail: 0 walls and roofs, 1 a texture per part, 2 openings and heavy bars as geometry,
    /// 3 everything as geometry.
    #[arg(long, value_name = "0..3", default_value_t = 3, value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: u8,
    /// Leave out roofs, and the ceilings of the highest storey.
    #[arg(long, conflicts_with = "storey")]
    cutaway: bool,
    /// Show the storeys up to this one, counted from 1, open above.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    storey: Option<u32>,
}

impl DetailArgs {
    pub(super) fn detail(self) -> Detail {
        Detail::ALL[usize::from(self.detail)]
    }

    /// Returns how much of each house is shown.
    pub(super) fn shown(self) -> Shown {
        match self.storey {
            Some(most) => Shown::Storeys(most),
            None if self.cutaway => Shown::Roofless,
            None => Shown::Whole,
        }
    }
}

impl ReadArgs {
    pub(super) fn limits(&self) -> Limits {
        Limits {
            bytes: self.max_bytes.min(u32::MAX as usize), // spans count in 32 bits
            nesting: self.max_nesting,
            includes: self.max_includes,
            included_bytes: self.max_included_bytes,
            parts: self.max_parts,
            repeated_parts: self.max_repeated_parts,
            triangles: self.max_triangles,
            variants: self.max_variants,
            pixels: self.max_pixels,
            memory: self.memory_args.max_memory,
        }
    }

    /// Returns the compiler options, at full detail. Sources of custom parts are numbered after the inputs.
    pub(super) fn options(
        &self,
        inputs: &Inputs,
        out: &mut Diagnostics,
    ) -> Result<hsd_driver::Options, Failure> {
        let expand = expand::Options {
            seed: self.seed,
            limits: self.limits(),
        };
        if let Some(threads) = self.threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.get());
            // A command that reads several times has its threads already.
            let _ = pool.build_global();
        }
        let first = inputs.sources.len() as u32;
        let catalogs = Inputs::from(first, &self.catalogs, self.max_bytes, out)?;
        let mut parameters = self.parameters.clone();
        parameters.extend(self.year.map(|year| ("year".to_owned(), year.to_string())));
        Ok(hsd_driver::Options {
            expand,
            parameters,
            catalogs: catalogs.accepted().into_iter().cloned().collect(),
            ..hsd_driver::Options::default()
        })
    }

    /// Returns the seed of the first variant: `--seed`, or 0.
    pub(super) fn first_seed(&self) -> u64 {
        self.seed.unwrap_or(0)
    }

    /// Returns the folders searched for part images of `inputs`.
    pub(super) fn folders(&self, inputs: &[PathBuf]) -> Vec<PathBuf> {
        if !self.textures.is_empty() {
            return self.textures.clone();
        }
        let mut folders = vec![];
        for own in inputs.iter().map(|input| home(input)) {
            // Joined to ".", file names in diagnostics would begin with "./".
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

    /// Returns the folders of the custom part files.
    pub(super) fn catalog_folders(&self) -> impl Iterator<Item = PathBuf> {
        self.catalogs.iter().map(|file| home(file).to_owned())
    }

    /// Returns the file access for `inputs`: image folders and include roots.
    pub(super) fn world(&self, inputs: &[PathBuf]) -> FolderWorld {
        let pictures = FolderWorld::new(self.folders(inputs), self.max_pixels)
            .with_memory(self.memory_args.max_memory);
        pictures.with_roots(self.roots(inputs))
    }

    /// Returns the folders below which includes are allowed.
    pub(super) fn roots(&self, inputs: &[PathBuf]) -> Vec<PathBuf> {
        match &self.root {
            Some(root) => vec![root.clone()],
            None => inputs.iter().map(|input| home(input).to_owned()).collect(),
        }
    }

    /// Fails if a folder named on the command line does not exist.
    pub(super) fn check_folders(&self) -> Result<(), Failure> {
        let mut named = self.textures.iter().chain(&self.root);
        match named.find(|f| !f.is_dir()) {
            Some(f) => {
                let shown = f.display();
                Err(Failure::Io(text!([shown]
                    "{shown}: no such folder",
                    "{shown}: そのようなフォルダーはありません"
                )))
            }
            None => Ok(()),
        }
    }

    /// Returns whether a diagnostic of this severity makes the run fail.
    pub(super) fn spoils(&self, severity: Severity) -> bool {
        match severity {
            Severity::Error => true,
            Severity::Warning => self.deny.is_some(),
            Severity::Note => false,
        }
    }
}

/// Returns the folder of an input file; `.` for standard input.
fn home(input: &Path) -> &Path {
    match input.parent() {
        _ if input.as_os_str() == STDIN => Path::new("."),
        None => Path::new("."),
        Some(parent) if parent.as_os_str().is_empty() => Path::new("."),
        Some(parent) => parent,
    }
}

/// Parses a parameter assignment such as `frontage=5`.
fn parameter(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.to_owned()))
        }
        _ => Err("expected NAME=VALUE, as in `frontage=5`".into()),
    }
}

/// Output formats of diagnostics.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(super) enum FormatArg {
    /// With source excerpts.
    #[default]
    Human,
    /// One line per diagnostic, for editors.
    Short,
    /// A JSON array, for programs.
    Json,
    /// SARIF 2.1.0, for code scanning services.
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

/// Returns exit status 1 if the input has errors, otherwise 0.
pub(super) fn exit(spoiled: bool) -> Exit {
    if spoiled { Exit::Errors } else { Exit::Done }
}
