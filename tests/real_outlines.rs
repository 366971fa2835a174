//! Outlines of real houses: the orthogonal buildings of a museum village, as a map has them. The map lies beside
//! the repository, not in it; without it the test is reported as ignored.
use crate::support::{assert_none, compile, flaws, root};
use serde_json::Value;
use std::path::PathBuf;

/// Half a unit in metres: the finest length that parts can make.
const HALF: f64 = 5.0 / 11.0;
const METRES_PER_DEGREE: f64 = 111_320.0;
/// Sine of the greatest angle between an edge and the grid of an orthogonal house: 12 degrees.
const CROOKED: f64 = 0.21;

type Point = (f64, f64);
type Cell = (i64, i64);

fn map() -> PathBuf {
    root().join("../shared/data/osm_meijimura/buildings.geojson")
}

/// The outer ring in metres, east and north of its first corner, the first corner not repeated.
fn ring_of(feature: &Value) -> Option<Vec<Point>> {
    let geometry = &feature["geometry"];
    let ring = match geometry["type"].as_str()? {
        "Polygon" => &geometry["coordinates"][0],
        "MultiPolygon" => &geometry["coordinates"][0][0],
        _ => return None,
    };
    let degrees: Vec<Point> = ring
        .as_array()?
        .iter()
        .filter_map(|p| Some((p[0].as_f64()?, p[1].as_f64()?)))
        .collect();
    let (lon, lat) = *degrees.first()?;
    let shrink = lat.to_radians().cos();
    let metres = |p: &Point| {
        let east = (p.0 - lon) * METRES_PER_DEGREE * shrink;
        (east, (p.1 - lat) * METRES_PER_DEGREE)
    };
    Some(degrees[..degrees.len() - 1].iter().map(metres).collect())
}

/// Turns the ring so that most of its length runs along the axes.
fn straighten(ring: &[Point]) -> Vec<Point> {
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    // Directions that differ by right angles count as one: their fourfold angles agree.
    let (mut x, mut y) = (0.0, 0.0);
    for (p, q) in edges {
        let (angle, length) = ((q.1 - p.1).atan2(q.0 - p.0), (q.0 - p.0).hypot(q.1 - p.1));
        x += length * (4.0 * angle).cos();
        y += length * (4.0 * angle).sin();
    }
    let (sin, cos) = (y.atan2(x) / 4.0).sin_cos();
    let turn = |p: &Point| (p.0 * cos + p.1 * sin, p.1 * cos - p.0 * sin);
    ring.iter().map(turn).collect()
}

/// The ring on the grid of half units; `None` if an edge is crooked. Each run of edges along one axis becomes
/// one edge, on the mean of its ends weighted by length.
fn snap(ring: &[Point]) -> Option<Vec<Cell>> {
    let n = ring.len();
    let mut runs: Vec<(bool, f64, f64)> = vec![]; // along x?, weighted sum of the other coordinate, length
    for (k, p) in ring.iter().enumerate() {
        let q = ring[(k + 1) % n];
        let (dx, dy) = (q.0 - p.0, q.1 - p.1);
        let length = dx.hypot(dy);
        if length < HALF / 4.0 {
            continue; // a stray corner
        }
        if dx.abs().min(dy.abs()) > CROOKED * length {
            return None;
        }
        let along_x = dx.abs() > dy.abs();
        let middle = if along_x {
            (p.1 + q.1) / 2.0
        } else {
            (p.0 + q.0) / 2.0
        };
        match runs.last_mut() {
            Some(run) if run.0 == along_x => {
                run.1 += middle * length;
                run.2 += length;
            }
            _ => runs.push((along_x, middle * length, length)),
        }
    }
    if runs.len() > 1 && runs[0].0 == runs[runs.len() - 1].0 {
        let (_, sum, length) = runs.pop()?;
        runs[0].1 += sum;
        runs[0].2 += length;
    }
    let at = |run: &(bool, f64, f64)| (run.1 / run.2 / HALF).round() as i64;
    let corner = |k: usize| {
        let (a, b) = (&runs[k], &runs[(k + 1) % runs.len()]);
        if a.0 { (at(b), at(a)) } else { (at(a), at(b)) }
    };
    (runs.len() >= 4 && runs.len().is_multiple_of(2)).then(|| (0..runs.len()).map(corner).collect())
}

/// Whether edges have a length and no two of them meet but at their common corner.
fn is_simple(ring: &[Cell]) -> bool {
    let n = ring.len();
    let edge = |k: usize| (ring[k % n], ring[(k + 1) % n]);
    let bounds = |k: usize| {
        let (p, q) = edge(k);
        (p.0.min(q.0), p.1.min(q.1), p.0.max(q.0), p.1.max(q.1))
    };
    let apart = |i: usize, j: usize| {
        let (a, b) = (bounds(i), bounds(j));
        a.2 < b.0 || b.2 < a.0 || a.3 < b.1 || b.3 < a.1
    };
    (0..n).all(|i| {
        let (p, q) = edge(i);
        p != q && (i + 2..n).all(|j| (i == 0 && j == n - 1) || apart(i, j))
    })
}

/// Clockwise seen from above, from a convex corner on.
fn walk(mut ring: Vec<Cell>) -> Vec<Cell> {
    let n = ring.len();
    let cross = |p: Cell, q: Cell| p.0 * q.1 - q.0 * p.1;
    if (0..n)
        .map(|k| cross(ring[k], ring[(k + 1) % n]))
        .sum::<i64>()
        > 0
    {
        ring.reverse();
    }
    let convex = |k: usize| turn(&ring, k) < 0;
    let start = (0..n).find(|&k| convex(k)).unwrap_or(0);
    ring.rotate_left(start);
    ring
}

/// Positive = to the left at corner `k`.
fn turn(ring: &[Cell], k: usize) -> i64 {
    let n = ring.len();
    let (p, q, r) = (ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]);
    (q.0 - p.0) * (r.1 - q.1) - (q.1 - p.1) * (r.0 - q.0)
}

/// The text of a house of one storey with this outline.
fn text_of(ring: &[Cell]) -> String {
    let n = ring.len();
    let mut text = "0 0\n9.5\n\n".to_owned();
    for k in 0..n {
        let (p, q) = (ring[k], ring[(k + 1) % n]);
        let halves = ((q.0 - p.0).abs() + (q.1 - p.1).abs()) as usize;
        text += &"KSK  ".repeat(halves / 2);
        text += if halves % 2 == 1 { "GKK h" } else { "" };
        text += if k + 1 < n && turn(ring, k + 1) > 0 {
            "L\n"
        } else {
            "\n"
        };
    }
    text
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_houses_of_a_map_get_whole_roofs() {
    let json = std::fs::read_to_string(map()).expect("the map is there");
    let json: Value = serde_json::from_str(&json).expect("the map is JSON");
    let features = json["features"].as_array().expect("the map has features");
    let (mut built, mut findings) = (0, vec![]);
    for feature in features {
        let ring = ring_of(feature).map(|ring| straighten(&ring));
        let Some(ring) = ring.as_deref().and_then(snap).filter(|r| is_simple(r)) else {
            continue;
        };
        built += 1;
        let text = text_of(&walk(ring));
        let run = compile("outline.hsd", text.as_bytes());
        let id = &feature["properties"]["osm_id"];
        if run.has_errors() {
            findings.push(format!("{id}\n{text}{}", run.short()));
        }
        if run
            .building
            .houses
            .iter()
            .all(|built| built.roofs.roofs.is_empty())
        {
            findings.push(format!("{id}: no roof\n{text}"));
        }
        findings.extend(
            flaws(&run)
                .iter()
                .map(|flaw| format!("{id}: {flaw}\n{text}")),
        );
    }
    eprintln!("{built} of {} outlines are orthogonal", features.len());
    assert!(
        built * 2 > features.len(),
        "most houses of the map are orthogonal"
    );
    assert_none(&findings);
}
