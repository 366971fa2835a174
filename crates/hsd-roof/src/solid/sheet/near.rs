//! Points near an edge in plan.

use glam::{DVec2, DVec3};

/// So many points are all looked at.
const FEW: usize = 24;

/// Points in the order of each plan coordinate.
pub(crate) struct Sorted([Vec<(f64, u32)>; 2]);

impl Sorted {
    pub(crate) fn of(points: &[DVec3]) -> Sorted {
        // Few are found faster without an order.
        let axes = if points.len() > FEW { 2 } else { 1 };
        Sorted([0, 1].map(|axis| {
            if axis >= axes {
                return vec![];
            }
            let at = |(id, p): (usize, &DVec3)| (p[axis], id as u32);
            let mut all: Vec<(f64, u32)> = points.iter().enumerate().map(at).collect();
            if axes > 1 {
                all.sort_unstable_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
            }
            all
        }))
    }

    /// Returns all points of a box in plan, and some beside it: the shorter of its two strips, since most edges run
    /// along one axis.
    pub(crate) fn near(&self, lo: DVec2, hi: DVec2) -> &[(f64, u32)] {
        if self.0[0].len() <= FEW {
            return &self.0[0];
        }
        let strip = |axis: usize| {
            let all = &self.0[axis];
            let start = all.partition_point(|p| p.0 < lo[axis]);
            let end = all.partition_point(|p| p.0 <= hi[axis]);
            all.get(start..end).unwrap_or_default()
        };
        let (x, y) = (strip(0), strip(1));
        if x.len() <= y.len() { x } else { y }
    }
}
