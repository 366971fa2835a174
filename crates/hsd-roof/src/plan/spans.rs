//! Halls too wide for one roof: several gables side by side, their ridges along the long side, with valleys between.
//!
//! A slope longer than 17 m lets rain in at any pitch that tiles take (docs/evidence.md 4.3), and a roof as steep would
//! stand higher than the house. Great halls of temples do have one roof; their shape is asked for.

use hsd_base::geometry::plan::Cell;

/// The widest span of one automatic gable, metres: 15 ken, whose slopes are 17 m long at 6 sun.
pub(crate) const WIDEST: f64 = 90.0 * hsd_base::geometry::SHAKU;

/// Divides the cells that are wider than `most` steps both ways into equal strips along their long side. Returns all
/// cells, and those strips.
pub(crate) fn divided(cells: Vec<Cell>, most: i64) -> (Vec<Cell>, Vec<Cell>) {
    let wide = |c: &Cell| c.width().min(c.depth()) > most;
    let (wide, mut all): (Vec<Cell>, Vec<Cell>) = cells.into_iter().partition(wide);
    let strips: Vec<Cell> = wide.iter().flat_map(|c| strips(c, most)).collect();
    all.extend(&strips);
    (all, strips)
}

/// Returns the strips of one cell, as few as possible.
fn strips(cell: &Cell, most: i64) -> impl Iterator<Item = Cell> {
    let cell = *cell;
    let short = cell.width().min(cell.depth());
    let count = short.div_euclid(most) + i64::from(short.rem_euclid(most) > 0);
    let at = move |k: i64| (i128::from(short) * i128::from(k) / i128::from(count)) as i64;
    (0..count).map(move |k| match cell.depth() <= cell.width() {
        true => Cell {
            b0: cell.b0 + at(k),
            b1: cell.b0 + at(k + 1),
            ..cell
        },
        false => Cell {
            a0: cell.a0 + at(k),
            a1: cell.a0 + at(k + 1),
            ..cell
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_are_as_few_as_may_be_and_cover_the_cell() {
        let cell = Cell {
            a0: 3,
            b0: 5,
            a1: 103,
            b1: 75,
        };
        for (most, count) in [(70, 1), (69, 2), (35, 2), (34, 3)] {
            let (all, new) = divided(vec![cell], most);
            assert_eq!(all.len(), count, "{most}");
            assert_eq!(all.iter().map(Cell::area).sum::<i128>(), cell.area());
            assert!(all.iter().all(|c| c.width() == 100 && c.depth() <= most));
            assert_eq!(new.is_empty(), count == 1);
        }
    }
}
