//! Every flight of stairs stands on something, and no two stand in each other: in the examples, the house types and
//! monuments of many measures.

use crate::support::{assert_none, compile, compile_file, on_all_processors, stem, texts};
use glam::DVec2;
use hsd::building::Built;
use hsd::building::fittings::{FittingKind, Platform, Stairs};

/// The flights of a house with what they belong to, and its platform.
fn flights(house: &Built) -> (Vec<(&'static str, &Stairs)>, Option<&Platform>) {
    let (mut found, mut platform) = (vec![], None);
    for fitting in &house.fittings {
        match &fitting.what {
            FittingKind::Platform(it) => {
                platform = Some(it);
                found.extend(it.stairs.iter().map(|s| ("platform", s)));
            }
            FittingKind::Veranda(it) => found.extend(it.stairs.iter().map(|s| ("veranda", s))),
            _ => {}
        }
    }
    (found, platform)
}

/// The flights that end in the air, and those that share room.
fn findings(house: &Built) -> Vec<String> {
    let ground = -house.house.raised;
    let (flights, platform) = flights(house);
    let mut found = vec![];
    for (what, flight) in &flights {
        let foot = flight.z.0;
        let on_platform = platform.is_some_and(|p| {
            let [.., right, left] = flight.plan();
            let on = |q: DVec2| hsd::geometry::holds(&p.outline, q);
            (foot - p.z.1).abs() < 1e-6 && on(right) && on(left)
        });
        if (foot - ground).abs() > 1e-6 && !on_platform {
            found.push(format!(
                "a flight of the {what} ends {:.2} m above the ground",
                foot - ground
            ));
        }
    }
    for (i, (_, a)) in flights.iter().enumerate() {
        for (_, b) in &flights[i + 1..] {
            if overlap(a, b) {
                found.push(format!(
                    "flights at {} and {} stand in each other",
                    a.at, b.at
                ));
            }
        }
    }
    found
}

/// Whether two flights share room: their plans are rectangles, which some axis of theirs keeps apart or not.
fn overlap(a: &Stairs, b: &Stairs) -> bool {
    let apart = |way: DVec2| {
        let range = |s: &Stairs| {
            let all = s.plan().map(|p| p.dot(way));
            (
                all.into_iter().fold(f64::MAX, f64::min),
                all.into_iter().fold(f64::MIN, f64::max),
            )
        };
        let ((a0, a1), (b0, b1)) = (range(a), range(b));
        a1 < b0 + 1e-6 || b1 < a0 + 1e-6
    };
    ![a.out, a.out.perp(), b.out, b.out.perp()]
        .into_iter()
        .any(apart)
}

#[test]
fn every_flight_stands_on_something() {
    let paths: Vec<_> = ["examples", "library"]
        .into_iter()
        .flat_map(texts)
        .collect();
    let all = on_all_processors(paths.len(), |i| {
        let run = compile_file(&paths[i]);
        let of = |f: String| format!("{}: {f}", stem(&paths[i]));
        run.building
            .houses
            .iter()
            .flat_map(findings)
            .map(of)
            .collect()
    });
    assert_none(&all);
}

#[test]
fn flights_of_monuments_of_any_measure_stand() {
    let all = on_all_processors(crate::support::part_of(100), |i| {
        // Three short forms a round, their measures from its number.
        let share = |k: usize| (i * (2 * k + 7) % 23) as f64 / 22.0;
        let (platform, margin) = (6.0 * share(0), 2.0 + 14.0 * share(1));
        let (veranda, floor) = (2.0 + 5.0 * share(2), 0.5 + 6.0 * share(3));
        let bay = 5.0 + 12.0 * share(4);
        let text = format!(
            "<Houses><House><Hall bay=\"{bay}\" platform=\"{platform}\" margin=\"{margin} {margin}\" veranda=\"{veranda}\" floor=\"{floor}\"/></House>\
             <House x=\"200\"><Shrine bay=\"{bay}\" veranda=\"{veranda}\" floor=\"{floor}\"/></House>\
             <House x=\"400\"><Pagoda platform=\"{platform}\"/></House></Houses>"
        );
        let run = compile("monuments.hsd", text.as_bytes());
        assert!(!run.has_errors(), "{text}{}", run.short());
        let of = |f: String| format!("{text}: {f}");
        run.building
            .houses
            .iter()
            .flat_map(findings)
            .map(of)
            .collect()
    });
    assert_none(&all);
}
