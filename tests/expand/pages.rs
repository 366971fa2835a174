//! Every message has a page and a fixture.

use std::path::Path;

#[test]
fn every_message_has_a_page_and_a_fixture() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for code in (301..=327).chain([904]) {
        let page = root.join(format!("grammar/diagnostics/HSD{code:04}.md"));
        let text = std::fs::read_to_string(&page).unwrap_or_default();
        assert!(
            text.starts_with(&format!("# HSD{code:04}: ")),
            "{}",
            page.display()
        );
        let fixtures = std::fs::read_dir(root.join("tests/suite/diagnostics")).unwrap();
        let prefix = format!("HSD{code:04}_");
        let found = fixtures.filter(|f| {
            let name = f.as_ref().unwrap().file_name();
            name.to_string_lossy().starts_with(&prefix)
        });
        assert_eq!(found.count(), 1, "{prefix}");
    }
}
