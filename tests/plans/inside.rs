//! What stands in the rooms of drawn plans is found: stairs, closets, stoves, wells; and what they are floored with.

use super::{drawing, drawings, find};
use crate::support::{number, on_all_processors};
use drawings::{Convention, Degradation, Floor, Furnishing, Plan, Point};
use hsd::plan::shape::inside;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// Of a kind: how many there are, how many were found, and how many of those found are none.
type Count = [usize; 3];

#[derive(Clone, Debug, Default)]
struct Score {
    plans: usize,
    things: BTreeMap<&'static str, Count>,
    /// Rooms told to have this floor, and those that do.
    floors: BTreeMap<&'static str, [usize; 2]>,
}

fn name(what: Furnishing) -> Option<&'static str> {
    Some(match what {
        Furnishing::Stairs => "stairs",
        Furnishing::Closet => "oshi-ire",
        Furnishing::Stove => "kamado",
        Furnishing::Well => "well",
        // An alcove is a rectangle like that of a mat; the language has no hearths and privies.
        Furnishing::Alcove | Furnishing::Hearth | Furnishing::Privy => return None,
    })
}

fn judge(plan: &Plan, shape: &hsd::plan::shape::Shape, score: &mut Score) {
    let right = shape.cells.iter().map(|c| c.0).max().unwrap() + 1;
    let front = shape.cells.iter().map(|c| c.1).max().unwrap() + 1;
    if (right - shape.cells.iter().map(|c| c.0).min().unwrap()) != plan.width {
        return;
    }
    score.plans += 1;
    let place = |p: Point| (right - p.0, front - p.1);
    let area = |t: &inside::Found| {
        let (u, v) = t.at;
        [place((u + t.size.0, v + t.size.1)), place((u, v))]
    };
    let truth = plan
        .fixtures
        .iter()
        .filter_map(|f| Some((name(f.what)?, [f.area.from, f.area.to])));
    let truth: Vec<(&str, [Point; 2])> = truth.collect();
    let found: Vec<(&str, [Point; 2])> = shape
        .things
        .iter()
        .map(|t| (t.kind.name(), area(t)))
        .collect();
    for t in &truth {
        let count = score.things.entry(t.0).or_default();
        count[0] += 1;
        count[1] += usize::from(found.contains(t));
    }
    for f in found.iter().filter(|f| !truth.contains(f)) {
        score.things.entry(f.0).or_default()[2] += 1;
    }
    for (k, floor) in &shape.floors {
        // The room of most of its cells.
        let within = |room: &&drawings::RoomTruth| {
            let cells = shape.rooms[*k].iter().filter(|(u, v)| {
                let (a, b) = place((u + 1, v + 1));
                room.area.cells().any(|c| c == (a, b))
            });
            cells.count()
        };
        let Some(room) = plan.rooms.iter().max_by_key(within) else {
            continue;
        };
        let right = match floor {
            inside::Floor::Tatami => room.floor == Floor::Tatami,
            inside::Floor::Boards => matches!(room.floor, Floor::Board | Floor::Veranda),
            inside::Floor::Earth => room.floor == Floor::Earth,
        };
        let count = score.floors.entry(floor.name()).or_default();
        count[0] += 1;
        count[1] += usize::from(right);
    }
}

fn trial(convention: Convention, way: Degradation) -> Score {
    let (first, plans) = (number("HSD_PLAN_SEED", 100) as u64, number("HSD_PLANS", 4));
    let sum = Mutex::new(Score::default());
    on_all_processors(plans, |k| {
        let seed = first + k as u64;
        let px = 26.0 + (seed * 7919 % 35) as f32;
        if let Ok(found) = find(drawing(seed, convention, way, px)) {
            judge(
                &drawings::plan(seed),
                &found.shape,
                &mut sum.lock().unwrap(),
            );
        }
        vec![]
    });
    let score = sum.into_inner().unwrap();
    println!("{convention:?} {way:?}: {score:?}");
    score
}

/// Fails if fewer of all things than a share were found, per cent, or more were found that are none.
fn holds(convention: Convention, way: Degradation, least: usize) {
    let score = trial(convention, way);
    let sum = |k: usize| score.things.values().map(|c| c[k]).sum::<usize>();
    let (all, found, none) = (sum(0), sum(1), sum(2));
    assert!(all > 0, "there is nothing to find");
    assert!(found * 100 >= all * least, "{found} of {all}: {score:?}");
    assert!(none * 4 <= all, "{none} beside {all}: {score:?}");
    if let Some([told, right]) = score.floors.get("boards") {
        assert!(right * 10 >= told * 8, "{score:?}");
    }
}

#[test]
#[ignore = "takes long; `.ci/nightly tests` runs it"]
fn things_are_found_in_survey_drawings() {
    holds(Convention::Survey, Degradation::Clean, 65);
}

#[test]
#[ignore = "takes long; `.ci/nightly tests` runs it"]
fn things_are_found_in_scans() {
    holds(Convention::Survey, Degradation::Scanned, 50);
}

#[test]
#[ignore = "takes long; `.ci/nightly tests` runs it"]
fn things_are_found_in_sashizu() {
    holds(Convention::Sashizu, Degradation::Clean, 60);
}

#[test]
#[ignore = "takes long; `.ci/nightly tests` runs it"]
fn things_are_found_in_photographs() {
    holds(Convention::Sashizu, Degradation::Photographed, 50);
}

#[test]
#[ignore = "takes long; `.ci/nightly tests` runs it"]
fn next_to_nothing_is_found_where_nothing_is_drawn() {
    for way in [Degradation::Clean, Degradation::Scanned] {
        let score = trial(Convention::Itazu, way);
        let found: usize = score.things.values().map(|c| c[1] + c[2]).sum();
        assert!(found <= 1 + score.plans / 2, "{score:?}");
    }
}
