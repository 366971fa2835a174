//! xmllint and the reader agree on every text of the repository.

use hsd::diagnostic::Diagnostics;
use hsd::source::{FileId, Limits, Source};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where texts lie.
const FOLDERS: &[&str] = &["examples", "library", "tests/suite", "tests/corpus"];

/// Mistakes that a schema finds: unknown and misplaced elements and attributes, missing ones.
const NAMES: &[u16] = &[209, 221, 222, 223, 224, 276];

/// Mistakes in values, which a schema finds where they are written and not computed.
const VALUES: &[u16] = &[225, 226, 227, 237, 238, 244, 253, 280];

/// Mistakes of which a schema finds some, so that nothing is expected of texts with them: (code, why).
const UNSURE: &[(u16, &str)] = &[
    (228, "a word that this version does not read"),
    (232, "a letter among codes, but also a turn in a floor"),
    (235, "positions the wrong way round"),
    (236, "a comment that is none to XML"),
    (241, "an end tag without `/`"),
    (245, "the XML declaration"),
    (262, "an `else` without `if`"),
    (266, "what stands in a `use`"),
    (
        435,
        "points of a view that are one point, or not three numbers",
    ),
    (902, "deep nesting"),
];

/// What a schema should say of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Verdict {
    Valid,
    Invalid,
    Unsure,
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("the folder is there");
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "hsd") {
            found.push(path);
        }
    }
}

/// What a schema should say of a text; `None` = it is not in the XML form, or in an encoding that it does not name.
fn expected(path: &Path) -> Option<Verdict> {
    let bytes = fs::read(path).expect("texts can be read");
    let text = std::str::from_utf8(&bytes).ok()?;
    let text = text.trim_start_matches('\u{feff}');
    text.trim_start().starts_with('<').then_some(())?;
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), path.to_string_lossy(), &bytes);
    hsd::parse::parse(&source, &Limits::default(), &mut out);
    let codes: Vec<u16> = out.iter().map(|d| d.code.0).collect();
    let any = |of: &[u16]| codes.iter().any(|c| of.contains(c));
    // Below 221 are those of XML itself, of which xmllint minds all but document types and Japanese marks.
    let unsure = codes.iter().any(|c| (201..=220).contains(c) && *c != 209)
        || codes.iter().any(|c| UNSURE.iter().any(|(u, _)| u == c))
        || text.contains('\u{3000}');
    Some(if any(NAMES) && !codes.contains(&217) {
        Verdict::Invalid
    } else if unsure || any(VALUES) && text.contains('{') {
        Verdict::Unsure
    } else if any(VALUES) {
        Verdict::Invalid
    } else {
        Verdict::Valid
    })
}

/// The texts that xmllint finds valid.
fn valid(option: &str, text: &str, texts: &[PathBuf]) -> BTreeSet<PathBuf> {
    let folder = tempfile::tempdir().expect("there is room for a schema");
    let schema = folder.path().join("schema");
    fs::write(&schema, text).expect("the schema can be written");
    let run = Command::new("xmllint")
        .arg("--noout")
        .arg(option)
        .arg(&schema)
        .args(texts)
        .output()
        .expect("xmllint starts");
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(
        !said.contains("failed to compile"),
        "{}: {said}",
        schema.display()
    );
    let lines = said.lines();
    lines
        .filter_map(|l| l.strip_suffix(" validates"))
        .map(PathBuf::from)
        .collect()
}

#[test]
#[ignore = "needs xmllint (Debian: libxml2-utils)"]
fn xmllint_agrees_with_the_reader() {
    let mut texts = vec![];
    for folder in FOLDERS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        files(&folder, &mut texts);
    }
    texts.sort();
    let expected: Vec<(PathBuf, Verdict)> = texts
        .into_iter()
        .filter_map(|p| expected(&p).map(|v| (p, v)))
        .collect();
    let count = |v| expected.iter().filter(|(_, e)| *e == v).count();
    let (good, bad) = (count(Verdict::Valid), count(Verdict::Invalid));
    assert!(good > 20 && bad > 5, "{good} {bad}");
    let paths: Vec<PathBuf> = expected.iter().map(|(p, _)| p.clone()).collect();
    let mut wrong = vec![];
    let schemas = [
        ("--relaxng", "hsd.rng", crate::schema::relaxng::make()),
        ("--schema", "hsd.xsd", crate::schema::xsd::make()),
    ];
    for (option, schema, text) in &schemas {
        let valid = valid(option, text, &paths);
        for (path, verdict) in &expected {
            let fits = match verdict {
                Verdict::Valid => valid.contains(path),
                Verdict::Invalid => !valid.contains(path) || is_beyond(schema, path),
                Verdict::Unsure => true,
            };
            if !fits {
                wrong.push(format!(
                    "{schema}: {} should be {verdict:?}",
                    path.display()
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The XML Schema cannot say that a code is needed.
fn is_beyond(schema: &str, path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    schema == "hsd.xsd" && name.starts_with("HSD0224")
}
