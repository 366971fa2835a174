//! Chigo-mune (稚児棟): the low end of a hip's ridge on roofs of cover tiles. The ridge itself ends some way above the corner
//! in an onigawara, the first one (一の鬼), and a lower ridge goes on to the corner and the second (二の鬼).

use crate::trim::TrimContext;
use crate::trim::line::Line;
use crate::trim::seams::{End, Kind, Seam};
use hsd_ir::ast::RoofKind;

/// Its length as a share of the hip's, and the bounds of that, metres.
const SHARE: f64 = 0.25;
const LENGTHS: (f64, f64) = (0.8, 2.4);
/// The shortest hip with such an end, metres.
const SHORTEST: f64 = 3.2;
/// The fewest courses of a ridge that can be lower at its end.
const COURSES: u32 = 2;
/// How far it runs in under the onigawara of the ridge above, metres.
const INTO: f64 = 0.04;
/// Its width as a share of that of the ridge.
const WIDTH: f64 = 0.9;

/// Returns the lower and the upper part of a hip's line, which runs upwards, if it has such an end.
pub(in crate::trim) fn parted(
    context: &TrimContext<'_>,
    seam: &Seam,
    line: &Line,
    courses: u32,
) -> Option<(Line, Line)> {
    let roof = context.roof;
    let length = line.length();
    let has = roof.kind == RoofKind::CoverTiles
        && !roof.shape.stands_on_another()
        && roof.trim.ends
        && seam.kind == Kind::Hip
        && seam.ends[0] == End::Free
        && courses >= COURSES
        && length >= SHORTEST;
    let at = (SHARE * length).clamp(LENGTHS.0, LENGTHS.1);
    has.then(|| (line.part(0.0, at + INTO), line.part(at, length)))
}

/// Returns the courses and the width of the lower ridge beside those of the upper one.
pub(in crate::trim) fn lower(courses: u32, width: f64) -> (u32, f64) {
    ((courses / 2).max(1), width * WIDTH)
}
