//! The shapes of domain 3.6 with the judgement given there, ridges too.

use hsd::geometry::plan::{Cell, Plan};
use hsd::roof::partition::{Method, partition};
use hsd::roof::plan::roles::regions;
use hsd::roof::plan::street::street_front;
use hsd::roof::region::{Region, Ridge, Role, Side};

/// a0 b0 a1 b1.
pub(crate) fn cell(c: [i64; 4]) -> Cell {
    Cell {
        a0: c[0],
        b0: c[1],
        a1: c[2],
        b1: c[3],
    }
}

pub(crate) fn plan(cells: &[[i64; 4]]) -> Plan {
    Plan::from_cells(&cells.iter().copied().map(cell).collect::<Vec<_>>()).clean()
}

fn roofs(plan: &Plan, method: Method) -> Vec<Region> {
    regions(plan, None, method, None, 1)
}

/// Rectangle, ridge, role, trunk.
type Brief = ([i64; 4], Option<Ridge>, Role, Option<usize>);

fn brief(regions: &[Region]) -> Vec<Brief> {
    let four = |c: Cell| [c.a0, c.b0, c.a1, c.b1];
    regions
        .iter()
        .map(|r| (four(r.cell), r.ridge, r.role, r.over))
        .collect()
}

const A: Option<Ridge> = Some(Ridge::A);
const B: Option<Ridge> = Some(Ridge::B);
const ALL: [Method; 3] = [Method::Kd, Method::LeastCut, Method::BranchCut];

/// The span decides how high a roof rises: a lean-to reaches as high as a gable of twice its depth.
#[test]
fn the_span_of_a_lean_to_is_twice_its_depth() {
    let like = |ridge, fall| Region {
        cell: cell([2, 3, 12, 7]),
        ridge,
        fall,
        role: Role::Main,
        over: None,
        street: false,
        against_wall: None,
        joins: None,
        through: None,
    };
    assert_eq!(like(A, None).span(), 4);
    assert_eq!(like(B, None).span(), 10);
    for (fall, span) in [
        (Side::Front, 8),
        (Side::Back, 8),
        (Side::Left, 20),
        (Side::Right, 20),
    ] {
        assert_eq!(like(None, Some(fall)).span(), span, "{fall:?}");
    }
}

#[test]
fn a_plan_knows_its_coordinates() {
    let l = plan(&[[0, 0, 14, 6], [0, 6, 6, 12]]);
    assert_eq!(l.coordinates(), (vec![0, 6, 14], vec![0, 6, 12]));
}

#[test]
fn l_the_square_wing_runs_into_the_trunk() {
    for method in ALL {
        let found = roofs(&plan(&[[0, 0, 14, 6], [0, 6, 6, 12]]), method);
        let want = [
            ([0, 0, 14, 6], A, Role::Main, None),
            ([0, 6, 6, 12], B, Role::Branch, Some(0)),
        ];
        assert_eq!(brief(&found), want);
    }
}

#[test]
fn l2_needs_the_street_rule() {
    let l2 = plan(&[[0, 0, 6, 4], [0, 4, 4, 14]]);
    for method in ALL {
        let long = partition(&l2, method);
        assert_eq!(long, [cell([0, 0, 4, 14]), cell([4, 0, 6, 4])]);
        let front = street_front(&l2, ((0, 0), (6, 0)));
        let found = regions(&l2, None, method, front, 1);
        let want = [
            ([0, 0, 6, 4], A, Role::Main, None),
            ([0, 4, 4, 14], B, Role::Branch, Some(0)),
        ];
        assert_eq!(brief(&found), want);
        assert!(found[0].street && !found[1].street);
    }
}

#[test]
fn t_the_stem_is_wider_than_the_bar_and_runs_through() {
    for method in ALL {
        let found = roofs(&plan(&[[0, 9, 18, 14], [6, 0, 12, 9]]), method);
        let want = [
            ([6, 0, 12, 9], B, Role::Main, None),
            ([0, 9, 18, 14], A, Role::Main, None),
        ];
        assert_eq!(brief(&found), want);
        assert_eq!(
            (found[0].through, found[0].joins),
            (Some(1), Some(Side::Back))
        );
        // One unit narrower it is a branch.
        let found = roofs(&plan(&[[0, 9, 18, 14], [6, 0, 11, 9]]), method);
        let want = [
            ([6, 0, 11, 9], B, Role::Branch, Some(1)),
            ([0, 9, 18, 14], A, Role::Main, None),
        ];
        assert_eq!(brief(&found), want);
    }
}

#[test]
fn u_h_and_z_are_right_everywhere() {
    for method in ALL {
        let u = roofs(
            &plan(&[[0, 0, 24, 6], [0, 6, 6, 13], [18, 6, 24, 13]]),
            method,
        );
        assert_eq!(
            brief(&u),
            [
                ([0, 0, 24, 6], A, Role::Main, None),
                ([0, 6, 6, 13], B, Role::Branch, Some(0)),
                ([18, 6, 24, 13], B, Role::Branch, Some(0)),
            ]
        );
        let h = roofs(
            &plan(&[[0, 0, 6, 18], [6, 7, 14, 11], [14, 0, 20, 18]]),
            method,
        );
        assert_eq!(
            brief(&h),
            [
                ([0, 0, 6, 18], B, Role::Main, None),
                ([14, 0, 20, 18], B, Role::Main, None),
                ([6, 7, 14, 11], A, Role::Branch, Some(0)),
            ]
        );
        let z = roofs(&plan(&[[0, 0, 12, 6], [8, 6, 20, 12]]), method);
        let halls = [
            ([0, 0, 12, 6], A, Role::Main, None),
            ([8, 6, 20, 12], A, Role::Main, None),
        ];
        assert_eq!(brief(&z), halls);
    }
}

#[test]
fn plus_arms_are_turned_by_the_branch_rule() {
    for method in ALL {
        let found = roofs(
            &plan(&[[0, 5, 16, 11], [5, 0, 11, 5], [5, 11, 11, 16]]),
            method,
        );
        let cells: Vec<_> = found.iter().map(|r| (r.ridge, r.role)).collect();
        assert_eq!(found.len(), 3);
        assert_eq!(cells.iter().filter(|c| c.1 == Role::Branch).count(), 2);
        let trunk = found.iter().find(|r| r.role == Role::Main).unwrap();
        let arms = found.iter().filter(|r| r.role == Role::Branch);
        arms.for_each(|r| assert_ne!(r.ridge, trunk.ridge));
    }
}

#[test]
fn court_is_a_pinwheel_by_kd_and_two_wings_by_least_cut() {
    let court = Plan::from_loops(vec![
        vec![(0, 0), (20, 0), (20, 14), (0, 14)],
        vec![(6, 5), (6, 10), (14, 10), (14, 5)],
    ]);
    let kd = partition(&court, Method::Kd);
    assert_eq!((kd.len(), total_cut(&kd, &court)), (4, 22));
    let found = roofs(&court, Method::LeastCut);
    let cells: Vec<Cell> = found.iter().map(|r| r.cell).collect();
    assert_eq!(total_cut(&cells, &court), 18);
    assert_eq!(
        brief(&found),
        [
            ([0, 0, 6, 14], B, Role::Main, None),
            ([6, 0, 14, 5], A, Role::Branch, Some(0)),
            ([14, 0, 20, 14], B, Role::Main, None),
            ([6, 10, 14, 14], A, Role::Branch, Some(0)),
        ]
    );
}

#[test]
fn stair_keeps_three_halls() {
    let halls = [[0, 0, 8, 6], [8, 4, 16, 10], [16, 8, 24, 14]];
    for method in ALL {
        let found = roofs(&plan(&halls), method);
        assert_eq!(brief(&found), halls.map(|h| (h, A, Role::Main, None)));
    }
}

#[test]
fn geya_leans_and_falls_away() {
    for method in ALL {
        let found = roofs(&plan(&[[0, 0, 12, 8], [2, 8, 10, 10]]), method);
        assert_eq!(
            brief(&found)[1],
            ([2, 8, 10, 10], None, Role::LeanTo, Some(0))
        );
        assert_eq!(
            (found[1].fall, found[1].joins),
            (Some(Side::Back), Some(Side::Front))
        );
        let porch = roofs(&plan(&[[0, 2, 12, 10], [2, 0, 5, 2]]), method);
        assert_eq!((porch[0].role, porch[0].ridge), (Role::Branch, B));
    }
}

#[test]
fn square_and_plain_houses() {
    for method in ALL {
        assert_eq!(
            brief(&roofs(&plan(&[[0, 0, 5, 5]]), method)),
            [([0, 0, 5, 5], A, Role::Main, None)]
        );
        assert_eq!(
            brief(&roofs(&plan(&[[0, 0, 5, 9]]), method)),
            [([0, 0, 5, 9], B, Role::Main, None)]
        );
        assert!(roofs(&Plan::default(), method).is_empty());
    }
}

#[test]
fn upper_walls_take_lean_tos_and_gables() {
    let ground = plan(&[[0, 0, 10, 12]]);
    let rule = |upper: [i64; 4]| regions(&ground, Some(&plan(&[upper])), Method::LeastCut, None, 1);
    let shallow = rule([0, 0, 10, 9]);
    assert_eq!(
        brief(&shallow),
        [([0, 9, 10, 12], None, Role::LeanTo, None)]
    );
    assert_eq!(
        (shallow[0].fall, shallow[0].against_wall),
        (Some(Side::Back), Some(Side::Front))
    );
    let deep = rule([0, 0, 10, 8]);
    assert_eq!(brief(&deep), [([0, 8, 10, 12], B, Role::Main, None)]);
    assert_eq!(deep[0].against_wall, Some(Side::Front));
    assert!(rule([0, 0, 10, 12]).is_empty());
    // All round: a skirt of lean-tos, each against its wall.
    let skirt = rule([2, 2, 8, 10]);
    assert_eq!(skirt.len(), 4);
    for r in &skirt {
        assert_eq!(r.role, Role::LeanTo);
        assert_eq!(r.fall.map(Side::opposite), r.against_wall);
    }
    // The street region keeps its ridge even there.
    let front = Some(cell([0, 0, 10, 3]));
    let street = regions(
        &ground,
        Some(&plan(&[[0, 3, 10, 12]])),
        Method::LeastCut,
        front,
        1,
    );
    assert_eq!(brief(&street), [([0, 0, 10, 3], A, Role::Main, None)]);
}

#[test]
fn equal_trunks_go_by_b_then_a() {
    let found = roofs(
        &plan(&[[0, 0, 4, 10], [4, 3, 7, 6], [7, 0, 11, 10]]),
        Method::LeastCut,
    );
    assert_eq!(brief(&found)[2], ([4, 3, 7, 6], A, Role::Branch, Some(0)));
}

/// Ninomaru goten of Nijo castle, half Kyo-ma ken; offsets after the picture of domain 3.6.
pub(crate) const NINOMARU: [[i64; 4]; 8] = [
    [82, 0, 90, 10],   // Kurumayose
    [78, 10, 110, 43], // Tozamurai
    [59, 22, 78, 40],  // Shikidai
    [32, 26, 59, 56],  // Ohiroma
    [32, 56, 38, 71],  // Sotetsu
    [8, 71, 36, 92],   // Kuroshoin
    [14, 92, 16, 107], // corridor
    [0, 107, 18, 125], // Shiroshoin
];

#[test]
fn ninomaru_keeps_its_eight_halls_by_least_cut() {
    let palace = plan(&NINOMARU);
    let found = roofs(&palace, Method::LeastCut);
    let cells: Vec<Cell> = found.iter().map(|r| r.cell).collect();
    assert_eq!(cells, NINOMARU.map(cell));
    assert_eq!(total_cut(&cells, &palace), 54);
    let ridge = |n: usize| found[n].ridge;
    // The designation records: Shikidai and Kuroshoin by the front, Ohiroma and Sotetsu by the side.
    assert_eq!((ridge(2), ridge(5)), (A, A));
    assert_eq!((ridge(3), ridge(4)), (B, B));
}

#[test]
fn ninomaru_is_cut_up_by_kd() {
    let palace = plan(&NINOMARU);
    let found = partition(&palace, Method::Kd);
    assert_eq!(found.len(), 10);
    assert_eq!(total_cut(&found, &palace), 122);
    assert!(!found.contains(&cell(NINOMARU[3])));
    let ohiroma = cell(NINOMARU[3]);
    assert_eq!(found.iter().filter(|c| c.overlaps(&ohiroma)).count(), 3);
}

/// Length of the borders between roofs.
pub(crate) fn total_cut(cells: &[Cell], plan: &Plan) -> i64 {
    let round: i64 = cells.iter().map(|c| 2 * (c.width() + c.depth())).sum();
    let outer: i64 = plan
        .edges()
        .map(|(p, q)| (p.0 - q.0).abs() + (p.1 - q.1).abs())
        .sum();
    (round - outer) / 2
}
