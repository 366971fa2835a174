//! Tests of trim on known roofs: seams in the right places, bodies closed, sizes that follow the roof.

use crate::trim::seams::{End, Kind, Seam};
use crate::trim::surface::Surface;
use crate::trim::{Beyond, Body, Neighbours, build};
use glam::{DVec2, dvec2};
use hsd_ir::ast::{RoofKind, RoofShape};
use hsd_ir::building::{Attic, Face, Finish, HouseRoofs, Roof, RoofSurface, Solid, Trim};
use hsd_ir::check::solid_flaws;
use hsd_ir::material::SurfaceId;
use hsd_roof::facet::Corner;
use hsd_roof::frame::Plane;
use hsd_roof::solid::sheet::{Coat, sheet};
use hsd_scene::Detail;

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
        trim: Trim {
            eaves: 0.75,
            verge: 0.3,
            noshi: 5,
            ends: true,
            crowned: false,
            pendant: true,
            lattice: true,
            timber: None,
            rafters: 2,
            arch: None,
        },
        attic: Attic::default(),
        whole: None,
        solids,
    }
}

fn seams(solids: &[Solid]) -> Vec<Seam> {
    Surface::of(&RoofSurface::of(solids)).seams(&Beyond::default())
}

fn count(seams: &[Seam], kind: Kind) -> usize {
    seams.iter().filter(|s| s.kind == kind).count()
}

/// A house with one roof.
fn alone(roof: &Roof) -> HouseRoofs {
    HouseRoofs {
        roofs: vec![roof.clone()],
        ..HouseRoofs::default()
    }
}

/// The plain blocks of ridges at detail 1.
fn blocks(kind: RoofKind, finish: &str) -> Vec<Body> {
    let roof = roof(kind, gable(kind, 8.0, 6.0, 0.5));
    let made = build((&alone(&roof), 0), &Beyond::default(), false, Detail::Flat);
    let finish = SurfaceId::named(finish);
    let blocks = made.bodies.into_iter();
    blocks.filter(|body| body.finish == finish).collect()
}

#[test]
fn cover_tiles_have_a_descending_ridge_on_both_slopes_beside_each_gable() {
    let ridges = blocks(RoofKind::CoverTiles, "noshi");
    assert_eq!(ridges.len(), 1 + 4);
    let falling = ridges.iter().filter(|body| {
        let heights = body.points.iter().map(|p| p.z);
        let ends = heights.fold((f64::MAX, f64::MIN), |(lo, hi), z| (lo.min(z), hi.max(z)));
        // Seven eighths of the slope, and the height of the ridge itself.
        ends.1 - ends.0 > 0.8 * 3.0 * 0.5
    });
    assert_eq!(falling.count(), 4);
    // Gables of pantiles have the main ridge alone.
    assert_eq!(blocks(RoofKind::Tiles, "kawara_edge").len(), 1);
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
fn a_pyramid_has_four_hips_and_a_finial() {
    let pyramid = hip(RoofKind::Bark, 5.0, 5.0, 0.5);
    assert_eq!(count(&seams(&pyramid), Kind::Hip), 4);
    let apex = |b: &Body| b.points.iter().any(|p| p.z > 3.0 + 2.5 * 0.5 + 0.5);
    let bodies = bodies(&roof(RoofKind::Bark, pyramid), Detail::Flat);
    assert_eq!(bodies.iter().filter(|b| apex(b)).count(), 1);
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

/// Builds all trim of a roof.
fn bodies(roof: &Roof, detail: Detail) -> Vec<Body> {
    bodies_on(roof, false, detail)
}

fn bodies_on(roof: &Roof, plastered: bool, detail: Detail) -> Vec<Body> {
    let worn = build((&alone(roof), 0), &Beyond::default(), plastered, detail);
    let rows = worn.runs.iter().flat_map(|run| run.row.bodies());
    worn.bodies.into_iter().chain(rows).collect()
}

/// Converts a body to the solid that the checks take.
fn solid(body: &Body) -> Solid {
    let finish = Finish::Plaster;
    let face = |corners: &hsd_ir::building::Corners| Face {
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
                assert!(bodies(&roof(kind, solids.clone()), Detail::Body).is_empty());
                for detail in [Detail::Flat, Detail::Openings, Detail::Everything] {
                    let roof = roof(kind, solids.clone());
                    let mut bodies = bodies(&roof, detail);
                    bodies.extend(bodies_on(&roof, true, detail));
                    assert!(!bodies.is_empty());
                    assert_closed(&bodies, &format!("{kind:?} {pitch} shape {n} {detail:?}"));
                }
            }
        }
    }
}

/// Counts the bodies of a surface in a roof's trim.
fn worn(roof: &Roof, surface: &str) -> usize {
    let finish = SurfaceId::named(surface);
    let bodies = bodies(roof, Detail::Everything);
    bodies.iter().filter(|b| b.finish == finish).count()
}

#[test]
fn rows_and_stones_follow_the_size_of_the_roof() {
    let of = |kind, length| roof(kind, gable(kind, length, 6.0, 0.3));
    // A row of cover tiles, a disc before it, and a front beside it, every 272 mm on both sides.
    let rows = |length| worn(&of(RoofKind::CoverTiles, length), "ibushi");
    let more = (16.0 - 8.0) / 0.272 * 6.0 + (16.0 - 8.0) / 0.32;
    assert!((rows(16.0) as f64 - rows(8.0) as f64 - more).abs() < 8.0);
    let seams = |length| worn(&of(RoofKind::Metal, length), "sheet_roof");
    assert!((seams(16.0) as f64 - seams(8.0) as f64 - 2.0 * 8.0 / 0.455).abs() < 3.0);
    let stones = |length| worn(&of(RoofKind::Boards, length), "stone") as f64;
    assert!(stones(8.0) > 30.0 && (stones(16.0) / stones(8.0) - 2.0).abs() < 0.15);
    assert_eq!(stones(900.0), 0.0, "nobody lays so many");
    let steep = roof(RoofKind::Boards, gable(RoofKind::Boards, 8.0, 6.0, 0.5));
    assert_eq!(worn(&steep, "stone"), 0);
}

#[test]
fn rows_keep_their_phase_where_a_slope_is_cut() {
    let low = [
        (0.0, 0.0, true),
        (5.0, 0.0, true),
        (5.0, 2.0, false),
        (0.0, 2.0, true),
    ];
    let left = [
        (0.0, 2.0, false),
        (2.1, 2.0, false),
        (2.1, 4.0, true),
        (0.0, 4.0, true),
    ];
    let right = [
        (2.1, 2.0, false),
        (5.0, 2.0, true),
        (5.0, 4.0, true),
        (2.1, 4.0, false),
    ];
    let rise = [0.0, 0.5];
    let solids = solids(
        RoofKind::Metal,
        &[(&low, rise, 3.0), (&left, rise, 3.0), (&right, rise, 3.0)],
    );
    let bodies = bodies(&roof(RoofKind::Metal, solids), Detail::Everything);
    let x = |b: &Body| b.points.iter().map(|p| p.x).sum::<f64>() / b.points.len() as f64;
    // Narrow bodies of sheet metal are seams.
    let finish = SurfaceId::named("sheet_roof");
    let narrow = |b: &&Body| b.points.iter().all(|p| (p.x - x(b)).abs() < 0.01);
    let seams = bodies.iter().filter(|b| b.finish == finish).filter(narrow);
    let seams: Vec<f64> = seams.map(x).collect();
    assert!(seams.len() >= 18, "{seams:?}");
    let off = |x: &f64| (x / 0.455 - (x / 0.455).round()).abs();
    assert!(seams.iter().all(|x| off(x) < 1e-9), "{seams:?}");
}

#[test]
fn less_detail_wears_less_and_always_the_same() {
    for kind in KINDS {
        let roof = roof(kind, hip(kind, 9.0, 6.0, 0.5));
        let faces = |detail| bodies(&roof, detail).iter().map(|b| b.faces.len()).sum();
        let counts: [usize; 4] = Detail::ALL.map(faces);
        assert!(
            counts.is_sorted() && counts[0] < counts[3],
            "{kind:?}: {counts:?}"
        );
        let told = || {
            let roofs = alone(&roof);
            let worn = build((&roofs, 0), &Beyond::default(), false, Detail::Everything);
            format!("{worn:?}")
        };
        assert_eq!(told(), told());
    }
}

#[test]
fn a_joint_is_a_valley_before_a_slope_and_a_flank_before_a_wall() {
    let kind = RoofKind::Tiles;
    let own = [
        (0.0, 0.0, true),
        (3.0, 0.0, false),
        (5.0, 2.0, true),
        (0.0, 2.0, true),
    ];
    let beside = [
        (3.0, 0.0, true),
        (9.0, 0.0, true),
        (9.0, 2.0, true),
        (5.0, 2.0, false),
    ];
    let straight = [
        (0.0, 0.0, true),
        (3.0, 0.0, false),
        (3.0, 2.0, true),
        (0.0, 2.0, true),
    ];
    let slope = |corners: &[(f64, f64, bool)]| solids(kind, &[(corners, [0.0, 0.5], 3.0)]);
    let kinds = |own: &[(f64, f64, bool)], other: Vec<Solid>| {
        let both = HouseRoofs {
            roofs: vec![roof(kind, slope(own)), roof(kind, other)],
            ..HouseRoofs::default()
        };
        let beyond = Neighbours::of(&both).beyond(0, &both.roofs[0]);
        let seams = Surface::of(&both.surfaces()[0]).seams(&beyond);
        seams.iter().map(|s| s.kind).collect::<Vec<_>>()
    };
    let rises = solids(kind, &[(&beside, [0.5, 0.0], 1.5)]);
    assert!(kinds(&own, rises).contains(&Kind::Valley));
    let goes_on = solids(kind, &[(&beside, [0.0, 0.5], 3.0)]);
    let found = kinds(&own, goes_on);
    assert!(!found.contains(&Kind::Valley) && !found.contains(&Kind::Flank));
    let far = solids(kind, &[(&beside, [0.0, 0.5], 9.0)]);
    assert!(kinds(&straight, far).contains(&Kind::Flank));
}

#[test]
fn a_hip_goes_on_down_a_raised_corner() {
    let front = [
        (0.0, 0.0, false),
        (1.0, -1.0, true),
        (2.0, -1.0, false),
        (2.0, 2.0, false),
    ];
    let left = [
        (0.0, 0.0, false),
        (2.0, 2.0, false),
        (-1.0, 2.0, true),
        (-1.0, 1.0, false),
    ];
    // The corner lies so high that the line below the hip is level as a ridge.
    let fore = [(0.0, 0.0, false), (-1.0, -1.0, true), (1.0, -1.0, false)];
    let side = [(0.0, 0.0, false), (-1.0, 1.0, true), (-1.0, -1.0, false)];
    let solids = solids(
        RoofKind::Tiles,
        &[
            (&front, [0.0, 0.5], 3.0),
            (&left, [0.5, 0.0], 3.0),
            (&fore, [-0.2, 0.3], 3.0),
            (&side, [0.3, -0.2], 3.0),
        ],
    );
    let seams = seams(&solids);
    assert_eq!(
        (count(&seams, Kind::Ridge), count(&seams, Kind::Hip)),
        (0, 1)
    );
    let hip = seams.iter().find(|s| s.kind == Kind::Hip).expect("one hip");
    assert_eq!(hip.points.len(), 3);
    assert!(hip.points.is_sorted_by(|a, b| a.z < b.z));
    assert_eq!(hip.ends[0], End::Free);
}
