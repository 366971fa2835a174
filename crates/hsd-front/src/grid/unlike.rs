//! Rows of openings, from which storeys of unlike heights follow: jambs are seen along a storey's openings and not between two
//! storeys. Columns of openings, by sills and lintels in the same way, tell which bays would cut them.

use super::Edges;

/// The least change of a colour at a jamb, times [`super::STRONG`].
const JAMB: u8 = 48;
/// The least length of a jamb, as a part of the height of the wall: grain and leaves are shorter.
const LONG: f64 = 0.035;
/// The strips of the wall that are counted for themselves; that with the most jambs, which may be a tree, does not count.
const STRIPS: usize = 5;
/// A row has openings if it has more than this part of the jambs of usual ones: shops have wider panes than windows.
const OPEN: f64 = 0.3;
/// How many times as many jambs are seen in rows with openings as between them, at least.
const CLEAR: f64 = 2.0;
/// The least height of openings, and the least distance between two storeys of them, as parts of the wall.
const LEAST: [f64; 2] = [0.05, 0.025];
/// The line between storeys stands in this part of what separates their openings.
const BETWEEN: [f64; 2] = [0.2, 0.8];
/// How far apart openings of equal storeys are above their floors at the most, as a part of the wall.
const SHIFTED: f64 = 0.02;
/// How far a line may reach into openings and still lie between them, as a part of their height.
const INTO: f64 = 0.15;

/// The rows of openings of a wall, from above: top and bottom of each, as parts of the wall. Edges that are not turned give its columns,
/// from the left.
pub(super) struct Openings(Vec<[f64; 2]>);

impl Openings {
    /// Finds rows of openings between the first `columns` of the picture, by changes of the kind `of`; none where they are not clear.
    pub(super) fn of(edges: &Edges, of: usize, columns: usize) -> Openings {
        let jambs = jambs(edges, of, columns);
        let Some(bound) = parted(&jambs) else {
            return Openings(vec![]);
        };
        let height = jambs.len() as f64;
        let mut rows: Vec<[f64; 2]> = vec![];
        for row in (0..jambs.len()).filter(|row| jambs[*row] >= bound) {
            let (top, bottom) = (row as f64 / height, (row + 1) as f64 / height);
            match rows.last_mut() {
                Some(last) if top - last[1] < LEAST[1] => last[1] = bottom,
                _ => rows.push([top, bottom]),
            }
        }
        rows.retain(|[top, bottom]| bottom - top >= LEAST[0]);
        Openings(rows)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether lines between storeys go through openings, or leave several storeys of them between two lines.
    pub(super) fn contradict(&self, lines: &[f64]) -> bool {
        let is_less = self.0.len() > 1 && self.0.len() + 1 > lines.len();
        is_less || self.are_cut(lines) || self.are_shifted(lines)
    }

    /// Whether lines go through openings.
    pub(super) fn are_cut(&self, lines: &[f64]) -> bool {
        let is_cut = |[top, bottom]: &[f64; 2]| {
            let into = INTO * (bottom - top);
            let mut inner = lines.iter().filter(|at| **at > 0.0 && **at < 1.0);
            inner.any(|at| *at > top + into && *at < bottom - into)
        };
        self.0.iter().any(is_cut)
    }

    /// Whether openings of storeys that are equally high, as those above the ground are in `lines`, stand unlike high above their floors.
    fn are_shifted(&self, lines: &[f64]) -> bool {
        let upper = lines[..lines.len() - 1].windows(2);
        let own = upper.filter_map(|line| {
            let mut own = self.0.iter().filter(|o| o[0] >= line[0] && o[1] <= line[1]);
            let first = own.next().filter(|_| own.next().is_none())?;
            Some([first[0] - line[0], first[1] - line[0]])
        });
        let own: Vec<[f64; 2]> = own.collect();
        (0..2).any(|k| {
            let least = own.iter().map(|o| o[k]).fold(f64::MAX, f64::min);
            own.iter().any(|o| o[k] - least > SHIFTED)
        })
    }

    /// The lines between storeys, with both ends, if there are several: each where the wall changes most along its whole width, else
    /// where the walls below and above openings have the same shares of these everywhere. `edges` is turned.
    pub(super) fn lines(&self, edges: &Edges) -> Option<Vec<f64>> {
        if self.0.len() < 2 {
            return None;
        }
        let height = edges.width as f64;
        let [below, above] = self.shares();
        let line = |pair: &[[f64; 2]]| {
            let ([upper, lower], from, to) = (heights(pair), pair[0][1], pair[1][0]);
            let within = BETWEEN.map(|part| from + part * (to - from));
            let rows = (within[0] * height) as usize..=(within[1] * height) as usize;
            let course = rows.map(|row| (row, courses(edges, row)));
            let course = course.reduce(|a, b| if b.1 > a.1 { b } else { a });
            match course.filter(|c| c.1 >= super::ALONG) {
                Some((row, _)) => (row as f64 + 0.5) / height,
                None => {
                    let part = below * upper / (below * upper + above * lower);
                    (from + part * (to - from)).clamp(within[0], within[1])
                }
            }
        };
        let inner = self.0.windows(2).map(line);
        Some(std::iter::once(0.0).chain(inner).chain([1.0]).collect())
    }

    /// The heights of the walls below and above openings, as parts of the heights of these: those that explain best what lies between
    /// openings, and above the first ones.
    fn shares(&self) -> [f64; 2] {
        let top = ([0.0, self.0[0][1] - self.0[0][0]], self.0[0][0]);
        let between = self
            .0
            .windows(2)
            .map(|pair| (heights(pair), pair[1][0] - pair[0][1]));
        let (mut square, mut right) = ([[0.0; 2]; 2], [0.0; 2]);
        for ([upper, lower], wall) in between.chain([top]) {
            let by = [upper, lower];
            for k in 0..2 {
                (0..2).for_each(|m| square[k][m] += by[k] * by[m]);
                right[k] += by[k] * wall;
            }
        }
        let [[a, b], [c, d]] = square;
        let whole = a * d - b * c;
        let shares = [
            (d * right[0] - b * right[1]) / whole,
            (a * right[1] - c * right[0]) / whole,
        ];
        match shares.iter().all(|s| s.is_finite() && *s > 0.0) {
            true => shares,
            false => [1.0; 2],
        }
    }
}

fn heights(pair: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| pair[k][1] - pair[k][0])
}

/// How much of jambs is seen in each row of the wall.
fn jambs(edges: &Edges, of: usize, columns: usize) -> Vec<f64> {
    let rows = edges.width;
    let long = ((LONG * rows as f64) as usize).max(4);
    let mut strips = vec![[0.0; STRIPS]; rows];
    for column in 0..columns {
        let is_edge = |row: &usize| edges.at(*row, column)[of] >= JAMB;
        let strip = column * STRIPS / columns;
        let mut row = 0;
        while row < rows {
            let run = (row..rows).take_while(is_edge).count();
            if run >= long {
                strips[row..row + run]
                    .iter_mut()
                    .for_each(|s| s[strip] += 1.0);
            }
            row += run + 1;
        }
    }
    let sum = |strips: &[f64; STRIPS]| {
        let most = strips.iter().copied().fold(0.0, f64::max);
        strips.iter().sum::<f64>() - most
    };
    strips.iter().map(sum).collect()
}

/// The value between rows with openings and those without, if they are clearly apart (Otsu).
fn parted(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let all: f64 = sorted.iter().sum();
    let (mut below, mut best) = (0.0, None::<(f64, f64, f64)>);
    for k in 1..sorted.len() {
        below += sorted[k - 1];
        let (few, many) = (below / k as f64, (all - below) / (sorted.len() - k) as f64);
        let apart = (k * (sorted.len() - k)) as f64 * (many - few).powi(2);
        if best.is_none_or(|b| apart > b.0) {
            best = Some((apart, few, many));
        }
    }
    let (_, few, many) = best?;
    (many > CLEAR * few.max(1.0)).then_some(few + OPEN * (many - few))
}

/// The part of a row of the wall in which it changes from above to below, as at a string course.
fn courses(edges: &Edges, row: usize) -> f64 {
    let strong = (0..edges.height).filter(|at| edges.at(row, *at)[1] >= super::EDGE);
    strong.count() as f64 / edges.height as f64
}
