//! What `grammar/partitions.md` and its Japanese twin show: the table of measures and the pictures, made here and compared.
//! `HSD_UPDATE=1 cargo test --release roof_partition::page` writes them anew.

use super::outlines::{Dice, outlines};
use super::shapes::{NINOMARU, cell, plan, total_cut};
use crate::support::{compile, expect, root};
use hsd::backend::regions_svg::regions_svg;
use hsd::geometry::plan::{Cell, Plan};
use hsd::roof::partition::{Method, partition};
use std::fmt::Write;

const METHODS: [(&str, Method); 3] = [
    ("kd", Method::Kd),
    ("branch-cut", Method::BranchCut),
    ("least-cut", Method::LeastCut),
];

/// The plans of domain 3.6, in halls.
const PLANS: [(&str, &[[i64; 4]]); 9] = [
    ("L", &[[0, 0, 14, 6], [0, 6, 6, 12]]),
    ("T", &[[0, 9, 18, 14], [6, 0, 12, 9]]),
    ("U", &[[0, 0, 24, 6], [0, 6, 6, 13], [18, 6, 24, 13]]),
    ("H", &[[0, 0, 6, 18], [6, 7, 14, 11], [14, 0, 20, 18]]),
    ("Z", &[[0, 0, 12, 6], [8, 6, 20, 12]]),
    ("plus", &[[0, 5, 16, 11], [5, 0, 11, 5], [5, 11, 11, 16]]),
    ("stair", &[[0, 0, 8, 6], [8, 4, 16, 10], [16, 8, 24, 14]]),
    (
        "court",
        &[
            [0, 0, 20, 5],
            [0, 5, 6, 14],
            [14, 5, 20, 14],
            [6, 10, 14, 14],
        ],
    ),
    ("Ninomaru", &NINOMARU),
];

/// A house of one storey with this plan. Gables are asked for: without a shape, the Tozamurai of Ninomaru (29 by 30 m)
/// would get two of them side by side (HSD0521), which is not what the method cuts.
fn house(name: &str, method: &str, plan: &Plan) -> String {
    let mut text = format!(
        "<House name=\"{name}, {method}\">\n<Roofs method=\"{method}\" shape=\"KIR\"/>\n<Storey height=\"9\">\n"
    );
    for corners in &plan.loops {
        let n = corners.len();
        let area: i64 = (0..n)
            .map(|k| corners[k].0 * corners[(k + 1) % n].1 - corners[(k + 1) % n].0 * corners[k].1)
            .sum();
        let hole = area < 0;
        // A courtyard is written from a wall along a.
        let along = |k: &usize| corners[(k + 1) % n].0 > corners[*k].0;
        let first = (0..n).find(along).unwrap();
        if hole {
            let start = corners[first];
            let _ = writeln!(
                text,
                "<Loop hole=\"yes\" start=\"{} {}\">",
                start.0, start.1
            );
        }
        for k in 0..n {
            let at = |m: usize| corners[(first + k + m) % n];
            let (p, q, r) = (at(0), at(1), at(2));
            let length = (q.0 - p.0).abs() + (q.1 - p.1).abs();
            let bend = (q.0 - p.0) * (r.1 - q.1) - (q.1 - p.1) * (r.0 - q.0);
            let turn = if bend < 0 && !hole { " turn=\"L\"" } else { "" };
            let _ = writeln!(
                text,
                "<Row{turn}><repeat num=\"{length}\"><Part code=\"KSK\"/></repeat></Row>"
            );
        }
        text += if hole { "</Loop>\n" } else { "" };
    }
    text + "</Storey>\n</House>\n"
}

/// Rectangles from the least corner of all: a walk begins at a corner of its own.
fn from_corner(rects: Vec<[f64; 4]>) -> Vec<[f64; 4]> {
    let least = |k: usize| rects.iter().map(|r| r[k]).fold(f64::MAX, f64::min);
    let (a, b) = (least(0), least(1));
    let moved = rects
        .iter()
        .map(|r| [r[0] - a, r[1] - b, r[2] - a, r[3] - b]);
    moved.collect()
}

#[test]
fn pictures_of_the_page_are_as_the_program_draws_them() {
    let mut differing = vec![];
    for (name, halls) in PLANS {
        let plan = plan(halls);
        let houses: String = METHODS.iter().map(|m| house(name, m.0, &plan)).collect();
        let run = compile(
            "plans.hsd",
            format!("<Houses>\n{houses}</Houses>\n").as_bytes(),
        );
        assert!(!run.has_errors(), "{name}\n{}", run.short());
        assert_eq!(run.building.houses.len(), METHODS.len());
        for (built, (_, method)) in run.building.houses.iter().zip(METHODS) {
            let roofs = &built.roofs;
            let regions: Vec<[f64; 4]> = roofs.plans[0].regions.iter().map(|r| r.rect).collect();
            let cells = partition(&plan, method);
            let cells = cells
                .iter()
                .map(|c| [c.a0, c.b0, c.a1, c.b1].map(|at| at as f64));
            assert_eq!(from_corner(regions), from_corner(cells.collect()), "{name}");
        }
        let file = format!("grammar/pictures/partitions/{}.svg", name.to_lowercase());
        expect(
            &root().join(file),
            &regions_svg(&run.building),
            &mut differing,
        );
    }
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}

/// Ninomaru with its halls a unit larger or smaller and shifted along each other by up to two, in the order
/// of [`NINOMARU`].
fn jittered(dice: &mut Dice) -> [Cell; 8] {
    let sizes = NINOMARU.map(cell).map(|c| {
        let mut grown = |length: i64| (length + dice.roll(-1, 2)).max(2);
        (grown(c.width()), grown(c.depth()))
    });
    let mut at = NINOMARU.map(|c| (c[0], c[1]));
    let mut shift = || dice.roll(-2, 3);
    // From the Tozamurai on, each hall stands against the one before.
    at[0] = (at[0].0 + shift(), at[1].1 - sizes[0].1);
    for (hall, before) in [(2, 1), (3, 2)] {
        at[hall] = (at[before].0 - sizes[hall].0, at[hall].1 + shift());
    }
    for (hall, before) in [(4, 3), (5, 4), (6, 5), (7, 6)] {
        let along = NINOMARU[hall][0] - NINOMARU[before][0];
        at[hall] = (
            at[before].0 + along + shift(),
            at[before].1 + sizes[before].1,
        );
    }
    std::array::from_fn(|n| Cell {
        a0: at[n].0,
        b0: at[n].1,
        a1: at[n].0 + sizes[n].0,
        b1: at[n].1 + sizes[n].1,
    })
}

/// What one method makes of all plans, a row of the table.
fn measure(method: Method, random: &[Plan], palaces: &[[Cell; 8]]) -> String {
    let (mut roofs, mut length) = (0.0, 0.0);
    for plan in random {
        let cells = partition(plan, method);
        roofs += cells.len() as f64;
        length += total_cut(&cells, plan) as f64;
    }
    let (mut kept, mut whole) = (0.0, 0);
    for halls in palaces {
        let cells = partition(&Plan::from_cells(halls).clean(), method);
        let same = halls.iter().filter(|hall| cells.contains(hall)).count();
        kept += same as f64;
        whole += usize::from(same == halls.len());
    }
    let (plans, count) = (random.len() as f64, palaces.len() as f64);
    format!(
        "{:.2} | {:.2} | {:.2} | {:.0} %",
        roofs / plans,
        length / plans,
        kept / count,
        100.0 * whole as f64 / count
    )
}

#[test]
fn the_table_of_the_page_is_as_measured() {
    let random = outlines(51, 5000, 24);
    let random = random.iter().map(|map| map.plan());
    let random: Vec<Plan> = random.filter(|p| p.corners() >= 8).take(1500).collect();
    assert_eq!(random.len(), 1500);
    let mut dice = Dice::new(52);
    let palaces: Vec<[Cell; 8]> = (0..300).map(|_| jittered(&mut dice)).collect();
    for halls in &palaces {
        let apart = |n: usize| halls[..n].iter().all(|c| !c.overlaps(&halls[n]));
        assert!((0..8).all(apart) && Plan::from_cells(halls).components().len() == 1);
    }
    let mut table = "|---|---|---|---|---|\n".to_owned();
    for (name, method) in METHODS {
        let _ = writeln!(
            table,
            "| `{name}` | {} |",
            measure(method, &random, &palaces)
        );
    }
    let mut differing = vec![];
    for page in ["grammar/partitions.md", "grammar/partitions.ja.md"] {
        let path = root().join(page);
        let page = std::fs::read_to_string(&path).unwrap();
        // The words above the table are the page's own.
        let (head, rest) = page.split_once("<!-- measured -->\n").unwrap();
        let (words, rest) = rest.split_once('\n').unwrap();
        let (_, tail) = rest.split_once("<!-- end -->").unwrap();
        let wanted = format!("{head}<!-- measured -->\n{words}\n{table}<!-- end -->{tail}");
        expect(&path, &wanted, &mut differing);
    }
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}
