//! Tables of vertices (000-25): points of which each names its house, and its place in the outline of that.

use super::{Read, word};
use crate::map::{self, Area, Chain, Geometry, Options, tidied};
use crate::source::World;
use glam::DVec2;
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
/// The share of outlines that must be some, so that one slip in a table does not hide what it is.
const SOUND: f64 = 0.9;

/// The fields of a table of vertices, and what it draws.
pub(super) struct Vertices {
    /// The field with the id of the house.
    pub(super) outline: String,
    /// The field that numbers the vertices.
    pub(super) order: String,
    /// Areas of the outlines, in the square of the unit of the coordinates.
    pub(super) sizes: Vec<f64>,
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
            if let Some(sizes) = drawn(&records, outline, order) {
                let name = |column: usize| read.columns[column].clone();
                return Some(Vertices {
                    outline: name(outline),
                    order: name(order),
                    sizes,
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
    let reader = map::open(world, path, options).ok()?;
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

/// Returns the areas of the outlines that records draw by two fields; `None` if too many are none.
fn drawn(records: &[Record], outline: usize, order: usize) -> Option<Vec<f64>> {
    let mut rings: BTreeMap<&str, Vec<(f64, DVec2)>> = BTreeMap::new();
    for record in records {
        let id = record.words[outline].as_deref()?;
        rings
            .entry(id)
            .or_default()
            .push((record.numbers[order]?, record.place));
    }
    let count = rings.len() as f64;
    let sizes: Vec<f64> = rings.into_values().filter_map(size).collect();
    (!sizes.is_empty() && sizes.len() as f64 >= SOUND * count).then_some(sizes)
}

/// Returns the area of an outline; `None` if its vertices are too few, share a number or cross.
fn size(mut vertices: Vec<(f64, DVec2)>) -> Option<f64> {
    vertices.sort_by(|v, w| v.0.total_cmp(&w.0));
    if vertices.windows(2).any(|two| two[0].0 == two[1].0) {
        return None;
    }
    let mut ring: Vec<DVec2> = vertices.into_iter().map(|(_, place)| place).collect();
    if ring.first() != ring.last() {
        ring.push(*ring.first()?);
    }
    let outline = Chain::flat(ring);
    let area = Area {
        outline,
        holes: vec![],
    };
    let (Geometry::Areas(areas), _) = tidied(Geometry::Areas(vec![area])).ok()? else {
        return None;
    };
    let size = areas.first()?.outline.signed_area().abs() / 2.0;
    (areas.len() == 1 && size > 0.0).then_some(size)
}
