//! The roofs of a house are the same alone and in any company. A tile of a town, a thread, or a view that builds one house
//! again relies on it: no search budget, cache, counter or name may pass from house to house.

use crate::robust::heaps::{comb, stair};
use crate::support::{Numbers, Run, assert_none, compile, texts};
use crate::twins::built;
use std::collections::BTreeSet;
use std::fs;

/// A house of the legacy form, without the line that ends it, and its roofs where nothing else is in the file.
struct Alone {
    text: String,
    roofs: String,
}

impl Alone {
    /// `None` where the text makes more than one house, or none.
    fn of(text: &str) -> Option<Alone> {
        let run = compile("alone.hsd", text.as_bytes());
        let [roofs] = &run.building.roofs[..] else {
            return None;
        };
        let text = text.trim_end().to_owned();
        let roofs = built(roofs);
        Some(Alone { text, roofs })
    }
}

/// Everything that the examples build in the legacy form, and plans of many corners with each way to cut them.
fn houses() -> Vec<Alone> {
    let mut all = vec![];
    for path in texts("examples") {
        let text = fs::read_to_string(&path).expect("examples are UTF-8");
        if !text.trim_start().starts_with('<') {
            all.extend(text.split("\n%\n").map(str::to_owned));
        }
    }
    let combs = (2..9).map(|teeth| String::from_utf8(comb(teeth)).expect("is ASCII"));
    let stairs = (2..13).map(|steps| stair(steps, 0).replace("%\n", ""));
    for plan in combs.chain(stairs) {
        for method in ["", "method kd\n", "method least-cut\n", "method skeleton\n"] {
            all.push(plan.replacen("\n\n", &format!("\n{method}\n"), 1));
        }
    }
    all.iter().filter_map(|text| Alone::of(text)).collect()
}

/// The houses of a file that holds these after each other.
fn together(houses: &[&Alone]) -> Run {
    let texts: Vec<&str> = houses.iter().map(|house| &*house.text).collect();
    compile("together.hsd", texts.join("\n%\n").as_bytes())
}

/// Reports the houses whose roofs are others in company.
fn changed(name: &str, houses: &[&Alone]) -> Vec<String> {
    let roofs = together(houses).building.roofs;
    assert_eq!(roofs.len(), houses.len(), "{name}");
    let pairs = houses.iter().zip(&roofs).enumerate();
    let changed = pairs.filter(|(_, (house, roofs))| house.roofs != built(roofs));
    changed
        .map(|(n, (house, _))| format!("{name}: house {n} has other roofs\n{}", house.text))
        .collect()
}

#[test]
fn roofs_are_the_same_in_any_company() {
    let houses = houses();
    let different: BTreeSet<&String> = houses.iter().map(|house| &house.roofs).collect();
    assert!(different.len() > 40, "{} kinds of roofs", different.len());

    let mut order: Vec<&Alone> = houses.iter().collect();
    let mut findings = changed("in order", &order);
    order.reverse();
    findings.extend(changed("in reverse", &order));
    let doubled: Vec<&Alone> = order.iter().flat_map(|house| [*house; 2]).collect();
    findings.extend(changed("each twice in a row", &doubled));

    let mut numbers = Numbers(16);
    for round in 0..40 {
        let company: Vec<&Alone> = (0..12).map(|_| numbers.of(&order)).copied().collect();
        findings.extend(changed(&format!("company {round}"), &company));
    }
    assert_none(&findings);
}
