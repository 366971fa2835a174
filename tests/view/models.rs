//! Models that were made before, as the preview shows them.

use super::{Files, HOUSE, show};
use crate::support::png;
use serde_json::{Value, json};
use std::fs;

#[test]
fn models_are_shown_as_they_are() {
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    let revision = shown.web.state("a.hsd")["revision"].clone();
    let model = shown
        .web
        .get(&format!("/api/model/{revision}/house.glb?file=a.hsd"))
        .body;
    fs::write(shown.folder.path().join("b.glb"), &model).expect("can be written");
    let state = shown.web.state("b.glb");
    let again = shown.web.get(&format!(
        "/api/model/{}/house.glb?file=b.glb",
        state["revision"]
    ));
    assert!(again.body == model);
}

#[test]
fn pictures_beside_a_model_are_found_and_nothing_else_is() {
    let outside = tempfile::tempdir().expect("folders can be made");
    fs::write(outside.path().join("secret.png"), png(2, 2)).expect("can be written");
    let shown = show(&[("made/a.txt", "no picture")], None, Files::default());
    let folder = shown.folder.path().join("made");
    let above = outside.path().join("secret.png");
    let names = [
        "家 1.png",
        "a.txt",
        "none.png",
        "cut.png",
        above.to_str().expect("is text"),
    ];
    fs::write(folder.join(names[0]), png(3, 3)).expect("can be written");
    let half = &png(3, 3)[..50];
    fs::write(folder.join(names[3]), half).expect("can be written");
    let uris = [&["%E5%AE%B6%201.png"], &names[1..]].concat();
    let images: Vec<Value> = uris.iter().map(|uri| json!({ "uri": uri })).collect();
    let document = json!({ "asset": { "version": "2.0" }, "images": images });
    let glb = gltf::binary::Glb {
        header: gltf::binary::Header {
            magic: *b"glTF",
            version: 2,
            length: 0,
        },
        json: document.to_string().into_bytes().into(),
        bin: None,
    };
    fs::write(folder.join("b.glb"), glb.to_vec().expect("is written")).expect("can be written");
    let state = shown.web.state("made/b.glb");
    let pictures = state["pictures"].as_object().expect("are named");
    assert_eq!(pictures.keys().collect::<Vec<_>>(), ["家 1.png"]);
    let said = state["diagnostics"].as_array().expect("is a list");
    let told: Vec<(&Value, &str)> = said
        .iter()
        .map(|d| (&d["code"], d["message"].as_str().expect("is text")))
        .collect();
    for (name, why) in [
        (names[1], "the file is not a PNG, JPEG or KTX2 image"),
        (names[2], "the file does not exist"),
        (names[3], "the file is truncated"),
        (names[4], "the file is outside the opened folder"),
    ] {
        let expected = |(code, m): &&(&Value, &str)| {
            *code == "HSD0605" && m.contains(name) && m.ends_with(why)
        };
        assert!(told.iter().any(|t| expected(&t)), "{name}: {told:?}");
    }
    assert_eq!(told.len(), 4, "{told:?}");
    let revision = &state["revision"];
    let get = |name: &str| shown.web.get(&format!("/api/model/{revision}/{name}"));
    assert_eq!(get("%E5%AE%B6%201.png").body, png(3, 3));
    for other in ["a.txt", "none.png", "..%2Fa.hsd"] {
        assert_eq!(get(other).status, 404, "{other}");
    }
    // Whoever looks again is shown what has come.
    fs::write(folder.join("none.png"), png(4, 4)).expect("can be written");
    let state = shown.web.state("made/b.glb");
    let later = format!("/api/model/{}/none.png", state["revision"]);
    assert_eq!(shown.web.get(&later).body, png(4, 4));
    assert_eq!(state["diagnostics"].as_array().map(Vec::len), Some(3));
}
