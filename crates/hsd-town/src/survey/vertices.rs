//! Tables of vertices (000-25): points of which each names its house, and its place in the outline of that.

use super::{Read, word};
use glam::DVec2;
use hsd_base::source::World;
use hsd_map::{Area, Chain, Geometry, Options, tidied};
use std::collections::BTreeMap;

/// Names of the field that numbers the vertices of an outline, the likelier first; `vertex_index` is QGIS's.
const ORDERS: &[&str] = &[
    "order",
    "vertex_index",
    "vertex_part_index",
    "vertex",
    "number",
    "seq",
    "sequence",
    "順番",
    "順",
    "順序",
    "頂点番号",
    "点番号",
    "no",
    "NO",
    "No",
];
/// Names of the field that holds the id of the house, the likelier first; any other field may be it too.
const OUTLINES: &[&str] = &[
    "house",
    "house_id",
    "houseid",
    "家屋",
    "家屋番号",
    "家屋ID",
    "建物",
    "建物ID",
    "building",
    "building_id",
    "outline",
    "polygon",
    "id",
    "ID",
    "fid",
];
/// The share of outlines that must be some, so that slips in a table do not hide what it is: by fields of these names, and by
/// any other.
const SOUND: (f64, f64) = (0.5, 0.9);

/// The fields of a table of vertices, and what it draws.
pub(super) struct Vertices {
    /// The field with the id of the house.
    pub(super) outline: String,
    /// The field that numbers the vertices.
    pub(super) order: String,
    /// The outlines, in the unit of the coordinates.
    pub(super) outlines: Vec<Geometry>,
}

/// A record: its place, and its values in some columns as words and as numbers.
struct Record {
    place: DVec2,
    words: Vec<Option<String>>,
    numbers: Vec<Option<f64>>,
}

/// Returns what the points of a layer draw, if they are vertices: a field that many have in common, another one that numbers
/// those, and outlines that do not cross themselves.
pub(super) fn find(
    world: &dyn World,
    path: &str,
    options: &Options,
    read: &Read,
) -> Option<Vertices> {
    let filled = |column: usize| read.seen[column].filled == read.features;
    let named = |name: &&str| read.columns.iter().position(|own| own == name);
    let orders = ORDERS.iter().filter_map(named);
    let orders: Vec<usize> = orders
        .filter(|c| filled(*c) && read.seen[*c].numbers == read.features)
        .collect();
    if orders.is_empty() || read.points < read.features {
        return None;
    }
    let all = OUTLINES
        .iter()
        .filter_map(named)
        .chain(0..read.columns.len());
    let mut outlines: Vec<usize> = vec![];
    for column in all.filter(|c| filled(*c) && !read.seen[*c].is_unique) {
        if !outlines.contains(&column) {
            outlines.push(column);
        }
    }
    let records = records(world, path, options, read.columns.len())?;
    for &order in &orders {
        for &outline in outlines.iter().filter(|outline| **outline != order) {
            let name = |column: usize| read.columns[column].clone();
            let is_named = OUTLINES.contains(&&*name(outline));
            let sound = if is_named { SOUND.0 } else { SOUND.1 };
            if let Some(outlines) = drawn(&records, (outline, order), sound) {
                return Some(Vertices {
                    outline: name(outline),
                    order: name(order),
                    outlines,
                });
            }
        }
    }
    None
}

/// Reads the points of a layer with their values; `None` if one is more than a point.
fn records(
    world: &dyn World,
    path: &str,
    options: &Options,
    columns: usize,
) -> Option<Vec<Record>> {
    let reader = hsd_map::open(world, path, options).ok()?;
    let mut records = vec![];
    for feature in reader.flatten() {
        let mut places = feature.geometry.points();
        let (Some(place), None) = (places.next(), places.next()) else {
            return None;
        };
        let mut record = Record {
            place,
            words: vec![None; columns],
            numbers: vec![None; columns],
        };
        for (column, value) in &feature.fields {
            record.words[*column] = word(value);
            record.numbers[*column] = value.number();
        }
        records.push(record);
    }
    Some(records)
}

/// Returns the outlines that records draw by two fields; `None` if more are none than a share leaves.
fn drawn(
    records: &[Record],
    (outline, order): (usize, usize),
    sound: f64,
) -> Option<Vec<Geometry>> {
    let mut rings: BTreeMap<&str, Vec<(f64, DVec2)>> = BTreeMap::new();
    for record in records {
        let id = record.words[outline].as_deref()?;
        let vertex = (record.numbers[order]?, record.place);
        rings.entry(id).or_default().push(vertex);
    }
    let count = rings.len() as f64;
    let found: Vec<Geometry> = rings.into_values().filter_map(ring).collect();
    (!found.is_empty() && found.len() as f64 >= sound * count).then_some(found)
}

/// Returns the outline of vertices; `None` if they are too few, are not numbered from 0 or 1 on, or cross.
fn ring(mut vertices: Vec<(f64, DVec2)>) -> Option<Geometry> {
    vertices.sort_by(|v, w| v.0.total_cmp(&w.0));
    let first = vertices.first()?.0;
    // Houses numbered along a street, or trees of a kind, are no vertices.
    let counts_on = vertices
        .iter()
        .zip(0..)
        .all(|(v, n)| v.0 == first + f64::from(n));
    if !counts_on || !(first == 0.0 || first == 1.0) {
        return None;
    }
    let mut ring: Vec<DVec2> = vertices.into_iter().map(|(_, place)| place).collect();
    if ring.first() != ring.last() {
        ring.push(*ring.first()?);
    }
    let area = Area {
        outline: Chain::flat(ring),
        holes: vec![],
    };
    let (geometry, _) = tidied(Geometry::Areas(vec![area])).ok()?;
    let is_area = match &geometry {
        Geometry::Areas(areas) => areas.len() == 1 && areas[0].outline.signed_area() != 0.0,
        _ => false,
    };
    is_area.then_some(geometry)
}
