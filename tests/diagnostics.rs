//! Every message has a fixture that triggers it, with its output beside it, and a page for `hsd explain`.
//! `HSD_UPDATE=1 cargo test --test diagnostics` writes the outputs anew.

mod support;

use hsd::diagnostic::{Code, pages};
use std::collections::BTreeSet;
use std::fs;
use support::{assert_none, compile, expect, flaws_of_diagnostics, root, stem, texts};

const FIXTURES: &str = "tests/suite/diagnostics";

/// Codes that no small text can trigger, and where they are tested.
const WITHOUT_FIXTURE: &[(u16, &str)] = &[];

/// The code at the beginning of a name such as `HSD0401_perimeter_open`.
fn code_of(name: &str) -> Option<u16> {
    name.strip_prefix("HSD")?.get(..4)?.parse().ok()
}

fn fixture_codes() -> BTreeSet<u16> {
    let names = texts(FIXTURES);
    names.iter().filter_map(|p| code_of(&stem(p))).collect()
}

#[test]
fn fixtures_say_what_they_should() {
    let mut findings = vec![];
    for path in texts(FIXTURES) {
        let name = stem(&path);
        let bytes = fs::read(&path).expect("fixtures can be read");
        let run = compile(&format!("{name}.hsd"), &bytes);
        expect(&path.with_extension("txt"), &run.short(), &mut findings);
        let Some(code) = code_of(&name) else {
            findings.push(format!("{name}: does not begin with its code"));
            continue;
        };
        if !run.diagnostics.iter().any(|d| d.code == Code(code)) {
            findings.push(format!("{name}: does not trigger {}", Code(code)));
        }
        let flaws = flaws_of_diagnostics(&run, bytes.len());
        findings.extend(flaws.iter().map(|flaw| format!("{name}: {flaw}")));
    }
    assert_none(&findings);
}

#[test]
fn every_page_is_in_the_list_and_in_order() {
    let mut wanted: Vec<(Code, String)> = vec![];
    for entry in fs::read_dir(root().join("grammar/diagnostics")).expect("pages are there") {
        let path = entry.expect("can be listed").path();
        let code = code_of(&stem(&path)).unwrap_or_else(|| panic!("{}: no code", path.display()));
        let text = fs::read_to_string(&path).expect("pages are UTF-8");
        wanted.push((Code(code), text));
    }
    wanted.sort_by_key(|(code, _)| *code);
    let mut findings = vec![];
    for (code, text) in &wanted {
        if !text.starts_with(&format!("# {code}: ")) {
            findings.push(format!("{code}.md: the first line is no title"));
        }
        if text.matches("```").count() < 2 {
            findings.push(format!("{code}.md: without an example"));
        }
        if pages::page(*code) != Some(text) {
            findings.push(format!("{code}.md: is not what pages.rs holds"));
        }
    }
    let listed: Vec<Code> = pages::PAGES.iter().map(|(code, _)| *code).collect();
    let there: Vec<Code> = wanted.iter().map(|(code, _)| *code).collect();
    if listed != there {
        findings.push(format!(
            "pages.rs lists {listed:?}, the folder holds {there:?}"
        ));
    }
    assert_none(&findings);
}

/// Codes that the messages can carry: the first number of `error(`, `warning(` and `note(`.
fn codes_in_messages() -> BTreeSet<u16> {
    let mut codes = BTreeSet::new();
    let folder = root().join("src/diagnostic/messages");
    for entry in fs::read_dir(folder).expect("messages are there") {
        let text = fs::read_to_string(entry.expect("can be listed").path()).expect("is UTF-8");
        for maker in ["error(", "warning(", "note("] {
            for (at, _) in text.match_indices(maker) {
                let rest = text[at + maker.len()..].trim_start();
                let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(0);
                codes.extend(rest[..digits].parse::<u16>().ok());
            }
        }
    }
    codes
}

#[test]
fn messages_fixtures_and_pages_belong_together() {
    let (messages, fixtures) = (codes_in_messages(), fixture_codes());
    let without: BTreeSet<u16> = WITHOUT_FIXTURE.iter().map(|(code, _)| *code).collect();
    let listed: BTreeSet<u16> = pages::PAGES.iter().map(|(code, _)| code.0).collect();
    let mut findings = vec![];
    for code in messages
        .union(&fixtures)
        .copied()
        .chain(listed.iter().copied())
    {
        let (code, name) = (code, Code(code));
        if !messages.contains(&code) {
            findings.push(format!("{name}: no message"));
        }
        if !listed.contains(&code) {
            findings.push(format!("{name}: no page"));
        }
        if fixtures.contains(&code) == without.contains(&code) {
            findings.push(format!(
                "{name}: needs either a fixture or a reason to have none"
            ));
        }
    }
    findings.sort();
    findings.dedup();
    assert_none(&findings);
}
