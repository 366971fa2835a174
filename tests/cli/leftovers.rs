//! What the program must not leave behind or write over: sources, and temporary files after signals and crashes.

use super::*;

#[test]
fn files_beside_a_model_overwrite_no_source() {
    let folder = folder();
    fs::write(folder.path().join("x.mtl"), SOUND).unwrap();
    let output = hsd(folder.path(), &["build", "x.mtl", "-o", "x.obj"]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("x.mtl is an input"),
        "{}",
        stderr(&output)
    );
    assert_eq!(
        fs::read(folder.path().join("x.mtl")).unwrap(),
        SOUND.as_bytes()
    );
    assert_eq!(names(folder.path()), ["broken.hsd", "sound.hsd", "x.mtl"]);
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_nothing_behind() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, temporary) = (folder(), tempfile::tempdir().unwrap());
    let browser = folder.path().join("browser");
    fs::write(&browser, "#!/bin/sh\necho > started\nexec sleep 60\n").unwrap();
    fs::set_permissions(&browser, fs::Permissions::from_mode(0o755)).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_hsd"))
        .current_dir(folder.path())
        .args(["render", "sound.hsd", "-o", "a.png"])
        .env("HSD_CHROMIUM", &browser)
        .env("TMPDIR", temporary.path())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let started = folder.path().join("started");
    while !started.exists() {
        if let Some(status) = child.try_wait().unwrap() {
            // A page that was not built yet cannot be rendered.
            let output = child.wait_with_output().unwrap();
            assert_eq!(status.code(), Some(2), "{}", stderr(&output));
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert_eq!(names(temporary.path()).len(), 1);
    let kill = Command::new("kill")
        .args(["-TERM", &child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(names(temporary.path()), Vec::<String>::new());
}

#[test]
fn what_a_crash_left_is_swept_after_a_day() {
    let folder = folder();
    let day = std::time::Duration::from_secs(25 * 60 * 60);
    for (name, old) in [
        (".hsd-aB3xY9", true),
        (".hsd-fresh1", false),
        (".hsd-notes.txt", true),
    ] {
        let file = fs::File::create(folder.path().join(name)).unwrap();
        let now = std::time::SystemTime::now();
        file.set_modified(if old { now - day } else { now })
            .unwrap();
    }
    let output = hsd(folder.path(), &["build", "sound.hsd", "-o", "a.glb"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let kept = [
        ".hsd-fresh1",
        ".hsd-notes.txt",
        "a.glb",
        "broken.hsd",
        "sound.hsd",
    ];
    assert_eq!(names(folder.path()), kept);
}
