//! The compiled state of a file: its state in the API, its model and external textures.

pub(super) mod parameters;

use super::editor_host::EditorHost;
use super::fingerprint::fingerprint;
use super::houses::Houses;
use super::model_file::ModelFile;
use super::scan::Scan;
use super::town::{BuiltTown, ShownTown};
use hsd_base::diagnostic::messages::limits::too_many_triangles;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::{Source, Span, World};
use hsd_driver::Options;
use hsd_ide::Analysis;
use hsd_ide::plan::Plan;
use hsd_ir::catalog::Catalog;
use hsd_report::{Format, Report, Style};
use hsd_syntax::parse;
use parameters::ShownParameter;
use serde::Serialize;
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::hash::Hash;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// The compiled state of a file at one revision.
pub(super) struct Snapshot {
    /// Incremented with every change of any file.
    pub(super) revision: u64,
    /// The state in the API, as JSON.
    pub(super) state: Vec<u8>,
    /// Serialized on request.
    model: Content,
    /// External textures by their names in the model.
    pub(super) pictures: Arc<BTreeMap<String, Vec<u8>>>,
    /// The source file and the files it includes.
    pub(super) sources: Vec<Source>,
    /// The parts available to its houses.
    pub(super) catalog: Cow<'static, Catalog>,
    /// The names of its parameters.
    pub(super) parameters: BTreeSet<String>,
    /// True if it is a town, which is built in tiles.
    pub(super) is_town: bool,
    /// True if an external texture is missing.
    pub(super) lacks: bool,
    /// The fingerprint of the content.
    fingerprint: u64,
}

/// Returns the options with which a document is read.
pub(super) type ReadAs<'r> = dyn Fn(&Options) -> Options + 'r;

/// The origin of a model.
enum Content {
    /// Compiled from a source file.
    Houses(Box<Houses>),
    /// An existing model: the contents of a `.glb`.
    File(Vec<u8>),
}

/// The state of a file: `State` in `view/src/server/api.ts`.
#[derive(Serialize)]
struct State<'a> {
    revision: u64,
    file: &'a str,
    sources: Vec<SourceState<'a>>,
    diagnostics: &'a RawValue,
    /// Keys and names of the houses, in the order of the model.
    houses: Vec<(&'a str, &'a str)>,
    pictures: &'a BTreeMap<String, String>,
    plan: Plan,
    town: Option<ShownTown>,
    parameters: Vec<ShownParameter>,
    scan: Option<&'a Scan>,
    times: Vec<(&'static str, f64)>,
}

/// A source file: `Source` of the state.
#[derive(Serialize)]
struct SourceState<'a> {
    id: u32,
    name: &'a str,
    /// The path relative to the root, with `/`.
    path: Option<String>,
    text: &'a str,
    /// The number of bytes before the text: those of a byte order mark.
    mark: u32,
    /// The number of bytes of each UTF-16 unit in the file, one digit per unit; `null` for UTF-8.
    widths: Option<String>,
}

impl Snapshot {
    /// Reads and compiles a source file; `file` is its path relative to `root`, as in the API. A town is shown as it was
    /// built last, under the number `id`.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub(super) fn of_text(
        (host, read_as): (&dyn EditorHost, &ReadAs<'_>),
        (root, file): (&Path, &str),
        (language, revision): (Language, u64),
        (id, built_town): (u64, Option<Arc<BuiltTown>>),
    ) -> io::Result<Snapshot> {
        let path = root.join(file);
        let (mut read, (houses, pictures), times) = compiled(host, read_as, &path)?;
        let town = read.checked.is_town.then(|| match &built_town {
            Some(built) => built.shown.clone(),
            None => ShownTown::none(id),
        });
        let found = built_town.and_then(|built| built.found(&read.source));
        if let Some((included, found)) = found.filter(|_| town.is_some()) {
            read.add_town(Arc::default(), included, found);
        }
        let keys = keys(&pictures);
        let parameters = parameters::shown(&read.checked.parameters, language);
        let sources: Vec<Source> = read.sources().cloned().collect();
        let report = Report::new(&sources, &read.diagnostics).in_language(language);
        let diagnostics = raw(&report)?;
        let scan = Scan::beside(&path, language);
        let scanned = serde_json::to_vec(&scan)?;
        let same = fingerprint(|p| {
            houses.known().for_each(|house| house.hash(p));
            houses.places().hash(p);
            keys.hash(p);
            town.hash(p);
            parameters.hash(p);
            scanned.hash(p);
            diagnostics.get().hash(p);
            sources.iter().for_each(|s| s.text().hash(p));
        });
        let state = State {
            revision,
            file,
            sources: sources.iter().map(|s| source_state(s, root)).collect(),
            diagnostics: &diagnostics,
            houses: houses.known().collect(),
            pictures: &keys,
            plan: Plan::of(&read, language),
            town: town.clone(),
            parameters,
            scan: scan.as_ref(),
            times: times.iter().map(|(step, t)| (*step, millis(*t))).collect(),
        };
        Ok(Snapshot {
            revision,
            state: serde_json::to_vec(&state)?,
            model: Content::Houses(houses.into()),
            pictures: pictures.into(),
            sources,
            catalog: read.checked.catalog,
            parameters: parameters::names(&read.checked.parameters),
            is_town: town.is_some(),
            lacks: false,
            fingerprint: same,
        })
    }

    /// Shows a town in tiles that exists already.
    ///
    /// # Errors
    /// If its state cannot be written.
    pub(super) fn of_tiles(file: &str, built: &BuiltTown, revision: u64) -> io::Result<Snapshot> {
        let (pictures, none) = (BTreeMap::new(), RawValue::from_string("[]".to_owned())?);
        let state = State {
            revision,
            file,
            sources: vec![],
            diagnostics: &none,
            houses: vec![],
            pictures: &pictures,
            plan: Plan::default(),
            town: Some(built.shown.clone()),
            parameters: vec![],
            scan: None,
            times: vec![],
        };
        let changed = built.changed();
        Ok(Snapshot {
            revision,
            state: serde_json::to_vec(&state)?,
            model: Content::File(vec![]),
            pictures: Arc::default(),
            sources: vec![],
            catalog: Cow::Borrowed(parse::builtin()),
            parameters: BTreeSet::new(),
            is_town: false, // Nothing is to be built.
            lacks: false,
            fingerprint: fingerprint(|p| (&built.shown, changed).hash(p)),
        })
    }

    /// Reads an existing model.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub(super) fn of_model(
        (root, file): (&Path, &str),
        language: Language,
        revision: u64,
    ) -> io::Result<Snapshot> {
        let model = ModelFile::read(root, &root.join(file))?;
        let keys = keys(&model.pictures);
        let source = std::slice::from_ref(&model.source);
        let report = Report::new(source, &model.diagnostics).in_language(language);
        let diagnostics = raw(&report)?;
        let state = State {
            revision,
            file,
            sources: vec![],
            diagnostics: &diagnostics,
            houses: vec![],
            pictures: &keys,
            plan: Plan::default(),
            town: None,
            parameters: vec![],
            scan: None,
            times: vec![],
        };
        Ok(Snapshot {
            revision,
            state: serde_json::to_vec(&state)?,
            fingerprint: fingerprint(|p| {
                model.bytes.hash(p);
                keys.hash(p);
                diagnostics.get().hash(p);
            }),
            model: Content::File(model.bytes),
            pictures: model.pictures.into(),
            sources: vec![],
            catalog: Cow::Borrowed(parse::builtin()),
            parameters: BTreeSet::new(),
            is_town: false,
            lacks: !model.diagnostics.is_empty(),
        })
    }

    /// Returns the whole model as a `.glb`.
    pub(super) fn whole(&self) -> Vec<u8> {
        match &self.model {
            Content::Houses(houses) => houses.whole(),
            Content::File(bytes) => bytes.clone(),
        }
    }

    /// Returns the houses whose keys are not in `had`, as [`Houses::others`]; `None` for the whole model.
    pub(super) fn others(&self, had: &[String]) -> Option<Vec<u8>> {
        match &self.model {
            Content::Houses(houses) => houses.others(had),
            Content::File(_) => None,
        }
    }

    /// Returns whether the page would look the same.
    pub(super) fn same(&self, other: &Snapshot) -> bool {
        self.fingerprint == other.fingerprint
    }
}

/// Returns the fingerprints of textures by name.
fn keys(pictures: &BTreeMap<String, Vec<u8>>) -> BTreeMap<String, String> {
    let key = |bytes: &Vec<u8>| format!("{:016x}", fingerprint(|p| bytes.hash(p)));
    let keys = pictures.iter().map(|(name, b)| (name.clone(), key(b)));
    keys.collect()
}

type Times = Vec<(&'static str, Duration)>;
type Built = (Houses, BTreeMap<String, Vec<u8>>);

/// Reads and compiles a source file.
fn compiled(
    host: &dyn EditorHost,
    read_as: &ReadAs<'_>,
    path: &Path,
) -> io::Result<(Analysis, Built, Times)> {
    let mut compiled = None;
    host.read(path, &mut |source, world, options| {
        compiled = Some(built(source, world, &read_as(options)));
    })?;
    Ok(compiled.ok_or(io::ErrorKind::NotFound)?)
}

/// Compiles a source file to houses and their external textures by name.
fn built(source: Source, world: &dyn World, options: &Options) -> (Analysis, Built, Times) {
    let mut times = vec![];
    let mut read = hsd_driver::timed(&mut times, "read", || Analysis::new(source, world, options));
    let building = &read.checked.building;
    let mut scene = hsd_driver::timed(&mut times, "shape", || {
        hsd_driver::scene(building, &read.checked.catalog, options.shapes())
    });
    let oversized = std::mem::take(&mut scene.oversized);
    let built = hsd_driver::timed(&mut times, "pictures", || {
        // The analysis has reported faulty images already.
        let (mut ignored, limits) = (Diagnostics::new(), &options.expand.limits);
        let paths = &scene.pictures;
        let mut library = hsd_driver::pictures(paths, building, world, limits, &mut ignored);
        library.bake(&scene.baked);
        Houses::new(scene, library)
    });
    let limit = options.expand.limits.triangles;
    let oversized = oversized.into_iter();
    read.add(oversized.map(|place| too_many_triangles(place, limit)));
    (read, built, times)
}

/// Returns diagnostics in the format of `hsd check --format json`.
fn raw(report: &Report<'_>) -> io::Result<Box<RawValue>> {
    let mut json = vec![];
    report.write(Format::Json, Style::default(), &mut json)?;
    let json = String::from_utf8(json).map_err(io::Error::other)?;
    Ok(RawValue::from_string(json.trim().to_owned())?)
}

fn source_state<'a>(source: &'a Source, root: &Path) -> SourceState<'a> {
    let path = Path::new(source.name()).canonicalize().ok();
    let below = path.and_then(|p| p.strip_prefix(root).ok().map(slashed));
    let text = source.text();
    let mark = source.span(0..0).start;
    let plain = source.span(0..text.len()).end - mark == text.len() as u32;
    SourceState {
        id: source.id().0,
        name: source.name(),
        path: below,
        text,
        mark,
        widths: (!plain || source.encoding() != "UTF-8").then(|| widths(source)),
    }
}

/// Returns the number of bytes of each UTF-16 unit; 0 for the second unit of a surrogate pair.
fn widths(source: &Source) -> String {
    let characters = source.text().char_indices();
    let digits = characters.flat_map(|(at, c)| {
        let Span { start, end, .. } = source.span(at..at + c.len_utf8());
        let first = char::from_digit((end - start).min(9), 10).unwrap_or('0');
        [first, '0'].into_iter().take(c.len_utf16())
    });
    digits.collect()
}

/// Returns a path with `/` as the separator.
pub(super) fn slashed(path: &Path) -> String {
    let parts = path.components().map(|c| c.as_os_str().to_string_lossy());
    parts.collect::<Vec<_>>().join("/")
}

fn millis(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}
