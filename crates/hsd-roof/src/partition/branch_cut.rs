//! `branch-cut`: Sugihara's division by branches, down to outlines of six corners (002-12, 002-22, 002-23).
//!
//! Walked clockwise, an outline turns right (R) and left (L). A branch is a run of R beside an L; from the L the
//! outgoing wall is extended backwards or the incoming one forwards, until it meets a wall, and the branch comes
//! off as a rectangle. A part with a single L left goes to [`SixVertex`]. The paper shows this for eight corners and
//! does not state which branch comes first. Here, for any number of corners:
//! 1. lines that cut off a rectangle come before others;
//! 2. then the least roof cut for each L that is made straight: a line from L to L counts for both, as in the T
//!    and the Z, where the paper cuts from both of them as well. This is domain 7.4's "the shorter of the two"
//!    for all L at once, and Sugihara's later rule, lines in the order of their length (domain 3.5);
//! 3. then the shorter line, the smaller branch, and the place: least b, least a, along a before along b.
//!
//! Where no line cuts off a rectangle, the same order divides by whatever line is best: so a courtyard is opened
//! by the least cut from one of its corners, each of which is an L. Pieces that do not touch are divided apart.
//! Every line makes one L straight and none new, so it ends.

use crate::partition::six_vertex::SixVertex;
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::plan::raster::{Raster, Span};

/// Maximum number of steps for one region, about half a second: a stair of 480 steps takes as many.
pub(crate) const MOST_STEPS: u64 = 1 << 28;

/// Returns the roof cells before merging, in no particular order, and the number of steps the search took; no cells if
/// it would take more than `most`. A step is a field or a grid point visited.
pub(crate) fn cut(raster: &Raster, most: u64) -> (Option<Vec<Cell>>, u64) {
    let mut cutter = Cutter::new(raster, most);
    match cutter.cut_all() {
        Some(()) => (Some(cutter.cells), most - cutter.steps),
        None => (None, most),
    }
}

/// A direction in walk order: +a, +b, -a, -b. A wall or line leaves a grid point in one of them; the quadrant of
/// that number lies between it and the next.
type Way = usize;

/// A candidate line for a cut.
#[derive(Clone, Copy, Debug)]
struct CutLine {
    from: usize,
    way: Way,
    to: usize,
    /// The number of L it makes straight, 1 or 2.
    bends: u8,
    rank: Rank,
}

/// The rank of a line; the least is cut first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Rank {
    /// True if it cuts off no rectangle.
    divides: bool,
    /// Twice the length for each L, reduced.
    price: u128,
    length: u64,
    /// Area of the rectangle, of the smaller if both sides are one; reduced, saturating.
    branch: u128,
    /// The lesser of its grid points, counted row by row, and its way.
    place: (usize, Way),
}

struct Cutter<'r> {
    raster: &'r Raster,
    /// Number of grid points in a row.
    stride: usize,
    /// For each grid point the walls and lines that leave it, one bit per [`Way`].
    walls: Vec<u8>,
    /// The remaining number of steps.
    steps: u64,
    cells: Vec<Cell>,
}

impl<'r> Cutter<'r> {
    fn new(raster: &'r Raster, steps: u64) -> Self {
        let (cols, rows) = (raster.cols(), raster.rows());
        let stride = cols + 1;
        let mut walls = vec![0; stride * (rows + 1)];
        let inside = |i: usize, j: usize| i < cols && j < rows && raster.inside[j * cols + i];
        for j in 0..=rows {
            for i in 0..=cols {
                let p = j * stride + i;
                // Beyond the first line the index wraps to a value no grid has.
                if inside(i, j) != inside(i, j.wrapping_sub(1)) {
                    walls[p] |= 1;
                    walls[p + 1] |= 4;
                }
                if inside(i, j) != inside(i.wrapping_sub(1), j) {
                    walls[p] |= 2;
                    walls[p + stride] |= 8;
                }
            }
        }
        Self {
            raster,
            stride,
            walls,
            steps,
            cells: Vec::new(),
        }
    }

    /// Divides every piece; `None` if the steps are used up.
    fn cut_all(&mut self) -> Option<()> {
        let mut labels = vec![0; self.raster.inside.len()];
        let mut todo = Vec::new();
        let mut pieces = 0;
        for field in 0..labels.len() {
            if self.raster.inside[field] && labels[field] == 0 {
                pieces += 1;
                self.label(field, pieces, &mut labels)?;
                todo.push((field, Vec::new()));
            }
        }
        for p in 0..self.walls.len() {
            if let Some(way) = self.bend(p) {
                let piece: u32 = labels[self.field(p, (way + 2) % 4)];
                todo[piece as usize - 1].1.push(p);
            }
        }
        while let Some((field, bends)) = todo.pop() {
            self.divide(field, bends, &mut labels, &mut pieces, &mut todo)?;
        }
        Some(())
    }

    /// Divides a piece, given by one of its fields and its L, into rectangles, or into two pieces.
    fn divide(
        &mut self,
        mut field: usize,
        mut bends: Vec<usize>,
        labels: &mut [u32],
        pieces: &mut u32,
        todo: &mut Vec<(usize, Vec<usize>)>,
    ) -> Option<()> {
        loop {
            if let [p] = bends[..]
                && let Some(six) = self.six_corners(p).and_then(|c| SixVertex::divide(&c))
            {
                self.cells.extend([six.box1, six.box2]);
                return Some(());
            }
            let Some(line) = self.best(&bends)? else {
                let rectangle = self.rectangle(field)?;
                self.cells
                    .extend(rectangle.map(|span| self.raster.cell(span)));
                return Some(());
            };
            self.draw(&line);
            bends.retain(|&p| p != line.from && (line.bends == 1 || p != line.to));
            let sides =
                [line.way, (line.way + 3) % 4].map(|quadrant| self.field(line.from, quadrant));
            let rectangles = [self.rectangle(sides[0])?, self.rectangle(sides[1])?];
            match rectangles {
                [Some(branch), Some(other)] => {
                    self.cells
                        .extend([branch, other].map(|span| self.raster.cell(span)));
                    return Some(());
                }
                [Some(branch), None] => {
                    self.cells.push(self.raster.cell(branch));
                    field = sides[1];
                }
                [None, Some(branch)] => {
                    self.cells.push(self.raster.cell(branch));
                    field = sides[0];
                }
                [None, None] => {
                    *pieces += 1;
                    self.label(sides[0], *pieces, labels)?;
                    if labels[sides[1]] != *pieces {
                        let quadrant = |p: usize| self.bend(p).map_or(0, |way| (way + 2) % 4);
                        let apart = |p: &usize| labels[self.field(*p, quadrant(*p))] == *pieces;
                        let (near, far) = bends.into_iter().partition(apart);
                        todo.extend([(sides[0], near), (sides[1], far)]);
                        return Some(());
                    }
                    field = sides[0];
                }
            }
        }
    }

    /// Returns the corners of a piece whose only L is `p`.
    fn six_corners(&self, p: usize) -> Option<[(i64, i64); 6]> {
        let way = self.bend(p)?;
        // The ends of both walls of the L, and the point where the walls beyond them meet again.
        let (one, other) = (
            self.wall_end(p, way, (way + 3) % 4),
            self.wall_end(p, (way + 1) % 4, (way + 2) % 4),
        );
        let (far_one, far_other) = (self.run(p, (way + 3) % 4).0, self.run(p, (way + 2) % 4).0);
        let at = |p: usize| {
            (
                self.raster.a.source[p % self.stride],
                self.raster.b.source[p / self.stride],
            )
        };
        let (p0, p1, p5) = (at(p), at(one), at(other));
        let along_a = way % 2 == 0;
        let (line_one, line_other) = (at(far_one), at(far_other));
        let meet = |a: (i64, i64), b: (i64, i64)| (a.0, b.1);
        let (p2, p3, p4) = match along_a {
            true => (
                meet(p1, line_one),
                meet(line_other, line_one),
                meet(line_other, p5),
            ),
            false => (
                meet(line_one, p1),
                meet(line_one, line_other),
                meet(p5, line_other),
            ),
        };
        Some([p0, p1, p2, p3, p4, p5])
    }

    /// Returns the point where the wall that leaves `p` one way turns to a side.
    fn wall_end(&self, p: usize, way: Way, side: Way) -> usize {
        let mut at = self.next(p, way);
        while self.walls[at] >> way & 1 == 1 && self.walls[at] >> side & 1 == 0 {
            at = self.next(at, way);
        }
        at
    }

    /// Returns the best line from any of some L.
    fn best(&mut self, bends: &[usize]) -> Option<Option<CutLine>> {
        let mut best: Option<CutLine> = None;
        for &p in bends {
            let Some(way) = self.bend(p) else { continue };
            for way in [(way + 2) % 4, (way + 3) % 4] {
                let line = self.line(p, way)?;
                if best.is_none_or(|b| line.rank < b.rank) {
                    best = Some(line);
                }
            }
        }
        Some(best)
    }

    /// Returns the line that extends a wall beyond the L at `from`.
    fn line(&mut self, from: usize, way: Way) -> Option<CutLine> {
        let (to, fields) = self.run(from, way);
        self.steps = self.steps.checked_sub(fields)?;
        let bends = if self.bend(to).is_some() { 2 } else { 1 };
        let (axis, lo, hi) = match way {
            0 | 2 => (&self.raster.a, from % self.stride, to % self.stride),
            _ => (&self.raster.b, from / self.stride, to / self.stride),
        };
        let length = axis.at[lo].abs_diff(axis.at[hi]);
        let mut line = CutLine {
            from,
            way,
            to,
            bends,
            rank: Rank {
                divides: true,
                price: u128::from(length) * if bends == 2 { 1 } else { 2 },
                length,
                branch: 0,
                place: (from.min(to), way % 2),
            },
        };
        self.draw(&line);
        let sides = [way, (way + 3) % 4].map(|quadrant| self.field(from, quadrant));
        let rectangles = sides.map(|field| self.rectangle(field));
        self.draw(&line);
        let [one, other] = rectangles;
        let areas = [one?, other?]
            .into_iter()
            .flatten()
            .map(|s| self.raster.area(s));
        if let Some(branch) = areas.min() {
            (line.rank.divides, line.rank.branch) = (false, branch);
        }
        Some(line)
    }

    /// Returns the point where a line from `p` meets a wall or another line, and its length in fields.
    fn run(&self, p: usize, way: Way) -> (usize, u64) {
        let back = 1 << ((way + 2) % 4);
        let (mut at, mut fields) = (self.next(p, way), 1);
        while self.walls[at] & !back == 0 {
            at = self.next(at, way);
            fields += 1;
        }
        (at, fields)
    }

    /// Draws a line; drawing it again removes it.
    fn draw(&mut self, line: &CutLine) {
        let mut at = line.from;
        while at != line.to {
            self.walls[at] ^= 1 << line.way;
            at = self.next(at, line.way);
            self.walls[at] ^= 1 << ((line.way + 2) % 4);
        }
    }

    /// Returns the piece that a field belongs to, if it is a rectangle.
    fn rectangle(&mut self, field: usize) -> Option<Option<Span>> {
        let cols = self.stride - 1;
        let (i, j) = (field % cols, field / cols);
        let wall = |i: usize, j: usize, way: Way| self.walls[j * self.stride + i] >> way & 1 == 1;
        let (mut i0, mut i1, mut j0, mut j1) = (i, i + 1, j, j + 1);
        while !wall(i0, j, 1) {
            i0 -= 1;
        }
        while !wall(i1, j, 1) {
            i1 += 1;
        }
        while !wall(i, j0, 0) {
            j0 -= 1;
        }
        while !wall(i, j1, 0) {
            j1 += 1;
        }
        let mut looked = (i1 - i0 + j1 - j0) as u64;
        let mut closed = (i0..i1).all(|i| wall(i, j0, 0) && wall(i, j1, 0))
            && (j0..j1).all(|j| wall(i0, j, 1) && wall(i1, j, 1));
        for j in j0 + 1..j1 {
            if !closed {
                break;
            }
            let row = &self.walls[j * self.stride..][i0 + 1..i1];
            looked += row.len() as u64;
            closed = row.iter().all(|&walls| walls == 0);
        }
        self.steps = self.steps.checked_sub(looked)?;
        Some(closed.then_some(Span { i0, j0, i1, j1 }))
    }

    /// Returns the first of the two walls of an L: `None` if there is none, in mid-wall and at an R. Round an L three
    /// quadrants belong to one piece.
    fn bend(&self, p: usize) -> Option<Way> {
        let way = match self.walls[p] {
            0b0011 => 0,
            0b0110 => 1,
            0b1100 => 2,
            0b1001 => 3,
            _ => return None,
        };
        let (i, j) = (p % self.stride, p / self.stride);
        // The quadrant across must be on the grid to be inside.
        let (left, below) = ([0, 3].contains(&way), way < 2);
        let off = (left && i == 0)
            || (!left && i + 1 == self.stride)
            || (below && j == 0)
            || (!below && (j + 1) * self.stride == self.walls.len());
        (!off && self.raster.inside[self.field(p, (way + 2) % 4)]).then_some(way)
    }

    /// Returns the field in a quadrant of a grid point, which must be on the grid.
    fn field(&self, p: usize, quadrant: usize) -> usize {
        let (mut i, mut j) = (p % self.stride, p / self.stride);
        if matches!(quadrant, 1 | 2) {
            i -= 1;
        }
        if quadrant > 1 {
            j -= 1;
        }
        j * (self.stride - 1) + i
    }

    fn next(&self, p: usize, way: Way) -> usize {
        match way {
            0 => p + 1,
            1 => p + self.stride,
            2 => p - 1,
            _ => p - self.stride,
        }
    }

    /// Numbers all fields of the piece that `start` belongs to.
    fn label(&mut self, start: usize, number: u32, labels: &mut [u32]) -> Option<()> {
        let cols = self.stride - 1;
        let mut stack = vec![start];
        while let Some(field) = stack.pop() {
            if labels[field] == number {
                continue;
            }
            labels[field] = number;
            self.steps = self.steps.checked_sub(1)?;
            let p = field / cols * self.stride + field % cols;
            let open = |at: usize, way: Way| self.walls[at] >> way & 1 == 0;
            stack.extend(open(p, 1).then(|| field - 1));
            stack.extend(open(p, 0).then(|| field - cols));
            stack.extend(open(p + 1, 1).then_some(field + 1));
            stack.extend(open(p + self.stride, 0).then_some(field + cols));
        }
        Some(())
    }
}
