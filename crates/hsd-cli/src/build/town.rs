//! `hsd town`: builds a town from its maps.

pub(super) mod candidates;
mod city;
mod obj;
mod text;

use super::NO_COMPRESS;
use super::tiled;
use super::tiled::{Progress, TILESET, Wish, table_paths, tables};
use crate::files::input::Inputs;
use crate::files::messages::{MessageArgs, Teller};
use crate::files::output::{Committer, Files};
use crate::options::{InputArgs, ReadArgs, exit};
use crate::{Exit, Failure, Outcome};
use city::CityForm;
use clap::Args;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_export::gltf::Writer;
use hsd_ir::ast;
use hsd_scene::Detail;
use hsd_town::decision::problems;
use hsd_town::layer;
use hsd_town::plan::Lodging;
use hsd_town::stream::{Ledger, TownStream};
use hsd_town::tiles::terrain;
use hsd_town::{Plan, TownInput, run};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The number of features from which those of a town wait in a spool.
const LARGE: usize = 1 << 14;

/// Build a town from the layers of maps that a town file names.
///
/// OUT is a folder for 3D Tiles, whose root is `tileset.json`, one model (.glb), a model for each tile
/// (.obj: OUT-TILE.obj beside OUT), its houses as a source file (.hsd), or CityJSON 2.0 of LoD 1 to 3 (.city.json, or .city.jsonl with
/// a line for each house; `--detail 0` leaves out LoD 3). In the folder or beside the model stand
/// `decisions.csv`, with a line for each feature, and `report.json`. Tiles that are there already and would be the same are
/// kept, so a run that was interrupted goes on. The exit status is 1 if a feature has no house that nobody asked to skip.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd town kyoto.hsd -o kyoto/       write kyoto/tileset.json with its tiles, kyoto/decisions.csv and kyoto/report.json
  hsd town kyoto.hsd -o kyoto.glb --param year=1928
  hsd town kyoto.hsd -o houses.hsd   write each house as a text, to change it by hand
  hsd town kyoto.hsd -o kyoto.city.jsonl --detail 0    write walls and roofs for a GIS, a line for each house")]
pub(crate) struct Town {
    #[command(flatten)]
    input_args: InputArgs,

    /// Write tiles to this folder, or one model to this file.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,

    /// Set the levels of detail of tiles, or that of a model: 0 walls and roofs, 1 a texture per part, 2 openings and heavy
    /// bars as geometry, 3 everything as geometry [default: those of `Tiles`, or 0,1,3; 3 for a model].
    #[arg(long, value_name = "0..3", value_delimiter = ',', value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: Vec<u8>,

    /// Pack tiles for the web (EXT_meshopt_compression, KTX2): a third of the bytes and of the graphics memory. Needs an hsd that was
    /// built with `--features compress`.
    #[arg(long)]
    compress: bool,

    #[command(flatten)]
    message_args: MessageArgs,

    /// Print triangles, bytes and an estimate of graphics memory of the tiles.
    #[arg(long)]
    stats: bool,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

/// Returns the order to build one model of a town at a level of detail.
pub(crate) fn model(input: &Path, read_args: &ReadArgs, detail: Detail, output: &Path) -> Town {
    Town {
        input_args: InputArgs {
            inputs: vec![input.to_owned()],
            read_args: read_args.clone(),
        },
        output: output.to_owned(),
        detail: vec![detail as u8],
        compress: false,
        stats: false,
        message_args: MessageArgs::default(),
        quiet: true,
    }
}

/// What came of a town: whether something is missing that the author wanted, the files that were included, and what was found.
type Built = (bool, Vec<Source>, Diagnostics);

/// Reads a town and its maps and hands them to `then`, with the files of these; tells what is wrong with one that cannot be read.
/// The features of a town wait in spools, if there is a maker of these.
pub(super) fn planned(
    (args, committer): (&InputArgs, &Committer),
    (detail, lodging): (Detail, Option<Lodging<'_>>),
    teller: Teller,
    then: impl FnOnce(TownInput<'_>, hsd_driver::Read, &Plan, Diagnostics, &[PathBuf]) -> Outcome,
) -> Outcome {
    args.check_folders()?;
    let [input] = &args.inputs[..] else {
        return Err(Failure::Usage(text!(
            "`hsd town` builds one town at a time",
            "`hsd town` が一度に作る町は一つです"
        )));
    };
    committer.add_inputs(args.files());
    let mut out = Diagnostics::new();
    let limits = args.limits();
    let inputs = Inputs::read(std::slice::from_ref(input), limits.bytes, &mut out)?;
    let options = hsd_driver::Options {
        detail,
        ..args.options(&inputs, &mut out)?
    };
    let world = args.world(&args.inputs);
    let world = world.recorded_in(&committer.inputs);
    let accepted = inputs.accepted();
    let mut read = hsd_driver::documents(&accepted, &world, &options, &mut out);
    let town = read.documents.iter_mut().find_map(|d| d.town.take());
    let (Some(town), [source]) = (town, &accepted[..]) else {
        if !out.has_errors() {
            return Err(Failure::Usage(text!(
                "this is no town: `hsd build` builds houses",
                "町のファイルではありません。建物は `hsd build` で作ります"
            )));
        }
        return unread(&inputs.and(read.included), out, teller);
    };
    let input = TownInput::new(source, &world, &options);
    let maps = maps(input, &town);
    committer.add_inputs(maps.iter().flat_map(|map| layer::with_side_files(map)));
    match run::plan_lodged(input, &town, lodging, &mut out)? {
        Some(plan) if !out.has_errors() => then(input, read, &plan, out, &maps),
        _ => unread(&inputs.and(read.included), out, teller),
    }
}

/// Returns the paths of the layers and tables of a town.
pub(super) fn maps(input: TownInput<'_>, town: &ast::town::Town) -> Vec<PathBuf> {
    let layers = town.layers.iter().map(|layer| &layer.src);
    let named = layers.chain(town.tables.iter().map(|table| &table.src));
    let files = |src| layer::files(input.world, input.source.name(), src).ok();
    let found = named.filter_map(files).flatten();
    found.map(|file| file.path.into()).collect()
}

/// Tells of a town that cannot be read.
fn unread(sources: &[Source], out: Diagnostics, teller: Teller) -> Outcome {
    let told = teller.report(sources, &out.into_sorted())?;
    let files: Vec<PathBuf> = sources.iter().map(|s| s.name().into()).collect();
    teller.built(&told, None, &files)?;
    Ok(Exit::Errors)
}

/// Prints what was found.
pub(super) fn print(
    sources: &[Source],
    out: Diagnostics,
    language: Language,
) -> Result<(), Failure> {
    let _ = Teller::from(language).report(sources, &out.into_sorted())?;
    Ok(())
}

/// Fails if tiles are to be packed but this build cannot.
pub(super) fn check_packed(packed: bool) -> Result<(), Failure> {
    match packed && !cfg!(feature = "compress") {
        true => Err(Failure::Usage(NO_COMPRESS.into())),
        false => Ok(()),
    }
}

impl Town {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        self.run_with(&Committer::default(), language)
    }

    /// Builds a town as part of a run that has read other files too.
    pub(crate) fn run_with(&self, committer: &Committer, language: Language) -> Outcome {
        self.check_compress()?;
        let detail = self.detail.iter().copied().max().unwrap_or(3);
        let detail = Detail::ALL[usize::from(detail)];
        let spool = tiled::spools_beside(&self.output);
        // What is written tile by tile needs no more of the town at a time.
        let by_tiles = self.is_folder() || self.is_obj() || CityForm::of(&self.output).is_some();
        let lodging = Lodging {
            new: &spool,
            from: LARGE,
        };
        let teller = self.message_args.teller(language);
        planned(
            (&self.input_args, committer),
            (detail, by_tiles.then_some(lodging)),
            teller,
            |input, read, plan, out, maps| {
                committer.check(self.outputs())?;
                let input = (input, committer);
                let town = (read, plan);
                let mut written = true;
                let (incomplete, included, out) = match CityForm::of(&self.output) {
                    Some(form) if !self.is_folder() => self.city(form, input, town, out, teller)?,
                    _ if self.is_obj() => self.objects(input, town, out, teller)?,
                    _ if self.is_text() => self.texts(input, town, out, teller)?,
                    _ if self.is_model()? => {
                        let (built, done) = self.build(input, town, out, teller)?;
                        written = done;
                        built
                    }
                    _ => self.tiles(input, town, out, teller)?,
                };
                let spoiled = out.has_errors();
                let mut sources = vec![input.0.source.clone()];
                sources.extend(included);
                let told = teller.report(&sources, &out.into_sorted())?;
                let files = sources.iter().map(|source| PathBuf::from(source.name()));
                let files: Vec<PathBuf> = files.chain(maps.iter().cloned()).collect();
                teller.built(&told, written.then_some(&*self.output), &files)?;
                Ok(exit(incomplete || spoiled))
            },
        )
    }

    /// Returns the outputs whose names are known before anything is built.
    fn outputs(&self) -> Vec<PathBuf> {
        let is_new_folder =
            !self.output.is_dir() && (self.is_folder() || self.output.extension().is_none());
        let main = match () {
            // There are no inputs in it.
            () if is_new_folder => return vec![],
            () if self.is_folder() => Some(self.output.join(TILESET)),
            () if self.is_obj() => None,
            () => Some(self.output.clone()),
        };
        main.into_iter().chain(table_paths(&self.output)).collect()
    }

    /// Returns true if nothing is said but messages.
    fn is_quiet(&self, teller: Teller) -> bool {
        self.quiet || teller.is_program()
    }

    /// Fails if `--compress` is given but the output is not in tiles, or this build cannot pack them.
    fn check_compress(&self) -> Result<(), Failure> {
        if !self.compress {
            return Ok(());
        }
        if self.output.extension().is_some() && !self.is_folder() {
            return Err(Failure::Usage(text!(
                "--compress packs tiles: name a folder, such as `-o town/`",
                "--compress が圧縮するのはタイルです。`-o town/` のようにフォルダーを指定してください"
            )));
        }
        check_packed(true)
    }

    /// Builds a town as CityJSON.
    fn city(
        &self,
        form: CityForm,
        (input, committer): (TownInput<'_>, &Committer),
        town: (hsd_driver::Read, &Plan),
        out: Diagnostics,
        teller: Teller,
    ) -> Result<Built, Failure> {
        let openings = self.detail.iter().copied().max().unwrap_or(3) > 0;
        let wish = (&*self.output, form, openings, self.is_quiet(teller));
        city::build(wish, (input, committer), town, out, teller)
    }

    /// Builds a town as a `.obj` a tile.
    fn objects(
        &self,
        (input, committer): (TownInput<'_>, &Committer),
        town: (hsd_driver::Read, &Plan),
        out: Diagnostics,
        teller: Teller,
    ) -> Result<Built, Failure> {
        let wish = (&*self.output, input.options.detail, self.is_quiet(teller));
        obj::build(wish, (input, committer), town, out, teller)
    }

    /// Writes the houses of a town as one source file.
    fn texts(
        &self,
        (input, committer): (TownInput<'_>, &Committer),
        town: (hsd_driver::Read, &Plan),
        out: Diagnostics,
        teller: Teller,
    ) -> Result<Built, Failure> {
        let wish = (&*self.output, self.is_quiet(teller));
        text::build(wish, (input, committer), town, out, teller)
    }

    /// Builds a town in tiles.
    fn tiles(
        &self,
        (input, committer): (TownInput<'_>, &Committer),
        town: (hsd_driver::Read, &Plan),
        out: Diagnostics,
        teller: Teller,
    ) -> Result<Built, Failure> {
        let wish = Wish {
            output: &self.output,
            levels: (!self.detail.is_empty()).then(|| self.detail.clone()),
            packed: self.compress,
            stats: self.stats,
            quiet: self.is_quiet(teller),
        };
        tiled::build((&wish, committer), input, town, out, teller)
    }

    /// Builds a town and writes its files; returns with it whether it did, since a town with errors is not written.
    fn build(
        &self,
        (input, committer): (TownInput<'_>, &Committer),
        (read, plan): (hsd_driver::Read, &Plan),
        mut out: Diagnostics,
        teller: Teller,
    ) -> Result<(Built, bool), Failure> {
        let progress = Progress::new(plan.features(), self.is_quiet(teller), teller);
        let advance = |n| progress.advance(n);
        let mut houses = TownStream::new(input, plan).telling(&advance);
        let model = self.output.clone();
        let failed = |error| Failure::at(model.display(), error);
        let new = tiled::spools_beside(&model);
        let mut writer = Writer::new(&new).map_err(failed)?;
        let mut ground = terrain::drafts(plan, input.options.detail).map_err(failed)?;
        let streamed = hsd_driver::stream_town(
            (input.source, read),
            houses.by_ref(),
            &mut ground,
            input.world,
            input.options,
            &mut out,
            (&mut |part, images| writer.add(part, images), &new),
        )
        .map_err(failed)?;
        let corrected = problems(&out);
        houses.lose(&streamed.left_out);
        let (mut ledger, included) = houses.finish(&mut out);
        progress.finish()?;
        ledger.report.corrected.extend(corrected);
        if out.has_errors() {
            return Ok(((true, included, out), false));
        }
        writer.made_from(&streamed.provenance);
        let glb = writer.glb(&streamed.materials, &streamed.library, &streamed.grown);
        tiled::check_outputs((&model, &ledger), Some(&model), committer)?;
        let size = committer.write(&model, Files::glb(glb.map_err(failed)?))?;
        tables(&model, &mut ledger, committer)?;
        self.summary(&model, size, &ledger, streamed.houses, teller)?;
        Ok(((ledger.is_incomplete(), included, out), true))
    }

    /// Prints what was built.
    fn summary(
        &self,
        model: &Path,
        size: u64,
        ledger: &Ledger,
        houses: usize,
        teller: Teller,
    ) -> Result<(), Failure> {
        if self.is_quiet(teller) {
            return Ok(());
        }
        let (name, mib) = (model.display(), size.div_ceil(1 << 20));
        let features = tiled::features(&ledger.report);
        let line = text!([name, mib, features, houses]
            "{name}: {features}, {houses} houses, {mib} MiB",
            "{name}: {features}、建物 {houses} 棟、{mib} MiB"
        );
        for line in std::iter::once(line).chain(tiled::above(ledger)) {
            writeln!(io::stderr(), "{}", line.in_language(teller.language))?;
        }
        Ok(())
    }

    /// Returns true if the output is a folder, or is written as one.
    fn is_folder(&self) -> bool {
        let text = self.output.to_string_lossy();
        self.output.is_dir() || text.ends_with(['/', std::path::MAIN_SEPARATOR])
    }

    /// Returns true if a `.obj` is to be written for each tile.
    fn is_obj(&self) -> bool {
        self.output.extension().is_some_and(|e| e == "obj") && !self.is_folder()
    }

    /// Returns true if the houses are to be written as a source file.
    fn is_text(&self) -> bool {
        self.output.extension().is_some_and(|e| e == "hsd") && !self.is_folder()
    }

    /// Returns true if one model is to be written.
    fn is_model(&self) -> Result<bool, Failure> {
        match self.output.extension() {
            Some(extension) if extension == "glb" && !self.is_folder() => Ok(true),
            Some(other) if !self.is_folder() => {
                let other = other.to_string_lossy();
                Err(Failure::Usage(text!([other]
                    "a town is written to a folder, a `.glb`, a `.obj`, a `.city.json`, a `.city.jsonl` or a `.hsd`, not to `.{other}`",
                    "町の出力先はフォルダー、`.glb`、`.obj`、`.city.json`、`.city.jsonl`、`.hsd` のどれかです。`.{other}` には書けません"
                )))
            }
            _ => Ok(false),
        }
    }
}
