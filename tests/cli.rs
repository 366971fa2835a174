//! The program as its users run it.

mod accounts;
#[cfg(target_os = "linux")]
mod desktop;
mod draw;
mod facade;
mod fmt;
mod folders;
mod languages;
mod leftovers;
mod messages;
mod overwrites;
mod plan;
mod printing;
mod render;
mod steps;

use hsd::fs::FolderWorld;
use hsd::source::World;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

const SOUND: &str = "0 0\n\n\nKSK  KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n";
/// A tab where blanks belong, in its second wall line.
const BROKEN: &str = "0 0\n\n\nKSK  KSK\nKSK\tKSK\nKSK  KSK\nKSK  KSK\n";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("sound.hsd"), SOUND).unwrap();
    fs::write(folder.path().join("broken.hsd"), BROKEN).unwrap();
    folder
}

fn hsd(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
    command
        .current_dir(folder)
        .args(arguments)
        .env("LC_ALL", "C")
        .stdin(Stdio::null());
    command.output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn exit_status_tells_what_happened() {
    let folder = folder();
    for (arguments, expected) in [
        (&["check", "sound.hsd"][..], 0),
        (&["check", "broken.hsd"], 1),
        (&["build", "broken.hsd", "-o", "x.glb"], 1),
        (&["build", "sound.hsd", "-o", "x.glb"], 0),
        (&["build"], 2),
        (&["no-such-command"], 2),
        (&["build", "sound.hsd", "-o", "x.fbx"], 2),
        (&["check", "missing.hsd"], 3),
        (&["check", "."], 3),
        (&["build", "sound.hsd", "-o", "no/such/folder/x.glb"], 3),
        (&["check", "--textures", "nowhere", "sound.hsd"], 3),
        (&["explain", "HSD9999"], 2),
        (&["build", "sound.hsd", "-o", "plain"], 2),
        (&["build", "sound.hsd", "-o", "plain", "--format", "stl"], 0),
        (&["build", "sound.hsd", "new.glb"], 2),
        (&["sound.hsd"], 2),
        (&["--help"], 0),
        (&["build", "--help"], 0),
    ] {
        let output = hsd(folder.path(), arguments);
        assert_eq!(
            code(&output),
            expected,
            "{arguments:?}: {}",
            stderr(&output)
        );
    }
}

#[test]
fn a_missing_file_hides_no_other() {
    let folder = folder();
    let files = ["missing.hsd", "broken.hsd", "nowhere/x.hsd"];
    let output = hsd(
        folder.path(),
        &[&["check", "--format", "json"], &files[..]].concat(),
    );
    assert_eq!(code(&output), 3);
    let told: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let told = told.as_array().unwrap();
    let of = |file: &str| told.iter().filter(|t| t["file"] == file).count();
    assert_eq!((of("missing.hsd"), of("nowhere/x.hsd")), (1, 1));
    assert!(of("broken.hsd") > 0);
    assert_eq!(told[0]["code"], "HSD0008");
    let output = hsd(folder.path(), &["check", "sound.hsd", "missing.hsd"]);
    assert_eq!(code(&output), 3);
    assert!(
        stdout(&output).contains("missing.hsd"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn wrong_usage_is_told_the_right_one() {
    let folder = folder();
    for (arguments, expected) in [
        (
            &["sound.hsd"][..],
            "to build a model from it: hsd build sound.hsd",
        ),
        (
            &["build", "sound.hsd", "new.glb"],
            "name the output with -o, as in `-o new.glb`",
        ),
        (
            &["build", "sound.hsd", "-o", "m"],
            "or .stl; for a folder, write `m/`",
        ),
        (
            &["build", "sound.hsd", "-o", "no/x.glb"],
            "hsd: no/x.glb: no such folder: no\n",
        ),
        (
            &["build", "sound.hsd", "-o", "no/x.obj"],
            "no such folder: no\n",
        ),
    ] {
        let said = stderr(&hsd(folder.path(), arguments));
        assert!(said.contains(expected) && !said.contains(".hsd-"), "{said}");
    }
}

#[test]
fn models_for_the_web_are_an_extra() {
    let folder = folder();
    let output = hsd(folder.path(), &["build", "--compress", "sound.hsd"]);
    if cfg!(feature = "compress") {
        assert_eq!(code(&output), 0);
        assert!(folder.path().join("sound.glb").exists());
    } else {
        let said = stderr(&output);
        assert_eq!(code(&output), 2);
        assert!(said.contains("--features compress"), "{said}");
        assert_eq!(said.trim_end().lines().count(), 1, "{said}");
        assert_eq!(names(folder.path()), ["broken.hsd", "sound.hsd"]);
    }
    let obj = ["build", "--compress", "sound.hsd", "-o", "a.obj"];
    assert_eq!(code(&hsd(folder.path(), &obj)), 2);
}

#[test]
fn errors_leave_nothing_behind() {
    let folder = folder();
    fs::write(folder.path().join("x.glb"), "before").unwrap();
    let output = hsd(folder.path(), &["build", "broken.hsd", "-o", "x.glb"]);
    assert_eq!(code(&output), 1);
    assert!(
        stderr(&output).contains("broken.hsd:5:4"),
        "{}",
        stderr(&output)
    );
    assert!(!stderr(&output).contains('\u{1b}'), "no colours in a pipe");
    assert_eq!(fs::read(folder.path().join("x.glb")).unwrap(), b"before");
    assert_eq!(names(folder.path()), ["broken.hsd", "sound.hsd", "x.glb"]);
}

#[test]
fn endings_choose_the_format() {
    let folder = folder();
    for (out, begins) in [
        ("a.glb", &b"glTF"[..]),
        ("a.gltf", b"{\"asset\""),
        ("a.obj", b"# hsd "),
        ("a.STL", b"hsd "),
    ] {
        let output = hsd(folder.path(), &["build", "sound.hsd", "-o", out]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(stderr(&output).starts_with(&format!("wrote {out}: 1 house, ")));
        assert!(output.stdout.is_empty());
        assert!(
            fs::read(folder.path().join(out))
                .unwrap()
                .starts_with(begins),
            "{out}"
        );
    }
    let files = names(folder.path());
    for file in ["a.bin", "a.mtl", "a_textures"] {
        assert!(files.iter().any(|f| f == file), "{file} in {files:?}");
    }
    assert!(!files.iter().any(|f| f.starts_with(".hsd")), "{files:?}");
}

#[test]
fn the_same_text_makes_the_same_bytes() {
    let folder = folder();
    for out in ["a.glb", "b.glb"] {
        assert_eq!(
            code(&hsd(
                folder.path(),
                &["build", "sound.hsd", "-q", "-o", out]
            )),
            0
        );
    }
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("a.glb"), read("b.glb"));
}

#[test]
fn a_folder_takes_a_model_for_each_text() {
    let folder = folder();
    fs::write(folder.path().join("second.hsd"), SOUND).unwrap();
    let output = hsd(
        folder.path(),
        &[
            "build",
            "sound.hsd",
            "broken.hsd",
            "second.hsd",
            "-o",
            "out/",
        ],
    );
    assert_eq!(code(&output), 1, "one of them is broken");
    assert_eq!(
        names(&folder.path().join("out")),
        ["second.glb", "sound.glb"]
    );
    assert!(
        stderr(&output).ends_with("wrote 2 models, 1 model not written\n"),
        "{}",
        stderr(&output)
    );
    fs::create_dir(folder.path().join("other")).unwrap();
    fs::write(folder.path().join("other/Sound.hsd"), SOUND).unwrap();
    let output = hsd(
        folder.path(),
        &["build", "sound.hsd", "other/Sound.hsd", "-o", "out"],
    );
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("would both be written to"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn files_that_are_checked_together_stand_apart() {
    let folder = folder();
    fs::write(folder.path().join("second.hsd"), SOUND).unwrap();
    let output = hsd(folder.path(), &["check", "sound.hsd", "second.hsd"]);
    assert_eq!(code(&output), 0);
    assert!(!stdout(&output).contains("HSD0420"), "{}", stdout(&output));
    // In one scene they are put side by side, unless they say where they stand.
    let one = ["build", "sound.hsd", "second.hsd", "-o", "both.glb"];
    let said = stderr(&hsd(folder.path(), &one));
    assert!(
        said.contains("HSD0431") && !said.contains("HSD0420"),
        "{said}"
    );
    let placed = format!("1 0{}", &SOUND[3..]);
    fs::write(folder.path().join("sound.hsd"), &placed).unwrap();
    fs::write(folder.path().join("second.hsd"), &placed).unwrap();
    let said = stderr(&hsd(folder.path(), &one));
    assert!(
        said.contains("HSD0420") && !said.contains("HSD0431"),
        "{said}"
    );
}

#[test]
fn texts_of_one_scene_share_a_file() {
    let folder = folder();
    let beside = format!("30 0{}", &SOUND[3..]);
    fs::write(folder.path().join("second.hsd"), beside).unwrap();
    let output = hsd(
        folder.path(),
        &["build", "sound.hsd", "second.hsd", "-o", "both.glb"],
    );
    assert!(
        stderr(&output).starts_with("wrote both.glb: 2 houses"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn without_a_place_models_stand_beside_their_texts() {
    let folder = folder();
    fs::create_dir(folder.path().join("street")).unwrap();
    fs::write(folder.path().join("street/家.hsd"), SOUND).unwrap();
    assert_eq!(code(&hsd(folder.path(), &["build", "street/家.hsd"])), 0);
    assert_eq!(names(&folder.path().join("street")), ["家.glb", "家.hsd"]);
}

#[test]
fn texts_are_not_overwritten() {
    let folder = folder();
    fs::write(folder.path().join("text.obj"), SOUND).unwrap();
    let output = hsd(folder.path(), &["build", "text.obj", "-o", "text.obj"]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert_eq!(
        fs::read(folder.path().join("text.obj")).unwrap(),
        SOUND.as_bytes()
    );
}

fn piped(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hsd"))
        .args(arguments)
        .env("LC_ALL", "C")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that refuses its arguments is gone before it reads.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

#[test]
fn pipes_carry_models() {
    let output = piped(&["build", "-", "-o", "-"], SOUND);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(output.stdout.starts_with(b"glTF"));
    assert!(stderr(&output).starts_with("wrote the model: 1 house"));
    assert_eq!(piped(&["build", "-"], SOUND).stdout, output.stdout);
    let output = piped(&["build", "-", "-o", "-", "--format", "obj"], SOUND);
    assert_eq!(code(&output), 2, "an OBJ has files beside it");
    let output = piped(&["check", "--format", "short", "-"], BROKEN);
    assert!(
        stdout(&output).starts_with("<stdin>:5:4: error[HSD01"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn closed_pipes_are_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hsd"))
        .args(["parts", "--format", "json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn large_files_are_refused_unread() {
    let folder = folder();
    let output = hsd(
        folder.path(),
        &[
            "check",
            "--max-bytes",
            "10",
            "--format",
            "json",
            "sound.hsd",
        ],
    );
    assert_eq!(code(&output), 1);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json.as_array().unwrap().len(), 1, "{json}");
    assert_eq!(
        (&json[0]["code"], &json[0]["span"]["end"]),
        (&"HSD0901".into(), &0.into())
    );
}

#[test]
fn formats_of_check_go_to_standard_output() {
    let folder = folder();
    let run = |format| {
        hsd(
            folder.path(),
            &["check", "--format", format, "broken.hsd", "sound.hsd"],
        )
    };
    let json: serde_json::Value = serde_json::from_slice(&run("json").stdout).unwrap();
    assert_eq!(
        (&json[0]["line"], &json[0]["column"]),
        (&5.into(), &4.into())
    );
    assert_eq!(json[0]["file"], "broken.hsd");
    let sarif: serde_json::Value = serde_json::from_slice(&run("sarif").stdout).unwrap();
    assert_eq!(sarif["runs"][0]["results"][0]["ruleId"], json[0]["code"]);
    assert!(stdout(&run("human")).contains("╭─[broken.hsd:5:4]"));
    let clean = hsd(folder.path(), &["check", "--format", "json", "sound.hsd"]);
    assert_eq!((code(&clean), stdout(&clean)), (0, "[]\n".to_owned()));
}

#[test]
fn dumps_are_json() {
    let folder = folder();
    for stage in ["ast", "program", "building", "regions", "scene"] {
        let output = hsd(folder.path(), &["dump", "--stage", stage, "sound.hsd"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let version = if stage == "building" { 2 } else { 1 };
        assert_eq!(json["version"], version, "{stage}");
    }
}

#[test]
fn regions_can_be_drawn() {
    let folder = folder();
    let drawn = |stage| {
        let command = ["dump", "--stage", stage, "--format", "svg", "sound.hsd"];
        hsd(folder.path(), &command)
    };
    let picture = drawn("regions");
    assert_eq!(code(&picture), 0, "{}", stderr(&picture));
    let picture = stdout(&picture);
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
    assert!(picture.contains("<path d=\"M"), "{picture}");
    let wrong = drawn("building");
    assert_eq!(code(&wrong), 2);
    assert!(stderr(&wrong).contains("`--stage regions`"));
}

#[test]
fn the_catalogue_is_listed() {
    let folder = folder();
    let json = hsd(folder.path(), &["parts", "--format", "json", "GDE 2"]);
    let list: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(list.as_array().unwrap().len(), 1);
    assert_eq!(list[0]["code"], "GDE 2");
    let lattices = stdout(&hsd(folder.path(), &["parts", "G"]));
    let (table, legend) = lattices.split_once("\n\n").unwrap();
    assert!(table.lines().skip(1).all(|l| l.starts_with('G')) && table.lines().count() > 3);
    assert!(legend.contains("shaku") && legend.contains("E Edo"));
    let list = |filter| stdout(&hsd(folder.path(), &["parts", filter]));
    for (filter, found) in [
        ("koushi", "格子戸引違い"),
        ("koshi", "格子戸引違い"),
        ("shouji", "障子二枚"),
        ("shoji", "障子二枚"),
        ("void", "\n.....  1 "),
        ("NAD", "  7.26 "),
    ] {
        assert!(list(filter).contains(found), "{filter}: {}", list(filter));
    }
    let nothing = hsd(folder.path(), &["parts", "no such part"]);
    assert!(stderr(&nothing).starts_with("no part has") && nothing.stdout.is_empty());
}

#[test]
fn shells_get_completions() {
    let folder = folder();
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = stdout(&hsd(folder.path(), &["completions", shell]));
        assert!(script.contains("explain"), "{shell}");
    }
}
