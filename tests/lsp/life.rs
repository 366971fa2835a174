//! From hello to good-bye: requests in any order, cancelled ones, nonsense.

use crate::lsp::client::Client;
use crate::lsp::program::Program;
use lsp_server::{Message, Notification, Request, RequestId};
use serde_json::{Value, json};

const TEXT: &str = "0 0\n\n\nKSK  KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n";

fn place() -> Value {
    json!({ "textDocument": { "uri": "file:///a.hsd" }, "position": { "line": 3, "character": 1 } })
}

fn note(method: &str, params: Value) -> Message {
    Notification::new(method.to_owned(), params).into()
}

fn request(id: i32, method: &str, params: Value) -> Message {
    Request::new(RequestId::from(id), method.to_owned(), params).into()
}

#[test]
fn requests_before_hello_and_after_good_bye_are_refused() {
    let mut client = Client::raw(vec![]);
    let early = client.request("textDocument/hover", place());
    assert_eq!(early.expect_err("is refused").0, -32002);
    client
        .request("initialize", json!({ "capabilities": {} }))
        .expect("is answered");
    let again = client.request("initialize", json!({ "capabilities": {} }));
    assert_eq!(again.expect_err("is refused").0, -32600);
    let unknown = client.request("textDocument/nonsense", json!({}));
    assert_eq!(unknown.expect_err("is refused").0, -32601);
    let wrong = client.request("textDocument/hover", json!({ "position": 7 }));
    assert_eq!(wrong.expect_err("is refused").0, -32602);
    assert_eq!(client.request("shutdown", Value::Null), Ok(Value::Null));
    let late = client.request("textDocument/hover", place());
    assert_eq!(late.expect_err("is refused").0, -32600);
    client.notify("exit", Value::Null);
}

#[test]
fn exit_codes_report_a_missing_shutdown() {
    for (shutdown, code) in [(false, 1), (true, 0)] {
        let mut program = Program::start();
        program.open("file:///a.hsd", TEXT);
        if shutdown {
            program.ask(2, "shutdown", Value::Null);
        }
        program.notify("exit", Value::Null);
        assert_eq!(program.end(), Some(code), "shutdown: {shutdown}");
    }
    let mut program = Program::start();
    program.notify("exit", Value::Null);
    assert_eq!(program.end(), Some(1), "before any hello");
}

#[test]
fn a_request_that_was_cancelled_is_never_begun() {
    let document =
        json!({ "uri": "file:///a.hsd", "languageId": "hsd", "version": 1, "text": TEXT });
    let mut client = Client::raw(vec![
        request(90, "initialize", json!({ "capabilities": {} })),
        note("initialized", json!({})),
        note("textDocument/didOpen", json!({ "textDocument": document })),
        request(91, "textDocument/documentSymbol", place()),
        request(92, "textDocument/documentSymbol", place()),
        note("$/cancelRequest", json!({ "id": 92 })),
        note("$/cancelRequest", json!({ "id": 777 })),
        note("$/cancelRequest", json!({})),
    ]);
    // It is answered before the others, since nothing has to be worked out for it.
    let refused = client.answer(&RequestId::from(92));
    assert_eq!(refused.expect_err("is cancelled").0, -32800);
    client.answer(&RequestId::from(90)).expect("is answered");
    client.answer(&RequestId::from(91)).expect("is answered");
    assert!(client.finish());
}

#[test]
fn texts_that_are_not_open_have_nothing_to_tell() {
    let mut client = Client::start("utf-16");
    let document = json!({ "uri": "file:///never.hsd" });
    let here = json!({ "textDocument": document, "position": { "line": 0, "character": 0 } });
    assert_eq!(
        client.request("textDocument/hover", here.clone()),
        Ok(Value::Null)
    );
    assert_eq!(
        client.request("textDocument/definition", here),
        Ok(json!([]))
    );
    client.change("file:///never.hsd", 5, json!([{ "text": "x" }]));
    client.close("file:///never.hsd");
    client.notify("textDocument/didOpen", json!({ "nonsense": true }));
    client.notify("textDocument/didChange", Value::Null);
    client.notify("no/such/notification", json!([1, 2]));
    client.open("file:///a.hsd", TEXT);
    assert!(client.diagnostics("file:///a.hsd", Some(1)).is_empty());
    assert!(client.finish());
}

#[test]
fn positions_outside_of_a_text_are_its_borders() {
    let uri = "file:///a.hsd";
    let mut client = Client::start("utf-16");
    client.open(uri, "家");
    client.diagnostics(uri, Some(1));
    let far = json!({ "line": 4_000_000_000u32, "character": 4_000_000_000u32 });
    let start = json!({ "line": 0, "character": 0 });
    // Backwards, far out: the end of the text.
    client.change(
        uri,
        2,
        json!([{ "range": { "start": far, "end": start }, "text": TEXT }]),
    );
    client.change(
        uri,
        3,
        json!([{ "range": { "start": start, "end": { "line": 0, "character": 1 } }, "text": "" }]),
    );
    assert!(client.diagnostics(uri, Some(3)).is_empty());
    let here = json!({ "textDocument": { "uri": uri }, "position": far });
    assert!(client.request("textDocument/hover", here).is_ok());
    assert!(client.finish());
}

#[test]
fn the_same_text_opened_twice_is_the_newer_one() {
    let uri = "file:///a.hsd";
    let mut client = Client::start("utf-16");
    client.open(uri, "nonsense");
    assert!(!client.diagnostics(uri, Some(1)).is_empty());
    client.open(uri, TEXT);
    assert!(client.diagnostics(uri, Some(1)).is_empty());
    client.close(uri);
    assert!(client.diagnostics(uri, None).is_empty());
    assert!(client.finish());
}

/// Ten changes at once are one: the text is read when nothing waits any more.
#[test]
fn a_huge_text_keeps_nobody_waiting_for_old_states() {
    let uri = "file:///a.hsd";
    let large = "%\n0 0\n\n\nKSK  KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n".repeat(20_000);
    let mut said = vec![
        request(90, "initialize", json!({ "capabilities": {} })),
        note("initialized", json!({})),
        note(
            "textDocument/didOpen",
            json!({
                "textDocument": { "uri": uri, "languageId": "hsd", "version": 1, "text": large },
            }),
        ),
    ];
    for version in 2..40 {
        let start = json!({ "line": 0, "character": 0 });
        let change = json!([{ "range": { "start": start, "end": start }, "text": "#\n" }]);
        let document = json!({ "uri": uri, "version": version });
        let params = json!({ "textDocument": document, "contentChanges": change });
        said.push(note("textDocument/didChange", params));
    }
    let mut client = Client::raw(said);
    client.answer(&RequestId::from(90)).expect("is answered");
    client.diagnostics(uri, Some(39));
    assert!(client.finish());
}
