//! The root of 3D Tiles 1.1: `tileset.json`, a tree of boxes with the files in them.
//!
//! Near tiles hang below a box without content, four boxes below a larger one, so that a viewer need not look at each. The
//! levels of a tile hang below one another and replace each other. Boxes lie in the frame of the town, metres east, north and
//! up; the root's transform places it on the globe. Every box contains those below it, and no error is less than those
//! below it.

use crate::scene::Detail;
use glam::DVec3;
use serde_json::{Value, json};

/// A tile.
#[derive(Clone, Debug)]
pub struct TilePlace {
    /// Its levels, from far to near.
    pub levels: Vec<TileLevel>,
}

/// A level of a tile.
#[derive(Clone, Debug)]
pub struct TileLevel {
    /// The level of detail.
    pub detail: Detail,
    /// Its file, relative to the root.
    pub file: String,
    /// The box of its vertices.
    pub bounds: [DVec3; 2],
}

/// The most tiles that hang below one box.
const TOGETHER: usize = 4;

/// Returns the bytes of `tileset.json`. Tiles without levels are left out.
pub fn tileset(tiles: &[TilePlace], transform: Option<[f64; 16]>) -> Vec<u8> {
    let nodes = tiles.iter().filter_map(tile).collect();
    let mut root = grouped(nodes).unwrap_or_else(|| Node {
        bounds: [DVec3::ZERO; 2],
        error: 0.0,
        json: json!({}),
    });
    if let Some(transform) = transform {
        root.json["transform"] = json!(transform);
    }
    root.json["refine"] = json!("REPLACE");
    let error = root.error;
    let json = json!({
        "asset": { "version": "1.1", "generator": concat!("hsd ", env!("CARGO_PKG_VERSION")) },
        "geometricError": error,
        "root": root.written(),
    });
    let mut bytes = serde_json::to_vec(&json).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

/// A box of the tree.
struct Node {
    bounds: [DVec3; 2],
    error: f64,
    json: Value,
}

impl Node {
    fn written(mut self) -> Value {
        self.json["boundingVolume"] = json!({ "box": volume(self.bounds) });
        self.json["geometricError"] = json!(self.error);
        self.json
    }

    fn middle(&self) -> DVec3 {
        self.bounds[0].midpoint(self.bounds[1])
    }
}

/// Returns how far a level may be from the nearest one, metres.
fn error(detail: Detail) -> f64 {
    match detail {
        Detail::Body => 4.0,
        Detail::Flat => 1.0,
        Detail::Openings => 0.25,
        Detail::Everything => 0.0,
    }
}

/// Returns the chain of a tile's levels.
fn tile(place: &TilePlace) -> Option<Node> {
    let mut near: Option<Node> = None;
    for level in place.levels.iter().rev() {
        let mut node = Node {
            bounds: level.bounds,
            error: 0.0,
            json: json!({ "content": { "uri": level.file } }),
        };
        if let Some(child) = near {
            node.bounds = union(node.bounds, child.bounds);
            node.error = error(level.detail).max(child.error);
            node.json["children"] = json!([child.written()]);
        }
        near = Some(node);
    }
    near
}

/// Hangs nodes below boxes until one is left.
fn grouped(mut nodes: Vec<Node>) -> Option<Node> {
    if nodes.len() > TOGETHER {
        let quarters = halves(nodes, |p| p.x).into_iter();
        let quarters = quarters.flat_map(|half| halves(half, |p| p.y));
        nodes = quarters.filter_map(grouped).collect();
    }
    let bounds = nodes.iter().map(|n| n.bounds).reduce(union)?;
    let errors = nodes.iter().map(|n| n.error);
    // From where a box is this small on the screen, what is in it may be left out.
    let error = errors.fold((bounds[1] - bounds[0]).length(), f64::max);
    let children: Vec<Value> = nodes.into_iter().map(Node::written).collect();
    Some(Node {
        bounds,
        error,
        json: json!({ "children": children }),
    })
}

/// Divides nodes into two lists of about equal length, by their middles.
fn halves(mut nodes: Vec<Node>, along: fn(DVec3) -> f64) -> [Vec<Node>; 2] {
    nodes.sort_by(|a, b| along(a.middle()).total_cmp(&along(b.middle())));
    let upper = nodes.split_off(nodes.len().div_ceil(2));
    [nodes, upper]
}

fn union([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> [DVec3; 2] {
    [a.min(c), b.max(d)]
}

/// Returns a box as its middle and three half axes, rounded outwards to the millimetre.
fn volume([low, high]: [DVec3; 2]) -> [f64; 12] {
    const MM: f64 = 1000.0;
    let low = (low * MM - 1e-3).floor();
    let high = (high * MM + 1e-3).ceil();
    // Twice the middle and twice the half axes are whole millimetres.
    let m = (low + high) / (2.0 * MM);
    let h = ((high - low) / (2.0 * MM)).max(DVec3::splat(0.001));
    [m.x, m.y, m.z, h.x, 0.0, 0.0, 0.0, h.y, 0.0, 0.0, 0.0, h.z]
}
