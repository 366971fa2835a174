//! Ridges of coverings other than tiles: two boards, a box of boards with or without a tile ridge on it, folded sheet
//! metal, and thatch with its riders (umanori).

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::Line;
use crate::trim::ridge::{arch, plain, run_on};
use crate::trim::seams::{Kind, Seam};
use glam::DVec3;
use hsd_ir::ast::RoofKind;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// How far a ridge extends into the slopes, metres.
const SUNK: f64 = 0.02;

/// Adds the ridge or hip of a roof that is not tiled.
pub(in crate::trim) fn ridge(context: &TrimContext<'_>, seam: &Seam, bodies: &mut Vec<Body>) {
    let Some(line) = run_on(context.roof.kind, seam) else {
        return;
    };
    let (kind, hip) = (context.roof.kind, seam.kind == Kind::Hip);
    let lean = context.lean(seam);
    let shown = context.detail >= Detail::Openings;
    let named = SurfaceId::named;
    match kind {
        RoofKind::Tiles | RoofKind::CoverTiles => {}
        RoofKind::Boards => {
            bodies.extend(Body::loft(
                named("cedar"),
                &line.sections(&fold(0.14, lean, 0.035)),
            ));
        }
        RoofKind::Metal => {
            let profile = fold(0.11, lean, 0.03);
            bodies.extend(Body::loft(named("sheet_roof"), &line.sections(&profile)));
        }
        // What covers a hip is the covering itself, a little thicker.
        RoofKind::Shingles | RoofKind::Bark if hip => {
            let finish = named(if kind == RoofKind::Bark {
                "bark"
            } else {
                "shingle"
            });
            bodies.extend(Body::loft(finish, &line.sections(&fold(0.16, lean, 0.046))));
        }
        RoofKind::Thatch if hip => {
            let profile = fold(0.30, lean, 0.06);
            bodies.extend(Body::loft(named("thatch"), &line.sections(&profile)));
        }
        RoofKind::Shingles => boxed(&line, lean, (0.12, 0.15), ["cedar"; 2], shown, bodies),
        RoofKind::Bark => {
            let tiles = ["noshi", "ibushi"];
            boxed(&line, lean, (0.15, 0.30), tiles, shown, bodies);
        }
        RoofKind::Thatch => {
            saddle(&line, lean, bodies);
            if shown {
                riders(&line, lean, bodies);
            }
        }
    }
}

/// Returns the profile of two boards or flaps that meet over the line, `wide` in plan on both sides.
fn fold(wide: f64, lean: f64, thick: f64) -> [(f64, f64); 6] {
    let low = -lean * wide;
    [
        (-wide, low - SUNK),
        (0.0, -SUNK),
        (wide, low - SUNK),
        (wide, low + thick),
        (0.0, thick * 1.15),
        (-wide, low + thick),
    ]
}

/// Adds a box (hako-mune) of boards, or of boards under tiles, with a projecting cover.
fn boxed(
    line: &Line,
    lean: f64,
    (half, height): (f64, f64),
    [wall, cover]: [&str; 2],
    shown: bool,
    bodies: &mut Vec<Body>,
) {
    let foot = SUNK + lean * half;
    let cedar = SurfaceId::named("cedar");
    if !shown {
        let profile = plain(half, foot, height);
        bodies.extend(Body::loft(
            SurfaceId::named(cover),
            &line.sections(&profile),
        ));
        return;
    }
    let neck = height - 0.07;
    let sides = [(-half, -foot), (half, -foot), (half, neck), (-half, neck)];
    bodies.extend(Body::loft(SurfaceId::named(wall), &line.sections(&sides)));
    let sill = half + 0.035;
    let foot = SUNK + lean * sill;
    let skirt = [
        (-sill, -foot),
        (sill, -foot),
        (half - 0.01, 0.05),
        (-half + 0.01, 0.05),
    ];
    // No two of them end in one plane.
    let skirt = line.longer(-0.01).sections(&skirt);
    bodies.extend(Body::loft(cedar, &skirt));
    let lid = arch(half + 0.04, 0.075, neck - 0.005);
    let lid = line.longer(0.02).sections(&lid);
    let lid = Body::loft(SurfaceId::named(cover), &lid);
    bodies.extend(lid.map(Body::smooth));
}

/// Adds the bundles over the ridge of a thatched roof, under bark.
fn saddle(line: &Line, lean: f64, bodies: &mut Vec<Body>) {
    // Up to where the slopes lie, then round over the top.
    let half = 0.45;
    let foot = -lean * half - 0.05;
    let profile = [
        (-half, foot),
        (half, foot),
        (half * 1.04, foot + 0.16),
        (half * 0.66, 0.24 - lean * half * 0.2),
        (half * 0.25, 0.34),
        (-half * 0.25, 0.34),
        (-half * 0.66, 0.24 - lean * half * 0.2),
        (-half * 1.04, foot + 0.16),
    ];
    let body = Body::loft(SurfaceId::named("bark"), &line.sections(&profile));
    bodies.extend(body.map(Body::smooth));
}

/// Adds pairs of logs that straddle the ridge of a thatched roof, an odd number of them.
fn riders(line: &Line, lean: f64, bodies: &mut Vec<Body>) {
    let length = line.length();
    let count = ((length / 1.1).floor() as u32).clamp(1, 99) | 1;
    let step = length / (f64::from(count) + 1.0);
    let finish = SurfaceId::named("cedar_silver");
    for i in 1..=count {
        let (from, along) = (
            line.at(f64::from(i) * step),
            line.at(f64::from(i) * step + 0.1),
        );
        let way = (along - from).normalize_or_zero();
        let across = way.truncate().perp().normalize_or_zero().extend(0.0);
        for side in [-1.0, 1.0] {
            // From above the ridge on one side over the shoulder of the bundles and down beside them on the other;
            // the pair lies side by side.
            let at = from + way * (side * 0.055);
            let on = |x: f64| {
                at + across * (side * x) + DVec3::Z * (0.41 + (0.11 - x) * 1.4 * lean.max(0.7))
            };
            let (head, foot) = (on(-0.14), on(0.68));
            bodies.extend(log(finish, head, foot, way, 0.05));
        }
    }
}

/// Builds a log between two points; `beside` is at right angles to it.
pub(in crate::trim) fn log(
    finish: SurfaceId,
    from: DVec3,
    to: DVec3,
    beside: DVec3,
    radius: f64,
) -> Option<Body> {
    let up = beside.cross((to - from).normalize_or_zero());
    let ring = |at: DVec3| -> Vec<DVec3> {
        let corner = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i) / 6.0;
            at + beside * (radius * libm::cos(angle)) + up * (radius * libm::sin(angle))
        };
        (0..6).map(corner).collect()
    };
    Body::loft(finish, &[ring(from), ring(to)]).map(Body::smooth)
}
