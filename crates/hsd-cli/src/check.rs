//! `hsd check`: prints the diagnostics of source files.

use super::options::{FormatArg, InputArgs, exit, report};
use super::{Exit, Outcome};
use crate::build::streamed;
use crate::files::input::Inputs;
use crate::files::terminal::{FILE, HOUSE, counted};
use clap::Args;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::text;
use hsd_driver::Feed;
use hsd_report::{Format, Report};
use hsd_town::{CheckDepth, TownInput};
use std::env;
use std::io::{self, Write};

/// Check source files for errors without building a model.
///
/// The exit status is 1 if a source file has errors (with `-D warnings`, errors or warnings), and 3 if one cannot be
/// read. It is 1 too if a build of a town would skip a feature.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd check shop.hsd                        print diagnostics with source excerpts
  hsd check -D warnings --format short *.hsd    print one line per diagnostic; treat warnings as errors")]
pub(super) struct Check {
    #[command(flatten)]
    input_args: InputArgs,

    /// Set the format of diagnostics on standard output.
    #[arg(long, value_enum, default_value_t)]
    format: FormatArg,
}

impl Check {
    pub(super) fn run(&self, language: Language) -> Outcome {
        self.input_args.check_folders()?;
        let limits = self.input_args.limits();
        let mut out = Diagnostics::new();
        let inputs = Inputs::readable_in_pieces(&self.input_args.inputs, &limits, &mut out);
        let options = self.input_args.options(&inputs, &mut out)?;
        let sources = inputs.accepted();
        let world = self.input_args.world(&self.input_args.inputs);
        let feed = Feed {
            sources: &sources,
            long: &inputs.long,
        };
        let mut checked = hsd_driver::inspect(feed, &world, &options, &mut out, &|| {
            streamed::spool(&env::temp_dir())
        })?;
        let (mut houses, mut is_incomplete) = (checked.houses, false);
        for source in &sources {
            let input = TownInput::new(source, &world, &options);
            let depth = CheckDepth::Houses;
            if let Some(town) = hsd_town::check(input, depth, &mut checked.included, &mut out) {
                houses += town.houses;
                is_incomplete |= town.is_incomplete;
            }
        }
        let list = out.into_sorted();
        let format = Format::from(self.format);
        let (failed, files) = (inputs.failed(), inputs.sources.len());
        if format == Format::Human && list.is_empty() {
            let files = counted(files, FILE);
            let houses = counted(houses, HOUSE);
            let clean = text!([files, houses]
                "{files}, {houses}: no problems found",
                "{files}、{houses}: 問題はありません"
            );
            writeln!(io::stderr(), "{}", clean.in_language(language))?;
        } else {
            report(
                &Report::new(&inputs.shown(checked.included, &list)?, &list).in_language(language),
                format,
                &mut io::stdout(),
            )?;
        }
        if failed {
            return Ok(Exit::Unread);
        }
        let is_spoiled = list.iter().any(|d| self.input_args.spoils(d.severity));
        Ok(exit(is_spoiled || is_incomplete))
    }
}
