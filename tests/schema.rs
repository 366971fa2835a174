//! The schemas of the XML form in `grammar/schema`: made of the tables that the reader itself goes by, and held against
//! every text of the repository by xmllint where that is there. `HSD_UPDATE=1 cargo test --release schema` writes them anew.

mod agree;
mod defaults;
mod model;
mod reference;
mod relaxng;
mod table;
mod xsd;

use std::fs;
use std::path::Path;

const FOLDER: &str = "grammar/schema";

#[test]
fn the_schemas_are_those_of_the_reader() {
    let made = [
        ("hsd.rng", relaxng::make()),
        ("hsd.xsd", xsd::make()),
        ("elements.json", table::make()),
    ];
    for (name, text) in made {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join(FOLDER)
            .join(name);
        if std::env::var_os("HSD_UPDATE").is_some() {
            fs::write(&path, &text).expect("the schema can be written");
        }
        let there = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            there == text,
            "{FOLDER}/{name} is stale: HSD_UPDATE=1 cargo test --release schema"
        );
    }
}

#[test]
fn the_reference_explains_everything() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar");
    let explanations = folder.join("reference.toml");
    let text = fs::read_to_string(explanations).expect("the explanations are there");
    let (pages, findings) = reference::make(&text);
    assert!(
        findings.is_empty(),
        "reference.toml:\n{}",
        findings.join("\n")
    );
    for (name, page) in ["reference.md", "reference.ja.md"].iter().zip(pages) {
        let path = folder.join(name);
        if std::env::var_os("HSD_UPDATE").is_some() {
            fs::write(&path, &page).expect("the page can be written");
        }
        let there = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            there == page,
            "grammar/{name} is stale: HSD_UPDATE=1 cargo test --release schema"
        );
    }
}

#[test]
fn every_element_and_attribute_says_what_it_is() {
    for element in model::elements() {
        let words = [element.en, element.ja];
        assert!(words.iter().all(|w| !w.is_empty()), "{}", element.name);
        for attribute in element.attributes {
            let words = [attribute.en, attribute.ja];
            let said = words.iter().all(|w| !w.is_empty());
            assert!(said, "{} {}", element.name, attribute.name);
        }
    }
}
