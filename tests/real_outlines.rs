//! Outlines of real maps as houses: every one is built, what can be squared is, and roofs divide it well. The maps lie beside
//! the repository, not in it; without them the test is reported as ignored.
//!
//! `HSD_OUTLINES=FOLDER cargo test --release real_outlines -- --include-ignored --nocapture` prints the figures for the
//! GeoJSON files of another folder. Of the maps beside the repository every eighth outline is built; with `HSD_THOROUGH` all are.

use crate::support::crossings::deepest;
use crate::support::maps::{Plan, maps, maps_in, plans};
use crate::support::{Run, Words, assert_none, compile, flaws, on_all_processors};
use glam::DVec2;
use hsd::building::{HouseRoofs, PlanRegion};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Metres in a unit.
const UNIT: f64 = 10.0 / 11.0;
/// Roofs may not be narrower, metres.
const NARROW: f64 = 0.5;
/// Borders shorter than that do not count, units.
const TOUCH: f64 = 0.05;
/// Roofs may not stand deeper in each other, metres; what fills their gables is let in by 0.01.
const THROUGH: f64 = 0.012;

/// What is counted over the outlines of a map.
const COUNTED: [&str; 13] = [
    "outlines", "refused", "square", "slanting", "moving", "crossing", "roofs", "lean-tos",
    "narrow", "against", "open", "double", "through",
];

/// The counts of one outline or of many, in the order of [`COUNTED`].
type Counts = [usize; COUNTED.len()];

fn points(ring: &[DVec2]) -> String {
    let mut text = String::new();
    for (n, p) in ring.iter().enumerate() {
        let comma = if n > 0 { ", " } else { "" };
        let _ = write!(text, "{comma}{:.3} {:.3}", p.x, p.y);
    }
    text
}

/// The house of an outline, one storey high.
pub(crate) fn text_of(plan: &Plan) -> String {
    let mut text = format!(
        "<House>\n  <Outline points=\"{}\">\n",
        points(&plan.outline)
    );
    for court in &plan.courts {
        let _ = writeln!(text, "    <Hole points=\"{}\"/>", points(court));
    }
    text + "  </Outline>\n</House>\n"
}

fn told(run: &Run, code: u16, words: &str) -> usize {
    let told = run.diagnostics.iter().filter(|d| d.code.0 == code);
    usize::from(told.map(|d| d.message.en()).any(|m| m.contains(words)))
}

/// The length along which two regions touch, on a side of the first.
fn touching(one: &PlanRegion, two: &PlanRegion, side: &str) -> f64 {
    let ([a0, b0, a1, b1], [c0, d0, c1, d1]) = (one.rect, two.rect);
    let along = |low: f64, high: f64, from: f64, to: f64| high.min(to) - low.max(from);
    let on = |p: f64, q: f64| (p - q).abs() < TOUCH;
    match side {
        "F" if on(b0, d1) => along(a0, a1, c0, c1),
        "B" if on(b1, d0) => along(a0, a1, c0, c1),
        "L" if on(a1, c0) => along(b0, b1, d0, d1),
        "R" if on(a0, c1) => along(b0, b1, d0, d1),
        _ => 0.0,
    }
}

fn area(ring: &[DVec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let sum: f64 = ring.iter().zip(next).map(|(p, q)| p.perp_dot(*q)).sum();
    (sum / 2.0).abs()
}

fn count_roofs(roofs: &HouseRoofs, counts: &mut Counts) {
    let [.., all, leaning, narrow, against, open, double, through] = counts;
    let crossing = deepest(&roofs.roofs);
    if crossing.depth > THROUGH {
        *through += 1;
        eprintln!("{crossing:?}");
    }
    for plan in &roofs.plans {
        let whole: f64 = plan.outlines.iter().map(|ring| area(ring)).sum();
        let whole = whole - plan.holes.iter().map(|ring| area(ring)).sum::<f64>();
        let wings = plan.regions.iter().filter_map(|r| r.polygon.as_deref());
        let mut covered: f64 = wings.map(area).sum();
        let rectangles = plan.regions.iter().filter(|r| r.polygon.is_none());
        let rectangles: Vec<&PlanRegion> = rectangles.collect();
        if rectangles.is_empty() {
            continue;
        }
        for (n, region) in rectangles.iter().enumerate() {
            let [a0, b0, a1, b1] = region.rect;
            *all += 1;
            // Lots may be strips themselves.
            let is_narrow = rectangles.len() > 1 && (a1 - a0).min(b1 - b0) * UNIT < NARROW - 1e-3;
            *narrow += usize::from(is_narrow);
            covered += (a1 - a0) * (b1 - b0);
            if let Some(side) = region.fall {
                *leaning += 1;
                let others = rectangles.iter().enumerate().filter(|(m, _)| *m != n);
                let meets = others.map(|(_, other)| touching(region, other, side));
                *against += usize::from(meets.fold(0.0, f64::max) > TOUCH);
            }
        }
        *open += usize::from(covered < 0.999 * whole);
        *double += usize::from(covered > 1.001 * whole);
    }
}

/// Builds an outline; adds what it comes to.
fn count(plan: &Plan, findings: &mut Vec<String>) -> Counts {
    let text = text_of(plan);
    let run = compile("outline.hsd", text.as_bytes());
    let mut counts = Counts::default();
    counts[0] = 1;
    counts[1] = usize::from(run.has_errors());
    counts[3] = told(&run, 422, "slants");
    counts[4] = told(&run, 422, "would move");
    counts[5] = told(&run, 422, "cross");
    counts[2] = usize::from(counts[1] + counts[3] + counts[4] + counts[5] == 0);
    for built in &run.building.houses {
        count_roofs(&built.roofs, &mut counts);
        if counts[1] == 0 && built.roofs.roofs.is_empty() {
            findings.push(format!("{}: no roof\n{text}", plan.name));
        }
    }
    let name = &plan.name;
    findings.extend(
        flaws(&run)
            .iter()
            .map(|flaw| format!("{name}: {flaw}\n{text}")),
    );
    if std::env::var_os("HSD_OUTLINES").is_some()
        && counts[1] + counts[8..].iter().sum::<usize>() > 0
    {
        eprintln!("{name}: {counts:?} {}\n{text}", run.short());
    }
    counts
}

fn add(sum: &mut Counts, more: &Counts) {
    sum.iter_mut().zip(more).for_each(|(sum, n)| *sum += n);
}

/// Builds the outlines of maps and prints the figures of each; returns their sum, and what is wrong.
fn figures(maps: &[PathBuf]) -> (Counts, Vec<String>) {
    let mut sum = Counts::default();
    let mut findings = vec![];
    eprintln!("{}", COUNTED.map(|name| format!("{name:>9}")).join(""));
    for map in maps {
        let plans: Vec<Plan> = plans(map).into_iter().step_by(step()).collect();
        let of_map = Mutex::new(Counts::default());
        findings.extend(on_all_processors(plans.len(), |n| {
            let mut found = vec![];
            let counts = count(&plans[n], &mut found);
            add(&mut of_map.lock().expect("no panic"), &counts);
            found
        }));
        let of_map = of_map.into_inner().expect("no panic");
        let name = map.file_name().unwrap_or_default().to_string_lossy();
        eprintln!("{} {name}", of_map.map(|n| format!("{n:>9}")).join(""));
        add(&mut sum, &of_map);
    }
    eprintln!("{} all", sum.map(|n| format!("{n:>9}")).join(""));
    (sum, findings)
}

/// Of so many outlines one is built.
fn step() -> usize {
    match asked().is_some() || crate::support::thorough() {
        true => 1,
        false => 8,
    }
}

fn asked() -> Option<PathBuf> {
    std::env::var_os("HSD_OUTLINES").map(PathBuf::from)
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_outlines_are_squared_and_get_whole_roofs() {
    let maps = match asked() {
        Some(folder) => maps_in(Path::new(&folder)),
        None => maps(),
    };
    let (sum, findings) = figures(&maps);
    assert_none(&findings);
    if asked().is_some() {
        return;
    }
    let [outlines, refused, square, ..] = sum;
    let [.., narrow, against, open, double, through] = sum;
    assert!(outlines > 7900 / step(), "{outlines}");
    // Of all 0.12 %; a sample has more or less of so few.
    assert!(
        300 * refused <= outlines,
        "{refused} of {outlines} are refused"
    );
    assert!(
        100 * square >= 67 * outlines,
        "{square} of {outlines} are square"
    );
    assert_eq!((narrow, against, open), (0, 0, 0));
    assert_eq!((double, through), (0, 0));
}
