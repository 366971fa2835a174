//! Covering, pitch and overhangs of one roof: the author's options, and `docs/evidence.md` 4.3 and 4.4 for the rest.

use crate::shape::board::upright;
use crate::shape::broken;
use crate::solid::sheet::Coat;
use hsd_base::geometry::SHAKU;
use hsd_base::source::Spanned;
use hsd_ir::ast::{GableWall, Paint, RoofKind, RoofShape, RoofStyle};
use hsd_ir::building::{Finish, Trim};
use hsd_ir::material::SurfaceId;

/// The resolved options of one roof, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Its form.
    pub shape: RoofShape,
    /// Its covering.
    pub kind: RoofKind,
    /// Rise per horizontal metre.
    pub pitch: f64,
    /// Horizontal overhang beyond the wall line.
    pub eaves: f64,
    /// Overhang beyond the gable wall.
    pub verge: f64,
    /// Overhang of the upper gable of an irimoya.
    pub barge: f64,
    /// Sagitta of the slope as a share of its length: sori, or mukuri where negative.
    pub sori: f64,
    /// Position of an irimoya's gable or height of a half-hip, share of the span; `None` = the default.
    pub gable: Option<f64>,
    /// Length of a hip's ridge, share of the roof's; `None` = equal slopes.
    pub ratio: Option<f64>,
    /// Thickness at right angles to the slope.
    pub thickness: f64,
    /// From the slope over the walls to the lower face, at right angles (d_low, F1): rf_offs of 004-09 is this and the thickness.
    pub gap: f64,
    /// Courses of ridge tiles.
    pub noshi: u32,
    /// True if the ridge ends in onigawara.
    pub ends: bool,
    /// True if gable walls of an irimoya are boards behind a lattice.
    pub lattice: bool,
    /// Wood or paint of its timber; `None` = bare.
    pub paint: Option<Paint>,
}

/// Slope lengths in metres up to which tiles keep out rain at a pitch (docs/evidence.md 4.3, S20).
const TILE_PITCHES: [(f64, f64); 5] = [
    (8.0, 0.40),
    (10.0, 0.45),
    (12.0, 0.50),
    (15.0, 0.55),
    (17.0, 0.60),
];

/// Defaults of a temple: the gentlest tiles and its sori (docs/evidence.md 4.3), eaves by the span and their
/// bounds in metres (4.4: 8 to 12 shaku on great ones), and the projection of its barge boards (7.10).
const TEMPLE_PITCH: f64 = 0.5;
const TEMPLE_SORI: f64 = 4.0;
const TEMPLE_EAVES: f64 = 0.3;
const TEMPLE_BARGE: f64 = 0.5;
/// Eaves of broken roofs, metres.
const BROKEN_EAVES: f64 = 1.5 * SHAKU;
/// Projection of the barge boards of other irimoya, metres.
const BARGE: f64 = 0.4;

/// The gentlest default of lean-tos (docs/evidence.md 4.3: geya 3 sun).
const LEAN_TO_PITCH: f64 = 0.3;

impl Look {
    /// Returns the look of a two-sided roof over `span` metres. `line` has the options of its own line, `house` those
    /// of the whole house.
    pub fn gable(line: Option<&RoofStyle>, house: &RoofStyle, span: f64, unit: f64) -> Look {
        let mut look = Look::plain(line, house);
        look.shape = shape(line, house);
        let temple = look.shape == RoofShape::Temple;
        let breaks = matches!(look.shape, RoofShape::Gambrel | RoofShape::Mansard);
        let eaves = match temple {
            true => (TEMPLE_EAVES * span).clamp(2.5 * SHAKU, 12.0 * SHAKU),
            false if breaks => BROKEN_EAVES,
            false => 2.5 * SHAKU,
        };
        look.eaves = wish(line, house, |s| s.eaves).map_or_else(
            // Deep eaves round a narrow roof would look like an umbrella.
            || eaves.min(SHAKU.max(span / 3.0)),
            |shaku| shaku * SHAKU,
        );
        if temple && wish(line, house, |s| s.sori).is_none() {
            look.sori = TEMPLE_SORI / 100.0;
        }
        look.noshi =
            wish(line, house, |s| s.noshi).unwrap_or(if span > 8.0 * unit { 5 } else { 3 });
        let free = own_pitch(line, house).is_none();
        if free && breaks {
            look.pitch = broken::PITCH;
        } else if free && look.kind == RoofKind::Tiles {
            let run = span / 2.0 + look.eaves;
            look.pitch = raised(run).max(if temple { TEMPLE_PITCH } else { 0.0 });
        }
        look.bounded()
    }

    /// Returns the look of a single slope over `depth` metres.
    pub fn lean_to(line: Option<&RoofStyle>, house: &RoofStyle, depth: f64) -> Look {
        let mut look = Look::plain(line, house);
        let eaves = wish(line, house, |s| s.eaves).map(|shaku| shaku * SHAKU);
        look.eaves = eaves.unwrap_or((2.0 * SHAKU).min(SHAKU.max(depth / 2.0)));
        if line.and_then(|s| s.pitch).is_none() {
            look.pitch = look.pitch.min(LEAN_TO_PITCH);
        }
        look.bounded()
    }

    fn plain(line: Option<&RoofStyle>, house: &RoofStyle) -> Look {
        let kind = wish(line, house, |s| s.kind).unwrap_or(RoofKind::Tiles);
        let (pitch, thickness) = defaults(kind);
        let barge = match shape(line, house) {
            RoofShape::Temple => TEMPLE_BARGE,
            _ => BARGE,
        };
        let thickness = wish(line, house, |s| s.thickness).map_or(thickness, |shaku| shaku * SHAKU);
        let offset = wish(line, house, |s| s.offset).map_or(0.0, |shaku| shaku * SHAKU);
        Look {
            shape: RoofShape::LeanTo,
            kind,
            pitch: own_pitch(line, house).map_or(pitch, |sun| sun / 10.0),
            eaves: 2.5 * SHAKU,
            verge: wish(line, house, |s| s.verge).unwrap_or(0.5) * SHAKU,
            barge: wish(line, house, |s| s.verge).map_or(barge, |shaku| shaku * SHAKU),
            sori: wish(line, house, |s| s.sori).unwrap_or(0.0) / 100.0,
            gable: wish(line, house, |s| s.gable),
            ratio: wish(line, house, |s| s.ratio),
            thickness,
            gap: (offset - thickness).max(0.0),
            noshi: wish(line, house, |s| s.noshi).unwrap_or(3),
            ends: !wish(line, house, |s| s.plain_ridge).unwrap_or(false),
            lattice: wish(line, house, |s| s.gable_wall).map_or_else(
                // Tile and thatch on houses are over walls of plaster or clay.
                || shape(line, house) == RoofShape::Temple || is_solemn(kind),
                |wall| wall == GableWall::Lattice,
            ),
            paint: wish(line, house, |s| s.paint),
        }
    }

    /// Limits the values to what can be built: the readers admit any finite number.
    fn bounded(mut self) -> Look {
        self.pitch = self.pitch.clamp(0.005, 5.0);
        self.eaves = self.eaves.clamp(0.0, 10.0);
        self.verge = self.verge.clamp(0.0, 10.0);
        self.barge = self.barge.clamp(0.02, 10.0);
        self.thickness = self.thickness.clamp(0.02, 2.0);
        self.gap = self.gap.clamp(0.0, 2.0);
        self.sori = self.sori.clamp(-0.5, 0.5);
        self.gable = self.gable.map(|c| c.clamp(0.0, 0.5));
        self.ratio = self.ratio.map(|r| r.clamp(0.0, 1.0));
        self.noshi = self.noshi.min(40);
        self
    }

    /// Returns the vertical thickness, metres.
    pub fn drop(&self) -> f64 {
        upright(self.thickness, self.pitch)
    }

    /// Returns how far the upper surface lies above the slope over the walls, measured upright, metres.
    pub fn lift(&self) -> f64 {
        upright(self.thickness + self.gap, self.pitch)
    }

    /// Returns how far the lower surface lies above the slope over the walls, measured upright, metres.
    pub fn gap(&self) -> f64 {
        upright(self.gap, self.pitch)
    }

    /// Returns its trim.
    pub fn trim(&self) -> Trim {
        let upper_gable = matches!(self.shape, RoofShape::HipAndGable | RoofShape::Temple);
        Trim {
            eaves: self.eaves,
            verge: if upper_gable { self.barge } else { self.verge },
            noshi: self.noshi,
            ends: self.ends,
            crowned: false,
            pendant: upper_gable || self.shape == RoofShape::Karahafu,
            lattice: upper_gable && self.lattice,
            timber: self.paint.map(|paint| SurfaceId::named(paint.surface())),
            rafters: if self.shape == RoofShape::Temple {
                2
            } else {
                1
            },
            arch: None,
        }
    }

    /// Returns the finishes of its slopes.
    pub fn coat(&self) -> Coat {
        Coat {
            top: Finish::Covering(self.kind),
            rim: Finish::Edge(self.kind),
            joint: Finish::Plaster,
            soffit: Finish::Soffit,
        }
    }
}

/// Returns the form of a two-sided roof; a line without one is a gable, whatever the house has.
fn shape(line: Option<&RoofStyle>, house: &RoofStyle) -> RoofShape {
    let shape = line.map_or(house.shape, |s| s.shape);
    match shape.map_or(RoofShape::Gable, |s| s.value) {
        RoofShape::LeanTo | RoofShape::Pent | RoofShape::Flat => RoofShape::Gable,
        shape if shape.stands_on_another() => RoofShape::Gable,
        shape => shape,
    }
}

/// Returns the pitch as written, in sun; the house's only for its own covering.
fn own_pitch(line: Option<&RoofStyle>, house: &RoofStyle) -> Option<f64> {
    let Some(line) = line else {
        return house.pitch.map(|p| p.value);
    };
    let kind = |s: &RoofStyle| s.kind.map(|k| k.value);
    let other = kind(line).is_some() && kind(line) != kind(house);
    let inherited = if other { None } else { house.pitch };
    line.pitch.or(inherited).map(|p| p.value)
}

/// Returns an option of the line, otherwise of the house.
fn wish<T: Copy>(
    line: Option<&RoofStyle>,
    house: &RoofStyle,
    option: fn(&RoofStyle) -> Option<Spanned<T>>,
) -> Option<T> {
    line.and_then(option)
        .or_else(|| option(house))
        .map(|s| s.value)
}

/// Returns true for the coverings of temples, shrines and palaces.
fn is_solemn(kind: RoofKind) -> bool {
    use RoofKind::{Bark, CoverTiles, Shingles};
    matches!(kind, CoverTiles | Bark | Shingles)
}

/// Returns pitch and thickness by covering (docs/evidence.md 6 and 4.4).
fn defaults(kind: RoofKind) -> (f64, f64) {
    match kind {
        RoofKind::Tiles => (0.40, 0.12),
        RoofKind::CoverTiles => (0.55, 0.15),
        RoofKind::Boards => (0.25, 0.05),
        RoofKind::Shingles => (0.35, 0.10),
        RoofKind::Bark => (0.60, 0.25),
        RoofKind::Thatch => (1.00, 0.60),
        RoofKind::Metal => (0.25, 0.05),
    }
}

/// Returns the pitch of tiles over a horizontal run: the gentlest that suits the length of its slope.
fn raised(run: f64) -> f64 {
    let slope = |pitch: f64| run * (1.0 + pitch * pitch).sqrt();
    let fits = TILE_PITCHES
        .iter()
        .find(|(length, pitch)| slope(*pitch) <= *length);
    fits.map_or(0.60, |(_, pitch)| *pitch)
}

/// Returns the range of pitches in sun that suit a covering (docs/evidence.md 4.3, with some tolerance).
pub fn band(kind: RoofKind) -> (f64, f64) {
    match kind {
        RoofKind::Tiles => (2.5, 10.0),
        RoofKind::CoverTiles => (4.0, 10.0),
        RoofKind::Boards => (1.5, 6.0),
        RoofKind::Shingles => (2.0, 8.0),
        RoofKind::Bark => (4.0, 12.0),
        RoofKind::Thatch => (6.0, 15.0),
        RoofKind::Metal => (0.5, 15.0),
    }
}

#[cfg(test)]
mod tests {
    use crate::shape::look::*;
    use hsd_base::source::Span;

    fn style(kind: RoofKind, pitch: Option<f64>) -> RoofStyle {
        RoofStyle {
            kind: Some(Spanned::new(kind, Span::default())),
            pitch: pitch.map(|p| Spanned::new(p, Span::default())),
            ..RoofStyle::default()
        }
    }

    #[test]
    fn long_slopes_of_tiles_are_steeper_unless_the_author_says_so() {
        let none = RoofStyle::default();
        assert_eq!(Look::gable(None, &none, 5.4, 0.909).pitch, 0.40);
        assert_eq!(Look::gable(None, &none, 16.0, 0.909).pitch, 0.45);
        assert_eq!(Look::gable(None, &none, 32.0, 0.909).pitch, 0.60);
        let own = style(RoofKind::Tiles, Some(3.5));
        assert_eq!(Look::gable(None, &own, 32.0, 0.909).pitch, 0.35);
    }

    /// The table of docs/evidence.md 4.3 goes by the length of the slope, which is longer than its plan.
    #[test]
    fn the_pitch_of_tiles_goes_by_the_length_of_the_slope() {
        for (run, pitch) in [(7.40, 0.40), (7.50, 0.45), (9.10, 0.45), (9.15, 0.50)] {
            assert_eq!(raised(run), pitch, "{run} m in plan");
        }
    }

    #[test]
    fn another_covering_does_not_take_the_pitch_of_the_house() {
        let (house, line) = (
            style(RoofKind::Tiles, Some(5.0)),
            style(RoofKind::Thatch, None),
        );
        assert_eq!(Look::gable(Some(&line), &house, 5.4, 0.909).pitch, 1.0);
        let tiled = style(RoofKind::Tiles, None);
        assert_eq!(Look::gable(Some(&tiled), &house, 5.4, 0.909).pitch, 0.5);
    }
}
