//! Wood: growth rings, fibres and drying cracks of sugi, weathered as on a street front.

use super::color::{Rgb, hex, mix, ramp, scale, smooth};
use super::noise::{fbm, hash, noise};

/// Freshly planed sugi.
pub(super) const FRESH: Rgb = hex(0xD9_B48A);
/// Sheltered and old: browned.
pub(super) const BROWN: Rgb = hex(0x8A_6A4A);
/// Rained and sunned upon: silver.
pub(super) const SILVER: Rgb = hex(0x9C_9890);
/// Silver with fungus.
pub(super) const DARK: Rgb = hex(0x5F_5B55);

/// What the wood shows at a point.
#[derive(Clone, Copy)]
pub(super) struct Wood {
    /// 0 in the pale earlywood, 1 in the dark, hard latewood at the end of a ring.
    pub(super) late: f64,
    /// Fine fibres along the grain, about -1..1.
    pub(super) fibre: f64,
    /// 1 in a drying crack.
    pub(super) check: f64,
    /// 1 in the heart of a knot.
    pub(super) knot: f64,
}

impl Wood {
    /// Height in metres: earlywood erodes, latewood stands.
    pub(super) fn height(&self, relief: f64) -> f64 {
        relief * (self.late + 0.35 * self.fibre - 2.5 * self.check + self.knot)
    }

    /// Colour between a pale and a dark tone.
    pub(super) fn color(&self, early: Rgb, late: Rgb) -> Rgb {
        let ringed = mix(early, late, self.late * 0.75);
        let fibred = scale(ringed, 1.0 + 0.10 * self.fibre);
        let cracked = mix(fibred, scale(late, 0.45), self.check * 0.8);
        mix(cracked, scale(late, 0.62), self.knot * 0.8)
    }
}

/// One year: slowly darker, then sharply pale again.
fn ring(phase: f64) -> f64 {
    let year = phase - phase.floor();
    let dark = smooth(0.30, 0.88, year);
    dark * dark * (1.0 - smooth(0.90, 1.0, year))
}

/// Fibres and cracks; `along` and `across` are fractions of the repeat.
fn texture(along: f64, across: f64, late: f64, knot: f64, seed: u32) -> Wood {
    let fibre = fbm(across, along, (56, 3), 3, seed ^ 0x11)
        + 0.6 * noise(across, along, (200, 4), seed ^ 0x12);
    let crack = noise(across, along, (44, 2), seed ^ 0x13).abs();
    let where_dry = smooth(0.30, 0.65, fbm(across, along, (7, 3), 2, seed ^ 0x14));
    let check = (1.0 - smooth(0.0, 0.05, crack)) * where_dry;
    Wood {
        late,
        fibre,
        check,
        knot,
    }
}

/// Edge grain (masame): rings cut at right angles, nearly straight, `rings` to a repeat.
pub(super) fn edge_grain(along: f64, across: f64, rings: u32, seed: u32) -> Wood {
    let bend =
        1.1 * fbm(across, along, (3, 1), 2, seed) + 0.8 * noise(across, along, (14, 1), seed ^ 1);
    let wave = 0.16 * noise(across, along, (20, 5), seed ^ 2);
    let late = ring(across * f64::from(rings) + bend + wave);
    texture(along, across, late, 0.0, seed)
}

/// A board sawn flat (itame) from a log: the rings open into arches.
#[derive(Clone, Copy)]
pub(super) struct Board {
    /// Number of the board, which decides all its chance.
    pub(super) id: i64,
    /// Width in metres.
    pub(super) width: f64,
    /// Length of the repeat in metres.
    pub(super) length: f64,
    /// Which random layer.
    pub(super) seed: u32,
}

impl Board {
    /// A number in 0..1 that belongs to the board.
    pub(super) fn chance(&self, salt: u32) -> f64 {
        hash(self.id, 7, self.seed ^ salt.wrapping_mul(0x9E37))
    }

    /// The wood at `at` (0..1 across the board) and `along` (fraction of the repeat), where
    /// `across` is the same place as a fraction of the repeat.
    pub(super) fn wood(&self, along: f64, at: f64, across: f64) -> Wood {
        let own = self.seed.wrapping_add(self.id as u32 * 977);
        let heart = 0.5 + 0.7 * (self.chance(1) - 0.5);
        let x = (at - heart) * self.width;
        let bow = noise(0.5, along, (1, 1), own) + 0.5 * noise(0.5, along, (1, 2), own ^ 1);
        let depth = 0.012 + 0.035 * self.chance(2) + 0.055 * (bow + 0.7).abs();
        let wobble = 0.0022 * fbm(across, along, (16, 4), 2, own ^ 2);
        let (knot, swirl) = self.knot(along, at);
        let radius = (x * x * 1.6 + depth * depth).sqrt() + wobble;
        let late = ring(radius / (0.0055 + 0.003 * self.chance(3)) + swirl);
        texture(along, across, late * (1.0 - knot), knot, own)
    }

    /// How much of a knot is here, and how many rings it pushes aside.
    fn knot(&self, along: f64, at: f64) -> (f64, f64) {
        if self.chance(4) < 0.45 {
            return (0.0, 0.0);
        }
        let x = (at - 0.2 - 0.6 * self.chance(5)) * self.width;
        let gap = along - self.chance(6);
        let y = (gap - gap.round()) * self.length;
        let size = 0.007 + 0.008 * self.chance(7);
        let round = (x * x + y * y * 0.45).sqrt();
        let swirl = 3.0 * libm::exp(-(round * round) / (size * size * 6.0));
        (1.0 - smooth(size * 0.6, size, round), swirl)
    }
}

/// Pale and dark tones of old wood: `age` 0 brown to 1 silver, `tone` -1..1 for this piece.
pub(super) fn weathered(age: f64, tone: f64) -> (Rgb, Rgb) {
    let lift = 1.0 + 0.10 * tone;
    let early = ramp(
        &[mix(FRESH, BROWN, 0.5), mix(BROWN, SILVER, 0.55), SILVER],
        age,
    );
    let late = ramp(&[scale(BROWN, 0.82), mix(BROWN, DARK, 0.6), DARK], age);
    (scale(early, lift), scale(late, lift))
}
