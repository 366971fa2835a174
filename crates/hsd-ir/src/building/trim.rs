//! Trim of a roof that its solids do not show: tessellation makes ridge tiles, barge boards and rafters from this and
//! from the solids.

use crate::ast::RoofKind;
use crate::material::SurfaceId;
use serde::Serialize;

/// The trim of one roof, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Trim {
    /// Horizontal overhang of the eaves beyond the wall line: the visible length of rafters.
    pub eaves: f64,
    /// Overhang of the verge beyond the gable wall; barge boards need a minimum.
    pub verge: f64,
    /// Courses of ridge tiles (noshi) under the cap.
    pub noshi: u32,
    /// True if ridges end in onigawara.
    pub ends: bool,
    /// True if the source file places a sōrin or a jewel on its apex, which replaces the default finial.
    pub crowned: bool,
    /// True if a pendant (gegyo) hangs under the apex of its gables.
    pub pendant: bool,
    /// True if its gable walls are boards behind a lattice (kitsune-goshi).
    pub lattice: bool,
    /// Rafters, soffits and boards; `None` = bare cedar.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timber: Option<SurfaceId>,
    /// Number of visible rows of rafters under the eaves: one on houses, two on temples.
    pub rafters: u8,
    /// Bent rafters under an undulating gable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arch: Option<Arch>,
}

/// The room for bent rafters behind an undulating edge, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Arch {
    /// From the edge back to the wall.
    pub depth: f64,
    /// Rise of the slope beside it over a metre backwards: its own underside ends where that slope's is as high.
    pub fall: f64,
}

impl Trim {
    /// Returns the height of a ridge above the line where its slopes meet, metres: dai, courses of 35 mm and a cap of
    /// 80 mm with tiles (docs/evidence.md 4.4), similar with other coverings.
    pub fn ridge_height(&self, kind: RoofKind) -> f64 {
        match kind {
            RoofKind::Tiles | RoofKind::CoverTiles => 0.015 + 0.035 * f64::from(self.noshi) + 0.08,
            RoofKind::Boards => 0.06,
            RoofKind::Shingles => 0.15,
            RoofKind::Bark => 0.30,
            RoofKind::Thatch => 0.35,
            RoofKind::Metal => 0.05,
        }
    }
}
