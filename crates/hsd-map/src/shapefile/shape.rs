//! Shapes out of the records of a `.shp`.

use crate::fault::Kind;
use crate::feature::{Area, Chain, Geometry};
use crate::rings;
use glam::{DVec2, dvec2};

/// Heights below this stand for none.
const NO_DATA: f64 = -1e38;

/// Returns the geometry of a record's content.
pub(super) fn geometry(content: &[u8]) -> Result<Geometry, Kind> {
    let kind = integer(content, 0)?;
    let has_heights = (11..=18).contains(&kind);
    match kind {
        0 => Err(Kind::NoGeometry),
        1 | 11 | 21 => {
            let points = vec![point(content, 4)?];
            let heights = match has_heights {
                true => vec![number(content, 20)?],
                false => vec![],
            };
            Ok(Geometry::Points(with_heights(points, heights)))
        }
        8 | 18 | 28 => {
            let count = integer(content, 36)? as usize;
            let points = points(content, 40, count)?;
            let heights = heights(content, 40 + 16 * count, count, has_heights)?;
            Ok(Geometry::Points(with_heights(points, heights)))
        }
        3 | 13 | 23 => Ok(Geometry::Lines(parts(content, has_heights)?)),
        5 | 15 | 25 => Ok(Geometry::Areas(areas(parts(content, has_heights)?))),
        31 => Err(Kind::OtherGeometry {
            name: "MultiPatch".into(),
        }),
        _ => Err(malformed("its shape type does not exist")),
    }
}

/// Rings of one area are the outline and its holes; those of several are told apart by what lies in what, since files do
/// not keep to the order of corners that the format demands.
fn areas(rings: Vec<Chain>) -> Vec<Area> {
    rings::areas(rings)
}

fn malformed(what: &str) -> Kind {
    Kind::Malformed { what: what.into() }
}

fn too_short() -> Kind {
    malformed("the record is too short for its points")
}

fn integer(content: &[u8], at: usize) -> Result<u32, Kind> {
    let bytes = content.get(at..at + 4).and_then(|b| b.try_into().ok());
    bytes.map(u32::from_le_bytes).ok_or_else(too_short)
}

fn number(content: &[u8], at: usize) -> Result<f64, Kind> {
    let bytes = content.get(at..at + 8).and_then(|b| b.try_into().ok());
    bytes.map(f64::from_le_bytes).ok_or_else(too_short)
}

fn point(content: &[u8], at: usize) -> Result<DVec2, Kind> {
    Ok(dvec2(number(content, at)?, number(content, at + 8)?))
}

/// Returns points, whose number is that of a record: checked against its length before memory is taken.
fn points(content: &[u8], at: usize, count: usize) -> Result<Vec<DVec2>, Kind> {
    if content.len() < count.saturating_mul(16).saturating_add(at) {
        return Err(too_short());
    }
    (0..count).map(|n| point(content, at + 16 * n)).collect()
}

fn heights(content: &[u8], at: usize, count: usize, has_any: bool) -> Result<Vec<f64>, Kind> {
    if !has_any {
        return Ok(vec![]);
    }
    // The range of heights stands before them.
    (0..count)
        .map(|n| number(content, at + 16 + 8 * n))
        .collect()
}

fn with_heights(points: Vec<DVec2>, mut heights: Vec<f64>) -> Chain {
    if heights.iter().any(|z| *z < NO_DATA) {
        heights.clear();
    }
    Chain { points, heights }
}

fn parts(content: &[u8], has_heights: bool) -> Result<Vec<Chain>, Kind> {
    let (parts, count) = (
        integer(content, 36)? as usize,
        integer(content, 40)? as usize,
    );
    if content.len() < parts.saturating_mul(4).saturating_add(44) {
        return Err(too_short());
    }
    let first = 44 + 4 * parts;
    let points = points(content, first, count)?;
    let heights = heights(content, first + 16 * count, count, has_heights)?;
    let starts: Result<Vec<usize>, Kind> = (0..parts)
        .map(|part| Ok(integer(content, 44 + 4 * part)? as usize))
        .collect();
    let mut starts = starts?;
    starts.push(count);
    let sorted = starts.windows(2).all(|pair| pair[0] <= pair[1]);
    if !sorted || starts.first().is_some_and(|s| *s > 0) {
        return Err(malformed("its parts do not follow each other"));
    }
    let chain = |pair: &[usize]| {
        let of = pair[0]..pair[1];
        let heights = heights.get(of.clone()).unwrap_or_default().to_vec();
        with_heights(points[of].to_vec(), heights)
    };
    Ok(starts.windows(2).map(chain).collect())
}
