//! Towns in steps: `hsd town plan`, `tile` and `seal` make what `hsd town` makes, whatever happens between them.

use super::{code, hsd, names, stderr, stdout};
use crate::support::root;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// A folder with the towns of the examples.
fn towns() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for entry in fs::read_dir(root().join("examples/towns")).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
    }
    folder
}

/// All files below a folder with their bytes.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for name in names(folder) {
        let path = folder.join(&name);
        match path.is_dir() {
            true => all.extend(
                tree(&path)
                    .into_iter()
                    .map(|(below, bytes)| (format!("{name}/{below}"), bytes)),
            ),
            false => drop(all.insert(name, fs::read(path).unwrap())),
        }
    }
    all
}

fn assert_same(folder: &Path, a: &str, b: &str) {
    let (a, b) = (tree(&folder.join(a)), tree(&folder.join(b)));
    let names = |tree: &BTreeMap<String, Vec<u8>>| tree.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b));
    for (name, bytes) in &a {
        assert!(*bytes == b[name], "{name} differs");
    }
    assert!(a.contains_key("tileset.json"));
}

/// Plans a town; returns its keys.
fn plan(folder: &Path, town: &str) -> Vec<String> {
    let planned = hsd(
        folder,
        &["town", "plan", town, "-o", "work", "--detail", "0"],
    );
    assert_eq!(code(&planned), 0, "{}", stderr(&planned));
    let lines = stdout(&planned);
    let keys = lines.lines().map(|line| {
        let cells: Vec<&str> = line.split('\t').collect();
        assert_eq!(cells.len(), 4, "{line}");
        assert!(cells[1].parse::<usize>().is_ok() && cells[2].parse::<u64>().is_ok());
        cells[0].to_owned()
    });
    keys.collect()
}

#[test]
fn the_steps_make_what_one_command_makes() {
    for town in ["block.hsd", "hill.hsd", "law.hsd", "lots.hsd"] {
        let folder = towns();
        let folder = folder.path();
        let plain = hsd(folder, &["town", town, "-o", "plain/", "--detail", "0"]);
        let keys = plan(folder, town);
        assert!(!keys.is_empty(), "{town}");
        // Backwards, one by one, and some of them twice.
        for key in keys.iter().rev().chain(keys.first()) {
            let made = hsd(folder, &["town", "tile", "work", key]);
            assert_eq!(code(&made), 0, "{}", stderr(&made));
            let line = stdout(&made);
            let word = line.trim_end().split('\t').nth(1);
            assert!(matches!(word, Some("made" | "there")), "{line}");
        }
        let sealed = hsd(folder, &["town", "seal", "work", "-o", "sealed"]);
        assert_eq!(code(&sealed), code(&plain), "{}", stderr(&sealed));
        assert_same(folder, "plain", "sealed");
        // What is reported is the same, in the plan or at the end.
        let again = hsd(
            folder,
            &["town", "plan", town, "-o", "work", "--detail", "0"],
        );
        let told = stderr(&again) + &stderr(&sealed);
        for line in stderr(&plain).lines().filter(|l| l.contains("HSD")) {
            assert!(told.contains(line.trim()), "{line}");
        }
        // Nothing is left to do, from another folder and for a folder that lies elsewhere.
        let work = folder.join("work");
        let all = hsd(root(), &["town", "tile", work.to_str().unwrap(), "--all"]);
        assert!(
            stdout(&all).lines().all(|l| l.ends_with("\tthere")),
            "{}",
            stdout(&all)
        );
        let other = folder.join("elsewhere");
        fs::rename(folder.join("work"), &other).unwrap();
        let resealed = hsd(folder, &["town", "seal", "elsewhere", "-o", "sealed", "-q"]);
        assert_eq!(code(&resealed), code(&plain), "{}", stderr(&resealed));
        assert_same(folder, "plain", "sealed");
    }
}

#[test]
fn processes_may_make_the_same_tile_at_a_time() {
    let folder = towns();
    let folder = folder.path();
    let keys = plan(folder, "hill.hsd");
    let start = |_| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
        let command = command
            .current_dir(folder)
            .args(["town", "tile", "work", "-q"]);
        command.args(&keys).stdin(Stdio::null()).spawn().unwrap()
    };
    let running: Vec<_> = (0..3).map(start).collect();
    for mut process in running {
        assert!(process.wait().unwrap().success());
    }
    hsd(
        folder,
        &["town", "hill.hsd", "-o", "plain/", "--detail", "0", "-q"],
    );
    hsd(folder, &["town", "seal", "work", "-o", "sealed", "-q"]);
    assert_same(folder, "plain", "sealed");
}

#[test]
fn only_what_a_change_touches_is_made_again() {
    let folder = towns();
    let folder = folder.path();
    plan(folder, "hill.hsd");
    hsd(folder, &["town", "tile", "work", "--all", "-q"]);
    let town = fs::read_to_string(folder.join("hill.hsd")).unwrap();
    let (before, after) = town.split_once("<for ").unwrap();
    // A rule for the western half.
    let more =
        "<for each=\"houses\" test=\"{x &lt; 0 and x > 100000}\"><Skip because=\"none\"/></for>";
    fs::write(
        folder.join("hill.hsd"),
        format!("{before}{more}<for {after}"),
    )
    .unwrap();
    let stale = hsd(folder, &["town", "tile", "work", "--all"]);
    assert_eq!(code(&stale), 2);
    assert!(stderr(&stale).contains("changed"), "{}", stderr(&stale));
    plan(folder, "hill.hsd");
    let kept = hsd(folder, &["town", "tile", "work", "--all"]);
    // Numbers of rules and lines have changed in the tables of the tiles, or nothing has.
    let words = stdout(&kept);
    assert!(
        words
            .lines()
            .all(|l| l.ends_with("made") || l.ends_with("kept")),
        "{words}"
    );
    hsd(folder, &["town", "seal", "work", "-o", "sealed", "-q"]);
    hsd(
        folder,
        &["town", "hill.hsd", "-o", "plain/", "--detail", "0", "-q"],
    );
    assert_same(folder, "plain", "sealed");
}

#[test]
fn what_cannot_be_done_is_told() {
    let folder = towns();
    let folder = folder.path();
    let none = hsd(folder, &["town", "tile", ".", "0_0"]);
    assert_eq!(
        (code(&none), stderr(&none).contains("hsd town plan")),
        (2, true)
    );
    let keys = plan(folder, "hill.hsd");
    let unknown = hsd(folder, &["town", "tile", "work", "9_9"]);
    assert_eq!(
        (code(&unknown), stderr(&unknown).contains("9_9")),
        (2, true)
    );
    // A damaged part is told, and the other tiles are made.
    let parts = folder.join("work/parts");
    let part = |key: &str| {
        let mut all = names(&parts).into_iter();
        all.find(|name| name.starts_with(&format!("{key}-")))
            .unwrap()
    };
    let damaged = parts.join(part(&keys[0]));
    let bytes = fs::read(&damaged).unwrap();
    fs::write(&damaged, &bytes[..bytes.len() / 2]).unwrap();
    let made = hsd(folder, &["town", "tile", "work", "--all"]);
    assert_eq!((code(&made), stderr(&made).contains(&keys[0])), (1, true));
    assert_eq!(stdout(&made).lines().count(), keys.len() - 1);
    let missing = hsd(folder, &["town", "seal", "work", "-o", "sealed"]);
    assert_eq!(code(&missing), 2);
    assert!(stderr(&missing).contains(&keys[0]), "{}", stderr(&missing));
    assert!(!folder.join("sealed").exists());
    // Its features are in the report of a town that lacks it.
    fs::write(&damaged, &bytes).unwrap();
    let lacking = hsd(
        folder,
        &["town", "seal", "work", "-o", "sealed", "--lacking", "-q"],
    );
    assert_eq!(code(&lacking), 1);
    let report = fs::read_to_string(folder.join("sealed/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let skipped = report["skipped"].as_array().unwrap();
    let built = report["built"].as_u64().unwrap() as usize;
    let unused = report["unused"].as_u64().unwrap() as usize;
    assert_eq!(report["features"], built + skipped.len() + unused);
    assert!(skipped.iter().any(|s| s["code"] == "not made"));
    // The table has a line for each, of as many cells as its head.
    let table = fs::read_to_string(folder.join("sealed/decisions.csv")).unwrap();
    let line = table
        .lines()
        .find(|l| l.contains("its tile was not made"))
        .unwrap();
    assert_eq!(
        line.split(',').count(),
        table.lines().next().unwrap().split(',').count()
    );
    hsd(folder, &["town", "tile", "work", "-q", &keys[0]]);
    hsd(folder, &["town", "seal", "work", "-o", "sealed", "-q"]);
    hsd(
        folder,
        &["town", "hill.hsd", "-o", "plain/", "--detail", "0", "-q"],
    );
    assert_same(folder, "plain", "sealed");
    let stdin = hsd(folder, &["town", "plan", "-", "-o", "work"]);
    assert_eq!(code(&stdin), 2);
}
