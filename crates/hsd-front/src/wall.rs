//! The rectangle of a facade in a photograph: four sides along edges that are parallel on the wall.

pub mod lines;
pub mod settled;
pub mod vanish;

use super::camera::Lens;
use super::rectify::between;
use glam::{DMat3, DVec2, dvec2};
use hsd_scan::raster::project;
use image::RgbImage;
use image::imageops;
use lines::Tones;
use settled::{Known, settled};
use vanish::Straight;

/// The longer side of the picture in which edges are looked for, pixels.
const SMALL: f64 = 1400.0;
/// The shortest edges, as a part of that.
const SHORTEST: f64 = 0.012;
/// The sine of how far an edge of the wall may be turned.
const TURN: f64 = 0.02;
/// Edges on one line: how far they lie apart, as a part of the wall that is seen.
pub(super) const APART: f64 = 0.0022;
/// The most lines of one direction that may be sides.
const SIDES: usize = 56;
/// The least part of a side along which there is an edge.
const LEAST: f64 = 0.08;
/// The least part of a side that is seen for it to be moved onto its edge: otherwise the edges of the whole wall know better.
const CLEAR: f64 = 0.35;
/// Places along a side at which its edge is looked for.
const PLACES: usize = 140;
/// How far off it is looked for, as a part of the longer side of the photograph.
const NEAR: f64 = 0.0022;

/// What was found of a wall.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    /// Its corners in the photograph, clockwise from the upper left, pixels.
    pub corners: [DVec2; 4],
    /// The same in the straight picture, in which they may lie where the lens shows nothing.
    pub straight: [DVec2; 4],
    /// The lens.
    pub lens: Lens,
    /// How far the sides are seen, 0 to 1.
    pub trust: f64,
}

/// Why there is no wall: what was looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lost {
    /// Fewer long edges than a wall has; so many were found.
    Edges(usize),
    /// Edges that meet nowhere, in one of the two directions.
    Meeting,
    /// No four sides; the best are seen so far, 0 to 1.
    Sides(f64),
}

/// The edges of a photograph, in its pixels.
pub fn edges(photo: &RgbImage) -> Vec<lines::Edge> {
    let longest = f64::from(photo.width().max(photo.height()));
    let shrink = (longest / SMALL).max(1.0);
    let side = |s: u32| ((f64::from(s) / shrink).round() as u32).max(1);
    let (width, height) = (side(photo.width()), side(photo.height()));
    let small;
    let picture = match shrink > 1.0 {
        true => {
            small = imageops::thumbnail(photo, width, height);
            &small
        }
        false => photo,
    };
    let by = dvec2(
        f64::from(photo.width()) / f64::from(width),
        f64::from(photo.height()) / f64::from(height),
    );
    let mut edges = lines::edges(&Tones::of(picture), SHORTEST * SMALL.min(longest));
    edges
        .iter_mut()
        .flat_map(|e| &mut e.places)
        .for_each(|p| *p *= by);
    edges
}

/// Finds the wall in a photograph.
///
/// # Errors
/// If there are no edges of a wall; with what was found.
pub fn find(
    photo: &RgbImage,
    edges: &[lines::Edge],
    lens: &Lens,
    known: Known,
) -> Result<Wall, Lost> {
    if edges.len() < 12 {
        return Err(Lost::Edges(edges.len()));
    }
    let (lens, straight, plane) = settled(edges, *lens, known).ok_or(Lost::Meeting)?;
    let [across, down] = sorted(&straight, plane);
    let (sides, shares) = rectangle(&across, &down).ok_or(Lost::Sides(0.0))?;
    let trust = shares.into_iter().fold(1.0, f64::min);
    if trust < LEAST {
        return Err(Lost::Sides(trust));
    }
    let [left, top, right, bottom] = sides;
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
    let back = plane.inverse();
    let rough = corners.map(|(u, v)| project(back, dvec2(u, v)));
    let straight = refined(photo, &lens, rough, shares.map(|s| s > CLEAR));
    Ok(Wall {
        corners: straight.map(|p| lens.bent(p)),
        straight,
        lens,
        trust,
    })
}

/// An edge on the wall: where it lies across its direction, from where to where along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    pub(super) at: f64,
    pub(super) from: f64,
    pub(super) to: f64,
}

/// The edges of the wall, those that run across it and those that run down.
pub(super) fn sorted(edges: &[Straight], plane: DMat3) -> [Vec<Stroke>; 2] {
    let mut found = [vec![], vec![]];
    for edge in edges {
        let before = |p: DVec2| (plane * p.extend(1.0)).z > 0.05;
        if !before(edge.a) || !before(edge.b) {
            continue;
        }
        let (a, b) = (project(plane, edge.a), project(plane, edge.b));
        let way = (b - a).normalize_or_zero();
        let middle = (a + b) / 2.0;
        if way.y.abs() < TURN {
            found[0].push(Stroke {
                at: middle.y,
                from: a.x.min(b.x),
                to: a.x.max(b.x),
            });
        } else if way.x.abs() < TURN {
            found[1].push(Stroke {
                at: middle.x,
                from: a.y.min(b.y),
                to: a.y.max(b.y),
            });
        }
    }
    found
}

/// Edges on one line of the wall.
#[derive(Clone, Copy, Debug)]
struct Line {
    at: f64,
    /// Where it is seen: a bit for each part of what is seen of the wall along it.
    seen: u128,
}

impl Line {
    /// How much of what is seen of it lies beyond two parts, 0 to 1.
    fn beyond(&self, from: u32, to: u32) -> f64 {
        let bits = (u128::MAX >> (127 - (to - from))) << from;
        f64::from((self.seen & !bits).count_ones()) / f64::from(self.seen.count_ones().max(1))
    }

    /// How much of it is seen between two parts, 0 to 1.
    fn share(&self, from: u32, to: u32) -> f64 {
        let bits = (u128::MAX >> (127 - (to - from))) << from;
        f64::from((self.seen & bits).count_ones()) / f64::from(to - from + 1)
    }
}

/// The lines on which edges lie, the best seen ones, in order; `reach` is what is seen of the wall along them.
fn joined(strokes: &[Stroke], reach: (f64, f64), apart: f64) -> Vec<Line> {
    let near = |at: f64| strokes.iter().filter(move |s| (s.at - at).abs() < apart);
    let mut lines: Vec<Line> = strokes
        .iter()
        .filter_map(|s| line(near(s.at), reach))
        .collect();
    lines.sort_by(|a, b| {
        (b.seen.count_ones().cmp(&a.seen.count_ones())).then(a.at.total_cmp(&b.at))
    });
    let mut kept: Vec<Line> = vec![];
    for line in lines {
        if kept.len() < SIDES && kept.iter().all(|k| (k.at - line.at).abs() > 1.2 * apart) {
            kept.push(line);
        }
    }
    kept.sort_by(|a, b| a.at.total_cmp(&b.at));
    kept
}

fn line<'s>(strokes: impl Iterator<Item = &'s Stroke> + Clone, reach: (f64, f64)) -> Option<Line> {
    let length = |s: &Stroke| s.to - s.from;
    let all: f64 = strokes.clone().map(length).sum();
    let at = strokes.clone().map(|s| s.at * length(s)).sum::<f64>() / all;
    let seen = strokes.fold(0, |seen, s| {
        let (a, b) = (part(s.from, reach), part(s.to, reach));
        seen | (u128::MAX >> (127 - (b - a))) << a
    });
    at.is_finite().then_some(Line { at, seen })
}

/// The part, of 128, in which a place along a line lies.
fn part(at: f64, (from, to): (f64, f64)) -> u32 {
    ((at - from) / (to - from) * 128.0).clamp(0.0, 127.0) as u32
}

/// The rectangle whose sides are seen best, and that holds most: left, top, right, bottom; and how far its sides are seen: upper,
/// right, lower, left.
fn rectangle(across: &[Stroke], down: &[Stroke]) -> Option<([f64; 4], [f64; 4])> {
    let reach = |along: &[Stroke], over: &[Stroke]| {
        let ends = along
            .iter()
            .flat_map(|s| [s.from, s.to])
            .chain(over.iter().map(|s| s.at));
        ends.fold((f64::INFINITY, f64::NEG_INFINITY), |r, t| {
            (r.0.min(t), r.1.max(t))
        })
    };
    let (us, vs) = (reach(across, down), reach(down, across));
    let apart = APART * (us.1 - us.0).max(vs.1 - vs.0);
    let rows = joined(across, us, apart);
    let columns = joined(down, vs, apart);
    let (sides, shares) = chosen(&columns, &rows, us, vs)?;
    Some((widened(sides, &columns, &rows, us, vs), shares))
}

/// The best rectangle of lines down and lines across.
fn chosen(
    columns: &[Line],
    rows: &[Line],
    us: (f64, f64),
    vs: (f64, f64),
) -> Option<([f64; 4], [f64; 4])> {
    let mut best: Option<([f64; 4], f64, [f64; 4])> = None;
    for (i, left) in columns.iter().enumerate() {
        for right in &columns[i + 1..] {
            let (u0, u1) = (part(left.at, us), part(right.at, us));
            if u1 < u0 + 12 {
                continue;
            }
            for (j, top) in rows.iter().enumerate() {
                let upper = top.share(u0, u1);
                if upper < LEAST {
                    continue;
                }
                for bottom in &rows[j + 1..] {
                    let (v0, v1) = (part(top.at, vs), part(bottom.at, vs));
                    if v1 < v0 + 12 {
                        continue;
                    }
                    let shares = [
                        upper,
                        bottom.share(u0, u1),
                        left.share(v0, v1),
                        right.share(v0, v1),
                    ];
                    let least = shares.into_iter().fold(1.0, f64::min);
                    let mean = shares.into_iter().sum::<f64>() / 4.0;
                    let area = f64::from(u1 - u0) * f64::from(v1 - v0) / (128.0 * 128.0);
                    let over =
                        left.beyond(v0, v1) + right.beyond(v0, v1) + 0.3 * top.beyond(u0, u1);
                    let score = mean + least + AREA * area.sqrt() - OVER * over;
                    if best.is_none_or(|b| score > b.1) {
                        let [upper, lower, west, east] = shares;
                        best = Some((
                            [left.at, top.at, right.at, bottom.at],
                            score,
                            [upper, east, lower, west],
                        ));
                    }
                }
            }
        }
    }
    best.map(|(sides, _, shares)| (sides, shares))
}

/// A rectangle whose sides lie on the outermost of the lines beside them: a wall ends where its cornice and its foot end.
fn widened(
    sides: [f64; 4],
    columns: &[Line],
    rows: &[Line],
    us: (f64, f64),
    vs: (f64, f64),
) -> [f64; 4] {
    let [left, top, right, bottom] = sides;
    let (u0, u1) = (part(left, us), part(right, us));
    let (v0, v1) = (part(top, vs), part(bottom, vs));
    // The lines that end at the side go on to where the wall ends.
    let goes_on = |crossing: [f64; 2], lines: &[Line], from: u32, to: u32| {
        let on = |at: f64| lines.iter().filter(move |l| (l.at - at).abs() < 1e-9);
        let (from, to) = (from.min(to), from.max(to));
        crossing
            .into_iter()
            .flat_map(on)
            .any(|l| l.share(from, to) > 0.6)
    };
    let outer = |lines: &[Line],
                 at: f64,
                 sign: f64,
                 of: f64,
                 within: (u32, u32),
                 goes_on: &dyn Fn(f64) -> bool| {
        let beside = lines
            .iter()
            .filter(|l| (l.at - at) * sign > 0.0 && (l.at - at).abs() < BESIDE * of);
        let seen = beside.filter(|l| l.share(within.0, within.1) > OUTER && goes_on(l.at));
        seen.map(|l| l.at * sign).fold(at * sign, f64::max) * sign
    };
    let (width, height) = (right - left, bottom - top);
    let up =
        |from: f64| move |at: f64| goes_on([left, right], columns, part(from, vs), part(at, vs));
    let aside = |from: f64| move |at: f64| goes_on([top, top], rows, part(from, us), part(at, us));
    [
        outer(columns, left, -1.0, width, (v0, v1), &aside(left)),
        outer(rows, top, -1.0, height, (u0, u1), &up(top)),
        outer(columns, right, 1.0, width, (v0, v1), &aside(right)),
        outer(rows, bottom, 1.0, height, (u0, u1), &up(bottom)),
    ]
}

/// How far beside a side another line may be its outer edge, as a part of the wall.
const BESIDE: f64 = 0.05;
/// The least part of such a line that is seen.
const OUTER: f64 = 0.4;
/// How much it counts against a rectangle that its sides go on beyond it.
const OVER: f64 = 1.0;
/// How much a rectangle that holds everything is worth beside sides that are seen whole.
const AREA: f64 = 3.0;

/// Corners of the straight picture, moved so that the clear sides (upper, right, lower, left) lie on the edges beside them.
fn refined(photo: &RgbImage, lens: &Lens, corners: [DVec2; 4], clear: [bool; 4]) -> [DVec2; 4] {
    let sides: [Option<(DVec2, DVec2)>; 4] = std::array::from_fn(|k| {
        clear[k].then(|| side(photo, lens, corners[k], corners[(k + 1) % 4]))?
    });
    let line = |k: usize| {
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        sides[k].unwrap_or((a, b - a))
    };
    std::array::from_fn(|k| {
        let ((a, d), (b, e)) = (line((k + 3) % 4), line(k));
        let cross = d.perp_dot(e);
        match cross.abs() > 1e-9 {
            true => a + d * ((b - a).perp_dot(e) / cross),
            false => corners[k],
        }
    })
}

/// The line of the edge that is seen beside a side, in the straight picture: a point and a direction.
fn side(photo: &RgbImage, lens: &Lens, a: DVec2, b: DVec2) -> Option<(DVec2, DVec2)> {
    let longest = f64::from(photo.width().max(photo.height()));
    let near = (NEAR * longest).max(2.5);
    let out = (b - a).try_normalize()?.perp();
    let mut offs: Vec<(f64, f64)> = vec![];
    for k in 0..PLACES {
        let t = 0.015 + 0.97 * (k as f64 + 0.5) / PLACES as f64;
        let at = a.lerp(b, t);
        offs.extend(
            peaks(photo, lens, at, out, near)
                .into_iter()
                .map(|off| (t, off)),
        );
    }
    let line = most(&offs, near)?;
    let kept: Vec<DVec2> = offs
        .iter()
        .filter(|(t, off)| (off - line.0 - line.1 * t).abs() < 1.0)
        .map(|(t, off)| a.lerp(b, *t) + out * *off)
        .collect();
    (kept.len() * 4 > PLACES).then(|| {
        let (middle, along, _) = vanish::through(&kept);
        (middle, along)
    })
}

/// How far from a place brightness changes most, pixels along a direction; up to three such places.
fn peaks(photo: &RgbImage, lens: &Lens, at: DVec2, out: DVec2, near: f64) -> Vec<f64> {
    let steps = (2.0 * near).ceil() as i32;
    let tone = |k: i32| {
        let p = lens.bent(at + out * (f64::from(k) / 2.0));
        (p.x >= 0.0
            && p.y >= 0.0
            && p.x < f64::from(photo.width())
            && p.y < f64::from(photo.height()))
        .then(|| between(photo, p))
    };
    let tones: Option<Vec<[f32; 3]>> = (-steps - 3..=steps + 3).map(tone).collect();
    let Some(tones) = tones else {
        return vec![];
    };
    // Differences over a pixel and a half: softened by what a lens and a sensor soften.
    let change: Vec<f64> = (3..tones.len() - 3)
        .map(|i| {
            let each = [0, 1, 2].map(|c| {
                let t = |k: usize| f64::from(tones[k][c]);
                (t(i + 1) - t(i - 1) + t(i + 2) - t(i - 2) + t(i + 3) - t(i - 3)).abs()
            });
            each.into_iter().fold(0.0, f64::max)
        })
        .collect();
    let mut found: Vec<(f64, f64)> = vec![];
    for i in 1..change.len().saturating_sub(1) {
        let (l, m, r) = (change[i - 1], change[i], change[i + 1]);
        if m >= l && m > r && m > 12.0 {
            let bend = l - 2.0 * m + r;
            let off = if bend < 0.0 {
                (l - r) / (2.0 * bend)
            } else {
                0.0
            };
            found.push((m, (i as f64 + off) / 2.0 - f64::from(steps) / 2.0));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let strongest = found.first().map_or(0.0, |f| f.0);
    let strong = found.into_iter().filter(|f| f.0 > 0.4 * strongest).take(3);
    strong.map(|f| f.1).collect()
}

/// The line `off = c + s t` on which most places lie; where several have as many, the nearest to zero.
fn most(offs: &[(f64, f64)], near: f64) -> Option<(f64, f64)> {
    let mut best: Option<((f64, f64), f64)> = None;
    for (i, a) in offs.iter().enumerate().step_by(3) {
        for b in offs[i + 1..].iter().step_by(3) {
            if b.0 - a.0 < 0.3 {
                continue;
            }
            let slope = (b.1 - a.1) / (b.0 - a.0);
            let line = (a.1 - slope * a.0, slope);
            if line.0.abs() > near || (line.0 + slope).abs() > near {
                continue;
            }
            let count = offs.iter().map(|(t, off)| {
                let rest = (off - line.0 - slope * t) / 0.8;
                (1.0 - rest * rest).max(0.0)
            });
            let far = (line.0.abs() + (line.0 + slope).abs()) / near;
            let score = count.sum::<f64>() - 0.25 * far * PLACES as f64;
            if best.is_none_or(|b| score > b.1) {
                best = Some((line, score));
            }
        }
    }
    best.map(|b| b.0)
}
