//! Towns in tiles: the rules of 3D Tiles, checked by an own reader; the same bytes from any number of threads and after any
//! interruption; only what has changed is made again.

mod lodged;
pub(crate) mod rules;

use crate::support::root;
use hsd::ast::town::Tiles;
use hsd::backend::pieces::Pieces;
use hsd::backend::spool;
use hsd::driver::Options;
use hsd::glam::{DVec3, dvec3};
use hsd::tiles::TileStore;
use hsd::tiles::run::{Reach, TileJob, TiledTown, run};
use hsd::town::plan::Lodging;
use hsd::town::{self, TownInput};
use hsd::{Diagnostics, FileId, FolderWorld, Source};
use rules::{Glb, checked};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Files in memory.
#[derive(Default)]
pub(crate) struct Memory {
    files: Mutex<BTreeMap<String, Vec<u8>>>,
    /// The number of files after which it breaks.
    most: Option<usize>,
    written: AtomicUsize,
}

impl TileStore for Memory {
    fn read(&self, name: &str) -> Option<Vec<u8>> {
        self.files
            .lock()
            .expect("no test panics")
            .get(name)
            .cloned()
    }

    fn has(&self, name: &str) -> bool {
        self.read(name).is_some()
    }

    fn commit(&self, name: &str, bytes: &Pieces) -> io::Result<()> {
        if self.most == Some(self.written.fetch_add(1, Ordering::SeqCst)) {
            return Err(io::Error::other("the power is gone"));
        }
        let mut files = self.files.lock().expect("no test panics");
        let kept = files
            .entry(name.to_owned())
            .or_insert_with(|| bytes.to_vec());
        assert!(bytes.are(kept), "{name} is written twice alike");
        Ok(())
    }
}

/// A town that has been built.
pub(crate) struct Built {
    pub(crate) town: TiledTown,
    decisions: String,
    files: BTreeMap<String, Vec<u8>>,
    tileset: Value,
    /// The other files of the tree.
    branches: BTreeMap<String, Value>,
}

impl Built {
    /// The bytes of everything.
    pub(crate) fn all(&self) -> (String, BTreeMap<String, Vec<u8>>, String) {
        let decisions = self.decisions.clone();
        let tree = format!("{}{:?}", self.tileset, self.branches);
        (tree, self.files.clone(), decisions)
    }
}

pub(crate) fn build(
    text: &str,
    folder: &Path,
    store: &Memory,
    threads: usize,
) -> io::Result<Built> {
    build_within((Reach::All, false), text, folder, store, threads)
}

fn build_within(
    (reach, spooled): (Reach, bool),
    text: &str,
    folder: &Path,
    store: &Memory,
    threads: usize,
) -> io::Result<Built> {
    let name = folder.join("town.hsd");
    let source = Source::new(FileId(0), name.to_string_lossy(), text.as_bytes());
    let world = FolderWorld::new(vec![], 1 << 20).with_roots(vec![folder.to_owned()]);
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let mut read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let written = read.documents.iter_mut().find_map(|d| d.town.take());
    let written = written.expect("is a town");
    let input = TownInput::new(&source, &world, &options);
    let lodging = spooled.then_some(Lodging {
        new: &spool::in_memory,
        from: 0,
    });
    let plan = town::run::plan_lodged(input, &written, lodging, &mut out)?;
    let plan = plan.expect("its maps are read");
    assert_eq!(plan.lodged.is_some(), spooled);
    let division: Tiles = written.tiles.clone();
    let job = TileJob {
        input,
        plan: &plan,
        catalog: &read.catalog,
        parts: &[],
        written: &[],
        year: Some("1928"),
        division: &division,
        reach,
        threads,
        packed: false,
        spool: spooled.then_some(&spool::in_memory),
    };
    let mut town = run(job, store, &|_| {}, &mut out)?;
    assert!(!out.has_errors(), "{:?}", out.iter().collect::<Vec<_>>());
    let tree = town.tileset(&plan);
    let json = |bytes: &[u8]| serde_json::from_slice(bytes).expect("is JSON");
    let branches = tree.branches.iter();
    let branches = branches.map(|(name, bytes)| (name.clone(), json(bytes)));
    let files = store.files.lock().expect("no test panics").clone();
    let mut decisions = vec![];
    town.ledger.decisions.write(&mut decisions)?;
    Ok(Built {
        town,
        decisions: String::from_utf8(decisions).expect("is text"),
        files,
        tileset: json(&tree.root),
        branches: branches.collect(),
    })
}

/// A folder with a map of rows of houses along streets, in a plane zone near Kyoto or in local metres.
fn map(rows: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut houses, mut roads) = (vec![], vec![]);
    for row in 0..rows {
        let y = row as f64 * 60.0 - 90.0;
        roads.push(format!(
            r#"{{"type":"Feature","properties":{{"width":4}},"geometry":{{"type":"LineString","coordinates":[[-120,{0}],[120,{0}]]}}}}"#,
            y - 3.0
        ));
        for n in 0..12 {
            let (x, w) = (f64::from(n) * 9.0 - 60.0, 4.0 + f64::from(n % 3));
            let (e, north) = (x + w, y + 8.0);
            houses.push(format!(
                r#"{{"type":"Feature","properties":{{"key":"h{row}-{n}","quarter":"{}"}},"geometry":{{"type":"Polygon","coordinates":[[[{x},{y}],[{e},{y}],[{e},{north}],[{x},{north}],[{x},{y}]]]}}}}"#,
                if n < 5 { "west" } else { "東" }
            ));
        }
    }
    for (name, list) in [("houses.geojson", houses), ("roads.geojson", roads)] {
        let text = format!(
            r#"{{"type":"FeatureCollection","features":[{}]}}"#,
            list.join(",")
        );
        fs::write(folder.path().join(name), text).expect("is written");
    }
    folder
}

fn text(rules: &str, tiles: &str) -> String {
    format!(
        "<Town seed=\"1\">\n<Layer name=\"houses\" src=\"houses.geojson\" crs=\"local\" key=\"key\" evidence=\"a drawing\"/>\n<Layer name=\"roads\" src=\"roads.geojson\" crs=\"local\"/>\n{rules}\n{tiles}</Town>"
    )
}

const RULES: &str = "<for each=\"houses\"><random><choice weight=\"1\"><Place type=\"so-nikai\"/></choice>\n<choice weight=\"1\"><Place type=\"kanban\"/></choice></random></for>";

#[test]
fn every_feature_is_in_one_tile_of_each_level() {
    let folder = map(4);
    let text = text(RULES, "<Tiles size=\"50\" detail=\"0,2,3\"/>");
    let built = build(&text, folder.path(), &Memory::default(), 2).expect("nothing fails");
    let found = checked(&built);
    let mut keys: Vec<String> = (0..4)
        .flat_map(|row| (0..12).map(move |n| format!("h{row}-{n}")))
        .collect();
    keys.sort();
    assert_eq!(found.keys.len(), 3, "levels");
    for level in found.keys.values() {
        assert_eq!(*level, keys);
    }
    assert!(built.town.tiles.len() >= 8, "{}", built.town.tiles.len());
    assert_eq!(built.town.ledger.report.built, 48);
    assert!(built.town.zero.is_none() && built.tileset["root"]["transform"].is_null());
    assert!(built.branches.is_empty());
    let stems: Vec<&str> = built.town.tiles.iter().map(|t| &*t.tile).collect();
    assert!(
        stems.contains(&"-1_0") && stems.contains(&"0_-1"),
        "{stems:?}"
    );
}

#[test]
fn tables_of_tiles_tell_what_is_known_of_a_house() {
    let folder = map(1);
    let text = text(RULES, "<Tiles by=\"quarter\" detail=\"0\"/>");
    let built = build(&text, folder.path(), &Memory::default(), 1).expect("nothing fails");
    checked(&built);
    assert_eq!(built.town.tiles.len(), 2, "one for each value");
    for tile in &built.town.tiles {
        let glb = Glb::new(&built.files[&tile.levels[0].file]);
        assert!(glb.texts("evidence").iter().all(|e| e == "a drawing"));
        assert!(glb.texts("year").iter().all(|y| y == "1928"));
        for (kind, line) in glb.texts("type").iter().zip(glb.lines()) {
            let wanted = if kind == "so-nikai" { 4 } else { 5 };
            assert_eq!(line, wanted, "{kind} stands there in the file");
        }
        assert!(
            glb.texts("parameters")
                .iter()
                .all(|p| p.contains("frontage="))
        );
    }
}

#[test]
fn threads_change_no_byte() {
    let folder = map(3);
    let text = text(RULES, "<Tiles size=\"40\" detail=\"0,1\"/>");
    let of = |threads| {
        let built = build(&text, folder.path(), &Memory::default(), threads);
        built.expect("nothing fails").all()
    };
    let one = of(1);
    assert!(one == of(2) && one == of(7));
}

#[test]
fn a_run_that_was_interrupted_goes_on() {
    let folder = map(2);
    let text = text(RULES, "<Tiles size=\"40\" detail=\"0\"/>");
    let whole = build(&text, folder.path(), &Memory::default(), 1).expect("nothing fails");
    let mut kept = 0;
    for most in (0..whole.files.len()).step_by(3) {
        let store = Memory {
            most: Some(most),
            ..Memory::default()
        };
        build(&text, folder.path(), &store, 2)
            .err()
            .expect("it breaks");
        let store = Memory {
            files: store.files,
            ..Memory::default()
        };
        let again = build(&text, folder.path(), &store, 2).expect("nothing fails");
        assert!(again.all() == whole.all(), "after {most} files");
        kept += again.town.kept;
    }
    assert!(kept > 0, "some tiles were there already");
}

#[test]
fn the_middle_comes_first_and_is_a_part_of_the_whole() {
    let folder = map(4);
    let text = text(RULES, "<Tiles size=\"20\" detail=\"0\"/>");
    let whole = build(&text, folder.path(), &Memory::default(), 1).expect("nothing fails");
    let store = Memory::default();
    let middle = build_within((Reach::Middle(9), false), &text, folder.path(), &store, 2);
    let middle = middle.expect("nothing fails");
    assert!(middle.town.ledger.report.features >= 9);
    assert!(middle.town.tiles.len() * 2 < whole.town.tiles.len());
    assert!(
        middle
            .files
            .iter()
            .all(|(name, bytes)| whole.files[name] == *bytes)
    );
    // Cells of 20 m by the names of their tiles; the houses reach as far as those of all.
    let cell = |tile: &str| -> [f64; 2] {
        let (east, north) = tile.split_once('_').expect("is a cell");
        [east, north].map(|n| n.parse::<f64>().expect("is a number"))
    };
    let cells = |town: &TiledTown| town.tiles.iter().map(|t| cell(&t.tile)).collect::<Vec<_>>();
    let (all, first) = (cells(&whole.town), cells(&middle.town));
    let of = |k: usize, f: fn(f64, f64) -> f64| all.iter().map(|c| c[k]).reduce(f).expect("some");
    let centre = [0, 1].map(|k| (of(k, f64::min) + of(k, f64::max)) / 2.0);
    let away = |c: &[f64; 2]| (c[0] - centre[0]).hypot(c[1] - centre[1]);
    let farthest = first.iter().map(away).fold(0.0, f64::max);
    let left = all.iter().filter(|c| !first.contains(c));
    assert!(left.map(away).all(|far| far >= farthest));
    // The rest follows, and nothing tells that it came later.
    let rest = build(&text, folder.path(), &store, 2).expect("nothing fails");
    assert_eq!(rest.town.kept, middle.town.tiles.len());
    assert!(rest.all() == whole.all());
}

/// All files below a folder.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for below in ["", "tiles", "textures"] {
        for entry in fs::read_dir(folder.join(below))
            .into_iter()
            .flatten()
            .flatten()
        {
            if entry.path().is_file() {
                let name = format!("{below}/{}", entry.file_name().to_string_lossy());
                all.insert(name, fs::read(entry.path()).expect("is read"));
            }
        }
    }
    all
}

#[test]
fn a_run_that_was_killed_goes_on_to_the_same_bytes() {
    let folder = map(3);
    let file = folder.path().join("town.hsd");
    fs::write(&file, text(RULES, "<Tiles size=\"30\" detail=\"0,1\"/>")).expect("is written");
    let program = |out: &Path| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_hsd"));
        command.args(["town", "--quiet", "--threads", "2"]);
        command.arg(&file).arg("-o").arg(out);
        command.stderr(std::process::Stdio::null());
        command
    };
    let (whole, killed) = (folder.path().join("whole"), folder.path().join("killed"));
    assert!(program(&whole).status().expect("runs").success());
    let (whole, mut partly) = (tree(&whole), 0);
    for moment in [20, 60, 110, 170, 240, 320] {
        let mut run = program(&killed).spawn().expect("runs");
        std::thread::sleep(std::time::Duration::from_millis(moment));
        // SIGKILL on Unix; it may have ended by itself.
        let _ = run.kill();
        run.wait().expect("ends");
        let there = tree(&killed);
        partly += usize::from(!there.is_empty() && there.len() < whole.len());
        for (name, bytes) in there.iter().filter(|(name, _)| !name.contains("/.hsd-")) {
            assert_eq!(
                Some(bytes),
                whole.get(name),
                "{name} is whole after {moment} ms"
            );
        }
    }
    eprintln!("{partly} of 6 runs were killed before they ended");
    assert!(program(&killed).status().expect("runs").success());
    let killed = tree(&killed);
    assert!(
        killed.keys().eq(whole.keys()),
        "nothing is left behind or missing"
    );
    assert!(killed == whole);
}

#[test]
fn only_what_has_changed_is_made_again() {
    let folder = map(2);
    let rules = |kind: &str| {
        format!(
            "<for each=\"houses\" test=\"{{key = 'h0-0'}}\"><Place type=\"{kind}\"/></for><for each=\"houses\" test=\"{{key != 'h0-0'}}\"><Place type=\"so-nikai\"/></for>"
        )
    };
    let tiles = "<Tiles size=\"40\" detail=\"0\"/>";
    let store = Memory::default();
    let before = build(&text(&rules("so-nikai"), tiles), folder.path(), &store, 2);
    let before = before.expect("nothing fails").town;
    assert_eq!(before.kept, 0);
    let after = build(&text(&rules("chu-nikai"), tiles), folder.path(), &store, 2);
    let after = after.expect("nothing fails").town;
    assert_eq!(
        after.kept,
        before.tiles.len() - 1,
        "all but the tile of that house"
    );
    let same = build(&text(&rules("chu-nikai"), tiles), folder.path(), &store, 2);
    assert_eq!(same.expect("nothing fails").town.kept, after.tiles.len());
}

#[test]
fn a_tree_of_many_tiles_is_several_files() {
    let folder = map(50);
    let rules = "<for each=\"houses\"><Place type=\"kura\" on=\"centre\"/></for>";
    let text = text(rules, "<Tiles size=\"10\" detail=\"0\"/>");
    let built = build(&text, folder.path(), &Memory::default(), 2).expect("nothing fails");
    assert!(built.town.tiles.len() > 512, "{}", built.town.tiles.len());
    assert!(built.branches.len() >= 4, "{}", built.branches.len());
    let found = checked(&built);
    assert_eq!(found.keys[&0].len(), 600);
    let again = build(&text, folder.path(), &Memory::default(), 1).expect("nothing fails");
    assert!(again.branches == built.branches && again.tileset == built.tileset);
}

#[test]
fn a_town_with_a_plane_stands_on_the_globe() {
    let Some(data) = root()
        .parent()
        .map(|p| p.join("shared/data/osm_kyoto_route18"))
    else {
        return;
    };
    let source = data.join("buildings.geojson");
    if !source.is_file() {
        eprintln!("skipped: no real maps at {}", data.display());
        return;
    }
    let text = "<Town><Layer name=\"houses\" src=\"buildings.geojson\"/><for each=\"houses\" test=\"{area &gt; 400}\"><Place type=\"kura\" on=\"centre\"/></for><for each=\"houses\" test=\"{area &lt;= 400}\"><Skip because=\"small\"/></for><Tiles size=\"250\" detail=\"0\"/></Town>";
    let built = build(text, &data, &Memory::default(), 2).expect("nothing fails");
    checked(&built);
    let transform = built.tileset["root"]["transform"]
        .as_array()
        .expect("is placed");
    let m: Vec<f64> = transform.iter().filter_map(Value::as_f64).collect();
    let place = dvec3(m[12], m[13], m[14]);
    assert_eq!(built.town.zero, Some(0.0));
    let text = text.replace("<Town>", "<Town geoid=\"yes\">");
    let from_sea = build(&text, &data, &Memory::default(), 2).expect("nothing fails");
    let rise = from_sea.town.zero.expect("is placed");
    assert!((rise - 36.7).abs() < 0.3, "{rise}");
    let raised = &from_sea.tileset["root"]["transform"];
    let raised = [12, 13, 14].map(|n| raised[n].as_f64().expect("a number"));
    assert!((DVec3::from_array(raised).distance(place) - rise).abs() < 1e-6);
    assert_eq!(from_sea.files, built.files, "the tiles are the same");
    // Kyoto, at 135.75 E 35.00 N.
    let lon = place.y.atan2(place.x).to_degrees();
    assert!((lon - 135.75).abs() < 0.05, "{lon}");
    assert!((place.z / place.length() - 0.571).abs() < 0.005, "{place}");
}
