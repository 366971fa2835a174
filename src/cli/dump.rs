//! `hsd dump`: the trees between the passes.

use super::options::{Reading, exit, report};
use super::{Outcome, Stop};
use crate::backend::dump;
use crate::backend::regions_svg::regions_svg;
use crate::cli::files::input::Inputs;
use crate::diagnostic::{Diagnostics, Language};
use crate::driver;
use crate::report::{Format, Report};
use crate::scene::Detail;
use crate::source::Source;
use crate::text;
use clap::{Args, ValueEnum};
use std::io::{self, Write};

/// Show what the program makes of texts on the way to a model, as JSON or, for roofs in plan, as a picture.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd dump --stage regions shop.hsd                  how the plan is divided into roofs
  hsd dump --stage regions --format svg shop.hsd     the same drawn
  hsd dump --stage program shop.hsd | jq .houses     codes looked up, repeats counted out")]
pub(super) struct Dump {
    #[command(flatten)]
    reading: Reading,

    /// After which step.
    #[arg(long, value_enum)]
    stage: Stage,

    /// How it is written.
    #[arg(long, value_enum, default_value_t = Form::Json)]
    format: Form,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Form {
    /// One line of JSON.
    Json,
    /// A picture, of regions only.
    Svg,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Stage {
    /// As written.
    Ast,
    /// Steps only: no repeats, draws and substitutions.
    Program,
    /// Walls with their places, and roofs.
    Building,
    /// The automatic roofs in plan.
    Regions,
    /// Meshes, materials and nodes.
    Scene,
}

impl Dump {
    pub(super) fn run(&self, language: Language) -> Outcome {
        if self.format == Form::Svg && self.stage != Stage::Regions {
            return Err(Stop::Usage(text!(
                "only `--stage regions` can be drawn: `--format svg` goes with no other",
                "図にできるのは `--stage regions` だけです。`--format svg` はほかでは使えません"
            )));
        }
        self.reading.check_folders()?;
        let mut out = Diagnostics::new();
        let limit = self.reading.limits().bytes;
        let inputs = Inputs::read(&self.reading.inputs, limit, &mut out)?;
        let mut included = vec![];
        let options = self.reading.options(&inputs, &mut out)?;
        let text = self.text(&inputs.accepted(), &options, &mut included, &mut out);
        let text = text.map_err(|e| {
            Stop::Io(text!(
                "cannot be written as JSON: {e}",
                "JSON として書けません: {e}"
            ))
        })?;
        let list = out.into_sorted();
        if !list.is_empty() {
            report(
                &Report::new(&inputs.and(included), &list).in_language(language),
                Format::Human,
                &mut io::stderr(),
            )?;
        }
        let mut stdout = io::stdout().lock();
        stdout.write_all(text.as_bytes())?;
        stdout.flush()?;
        Ok(exit(list.iter().any(|d| self.reading.spoils(d.severity))))
    }

    fn text(
        &self,
        sources: &[&Source],
        options: &driver::Options,
        included: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> serde_json::Result<String> {
        let world = self.reading.world(&self.reading.inputs);
        let driver::Read {
            documents,
            included: read,
            catalog,
        } = driver::documents(sources, &world, options, out);
        *included = read;
        if let Stage::Ast = self.stage {
            return dump::ast(sources, &documents);
        }
        let program = driver::program(sources, &documents, &catalog, &world, &options.expand, out);
        if let Stage::Program = self.stage {
            return dump::program(&program);
        }
        let building = driver::building(program, &catalog, out);
        match self.stage {
            Stage::Regions if self.format == Form::Svg => Ok(regions_svg(&building)),
            Stage::Regions => dump::regions(&building),
            Stage::Scene => {
                let scene = driver::scene(&building, &catalog, Detail::default());
                dump::scene(&scene)
            }
            _ => dump::building(&building),
        }
    }
}
