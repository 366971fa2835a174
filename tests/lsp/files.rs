//! Texts that include others: what is open and not saved is what counts.

use crate::lsp::client::{Client, range};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

const STREET: &str = r#"<Houses>
  <include href="pieces.hsd"/>
  <House name="家"><Storey><use name="front"/><Row>KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row></Storey></House>
</Houses>
"#;
const PIECES: &str =
    "<Catalog>\n  <define name=\"front\"><Row>KSK  TOD</Row></define>\n</Catalog>\n";

fn uri(folder: &Path, name: &str) -> String {
    let path = folder.canonicalize().expect("is there").join(name);
    format!("file://{}", path.display())
}

fn codes(list: &[Value]) -> Vec<&str> {
    list.iter().filter_map(|d| d["code"].as_str()).collect()
}

fn whole(text: &str) -> Value {
    json!([{ "text": text }])
}

/// The first trouble that is told of a text: before that the server may say that all is well.
fn trouble(client: &mut Client, uri: &str) -> Vec<Value> {
    loop {
        let found = client.diagnostics(uri, None);
        if !found.is_empty() {
            return found;
        }
    }
}

#[test]
fn unsaved_texts_are_seen_by_those_that_include_them() {
    let folder = tempfile::tempdir().expect("can be made");
    fs::write(folder.path().join("street.hsd"), STREET).expect("can be written");
    fs::write(folder.path().join("pieces.hsd"), PIECES).expect("can be written");
    let (street, pieces) = (
        uri(folder.path(), "street.hsd"),
        uri(folder.path(), "pieces.hsd"),
    );
    let mut client = Client::start("utf-16");
    client.open(&street, STREET);
    assert!(client.diagnostics(&street, Some(1)).is_empty());
    client.open(&pieces, PIECES);
    assert!(client.diagnostics(&pieces, Some(1)).is_empty());
    client.forget();

    // Another name for the piece: whoever uses it hears of it, though nothing is saved.
    let renamed = PIECES.replace("front", "omote");
    client.change(&pieces, 2, whole(&renamed));
    assert!(client.diagnostics(&pieces, Some(2)).is_empty());
    let found = trouble(&mut client, &street);
    assert!(codes(&found).contains(&"HSD0263"), "{found:?}");

    // What is wrong in the piece is shown there, in places of the unsaved text.
    let broken = PIECES
        .replace("<Catalog>", "<Catalog>\n\n")
        .replace("TOD", "TODX");
    client.forget();
    client.change(&pieces, 3, whole(&broken));
    let found = trouble(&mut client, &pieces);
    assert_eq!(codes(&found), ["HSD0301"]);
    let at = broken.find("TODX").expect("is there");
    assert_eq!(found[0]["range"], range(&broken, at..at + 4, "utf-16"));
    // And its mend is offered where the mistake is.
    let wanted = json!({
        "textDocument": { "uri": pieces }, "range": found[0]["range"], "context": { "diagnostics": found },
    });
    let actions = client
        .request("textDocument/codeAction", wanted)
        .expect("is answered");
    let edits = actions[0]["edit"]["documentChanges"][0].clone();
    assert_eq!(
        edits["textDocument"],
        json!({ "uri": pieces, "version": 3 }),
        "{actions}"
    );

    // Once it is closed the file on disk counts again.
    client.forget();
    client.close(&pieces);
    assert!(client.diagnostics(&street, Some(1)).is_empty());
    assert!(client.finish());
}

#[test]
fn texts_that_are_nowhere_on_disk_can_be_included() {
    let folder = tempfile::tempdir().expect("can be made");
    let (street, pieces) = (
        uri(folder.path(), "street.hsd"),
        uri(folder.path(), "pieces.hsd"),
    );
    let mut client = Client::start("utf-8");
    client.open(&street, STREET);
    assert!(!client.diagnostics(&street, Some(1)).is_empty());
    client.open(&pieces, PIECES);
    assert!(client.diagnostics(&street, Some(1)).is_empty());
    assert!(client.finish());
}

#[test]
fn files_that_others_change_are_read_anew() {
    let folder = tempfile::tempdir().expect("can be made");
    fs::write(folder.path().join("pieces.hsd"), "<Catalog/>").expect("can be written");
    let street = uri(folder.path(), "street.hsd");
    let mut client = Client::start("utf-16");
    client.open(&street, STREET);
    assert!(!client.diagnostics(&street, Some(1)).is_empty());
    fs::write(folder.path().join("pieces.hsd"), PIECES).expect("can be written");
    let change = json!([{ "uri": uri(folder.path(), "pieces.hsd"), "type": 2 }]);
    client.notify(
        "workspace/didChangeWatchedFiles",
        json!({ "changes": change }),
    );
    assert!(client.diagnostics(&street, Some(1)).is_empty());
    assert!(client.finish());
}

#[test]
fn nothing_outside_the_folder_is_read() {
    let folder = tempfile::tempdir().expect("can be made");
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).expect("can be made");
    fs::write(folder.path().join("pieces.hsd"), PIECES).expect("can be written");
    let text = STREET.replace("pieces.hsd", "../pieces.hsd");
    let street = uri(&inner, "street.hsd");
    let mut client = Client::start("utf-16");
    // Open or not: what lies outside is none of this text's business.
    client.open(&uri(folder.path(), "pieces.hsd"), PIECES);
    client.open(&street, &text);
    let found = client.diagnostics(&street, Some(1));
    assert!(codes(&found).contains(&"HSD0268"), "{found:?}");
    assert!(client.finish());
}

#[test]
fn wishes_change_what_is_said() {
    let uri = "untitled:Untitled-1";
    let text = "0 0\n\n\nKSK  QZJ\nKSK  KSK\nKSK  KSK\nKSK  KSK\n";
    let mut client = Client::with(json!({
        "capabilities": {}, "locale": "ja-JP", "initializationOptions": { "language": "auto" },
    }));
    client.open(uri, text);
    let found = client.diagnostics(uri, Some(1));
    assert!(
        found[0]["message"]
            .as_str()
            .is_some_and(|m| m.contains("対処")),
        "{found:?}"
    );
    let settings = json!({ "hsd": { "language": "en" } });
    client.notify(
        "workspace/didChangeConfiguration",
        json!({ "settings": settings }),
    );
    let found = client.diagnostics(uri, Some(1));
    assert!(
        found[0]["message"]
            .as_str()
            .is_some_and(|m| m.contains("help: ")),
        "{found:?}"
    );
    assert!(client.finish());
}

#[test]
fn cards_show_pictures_only_where_they_are_asked_for() {
    let uri = "untitled:Untitled-1";
    let text = "0 0\n9\n\nKSK  KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n";
    for (said, shown) in [(json!({}), false), (json!({ "pictures": true }), true)] {
        let mut client = Client::with(json!({ "capabilities": {}, "initializationOptions": said }));
        client.open(uri, text);
        let place =
            json!({ "textDocument": { "uri": uri }, "position": { "line": 3, "character": 1 } });
        let card = client
            .request("textDocument/hover", place)
            .unwrap_or_else(|why| panic!("{why:?}"))
            .to_string();
        assert!(card.contains("漆喰壁"), "{card}");
        assert_eq!(card.contains("data:image"), shown, "{card}");
        assert!(client.finish());
    }
}

#[test]
fn a_rename_reaches_files_that_are_read_but_not_open() {
    let folder = tempfile::tempdir().expect("can be made");
    let mid = "<Catalog>\n  <include href=\"pieces.hsd\"/>\n  <define name=\"both\"><use name=\"front\"/></define>\n</Catalog>\n";
    let house = STREET
        .replace("pieces", "mid")
        .replace("\"front\"", "\"both\"");
    for (name, text) in [("pieces.hsd", PIECES), ("mid.hsd", mid)] {
        fs::write(folder.path().join(name), text).expect("can be written");
    }
    let uris = ["pieces.hsd", "street.hsd", "house.hsd", "mid.hsd"];
    let [pieces, street, other, between] = uris.map(|name| uri(folder.path(), name));
    let mut client = Client::start("utf-16");
    client.open(&pieces, PIECES);
    client.open(&street, STREET);
    client.open(&other, &house);
    let at = PIECES.find("front").expect("is there");
    let wanted = json!({
        "textDocument": { "uri": pieces }, "position": range(PIECES, at..at, "utf-16")["start"], "newName": "omote",
    });
    let edit = client.request("textDocument/rename", wanted);
    let edit = edit.expect("is answered");
    let changes = edit["documentChanges"].as_array().expect("is a list");
    let mut changed: Vec<&str> = changes
        .iter()
        .filter_map(|c| c["textDocument"]["uri"].as_str())
        .collect();
    changed.sort_unstable();
    let mut wanted = [&*between, &*pieces, &*street];
    wanted.sort_unstable();
    assert_eq!(changed, wanted, "{edit}");
    assert!(client.finish());
}

#[test]
fn unsaved_catalogues_are_those_that_count() {
    let folder = tempfile::tempdir().expect("can be made");
    let part = |code: &str| {
        format!("<Catalog><PartDef code=\"{code}\" base=\"KSK\" ja=\"壁\"/></Catalog>\n")
    };
    fs::write(folder.path().join("own.hsd"), part("XAA  ")).expect("can be written");
    let text = "0 0 180\n9\n\nXBB  XBB\nKSK  KSK\nKSK  KSK\nKSK  KSK\n";
    let (house, own) = (uri(folder.path(), "a.hsd"), uri(folder.path(), "own.hsd"));
    let path = folder
        .path()
        .canonicalize()
        .expect("is there")
        .join("own.hsd");
    let mut client = Client::with(json!({
        "capabilities": {}, "initializationOptions": { "catalogs": [path] },
    }));
    client.open(&house, text);
    assert_eq!(codes(&client.diagnostics(&house, Some(1)))[0], "HSD0301");
    client.forget();
    client.open(&own, &part("XBB  "));
    let unknown = |list: &[Value]| codes(list).contains(&"HSD0301");
    while unknown(&client.diagnostics(&house, None)) {}
    assert!(client.finish());
}
