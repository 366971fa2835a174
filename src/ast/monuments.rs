//! Houses written short: a pagoda, a gate, a hall, a shrine by its measures alone. `expand` makes storeys, posts,
//! brackets and roofs of them; what no attribute says follows from the others (`docs/evidence.md` 4.8, 7.10).
//! Lengths in shaku, shares without unit.

use super::fittings::Paint;
use super::{RoofKind, RoofShape};
use crate::source::{Span, Spanned};
use serde::Serialize;

/// A number that may be left out.
pub type Given = Option<Spanned<f64>>;

/// Two numbers that may be left out.
pub type Pair = Option<Spanned<[f64; 2]>>;

/// A house written short.
#[derive(Clone, Debug, Serialize)]
pub enum Monument {
    /// `<Pagoda>`.
    Pagoda(Pagoda),
    /// `<Gate>`.
    Gate(Gate),
    /// `<Hall>` and `<Shrine>`.
    Hall(Hall),
}

impl Monument {
    /// The element.
    pub fn span(&self) -> Span {
        match self {
            Monument::Pagoda(p) => p.span,
            Monument::Gate(g) => g.span,
            Monument::Hall(h) => h.span,
        }
    }
}

/// Attributes that all of them have.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Measures {
    /// Of the columns on the ground, from their feet to the brackets.
    pub columns: Given,
    /// Diameter of the columns.
    pub post: Given,
    /// Of all timber.
    pub paint: Option<Spanned<Paint>>,
    /// Steps of the brackets.
    pub steps: Option<Spanned<u64>>,
    /// Rise of the roof, sun.
    pub pitch: Given,
    /// Overhang of the (lowest) roof.
    pub eaves: Given,
    /// Curve of the roof, per cent.
    pub sori: Given,
    /// Thickness of the roof.
    pub thickness: Given,
    /// Covering.
    pub kind: Option<Spanned<RoofKind>>,
    /// Form of the (top) roof.
    pub shape: Option<Spanned<RoofShape>>,
    /// Height of the platform; 0 = none.
    pub platform: Given,
    /// From the walls to the platform's edge: left and right, front and back.
    pub margin: Pair,
}

/// A square tower of storeys that taper.
#[derive(Clone, Debug, Serialize)]
pub struct Pagoda {
    /// The element.
    pub span: Span,
    /// Attributes that all of these elements have.
    pub measures: Measures,
    /// How many.
    pub storeys: Option<Spanned<u64>>,
    /// Side of the first storey.
    pub width: Given,
    /// Bays of a side.
    pub bays: Option<Spanned<u64>>,
    /// Width of the last storey as a share of the first.
    pub taper: Given,
    /// From eaves plate to eaves plate, as a share of the upper one's width.
    pub rise: Given,
    /// Height of the sorin; 0 = none.
    pub sorin: Given,
}

/// A gate house of one or two storeys.
#[derive(Clone, Debug, Serialize)]
pub struct Gate {
    /// The element.
    pub span: Span,
    /// Attributes that all of these elements have.
    pub measures: Measures,
    /// Along the front, and in depth.
    pub bays: Pair,
    /// Width of a bay along the front, and in depth.
    pub bay: Pair,
    /// One or two.
    pub storeys: Option<Spanned<u64>>,
    /// Bays with doors.
    pub doors: Option<Spanned<u64>>,
    /// How far the upper walls stand back.
    pub inset: Given,
    /// Height of the upper columns.
    pub upper: Given,
}

/// A hall of one storey, round whose core an aisle under a roof of its own may run.
#[derive(Clone, Debug, Serialize)]
pub struct Hall {
    /// The element.
    pub span: Span,
    /// True for a shrine, which has different defaults.
    pub shrine: bool,
    /// Attributes that all of these elements have.
    pub measures: Measures,
    /// Along the front, and in depth.
    pub bays: Pair,
    /// Width of a bay along the front, and in depth.
    pub bay: Pair,
    /// Bays with doors in front.
    pub doors: Option<Spanned<u64>>,
    /// Width of the aisle; 0 = one roof over all.
    pub aisle: Given,
    /// Height of the core's walls above the roof of the aisle's.
    pub upper: Given,
    /// Width of the veranda; 0 = none.
    pub veranda: Given,
    /// Height of its floor.
    pub floor: Given,
    /// Logs on the ridge; 0 = no chigi.
    pub katsuogi: Option<Spanned<u64>>,
}
