//! `hsd render`: renders images for documents with the page of the preview in a headless browser.

mod browser;
mod cameras;
mod progress;
mod shots;
mod standing;
mod target;
mod values;

use super::options::{DetailArgs, ReadArgs, exit, report};
use super::view::{FileHost, check_page};
use super::{Failure, Outcome};
use crate::build::town;
use crate::files::input::Inputs;
use crate::files::output::Committer;
use browser::Browser;
use clap::Args;
use hsd_base::diagnostic::{Diagnostic, Diagnostics, Language};
use hsd_base::source::Source;
use hsd_base::text;
use hsd_ir::ast::{NamedView, ViewTime};
use hsd_ir::building::Built;
use hsd_report::{Format, Report};
use hsd_view::{Preview, PreviewOptions, Screenshot};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use progress::Progress;
use shots::{Scenery, Shot, ViewParser};
use standing::Camera;
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};
use target::{ImageFormat, Target, write};
use values::{Place, angle, date, hour, place, size};

/// The maximum time without a response from the browser.
const TIMEOUT: Duration = Duration::from_secs(300);

/// The interval of the checks whether the browser still runs.
const POLL_INTERVAL: Duration = Duration::from_millis(250);

/// Render images of houses and towns for documents.
///
/// The page of `hsd view` draws them in afternoon light, in a headless Chromium, Chrome or Edge installed on this machine;
/// HSD_CHROMIUM selects another one. A single image is written to OUT, several into the folder OUT as NAME-VIEW.png. No
/// image is written for a source file with errors.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd render shop.hsd -o shop.png                              render the view from the street
  hsd render street/*.hsd -o pictures/ --view front,above      render two views of each house
  hsd render street.hsd -o eye.png --from 2,0,1.6 --to 60,0,3  stand in the street and look east
  hsd render shop.hsd -o front.png --view elevation-front      draw the front in parallel projection
  hsd render plot.hsd -o pictures/ --view garden,court         take the view named garden in the file, and a courtyard
  hsd render plot.hsd -o kura.png --house kura --date 2026-12-21 --hour 9
                                                               show the storehouse on a winter morning
  hsd render kyoto.hsd -o film/ --camera path.json --detail 1  go through a town along a path of cameras")]
pub(super) struct Render {
    /// Source files of houses or towns, or models (.glb).
    #[arg(value_name = "FILE", required = true)]
    inputs: Vec<PathBuf>,

    #[command(flatten)]
    read_args: ReadArgs,

    #[command(flatten)]
    detail_args: DetailArgs,

    /// Write the image to this file (.png or .jpg), or several images into this folder (`pictures/`).
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,

    /// Select the views, separated by commas: those below, or the names of `View` elements in the file.
    #[arg(
        long = "view",
        value_parser = ViewParser,
        value_delimiter = ',',
        default_value = "front",
        value_name = "VIEW"
    )]
    views: Vec<String>,

    /// Show this house of the file: its name.
    #[arg(long, value_name = "NAME", conflicts_with = "from")]
    house: Option<String>,

    /// Take the sun of Kyoto on this date instead of an afternoon's.
    #[arg(long, value_name = "YYYY-MM-DD", value_parser = date)]
    date: Option<String>,

    /// Take it at this hour, as on a clock [default: 12].
    #[arg(long, value_name = "H[:MM]", requires = "date", value_parser = hour)]
    hour: Option<f64>,

    /// Place the camera: metres east, north and up, instead of a view.
    #[arg(long, value_name = "E,N,U", requires = "to", conflicts_with = "views", allow_hyphen_values = true, value_parser = place)]
    from: Option<Place>,

    /// Point the camera at a place: metres east, north and up.
    #[arg(long, value_name = "E,N,U", requires = "from", allow_hyphen_values = true, value_parser = place)]
    to: Option<Place>,

    /// Set the vertical angle of view of that camera, degrees.
    #[arg(long, value_name = "DEG", requires = "from", default_value_t = 45.0, value_parser = angle)]
    fov: f64,

    /// Take the cameras of this file.
    ///
    /// It is JSON, `[{"from": [2, -8, 1.6], "to": [2, 0, 3]}, ...]`: places in metres east, north and up; `name`, `fov`, `date`
    /// and `hour` may be given. `frames` is the number of pictures on a smooth way from the camera before.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["views", "from", "house"])]
    camera: Option<PathBuf>,

    /// Set the image size in pixels.
    #[arg(long, value_name = "WxH", default_value = "960x640", value_parser = size)]
    size: (u32, u32),

    /// Set the number of light samples; more make smoother shadows.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=1024))]
    samples: u32,

    /// Set the format of images in a folder.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: ImageFormat,

    /// Print only diagnostics.
    #[arg(short, long)]
    quiet: bool,
}

/// The model of a town, and the folder that it lies in as long as it is needed.
struct BuiltTown {
    model: PathBuf,
    _folder: tempfile::TempDir,
}

/// The cameras of a checked file.
#[derive(Default)]
struct Seen {
    houses: Vec<Built>,
    views: Vec<NamedView>,
    model: bool,
    /// True for a town, of which a model is built first.
    town: bool,
}

/// Pictures that one browser takes of a file.
struct Run<'a> {
    input: &'a Path,
    shots: &'a [Shot],
    screenshots: &'a Receiver<Screenshot>,
    running: browser::Running,
}

/// Returns the browser that takes the images, with the folder of the images made. Fails without a page or a browser.
fn ready(target: &Target<'_>) -> Result<Browser, Failure> {
    check_page()?;
    let browser = Browser::find()?;
    if let Target::Folder(folder, _) = target {
        std::fs::create_dir_all(folder).map_err(|e| Failure::at(folder.display(), e))?;
    }
    Ok(browser)
}

impl Render {
    pub(super) fn run(&self, language: Language) -> Outcome {
        self.read_args.check_folders()?;
        let target = self.target()?;
        let cameras = self.camera.as_deref().map(cameras::read).transpose()?;
        let committer = self.committer(&target, cameras.as_deref())?;
        // Found when the first image is due, so that mistakes are reported without a browser too.
        let mut browser = None;
        let count = cameras.as_ref().map_or(self.count(), Vec::len);
        let mut spoiled = false;
        let mut progress = Progress::new(self.inputs.len() * count);
        for input in &self.inputs {
            match self.seen(input, &committer, language)? {
                None => {
                    progress.total -= count;
                    spoiled = true;
                }
                Some(seen) => {
                    let shots = match &cameras {
                        Some(cameras) => cameras.clone(),
                        None => self.shots(input, &seen)?,
                    };
                    let browser = match &browser {
                        Some(browser) => browser,
                        None => browser.insert(ready(&target)?),
                    };
                    let built = match seen.town {
                        true => Some(self.built(input, &committer, language)?),
                        false => None,
                    };
                    let input = built.as_ref().map_or(input, |built| &built.model);
                    committer.check(shots.iter().map(|shot| target.path(input, &shot.name)))?;
                    self.one(
                        (input, &shots),
                        (&target, &committer),
                        browser,
                        (language, &mut progress),
                    )?;
                }
            }
        }
        Ok(exit(spoiled))
    }

    /// Returns the committer of a run. Fails if an image is a file that the command line names as an input.
    fn committer(
        &self,
        target: &Target<'_>,
        cameras: Option<&[Shot]>,
    ) -> Result<Committer, Failure> {
        let named = self.inputs.iter().chain(&self.read_args.catalogs);
        let committer = Committer::reading(named.chain(&self.camera));
        if let Target::File(path, _) = target {
            committer.check([path])?;
        }
        let mut paths = vec![];
        for input in &self.inputs {
            let shots = cameras.unwrap_or_default().iter();
            paths.extend(shots.map(|shot| target.path(input, &shot.name)));
        }
        committer.check(paths)?;
        Ok(committer)
    }

    /// Returns the number of pictures of each input, if no file says it.
    fn count(&self) -> usize {
        match self.from {
            Some(_) => 1,
            None => self.views.len(),
        }
    }

    /// Builds the model of a town and tells what is wrong with it; a feature without a house spoils no picture.
    fn built(
        &self,
        input: &Path,
        committer: &Committer,
        language: Language,
    ) -> Result<BuiltTown, Failure> {
        let folder = tempfile::tempdir()?;
        let stem = input.file_stem().unwrap_or_default().to_string_lossy();
        let model = folder.path().join(format!("{stem}.glb"));
        let detail = self.detail_args.detail();
        let town = town::model(input, &self.read_args, detail, &model);
        town.run_with(committer, language)?;
        if !model.exists() {
            let shown = input.display();
            return Err(Failure::Io(text!([shown]
                "{shown}: the town has errors, so there is no picture of it",
                "{shown}: 町に誤りがあるため、画像はありません"
            )));
        }
        Ok(BuiltTown {
            model,
            _folder: folder,
        })
    }

    /// Returns the pictures of an input. Fails for a view that it does not have.
    fn shots(&self, input: &Path, seen: &Seen) -> Result<Vec<Shot>, Failure> {
        if let (Some(from), Some(to)) = (self.from, self.to) {
            let fov = self.fov;
            return Ok(vec![Shot::free(Camera { from, to, fov })]);
        }
        let scenery = Scenery {
            houses: &seen.houses,
            views: &seen.views,
            house: self.house.as_deref(),
            model: seen.model,
        };
        scenery.shots(&self.views, &input.display().to_string())
    }

    /// Returns the output. Fails for several images in one file, or two with the same name.
    fn target(&self) -> Result<Target<'_>, Failure> {
        let output = &self.output;
        let named = output.to_string_lossy();
        let folder = output.is_dir() || named.ends_with(['/', std::path::MAIN_SEPARATOR]);
        let several = self.inputs.len() * self.count() > 1 || self.camera.is_some();
        let shown = output.display();
        if !folder && !several {
            return match ImageFormat::of(output) {
                Some(kind) => Ok(Target::File(output, kind)),
                None => Err(Failure::Usage(text!([shown]
                    "{shown}: the extension of an image must be .png or .jpg",
                    "{shown}: 画像の拡張子は .png か .jpg です"
                ))),
            };
        }
        if !folder && ImageFormat::of(output).is_some() {
            return Err(Failure::Usage(text!([shown]
                "{shown} is a single image; for several name a folder, as in `-o pictures/`",
                "{shown} に書ける画像はひとつです。複数の場合は`-o pictures/` のようにフォルダーを指定してください"
            )));
        }
        for (n, input) in self.inputs.iter().enumerate() {
            let stem = input
                .file_stem()
                .map(|s| s.to_string_lossy().to_lowercase());
            let same = |other: &&PathBuf| {
                other
                    .file_stem()
                    .map(|s| s.to_string_lossy().to_lowercase())
                    == stem
            };
            if let Some(other) = self.inputs[..n].iter().find(same) {
                return Err(Failure::one_output(other, input, output));
            }
        }
        Ok(Target::Folder(output, self.format))
    }

    /// Prints the diagnostics of a source file or a model; returns nothing if they make it fail.
    fn seen(
        &self,
        input: &PathBuf,
        committer: &Committer,
        language: Language,
    ) -> Result<Option<Seen>, Failure> {
        let model = input
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("glb"));
        let mut seen = Seen {
            model,
            ..Seen::default()
        };
        let (sources, list) = if model {
            committer.add_inputs(hsd_view::texture_files(input));
            let message = hsd_view::check_model(input);
            let (source, list) = message.map_err(|e| Failure::at(input.display(), e))?;
            (vec![source], list)
        } else {
            self.checked(input, committer, &mut seen)?
        };
        // What is wrong with a town is told when it is built, with its maps.
        if !list.is_empty() && !seen.town {
            let written = Report::new(&sources, &list).in_language(language);
            report(&written, Format::Human, &mut io::stderr())?;
        }
        let spoiled = list.iter().any(|d| self.read_args.spoils(d.severity));
        Ok((seen.town || !spoiled).then_some(seen))
    }

    /// Checks a source file; returns the sources and their diagnostics.
    fn checked(
        &self,
        input: &PathBuf,
        committer: &Committer,
        seen: &mut Seen,
    ) -> Result<(Vec<Source>, Vec<Diagnostic>), Failure> {
        let mut out = Diagnostics::new();
        let own = std::slice::from_ref(input);
        let inputs = Inputs::read(own, self.read_args.limits().bytes, &mut out)?;
        let options = self.read_args.options(&inputs, &mut out)?;
        let world = self.read_args.world(own);
        let world = world.recorded_in(&committer.inputs);
        let checked = hsd_driver::check(&inputs.accepted(), &world, &options, &mut out);
        (seen.houses, seen.views) = (checked.building.houses, checked.views);
        seen.town = checked.is_town;
        seen.model |= seen.town;
        Ok((inputs.and(checked.included), out.into_sorted()))
    }

    /// Renders the images of one file: those under one sun in one run of the browser.
    fn one(
        &self,
        (input, shots): (&Path, &[Shot]),
        target: (&Target<'_>, &Committer),
        browser: &Browser,
        (language, progress): (Language, &mut Progress),
    ) -> Result<(), Failure> {
        let failed = |e| Failure::at(input.display(), e);
        let real = input.canonicalize().map_err(failed)?;
        let name = real.file_name().unwrap_or_default().to_string_lossy();
        let (sink, screenshots) = mpsc::channel();
        let options = PreviewOptions {
            root: real.parent().unwrap_or(Path::new("/")).to_owned(),
            only: vec![name.clone().into_owned()],
            language,
            host: Box::new(FileHost {
                read_args: self.read_args.clone(),
                detail: self.detail_args.detail(),
                shown: self.detail_args.shown(),
                editor: None,
                writes: false,
                scratch: Default::default(),
                record: target.1.inputs.clone(),
            }),
            front: None,
            port: 0,
            watched: vec![],
        };
        let preview = Preview::with_screenshots(options, sink).map_err(failed)?;
        for under in shots.chunk_by(|p, q| p.time == q.time) {
            let url = format!("{}{}", preview.page(&name), self.query(under));
            let running = browser.open(&url)?;
            let run = Run {
                input,
                shots: under,
                screenshots: &screenshots,
                running,
            };
            self.take(run, target, language, progress)?;
        }
        Ok(())
    }

    /// Returns what the page is asked for: pictures under one sun.
    fn query(&self, shots: &[Shot]) -> String {
        let encoded = |text: &str| utf8_percent_encode(text, NON_ALPHANUMERIC).to_string();
        let ids: Vec<&str> = shots.iter().map(|s| &*s.id).collect();
        let cameras = encoded(&shots::cameras(shots));
        let house = self.house.as_deref().map(encoded);
        let house = house.map_or(String::new(), |house| format!("&house={house}"));
        let given = self.date.as_ref().map(|date| ViewTime {
            date: date.clone(),
            hour: self.hour.unwrap_or(ViewTime::USUAL_HOUR),
        });
        // What the command line says of the sun holds for every view.
        let own = shots.first().and_then(|s| s.time.clone());
        let sun = given.or(own).map_or(String::new(), |time| {
            format!("&date={}&hour={}", time.date, time.hour)
        });
        let (width, height) = self.size;
        format!(
            "&render={}&cameras={cameras}{house}{sun}&size={width}x{height}&samples={}",
            ids.join(","),
            self.samples
        )
    }

    /// Writes the images received from the page until it reports completion.
    fn take(
        &self,
        mut run: Run<'_>,
        (target, committer): (&Target<'_>, &Committer),
        language: Language,
        progress: &mut Progress,
    ) -> Result<(), Failure> {
        let shown = run.input.display();
        let mut last_response = Instant::now();
        let mut received = BTreeSet::new();
        loop {
            match run.screenshots.recv_timeout(POLL_INTERVAL) {
                Ok(Screenshot::Picture { view, png }) => {
                    last_response = Instant::now();
                    // The page names the view; only requested views become file names.
                    let Some(shot) = run.shots.iter().find(|s| s.id == view) else {
                        continue;
                    };
                    // A page that is loaded again sends its images again.
                    if !received.insert(view) {
                        continue;
                    }
                    let path = target.path(run.input, &shot.name);
                    write(&path, target.kind(), png, committer)?;
                    progress.done += 1;
                    if !self.quiet {
                        let message = progress.message(&path);
                        writeln!(io::stderr(), "{}", message.in_language(language))?;
                    }
                }
                Ok(Screenshot::Done(errors)) if errors.is_empty() => return Ok(()),
                Ok(Screenshot::Done(errors)) => {
                    let why = errors.join("; ");
                    return Err(Failure::Io(
                        text!([shown, why] "{shown}: {why}", "{shown}: {why}"),
                    ));
                }
                Err(RecvTimeoutError::Timeout) if run.running.ended() => {
                    return Err(Failure::Io(text!([shown]
                        "{shown}: the browser exited before the image was complete",
                        "{shown}: 画像ができる前にブラウザーが終了しました"
                    )));
                }
                Err(RecvTimeoutError::Timeout) if last_response.elapsed() < TIMEOUT => {}
                Err(_) => {
                    return Err(Failure::Io(text!([shown]
                        "{shown}: no response from the browser",
                        "{shown}: ブラウザーから応答がありません"
                    )));
                }
            }
        }
    }
}
