//! Panels: rectangles of a wall plane that show small elements as one image.

use crate::mesh::{Bodies, Soup};
use hsd_ir::material::SurfaceId;

/// A rectangle in x and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) x0: f64,
    pub(crate) x1: f64,
    pub(crate) z0: f64,
    pub(crate) z1: f64,
}

impl Rect {
    pub(crate) fn width(&self) -> f64 {
        self.x1 - self.x0
    }

    pub(crate) fn height(&self) -> f64 {
        self.z1 - self.z0
    }

    /// Returns the rectangle shrunk by `x` at left and right, and by `z` at bottom and top.
    pub(crate) fn shrunk(&self, x: f64, z: f64) -> Rect {
        Rect {
            x0: self.x0 + x,
            x1: self.x1 - x,
            z0: self.z0 + z,
            z1: self.z1 - z,
        }
    }

    /// Returns another rectangle as shares of the width and height of this one.
    pub(crate) fn shares_of(&self, other: Rect) -> Rect {
        Rect {
            x0: (other.x0 - self.x0) / self.width(),
            x1: (other.x1 - self.x0) / self.width(),
            z0: (other.z0 - self.z0) / self.height(),
            z1: (other.z1 - self.z0) / self.height(),
        }
    }

    /// Returns the part of the rectangle with these shares of its width and height.
    pub(crate) fn part(&self, shares: Rect) -> Rect {
        Rect {
            x0: self.x0 + shares.x0 * self.width(),
            x1: self.x0 + shares.x1 * self.width(),
            z0: self.z0 + shares.z0 * self.height(),
            z1: self.z0 + shares.z1 * self.height(),
        }
    }

    /// Returns the rectangle with another extent in x.
    pub(crate) fn across(&self, x0: f64, x1: f64) -> Rect {
        Rect { x0, x1, ..*self }
    }

    /// Returns the rectangle with another extent in z.
    pub(crate) fn between(&self, z0: f64, z1: f64) -> Rect {
        Rect { z0, z1, ..*self }
    }
}

/// Small elements shown as one image.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    /// The area it covers.
    pub(crate) rect: Rect,
    /// Distance of its plane outside the centre line, metres.
    pub(crate) front: f64,
    /// The geometry to bake; none of a panel that is only measured.
    pub(crate) soups: Vec<(SurfaceId, Soup)>,
}

/// Returns the area of soups and their front, outside the centre line; `None` if they have no extent.
pub(crate) fn extent(soups: &[(SurfaceId, Soup)]) -> Option<(Rect, f64)> {
    extent_of(soups.iter().flat_map(|(_, s)| &s.positions))
}

impl Bodies {
    /// As [`extent`], with what is only measured.
    pub(crate) fn extent(&self) -> Option<(Rect, f64)> {
        let drawn = self.soups.iter().flat_map(|(_, s)| &s.positions);
        let measured = self.measured.iter().flatten();
        extent_of(drawn.chain(measured.filter(|p| p[0].is_finite())))
    }
}

/// Returns the area of points and their front.
fn extent_of<'p>(points: impl Iterator<Item = &'p [f32; 3]>) -> Option<(Rect, f64)> {
    let nothing = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    let (low, high) = points.fold(nothing, |(low, high), p| {
        (
            std::array::from_fn(|k| low[k].min(p[k])),
            std::array::from_fn(|k| high[k].max(p[k])),
        )
    });
    let ([x0, y0, z0], [x1, _, z1]) = (low.map(f64::from), high.map(f64::from));
    let rect = Rect { x0, x1, z0, z1 };
    let has_area = rect.width() > 1e-3 && rect.height() > 1e-3;
    has_area.then_some((rect, -y0))
}

/// Returns the panes of a panel: one rectangle behind each of its glass surfaces.
pub(crate) fn panes(panel: &Panel) -> impl Iterator<Item = (SurfaceId, Rect)> {
    let glass = panel.soups.iter().filter(|(id, _)| id.surface().glass);
    glass.filter_map(|(id, soup)| {
        let (rect, _) = extent_of(soup.positions.iter())?;
        Some((*id, rect))
    })
}
