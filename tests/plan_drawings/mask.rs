//! Shapes of houses: which cells of the grid are built on, and the loops round them.

use super::rng::Rng;
use super::truth::Point;
use std::collections::BTreeMap;

/// Cells that are built on.
#[derive(Clone, Debug)]
pub struct Mask {
    /// Units along the front.
    pub width: i32,
    /// Units back.
    pub depth: i32,
    cells: Vec<bool>,
}

impl Mask {
    fn full(width: i32, depth: i32) -> Self {
        Self {
            width,
            depth,
            cells: vec![true; (width * depth) as usize],
        }
    }

    /// Whether a cell is built on; false outside.
    pub fn has(&self, a: i32, b: i32) -> bool {
        (0..self.width).contains(&a)
            && (0..self.depth).contains(&b)
            && self.cells[(b * self.width + a) as usize]
    }

    /// Take a rectangle away.
    fn cut(&mut self, a: (i32, i32), b: (i32, i32)) {
        for y in b.0.max(0)..b.1.min(self.depth) {
            for x in a.0.max(0)..a.1.min(self.width) {
                self.cells[(y * self.width + x) as usize] = false;
            }
        }
    }

    /// Take a corner away: bit 0 of `corner` is the left side, bit 1 the back.
    fn cut_corner(&mut self, corner: i32, width: i32, depth: i32) {
        let a = if corner & 1 == 0 {
            (0, width)
        } else {
            (self.width - width, self.width)
        };
        let b = if corner & 2 == 0 {
            (0, depth)
        } else {
            (self.depth - depth, self.depth)
        };
        self.cut(a, b);
    }

    /// The loops of unit edges with the house on their right: the outline first, then the courtyards.
    pub fn loops(&self) -> Vec<Vec<Point>> {
        let mut next: BTreeMap<(i32, i32), Point> = BTreeMap::new();
        for b in 0..self.depth {
            for a in (0..self.width).filter(|&a| self.has(a, b)) {
                let sides = [
                    (self.has(a, b - 1), (a, b), (a + 1, b)),
                    (self.has(a + 1, b), (a + 1, b), (a + 1, b + 1)),
                    (self.has(a, b + 1), (a + 1, b + 1), (a, b + 1)),
                    (self.has(a - 1, b), (a, b + 1), (a, b)),
                ];
                for (_, from, to) in sides.into_iter().filter(|side| !side.0) {
                    next.insert((from.1, from.0), to);
                }
            }
        }
        let mut loops = Vec::new();
        while let Some((&(b, a), _)) = next.first_key_value() {
            let mut path = vec![(a, b)];
            let mut at = (a, b);
            while let Some(to) = next.remove(&(at.1, at.0)) {
                path.push(to);
                at = to;
            }
            path.pop();
            loops.push(path);
        }
        loops
    }
}

/// The corners of a loop of unit edges.
pub fn corners(path: &[Point]) -> Vec<Point> {
    let n = path.len();
    let turns = |k: usize| {
        let (p, q, r) = (path[(k + n - 1) % n], path[k], path[(k + 1) % n]);
        (q.0 - p.0, q.1 - p.1) != (r.0 - q.0, r.1 - q.1)
    };
    (0..n).filter(|&k| turns(k)).map(|k| path[k]).collect()
}

/// The shapes of houses that the drawings show.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Form {
    /// A plain house.
    Rectangle,
    /// One corner missing.
    Ell,
    /// Two corners of one side missing.
    Tee,
    /// A notch in one side.
    Yu,
    /// All four corners missing.
    Cross,
    /// Two opposite corners missing.
    Zed,
    /// One or two courtyards.
    Court,
    /// Stepped back like flying geese.
    Stepped,
}

/// A shape by chance: town houses are narrow and deep, others as they come.
pub fn shape(rng: &mut Rng) -> (Mask, Form) {
    use Form::*;
    let form = rng.pick(&[
        Rectangle, Rectangle, Ell, Ell, Tee, Yu, Cross, Zed, Court, Stepped,
    ]);
    let least = match form {
        Rectangle => (4, 5),
        Ell | Zed => (6, 7),
        Tee | Yu | Stepped => (7, 8),
        Cross => (8, 8),
        Court => (8, 9),
    };
    let narrow = rng.chance(0.45);
    let width = rng.whole(least.0, if narrow { least.0 + 3 } else { 16 });
    let depth = rng.whole(
        if narrow { least.1.max(10) } else { least.1 },
        if narrow {
            24
        } else {
            (width * 3 / 2).clamp(least.1, 24)
        },
    );
    let mut mask = Mask::full(width, depth);
    cut_form(&mut mask, form, rng);
    (mask, form)
}

fn cut_form(mask: &mut Mask, form: Form, rng: &mut Rng) {
    let (width, depth) = (mask.width, mask.depth);
    let corner = rng.whole(0, 3);
    match form {
        Form::Rectangle => {}
        Form::Ell => mask.cut_corner(corner, rng.whole(2, width - 3), rng.whole(2, depth - 3)),
        Form::Tee => {
            let (first, second) = if corner == 0 { (0, 1) } else { (2, 3) };
            let left = rng.whole(1, (width - 3) / 2);
            let back = rng.whole(2, depth - 3);
            mask.cut_corner(first, left.max(1), back);
            mask.cut_corner(second, rng.whole(1, width - 3 - left), back);
        }
        Form::Yu => {
            let from = rng.whole(2, width - 4);
            let to = rng.whole(from + 2, width - 2);
            let back = rng.whole(2, depth - 3);
            mask.cut(
                (from, to),
                if corner == 0 {
                    (0, back.min(depth / 3))
                } else {
                    (depth - back, depth)
                },
            );
        }
        Form::Cross => {
            let (right, left) = (rng.whole(1, width / 2 - 2), rng.whole(1, width / 2 - 2));
            let (front, back) = (rng.whole(1, depth / 2 - 2), rng.whole(1, depth / 2 - 2));
            for k in 0..4 {
                mask.cut_corner(
                    k,
                    if k & 1 == 0 { right } else { left },
                    if k & 2 == 0 { front } else { back },
                );
            }
        }
        Form::Zed => {
            let first = rng.whole(2, width - 4);
            mask.cut_corner(corner, first, rng.whole(2, depth - 3));
            mask.cut_corner(
                3 - corner,
                rng.whole(1, width - 2 - first),
                rng.whole(2, depth - 3),
            );
        }
        Form::Court => cut_courts(mask, rng),
        Form::Stepped => {
            let (low, high) = (rng.whole(2, depth / 2 - 1), rng.whole(depth / 2, depth - 3));
            let first = rng.whole(2, (width - 2) / 2);
            mask.cut_corner(corner, first, high);
            mask.cut_corner(corner, rng.whole(first + 1, width - 2), low);
        }
    }
}

fn cut_courts(mask: &mut Mask, rng: &mut Rng) {
    let (width, depth) = (mask.width, mask.depth);
    let mut front = 3;
    let count = if depth >= 17 { rng.whole(1, 2) } else { 1 };
    for k in 0..count {
        let end = if k + 1 == count { depth - 3 } else { depth / 2 };
        let from = rng.whole(front, (end - 2).min(front + 3));
        let to = rng.whole(from + 2, end.min(from + 6));
        let left = rng.whole(2, width - 4);
        mask.cut(
            (left, rng.whole(left + 2, (width - 2).min(left + 5))),
            (from, to),
        );
        front = to + 3;
        if front + 5 > depth {
            break;
        }
    }
}
