//! The README in its two languages: the same commands, texts and pictures, and a first house that does what it says.

mod support;

use hsd::diagnostic::Code;
use std::fs;
use support::{compile, root};

fn readme(name: &str) -> String {
    fs::read_to_string(root().join(name)).expect("the README is there")
}

/// What stands between fences, with the words behind the first ones.
fn fenced(text: &str) -> Vec<&str> {
    text.split("```").skip(1).step_by(2).collect()
}

/// Where links and pictures lead.
fn links(text: &str) -> Vec<&str> {
    let behind = text.split("](").skip(1);
    behind.filter_map(|rest| rest.split(')').next()).collect()
}

#[test]
fn both_languages_show_the_same() {
    let (english, japanese) = (readme("README.md"), readme("README.ja.md"));
    assert_eq!(fenced(&english), fenced(&japanese));
    let (mut en, mut ja) = (links(&english), links(&japanese));
    assert_eq!((en.remove(0), ja.remove(0)), ("README.ja.md", "README.md"));
    assert_eq!(en, ja);
    let headings = |text: &str| text.lines().filter(|l| l.starts_with('#')).count();
    assert_eq!(headings(&english), headings(&japanese));
    let rows = |text: &str| text.lines().filter(|l| l.starts_with('|')).count();
    assert_eq!(rows(&english), rows(&japanese));
}

#[test]
fn links_lead_somewhere() {
    for name in ["README.md", "README.ja.md"] {
        let text = readme(name);
        let local = links(&text).into_iter().filter(|l| !l.contains("://"));
        for link in local {
            assert!(root().join(link).exists(), "{name}: {link}");
        }
    }
}

#[test]
fn the_first_house_does_what_is_said() {
    let text = readme("README.md");
    let blocks = fenced(&text);
    let texts = blocks.iter().filter_map(|b| b.strip_prefix("text\n"));
    let texts: Vec<&str> = texts.collect();
    let [machiya, wall, house, upper] = texts[..] else {
        panic!("four texts in the README, not {}", texts.len());
    };
    let codes = |text: &str| -> Vec<Code> {
        let run = compile("first.hsd", text.as_bytes());
        run.diagnostics.iter().map(|d| d.code).collect()
    };
    assert_eq!(codes(machiya), []);
    assert_eq!(codes(wall), [Code(404)]);
    assert_eq!(codes(house), []);
    let shorter = house.replacen("KSK  MRE", "MRE", 1);
    assert_eq!(codes(&shorter), [Code(401)]);
    // The fourth line begins the text of the upper storey again.
    let ground = house.trim_end().rsplit_once('\n').expect("has lines").0;
    let two = format!("{}\n{upper}", ground.replacen("9.5", "9.5 8", 1));
    let run = compile("first.hsd", two.as_bytes());
    assert!(!run.has_errors(), "{}", run.short());
    assert_eq!(run.building.shell.houses[0].storeys.len(), 2);
}
