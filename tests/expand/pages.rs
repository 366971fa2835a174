//! Every message has a page and a fixture, and the fixture triggers this message and no other.

use crate::expand::build::Pictures;
use hsd::diagnostic::Diagnostics;
use hsd::expand::{Options, expand};
use hsd::parse::parse;
use hsd::source::{FileId, Limits, Source};
use std::path::Path;

fn codes() -> impl Iterator<Item = u16> {
    (301..=322).chain([904])
}

/// The fixtures of a code: their names and bytes.
fn fixtures(code: u16) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/diagnostics");
    let prefix = format!("HSD{code:04}_");
    let files = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap());
    let found = files.filter_map(|f| {
        let name = f.file_name().to_string_lossy().into_owned();
        let own = name.starts_with(&prefix) && name.ends_with(".hsd");
        own.then(|| (name, std::fs::read(f.path()).unwrap()))
    });
    let found: Vec<_> = found.collect();
    assert!(!found.is_empty(), "no {prefix}*.hsd");
    found
}

#[test]
fn every_message_has_a_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for code in codes() {
        let page = root.join(format!("grammar/diagnostics/HSD{code:04}.md"));
        let text = std::fs::read_to_string(&page).unwrap_or_default();
        let title = format!("# HSD{code:04}: ");
        assert!(text.starts_with(&title), "{}", page.display());
    }
}

#[test]
fn every_fixture_triggers_its_message() {
    let world = Pictures(vec![("f7f1f1u1", (8, 8))]);
    let all = codes().flat_map(|code| fixtures(code).into_iter().map(move |f| (code, f)));
    for (code, (name, bytes)) in all {
        let source = Source::new(FileId(0), name.as_str(), &bytes);
        let mut out = Diagnostics::new();
        let document = parse(&source, &Limits::default(), &mut out);
        let documents = [(&source, &document)];
        expand(
            &documents,
            hsd::parse::builtin(),
            &world,
            &Options::default(),
            &mut out,
        );
        let said = out.into_sorted();
        assert!(!said.is_empty(), "{name} says nothing");
        for one in &said {
            assert_eq!(one.code.0, code, "{name}: {one:#?}");
            let range = source.text_range(one.span().unwrap());
            let text = &source.text()[range];
            assert!(
                !text.contains('\n') && !one.help.is_empty(),
                "{name}: {text}"
            );
        }
    }
}
