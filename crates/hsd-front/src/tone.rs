//! Linear light and the light on a wall.

use std::sync::LazyLock;

/// sRGB levels as linear light.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|level| {
        let s = level as f64 / 255.0;
        let c = match s <= 0.040_45 {
            true => s / 12.92,
            false => libm::pow((s + 0.055) / 1.055, 2.4),
        };
        c as f32
    })
});

/// Levels of linear light, in steps of 1/8192.
static LEVELS: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let level = |k: usize| {
        let c = k as f64 / 8192.0;
        let s = match c <= 0.003_130_8 {
            true => 12.92 * c,
            false => 1.055 * libm::pow(c, 1.0 / 2.4) - 0.055,
        };
        (s * 255.0).round() as u8
    };
    (0..=8192).map(level).collect()
});

/// Linear light of a colour.
pub fn linear(levels: [u8; 3]) -> [f32; 3] {
    levels.map(|level| LINEAR[usize::from(level)])
}

/// The levels of linear light.
pub fn levels(tone: [f32; 3]) -> [u8; 3] {
    tone.map(|c| LEVELS[(c.clamp(0.0, 1.0) * 8192.0 + 0.5) as usize])
}

/// How light changes over a wall: the logarithm is a polynomial of the second degree in places from the middle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// Of across, down, and their products: across twice, both, down twice.
    pub slopes: [f64; 5],
}

/// The least and the most by which light is corrected.
pub const CORRECTED: (f64, f64) = (0.5, 3.0);

/// A part as it is seen: its group, its place across and down, and the logarithm of its brightness.
pub type Seen = (usize, f64, f64, f64);

impl Light {
    /// The logarithm of the light at a place, parts of the wall from its upper left corner.
    pub fn at(&self, u: f64, v: f64) -> f64 {
        terms(u, v)
            .iter()
            .zip(self.slopes)
            .map(|(t, s)| t * s)
            .sum()
    }

    /// What colours at a place are to be multiplied by.
    pub fn correction(&self, u: f64, v: f64) -> f64 {
        libm::exp(-self.at(u, v)).clamp(CORRECTED.0, CORRECTED.1)
    }

    /// The light that explains brightnesses best: group, place, logarithm. What is of one group would be equally bright.
    pub fn fitted(seen: &[Seen]) -> Light {
        let groups = seen.iter().map(|s| s.0 + 1).max().unwrap_or(0);
        let mean = |of: &dyn Fn(&Seen) -> f64, group: usize| {
            let own: Vec<f64> = seen.iter().filter(|s| s.0 == group).map(of).collect();
            own.iter().sum::<f64>() / own.len().max(1) as f64
        };
        // Within its group only: differences from its means.
        let mut sums = [[0.0; 6]; 5];
        for group in 0..groups {
            let middle: [f64; 5] = std::array::from_fn(|k| mean(&|s| terms(s.1, s.2)[k], group));
            let level = mean(&|s| s.3, group);
            for s in seen.iter().filter(|s| s.0 == group) {
                let all = terms(s.1, s.2);
                let off: [f64; 5] = std::array::from_fn(|k| all[k] - middle[k]);
                for (i, row) in sums.iter_mut().enumerate() {
                    for j in 0..5 {
                        row[j] += off[i] * off[j];
                    }
                    row[5] += off[i] * (s.3 - level);
                }
            }
        }
        // Little is known from few parts: no slope rather than a steep one.
        for (k, row) in sums.iter_mut().enumerate() {
            row[k] += if k < 2 { 1e-3 } else { 1e-2 };
        }
        let slopes = super::camera::solved(sums).unwrap_or_default();
        Light { slopes }
    }
}

fn terms(u: f64, v: f64) -> [f64; 5] {
    let (u, v) = (u - 0.5, v - 0.5);
    [u, v, u * u, u * v, v * v]
}
