//! The role of each rectangle: main roof, branch running into its trunk, or lean-to
//! (domain 3.7, 3.8; seed 001 gives every region a gable by its long side, 001-20, and admits
//! that its small roofs come out wrong, 001-21).
//!
//! For each region, the first of these that applies:
//! 1. the street region: main, ridge parallel to the first line ("wins over everything"). Where the
//!    storey above stands behind the whole of it at most 2 units back, or a roof line's roof that a
//!    strip may lean on, a lean-to falling to the street: its upper edge is parallel to the first line;
//! 2. an upper storey's wall along a whole edge: a lean-to against it if at most 3 units deep,
//!    else a gable with the ridge running into the wall;
//! 3. its trunk, the largest region (at equal area the least (b0, a0)) with a larger area on
//!    whose side it lies with a whole edge, and the street region before any other and of any
//!    area, then one that a strip touches with its long side: a strip is a lean-to falling away
//!    from it, anything else a branch, ridge perpendicular to the edge. A branch wider than its
//!    trunk's span would stand higher: it becomes a main roof that runs [`Region::through`] the
//!    other. Its ridge keeps its direction, since along the trunk it would leave a valley;
//! 4. a strip at most 3 units deep and at least twice as long, an upper wall along at least
//!    half of it (round the corner of a smaller upper storey): a lean-to against that wall;
//! 5. main, ridge along the long side; a square's parallel to the first line.
//!
//! A strip is at most 2 units deep and at least twice as long, or at most 3 and more than 2.5 times. Nothing leans that
//! would fall against another roof: it becomes the gable of a link between the two (docs/contract.md 8).
//!
//! Roofs that the author wrote are trunks like any other, but for flat ones.

use crate::partition::{Method, partition};
use crate::plan::sides::{Sides, Walls};
use crate::region::{Beside, Region, Ridge, Role, Side};
use hsd_base::geometry::plan::{Cell, Plan};

/// The regions of one storey, sorted by (b0, a0); `over` and `through` refer to that order.
///
/// `plan` is the storey's plan or what of it is left open (`upper`, the plan of the storey
/// above, is taken off again), `street_front` the street region as found by
/// [`crate::plan::street::street_front`], cut off before the method is applied; `unit` is the number
/// of grid steps in one U, to compare "2 units" and "3 units". All in the author frame.
pub fn regions(
    plan: &Plan,
    upper: Option<&Plan>,
    method: Method,
    street_front: Option<Cell>,
    unit: i64,
) -> Vec<Region> {
    let cut = |open: &Plan| partition(open, method);
    regions_by(plan, upper, cut, street_front, unit, &[])
}

/// Returns the regions with a given cutting function, beside written roofs.
pub fn regions_by(
    plan: &Plan,
    upper: Option<&Plan>,
    cut: impl Fn(&Plan) -> Vec<Cell>,
    street_front: Option<Cell>,
    unit: i64,
    beside: &[Beside],
) -> Vec<Region> {
    if let (Some(_), None, None, []) = (plan.as_cell(), upper, street_front, beside)
        && let [only] = cut(plan)[..]
    {
        return vec![Region::main(only)];
    }
    let open = upper.map(|u| plan.difference(u));
    let open = open.as_ref().unwrap_or(plan);
    let mut cells = match street_front {
        Some(front) => cut(&open.minus_cells(&[front])),
        None => cut(open),
    };
    cells.extend(street_front);
    cells.sort_unstable_by_key(Cell::key);
    let street = street_front.and_then(|front| cells.iter().position(|c| *c == front));
    let count = cells.len();
    cells.extend(beside.iter().map(|b| b.roof.cell));
    let judge = Judge {
        sides: Sides::of(&cells),
        walls: upper.map(Walls::of).unwrap_or_default(),
        cells: &cells,
        count,
        beside,
        street,
        unit,
    };
    judge.all()
}

/// The input of the rules.
struct Judge<'c> {
    /// The regions, followed by the written roofs.
    cells: &'c [Cell],
    /// The number of regions among them.
    count: usize,
    beside: &'c [Beside],
    sides: Sides,
    walls: Walls,
    street: Option<usize>,
    unit: i64,
}

impl Judge<'_> {
    /// Judges trunks before their branches: by decreasing area, the street region first.
    fn all(&self) -> Vec<Region> {
        let mut order: Vec<usize> = (0..self.count).collect();
        order.sort_by_key(|&n| {
            (
                Some(n) != self.street,
                std::cmp::Reverse(self.cells[n].area()),
            )
        });
        let mut judged: Vec<Region> = self.cells.iter().map(|c| Region::main(*c)).collect();
        for (known, beside) in judged[self.count..].iter_mut().zip(self.beside) {
            *known = beside.roof;
        }
        for n in order {
            judged[n] = self.judge(n, &judged);
        }
        judged.truncate(self.count);
        judged
    }

    fn judge(&self, n: usize, judged: &[Region]) -> Region {
        let cell = self.cells[n];
        if Some(n) == self.street {
            return self.on_street(cell, judged);
        }
        if let Some(side) = self.whole_wall(&cell) {
            return self.against_wall(cell, side);
        }
        if let Some((trunk, side)) = self.trunk(n, judged) {
            return self.joined(cell, side, trunk, &judged[trunk]);
        }
        match self.half_wall(&cell) {
            Some(side) => Region {
                against_wall: Some(side),
                ..Region::lean_to(cell, side)
            },
            None => Region::main(cell),
        }
    }

    /// Applies rule 1.
    fn on_street(&self, cell: Cell, judged: &[Region]) -> Region {
        let behind = || [Side::Back, Side::Front].into_iter();
        let lean_to = |side| Region {
            street: true,
            ..Region::lean_to(cell, side)
        };
        if let Some(side) = behind().find(|s| self.has_wall(&cell, *s))
            && side.measure(&cell).1 <= self.steps(2)
        {
            return Region {
                against_wall: Some(side),
                ..lean_to(side)
            };
        }
        let written = |side: Side| {
            let trunk = self
                .sides
                .beyond(&cell, side)
                .filter(|t| *t >= self.count)?;
            let larger = judged[trunk].cell.area() > cell.area();
            (larger && self.is_strip(&cell, side)).then_some((trunk, side))
        };
        match behind().find_map(written) {
            Some((trunk, side)) => Region {
                over: Some(trunk),
                joins: Some(side),
                ..lean_to(side)
            },
            None => Region {
                ridge: Some(Ridge::A),
                street: true,
                against_wall: self.whole_wall(&cell),
                ..Region::main(cell)
            },
        }
    }

    /// Returns true if an upper wall stands along the whole of a side.
    fn has_wall(&self, cell: &Cell, side: Side) -> bool {
        !self.walls.is_empty() && self.walls.along(cell, side) == side.measure(cell).0
    }

    /// Returns true if a cell is shallow and long enough to be a lean-to against a side.
    fn is_strip(&self, cell: &Cell, side: Side) -> bool {
        let (length, depth) = side.measure(cell);
        let long = depth <= self.steps(2) && length >= depth.saturating_mul(2);
        let wide = depth <= self.steps(3) && length.saturating_mul(2) > depth.saturating_mul(5);
        long || wide
    }

    /// Returns true if a lean-to against a side would fall onto another roof.
    fn falls_on_roof(&self, cell: &Cell, side: Side) -> bool {
        self.sides.touches(cell, side.opposite())
    }

    /// Converts `units` to grid steps.
    fn steps(&self, units: i64) -> i64 {
        units.saturating_mul(self.unit)
    }

    /// Returns the longest side along the whole of which an upper wall stands.
    fn whole_wall(&self, cell: &Cell) -> Option<Side> {
        let whole = |side: &Side| self.has_wall(cell, *side);
        longest(cell, Side::ALL.into_iter().filter(whole))
    }

    /// Returns the longest side of a strip along at least half of which an upper wall stands.
    fn half_wall(&self, cell: &Cell) -> Option<Side> {
        let half = |side: &Side| {
            let (length, depth) = side.measure(cell);
            let wall = self.walls.along(cell, *side);
            let long = depth <= self.steps(3) && length >= depth.saturating_mul(2);
            long && wall >= length - wall && !self.falls_on_roof(cell, *side)
        };
        longest(
            cell,
            Side::ALL
                .into_iter()
                .filter(|s| !self.walls.is_empty() && half(s)),
        )
    }

    /// Applies rule 2.
    fn against_wall(&self, cell: Cell, side: Side) -> Region {
        let against_wall = Some(side);
        if side.measure(&cell).1 <= self.steps(3) && !self.falls_on_roof(&cell, side) {
            return Region {
                against_wall,
                ..Region::lean_to(cell, side)
            };
        }
        Region {
            ridge: Some(side.ridge_into()),
            against_wall,
            ..Region::main(cell)
        }
    }

    /// Returns the trunk of a region and the side that it shares with it.
    fn trunk(&self, n: usize, judged: &[Region]) -> Option<(usize, Side)> {
        let area = self.cells[n].area();
        // A street region that leans on another roof is only a strip.
        let street = self.street.filter(|s| judged[*s].role == Role::Main);
        Side::ALL
            .into_iter()
            .filter_map(|side| Some((self.sides.beyond(&self.cells[n], side)?, side)))
            .filter(|(t, _)| Some(*t) == street || self.cells[*t].area() > area)
            .filter(|(t, side)| self.bears(*t, n, *side))
            .min_by_key(|(t, side)| {
                // Cells are sorted, so the lesser index is the lesser (b0, a0).
                (
                    Some(*t) != street,
                    !self.is_strip(&self.cells[n], *side),
                    std::cmp::Reverse(self.cells[*t].area()),
                    *t,
                )
            })
    }

    /// Returns true if a roof can be the trunk of region `n`. A roof above wall height can be the trunk only of a strip
    /// leaning on it.
    fn bears(&self, trunk: usize, n: usize, side: Side) -> bool {
        let written = trunk.checked_sub(self.count).map(|i| self.beside[i]);
        written.is_none_or(|w| w.level || self.is_strip(&self.cells[n], side))
    }

    /// Applies rule 3.
    fn joined(&self, cell: Cell, side: Side, trunk: usize, t: &Region) -> Region {
        let (length, _) = side.measure(&cell);
        let (over, joins) = (Some(trunk), Some(side));
        if self.is_strip(&cell, side) && !self.falls_on_roof(&cell, side) {
            return Region {
                over,
                joins,
                ..Region::lean_to(cell, side)
            };
        }
        let gable = Region {
            ridge: Some(side.ridge_into()),
            joins,
            ..Region::main(cell)
        };
        if length > t.span() && !t.street && t.role != Role::LeanTo {
            return Region {
                through: over,
                ..gable
            };
        }
        Region {
            role: Role::Branch,
            over,
            ..gable
        }
    }
}

/// Returns the longest of some sides, the first among equals.
fn longest(cell: &Cell, sides: impl Iterator<Item = Side>) -> Option<Side> {
    sides.min_by_key(|s| std::cmp::Reverse(s.measure(cell).0))
}
