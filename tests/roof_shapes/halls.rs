//! Every shape over thin, square, deep, tiny and huge rectangles, gentle and steep, straight and curved: closed,
//! outward, without slivers, and as high as the closed forms of `docs/evidence.md` 7.10 say.

use crate::roof_shapes::common::*;
use glam::DVec3;
use hsd::ast::{RoofDirection, RoofShape};
use hsd::building::{Building, Finish, House, Roof};
use hsd::geometry::SHAKU;

pub const FOOTPRINTS: [(f64, f64); 5] = [
    (24.0, 2.0),
    (7.0, 7.0),
    (5.0, 12.0),
    (1.0, 1.5),
    (66.0, 40.0),
];
pub const PITCHES: [f64; 3] = [3.0, 5.0, 10.0];
const SORI: [f64; 3] = [-3.0, 0.0, 4.0];
const TWO_SIDED: [RoofShape; 8] = [
    RoofShape::Gable,
    RoofShape::Hip,
    RoofShape::BroadGable,
    RoofShape::HipAndGable,
    RoofShape::HalfHip,
    RoofShape::Pyramid,
    RoofShape::Temple,
    RoofShape::Karahafu,
];

/// A house under one roof of this shape, by itself or by a line.
pub fn under(
    shape: RoofShape,
    (width, depth): (f64, f64),
    pitch: f64,
    sori: f64,
    line: bool,
) -> House {
    let mut house = house(vec![vec![ring(&rect(0.0, 0.0, width, depth))]]);
    house.roofs.style.shape = Some(spanned(shape));
    house.roofs.style.pitch = Some(spanned(pitch));
    house.roofs.style.sori = Some(spanned(sori));
    if line {
        let mut written =
            crate::roof_shapes::common::line(shape, None, None, [0.0, 0.0, width, depth]);
        written.style.pitch = Some(spanned(pitch));
        house.roofs.lines = vec![written];
    }
    house
}

pub fn covering(roof: &Roof) -> impl Iterator<Item = DVec3> + '_ {
    let of = |s: &'_ hsd::building::Solid| {
        let faces = s
            .faces
            .iter()
            .filter(|f| matches!(f.finish, Finish::Covering(_)));
        let corners: Vec<DVec3> = faces
            .flat_map(|f| &f.corners)
            .map(|c| s.points[*c as usize])
            .collect();
        corners
    };
    roof.solids.iter().flat_map(of)
}

/// Least and greatest corner of a roof's upper surface.
pub fn extent(roof: &Roof) -> (DVec3, DVec3) {
    covering(roof).fold((DVec3::MAX, DVec3::MIN), |(lo, hi), p| {
        (lo.min(p), hi.max(p))
    })
}

pub fn close(p: f64, q: f64, what: &str) {
    assert!((p - q).abs() < 1e-3, "{what}: {p} is not {q}");
}

/// Height of the eaves of a parabola through plate and ridge over the plate; none where it would hardly fall.
fn eaves_height(pitch: f64, sori: f64, run: f64, eaves: f64) -> Option<f64> {
    let sag = sori / 100.0 * run * (1.0 + pitch * pitch);
    let slope = |d: f64| pitch - 4.0 * sag * (run - 2.0 * d) / (run * run);
    let falls = slope(-eaves).min(slope(run)) > 0.2 * pitch + 1e-9;
    falls.then(|| -pitch * eaves + 4.0 * sag * eaves * (run + eaves) / (run * run))
}

#[test]
fn every_two_sided_shape_is_sound_and_as_high_as_its_formula() {
    for shape in TWO_SIDED {
        for size in FOOTPRINTS {
            for pitch in PITCHES {
                for sori in SORI {
                    for line in [false, true] {
                        let building = quiet(under(shape, size, pitch, sori, line));
                        assert_sound(&building);
                        let what = format!("{shape:?} {size:?} {pitch} {sori} {line}");
                        check_heights(&building, shape, size, pitch / 10.0, sori, &what);
                    }
                }
            }
        }
    }
}

fn check_heights(
    building: &Building,
    shape: RoofShape,
    size: (f64, f64),
    t: f64,
    sori: f64,
    what: &str,
) {
    let [roof] = roofs(building) else {
        panic!("{what}: {} roofs", roofs(building).len())
    };
    assert_eq!(roof.shape, shape, "{what}");
    let (short, long) = (size.0.min(size.1) * U, size.0.max(size.1) * U);
    let span = if shape == RoofShape::BroadGable {
        long
    } else {
        short
    };
    let drop = 0.12 * (1.0 + t * t).sqrt();
    let (lo, hi) = extent(roof);
    close(hi.z, H + t * span / 2.0 + drop, what);
    let eaves = roof.trim.eaves;
    let edge = match shape {
        RoofShape::Karahafu => return,
        _ => eaves_height(t, sori, span / 2.0, eaves),
    };
    if let Some(edge) = edge {
        close(lo.z, H + drop + edge, what);
    }
    let hipped = matches!(
        shape,
        RoofShape::Hip | RoofShape::Pyramid | RoofShape::HipAndGable | RoofShape::Temple
    );
    if hipped && short > 2.0 {
        // Eaves all round.
        close(hi.x - lo.x, size.0 * U + 2.0 * eaves, what);
        close(hi.y - lo.y, size.1 * U + 2.0 * eaves, what);
    }
}

#[test]
fn every_single_slope_is_sound_and_as_high_as_its_formula() {
    let sides = [(RoofDirection::Front, true), (RoofDirection::Left, false)];
    for (side, deep) in sides {
        for size in FOOTPRINTS {
            for pitch in PITCHES {
                for sori in SORI {
                    let mut shed = under(RoofShape::LeanTo, size, pitch, sori, true);
                    shed.roofs.lines[0].direction = Some(spanned(side));
                    shed.roofs.lines[0].style.verge = Some(spanned(0.0));
                    let building = quiet(shed);
                    assert_sound(&building);
                    let depth = if deep { size.1 } else { size.0 } * U;
                    let (t, roof) = (pitch / 10.0, &roofs(&building)[0]);
                    let what = format!("{side:?} {size:?} {pitch} {sori}");
                    let drop = 0.12 * (1.0 + t * t).sqrt();
                    let (lo, hi) = extent(roof);
                    close(hi.z, H + t * depth + drop, &what);
                    if let Some(edge) = eaves_height(t, sori, depth, roof.trim.eaves) {
                        close(lo.z, H + drop + edge, &what);
                    }
                }
            }
        }
    }
}

#[test]
fn pents_follow_their_curve() {
    for sori in SORI {
        let mut shop = house(vec![vec![ring(&rect(0.0, 0.0, 6.0, 8.0))]]);
        let mut pent = line(RoofShape::Pent, None, Some(5.0), [0.0, 0.0, 6.0, -4.0]);
        pent.style.sori = Some(spanned(sori));
        pent.style.pitch = Some(spanned(3.0));
        shop.roofs.lines = vec![pent];
        let building = quiet(shop);
        assert_sound(&building);
        let middle = top_at(&building, 3.01, -2.0).unwrap_or(0.0);
        let sag = sori / 100.0 * 4.0 * U * 1.09;
        assert!(
            (middle - (5.0 * SHAKU + 0.6 * U - sag)).abs() < 0.011,
            "{sori} {middle}"
        );
    }
}

#[test]
fn hips_of_equal_pitch_run_at_45_degrees() {
    let building = quiet(under(RoofShape::Hip, (10.0, 6.0), 4.0, 0.0, false));
    let roof = &roofs(&building)[0];
    // Two trapezoids and two triangles, all in one solid.
    assert_eq!(roof.solids.len(), 1);
    assert_eq!(roof.solids[0].faces.len(), 4 + 4 + 4);
    let drop = 0.12 * (1.16_f64).sqrt();
    for (a, b) in [(0.5, 0.5), (1.0, 3.0), (9.0, 2.5), (5.0, 5.0), (2.0, 5.5)] {
        let inward = [a, b, 10.0 - a, 6.0 - b]
            .into_iter()
            .fold(f64::MAX, f64::min);
        close(
            top_at(&building, a, b).unwrap(),
            H + drop + 0.4 * inward * U,
            "hip",
        );
    }
}

#[test]
fn a_ratio_sets_the_length_of_the_ridge() {
    for ratio in [0.0, 0.2, 0.7] {
        let mut house = under(RoofShape::Hip, (10.0, 6.0), 4.0, 0.0, false);
        house.roofs.style.ratio = Some(spanned(ratio));
        let building = quiet(house);
        assert_sound(&building);
        let roof = &roofs(&building)[0];
        let top = extent(roof).1.z;
        let ridge: Vec<f64> = covering(roof)
            .filter(|p| p.z > top - 1e-6)
            .map(|p| p.x)
            .collect();
        let (lo, hi) = ridge
            .iter()
            .fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(*x), h.max(*x)));
        close(hi - lo, ratio * 10.0 * U, "ridge");
        // t_e = t w_S / (w_L (1 - r)), with level eaves all round.
        let steep = 0.4 * 6.0 / (10.0 * (1.0 - ratio));
        let drop = 0.12 * (1.16_f64).sqrt();
        close(
            top_at(&building, 0.5, 3.0).unwrap(),
            H + drop + steep * 0.5 * U,
            "end",
        );
        let eaves = covering(roof).map(|p| p.z).fold(f64::MAX, f64::min);
        let corners = covering(roof).filter(|p| p.z < eaves + 1e-6).count();
        assert_eq!(corners, 8);
    }
}

#[test]
fn an_irimoya_has_a_skirt_and_an_upper_gable() {
    for (c, wall) in [(None, 0.25), (Some(0.4), 0.4)] {
        let mut hall = under(RoofShape::HipAndGable, (12.0, 8.0), 5.0, 0.0, false);
        hall.roofs.style.gable = c.map(spanned);
        let building = quiet(hall);
        assert_sound(&building);
        let roof = &roofs(&building)[0];
        // The roof itself, what lies under its upper gables, and the two gable walls.
        assert_eq!(roof.solids.len(), 5);
        let drop = 0.12 * (1.25_f64).sqrt();
        let inset = wall * 8.0;
        // Just outside the barge board the skirt shows, inside it the upper gable.
        let outside = inset - 0.5 / U;
        close(
            top_at(&building, outside, 4.0).unwrap(),
            H + drop + 0.5 * outside * U,
            "skirt",
        );
        let inside = inset - 0.3 / U;
        close(
            top_at(&building, inside, 4.0).unwrap(),
            H + drop + 0.5 * 4.0 * U,
            "gable",
        );
        let gables = roof
            .solids
            .iter()
            .filter(|s| s.faces[0].finish == Finish::Gable);
        for gable in gables {
            let (lo, hi) = gable
                .points
                .iter()
                .fold((DVec3::MAX, DVec3::MIN), |(l, h), p| (l.min(*p), h.max(*p)));
            let middle = (lo.x + hi.x) / 2.0;
            let from_end = (-middle).min(12.0 * U + middle);
            close(from_end, inset * U, "gable wall");
            close(lo.z, H + 0.5 * inset * U - 0.01, "foot");
        }
    }
}

#[test]
fn the_ends_of_an_irimoya_are_gable_and_hip() {
    for (c, same) in [(0.0, RoofShape::Gable), (0.5, RoofShape::Hip)] {
        let mut hall = under(RoofShape::HipAndGable, (12.0, 8.0), 5.0, 0.0, false);
        hall.roofs.style.gable = Some(spanned(c));
        let other = under(same, (12.0, 8.0), 5.0, 0.0, false);
        let (hall, other) = (quiet(hall), quiet(other));
        let solids = |b: &Building| serde_json::to_string(&roofs(b)[0].solids).unwrap();
        assert_eq!(solids(&hall), solids(&other));
    }
}

#[test]
fn a_half_hip_has_a_gable_wall_below() {
    let building = quiet(under(RoofShape::HalfHip, (10.0, 6.0), 8.0, 0.0, false));
    assert_sound(&building);
    let drop = 0.12 * (1.64_f64).sqrt();
    // A run of a fifth of the span, so the little hip starts at six tenths of the height.
    let run = 0.2 * 6.0;
    let foot = H + drop + 0.8 * (3.0 - run) * U;
    close(
        top_at(&building, 0.0, 3.0).unwrap(),
        foot,
        "foot of the hip",
    );
    close(
        top_at(&building, run, 3.0).unwrap(),
        H + drop + 0.8 * 3.0 * U,
        "its tip",
    );
    let roof = &roofs(&building)[0];
    let walls = roof
        .solids
        .iter()
        .filter(|s| s.faces[0].finish == Finish::Gable);
    assert_eq!(walls.count(), 2);
}

#[test]
fn corners_of_a_temple_rise() {
    let building = quiet(under(RoofShape::Temple, (14.0, 10.0), 5.5, 4.0, false));
    assert_sound(&building);
    let roof = &roofs(&building)[0];
    let (lo, hi) = extent(roof);
    let middle = covering(roof).map(|p| p.z).fold(f64::MAX, f64::min);
    let corner = |x: f64, y: f64| {
        let at = covering(roof).find(|p| (p.x - x).abs() + (p.y - y).abs() < 1e-6);
        at.unwrap().z - middle
    };
    let lifts = [
        corner(lo.x, lo.y),
        corner(lo.x, hi.y),
        corner(hi.x, lo.y),
        corner(hi.x, hi.y),
    ];
    assert!(
        lifts
            .iter()
            .all(|l| (l - lifts[0]).abs() < 1e-9 && *l > 0.15),
        "{lifts:?}"
    );
    // The wall plate stays where it is.
    let drop = 0.12 * (1.0 + 0.55_f64 * 0.55).sqrt();
    for (a, b) in [(0.0, 0.0), (0.0, 5.0), (3.0, 0.0), (14.0, 10.0)] {
        close(top_at(&building, a, b).unwrap(), H + drop, "plate");
    }
}

#[test]
fn a_karahafu_before_a_hall_is_closed_by_it() {
    // In the wall where it stays below its top, in the roof where it rises over that.
    for (height, rises) in [(5.0, false), (8.0, true), (9.0, true)] {
        let mut hall = house(vec![vec![ring(&rect(0.0, 0.0, 14.0, 10.0))]]);
        hall.roofs.style.shape = Some(spanned(RoofShape::HipAndGable));
        let mut porch = line(
            RoofShape::Karahafu,
            None,
            Some(height),
            [4.0, 0.0, 10.0, -3.0],
        );
        porch.style.pitch = Some(spanned(4.0));
        hall.roofs.lines = vec![porch];
        let (building, out) = build(hall);
        // Far below the top of the walls it is warned about.
        assert!(codes(&out).iter().all(|c| *c == 509), "{:?}", codes(&out));
        assert_sound(&building);
        let porch = roofs(&building)
            .iter()
            .find(|r| r.shape == RoofShape::Karahafu)
            .unwrap();
        // One gable wall, at its free end.
        let gables = porch
            .solids
            .iter()
            .filter(|s| s.faces[0].finish == Finish::Gable);
        assert_eq!(gables.count(), 1);
        // Where the eaves behind run on under it, a ceiling on its plates hides them.
        let ceilings = porch
            .solids
            .iter()
            .filter(|s| s.faces.iter().all(|f| f.finish == Finish::Timber));
        let heights: Vec<f64> = ceilings
            .map(|s| s.points.iter().map(|p| p.z).fold(f64::MAX, f64::min))
            .filter(|z| (z - height * SHAKU).abs() < 1e-9)
            .collect();
        assert_eq!(heights.len(), usize::from(rises), "{height}");
        let (lo, hi) = extent(porch);
        close(
            hi.z,
            height * SHAKU + 0.4 * 3.0 * U + 0.12 * (1.16_f64).sqrt(),
            "crown",
        );
        assert!(lo.y < -3.0 * U);
        assert_eq!(hi.y > 0.1, rises, "{height} {}", hi.y);
    }
}

#[test]
fn corners_rise_only_where_they_stand_free() {
    // An L whose branch goes on along the end of the trunk.
    let l = [
        (0.0, 0.0),
        (16.0, 0.0),
        (16.0, 14.0),
        (10.0, 14.0),
        (10.0, 6.0),
        (0.0, 6.0),
    ];
    let mut house = house(vec![vec![ring(&l)]]);
    house.roofs.style.shape = Some(spanned(RoofShape::Hip));
    house.roofs.style.sori = Some(spanned(4.0));
    house.roofs.style.pitch = Some(spanned(5.0));
    let building = quiet(house);
    assert_sound(&building);
    let eaves = |b: f64| {
        let along = |p: &DVec3| p.x < -16.0 * U - 0.7 && (p.y - b * U).abs() < 0.8 * U;
        let points = roofs(&building).iter().flat_map(covering);
        points.filter(along).map(|p| p.z).fold(f64::MIN, f64::max)
    };
    // Where trunk and branch meet the eaves run on level; at the corners they rise.
    assert!(
        eaves(14.5) > eaves(6.0) + 0.1,
        "{} {}",
        eaves(14.5),
        eaves(6.0)
    );
    let over = roofs(&building)[0].trim.eaves;
    let level = eaves_height(0.5, 4.0, 3.0 * U, over).unwrap() + 0.12 * (1.25_f64).sqrt();
    close(eaves(6.0), H + level, "level eaves");
}

/// Plain halls wider than 15 ken get gables side by side; none stands higher than a slope of 17 m rises, and a shape
/// that is asked for is one roof.
#[test]
fn wide_halls_have_several_ridges() {
    // 66 by 44 U are 60 by 40 m; an odd width, and a wing at the end.
    let wing = [
        (0.0, 0.0),
        (66.0, 0.0),
        (66.0, 10.0),
        (80.0, 10.0),
        (80.0, 20.0),
        (66.0, 20.0),
        (66.0, 44.0),
        (0.0, 44.0),
    ];
    for (corners, count) in [
        (rect(0.0, 0.0, 66.0, 44.0), 2),
        (rect(0.0, 0.0, 31.0, 80.0), 2),
        (rect(0.0, 0.0, 66.0, 63.001), 3),
        (wing.to_vec(), 3),
    ] {
        let (building, out) = build(house(vec![vec![ring(&corners)]]));
        assert!(out.iter().any(|d| d.code.0 == 521));
        assert_eq!(roofs(&building).len(), count);
        let top = all_solids(&building).flat_map(|s| s.points.iter().map(|p| p.z));
        assert!(top.fold(0.0, f64::max) < H + 9.5);
    }
    let mut one = house(vec![vec![ring(&rect(0.0, 0.0, 66.0, 44.0))]]);
    one.roofs.style.shape = Some(spanned(RoofShape::Gable));
    let (building, out) = build(one);
    assert!(out.iter().all(|d| d.code.0 != 521));
    assert_eq!(roofs(&building).len(), 1);
}
