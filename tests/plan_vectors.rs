//! Plans as vectors, against drawings of houses of which all is known (`plan_drawings`).

use crate::plan_drawings::{self, Cad, Convention, Kind, Point, Unit, Variant};
use crate::plans::legends;
use crate::support::{assert_none, number, on_all_processors, root};
use hsd::plan::Front;
use hsd::plan::drawing::{self, DrawnPlan};
use hsd::plan::legend::Role;
use hsd::plan::shape::Wall;
use hsd::plan::text::Era;
use hsd::plan::vector::roles::{Means, Roles};
use hsd::plan::vector::{self, Refused, dxf, paint, svg};
use hsd::plan::walls::scale::Evidence;
use hsd::plan::walls::writing;
use std::collections::{BTreeMap, BTreeSet};

/// The same wall from both ends.
fn ends(p: Point, q: Point) -> (Point, Point) {
    (p.min(q), p.max(q))
}

fn word(wall: &Wall) -> &'static str {
    match wall.read.role {
        _ if wall.is_joined => "open",
        Role::Wall => "wall",
        Role::Slide => "slide",
        Role::Hinged => "hinged",
        Role::Window => "window",
        Role::Lattice => "lattice",
        Role::Open | Role::Empty | Role::Mat => "open",
    }
}

/// The units of an outline, courts left out: a court looks like a room without a name.
fn outline(corners: &[Point]) -> BTreeSet<(Point, Point)> {
    let mut units = BTreeSet::new();
    for k in 0..corners.len() {
        let (mut at, to) = (corners[k], corners[(k + 1) % corners.len()]);
        let step = ((to.0 - at.0).signum(), (to.1 - at.1).signum());
        while at != to {
            let next = (at.0 + step.0, at.1 + step.1);
            units.insert(ends(at, next));
            at = next;
        }
    }
    units
}

/// What is wrong with the house that was found, apart from what is in doubt.
fn wrong(seed: u64, lines: Result<vector::lines::Lines, Refused>) -> Vec<String> {
    let plan = plan_drawings::plan(seed);
    let roles = Roles::read(vector::CAD).expect("the legend is sound");
    let found = match lines.and_then(|lines| vector::find(lines, &roles, None)) {
        Ok(found) => found,
        Err(refused) => return vec![format!("{seed}: {refused:?}")],
    };
    let shape = &found.shape;
    let right = shape.cells.iter().map(|c| c.0).max().unwrap_or(0) + 1;
    let front = shape.cells.iter().map(|c| c.1).max().unwrap_or(0) + 1;
    let place = |p: Point| (right - p.0, front - p.1);
    let all: BTreeMap<_, _> = shape
        .outer
        .iter()
        .chain(&shape.inner)
        .map(|w| (ends(place(w.from), place(w.to)), w))
        .collect();
    let least = plan.outer.iter().fold((i32::MAX, i32::MAX), |m, u| {
        (m.0.min(u.from.0), m.1.min(u.from.1))
    });
    let moved = |p: Point| (p.0 - least.0, p.1 - least.1);
    let of = |u: &Unit| ends(moved(u.from), moved(u.to));
    let corners: Vec<Point> = plan.outline.iter().map(|p| moved(*p)).collect();
    let outer: BTreeSet<_> = shape
        .outer
        .iter()
        .map(|w| ends(place(w.from), place(w.to)))
        .collect();
    let mut wrong = vec![];
    if !outline(&corners).is_subset(&outer)
        || !outer.is_subset(&plan.outer.iter().map(of).collect())
    {
        wrong.push(format!("{seed}: another outline"));
    }
    let is_unsure = shape
        .inner
        .iter()
        .chain(&shape.outer)
        .any(|w| w.read.lead == 0.0);
    for unit in plan.outer.iter().chain(&plan.inner) {
        let is_bare = unit.kind == Kind::Open && !outline(&corners).contains(&of(unit));
        let found = all.get(&of(unit)).map_or("nothing", |w| word(w));
        // Leaves without arcs may hang on either side of their corner.
        let in_doubt = unit.kind == Kind::Hinged && is_unsure;
        if found != unit.kind.name() && !is_bare && !in_doubt {
            wrong.push(format!(
                "{seed}: {} at {:?} read as {found}",
                unit.kind.name(),
                unit.from
            ));
        }
    }
    wrong
}

fn all(read: impl Fn(u64, Variant) -> Result<vector::lines::Lines, Refused> + Sync) -> Vec<String> {
    let count = number("HSD_PLANS", 100);
    on_all_processors(count, |k| {
        wrong(
            k as u64,
            read(
                k as u64,
                Variant {
                    seed: k as u64,
                    unseen: false,
                },
            ),
        )
    })
}

#[test]
fn cad_drawings_are_read_exactly() {
    for cad in [Cad::Lines, Cad::Polylines, Cad::Blocks] {
        assert_none(&all(|seed, variant| {
            dxf::read(plan_drawings::dxf(&plan_drawings::plan(seed), cad, variant).as_bytes())
        }));
    }
}

#[test]
fn svg_of_survey_drawings_is_read_exactly() {
    assert_none(&all(|seed, variant| {
        svg::read(&plan_drawings::svg(
            &plan_drawings::plan(seed),
            Convention::Survey,
            variant,
        ))
    }));
}

#[test]
fn svg_drawn_by_hand_is_read_but_for_a_leaf() {
    for convention in [Convention::Sashizu, Convention::Itazu] {
        let wrong = all(|seed, variant| {
            svg::read(&plan_drawings::svg(
                &plan_drawings::plan(seed),
                convention,
                variant,
            ))
        });
        assert!(wrong.len() <= 2, "{wrong:?}");
    }
}

#[test]
fn layers_of_many_languages_have_roles() {
    let roles = Roles::read(vector::CAD).expect("the legend is sound");
    let of = |name: &str| {
        let drawing = format!(
            "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n{name}\n10\n0\n20\n0\n11\n1\n21\n1\n0\nENDSEC\n0\nEOF\n"
        );
        let lines = dxf::read(drawing.as_bytes()).expect("it is a DXF");
        roles.of(&lines)[0]
    };
    for (role, names) in [
        (
            Means::Wall,
            ["_0-1__躯体", "Innenwand", "CLOISONS", "Tabiques", "A-WALL"],
        ),
        (
            Means::Door,
            ["_0-3__建具", "Türen", "PORTES", "Puertas", "A-DOOR"],
        ),
        (
            Means::Glazing,
            ["窓", "FENSTER", "Fenêtres", "Ventanas", "A-GLAZ"],
        ),
        (
            Means::Grid,
            ["_0-0__芯", "Achsen", "AXES", "壁芯", "S-GRID"],
        ),
        (
            Means::Ignore,
            ["_0-7__寸法", "Bemassung", "Cotation", "Cotas", "A-DIMS"],
        ),
    ] {
        for name in names {
            assert_eq!(of(name), Some(role), "{name}");
        }
    }
}

#[test]
fn areas_keep_the_colour_of_their_fill() {
    let drawing = r##"<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200">
      <rect x="10" y="10" width="280" height="180" fill="#ffffff" stroke="#202020" stroke-width="4"/></svg>"##;
    let lines = svg::read(drawing).expect("it is an SVG");
    let painted = paint::paint(&lines)
        .expect("something is drawn")
        .picture
        .pixels;
    let middle = painted.get_pixel(painted.width() / 2, painted.height() / 2);
    assert_eq!(middle.0, [255; 3]);
    assert!(painted.pixels().any(|p| p.0 == [32; 3]));
}

#[test]
fn a_damaged_dxf_is_refused_in_words() {
    let whole = plan_drawings::dxf(
        &plan_drawings::plan(1),
        Cad::Blocks,
        Variant {
            seed: 1,
            unseen: false,
        },
    );
    for share in 0..20 {
        let end = whole.len() * share / 20;
        assert!(dxf::read(&whole.as_bytes()[..end]).is_err(), "cut at {end}");
    }
    let cyclic = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nA\n0\nINSERT\n2\nA\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nA\n0\nENDSEC\n0\nEOF\n";
    assert!(
        dxf::read(cyclic.as_bytes())
            .expect("it is a DXF")
            .strokes
            .is_empty()
    );
    let beyond = "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nWALL\n10\nnan\n20\n0\n11\n1e308\n21\n1\n0\nENDSEC\n0\nEOF\n";
    assert!(
        dxf::read(beyond.as_bytes())
            .expect("it is a DXF")
            .strokes
            .is_empty()
    );
}

#[test]
#[cfg_attr(not(shared_data), ignore = "the files lie beside the repository")]
fn files_of_other_programs_are_opened_or_refused_in_words() {
    let folder = root().join("../shared/data/dxf_torture");
    let roles = Roles::read(vector::CAD).expect("the legend is sound");
    let files = std::fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("can be listed").path());
    let files: Vec<_> = files
        .filter(|p| p.extension().is_some_and(|e| e == "dxf"))
        .collect();
    assert!(files.len() > 30);
    for path in files {
        let bytes = std::fs::read(&path).expect("the file can be read");
        // None of them is a plan.
        let found = dxf::read(&bytes).and_then(|lines| vector::find(lines, &roles, None));
        assert!(found.is_err(), "{}", path.display());
    }
}

/// The four sides of a box: a layer and two places for each.
fn bar(layer: &'static str, [x, y, right, top]: [f64; 4]) -> [(&'static str, [f64; 4]); 4] {
    [
        (layer, [x, y, right, y]),
        (layer, [right, y, right, top]),
        (layer, [right, top, x, top]),
        (layer, [x, top, x, y]),
    ]
}

/// A house of two rooms off every grid with walls of 140 mm as two lines: 7130 by 5270 mm. Lines are a layer and two places.
fn hollow() -> Vec<(&'static str, [f64; 4])> {
    let walls = [
        [0.0, 0.0, 1230.0, 140.0],
        [2410.0, 0.0, 4480.0, 140.0],
        [6020.0, 0.0, 7130.0, 140.0],
        [0.0, 5130.0, 7130.0, 5270.0],
        [0.0, 140.0, 140.0, 5130.0],
        [6990.0, 140.0, 7130.0, 5130.0],
        // The inner wall has a door.
        [2950.0, 140.0, 3090.0, 3070.0],
        [2950.0, 3880.0, 3090.0, 5130.0],
    ];
    let mut lines: Vec<_> = walls
        .into_iter()
        .flat_map(|wall| bar("Walls", wall))
        .collect();
    for [from, to] in [[1230.0, 2410.0], [4480.0, 6020.0]] {
        lines.extend(bar("Windows", [from, 15.0, to, 125.0]));
        lines.extend(bar("Windows", [from, 60.0, to, 80.0]));
    }
    lines
}

/// A DXF of two storeys beside each other: that house, and 2 m to its right an upper storey of two rooms, 4130 by 5270 mm.
pub(crate) fn two_storeys() -> String {
    let walls = [
        [0.0, 0.0, 4130.0, 140.0],
        [0.0, 5130.0, 4130.0, 5270.0],
        [0.0, 140.0, 140.0, 5130.0],
        [3990.0, 140.0, 4130.0, 5130.0],
        [1950.0, 140.0, 2090.0, 3070.0],
        [1950.0, 3880.0, 2090.0, 5130.0],
    ];
    let right = |[x, y, right, top]: [f64; 4]| [x + 9130.0, y, right + 9130.0, top];
    let upper = walls.into_iter().flat_map(|wall| bar("Walls", right(wall)));
    text(&[hollow(), upper.collect()].concat())
}

fn text(lines: &[(&str, [f64; 4])]) -> String {
    let mut text = "0\nSECTION\n2\nENTITIES\n".to_owned();
    for (layer, [x, y, to_x, to_y]) in lines {
        text += &format!("0\nLINE\n8\n{layer}\n10\n{x}\n20\n{y}\n11\n{to_x}\n21\n{to_y}\n");
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

fn drawn(lines: &[(&str, [f64; 4])]) -> vector::lines::Lines {
    dxf::read(text(lines).as_bytes()).expect("it is a DXF")
}

/// Reads a drawing wall by wall, and returns the number of rooms, the size and the windows.
fn by_walls(lines: &[(&str, [f64; 4])]) -> (usize, [f64; 2], usize) {
    let roles = Roles::read(vector::CAD).expect("the legend is sound");
    let read = drawing::read(drawn(lines), &roles, None, &legends(), Front::Bottom);
    let found = match read {
        Ok(DrawnPlan::Walls(found)) => found,
        Ok(DrawnPlan::Grid(_)) => panic!("read on a grid"),
        Err(none) => panic!("{:?}", none.why),
    };
    assert_eq!(found.scale.evidence, Evidence::Unit(1.0));
    let head = ("h", &[][..], Era::named("edo").unwrap());
    let traced = writing::write(&[found.storey(10.0)], head).expect("a house");
    let windows = traced.text.matches("MRE").count();
    (
        found.reading.rooms(),
        found.size(&traced.storeys[0]).to_array(),
        windows,
    )
}

fn assert_is_hollow((rooms, [width, depth], windows): (usize, [f64; 2], usize)) {
    assert_eq!((rooms, windows), (2, 2));
    // From the middle of a wall to that of the other.
    assert!(
        (width - 6.99).abs() < 0.06 && (depth - 5.13).abs() < 0.06,
        "{width} x {depth}"
    );
}

#[test]
fn wall_layers_off_the_grid_are_read_without_furniture() {
    let mut lines = hollow();
    // A bed against a wall, cupboards and a path look like walls.
    for [x, y, right, top] in [
        [140.0, 3200.0, 1400.0, 5130.0],
        [3090.0, 4800.0, 6990.0, 4960.0],
        [-3000.0, -2000.0, -2850.0, 9000.0],
    ] {
        for side in [
            [x, y, right, y],
            [right, y, right, top],
            [x, top, right, top],
            [x, y, x, top],
        ] {
            lines.push(("Furniture", side));
        }
    }
    assert_is_hollow(by_walls(&lines));
}

#[test]
fn axes_of_hollow_walls_on_one_layer_are_no_walls() {
    let mut lines = hollow();
    lines.iter_mut().for_each(|line| line.0 = "0");
    for at in [70.0, 3020.0, 7060.0] {
        lines.push(("0", [at, -1500.0, at, 6800.0]));
    }
    for at in [70.0, 5200.0] {
        lines.push(("0", [-1500.0, at, 8600.0, at]));
    }
    assert_is_hollow(by_walls(&lines));
}
