//! Building law as a town writes it (docs/contract.md 10.5): the terms of a zone, and the envelope of a lot under them.

use serde::Serialize;

/// The terms of a zone. A missing term is taken from the enclosing zone, and in the end from [`Terms::default`]. Heights and
/// lengths in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Zone {
    /// Rise of the road slant line per metre.
    pub gradient: Option<f64>,
    /// How far from the far side of a road that counts.
    pub distance: Option<f64>,
    /// Floor area as a share of the lot, as designated.
    pub ratio: Option<f64>,
    /// The share that a road gives, by each metre of its width.
    pub factor: Option<f64>,
    /// Greatest height.
    pub limit: Option<f64>,
    /// How far houses stand back from roads.
    pub setback: Option<f64>,
    /// Which rules count.
    pub plan: Option<DistrictPlan>,
    /// Height over the border of a neighbour from which the adjacent-land slant line rises.
    pub side_height: Option<f64>,
    /// Rise of that per metre.
    pub side_gradient: Option<f64>,
    /// Height of a storey.
    pub storey: Option<f64>,
    /// Ground area of a house as a share of the lot.
    pub coverage: Option<f64>,
    /// True if the solid is cut where a house of that ground area has used up its floor area.
    pub by_ratio: Option<bool>,
}

/// The rules that count in a zone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum DistrictPlan {
    /// Those of the law for all.
    #[default]
    Present,
    /// Those of a district plan that guides the street scene: fronts and heights in line, slant lines and the ratio by road width
    /// relaxed (002-32).
    Guided,
}

impl DistrictPlan {
    /// The words for it.
    pub const WORDS: [(&'static str, DistrictPlan); 2] = [
        ("present", DistrictPlan::Present),
        ("guided", DistrictPlan::Guided),
    ];
}

/// The terms that hold for a lot. The usual values are those of the paper (002-30), elsewhere those of the Building Standards
/// Act of Japan for commercial zones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terms {
    /// Rise of the road slant line per metre (art. 56 (1) 1: 1.25 in residential zones, else 1.5).
    pub gradient: f64,
    /// How far from the far side of a road it counts, metres (appended table 3: 20 to 50).
    pub distance: f64,
    /// The designated ratio of floor area to the area of the lot (art. 52 (1)); `None` for none.
    pub ratio: Option<f64>,
    /// The ratio that a road of less than 12 m gives by each metre of its width (art. 52 (2): 0.4 in residential zones, else 0.6).
    pub factor: f64,
    /// Greatest height, metres; usually 60, over which art. 20 asks for a special proof.
    pub limit: f64,
    /// How far houses stand back from roads, metres; the far side counts as far farther away (art. 56 (2)).
    pub setback: f64,
    /// The rules that count.
    pub plan: DistrictPlan,
    /// Height over the border of a neighbour from which the adjacent-land slant line rises, metres (art. 56 (1) 2: 20 or 31).
    pub side_height: f64,
    /// Rise of that per metre (art. 56 (1) 2: 1.25 or 2.5).
    pub side_gradient: f64,
    /// Height of a storey, metres.
    pub storey: f64,
    /// The greatest ratio of ground area to the area of the lot (art. 53).
    pub coverage: f64,
    /// True if the solid is cut where a house of that ground area has used up its floor area (002-31).
    pub by_ratio: bool,
}

impl Default for Terms {
    fn default() -> Terms {
        Terms {
            gradient: 1.5,
            distance: 30.0,
            ratio: None,
            factor: 0.4,
            limit: 60.0,
            setback: 0.0,
            plan: DistrictPlan::Present,
            side_height: 31.0,
            side_gradient: 2.5,
            storey: 3.0,
            coverage: 1.0,
            by_ratio: false,
        }
    }
}

impl Zone {
    /// Returns the zone with what it leaves open taken from another.
    #[must_use]
    pub fn or(&self, other: &Zone) -> Zone {
        Zone {
            gradient: self.gradient.or(other.gradient),
            distance: self.distance.or(other.distance),
            ratio: self.ratio.or(other.ratio),
            factor: self.factor.or(other.factor),
            limit: self.limit.or(other.limit),
            setback: self.setback.or(other.setback),
            plan: self.plan.or(other.plan),
            side_height: self.side_height.or(other.side_height),
            side_gradient: self.side_gradient.or(other.side_gradient),
            storey: self.storey.or(other.storey),
            coverage: self.coverage.or(other.coverage),
            by_ratio: self.by_ratio.or(other.by_ratio),
        }
    }

    /// Returns the terms that it gives.
    pub fn terms(&self) -> Terms {
        let usual = Terms::default();
        Terms {
            gradient: self.gradient.unwrap_or(usual.gradient),
            distance: self.distance.unwrap_or(usual.distance),
            ratio: self.ratio.or(usual.ratio),
            factor: self.factor.unwrap_or(usual.factor),
            limit: self.limit.unwrap_or(usual.limit),
            setback: self.setback.unwrap_or(usual.setback),
            plan: self.plan.unwrap_or(usual.plan),
            side_height: self.side_height.unwrap_or(usual.side_height),
            side_gradient: self.side_gradient.unwrap_or(usual.side_gradient),
            storey: self.storey.unwrap_or(usual.storey),
            coverage: self.coverage.unwrap_or(usual.coverage),
            by_ratio: self.by_ratio.unwrap_or(usual.by_ratio),
        }
    }
}

/// The envelope that a rule asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EnvelopeWish {
    /// The terms written on the element itself. The zone of the lot supplies the others.
    pub own: Zone,
    /// The name of the set of rules, to compare several.
    pub scenario: String,
    /// The height of the house that stands there, metres, if it is known.
    pub built: Option<f64>,
    /// The layer of roads; without, all streets.
    pub roads: Option<String>,
    /// True if it is shown in the model of the town.
    pub show: bool,
}
