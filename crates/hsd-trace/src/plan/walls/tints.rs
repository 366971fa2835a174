//! Openings drawn over their walls in another colour.

use super::{Divided, Stuff};
use image::GrayImage;

/// The least difference between the tint of an opening and that of walls, of 255.
const APART: u8 = 76;
/// The greatest share of walls that may have another colour. If more have it, it does not mean openings.
const MOST: f64 = 0.5;
/// The width of the strip beside a wall in which colour belongs to it, in thicknesses of walls.
const BESIDE: f64 = 1.0;

/// Marks the stretches of walls that have another colour than most.
pub(super) fn mark(divided: &mut Divided, tints: &GrayImage) {
    let tint = |(x, y): (usize, usize)| {
        let at = tints.get_pixel_checked(x as u32, y as u32);
        at.map_or(0, |p| p[0])
    };
    let walls: Vec<(usize, usize)> = {
        let stuff = &divided.stuff;
        let is_wall = |p: &(usize, usize)| stuff[*p] == Stuff::Wall;
        stuff.places().filter(is_wall).collect()
    };
    let mut levels: Vec<u8> = walls.iter().map(|p| tint(*p)).collect();
    levels.sort_unstable();
    let Some(usual) = levels.get(levels.len() / 2) else {
        return;
    };
    let is_tinted = |p: &(usize, usize)| tint(*p) >= usual.saturating_add(APART);
    let tinted = walls.iter().filter(|p| is_tinted(p)).count();
    if tinted as f64 <= MOST * walls.len() as f64 {
        // A dark line along the middle may hide the colour there.
        let reach = (BESIDE * divided.strokes.usual).max(2.0) as isize;
        let (width, height) = (divided.stuff.width, divided.stuff.height);
        for (x, y) in &walls {
            let along = (-reach..=reach).flat_map(|d| [(d, 0), (0, d)]);
            let near = along.filter_map(|(dx, dy)| {
                let (x, y) = (x.checked_add_signed(dx)?, y.checked_add_signed(dy)?);
                (x < width && y < height).then_some((x, y))
            });
            near.filter(is_tinted)
                .for_each(|p| divided.stuff[p] = Stuff::Tinted);
        }
    }
}
