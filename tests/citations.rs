//! Comments and pages cite `docs/`: sections of `docs/evidence.md` and `docs/contract.md`, statements of the papers (001-19), sources and
//! corrections (S20, F1). Everything that is cited exists there.

use crate::support::{assert_none, root};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Folders and files whose citations are checked.
const CITING: &[&str] = &[
    "src",
    "crates",
    "tests",
    "benches",
    "grammar",
    "examples",
    "library",
    "docs",
    "view/src",
    "README.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
];

/// Extensions of files that people write.
const WRITTEN: &[&str] = &["rs", "md", "hsd", "ebnf", "xml", "ts"];

/// Pages that lie outside the repository: a reader cannot open them.
const ELSEWHERE: &[&str] = &["domain.md", "language.md", "toolbox.md"];

fn files() -> Vec<PathBuf> {
    let mut found = vec![];
    let mut open: Vec<PathBuf> = CITING.iter().map(|name| root().join(name)).collect();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).expect("can be listed");
            open.extend(entries.map(|entry| entry.expect("can be listed").path()));
        } else if path
            .extension()
            .is_some_and(|e| WRITTEN.iter().any(|w| e == *w))
        {
            found.push(path);
        }
    }
    assert!(found.len() > 500, "{} files", found.len());
    found.sort();
    found
}

fn page(name: &str) -> String {
    fs::read_to_string(root().join(name)).expect("the page is there")
}

/// The numbers of the headings of a page: `4.4` of `### 4.4 Build-up`, `6` of `## 6. Outputs`.
fn sections(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let numbers =
        headings.filter_map(|line| line.trim_start_matches('#').split_whitespace().next());
    let numbers = numbers.map(|word| word.trim_end_matches('.').to_owned());
    numbers.filter(|word| is_section(word)).collect()
}

fn is_section(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit())
        && word.chars().all(|c| c.is_ascii_digit() || c == '.')
}

/// Whether a word is a letter and a number, such as S20 or F1.
fn is_mark(word: &str) -> bool {
    let mut rest = word.chars();
    rest.next().is_some_and(|c| "ACFS".contains(c))
        && rest.clone().next().is_some()
        && rest.all(|c| c.is_ascii_digit())
}

/// The marks that tables of the evidence begin with.
fn marks(text: &str) -> BTreeSet<String> {
    let rows = text.lines().filter_map(|line| line.strip_prefix("| "));
    let firsts = rows.filter_map(|row| row.split_whitespace().next());
    firsts.filter(|w| is_mark(w)).map(str::to_owned).collect()
}

/// The statements of the papers that the evidence lists.
fn statements(text: &str) -> BTreeSet<String> {
    let items = text.lines().filter_map(|line| line.strip_prefix("- **"));
    items
        .filter_map(|item| item.get(..6))
        .filter(|number| is_statement(number))
        .map(str::to_owned)
        .collect()
}

/// Whether this is a number such as 001-19.
fn is_statement(word: &str) -> bool {
    let digits = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
    word.len() == 6
        && word.is_ascii()
        && word.as_bytes()[3] == b'-'
        && ("000"..="004").contains(&&word[..3])
        && digits(&word[4..])
}

/// The sections and marks named right behind the name of a page: "4.8, S54 and S55", "3.7 to 3.9".
fn cited(behind: &str) -> Vec<String> {
    let behind = behind.strip_prefix('`').unwrap_or(behind);
    let mut found = vec![];
    for word in behind.split_whitespace() {
        // A line of a comment may end within the list.
        if matches!(word, "and" | "to" | "or" | "//!" | "///" | "//") {
            continue;
        }
        let bare = word.trim_end_matches([',', '.', ';', ':', ')', '(']);
        if !is_section(bare) && !is_mark(bare) {
            break;
        }
        found.push(bare.to_owned());
        if word != bare && !word.ends_with(',') {
            break;
        }
    }
    found
}

/// The citations in a text that name no section or mark of the page.
fn missing(text: &str, name: &str, there: &BTreeSet<String>) -> Vec<String> {
    let behind = text.split(name).skip(1);
    let all = behind.flat_map(cited);
    all.filter(|word| !there.contains(word))
        .map(|word| format!("{name} {word}"))
        .collect()
}

/// Whole words of six characters that look like statements.
fn statements_in(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    words.filter(|word| is_statement(word))
}

#[test]
fn what_is_cited_exists() {
    let evidence = page("docs/evidence.md");
    let statements = statements(&evidence);
    assert!(statements.len() > 150, "{}", statements.len());
    let mut in_evidence = sections(&evidence);
    in_evidence.extend(marks(&evidence));
    let in_contract = sections(&page("docs/contract.md"));
    let mut findings = vec![];
    for path in files() {
        let text = fs::read_to_string(&path).unwrap_or_default();
        let mut wrong = missing(&text, "evidence.md", &in_evidence);
        wrong.extend(missing(&text, "contract.md", &in_contract));
        wrong.extend(
            statements_in(&text)
                .filter(|number| !statements.contains(*number))
                .map(str::to_owned),
        );
        wrong.extend(elsewhere(&path, &text));
        let name = path.strip_prefix(root()).unwrap_or(&path).display();
        findings.extend(wrong.iter().map(|what| format!("{name}: {what}")));
    }
    assert_none(&findings);
}

/// Pages outside the repository that a text cites; this file has to name them.
fn elsewhere(path: &Path, text: &str) -> Vec<String> {
    if path.ends_with("tests/citations.rs") {
        return vec![];
    }
    let named = ELSEWHERE.iter().filter(|name| text.contains(**name));
    named
        .map(|name| format!("{name} is not in the repository"))
        .collect()
}

/// Where the links of a page lead, without those to other hosts and to places within a page.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = text
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split([')', '#']).next());
    targets.filter(|target| !target.is_empty() && !target.contains("://"))
}

/// Paths in backticks, without patterns such as `HSDnnnn.md`.
fn paths(text: &str) -> impl Iterator<Item = &str> {
    let prose = text.split("```").step_by(2);
    let quoted = prose.flat_map(|p| p.split('`').skip(1).step_by(2));
    quoted.filter(|word| {
        let folders = [
            "src/", "crates/", "tests/", "grammar/", "library/", "docs/", ".ci/",
        ];
        folders.iter().any(|f| word.starts_with(f))
            && !word.contains([' ', ':'])
            && !word.contains("nnnn")
    })
}

#[test]
fn pages_for_contributors_lead_to_what_exists() {
    let pages = [
        "CONTRIBUTING.md",
        "SECURITY.md",
        "docs/README.md",
        "docs/architecture.md",
        "docs/contract.md",
        "docs/evidence.md",
        "docs/releasing.md",
    ];
    let mut findings = vec![];
    for name in pages {
        let text = page(name);
        let folder = root().join(name);
        let folder = folder.parent().expect("a page is in a folder");
        let linked = links(&text).map(|target| (target, folder.join(target)));
        let named = paths(&text).map(|path| (path, root().join(path)));
        let gone = linked.chain(named).filter(|(_, path)| !path.exists());
        findings.extend(gone.map(|(target, _)| format!("{name}: {target}")));
    }
    assert_none(&findings);
}

#[test]
fn citations_are_read_as_they_are_written() {
    assert_eq!(cited(" 4.4: 0.10"), ["4.4"]);
    assert_eq!(cited("` 4.8, S54 and S55."), ["4.8", "S54", "S55"]);
    assert_eq!(cited(" 3.7 to 3.9"), ["3.7", "3.9"]);
    assert_eq!(cited(" 3, \"Codes\""), ["3"]);
    assert_eq!(cited("#section) says"), Vec::<String>::new());
    let found: Vec<&str> = statements_in("(000-37 to 000-40), 1000-22").collect();
    assert_eq!(found, ["000-37", "000-40"]);
}

/// Tests that `docs/testing.md` names, as `file::test`, are there.
#[test]
fn tests_that_are_named_exist() {
    let page = fs::read_to_string(root().join("docs/testing.md")).expect("can be read");
    let named: Vec<(&str, &str)> = page
        .split('`')
        .filter(|word| !word.contains([' ', '/', '\n']))
        .filter_map(|word| word.split_once("::"))
        .filter(|(file, _)| root().join(format!("tests/{file}.rs")).is_file())
        .collect();
    assert!(named.len() > 25, "{}", named.len());
    let missing = named.iter().filter(|(file, test)| {
        let path = root().join(format!("tests/{file}.rs"));
        let text = fs::read_to_string(path).expect("can be read");
        !text.contains(&format!("#[test]\nfn {test}(")) && !text.contains(&format!("]\nfn {test}("))
    });
    let missing: Vec<String> = missing
        .map(|(file, test)| format!("{file}::{test}"))
        .collect();
    assert_none(&missing);
}
