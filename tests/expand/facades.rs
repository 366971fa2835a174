//! Walls given facade by facade.

use crate::expand::build::*;
use crate::support::Words;
use hsd::ast::{Facade, House, Item, StoreyKind, Texture};
use hsd::expand::Options;
use hsd::geometry::SHAKU;
use hsd::program::{Content, Drawn, Program};
use hsd::source::NoFiles;

const U: f64 = 3.0 * SHAKU;

/// Figure 4 of paper 003.
fn figure_4() -> House {
    let top = vec![replace("f1ftf1", "f1ftf3"), replace("f1ftf2", "f1ftf4")];
    let middle = vec![
        random("f1fkf1,f1fkf3"),
        random("f1fkf2u1,f1fkf2u3,f1fkf4u1,f1fkf4u3"),
    ];
    let wall = Facade {
        id: Some(put("1".into())),
        ratio: Some(put(1.0)),
        angle: Some(put(0.0)),
        reflection: true,
        ..facade(vec![
            floor("1", vec![]),
            repeat(8, vec![floor("k", middle)]),
            floor("top", top),
        ])
    };
    structure(Some(100.0), vec![wall])
}

fn figure_4_pictures() -> Pictures {
    let plain = (80, 100);
    let names = [
        "f1f1f1", "f1f1f2", "f1fkf1", "f1fkf3", "f1ftf1", "f1ftf2", "f1ftf3", "f1ftf4",
    ];
    let mut all: Vec<_> = names.iter().map(|n| (*n, plain)).collect();
    for part in ["f1fkf2", "f1fkf4"] {
        for piece in ["u1", "u2", "u3", "l1", "l2"] {
            let name: &'static str = format!("{part}{piece}").leak();
            all.push((name, if piece == "u3" { (41, 50) } else { (40, 50) }));
        }
    }
    Pictures(all)
}

#[test]
fn figure_4_compiles_as_printed() {
    let (program, said) = run_in(figure_4(), &figure_4_pictures(), &Options::default());
    assert!(said.is_empty(), "{said:#?}");
    let storeys = &program.houses[0].storeys;
    assert_eq!(storeys.len(), 10);
    for (index, storey) in storeys.iter().enumerate() {
        let made = &storey.loops[0];
        assert!(made.drawn == Drawn::Facades && made.lines.len() == 1 && made.lines[0].reflection);
        assert_eq!(storey.height, 11.55);
        let wide = width(&made.lines[0].units) * U;
        assert!((wide - 10.0).abs() < 1e-9, "storey {index}: {wide} m");
    }
    assert_eq!(names(&program, 0, 0), "f1f1f1|f1f1f2");
    assert_eq!(names(&program, 9, 0), "f1ftf3|f1ftf4|f1ftf3|f1ftf4");
    let mut rows: Vec<_> = (1..9).map(|s| names(&program, s, 0)).collect();
    assert!(
        rows.iter()
            .all(|r| r.starts_with("f1fkf") && r.contains("/f1fkf2l1|f1fkf2l2)"))
    );
    rows.sort();
    rows.dedup();
    assert!(rows.len() > 5, "each storey draws anew: {rows:#?}");
    assert!(
        program
            .pictures
            .iter()
            .all(|p| p.path.starts_with("textures/"))
    );
    assert_halves_fit(&program);
}

fn assert_halves_fit(program: &Program) {
    for storey in &program.houses[0].storeys {
        for unit in &storey.loops[0].lines[0].units {
            if let Content::Split(split) = &unit.content {
                assert!((width(&split.upper) - unit.width).abs() < 1e-9);
                assert!((width(&split.lower) - unit.width).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn figure_4_with_only_the_pictures_it_names() {
    let names = [
        "f1f1f1", "f1fkf1", "f1fkf3", "f1fkf2u1", "f1fkf2u3", "f1fkf4u1", "f1fkf4u3", "f1ftf1",
        "f1ftf2", "f1ftf3", "f1ftf4",
    ];
    let world = Pictures(names.iter().map(|n| (*n, (80, 100))).collect());
    let (program, said) = run_in(figure_4(), &world, &Options::default());
    assert!(said.iter().all(|d| d.code.0 == 319), "{said:#?}");
    assert_eq!(line(&program, 1, 0).units.len(), 4);
}

#[test]
fn figure_4_without_pictures_says_what_it_looked_for() {
    let (_, said) = run_in(figure_4(), &NoFiles, &Options::default());
    let missing: Vec<_> = said.iter().filter(|d| d.code.0 == 312).collect();
    assert_eq!(missing.len(), 2, "{said:#?}");
    assert!(
        missing[0].message.en().contains("`f1f1f1.png`")
            && missing[1].message.en().contains("`f1ftf1.png`")
    );
    assert!(missing[0].help.en().contains("--textures"));
}

#[test]
fn only_pictures_in_use_are_kept() {
    let world = Pictures(vec![("red", (1, 1)), ("blue", (1, 1)), ("grey", (1, 1))]);
    let pieces = vec![weighted("red,blue", Some(vec![0.0, 1.0])), part("grey")];
    let (program, said) = run_in(one_row(pieces), &world, &Options::default());
    assert!(said.is_empty(), "{said:?}");
    let kept: Vec<_> = program.pictures.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(kept, ["blue", "grey"]);
    assert_eq!(names(&program, 0, 0), "blue|grey");
}

fn four(floors: impl Fn() -> Vec<Item<hsd::ast::Floor>>) -> Vec<Facade> {
    (0..4).map(|_| facade(floors())).collect()
}

#[test]
fn a_ring_of_facades() {
    let program = clean(structure(
        None,
        four(|| vec![floor("1", codes("NAP  NGC  "))]),
    ));
    let lines = &program.houses[0].storeys[0].loops[0].lines;
    let turns: Vec<_> = lines.iter().map(|l| l.turn).collect();
    assert_eq!(turns, [90.0, 90.0, 90.0, 0.0]);
    assert!(lines.iter().all(|l| width(&l.units) == 2.0));
}

#[test]
fn the_first_angle_turns_the_heading() {
    let mut walls = four(|| vec![floor("1", codes("NAP  "))]);
    walls[0].angle = Some(put(30.0));
    walls[2].angle = Some(put(160.0));
    let (program, said) = run(structure(None, walls));
    assert_eq!(numbers(&said), [316]);
    let lines = &program.houses[0].storeys[0].loops[0].lines;
    assert_eq!(
        (lines.len(), lines[0].units.len(), lines[0].turn),
        (5, 0, 30.0)
    );
    assert_eq!((lines[2].turn, lines[4].turn), (160.0, 0.0));
}

#[test]
fn floors_are_scaled_to_the_facade() {
    let mut walls = four(|| vec![floor("1", codes("NAS 2NAP  ")), floor("2", codes("NAP  "))]);
    walls[1].ratio = Some(put(0.5));
    let program = clean(structure(Some(60.0), walls));
    for storey in &program.houses[0].storeys {
        let lines = &storey.loops[0].lines;
        let wide: Vec<_> = lines
            .iter()
            .map(|l| (width(&l.units) * U * 1e6).round())
            .collect();
        assert_eq!(wide, [6e6, 3e6, 6e6, 6e6]);
    }
    let units = &line(&program, 0, 0).units;
    assert!((units[0].width - 2.0 * units[1].width).abs() < 1e-12);
}

#[test]
fn pictures_keep_their_proportions() {
    let world = Pictures(vec![("f1f1f1", (50, 100)), ("f1f1f2", (100, 100))]);
    let made = structure(None, vec![facade(vec![floor("1", vec![])])]);
    let (program, said) = run_in(made, &world, &Options::default());
    assert!(said.is_empty(), "{said:?}");
    let widths: Vec<_> = line(&program, 0, 0).units.iter().map(|u| u.width).collect();
    assert_eq!(widths, [3.85 * 0.5, 3.85]);
}

#[test]
fn parts_may_run_rightwards() {
    let mut made = structure(
        None,
        vec![facade(vec![floor("1", codes("NAP  NGC  NTI  "))])],
    );
    made.structures[0].rightwards = true;
    assert_eq!(names(&clean(made), 0, 0), "NTI  |NGC  |NAP  ");
}

#[test]
fn a_floor_borrows_the_parts_of_its_namesake() {
    let walls = vec![
        facade(vec![floor("1", codes("NAP  NGC  "))]),
        facade(vec![floor("1", vec![replace("NAP", "NTI")])]),
    ];
    let program = clean(structure(None, walls));
    assert_eq!(names(&program, 0, 0), "NAP  |NGC  ");
    assert_eq!(names(&program, 0, 1), "NTI  |NGC  ");
}

#[test]
fn slots_without_and_edits_with_a_base_row() {
    let slots = vec![repeat(6, vec![random("NAP, NAS 2")])];
    let program = clean(structure(Some(50.0), vec![facade(vec![floor("1", slots)])]));
    assert_eq!(line(&program, 0, 0).units.len(), 6);
    let mut edits = codes("NAP  NTI  ");
    edits.push(random("NGC, NAS 2"));
    let (program, said) = run(structure(None, vec![facade(vec![floor("1", edits)])]));
    assert_eq!(numbers(&said), [308]);
    assert_eq!(names(&program, 0, 0), "NAP  |NTI  ");
}

#[test]
fn a_shorter_facade_leaves_its_side_open() {
    let mut walls = four(|| {
        vec![
            floor("1", codes("NAP  NAP  ")),
            floor("2", codes("NAP  NAP  ")),
        ]
    });
    walls[3].floors.pop();
    let program = clean(structure(None, walls));
    assert_eq!(names(&program, 1, 3), ".....");
    assert_eq!(line(&program, 1, 3).units[0].width, 2.0);
}

#[test]
fn heights_of_a_storey_must_agree() {
    let mut walls = four(|| vec![floor("1", codes("NAP  "))]);
    for (wall, height) in walls.iter_mut().zip([10.0, 12.0]) {
        let Item::One(floor) = &mut wall.floors[0] else {
            unreachable!()
        };
        floor.height = Some(put(height));
    }
    let (program, said) = run(structure(None, walls));
    assert_eq!(numbers(&said), [315]);
    assert_eq!(program.houses[0].storeys[0].height, 12.0);
}

#[test]
fn parapets_are_no_storeys() {
    let mut wall = facade(vec![floor("1", codes("NAP  ")), floor("p", codes("NAP  "))]);
    let Item::One(floor) = &mut wall.floors[1] else {
        unreachable!()
    };
    floor.kind = StoreyKind::Parapet;
    let program = clean(structure(None, vec![wall]));
    assert_eq!(program.houses[0].storeys[1].kind, StoreyKind::Parapet);
}

#[test]
fn a_facade_without_floors() {
    let mut walls = four(|| vec![floor("1", codes("NAP  "))]);
    walls[1].floors.clear();
    assert_eq!(numbers(&run(structure(Some(10.0), walls)).1), [320]);
}

#[test]
fn textures_mirror_where_the_facade_allows() {
    let mut walls = four(|| vec![floor("1", codes("NGC  NAP  "))]);
    walls[0].reflection = true;
    let mut made = structure(None, walls);
    let texture = |code: &str, share| Texture {
        span: at(),
        code: put(code.into()),
        reflection: Some(put(share)),
        src: None,
    };
    made.textures = vec![texture("NGC", 0.6)];
    let program = clean(made.clone());
    let shares: Vec<_> = line(&program, 0, 0)
        .units
        .iter()
        .map(|u| u.reflection)
        .collect();
    assert_eq!(shares, [Some(0.6), None]);
    assert_eq!(line(&program, 0, 1).units[0].reflection, None);
    made.textures = vec![texture("NGD", 0.5), texture("NGC", 0.4)];
    let (program, said) = run(made);
    assert_eq!(numbers(&said), [317]);
    assert!(
        said[0].help.en().contains("`NGC  `"),
        "{}",
        said[0].help.en()
    );
    assert_eq!(line(&program, 0, 0).units[0].reflection, Some(0.4));
}
