//! Monuments, houses described by their measures alone: a pagoda, a gate, a hall, a shrine. `expand` makes storeys,
//! posts, brackets and roofs of them; omitted attributes follow from the others (`docs/evidence.md` 4.8, 7.10). Lengths
//! in shaku, shares without unit.

use super::fittings::Paint;
use super::{RoofKind, RoofShape};
use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// An optional number.
pub type Given = Option<Spanned<f64>>;

/// Two optional numbers.
pub type Pair = Option<Spanned<[f64; 2]>>;

/// A monument.
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
    /// Returns the span of the element.
    pub fn span(&self) -> Span {
        match self {
            Monument::Pagoda(p) => p.span,
            Monument::Gate(g) => g.span,
            Monument::Hall(h) => h.span,
        }
    }
}

/// Attributes common to all monuments.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Measures {
    /// Height of the columns on the ground, from their feet to the brackets.
    pub columns: Given,
    /// Diameter of the columns.
    pub post: Given,
    /// Paint of all timber.
    pub paint: Option<Spanned<Paint>>,
    /// Steps of the brackets.
    pub steps: Option<Spanned<u64>>,
    /// Pitch of the roof, sun.
    pub pitch: Given,
    /// Overhang of the (lowest) roof.
    pub eaves: Given,
    /// Curve of the roof, per cent.
    pub sori: Given,
    /// Thickness of the roof.
    pub thickness: Given,
    /// Covering.
    pub kind: Option<Spanned<RoofKind>>,
    /// Form of the roof, or of the top one.
    pub shape: Option<Spanned<RoofShape>>,
    /// Height of the platform; 0 = none.
    pub platform: Given,
    /// Distances from the walls to the platform's edge: left and right, front and back.
    pub margin: Pair,
}

/// A square tower of storeys that taper.
#[derive(Clone, Debug, Serialize)]
pub struct Pagoda {
    /// The element.
    pub span: Span,
    /// Attributes that all of these elements have.
    pub measures: Measures,
    /// Number of storeys.
    pub storeys: Option<Spanned<u64>>,
    /// Side of the first storey.
    pub width: Given,
    /// Number of bays of a side.
    pub bays: Option<Spanned<u64>>,
    /// Number of bays of a side of the last storey.
    pub top_bays: Option<Spanned<u64>>,
    /// Width of the last storey as a share of the first.
    pub taper: Given,
    /// Overhang of the last roof as a share of the first one's.
    pub eaves_taper: Given,
    /// Height from eaves plate to eaves plate, as a share of the upper one's width.
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
    /// Numbers of bays along the front and in depth.
    pub bays: Pair,
    /// Widths of a bay along the front and in depth.
    pub bay: Pair,
    /// Number of storeys, one or two.
    pub storeys: Option<Spanned<u64>>,
    /// Number of bays with doors.
    pub doors: Option<Spanned<u64>>,
    /// Distance by which the upper walls stand back.
    pub inset: Given,
    /// Height of the upper columns.
    pub upper: Given,
}

/// A hall of one storey, optionally with an aisle under a roof of its own round its core.
#[derive(Clone, Debug, Serialize)]
pub struct Hall {
    /// The element.
    pub span: Span,
    /// True for a shrine, which has different defaults.
    pub shrine: bool,
    /// Attributes that all of these elements have.
    pub measures: Measures,
    /// Numbers of bays along the front and in depth.
    pub bays: Pair,
    /// Widths of a bay along the front and in depth.
    pub bay: Pair,
    /// Number of bays with doors in front.
    pub doors: Option<Spanned<u64>>,
    /// Width of the aisle; 0 = one roof over all.
    pub aisle: Given,
    /// Height of the core's walls above the roof of the aisle.
    pub upper: Given,
    /// Width of the veranda; 0 = none.
    pub veranda: Given,
    /// Height of its floor.
    pub floor: Given,
    /// Number of billets on the ridge; 0 = no chigi.
    pub katsuogi: Option<Spanned<u64>>,
}
