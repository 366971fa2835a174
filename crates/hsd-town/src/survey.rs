//! `hsd town init`: looks at maps, finds what their layers are, and writes a first town.
//!
//! | step | file |
//! |---|---|
//! | a map is read once: geometry, fields, values | this one |
//! | points that are the vertices of outlines are known by their fields | `vertices` |
//! | files of one kind beside each other become one layer | `sheets` |
//! | fields get a meaning by their names and values | `fields` |
//! | the town is written | `text` |
//!
//! What a layer is follows from its geometry, then from fields that only such layers have, then from the name of its file,
//! and at last from the size of its outlines. Nothing is certain; the town says what was found and how to change it.

mod fields;
mod sheets;
mod text;
mod vertices;

pub use sheets::{is_map, joined, standing};
pub use text::town;

use crate::layer::measured;
use fields::Fields;
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, bounds};
use hsd_base::source::World;
use hsd_map::Kind as Wrong;
use hsd_map::{Crs, Fault, Faults, Geometry, Options, Outside, Projection, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};
use std::sync::Arc;

/// Different values of a field that are remembered.
const MOST_VALUES: usize = 200;
/// Outlines of which half are larger are blocks of a town, square metres.
const BLOCK: f64 = 1_500.0;

/// What the features of a layer are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Outlines of buildings.
    Houses,
    /// Plots of land.
    Lots,
    /// Streets: lines, or areas of roads.
    Roads,
    /// Areas between streets.
    Blocks,
    /// Trees.
    Trees,
    /// Other areas: water, uses of land.
    Areas,
    /// Other lines: walls, hedges, water.
    Lines,
    /// Places.
    Places,
    /// A grid of heights.
    Heights,
}

/// A layer of a map.
#[derive(Debug)]
pub struct Surveyed {
    /// The path of its file from the town, or what the town says of several.
    pub src: String,
    /// Its files: the path from the town of each, what is wrong with it, and the box of its features.
    pub files: Vec<Sheet>,
    /// The theme or layer in the file, if it has several.
    pub layer: Option<&'static str>,
    /// What it is.
    pub kind: Kind,
    /// The number of its features.
    pub features: usize,
    /// What its coordinates are.
    pub plane: Plane,
    /// True if its files say nothing of that.
    pub is_silent: bool,
    /// True if its features are so small that they can only be in degrees.
    pub is_tiny: bool,
    /// The fields of a table of vertices: the id of the house, and the number of the vertex.
    pub vertices: Option<(String, String)>,
    /// The encoding that the town must name.
    pub encoding: Option<&'static str>,
    /// Its fields.
    pub(in crate::survey) fields: Fields,
}

/// A file of a layer.
#[derive(Debug)]
pub struct Sheet {
    /// Its path from the town.
    pub src: String,
    /// What is wrong with it.
    pub faults: Faults,
    /// The box of its features.
    pub(in crate::survey) bounds: Option<Bounds>,
}

/// What the coordinates of a layer are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Plane {
    /// As the file says: the name of the system.
    Said(Box<str>),
    /// Metres of a survey of its own, as the file says; another file of this kind has other ones.
    OwnSurvey,
    /// The file says nothing, and they can be degrees.
    Degrees,
    /// The file says nothing, and they can only be metres.
    Metres,
}

impl Plane {
    /// Returns true if the layer lies somewhere on the earth.
    pub fn is_placed(&self) -> bool {
        matches!(self, Plane::Said(_) | Plane::Degrees)
    }
}

/// A column of a layer and its values.
#[derive(Debug, Default)]
pub(in crate::survey) struct Seen {
    /// The features that have a value.
    pub(in crate::survey) filled: usize,
    /// Those of which it is a number.
    pub(in crate::survey) numbers: usize,
    /// Those of which it is a number, or begins with one: `12 m`.
    pub(in crate::survey) measures: usize,
    /// The values and how often they occur, up to [`MOST_VALUES`] of them.
    pub(in crate::survey) values: BTreeMap<String, usize>,
    /// True while no value occurred twice.
    pub(in crate::survey) is_unique: bool,
    all: BTreeSet<u64>,
}

impl Seen {
    fn add(&mut self, value: &Value) {
        let Some(text) = word(value) else {
            return;
        };
        if self.filled == 0 {
            self.is_unique = true;
        }
        self.filled += 1;
        self.numbers += usize::from(value.number().is_some());
        let is_measure = value.number().is_some() || measured(&text).is_some();
        self.measures += usize::from(is_measure);
        self.is_unique &= self
            .all
            .insert(BuildHasherDefault::<DefaultHasher>::default().hash_one(&text));
        let known = self.values.len() < MOST_VALUES || self.values.contains_key(&text);
        if known {
            *self.values.entry(text).or_default() += 1;
        }
    }
}

/// Returns a value as a word, if it is any.
fn word(value: &Value) -> Option<String> {
    let text = match value {
        Value::Null => return None,
        Value::Bool(truth) => if *truth { "yes" } else { "no" }.to_owned(),
        Value::Integer(n) => n.to_string(),
        Value::Number(n) => n.to_string(),
        Value::Text(text) => text.trim().to_owned(),
    };
    (!text.is_empty()).then_some(text)
}

impl Seen {
    /// Adds what was seen of the column in another file.
    pub(in crate::survey) fn append(&mut self, other: Seen) {
        self.is_unique = match (self.filled, other.filled) {
            (0, _) => other.is_unique,
            (_, 0) => self.is_unique,
            _ => self.is_unique && other.is_unique && self.all.is_disjoint(&other.all),
        };
        self.filled += other.filled;
        self.numbers += other.numbers;
        self.measures += other.measures;
        self.all.extend(other.all);
        for (value, count) in other.values {
            if self.values.len() < MOST_VALUES || self.values.contains_key(&value) {
                *self.values.entry(value).or_default() += count;
            }
        }
    }
}

/// What was read of a layer.
#[derive(Default)]
struct Read {
    /// Records of the file; several are one feature in a table of vertices.
    records: usize,
    features: usize,
    points: usize,
    lines: usize,
    sizes: Vec<f64>,
    widths: hsd_map::Widths,
    bounds: Option<Bounds>,
    /// Records that cannot lie in degrees.
    beyond: usize,
    seen: Vec<Seen>,
    crs: Option<Crs>,
    /// True if the file says nothing of its coordinates.
    is_silent: bool,
    columns: Vec<String>,
    /// The fields of a table of vertices, whose features are the outlines that they draw.
    vertices: Option<(String, String)>,
    faults: Faults,
}

/// Surveys a map: a path that the world has found, and how the town will name it. Data of OpenStreetMap have several
/// layers.
///
/// # Errors
/// If it cannot be read at all, or has no features.
pub fn survey(world: &dyn World, path: &str, src: &str) -> Result<Vec<Surveyed>, Fault> {
    const THEMES: [&str; 4] = ["building", "highway", "natural", "barrier"];
    let name = src.to_lowercase();
    if hsd_map::heights::is_grid(world, path) {
        return Ok(vec![survey_grid(world, path, src)?]);
    }
    let is_osm = [".osm", ".pbf", ".osm.gz", ".osm.bz2"]
        .iter()
        .any(|end| name.ends_with(end));
    if !is_osm {
        return Ok(vec![survey_layer(world, path, src, None)?]);
    }
    let mut found = vec![];
    for theme in THEMES {
        let layer = survey_layer(world, path, src, Some(theme))?;
        if layer.features > 0 {
            found.push(layer);
        }
    }
    match found.is_empty() {
        true => Err(Fault::of_file(&path.into(), Wrong::NoFeatures)),
        false => Ok(found),
    }
}

/// Looks at the head of a grid of heights.
fn survey_grid(world: &dyn World, path: &str, src: &str) -> Result<Surveyed, Fault> {
    let (mut remarks, mut faults) = (vec![], Faults::default());
    let corner = DVec2::ZERO;
    let nothing = |_: &Crs| Some([corner; 2]);
    let options = Options::default();
    let heights = hsd_map::heights::read(world, path, &options, &nothing, &mut remarks)?;
    remarks.into_iter().for_each(|fault| faults.push(fault));
    Ok(Surveyed {
        kind: Kind::Heights,
        src: src.to_owned(),
        files: vec![Sheet {
            src: src.to_owned(),
            faults,
            bounds: None,
        }],
        layer: None,
        features: 0,
        plane: match heights.crs {
            Some(crs) => Plane::Said(crs.name),
            None => Plane::Metres,
        },
        is_silent: false,
        is_tiny: false,
        vertices: None,
        encoding: None,
        fields: Fields::new(&[], vec![], 0),
    })
}

fn survey_layer(
    world: &dyn World,
    path: &str,
    src: &str,
    layer: Option<&'static str>,
) -> Result<Surveyed, Fault> {
    let mut options = Options {
        layer: layer.map(Into::into),
        ..Options::default()
    };
    let mut found = read(world, path, &options)?;
    let is_metres = found.is_silent && found.are_metres();
    let unknown = |fault: &Fault| matches!(fault.kind, Wrong::UnknownCrs { .. });
    let faults = found.faults.iter().map(|(fault, _)| fault.clone());
    if let Some(fault) = faults.filter(|_| is_metres).find(unknown) {
        return Err(fault);
    }
    if is_metres && found.crs.is_some() {
        // Features that are no degrees were refused.
        options.crs = Some(Crs::local());
        found = read(world, path, &options)?;
    }
    let mut read = found;
    // Sizes in degrees become square metres of the latitude of Japan, which is near enough to tell houses from blocks.
    let is_degrees = !is_metres && read.crs.as_ref().is_none_or(Crs::is_degrees);
    if is_degrees && let Some([_, high]) = read.bounds {
        let metres = 111_320.0 * 111_320.0 * libm::cos(high.y.to_radians());
        read.sizes.iter_mut().for_each(|size| *size *= metres);
    }
    let fields = Fields::new(&read.columns, read.seen, read.records);
    let stem = src.rsplit(['/', '\\']).next().unwrap_or(src).to_lowercase();
    let geometry = (read.points, read.lines);
    Ok(Surveyed {
        kind: kind(&stem, layer, &fields, geometry, read.sizes),
        src: src.to_owned(),
        files: vec![Sheet {
            src: src.to_owned(),
            faults: read.faults,
            bounds: read.bounds,
        }],
        layer,
        features: read.features,
        plane: match read.crs {
            _ if is_metres => Plane::Metres,
            Some(crs) if crs.projection == Projection::Local => Plane::OwnSurvey,
            Some(crs) => Plane::Said(crs.name),
            None => Plane::Degrees,
        },
        is_silent: read.is_silent || is_metres,
        is_tiny: read.widths.are_degrees(),
        vertices: read.vertices,
        encoding: None,
        fields,
    })
}

impl Surveyed {
    /// Returns what is wrong with a map that has no features, though nothing in it was lost: other layers would be wanted. One
    /// of the sheets of a map may be empty.
    pub fn no_features(&self) -> Option<Fault> {
        let is_sound = |sheet: &Sheet| sheet.faults.iter().next().is_none();
        let is_empty = self.kind != Kind::Heights && self.features == 0;
        let file: Arc<str> = self.src.as_str().into();
        (is_empty && self.files.iter().all(is_sound))
            .then(|| Fault::of_file(&file, Wrong::NoFeatures))
    }
}

impl Read {
    /// Adds a feature.
    fn add(&mut self, geometry: &Geometry) {
        self.features += 1;
        match geometry {
            Geometry::Points(_) => self.points += 1,
            Geometry::Lines(_) => self.lines += 1,
            Geometry::Areas(areas) => {
                let size = areas.iter().map(|a| a.outline.signed_area().abs() / 2.0);
                self.sizes.push(size.fold(0.0, f64::max));
            }
        }
        self.widths.add(geometry.width());
    }

    /// Takes the outlines that its points draw for its features.
    fn draw(&mut self, found: vertices::Vertices) {
        (self.features, self.points) = (0, 0);
        found.outlines.iter().for_each(|outline| self.add(outline));
        self.vertices = Some((found.outline, found.order));
    }

    /// Returns true if coordinates of which the file says nothing are no degrees.
    fn are_metres(&self) -> bool {
        let is_metres = |seems: &Outside| matches!(seems, Outside::Metres | Outside::Far);
        let is_refused = |fault: &Fault| matches!(&fault.kind, Wrong::OutsideCrs { seems, .. } if is_metres(seems));
        let refused = self.faults.iter().filter(|(fault, _)| is_refused(fault));
        let refused: usize = refused.map(|(_, count)| count).sum();
        // A few wrong places do not make metres of degrees.
        let beyond = refused + self.beyond;
        2 * beyond > refused + self.records || self.widths.are_metres()
    }
}

/// Reads all features of a layer.
fn read(world: &dyn World, path: &str, options: &Options) -> Result<Read, Fault> {
    let mut reader = hsd_map::open(world, path, options)?;
    let mut read = Read::default();
    while let Some(next) = reader.next() {
        reader
            .remarks()
            .into_iter()
            .for_each(|f| read.faults.push(f));
        let feature = match next {
            Ok(feature) => feature,
            Err(fault) if fault.is_exhausted_file() => return Err(fault),
            Err(fault) => {
                read.faults.push(fault);
                continue;
            }
        };
        read.records += 1;
        read.add(&feature.geometry);
        let own = bounds(feature.geometry.points());
        let degrees = Crs::wgs84();
        let is_beyond = |p: &DVec2| degrees.refuses(*p).is_some();
        read.beyond += usize::from(own.is_some_and(|b| b.iter().any(is_beyond)));
        read.bounds = match (read.bounds, own) {
            (Some([a, b]), Some([c, d])) => Some([a.min(c), b.max(d)]),
            (known, own) => known.or(own),
        };
        for (column, value) in &feature.fields {
            if read.seen.len() <= *column {
                read.seen.resize_with(column + 1, Seen::default);
            }
            read.seen[*column].add(value);
        }
    }
    reader
        .remarks()
        .into_iter()
        .for_each(|f| read.faults.push(f));
    let known = reader.layer();
    read.is_silent = known.crs_is_usual || known.crs.is_none();
    read.crs = known.crs.clone();
    let columns = known.columns.list().iter();
    read.columns = columns.map(|c| c.name.to_string()).collect();
    read.seen.resize_with(read.columns.len(), Seen::default);
    if let Some(found) = vertices::find(world, path, options, &read) {
        read.draw(found);
    }
    Ok(read)
}

/// Decides what a layer is.
fn kind(
    stem: &str,
    theme: Option<&str>,
    fields: &Fields,
    (points, lines): (usize, usize),
    mut sizes: Vec<f64>,
) -> Kind {
    let named = |words: &[&str]| words.iter().any(|word| stem.contains(word));
    let roads = ["road", "street", "highway", "tran", "道", "通"];
    if points >= lines && points > sizes.len() {
        let trees = fields.says("natural", "tree") || named(&["tree", "樹", "木"]);
        return if trees { Kind::Trees } else { Kind::Places };
    }
    if lines > sizes.len() {
        let is_road = theme == Some("highway") || fields.has(fields::ROADS) || named(&roads);
        let is_water = named(&["water", "river", "coast", "水", "川"]);
        return match is_road && !is_water {
            true => Kind::Roads,
            false => Kind::Lines,
        };
    }
    let is_water = named(&["water", "river", "landuse", "land_use", "水", "用途地域"]);
    if theme == Some("building") || fields.has(fields::BUILDINGS) {
        return Kind::Houses;
    }
    if fields.has(fields::LOTS) || named(&["fude", "lot", "parcel", "筆", "地番"]) {
        return Kind::Lots;
    }
    if is_water || matches!(theme, Some("natural" | "barrier")) {
        return Kind::Areas;
    }
    if named(&["build", "house", "bldg", "tatemono", "建物", "家屋"]) {
        return Kind::Houses;
    }
    if fields.has(fields::BLOCKS) || named(&["block", "街区", "町割"]) {
        return Kind::Blocks;
    }
    if fields.has(fields::ROADS) || named(&roads) {
        return Kind::Roads;
    }
    sizes.sort_by(f64::total_cmp);
    match sizes.get(sizes.len() / 2) {
        Some(half) if *half > BLOCK => Kind::Areas,
        _ => Kind::Houses,
    }
}
