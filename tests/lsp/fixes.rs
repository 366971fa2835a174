//! Fixes, as a client does them.

use crate::lsp::client::{Client, position};
use serde_json::{Value, json};

/// Does the edits of an action on a text.
fn done(text: &str, action: &Value, encoding: &str) -> String {
    let changes = &action["edit"]["documentChanges"];
    let edits = changes[0]["edits"].as_array().expect("are there");
    let offset = |wanted: &Value| {
        let places = text.char_indices().map(|(at, _)| at).chain([text.len()]);
        let mut places = places.filter(|at| !text[..*at].ends_with('\r'));
        let found = places.find(|at| position(text, *at, encoding) == *wanted);
        found.expect("is a position of the text")
    };
    let mut places: Vec<_> = edits
        .iter()
        .map(|e| {
            let range = offset(&e["range"]["start"])..offset(&e["range"]["end"]);
            (range, e["newText"].as_str().expect("is a text"))
        })
        .collect();
    places.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    let mut text = text.to_owned();
    for (range, new) in places {
        text.replace_range(range, new);
    }
    text
}

fn actions(client: &mut Client, uri: &str, range: &Value, only: Option<&str>) -> Vec<Value> {
    let mut context = json!({ "diagnostics": [] });
    if let Some(only) = only {
        context["only"] = json!([only]);
    }
    let wanted = json!({ "textDocument": { "uri": uri }, "range": range, "context": context });
    let answer = client.request("textDocument/codeAction", wanted);
    answer
        .expect("is answered")
        .as_array()
        .cloned()
        .expect("is a list")
}

#[test]
fn a_fix_puts_its_mistake_right() {
    let uri = "file:///a.hsd";
    for encoding in ["utf-8", "utf-16", "utf-32"] {
        let text = "# 𠮷野家\n0 0\n\n\nKSK　KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n";
        let mut client = Client::start(encoding);
        client.open(uri, text);
        let found = client.diagnostics(uri, Some(1));
        assert_eq!(found.len(), 1, "{found:?}");
        let offered = actions(&mut client, uri, &found[0]["range"], Some("quickfix"));
        assert_eq!(offered[0]["isPreferred"], true);
        assert_eq!(offered[0]["diagnostics"][0], found[0]);
        let fixed = done(text, &offered[0], encoding);
        client.change(uri, 2, json!([{ "text": fixed }]));
        assert!(client.diagnostics(uri, Some(2)).is_empty(), "{fixed}");
        // Nothing is offered elsewhere.
        let elsewhere =
            json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 1 } });
        assert!(actions(&mut client, uri, &elsewhere, None).is_empty());
        assert!(client.finish());
    }
}

#[test]
fn everything_is_fixed_at_once() {
    let uri = "file:///a.hsd";
    let text = "0 0\n\n\nKSK　KSK\nKSK　KSK\nKSK　KSK\nKSK　KSK\n";
    let mut client = Client::start("utf-16");
    client.open(uri, text);
    assert_eq!(client.diagnostics(uri, Some(1)).len(), 4);
    let start = json!({ "line": 0, "character": 0 });
    let nowhere = json!({ "start": start, "end": start });
    for only in ["source", "source.fixAll", "source.fixAll.hsd"] {
        let offered = actions(&mut client, uri, &nowhere, Some(only));
        assert_eq!(offered.len(), 1, "{only}: {offered:?}");
        let fixed = done(text, &offered[0], "utf-16");
        assert_eq!(fixed, text.replace('　', "  "));
    }
    assert!(client.finish());
}

#[test]
fn a_wall_that_is_too_short_can_be_made_longer_in_xml() {
    let uri = "file:///a.hsd";
    let text = include_str!("../suite/diagnostics/HSD0401_row_short.hsd");
    let mut client = Client::start("utf-16");
    client.open(uri, text);
    let found = client.diagnostics(uri, Some(1));
    let offered = actions(&mut client, uri, &found[0]["range"], Some("quickfix"));
    assert_eq!(offered.len(), 2, "{offered:?}");
    for (version, action) in (2..).zip(&offered) {
        let fixed = done(text, action, "utf-16");
        client.change(uri, version, json!([{ "text": fixed }]));
        assert!(client.diagnostics(uri, Some(version)).is_empty(), "{fixed}");
    }
    assert!(client.finish());
}

/// A mend may bring to light what the mistake had hidden; nobody wants to ask twice, nor a text that is worse.
#[test]
fn fixed_texts_are_fixed_again_until_they_are_best() {
    let uri = "file:///a.hsd";
    let text = "0 0\nstret 　yes\n\n\nKSK　KSK\nKSK  KSX\nKSK  KSK\nKSK  KSKL\n";
    let mut client = Client::start("utf-16");
    client.open(uri, text);
    let before = client.diagnostics(uri, Some(1)).len();
    let start = json!({ "line": 0, "character": 0 });
    let nowhere = json!({ "start": start, "end": start });
    let offered = actions(&mut client, uri, &nowhere, Some("source.fixAll"));
    let fixed = done(text, &offered[0], "utf-16");
    client.change(uri, 2, json!([{ "text": fixed }]));
    let after = client.diagnostics(uri, Some(2));
    assert!(after.len() < before, "{before}\n{fixed}\n{after:?}");
    let again = actions(&mut client, uri, &nowhere, Some("source.fixAll"));
    assert!(again.is_empty(), "{fixed}\n{again:?}");
    assert!(client.finish());
}
