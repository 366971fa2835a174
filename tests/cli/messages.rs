//! What hsd says to programs and packagers: `--messages json`, manual pages, what is in a build.

use super::{code, folder, hsd, names, stderr, stdout};
use crate::support::root;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Output;

/// The lines on standard output.
fn told(output: &Output) -> Vec<Value> {
    let text = stdout(output);
    let lines = text.lines();
    lines
        .map(|line| serde_json::from_str(line).unwrap_or_else(|why| panic!("{why}: {line}")))
        .collect()
}

fn files(line: &Value) -> Vec<&str> {
    let files = line["files"].as_array().expect("has files");
    files.iter().map(|file| file.as_str().unwrap()).collect()
}

#[test]
fn a_build_says_all_in_one_call() {
    let folder = folder();
    let example = |name: &str, to: &str| {
        let to = folder.path().join(to);
        fs::copy(root().join("examples").join(name), to).unwrap();
    };
    fs::create_dir(folder.path().join("tea-shop")).unwrap();
    fs::create_dir(folder.path().join("textures")).unwrap();
    example("tea-shop.hsd", "shop.hsd");
    example("tea-shop/parts.hsd", "tea-shop/parts.hsd");
    let signs = [1, 2, 3].map(|n| format!("textures/SIGN.{n}.png"));
    for sign in &signs {
        example(sign, sign);
    }
    for options in [&[][..], &["--bake"]] {
        let arguments = ["build", "--messages", "json", "shop.hsd", "-o", "shop.glb"];
        let run = hsd(folder.path(), &[&arguments[..], options].concat());
        assert_eq!((code(&run), &*stderr(&run)), (0, ""));
        let lines = told(&run);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert_eq!(
            (&lines[0]["kind"], &lines[0]["output"]),
            (&"built".into(), &"shop.glb".into())
        );
        assert_eq!(lines[0]["messages"], Value::Array(vec![]));
        let mut read = vec!["shop.hsd", "tea-shop/parts.hsd"];
        read.extend(signs.iter().map(String::as_str));
        assert_eq!(files(&lines[0]), read);
    }
}

#[test]
fn errors_are_those_of_check_and_leave_no_output() {
    let folder = folder();
    let both = [
        "build",
        "--messages",
        "json",
        "sound.hsd",
        "broken.hsd",
        "-o",
        "out/",
    ];
    let run = hsd(folder.path(), &both);
    assert_eq!((code(&run), &*stderr(&run)), (1, ""));
    let lines = told(&run);
    let kinds: Vec<&str> = lines.iter().map(|l| l["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["built", "progress", "built", "progress"]);
    assert_eq!((&lines[3]["done"], &lines[3]["of"]), (&2.into(), &2.into()));
    assert_eq!(lines[2]["output"], Value::Null);
    let check = hsd(folder.path(), &["check", "--format", "json", "broken.hsd"]);
    let check: Value = serde_json::from_str(&stdout(&check)).unwrap();
    assert_eq!(lines[2]["messages"], check);
    assert_eq!(names(&folder.path().join("out")), ["sound.glb"]);
    // In the language asked for, and of two streams that go one way.
    let run = hsd(folder.path(), &[&["--lang", "ja"][..], &both[..]].concat());
    assert!(!stdout(&run).is_ascii());
    let run = hsd(
        folder.path(),
        &["build", "--messages", "json", "sound.hsd", "-o", "-"],
    );
    assert_eq!((code(&run), &*stdout(&run)), (2, ""));
    assert!(stderr(&run).contains("--messages json"), "{}", stderr(&run));
}

#[test]
fn towns_tell_how_far_they_are() {
    let folder = folder();
    for entry in fs::read_dir(root().join("examples/towns")).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.path().join(entry.file_name())).unwrap();
    }
    let town = |out: &str| {
        let arguments = [
            "town",
            "--messages",
            "json",
            "--detail",
            "0",
            "block.hsd",
            "-o",
            out,
        ];
        let run = hsd(folder.path(), &arguments);
        // A feature of it has no house, as the file says.
        assert_eq!((code(&run), &*stderr(&run)), (0, ""), "{out}");
        let mut lines = told(&run);
        let last = lines.pop().expect("says something");
        assert_eq!(
            (&last["kind"], &last["output"]),
            (&"built".into(), &out.into())
        );
        let files = files(&last);
        for name in ["block.hsd", "block-houses.geojson", "shares.csv"] {
            assert!(
                files.iter().any(|f| Path::new(f).ends_with(name)),
                "{name}: {files:?}"
            );
        }
        lines
    };
    for (out, report) in [
        ("town.glb", "town.report.json"),
        ("town.obj", "town.report.json"),
        ("town.city.jsonl", "town.city.report.json"),
        ("houses.hsd", "houses.report.json"),
        ("town/", "town/report.json"),
    ] {
        let lines = town(out);
        let done: Vec<u64> = lines.iter().map(|l| l["done"].as_u64().unwrap()).collect();
        assert!(done.is_sorted() && !done.is_empty(), "{out}: {done:?}");
        let report = fs::read_to_string(folder.path().join(report)).unwrap();
        let report: Value = serde_json::from_str(&report).unwrap();
        let last = lines.last().expect("is not empty");
        let count = |name: &str| report[name].as_u64().unwrap();
        let all = Value::from(count("features") - count("unused"));
        assert_eq!((&last["done"], &last["of"]), (&all, &all), "{out}");
    }
    // A town that cannot be read is told likewise.
    fs::write(
        folder.path().join("none.hsd"),
        "<Town><Layer name=\"a\" src=\"none.geojson\"/></Town>",
    )
    .unwrap();
    let run = hsd(
        folder.path(),
        &["town", "--messages", "json", "none.hsd", "-o", "none/"],
    );
    let lines = told(&run);
    assert_eq!((code(&run), &lines[0]["output"]), (1, &Value::Null));
    assert!(!lines[0]["messages"].as_array().unwrap().is_empty());
}

#[test]
fn every_command_has_a_page() {
    let folder = folder();
    for (lang, out) in [("en", "man"), ("en", "again"), ("ja", "ja")] {
        let run = hsd(folder.path(), &["--lang", lang, "man", out]);
        assert_eq!((code(&run), &*stdout(&run)), (0, ""));
    }
    let pages = names(&folder.path().join("man"));
    for name in [
        "hsd.1",
        "hsd-build.1",
        "hsd-town.1",
        "hsd-town-init.1",
        "hsd-man.1",
    ] {
        assert!(pages.iter().any(|page| page == name), "{name}: {pages:?}");
    }
    for name in &pages {
        let read = |of: &str| fs::read_to_string(folder.path().join(of).join(name)).unwrap();
        let page = read("man");
        assert_eq!(page, read("again"));
        assert!(
            page.contains(".SH SYNOPSIS") && page.contains(env!("CARGO_PKG_VERSION")),
            "{page}"
        );
        let page = read("ja");
        let headings = page.lines().filter_map(|line| line.strip_prefix(".SH "));
        let headings: Vec<&str> = headings.collect();
        assert!(
            headings.starts_with(&["名前", "書式", "説明"]),
            "{headings:?}"
        );
        assert!(headings.iter().all(|h| !h.is_ascii()), "{headings:?}");
    }
}

#[test]
fn the_version_tells_what_is_in_it() {
    let folder = folder();
    let told = stdout(&hsd(folder.path(), &["--version"]));
    let (first, rest) = told.split_once('\n').expect("has lines");
    assert_eq!(first, format!("hsd {}", env!("CARGO_PKG_VERSION")));
    let compress = if cfg!(feature = "compress") {
        "yes"
    } else {
        "no"
    };
    assert!(
        rest.contains(&format!("--compress:       {compress}\n")),
        "{rest}"
    );
    assert!(rest.contains(" house types"), "{rest}");
    assert_eq!(stdout(&hsd(folder.path(), &["-V"])), format!("{first}\n"));
}
