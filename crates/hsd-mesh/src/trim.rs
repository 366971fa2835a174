//! Roof trim beyond the solids: ridge tiles, end tiles, eaves and verge tiles, barge boards, rafters.
//!
//! The lines to trim are read off the finished solids ([`seams`]), so that they are correct after every junction and
//! for every shape; sizes come from `docs/evidence.md` 4.4 and the parameters in [`Trim`]. All trim consists of closed
//! bodies that extend slightly into their support, so that no two faces are coplanar.
//!
//! | detail | shows |
//! |---|---|
//! | 0 | nothing: the roof is its surface |
//! | 1 | ridges, hips and descending ridges as plain blocks, finials, end tiles, barge boards and the boards before great rafters |
//! | 2 | silhouettes: ridge courses as a picture under a round cap, end tiles, pendants, thick eaves, fascias, plain eaves and verge tiles, flashings, valley gutters |
//! | 3 | ridge courses and cap tiles one by one, rafters, the fronts of eaves tiles, rows of round tiles, battens and stones, standing seams |
//!
//! [`Trim`]: hsd_ir::building::Trim

mod body;
mod line;
mod neighbours;
mod edge;
mod ridge;
mod run;
mod seams;
mod slope;
mod stones;
mod surface;
mod tiles;

#[cfg(test)]
mod tests;

use crate::mesh::Soup;
pub(super) use body::Body;
use hsd_ir::ast::RoofKind;
use hsd_ir::building::{HouseRoofs, Roof};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
pub(super) use neighbours::Neighbours;
pub(super) use run::{Row, Run};
pub(super) use seams::Beyond;
use seams::{Kind, Seam};
use slope::Field;
pub(super) use slope::Twist;
use surface::Surface;

/// A roof whose trim is under construction.
struct TrimContext<'a> {
    roof: &'a Roof,
    surface: &'a Surface,
    detail: Detail,
    /// True if no timber shows under eaves and verges.
    plastered: bool,
}

/// The trim of a roof at one detail.
#[derive(Debug, Default)]
pub(super) struct TrimDetail {
    /// Bodies that are unique to this roof.
    pub(super) bodies: Vec<Body>,
    /// Rows of bodies that other roofs may share.
    pub(super) runs: Vec<Run>,
}

/// Builds the trim of a roof of a house at a detail; `beyond` describes the surfaces at its joints, `plastered` is true if the
/// walls below are plastered over their posts.
pub(super) fn build(
    (roofs, number): (&HouseRoofs, usize),
    beyond: &Beyond,
    plastered: bool,
    detail: Detail,
) -> TrimDetail {
    let mut worn = TrimDetail::default();
    if detail == Detail::Body {
        return worn;
    }
    let (roof, surface) = (&roofs.roofs[number], &roofs.surfaces()[number]);
    let surface = Surface::of(surface);
    if surface.facets.is_empty() {
        return worn;
    }
    let context = TrimContext {
        roof,
        surface: &surface,
        detail,
        plastered,
    };
    let fields = match edge::rafters::are_shown(&context) || detail > Detail::Flat {
        true => Field::all(&surface),
        false => vec![],
    };
    let seams = surface.seams(beyond);
    for seam in &seams {
        context.seam(seam, &fields, &mut worn.bodies);
        if seam.kind == Kind::Verge {
            ridge::descending::beside(&context, seam, &seams, &mut worn.bodies);
        }
    }
    edge::lattice::lattices(&context, &seams, &mut worn.bodies);
    crate::trim::ridge::finial::finials(&context, &seams, &mut worn.bodies);
    for rim in crate::trim::edge::rim::rims(&surface) {
        crate::trim::ridge::stack::edge(&context, &rim, &mut worn.bodies);
    }
    if detail == Detail::Everything {
        for field in &fields {
            context.slope(field, &mut worn.bodies);
        }
        if roof.kind == RoofKind::CoverTiles {
            crate::trim::edge::rows::cover_tiles(&fields, &mut worn.bodies);
        }
    }
    worn.runs = run::take(&mut worn.bodies);
    worn
}

impl TrimContext<'_> {
    fn seam(&self, seam: &Seam, fields: &[Field], bodies: &mut Vec<Body>) {
        let tiled = matches!(self.roof.kind, RoofKind::Tiles | RoofKind::CoverTiles);
        match seam.kind {
            Kind::Ridge | Kind::Hip => {
                match tiled {
                    true => ridge::tiles(self, seam, bodies),
                    false => crate::trim::ridge::crown::ridge(self, seam, bodies),
                }
                if seam.kind == Kind::Hip && !self.plastered {
                    crate::trim::edge::rafters::hip(self, seam, bodies);
                }
            }
            Kind::Eaves => {
                match self.roof.kind {
                    RoofKind::Tiles => tiles::eaves(self, fields, seam, bodies),
                    RoofKind::CoverTiles => {
                        crate::trim::edge::rows::eaves(self, fields, seam, bodies)
                    }
                    _ => {}
                }
                match self.plastered {
                    true => crate::trim::edge::plaster::bands(self, seam, bodies),
                    false => crate::trim::edge::rafters::eaves(self, fields, seam, bodies),
                }
            }
            Kind::Verge => {
                match self.plastered {
                    true => crate::trim::edge::plaster::bands(self, seam, bodies),
                    false => crate::trim::edge::barge::boards(self, seam, bodies),
                }
                crate::trim::edge::arched::rafters(self, seam, bodies);
                if tiled {
                    tiles::verge(self, seam, bodies);
                }
            }
            Kind::Valley => crate::trim::edge::flashing::valley(self, seam, bodies),
            Kind::Crest | Kind::Flank => crate::trim::edge::flashing::wall(self, seam, bodies),
        }
    }

    /// Returns the surface of its timber.
    fn timber(&self) -> SurfaceId {
        self.roof.trim.timber.unwrap_or(SurfaceId::named("cedar"))
    }

    /// Adds the trim on the slope itself.
    fn slope(&self, field: &Field, bodies: &mut Vec<Body>) {
        match self.roof.kind {
            RoofKind::Metal => crate::trim::edge::rows::seams(field, bodies),
            RoofKind::Boards => stones::battens(field, bodies),
            _ => {}
        }
    }

    /// Returns the steepest fall of the covering beside a seam, metres per metre across it.
    fn lean(&self, seam: &Seam) -> f64 {
        let ways = seam.points.windows(2).map(|w| w[1] - w[0]);
        let leans = seam.spans.iter().zip(ways);
        leans
            .flat_map(|(span, way)| self.surface.leans(span, way))
            .fold(0.0, f64::max)
    }
}

/// Adds bodies to the soups of their surfaces.
pub(super) fn pour(bodies: &[Body], soups: &mut Vec<(SurfaceId, Soup)>) {
    for body in bodies {
        let at = soups.iter().position(|(finish, _)| *finish == body.finish);
        let at = at.unwrap_or_else(|| {
            soups.push((body.finish, Soup::default()));
            soups.len() - 1
        });
        body.pour(&mut soups[at].1);
    }
}
