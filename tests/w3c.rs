//! The W3C's conformance suite for XML, where `../shared/data` has it: every document is taken or refused as a reader
//! must that does not validate and reads no document types. `grammar/xml.md` lists the deliberate differences.
use crate::support::root;
use hsd::diagnostic::{Diagnostics, Severity};
use hsd::source::{FileId, Limits, Source};
use quick_xml::events::{BytesStart, Event};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::Read;
use zip::ZipArchive;

const ARCHIVE: &str = "../shared/data/xml_w3c_xmlconf/xmlts20130923.zip";
const PAGE: &str = "grammar/xml.md";

/// What a document is for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    WellFormed,
    Malformed,
    /// A reader may take it or leave it.
    Either,
}

struct Case {
    id: String,
    path: String,
    kind: Kind,
}

/// Whether a code says that a file is no XML, or holds what hsd refuses of XML; the others are about houses.
fn is_of_xml(code: u16) -> bool {
    matches!(code, 3..=6 | 201..=208 | 210..=220 | 236 | 241 | 245 | 902)
}

struct Suite(ZipArchive<File>);

impl Suite {
    fn bytes(&mut self, path: &str) -> Option<Vec<u8>> {
        let mut entry = self.0.by_name(path).ok()?;
        let mut bytes = vec![];
        entry.read_to_end(&mut bytes).expect("the archive is whole");
        Some(bytes)
    }

    /// The cases of XML 1.0 as it stands today; names in name spaces are not a reader's business here.
    fn cases(&mut self) -> Vec<Case> {
        let index = self.bytes("xmlconf/xmlconf.xml").expect("it has an index");
        let index = String::from_utf8_lossy(&index).into_owned();
        let mut cases = vec![];
        for line in index.lines().filter(|l| l.contains("<!ENTITY")) {
            let path = line.split('"').nth(1).expect("an entity is a file");
            let path = format!("xmlconf/{path}");
            let folder = &path[..=path.rfind('/').expect("it is in a folder")];
            let catalog = self.bytes(&path).expect("the catalogue is there");
            let catalog = String::from_utf8_lossy(&catalog).into_owned();
            cases_of(&catalog, folder, &mut cases);
        }
        cases
    }
}

fn cases_of(catalog: &str, folder: &str, cases: &mut Vec<Case>) {
    let mut reader = quick_xml::Reader::from_str(catalog);
    reader.config_mut().check_end_names = false;
    reader.config_mut().allow_unmatched_ends = true;
    loop {
        match reader.read_event() {
            Ok(Event::Start(tag) | Event::Empty(tag)) if tag.name().as_ref() == "TEST" => {
                cases.extend(case(&tag, folder));
            }
            Ok(Event::Eof) => return,
            Ok(_) => {}
            Err(e) => panic!("{folder}: {e}"),
        }
    }
}

fn case(tag: &BytesStart<'_>, folder: &str) -> Option<Case> {
    let found: BTreeMap<String, String> = tag
        .attributes()
        .flatten()
        .map(|a| (a.key.as_ref().to_owned(), a.value.to_string()))
        .collect();
    let get = |name: &str| found.get(name).map_or("", |v| v.as_str());
    let old = !get("EDITION").is_empty() && !get("EDITION").contains('5');
    let other = get("RECOMMENDATION").contains("1.1") || get("RECOMMENDATION").starts_with("NS");
    let kind = match get("TYPE") {
        _ if old || other || get("VERSION") == "1.1" => Kind::Either,
        "valid" | "invalid" => Kind::WellFormed,
        "not-wf" => Kind::Malformed,
        _ => Kind::Either,
    };
    Some(Case {
        id: get("ID").to_owned(),
        path: format!("{folder}{}", get("URI")),
        kind,
    })
}

/// Whether a document has a document type: behind comments and instructions.
fn has_document_type(bytes: &[u8]) -> bool {
    let source = Source::new(FileId(0), "case", bytes);
    let mut rest = source.text().trim_start();
    loop {
        let end = match rest {
            _ if rest.starts_with("<!--") => "-->",
            _ if rest.starts_with("<?") => "?>",
            _ => return rest.starts_with("<!DOCTYPE"),
        };
        match rest.find(end) {
            Some(at) => rest = rest[at + end.len()..].trim_start(),
            None => return false,
        }
    }
}

/// The first code of an error in XML that the reader says.
fn refused(bytes: &[u8]) -> Option<u16> {
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "case.xml", bytes);
    hsd::parse::xml::parse(&source, &Limits::default(), &mut out);
    // The whole chain survives it too.
    let mut all = Diagnostics::new();
    let world = hsd::source::NoFiles;
    hsd::compile(&[&source], &world, &hsd::Options::default(), &mut all);
    let said = out.iter().chain(all.iter());
    let mut errors = said.filter(|d| d.severity == Severity::Error);
    errors.find(|d| is_of_xml(d.code.0)).map(|d| d.code.0)
}

/// The cases that the page names.
fn named() -> BTreeSet<String> {
    let page = std::fs::read_to_string(root().join(PAGE)).unwrap_or_default();
    let words = page.split('`').skip(1).step_by(2);
    words.map(str::to_owned).collect()
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_suite_is_taken_and_refused_as_it_should() {
    let file = File::open(root().join(ARCHIVE)).expect(ARCHIVE);
    let mut suite = Suite(ZipArchive::new(file).expect("it is an archive"));
    let (mut differing, mut taken, mut left) = (vec![], 0, 0);
    for case in suite.cases() {
        let Some(bytes) = suite.bytes(&case.path) else {
            panic!("{} is not in the archive", case.path);
        };
        let code = refused(&bytes);
        match code {
            Some(_) => left += 1,
            None => taken += 1,
        }
        let fits = match (case.kind, has_document_type(&bytes)) {
            (_, true) => code.is_some(),
            (Kind::WellFormed, _) => code.is_none(),
            (Kind::Malformed, _) => code.is_some(),
            (Kind::Either, _) => true,
        };
        if !fits {
            differing.push((case, code));
        }
    }
    eprintln!("{taken} documents taken, {left} refused");
    assert!(taken > 100 && left > 1500, "{taken} {left}");
    let named = named();
    let missing: Vec<String> = differing
        .iter()
        .filter(|(case, _)| !named.contains(&case.id))
        .map(|(case, code)| format!("{} ({:?}, {code:?}): {}", case.id, case.kind, case.path))
        .collect();
    assert!(missing.is_empty(), "{}", missing.join("\n"));
    let differing: BTreeSet<&str> = differing.iter().map(|(case, _)| &*case.id).collect();
    let cases: BTreeSet<String> = suite.cases().into_iter().map(|c| c.id).collect();
    let settled: Vec<&String> = named
        .iter()
        .filter(|id| cases.contains(*id) && !differing.contains(&***id))
        .collect();
    assert!(
        settled.is_empty(),
        "{PAGE} names what is no difference: {settled:?}"
    );
}
