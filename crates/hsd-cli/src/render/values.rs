//! The values of the options of `hsd render`.

use hsd_ir::ast::ViewTime;

/// Metres east, north and up.
pub(super) type Place = [f64; 3];

/// Parses a size such as `960x640`.
pub(super) fn size(text: &str) -> Result<(u32, u32), &'static str> {
    let side = |t: &str| t.parse().ok().filter(|n: &u32| (16..=8192).contains(n));
    let sides = text
        .split_once('x')
        .and_then(|(w, h)| Some((side(w)?, side(h)?)));
    sides.ok_or("expected width and height in pixels, 16 to 8192, as in 960x640")
}

/// Parses a place such as `2,0,1.6`.
pub(super) fn place(text: &str) -> Result<Place, &'static str> {
    const EXPECTED: &str = "expected metres east, north and up, as in 2,-3.5,1.6";
    let number = |t: &str| t.trim().parse().ok().filter(|n: &f64| n.abs() <= 1e8);
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    numbers.ok_or(EXPECTED)?.try_into().map_err(|_| EXPECTED)
}

/// Parses a date such as `2026-12-21`.
pub(super) fn date(text: &str) -> Result<String, &'static str> {
    ViewTime::date(text).ok_or("expected a date, as in 2026-12-21")
}

/// Parses an hour such as `9`, `9.5` or `9:30`.
pub(super) fn hour(text: &str) -> Result<f64, &'static str> {
    ViewTime::hour(text).ok_or("expected an hour of the day, as in 9 or 16:30")
}

/// Parses an angle of view.
pub(super) fn angle(text: &str) -> Result<f64, &'static str> {
    let angle = text.trim().parse().ok();
    let angle = angle.filter(|n| (1.0..=150.0).contains(n));
    angle.ok_or("expected degrees, 1 to 150")
}
