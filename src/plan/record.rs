//! What is kept beside a house that was read from plans (`HOUSE.plan.json`): its sheets, for the page that shows them under the
//! house, and its text as it was read, so that a second reading keeps what the author has changed.

use super::Found;
use super::flatten::warp;
use glam::{DMat3, DVec2, dvec2};
use image::RgbImage;
use serde::{Deserialize, Serialize};

/// The version of the record.
const VERSION: u32 = 1;
/// The most pixels of a unit in the picture of a sheet.
const FINEST: f64 = 64.0;
/// Units round the plan that the picture of a sheet shows.
const MARGIN: i32 = 2;

/// The record.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Record {
    /// The version: 1.
    pub plan: u32,
    /// The sheets.
    pub sheets: Vec<Sheet>,
    /// The text as it was read.
    pub read: String,
}

/// A sheet.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Sheet {
    /// Its storey, counted from 1.
    pub storey: u32,
    /// Its flat picture, a file beside the record.
    pub picture: String,
    /// Takes pixels x to the right and y down to metres, `left = a x + c y + e` and `back = b x + d y + f`: to the left along
    /// the front and back from it, from where the first storey begins.
    pub to_house: [f64; 6],
}

impl Record {
    /// A record of some sheets and of what was read from them.
    pub fn new(sheets: Vec<Sheet>, read: String) -> Record {
        Record {
            plan: VERSION,
            sheets,
            read,
        }
    }

    /// Reads a record; `None` if it is of another version or none at all.
    pub fn read(json: &str) -> Option<Record> {
        let record: Record = serde_json::from_str(json).ok()?;
        (record.plan == VERSION).then_some(record)
    }

    /// The record as JSON.
    pub fn json(&self) -> String {
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }
}

/// The part of a sheet that shows the plan, so that units are squares; and what takes its pixels to metres, if the house begins
/// at `origin` (to the right and down, units of this sheet) and a unit has `metres`.
pub fn flat(found: &Found, origin: (i32, i32), metres: f64) -> (RgbImage, [f64; 6]) {
    let grid = &found.grid;
    let pixels = grid.unit.round().clamp(8.0, FINEST);
    let corner = (grid.across.0 - MARGIN, grid.down.0 - MARGIN);
    let size = |(first, last): (i32, i32)| (f64::from(last - first + 2 * MARGIN) * pixels) as u32;
    let to_units =
        DMat3::from_translation(at(corner)) * DMat3::from_scale(DVec2::splat(1.0 / pixels));
    let picture = warp(
        &found.flat.sheet,
        grid.to_sheet * to_units,
        (size(grid.across), size(grid.down)),
    );
    let scale = metres / pixels;
    let zero = at(origin) - at(corner);
    (
        picture,
        [-scale, 0.0, 0.0, -scale, zero.x * metres, zero.y * metres],
    )
}

fn at(p: (i32, i32)) -> DVec2 {
    dvec2(f64::from(p.0), f64::from(p.1))
}
