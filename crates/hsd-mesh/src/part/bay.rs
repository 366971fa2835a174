//! A bay: the frame in which a part's bodies are made. x runs from 0 at the left end to the width, y into the house, z
//! up; all in metres. Elements are placed in rectangles of it.

use crate::mesh::panel::Rect;
use crate::mesh::{Axis, Bodies, THIN};
use glam::{DVec2, dvec2, dvec3};
use hsd_base::geometry::FOUNDATION;
use hsd_ir::catalog::body::Place;
use hsd_ir::catalog::value::{Area, Level};
use hsd_ir::catalog::{PartDef, Stance};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Half of a 4 sun post, metres: the distance of joinery from the ends of its bay.
pub(crate) const HALF_POST: f64 = 0.0605;

/// A layer of the wall: its front, outwards from the centre line, and its depth inwards; metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layer {
    pub(crate) front: f64,
    pub(crate) thick: f64,
}

/// A part under construction.
pub(crate) struct Bay<'a> {
    pub(crate) part: &'a PartDef,
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// The area between the posts, over the full height.
    pub(crate) clear: Rect,
    /// The area between the posts, from the part's foot to its top.
    pub(crate) opening: Rect,
    /// The surface of infill walls.
    pub(crate) around: SurfaceId,
    /// The level of detail.
    pub(crate) detail: Detail,
    /// True if the adjacent posts are in the part's image; posts written in the source file are geometry.
    pub(crate) pictured: bool,
    /// Depth of the house behind the bay, metres.
    pub(crate) room: f64,
    /// True if it stands on the ground, which a wing wall reaches down to.
    pub(crate) grounded: bool,
    /// True if its panels are only measured, since their images are there already.
    pub(crate) measured: bool,
    pub(crate) bodies: Bodies,
}

impl<'a> Bay<'a> {
    /// Creates a bay of a width and height with an opening between two heights, metres.
    pub(crate) fn new(
        part: &'a PartDef,
        (width, height): (f64, f64),
        (z0, z1): (f64, f64),
        around: SurfaceId,
        detail: Detail,
        posts: Option<f64>,
    ) -> Bay<'a> {
        let post = match part.stance {
            Stance::Posts => posts.unwrap_or(HALF_POST).min(width / 4.0),
            _ => 0.0,
        };
        let whole = Rect {
            x0: 0.0,
            x1: width,
            z0: 0.0,
            z1: height,
        };
        let clear = whole.shrunk(post, 0.0);
        let narrow = part.clear.map_or(clear.width(), |c| c.0.min(clear.width()));
        let side = (width - narrow) / 2.0;
        let opening = Rect {
            x0: side,
            x1: width - side,
            z0,
            z1,
        };
        Bay {
            part,
            width,
            height,
            clear,
            opening,
            around,
            detail,
            pictured: posts.is_none(),
            room: crate::part::DEEPEST,
            grounded: false,
            measured: false,
            bodies: Bodies::default(),
        }
    }

    /// Returns the whole area of the bay.
    pub(crate) fn whole(&self) -> Rect {
        Rect {
            x0: 0.0,
            x1: self.width,
            z0: 0.0,
            z1: self.height,
        }
    }

    /// Returns the rectangle of an element; `None` if the bay is too small for it.
    pub(crate) fn rect(&self, place: &Place, inside: Option<Rect>) -> Option<Rect> {
        let area = inside.unwrap_or(match place.over {
            Area::Bay => self.whole(),
            Area::Clear => self.clear,
            Area::Opening => self.opening,
            Area::Above => self.clear.between(self.opening.z1, self.height),
            Area::Below => self.clear.between(0.0, self.opening.z0),
        });
        // What stands before the house reaches down past its foundation, if its list says so.
        let low = match place.from {
            Level::Start(from) if from < 0.0 => -FOUNDATION,
            _ => 0.0,
        };
        // A share of the width is one between the posts wherever it stands, so that what ends there meets what begins
        // there; only ends and measured edges reach under the posts.
        let shared = inside.unwrap_or(match place.over {
            Area::Bay => self.clear,
            _ => area,
        });
        let across = |level: Level| match level {
            Level::Share(_) => level.at(shared.x0, shared.x1),
            _ => level.at(area.x0, area.x1),
        };
        let rect = Rect {
            x0: across(place.left).max(0.0),
            x1: across(place.right).min(self.width),
            z0: place.from.at(area.z0, area.z1).max(low),
            z1: place.to.at(area.z0, area.z1).min(self.height),
        };
        // Posts and wings have no width.
        let wide = rect.width() >= THIN || self.width == 0.0;
        (wide && rect.height() >= THIN).then_some(rect)
    }

    /// Adds a box over a rectangle in a layer.
    pub(crate) fn block(&mut self, finish: SurfaceId, rect: Rect, layer: Layer) {
        let (y0, y1) = (-layer.front, -layer.front + layer.thick);
        self.bodies.block(
            finish,
            dvec3(rect.x0, y0, rect.z0),
            dvec3(rect.x1, y1, rect.z1),
        );
    }

    /// Adds a profile extruded along x: corners are (outwards from the centre line, up), in either orientation.
    pub(crate) fn profile(&mut self, finish: SurfaceId, outline: &[(f64, f64)], x0: f64, x1: f64) {
        let outline: Vec<DVec2> = outline.iter().map(|(out, z)| dvec2(-out, *z)).collect();
        if x1 - x0 >= THIN {
            self.bodies.prism(finish, &outline, Axis::X, x0, x1);
        }
    }
}

impl From<&Place> for Layer {
    fn from(place: &Place) -> Layer {
        Layer {
            front: place.front.0,
            thick: place.thick.0,
        }
    }
}
