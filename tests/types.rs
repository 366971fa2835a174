//! The types of houses: every one builds for every value of its parameters, and is what the historians say of it.

use crate::support::Words;
use crate::support::{Numbers, Run, assert_none, flaws, on_all_processors, root};
use hsd::ast::{Parameter, Value};
use hsd::diagnostic::{Diagnostics, Severity};
use hsd::scene::Detail;
use hsd::source::{FileId, NoFiles, Source};
use hsd::templates::{TYPES, Template};
use hsd::{Options, driver};
use std::collections::BTreeSet;

/// Random combinations of parameters a type.
const SAMPLES: usize = 60;

type Setting = Vec<(String, String)>;

fn text(word: &str) -> String {
    Template::named(word).expect("is a type").text()
}

/// The chain on a text with these parameters.
fn built(text: &str, parameters: &Setting, detail: Detail) -> Run {
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "type.hsd", text.as_bytes());
    let options = Options {
        parameters: parameters.clone(),
        detail,
        ..Options::default()
    };
    let made = hsd::compile(&[&source], &NoFiles, &options, &mut out);
    Run {
        source,
        included: made.included,
        diagnostics: out.into_sorted(),
        catalog: made.catalog,
        building: made.building,
        scene: made.scene,
    }
}

fn with(word: &str, pairs: &[(&str, &str)]) -> Run {
    let owned = pairs
        .iter()
        .map(|(n, v)| ((*n).to_owned(), (*v).to_owned()));
    let run = built(&text(word), &owned.collect(), Detail::Body);
    assert!(!run.has_errors(), "{}", run.short());
    run
}

fn parameters(text: &str) -> Vec<Parameter> {
    let source = Source::new(FileId(0), "type.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    let read = driver::documents(&[&source], &NoFiles, &Options::default(), &mut out);
    read.documents
        .into_iter()
        .flat_map(|d| d.parameters)
        .collect()
}

/// Every listed value, or the ends, the middle and what lies between.
fn values(of: &Parameter) -> Vec<String> {
    if !of.choices.is_empty() {
        return of.choices.iter().map(Value::to_string).collect();
    }
    if let Some(Value::Truth(_)) = of.default {
        return vec!["yes".into(), "no".into()];
    }
    let (least, most) = (
        of.min.expect("has a least value"),
        of.max.expect("has a greatest"),
    );
    let step = of.step.expect("has a step");
    let steps = ((most - least) / step).round() as usize;
    let at = |k: usize| ((least + step * k as f64) * 1e9).round() / 1e9;
    let some = 6.min(steps);
    let mut found: BTreeSet<usize> = (0..=some).map(|k| k * steps / some.max(1)).collect();
    found.insert(steps);
    found.into_iter().map(|k| at(k).to_string()).collect()
}

/// Every value of every parameter alone, then combinations at random.
fn settings(of: &[Parameter], seed: u64) -> Vec<Setting> {
    let mut all = vec![vec![]];
    for p in of {
        all.extend(values(p).into_iter().map(|v| vec![(p.name.clone(), v)]));
    }
    let mut numbers = Numbers(seed);
    for _ in 0..crate::support::part_of(SAMPLES) {
        let draw = |p: &Parameter| {
            let value = match (&p.choices[..], p.min, p.max, p.step) {
                ([], Some(least), Some(most), Some(step)) => {
                    let k = numbers.below(((most - least) / step).round() as usize + 1);
                    (((least + step * k as f64) * 1e9).round() / 1e9).to_string()
                }
                _ => numbers.of(&values(p)).clone(),
            };
            (p.name.clone(), value)
        };
        all.push(of.iter().map(draw).collect());
    }
    all
}

/// What is wrong with a house that was built: anything worse than a note, a walk that does not close, a solid that is
/// not tight.
fn complaints(run: &Run) -> Vec<String> {
    let mut found = vec![];
    let bad = |s: Severity| s != Severity::Note;
    if run.diagnostics.iter().any(|d| bad(d.severity)) {
        found.push(run.short());
    }
    for house in run.building.houses.iter().map(|b| &b.house) {
        let rings = house.storeys.iter().flat_map(|s| &s.rings);
        let open = rings.filter(|r| !r.closed && !r.inner).count();
        if open > 0 {
            found.push(format!("{}: {open} rings are open", house.name));
        }
    }
    found.extend(flaws(run));
    found
}

#[test]
fn every_type_builds_for_every_value_of_its_parameters() {
    let findings = on_all_processors(TYPES.len(), |index| {
        let word = TYPES[index].word;
        let text = text(word);
        let all = settings(&parameters(&text), index as u64);
        let mut findings = vec![];
        for setting in all {
            let run = built(&text, &setting, Detail::Body);
            let found = complaints(&run);
            let said: Vec<String> = setting.iter().map(|(n, v)| format!("{n}={v}")).collect();
            let said = said.join(" ");
            findings.extend(found.into_iter().map(|f| format!("{word} {said}: {f}")));
            if findings.len() > 5 {
                break;
            }
        }
        findings
    });
    assert_none(&findings);
}

#[test]
fn every_type_is_whole_in_all_its_joinery() {
    let findings = on_all_processors(TYPES.len(), |index| {
        let word = TYPES[index].word;
        let run = built(&text(word), &vec![], Detail::Everything);
        let mut found = complaints(&run);
        // As it stands nobody finds anything to say of it.
        found.extend(run.diagnostics.iter().map(|d| d.message.en()));
        found.into_iter().map(|f| format!("{word}: {f}")).collect()
    });
    assert_none(&findings);
}

/// The types of one house that have rooms.
pub(crate) fn with_rooms() -> Vec<&'static str> {
    let inside = |t: &&Template| parameters(&t.text()).iter().any(|p| p.name == "rooms");
    TYPES.iter().filter(inside).map(|t| t.word).collect()
}

/// A type with its rooms, as it is or with another parameter.
pub(crate) fn roomy(word: &str, other: bool) -> Run {
    let mut setting = vec![("rooms".to_owned(), "yes".to_owned())];
    if other {
        let other = match word {
            "hei-tsuki" => ("gate", "left"),
            "kanban" => ("frontage", "4.5"),
            "kura" => ("storeys", "1"),
            "ura-nagaya" => ("munewari", "yes"),
            "buke-nagaya" => ("gate", "yes"),
            _ => ("mirrored", "yes"),
        };
        setting.push((other.0.to_owned(), other.1.to_owned()));
    }
    built(&text(word), &setting, Detail::Everything)
}

/// The types of one house with their rooms: nothing is said of them, and whoever enters gets into each.
#[test]
fn types_with_rooms_are_whole_in_all_their_joinery() {
    let inside = with_rooms();
    assert_eq!(inside.len(), 10);
    let findings = on_all_processors(2 * inside.len(), |index| {
        let word = inside[index / 2];
        let run = roomy(word, index % 2 == 1);
        let mut found = complaints(&run);
        found.extend(run.diagnostics.iter().map(|d| d.message.en()));
        let houses = || run.building.houses.iter();
        let written: usize = houses()
            .flat_map(|b| &b.house.storeys)
            .map(|s| s.rooms.len())
            .sum();
        let named = houses().flat_map(|b| &b.rooms);
        let named = named.filter(|r| !r.name.is_empty()).count();
        if written == 0 || named != written {
            found.push(format!("{named} of {written} rooms are built"));
        }
        found.into_iter().map(|f| format!("{word}: {f}")).collect()
    });
    assert_none(&findings);
}

#[test]
fn every_parameter_says_what_it_is_and_may_be() {
    let mut findings = vec![];
    for t in TYPES {
        let all = parameters(&t.text());
        assert!(all.len() >= 5, "{}", t.word);
        for p in all {
            let bounded =
                p.min.is_some() && p.max.is_some() && p.step.is_some() && p.unit.is_some();
            let truth = matches!(p.default, Some(Value::Truth(_)));
            if p.doc.is_none() || p.default.is_none() || !(bounded || truth || p.choices.len() > 1)
            {
                findings.push(format!("{}: {}", t.word, p.name));
            }
        }
    }
    assert_none(&findings);
}

#[test]
fn every_text_of_the_folder_is_a_type_with_its_names() {
    for path in crate::support::texts("library") {
        let word = crate::support::stem(&path);
        let text = std::fs::read_to_string(&path).expect("can be read");
        if ["fronts", "grounds", "outlines", "plans"].contains(&&*word) {
            continue;
        }
        let t = Template::named(&word).unwrap_or_else(|| panic!("{word} is no type"));
        assert!(text.contains(t.ja), "{word} does not say {}", t.ja);
        assert!(text.contains("Sources:"), "{word} names no source");
    }
    assert!(root().join("library/fronts.hsd").is_file());
}

/// Front and upper floor, chosen apart (000-55): at least a hundred fronts of each type of town house.
#[test]
fn town_houses_have_a_hundred_fronts() {
    for (word, names) in [
        ("chu-nikai", ["front", "storey"]),
        ("so-nikai", ["front", "storey"]),
        ("sangai", ["front", "storey"]),
        ("shimotaya", ["front", "storey"]),
        ("hei-tsuki", ["front", "storey"]),
        ("office", ["front", "cladding"]),
        ("modern-house", ["front", "upper"]),
    ] {
        let all = parameters(&text(word));
        let of = |name: &str| {
            let found = all.iter().find(|p| p.name == name);
            values(found.expect("has the parameter"))
        };
        let (below, above) = (of(names[0]), of(names[1]));
        assert!(below.len() >= 10 && above.len() >= 10, "{word}");
        // No two are the same wall.
        let mut seen = BTreeSet::new();
        for (name, values) in [(names[0], &below), (names[1], &above)] {
            for value in values {
                let mut set = vec![(name, &**value)];
                if word != "office" {
                    set.push(("frontage", "7"));
                }
                let run = with(word, &set);
                let houses = run.building.houses.iter().map(|b| &b.house);
                let walls = houses
                    .flat_map(|h| &h.storeys)
                    .flat_map(|s| &s.rings)
                    .flat_map(|r| r.walls.first());
                let units: Vec<_> = walls
                    .map(|w| {
                        w.units
                            .iter()
                            .map(|u| (u.content.clone(), u.width))
                            .collect::<Vec<_>>()
                    })
                    .collect();
                seen.insert(format!("{units:?}"));
            }
        }
        // The defaults of both lists are one wall.
        assert_eq!(seen.len(), below.len() + above.len() - 1, "{word}");
    }
}

fn size(run: &Run) -> glam::DVec2 {
    let house = &run.building.houses[0].house;
    let corners = house.storeys[0].rings[0].corners();
    let (lo, hi) = corners
        .iter()
        .fold((glam::DVec2::MAX, glam::DVec2::MIN), |(l, h), p| {
            (l.min(*p), h.max(*p))
        });
    (hi - lo) * house.unit
}

/// Top of the highest roof, metres above the eaves of its walls.
fn rise(run: &Run) -> f64 {
    let points = run.building.houses[0]
        .roofs
        .roofs
        .iter()
        .flat_map(|r| &r.solids)
        .flat_map(|s| &s.points);
    let top = points.map(|p| p.z).fold(f64::MIN, f64::max);
    let house = &run.building.houses[0].house;
    top - house.storeys.last().expect("has storeys").z1
}

#[test]
fn frontage_is_filled_exactly_and_depth_is_capped() {
    for (word, cap) in [
        ("chu-nikai", 12.0),
        ("so-nikai", 8.0),
        ("sangai", 8.0),
        ("hiraya", 8.0),
        ("shimotaya", 8.0),
        ("kanban", 8.0),
        ("hei-tsuki", 8.0),
    ] {
        for frontage in ["7", "7.7", "8.6"] {
            let run = with(word, &[("frontage", frontage), ("depth", "40")]);
            let found = size(&run);
            let wanted: f64 = frontage.parse().expect("is a number");
            assert!((found.x - wanted).abs() < 1e-6, "{word}: {found}");
            assert!((found.y - cap).abs() < 1e-6, "{word}: {found}");
        }
        let run = with(word, &[("depth", "6.5")]);
        assert!((size(&run).y - 6.5).abs() < 1e-6, "{word}: {}", size(&run));
    }
}

/// The pitch stays, so the ridge rises with the depth, and the eaves do not (000-19).
#[test]
fn the_ridge_rises_with_the_depth() {
    for word in [
        "chu-nikai",
        "so-nikai",
        "sangai",
        "hiraya",
        "shimotaya",
        "hei-tsuki",
    ] {
        let (near, far) = (with(word, &[("depth", "5")]), with(word, &[("depth", "8")]));
        let risen = rise(&far) - rise(&near);
        assert!((risen - 0.4 * 1.5).abs() < 0.02, "{word}: {risen}");
        let eaves = |run: &Run| run.building.houses[0].house.storeys.last().map(|s| s.z1);
        assert_eq!(eaves(&near), eaves(&far), "{word}");
    }
}

/// At 7.7 m a front is composed anew, not drawn out (000-57).
#[test]
fn wide_fronts_have_another_composition() {
    let codes = |frontage: &str| {
        let run = with("chu-nikai", &[("frontage", frontage)]);
        let wall = &run.building.houses[0].house.storeys[0].rings[0].walls[0];
        wall.units
            .iter()
            .filter(|u| (u.width - 2.0).abs() < 1e-9)
            .count()
    };
    assert_eq!(codes("7.6"), 0);
    assert_eq!(
        codes("7.7"),
        2,
        "a projecting lattice and the doors of the guests"
    );
}

#[test]
fn the_page_shows_every_type() {
    let page = std::fs::read_to_string(root().join("grammar/types.md")).expect("the page is there");
    let mut findings = vec![];
    for t in TYPES {
        let word = t.word;
        let row = page.lines().find(|l| l.contains(&format!("`{word}`")));
        let row = row.unwrap_or_default();
        for wanted in [
            t.ja.to_owned(),
            t.romaji.to_owned(),
            format!("(../library/{word}.hsd)"),
        ] {
            if !row.contains(&wanted) {
                findings.push(format!("{word}: the page lacks {wanted}"));
            }
        }
        for view in ["front", "eaves", "above"] {
            let picture = format!("pictures/types/{word}-{view}.jpg");
            if !row.contains(&picture) || !root().join("grammar").join(&picture).is_file() {
                findings.push(format!("{word}: no {picture}"));
            }
        }
    }
    assert_none(&findings);
}

/// `hsd` with these words in this folder: its exit status, output and complaints.
fn hsd(folder: &std::path::Path, words: &[&str]) -> (i32, String, String) {
    let made = std::process::Command::new(env!("CARGO_BIN_EXE_hsd"))
        .args(words)
        .env("LC_ALL", "C")
        .current_dir(folder)
        .output()
        .expect("hsd runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        made.status.code().expect("ends"),
        text(&made.stdout),
        text(&made.stderr),
    )
}

#[test]
fn new_copies_a_type_and_spares_what_is_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let (status, list, _) = hsd(folder, &["new"]);
    assert_eq!(status, 0);
    for t in TYPES {
        let line = list
            .lines()
            .find(|l| l.starts_with(t.word))
            .unwrap_or_default();
        assert!(
            line.contains(t.ja) && line.contains(t.romaji) && line.contains(t.en),
            "{line}"
        );
    }
    for name in ["kura", "土蔵", "dozo"] {
        let (status, text, said) = hsd(folder, &["new", name, "-o", "-"]);
        assert_eq!(
            (status, &*text, &*said),
            (0, &*Template::named("kura").expect("is a type").text(), "")
        );
    }
    assert_eq!(hsd(folder, &["new", "chu-nikai"]).0, 0);
    let file = folder.join("chu-nikai.hsd");
    // The copy needs no other file, and its author's work is safe.
    assert_eq!(
        hsd(folder, &["check", "chu-nikai.hsd", "-D", "warnings"]).0,
        0
    );
    std::fs::write(&file, "mine").expect("can be written");
    let (status, _, said) = hsd(folder, &["new", "chu-nikai"]);
    assert!(status == 3 && said.contains("--force"), "{status} {said}");
    assert_eq!(std::fs::read_to_string(&file).expect("is there"), "mine");
    assert_eq!(hsd(folder, &["new", "chu-nikai", "--force"]).0, 0);
    assert_eq!(
        std::fs::read_to_string(&file).expect("is there"),
        text("chu-nikai")
    );
    let (status, _, said) = hsd(folder, &["new", "nagya"]);
    assert!(
        status == 2 && said.contains("ura-nagaya (裏長屋)"),
        "{status} {said}"
    );
}
