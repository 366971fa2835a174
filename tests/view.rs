//! The server of the live preview: what it tells, when, and whom.

mod guard;
mod houses;
mod models;
mod scans;
mod screenshots;
mod towns;
pub mod web;

use hsd::diagnostic::Language;
use hsd::fs::FolderWorld;
use hsd::source::{FileId, Source, Span, World};
use hsd::view::{EditorHost, Preview, PreviewOptions, RecursiveMode};
use serde_json::{Value, json};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use tempfile::TempDir;
use web::Web;

const HOUSE: &str = "0 0 180\n9.5\n\nKKS  TKD 2MRE\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n";

/// Files, and an editor that takes down where it was sent.
#[derive(Clone, Default)]
struct Files {
    sent: Arc<Mutex<Vec<String>>>,
    read_only: bool,
    scratch: Arc<Mutex<Vec<TempDir>>>,
}

impl EditorHost for Files {
    fn read(
        &self,
        path: &Path,
        work: &mut dyn FnMut(Source, &dyn World, &hsd::Options),
    ) -> io::Result<()> {
        let folder = path.parent().expect("lies in a folder").to_owned();
        let world = FolderWorld::new(vec![folder.clone()], 1 << 26).with_roots(vec![folder]);
        let source = Source::new(FileId(0), path.to_string_lossy(), &fs::read(path)?);
        work(source, &world, &hsd::Options::default());
        Ok(())
    }

    fn scratch(&self) -> io::Result<PathBuf> {
        let made = tempfile::tempdir()?;
        let path = made.path().to_owned();
        self.scratch.lock().expect("no thread failed").push(made);
        Ok(path)
    }

    fn bytes(&self, path: &Path) -> io::Result<Vec<u8>> {
        fs::read(path)
    }

    fn writes(&self) -> bool {
        !self.read_only
    }

    fn write(&self, path: &Path, before: &[u8], after: &[u8]) -> io::Result<()> {
        assert_eq!(fs::read(path)?, before);
        fs::write(path, after)
    }

    fn opens(&self) -> bool {
        true
    }

    fn open(&self, source: &Source, span: Span) -> io::Result<()> {
        let (line, column) = source.line_column(span);
        let name = Path::new(source.name()).file_name().unwrap_or_default();
        let place = format!("{}:{line}:{column}", name.to_string_lossy());
        self.sent.lock().expect("no thread failed").push(place);
        Ok(())
    }
}

/// A folder of files and the preview of it.
struct Shown {
    folder: TempDir,
    files: Files,
    web: Web,
    _preview: Preview,
}

fn show(texts: &[(&str, &str)], only: Option<&str>, files: Files) -> Shown {
    let folder = tempfile::tempdir().expect("folders can be made");
    for (name, text) in texts {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("lies in a folder")).expect("can be made");
        fs::write(path, text).expect("can be written");
    }
    let preview = Preview::start(PreviewOptions {
        root: folder.path().to_owned(),
        only: only.map(str::to_owned).into_iter().collect(),
        language: Language::English,
        host: Box::new(files.clone()),
        front: None,
        port: 0,
        watched: vec![(folder.path().to_owned(), RecursiveMode::Recursive)],
    });
    let preview = preview.expect("can be shown");
    let web = Web::new(&preview.url());
    Shown {
        folder,
        files,
        web,
        _preview: preview,
    }
}

impl Shown {
    fn save(&self, name: &str, text: &str) {
        fs::write(self.folder.path().join(name), text).expect("can be written");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.folder.path().join(name)).expect("can be read")
    }
}

/// The revision in what was said of a state.
fn revision((name, data): (String, Value)) -> u64 {
    assert_eq!(name, "state");
    data["revision"].as_u64().expect("is a number")
}

#[test]
fn a_page_learns_what_a_text_makes() {
    let shown = show(
        &[("家.hsd", HOUSE), ("town/b.hsd", HOUSE), ("c.txt", "")],
        None,
        Files::default(),
    );
    let hello = shown.web.get("/api/hello").json();
    let paths: Vec<&str> = hello["files"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|f| f["path"].as_str())
        .collect();
    assert_eq!(paths, ["家.hsd", "town/b.hsd"]);
    let state = shown.web.state("%E5%AE%B6.hsd");
    assert_eq!(state["sources"][0]["text"], HOUSE);
    assert_eq!(state["sources"][0]["path"], "家.hsd");
    let walls = &state["plan"]["houses"][0]["storeys"][0]["rings"][0]["walls"];
    assert_eq!(walls.as_array().map(Vec::len), Some(4));
    assert_eq!(walls[0]["units"][1]["code"], "TKD 2");
    shown.save("c.hsd", &HOUSE.replace("KSK  MRE  KSK", "APW  AKI  AIN"));
    let open = shown.web.state("c.hsd");
    let walls = &open["plan"]["houses"][0]["storeys"][0]["rings"][0]["walls"];
    let kinds = [0, 1, 2].map(|unit| walls[1]["units"][unit]["part"].as_str().unwrap_or_default());
    assert_eq!(kinds, ["wall", "opening", "wall"]);
    let revision = &state["revision"];
    let model = shown.web.get(&format!(
        "/api/model/{revision}/house.glb?file=%E5%AE%B6.hsd"
    ));
    assert!(model.body.starts_with(b"glTF"), "{}", model.status);
    let (document, _) = gltf_json(&model.body);
    let pictures = state["pictures"].as_object().expect("are named");
    assert!(!pictures.is_empty());
    for image in document["images"].as_array().expect("has pictures") {
        let name = image["uri"].as_str().expect("lies beside the model");
        assert!(pictures.contains_key(name), "{name}");
        let picture = shown.web.get(&format!("/api/model/{revision}/{name}"));
        assert!(
            picture.headers.contains("content-type: image/"),
            "{}",
            picture.headers
        );
        assert!(picture.body.len() > 100);
    }
}

/// The JSON of a `.glb`, and how long it is.
fn gltf_json(glb: &[u8]) -> (Value, usize) {
    let length = u32::from_le_bytes(glb[12..16].try_into().expect("four bytes")) as usize;
    let document = serde_json::from_slice(&glb[20..20 + length]);
    (document.expect("is JSON"), length)
}

#[test]
fn what_is_saved_is_told_at_once_and_once() {
    let shown = show(
        &[("a.hsd", HOUSE), ("b.hsd", HOUSE)],
        None,
        Files::default(),
    );
    let ear = shown.web.listen("a.hsd");
    let first = revision(ear.hear());
    shown.save("a.hsd", &HOUSE.replace("MRE", "MGA"));
    let second = revision(ear.hear());
    assert!(second > first);
    assert_eq!(shown.web.state("a.hsd")["revision"], second);
    assert!(ear.silent(), "one save is told once");
    shown.save("a.hsd", &HOUSE.replace("MRE", "MGA"));
    assert!(ear.silent(), "what is the same is not told");
    shown.save("b.hsd", "9\n");
    assert!(ear.silent(), "another file is not told of");
    let gone = shown
        .web
        .get(&format!("/api/model/{first}/house.glb?file=a.hsd"));
    assert_eq!(gone.status, 410);
    // Editors put a new file in the place of the old one.
    let new = shown.folder.path().join(".a.hsd.tmp");
    fs::write(&new, HOUSE).expect("can be written");
    fs::rename(new, shown.folder.path().join("a.hsd")).expect("can be renamed");
    assert!(revision(ear.hear()) > second);
}

#[test]
fn a_text_that_was_asked_for_may_end_with_anything() {
    let shown = show(&[("house.txt", HOUSE)], Some("house.txt"), Files::default());
    let hello = shown.web.get("/api/hello").json();
    assert_eq!(
        hello["files"],
        json!([{ "path": "house.txt", "kind": "text" }])
    );
    assert_eq!(hello["file"], "house.txt");
    let ear = shown.web.listen("house.txt");
    let first = revision(ear.hear());
    shown.save("house.txt", &HOUSE.replace("MRE", "MGA"));
    assert!(revision(ear.hear()) > first);
}

#[test]
fn mistakes_are_told_in_place() {
    let shown = show(
        &[("a.hsd", &HOUSE.replace("TKD 2", "TKX 2"))],
        None,
        Files::default(),
    );
    let said = &shown.web.state("a.hsd")["diagnostics"];
    let unknown = said
        .as_array()
        .expect("is a list")
        .iter()
        .find(|d| d["line"] == 4);
    let unknown = unknown.expect("the code is not known");
    assert_eq!(unknown["column"], 6);
    assert!(
        unknown["message"]
            .as_str()
            .is_some_and(|m| m.contains("TKX 2")),
        "{unknown}"
    );
}

#[test]
fn included_files_are_kept_up_with_and_told_apart() {
    let house = "<House>\n<include href=\"walls.hsd\"/>\n<Storey>\n<Row><use name=\"front\"/></Row>\n\
                 <Row>APW  APW</Row>\n<Row>KTU  KTU</Row>\n<Row>APW  APW</Row>\n</Storey>\n</House>\n";
    let walls =
        |part: &str| format!("<Catalog><define name=\"front\">{part}  KTU</define></Catalog>\n");
    let shown = show(
        &[("a.hsd", house), ("walls.hsd", &walls("KTU"))],
        Some("a.hsd"),
        Files::default(),
    );
    let ear = shown.web.listen("a.hsd");
    let first = revision(ear.hear());
    let state = shown.web.state("a.hsd");
    let said = &state["diagnostics"];
    assert_eq!(state["sources"][1]["path"], "walls.hsd", "{said}");
    let front = &state["plan"]["houses"][0]["storeys"][0]["rings"][0]["walls"][0]["units"][0];
    assert_eq!((&front["code"], &front["file"]), (&json!("KTU"), &json!(1)));
    shown.save("walls.hsd", &walls("MRE"));
    assert!(revision(ear.hear()) > first);
}

#[test]
fn the_editor_is_sent_to_what_was_clicked() {
    let text = HOUSE.replace("0 0 180", "# 町家\n0 0 180");
    let shown = show(&[("a.hsd", &text)], None, Files::default());
    let state = shown.web.state("a.hsd");
    let unit = &state["plan"]["houses"][0]["storeys"][0]["rings"][0]["walls"][0]["units"][1];
    let place = json!({ "file": "a.hsd", "id": unit["file"], "span": unit["span"] });
    assert_eq!(shown.web.post("/api/open", &place).status, 200);
    assert_eq!(
        *shown.files.sent.lock().expect("no thread failed"),
        ["a.hsd:5:6"]
    );
    let place = json!({ "file": "a.hsd", "id": 7, "span": [0, 1] });
    assert_eq!(shown.web.post("/api/open", &place).status, 404);
}

#[test]
fn strokes_change_the_text_and_are_taken_back() {
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    let stroke = |part: &str, revision: &Value| {
        let unit = json!({ "do": "set-part", "house": 0, "storey": 0, "ring": 0, "wall": 0, "unit": 2, "part": part });
        let drawn = json!({ "file": "a.hsd", "revision": revision, "stroke": unit });
        shown.web.post("/api/stroke", &drawn).json()
    };
    let step = |way: &str| {
        shown
            .web
            .post(&format!("/api/{way}"), &json!({ "file": "a.hsd" }))
            .json()
    };
    let first = shown.web.state("a.hsd")["revision"].clone();
    let done = stroke("MHI", &first);
    assert!(done["revision"].is_u64(), "{done}");
    let changed = HOUSE.replacen("MRE", "MHI", 1);
    assert_eq!(shown.read("a.hsd"), changed);
    assert_eq!(shown.web.state("a.hsd")["revision"], done["revision"]);
    // Drawn on a plan that is no more.
    assert!(stroke("MGA", &first)["refused"].is_string());
    assert!(stroke("???", &done["revision"])["refused"].is_string());
    assert_eq!(shown.read("a.hsd"), changed);
    assert!(step("undo")["revision"].is_u64());
    assert_eq!(shown.read("a.hsd"), HOUSE);
    assert!(step("redo")["revision"].is_u64());
    assert_eq!(shown.read("a.hsd"), changed);
    shown.save("a.hsd", &format!("{changed}# by hand\n"));
    assert!(
        step("undo")["refused"]
            .as_str()
            .is_some_and(|w| w.contains("elsewhere"))
    );
    assert!(shown.read("a.hsd").ends_with("# by hand\n"));
}

#[test]
fn texts_that_are_not_to_be_changed_stay_as_they_are() {
    let files = Files {
        read_only: true,
        ..Files::default()
    };
    let shown = show(&[("a.hsd", HOUSE)], None, files);
    assert_eq!(shown.web.get("/api/hello").json()["writes"], false);
    let revision = shown.web.state("a.hsd")["revision"].clone();
    let storey = json!({ "do": "add-storey", "house": 0 });
    let drawn = json!({ "file": "a.hsd", "revision": revision, "stroke": storey });
    let said = shown.web.post("/api/stroke", &drawn).json();
    assert!(
        said["refused"]
            .as_str()
            .is_some_and(|w| w.contains("--read-only")),
        "{said}"
    );
    assert_eq!(shown.read("a.hsd"), HOUSE);
}

#[test]
fn the_palette_has_all_parts_and_pictures_of_them() {
    let shown = show(&[("a.hsd", HOUSE)], None, Files::default());
    let parts = shown.web.get("/api/parts?file=a.hsd").json();
    let parts = parts.as_array().expect("is a list");
    assert!(parts.len() > 80, "{}", parts.len());
    assert!(
        parts
            .iter()
            .any(|p| p["code"] == "TKD 2" && p["ja"] == "格子戸引違い")
    );
    let picture = shown.web.get("/api/part?file=a.hsd&code=TKD%202");
    assert!(picture.body.starts_with(b"\xff\xd8"), "{}", picture.status);
    assert_eq!(shown.web.get("/api/part?file=a.hsd&code=nope").status, 404);
}
