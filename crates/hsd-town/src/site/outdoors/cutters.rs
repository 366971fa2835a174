//! Convex rings that are taken out of others.

use crate::shape::contains;
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::clip::without;
use hsd_base::geometry::grid::{Bounds, Grid, bounds};
use hsd_base::text;

/// The most others that a ring of a feature may meet, on average, and the most meetings of a few rings. Each cuts the others, so a
/// line that is scribbled over itself would take the square of its length.
const MEET: [usize; 2] = [32, 500_000];

/// Convex rings with the index of their boxes.
pub(super) struct Cutters<'r> {
    rings: &'r [Vec<DVec2>],
    index: Grid,
}

impl<'r> Cutters<'r> {
    pub(super) fn new(rings: &'r [Vec<DVec2>]) -> Cutters<'r> {
        let boxes = rings.iter().map(|ring| box_of(ring)).collect();
        Cutters {
            rings,
            index: Grid::new(boxes),
        }
    }

    /// Returns those whose boxes meet that of a ring, in their order.
    pub(super) fn near(&self, ring: &[DVec2]) -> impl Iterator<Item = &'r Vec<DVec2>> {
        let near = self.index.near(box_of(ring)).into_iter();
        near.map(|n| &self.rings[n as usize])
    }

    /// Returns what they leave of a convex ring.
    pub(super) fn cut(&self, ring: &[DVec2]) -> Vec<Vec<DVec2>> {
        let near: Vec<Vec<DVec2>> = self.near(ring).cloned().collect();
        without(vec![ring.to_vec()], &near)
    }

    /// Returns what they leave of convex rings.
    pub(super) fn cut_all(&self, rings: &[Vec<DVec2>]) -> Vec<Vec<DVec2>> {
        rings.iter().flat_map(|ring| self.cut(ring)).collect()
    }

    /// Returns true if a place lies in one of them.
    pub(super) fn cover(&self, at: DVec2) -> bool {
        let mut near = self.index.near([at; 2]).into_iter();
        near.any(|n| contains(&self.rings[n as usize], at))
    }
}

/// The meetings of rings of a feature that are still allowed.
pub(super) struct Meetings {
    left: usize,
    most: usize,
}

impl Meetings {
    /// Returns how often this many rings may meet each other.
    pub(super) fn among(count: usize) -> Meetings {
        let most = MEET[1].max(MEET[0] * count);
        Meetings { left: most, most }
    }

    /// Takes the meetings of rings with those that cut them.
    ///
    /// # Errors
    /// If they are more than may be.
    pub(super) fn take(&mut self, cutters: &Cutters<'_>, rings: &[Vec<DVec2>]) -> Result<(), Text> {
        let boxes = rings.iter().map(|ring| box_of(ring));
        self.take_boxes(&cutters.index, boxes)
    }

    /// Takes the meetings of boxes with those of an index.
    ///
    /// # Errors
    /// If they are more than may be.
    pub(super) fn take_boxes(
        &mut self,
        index: &Grid,
        boxes: impl IntoIterator<Item = Bounds>,
    ) -> Result<(), Text> {
        let most = self.most;
        for around in boxes {
            let Some(found) = index.near_at_most(around, self.left) else {
                return Err(text!([most]
                    "its lines or sides meet each other more than {most} times",
                    "線や辺どうしの交わりが {most} 箇所を超えます"
                ));
            };
            self.left -= found.len();
        }
        Ok(())
    }
}

fn box_of(ring: &[DVec2]) -> Bounds {
    bounds(ring.iter().copied()).unwrap_or_default()
}
