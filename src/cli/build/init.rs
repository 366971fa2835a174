//! `hsd town init`: writes a first town from maps.

use super::town::Town;
use super::town::candidates::Candidates;
use crate::cli::files::output::{self, Files};
use crate::cli::files::terminal::counted;
use crate::cli::options::report;
use crate::cli::{Exit, Failure, Outcome};
use crate::diagnostic::{Diagnostics, Language, Origin, noun};
use crate::fs::FolderWorld;
use crate::map;
use crate::report::{Format, Report};
use crate::source::World;
use crate::survey::{self, Surveyed};
use crate::text;
use clap::{ArgMatches, Args, Command, Error, FromArgMatches, Subcommand};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// `hsd town`: builds a town, or one of its steps. It has the arguments and the help of [`Town`].
#[derive(Debug)]
pub(in crate::cli) enum TownCommand {
    Build(Box<Town>),
    Step(Step),
}

#[derive(Debug, Subcommand)]
pub(in crate::cli) enum Step {
    Init(Init),
    Candidates(Box<Candidates>),
}

impl TownCommand {
    pub(in crate::cli) fn run(&self, language: Language) -> Outcome {
        match self {
            TownCommand::Build(build) => build.run(language),
            TownCommand::Step(Step::Init(init)) => init.run(language),
            TownCommand::Step(Step::Candidates(candidates)) => candidates.run(language),
        }
    }
}

impl Args for TownCommand {
    fn augment_args(command: Command) -> Command {
        Step::augment_subcommands(Town::augment_args(command))
            .args_conflicts_with_subcommands(true)
            .subcommand_negates_reqs(true)
            .subcommand_required(false)
            .disable_help_subcommand(true)
    }

    fn augment_args_for_update(command: Command) -> Command {
        TownCommand::augment_args(command)
    }
}

impl FromArgMatches for TownCommand {
    fn from_arg_matches(found: &ArgMatches) -> Result<TownCommand, Error> {
        match found.subcommand_name() {
            Some(_) => Step::from_arg_matches(found).map(TownCommand::Step),
            None => Town::from_arg_matches(found).map(|t| TownCommand::Build(Box::new(t))),
        }
    }

    fn update_from_arg_matches(&mut self, found: &ArgMatches) -> Result<(), Error> {
        *self = TownCommand::from_arg_matches(found)?;
        Ok(())
    }
}

/// Write a first town from maps: a source file to change and to build.
///
/// Finds what the layers of the maps are (buildings, lots, streets, places) from their geometry and fields, and what
/// fields mean (storeys, heights, kinds). The maps must lie in the folder of TOWN or below it.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd town init buildings.geojson roads.geojson -o kyoto.hsd
  hsd town kyoto.hsd -o kyoto.glb")]
pub(in crate::cli) struct Init {
    /// Maps: GeoJSON, Shapefile, FlatGeobuf, OpenStreetMap, map XML of the land registry, CityGML, CSV of points, grids of heights (GeoTIFF, ESRI ASCII, GSI).
    #[arg(required = true, value_name = "MAP")]
    maps: Vec<PathBuf>,

    /// Write the town to this file.
    #[arg(short, long, value_name = "TOWN")]
    output: PathBuf,

    /// Replace the file if it exists.
    #[arg(long)]
    force: bool,
}

impl Init {
    fn run(&self, language: Language) -> Outcome {
        if self.output.exists() && !self.force {
            let name = self.output.display();
            return Err(Failure::Usage(text!([name]
                "{name} exists; `--force` replaces it",
                "{name} はすでにあります。置き換えるなら `--force` を付けてください"
            )));
        }
        let folder = output::folder_of(&self.output);
        let world = FolderWorld::new(vec![], 0).with_roots(vec![folder.to_owned()]);
        let from = self.output.to_string_lossy();
        let (mut layers, mut out): (Vec<Surveyed>, _) = (vec![], Diagnostics::new());
        for map in &self.maps {
            let src = below(map, folder)?;
            let path = world.text(&from, &src).map_err(|_| outside(map))?;
            match survey::survey(&world, &path, &src) {
                Ok(found) => layers.extend(found),
                Err(fault) => {
                    let (layer, key) = (src.as_str().into(), "-".into());
                    out.push(map::diagnostic(&fault, 1, Origin::Feature { layer, key }));
                }
            }
        }
        for layer in &layers {
            layer.faults.report(&layer.src, None, &mut out);
        }
        let unread = out.has_errors() && layers.is_empty();
        let list = out.into_sorted();
        if !list.is_empty() {
            let written = Report::new(&[], &list).in_language(language);
            report(&written, Format::Human, &mut io::stderr())?;
        }
        if unread {
            return Ok(Exit::Errors);
        }
        let name = self
            .output
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy();
        let town = survey::town(&name, &layers);
        output::write(&self.output, Files::bytes(town.into_bytes()))?;
        let name = self.output.display();
        let layers = counted(layers.len(), noun("layer", "レイヤー{}枚"));
        let line = text!([name, layers]
            "{name}: {layers}; read the comments, then build it with `hsd town {name} -o OUT`",
            "{name}: {layers}。注釈を読んでから `hsd town {name} -o OUT` で作れます"
        );
        writeln!(io::stderr(), "{}", line.in_language(language))?;
        Ok(Exit::Done)
    }
}

/// Returns the path of a map from the folder of the town.
fn below(map: &Path, folder: &Path) -> Result<String, Failure> {
    let real = |path: &Path| {
        let path = if path.as_os_str().is_empty() {
            Path::new(".")
        } else {
            path
        };
        path.canonicalize()
            .map_err(|e| Failure::at(path.display(), e))
    };
    let (map_path, folder) = (real(map)?, real(folder)?);
    let inside = map_path.strip_prefix(&folder).map_err(|_| outside(map))?;
    let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
    Ok(parts.join("/"))
}

fn outside(map: &Path) -> Failure {
    let map = map.display();
    Failure::Usage(text!([map]
        "{map} lies outside the folder of the town, and a town reads only what lies below it: write the town beside the map",
        "{map} は町のフォルダーの外にあります。町が読むのはそのフォルダーより下だけです。町のファイルを地図の隣に書いてください"
    ))
}
