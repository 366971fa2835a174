//! Roofs: ready polyhedra into triangles, in the surfaces of their coverings. Texture coordinates run
//! along the eaves and up the slope, so that courses lie level.

use super::mesh::Soup;
use crate::ast::RoofKind;
use crate::building::{Face, Finish, Roof, Solid};
use crate::material::SurfaceId;
use glam::DVec3;
use std::sync::LazyLock;

/// The surface of every finish, looked up once.
static SURFACES: LazyLock<Vec<(Finish, SurfaceId)>> = LazyLock::new(|| {
    let mut table = vec![
        (Finish::Soffit, SurfaceId::named("soffit")),
        (Finish::Gable, SurfaceId::named("plaster")),
        (Finish::Timber, SurfaceId::named("cedar")),
        (Finish::Plaster, SurfaceId::named("plaster")),
    ];
    for (_, kind) in RoofKind::ALL {
        let [covering, edge, ridge] = names(kind).map(SurfaceId::named);
        table.push((Finish::Covering(kind), covering));
        table.push((Finish::Edge(kind), edge));
        table.push((Finish::Ridge(kind), ridge));
    }
    table
});

/// Covering, edge and ridge of a kind.
fn names(kind: RoofKind) -> [&'static str; 3] {
    match kind {
        RoofKind::Tiles => ["kawara", "kawara_edge", "kawara_edge"],
        RoofKind::Boards => ["board_roof", "cedar", "cedar"],
        RoofKind::Shingles => ["shingle", "shingle", "cedar"],
        RoofKind::Bark => ["bark", "bark", "kawara_edge"],
        RoofKind::Thatch => ["thatch", "thatch", "bark"],
        RoofKind::Metal => ["sheet_roof", "sheet_roof", "sheet_roof"],
    }
}

/// The surface of a finish.
pub(super) fn surface(finish: Finish) -> SurfaceId {
    let found = SURFACES.iter().find(|(f, _)| *f == finish);
    found.map_or(SurfaceId::named("plaster"), |(_, id)| *id)
}

/// The faces of all solids, a soup each surface in the order of first use.
pub(super) fn soups(roof: &Roof) -> Vec<(SurfaceId, Soup)> {
    let mut soups: Vec<(Finish, SurfaceId, Soup)> = Vec::with_capacity(6);
    let mut corners: Vec<DVec3> = Vec::with_capacity(8);
    for solid in &roof.solids {
        for face in &solid.faces {
            let at = soups.iter().position(|(f, ..)| *f == face.finish);
            let at = at.unwrap_or_else(|| {
                soups.push(empty(face.finish, roof.solids.len()));
                soups.len() - 1
            });
            gather(solid, face, &mut corners);
            add(&mut soups[at].2, &corners, face.finish);
        }
    }
    let mut merged: Vec<(SurfaceId, Soup)> = Vec::with_capacity(soups.len());
    for (_, id, soup) in soups {
        match merged.iter_mut().find(|(other, _)| *other == id) {
            Some((_, into)) => append(into, soup),
            None => merged.push((id, soup)),
        }
    }
    merged
}

/// An empty soup with room for some quadrangles of each solid.
fn empty(finish: Finish, solids: usize) -> (Finish, SurfaceId, Soup) {
    let room = 8 * solids.min(64);
    let soup = Soup {
        positions: Vec::with_capacity(room),
        normals: Vec::with_capacity(room),
        uvs: Vec::with_capacity(room),
        indices: Vec::with_capacity(room * 3 / 2),
    };
    (finish, surface(finish), soup)
}

/// The corners of a face; indices out of range are left out.
fn gather(solid: &Solid, face: &Face, corners: &mut Vec<DVec3>) {
    corners.clear();
    let points = face.corners.iter();
    corners.extend(points.filter_map(|i| solid.points.get(*i as usize)));
}

/// One face.
fn add(soup: &mut Soup, corners: &[DVec3], finish: Finish) {
    // Boards and barge boards have their grain along them; coverings keep up the slope.
    let grain = matches!(
        finish,
        Finish::Timber | Finish::Edge(RoofKind::Boards) | Finish::Ridge(RoofKind::Boards)
    );
    soup.face(corners, grain);
}

/// Two soups of one surface.
fn append(into: &mut Soup, soup: Soup) {
    let first = into.positions.len() as u32;
    into.positions.extend(soup.positions);
    into.normals.extend(soup.normals);
    into.uvs.extend(soup.uvs);
    into.indices.extend(soup.indices.iter().map(|i| first + i));
}
