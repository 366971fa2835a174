//! `hsd town candidates`: what the rules of a town could make of one plot, side by side (002-27).

use super::{planned, print};
use crate::build::variants::{check_sheet, write_sheet};
use crate::files::output::Committer;
use crate::options::{DetailArgs, InputArgs};
use crate::{Exit, Failure, Outcome};
use clap::Args;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::text;
use hsd_driver::TileDriver;
use hsd_render::sheet::{self, Cell};
use hsd_scene::NodeId;
use hsd_town::plan::LotId;
use hsd_town::{Plan, TownHouses, TownInput};
use std::io::{self, Write};
use std::num::NonZeroU32;
use std::path::PathBuf;

/// Draw what a town could build on one plot: candidates side by side, each with its seed.
///
/// Types by share and drawn parameters differ from seed to seed; what the file says stays. The first candidate is what
/// the town builds. A line for each names its seed, type and parameters: write those of the nearest one in a rule with
/// `test="{key = 'K'}"`.
#[derive(Debug, Args)]
#[command(after_help = "\
Example:
  hsd town candidates kyoto.hsd --key 417 -o sheet.png")]
pub(crate) struct Candidates {
    #[command(flatten)]
    input_args: InputArgs,

    /// Set the plot: the key of a feature, as `decisions.csv` has it.
    #[arg(long, value_name = "KEY")]
    key: String,

    /// Set its layer, if several have a feature of this key.
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,

    /// Set the number of candidates.
    #[arg(long, value_name = "N", default_value = "9")]
    variants: NonZeroU32,

    #[command(flatten)]
    detail_args: DetailArgs,

    /// Write the image to this file (.png or .jpg).
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

impl Candidates {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        check_sheet(&self.output, Some(self.variants))?;
        let detail = self.detail_args.detail();
        let committer = Committer::default();
        planned(
            (&self.input_args, &committer),
            (detail, None),
            language.into(),
            |input, read, plan, out, _| {
                committer.check([&self.output])?;
                let lot = self.lot(plan)?;
                self.draw((input, &committer), &read, (plan, lot), out, language)
            },
        )
    }

    /// Returns the feature that is meant.
    fn lot(&self, plan: &Plan) -> Result<LotId, Failure> {
        let name = |lot: &LotId| &*plan.layers[lot.0].layer.name.value;
        let layer = self.layer.as_deref();
        let lots = plan.lots().into_iter();
        let lots = lots.filter(|lot| layer.is_none_or(|layer| layer == name(lot)));
        let lots: Vec<LotId> = lots.collect();
        let mut found = lots.iter().filter(|lot| *plan.lot(**lot).key == *self.key);
        let key = &self.key;
        match (found.next(), found.next()) {
            (Some(lot), None) => Ok(*lot),
            (Some(one), Some(other)) if one.0 == other.0 => {
                let layer = name(one);
                Err(Failure::Usage(text!([key, layer]
                    "several features of {layer} have the key `{key}`: name a field with a value for each in `key` of the layer",
                    "{layer} にはキー `{key}` の地物が複数あります。地物ごとに違う値の属性を、レイヤーの `key` に書いてください"
                )))
            }
            (Some(one), Some(other)) => {
                let (one, other) = (name(one), name(other));
                Err(Failure::Usage(text!([key, one, other]
                    "several features have the key `{key}`, in {one} and {other}: name the layer with `--layer`",
                    "キー `{key}` の地物が複数あります（{one} と {other}）。`--layer` でレイヤーを指定してください"
                )))
            }
            (None, _) => {
                let few = lots.iter().take(3).map(|lot| &*plan.lot(*lot).key);
                let few = few.collect::<Vec<&str>>().join(", ");
                Err(Failure::Usage(text!([key, few]
                    "no rule of the town takes a feature with the key `{key}`; keys are such as {few}",
                    "キー `{key}` の地物を対象とする規則がありません。キーは {few} などです"
                )))
            }
        }
    }

    fn draw(
        &self,
        (input, committer): (TownInput<'_>, &Committer),
        read: &hsd_driver::Read,
        (plan, lot): (&Plan, LotId),
        mut out: Diagnostics,
        language: Language,
    ) -> Outcome {
        let own = input.options.expand.seed.unwrap_or(plan.town.seed);
        let (mut houses, mut cells, mut lines) = (vec![], vec![], String::new());
        let mut sources = vec![input.source.clone()];
        for number in 0..self.variants.get() {
            let seed = own.wrapping_add(number.into());
            let mut options = input.options.clone();
            options.expand.seed = Some(seed);
            let options = &options;
            let made = TownHouses::new(TownInput { options, ..input }, plan).evaluate(&[lot]);
            out.push_new(made.found);
            if number == 0 {
                sources.extend(made.included);
            }
            // A house behind the house that has no room is no candidate.
            for record in made.records.iter().filter(|r| r.is_shown()) {
                let (kind, parameters) = (&record.kind, record.parameters());
                lines += format!("{seed}\t{kind}\t{parameters}").trim_end();
                lines.push('\n');
            }
            cells.push((seed, made.houses.len()));
            houses.extend(made.houses);
        }
        if houses.is_empty() {
            print(&sources, out, language)?;
            let key = &self.key;
            return Err(Failure::Usage(text!([key]
                "the town builds no house on `{key}`",
                "この町は `{key}` に建物を建てません"
            )));
        }
        let detail = self.detail_args.detail();
        let settings = (input.world, input.options);
        let driver = TileDriver::new(input.source, &read.catalog, settings, &[detail]);
        let made = driver.houses(houses, &mut out)?;
        let level = driver.level(&made, detail, &mut out);
        let mut roots = level.houses.iter();
        let cells = cells.into_iter().map(|(seed, count)| {
            let own = roots.by_ref().take(count).filter(|nodes| !nodes.is_empty());
            Cell {
                seed,
                nodes: own.map(|nodes| NodeId(nodes.start as u32)).collect(),
            }
        });
        let drawn = sheet::sheet(&level.scene, &cells.collect::<Vec<Cell>>());
        let spoiled = out.has_errors();
        print(&sources, out, language)?;
        write_sheet((&self.output, committer), drawn, self.quiet, language)?;
        if !self.quiet {
            write!(io::stdout(), "{lines}")?;
        }
        Ok(if spoiled { Exit::Errors } else { Exit::Done })
    }
}
