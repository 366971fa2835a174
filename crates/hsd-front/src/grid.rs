//! The lattice of a facade: bays and storeys, from what repeats.

mod unlike;

use image::imageops;
use image::{Rgb, RgbImage};
use unlike::Openings;

/// The longer side of the straight wall in which a lattice is looked for, pixels.
pub const LONGEST: f64 = 1000.0;
/// The longer side of the picture in which repetition is looked for, pixels.
const SMALL: f64 = 380.0;
/// The most bays, and the most storeys.
const MOST: usize = 40;
/// The least width of a bay and height of a storey in that picture, pixels.
const LEAST: f64 = 10.0;
/// A change of a colour by 255 over this counts whole.
const STRONG: u8 = 4;
/// How near the likeness of a shorter period has to come to that of the best: of bays, of storeys.
const NEARLY: [f64; 2] = [0.92, 0.86];
/// The least likeness of bays and of storeys that repeat: what panes reflect is alike to about a half.
const ALIKE: [f64; 2] = [0.42, 0.58];
/// Bays, and storeys, that are so alike are equal, whatever openings say.
const SURELY: [f64; 2] = [0.55, 0.68];
/// The least change of a colour at the edge of a bar, times [`STRONG`].
const EDGE: u8 = 56;
/// The least part of the wall along which the edge of a bar is seen.
const ALONG: f64 = 0.6;
/// The most by which edges of one bar lie apart, as a part of the wall.
const BAR: f64 = 0.07;
/// The least distance of a bar from the border of the wall that is not that of the border itself, as a part of the wall.
const INNER: f64 = 0.1;
/// What is left over at the ends of a row of bays, as a part of a bay, and is spread over them.
const SPREAD: f64 = 0.12;

/// Lines of a lattice, as parts of the wall from its upper left corner, with both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Between bays, from the left.
    pub columns: Vec<f64>,
    /// Between storeys, from above.
    pub rows: Vec<f64>,
    /// How far bays and storeys repeat, 0 to 1.
    pub likeness: [f64; 2],
}

impl Grid {
    /// So many equal bays and storeys.
    pub fn even(bays: usize, storeys: usize) -> Grid {
        let lines = |n: usize| (0..=n).map(|k| k as f64 / n as f64).collect();
        Grid {
            columns: lines(bays),
            rows: lines(storeys),
            likeness: [1.0; 2],
        }
    }

    /// The lattice of inner lines, as parts of the wall.
    pub fn with(columns: Vec<f64>, rows: Vec<f64>) -> Grid {
        let whole = |inner: Vec<f64>| std::iter::once(0.0).chain(inner).chain([1.0]).collect();
        Grid {
            columns: whole(columns),
            rows: whole(rows),
            likeness: [1.0; 2],
        }
    }

    /// Finds the lattice of a straight wall. Where nothing repeats the wall is one bay or one storey.
    pub fn find(wall: &RgbImage) -> Grid {
        let edges = Edges::of(wall);
        let (rows, down) = storeys(&edges.turned());
        // What repeats along a storey is clearest above the ground.
        let ground = (rows[rows.len() - 2] * edges.height as f64) as usize;
        let upper = if rows.len() > 2 { ground } else { edges.height };
        let (columns, across) = bays(&edges.without_bands(), upper);
        Grid {
            columns,
            rows,
            likeness: [across, down],
        }
    }
}

/// How much the colours of a small picture change: across and down, for each pixel in turn.
struct Edges {
    width: usize,
    height: usize,
    change: Vec<u8>,
}

impl Edges {
    fn of(wall: &RgbImage) -> Edges {
        let (w, h) = (f64::from(wall.width()), f64::from(wall.height()));
        let fit = (SMALL / w.max(h)).min(1.0);
        let side = |s: f64| ((s * fit).round() as u32).max(2);
        let small = imageops::thumbnail(wall, side(w), side(h));
        let (width, height) = (small.width() as usize, small.height() as usize);
        let tone = |x: usize, y: usize| {
            let Rgb(tone) = small.get_pixel(x.min(width - 1) as u32, y.min(height - 1) as u32);
            *tone
        };
        let most = |a: [u8; 3], b: [u8; 3]| {
            let off = (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap_or(0);
            off.saturating_mul(STRONG)
        };
        let mut change = Vec::with_capacity(2 * width * height);
        for y in 0..height {
            for x in 0..width {
                let at = tone(x, y);
                change.extend([most(at, tone(x + 1, y)), most(at, tone(x, y + 1))]);
            }
        }
        let edges = Edges {
            width,
            height,
            change,
        };
        edges.widened()
    }

    fn at(&self, x: usize, y: usize) -> [u8; 2] {
        let at = 2 * (y * self.width + x);
        [self.change[at], self.change[at + 1]]
    }

    /// The same with each edge spread over its neighbours: periods are no whole pixels.
    fn widened(&self) -> Edges {
        let (width, height) = (self.width, self.height);
        let mut change = Vec::with_capacity(self.change.len());
        for y in 0..height {
            for x in 0..width {
                let mut most = [0; 2];
                for ny in y.saturating_sub(1)..=(y + 1).min(height - 1) {
                    for nx in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                        let near = self.at(nx, ny);
                        most = [most[0].max(near[0]), most[1].max(near[1])];
                    }
                }
                change.extend(most);
            }
        }
        Edges {
            width,
            height,
            change,
        }
    }

    /// The same without what runs along whole rows, which repeats at any length.
    fn without_bands(mut self) -> Edges {
        for row in self.change.chunks_exact_mut(2 * self.width) {
            for k in 0..2 {
                let mut sorted: Vec<u8> = row.iter().skip(k).step_by(2).copied().collect();
                let half = sorted.len() / 2;
                let middle = *sorted.select_nth_unstable(half).1;
                row.iter_mut()
                    .skip(k)
                    .step_by(2)
                    .for_each(|c| *c = c.saturating_sub(middle));
            }
        }
        self
    }

    /// The same with rows and columns exchanged.
    fn turned(&self) -> Edges {
        let mut change = Vec::with_capacity(self.change.len());
        for x in 0..self.width {
            (0..self.height).for_each(|y| change.extend(self.at(x, y)));
        }
        Edges {
            width: self.height,
            height: self.width,
            change,
        }
    }

    /// How alike the parts of the picture from `left` on and from `left + shift` on are, `length` pixels wide: common edges over
    /// all edges.
    fn alike(&self, left: f64, shift: f64, length: f64, rows: usize) -> f64 {
        let off = 2 * ((left + shift).round() as usize);
        let start = 2 * (left.round() as usize);
        let length =
            (2 * (length.round() as usize)).min((2 * self.width).saturating_sub(start.max(off)));
        let (mut common, mut all) = (0_u64, 0_u64);
        // Edges are spread over three rows, so every second row has them.
        for row in self
            .change
            .chunks_exact(2 * self.width)
            .take(rows)
            .step_by(2)
        {
            let (a, b) = (&row[start..start + length], &row[off..off + length]);
            common += u64::from(
                a.iter()
                    .zip(b)
                    .map(|(a, b)| u32::from(*a.min(b)))
                    .sum::<u32>(),
            );
            all += u64::from(
                a.iter()
                    .zip(b)
                    .map(|(a, b)| u32::from(*a.max(b)))
                    .sum::<u32>(),
            );
        }
        if all > 0 {
            common as f64 / all as f64
        } else {
            0.0
        }
    }
}

/// Lengths from `least` to `most` by steps that shift no repetition by more than half a pixel.
fn lengths(least: f64, most: f64, of: f64) -> impl Iterator<Item = f64> {
    let mut length = least;
    std::iter::from_fn(move || {
        let this = length;
        length += (0.5 * length / of).max(0.1);
        (this <= most).then_some(this)
    })
}

/// The lines between bays, and how far they repeat.
fn bays(edges: &Edges, rows: usize) -> (Vec<f64>, f64) {
    let width = edges.width as f64;
    let tried: Vec<(f64, f64)> = lengths(LEAST.max(width / MOST as f64), width / 1.9, width)
        .map(|bay| (bay, mated(edges, bay, rows)))
        .collect();
    let lines = |bay: f64| -> Vec<f64> {
        let count = (width / bay + SPREAD).floor();
        let rest = width - count * bay;
        let lines = (0..=count as usize).map(|k| match k {
            0 => 0.0,
            k if k as f64 == count => 1.0,
            // A little that is left over is an error of the period.
            k if rest.abs() < SPREAD * bay => k as f64 / count,
            k => (rest / 2.0 + k as f64 * bay) / width,
        });
        lines.collect()
    };
    let openings = Openings::of(edges, 1, rows);
    let best = shortest(&tried, NEARLY[0], ALIKE[0]);
    let is_doubtful = best.is_none_or(|b| b.1 < SURELY[0] && openings.are_cut(&lines(b.0)));
    let uncut = || {
        if openings.is_empty() {
            return None;
        }
        let uncut = tried.iter().filter(|t| !openings.are_cut(&lines(t.0)));
        shortest(&uncut.copied().collect::<Vec<_>>(), NEARLY[0], ALIKE[0])
    };
    let found = best.filter(|_| !is_doubtful).or_else(uncut);
    match found {
        Some((bay, alike)) => (lines(bay), alike),
        None => (bars(edges, 0), 0.0),
    }
}

/// The middles of bars that run over the wall, mullions and transoms, with both ends: where panes reflect what is before them nothing
/// repeats, but their frame is seen. `of` is 0 for changes across the wall, 1 for changes down.
fn bars(edges: &Edges, of: usize) -> Vec<f64> {
    let width = edges.width as f64;
    let is_edge = |x: &usize| {
        let strong = (0..edges.height).filter(|y| edges.at(*x, *y)[of] >= EDGE);
        strong.count() as f64 >= ALONG * edges.height as f64
    };
    let mut found: Vec<(f64, f64)> = vec![];
    for at in (0..edges.width).filter(is_edge) {
        let at = (at as f64 + 0.5) / width;
        match found.last_mut() {
            Some(bar) if at - bar.0 < BAR => bar.1 = at,
            _ => found.push((at, at)),
        }
    }
    let middles = found.into_iter().map(|bar| (bar.0 + bar.1) / 2.0);
    let inner = middles.filter(|at| (INNER..=1.0 - INNER).contains(at));
    std::iter::once(0.0).chain(inner).chain([1.0]).collect()
}

/// How alike bays of one width are: the most that one of them has in common with the others, on average, without the two of
/// five that are odd or behind a tree.
fn mated(edges: &Edges, bay: f64, rows: usize) -> f64 {
    let count = (edges.width as f64 / bay + SPREAD).floor() as usize;
    // Of three one may be odd.
    let kept = if count < 4 {
        1
    } else {
        ((count - 1) * 3).div_ceil(5)
    };
    let core = |core: usize| {
        let others = (0..count).filter(|k| *k != core);
        let mut alike: Vec<f64> = others
            .map(|k| edges.alike(core as f64 * bay, (k as f64 - core as f64) * bay, bay, rows))
            .collect();
        alike.sort_by(|a, b| b.total_cmp(a));
        alike[..kept].iter().sum::<f64>() / kept as f64
    };
    let step = count.div_ceil(CORES);
    (0..count).step_by(step).map(core).fold(0.0, f64::max)
}

/// The most bays that are compared with all others.
const CORES: usize = 6;

/// The shortest length that repeats nearly as well as the best, at its own best.
fn shortest(tried: &[(f64, f64)], nearly: f64, least: f64) -> Option<(f64, f64)> {
    let best = tried.iter().map(|t| t.1).fold(0.0, f64::max);
    if best < least {
        return None;
    }
    let first = tried.iter().position(|t| t.1 >= nearly * best)?;
    let near = tried[first..]
        .iter()
        .take_while(|t| t.0 < 1.06 * tried[first].0);
    near.copied().reduce(|a, b| if b.1 > a.1 { b } else { a })
}

/// The lines between storeys, from above, and how far they repeat; `edges` is turned.
///
/// Storeys above the ground are equally high and begin at the top, what is left below is the ground storey; unless openings say
/// otherwise.
fn storeys(edges: &Edges) -> (Vec<f64>, f64) {
    let equal = equal_storeys(edges);
    let openings = Openings::of(edges, 0, edges.height);
    let unlike = openings.lines(edges);
    match (equal, unlike) {
        (Some((lines, alike)), Some(unlike))
            if alike < SURELY[1] && openings.contradict(&lines) =>
        {
            (unlike, 0.0)
        }
        (Some(equal), _) => equal,
        (None, unlike) => {
            let bars = bars(edges, 1);
            // A single bar over the whole wall is surer than what lies between two rows.
            let is_single = bars.len() == 3;
            let others = unlike.filter(|unlike| unlike.len() > 3 || !is_single);
            (others.unwrap_or(bars), 0.0)
        }
    }
}

/// Storeys that repeat, and how far they do.
fn equal_storeys(edges: &Edges) -> Option<(Vec<f64>, f64)> {
    let (height, rows) = (edges.width as f64, edges.height);
    let fits = |storey: f64| {
        // Pairs of equal storeys, from the top.
        let pairs = (height / storey).floor() as usize - 1;
        let alike: Vec<f64> = (0..pairs)
            .map(|k| edges.alike(k as f64 * storey, storey, storey, rows))
            .collect();
        let best = alike.iter().copied().fold(0.0, f64::max);
        let like = alike.iter().take_while(|a| **a > 0.55 * best).count();
        let mean = alike[..like].iter().sum::<f64>() / like.max(1) as f64;
        (like + 1, mean)
    };
    // What is left below is no more than two storeys, or it would repeat too.
    let tried: Vec<(f64, f64)> = lengths(LEAST.max(height / MOST as f64), height / 2.0, height)
        .map(|storey| {
            let (count, alike) = fits(storey);
            let rest = height / storey - count as f64;
            (storey, if count > 1 && rest < 2.2 { alike } else { 0.0 })
        })
        .collect();
    let (storey, alike) = shortest(&tried, NEARLY[1], ALIKE[1])?;
    let (count, _) = fits(storey);
    let mut lines: Vec<f64> = (0..=count).map(|k| k as f64 * storey / height).collect();
    let rest = height / storey - count as f64;
    match rest > 0.35 {
        true => lines.push(1.0),
        false => lines
            .iter_mut()
            .for_each(|line| *line *= height / (storey * count as f64)),
    }
    Some((lines, alike))
}
