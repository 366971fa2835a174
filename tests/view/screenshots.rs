//! Pictures for documents: who may hand them over, and to whom.

use super::web::{PATIENCE, Web};
use super::{Files, HOUSE};
use hsd::diagnostic::Language;
use hsd::view::{Preview, PreviewOptions, Screenshot};
use serde_json::json;
use std::path::Path;
use std::sync::mpsc;

fn shown(folder: &Path) -> PreviewOptions {
    PreviewOptions {
        root: folder.to_owned(),
        only: vec!["a.hsd".to_owned()],
        language: Language::English,
        host: Box::new(Files::default()),
        front: None,
        port: 0,
        watched: vec![],
    }
}

#[test]
fn pictures_are_taken_where_somebody_wants_them() {
    let folder = tempfile::tempdir().expect("folders can be made");
    std::fs::write(folder.path().join("a.hsd"), HOUSE).expect("can be written");
    let (taker, stills) = mpsc::channel();
    let preview = Preview::with_screenshots(shown(folder.path()), taker).expect("can be shown");
    let web = Web::new(&preview.url());
    let foreign = format!(
        "POST /api/rendered HTTP/1.1\r\nHost: {}\r\nOrigin: http://example.org\r\n\
         Content-Type: application/json\r\nContent-Length: 13\r\nConnection: close\r\n\r\n{{\"errors\":[]}}",
        web.host
    );
    assert_eq!(web.raw(&foreign).status, 403);
    assert_eq!(web.post("/api/picture?view=front", &json!(7)).status, 200);
    assert_eq!(
        web.post("/api/rendered", &json!({ "errors": ["no"] }))
            .status,
        200
    );
    let next = || stills.recv_timeout(PATIENCE).expect("is handed over");
    let heard = [next(), next()];
    let front = Screenshot::Picture {
        view: "front".to_owned(),
        png: b"7".to_vec(),
    };
    assert_eq!(heard, [front, Screenshot::Done(vec!["no".to_owned()])]);
    assert!(stills.try_recv().is_err(), "nothing else is handed over");
    drop(stills);
    assert_eq!(
        web.post("/api/rendered", &json!({ "errors": [] })).status,
        410
    );
}

#[test]
fn nobody_hands_over_pictures_unasked() {
    let folder = tempfile::tempdir().expect("folders can be made");
    std::fs::write(folder.path().join("a.hsd"), HOUSE).expect("can be written");
    let preview = Preview::start(shown(folder.path())).expect("can be shown");
    let web = Web::new(&preview.url());
    assert_eq!(web.post("/api/picture?view=front", &json!(7)).status, 404);
    assert_eq!(
        web.post("/api/rendered", &json!({ "errors": [] })).status,
        404
    );
}
