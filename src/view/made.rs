//! What one text makes, ready to be handed out: what the page is told of it, its model, the pictures beside that.

use super::beside::Model;
use super::desk::Desk;
use super::houses::Houses;
use crate::catalog::Catalog;
use crate::diagnostic::{Diagnostics, Language};
use crate::driver::{self, Options};
use crate::ide::Analysis;
use crate::ide::plan::Plan;
use crate::parse;
use crate::report::{Format, Report, Style};
use crate::source::{Source, Span, World};
use serde::Serialize;
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// The name of the model; its pictures lie in a folder named after it.
pub(super) const STEM: &str = "house";

/// A text and its model at one moment.
pub(super) struct Made {
    /// Counts up with every change of any text.
    pub(super) revision: u64,
    /// What the page is told, as JSON.
    pub(super) state: Vec<u8>,
    /// Written when it is asked for.
    model: Content,
    /// The files beside it by their names in it.
    pub(super) pictures: Arc<BTreeMap<String, Vec<u8>>>,
    /// The text and those that were read for it.
    pub(super) sources: Vec<Source>,
    /// The parts that its houses may be made of.
    pub(super) catalog: Cow<'static, Catalog>,
    /// Whether something lies no longer beside a model.
    pub(super) lacks: bool,
    /// What is the same for the same content.
    print: u64,
}

/// What a model is.
enum Content {
    /// What a text makes.
    Houses(Box<Houses>),
    /// What was made before: the bytes of a `.glb`.
    File(Vec<u8>),
}

/// What the page is told of a text: `State` in `view/src/server/api.ts`.
#[derive(Serialize)]
struct State<'a> {
    revision: u64,
    file: &'a str,
    sources: Vec<Told<'a>>,
    diagnostics: &'a RawValue,
    /// Keys and names of the houses, in the order of the model.
    houses: Vec<(&'a str, &'a str)>,
    pictures: &'a BTreeMap<String, String>,
    plan: Plan,
    times: Vec<(&'static str, f64)>,
}

/// A text that was read.
#[derive(Serialize)]
struct Told<'a> {
    id: u16,
    name: &'a str,
    /// Below the root, with `/`.
    path: Option<String>,
    text: &'a str,
    /// Bytes of the file before the text: those of a byte order mark.
    mark: u32,
    /// How many bytes of the file each UTF-16 unit of the text takes, a digit each; `null` = as in UTF-8.
    widths: Option<String>,
}

impl Made {
    /// Reads a text below `root` and builds it. `file` is what the page calls it.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub(super) fn of_text(
        desk: &dyn Desk,
        (root, file): (&Path, &str),
        language: Language,
        revision: u64,
    ) -> io::Result<Made> {
        let path = root.join(file);
        let mut made = None;
        desk.read(&path, &mut |source, world, options| {
            made = Some(built(source, world, options));
        })?;
        let (read, (houses, pictures), times) = made.ok_or(io::ErrorKind::NotFound)?;
        let keys = keys(&pictures);
        let sources: Vec<Source> = read.sources().cloned().collect();
        let report = Report::new(&sources, &read.diagnostics).in_language(language);
        let diagnostics = raw(&report)?;
        let same = print(|p| {
            houses.known().for_each(|house| house.hash(p));
            houses.places().hash(p);
            keys.hash(p);
            diagnostics.get().hash(p);
            sources.iter().for_each(|s| s.text().hash(p));
        });
        let state = State {
            revision,
            file,
            sources: sources.iter().map(|s| told(s, root)).collect(),
            diagnostics: &diagnostics,
            houses: houses.known().collect(),
            pictures: &keys,
            plan: Plan::of(&read, language),
            times: times.iter().map(|(step, t)| (*step, millis(*t))).collect(),
        };
        Ok(Made {
            revision,
            state: serde_json::to_vec(&state)?,
            model: Content::Houses(houses.into()),
            pictures: pictures.into(),
            sources,
            catalog: read.checked.catalog,
            lacks: false,
            print: same,
        })
    }

    /// A model that was made before and is shown as it is.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub(super) fn of_model(
        (root, file): (&Path, &str),
        language: Language,
        revision: u64,
    ) -> io::Result<Made> {
        let model = Model::read(root, &root.join(file))?;
        let keys = keys(&model.pictures);
        let source = std::slice::from_ref(&model.source);
        let report = Report::new(source, &model.said).in_language(language);
        let diagnostics = raw(&report)?;
        let state = State {
            revision,
            file,
            sources: vec![],
            diagnostics: &diagnostics,
            houses: vec![],
            pictures: &keys,
            plan: Plan {
                reasons: BTreeMap::new(),
                houses: vec![],
            },
            times: vec![],
        };
        Ok(Made {
            revision,
            state: serde_json::to_vec(&state)?,
            print: print(|p| {
                model.bytes.hash(p);
                keys.hash(p);
                diagnostics.get().hash(p);
            }),
            model: Content::File(model.bytes),
            pictures: model.pictures.into(),
            sources: vec![],
            catalog: Cow::Borrowed(parse::builtin()),
            lacks: !model.said.is_empty(),
        })
    }

    /// The whole model, `.glb`.
    pub(super) fn whole(&self) -> Vec<u8> {
        match &self.model {
            Content::Houses(houses) => houses.whole(),
            Content::File(bytes) => bytes.clone(),
        }
    }

    /// What somebody lacks who has these houses of a model, as [`Houses::others`]; `None` = the whole.
    pub(super) fn others(&self, had: &[String]) -> Option<Vec<u8>> {
        match &self.model {
            Content::Houses(houses) => houses.others(had),
            Content::File(_) => None,
        }
    }

    /// Whether the page would show the same.
    pub(super) fn same(&self, other: &Made) -> bool {
        self.print == other.print
    }
}

/// What is the same for the same picture, by the names of pictures.
fn keys(pictures: &BTreeMap<String, Vec<u8>>) -> BTreeMap<String, String> {
    let key = |bytes: &Vec<u8>| format!("{:016x}", print(|p| bytes.hash(p)));
    let keys = pictures.iter().map(|(name, b)| (name.clone(), key(b)));
    keys.collect()
}

type Times = Vec<(&'static str, Duration)>;
type Built = (Houses, BTreeMap<String, Vec<u8>>);

/// Runs the chain; the houses and the pictures beside them by their names.
fn built(source: Source, world: &dyn World, options: &Options) -> (Analysis, Built, Times) {
    let mut times = vec![];
    let read = driver::timed(&mut times, "read", || Analysis::new(source, world, options));
    let building = &read.checked.building;
    let scene = driver::timed(&mut times, "shape", || {
        driver::scene(building, &read.checked.catalog, options.detail)
    });
    let built = driver::timed(&mut times, "pictures", || {
        // What is wrong with pictures was said by the reading.
        let (mut said, limits) = (Diagnostics::new(), &options.expand.limits);
        let paths = &scene.pictures;
        let mut library = driver::pictures(paths, building, world, limits, &mut said);
        library.bake(&scene.baked);
        Houses::new(scene, library)
    });
    (read, built, times)
}

/// What is said of a text, as `hsd check --format json` writes it.
fn raw(report: &Report<'_>) -> io::Result<Box<RawValue>> {
    let mut json = vec![];
    report.write(Format::Json, Style::default(), &mut json)?;
    let json = String::from_utf8(json).map_err(io::Error::other)?;
    Ok(RawValue::from_string(json.trim().to_owned())?)
}

fn told<'a>(source: &'a Source, root: &Path) -> Told<'a> {
    let path = Path::new(source.name()).canonicalize().ok();
    let below = path.and_then(|p| p.strip_prefix(root).ok().map(slashed));
    let text = source.text();
    let mark = source.span(0..0).start;
    let plain = source.span(0..text.len()).end - mark == text.len() as u32;
    Told {
        id: source.id().0,
        name: source.name(),
        path: below,
        text,
        mark,
        widths: (!plain || source.encoding() != "UTF-8").then(|| widths(source)),
    }
}

/// The bytes of each UTF-16 unit; the second unit of a pair takes none.
fn widths(source: &Source) -> String {
    let characters = source.text().char_indices();
    let digits = characters.flat_map(|(at, c)| {
        let Span { start, end, .. } = source.span(at..at + c.len_utf8());
        let first = char::from_digit((end - start).min(9), 10).unwrap_or('0');
        [first, '0'].into_iter().take(c.len_utf16())
    });
    digits.collect()
}

/// A path as the page writes it.
pub(super) fn slashed(path: &Path) -> String {
    let parts = path.components().map(|c| c.as_os_str().to_string_lossy());
    parts.collect::<Vec<_>>().join("/")
}

fn millis(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}

/// What is the same for the same content.
pub(super) fn print(content: impl FnOnce(&mut DefaultHasher)) -> u64 {
    let mut hasher = DefaultHasher::new();
    content(&mut hasher);
    hasher.finish()
}
