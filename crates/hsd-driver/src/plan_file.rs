//! The file beside a house that was read from plans (`HOUSE.plan.json`): its sheets, which `hsd view` shows under the house, and
//! its text as it was read, so that a second reading of `hsd plan` keeps what the author has changed.

use serde::{Deserialize, Serialize};

/// The only version of the file.
pub const VERSION: u32 = 1;

/// The file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanFile {
    /// The version of the file, 1.
    pub plan: u32,
    /// One for each storey that was read.
    pub sheets: Vec<PlanSheet>,
    /// The text of the house as it was read; other programs may leave it out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub read: Option<String>,
}

/// A flattened picture of one storey.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanSheet {
    /// The number of its storey, from 1, as in the text.
    pub storey: u32,
    /// The name of the picture, a PNG or JPEG in the folder of the file.
    pub picture: String,
    /// Takes pixels of the picture to metres in the frame of the house, as `matrix(a, b, c, d, e, f)` of SVG:
    /// `left = a x + c y + e`, `back = b x + d y + f`.
    ///
    /// `x` runs to the right and `y` down from the upper left corner of the picture; the middle of its first pixel is at
    /// 0.5, 0.5. `left` runs along the front, to the left as seen from the street, and `back` away from the street. Both
    /// count from the origin of the house: the right end of its front, where the first `Storey` begins. That is the frame
    /// in which authors count `start` and `at`, times the metres of a unit (`unit_m` of the plan).
    ///
    /// An upright sheet whose front lies at the bottom, of `s` metres a pixel, with the right end of the front at pixel
    /// `x0, y0`, has `[-s, 0, 0, -s, s x0, s y0]`.
    pub to_house: [f64; 6],
}

impl PlanFile {
    /// A file for some sheets and the text that was read from them.
    pub fn new(sheets: Vec<PlanSheet>, read: String) -> PlanFile {
        PlanFile {
            plan: VERSION,
            sheets,
            read: Some(read),
        }
    }

    /// Reads a file; `None` if it is of another version or none at all.
    pub fn parse(json: &str) -> Option<PlanFile> {
        let file: PlanFile = serde_json::from_str(json).ok()?;
        (file.plan == VERSION).then_some(file)
    }

    /// The file as JSON.
    pub fn json(&self) -> String {
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }
}
