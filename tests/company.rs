//! The roofs of a house are the same alone and in any company. A tile of a town, a thread, or a view that builds one house
//! again relies on it: no search budget, cache, counter or name may pass from house to house.

use crate::robust::heaps::{comb, stair};
use crate::support::{Numbers, Run, assert_none, compile, texts};
use crate::twins::built;
use hsd::Options;
use hsd::ast::Document;
use hsd::building::{Building, Built};
use hsd::catalog::Catalog;
use hsd::diagnostic::Diagnostics;
use hsd::driver::{self, Checked, Compiled, HouseBuilder, HouseContext, HouseId};
use hsd::program::Program;
use hsd::roof::RoofCache;
use hsd::roof::budget::SearchBudget;
use hsd::scene::Scene;
use hsd::source::{FileId, NoFiles, Source, World};
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
        let [house] = &run.building.houses[..] else {
            return None;
        };
        let text = text.trim_end().to_owned();
        let roofs = built(&house.roofs);
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
    let built_together = together(houses).building.houses;
    assert_eq!(built_together.len(), houses.len(), "{name}");
    let pairs = houses.iter().zip(&built_together).enumerate();
    let changed = pairs.filter(|(_, (house, other))| house.roofs != built(&other.roofs));
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

/// The search for the best cuts of a plan has a budget. Houses that use up all of theirs leave that of the next alone.
#[test]
fn houses_that_search_long_take_nothing_from_the_next() {
    let houses = houses();
    let long: Vec<Alone> = (0..40)
        .filter_map(|higher| Alone::of(&stair(30, higher).replace("%\n", "")))
        .collect();
    assert_eq!(long.len(), 40);
    let company: Vec<&Alone> = long.iter().chain(&houses).collect();
    assert_none(&changed("after forty stairs", &company));
}

/// A house that is made alone, from its syntax and its id, is that of the run to the last bit, its places, draws and
/// diagnostics included.
#[test]
fn a_house_made_alone_is_the_one_of_the_run() {
    let mut findings = vec![];
    for path in texts("examples")
        .into_iter()
        .chain(texts("tests/suite/diagnostics"))
    {
        let name = crate::support::stem(&path);
        let source = Source::new(FileId(0), &name, &fs::read(&path).expect("can be read"));
        let (options, mut ignored) = (Options::default(), Diagnostics::new());
        let mut read = driver::documents(&[&source], &NoFiles, &options, &mut ignored);
        let (catalog, document) = (&read.catalog, read.documents.remove(0));
        let context = |index: usize| HouseContext {
            source: &source,
            scope: catalog.known_in(0, index),
            variant: None,
        };
        let expand = &options.expand;
        let (mut together, mut alone) = (Diagnostics::new(), Diagnostics::new());
        let mut run = HouseBuilder::new(catalog, &NoFiles, expand);
        for (index, house) in document.houses.iter().enumerate() {
            let (id, context) = (HouseId(index as u64), context(index));
            let known = (&**catalog, &NoFiles as &dyn World);
            let single = driver::house(house, id, context, known, expand, &mut alone);
            let of_run = run.house(house, id, context, &mut together);
            if json(&single.map(|(built, _)| built)) != json(&of_run) {
                findings.push(format!("{name}: house {index} is another alone"));
            }
        }
        if alone.into_sorted() != together.into_sorted() {
            findings.push(format!("{name}: other diagnostics"));
        }
    }
    assert_none(&findings);
}

fn json(built: &Option<Built>) -> String {
    serde_json::to_string(built).expect("is plain data")
}

/// Houses may be made on any thread, and what they are made of may be handed from one to another.
#[test]
fn the_chain_can_move_between_threads() {
    fn is_send<T: Send>() {}
    fn is_shared<T: Send + Sync>() {}
    is_shared::<&dyn World>();
    is_shared::<Source>();
    is_shared::<Catalog>();
    is_shared::<Document>();
    is_shared::<Program>();
    is_shared::<Building>();
    is_shared::<Scene>();
    is_shared::<Diagnostics>();
    is_send::<HouseBuilder<'_>>();
    is_send::<RoofCache>();
    is_send::<SearchBudget>();
    is_send::<Compiled>();
    is_send::<Checked>();
}
