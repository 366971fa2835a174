//! The file `facade.json`: how photographs see a wall, its lattice and its parts, for other programs.

use super::{Front, Photo, Told};
use glam::{DMat3, DVec2};
use hsd_scan::raster::project;
use serde::Serialize;

/// The file.
#[derive(Debug, Serialize)]
struct Record {
    photos: Vec<Seen>,
    /// Width and height, metres.
    size: [f64; 2],
    grid: Lines,
    parts: Vec<Cut>,
    /// The logarithm of the light along the wall: of across and down from its middle, their squares and product.
    light: [f64; 5],
}

/// A photograph.
#[derive(Debug, Serialize)]
struct Seen {
    file: String,
    corners: [[f64; 2]; 4],
    /// Wall metres from the upper left corner, x to the right, y down, to pixels of the straight picture; row by row.
    homography: [f64; 9],
    lens: [f64; 2],
    focal_px: f64,
    focal_from: &'static str,
    aspect: f64,
    confidence: f64,
}

/// Lines between bays and storeys, metres from the upper left corner, with both ends.
#[derive(Debug, Serialize)]
struct Lines {
    columns: Vec<f64>,
    rows: Vec<f64>,
    likeness: [f64; 2],
}

/// A cell of the lattice.
#[derive(Debug, Serialize)]
struct Cut {
    name: String,
    same_as: String,
    replaced: bool,
    likeness: f64,
    /// Width and height, metres.
    size: [f64; 2],
}

/// The record of a front.
pub fn json(photos: &[Photo], front: &Front) -> String {
    let record = Record {
        photos: photos
            .iter()
            .zip(&front.views)
            .map(|(p, v)| seen(p, v, front.size))
            .collect(),
        size: [round(front.size.x), round(front.size.y)],
        grid: Lines {
            columns: front
                .grid
                .columns
                .iter()
                .map(|u| round(u * front.size.x))
                .collect(),
            rows: front
                .grid
                .rows
                .iter()
                .map(|v| round(v * front.size.y))
                .collect(),
            likeness: front.grid.likeness.map(round),
        },
        parts: cuts(front),
        light: front.light.slopes.map(round),
    };
    let mut json = serde_json::to_string_pretty(&record).unwrap_or_default();
    json.push('\n');
    json
}

fn seen(photo: &Photo, view: &super::View, size: DVec2) -> Seen {
    let map = view.map * DMat3::from_scale(size.recip());
    let map = map * (1.0 / map.z_axis.z);
    debug_assert!(project(map, size).is_finite());
    Seen {
        file: photo.name.clone(),
        corners: view.corners.map(|c| [round(c.x), round(c.y)]),
        homography: map.transpose().to_cols_array(),
        lens: view.lens.bend.map(round),
        focal_px: round(view.lens.focal),
        focal_from: match view.focal {
            Told::Given => "given",
            Told::Camera => "camera",
            Told::Square => "corners",
            Told::Usual => "usual",
        },
        aspect: round(view.aspect),
        confidence: round(view.trust),
    }
}

fn cuts(front: &Front) -> Vec<Cut> {
    let storeys = front.grid.rows.len() - 1;
    let cuts = front.cells.iter().zip(&front.shown).map(|(cell, shown)| {
        let (u, v) = (
            &front.grid.columns[cell.column..],
            &front.grid.rows[cell.row..],
        );
        Cut {
            name: format!("f1f{}f{}", storeys - cell.row, cell.column + 1),
            same_as: front.name_at(cell.row, cell.column),
            replaced: shown.is_replaced,
            likeness: round(shown.likeness),
            size: [
                round((u[1] - u[0]) * front.size.x),
                round((v[1] - v[0]) * front.size.y),
            ],
        }
    });
    cuts.collect()
}

/// Six decimals say all that a photograph tells.
fn round(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}
