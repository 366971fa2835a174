//! Flashing: sheet metal gutters in valleys, and courses of flat tiles (noshi) or a board where a slope abuts a wall or
//! ends at its crest.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::Line;
use crate::trim::seams::{End, Kind, REACH, Seam};
use hsd_ir::ast::RoofKind;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Half the width of a gutter, and its height above the slopes, metres.
const GUTTER: (f64, f64) = (0.09, 0.012);
/// Courses against a wall: how far they cover the slope, and the height of one, metres. Walls project by half their
/// thickness from the line on which roofs end.
const COURSES: (f64, f64) = (0.20, 0.04);
/// How far all flashing extends into the slope, metres.
const SUNK: f64 = 0.02;
/// How far courses project over a free crest, metres.
const OVER: f64 = 0.016;
/// Lines shorter than this have no flashing, metres.
const SHORTEST: f64 = 0.2;

/// Adds a gutter along a valley; if another roof is on the other side, only the half on this one.
pub(in crate::trim) fn valley(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let line = Line {
        points: seam.points.clone(),
    };
    if context.detail < Detail::Openings || line.length() < SHORTEST {
        return;
    }
    let thatched = matches!(context.roof.kind, RoofKind::Thatch);
    let finish = SurfaceId::named(if thatched { "bark" } else { "sheet_roof" });
    let (wide, high) = GUTTER;
    for (span, ends) in seam.spans.iter().zip(seam.points.windows(2)) {
        let [left, right] = context.surface.leans(span, ends[1] - ends[0]);
        // Slopes rise to both sides, by minus their lean.
        let mut profile = vec![
            (wide, -left * wide - SUNK),
            (wide, -left * wide + high),
            (0.0, high),
        ];
        match span.left == span.right {
            true => profile.push((0.0, -SUNK)),
            false => profile.extend([
                (-wide, -right * wide + high),
                (-wide, -right * wide - SUNK),
                (0.0, -SUNK),
            ]),
        }
        let piece = Line {
            points: ends.to_vec(),
        };
        bodies.extend(Body::loft(finish, &piece.sections(&profile)));
    }
}

/// Adds courses along a wall, or along the crest of a single slope.
pub(in crate::trim) fn wall(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let line = Line {
        points: seam.points.clone(),
    };
    if context.detail < Detail::Openings || line.length() < SHORTEST {
        return;
    }
    let (name, courses) = match context.roof.kind {
        RoofKind::Tiles | RoofKind::CoverTiles => ("ibushi", 2),
        RoofKind::Metal => ("sheet_roof", 1),
        RoofKind::Bark | RoofKind::Shingles | RoofKind::Boards => ("cedar", 1),
        // Thatch is packed against walls.
        RoofKind::Thatch => return,
    };
    // A slope that runs along a wall has one course less.
    let courses = if seam.kind == Kind::Flank { 1 } else { courses };
    let (wide, high) = COURSES;
    let wide = if seam.kind == Kind::Flank {
        0.7 * wide
    } else {
        wide
    };
    let fall = context.lean(seam).max(0.0);
    let free = seam.spans.iter().any(|s| s.deep != [0.0; 2]);
    let back = if free { -OVER } else { -REACH };
    let mut profile = vec![(back, -SUNK), (wide, -fall * wide - SUNK)];
    for i in 0..courses {
        let own = wide * (1.0 - 0.2 * f64::from(i));
        // Each course falls a little less than the slope, so that water runs off it.
        let foot = -fall * own + high * f64::from(i) + if i > 0 { 0.004 } else { 0.0 };
        profile.extend([(own, foot), (own, -fall * own + high * f64::from(i + 1))]);
    }
    profile.push((back, high * f64::from(courses)));
    // Free ends stay inside the verge.
    let drawn = |end: End| if end == End::Free { 0.01 } else { 0.0 };
    let piece = line.part(drawn(seam.ends[0]), line.length() - drawn(seam.ends[1]));
    bodies.extend(Body::loft(
        SurfaceId::named(name),
        &piece.sections(&profile),
    ));
}
