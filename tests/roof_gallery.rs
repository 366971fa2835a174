//! The gallery of roofs: each text builds without a word, says the form it shows, and stands on the page.

use crate::support::{assert_none, compile_file, flaws, root, stem, texts};
use hsd::ast::{RoofKind, RoofShape};
use std::collections::BTreeSet;

#[test]
fn every_text_builds_without_a_word() {
    let mut findings = vec![];
    for path in texts("grammar/roofs") {
        let run = compile_file(&path);
        let name = stem(&path);
        findings.extend(
            run.diagnostics
                .iter()
                .map(|d| format!("{name}: {}", d.code)),
        );
        findings.extend(flaws(&run).into_iter().map(|f| format!("{name}: {f}")));
    }
    assert_none(&findings);
}

#[test]
fn the_page_shows_every_text_every_form_and_every_covering() {
    let page = std::fs::read_to_string(root().join("grammar/roofs.md")).expect("the page is there");
    let mut findings = vec![];
    let (mut shapes, mut kinds) = (BTreeSet::new(), BTreeSet::new());
    for path in texts("grammar/roofs") {
        let name = stem(&path);
        for view in ["eaves", "above"] {
            let picture = format!("pictures/roofs/{name}-{view}.jpg");
            if !page.contains(&format!("]({picture})")) {
                findings.push(format!("the page does not show {picture}"));
            }
            if !root().join("grammar").join(&picture).is_file() {
                findings.push(format!("no {picture}"));
            }
        }
        if !page.contains(&format!("[source](roofs/{name}.hsd)")) {
            findings.push(format!("the page does not link {name}.hsd"));
        }
        for roof in compile_file(&path)
            .building
            .houses
            .iter()
            .flat_map(|b| &b.roofs.roofs)
        {
            shapes.insert(roof.shape.letters());
            kinds.insert(roof.kind);
        }
    }
    for (letters, _) in RoofShape::ALL {
        if !shapes.contains(letters) {
            findings.push(format!("no text has a roof of shape {letters}"));
        }
        if !page.contains(&format!("`{letters}`")) {
            findings.push(format!("the page does not name {letters}"));
        }
    }
    for (letter, kind) in RoofKind::ALL {
        if !kinds.contains(&kind) {
            findings.push(format!("no text has a roof of kind {letter}"));
        }
        if !page.contains(&format!("`{letter}`")) {
            findings.push(format!("the page does not name {letter}"));
        }
    }
    assert_none(&findings);
}
