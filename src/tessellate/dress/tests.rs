//! Dressing of known roofs: seams where they must be, bodies closed, sizes that follow the roof.

use super::seams::{End, Kind, Seam, Surface};
use super::{Beyond, Body, Rafters, dress};
use crate::ast::{RoofKind, RoofShape};
use crate::building::{Dress, Face, Finish, Roof, Solid};
use crate::check::solid_flaws;
use crate::roof::facet::Corner;
use crate::roof::frame::Plane;
use crate::roof::sheet::{Coat, sheet};
use crate::scene::Detail;
use glam::{DVec2, dvec2};

/// All coverings.
const KINDS: [RoofKind; 7] = [
    RoofKind::Tiles,
    RoofKind::CoverTiles,
    RoofKind::Boards,
    RoofKind::Shingles,
    RoofKind::Bark,
    RoofKind::Thatch,
    RoofKind::Metal,
];

/// A facet as corners (x, y, whether a rim starts there) and its rise per metre in x and y, z = 0 at the origin.
type Slope<'a> = (&'a [(f64, f64, bool)], [f64; 2], f64);

fn solids(kind: RoofKind, slopes: &[Slope<'_>]) -> Vec<Solid> {
    let coat = Coat {
        top: Finish::Covering(kind),
        rim: Finish::Edge(kind),
        joint: Finish::Plaster,
        soffit: Finish::Soffit,
    };
    let pieces: Vec<_> = slopes
        .iter()
        .map(|(corners, rise, z)| {
            let corner = |&(x, y, rim): &(f64, f64, bool)| Corner {
                at: dvec2(x, y),
                rim,
            };
            let plane = Plane {
                z: *z,
                slope: DVec2::from(*rise),
            };
            (corners.iter().map(corner).collect(), plane)
        })
        .collect();
    sheet(&pieces, 0.12, &coat, f64::MIN)
}

/// Eaves along x at y = 0 and y = d, ridge at y = d / 2.
fn gable(kind: RoofKind, l: f64, d: f64, pitch: f64) -> Vec<Solid> {
    let h = d / 2.0;
    let near = [
        (0.0, 0.0, true),
        (l, 0.0, true),
        (l, h, false),
        (0.0, h, true),
    ];
    let far = [(0.0, h, false), (l, h, true), (l, d, true), (0.0, d, true)];
    solids(
        kind,
        &[
            (&near, [0.0, pitch], 3.0),
            (&far, [0.0, -pitch], 3.0 + d * pitch),
        ],
    )
}

fn hip(kind: RoofKind, l: f64, d: f64, pitch: f64) -> Vec<Solid> {
    let h = d / 2.0;
    let near = [
        (0.0, 0.0, true),
        (l, 0.0, false),
        (l - h, h, false),
        (h, h, false),
    ];
    let far = [
        (h, h, false),
        (l - h, h, false),
        (l, d, true),
        (0.0, d, false),
    ];
    let left = [(0.0, 0.0, false), (h, h, false), (0.0, d, true)];
    let right = [(l, 0.0, true), (l, d, false), (l - h, h, false)];
    solids(
        kind,
        &[
            (&near, [0.0, pitch], 3.0),
            (&far, [0.0, -pitch], 3.0 + d * pitch),
            (&left, [pitch, 0.0], 3.0),
            (&right, [-pitch, 0.0], 3.0 + l * pitch),
        ],
    )
}

/// Gables over an L: x to 10 by y to 4, and x to 4 by y to 9.
fn corner(kind: RoofKind, pitch: f64) -> Vec<Solid> {
    let top = 3.0 + 4.0 * pitch;
    let front = [
        (0.0, 0.0, true),
        (10.0, 0.0, true),
        (10.0, 2.0, false),
        (2.0, 2.0, false),
    ];
    let back = [
        (2.0, 2.0, false),
        (10.0, 2.0, true),
        (10.0, 4.0, true),
        (4.0, 4.0, false),
    ];
    let left = [
        (0.0, 0.0, false),
        (2.0, 2.0, false),
        (2.0, 9.0, true),
        (0.0, 9.0, true),
    ];
    let right = [
        (2.0, 2.0, false),
        (4.0, 4.0, true),
        (4.0, 9.0, true),
        (2.0, 9.0, false),
    ];
    solids(
        kind,
        &[
            (&front, [0.0, pitch], 3.0),
            (&back, [0.0, -pitch], top),
            (&left, [pitch, 0.0], 3.0),
            (&right, [-pitch, 0.0], top),
        ],
    )
}

fn roof(kind: RoofKind, solids: Vec<Solid>) -> Roof {
    Roof {
        storey: 1,
        span: None,
        shape: RoofShape::Gable,
        kind,
        dress: Dress {
            eaves: 0.75,
            verge: 0.3,
            noshi: 5,
            ends: true,
            pendant: true,
            rafters: 2,
        },
        solids,
    }
}

fn seams(solids: &[Solid]) -> Vec<Seam> {
    Surface::of(solids).seams(&Beyond::default())
}

fn count(seams: &[Seam], kind: Kind) -> usize {
    seams.iter().filter(|s| s.kind == kind).count()
}

#[test]
fn a_gable_has_a_ridge_two_eaves_and_two_verges() {
    let seams = seams(&gable(RoofKind::Tiles, 8.0, 6.0, 0.4));
    let counts = [Kind::Ridge, Kind::Eaves, Kind::Verge].map(|k| count(&seams, k));
    assert_eq!((counts, seams.len()), ([1, 2, 2], 5));
    let ridge = &seams[0];
    assert_eq!(ridge.ends, [End::Free, End::Free]);
    assert!((ridge.points[0].distance(ridge.points[1]) - 8.0).abs() < 1e-9);
    let verge = seams
        .iter()
        .find(|s| s.kind == Kind::Verge)
        .expect("a verge");
    assert_eq!(verge.points.len(), 3);
    assert!((verge.points[1].z - 4.2).abs() < 1e-9);
    assert!((verge.spans[0].deep[0] - 0.12).abs() < 1e-9);
}

#[test]
fn a_hipped_roof_has_four_hips_that_end_free_below() {
    let seams = seams(&hip(RoofKind::Tiles, 9.0, 6.0, 0.5));
    let counts = [Kind::Ridge, Kind::Hip, Kind::Eaves].map(|k| count(&seams, k));
    assert_eq!((counts, seams.len()), ([1, 4, 4], 9));
    assert_eq!(seams[0].ends, [End::Met, End::Met]);
    for hip in seams.iter().filter(|s| s.kind == Kind::Hip) {
        assert_eq!(hip.ends, [End::Free, End::Met]);
        assert!(hip.points[0].z < hip.points[1].z);
    }
}

#[test]
fn an_l_has_a_valley_and_a_hip() {
    let seams = seams(&corner(RoofKind::Tiles, 0.4));
    let kinds = [
        Kind::Ridge,
        Kind::Hip,
        Kind::Valley,
        Kind::Eaves,
        Kind::Verge,
    ];
    assert_eq!(kinds.map(|k| count(&seams, k)), [2, 1, 1, 4, 2]);
}

#[test]
fn strips_of_a_curve_are_one_slope() {
    let strip = |y0: f64, y1: f64, rim: bool| {
        [
            (0.0, y0, rim),
            (6.0, y0, true),
            (6.0, y1, !rim),
            (0.0, y1, true),
        ]
    };
    let (low, high) = (strip(0.0, 2.0, true), strip(2.0, 4.0, false));
    let seams = seams(&solids(
        RoofKind::Bark,
        &[(&low, [0.0, 0.4], 3.0), (&high, [0.0, 0.6], 2.6)],
    ));
    let kinds = [Kind::Eaves, Kind::Crest, Kind::Verge];
    assert_eq!(
        (kinds.map(|k| count(&seams, k)), seams.len()),
        ([1, 1, 2], 4)
    );
}

/// Everything that a roof wears.
fn bodies(roof: &Roof, detail: Detail) -> Vec<Body> {
    let worn = dress(roof, &Beyond::default(), detail);
    let rows = worn.rows.iter().flat_map(|row| Rafters::bodies(row.size));
    worn.bodies.into_iter().chain(rows).collect()
}

/// A body as the checks take it.
fn solid(body: &Body) -> Solid {
    let finish = Finish::Plaster;
    let face = |corners: &crate::building::Corners| Face {
        corners: corners.clone(),
        finish,
    };
    Solid {
        points: body.points.clone(),
        faces: body.faces.iter().map(face).collect(),
    }
}

fn assert_closed(bodies: &[Body], what: &str) {
    for body in bodies {
        let flaws: Vec<_> = solid_flaws(&solid(body)).collect();
        assert!(flaws.is_empty(), "{what}: {flaws:?}\n{body:?}");
    }
}

#[test]
fn everything_worn_is_closed() {
    for kind in KINDS {
        for pitch in [0.25, 0.5, 1.0] {
            let shapes = [
                gable(kind, 8.0, 6.0, pitch),
                gable(kind, 0.6, 5.0, pitch),
                hip(kind, 9.0, 6.0, pitch),
                hip(kind, 5.0, 5.0, pitch),
                corner(kind, pitch),
            ];
            for (n, solids) in shapes.into_iter().enumerate() {
                for detail in Detail::ALL {
                    let bodies = bodies(&roof(kind, solids.clone()), detail);
                    assert!(!bodies.is_empty());
                    assert_closed(&bodies, &format!("{kind:?} {pitch} shape {n} {detail:?}"));
                }
            }
        }
    }
}
