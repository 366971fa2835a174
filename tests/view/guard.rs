//! Whom the server answers, and with which files: only its own page, and only sources of its folder, by whatever name.

use super::{Files, HOUSE, show};
use serde_json::json;
use std::fs;

#[test]
fn only_the_page_is_answered_and_only_files_of_the_folder() {
    let outside = tempfile::tempdir().expect("folders can be made");
    fs::write(outside.path().join("secret.hsd"), HOUSE).expect("can be written");
    let shown = show(
        &[("a.hsd", HOUSE), ("sub/b.hsd", HOUSE)],
        Some("a.hsd"),
        Files::default(),
    );
    let host = &shown.web.host;
    let with = |line: &str| {
        shown
            .web
            .raw(&format!(
                "GET /api/hello HTTP/1.1\r\n{line}\r\nConnection: close\r\n\r\n"
            ))
            .status
    };
    assert_eq!(with(&format!("Host: {host}")), 200);
    let port = host.split(':').nth(1).expect("has a port");
    assert_eq!(with(&format!("Host: rebound.example:{port}")), 403);
    assert_eq!(
        with(&format!("Host: {host}\r\nOrigin: http://foreign.example")),
        403
    );
    assert_eq!(
        with(&format!(
            "Host: {host}\r\nSec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: cors"
        )),
        403
    );
    let stroke = "{\"file\":\"a.hsd\"}";
    let post = format!(
        "POST /api/undo HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{stroke}",
        stroke.len()
    );
    assert_eq!(
        shown.web.raw(&post).status,
        403,
        "a form of another page has no right origin"
    );
    let headers = shown.web.get("/api/hello").headers.to_lowercase();
    assert!(
        headers.contains("default-src 'self'") && headers.contains("nosniff"),
        "{headers}"
    );
    let path = outside.path().join("secret.hsd");
    let absolute = path.to_string_lossy().replace('/', "%2F");
    let others = [
        "../secret.hsd",
        "sub/../../secret.hsd",
        "..%5Csecret.hsd",
        "sub%2Fb.hsd",
        "%2Fetc%2Fpasswd",
        "a.hsd%00",
        "a.txt",
        "",
        &absolute,
    ];
    for other in others {
        let status = shown.web.get(&format!("/api/state?file={other}")).status;
        assert_eq!(status, 404, "{other}");
    }
}

#[test]
fn only_files_of_the_page_are_served() {
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    for other in [
        "/Cargo.toml",
        "/..%2FCargo.toml",
        "/sub/view.js",
        "/view.js.gz",
    ] {
        assert_eq!(shown.web.get(other).status, 404, "{other}");
    }
}

#[test]
#[ignore = "needs the built page"]
fn files_of_the_page_may_do_what_they_need_and_no_more() {
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    let policy = |path: &str| {
        let answer = shown.web.get(path);
        assert_eq!(answer.status, 200, "{path}");
        let told = answer.headers.to_lowercase();
        let policies: Vec<String> = told
            .lines()
            .filter_map(|line| line.strip_prefix("content-security-policy:"))
            .map(|policy| policy.replace("'wasm-unsafe-eval'", ""))
            .collect();
        assert_eq!(policies.len(), 1, "{path}: {told}");
        policies.concat()
    };
    for path in [
        "/",
        "/view.js",
        "/view.css",
        "/api/hello",
        "/basis_transcoder.wasm",
    ] {
        let policy = policy(path);
        assert!(policy.contains("default-src 'self'"), "{path}: {policy}");
        assert!(!policy.contains("unsafe"), "{path}: {policy}");
        assert!(policy.contains("worker-src 'self';"), "{path}: {policy}");
    }
    assert_eq!(
        policy("/unpack.js").trim(),
        "default-src 'none'; script-src 'unsafe-eval'"
    );
}

#[cfg(unix)]
#[test]
fn links_lead_nowhere_else() {
    let outside = tempfile::tempdir().expect("folders can be made");
    fs::write(outside.path().join("secret.hsd"), HOUSE).expect("can be written");
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    let link = shown.folder.path().join("link.hsd");
    std::os::unix::fs::symlink(outside.path().join("secret.hsd"), link).expect("can be made");
    std::os::unix::fs::symlink(outside.path(), shown.folder.path().join("way"))
        .expect("can be made");
    assert_eq!(shown.web.get("/api/state?file=link.hsd").status, 404);
    assert_eq!(shown.web.get("/api/state?file=way/secret.hsd").status, 404);
}

/// However a file is named, it is one document: what changes it by one name is shown by the others.
#[cfg(unix)]
#[test]
fn names_of_one_file_are_one_document() {
    let shown = show(
        &[("a.hsd", HOUSE), ("street/b.hsd", HOUSE)],
        None,
        Files::default(),
    );
    let root = shown.folder.path();
    std::os::unix::fs::symlink(root.join("a.hsd"), root.join("link.hsd")).expect("can be made");
    std::os::unix::fs::symlink(root.join("street"), root.join("way")).expect("can be made");
    let revision = |name: &str| shown.web.state(name)["revision"].clone();
    for (name, others) in [
        ("a.hsd", ["./a.hsd", "link.hsd", "street/../a.hsd"]),
        (
            "street/b.hsd",
            ["street//b.hsd", "street/./b.hsd", "way/b.hsd"],
        ),
    ] {
        let first = revision(name);
        for other in others {
            assert_eq!(revision(other), first, "{other}");
        }
    }
    assert_eq!(shown.web.get("/api/state?file=../a.hsd").status, 404);
}

#[cfg(unix)]
#[test]
fn a_link_in_the_place_of_a_shown_file_is_not_followed() {
    let outside = tempfile::tempdir().expect("folders can be made");
    let secret = outside.path().join("secret.hsd");
    fs::write(&secret, HOUSE).expect("can be written");
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    let revision = shown.web.state("a.hsd")["revision"].clone();
    let file = shown.folder.path().join("a.hsd");
    fs::remove_file(&file).expect("can be removed");
    std::os::unix::fs::symlink(&secret, &file).expect("can be made");
    let unit = json!({ "do": "set-part", "house": 0, "storey": 0, "ring": 0, "wall": 0, "unit": 2, "part": "MHI" });
    let drawn = json!({ "file": "a.hsd", "revision": revision, "stroke": unit });
    let answer = shown.web.post("/api/stroke", &drawn);
    assert!(answer.json()["refused"].is_string());
    let step = json!({ "file": "a.hsd" });
    assert!(shown.web.post("/api/undo", &step).json()["refused"].is_string());
    assert_eq!(fs::read_to_string(&secret).expect("is there"), HOUSE);
}
