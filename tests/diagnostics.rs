//! Every message has a fixture that triggers it, with its output beside it, and a page for `hsd explain`.
//! The first example of a page triggers its code too. `HSD_UPDATE=1 cargo test --release diagnostics` writes the outputs
//! anew.

use crate::support::Words;
use crate::support::{
    assert_none, compile, compile_file, expect, flaws_of_diagnostics, root, stem, texts,
};
use hsd::diagnostic::{Code, Diagnostic, Text, pages};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

const FIXTURES: &str = "tests/suite/diagnostics";
const PAGES: &str = "grammar/diagnostics";

/// Codes that no small text can trigger, and where they are tested.
const WITHOUT_FIXTURE: &[(u16, &str)] = &[
    (8, "a file that is not there: tests/cli"),
    (260, "a parameter of the command line: tests/language"),
    (281, "more than 10,000 corners: tests/outlines.rs"),
    (431, "several files: tests/cli"),
    (330, "a file of parts without any: tests/catalogs.rs"),
    (331, "more than 65,534 parts: tests/catalogs.rs"),
    (601, "a file that cannot be read: tests/pictures.rs"),
    (602, "a file that is no picture: tests/pictures.rs"),
    (603, "a fault of the program: tests/pictures.rs"),
    (605, "a model made before: tests/view/models.rs"),
    (606, "a scale of the command line: tests/cli/printing.rs"),
    (901, "a file of more than 16 MiB: tests/robust.rs"),
    (903, "more than 256 files: tests/language"),
    (905, "a picture of too many pixels: tests/pictures.rs"),
    (908, "more than 10,000 variants: tests/variants.rs"),
    (910, "more than 64 MiB of files: tests/language"),
    (1103, "a map: tests/towns.rs"),
    (1104, "a map: tests/towns.rs"),
    (1105, "a map: tests/towns.rs"),
    (1106, "a map: tests/towns.rs"),
    (1107, "a map: tests/towns.rs"),
    (1108, "a map: tests/towns.rs"),
    (1109, "a map: tests/towns.rs"),
    (1110, "a map: tests/towns.rs"),
    (1112, "a map: tests/towns.rs"),
    (1115, "a map: tests/towns.rs"),
    (1117, "a map: tests/towns.rs"),
    (1118, "a map: tests/town_accounts.rs"),
    (1119, "a map: tests/town_accounts.rs"),
    (1120, "a map: tests/town_accounts.rs"),
    (1140, "a map: tests/towns.rs"),
    (1141, "a map: tests/towns.rs"),
    (1142, "a map: tests/towns.rs"),
    (1143, "a map: tests/towns.rs"),
    (1150, "a map: tests/rears.rs"),
    (1151, "a map: tests/rears.rs"),
    (1152, "a map: tests/rears.rs"),
    (1153, "a map: tests/joins.rs"),
    (1154, "a map: tests/joins.rs"),
    (1155, "a map: tests/joins.rs"),
    (1156, "a map: tests/joins.rs"),
    (1158, "a map: tests/vertices.rs"),
    (1160, "a map: tests/ground.rs"),
    (1161, "a map: tests/ground.rs"),
    (1162, "a map: tests/ground.rs"),
    (1163, "a map: tests/ground.rs"),
    (1170, "a map: tests/town_streets.rs"),
    (1171, "a map: tests/town_law.rs"),
    (1172, "a map: tests/town_works.rs"),
    (
        909,
        "more than 500 messages: tests/parse_legacy.rs, tests/parse_xml",
    ),
    (1001, "a map: tests/maps.rs"),
    (1002, "a map: tests/maps.rs"),
    (1003, "a map: tests/maps.rs"),
    (1004, "a map: tests/maps.rs"),
    (1005, "a map: tests/maps.rs"),
    (1006, "a map: tests/maps.rs"),
    (1007, "a map: tests/maps.rs"),
    (1008, "a map: tests/maps.rs"),
    (1009, "a map: tests/maps.rs"),
    (1010, "a map: tests/maps.rs"),
    (1011, "a map: tests/maps.rs"),
    (1012, "a map: tests/maps.rs"),
    (1013, "a map: tests/maps.rs"),
    (1014, "a map: tests/ground.rs"),
    (1015, "a map: tests/first_towns.rs"),
    (1201, "a picture: tests/plans.rs"),
    (1202, "a picture: tests/plans.rs"),
    (1203, "a picture: tests/plans.rs"),
    (1204, "a picture: tests/plans.rs"),
    (1205, "a legend: tests/plans.rs"),
    (1206, "a picture: tests/plans.rs"),
    (1207, "a picture: tests/plans.rs"),
    (1208, "a picture: tests/plans.rs"),
    (1301, "a photograph: tests/cli/facade.rs"),
    (1302, "a photograph: tests/cli/facade.rs"),
    (1303, "a photograph: tests/cli/facade.rs"),
    (1304, "a photograph: tests/cli/facade.rs"),
    (1305, "a photograph: tests/cli/facade.rs"),
    (1306, "a photograph: tests/cli/facade.rs"),
];

/// Codes whose page shows no text that can be run, and why.
const WITHOUT_EXAMPLE: &[(u16, &str)] = &[
    (2, "the bytes are Shift_JIS"),
    (3, "the bytes are of another encoding"),
    (4, "the bytes are of no encoding"),
    (5, "the file is no text"),
    (6, "a control character cannot be seen"),
    (7, "the line ends cannot be seen"),
    (8, "the file is not there"),
    (260, "a parameter of the command line"),
    (269, "the files are several"),
    (270, "the files are several"),
    (272, "the pictures are not there"),
    (281, "the corners are too many to print"),
    (319, "the pictures are not there"),
    (330, "the files are several"),
    (331, "the parts are too many to print"),
    (431, "the files are several"),
    (601, "the picture is not there"),
    (602, "the picture is none"),
    (603, "a fault of the program"),
    (605, "a model, no text"),
    (606, "an option of the command line"),
    (901, "the file is too long to print"),
    (902, "the nesting is too deep to print"),
    (903, "the files are too many to print"),
    (905, "the picture is too large"),
    (908, "an option of the command line"),
    (910, "the files are too large to print"),
    (906, "the roofs are too many to print"),
    (909, "the messages are too many to print"),
    (1001, "a map, no text"),
    (1002, "a map, no text"),
    (1003, "a map, no text"),
    (1004, "a map, no text"),
    (1005, "a map, no text"),
    (1006, "a map, no text"),
    (1007, "a map, no text"),
    (1008, "a map, no text"),
    (1009, "a map, no text"),
    (1010, "a map, no text"),
    (1011, "a map, no text"),
    (1012, "a map, no text"),
    (1013, "a map, no text"),
    (1014, "a map, no text"),
    (1015, "a map, no text"),
    (1103, "the map is not there"),
    (1150, "the map is not there"),
    (1151, "the map is not there"),
    (1152, "the map is not there"),
    (1153, "the map is not there"),
    (1154, "the map is not there"),
    (1155, "the map is not there"),
    (1156, "the map is not there"),
    (1158, "the map is not there"),
    (1160, "the map is not there"),
    (1161, "the map is not there"),
    (1162, "the map is not there"),
    (1163, "the map is not there"),
    (1170, "the map is not there"),
    (1171, "the map is not there"),
    (1172, "the map is not there"),
    (1104, "the map is not there"),
    (1105, "the map is not there"),
    (1106, "the map is not there"),
    (1107, "the map is not there"),
    (1108, "the map is not there"),
    (1109, "the map is not there"),
    (1110, "the map is not there"),
    (1112, "the map is not there"),
    (1115, "the map is not there"),
    (1117, "the map is not there"),
    (1118, "the map is not there"),
    (1119, "the map is not there"),
    (1120, "the map is not there"),
    (1140, "the map is not there"),
    (1141, "the map is not there"),
    (1142, "the map is not there"),
    (1143, "the map is not there"),
    (1201, "a picture, no text of a house"),
    (1202, "a picture, no text of a house"),
    (1203, "a picture, no text of a house"),
    (1204, "a picture, no text of a house"),
    (1205, "a legend, no text of a house"),
    (1206, "a picture, no text of a house"),
    (1207, "a picture, no text of a house"),
    (1208, "a picture, no text of a house"),
    (1301, "a photograph, no text of a house"),
    (1302, "a photograph, no text of a house"),
    (1303, "a photograph, no text of a house"),
    (1304, "a photograph, no text of a house"),
    (1305, "a photograph, no text of a house"),
    (1306, "a photograph, no text of a house"),
];

/// Messages of layouts are said by `hsd fmt` alone; they have their own fixtures and test, in tests/convert.rs.
fn is_of_layouts(code: u16) -> bool {
    code / 100 == 8 || code == 434
}

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
        let run = compile_file(&path);
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

/// The pages of the folder, by code.
fn pages_there() -> BTreeMap<u16, String> {
    pages_in(PAGES)
}

fn pages_in(folder: &str) -> BTreeMap<u16, String> {
    let folder = fs::read_dir(root().join(folder)).expect("pages are there");
    let files = folder.map(|entry| entry.expect("can be listed").path());
    let page = |path: PathBuf| {
        let code = code_of(&stem(&path)).unwrap_or_else(|| panic!("{}: no code", path.display()));
        (code, fs::read_to_string(&path).expect("pages are UTF-8"))
    };
    files.filter(|path| path.is_file()).map(page).collect()
}

#[test]
fn every_page_is_in_the_list() {
    let there = pages_there();
    let mut findings = vec![];
    let listed: Vec<u16> = pages::codes().map(|code| code.0).collect();
    for code in listed.iter().filter(|code| !there.contains_key(code)) {
        findings.push(format!(
            "{} is in grammar/lib.rs, not in the folder",
            Code(*code)
        ));
    }
    for code in there.keys().filter(|code| !listed.contains(code)) {
        findings.push(format!(
            "{} is in the folder, not in grammar/lib.rs",
            Code(*code)
        ));
    }
    if !listed.is_sorted() {
        findings.push("grammar/lib.rs is not in order".into());
    }
    for (&code, text) in &there {
        let name = Code(code);
        if !text.starts_with(&format!("# {name}: ")) {
            findings.push(format!("{name}.md: the first line is no title"));
        }
        if text.matches("```").count() < 2 {
            findings.push(format!("{name}.md: without an example"));
        }
    }
    assert_none(&findings);
}

/// The files of the wording, by path.
fn message_sources() -> Vec<(String, String)> {
    let mut found = vec![];
    let mut folders = vec![root().join("crates")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("messages are there") {
            let path = entry.expect("can be listed").path();
            let is_message = path.to_string_lossy().contains("/src/messages")
                || path.to_string_lossy().contains("/diagnostic/messages");
            if path.is_dir() {
                folders.push(path);
            } else if is_message && path.extension().is_some_and(|e| e == "rs") {
                let text = fs::read_to_string(&path).expect("messages are UTF-8");
                let name = path.strip_prefix(root()).unwrap_or(&path);
                found.push((name.display().to_string(), text));
            }
        }
    }
    found
}

/// Codes that the messages can carry: the whole numbers that begin a list of arguments.
fn codes_in_messages() -> BTreeSet<u16> {
    let sources = message_sources();
    sources
        .iter()
        .flat_map(|(_, text)| codes_in(text))
        .collect()
}

fn codes_in(text: &str) -> Vec<u16> {
    let calls = text.split('(').map(str::trim_start);
    calls
        .filter_map(|call| call.split_once(',')?.0.parse().ok())
        .collect()
}

#[test]
fn messages_fixtures_and_pages_belong_together() {
    let (messages, fixtures) = (codes_in_messages(), fixture_codes());
    let without: BTreeSet<u16> = WITHOUT_FIXTURE.iter().map(|(code, _)| *code).collect();
    let paged: BTreeSet<u16> = pages_there().into_keys().collect();
    let mut findings = vec![];
    for code in messages
        .union(&fixtures)
        .copied()
        .chain(paged.iter().copied())
    {
        let (code, name) = (code, Code(code));
        if !messages.contains(&code) {
            findings.push(format!("{name}: no message"));
        }
        if !paged.contains(&code) {
            findings.push(format!("{name}: no page"));
        }
        let without = without.contains(&code) || is_of_layouts(code);
        if fixtures.contains(&code) == without {
            findings.push(format!(
                "{name}: needs either a fixture or a reason to have none"
            ));
        }
    }
    findings.sort();
    findings.dedup();
    assert_none(&findings);
}

/// Whether a text holds kana or kanji.
fn is_japanese(text: &str) -> bool {
    text.chars()
        .any(|c| matches!(c, '\u{3041}'..='\u{30ff}' | '\u{4e00}'..='\u{9fff}'))
}

/// The texts of a message that a Japanese reader would find in English. Labels of one word may be names.
fn untranslated(d: &Diagnostic) -> Vec<&Text> {
    let labels = d.labels.iter().map(|l| &l.message);
    let sentences = labels.filter(|text| text.en().contains(' '));
    let all = [&d.message, &d.help].into_iter().chain(sentences);
    all.filter(|text| text.ja() == text.en() || !is_japanese(&text.ja()))
        .collect()
}

/// What takes words, and how many arguments stand before them.
const CALLS: [(&str, usize); 5] = [
    ("Diagnostic::error(", 2),
    ("Diagnostic::warning(", 2),
    ("Diagnostic::note(", 2),
    (".label(", 1),
    (".help(", 0),
];

/// English sentences that are handed to a call as they are.
fn plain_words<'a>(text: &'a str, (call, before): &(&str, usize)) -> Vec<&'a str> {
    let arguments = text.split(call).skip(1);
    let words = arguments.filter_map(|rest| rest.splitn(before + 1, ',').nth(*before));
    let words = words.map(|w| w.trim_start().lines().next().unwrap_or_default());
    let plain = |w: &&str| (w.starts_with('"') || w.starts_with("format!")) && w.contains(' ');
    words.filter(plain).collect()
}

#[test]
fn messages_speak_japanese() {
    let mut findings = BTreeSet::new();
    for path in texts(FIXTURES) {
        for d in &compile_file(&path).diagnostics {
            let texts = untranslated(d);
            findings.extend(texts.iter().map(|text| format!("{}: {text:?}", d.code)));
        }
    }
    // Messages that no small text can trigger: their words stand in `text!` too.
    for (file, text) in message_sources() {
        let plain = CALLS.iter().flat_map(|call| plain_words(&text, call));
        findings.extend(plain.map(|words| format!("{file}: {words}")));
    }
    assert_none(&findings.into_iter().collect::<Vec<_>>());
}

/// All that stands between fences, with the words behind the first ones.
fn fenced(page: &str) -> Vec<&str> {
    page.split("```").skip(1).step_by(2).collect()
}

#[test]
fn every_page_has_its_japanese_one() {
    let japanese = pages_in(&format!("{PAGES}/ja"));
    let english = pages_there();
    let mut findings = vec![];
    for (&code, page) in &english {
        let name = Code(code);
        let Some(ja) = japanese.get(&code) else {
            findings.push(format!("{name}: no page in {PAGES}/ja"));
            continue;
        };
        if fenced(page) != fenced(ja) {
            findings.push(format!("{name}: the examples differ"));
        }
        let title = ja.lines().next().unwrap_or_default();
        if !title.starts_with(&format!("# {name}: ")) || !is_japanese(title) {
            findings.push(format!("{name}: the first line is no title in Japanese"));
        }
        let prose = ja.split("```").step_by(2);
        let english = prose.flat_map(str::lines).skip(1);
        let english = english.filter(|l| l.contains(' ') && !is_japanese(l));
        findings.extend(english.map(|line| format!("{name}: not Japanese: {line}")));
    }
    let alone = japanese.keys().filter(|code| !english.contains_key(code));
    findings.extend(alone.map(|code| format!("{}: only in Japanese", Code(*code))));
    assert_none(&findings);
}

/// The examples of a page: what stands between fences that name a form of the language.
fn examples(page: &str) -> Vec<String> {
    let mut found = vec![];
    let mut rest = page;
    while let Some((_, fenced)) = rest.split_once("\n```") {
        let (language, body) = fenced.split_once('\n').unwrap_or_default();
        let (example, after) = body.split_once("\n```").unwrap_or((body, ""));
        if matches!(language, "hsd" | "xml") {
            found.push(format!("{example}\n"));
        }
        rest = after;
    }
    found
}

#[test]
fn the_first_example_of_a_page_triggers_its_code() {
    let mut findings = vec![];
    for (code, text) in pages_there() {
        let name = Code(code);
        let reason = WITHOUT_EXAMPLE.iter().find(|(c, _)| *c == code);
        let Some(example) = examples(&text).into_iter().next() else {
            if reason.is_none() && code != 801 {
                findings.push(format!("{name}: without an example to run"));
            }
            continue;
        };
        if is_of_layouts(code) {
            continue;
        }
        let run = compile("example.hsd", example.as_bytes());
        let triggers = run.diagnostics.iter().any(|d| d.code == name);
        if triggers == reason.is_some() {
            findings.push(format!(
                "{name}: does not say what it should\n{example}{}",
                run.short()
            ));
        }
    }
    assert_none(&findings);
}
