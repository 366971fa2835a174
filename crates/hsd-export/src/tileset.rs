//! The root of 3D Tiles 1.1: `tileset.json`, a tree of boxes with the files in them.
//!
//! Near tiles hang below a box without content, four boxes below a larger one, so that a viewer need not look at each. Boxes
//! with hundreds of tiles below them are files of their own, so that of a large town a viewer reads what it comes near. The
//! levels of a tile hang below one another and replace each other. Boxes lie in the frame of the town, metres east, north and
//! up; the root's transform places it on the globe. Every box contains those below it, and no error is less than those
//! below it.

use glam::DVec3;
use hsd_scene::Detail;
use serde_json::{Value, json};
use twox_hash::XxHash3_128;

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

/// A box with at least this many entries below it, tiles or files, is written to a file of its own.
const APART: usize = 128;

/// The files of the tree.
#[derive(Debug)]
pub struct TreeFiles {
    /// `tileset.json`, which names the others.
    pub root: Vec<u8>,
    /// The others, which stand beside it: their names, made of what is in them, and their bytes.
    pub branches: Vec<(String, Vec<u8>)>,
}

impl TreeFiles {
    /// Returns true for a name as branches have it.
    pub fn is_branch(name: &str) -> bool {
        name.starts_with("branch-") && name.ends_with(".json")
    }
}

/// Returns the tree of some tiles. Tiles without levels are left out.
pub fn tileset(tiles: &[TilePlace], transform: Option<[f64; 16]>) -> TreeFiles {
    let nodes = tiles.iter().filter_map(tile).collect();
    let mut branches = vec![];
    let mut root = grouped(nodes, &mut branches).unwrap_or_else(|| Node {
        bounds: [DVec3::ZERO; 2],
        error: 0.0,
        json: json!({}),
        weight: 0,
    });
    if let Some(transform) = transform {
        root.json["transform"] = json!(transform);
    }
    let root = file(root);
    TreeFiles { root, branches }
}

/// Returns the file of a tree.
fn file(mut root: Node) -> Vec<u8> {
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
    /// The number of tiles and files below it, without what is inside of those files.
    weight: usize,
}

impl Node {
    /// Moves what is in it to a file of its own, if it is much.
    fn apart(self, branches: &mut Vec<(String, Vec<u8>)>) -> Node {
        if self.weight < APART {
            return self;
        }
        let (bounds, error) = (self.bounds, self.error);
        let bytes = file(self);
        let name = format!("branch-{:016x}.json", XxHash3_128::oneshot(&bytes) as u64);
        let json = json!({ "content": { "uri": name } });
        branches.push((name, bytes));
        Node {
            bounds,
            error,
            json,
            weight: 1,
        }
    }

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
            weight: 1,
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

/// Hangs nodes below boxes until one is left; large boxes below it go to `branches`.
fn grouped(mut nodes: Vec<Node>, branches: &mut Vec<(String, Vec<u8>)>) -> Option<Node> {
    if nodes.len() > TOGETHER {
        let quarters = halves(nodes, |p| p.x).into_iter();
        let quarters = quarters.flat_map(|half| halves(half, |p| p.y));
        let below = quarters.filter_map(|quarter| grouped(quarter, branches));
        let below: Vec<Node> = below.collect();
        nodes = below.into_iter().map(|n| n.apart(branches)).collect();
    }
    let bounds = nodes.iter().map(|n| n.bounds).reduce(union)?;
    let errors = nodes.iter().map(|n| n.error);
    // From where a box is this small on the screen, what is in it may be left out.
    let error = errors.fold((bounds[1] - bounds[0]).length(), f64::max);
    let weight = nodes.iter().map(|n| n.weight).sum();
    let children: Vec<Value> = nodes.into_iter().map(Node::written).collect();
    Some(Node {
        bounds,
        error,
        json: json!({ "children": children }),
        weight,
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
