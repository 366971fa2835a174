//! `hsd dump`: prints the intermediate representations of the compiler.

use super::options::{InputArgs, exit, report};
use super::{Failure, Outcome};
use crate::files::input::Inputs;
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_dump as dump;
use hsd_export::regions_svg::regions_svg;
use hsd_report::{Format, Report};
use std::io::{self, Write};

/// Print the result of one compiler stage as JSON, or the roofs in plan as SVG.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd dump --stage regions shop.hsd                  print how the plan is divided into roofs
  hsd dump --stage regions --format svg shop.hsd     draw the same in plan
  hsd dump --stage program shop.hsd | jq .houses     print resolved codes and expanded repeats")]
pub(super) struct Dump {
    #[command(flatten)]
    input_args: InputArgs,

    /// Select the stage.
    #[arg(long, value_enum)]
    stage: Stage,

    /// Set the output format.
    #[arg(long, value_enum, default_value_t = DumpFormat::Json)]
    format: DumpFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DumpFormat {
    /// One line of JSON.
    Json,
    /// A drawing; only for regions.
    Svg,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Stage {
    /// The parsed source files.
    Ast,
    /// The instructions after expanding repeats, random choices and substitutions.
    Program,
    /// Walls in place, and roofs.
    Building,
    /// The regions of automatic roofs in plan.
    Regions,
    /// Meshes, materials and nodes.
    Scene,
}

impl Dump {
    pub(super) fn run(&self, language: Language) -> Outcome {
        if self.format == DumpFormat::Svg && self.stage != Stage::Regions {
            return Err(Failure::Usage(text!(
                "`--format svg` requires `--stage regions`",
                "`--format svg` は `--stage regions` でしか使えません"
            )));
        }
        self.input_args.check_folders()?;
        let mut out = Diagnostics::new();
        let limit = self.input_args.limits().bytes;
        let inputs = Inputs::read(&self.input_args.inputs, limit, &mut out)?;
        let mut included = vec![];
        let options = self.input_args.options(&inputs, &mut out)?;
        let text = self.text(&inputs.accepted(), &options, &mut included, &mut out);
        let text = text.map_err(|e| Failure::json(&e))?;
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
        Ok(exit(
            list.iter().any(|d| self.input_args.spoils(d.severity)),
        ))
    }

    fn text(
        &self,
        sources: &[&Source],
        options: &hsd_driver::Options,
        included: &mut Vec<Source>,
        out: &mut Diagnostics,
    ) -> serde_json::Result<String> {
        let world = self.input_args.world(&self.input_args.inputs);
        let hsd_driver::Read {
            documents,
            included: read,
            catalog,
        } = hsd_driver::documents(sources, &world, options, out);
        *included = read;
        if let Stage::Ast = self.stage {
            return dump::ast(sources, &documents);
        }
        let program =
            hsd_driver::program(sources, &documents, &catalog, &world, &options.expand, out);
        if let Stage::Program = self.stage {
            return dump::program(&program);
        }
        let building = hsd_driver::building(program, &catalog, out);
        match self.stage {
            Stage::Regions if self.format == DumpFormat::Svg => Ok(regions_svg(&building)),
            Stage::Regions => dump::regions(&building),
            Stage::Scene => {
                let scene = hsd_driver::scene(&building, &catalog, options.shapes());
                dump::scene(&scene)
            }
            _ => dump::building(&building),
        }
    }
}
