//! The program without arguments: help where nobody sits before the machine, a folder of houses in the browser on a desktop.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

/// The program with nothing of this desktop, so that no browser opens.
fn alone(home: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
    command.env_clear().env("HOME", home).env("PATH", home);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

#[test]
fn without_a_desktop_there_is_help() {
    let home = tempfile::tempdir().expect("a folder");
    for far in [&[][..], &[("DISPLAY", ":0"), ("CI", "true")]] {
        let run = alone(home.path()).envs(far.iter().copied()).output();
        let run = run.expect("starts");
        assert_eq!(run.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&run.stderr).contains("Usage: hsd"));
    }
    assert!(!home.path().join("hsd-houses").exists());
}

/// Starts the program as after a double click, reads the address of the page, and ends it.
fn address(home: &Path) -> String {
    let mut run = alone(home);
    let mut child = run.env("DISPLAY", ":0").spawn().expect("starts");
    let mut url = String::new();
    let out = child.stdout.take().expect("is piped");
    BufReader::new(out).read_line(&mut url).expect("is UTF-8");
    child.kill().expect("can be ended");
    child.wait().expect("ends");
    url
}

#[test]
fn on_a_desktop_a_folder_of_houses_is_shown() {
    if !hsd::view::is_built() {
        return;
    }
    let home = tempfile::tempdir().expect("a folder");
    let houses = home.path().join("hsd-houses");
    let url = address(home.path());
    assert!(url.starts_with("http://127.0.0.1:"), "{url}");
    for name in ["first.hsd", "so-nikai.hsd", "pagoda.hsd"] {
        let text = fs::read(houses.join(name)).expect("is written");
        assert!(!text.is_empty(), "{name}");
    }
    // From then on they are those of the user.
    fs::write(houses.join("first.hsd"), "mine").expect("can be written");
    fs::remove_file(houses.join("pagoda.hsd")).expect("can be removed");
    assert!(address(home.path()).starts_with("http"));
    assert!(!houses.join("pagoda.hsd").exists());
    let first = fs::read_to_string(houses.join("first.hsd"));
    assert_eq!(first.expect("is there"), "mine");
}
