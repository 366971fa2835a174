//! Gable infill over walls that are plastered over their posts: it is flush with the wall below instead of set back between posts.

use crate::building::{Finish, Roof, Solid};
use crate::catalog::{Catalog, Stance, body::Shape, value::Level};
use crate::material::SurfaceId;
use crate::program::Content;
use crate::roof::solid::{INFILL_THICKNESS, SUNK};
use glam::DVec2;

/// Distance of the infill behind the face of the wall, metres: the two lap a little and must not lie in one plane.
const BEHIND: f64 = 0.001;

/// Position of the outer face of a wall in front of its line, and the thickness of the wall, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::tessellate) struct Faces {
    front: f64,
    thick: f64,
}

impl Faces {
    /// Returns the faces at the top of a wall without visible posts; `None` of any other part.
    pub(in crate::tessellate) fn of(catalog: &Catalog, content: &Content) -> Option<Faces> {
        let Content::Part(id) = content else {
            return None;
        };
        let part = catalog.part(*id);
        let top = part.body.iter().filter(|e| {
            matches!(e.shape, Shape::Wall(_))
                && e.place.to == Level::End(0.0)
                && Some(e.place.finish) == part.finish
        });
        let faces = top.map(|e| Faces {
            front: e.place.front.0,
            thick: e.place.thick.0,
        });
        (part.stance == Stance::Bare)
            .then(|| faces.max_by(|p, q| p.front.total_cmp(&q.front)))
            .flatten()
    }
}

/// Returns true if a solid fills a gable.
pub(in crate::tessellate) fn is_fill(solid: &Solid) -> bool {
    solid
        .faces
        .first()
        .is_some_and(|f| f.finish == Finish::Gable)
}

/// Surface of a gable infill, and the wall below with which it is flush, if any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::tessellate) struct Infill {
    pub(in crate::tessellate) surface: SurfaceId,
    pub(in crate::tessellate) flush: Option<Flush>,
}

impl Infill {
    /// Returns infill that stays between the posts.
    pub(in crate::tessellate) fn plain(surface: SurfaceId) -> Infill {
        Infill {
            surface,
            flush: None,
        }
    }
}

/// The wall with which infill is flush: its line in plan, metres, and its faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::tessellate) struct Flush {
    pub(in crate::tessellate) outward: DVec2,
    pub(in crate::tessellate) line: f64,
    pub(in crate::tessellate) faces: Faces,
}

impl Flush {
    /// Returns the infill moved to these faces, but no further out than its roof covers.
    pub(in crate::tessellate) fn laid(&self, fill: &Solid, roofs: &[Roof]) -> Solid {
        let before = |p: &glam::DVec3| self.outward.dot(p.truncate()) - self.line;
        let slabs = roofs.iter().flat_map(|r| &r.solids).filter(|s| !is_fill(s));
        let verge = slabs
            .flat_map(|s| &s.points)
            .map(before)
            .fold(f64::MIN, f64::max);
        let (own, back) = (INFILL_THICKNESS / 2.0, self.faces.front - self.faces.thick);
        let front = (self.faces.front - BEHIND).min(verge - SUNK / 2.0);
        let outer = fill.points.iter().map(before).fold(f64::MIN, f64::max);
        // Fills of a narrow verge begin behind their own usual face.
        let inner = outer - 2.0 * own;
        if front <= back || front <= outer {
            return fill.clone();
        }
        let mut laid = fill.clone();
        for p in &mut laid.points {
            let share = (before(p) - inner) / (2.0 * own);
            let by = self.outward * (back + (front - back) * share - before(p));
            *p += by.extend(0.0);
        }
        laid
    }
}
