//! `hsd town init`: writes a first town from maps.

use super::steps::{TownPlan, TownSeal, TownTile};
use super::town::Town;
use super::town::candidates::Candidates;
use crate::files::output::{self, Committer, Files};
use crate::files::terminal::counted;
use crate::options::{MemoryArgs, report};
use crate::{Exit, Failure, Outcome};
use clap::{ArgMatches, Args, Command, Error, FromArgMatches, Subcommand};
use hsd_base::diagnostic::{Diagnostic, Diagnostics, Language, Origin, Severity, Text, noun};
use hsd_base::source::World;
use hsd_base::text;
use hsd_driver::fs::FolderWorld;
use hsd_map::Fault;
use hsd_report::{Format, Report};
use hsd_town::survey::{self, Plane, Surveyed};
use rayon::prelude::*;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// `hsd town`: builds a town, or one of its steps. It has the arguments and the help of [`Town`].
#[derive(Debug)]
pub(crate) enum TownCommand {
    Build(Box<Town>),
    Step(Step),
}

#[derive(Debug, Subcommand)]
pub(crate) enum Step {
    Init(Init),
    Candidates(Box<Candidates>),
    Plan(Box<TownPlan>),
    Tile(TownTile),
    Seal(TownSeal),
}

impl TownCommand {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        match self {
            TownCommand::Build(build) => build.run(language),
            TownCommand::Step(Step::Init(init)) => init.run(language),
            TownCommand::Step(Step::Candidates(candidates)) => candidates.run(language),
            TownCommand::Step(Step::Plan(plan)) => plan.run(language),
            TownCommand::Step(Step::Tile(tile)) => tile.run(language),
            TownCommand::Step(Step::Seal(seal)) => seal.run(language),
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
/// fields mean (storeys, heights, kinds). Files of one kind beside each other, as the sheets of a map, become one layer.
/// The maps must lie in the folder of TOWN or below it.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd town init buildings.geojson roads.geojson -o kyoto.hsd
  hsd town init sheets/ -o joetsu.hsd
  hsd town kyoto.hsd -o kyoto.glb")]
pub(crate) struct Init {
    /// Maps: GeoJSON, Shapefile, FlatGeobuf, OpenStreetMap, map XML of the land registry, CityGML, CSV of points, grids of heights (GeoTIFF, ESRI ASCII, GSI). Of a folder, all maps in it.
    #[arg(required = true, value_name = "MAP")]
    maps: Vec<PathBuf>,

    /// Write the town to this file.
    #[arg(short, long, value_name = "TOWN")]
    output: PathBuf,

    /// Replace the file if it exists.
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    memory_args: MemoryArgs,
}

/// Returns the error of a map that gives no layer.
fn unreadable(src: &str, fault: &Fault) -> Diagnostic {
    let (layer, key) = (src.into(), "-".into());
    let mut said = hsd_map::diagnostic(fault, 1, Origin::Feature { layer, key });
    said.severity = Severity::Error;
    said
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
        let committer = Committer::reading(&self.maps);
        let folder = output::folder_of(&self.output);
        let world = FolderWorld::new(vec![], 0).with_roots(vec![folder.to_owned()]);
        let world = world.with_memory(self.memory_args.max_memory);
        let world = world.recorded_in(&committer.inputs);
        let mut out = Diagnostics::new();
        let (layers, unread) = self.survey(&world, folder, &mut out)?;
        committer.check([&self.output])?;
        let list = out.into_sorted();
        if !list.is_empty() {
            let written = Report::new(&[], &list).in_language(language);
            report(&written, Format::Human, &mut io::stderr())?;
        }
        if layers.is_empty() {
            return Ok(Exit::Errors);
        }
        let name = self
            .output
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy();
        let stands = survey::standing(&layers);
        let lines = layers.iter().zip(&stands);
        for line in lines.filter_map(|(layer, stands)| assumed(layer, *stands)) {
            writeln!(io::stderr(), "{}", line.in_language(language))?;
        }
        let town = survey::town(&name, &layers);
        committer.write(&self.output, Files::bytes(town.into_bytes()))?;
        let name = self.output.display();
        let layers = counted(layers.len(), noun("layer", "レイヤー{}枚"));
        let line = text!([name, layers]
            "{name}: {layers}; read the comments, then build it with `hsd town {name} -o OUT`",
            "{name}: {layers}。注釈を読んでから `hsd town {name} -o OUT` で作れます"
        );
        writeln!(io::stderr(), "{}", line.in_language(language))?;
        Ok(match unread {
            0 => Exit::Done,
            _ => Exit::Errors,
        })
    }

    /// Surveys all maps and reports their faults. Returns the layers and the number of maps that cannot be read.
    fn survey(
        &self,
        world: &FolderWorld,
        folder: &Path,
        out: &mut Diagnostics,
    ) -> Result<(Vec<Surveyed>, usize), Failure> {
        let from = self.output.to_string_lossy();
        let mut srcs = vec![];
        for map in &self.maps {
            srcs.extend(self.srcs(world, map, folder)?);
        }
        let surveyed = srcs.par_iter().map(|(map, src)| {
            let path = world.text(&from, src).map_err(|_| outside(map))?;
            Ok((src, survey::survey(world, &path, src)))
        });
        let surveyed: Result<Vec<_>, Failure> = surveyed.collect();
        let (mut layers, mut unread): (Vec<Surveyed>, usize) = (vec![], 0);
        for (src, found) in surveyed? {
            match found {
                Ok(found) => layers.extend(found),
                Err(fault) => {
                    unread += 1;
                    out.push(unreadable(src, &fault));
                }
            }
        }
        let names = |folder: &str| world.names(&from, folder).unwrap_or_default();
        let mut layers = survey::joined(layers, &names);
        layers.retain(|layer| {
            let Some(fault) = layer.no_features() else {
                return true;
            };
            unread += 1;
            out.push(unreadable(&layer.src, &fault));
            false
        });
        for file in layers.iter().flat_map(|layer| &layer.files) {
            file.faults.report(&file.src, None, out);
        }
        Ok((layers, unread))
    }

    /// Returns the maps that an argument names, with their paths from the folder of the town: itself, or those in it.
    fn srcs(
        &self,
        world: &FolderWorld,
        map: &Path,
        folder: &Path,
    ) -> Result<Vec<(PathBuf, String)>, Failure> {
        let src = below(map, folder)?;
        if !map.is_dir() {
            return Ok(vec![(map.to_owned(), src)]);
        }
        let from = self.output.to_string_lossy();
        let mut names = world.names(&from, &src).map_err(|_| outside(map))?;
        names.retain(|name| survey::is_map(name));
        names.sort();
        if names.is_empty() {
            let map = map.display();
            return Err(Failure::Usage(text!([map]
                "there are no maps in {map}",
                "{map} に地図がありません"
            )));
        }
        let below = |name: &String| match src.is_empty() {
            true => name.clone(),
            false => format!("{src}/{name}"),
        };
        let srcs = names.iter().map(|name| (map.join(name), below(name)));
        Ok(srcs.collect())
    }
}

/// Returns what was assumed of the coordinates of a layer of which its file says nothing.
fn assumed(layer: &Surveyed, stands: bool) -> Option<Text> {
    let src = &layer.src;
    Some(match layer.plane {
        _ if !stands => text!([src]
            "{src} is left out: its metres have no common zero with the other maps, and nothing says where they lie; it can be a town of its own",
            "{src} は入れていません。ほかの地図と共通の原点がなく、位置もわからないためです。それだけで一つの町にできます"
        ),
        Plane::Metres => text!([src]
            "{src} does not say its coordinates, and they can be no degrees: taken as metres (`crs=\"local\"`); if they are of a plane zone, write which",
            "{src} には座標系の記載がなく、値は度ではありえないため、メートルとしました（`crs=\"local\"`）。平面直角座標系なら、その系を書いてください"
        ),
        Plane::Degrees => text!([src]
            "{src} does not say its coordinates: taken as longitude and latitude",
            "{src} には座標系の記載がありません。経度と緯度としました"
        ),
        Plane::OwnSurvey => text!([src]
            "{src} has metres of a survey of its own: the town stands nowhere on the earth, and no other map can be laid over it",
            "{src} は任意座標系です。町は地球上の位置を持たず、ほかの地図を重ねられません"
        ),
        Plane::Said(_) => return None,
    })
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
