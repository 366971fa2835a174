//! Values of the options of `hsd plan`.

use clap::ValueEnum;
use glam::{DVec2, dvec2};
use hsd_trace::plan::Front;
use hsd_trace::plan::flatten::Region;

/// Places farther out are in no image or drawing.
const FARTHEST: f64 = 1e9;
/// The diagonal below which a box is in metres, not in pixels or millimetres.
const SMALL: f64 = 100.0;

/// The side of a sheet where the street is.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Side {
    /// At the lower edge.
    Bottom,
    /// At the left edge.
    Left,
    /// At the upper edge.
    Top,
    /// At the right edge.
    Right,
}

impl From<Side> for Front {
    fn from(side: Side) -> Front {
        match side {
            Side::Bottom => Front::Bottom,
            Side::Left => Front::Left,
            Side::Top => Front::Top,
            Side::Right => Front::Right,
        }
    }
}

/// The parts that stand for what a plan shows.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum EraArg {
    /// Clay walls, paper screens.
    Edo,
    /// Boarded walls, paper screens.
    Meiji,
    /// Boarded walls, glass.
    Showa,
}

impl EraArg {
    pub(super) fn name(self) -> &'static str {
        match self {
            EraArg::Edo => "edo",
            EraArg::Meiji => "meiji",
            EraArg::Showa => "showa",
        }
    }
}

/// Two points of a plan and the ken between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ken {
    /// The length of half a ken, pixels.
    pub(super) unit: f64,
}

/// A point of the first sheet, and the same point of another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Same {
    pub(super) ground: DVec2,
    pub(super) upper: DVec2,
}

/// Shaku in half a ken.
pub(super) fn unit(text: &str) -> Result<f64, String> {
    match text.trim().to_lowercase().as_str() {
        "edo-ma" | "edoma" | "江戸間" => Ok(3.0),
        "kyo-ma" | "kyoma" | "京間" => Ok(3.25),
        other => match other.parse::<f64>() {
            Ok(shaku) if (2.0..=4.0).contains(&shaku) => Ok(shaku),
            _ => Err("expected kyo-ma, edo-ma, or shaku in half a ken, as in `3.25`".to_owned()),
        },
    }
}

/// A length in pixels.
pub(super) fn pixels(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(length) if (4.0..=4000.0).contains(&length) => Ok(length),
        _ => Err("expected the length of half a ken in pixels, from 4 to 4000".to_owned()),
    }
}

/// A height in shaku.
pub(super) fn height(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(shaku) if (4.0..=40.0).contains(&shaku) => Ok(shaku),
        _ => Err("expected a height in shaku, from 4 to 40".to_owned()),
    }
}

/// A skew in degrees.
pub(super) fn degrees(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(angle) if (-45.0..=45.0).contains(&angle) => Ok(angle),
        _ => Err("expected degrees clockwise, from -45 to 45".to_owned()),
    }
}

/// Four corners, clockwise from the upper left.
pub(in crate::build) fn corners(text: &str) -> Result<[DVec2; 4], String> {
    let points: Option<Vec<DVec2>> = text.split_whitespace().map(point).collect();
    let points = points.and_then(|p| <[DVec2; 4]>::try_from(p).ok());
    let Some(points) = points else {
        return Err("expected four points, clockwise from the upper left, as in \"80,60 900,70 880,1240 90,1220\"".to_owned());
    };
    let turn = |k: usize| {
        (points[(k + 1) % 4] - points[k]).perp_dot(points[(k + 2) % 4] - points[(k + 1) % 4])
    };
    match (0..4).all(|k| turn(k) > 1.0) {
        true => Ok(points),
        false => Err("the four points must go clockwise, from the upper left corner".to_owned()),
    }
}

/// Parses a box from two opposite corners.
pub(super) fn region(text: &str) -> Result<Region, String> {
    let points: Option<Vec<DVec2>> = text.split_whitespace().map(point).collect();
    match points.as_deref() {
        Some([a, b]) if (*a - *b).abs().min_element() > 0.0 => Ok([a.min(*b), a.max(*b)]),
        _ => Err("expected two opposite corners of a box, as in \"80,60 900,640\"".to_owned()),
    }
}

/// Returns a box as [`region`] reads it. Boxes in metres keep millimetres.
pub(super) fn region_name([a, b]: Region) -> String {
    let step = if a.distance(b) < SMALL { 1e3 } else { 1.0 };
    let [a, b] = [a, b].map(|p| (p * step).round() / step + 0.0);
    format!("{},{} {},{}", a.x, a.y, b.x, b.y)
}

/// A page, counted from 1.
pub(super) fn page(text: &str) -> Result<usize, String> {
    let page = text.parse().ok().filter(|page| *page > 0);
    page.ok_or_else(|| "expected the number of a page, counted from 1".to_owned())
}

/// Two points and the ken between them.
pub(super) fn ken(text: &str) -> Result<Ken, String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let read = match words[..] {
        [a, b, ken] => point(a)
            .zip(point(b))
            .zip(ken.parse::<f64>().ok())
            .map(|((a, b), ken)| (a, b, ken)),
        _ => None,
    };
    match read {
        Some((a, b, ken)) if ken > 0.0 && a.distance(b) > 8.0 => Ok(Ken {
            unit: a.distance(b) / (2.0 * ken),
        }),
        _ => Err(
            "expected two points and the ken between them, as in \"100,80 100,880 5\"".to_owned(),
        ),
    }
}

/// A point of the first sheet and the same of another.
pub(super) fn same(text: &str) -> Result<Same, String> {
    let points = text
        .split_once('=')
        .and_then(|(a, b)| Some((point(a.trim())?, point(b.trim())?)));
    let (ground, upper) = points.ok_or("expected a point of the first sheet and the same point of the other, as in 120,900=130,870")?;
    Ok(Same { ground, upper })
}

fn point(text: &str) -> Option<DVec2> {
    let (x, y) = text.split_once(',')?;
    let (x, y): (f64, f64) = (x.trim().parse().ok()?, y.trim().parse().ok()?);
    (x.abs() < FARTHEST && y.abs() < FARTHEST).then_some(dvec2(x, y))
}
