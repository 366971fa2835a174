//! Contact sheets: an image of each variant with its seed.

use crate::{digits, on_all_processors, picture};
use hsd_ir::building::Built;
use hsd_scene::{NodeId, Scene};
use image::{RgbImage, imageops};
use std::collections::BTreeMap;

/// The gap between images in pixels.
const GAP: u32 = 6;

const PAPER: image::Rgb<u8> = image::Rgb([0xf6, 0xf3, 0xec]);

/// Image widths in pixels by the minimum number of images.
const WIDTHS: [(usize, u32); 4] = [(0, 360), (25, 240), (101, 160), (401, 96)];

/// Draws a contact sheet of some houses of a scene.
pub fn sheet(scene: &Scene, cells: &[Cell]) -> RgbImage {
    let wide = WIDTHS.iter().rev().find(|(from, _)| cells.len() >= *from);
    let width = wide.map_or(WIDTHS[0].1, |(_, width)| *width);
    let height = width * 3 / 4;
    let columns = (1..).find(|c| c * c >= cells.len()).unwrap_or(1).max(1) as u32;
    let rows = (cells.len() as u32).div_ceil(columns).max(1);
    let mut sheet = RgbImage::from_pixel(
        columns * (width + GAP) + GAP,
        rows * (height + GAP) + GAP,
        PAPER,
    );
    let one = |cell: &Cell| picture(scene, &cell.nodes, (width, height));
    let pictures = on_all_processors(cells, one);
    for (index, (cell, mut picture)) in (0..).zip(cells.iter().zip(pictures)) {
        let dot = (width / 120).max(1);
        digits::write(cell.seed, &mut picture, (3 * dot, 3 * dot), dot);
        let (x, y) = (index % columns, index / columns);
        let place = (GAP + x * (width + GAP), GAP + y * (height + GAP));
        imageops::replace(&mut sheet, &picture, i64::from(place.0), i64::from(place.1));
    }
    sheet
}

/// The houses of one image.
#[derive(Debug)]
pub struct Cell {
    /// The seed that is written in it.
    pub seed: u64,
    /// Their nodes.
    pub nodes: Vec<NodeId>,
}

/// Returns an image for each variant; `houses` are those of the scene in order.
pub fn variants(scene: &Scene, houses: &[Built]) -> Vec<Cell> {
    let roots = scene
        .nodes
        .iter()
        .enumerate()
        .filter(|(_, n)| n.parent.is_none());
    let mut cells: BTreeMap<u32, Cell> = BTreeMap::new();
    for ((node, _), house) in roots.zip(houses.iter().map(|b| &b.house)) {
        let Some(variant) = house.variant else {
            continue;
        };
        let cell = cells.entry(variant.number).or_insert(Cell {
            seed: variant.seed,
            nodes: vec![],
        });
        cell.nodes.push(NodeId(node as u32));
    }
    cells.into_values().collect()
}
