//! The ground of a town in square pieces: heights on a lattice, thinned to triangles that keep within a tolerance of it.
//!
//! Neighbouring pieces, at whatever levels, meet without a gap. Their common border is a line of its own: it is thinned once,
//! from the heights on it alone, and the border of every mesh lies on that line. So no piece needs to know its neighbours.

mod thin;

use crate::Plan;
use crate::layer::Ground;
use glam::{DVec2, DVec3};
use hsd_ir::ast::town::Tiles;
use hsd_mesh::{GroundMesh, HouseDrafts, ground};
use hsd_scene::Detail;
use std::collections::BTreeSet;
use std::io;

/// How far the border of pieces may be from the heights, metres.
const BORDER: f64 = 0.05;
/// The cells of the side of a lattice, least and greatest powers of two.
const SIDES: (usize, usize) = (4, 512);
/// How far beyond features there is ground, metres.
const AROUND: f64 = 40.0;
/// Pieces in a row or a column that are filled between two others.
const GAP: i64 = 8;
/// Pieces under one feature.
const MOST: i64 = 4096;

/// A piece: the number of its square to the east and to the north of the origin.
pub type Cell = (i64, i64);

/// Returns the pieces of a town's ground: under all features that rules name, and between them; none without heights.
///
/// # Errors
/// Those of the spool in which the features wait.
pub fn cells(plan: &Plan, division: &Tiles) -> io::Result<Vec<Cell>> {
    if plan.ground.is_empty() {
        return Ok(vec![]);
    }
    let number = |p: DVec2| {
        let cell = (p / division.size).floor();
        (cell.x as i64, cell.y as i64)
    };
    let mut all = BTreeSet::new();
    plan.each(&mut |lot| {
        let [low, high] = lot.shape.bounds();
        let ((x0, y0), (x1, y1)) = (number(low - AROUND), number(high + AROUND));
        if (x1 - x0 + 1).saturating_mul(y1 - y0 + 1) > MOST {
            all.insert(number(lot.shape.centre()));
            return;
        }
        all.extend((x0..=x1).flat_map(|x| (y0..=y1).map(move |y| (x, y))));
    })?;
    let filled = |all: &BTreeSet<Cell>| -> Vec<Cell> {
        let pairs = all.iter().zip(all.iter().skip(1));
        let close = pairs.filter(|(a, b)| a.0 == b.0 && b.1 - a.1 <= GAP);
        close
            .flat_map(|(a, b)| (a.1..b.1).map(|y| (a.0, y)))
            .collect()
    };
    let turned: BTreeSet<Cell> = all.iter().map(|(x, y)| (*y, *x)).collect();
    let rows = filled(&turned).into_iter().map(|(y, x)| (x, y));
    let columns = filled(&all);
    all.extend(columns);
    all.extend(rows);
    Ok(all.into_iter().collect())
}

/// Returns the whole ground of a town at a level of detail, a piece after the other.
///
/// # Errors
/// Those of the spool in which the features wait.
pub fn meshes(
    plan: &Plan,
    detail: Detail,
) -> io::Result<impl Iterator<Item = (Patch, GroundMesh)> + '_> {
    let division = &plan.town.tiles;
    let patches = cells(plan, division)?.into_iter();
    let patches = patches.filter_map(|cell| Patch::new(&plan.ground, cell, division.size));
    Ok(patches.map(move |patch| {
        let mesh = patch.mesh(detail.ground_tolerance());
        (patch, mesh)
    }))
}

/// Returns the same as parts of a scene.
///
/// # Errors
/// Those of the spool in which the features wait.
pub fn drafts(plan: &Plan, detail: Detail) -> io::Result<impl Iterator<Item = HouseDrafts> + '_> {
    let meshes = meshes(plan, detail)?;
    Ok(meshes.map(|(patch, mesh)| ground(&patch.name(), patch.centre(), &mesh)))
}

/// The heights of a piece.
#[derive(Clone, Debug)]
pub struct Patch {
    /// Its square.
    pub cell: Cell,
    size: f64,
    /// The number of cells of a side, a power of two.
    side: usize,
    /// Heights of the corners of cells, row by row from the south-west, and of a ring round them; NaN where there is none.
    heights: Vec<f64>,
}

impl Patch {
    /// Looks at the heights of a piece; `None` if there are none.
    pub fn new(ground: &Ground, cell: Cell, size: f64) -> Option<Patch> {
        let (least, most) = SIDES;
        let wanted = (size / ground.cell()).ceil().clamp(1.0, most as f64) as usize;
        let side = wanted.next_power_of_two().clamp(least, most);
        let mut patch = Patch {
            cell,
            size,
            side,
            heights: Vec::with_capacity((side + 3) * (side + 3)),
        };
        for y in 0..side + 3 {
            for x in 0..side + 3 {
                let at = patch.place(x as i64 - 1, y as i64 - 1);
                patch.heights.push(ground.at(at).unwrap_or(f64::NAN));
            }
        }
        let known = patch.corners().any(|(x, y)| patch.height(x, y).is_finite());
        known.then_some(patch)
    }

    /// Returns the place of a corner of the lattice: the same to the last bit in all pieces that have it.
    fn place(&self, x: i64, y: i64) -> DVec2 {
        let step = self.size / self.side as f64;
        let side = self.side as i64;
        DVec2::new(
            (self.cell.0 * side + x) as f64,
            (self.cell.1 * side + y) as f64,
        ) * step
    }

    fn corners(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let side = self.side;
        (0..=side).flat_map(move |y| (0..=side).map(move |x| (x, y)))
    }

    fn height(&self, x: usize, y: usize) -> f64 {
        self.heights[(y + 1) * (self.side + 3) + x + 1]
    }

    /// Returns the middle of its square, on the ground there or at 0.
    pub fn centre(&self) -> DVec3 {
        let middle = self.place(self.side as i64 / 2, self.side as i64 / 2);
        middle.round().extend(0.0)
    }

    /// Returns its name.
    pub fn name(&self) -> String {
        let (east, north) = self.cell;
        format!("ground-{east}_{north}")
    }

    /// Returns the bytes of all that its mesh depends on.
    pub fn essence(&self) -> Vec<u8> {
        let numbers = [self.size, self.side as f64];
        let numbers = numbers.iter().chain(&self.heights);
        numbers.flat_map(|n| n.to_bits().to_le_bytes()).collect()
    }

    /// Returns its mesh within a tolerance of the heights, metres.
    pub fn mesh(&self, tolerance: f64) -> GroundMesh {
        let triangles = thin::triangles(self.lattice(), tolerance);
        let mut number = vec![u32::MAX; (self.side + 1) * (self.side + 1)];
        let mut mesh = GroundMesh::default();
        for corner in triangles.corners.into_iter().flatten() {
            let known = &mut number[corner];
            if *known == u32::MAX {
                *known = mesh.positions.len() as u32;
                let (x, y) = (corner % (self.side + 1), corner / (self.side + 1));
                let at = self.place(x as i64, y as i64);
                mesh.positions.push(at.extend(triangles.heights[corner]));
                mesh.normals.push(self.normal(x, y));
            }
            mesh.indices.push(*known);
        }
        mesh
    }

    /// Returns the heights of the corners, those of the border on its thinned lines.
    fn lattice(&self) -> thin::Lattice {
        let heights = self.corners().map(|(x, y)| self.height(x, y)).collect();
        let mut lattice = thin::Lattice::new(self.side, heights);
        lattice.thin_border(BORDER);
        lattice
    }

    /// Returns the normal of the ground at a corner, from the heights round it.
    fn normal(&self, x: usize, y: usize) -> DVec3 {
        let wide = self.side + 3;
        let at = (y + 1) * wide + x + 1;
        let step = self.size / self.side as f64;
        let slope = |low: f64, middle: f64, high: f64| {
            let both = (high - low) / (2.0 * step);
            let one = [(high - middle) / step, (middle - low) / step];
            let known = [both, one[0], one[1]]
                .into_iter()
                .find(|slope| slope.is_finite());
            known.unwrap_or(0.0)
        };
        let h = &self.heights;
        let east = slope(h[at - 1], h[at], h[at + 1]);
        let north = slope(h[at - wide], h[at], h[at + wide]);
        DVec3::new(-east, -north, 1.0).normalize()
    }
}
