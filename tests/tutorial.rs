//! The tutorial in its two languages: the same texts, commands and pictures, and every text builds what is said of it.

use crate::support::{assert_none, compile, flaws, root};
use hsd::diagnostic::Code;
use serde_json::Value;
use std::fs;
use std::process::Command;

const FOLDER: &str = "grammar";

fn page(name: &str) -> String {
    fs::read_to_string(root().join(FOLDER).join(name)).expect("the tutorial is there")
}

/// What stands between fences, with the word behind the first ones.
fn fenced(text: &str) -> Vec<&str> {
    text.split("```").skip(1).step_by(2).collect()
}

/// Where links and pictures lead, without the ends of pages.
fn links(text: &str) -> Vec<&str> {
    let behind = text.split("](").skip(1);
    let links = behind.filter_map(|rest| rest.split(')').next());
    links
        .map(|link| link.split('#').next().unwrap_or(link))
        .collect()
}

/// The texts with the names that stand before them.
fn texts(page: &str) -> Vec<(&str, &str)> {
    let mut found = vec![];
    let pieces: Vec<&str> = page.split("```").collect();
    for pair in pieces.windows(2).step_by(2) {
        let body = pair[1]
            .strip_prefix("text\n")
            .or(pair[1].strip_prefix("xml\n"));
        let name = pair[0].rsplit('`').nth(1).unwrap_or("");
        found.extend(body.map(|body| (name, body)));
    }
    found
}

#[test]
fn both_languages_show_the_same() {
    let (english, japanese) = (page("tutorial.md"), page("tutorial.ja.md"));
    assert_eq!(fenced(&english), fenced(&japanese));
    let headings = |text: &str| text.lines().filter(|l| l.starts_with("## ")).count();
    assert_eq!(headings(&english), headings(&japanese));
    let pictures = |text: &str| -> Vec<String> {
        let all = links(text).into_iter().map(str::to_owned);
        all.filter(|l| l.ends_with(".jpg")).collect()
    };
    assert_eq!(pictures(&english), pictures(&japanese));
    for text in [&english, &japanese] {
        for link in links(text) {
            assert!(root().join(FOLDER).join(link).exists(), "{link}");
        }
    }
}

#[test]
fn the_language_is_shown_by_the_same_texts() {
    let (english, japanese) = (page("README.md"), page("README.ja.md"));
    let (en, ja) = (fenced(&english), fenced(&japanese));
    assert!(ja.len() > 3);
    for text in &ja {
        assert!(en.contains(text), "not in English:\n{text}");
    }
    for link in links(&japanese) {
        assert!(root().join(FOLDER).join(link).exists(), "{link}");
    }
}

#[test]
fn every_text_builds_what_is_said() {
    let page = page("tutorial.md");
    let texts = texts(&page);
    let names: Vec<&str> = texts.iter().map(|(name, _)| *name).collect();
    let all = [
        "wall.hsd",
        "first.hsd",
        "two.hsd",
        "rows.hsd",
        "shop.hsd",
        "street.hsd",
        "home.hsd",
    ];
    assert_eq!(names, all);
    for (name, text) in &texts {
        let run = compile(name, text.as_bytes());
        let codes: Vec<Code> = run.diagnostics.iter().map(|d| d.code).collect();
        let said = if *name == "wall.hsd" {
            vec![Code(404)]
        } else {
            vec![]
        };
        assert_eq!(codes, said, "{name}: {}", run.short());
        assert_none(&flaws(&run));
        let houses = run.building.houses.len();
        assert_eq!(houses, if *name == "street.hsd" { 5 } else { 1 }, "{name}");
    }
}

#[test]
fn the_mistake_shows_the_message_that_is_promised() {
    let page = page("tutorial.md");
    let texts = texts(&page);
    let (_, first) = texts[1];
    let shorter = first.trim_end().strip_suffix("KSK").expect("it ends so");
    let run = compile("first.hsd", shorter.as_bytes());
    let codes: Vec<Code> = run.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, [Code(401)]);
}

/// What the parts of a house's walls are, in their order.
fn parts(text: &str) -> Vec<String> {
    let run = compile("house.hsd", text.as_bytes());
    let scene = serde_json::to_value(&run.scene.nodes).expect("nodes are plain data");
    let mut found = vec![];
    codes(&scene, &mut found);
    found
}

fn codes(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            let code = map.get("code").and_then(Value::as_str);
            found.extend(code.map(str::to_owned));
            map.values().for_each(|v| codes(v, found));
        }
        Value::Array(list) => list.iter().for_each(|v| codes(v, found)),
        _ => {}
    }
}

#[test]
fn both_forms_have_the_same_parts() {
    let page = page("tutorial.md");
    let texts = texts(&page);
    let (two, rows) = (parts(texts[2].1), parts(texts[3].1));
    assert!(two.len() > 30, "{two:?}");
    assert_eq!(two, rows);
}

/// The page that leads from a map to a town: its texts are written, its commands run one after another beside the maps that
/// it names, and they print what is shown.
#[test]
fn a_map_becomes_the_town_that_is_told_of() {
    let page = page("first-town.md");
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["block-houses.geojson", "block-roads.geojson", "shares.csv"] {
        assert!(
            page.contains(&format!("(../examples/towns/{name})")),
            "{name}"
        );
        let from = root().join("examples/towns").join(name);
        fs::copy(from, folder.path().join(name)).expect("is there");
    }
    for (name, text) in texts(&page) {
        fs::write(folder.path().join(name), text).expect("is written");
    }
    let mut ran = 0;
    for shown in fenced(&page)
        .iter()
        .filter_map(|f| f.strip_prefix("console\n"))
    {
        for command in shown.split("$ ").skip(1) {
            let (line, printed) = command.split_once('\n').expect("has a line");
            let words: Vec<&str> = line.split_whitespace().skip(1).collect();
            if words[0] == "view" {
                continue;
            }
            let done = Command::new(env!("CARGO_BIN_EXE_hsd"))
                .args(&words)
                .current_dir(folder.path())
                .env("LC_ALL", "C")
                .output()
                .expect("runs");
            let said = [done.stderr, done.stdout].concat();
            let said = String::from_utf8_lossy(&said);
            assert!(done.status.success(), "{line}: {said}");
            if !printed.trim().is_empty() {
                assert_eq!(said.trim(), printed.trim(), "{line}");
            }
            ran += 1;
        }
    }
    assert_eq!(ran, 6);
    // What is said of the years.
    let types = |name: &str| -> Vec<String> {
        let table = fs::read_to_string(folder.path().join(name)).expect("is written");
        let cells = table
            .lines()
            .skip(1)
            .map(|line| line.split(',').collect::<Vec<_>>());
        cells.map(|c| format!("{} {}", c[0], c[3])).collect()
    };
    let (old, new) = (types("1928.decisions.csv"), types("1998.decisions.csv"));
    let changed: Vec<&String> = new.iter().filter(|one| !old.contains(one)).collect();
    assert_eq!(changed, ["n1 kanban", "n2 kanban", "n5 kanban"]);
    assert!(old.contains(&"s4 chu-nikai".to_owned()) && old.contains(&"k1 kura".to_owned()));
}
