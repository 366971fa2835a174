//! `hsd build`: builds 3D models from house files.

mod bake;
pub(crate) mod facade;
mod format;
pub(crate) mod draw;
mod job;
pub(crate) mod plan;
mod progress;
mod statistics;
mod steps;
pub(crate) mod streamed;
pub(crate) mod init;
mod tiled;
pub(crate) mod town;
mod variants;
pub(crate) mod watch;

use super::options::{DetailArgs, InputArgs, exit};
use super::{Failure, Outcome};
use crate::files::input::{Inputs, STDIN};
use crate::files::messages::MessageArgs;
#[cfg(feature = "compress")]
use crate::files::output::Files;
use crate::files::output::{Committer, Model};
use crate::files::terminal::counted;
use clap::Args;
use hsd_base::diagnostic::{Diagnostics, Language, Noun, noun};
use hsd_base::text;
use hsd_driver::Compiled;
#[cfg(feature = "compress")]
use hsd_export::gltf::{Glb, Ktx2};
use hsd_export::images::Library;
use hsd_export::spool::in_memory;
use hsd_scene::{Detail, Scene};
use job::{Job, each};
use progress::Progress;
use statistics::{statistics, summary};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::time::Instant;
use streamed::{Finished, Started};

/// Build 3D models from house files.
///
/// The extension of OUT selects the format: .glb (everything in one file), .gltf, .obj or .stl. Without -o, each
/// model is written as .glb beside its source file. No model is written for a source file with errors.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd build shop.hsd -o shop.glb          one house, textures embedded
  hsd build street/*.hsd -o models/       one model per source file, in the folder `models`")]
pub(super) struct Build {
    #[command(flatten)]
    pub(super) input_args: InputArgs,

    /// Write the model to this file, one model per source file into this folder (`models/`), or to standard output (`-`).
    ///
    /// Several source files and one output file make one scene.
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,

    /// Set the format if OUT is a folder or standard output.
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Model>,

    /// Write the textures of a .glb to a folder beside it instead of embedding them.
    #[arg(long)]
    textures_beside: bool,

    /// Write a .glb for the web: several times smaller, but requires instancing, meshopt and KTX2 support.
    ///
    /// Houses, storeys and parts have no nodes of their own and no extras. Encoding the textures takes some seconds.
    /// Blender, as of 5.1, cannot read such a file.
    #[arg(long, conflicts_with = "textures_beside")]
    compress: bool,

    /// Join houses at detail 0: some hundred of them in one mesh of a .glb, with a feature id each.
    ///
    /// For cities: a fraction of the nodes, half the bytes. Vertices carry the number of their house (EXT_mesh_features); its
    /// name and its place in the source file are in the extras of the node.
    #[arg(long, conflicts_with_all = ["compress", "variants"])]
    join: bool,

    /// Build N variants of each source file with consecutive random seeds.
    ///
    /// The variants stand in rows in one model; if OUT is a folder, each gets a model of its own. The first seed is
    /// that of --seed, or 0.
    #[arg(long, value_name = "N", conflicts_with = "watch")]
    variants: Option<NonZeroU32>,

    /// Draw a contact sheet (.png or .jpg) of the variants with their seeds.
    ///
    /// Without -o, no model is written.
    #[arg(long, value_name = "FILE", requires = "variants")]
    sheet: Option<PathBuf>,

    #[command(flatten)]
    detail_args: DetailArgs,

    #[command(flatten)]
    bake_args: bake::BakeArgs,

    #[command(flatten)]
    format_args: format::FormatArgs,

    #[command(flatten)]
    message_args: MessageArgs,

    /// Rebuild whenever a source file or an image changes, until interrupted.
    #[arg(long)]
    watch: bool,

    /// Print the size of the model and the duration of each stage.
    #[arg(long)]
    stats: bool,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

/// The message for a build without the `compress` feature.
const NO_COMPRESS: Noun = noun(
    "this hsd was built without --compress; to build one with it (requires a C++ compiler): \
     `cargo build --release --features compress`",
    "この hsd は --compress なしでビルドされています。C++ コンパイラーがあれば、\
     `cargo build --release --features compress` で使えるようになります",
);

const MODEL: Noun = noun("model", "モデル{}個");

impl Build {
    pub(super) fn run(&self, language: Language) -> Outcome {
        self.input_args.check_folders()?;
        self.check_inputs()?;
        if let Some(sheet) = &self.sheet {
            variants::check_sheet(sheet, self.variants)?;
        }
        let jobs = self.jobs()?;
        for job in &jobs {
            self.check_compress(job)?;
            self.check_join(job)?;
            self.format_args.check(job)?;
            job.check_terminal()?;
            self.message_args.check(&job.output)?;
        }
        let committer = self.committer(&jobs)?;
        if self.watch {
            return watch::run(self, &jobs, language);
        }
        let built = self.all((&jobs, &committer), language)?;
        match &self.sheet {
            Some(sheet) => {
                let target = (&**sheet, &committer);
                Ok(built.worse(self.contact_sheet(target, jobs.is_empty(), language)?))
            }
            None => Ok(built),
        }
    }

    /// Returns the committer of a run. Fails if an output is a file that the command line names as an input.
    pub(super) fn committer(&self, jobs: &[Job]) -> Result<Committer, Failure> {
        let committer = Committer::reading(self.input_args.files());
        committer.check(jobs.iter().map(|job| &job.output))?;
        committer.named_by("--sheet").check(&self.sheet)?;
        Ok(committer)
    }

    /// Runs all jobs; a failed job does not stop the others.
    pub(super) fn all(
        &self,
        (jobs, committer): (&[Job], &Committer),
        language: Language,
    ) -> Outcome {
        // A house may have an image in the place of one beside the model of another.
        let committer =
            match jobs.len() > 1 && jobs.iter().any(|job| self.has_side_files(job.model)) {
                true => committer.holding(),
                false => committer.clone(),
            };
        let teller = self.message_args.teller(language);
        let progress = Progress::new(self.quiet, jobs.len(), teller);
        let (mut spoiled, mut failure) = (0, None);
        for job in jobs {
            match self.one((job, &committer), &progress) {
                Ok(true) => spoiled += 1,
                Ok(false) => {}
                Err(Failure::Io(message)) => {
                    if let Some(Failure::Io(before)) = failure.replace(Failure::Io(message)) {
                        progress.line(&text!([before] "hsd: {before}", "hsd: {before}"))?;
                    }
                }
                Err(stop) => return Err(stop),
            }
            progress.advance()?;
        }
        progress.finish();
        committer.publish()?;
        if let Some(stop) = failure {
            return Err(stop);
        }
        if jobs.len() > 1 && !progress.quiet {
            let written = counted(jobs.len() - spoiled, MODEL);
            let unwritten = counted(spoiled, MODEL);
            progress.line(&match spoiled {
                0 => text!([written] "wrote {written}", "{written}を書きました"),
                _ => text!([written, unwritten]
                    "wrote {written}, {unwritten} not written",
                    "{written}を書きました。{unwritten}は書いていません"
                ),
            })?;
        }
        Ok(exit(spoiled > 0))
    }

    /// Runs one job; returns whether its source files have errors.
    fn one(
        &self,
        (job, committer): (&Job, &Committer),
        progress: &Progress,
    ) -> Result<bool, Failure> {
        match self.streams(job) {
            true => self.stream((job, committer), progress),
            false => self.whole((job, committer), progress),
        }
    }

    /// Runs one job with the whole scene in memory; returns whether its source files have errors.
    fn whole(
        &self,
        (job, committer): (&Job, &Committer),
        progress: &Progress,
    ) -> Result<bool, Failure> {
        let start = Instant::now();
        let mut out = Diagnostics::new();
        let limits = self.input_args.limits();
        let inputs = Inputs::read(&job.inputs, limits.bytes, &mut out)?;
        let world = self.input_args.world(&job.inputs);
        let world = world.recorded_in(&committer.inputs);
        let options = self.options(job.seed, &inputs, &mut out)?;
        let mut compiled = hsd_driver::compile(&inputs.accepted(), &world, &options, &mut out);
        let Compiled {
            building, scene, ..
        } = &compiled;
        let paths = &scene.pictures;
        let mut library = hsd_driver::pictures(paths, building, &world, &limits, &mut out);
        library.bake(&scene.baked);
        hsd_driver::flaws(&compiled, &mut out);
        if job.model == Model::Stl {
            self.format_args.print_scene(scene.whole(), &mut out)?;
        }
        let list = out.into_sorted();
        let read = job.files_read(&compiled.included, paths);
        let included = std::mem::take(&mut compiled.included);
        let told = progress.report(&inputs.and(included), &list)?;
        if list.iter().any(|d| self.input_args.spoils(d.severity)) {
            progress.teller.built(&told, None, &read)?;
            return Ok(true);
        }
        let mut times = std::mem::take(&mut compiled.times);
        // Only the scene is needed from here on; frees the memory of a town's walls and roofs.
        let houses = std::mem::take(&mut compiled.building).houses.len();
        if self.bake_args.bake {
            hsd_driver::timed(&mut times, "bake", || {
                self.bake_args.run(&mut compiled.scene, &mut library);
            });
        }
        let scene = &compiled.scene;
        let size = hsd_driver::timed(&mut times, "write", || {
            self.write_scene(scene, &library, (job, committer))
        })?;
        progress.teller.built(&told, Some(&job.output), &read)?;
        if progress.verbose || self.stats {
            let counts = (houses, scene.stats().triangles);
            progress.line(&summary(&job.output, counts, size, start.elapsed()))?;
        }
        if self.stats {
            let counts = (scene.stats(), scene.materials.len());
            progress.line(&statistics(counts, &[], &times))?;
        }
        Ok(false)
    }

    /// Writes the model of a whole scene and returns its size in bytes.
    fn write_scene(
        &self,
        scene: &Scene,
        library: &Library,
        (job, committer): (&Job, &Committer),
    ) -> Result<u64, Failure> {
        if self.compress {
            return compressed(scene, library, (&job.output, committer));
        }
        let mut model = Started::new(job.model, self, &in_memory)?;
        model.add(scene.whole(), library)?;
        let made = Finished::scene(scene, library);
        let files = model.finish(made, &job.output, self.textures_beside)?;
        committer.write(&job.output, files)
    }

    /// Returns the compiler options, for all variants or only the one with `seed`.
    pub(super) fn options(
        &self,
        seed: Option<u64>,
        inputs: &Inputs,
        out: &mut Diagnostics,
    ) -> Result<hsd_driver::Options, Failure> {
        let mut options = hsd_driver::Options {
            detail: self.detail_args.detail(),
            shown: self.detail_args.shown(),
            ..self.input_args.options(inputs, out)?
        };
        match seed {
            Some(_) => options.expand.seed = seed,
            None => options.variants = self.variants,
        }
        Ok(options)
    }

    /// Fails if an input is a model: its name was meant for `-o`.
    fn check_inputs(&self) -> Result<(), Failure> {
        let is_model = |i: &&PathBuf| Model::of_extension(i).is_some();
        match self.input_args.inputs.iter().find(is_model) {
            Some(model) => {
                let shown = model.display();
                Err(Failure::Usage(text!([shown]
                    "{shown} is a model, not a source file: name the output with -o, as in `-o {shown}`",
                    "{shown} はテキストではなくモデルです。出力先は `-o {shown}` のように -o で指定してください"
                )))
            }
            None => Ok(()),
        }
    }

    /// Fails if `--compress` is given but not supported by the format or this build.
    fn check_compress(&self, job: &Job) -> Result<(), Failure> {
        let message = match (self.compress, job.model) {
            (false, _) => return Ok(()),
            (true, Model::Glb) if cfg!(feature = "compress") => return Ok(()),
            (true, Model::Glb) => NO_COMPRESS,
            (true, _) => noun(
                "--compress writes .glb only",
                "--compress で書けるのは .glb だけです",
            ),
        };
        Err(Failure::Usage(message.into()))
    }

    /// Fails if `--join` is given but the model has no joined houses.
    fn check_join(&self, job: &Job) -> Result<(), Failure> {
        let glb = job.model == Model::Glb && self.streams(job);
        let joins = glb && self.detail_args.detail() == Detail::Body;
        match self.join && !joins {
            true => Err(Failure::Usage(text!(
                "--join needs --detail 0 and writes .glb only",
                "--join は --detail 0 とともに使い、.glb だけを書きます"
            ))),
            false => Ok(()),
        }
    }

    /// Returns whether models of this format consist of several files.
    fn has_side_files(&self, model: Model) -> bool {
        self.textures_beside || matches!(model, Model::Gltf | Model::Obj)
    }

    /// Returns the models to build.
    fn jobs(&self) -> Result<Vec<Job>, Failure> {
        let inputs = &self.input_args.inputs;
        let stdin = inputs.iter().filter(|i| i.as_os_str() == STDIN).count();
        if stdin > 1 || (stdin > 0 && self.watch) {
            return Err(Failure::stdin_twice());
        }
        if self.sheet.is_some() && self.output.is_none() {
            return Ok(vec![]);
        }
        let Some(output) = &self.output else {
            let model = self.format.unwrap_or_default();
            return each(inputs, model, |input| match input.as_os_str() == STDIN {
                true => input.to_owned(),
                false => input.with_extension(model.extension()),
            });
        };
        let text = output.to_string_lossy();
        if output.is_dir() || text.ends_with(['/', std::path::MAIN_SEPARATOR]) {
            let made = std::fs::create_dir_all(output);
            made.map_err(|e| Failure::at(output.display(), e))?;
            let model = self.format.unwrap_or_default();
            let jobs = each(inputs, model, |input| {
                let stem = if input.as_os_str() == STDIN {
                    Path::new("stdin")
                } else {
                    input
                };
                let name = stem.file_name().map(PathBuf::from).unwrap_or_default();
                output.join(name.with_extension(model.extension()))
            })?;
            return self.each_variant(jobs);
        }
        let stdout = output.as_os_str() == STDIN;
        let model = match self.format {
            Some(model) => model,
            None if stdout => Model::Glb,
            None => Model::of(output)?,
        };
        if stdout && self.has_side_files(model) {
            return Err(Failure::Usage(text!(
                "only a single file can be written to standard output: .glb or .stl, with textures embedded",
                "標準出力に書けるのは単一のファイル (.glb か .stl、テクスチャーは埋め込み) だけです"
            )));
        }
        Ok(vec![Job {
            inputs: inputs.clone(),
            output: output.clone(),
            model,
            seed: None,
        }])
    }
}

/// Writes a compressed model and returns its size in bytes.
#[cfg(feature = "compress")]
fn compressed(
    scene: &Scene,
    library: &Library,
    (output, committer): (&Path, &Committer),
) -> Result<u64, Failure> {
    let pictures = Ktx2::new(scene, library);
    let glb = Glb::compressed(scene, &pictures);
    committer.write(output, Files::glb(glb))
}

#[cfg(not(feature = "compress"))]
fn compressed(_: &Scene, _: &Library, _: (&Path, &Committer)) -> Result<u64, Failure> {
    Err(Failure::Usage(NO_COMPRESS.into()))
}
