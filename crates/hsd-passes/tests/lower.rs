//! Walks to outlines: closing, turns, crossings, courtyards, set-back storeys, rings of facades.
use glam::dvec2;
use hsd_base::diagnostic::{Diagnostics, Severity};
use hsd_base::source::{FileId, Span};
use hsd_ir::ast::{Anchor, StoreyKind};
use hsd_ir::building::{Ring, Shell};
use hsd_ir::catalog::PartId;
use hsd_ir::program::{Content, Drawn, House, Loop, Program, Roofs, Storey, Unit, WallLine};
use hsd_passes::lower::lower;

/// A unit of that width: a part, or a void below zero.
fn unit(width: f64) -> Unit {
    let content = if width < 0.0 {
        Content::Void
    } else {
        Content::Part(PartId(0))
    };
    let (span, width) = (Span::default(), width.abs());
    Unit {
        span,
        width,
        content,
        height: None,
        reflection: None,
        picture: None,
    }
}

/// Lines as "4R 2.5L -1L": a length (negative: a void) and a turn, R, L or degrees behind `@`. Their spans are
/// their places in the text.
fn lines(text: &str) -> Vec<WallLine> {
    let mut at = 0;
    let words = text.split(' ').map(|word| {
        let span = Span {
            file: FileId(0),
            start: at,
            end: at + word.len() as u32,
        };
        at = span.end + 1;
        let (length, turn) = match word.split_once('@') {
            Some((length, degrees)) => (length, degrees.parse().unwrap()),
            None => (
                &word[..word.len() - 1],
                if word.ends_with('L') { -90.0 } else { 90.0 },
            ),
        };
        let units = if length.is_empty() {
            vec![]
        } else {
            vec![unit(length.parse().unwrap())]
        };
        WallLine {
            span,
            units,
            turn,
            reflection: false,
        }
    });
    words.collect()
}

fn walk(text: &str) -> Loop {
    let all = Span {
        file: FileId(0),
        start: 0,
        end: text.len() as u32,
    };
    Loop {
        span: all,
        hole: false,
        inner: false,
        drawn: Drawn::Rows,
        start: (0.0, 0.0),
        lines: lines(text),
    }
}

fn lowered(storeys: Vec<Vec<Loop>>) -> (Shell, Vec<(u16, Severity, Span)>) {
    let storeys = storeys.into_iter().map(|loops| {
        let (span, kind) = (Span::default(), StoreyKind::Storey);
        Storey {
            span,
            height: 9.0,
            kind,
            order: hsd_ir::ast::Order::default(),
            loops,
            rooms: vec![],
            fixtures: vec![],
        }
    });
    let house = House {
        span: Span::default(),
        name: String::new(),
        variant: None,
        placed: None,
        anchor: Anchor::Corner,
        origin: [0.0; 3],
        plinth: 0.0,
        azimuth: 180.0,
        unit_shaku: 3.0,
        street: false,
        purpose: None,
        age: None,
        storeys: storeys.collect(),
        platform: None,
        finials: vec![],
        puts: vec![],
        grounds: vec![],
        outdoors: None,
        roofs: Roofs::default().into(),
    };
    let mut out = Diagnostics::new();
    let shell = lower(
        Program {
            houses: vec![house],
            pictures: vec![],
        },
        &mut out,
    );
    let said = out
        .into_sorted()
        .iter()
        .map(|d| (d.code.0, d.severity, d.span().unwrap()))
        .collect();
    (shell, said)
}

fn ring(text: &str) -> (Ring, Vec<u16>) {
    let (shell, said) = lowered(vec![vec![walk(text)]]);
    (
        shell.houses[0].storeys[0].rings[0].clone(),
        said.iter().map(|s| s.0).collect(),
    )
}

#[test]
fn an_l_has_six_corners_in_walk_order() {
    let (ring, said) = ring("6R 4R 3R 2L 3R 2R");
    assert!(ring.closed && said.is_empty(), "{said:?}");
    let expected = [(0, 0), (6, 0), (6, 4), (3, 4), (3, 2), (0, 2)];
    assert_eq!(
        ring.corners(),
        expected.map(|(a, b)| dvec2(f64::from(a), f64::from(b)))
    );
}

#[test]
fn the_last_turn_does_not_count() {
    for last in ["3R", "3L", "3@0"] {
        let (ring, said) = ring(&format!("4R 3R 4R {last}"));
        assert!(ring.closed && said.is_empty(), "{last}: {said:?}");
    }
    // Starts in the middle of a wall (written turns 4) and at an inner corner (5).
    assert!(ring("2R 3R 4R 3R 2R").0.closed);
    let (inner, said) = ring("3R 2R 6R 4R 3R 2R");
    assert!(inner.closed && said.is_empty(), "{said:?}");
}

/// A line without length adds its turn to that of the wall before it.
#[test]
fn turns_of_lines_without_length_add_up() {
    let (ring, said) = ring("4@45 @45 3@45 @45 4R R L 3R");
    assert!(ring.closed && said.is_empty(), "{said:?}");
    assert_eq!(ring.walls.len(), 4);
    let (_, said) = self::ring("4R R 3R 4R 3R");
    assert_eq!(said, [411], "two right angles are half a circle");
    // Three quarters to the left lead where one to the right does, but not once round.
    let (ring, said) = self::ring("4L L L 3R 4R 3R");
    assert!(!ring.closed && said == [402], "{said:?}");
}

#[test]
fn open_walls_name_the_line_that_closes_them() {
    let (shell, said) = lowered(vec![vec![walk("4R 3R 3R 3R")]]);
    assert_eq!(said.len(), 1);
    assert_eq!((said[0].0, said[0].1), (401, Severity::Error));
    assert!(!shell.houses[0].storeys[0].rings[0].closed);
    assert_eq!(
        shell.houses[0].storeys[0].rings[0].walls.len(),
        4,
        "the walls stand all the same"
    );
}

#[test]
fn a_single_wrong_turn_is_found() {
    let (_, said) = lowered(vec![vec![walk("4R 3L 4R 3R")]]);
    let wrong = Span {
        file: FileId(0),
        start: 3,
        end: 5,
    };
    assert_eq!(said, [(403, Severity::Warning, wrong)]);
    // An inner corner written without its L.
    let (_, said) = lowered(vec![vec![walk("6R 4R 3R 2R 3R 2R")]]);
    assert_eq!(said[0].0, 403);
    assert_eq!(said[0].1, Severity::Error);
}

#[test]
fn few_turns_are_a_facade() {
    for text in ["5R", "5R 3R", "2R 3R 2R", "3L 2R 4R"] {
        let (_, said) = lowered(vec![vec![walk(text)]]);
        assert_eq!((said[0].0, said[0].1), (404, Severity::Note), "{text}");
    }
}

#[test]
fn walls_that_meet_are_named() {
    assert_eq!(ring("4R 4R 1R 5L 2L 5R 1R 4R").1, [405]);
    assert_eq!(ring("4R 4R 1R 4L 2L 4R 1R 4R").1, [406]);
    // An eight: back at the start, and crossing itself.
    let (eight, said) = ring("2R 2R 1R 3L 1L 1L 2R 1R 2R 1R");
    assert!(!eight.closed && !said.is_empty());
}

#[test]
fn the_mirrored_house_is_known() {
    assert_eq!(ring("4L 3L 4L 3L").1, [412]);
}

#[test]
fn voids_before_the_first_part_move_the_start() {
    let (shell, said) = lowered(vec![
        vec![walk("6R 8R 6R 8R")],
        vec![walk("R -2L 6R 6R 6R 6R")],
    ]);
    assert!(said.is_empty(), "{said:?}");
    let upper = &shell.houses[0].storeys[1].rings[0];
    let expected = [(0, 2), (6, 2), (6, 8), (0, 8)];
    assert!(upper.closed);
    assert_eq!(
        upper.corners(),
        expected.map(|(a, b)| dvec2(f64::from(a), f64::from(b)))
    );
    assert_eq!(upper.walls.len(), 4);
    let z = &shell.houses[0].storeys;
    assert!((z[1].z0 - 90.0 / 33.0).abs() < 1e-12 && (z[1].z1 - 180.0 / 33.0).abs() < 1e-12);
}

#[test]
fn later_voids_are_open_bays() {
    let (ring, said) = ring("4R -3R 4R 3R");
    assert!(ring.closed && said.is_empty());
    assert_eq!(ring.walls[1].units[0].content, Content::Void);
}

#[test]
fn courtyards_lie_inside() {
    let hole = |start, text: &str| Loop {
        hole: true,
        start,
        ..walk(text)
    };
    let outer = || walk("9R 9R 9R 9R");
    let (shell, said) = lowered(vec![vec![outer(), hole((3.0, 6.0), "3L 3L 3L 3L")]]);
    assert!(
        said.is_empty() && shell.houses[0].storeys[0].rings[1].closed,
        "{said:?}"
    );
    let code = |inner| lowered(vec![vec![outer(), inner]]).1[0].0;
    assert_eq!(code(hole((12.0, 6.0), "3L 3L 3L 3L")), 407);
    assert_eq!(code(hole((0.0, 6.0), "3L 3L 3L 3L")), 406);
    assert_eq!(code(hole((3.0, 3.0), "3R 3R 3R 3R")), 417);
    assert_eq!(
        code(Loop {
            start: (3.0, 3.0),
            ..walk("3R 3R 3R 3R")
        }),
        408
    );
}

#[test]
fn rings_of_facades_spread_a_small_error() {
    let facades = |text| Loop {
        drawn: Drawn::Facades,
        ..walk(text)
    };
    let (shell, said) = lowered(vec![vec![facades("10R 5R 10.1R 5R")]]);
    assert!(said.is_empty(), "{said:?}");
    let walls = &shell.houses[0].storeys[0].rings[0].walls;
    assert_eq!(walls[3].to, walls[0].from);
    for wall in walls {
        let units: f64 = wall.units.iter().map(|u| u.width).sum();
        assert!((units - wall.from.distance(wall.to)).abs() < 1e-9);
    }
    for wall in walls {
        let way = wall.to - wall.from;
        assert!(way.x == 0.0 || way.y == 0.0, "right angles stay right");
        assert!((way.normalize() - wall.direction).length() < 1e-12);
    }
    // Along a 20.1 units share the 0.1, along b nothing is wrong.
    assert!((walls[0].to.x - 10.0 * (1.0 + 0.1 / 20.1)).abs() < 1e-9);
    assert_eq!(walls[1].to.y - walls[1].from.y, 5.0);
    assert_eq!(lowered(vec![vec![facades("10R 5R 8R 5R")]]).1[0].0, 409);
    assert!(
        lowered(vec![vec![facades("10R 5R")]]).1.is_empty(),
        "an open facade"
    );
    let round = ["2@15"; 24].join(" ");
    let (shell, said) = lowered(vec![vec![facades(&round)]]);
    assert!(
        said.is_empty() && shell.houses[0].storeys[0].rings[0].closed,
        "{said:?}"
    );
}

#[test]
fn spread_rings_are_exact_whatever_their_shape() {
    let facades = |text: &str| Loop {
        drawn: Drawn::Facades,
        ..walk(text)
    };
    let l = "6.01R 4R 3R 2.02L 3R 2R";
    let odd = "3.333333R 2.7R 3.3R 0.33333R 0.02L 2.4R";
    let middle = "2.01R 3R 4R 3.03R 2R";
    for text in [l, odd, middle] {
        let (shell, said) = lowered(vec![vec![facades(text)]]);
        assert!(said.is_empty(), "{text}: {said:?}");
        let ring = &shell.houses[0].storeys[0].rings[0];
        for (wall, next) in ring.walls.iter().zip(ring.walls.iter().cycle().skip(1)) {
            let way = wall.to - wall.from;
            assert!(way.x == 0.0 || way.y == 0.0, "{text}: {wall:?}");
            assert!(way.dot(wall.direction) > 0.0, "{text}: {wall:?}");
            assert_eq!(wall.to, next.from, "{text}");
        }
    }
    // So thin that the error is no small one along its depth: corners move, and it closes all the same.
    let (shell, said) = lowered(vec![vec![facades("50R 0.2R 50R 0.8R")]]);
    let codes: Vec<u16> = said.iter().map(|told| told.0).collect();
    assert_eq!(codes, [419], "the corners are squared again");
    let walls = &shell.houses[0].storeys[0].rings[0].walls;
    assert_eq!(walls[3].to, walls[0].from);
}

#[test]
fn a_comb_of_many_teeth_is_judged_in_linear_time() {
    let comb = |teeth: usize| {
        let mut text = format!("{}R 5R ", teeth * 2);
        text += &vec!["1R 4L 1L 4R"; teeth - 1].join(" ");
        walk(&(text + " 1R 4L 1R 1R"))
    };
    hsd_testing::cpu::assert_linear("a comb", 5_000, comb, |comb| {
        let (shell, said) = lowered(vec![vec![comb.clone()]]);
        assert!(shell.houses[0].storeys[0].rings[0].closed && said.is_empty());
    });
}

/// The lines of a walk through some corners, as someone measures them: turns to a hundredth of a degree, lengths to a
/// thousandth.
fn measured(corners: &[(f64, f64)]) -> String {
    let at = |k: usize| {
        let (a, b) = corners[k % corners.len()];
        dvec2(a, b)
    };
    let lines = (0..corners.len()).map(|k| {
        let (way, next) = (at(k + 1) - at(k), at(k + 2) - at(k + 1));
        let turn = way.perp_dot(next).atan2(way.dot(next)).to_degrees();
        format!("{:.3}@{turn:.2}", way.length())
    });
    lines.collect::<Vec<_>>().join(" ")
}

#[test]
fn measured_rings_are_squared() {
    // An L with a court of its own, every corner a little off.
    let outer = [
        (0.0, 0.0),
        (9.0, 0.0),
        (9.03, 5.02),
        (4.01, 4.97),
        (3.98, 8.03),
        (0.02, 8.0),
    ];
    let (shell, said) = lowered(vec![vec![walk(&measured(&outer))]]);
    let ring = &shell.houses[0].storeys[0].rings[0];
    assert_eq!(said.iter().map(|s| s.0).collect::<Vec<_>>(), [419]);
    assert!(ring.closed);
    for ((wall, next), (a, b)) in
        (ring.walls.iter().zip(ring.walls.iter().cycle().skip(1))).zip(outer)
    {
        let way = wall.to - wall.from;
        assert!((way.x == 0.0) != (way.y == 0.0), "{wall:?}");
        assert!((way.normalize() - wall.direction).length() < 1e-12);
        assert_eq!(wall.to, next.from);
        assert!(wall.from.distance(dvec2(a, b)) < 0.05, "{wall:?}");
        let length: f64 = wall.units.iter().map(|unit| unit.width).sum();
        assert!((length - way.length()).abs() < 1e-9);
    }
}

#[test]
fn walls_in_one_line_stay_in_one_line() {
    let bent = [
        (0.0, 0.0),
        (5.0, 0.0),
        (10.0, 0.06),
        (10.0, 4.0),
        (0.0, 4.0),
    ];
    let (shell, said) = lowered(vec![vec![walk(&measured(&bent))]]);
    assert_eq!(said.iter().map(|s| s.0).collect::<Vec<_>>(), [419]);
    let walls = &shell.houses[0].storeys[0].rings[0].walls;
    assert_eq!(walls.len(), 5);
    assert_eq!(walls[0].to.y, walls[0].from.y);
    assert_eq!(walls[1].to.y, walls[0].from.y);
}

#[test]
fn what_slants_on_purpose_is_not_squared() {
    let silent = |text: &str| {
        let (shell, said) = lowered(vec![vec![walk(text)]]);
        let slants = |w: &hsd_ir::building::Wall| w.direction.x != 0.0 && w.direction.y != 0.0;
        let walls = &shell.houses[0].storeys[0].rings[0].walls;
        assert!(walls.iter().any(slants), "{text}");
        assert!(said.iter().all(|told| told.0 != 419), "{text}: {said:?}");
    };
    // More than a degree.
    silent(&measured(&[(0.0, 0.0), (9.0, 0.0), (9.0, 5.0), (0.0, 5.2)]));
    // Less, but a corner would move by more than 0.3 m, since the wall is long.
    silent(&measured(&[
        (0.0, 0.0),
        (99.0, 0.0),
        (99.0, 5.0),
        (0.0, 6.5),
    ]));
}
