//! `hsd build`: texts to models.

mod bake;
mod variants;
pub(in crate::cli) mod watch;

use super::options::{Fineness, Reading, exit, report};
use super::{Outcome, Stop};
#[cfg(feature = "compress")]
use crate::backend::gltf::{Glb, Ktx2};
use crate::backend::images::Library;
use crate::cli::files::input::{Inputs, STDIN};
use crate::cli::files::output;
use crate::cli::files::output::Model;
use crate::cli::files::terminal::{HOUSE, bytes, counted};
use crate::diagnostic::{Diagnostic, Diagnostics, Language, Noun, Text, noun};
use crate::driver::{self, Compiled};
use crate::report::{Format, Report};
use crate::scene::Scene;
use crate::source::Source;
use crate::text;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::OnceCell;
use std::io::{self, IsTerminal, Write};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Make 3D models from texts of houses.
///
/// The ending of OUT says what is written: .glb (all in one file), .gltf, .obj or .stl. Without -o each
/// model is written as .glb beside its text. Where a text has errors, nothing is written for it.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd build shop.hsd -o shop.glb          one house, textures inside
  hsd build street/*.hsd -o models/       a model for each text, in the folder `models`")]
pub(super) struct Build {
    #[command(flatten)]
    pub(super) reading: Reading,

    /// The model's file, a folder (`models/`, one model for each text), or `-` for standard output.
    ///
    /// Several texts and one file make one scene.
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,

    /// The format where OUT does not tell: a folder, or standard output.
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Model>,

    /// Write the pictures of a .glb into a folder beside it.
    #[arg(long)]
    textures_beside: bool,

    /// Write a .glb for the web: several times smaller, for readers that know instances, meshopt and KTX2.
    ///
    /// Houses, storeys and parts are no nodes of their own in it, and have no extras. The pictures take
    /// some seconds.
    #[arg(long, conflicts_with = "textures_beside")]
    compress: bool,

    /// Build each text so many times, each time with the next seed: a house for every draw, in rows, or in a folder a
    /// model each. `--seed` gives the first one; it is 0 else.
    #[arg(long, value_name = "N", conflicts_with = "watch")]
    variants: Option<NonZeroU32>,

    /// Draw a contact sheet of the variants, .png or .jpg: a picture of each with its seed. Without -o no model is
    /// written.
    #[arg(long, value_name = "FILE", requires = "variants")]
    sheet: Option<PathBuf>,

    #[command(flatten)]
    fineness: Fineness,

    #[command(flatten)]
    baking: bake::Baking,

    /// Build again whenever a text or a picture changes, until interrupted.
    #[arg(long)]
    watch: bool,

    /// Say how large the model is and how long each step took.
    #[arg(long)]
    stats: bool,

    /// Say nothing unless something is wrong.
    #[arg(short, long)]
    quiet: bool,
}

/// How to get what was left out of this program.
const NO_COMPRESS: Noun = noun(
    "this hsd is built without --compress; with a C++ compiler at hand, \
     `cargo build --release --features compress` makes one that has it",
    "この hsd には --compress が含まれていません。C++ コンパイラーがあれば \
     `cargo build --release --features compress` で含めて作れます",
);

const MODEL: Noun = noun("model", "モデル{}個");

/// Texts that make one model.
#[derive(Debug)]
pub(super) struct Job {
    inputs: Vec<PathBuf>,
    output: PathBuf,
    model: Model,
    /// The only variant, where it is one of several.
    seed: Option<u64>,
}

impl Build {
    pub(super) fn run(&self, language: Language) -> Outcome {
        self.reading.check_folders()?;
        self.check_inputs()?;
        if let Some(sheet) = &self.sheet {
            variants::check_sheet(sheet, self.variants)?;
        }
        let jobs = self.jobs()?;
        for job in &jobs {
            self.check_compress(job)?;
            job.keeps_its_texts()?;
            job.spares_the_screen()?;
        }
        if self.watch {
            return watch::run(self, &jobs, language);
        }
        let built = self.all(&jobs, language)?;
        match &self.sheet {
            Some(sheet) => Ok(built.worse(self.contact_sheet(sheet, jobs.is_empty(), language)?)),
            None => Ok(built),
        }
    }

    /// Runs all jobs. One that fails does not stop the others.
    pub(super) fn all(&self, jobs: &[Job], language: Language) -> Outcome {
        let status = Status::new(self.quiet, jobs.len(), language);
        let (mut spoiled, mut failure) = (0, None);
        for job in jobs {
            match self.one(job, &status) {
                Ok(true) => spoiled += 1,
                Ok(false) => {}
                Err(Stop::Io(message)) => {
                    if let Some(Stop::Io(before)) = failure.replace(Stop::Io(message)) {
                        status.line(&text!([before] "hsd: {before}", "hsd: {before}"))?;
                    }
                }
                Err(stop) => return Err(stop),
            }
            status.advance();
        }
        status.finish();
        if let Some(stop) = failure {
            return Err(stop);
        }
        if jobs.len() > 1 && !self.quiet {
            let written = counted(jobs.len() - spoiled, MODEL);
            let unwritten = counted(spoiled, MODEL);
            status.line(&match spoiled {
                0 => text!([written] "wrote {written}", "{written}を書きました"),
                _ => text!([written, unwritten]
                    "wrote {written}, {unwritten} not written",
                    "{written}を書きました。{unwritten}は書いていません"
                ),
            })?;
        }
        Ok(exit(spoiled > 0))
    }

    /// Runs one job; whether its texts are spoiled.
    fn one(&self, job: &Job, status: &Status) -> Result<bool, Stop> {
        let start = Instant::now();
        let mut out = Diagnostics::new();
        let limits = self.reading.limits();
        let inputs = Inputs::read(&job.inputs, limits.bytes, &mut out)?;
        let world = self.reading.world(&job.inputs);
        let options = self.options(job.seed, &inputs, &mut out)?;
        let mut compiled = driver::compile(&inputs.accepted(), &world, &options, &mut out);
        let Compiled {
            building, scene, ..
        } = &compiled;
        let paths = &scene.pictures;
        let mut library = driver::pictures(paths, &building.shell, &world, &limits, &mut out);
        library.bake(&scene.baked);
        driver::flaws(&compiled, &mut out);
        let list = out.into_sorted();
        let included = std::mem::take(&mut compiled.included);
        status.report(&inputs.and(included), &list)?;
        if list.iter().any(|d| self.reading.spoils(d.severity)) {
            return Ok(true);
        }
        let mut times = std::mem::take(&mut compiled.times);
        // Only the scene is written; a town's walls and roofs make room.
        let houses = std::mem::take(&mut compiled.building).shell.houses.len();
        if self.baking.bake {
            driver::timed(&mut times, "bake", || {
                self.baking.run(&mut compiled.scene, &mut library);
            });
        }
        let scene = &compiled.scene;
        let size = driver::timed(&mut times, "write", || {
            if self.compress {
                return compressed(scene, &library, &job.output);
            }
            let beside = self.textures_beside;
            let files = job.model.files(scene, &library, &job.output, beside);
            output::write(&job.output, files)
        })?;
        if status.chatty || self.stats {
            let counts = (houses, scene.stats().triangles);
            status.line(&told(&job.output, counts, size, start.elapsed()))?;
        }
        if self.stats {
            status.line(&statistics(scene, &times))?;
        }
        Ok(false)
    }

    /// What a run is to do, for all variants or for the one of this seed.
    pub(super) fn options(
        &self,
        seed: Option<u64>,
        inputs: &Inputs,
        out: &mut Diagnostics,
    ) -> Result<driver::Options, Stop> {
        let mut options = driver::Options {
            detail: self.fineness.detail(),
            ..self.reading.options(inputs, out)?
        };
        match seed {
            Some(_) => options.expand.seed = seed,
            None => options.variants = self.variants,
        }
        Ok(options)
    }

    /// Fails for models among the texts: what was meant is `-o`.
    fn check_inputs(&self) -> Result<(), Stop> {
        let is_model = |i: &&PathBuf| Model::of_ending(i).is_some();
        match self.reading.inputs.iter().find(is_model) {
            Some(model) => {
                let shown = model.display();
                Err(Stop::Usage(text!(
                    "{shown} is no text: the model's name goes after -o, as in `-o {shown}`",
                    "{shown} はテキストではありません。モデルの名前は `-o {shown}` のように -o の後に書いてください"
                )))
            }
            None => Ok(()),
        }
    }

    /// Fails where `--compress` is asked of what cannot be so.
    fn check_compress(&self, job: &Job) -> Result<(), Stop> {
        let message = match (self.compress, job.model) {
            (false, _) => return Ok(()),
            (true, Model::Glb) if cfg!(feature = "compress") => return Ok(()),
            (true, Model::Glb) => NO_COMPRESS,
            (true, _) => noun(
                "--compress makes a .glb only",
                "--compress で作れるのは .glb だけです",
            ),
        };
        Err(Stop::Usage(message.into()))
    }

    /// What is to be made of what.
    fn jobs(&self) -> Result<Vec<Job>, Stop> {
        let inputs = &self.reading.inputs;
        let stdin = inputs.iter().filter(|i| i.as_os_str() == STDIN).count();
        if stdin > 1 || (stdin > 0 && self.watch) {
            return Err(Stop::stdin_twice());
        }
        if self.sheet.is_some() && self.output.is_none() {
            return Ok(vec![]);
        }
        let Some(output) = &self.output else {
            let model = self.format.unwrap_or_default();
            return each(inputs, model, |input| match input.as_os_str() == STDIN {
                true => input.to_owned(),
                false => input.with_extension(model.ending()),
            });
        };
        let text = output.to_string_lossy();
        if output.is_dir() || text.ends_with(['/', std::path::MAIN_SEPARATOR]) {
            let made = std::fs::create_dir_all(output);
            made.map_err(|e| Stop::at(output.display(), e))?;
            let model = self.format.unwrap_or_default();
            let jobs = each(inputs, model, |input| {
                let stem = if input.as_os_str() == STDIN {
                    Path::new("stdin")
                } else {
                    input
                };
                let name = stem.file_name().map(PathBuf::from).unwrap_or_default();
                output.join(name.with_extension(model.ending()))
            })?;
            return self.each_variant(jobs);
        }
        let stdout = output.as_os_str() == STDIN;
        let model = match self.format {
            Some(model) => model,
            None if stdout => Model::Glb,
            None => Model::of(output)?,
        };
        let several = self.textures_beside || matches!(model, Model::Gltf | Model::Obj);
        if stdout && several {
            return Err(Stop::Usage(text!(
                "standard output takes one file: .glb or .stl, textures inside",
                "標準出力に書けるのはひとつのファイル (.glb か .stl、テクスチャーも中に) だけです"
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

impl Job {
    /// Fails where the model would take the place of a text.
    fn keeps_its_texts(&self) -> Result<(), Stop> {
        let real = |p: &Path| p.canonicalize().ok();
        let output = real(&self.output);
        let same = |input: &&PathBuf| output.is_some() && real(input) == output;
        match self.inputs.iter().find(same) {
            Some(text) if text.is_file() => {
                let shown = text.display();
                Err(Stop::Usage(text!(
                    "{shown} is a text to be read; it would be overwritten",
                    "{shown} は読むテキストです。上書きされてしまいます"
                )))
            }
            _ => Ok(()),
        }
    }

    /// Fails where the bytes of a model would be poured on the screen.
    fn spares_the_screen(&self) -> Result<(), Stop> {
        if self.output.as_os_str() == STDIN && io::stdout().is_terminal() {
            return Err(Stop::Usage(text!(
                "a model is no text for the screen; give a file by -o, as in `-o house.glb`",
                "モデルは画面に表示できません。`-o house.glb` のように -o でファイルを指定してください"
            )));
        }
        Ok(())
    }

    /// The texts.
    pub(super) fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}

/// A job for each input; two of one output are an error, on any system whatever letters are large.
fn each(
    inputs: &[PathBuf],
    model: Model,
    output: impl Fn(&Path) -> PathBuf,
) -> Result<Vec<Job>, Stop> {
    let mut jobs: Vec<Job> = vec![];
    let mut taken = std::collections::HashMap::new();
    // A folder's file of parts makes no model of its own.
    let parts = |input: &PathBuf| inputs.len() > 1 && input.ends_with(driver::PARTS_BESIDE);
    for input in inputs.iter().filter(|input| !parts(input)) {
        let output = output(input);
        let key = output.to_string_lossy().to_lowercase();
        if let Some(other) = taken.insert(key, input) {
            return Err(Stop::one_output(other, input, &output));
        }
        jobs.push(Job {
            inputs: vec![input.clone()],
            output,
            model,
            seed: None,
        });
    }
    Ok(jobs)
}

/// Writes a model for the web; returns how many bytes it has.
#[cfg(feature = "compress")]
fn compressed(scene: &Scene, library: &Library, output: &Path) -> Result<u64, Stop> {
    let pictures = Ktx2::new(scene, library);
    let glb = Glb::compressed(scene, &pictures);
    output::write(output, output::Files::glb(glb))
}

#[cfg(not(feature = "compress"))]
fn compressed(_: &Scene, _: &Library, _: &Path) -> Result<u64, Stop> {
    Err(Stop::Usage(NO_COMPRESS.into()))
}

/// `wrote shop.glb: 1 house, 5230 triangles, 1.2 MB in 12 ms`.
fn told(output: &Path, (houses, triangles): (usize, usize), size: u64, took: Duration) -> Text {
    let place = match output.as_os_str() == STDIN {
        true => text!("the model", "モデル"),
        false => output.display().to_string().into(),
    };
    let houses = counted(houses, HOUSE);
    let triangles = counted(triangles, noun("triangle", "三角形{}枚"));
    let (size, took) = (bytes(size as usize), took.as_millis());
    text!([place, houses, triangles, size]
        "wrote {place}: {houses}, {triangles}, {size} in {took} ms",
        "{place} を書きました: {houses}、{triangles}、{size}、{took} ms"
    )
}

fn statistics(scene: &Scene, times: &[(&'static str, Duration)]) -> Text {
    let nodes = counted(scene.nodes.len(), noun("node", "ノード{}個"));
    let meshes = counted(scene.meshes.len(), noun("mesh", "メッシュ{}個"));
    let materials = counted(scene.materials.len(), noun("material", "材質{}種"));
    let time = |(name, took): &(&str, Duration)| {
        format!("  {name:<16} {:9.3} ms", took.as_secs_f64() * 1e3)
    };
    let times: Vec<String> = times.iter().map(time).collect();
    let times = times.join("\n");
    text!([nodes, meshes, materials]
        "  {nodes}, {meshes}, {materials}\n{times}",
        "  {nodes}、{meshes}、{materials}\n{times}"
    )
}

/// What is said on standard error while jobs run: with a bar where many take long and somebody watches.
struct Status {
    language: Language,
    /// Whether each model gets a line.
    chatty: bool,
    start: Instant,
    jobs: usize,
    done: std::cell::Cell<u64>,
    bar: OnceCell<ProgressBar>,
}

impl Status {
    fn new(quiet: bool, jobs: usize, language: Language) -> Status {
        Status {
            language,
            chatty: !quiet && jobs == 1,
            start: Instant::now(),
            jobs,
            done: 0.into(),
            bar: OnceCell::new(),
        }
    }

    fn line(&self, text: &Text) -> Result<(), Stop> {
        let text = text.in_language(self.language);
        self.above(|| writeln!(io::stderr(), "{text}"))?;
        Ok(())
    }

    fn report(&self, sources: &[Source], list: &[Diagnostic]) -> Result<(), Stop> {
        if list.is_empty() {
            return Ok(());
        }
        let written = Report::new(sources, list).in_language(self.language);
        self.above(|| report(&written, Format::Human, &mut io::stderr()))
    }

    /// Writes above the bar.
    fn above<T>(&self, write: impl FnOnce() -> T) -> T {
        match self.bar.get() {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    fn advance(&self) {
        self.done.set(self.done.get() + 1);
        let long = self.start.elapsed() > Duration::from_secs(1);
        if self.jobs > 1 && long && io::stderr().is_terminal() {
            let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {eta}");
            let bar = self.bar.get_or_init(|| {
                let bar = ProgressBar::new(self.jobs as u64);
                style.map_or(bar.clone(), |style| bar.with_style(style))
            });
            bar.set_position(self.done.get());
        }
    }

    fn finish(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}
