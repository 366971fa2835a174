//! One wall out of several photographs: each shows what others hide.

use super::cut;
use crate::cells::{self, Cell};
use crate::grid::Grid;
use crate::kinds::{self, Shown};
use crate::tone::{levels, linear};
use image::{Rgb, RgbImage, imageops};
use std::collections::BTreeMap;

/// One wall out of several: each cell from the photograph that shows it clean and sharpest, as bright as in the first (003-04);
/// what is hidden there comes from those in which it is free.
pub fn composed(mut walls: Vec<(RgbImage, Vec<bool>)>, grid: &Grid) -> (RgbImage, Vec<bool>) {
    if walls.len() == 1 {
        return walls.swap_remove(0);
    }
    let read: Vec<(Vec<Cell>, Vec<Shown>)> = walls
        .iter()
        .map(|(wall, seen)| {
            let cells = cells::cells(wall, seen, grid);
            let shown = kinds::sorted(&cells);
            (cells, shown)
        })
        .collect();
    let (mut out, mut seen) = walls[0].clone();
    for k in 0..read[0].0.len() {
        // Whole and like others first; of several the one with which the other photographs agree.
        let worth = |photo: usize| {
            let (cell, shown) = (&read[photo].0[k], &read[photo].1[k]);
            let agree = (0..walls.len()).filter(|other| *other != photo);
            let agree = agree
                .filter_map(|other| cells::compare(cell, &read[other].0[k]))
                .map(|l| l.share);
            let is_clean = cell.is_whole() && !shown.is_replaced && !shown.is_spoiled;
            f64::from(u8::from(is_clean)) + shown.likeness + agree.fold(0.0, f64::max)
        };
        let best = (0..walls.len())
            .rev()
            .max_by(|a, b| worth(*a).total_cmp(&worth(*b)));
        let best = best.unwrap_or(0);
        if best > 0 {
            let cell = &read[best].0[k];
            let gain = cells::compare(cell, &read[0].0[k]).map_or(1.0, |l| l.gain);
            let picture = cut(&walls[best].0, cell, gain);
            imageops::replace(
                &mut out,
                &picture,
                cell.frame[0].into(),
                cell.frame[1].into(),
            );
            let width = out.width();
            for y in cell.frame[1]..cell.frame[3] {
                let row =
                    (y * width + cell.frame[0]) as usize..(y * width + cell.frame[2]) as usize;
                seen[row.clone()].copy_from_slice(&walls[best].1[row]);
            }
        }
        for other in (0..walls.len()).filter(|other| *other != best) {
            let gain = cells::compare(&read[other].0[k], &read[0].0[k]).map(|l| l.gain);
            if let Some(gain) = gain {
                filled(
                    (&mut out, &mut seen),
                    &walls[other],
                    read[0].0[k].frame,
                    gain,
                );
            }
        }
    }
    (out, seen)
}

/// How wide the passage is between what is seen and what comes from another photograph, pixels.
const PASSAGE: u32 = 4;

/// Fills what is hidden in a frame with what another wall shows there, so many times as bright; near its border the two pass
/// into each other.
fn filled(
    (out, seen): (&mut RgbImage, &mut [bool]),
    (wall, free): &(RgbImage, Vec<bool>),
    [left, top, right, bottom]: [u32; 4],
    gain: f32,
) {
    let width = out.width();
    let at = |x: u32, y: u32| (y * width + x) as usize;
    let places = (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y)));
    let hidden: Vec<(u32, u32)> = places.filter(|(x, y)| !seen[at(*x, *y)]).collect();
    let tone = |x: u32, y: u32| linear(wall.get_pixel(x, y).0).map(|c| c * gain);
    // The border is that of what was hidden, so it is looked for before anything is filled.
    let near = |(x, y): (u32, u32)| {
        let reach = |t: u32, least: u32, most: u32| {
            t.saturating_sub(PASSAGE).max(least)..(t + PASSAGE + 1).min(most)
        };
        reach(y, top, bottom).flat_map(move |ny| reach(x, left, right).map(move |nx| (nx, ny)))
    };
    let mut passage: BTreeMap<(u32, u32), f32> = BTreeMap::new();
    for (place, next) in hidden.iter().flat_map(|p| near(*p).map(move |n| (p, n))) {
        if seen[at(next.0, next.1)] && free[at(next.0, next.1)] {
            let far = place.0.abs_diff(next.0).max(place.1.abs_diff(next.1));
            let share = 1.0 - far as f32 / (PASSAGE + 1) as f32;
            let most = passage.entry(next).or_default();
            *most = most.max(share);
        }
    }
    for ((x, y), share) in passage {
        let (own, other) = (linear(out.get_pixel(x, y).0), tone(x, y));
        let mixed = [0, 1, 2].map(|c| own[c] + (other[c] - own[c]) * share);
        out.put_pixel(x, y, Rgb(levels(mixed)));
    }
    for (x, y) in hidden.into_iter().filter(|(x, y)| free[at(*x, *y)]) {
        out.put_pixel(x, y, Rgb(levels(tone(x, y))));
        seen[at(x, y)] = true;
    }
}
