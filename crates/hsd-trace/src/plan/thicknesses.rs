//! The thicknesses of hollow walls, weighted by length.

/// The greatest ratio of the thicknesses of walls of one kind.
pub(super) const ALIKE: f64 = 1.2;

/// The thicknesses of some walls in their order, each with the length of all walls up to it.
pub(super) struct Thicknesses(Vec<(f64, f64)>);

impl Thicknesses {
    /// Sorts walls, each a thickness and a length.
    pub(super) fn of(walls: impl Iterator<Item = (f64, f64)>) -> Thicknesses {
        let mut walls: Vec<(f64, f64)> = walls.collect();
        walls.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut sum = 0.0;
        for wall in &mut walls {
            sum += wall.1;
            wall.1 = sum;
        }
        Thicknesses(walls)
    }

    /// Returns the length of all walls with a thickness in a range.
    pub(super) fn length(&self, from: f64, to: f64) -> f64 {
        let before = |count: usize| count.checked_sub(1).map_or(0.0, |last| self.0[last].1);
        let start = self.0.partition_point(|wall| wall.0 < from);
        let end = self.0.partition_point(|wall| wall.0 <= to);
        before(end) - before(start)
    }

    /// Returns the least thickness of the commonest kind, and the length of its walls.
    pub(super) fn commonest(&self) -> Option<(f64, f64)> {
        let kinds = self.0.iter().map(|wall| wall.0);
        let kinds = kinds.map(|from| (from, self.length(from, ALIKE * from)));
        kinds.max_by(|a, b| a.1.total_cmp(&b.1))
    }
}
