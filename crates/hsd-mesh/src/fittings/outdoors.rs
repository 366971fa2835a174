//! What a town has outside houses: sheets on the ground, and trees. A tree is two crossed upright shapes, cut out to its outline,
//! at details 0 and 1 (000-67), and a trunk with a crown at 2 and 3. All trees of a species are one shape, stretched in width
//! and height: tiles keep it once and put it up again and again.

use super::super::Walker;
use super::super::mesh::{Bodies, Soup};
use super::super::store::look::Share;
use crate::mesh::polygon;
use compact_str::format_compact;
use glam::{DVec3, dvec3};
use hsd_ir::ast::{Outdoors, Sheet, Species, Tree};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Detail, Kind, NodeId, Stretched};
use std::f64::consts::TAU;

/// Shares of half the width and of the height, from the foot of a crown to its top.
type Profile = &'static [(f64, f64)];

/// A crown: its middle in shares of half the width, and its profile.
type Crown = ([f64; 2], Profile);

/// Half the width of a trunk at its foot and top, as shares of the height.
const TRUNK: [f64; 2] = [0.022, 0.012];

impl Walker<'_> {
    /// Adds the nodes of what a town made in place of a house.
    pub(crate) fn outdoors(&mut self, root: NodeId, it: &Outdoors) {
        let detail = self.detail;
        let mut bodies = Bodies::default();
        let shown = |sheet: &&Sheet| (sheet.least..=sheet.most).contains(&(detail as u8));
        for sheet in it.sheets.iter().filter(shown) {
            let lift = match sheet.on_ground {
                true => detail.ground_tolerance(),
                false => lift(detail),
            };
            lay(&mut bodies, sheet, lift);
        }
        let mesh = self.own(it.word, bodies);
        if mesh.is_some() {
            let node = self.node(Some(root), Kind::Outdoors, it.word.into(), DVec3::ZERO);
            node.mesh = mesh;
            node.span = Some(it.span);
        }
        for tree in &it.trees {
            let word = tree.species.word();
            let name = format_compact!("tree {word}");
            let bodies = shape(tree, detail);
            let draft = self
                .store
                .finish(name.to_string(), bodies, Share::default());
            let mesh = self.store.push(draft);
            let node = self.node(Some(root), Kind::Tree, name, tree.at);
            node.turn = tree.turn;
            node.mesh = Some(mesh);
            node.span = Some(it.span);
            node.stretched = Some(Box::new(Stretched {
                model: word,
                size: [tree.width as f32, tree.height as f32],
            }));
        }
    }
}

/// Returns how far sheets are raised over a plane, metres: from afar, viewers cannot tell them from what they lie on.
fn lift(detail: Detail) -> f64 {
    match detail {
        Detail::Body => 0.12,
        Detail::Flat => 0.03,
        Detail::Openings | Detail::Everything => 0.0,
    }
}

/// Adds the faces of a sheet.
fn lay(bodies: &mut Bodies, sheet: &Sheet, lift: f64) {
    let finish = SurfaceId::named(sheet.finish);
    let up = DVec3::Z * lift;
    for face in &sheet.faces {
        let corners: Vec<DVec3> = face.iter().map(|p| *p + up).collect();
        // Roads are shaded as one surface, however the ground bends; envelopes have planes.
        let bends = !sheet.finish.starts_with("envelope");
        match bends && polygon::normal(&corners).z > 0.5 {
            true => bodies.shaded(finish, &corners, &vec![DVec3::Z; corners.len()]),
            false => bodies.face(finish, &corners),
        }
    }
}

/// Returns the crowns of a species.
#[rustfmt::skip]
fn crowns(species: Species) -> &'static [Crown] {
    match species {
        Species::Willow => &[([0.0; 2], &[(0.0, 0.42), (0.6, 0.2), (0.92, 0.14), (1.0, 0.45), (0.8, 0.78), (0.42, 0.95), (0.0, 1.0)])],
        Species::Pine => &[
            ([0.12, 0.1], &[(0.0, 0.46), (0.7, 0.47), (0.88, 0.52), (0.5, 0.6), (0.0, 0.63)]),
            ([-0.25, 0.05], &[(0.0, 0.63), (0.55, 0.65), (0.66, 0.7), (0.35, 0.78), (0.0, 0.8)]),
            ([0.1, -0.08], &[(0.0, 0.82), (0.42, 0.83), (0.5, 0.88), (0.3, 0.96), (0.0, 1.0)]),
        ],
        Species::Cherry => &[([0.0; 2], &[(0.0, 0.34), (0.62, 0.33), (0.98, 0.5), (0.92, 0.72), (0.5, 0.93), (0.0, 1.0)])],
        Species::Cedar => &[
            ([0.0; 2], &[(0.0, 0.16), (1.0, 0.14), (0.6, 0.38), (0.3, 0.5), (0.0, 0.56)]),
            ([0.0; 2], &[(0.0, 0.42), (0.74, 0.4), (0.42, 0.62), (0.0, 0.78)]),
            ([0.0; 2], &[(0.0, 0.64), (0.48, 0.62), (0.22, 0.84), (0.0, 1.0)]),
        ],
        Species::Plane => &[([0.0; 2], &[(0.0, 0.28), (0.55, 0.28), (0.95, 0.45), (1.0, 0.62), (0.7, 0.88), (0.0, 1.0)])],
    }
}

fn leaves(species: Species) -> SurfaceId {
    SurfaceId::named(match species {
        Species::Willow => "leaves_willow",
        Species::Pine => "leaves_pine",
        Species::Cherry => "leaves_cherry",
        Species::Cedar => "leaves_cedar",
        Species::Plane => "leaves_plane",
    })
}

/// Returns the height of the trunk as a share of the tree's.
fn trunk(species: Species) -> f64 {
    match species {
        Species::Pine | Species::Cedar => 0.86,
        Species::Willow | Species::Cherry | Species::Plane => 0.55,
    }
}

/// Builds a tree that stands on 0 0 0.
fn shape(tree: &Tree, detail: Detail) -> Bodies {
    let mut bodies = Bodies::default();
    let (half, height) = (tree.width / 2.0, tree.height);
    // A trunk is part of the shape that is stretched.
    let wood = TRUNK.map(|share| share * 2.0);
    let top = trunk(tree.species);
    let bark = SurfaceId::named("cedar_dark");
    if detail <= Detail::Flat {
        for way in [DVec3::X, DVec3::Y] {
            let outline = [(wood[0], 0.0), (wood[1], top)];
            crossed(&mut bodies, bark, way, ([0.0; 2], &outline), [half, height]);
            for (off, profile) in crowns(tree.species) {
                crossed(
                    &mut bodies,
                    leaves(tree.species),
                    way,
                    (*off, profile),
                    [half, height],
                );
            }
        }
        return bodies;
    }
    let sides = if detail == Detail::Everything { 9 } else { 6 };
    let pole = [(wood[0], 0.0), (wood[1], top)];
    round(
        bodies.soup(bark),
        ([0.0; 2], &pole),
        [half, height],
        (5, 0.0),
    );
    for (off, profile) in crowns(tree.species) {
        let soup = bodies.soup(leaves(tree.species));
        round(soup, (*off, profile), [half, height], (sides, 0.13));
    }
    bodies
}

/// Adds an upright shape of this profile to both sides, seen from before and behind.
fn crossed(
    bodies: &mut Bodies,
    finish: SurfaceId,
    way: DVec3,
    ([east, north], profile): ([f64; 2], &[(f64, f64)]),
    [half, height]: [f64; 2],
) {
    let middle = way * way.dot(dvec3(east, north, 0.0));
    let at = |side: f64| {
        move |(r, z): &(f64, f64)| (middle + way * (side * r)) * half + DVec3::Z * (z * height)
    };
    let right = profile.iter().map(at(1.0));
    let left = profile.iter().rev().filter(|(r, _)| *r > 0.0).map(at(-1.0));
    let mut ring: Vec<DVec3> = right.chain(left).collect();
    for out in [way.cross(DVec3::Z), DVec3::Z.cross(way)] {
        // Light comes from above for both sides.
        let normal = (out + DVec3::Z).normalize();
        bodies.shaded(finish, &ring, &vec![normal; ring.len()]);
        ring.reverse();
    }
}

/// Adds a body of revolution with lumps, whose faces share their corners.
fn round(
    soup: &mut Soup,
    ([east, north], profile): ([f64; 2], &[(f64, f64)]),
    [half, height]: [f64; 2],
    (sides, lumps): (u32, f64),
) {
    let first = soup.positions.len() as u32;
    let rows = profile.len() as u32;
    for (row, (r, z)) in profile.iter().enumerate() {
        let before = profile[row.saturating_sub(1)];
        let after = profile[(row + 1).min(profile.len() - 1)];
        let slope = [(after.0 - before.0) * half, (after.1 - before.1) * height];
        for k in 0..sides {
            let turn = f64::from(k) + if row % 2 == 0 { 0.0 } else { 0.5 };
            let angle = TAU * turn / f64::from(sides);
            let way = dvec3(libm::cos(angle), libm::sin(angle), 0.0);
            let lump = 1.0 + lumps * libm::sin(f64::from(k * k) * 2.4 + row as f64 * 1.9);
            let at =
                dvec3(east, north, 0.0) * half + way * (r * half * lump) + DVec3::Z * (z * height);
            let normal = (way * slope[1] - DVec3::Z * slope[0]).normalize_or(DVec3::Z);
            soup.positions.push(at.as_vec3().to_array());
            soup.normals.push(normal.as_vec3().to_array());
            let around = TAU * f64::from(k) / f64::from(sides) * half;
            soup.uvs.push([around as f32, (z * height) as f32]);
        }
    }
    for row in 0..rows - 1 {
        for k in 0..sides {
            let corner = |row: u32, k: u32| first + row * sides + k % sides;
            let lead = u32::from(row % 2 == 1);
            let (a, b) = (corner(row, k), corner(row, k + 1));
            let (c, d) = (corner(row + 1, k + lead), corner(row + 1, k + lead + 1));
            // Rows are turned against each other by half a side.
            match lead {
                0 => soup.indices.extend([a, b, c, b, d, c]),
                _ => soup.indices.extend([a, b, c, a, c, corner(row + 1, k)]),
            }
        }
    }
}
