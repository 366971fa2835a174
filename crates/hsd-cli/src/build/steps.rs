//! `hsd town plan`, `tile` and `seal`: a town in three steps, for engines that run on many machines.

mod open;
mod seal;
mod tile;

pub(super) use seal::TownSeal;
pub(super) use tile::TownTile;

use super::tiled::{self, Folder};
use super::town::{check_packed, planned, print};
use crate::files::output::Committer;
use crate::files::terminal::counted;
use crate::options::InputArgs;
use crate::{Exit, Failure, Outcome};
use clap::Args;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_ir::ast::town::Tiles;
use hsd_scene::Detail;
use hsd_town::plan::Lodging;
use hsd_town::tiles::run::{TileJob, TileParts};
use hsd_town::tiles::work::{self, Manifest, PlannedTile};
use hsd_town::{Plan, TownInput};
use open::Asked;
use std::collections::BTreeSet;
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;

/// Divide a town into tiles that can be made one by one, on any machine that sees WORK and the folder of the town.
///
/// Reads the maps and puts into WORK, for each tile, its features with all that their houses depend on, so no later step reads a
/// map. Prints a line a tile: key, features, bytes and hash of its inputs, with tabs between. Ground without houses has keys
/// too. Repeated, it plans anew; what was made of inputs that are the same stays made.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd town plan kyoto.hsd -o work/                   prepare the tiles and print them
  hsd town tile work/ 0_0 0_1                        make two of them
  hsd town tile work/ --all                          make those that are missing
  hsd town seal work/ -o kyoto/                      put the town together")]
pub(crate) struct TownPlan {
    #[command(flatten)]
    input_args: InputArgs,

    /// Put the work into this folder.
    #[arg(short, long, value_name = "WORK")]
    output: PathBuf,

    /// Set the levels of detail of tiles: 0 walls and roofs, 1 a texture per part, 2 openings and heavy bars as geometry, 3
    /// everything as geometry [default: those of `Tiles`, or 0,1,3].
    #[arg(long, value_name = "0..3", value_delimiter = ',', value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: Vec<u8>,

    /// Pack the shapes of tiles (EXT_meshopt_compression), for the web. Needs an hsd that was built with `--features compress`.
    #[arg(long)]
    compress: bool,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

impl TownPlan {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        check_packed(self.compress)?;
        let failed = |error| Failure::at(self.output.display(), error);
        let committer = Committer::default();
        let folder = Folder::of_work(&self.output, &committer).map_err(failed)?;
        let asked = Asked::new(
            &self.input_args,
            (&self.detail, self.compress),
            &self.output,
        )?;
        let spool = tiled::spools_beside(&self.output.join(work::MANIFEST));
        // Parts are cut out of a spool, whatever the size of the town.
        let lodging = Lodging {
            new: &spool,
            from: 0,
        };
        let detail = self.detail.iter().copied().max().unwrap_or(3);
        planned(
            (&self.input_args, &committer),
            (Detail::ALL[usize::from(detail)], Some(lodging)),
            language.into(),
            |input, read, plan, out, _| {
                committer.check([self.output.join(work::MANIFEST)])?;
                let made = self.plan(&folder, &asked, input, (&read, plan))?;
                let mut sources = vec![input.source.clone()];
                sources.extend(read.included);
                self.end(&folder, &made, (&sources, out), language)
            },
        )
    }

    fn plan(
        &self,
        folder: &Folder,
        asked: &Asked,
        input: TownInput<'_>,
        (read, plan): (&hsd_driver::Read, &Plan),
    ) -> Result<Manifest, Failure> {
        let division = Tiles {
            detail: match self.detail.is_empty() {
                true => plan.town.tiles.detail.clone(),
                false => self.detail.clone(),
            },
            ..plan.town.tiles.clone()
        };
        let parts = TileParts::of(read, input.options);
        let job = TileJob {
            packed: self.compress,
            ..parts.job(input, plan, &read.catalog, &division)
        };
        let asked = serde_json::to_value(asked).map_err(|e| Failure::json(&e))?;
        let mut lines = BufWriter::new(io::stdout());
        let mut told = |tile: &PlannedTile| match self.quiet {
            true => Ok(()),
            false => writeln!(
                lines,
                "{}\t{}\t{}\t{}",
                tile.key, tile.features, tile.bytes, tile.inputs
            ),
        };
        let made = work::plan(&job, asked, folder, &mut told);
        let made = made.map_err(|error| Failure::at(self.output.display(), error))?;
        lines.flush()?;
        Ok(made)
    }

    /// Removes parts of earlier plans, and prints what was found.
    fn end(
        &self,
        folder: &Folder,
        made: &Manifest,
        (sources, out): (&[Source], Diagnostics),
        language: Language,
    ) -> Outcome {
        let spoiled = out.has_errors();
        print(sources, out, language)?;
        let parts: BTreeSet<String> = made.files().collect();
        let swept = folder.sweep_in("parts", &parts);
        swept.map_err(|error| Failure::at(self.output.display(), error))?;
        if !self.quiet {
            let (name, tiles) = (
                self.output.display(),
                counted(made.tiles.len(), tiled::TILE),
            );
            let features = counted(made.features, tiled::FEATURE);
            let line = text!([name, features, tiles]
                "{name}: {features} in {tiles}; make them with `hsd town tile {name} KEY...`",
                "{name}: {features}、{tiles}。`hsd town tile {name} KEY...` で作れます"
            );
            writeln!(io::stderr(), "{}", line.in_language(language))?;
        }
        Ok(if spoiled { Exit::Errors } else { Exit::Done })
    }
}
