//! Moves the grid onto the posts of the plan, and onto the middle of thick walls.
//!
//! Strokes near a line of the grid are walls and the edges of mats that lie against them, always on the inner side: the
//! lines drift inwards with them. Posts stand in the middle.

use super::{Grid, Seen, dark_at, fitted};
use crate::raster::project;
use crate::sheet::Ink;
use glam::{DMat3, DVec2, Vec2Swizzles, dvec2};
use rayon::prelude::*;

/// How far about a crossing its post is looked for, units.
const AROUND: f64 = 0.14;
/// Places tried to each side of it.
const STEPS: i32 = 9;
/// Half the widths of posts that are tried, units.
const HALVES: [f64; 6] = [0.045, 0.06, 0.075, 0.09, 0.105, 0.12];
/// The least share of ink in a filled post, or along each side of the outline of one.
const LEAST: f64 = 0.9;
/// The share by which less than at the best place may be inked where a post fits too.
const ALIKE: f64 = 0.02;
/// How wide the places may spread where a post fits, units: along a thick wall it fits everywhere, so only its other direction
/// counts.
const VAGUE: f64 = 0.05;
/// The fewest posts, and the fewest lines of each direction on which they stand.
const FEWEST: usize = 8;
const FEWEST_LINES: usize = 3;

/// The share of the middle distance of posts from their crossings that may be left.
const BETTER: f64 = 0.7;

/// A post as it was found: how far from its crossing, units, and which of the two directions that holds for.
struct Post {
    crossing: DVec2,
    off: DVec2,
    is_sure: [bool; 2],
}

impl Grid {
    /// Moves the lines onto the posts, if there are enough of them.
    pub(super) fn onto_posts(&mut self, ink: &Ink, leans: bool) {
        let posts = posts(ink, self);
        let seen: Vec<Seen> = posts.iter().flat_map(|p| self.seen_posts(p)).collect();
        let lines = |upright: bool| {
            let on = seen.iter().filter(|s| s.upright == upright);
            let mut lines: Vec<i64> = on
                .map(|s| if upright { s.unit.x } else { s.unit.y } as i64)
                .collect();
            lines.sort_unstable();
            lines.dedup();
            lines.len()
        };
        let is_enough = posts.len() >= FEWEST && lines(true).min(lines(false)) >= FEWEST_LINES;
        if !is_enough {
            return;
        }
        let off = |map: DMat3| {
            let off = |s: &Seen| {
                let at = project(map, s.unit);
                (if s.upright { at.x } else { at.y } - s.pixel).abs() / self.unit
            };
            let mut offs: Vec<f64> = seen.iter().map(off).collect();
            let half = offs.len() / 2;
            *offs.select_nth_unstable_by(half, f64::total_cmp).1
        };
        let better = |map: &DMat3| off(*map) < BETTER * off(self.to_sheet);
        if let Some(map) = fitted(&seen, self.to_sheet, leans).filter(better) {
            self.to_sheet = map;
        }
    }

    /// The places where the upright and the level line through a post should run.
    fn seen_posts(&self, post: &Post) -> impl Iterator<Item = Seen> {
        let at = self.at(post.crossing.x + post.off.x, post.crossing.y + post.off.y);
        let both = [(at.x, post.off.x), (at.y, post.off.y)];
        let (unit, is_sure) = (post.crossing, post.is_sure);
        let seen = move |(k, (pixel, off)): (usize, (f64, f64))| {
            is_sure[k].then_some(Seen {
                unit,
                pixel,
                upright: k == 0,
                off,
                weight: 1.0,
            })
        };
        both.into_iter().enumerate().filter_map(seen)
    }
}

/// The posts of a sheet, by the width that most of them have.
fn posts(ink: &Ink, grid: &Grid) -> Vec<Post> {
    let ((u0, u1), (v0, v1)) = (grid.across, grid.down);
    let crossings = (v0..=v1).flat_map(|v| (u0..=u1).map(move |u| dvec2(u.into(), v.into())));
    let crossings: Vec<DVec2> = crossings.filter(|at| has_ink(ink, grid, *at)).collect();
    let of = |half: f64, is_filled: bool| -> Vec<Post> {
        let found = crossings
            .par_iter()
            .filter_map(|at| post(ink, grid, *at, half, is_filled));
        found.collect()
    };
    // A small square fits into every post, so the widest that most posts still hold is theirs.
    let filled: Vec<Vec<Post>> = HALVES.iter().map(|half| of(*half, true)).collect();
    let most = filled[0].len();
    let outlines = HALVES.iter().map(|half| of(*half, false));
    let outlines = outlines.max_by_key(Vec::len).unwrap_or_default();
    let widest = filled.into_iter().rev().find(|f| f.len() * 3 > most * 2);
    let filled = widest.unwrap_or_default();
    // Along thick walls a filled square fits everywhere, so only what is sure counts.
    let sure = |posts: &[Post]| {
        let sure = posts.iter().flat_map(|p| p.is_sure);
        sure.filter(|s| *s).count()
    };
    if sure(&outlines) > sure(&filled) {
        outlines
    } else {
        filled
    }
}

/// Whether there is ink about a crossing: round a house most are blank.
fn has_ink(ink: &Ink, grid: &Grid, at: DVec2) -> bool {
    let side = |k: i32| f64::from(k) / f64::from(STEPS) * AROUND;
    let mut places =
        (-STEPS..=STEPS).flat_map(|y| (-STEPS..=STEPS).map(move |x| at + dvec2(side(x), side(y))));
    places.any(|p| dark_at(ink, grid.at(p.x, p.y)) > ink.threshold)
}

/// The post of such a width at a crossing: the middle of all places where it may be.
fn post(ink: &Ink, grid: &Grid, at: DVec2, half: f64, is_filled: bool) -> Option<Post> {
    let dark = |x: f64, y: f64| dark_at(ink, grid.at(at.x + x, at.y + y)) > ink.threshold;
    let side = |k: i32| f64::from(k) / f64::from(STEPS) * AROUND;
    let offs =
        (-STEPS..=STEPS).flat_map(|y| (-STEPS..=STEPS).map(move |x| dvec2(side(x), side(y))));
    let shares: Vec<(DVec2, f64)> = offs
        .map(|off| {
            let dark = |x: f64, y: f64| dark(off.x + x * half, off.y + y * half);
            let share = match is_filled {
                true => filled(dark),
                false => outlined(dark),
            };
            (off, share)
        })
        .collect();
    let best = shares.iter().map(|s| s.1).fold(0.0, f64::max);
    if best < LEAST {
        return None;
    }
    let alike: Vec<DVec2> = shares
        .iter()
        .filter(|s| s.1 >= best - ALIKE)
        .map(|s| s.0)
        .collect();
    let (low, high) = alike
        .iter()
        .fold((DVec2::MAX, DVec2::MIN), |(l, h), a| (l.min(*a), h.max(*a)));
    let reaches_out = (low.abs().max(high.abs())).max_element() > AROUND - 1e-9;
    let width = high - low;
    let post = Post {
        crossing: at,
        off: (low + high) / 2.0,
        is_sure: [width.x <= VAGUE, width.y <= VAGUE],
    };
    (!reaches_out || post.is_sure != [true; 2]).then_some(post)
}

/// Returns the share of `count` places that are inked; 0 as soon as too many are not for a post to fit there.
fn share(count: i32, is_inked: impl Fn(i32) -> bool) -> f64 {
    let may_miss = f64::from(count) * (1.0 - LEAST + ALIKE);
    let mut missing = 0.0;
    for _ in (0..count).filter(|k| !is_inked(*k)) {
        missing += 1.0;
        if missing > may_miss {
            return 0.0;
        }
    }
    1.0 - missing / f64::from(count)
}

/// The share of ink in a square from -1 to 1.
fn filled(dark: impl Fn(f64, f64) -> bool) -> f64 {
    share(49, |k| {
        let at = |k: i32| f64::from(k) / 3.0 - 1.0;
        dark(at(k % 7), at(k / 7))
    })
}

/// The least share of ink along a side of a square from -1 to 1, if there is paper in it.
fn outlined(dark: impl Fn(f64, f64) -> bool) -> f64 {
    let side = |from: DVec2, along: DVec2| {
        share(9, |k| {
            let at = from + along * (f64::from(k) / 4.0 - 1.0) * 0.9;
            dark(at.x, at.y)
        })
    };
    let mut least = 1.0_f64;
    for from in [DVec2::NEG_X, DVec2::X, DVec2::NEG_Y, DVec2::Y] {
        least = least.min(side(from, from.yx().abs()));
        if least == 0.0 {
            return 0.0;
        }
    }
    let paper = (0..9).filter(|k| {
        let at = |k: i32| (f64::from(k) - 1.0) * 0.35;
        !dark(at(k % 3), at(k / 3))
    });
    if paper.count() < 7 {
        return 0.0;
    }
    least
}
