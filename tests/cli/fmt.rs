//! `hsd fmt`: which files change, and which never do.

use super::*;

const LOOSE: &str = "0 0\n\n\nKSK  KSK  \nKSK  KSK  \nKSK  KSK\nKSK  KSK\n";
const TIDY: &str = "0 0\n\nKSK  KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n";

fn loose() -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("loose.hsd"), LOOSE).unwrap();
    fs::write(folder.path().join("tidy.hsd"), TIDY).unwrap();
    folder
}

fn read(folder: &TempDir, name: &str) -> String {
    fs::read_to_string(folder.path().join(name)).unwrap()
}

#[test]
fn check_changes_nothing_and_tells_what_would_change() {
    let folder = loose();
    let output = hsd(folder.path(), &["fmt", "--check", "tidy.hsd", "loose.hsd"]);
    assert_eq!(code(&output), 1);
    assert_eq!(
        stdout(&output),
        "loose.hsd\n    3 - \n    4 - KSK  KSK··\n    5 - KSK  KSK··\n    5 + KSK  KSK\n    6 + KSK  KSK\n"
    );
    assert_eq!(stderr(&output), "2 files, 1 would be reformatted\n");
    assert_eq!(read(&folder, "loose.hsd"), LOOSE);
    assert_eq!(
        code(&hsd(folder.path(), &["fmt", "--check", "tidy.hsd"])),
        0
    );
}

#[test]
fn files_are_laid_out_in_place_or_elsewhere() {
    let folder = loose();
    let before = names(folder.path());
    let output = hsd(folder.path(), &["fmt", "tidy.hsd", "loose.hsd"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (0, ""));
    assert_eq!(read(&folder, "loose.hsd"), TIDY);
    assert_eq!(names(folder.path()), before, "no temporary file is left");
    fs::write(folder.path().join("loose.hsd"), LOOSE).unwrap();
    let output = hsd(folder.path(), &["fmt", "loose.hsd", "-o", "other.hsd"]);
    assert_eq!(code(&output), 0);
    assert_eq!(
        (
            read(&folder, "other.hsd").as_str(),
            read(&folder, "loose.hsd").as_str()
        ),
        (TIDY, LOOSE)
    );
    let output = hsd(
        folder.path(),
        &["fmt", "loose.hsd", "tidy.hsd", "-o", "all/"],
    );
    assert_eq!(code(&output), 0);
    assert_eq!(read(&folder, "all/loose.hsd"), TIDY);
    let output = hsd(folder.path(), &["fmt", "loose.hsd", "-o", "-"]);
    assert_eq!(stdout(&output), TIDY);
    assert_eq!(read(&folder, "loose.hsd"), LOOSE);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hsd"))
        .args(["fmt", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(LOOSE.as_bytes())
        .unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(
        (stdout(&output).as_str(), stderr(&output).as_str()),
        (TIDY, "")
    );
}

#[test]
fn texts_with_errors_are_left_alone() {
    let folder = loose();
    let output = hsd(folder.path(), &["fmt", "broken.hsd", "loose.hsd"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("HSD0121"), "{}", stderr(&output));
    assert_eq!(
        (
            read(&folder, "broken.hsd").as_str(),
            read(&folder, "loose.hsd").as_str()
        ),
        (BROKEN, TIDY)
    );
    for (arguments, status) in [
        (&["fmt", "missing.hsd"][..], 3),
        (&["fmt", "."], 3),
        (&["fmt"], 2),
        (&["fmt", "--check", "tidy.hsd", "-o", "x.hsd"], 2),
        (&["fmt", "loose.hsd", "tidy.hsd", "-o", "x.hsd"], 2),
    ] {
        assert_eq!(
            code(&hsd(folder.path(), arguments)),
            status,
            "{arguments:?}"
        );
    }
}

#[cfg(unix)]
#[test]
fn a_file_keeps_its_rights() {
    use std::os::unix::fs::PermissionsExt;
    let folder = loose();
    let path = folder.path().join("loose.hsd");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
    assert_eq!(code(&hsd(folder.path(), &["fmt", "loose.hsd"])), 0);
    assert_eq!(
        fs::metadata(&path).unwrap().permissions().mode() & 0o777,
        0o600
    );
    fs::write(&path, LOOSE).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o400)).unwrap();
    assert_eq!(code(&hsd(folder.path(), &["fmt", "loose.hsd"])), 3);
    assert_eq!(read(&folder, "loose.hsd"), LOOSE);
}

#[test]
fn a_house_is_written_in_the_other_form() {
    let folder = loose();
    let output = hsd(
        folder.path(),
        &["fmt", "--to", "xml", "loose.hsd", "-o", "x.hsd"],
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let xml = read(&folder, "x.hsd");
    assert!(
        xml.starts_with("<House>\n  <Storey>\n    <Row>KSK  KSK</Row>\n"),
        "{xml}"
    );
    let output = hsd(folder.path(), &["fmt", "--to", "xml", "x.hsd", "--check"]);
    assert_eq!(code(&output), 0, "it is in that form already");
    let output = hsd(folder.path(), &["fmt", "--to", "legacy", "x.hsd"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(
        read(&folder, "x.hsd"),
        TIDY.replacen("0 0\n", "0 0\n9.0\n", 1)
    );
    let drawn = "<House><Storey><Row><random code=\"KSM, MRE\"/></Row></Storey></House>\n";
    fs::write(folder.path().join("drawn.hsd"), drawn).unwrap();
    let output = hsd(folder.path(), &["fmt", "--to", "legacy", "drawn.hsd"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("HSD0803"), "{}", stderr(&output));
    assert_eq!(read(&folder, "drawn.hsd"), drawn);
}
