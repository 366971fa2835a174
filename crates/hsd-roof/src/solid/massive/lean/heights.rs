//! The points over the corners of a plan.

use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::JOINT;

/// The heights over corners, each once: slabs, fillings and slopes side by side have most of them in common.
pub(super) struct Heights {
    /// The last height over each corner.
    last: Vec<u32>,
    /// Heights, each with the one before it over the same corner.
    all: Vec<(f64, u32)>,
}

impl Heights {
    const NONE: u32 = u32::MAX;

    pub(super) fn over(corners: usize, count: usize) -> Heights {
        Heights {
            last: vec![Self::NONE; corners],
            all: Vec::with_capacity(count),
        }
    }

    /// Returns the number of a height.
    pub(super) fn number(&mut self, corner: u32, z: f64) -> u32 {
        let last = &mut self.last[corner as usize];
        let mut n = *last;
        while n != Self::NONE {
            let (known, before) = self.all[n as usize];
            if known.to_bits() == z.to_bits() {
                return n;
            }
            n = before;
        }
        self.all.push((z, *last));
        *last = self.all.len() as u32 - 1;
        *last
    }

    /// Returns the points over all corners, from below, and the number of its point for each height.
    pub(super) fn points(&self, corners: &[DVec2]) -> (Vec<DVec3>, Vec<u32>) {
        let mut points: Vec<DVec3> = Vec::with_capacity(self.all.len());
        let mut number = vec![0; self.all.len()];
        let mut over: Vec<(f64, u32)> = Vec::with_capacity(16);
        for (corner, &last) in corners.iter().zip(&self.last) {
            over.clear();
            let mut n = last;
            while n != Self::NONE {
                let (z, before) = self.all[n as usize];
                over.push((z, n));
                n = before;
            }
            over.sort_unstable_by(|p, q| p.0.total_cmp(&q.0));
            let mut last: Option<f64> = None;
            for &(z, n) in &over {
                if last.is_none_or(|last| z - last > JOINT) {
                    points.push(corner.extend(z));
                    last = Some(z);
                }
                number[n as usize] = points.len() as u32 - 1;
            }
        }
        (points, number)
    }
}
