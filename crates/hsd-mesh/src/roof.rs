//! Triangulates roof solids in the surfaces of their coverings. Texture coordinates run along the eaves and up the
//! slope, so that courses are horizontal.

pub(crate) mod bulk;
pub(crate) mod infill;
pub(crate) mod mesh_key;

use crate::mesh::Soup;
use crate::roof::bulk::Bulk;
use glam::DVec3;
use hsd_ir::ast::RoofKind;
use hsd_ir::building::{Face, Finish, Solid};
use hsd_ir::material::SurfaceId;
use smallvec::SmallVec;
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

/// Returns the faces of all solids, one soup per surface in the order of first use; those of some finishes are in a list of
/// their own, the second.
pub(super) fn soups(
    bulk: &Bulk<'_>,
    apart: impl Fn(Finish) -> bool,
) -> [Vec<(SurfaceId, Soup)>; 2] {
    let solids = bulk.solids.iter().enumerate();
    let faces = solids.flat_map(|(n, s)| s.faces.iter().map(move |face| (n, s, face)));
    let mut sizes = [const { vec![] }; 2];
    let mut places: SmallVec<[(usize, usize); 64]> = SmallVec::new();
    for (n, _, face) in faces.clone() {
        let id = bulk.given(n, face).unwrap_or_else(|| surface(face.finish));
        let list = usize::from(apart(face.finish));
        places.push((list, Size::count(&mut sizes[list], id, face)));
    }
    let mut soups = sizes.map(|list| list.into_iter().map(Size::empty).collect::<Vec<_>>());
    let mut corners: Vec<DVec3> = Vec::with_capacity(8);
    for ((_, solid, face), (list, at)) in faces.zip(places) {
        gather(solid, face, &mut corners);
        let up = |normal| match face.finish {
            Finish::Covering(_) => bulk.up(normal),
            _ => None,
        };
        let soup = &mut soups[list][at].1;
        soup.covering(&corners, up, has_grain(face.finish));
    }
    soups
}

/// The size of a surface's soup. Room is made for all of it at once: roofs are never shared, so they dominate the cost.
struct Size {
    surface: SurfaceId,
    corners: usize,
    triangles: usize,
}

impl Size {
    /// Adds a face to the size of its surface's soup; returns the index of that.
    fn count(list: &mut Vec<Size>, surface: SurfaceId, face: &Face) -> usize {
        let at = list.iter().position(|size| size.surface == surface);
        let at = at.unwrap_or_else(|| {
            list.push(Size {
                surface,
                corners: 0,
                triangles: 0,
            });
            list.len() - 1
        });
        let n = face.corners.len();
        list[at].corners += n;
        list[at].triangles += n.saturating_sub(2);
        at
    }

    /// Returns a soup that has room for it.
    fn empty(self) -> (SurfaceId, Soup) {
        let soup = Soup {
            positions: Vec::with_capacity(self.corners),
            normals: Vec::with_capacity(self.corners),
            uvs: Vec::with_capacity(self.corners),
            indices: Vec::with_capacity(3 * self.triangles),
            left_out: 0,
        };
        (self.surface, soup)
    }
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
