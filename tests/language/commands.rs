//! `--param`, `--root` and `hsd params`, and files that must not be read.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn hsd(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
    command.current_dir(folder).args(arguments).env("LANG", "C");
    command.output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const HOUSE: &str = "<House><Param name='w' default='2' min='1' max='5' step='1' doc='width'/>\
    <Storey><Row><repeat num='{w}'>KSK</repeat></Row><Row>APW</Row>\
    <Row><repeat num='{w}'>KSK</repeat></Row><Row>APW</Row></Storey></House>\n";

#[test]
fn parameters_are_listed_and_set() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.hsd"), HOUSE).unwrap();
    let table = hsd(folder.path(), &["params", "a.hsd"]);
    assert_eq!(table.status.code(), Some(0));
    assert!(text(&table.stdout).contains("a number from 1 to 5 in steps of 1"));
    let json = hsd(
        folder.path(),
        &["params", "a.hsd", "--format", "json", "--param", "w=3"],
    );
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(
        (&json[0]["name"], &json[0]["value"]),
        (&"w".into(), &3.0.into())
    );

    let walls = |w: &str| {
        let set = format!("w={w}");
        let dump = hsd(
            folder.path(),
            &["dump", "--stage", "regions", "a.hsd", "--param", &set],
        );
        let json: serde_json::Value = serde_json::from_slice(&dump.stdout).unwrap();
        json["houses"][0]["storeys"][0]["outline"][1][0].as_f64()
    };
    assert_eq!((walls("2"), walls("5")), (Some(2.0), Some(5.0)));
    for (set, code) in [("w=6", "HSD0259"), ("v=1", "HSD0260")] {
        let check = hsd(folder.path(), &["check", "a.hsd", "--param", set]);
        assert_eq!(check.status.code(), Some(1));
        assert!(
            text(&check.stdout).contains(code),
            "{}",
            text(&check.stdout)
        );
    }
    let wrong = hsd(folder.path(), &["check", "a.hsd", "--param", "w"]);
    assert_eq!(wrong.status.code(), Some(2));
}

#[test]
fn nothing_above_the_root_is_included() {
    let folder = tempfile::tempdir().unwrap();
    let (street, library) = (folder.path().join("street"), folder.path().join("library"));
    fs::create_dir_all(street.join("own")).unwrap();
    fs::create_dir_all(&library).unwrap();
    let piece = "<Catalog><define name='bay'>KSK</define></Catalog>";
    fs::write(library.join("bay.hsd"), piece).unwrap();
    fs::write(street.join("own/bay.hsd"), piece).unwrap();
    let check = |href: &str, options: &[&str]| {
        let house = HOUSE.replace("<House>", &format!("<House><include href='{href}'/>"));
        fs::write(street.join("a.hsd"), house).unwrap();
        let out = hsd(
            folder.path(),
            &[&["check", "street/a.hsd", "--format", "short"], options].concat(),
        );
        text(&out.stdout)
    };
    assert_eq!(check("own/bay.hsd", &[]), "");
    assert_eq!(check("own/../own/./bay.hsd", &[]), "");
    assert!(check("../library/bay.hsd", &[]).contains("HSD0268"));
    assert_eq!(check("../library/bay.hsd", &["--root", "."]), "");
    assert!(check("own/../../library/bay.hsd", &[]).contains("HSD0268"));
    let full = library.join("bay.hsd");
    assert!(check(&full.to_string_lossy(), &[]).contains("HSD0268"));
    assert!(check("none.hsd", &[]).contains("HSD0267"));
    assert!(check("own", &[]).contains("HSD0267"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&full, street.join("link.hsd")).unwrap();
        std::os::unix::fs::symlink(&library, street.join("away")).unwrap();
        assert!(check("link.hsd", &[]).contains("HSD0268"));
        assert!(check("away/bay.hsd", &[]).contains("HSD0268"));
    }
}
