//! What is drawn in a DXF, as strokes.

use super::lines::{Lines, Stroke, arc, bulged, moved};
use super::pairs::Pair;
use glam::{DMat3, DVec2, dvec2};

/// The most copies in a row of an insert.
const ROW: i32 = 1000;

/// Pairs from one group code 0 to the next.
pub(super) struct Record<'p> {
    /// What it is.
    pub(super) kind: &'p str,
    pub(super) pairs: &'p [Pair<'p>],
}

impl<'p> Record<'p> {
    pub(super) fn new(pairs: &'p [Pair<'p>]) -> Record<'p> {
        Record {
            kind: pairs[0].1.trim(),
            pairs: &pairs[1..],
        }
    }

    pub(super) fn text(&self, code: i32) -> Option<&'p str> {
        self.pairs
            .iter()
            .find(|(c, _)| *c == code)
            .map(|(_, value)| value.trim())
    }

    pub(super) fn real(&self, code: i32) -> Option<f64> {
        self.text(code).and_then(number)
    }

    pub(super) fn whole(&self, code: i32) -> Option<i32> {
        self.text(code)?.parse().ok()
    }

    /// A place; none if a number of it is none.
    fn place(&self, code: i32) -> Option<DVec2> {
        Some(dvec2(self.real(code)?, self.real(code + 10)?))
    }

    /// From its own plane to that of the drawing: one that is seen from below is mirrored.
    fn plane(&self) -> DMat3 {
        let is_below = self.real(230).is_some_and(|z| z < 0.0);
        DMat3::from_scale(dvec2(if is_below { -1.0 } else { 1.0 }, 1.0))
    }
}

fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|n: &f64| n.is_finite())
}

/// Where a block stands, and what its parts have from it.
#[derive(Clone, Debug, Default)]
pub(super) struct Home {
    pub(super) matrix: DMat3,
    /// The layer of what is drawn on layer 0 of a block.
    pub(super) layer: Option<u32>,
    pub(super) hidden: bool,
    pub(super) colour: i32,
    pub(super) blocks: Vec<u32>,
    pub(super) symbol: u32,
}

/// What a stroke has from layers and blocks.
pub(super) struct Style {
    pub(super) layer: Option<u32>,
    pub(super) colour: [u8; 3],
    pub(super) line_type: Option<u32>,
    pub(super) width: f64,
}

/// Adds what a record draws; false if there is no room for more.
pub(super) fn draw(
    record: &Record<'_>,
    follow: &[Record<'_>],
    home: &Home,
    style: &Style,
    lines: &mut Lines,
) -> bool {
    let Some(found) = points(record, follow) else {
        lines.leave_out(record.kind);
        return true;
    };
    let matrix = home.matrix * record.plane();
    found.into_iter().all(|path| {
        let stroke = Stroke {
            points: path.points.iter().map(|p| moved(&matrix, *p)).collect(),
            is_closed: path.is_closed,
            fill: path.is_filled.then_some(style.colour),
            is_text: matches!(record.kind, "TEXT" | "MTEXT" | "ATTRIB" | "ATTDEF"),
            width: style.width * moved(&matrix, DVec2::X).distance(moved(&matrix, DVec2::ZERO)),
            colour: style.colour,
            layers: style.layer.into_iter().collect(),
            blocks: home.blocks.clone(),
            line_type: style.line_type,
            symbol: home.symbol,
        };
        lines.put(stroke)
    })
}

#[derive(Default)]
struct Path {
    points: Vec<DVec2>,
    is_closed: bool,
    is_filled: bool,
}

impl Path {
    fn open(points: Vec<DVec2>) -> Path {
        Path {
            points,
            ..Path::default()
        }
    }

    fn area(points: Vec<DVec2>) -> Path {
        Path {
            points,
            is_closed: true,
            is_filled: true,
        }
    }
}

/// The paths of a record in its own plane; none if it is not drawn.
fn points(record: &Record<'_>, follow: &[Record<'_>]) -> Option<Vec<Path>> {
    let one = |path: Path| Some(vec![path]);
    match record.kind {
        "LINE" => one(Path::open(vec![record.place(10)?, record.place(11)?])),
        "LWPOLYLINE" => one(light(record)?),
        "POLYLINE" => one(heavy(record, follow)?),
        "MLINE" => one(Path::open(places(record.pairs, 11))),
        "ARC" => one(bow(record)?),
        "CIRCLE" => one(Path {
            points: arc(
                record.place(10)?,
                round(record)?,
                0.0,
                std::f64::consts::TAU,
            ),
            is_closed: true,
            is_filled: false,
        }),
        "ELLIPSE" => one(oval(record)?),
        "SPLINE" => one(Path {
            points: spline(record)?,
            is_closed: record.whole(70)? & 1 == 1,
            is_filled: false,
        }),
        // The corners of a solid go zigzag.
        "SOLID" | "TRACE" => one(Path::area(four(record, [10, 11, 13, 12])?)),
        "3DFACE" => one(Path {
            points: four(record, [10, 11, 12, 13])?,
            is_closed: true,
            is_filled: false,
        }),
        "HATCH" => Some(hatch(record)),
        "TEXT" | "MTEXT" | "ATTRIB" | "ATTDEF" => one(Path::open(vec![record.place(10)?])),
        _ => None,
    }
}

/// Four corners by their codes; a triangle repeats its third.
fn four(record: &Record<'_>, codes: [i32; 4]) -> Option<Vec<DVec2>> {
    let corner = |code: i32| match code {
        13 => record.place(13).or(record.place(12)),
        code => record.place(code),
    };
    codes.into_iter().map(corner).collect()
}

/// A part of a circle; it runs counter-clockwise.
fn bow(record: &Record<'_>) -> Option<Path> {
    let (from, to) = (record.real(50)?.to_radians(), record.real(51)?.to_radians());
    let turn = (to - from).rem_euclid(std::f64::consts::TAU);
    let points = arc(record.place(10)?, round(record)?, from, from + turn);
    Some(Path::open(points))
}

/// An ellipse or a part of one.
fn oval(record: &Record<'_>) -> Option<Path> {
    let (axis, ratio) = (record.place(11)?, record.real(40)?);
    let from = record.real(41).unwrap_or(0.0);
    let to = record.real(42).unwrap_or(std::f64::consts::TAU);
    let axes = [axis, axis.perp() * ratio];
    Some(Path::open(arc(record.place(10)?, axes, from, to)))
}

fn round(record: &Record<'_>) -> Option<[DVec2; 2]> {
    let radius = record.real(40)?;
    Some([DVec2::X * radius, DVec2::Y * radius])
}

/// Places of one group code, in their order.
fn places(pairs: &[Pair<'_>], code: i32) -> Vec<DVec2> {
    let of = |code: i32| {
        pairs
            .iter()
            .filter(move |(c, _)| *c == code)
            .filter_map(|(_, value)| number(value.trim()))
    };
    of(code)
        .zip(of(code + 10))
        .map(|(x, y)| dvec2(x, y))
        .collect()
}

/// Corners with the bulges of the segments that begin at them.
fn joined(corners: &[(DVec2, f64)], is_closed: bool) -> Vec<DVec2> {
    let Some((first, _)) = corners.first() else {
        return vec![];
    };
    let mut points = vec![*first];
    let count = if is_closed {
        corners.len()
    } else {
        corners.len() - 1
    };
    for k in 0..count {
        let ((from, bulge), (to, _)) = (corners[k], corners[(k + 1) % corners.len()]);
        points.extend(bulged(from, to, bulge));
    }
    if is_closed {
        points.pop();
    }
    points
}

fn light(record: &Record<'_>) -> Option<Path> {
    let mut corners: Vec<(DVec2, f64)> = vec![];
    for (code, value) in record.pairs {
        match code {
            10 => corners.push((dvec2(number(value.trim())?, f64::NAN), 0.0)),
            20 => corners.last_mut()?.0.y = number(value.trim())?,
            42 => corners.last_mut()?.1 = number(value.trim())?,
            _ => {}
        }
    }
    let is_closed = record.whole(70).unwrap_or(0) & 1 == 1;
    corners.iter().all(|c| c.0.is_finite()).then(|| Path {
        points: joined(&corners, is_closed),
        is_closed,
        is_filled: false,
    })
}

fn heavy(record: &Record<'_>, follow: &[Record<'_>]) -> Option<Path> {
    let flags = record.whole(70).unwrap_or(0);
    // Meshes are no lines.
    if flags & (16 | 64) != 0 {
        return None;
    }
    let is_closed = flags & 1 == 1;
    let vertices = follow.iter().filter(|r| r.kind == "VERTEX");
    // Control points of splines lie beside the line.
    let vertices = vertices.filter(|r| r.whole(70).unwrap_or(0) & 16 == 0);
    let corners: Option<Vec<(DVec2, f64)>> = vertices
        .map(|r| Some((r.place(10)?, r.real(42).unwrap_or(0.0))))
        .collect();
    Some(Path {
        points: joined(&corners?, is_closed),
        is_closed,
        is_filled: false,
    })
}

/// A spline by its fit points, else by chords of its curve.
fn spline(record: &Record<'_>) -> Option<Vec<DVec2>> {
    let fit = places(record.pairs, 11);
    if fit.len() > 2 {
        return Some(fit);
    }
    let controls = places(record.pairs, 10);
    let degree = usize::try_from(record.whole(71)?)
        .ok()
        .filter(|d| (1..=10).contains(d))?;
    let knots: Vec<f64> = record
        .pairs
        .iter()
        .filter(|(c, _)| *c == 40)
        .filter_map(|(_, v)| number(v.trim()))
        .collect();
    let rises = knots.windows(2).all(|w| w[0] <= w[1]);
    if controls.len() <= degree || knots.len() < controls.len() + degree + 1 || !rises {
        return (controls.len() > 1).then_some(controls);
    }
    let (from, to) = (knots[degree], knots[controls.len()]);
    let steps = (controls.len() * 6).min(2000);
    let at = |k: usize| {
        let t = from + (to - from) * k as f64 / steps as f64;
        let span = (degree..controls.len() - 1)
            .rev()
            .find(|j| knots[*j] <= t)
            .unwrap_or(degree);
        let mut d: Vec<DVec2> = controls[span - degree..=span].to_vec();
        for r in 1..=degree {
            for j in (r..=degree).rev() {
                let (low, high) = (knots[span - degree + j], knots[span + 1 + j - r]);
                let share = if high > low {
                    (t - low) / (high - low)
                } else {
                    0.0
                };
                d[j] = d[j - 1].lerp(d[j], share);
            }
        }
        d[degree]
    };
    Some((0..=steps).map(at).collect())
}

/// The borders of a hatch: polylines, or lines and arcs one after another.
fn hatch(record: &Record<'_>) -> Vec<Path> {
    let is_solid = record.whole(70) == Some(1);
    let mut paths: Vec<Path> = vec![];
    let mut rest = record.pairs;
    while let Some(at) = rest.iter().position(|(code, _)| *code == 92) {
        rest = &rest[at..];
        let end = rest[1..]
            .iter()
            .position(|(code, _)| matches!(code, 92 | 97 | 75))
            .map_or(rest.len(), |k| k + 1);
        let (own, flags) = (&rest[1..end], rest[0].1.trim().parse::<i32>().unwrap_or(0));
        let points = if flags & 2 == 2 {
            places(own, 10)
        } else {
            edges(own)
        };
        if points.len() > 2 {
            paths.push(Path {
                points,
                is_closed: true,
                is_filled: is_solid,
            });
        }
        rest = &rest[end..];
    }
    paths
}

fn edges(pairs: &[Pair<'_>]) -> Vec<DVec2> {
    let starts: Vec<usize> = (0..pairs.len()).filter(|k| pairs[*k].0 == 72).collect();
    let mut points = vec![];
    for (k, start) in starts.iter().enumerate() {
        let own = &pairs[start + 1..starts.get(k + 1).copied().unwrap_or(pairs.len())];
        let real = |code: i32| {
            own.iter()
                .find(|(c, _)| *c == code)
                .and_then(|(_, v)| number(v.trim()))
        };
        match pairs[*start].1.trim() {
            "1" => points.extend(places(own, 10).into_iter().chain(places(own, 11))),
            "2" => {
                let (Some(radius), Some(middle)) = (real(40), places(own, 10).first().copied())
                else {
                    continue;
                };
                let (from, to) = (
                    real(50).unwrap_or(0.0).to_radians(),
                    real(51).unwrap_or(360.0).to_radians(),
                );
                points.extend(arc(
                    middle,
                    [DVec2::X * radius, DVec2::Y * radius],
                    from,
                    to,
                ));
            }
            _ => {}
        }
    }
    points
}

/// Where the copies of an insert stand: rows and columns of it.
pub(super) fn copies(record: &Record<'_>, base: [f64; 2]) -> Vec<DMat3> {
    let real = |code: i32, usual: f64| record.real(code).unwrap_or(usual);
    let at = dvec2(real(10, 0.0), real(20, 0.0));
    let scale = dvec2(real(41, 1.0), real(42, 1.0));
    let count = |code: i32| record.whole(code).unwrap_or(1).clamp(1, ROW);
    let turn = DMat3::from_angle(real(50, 0.0).to_radians());
    let base = DMat3::from_translation(-dvec2(base[0], base[1]));
    let mut all = vec![];
    for row in 0..count(71) {
        for column in 0..count(70) {
            let off = dvec2(
                f64::from(column) * real(44, 0.0),
                f64::from(row) * real(45, 0.0),
            );
            let place = DMat3::from_translation(at) * turn * DMat3::from_translation(off);
            all.push(record.plane() * place * DMat3::from_scale(scale) * base);
        }
    }
    all
}

/// A name with the letters that R12 to 2004 write as \U+XXXX.
pub(super) fn decoded(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    let mut rest = name;
    while let Some(at) = rest.find("\\U+") {
        out.push_str(&rest[..at]);
        let digits = rest.get(at + 3..at + 7);
        match digits
            .and_then(|d| u32::from_str_radix(d, 16).ok())
            .and_then(char::from_u32)
        {
            Some(letter) => {
                out.push(letter);
                rest = &rest[at + 7..];
            }
            None => {
                out.push_str("\\U+");
                rest = &rest[at + 3..];
            }
        }
    }
    out + rest
}

/// The colours of the index that names use: the first nine, greys, and the rest by hue.
pub(super) fn colour(index: i32) -> [u8; 3] {
    match index {
        1 => [255, 0, 0],
        2 => [255, 255, 0],
        3 => [0, 255, 0],
        4 => [0, 255, 255],
        5 => [0, 0, 255],
        6 => [255, 0, 255],
        8 => [128; 3],
        9 => [192; 3],
        10..=249 => hue(index),
        250..=255 => [(51 + (index - 250) * 41) as u8; 3],
        _ => [0; 3],
    }
}

/// Ten shades for each of 24 hues.
fn hue(index: i32) -> [u8; 3] {
    let (turn, shade) = (f64::from(index / 10 - 1) / 24.0 * 6.0, index % 10);
    let high = [255.0, 189.0, 129.0, 104.0, 79.0][(shade / 2) as usize];
    let low = if shade % 2 == 0 { 0.0 } else { high / 2.0 };
    let part = |off: f64| {
        let at = ((turn + off).rem_euclid(6.0) - 3.0).abs() - 1.0;
        (low + (high - low) * at.clamp(0.0, 1.0)).round() as u8
    };
    [part(0.0), part(4.0), part(2.0)]
}
