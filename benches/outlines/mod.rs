//! Outlines like those of real houses: as many corners, as often, as the houses of the Meiji village in
//! Inuyama have on a map, snapped to half units (143 buildings, 133 of them orthogonal). Places are drawn.

use hsd::geometry::plan::{Cell, Plan};

/// Corners and how many houses have them.
const VILLAGE: [(usize, usize); 9] = [
    (4, 79),
    (6, 15),
    (8, 16),
    (10, 7),
    (12, 4),
    (14, 3),
    (16, 5),
    (20, 3),
    (26, 1),
];

/// A small generator: the same outlines on every machine.
struct Dice(u64);

impl Dice {
    /// A number from `lo` to `hi - 1`.
    fn roll(&mut self, lo: i64, hi: i64) -> i64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        lo + (self.0 >> 33) as i64 % (hi - lo)
    }

    /// A rectangle in a field of this size, in half units.
    fn cell(&mut self, size: i64) -> Cell {
        let (a0, b0) = (self.roll(0, size - 4), self.roll(0, size - 4));
        Cell {
            a0,
            b0,
            a1: self.roll(a0 + 2, size + 1),
            b1: self.roll(b0 + 2, size + 1),
        }
    }
}

/// The houses of the village, in half units.
pub(crate) fn village() -> Vec<Plan> {
    let kinds = VILLAGE
        .iter()
        .flat_map(|&(corners, count)| of(corners, count));
    kinds.collect()
}

/// So many outlines of so many corners each, in one piece without courts: wings are put to a hall or taken off
/// it until it has them.
pub(crate) fn of(corners: usize, count: usize) -> Vec<Plan> {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15 ^ corners as u64);
    let size = 20 + 2 * corners as i64;
    let mut found = Vec::with_capacity(count);
    while found.len() < count {
        let mut plan = Plan::from_cells(&[dice.cell(size)]);
        for _ in 0..200 {
            if plan.corners() == corners {
                found.push(plan);
                break;
            }
            let wing = Plan::from_cells(&[dice.cell(size)]);
            let next = match dice.roll(0, 2) {
                0 => plan.union(&wing),
                _ => plan.difference(&wing),
            };
            let grown = (plan.corners() + 1..=corners).contains(&next.corners());
            if grown && is_simple(&next) {
                plan = next;
            }
        }
    }
    found
}

/// Whether it is a single loop that nowhere touches itself.
fn is_simple(plan: &Plan) -> bool {
    let [only] = plan.loops.as_slice() else {
        return false;
    };
    let mut corners = only.clone();
    corners.sort_unstable();
    corners.windows(2).all(|pair| pair[0] != pair[1])
}

/// The outline as a house of one storey.
pub(crate) fn text(plan: &Plan) -> String {
    let corners = &plan.loops[0];
    let n = corners.len();
    let mut text = "0 0\n9.5\n\n".to_owned();
    for k in 0..n {
        let at = |m: usize| corners[(k + m) % n];
        let (p, q, r) = (at(0), at(1), at(2));
        let halves = ((q.0 - p.0).abs() + (q.1 - p.1).abs()) as usize;
        text += &"KSK  ".repeat(halves / 2);
        text += if halves % 2 == 1 { "GKK h" } else { "" };
        let bend = (q.0 - p.0) * (r.1 - q.1) - (q.1 - p.1) * (r.0 - q.0);
        text += if bend < 0 { "L\n" } else { "\n" };
    }
    text
}
