//! Photographs of facades that are drawn so that all truth is known: a wall with its windows, seen through a lens in perspective,
//! with trees, wires and cars before it and uneven light on it. Nothing here uses the program.

use super::model::Straight;
use image::{Rgb, RgbImage};

/// Numbers that look random.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x1234_5678_9ABC_DEF1);
        (0..4).for_each(|_| {
            dice.next();
        });
        dice
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number from one to another.
    pub fn range(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() >> 33) as usize % n
    }

    /// A number of the bell curve, of unit width.
    pub fn bell(&mut self) -> f64 {
        (0..12).map(|_| self.range(0.0, 1.0)).sum::<f64>() - 6.0
    }
}

type Tone = [f64; 3];

/// What a bay of a storey shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Sashes,
    Curtained,
    Shuttered,
    Wall,
    Shop,
    Door,
    Pair,
}

/// A facade, in metres from its upper left corner.
#[derive(Clone, Debug)]
pub struct Facade {
    pub width: f64,
    pub height: f64,
    /// Lines between bays, with both ends.
    pub columns: Vec<f64>,
    /// Lines between storeys from above, with both ends.
    pub rows: Vec<f64>,
    /// Kinds by storey from above, from the left.
    pub kinds: Vec<Vec<Kind>>,
    wall: Tone,
    trim: Tone,
    glass: Tone,
    base: Tone,
    bands: bool,
    /// The wall of a model that stands for the drawn one.
    pub model: Option<Straight>,
}

impl Facade {
    pub fn new(seed: u64) -> Facade {
        let mut dice = Dice::new(seed);
        let bays = 3 + dice.below(5);
        let storeys = 3 + dice.below(4);
        let bay = dice.range(1.8, 3.2);
        let upper = dice.range(2.8, 3.5);
        let ground = upper * dice.range(1.1, 1.4);
        let columns: Vec<f64> = (0..=bays).map(|k| bay * k as f64).collect();
        let mut rows: Vec<f64> = (0..storeys).map(|k| upper * k as f64).collect();
        let height = upper * (storeys - 1) as f64 + ground;
        rows.push(height);
        let common = [Kind::Sashes, Kind::Pair][dice.below(2)];
        let other = [Kind::Curtained, Kind::Shuttered, Kind::Wall][dice.below(3)];
        let door = dice.below(bays);
        let odd = dice.below(bays);
        let kinds = (0..storeys)
            .map(|row| {
                let kind = |bay: usize| match row + 1 == storeys {
                    true if bay == door => Kind::Door,
                    true => Kind::Shop,
                    false if bay == odd => other,
                    false => common,
                };
                (0..bays).map(kind).collect()
            })
            .collect();
        let mut tone = |low: f64, high: f64, warm: f64| {
            let level = dice.range(low, high);
            [level, level * (1.0 - 0.5 * warm), level * (1.0 - warm)]
        };
        Facade {
            width: bay * bays as f64,
            height,
            columns,
            rows,
            kinds,
            wall: tone(0.30, 0.55, 0.3),
            trim: tone(0.55, 0.75, 0.1),
            glass: tone(0.03, 0.08, -0.3),
            base: tone(0.20, 0.32, 0.1),
            bands: !seed.is_multiple_of(3),
            model: None,
        }
    }

    /// The same with storeys of which no two are equally high.
    pub fn unlike(seed: u64) -> Facade {
        let mut facade = Facade::new(seed);
        let mut dice = Dice::new(seed ^ 0x5EED);
        let mut heights: Vec<f64> = facade.rows.windows(2).map(|r| r[1] - r[0]).collect();
        let count = heights.len();
        let first = dice.below(count);
        for (k, height) in heights.iter_mut().enumerate() {
            let rank = (k + first) % count;
            *height *= 0.78 + 0.5 * (rank as f64 + dice.range(0.1, 0.9)) / count as f64;
        }
        facade.rows = vec![0.0];
        for height in heights {
            facade
                .rows
                .push(facade.rows[facade.rows.len() - 1] + height);
        }
        facade.height = facade.rows[count];
        facade
    }

    /// The colour of a place, linear light; equal bays are equal.
    pub fn tone(&self, x: f64, y: f64) -> Tone {
        if let Some(model) = &self.model {
            return model.tone(x, y);
        }
        let row = self.rows[1..self.rows.len() - 1]
            .iter()
            .filter(|r| y >= **r)
            .count();
        let bay = self.columns[1..self.columns.len() - 1]
            .iter()
            .filter(|c| x >= **c)
            .count();
        let (left, right) = (self.columns[bay], self.columns[bay + 1]);
        let (top, bottom) = (self.rows[row], self.rows[row + 1]);
        let (u, v) = ((x - left) / (right - left), (y - top) / (bottom - top));
        let kind = self.kinds[row][bay];
        let band = (y - top) < 0.14 && self.bands;
        if band {
            return self.trim;
        }
        let inside = |u0: f64, u1: f64, v0: f64, v1: f64| u >= u0 && u < u1 && v >= v0 && v < v1;
        let grain = 1.0 + 0.06 * wave(9.0 * u, 7.0 * v);
        let wall = self.wall.map(|c| c * grain);
        match kind {
            Kind::Wall => wall,
            Kind::Shop => match inside(0.10, 0.90, 0.25, 0.88) {
                true if inside(0.13, 0.87, 0.28, 0.85) => shaded(self.glass, 1.5 + 2.0 * v),
                true => self.trim,
                false if v > 0.93 => self.base,
                false => wall,
            },
            Kind::Door => match inside(0.25, 0.75, 0.30, 1.0) {
                true if inside(0.30, 0.70, 0.35, 1.0) => {
                    [0.16, 0.07, 0.04].map(|c| c * (1.0 + 0.4 * wave(20.0 * u, 0.0)))
                }
                true => self.trim,
                false => wall,
            },
            Kind::Pair => match inside(0.12, 0.44, 0.25, 0.82) || inside(0.56, 0.88, 0.25, 0.82) {
                true if inside(0.15, 0.41, 0.28, 0.79) || inside(0.59, 0.85, 0.28, 0.79) => {
                    shaded(self.glass, 1.0 + 3.0 * v)
                }
                true => self.trim,
                false => wall,
            },
            Kind::Sashes | Kind::Curtained | Kind::Shuttered => {
                let frame = inside(0.22, 0.78, 0.22, 0.85);
                let pane = inside(0.25, 0.75, 0.25, 0.82);
                let bar = (u - 0.5).abs() < 0.015 || (v - 0.45).abs() < 0.012;
                match kind {
                    _ if !frame => wall,
                    _ if !pane => self.trim,
                    Kind::Shuttered => {
                        [0.10, 0.22, 0.13].map(|c| c * (1.0 + 0.5 * wave(0.0, 60.0 * v)))
                    }
                    _ if bar => self.trim,
                    Kind::Curtained if !(0.42..=0.58).contains(&u) => {
                        [0.5, 0.42, 0.33].map(|c| c * (1.0 + 0.2 * wave(40.0 * u, 0.0)))
                    }
                    _ => shaded(self.glass, 1.0 + 4.0 * v),
                }
            }
        }
    }
}

fn covered(before: &[(f64, f64, f64, Tone)], x: f64, y: f64) -> Option<Tone> {
    let is_over = |b: &&(f64, f64, f64, Tone)| (x - b.0).powi(2) + (y - b.1).powi(2) < b.2 * b.2;
    before.iter().rev().find(is_over).map(|b| b.3)
}

/// A wave from -1 to 1 without sines: parabolas.
fn wave(u: f64, v: f64) -> f64 {
    let t = (u + v).rem_euclid(2.0) - 1.0;
    1.0 - 2.0 * (1.0 - 4.0 * (t.abs() - 0.5).powi(2)).abs()
}

fn shaded(tone: Tone, by: f64) -> Tone {
    tone.map(|c| c * by)
}

/// How a photograph was taken.
#[derive(Clone, Debug)]
pub struct Shot {
    pub size: (u32, u32),
    pub focal: f64,
    pub bend: [f64; 2],
    /// Columns: the wall's directions across and down in the camera's frame, and its upper left corner, metres.
    pub pose: [[f64; 3]; 3],
    /// Blobs before the wall: middle and radius in pixels, and whether they are leaves or a car.
    pub before: Vec<(f64, f64, f64, Tone)>,
    /// How the light changes over the wall: across, down, and both squared.
    pub light: [f64; 4],
    pub noise: f64,
    /// From which its noise comes.
    pub seed: u64,
}

impl Shot {
    /// A photograph of a facade from the street, its longer side so many pixels.
    pub fn new(facade: &Facade, seed: u64, longest: u32, trees: usize) -> Shot {
        let mut dice = Dice::new(seed ^ 0xABCD);
        let size = (longest, longest * 3 / 4);
        let focal = f64::from(longest) * dice.range(0.75, 1.1);
        let (yaw, pitch, roll) = (
            dice.range(-0.45, 0.45),
            dice.range(-0.02, 0.20),
            dice.range(-0.025, 0.025),
        );
        let turn = |a: f64| (a.sin(), a.cos());
        let ((sy, cy), (sp, cp), (sr, cr)) = (turn(yaw), turn(pitch), turn(roll));
        // Camera frame: x right, y down, z forwards; the camera looks up by `pitch`.
        let rotate = |p: [f64; 3]| {
            let [x, y, z] = [cy * p[0] - sy * p[2], p[1], sy * p[0] + cy * p[2]];
            let [x, y, z] = [x, cp * y + sp * z, -sp * y + cp * z];
            [cr * x - sr * y, sr * x + cr * y, z]
        };
        let mut shot = Shot {
            size,
            focal,
            bend: [dice.range(-0.12, 0.02), dice.range(0.0, 0.03)],
            pose: [rotate([1.0, 0.0, 0.0]), rotate([0.0, 1.0, 0.0]), [0.0; 3]],
            before: vec![],
            light: [
                dice.range(-0.35, 0.35),
                dice.range(-0.2, 0.2),
                dice.range(-0.1, 0.1),
                0.0,
            ],
            noise: 0.006,
            seed,
        };
        // As near as the whole wall is in the picture.
        let mut away = facade.width.max(facade.height) * 0.5;
        for _ in 0..200 {
            let middle = rotate([0.0, 0.0, 0.0]);
            let back = [middle[0], middle[1], away];
            for (k, back) in back.into_iter().enumerate() {
                shot.pose[2][k] = back
                    - shot.pose[0][k] * facade.width / 2.0
                    - shot.pose[1][k] * facade.height / 2.0;
            }
            let margin = 0.04 * f64::from(longest);
            let is_in = shot.corners(facade).iter().all(|(x, y)| {
                *x > margin
                    && *y > margin
                    && *x < f64::from(size.0) - margin
                    && *y < f64::from(size.1) - margin
            });
            if is_in {
                break;
            }
            away *= 1.03;
        }
        let [_, _, right, left] = shot.corners(facade);
        for _ in 0..trees {
            let t = dice.range(0.05, 0.95);
            let (x, y) = (
                left.0 + (right.0 - left.0) * t,
                left.1 + (right.1 - left.1) * t,
            );
            let high = f64::from(size.1) * dice.range(0.10, 0.26);
            for _ in 0..26 {
                let (dx, dy) = (
                    dice.bell() * 0.022 * f64::from(longest),
                    -high + dice.bell() * 0.03 * f64::from(longest),
                );
                let green = dice.range(0.04, 0.14);
                shot.before.push((
                    x + dx,
                    y + dy,
                    dice.range(0.008, 0.016) * f64::from(longest),
                    [green * 0.5, green, green * 0.3],
                ));
            }
            for k in 0..12 {
                shot.before.push((
                    x,
                    y - high * f64::from(k) / 12.0,
                    0.004 * f64::from(longest),
                    [0.05, 0.035, 0.02],
                ));
            }
        }
        shot
    }

    /// The pixel of a place on the wall, metres from its upper left corner; the middle of the first pixel is at 0.5, 0.5.
    pub fn pixel(&self, x: f64, y: f64) -> (f64, f64) {
        let p: Vec<f64> = (0..3)
            .map(|k| self.pose[2][k] + self.pose[0][k] * x + self.pose[1][k] * y)
            .collect();
        let (u, v) = (p[0] / p[2], p[1] / p[2]);
        let r2 = u * u + v * v;
        let bent = 1.0 + r2 * (self.bend[0] + r2 * self.bend[1]);
        (
            f64::from(self.size.0) / 2.0 + self.focal * u * bent,
            f64::from(self.size.1) / 2.0 + self.focal * v * bent,
        )
    }

    /// The corners of the wall, clockwise from the upper left.
    pub fn corners(&self, facade: &Facade) -> [(f64, f64); 4] {
        let (w, h) = (facade.width, facade.height);
        [
            self.pixel(0.0, 0.0),
            self.pixel(w, 0.0),
            self.pixel(w, h),
            self.pixel(0.0, h),
        ]
    }

    /// The place on the wall that a pixel sees, if it does not see the sky behind it.
    fn wall(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (x, y) = (
            (x - f64::from(self.size.0) / 2.0) / self.focal,
            (y - f64::from(self.size.1) / 2.0) / self.focal,
        );
        let (mut u, mut v) = (x, y);
        for _ in 0..12 {
            let r2 = u * u + v * v;
            let bent = 1.0 + r2 * (self.bend[0] + r2 * self.bend[1]);
            (u, v) = (x / bent, y / bent);
        }
        // Solve pose * (a, b, 1) = s (u, v, 1).
        let [p, q, o] = self.pose;
        let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let ray = [u, v, 1.0];
        let all = det(p, q, ray);
        let minus = o.map(|c| -c);
        let s = det(p, q, minus) / all;
        (s < 0.0).then_some((det(minus, q, ray) / all, det(p, minus, ray) / all))
    }

    /// The light at a place of the wall.
    pub fn light_at(&self, facade: &Facade, x: f64, y: f64) -> f64 {
        let (u, v) = (x / facade.width - 0.5, y / facade.height - 0.5);
        1.0 + self.light[0] * u + self.light[1] * v + self.light[2] * (u * u + v * v)
    }

    fn seen(&self, facade: &Facade, before: &[(f64, f64, f64, Tone)], x: f64, y: f64) -> Tone {
        if let Some(tone) = covered(before, x, y) {
            return tone;
        }
        let Some((a, b)) = self.wall(x, y) else {
            return [0.45, 0.62, 0.85];
        };
        if a >= 0.0 && b >= 0.0 && a < facade.width && b < facade.height {
            let light = self.light_at(facade, a, b);
            return facade.tone(a, b).map(|c| c * light);
        }
        match b >= facade.height {
            true => [0.08, 0.08, 0.085].map(|c| c * (1.0 + 0.1 * wave(3.0 * a, 5.0 * b))),
            // Lower houses beside it.
            false if a < -0.05 * facade.width && b > facade.height * 0.45 => [0.25, 0.2, 0.18],
            false if a > 1.06 * facade.width && b > facade.height * 0.6 => [0.33, 0.33, 0.36],
            false => [0.55, 0.68, 0.88].map(|c| c * (1.0 + 0.1 * wave(0.3 * a, 0.2 * b))),
        }
    }

    /// The photograph.
    pub fn draw(&self, facade: &Facade) -> RgbImage {
        let mut dice = Dice::new(self.seed ^ 0x77);
        let mut row = u32::MAX;
        let mut before = vec![];
        RgbImage::from_fn(self.size.0, self.size.1, |x, y| {
            if y != row {
                row = y;
                let near = self
                    .before
                    .iter()
                    .filter(|b| (b.1 - f64::from(y)).abs() < b.2 + 1.0);
                before = near.copied().collect();
            }
            let mut sum = [0.0; 3];
            for k in 0..4 {
                let (dx, dy) = (
                    (f64::from(k % 2) + 0.5) / 2.0,
                    (f64::from(k / 2) + 0.5) / 2.0,
                );
                let tone = self.seen(facade, &before, f64::from(x) + dx, f64::from(y) + dy);
                sum.iter_mut().zip(tone).for_each(|(s, t)| *s += t / 4.0);
            }
            let noise = self.noise;
            Rgb(sum.map(|c| encoded(c + noise * dice.bell() * (c + 0.02).sqrt())))
        })
    }
}

/// sRGB of linear light.
pub fn encoded(c: f64) -> u8 {
    let c = c.clamp(0.0, 1.0);
    let s = if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    };
    (s * 255.0).round() as u8
}
