//! Triangulates roof solids in the surfaces of their coverings. Texture coordinates run along the eaves and up the
//! slope, so that courses are horizontal.

pub(in crate::tessellate) mod bulk;
pub(in crate::tessellate) mod infill;
pub(in crate::tessellate) mod mesh_key;

use crate::ast::RoofKind;
use crate::building::{Face, Finish, Solid};
use crate::material::SurfaceId;
use crate::tessellate::mesh::Soup;
use crate::tessellate::roof::bulk::Bulk;
use glam::DVec3;
use std::sync::LazyLock;

/// The surfaces of all finishes, looked up once: soffit, timber, plaster, then covering and edge of each kind.
static SURFACES: LazyLock<Vec<SurfaceId>> = LazyLock::new(|| {
    let plain = ["soffit", "cedar", "plaster"];
    let kinds = KINDS.into_iter().flat_map(names);
    plain
        .into_iter()
        .chain(kinds)
        .map(SurfaceId::named)
        .collect()
});

/// The roof kinds in the order of the table.
const KINDS: [RoofKind; 7] = [
    RoofKind::Tiles,
    RoofKind::CoverTiles,
    RoofKind::Boards,
    RoofKind::Shingles,
    RoofKind::Bark,
    RoofKind::Thatch,
    RoofKind::Metal,
];

/// Returns the surface names of a kind's covering and edge.
fn names(kind: RoofKind) -> [&'static str; 2] {
    match kind {
        RoofKind::Tiles => ["kawara", "kawara_edge"],
        RoofKind::CoverTiles => ["hongawara", "kawara_edge"],
        RoofKind::Boards => ["board_roof", "cedar"],
        RoofKind::Shingles => ["shingle", "shingle"],
        RoofKind::Bark => ["bark", "bark"],
        RoofKind::Thatch => ["thatch", "thatch"],
        RoofKind::Metal => ["sheet_roof", "sheet_roof"],
    }
}

/// Returns the surface of plaster.
pub(super) fn plaster() -> SurfaceId {
    SURFACES[2]
}

/// Returns the default surface of a finish; gables are plastered.
fn surface(finish: Finish) -> SurfaceId {
    let of = |kind: RoofKind, which: usize| {
        let row = KINDS.iter().position(|k| *k == kind).unwrap_or_default();
        3 + 2 * row + which
    };
    SURFACES[match finish {
        Finish::Soffit => 0,
        Finish::Timber => 1,
        Finish::Plaster | Finish::Gable => 2,
        Finish::Covering(kind) => of(kind, 0),
        Finish::Edge(kind) => of(kind, 1),
    }]
}

/// Returns true if a finish is seen little from afar: edges of coverings, and what looks down.
pub(super) fn is_minor(finish: Finish) -> bool {
    matches!(finish, Finish::Edge(_) | Finish::Soffit)
}

/// Returns the faces of all solids with some finishes, one soup per surface in the order of first use.
pub(super) fn soups(bulk: &Bulk<'_>, with: impl Fn(Finish) -> bool) -> Vec<(SurfaceId, Soup)> {
    let solids = &bulk.solids[..];
    let shows = |n: usize, face: &Face| {
        with(face.finish).then(|| bulk.given(n, face).unwrap_or_else(|| surface(face.finish)))
    };
    let mut soups = rooms(solids, shows);
    let mut corners: Vec<DVec3> = Vec::with_capacity(8);
    for (n, solid) in solids.iter().enumerate() {
        for face in &solid.faces {
            let Some(id) = shows(n, face) else { continue };
            gather(solid, face, &mut corners);
            if let Some((_, soup)) = soups.iter_mut().find(|(s, _)| *s == id) {
                let up = |normal| match face.finish {
                    Finish::Covering(_) => bulk.up(normal),
                    _ => None,
                };
                soup.covering(&corners, up, has_grain(face.finish));
            }
        }
    }
    soups
}

/// Allocates soups with capacity for all faces of each surface: roofs are never shared, so they dominate the cost.
fn rooms(
    solids: &[Solid],
    shows: impl Fn(usize, &Face) -> Option<SurfaceId>,
) -> Vec<(SurfaceId, Soup)> {
    let mut rooms: Vec<(SurfaceId, usize, usize)> = Vec::with_capacity(6);
    let faces = solids.iter().enumerate();
    let faces = faces.flat_map(|(solid, s)| s.faces.iter().map(move |f| (solid, f)));
    for (solid, face) in faces {
        let Some(id) = shows(solid, face) else {
            continue;
        };
        let n = face.corners.len();
        match rooms.iter_mut().find(|(s, ..)| *s == id) {
            Some((_, corners, triangles)) => {
                *corners += n;
                *triangles += n.saturating_sub(2);
            }
            None => rooms.push((id, n, n.saturating_sub(2))),
        }
    }
    let empty = |(id, corners, triangles): (SurfaceId, usize, usize)| {
        let soup = Soup {
            positions: Vec::with_capacity(corners),
            normals: Vec::with_capacity(corners),
            uvs: Vec::with_capacity(corners),
            indices: Vec::with_capacity(3 * triangles),
        };
        (id, soup)
    };
    rooms.into_iter().map(empty).collect()
}

/// Returns true if the grain follows the longer side, as on boards; coverings keep v up the slope.
fn has_grain(finish: Finish) -> bool {
    use RoofKind::Boards;
    matches!(finish, Finish::Timber | Finish::Edge(Boards))
}

/// Collects the corners of a face; indices out of range are skipped.
fn gather(solid: &Solid, face: &Face, corners: &mut Vec<DVec3>) {
    corners.clear();
    let points = face.corners.iter();
    corners.extend(points.filter_map(|i| solid.points.get(*i as usize)));
}
