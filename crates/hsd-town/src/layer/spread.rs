//! Places of the features of a map by cells of a coarse grid, so that a few wrong places do not move the town.

use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, bounds};
use hsd_map::{Crs, Projection, Transform};
use std::collections::BTreeMap;

/// Distance from the middle of the town beyond which a point is an outlier, metres.
pub(super) const FARTHEST: f64 = 50_000.0;

/// The sides of a cell.
const DEGREES: f64 = 0.25;
const METRES: f64 = 25_000.0;

/// Features by cells.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spread {
    /// The number of features in each cell and the box around them. The cell is that of the middle of the feature.
    cells: BTreeMap<[i32; 2], (usize, Bounds)>,
}

impl Spread {
    /// Adds a feature with these points.
    pub(super) fn add(&mut self, points: &[DVec2], crs: &Crs) {
        let Some([low, high]) = bounds(points.iter().copied()) else {
            return;
        };
        let side = match crs.projection {
            Projection::Degrees => DEGREES,
            _ => METRES,
        };
        // A feature wider than a cell has a wrong point, or its box says little about the position of the town.
        let [low, high] = match (high - low).max_element() < side {
            true => [low, high],
            false => [middle(points); 2],
        };
        let cell = (low.midpoint(high) / side).floor();
        let known = self
            .cells
            .entry([cell.x as i32, cell.y as i32])
            .or_insert((0, [low, high]));
        known.0 += 1;
        known.1 = joined(known.1, [low, high]);
    }

    /// Adds the features of another map in the same system.
    pub(crate) fn append(&mut self, other: &Spread) {
        for (cell, (count, bounds)) in &other.cells {
            let known = self.cells.entry(*cell).or_insert((0, *bounds));
            known.0 += count;
            known.1 = joined(known.1, *bounds);
        }
    }

    /// Returns the middle of the cell with the median of all features: of their columns, and of the rows in that column.
    pub(crate) fn median(&self) -> Option<DVec2> {
        let columns = self
            .cells
            .iter()
            .map(|(cell, (count, _))| (cell[0], *count));
        let column = median(columns)?;
        let rows = self.cells.range([column, i32::MIN]..=[column, i32::MAX]);
        let row = median(rows.map(|(cell, (count, _))| (cell[1], *count)))?;
        let (_, [low, high]) = self.cells.get(&[column, row])?;
        Some(low.midpoint(*high))
    }

    /// Returns true if most features are in the cells around the median, as those of a town in degrees are.
    pub(super) fn is_gathered(&self) -> bool {
        let Some(median) = self.median() else {
            return true;
        };
        let all: usize = self.cells.values().map(|(count, _)| count).sum();
        let near = |bounds: &Bounds| {
            let off = bounds[0].midpoint(bounds[1]) - median;
            off.abs().max_element() < 2.0 * DEGREES
        };
        let cells = self.cells.values();
        let gathered: usize = cells
            .filter(|(_, bounds)| near(bounds))
            .map(|(n, _)| n)
            .sum();
        2 * gathered > all
    }

    /// Returns the middle of the box around all features but outliers, those that lie too far from `median` in the plane of
    /// the town. In degrees a town may lie on both sides of the line where they jump from 180 to -180.
    pub(crate) fn centre(&self, median: DVec2, crs: &Crs, to_plane: &Transform) -> DVec2 {
        let Some(middle) = to_plane.apply(median) else {
            return median;
        };
        let turn: f64 = match crs.projection {
            Projection::Degrees => 360.0,
            _ => 0.0,
        };
        let near = |bounds: &Bounds| {
            let places = bounds.map(|corner| to_plane.apply(corner));
            let far = |place: DVec2| place.distance(middle) > FARTHEST;
            !places.iter().any(|place| place.is_none_or(far))
        };
        let unwrapped = |bounds: &Bounds| {
            let turns = (median.x - bounds[0].x) / turn.max(1.0);
            bounds.map(|corner| corner + DVec2::new(turns.round() * turn, 0.0))
        };
        let boxes = self.cells.values().map(|(_, bounds)| bounds);
        let all = boxes.filter(|bounds| near(bounds)).map(unwrapped);
        let [low, high] = all.reduce(joined).unwrap_or([median; 2]);
        low.midpoint(high)
    }
}

/// Returns the medians of the coordinates of points.
fn middle(points: &[DVec2]) -> DVec2 {
    let median = |of: fn(DVec2) -> f64| {
        let mut all: Vec<f64> = points.iter().copied().map(of).collect();
        let half = all.len() / 2;
        *all.select_nth_unstable_by(half, f64::total_cmp).1
    };
    DVec2::new(median(|p| p.x), median(|p| p.y))
}

fn joined([a, b]: Bounds, [c, d]: Bounds) -> Bounds {
    [a.min(c), b.max(d)]
}

/// Returns the median of ascending numbers, each with the number of its occurrences.
fn median(numbers: impl Iterator<Item = (i32, usize)> + Clone) -> Option<i32> {
    let all: usize = numbers.clone().map(|(_, count)| count).sum();
    let mut passed = 0;
    for (number, count) in numbers {
        passed += count;
        if 2 * passed >= all {
            return Some(number);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_map::Datums;

    /// Places as boxes without size, in degrees.
    fn spread(places: &[(f64, f64)]) -> Spread {
        let mut spread = Spread::default();
        for (lon, lat) in places {
            spread.add(&[DVec2::new(*lon, *lat)], &Crs::wgs84());
        }
        spread
    }

    fn centre(spread: &Spread) -> DVec2 {
        let median = spread.median().expect("has places");
        let plane = Crs::zone_at(median, &Crs::wgs84().datum);
        let to_plane = Transform::new(&Crs::wgs84(), &plane, Datums::Exact);
        spread.centre(median, &Crs::wgs84(), &to_plane.expect("is known"))
    }

    #[test]
    fn a_wrong_place_does_not_move_the_town() {
        let town = [(135.75, 35.0), (135.76, 35.01), (135.77, 35.02)];
        let with = [(0.0, 0.0), town[0], town[1], town[2], (135.76, 43.0)];
        let middle = centre(&spread(&town));
        assert!(
            middle.distance(DVec2::new(135.76, 35.01)) < 1e-9,
            "{middle}"
        );
        assert_eq!(centre(&spread(&with)), centre(&spread(&town)));
    }

    #[test]
    fn a_town_may_lie_on_the_date_line() {
        let middle = centre(&spread(&[(179.99, -17.0), (-179.99, -17.0)]));
        assert!((middle.x.abs() - 180.0).abs() < 1e-9, "{middle}");
    }

    #[test]
    fn a_feature_with_a_wrong_point_lies_with_its_other_points() {
        let mut spread = spread(&[(135.75, 35.0)]);
        let points = [(135.75, 35.01), (135.75, 35.01), (0.0, 0.0)];
        spread.add(&points.map(DVec2::from), &Crs::wgs84());
        let middle = centre(&spread);
        assert!(
            middle.distance(DVec2::new(135.75, 35.005)) < 1e-9,
            "{middle}"
        );
    }

    #[test]
    fn nothing_has_no_middle() {
        assert_eq!(Spread::default().median(), None);
    }
}
