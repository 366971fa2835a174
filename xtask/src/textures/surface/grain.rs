//! Wood: growth rings, fibres and drying cracks of sugi, and how it weathers on a street front.

use crate::textures::color::{Rgb, hex, mix, scale, smooth};
use crate::textures::noise::{Period, fbm, floor, hash, noise, wrap};

/// Freshly planed sugi.
pub(in crate::textures) const FRESH: Rgb = hex(0xD9_B48A);
/// Sheltered and old: browned.
pub(in crate::textures) const BROWN: Rgb = hex(0x8A_6A4A);
/// Exposed to rain and sun: silver.
pub(in crate::textures) const SILVER: Rgb = hex(0x9C_9890);
/// Silver with fungus.
pub(in crate::textures) const DARK: Rgb = hex(0x5F_5B55);

/// The appearance of wood at a point.
#[derive(Clone, Copy)]
pub(in crate::textures) struct Wood {
    /// 0 in the pale earlywood, 1 in the dark, hard latewood at the end of a ring.
    pub(in crate::textures) late: f64,
    /// Fine fibres along the grain, about -1..1.
    pub(in crate::textures) fibre: f64,
    /// 1 in a drying crack.
    pub(in crate::textures) check: f64,
    /// 1 in the heart of a knot.
    pub(in crate::textures) knot: f64,
}

impl Wood {
    /// Returns the height, metres: earlywood erodes, latewood stands proud.
    pub(in crate::textures) fn height(&self, relief: f64) -> f64 {
        relief * (self.late + 0.35 * self.fibre - 2.5 * self.check + self.knot)
    }

    /// Returns the colour between a pale and a dark tone.
    pub(in crate::textures) fn color(&self, early: Rgb, late: Rgb) -> Rgb {
        let ringed = mix(early, late, self.late * 0.85);
        let fibred = scale(ringed, 1.0 + 0.10 * self.fibre);
        let cracked = mix(fibred, scale(late, 0.45), self.check * 0.8);
        mix(cracked, scale(late, 0.62), self.knot * 0.8)
    }

    /// Returns the colours fresh, browned, silver, and dark with fungus. `cloud` (about -1..1) varies between rain and
    /// shelter; `tone` -1..1 belongs to the piece.
    pub(in crate::textures) fn ages(&self, cloud: f64, tone: f64) -> [Rgb; 4] {
        let lift = 1.0 + 0.09 * tone;
        let of =
            |pale: Rgb, dark: f64| scale(self.color(scale(pale, 1.06), scale(pale, dark)), lift);
        let (fresh, brown) = (of(FRESH, 0.74), of(BROWN, 0.66));
        let silver = mix(of(SILVER, 0.70), brown, 0.30 * smooth(-0.1, 0.9, cloud));
        let spots = smooth(0.05, 0.6, 0.7 * self.fibre - cloud);
        let dark = mix(of(DARK, 0.70), hex(0x2E_2C2A), 0.5 * spots);
        [fresh, brown, silver, dark]
    }
}

/// Returns the profile of one year: slowly darker, then sharply pale again.
fn ring(phase: f64) -> f64 {
    let year = phase - floor(phase) as f64;
    let dark = smooth(0.30, 0.86, year);
    dark * dark * (1.0 - smooth(0.88, 1.0, year))
}

/// Adds fibres and cracks; `along` and `across` are fractions of the repeat.
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

/// A continuous face without joints, cut alternately along the rings (masame: straight lines) and through them (itame:
/// arches).
#[derive(Clone, Copy)]
pub(in crate::textures) struct Face {
    /// Number of log hearts side by side in one repeat, with arches over each; 0 = sawn along the rings.
    pub(in crate::textures) hearts: u32,
    /// Number of rings in one repeat.
    pub(in crate::textures) rings: u32,
    /// Displacement of rings, in rings: small values keep them straight, large ones open arches.
    pub(in crate::textures) arches: f64,
    /// Frequency of the alternation.
    pub(in crate::textures) turns: Period,
    /// Knots in one repeat, as lattice cells; most stay empty.
    pub(in crate::textures) knots: Option<Period>,
    /// Seed of the random layer.
    pub(in crate::textures) seed: u32,
}

impl Face {
    /// Returns the wood at a point; `along` and `across` are fractions of the repeat.
    pub(in crate::textures) fn wood(&self, along: f64, across: f64, metres: f64) -> Wood {
        let seed = self.seed;
        let rings = f64::from(self.rings);
        let straight = if self.hearts == 0 {
            across * rings
        } else {
            let hearts = f64::from(self.hearts);
            let sway = 0.08 * noise(across, along, (3, 1), seed ^ 5);
            let turn = libm::cos(std::f64::consts::TAU * (across * hearts + sway));
            turn * rings / (4.0 * hearts)
        };
        let push = self.arches * noise(across, along, self.turns, seed);
        let bend = 0.9 * fbm(across, along, (4, 1), 2, seed ^ 1);
        // No two years are alike.
        let years = 0.32 * noise(across, along, (23, 1), seed ^ 3)
            + 0.06 * noise(across, along, (40, 7), seed ^ 2);
        let (knot, swirl) = self.knot(along, across, metres);
        let late = ring(straight + push + bend + years + swirl);
        texture(along, across, late * (1.0 - knot), knot, seed)
    }

    /// Returns the strength of a knot here, and how many rings it displaces.
    fn knot(&self, along: f64, across: f64, metres: f64) -> (f64, f64) {
        let Some((nx, ny)) = self.knots else {
            return (0.0, 0.0);
        };
        let (cx, cy) = (floor(across * f64::from(nx)), floor(along * f64::from(ny)));
        let (wx, wy) = (wrap(cx, i64::from(nx)), wrap(cy, i64::from(ny)));
        let chance = |salt: u32| hash(wx, wy, self.seed.wrapping_mul(7).wrapping_add(salt));
        if chance(1) > 0.2 {
            return (0.0, 0.0);
        }
        let x = (across - (cx as f64 + 0.3 + 0.4 * chance(2)) / f64::from(nx)) * metres;
        let y = (along - (cy as f64 + 0.3 + 0.4 * chance(3)) / f64::from(ny)) * metres;
        knot_at(x, y, 0.006 + 0.008 * chance(4))
    }
}

/// Returns the heart of a knot of this radius at `x` across and `y` along in metres, and its displacement of rings.
fn knot_at(x: f64, y: f64, size: f64) -> (f64, f64) {
    let round = (x * x + y * y * 0.45).sqrt();
    let swirl = 3.0 * libm::exp(-(round * round) / (size * size * 6.0));
    (1.0 - smooth(size * 0.6, size, round), swirl)
}

/// A board sawn flat (itame) from a log: the rings open into arches.
#[derive(Clone, Copy)]
pub(in crate::textures) struct Board {
    /// Number of the board, the seed of its variation.
    pub(in crate::textures) id: i64,
    /// Width, metres.
    pub(in crate::textures) width: f64,
    /// Length of the repeat, metres.
    pub(in crate::textures) length: f64,
    /// Seed of the random layer.
    pub(in crate::textures) seed: u32,
}

impl Board {
    /// Returns a pseudo-random number in 0..1 for the board.
    pub(in crate::textures) fn chance(&self, salt: u32) -> f64 {
        hash(self.id, 7, self.seed ^ salt.wrapping_mul(0x9E37))
    }

    /// Returns the board's lightness relative to its neighbours, -1..1.
    pub(in crate::textures) fn tone(&self) -> f64 {
        2.0 * self.chance(8) - 1.0
    }

    /// Returns the wood at `at` (0..1 across the board) and `along` (fraction of the repeat), where `across` is the
    /// same place as a fraction of the repeat.
    pub(in crate::textures) fn wood(&self, along: f64, at: f64, across: f64) -> Wood {
        let own = self.seed.wrapping_add(self.id as u32 * 977);
        let heart = 0.5 + 0.9 * (self.chance(1) - 0.5);
        let x = (at - heart) * self.width;
        let bow = noise(0.5, along, (1, 1), own) + 0.5 * noise(0.5, along, (1, 2), own ^ 1);
        let depth = 0.012 + 0.035 * self.chance(2) + 0.055 * (bow + 0.7).abs();
        let wobble = 0.0018 * fbm(across, along, (16, 4), 2, own ^ 2);
        let (knot, swirl) = self.knot(along, at);
        let radius = (x * x * 1.6 + depth * depth).sqrt() + wobble;
        let late = ring(radius / (0.0046 + 0.0024 * self.chance(3)) + swirl);
        texture(along, across, late * (1.0 - knot), knot, own)
    }

    /// Returns the strength of a knot here, and how many rings it displaces.
    fn knot(&self, along: f64, at: f64) -> (f64, f64) {
        if self.chance(4) < 0.7 {
            return (0.0, 0.0);
        }
        let x = (at - 0.2 - 0.6 * self.chance(5)) * self.width;
        let gap = along - self.chance(6);
        let y = (gap - gap.round()) * self.length;
        knot_at(x, y, 0.007 + 0.008 * self.chance(7))
    }
}
