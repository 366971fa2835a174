//! Words that attributes may have as values, with their meanings in the tree.

use hsd_ir::ast::{
    Anchor, On, Rail, RoofDirection, RoofKind, RoofMode, RoofShape, Side, StoreyKind,
};

/// The kind of a storey or a floor.
pub(in crate::parse) const STOREY_KINDS: [(&str, StoreyKind); 2] = [
    ("storey", StoreyKind::Storey),
    ("parapet", StoreyKind::Parapet),
];

/// The points of a house that can stand at its place.
pub(in crate::parse) const ANCHORS: [(&str, Anchor); 2] =
    [("corner", Anchor::Corner), ("centre", Anchor::Centre)];

/// The orders of parts; true if they run rightwards.
pub(in crate::parse) const PART_ORDERS: [(&str, bool); 2] = [("left", false), ("right", true)];

/// The values for the reflection of glass; true if it is reflective.
pub(in crate::parse) const REFLECTIONS: [(&str, bool); 2] = [("enable", true), ("disable", false)];

pub(in crate::parse) const SIDES: [(&str, Side); 4] = [
    ("F", Side::Front),
    ("B", Side::Back),
    ("L", Side::Left),
    ("R", Side::Right),
];

/// The kinds of sides of an outline.
pub(in crate::parse) const ON: [(&str, On); 8] = [
    ("front", On::Front),
    ("street", On::Street),
    ("neighbour", On::Neighbour),
    ("court", On::Court),
    ("back", On::Back),
    ("long", On::Long),
    ("short", On::Short),
    ("any", On::Any),
];

pub(in crate::parse) const RAILS: [(&str, Rail); 3] = [
    ("none", Rail::None),
    ("crossed", Rail::Crossed),
    ("knobbed", Rail::Knobbed),
];

pub(in crate::parse) const TURNS: [(&str, f64); 2] = [("R", 90.0), ("L", -90.0)];

pub(in crate::parse) const RIDGE_DIRECTIONS: [(&str, RoofDirection); 6] = [
    ("X", RoofDirection::AlongFront),
    ("Y", RoofDirection::AcrossFront),
    ("F", RoofDirection::Front),
    ("B", RoofDirection::Back),
    ("L", RoofDirection::Left),
    ("R", RoofDirection::Right),
];

pub(in crate::parse) const COVERINGS: [(&str, RoofKind); 7] = [
    ("K", RoofKind::Tiles),
    ("G", RoofKind::CoverTiles),
    ("I", RoofKind::Boards),
    ("S", RoofKind::Shingles),
    ("H", RoofKind::Bark),
    ("Y", RoofKind::Thatch),
    ("T", RoofKind::Metal),
];

/// The shapes of roofs: their letters, and the words of OpenStreetMap.
pub(in crate::parse) const ROOF_SHAPES: [(&str, RoofShape); 27] =
    joined(RoofShape::ALL, RoofShape::MAPPED);

/// The shapes of the roofs of a house; `None` leaves it to what the house is for.
pub(in crate::parse) const SHAPES_OF_HOUSES: [(&str, Option<RoofShape>); 28] = {
    let mut all = [("use", None); 28];
    let mut at = 0;
    while at < ROOF_SHAPES.len() {
        all[at] = (ROOF_SHAPES[at].0, Some(ROOF_SHAPES[at].1));
        at += 1;
    }
    all
};

/// Joins two lists of words.
const fn joined<T: Copy, const A: usize, const B: usize, const N: usize>(
    first: [(&'static str, T); A],
    then: [(&'static str, T); B],
) -> [(&'static str, T); N] {
    assert!(A + B == N);
    let mut all = [first[0]; N];
    let mut at = 0;
    while at < N {
        all[at] = if at < A { first[at] } else { then[at - A] };
        at += 1;
    }
    all
}

pub(in crate::parse) const ROOF_MODES: [(&str, RoofMode); 2] =
    [("auto", RoofMode::Auto), ("explicit", RoofMode::Explicit)];
