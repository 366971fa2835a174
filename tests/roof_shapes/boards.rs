//! The slabs of gable roofs against the boards of paper 004, as `docs/evidence.md` 7.2 corrects them.

use crate::roof_shapes::common::*;
use crate::roof_shapes::random::Draws;
use glam::{DVec2, DVec3, dvec2};
use hsd::ast::RoofShape;
use hsd::building::{Finish, Solid};
use hsd::geometry::SHAKU;
use hsd::roof::shape::board::{Board, Cut, Edge, upright};

/// The corners of a solid's faces of one finish, each once.
fn corners(solids: &[Solid], of: fn(Finish) -> bool) -> Vec<DVec3> {
    let mut found: Vec<DVec3> = vec![];
    for solid in solids {
        for face in solid.faces.iter().filter(|f| of(f.finish)) {
            for &corner in &face.corners {
                let p = solid.points[corner as usize];
                if found.iter().all(|q| (*q - p).length() > 1e-6) {
                    found.push(p);
                }
            }
        }
    }
    found
}

/// Asserts that two points agree to a millionth of a millimetre.
fn near(found: DVec2, wanted: DVec2) {
    assert!((found - wanted).length() < 1e-9, "{found} for {wanted}");
}

#[test]
fn slabs_are_boards_cut_at_the_ridge_and_upright_at_the_eaves() {
    let mut draws = Draws(41);
    for n in 0..200 {
        // Half units, tenths of a sun, hundredths of a shaku.
        let mut draw =
            |from: u64, to: u64, parts: f64| (from + draws.below(to - from)) as f64 / parts;
        let (short, more) = (draw(4, 40, 2.0), draw(1, 30, 2.0));
        let (pitch, thickness) = (draw(20, 120, 10.0), draw(10, 200, 100.0));
        let (eaves, verge) = (draw(0, 400, 100.0), draw(0, 300, 100.0));
        let (w, d) = match n % 2 {
            0 => (short + more, short),
            _ => (short, short + more),
        };
        let mut house = house(vec![vec![ring(&rect(0.0, 0.0, w, d))]]);
        let style = &mut house.roofs.style;
        style.shape = Some(spanned(RoofShape::Gable));
        style.pitch = Some(spanned(pitch));
        (style.eaves, style.verge) = (Some(spanned(eaves)), Some(spanned(verge)));
        style.thickness = Some(spanned(thickness));
        // Every other board lies above the prism.
        let gap = draw(0, 100, 100.0) * f64::from(n / 2 % 2);
        style.offset = (gap > 0.0).then(|| spanned(thickness + gap));
        let (building, _) = build(house);
        assert_sound(&building);
        let [roof] = roofs(&building) else {
            panic!("one roof");
        };
        let board = Board {
            w_long: (short + more) * U,
            w_short: short * U,
            pitch: pitch / 10.0,
            eaves: 0.0,
            verge: verge * SHAKU,
            offset: 0.0,
            thickness: thickness * SHAKU,
            start: H,
        };
        // An overhang in plan.
        check(
            &roof.solids,
            &board.above(gap * SHAKU).overhanging(eaves * SHAKU),
            dvec2(w, d),
            n % 2 == 0,
        );
    }
}

fn check(solids: &[Solid], board: &Board, size: DVec2, along_a: bool) {
    let middle = dvec2(-size.x, size.y) * U / 2.0;
    // Along the ridge and away from it.
    let turned = |p: DVec3| {
        let q = p.truncate() - middle;
        let q = if along_a { q } else { dvec2(q.y, q.x) };
        DVec3::new(q.x, q.y, p.z)
    };
    let upper: Vec<DVec3> = corners(solids, |f| matches!(f, Finish::Covering(_)))
        .into_iter()
        .map(turned)
        .collect();
    for side in [-1.0, 1.0] {
        let own: Vec<DVec3> = upper
            .iter()
            .copied()
            .filter(|p| p.y * side > -1e-6)
            .collect();
        assert_eq!(own.len(), 4, "{own:?}");
        let mean = own.iter().sum::<DVec3>() / 4.0;
        let edge = if side > 0.0 { Edge::E12 } else { Edge::E34 };
        let want = board.corners(edge);
        let half = dvec2(0.0, board.w_short / 2.0);
        for p in own {
            let off = want[4..]
                .iter()
                .map(|q| (*q - p).length())
                .fold(f64::MAX, f64::min);
            assert!(off < 1e-9, "{p} is {off} off {want:?}");
            let edge_of = dvec2(p.y * side, p.z);
            if edge_of.x < 1e-6 {
                near(edge_of, dvec2(0.0, board.ridge_top()));
            } else {
                near(edge_of, board.eaves_top());
            }
            assert!((p.x.abs() - board.length() / 2.0).abs() < 1e-9);
        }
        // The middle of the board stands a thickness above the control point.
        let normal = board.rotation(edge) * DVec3::Z;
        let foot = mean - normal * board.thickness;
        let [cp1, cp2] = board.control_points(half, -half);
        let point = if side > 0.0 { cp1 } else { cp2 };
        near(foot.truncate(), point);
        assert!((foot.z - board.height()).abs() < 1e-9);
    }
    let lower = corners(solids, |f| f == Finish::Soffit);
    let low = lower
        .into_iter()
        .map(turned)
        .fold(DVec3::MAX, |low, p| if p.z < low.z { p } else { low });
    near(dvec2(low.y.abs(), low.z), board.eaves_bottom(Cut::Plumb));
    assert!((board.eaves_top().y - low.z - upright(board.thickness, board.pitch)).abs() < 1e-9);
}
