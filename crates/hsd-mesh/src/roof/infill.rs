//! Gable infill over walls that are plastered over their posts: it is flush with the wall below instead of set back between posts.

use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::HEIGHT;
use hsd_ir::building::{Finish, Roof, Solid};
use hsd_ir::catalog::{Catalog, Stance, body::Shape, value::Level};
use hsd_ir::material::SurfaceId;
use hsd_ir::program::Content;
use hsd_roof::solid::{INFILL_THICKNESS, SUNK};

/// Distance of the infill behind the face of the wall, metres: the two lap a little and must not lie in one plane.
const BEHIND: f64 = 0.001;

/// Position of the outer face of a wall in front of its line, and the thickness of the wall, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Faces {
    front: f64,
    thick: f64,
}

impl Faces {
    /// Returns the faces at the top of a wall without visible posts; `None` of any other part.
    pub(crate) fn of(catalog: &Catalog, content: &Content) -> Option<Faces> {
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
pub(crate) fn is_fill(solid: &Solid) -> bool {
    solid
        .faces
        .first()
        .is_some_and(|f| f.finish == Finish::Gable)
}

/// Surface of a gable infill, and the wall below with which it is flush, if any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Infill {
    pub(crate) surface: SurfaceId,
    pub(crate) flush: Option<Flush>,
}

impl Infill {
    /// Returns infill that stays between the posts.
    pub(crate) fn plain(surface: SurfaceId) -> Infill {
        Infill {
            surface,
            flush: None,
        }
    }
}

/// The wall with which infill is flush: its line in plan, metres, and its faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flush {
    pub(crate) outward: DVec2,
    pub(crate) line: f64,
    pub(crate) faces: Faces,
}

impl Flush {
    /// Returns how far a point lies before the line of the wall, metres.
    fn before(&self, p: &DVec3) -> f64 {
        self.outward.dot(p.truncate()) - self.line
    }

    /// Returns how far before the line of the wall the outer face of an infill comes to lie: as far as these faces, but no further
    /// out than its roof covers; `None` if it lies there already.
    fn front(&self, fill: &Solid, roofs: &[Roof]) -> Option<f64> {
        let slabs = roofs.iter().flat_map(Roof::bodies).filter(|s| !is_fill(s));
        let verge = slabs.flat_map(|s| &s.points);
        let verge = verge.map(|p| self.before(p)).fold(f64::MIN, f64::max);
        let front = (self.faces.front - BEHIND).min(verge - SUNK / 2.0);
        let back = self.faces.front - self.faces.thick;
        (front > back && front > self.outer(fill)).then_some(front)
    }

    fn outer(&self, fill: &Solid) -> f64 {
        let points = fill.points.iter().map(|p| self.before(p));
        points.fold(f64::MIN, f64::max)
    }

    /// Returns the infill moved to these faces.
    pub(crate) fn laid(&self, fill: &Solid, roofs: &[Roof]) -> Solid {
        let mut laid = fill.clone();
        if let Some(front) = self.front(fill, roofs) {
            let back = self.faces.front - self.faces.thick;
            // Fills of a narrow verge begin behind their own usual face.
            let inner = self.outer(fill) - INFILL_THICKNESS;
            for p in &mut laid.points {
                let share = (self.before(p) - inner) / INFILL_THICKNESS;
                let by = self.outward * (back + (front - back) * share - self.before(p));
                *p += by.extend(0.0);
            }
        }
        laid
    }

    /// Moves the gable of a massive roof to these faces: slopes and floors run in that direction, so that they stay plane.
    pub(crate) fn lay(&self, fill: &Solid, roofs: &[Roof], whole: &mut [Solid]) {
        let Some(front) = self.front(fill, roofs) else {
            return;
        };
        let side = self.outward.perp();
        let along = fill.points.iter().map(|p| side.dot(p.truncate()));
        let (from, to) = along.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        // Massive gables fill the corner under the eaves as well.
        let near = INFILL_THICKNESS;
        let on_wall = |p: &DVec3| {
            let x = side.dot(p.truncate());
            self.before(p).abs() < near && (from - near..=to + near).contains(&x)
        };
        for solid in whole {
            let gables = solid.faces.iter().filter(|f| f.finish == Finish::Gable);
            let gables = gables.filter(|f| {
                let corners = f.corners.iter().map(|c| &solid.points[*c as usize]);
                let depths = corners.clone().map(|p| self.before(p));
                let (least, most) =
                    depths.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
                // The outer face alone: ends run through the wall, and what lies in its line belongs to something else.
                most - least < HEIGHT && least > HEIGHT && corners.clone().all(on_wall)
            });
            let mut moved: Vec<u32> = gables.flat_map(|f| f.corners.iter().copied()).collect();
            moved.sort_unstable();
            moved.dedup();
            for corner in moved {
                let p = &mut solid.points[corner as usize];
                *p += (self.outward * (front - self.before(p))).extend(0.0);
            }
        }
    }
}
