//! Scattered pieces and rows of pieces: boards and tiles, grains, straws. All periodic.

use crate::textures::color::smooth;
use crate::textures::noise::{Period, floor, hash, wrap};
use crate::textures::paint::Spot;

/// A position in a row of equal pieces.
#[derive(Clone, Copy)]
pub(in crate::textures) struct RowPiece {
    /// Number of the piece, 0 to n - 1.
    pub(in crate::textures) index: i64,
    /// Position within the piece, 0..1.
    pub(in crate::textures) at: f64,
    /// Width of the piece as a fraction of the repeat.
    pub(in crate::textures) width: f64,
}

impl RowPiece {
    /// Returns the distance to the nearer end of the piece, as a fraction of the repeat.
    pub(in crate::textures) fn edge(&self) -> f64 {
        self.at.min(1.0 - self.at) * self.width
    }
}

/// Returns the piece at `t` (fraction of the repeat) if `n` equal ones fill the repeat.
pub(in crate::textures) fn row(t: f64, n: u32) -> RowPiece {
    let x = t * f64::from(n);
    let low = floor(x);
    RowPiece {
        index: wrap(low, i64::from(n)),
        at: x - low as f64,
        width: 1.0 / f64::from(n),
    }
}

/// As [`row`], with each joint moved by up to `jitter` / 2 pieces (`jitter` < 1).
pub(in crate::textures) fn uneven_row(t: f64, n: u32, jitter: f64, seed: u32) -> RowPiece {
    let x = t * f64::from(n);
    let joint = |i: i64| i as f64 + jitter * (hash(wrap(i, i64::from(n)), 0, seed) - 0.5);
    let mut low = floor(x);
    if x < joint(low) {
        low -= 1;
    } else if x >= joint(low + 1) {
        low += 1;
    }
    let (from, to) = (joint(low), joint(low + 1));
    RowPiece {
        index: wrap(low, i64::from(n)),
        at: (x - from) / (to - from),
        width: (to - from) / f64::from(n),
    }
}

/// The nearest of scattered points (Worley, 1996).
#[derive(Clone, Copy)]
pub(in crate::textures) struct Grain {
    /// Distance to the nearest point, in lattice cells.
    pub(in crate::textures) near: f64,
    /// Additional distance to the second nearest point; 0 on the border between two grains.
    pub(in crate::textures) border: f64,
    /// A pseudo-random number in 0..1 for the nearest point.
    pub(in crate::textures) id: f64,
}

/// Returns the grain at a point, with one point scattered in each lattice cell.
pub(in crate::textures) fn grain(u: f64, v: f64, period: Period, seed: u32) -> Grain {
    let (nx, ny) = (i64::from(period.0), i64::from(period.1));
    let (x, y) = (u * nx as f64, v * ny as f64);
    let (cx, cy) = (floor(x), floor(y));
    let (mut first, mut second, mut id) = (9.0_f64, 9.0_f64, 0.0);
    for j in cy - 1..=cy + 1 {
        for i in cx - 1..=cx + 1 {
            let (wi, wj) = (wrap(i, nx), wrap(j, ny));
            let dx = i as f64 + hash(wi, wj, seed) - x;
            let dy = j as f64 + hash(wi, wj, seed ^ 0x51) - y;
            let d = dx * dx + dy * dy;
            if d < first {
                second = first;
                first = d;
                id = hash(wi, wj, seed ^ 0xA7);
            } else if d < second {
                second = d;
            }
        }
    }
    Grain {
        near: first.sqrt(),
        border: second.sqrt() - first.sqrt(),
        id,
    }
}

/// A layer of scattered straws, hairs or reeds.
#[derive(Clone, Copy)]
pub(in crate::textures) struct Straws {
    /// One straw in each lattice cell.
    pub(in crate::textures) period: Period,
    /// Half the length, metres; straws that extend more than a cell in a direction are cut.
    pub(in crate::textures) reach: f64,
    /// Thickness, metres.
    pub(in crate::textures) width: f64,
    /// Largest angle from the vertical, radians.
    pub(in crate::textures) spread: f64,
    /// Deflection at the ends, metres.
    pub(in crate::textures) bow: f64,
    /// Seed of the random layer.
    pub(in crate::textures) seed: u32,
}

/// The uppermost straw at a point.
#[derive(Clone, Copy, Default)]
pub(in crate::textures) struct Straw {
    /// Coverage: 0 beside every straw, 1 on one.
    pub(in crate::textures) cover: f64,
    /// A pseudo-random number in 0..1 for the straw; the highest is on top.
    pub(in crate::textures) id: f64,
    /// Position along the straw, -1 at its foot, 1 at its head.
    pub(in crate::textures) along: f64,
    /// Position across it, -1..1.
    pub(in crate::textures) across: f64,
}

impl Straws {
    /// Returns the uppermost straw at a spot.
    pub(in crate::textures) fn at(&self, spot: Spot) -> Straw {
        let (nx, ny) = (i64::from(self.period.0), i64::from(self.period.1));
        let (cx, cy) = (floor(spot.u * nx as f64), floor(spot.v * ny as f64));
        let mut top = Straw::default();
        for j in cy - 1..=cy + 1 {
            for i in cx - 1..=cx + 1 {
                let straw = self.one(spot, i, j);
                if straw.cover > 0.0 && (straw.id >= top.id || top.cover < 0.5) {
                    top = straw;
                }
            }
        }
        top
    }

    /// Returns the straw of one lattice cell.
    fn one(&self, spot: Spot, i: i64, j: i64) -> Straw {
        let (nx, ny) = (i64::from(self.period.0), i64::from(self.period.1));
        let (wi, wj) = (wrap(i, nx), wrap(j, ny));
        let random = |salt: u32| hash(wi, wj, self.seed.wrapping_mul(31).wrapping_add(salt));
        let dx = (spot.u - (i as f64 + random(1)) / nx as f64) * spot.metres;
        let dy = (spot.v - (j as f64 + random(2)) / ny as f64) * spot.metres;
        let angle = self.spread * (2.0 * random(3) - 1.0);
        let (sin, cos) = libm::sincos(angle);
        let along = (dx * sin + dy * cos) / self.reach;
        let bow = self.bow * (2.0 * random(4) - 1.0) * along * along;
        let across = dx * cos - dy * sin - bow;
        let half = self.width / 2.0;
        let soft = spot.pixel * 0.6;
        let cover = (1.0 - smooth(half - soft, half + soft, across.abs()))
            * (1.0 - smooth(0.9, 1.0, along.abs()));
        Straw {
            cover,
            id: random(5),
            along,
            across: (across / half).clamp(-1.0, 1.0),
        }
    }
}
