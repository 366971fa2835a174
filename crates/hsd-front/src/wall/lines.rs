//! Straight edges in a photograph: runs of pixels whose brightness changes in one direction, with their places between pixels.

use glam::{DVec2, dvec2};
use image::RgbImage;

/// The cosine of how far the directions of a run's pixels may differ: 22.5 degrees.
const ALIKE: f32 = 0.924;
/// The least change of a colour, levels a pixel.
const WEAK: f32 = 2.0;
/// The largest deviation of a run across its direction, pixels, and the part of its length that comes on top (bent lines).
const WIDE: (f64, f64) = (1.6, 0.012);

/// A run of edge pixels.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Its places, one a pixel of its length, in order.
    pub places: Vec<DVec2>,
    /// How much the brightness changes, levels a pixel, on average.
    pub step: f64,
}

impl Edge {
    /// Edges that lie on one line, as one.
    pub fn joined<'e>(edges: impl Iterator<Item = &'e Edge> + Clone) -> Edge {
        let length: f64 = edges.clone().map(Edge::length).sum();
        let step = edges.clone().map(|e| e.step * e.length()).sum::<f64>() / length.max(1.0);
        let mut places: Vec<DVec2> = edges.flat_map(|e| e.places.iter().copied()).collect();
        let reach = |axis: usize| {
            let each = places.iter().map(|p| p[axis]);
            each.clone().fold(f64::NEG_INFINITY, f64::max) - each.fold(f64::INFINITY, f64::min)
        };
        let axis = usize::from(reach(1) > reach(0));
        places.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
        Edge { places, step }
    }

    /// Its ends.
    pub fn ends(&self) -> (DVec2, DVec2) {
        let first = self.places.first().copied().unwrap_or_default();
        (first, self.places.last().copied().unwrap_or(first))
    }

    /// Its length, pixels.
    pub fn length(&self) -> f64 {
        let (a, b) = self.ends();
        a.distance(b)
    }
}

/// The three colours of a picture, levels, softened by a pixel. An edge is seen in the one that changes most: white
/// trims against a bright sky are as bright as it.
pub struct Tones {
    /// Pixels of a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    tones: Vec<[f32; 3]>,
}

impl Tones {
    /// The colours of a picture.
    pub fn of(picture: &RgbImage) -> Tones {
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let tones: Vec<[f32; 3]> = picture.pixels().map(|p| p.0.map(f32::from)).collect();
        let mut tones = Tones {
            width,
            height,
            tones,
        };
        tones.soften();
        tones
    }

    /// Weighs each pixel with its neighbours, 1 4 6 4 1 in both directions.
    fn soften(&mut self) {
        const WEIGHTS: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];
        let (width, height) = (self.width, self.height);
        let near = |i: usize, k: usize, n: usize| (i + k).saturating_sub(2).min(n - 1);
        let weighed = |of: &dyn Fn(usize) -> [f32; 3]| {
            (0..5).fold([0.0; 3], |sum, k| {
                let tone = of(k);
                [0, 1, 2].map(|c| sum[c] + WEIGHTS[k] * tone[c])
            })
        };
        let mut across = vec![[0.0; 3]; self.tones.len()];
        for y in 0..height {
            let row = &self.tones[y * width..(y + 1) * width];
            for x in 0..width {
                across[y * width + x] = weighed(&|k| row[near(x, k, width)]);
            }
        }
        for y in 0..height {
            for x in 0..width {
                self.tones[y * width + x] = weighed(&|k| across[near(y, k, height) * width + x]);
            }
        }
    }

    /// The change at a pixel, towards the lighter side, of the colour that changes most.
    fn change(&self, x: usize, y: usize) -> (f32, f32) {
        if x == 0 || y == 0 || x + 1 >= self.width || y + 1 >= self.height {
            return (0.0, 0.0);
        }
        let at = y * self.width + x;
        let t = &self.tones;
        let each = [0, 1, 2].map(|c| {
            (
                (t[at + 1][c] - t[at - 1][c]) / 2.0,
                (t[at + self.width][c] - t[at - self.width][c]) / 2.0,
            )
        });
        let size = |(x, y): (f32, f32)| x * x + y * y;
        each.into_iter().fold(
            (0.0, 0.0),
            |most, one| if size(one) > size(most) { one } else { most },
        )
    }
}

/// The edges of a picture of at least so many pixels, the longest first.
pub fn edges(tones: &Tones, shortest: f64) -> Vec<Edge> {
    let (width, height) = (tones.width, tones.height);
    let mut changes = vec![(0.0_f32, 0.0_f32, 0.0_f32); width * height];
    let mut order: Vec<u32> = vec![];
    for y in 0..height {
        for x in 0..width {
            let (gx, gy) = tones.change(x, y);
            let size = (gx * gx + gy * gy).sqrt();
            if size >= WEAK {
                changes[y * width + x] = (gx / size, gy / size, size);
                order.push((y * width + x) as u32);
            }
        }
    }
    // Strong ones first; equal ones as they lie.
    order.sort_by(|a, b| changes[*b as usize].2.total_cmp(&changes[*a as usize].2));
    let mut used = vec![false; width * height];
    let mut found = vec![];
    for start in order {
        if !used[start as usize] {
            let run = grown(start, &changes, &mut used, (width, height));
            found.extend(edge(&run, &changes, width).filter(|edge| edge.length() >= shortest));
        }
    }
    found.sort_by(|a, b| b.length().total_cmp(&a.length()));
    found
}

/// The pixels next to each other that change in the direction of the first.
fn grown(
    start: u32,
    changes: &[(f32, f32, f32)],
    used: &mut [bool],
    (width, height): (usize, usize),
) -> Vec<u32> {
    let mut run = vec![start];
    used[start as usize] = true;
    let (mut sx, mut sy) = (changes[start as usize].0, changes[start as usize].1);
    let mut next = 0;
    while next < run.len() {
        let (x, y) = (run[next] as usize % width, run[next] as usize / width);
        next += 1;
        for (nx, ny) in around(x, y, width, height) {
            let at = ny * width + nx;
            let (gx, gy, size) = changes[at];
            let along = (gx * sx + gy * sy) / (sx * sx + sy * sy).sqrt();
            if !used[at] && size > 0.0 && along > ALIKE {
                used[at] = true;
                run.push(at as u32);
                sx += gx;
                sy += gy;
            }
        }
    }
    run
}

fn around(x: usize, y: usize, width: usize, height: usize) -> impl Iterator<Item = (usize, usize)> {
    let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
    rows.flat_map(move |ny| (x.saturating_sub(1)..=(x + 1).min(width - 1)).map(move |nx| (nx, ny)))
}

/// The edge that a run of pixels forms, if they lie along a line.
fn edge(run: &[u32], changes: &[(f32, f32, f32)], width: usize) -> Option<Edge> {
    if run.len() < 8 {
        return None;
    }
    let places: Vec<(DVec2, f64)> = run
        .iter()
        .map(|at| {
            let (x, y) = (*at as usize % width, *at as usize / width);
            let size = f64::from(changes[*at as usize].2);
            (dvec2(x as f64 + 0.5, y as f64 + 0.5), size)
        })
        .collect();
    let all: f64 = places.iter().map(|p| p.1).sum();
    let middle = places.iter().map(|p| p.0 * p.1).sum::<DVec2>() / all;
    let along = direction(&places, middle)?;
    let across = along.perp();
    let reach = |p: &(DVec2, f64)| (p.0 - middle).dot(along);
    let first = places.iter().map(reach).fold(f64::INFINITY, f64::min);
    let last = places.iter().map(reach).fold(f64::NEG_INFINITY, f64::max);
    let off = places
        .iter()
        .map(|p| p.1 * (p.0 - middle).dot(across).powi(2))
        .sum::<f64>()
        / all;
    if off.sqrt() > WIDE.0 + WIDE.1 * (last - first) {
        return None;
    }
    let mut bins = vec![(0.0, 0.0, 0.0); (last - first) as usize + 1];
    for p in &places {
        let bin = &mut bins[(reach(p) - first) as usize];
        bin.0 += p.1;
        bin.1 += p.1 * (p.0 - middle).dot(across);
        bin.2 += p.1 * reach(p);
    }
    let on_line = bins.iter().filter(|bin| bin.0 > 0.0);
    let places: Vec<DVec2> = on_line
        .map(|(weight, off, t)| middle + along * (t / weight) + across * (off / weight))
        .collect();
    (places.len() > 4).then_some(Edge {
        places,
        step: all / run.len() as f64,
    })
}

/// The direction in which weighted places lie, to the right or down.
fn direction(places: &[(DVec2, f64)], middle: DVec2) -> Option<DVec2> {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (p, weight) in places {
        let d = *p - middle;
        xx += weight * d.x * d.x;
        xy += weight * d.x * d.y;
        yy += weight * d.y * d.y;
    }
    // The eigenvector of the larger eigenvalue.
    let half = (xx - yy) / 2.0;
    let root = (half * half + xy * xy).sqrt();
    let along = match half > 0.0 {
        true => dvec2(half + root, xy),
        false => dvec2(xy, root - half),
    };
    let along = along.try_normalize()?;
    Some(if along.x + along.y < 0.0 {
        -along
    } else {
        along
    })
}
