//! Documents that expand without end: refused, with a diagnostic.

use hsd::diagnostic::Diagnostics;
use hsd::parse::xml;
use hsd::source::{FileId, Limits, Source};

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_bombs_are_refused() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/xml_bombs");
    for entry in std::fs::read_dir(folder).expect(folder) {
        let path = entry.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        let source = Source::new(FileId(0), path.display().to_string(), &bytes);
        let mut out = Diagnostics::new();
        let document = xml::parse(&source, &Limits::default(), &mut out);
        assert!(document.houses.is_empty());
        assert!(out.has_errors(), "{}", path.display());
    }
}
