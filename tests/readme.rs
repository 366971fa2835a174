//! The README and the pages of `grammar/` in their two languages: the same commands, texts, words and pictures, and a
//! first house that does what it says.

use crate::support::{assert_none, compile, root};
use hsd::diagnostic::Code;
use std::collections::BTreeSet;
use std::fs;

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

/// The links of a page, those to Japanese pages and pictures as if they led to the English ones.
fn english_links(text: &str) -> Vec<String> {
    let all = links(text).into_iter();
    all.map(|link| link.replace(".ja.", ".")).collect()
}

/// What stands between single backticks, names of Japanese pages as those of the English ones.
fn code(text: &str) -> BTreeSet<String> {
    let prose: Vec<&str> = text.split("```").step_by(2).collect();
    let pieces = prose.iter().flat_map(|p| p.split('`').skip(1).step_by(2));
    pieces.map(|c| c.replace(".ja.md", ".md")).collect()
}

/// How many lines begin so.
fn lines(text: &str, start: char) -> usize {
    text.lines().filter(|l| l.starts_with(start)).count()
}

#[test]
fn both_languages_show_the_same() {
    let (english, japanese) = (readme("README.md"), readme("README.ja.md"));
    assert_eq!(fenced(&english), fenced(&japanese));
    let first = |text: &str| links(text).first().map(|&l| l.to_owned());
    assert_eq!(first(&english).as_deref(), Some("README.ja.md"));
    assert_eq!(first(&japanese).as_deref(), Some("README.md"));
    assert_eq!(english_links(&english), english_links(&japanese));
    assert_eq!(lines(&english, '#'), lines(&japanese, '#'));
    assert_eq!(lines(&english, '|'), lines(&japanese, '|'));
}

/// The names of the pages of `grammar/` that are there in Japanese, without their ends.
fn pairs() -> Vec<String> {
    let folder = fs::read_dir(root().join("grammar")).expect("the pages are there");
    let names = folder.map(|e| {
        e.expect("an entry")
            .file_name()
            .to_string_lossy()
            .into_owned()
    });
    let mut pairs: Vec<String> = names
        .filter_map(|n| Some(n.strip_suffix(".ja.md")?.to_owned()))
        .collect();
    pairs.sort();
    assert!(pairs.len() > 3, "Japanese pages are looked for in vain");
    pairs
}

/// The Japanese overview of the language is a short one, and the tutorial has a test of its own; all others say what
/// the English pages say.
#[test]
fn pages_in_both_languages_show_the_same() {
    let pairs = pairs();
    let mut findings = vec![];
    for name in pairs
        .iter()
        .filter(|n| !["README", "tutorial"].contains(&n.as_str()))
    {
        let (english, japanese) = (
            readme(&format!("grammar/{name}.md")),
            readme(&format!("grammar/{name}.ja.md")),
        );
        let mut said = |what: &str, en: String, ja: String| {
            if en != ja {
                findings.push(format!("{name}: {what}: {en} | {ja}"));
            }
        };
        let show = |all: &dyn std::fmt::Debug| format!("{all:?}");
        said("fences", show(&fenced(&english)), show(&fenced(&japanese)));
        let (en, ja) = (english_links(&english), english_links(&japanese));
        said("first link", show(&en.first()), show(&ja.first()));
        let lacks =
            |a: &BTreeSet<String>, b: &BTreeSet<String>| show(&Vec::from_iter(a.difference(b)));
        let [en, ja]: [BTreeSet<String>; 2] = [en, ja].map(BTreeSet::from_iter);
        said("links", lacks(&en, &ja), lacks(&ja, &en));
        let (en, ja) = (code(&english), code(&japanese));
        said("words", lacks(&en, &ja), lacks(&ja, &en));
        for start in ['#', '|', '!'] {
            said(
                "lines",
                lines(&english, start).to_string(),
                lines(&japanese, start).to_string(),
            );
        }
    }
    assert_none(&findings);
}

/// A Japanese page leads to Japanese pages, but for the English one that it is a pair with.
#[test]
fn japanese_pages_lead_to_japanese_ones() {
    let mut pages = vec![root().join("README.ja.md")];
    pages.extend(
        pairs()
            .iter()
            .map(|n| root().join(format!("grammar/{n}.ja.md"))),
    );
    let mut findings = vec![];
    for page in pages {
        let text = fs::read_to_string(&page).expect("the page is there");
        let own = page
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .replace(".ja.md", ".md");
        for link in links(&text) {
            let file = link.split('#').next().unwrap_or(link);
            let to = page.with_file_name(file);
            if !file.contains("://") && !to.exists() {
                findings.push(format!("{}: {link} is not there", page.display()));
            }
            let twin = file.strip_suffix(".md").filter(|f| !f.ends_with(".ja"));
            let twin = twin.map(|f| page.with_file_name(format!("{f}.ja.md")));
            if file != own && twin.is_some_and(|twin| twin.exists()) {
                findings.push(format!("{}: {link} is there in Japanese", page.display()));
            }
        }
    }
    assert_none(&findings);
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
    assert_eq!(run.building.houses[0].house.storeys.len(), 2);
}
