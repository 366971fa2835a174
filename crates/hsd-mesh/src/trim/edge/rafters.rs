//! Rafters (taruki) under the eaves, 55 x 45 mm at 455 mm (docs/evidence.md 4.4), parallel on every slope as usual in
//! wayo; under hips, the hip rafter. Temples have two rows, the upper one (hien-daruki) projecting beyond the lower. A
//! board (hirokomai) runs over their ends.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::level_left;
use crate::trim::seams::{End, Seam};
use crate::trim::slope::Field;
use glam::{DVec2, DVec3};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Height and half width of a rafter, metres.
const RAFTER: (f64, f64) = (0.055, 0.0225);
/// Spacing of rafters, metres: 1.5 shaku.
const APART: f64 = 0.455;
/// Spacing of temple rafters, metres.
const CLOSE: f64 = 0.30;
/// Height and half width of a temple rafter, metres.
const GREAT: (f64, f64) = (0.12, 0.05);
/// How far rafters extend into the roof above them, metres.
const SUNK: f64 = 0.006;
/// How far they extend beyond the wall line, metres.
const INSIDE: f64 = 0.05;
/// Setback of their ends from the eaves, metres.
const BACK: f64 = 0.06;
/// Share of the eaves that the lower of two rows spans.
const LOWER: f64 = 0.62;
/// The board in front of their ends: its thickness and how far it extends below them, metres.
const BOARD: (f64, f64) = (0.022, 0.012);
/// Height and half width of a hip rafter, metres.
const HIP: (f64, f64) = (0.12, 0.05);

/// A row of rafters: its start and end behind the eaves in plan, and the distance of its upper side below the roof's
/// lower surface, metres.
#[derive(Clone, Copy)]
struct Row {
    from: f64,
    to: f64,
    below: f64,
    size: (f64, f64),
    apart: f64,
    timber: SurfaceId,
}

/// Returns the rows under the eaves.
fn rows(context: &TrimContext<'_>) -> Vec<Row> {
    let trim = &context.roof.trim;
    let to = trim.eaves + INSIDE;
    let great = trim.rafters > 1;
    let (size, apart) = if great {
        (GREAT, CLOSE)
    } else {
        (RAFTER, APART)
    };
    let upper = Row {
        from: BACK,
        to,
        below: -SUNK,
        size,
        apart,
        timber: context.timber(),
    };
    if !great {
        return vec![upper];
    }
    let lower = Row {
        from: trim.eaves * (1.0 - LOWER),
        to,
        below: size.0 - 2.0 * SUNK,
        size,
        apart,
        timber: context.timber(),
    };
    vec![upper, lower]
}

/// Returns true if there are rafters, or at least the boards in front of them; great ones hide the top of the wall even from afar.
pub(in crate::trim) fn are_shown(context: &TrimContext<'_>) -> bool {
    let least = match context.roof.trim.rafters > 1 {
        true => Detail::Flat,
        false => Detail::Openings,
    };
    context.detail >= least && context.roof.trim.eaves >= 2.0 * BACK
}

/// Adds the rafters under one line of eaves, and the board in front of them.
pub(in crate::trim) fn eaves(
    context: &TrimContext<'_>,
    fields: &[Field],
    seam: &Seam,
    bodies: &mut Vec<Body>,
) {
    if !are_shown(context) {
        return;
    }
    let rows = rows(context);
    rows.iter().for_each(|row| board(fields, seam, row, bodies));
    if context.detail < Detail::Everything {
        return;
    }
    for (span, ends) in seam.spans.iter().zip(seam.points.windows(2)) {
        let field = &fields[span.left as usize];
        let (s0, s1) = (field.s(ends[0]), field.s(ends[1]));
        let (lo, hi) = (s0.min(s1), s0.max(s1));
        let deep = span.deep[0].max(span.deep[1]);
        for row in &rows {
            // As many as fit, the same distance from both ends.
            let margin = 2.0 * row.size.1;
            let count = ((hi - lo - 2.0 * margin) / row.apart)
                .floor()
                .clamp(0.0, 2000.0);
            let first = (lo + hi - count * row.apart) / 2.0;
            for i in 0..=count as u32 {
                let s = first + row.apart * f64::from(i);
                // Under a verge they show up to the ridge.
                let outside = (s - lo).min(hi - s) < context.roof.trim.verge;
                let to = if outside { f64::INFINITY } else { row.to };
                let own = Row { to, ..*row };
                rafter(fields, field.slope(), s, deep, &own, bodies);
            }
        }
    }
}

/// Builds a rafter at `s` under a covering `deep` metres thick, following the curve of its slope.
fn rafter(fields: &[Field], slope: usize, s: f64, deep: f64, row: &Row, bodies: &mut Vec<Body>) {
    let half = row.size.1;
    let own = || fields.iter().filter(|f| f.slope() == slope);
    let reach = |s: f64| own().filter_map(move |f| f.column(s)).map(|c| c.0);
    let Some(low) = reach(s).reduce(f64::min) else {
        return;
    };
    let top = -(deep + row.below);
    let within = (low + row.from, low + row.to);
    for field in own() {
        let foot = top - row.size.0 * field.stretch();
        let profile = [(-half, foot), (half, foot), (half, top), (-half, top)];
        let finish = row.timber;
        let made = field.upright_row(finish, s, &profile, within);
        bodies.extend(made.map(|body| body.in_row("rafters", field.right())));
    }
}

/// Adds the board in front of the ends of the rafters.
fn board(fields: &[Field], seam: &Seam, row: &Row, bodies: &mut Vec<Body>) {
    let last = seam.points.len() - 1;
    let section = |i: usize| -> Vec<DVec3> {
        let way = seam.points[(i + 1).min(last)] - seam.points[i.max(1) - 1];
        let inward: DVec2 = level_left(way);
        let deep = match i {
            0 => seam.spans[0].deep[0],
            _ => seam.spans[i - 1].deep[1],
        };
        let along = way.truncate().normalize_or_zero();
        let drawn = match i {
            0 if seam.ends[0] == End::Free => along * row.from,
            i if i == last && seam.ends[1] == End::Free => along * -row.from,
            _ => DVec2::ZERO,
        };
        let plan = seam.points[i].truncate() + inward * (row.from - BOARD.0) + drawn;
        let field = &fields[seam.spans[i.min(last - 1)].left as usize];
        // Its head lies in the roof, its foot below the rafters.
        let soffit = seam.points[i].z - deep + field.pitch() * (row.from - BOARD.0);
        let (top, low) = (
            soffit + 0.012,
            soffit - row.below - row.size.0 * field.stretch() - BOARD.1,
        );
        let back = plan + inward * BOARD.0;
        vec![
            plan.extend(top),
            plan.extend(low),
            back.extend(low),
            back.extend(top),
        ]
    };
    let sections: Vec<Vec<DVec3>> = (0..=last).map(section).collect();
    bodies.extend(Body::loft(row.timber, &sections));
}

/// Adds the rafter under a hip, from the eaves to the wall.
pub(in crate::trim) fn hip(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let eaves = context.roof.trim.eaves;
    let free = seam.ends[0] == End::Free;
    if context.detail < Detail::Everything || eaves < 2.0 * BACK || !free {
        return;
    }
    let Some(deep) = context.surface.deep_at(seam.points[0]) else {
        return;
    };
    let line = crate::trim::line::Line {
        points: seam.points.clone(),
    };
    // The diagonal of the eaves on both sides.
    let reach = (eaves + INSIDE) * std::f64::consts::SQRT_2;
    let part = line.part(2.0 * BACK, reach.min(line.length()));
    let (high, half) = HIP;
    let lean = context.lean(seam);
    let top = -deep + SUNK - lean * half;
    let profile = [
        (-half, top - high),
        (half, top - high),
        (half, top),
        (-half, top),
    ];
    bodies.extend(Body::loft(context.timber(), &part.sections(&profile)));
}
