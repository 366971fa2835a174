//! `hsd town`: builds a town from its maps.

use super::streamed;
use crate::backend::gltf::{Spool, Writer};
use crate::cli::files::input::Inputs;
use crate::cli::files::output::{self, Files};
use crate::cli::files::terminal::counted;
use crate::cli::options::{DetailArgs, InputArgs, report};
use crate::cli::{Exit, Failure, Outcome};
use crate::diagnostic::{Diagnostics, Language, Noun, noun};
use crate::driver;
use crate::report::{Format, Report};
use crate::source::Source;
use crate::text;
use crate::town::stream::{Ledger, TownStream};
use crate::town::{Plan, TownInput, run};
use clap::Args;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const FEATURE: Noun = noun("feature", "地物{}件");

/// Build a town from the layers of maps that a town file names.
///
/// OUT is a model (.glb), or a folder for `town.glb`. Beside the model stand `decisions.csv`, with a line for each feature,
/// and `report.json`. The exit status is 1 if a feature has no house that nobody asked to skip.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd town kyoto.hsd -o kyoto/       write kyoto/town.glb, kyoto/decisions.csv and kyoto/report.json
  hsd town kyoto.hsd -o kyoto.glb --param year=1928")]
pub(in crate::cli) struct Town {
    #[command(flatten)]
    input_args: InputArgs,

    /// Write the model to this file or folder.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,

    #[command(flatten)]
    detail_args: DetailArgs,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

impl Town {
    pub(in crate::cli) fn run(&self, language: Language) -> Outcome {
        self.input_args.check_folders()?;
        let [input] = &self.input_args.inputs[..] else {
            return Err(Failure::Usage(text!(
                "`hsd town` builds one town at a time",
                "`hsd town` が一度に作る町は一つです"
            )));
        };
        let mut out = Diagnostics::new();
        let limits = self.input_args.limits();
        let inputs = Inputs::read(std::slice::from_ref(input), limits.bytes, &mut out)?;
        let options = driver::Options {
            detail: self.detail_args.detail(),
            ..self.input_args.options(&inputs, &mut out)?
        };
        let world = self.input_args.world(&self.input_args.inputs);
        let accepted = inputs.accepted();
        let mut read = driver::documents(&accepted, &world, &options, &mut out);
        let town = read.documents.iter_mut().find_map(|d| d.town.take());
        let (Some(town), [source]) = (town, &accepted[..]) else {
            if !out.has_errors() {
                return Err(Failure::Usage(text!(
                    "this is no town: `hsd build` builds houses",
                    "町のファイルではありません。建物は `hsd build` で作ります"
                )));
            }
            self.print(&inputs.and(read.included), out, language)?;
            return Ok(Exit::Errors);
        };
        let input = TownInput {
            source,
            world: &world,
            options: &options,
        };
        let plan = match run::plan(input, &town, &mut out) {
            Some(plan) if !out.has_errors() => plan,
            _ => {
                self.print(&inputs.and(read.included), out, language)?;
                return Ok(Exit::Errors);
            }
        };
        self.build(input, read, &plan, out, language)
    }

    /// Builds a town and writes its files.
    fn build(
        &self,
        input: TownInput<'_>,
        read: driver::Read,
        plan: &Plan,
        mut out: Diagnostics,
        language: Language,
    ) -> Outcome {
        let mut houses = TownStream::new(input, plan);
        let model = self.model()?;
        let failed = |error| Failure::at(model.display(), error);
        let folder = streamed::spool_folder(&model);
        let new = || -> io::Result<Box<dyn Spool>> { streamed::spool(&folder) };
        let mut writer = Writer::new(&new).map_err(failed)?;
        let streamed = driver::stream_town(
            (input.source, read),
            houses.by_ref(),
            input.world,
            input.options,
            &mut out,
            &mut |part, images| writer.add(part, images),
        )
        .map_err(failed)?;
        let (ledger, included) = houses.finish(&mut out);
        let spoiled = out.has_errors();
        let mut sources = vec![input.source.clone()];
        sources.extend(included);
        self.print(&sources, out, language)?;
        if spoiled {
            return Ok(Exit::Errors);
        }
        let glb = writer.glb(&streamed.materials, &streamed.library, &streamed.grown);
        let size = output::write(&model, Files::glb(glb.map_err(failed)?))?;
        self.tables(&model, &ledger)?;
        self.summary(&model, size, &ledger, streamed.houses, language)?;
        Ok(match ledger.incomplete {
            true => Exit::Errors,
            false => Exit::Done,
        })
    }

    /// Prints what was built.
    fn summary(
        &self,
        model: &Path,
        size: u64,
        ledger: &Ledger,
        houses: usize,
        language: Language,
    ) -> Result<(), Failure> {
        if self.quiet {
            return Ok(());
        }
        let (name, mib) = (model.display(), size.div_ceil(1 << 20));
        let features = counted(ledger.report.features, FEATURE);
        let built = ledger.report.built;
        let line = text!([name, mib, features, built, houses]
            "{name}: {features}, {built} of them built, {houses} houses, {mib} MiB",
            "{name}: {features}、うち {built} 件に建物 {houses} 棟、{mib} MiB"
        );
        writeln!(io::stderr(), "{}", line.in_language(language))?;
        Ok(())
    }

    /// Returns the path of the model; makes the folder.
    fn model(&self) -> Result<PathBuf, Failure> {
        let is_model = self.output.extension().is_some_and(|e| e == "glb");
        if is_model {
            return Ok(self.output.clone());
        }
        if let Some(other) = self.output.extension() {
            let other = other.to_string_lossy();
            return Err(Failure::Usage(text!([other]
                "a town is written to a folder or a `.glb`, not to `.{other}`",
                "町の出力先はフォルダーか `.glb` です。`.{other}` には書けません"
            )));
        }
        std::fs::create_dir_all(&self.output).map_err(|e| Failure::at(self.output.display(), e))?;
        Ok(self.output.join("town.glb"))
    }

    /// Writes the table of decisions and the report beside the model.
    fn tables(&self, model: &Path, ledger: &Ledger) -> Result<(), Failure> {
        let json = serde_json::to_vec_pretty(&ledger.report).map_err(|e| Failure::json(&e))?;
        let beside = |name: &str| match self.output.extension() {
            Some(_) => model.with_extension(name),
            None => model.with_file_name(name),
        };
        for (name, bytes) in [
            ("decisions.csv", ledger.decisions.clone().into_bytes()),
            ("report.json", json),
        ] {
            output::write(&beside(name), Files::bytes(bytes))?;
        }
        Ok(())
    }

    fn print(
        &self,
        sources: &[Source],
        out: Diagnostics,
        language: Language,
    ) -> Result<(), Failure> {
        let list = out.into_sorted();
        if list.is_empty() {
            return Ok(());
        }
        let written = Report::new(sources, &list).in_language(language);
        report(&written, Format::Human, &mut io::stderr())
    }
}
