//! Scans beside a house, as the preview tells of them and serves their pictures.

use super::web::Ear;
use super::{Files, revision, show};
use crate::support::png;
use serde_json::json;
use std::fs;

const HOUSE: &str = "<House><Storey height=\"9\">
  <!-- in doubt: KTU at 1 0 -->
  <Row>KTU  KTU  KTU</Row>
  <Row>KTU  KTU</Row>
  <Row>KTU  KTU  KTU</Row>
  <Row>KTU  KTU</Row>
</Storey></House>
";

/// The next revision; new files are told too.
fn next(ear: &Ear) -> u64 {
    loop {
        let told = ear.hear();
        if told.0 != "files" {
            return revision(told);
        }
    }
}

#[test]
fn a_scan_beside_a_house_is_told_and_served() {
    let shown = show(
        &[("読み.hsd", HOUSE), ("other.hsd", HOUSE)],
        None,
        Files::default(),
    );
    let (folder, file) = (
        shown.folder.path(),
        "%E8%AA%AD%E3%81%BF.hsd", // 読み.hsd
    );
    assert!(shown.web.state(file)["scan"].is_null());
    let ear = shown.web.listen(file);
    let first = next(&ear);
    fs::write(folder.join("読み.sheet-1.png"), png(3, 2)).expect("can be written");
    let plan = json!({"plan": 1, "sheets": [
        {"storey": 1, "picture": "読み.sheet-1.png", "to_house": [-0.01, 0, 0, -0.01, 5, 7]},
        {"storey": 2, "picture": "none.png", "to_house": [-0.01, 0, 0, -0.01, 5, 7]},
    ]});
    shown.save("読み.plan.json", &plan.to_string());
    assert!(next(&ear) > first);
    let scan = shown.web.state(file)["scan"].clone();
    assert_eq!(scan["file"], "読み.plan.json");
    let sheets = scan["sheets"].as_array().expect("is a list");
    assert_eq!(sheets.len(), 1);
    assert_eq!(
        (&sheets[0]["size"], &sheets[0]["to_house"][4]),
        (&json!([3, 2]), &json!(5.0))
    );
    let fault = scan["faults"][0].as_str().expect("is told");
    assert!(fault.contains("`none.png` is not in the folder"), "{fault}");
    let get = |query: &str| shown.web.get(&format!("/api/scan?{query}"));
    let picture = get(&format!("file={file}&sheet=0"));
    assert_eq!((picture.status, picture.body), (200, png(3, 2)));
    for query in [
        &format!("file={file}&sheet=1"),
        &format!("file={file}&sheet=9"),
        "file=other.hsd&sheet=0",
    ] {
        assert_eq!(get(query).status, 404, "{query}");
    }
    // What is broken later is told, and the house is shown all the same.
    shown.save("読み.plan.json", "{");
    next(&ear);
    let state = shown.web.state(file);
    assert!(
        state["scan"]["faults"][0]
            .as_str()
            .is_some_and(|f| f.contains("line 1"))
    );
    assert_eq!(state["plan"]["doubts"][0]["code"], "KTU");
}

#[test]
fn what_is_in_doubt_is_settled_by_strokes_with_undo() {
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    let stroke = |stroke| {
        let revision = shown.web.state("a.hsd")["revision"].clone();
        let body = json!({"file": "a.hsd", "revision": revision, "stroke": stroke});
        shown.web.post("/api/stroke", &body).json()
    };
    stroke(json!({"do": "change-doubt", "doubt": 0, "kind": "lattice"}));
    let expected = HOUSE.replace("  <!-- in doubt: KTU at 1 0 -->\n", "");
    assert_eq!(
        shown.read("a.hsd"),
        expected.replacen("KTU  KTU  KTU", "KTU  GSI  KTU", 1)
    );
    shown.web.post("/api/undo", &json!({"file": "a.hsd"}));
    assert_eq!(shown.read("a.hsd"), HOUSE);
    let refused = stroke(json!({"do": "delete-doubt", "doubt": 7}));
    assert!(refused["refused"].is_string(), "{refused}");
}
