//! Files of one kind beside each other become one layer: the sheets of a map, or the squares of a mesh.

use super::{Kind, Plane, Sheet, Surveyed};
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, meet};

/// Endings of the maps that are read where a folder is named.
const MAPS: [&str; 15] = [
    "geojson", "geojsonl", "shp", "fgb", "gpkg", "parquet", "osm", "pbf", "xml", "gml", "tif",
    "tiff", "asc", "gz", "bz2",
];
/// Files of one layer from which on the town names them by a pattern.
const MANY: usize = 4;

/// Returns true if the name of a file is that of a map.
pub fn is_map(name: &str) -> bool {
    MAPS.iter()
        .any(|ending| hsd_map::has_extension(name, ending))
}

/// Joins layers of one kind whose files lie beside each other, and settles what coordinates are of which the files say
/// nothing. `names` lists the files of a folder.
pub fn joined(layers: Vec<Surveyed>, names: &dyn Fn(&str) -> Vec<String>) -> Vec<Surveyed> {
    let mut all: Vec<Surveyed> = vec![];
    for layer in layers {
        match all.iter_mut().find(|known| is_sheet(known, &layer)) {
            Some(known) => known.append(layer),
            None => all.push(layer),
        }
    }
    for layer in &mut all {
        if layer.files.len() > 1 {
            layer.src = src_of(&layer.files, names);
        }
    }
    settle(&mut all);
    all
}

impl Surveyed {
    /// Returns the boxes of its files.
    fn boxes(&self) -> impl Iterator<Item = Bounds> {
        self.files.iter().filter_map(|file| file.bounds)
    }

    fn append(&mut self, other: Surveyed) {
        if self.features == 0 {
            (self.kind, self.plane, self.is_silent) = (other.kind, other.plane, other.is_silent);
        }
        self.features += other.features;
        self.files.extend(other.files);
        self.fields.append(other.fields);
    }
}

/// Returns true if a layer is another sheet of a known one.
fn is_sheet(known: &Surveyed, other: &Surveyed) -> bool {
    let is_listed = |layer: &Surveyed| !layer.files[0].src.contains([',', '*', '?']);
    let beside = place(&known.files[0].src) == place(&other.files[0].src);
    if !beside || known.layer != other.layer || !is_listed(known) || !is_listed(other) {
        return false;
    }
    let is_empty = |layer: &Surveyed| layer.features == 0 && layer.kind != Kind::Heights;
    if is_empty(known) || is_empty(other) {
        return true;
    }
    let are_alike =
        known.kind == other.kind && known.plane == other.plane && known.vertices == other.vertices;
    // Two surveys of their own have nothing in common, whatever their numbers are.
    are_alike && known.plane != Plane::OwnSurvey && !known.files.iter().any(|f| covers(f, other))
}

/// Returns the folder of a file and its ending.
fn place(src: &str) -> (&str, String) {
    let (folder, name) = split(src);
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    (folder, ending.to_lowercase())
}

/// Returns the folder of a file with its slash, and its name.
fn split(src: &str) -> (&str, &str) {
    src.split_at(src.rfind('/').map_or(0, |slash| slash + 1))
}

/// Returns true if a layer lies where a sheet does, as another theme or another year of the same place: by half at least.
fn covers(sheet: &Sheet, other: &Surveyed) -> bool {
    let Some(own) = sheet.bounds else {
        return false;
    };
    let size = |[low, high]: Bounds| {
        let side = (high - low).max(glam::DVec2::ZERO);
        side.x * side.y
    };
    let mut shared = other.boxes().map(|b| {
        let smaller = size(own).min(size(b));
        let common = size([own[0].max(b[0]), own[1].min(b[1])]);
        smaller > 0.0 && common > smaller / 2.0
    });
    shared.any(|is_shared| is_shared)
}

/// Returns what a town says of several files: a pattern where it names just these, else all of them.
fn src_of(files: &[Sheet], names: &dyn Fn(&str) -> Vec<String>) -> String {
    let mut srcs: Vec<&str> = files.iter().map(|file| &*file.src).collect();
    let (folder, first) = split(srcs[0]);
    let ending = first.rsplit_once('.').map_or("", |(_, ending)| ending);
    let tail = format!(".{ending}");
    let own: Vec<&str> = srcs.iter().map(|src| split(src).1).collect();
    let there = names(folder);
    let lead = common(&own);
    for lead in ["", lead] {
        let fits = there
            .iter()
            .filter(|name| name.starts_with(lead) && name.ends_with(&tail));
        if own.len() >= MANY && fits.count() == own.len() && own.iter().all(|n| n.ends_with(&tail))
        {
            return format!("{folder}{lead}*{tail}");
        }
    }
    srcs.dedup();
    srcs.join(", ")
}

/// Returns what all names begin with.
fn common<'n>(names: &[&'n str]) -> &'n str {
    let first = names[0];
    let is_shared = |end: &usize| {
        let lead = first.get(..*end);
        lead.is_some_and(|lead| names.iter().all(|name| name.starts_with(lead)))
    };
    let end = (0..=first.len()).rev().find(is_shared);
    &first[..end.unwrap_or(0)]
}

/// Settles the unit of files that do not name one. Those among features that can only be in degrees are in degrees, and those
/// among features that can only be in metres are in metres.
fn settle(layers: &mut [Surveyed]) {
    let boxes = |of: &dyn Fn(&Surveyed) -> bool| -> Vec<Bounds> {
        let layers = layers.iter().filter(|layer| of(layer));
        layers.flat_map(Surveyed::boxes).collect()
    };
    let tiny = boxes(&|layer| layer.plane.is_placed() && layer.is_tiny);
    let metres = boxes(&|layer| layer.plane == Plane::Metres);
    let is_among = |layer: &Surveyed, boxes: &[Bounds]| {
        layer
            .boxes()
            .any(|own| boxes.iter().any(|other| meet(own, *other)))
    };
    let globe = [DVec2::new(-180.0, -90.0), DVec2::new(180.0, 90.0)];
    let is_on_globe = |[low, high]: Bounds| low.cmpge(globe[0]).all() && high.cmple(globe[1]).all();
    for layer in layers.iter_mut().filter(|layer| layer.is_silent) {
        let is_metres = layer.plane == Plane::Metres;
        if is_metres && layer.boxes().all(is_on_globe) && is_among(layer, &tiny) {
            layer.plane = Plane::Degrees;
        } else if !layer.is_tiny && !is_among(layer, &tiny) && is_among(layer, &metres) {
            layer.plane = Plane::Metres;
        }
    }
}

/// Returns for each layer whether it stands in the town: one place on the earth, or one survey of its own, since no two of
/// them have a common frame. The layers with most houses and lots decide.
pub fn standing(layers: &[Surveyed]) -> Vec<bool> {
    // Layers of one frame share a number.
    let frame = |n: usize| match layers[n].plane {
        Plane::Said(_) | Plane::Degrees => 0,
        Plane::Metres => 1,
        Plane::OwnSurvey => n + 2,
    };
    let weight = |of: usize| {
        let own = (0..layers.len()).filter(|n| frame(*n) == of);
        let weigh = |n: usize| match layers[n].kind {
            Kind::Houses => (layers[n].features, layers[n].features),
            Kind::Lots => (0, layers[n].features),
            _ => (0, 0),
        };
        own.map(weigh).fold((0, 0), |(a, b), (c, d)| (a + c, b + d))
    };
    let frames = (0..layers.len()).map(frame);
    let best = frames.reduce(|best, next| match weight(next) > weight(best) {
        true => next,
        false => best,
    });
    (0..layers.len()).map(|n| Some(frame(n)) == best).collect()
}
