//! Pictures of what each step found, for people who look where a plan went wrong.

use super::flatten::Flat;
use super::grid::Grid;
use super::legend::Role;
use super::shape::{Shape, Wall};
use super::sheet::Ink;
use super::strokes::Units;
use super::{Found, Stopped};
use glam::{DVec2, dvec2};
use image::{GrayImage, Luma, Rgb, RgbImage};

/// The colour of a grid.
const GRID: [u8; 3] = [90, 150, 255];
/// The colour of what is in doubt.
const DOUBT: [u8; 3] = [230, 0, 0];
/// The colour of stairs and fixtures.
const THING: [u8; 3] = [150, 90, 30];

/// What the steps have found, or had found when one of them found too little.
#[derive(Clone, Copy)]
pub struct Seen<'s> {
    flat: &'s Flat,
    ink: &'s Ink,
    grid: Option<&'s Grid>,
    units: Option<&'s Units>,
    shape: Option<&'s Shape>,
}

impl<'s> From<&'s Found> for Seen<'s> {
    fn from(found: &'s Found) -> Seen<'s> {
        Seen {
            flat: &found.flat,
            ink: &found.ink,
            grid: Some(&found.grid),
            units: Some(&found.units),
            shape: Some(&found.shape),
        }
    }
}

impl<'s> From<&'s Stopped> for Seen<'s> {
    fn from(stopped: &'s Stopped) -> Seen<'s> {
        Seen {
            flat: &stopped.flat,
            ink: &stopped.ink,
            grid: stopped.grid.as_ref(),
            units: stopped.units.as_ref(),
            shape: stopped.shape.as_ref(),
        }
    }
}

/// The pictures of all steps that were taken, with the names of their files.
pub fn steps(seen: Seen<'_>) -> Vec<(&'static str, RgbImage)> {
    let mut out = vec![
        ("1-flat.png", seen.flat.sheet.clone()),
        ("2-ink.png", ink(seen.ink)),
    ];
    let Some(found) = seen.grid else { return out };
    out.push(("3-grid.png", grid(seen.flat, found)));
    if let Some(units) = seen.units {
        out.push(("4-strokes.png", strokes(seen.flat, found, units)));
    }
    if let Some(shape) = seen.shape {
        out.push(("5-house.png", house(seen.flat, found, shape)));
    }
    out
}

/// The sheet, pale, with the house that was found on it; what is in doubt is red.
pub fn review(found: &Found, doubts: &[DVec2]) -> RgbImage {
    let mut out = house(&found.flat, &found.grid, &found.shape);
    let reach = found.grid.unit * 0.32;
    for at in doubts {
        ring(&mut out, found.grid.at(at.x, at.y), reach);
    }
    out
}

/// Draws a ring round what is in doubt.
pub(super) fn ring(out: &mut RgbImage, middle: DVec2, reach: f64) {
    let ring = (0..=48).map(|k| std::f64::consts::TAU * f64::from(k) / 48.0);
    let ring: Vec<DVec2> = ring
        .map(|a| middle + dvec2(libm::cos(a), libm::sin(a)) * reach)
        .collect();
    for pair in ring.windows(2) {
        line(out, pair[0], pair[1], DOUBT, 2);
    }
}

fn ink(ink: &Ink) -> RgbImage {
    let black = GrayImage::from_fn(ink.dark.width(), ink.dark.height(), |x, y| {
        Luma([if ink.is(x, y) { 0 } else { 255 }])
    });
    image::DynamicImage::ImageLuma8(black).to_rgb8()
}

fn grid(flat: &Flat, grid: &Grid) -> RgbImage {
    let mut out = pale(&flat.sheet);
    let (across, down) = (grid.across, grid.down);
    let at = |u: i32, v: i32| grid.at(f64::from(u), f64::from(v));
    for u in across.0..=across.1 {
        line(&mut out, at(u, down.0), at(u, down.1), GRID, 0);
    }
    for v in down.0..=down.1 {
        line(&mut out, at(across.0, v), at(across.1, v), GRID, 0);
    }
    out
}

fn strokes(flat: &Flat, grid: &Grid, units: &Units) -> RgbImage {
    let mut out = pale(&flat.sheet);
    let (across, down) = (grid.across, grid.down);
    for v in down.0..=down.1 {
        for u in across.0..=across.1 {
            for (read, to) in [
                (units.level(u, v), (u + 1, v)),
                (units.upright(u, v), (u, v + 1)),
            ] {
                unit(&mut out, grid, (u, v), to, read.role);
            }
        }
    }
    out
}

fn house(flat: &Flat, grid: &Grid, shape: &Shape) -> RgbImage {
    let mut out = pale(&flat.sheet);
    for cell in &shape.cells {
        let at = |a: f64, b: f64| grid.at(f64::from(cell.0) + a, f64::from(cell.1) + b);
        line(&mut out, at(0.42, 0.5), at(0.58, 0.5), [170, 200, 170], 1);
    }
    for Wall {
        from,
        to,
        read,
        is_joined,
    } in shape.outer.iter().chain(&shape.inner)
    {
        let role = if *is_joined { Role::Open } else { read.role };
        unit(&mut out, grid, *from, *to, role);
    }
    for thing in &shape.things {
        let ((u, v), (w, d)) = (thing.at, thing.size);
        let corner = |x: i32, y: i32| {
            let inwards = |k: i32, from: i32| f64::from(k) + if k == from { 0.1 } else { -0.1 };
            grid.at(inwards(u + x, u), inwards(v + y, v))
        };
        let round = [(0, 0), (w, 0), (w, d), (0, d), (0, 0)].map(|(x, y)| corner(x, y));
        for side in round.windows(2) {
            line(&mut out, side[0], side[1], THING, 1);
        }
    }
    out
}

/// Draws the colour of a role along a unit.
fn unit(out: &mut RgbImage, grid: &Grid, from: (i32, i32), to: (i32, i32), role: Role) {
    let Some(colour) = colour(role) else { return };
    let at = |p: (i32, i32)| grid.at(f64::from(p.0), f64::from(p.1));
    let (a, b) = (at(from), at(to));
    line(out, a.lerp(b, 0.1), a.lerp(b, 0.9), colour, 1);
}

/// The colour of a role in all pictures.
fn colour(role: Role) -> Option<[u8; 3]> {
    Some(match role {
        Role::Empty => return None,
        Role::Mat => [200, 190, 120],
        Role::Open => [255, 150, 0],
        Role::Wall => [60, 60, 60],
        Role::Slide => [0, 150, 60],
        Role::Hinged => [170, 0, 200],
        Role::Window => [0, 90, 255],
        Role::Lattice => [0, 160, 190],
    })
}

/// A sheet as through tracing paper.
pub(super) fn pale(sheet: &RgbImage) -> RgbImage {
    let mut out = sheet.clone();
    for pixel in out.pixels_mut() {
        *pixel = Rgb(pixel.0.map(|c| 160 + c / 8 * 3));
    }
    out
}

/// Draws a line so many pixels wider to each side.
pub(super) fn line(out: &mut RgbImage, from: DVec2, to: DVec2, colour: [u8; 3], wider: i32) {
    let steps = (from.distance(to).ceil() as u32).clamp(1, 20_000);
    for k in 0..=steps {
        let at = from.lerp(to, f64::from(k) / f64::from(steps));
        let (x, y) = (at.x.floor() as i32, at.y.floor() as i32);
        for (u, v) in (-wider..=wider).flat_map(|v| (-wider..=wider).map(move |u| (x + u, y + v))) {
            let inside = u >= 0 && v >= 0 && (u as u32) < out.width() && (v as u32) < out.height();
            if inside {
                out.put_pixel(u as u32, v as u32, Rgb(colour));
            }
        }
    }
}
