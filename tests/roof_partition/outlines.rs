//! Random orthogonal outlines on a unit grid, from an own generator.

use hsd::geometry::plan::{Cell, Plan};

/// A small deterministic generator (xorshift*).
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// A number in `lo..hi`.
    pub(crate) fn roll(&mut self, lo: i64, hi: i64) -> i64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let n = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33;
        lo + (n as i64) % (hi - lo)
    }
}

/// Unit fields, `at(x, y)`; everything off the grid is outside.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Bitmap {
    pub(crate) w: i64,
    pub(crate) h: i64,
    fields: Vec<bool>,
}

impl Bitmap {
    pub(crate) fn new(w: i64, h: i64) -> Self {
        Self {
            w,
            h,
            fields: vec![false; (w * h) as usize],
        }
    }

    pub(crate) fn at(&self, x: i64, y: i64) -> bool {
        x >= 0 && y >= 0 && x < self.w && y < self.h && self.fields[(y * self.w + x) as usize]
    }

    pub(crate) fn set(&mut self, c: (i64, i64, i64, i64), to: bool) {
        for y in c.1..c.3 {
            for x in c.0..c.2 {
                self.fields[(y * self.w + x) as usize] = to;
            }
        }
    }

    /// Unions of rectangles, some taken off again.
    pub(crate) fn random(dice: &mut Dice, w: i64, h: i64, parts: i64) -> Self {
        let mut map = Self::new(w, h);
        for n in 0..dice.roll(1, parts + 1) {
            let (x0, y0) = (dice.roll(0, w), dice.roll(0, h));
            let (x1, y1) = (dice.roll(x0 + 1, w + 1), dice.roll(y0 + 1, h + 1));
            map.set((x0, y0, x1, y1), n < 2 || dice.roll(0, 4) > 0);
        }
        map
    }

    /// One 4-connected piece whose boundary nowhere touches itself in a corner.
    pub(crate) fn is_sound(&self) -> bool {
        let inside: Vec<(i64, i64)> = self.all().filter(|&(x, y)| self.at(x, y)).collect();
        let Some(&first) = inside.first() else {
            return false;
        };
        let mut seen = vec![first];
        let mut next = 0;
        while next < seen.len() {
            let (x, y) = seen[next];
            next += 1;
            for p in [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)] {
                if self.at(p.0, p.1) && !seen.contains(&p) {
                    seen.push(p);
                }
            }
        }
        let touches = self.all().any(|(x, y)| {
            let (a, b) = (self.at(x, y), self.at(x - 1, y - 1));
            let (c, d) = (self.at(x - 1, y), self.at(x, y - 1));
            a == b && c == d && a != c
        });
        seen.len() == inside.len() && !touches
    }

    pub(crate) fn all(&self) -> impl Iterator<Item = (i64, i64)> + use<> {
        let (w, h) = (self.w, self.h);
        (0..h).flat_map(move |y| (0..w).map(move |x| (x, y)))
    }

    /// The region with clean loops.
    pub(crate) fn plan(&self) -> Plan {
        self.fields_plan().clean()
    }

    /// The region written as a loop for each unit field.
    pub(crate) fn fields_plan(&self) -> Plan {
        let fields = self.all().filter(|&(x, y)| self.at(x, y));
        let cells: Vec<Cell> = fields
            .map(|(x, y)| Cell {
                a0: x,
                b0: y,
                a1: x + 1,
                b1: y + 1,
            })
            .collect();
        Plan::from_cells(&cells)
    }

    pub(crate) fn minus(&self, other: &Bitmap) -> Bitmap {
        let mut rest = self.clone();
        for (x, y) in self.all() {
            if other.at(x, y) {
                rest.set((x, y, x + 1, y + 1), false);
            }
        }
        rest
    }

    /// Whether the cells cover exactly this region and never overlap.
    pub(crate) fn is_covered_by(&self, cells: &[Cell]) -> bool {
        let mut count = vec![0; (self.w * self.h) as usize];
        for c in cells {
            for y in c.b0..c.b1 {
                for x in c.a0..c.a1 {
                    if x < 0 || y < 0 || x >= self.w || y >= self.h {
                        return false;
                    }
                    count[(y * self.w + x) as usize] += 1;
                }
            }
        }
        self.all()
            .all(|(x, y)| count[(y * self.w + x) as usize] == i32::from(self.at(x, y)))
    }
}

/// `count` sound outlines, sizes growing with `size`.
pub(crate) fn outlines(seed: u64, count: usize, size: i64) -> Vec<Bitmap> {
    let mut dice = Dice::new(seed);
    let mut found = Vec::new();
    while found.len() < count {
        let (w, h) = (dice.roll(3, size), dice.roll(3, size));
        let map = Bitmap::random(&mut dice, w, h, 7);
        if map.is_sound() {
            found.push(map);
        }
    }
    found
}

/// A plan moved and stretched: other grid steps, other signs.
pub(crate) fn moved(plan: &Plan, scale: i64, da: i64, db: i64) -> Plan {
    let corner = |p: &(i64, i64)| (p.0 * scale + da, p.1 * scale + db);
    Plan::from_loops(
        plan.loops
            .iter()
            .map(|l| l.iter().map(corner).collect())
            .collect(),
    )
}
