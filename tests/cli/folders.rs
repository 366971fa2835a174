//! Folders: where pictures come from, and watching for changes.

use super::*;

#[test]
fn pictures_come_from_texture_folders_only() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("house");
    fs::create_dir_all(inside.join("textures/deep")).unwrap();
    let picture = image::RgbImage::new(3, 2);
    picture.save(inside.join("textures/noren.png")).unwrap();
    picture.save(inside.join("textures/deep/low.png")).unwrap();
    picture.save(inside.join("sign.JPG")).unwrap();
    picture.save(folder.path().join("secret.png")).unwrap();
    fs::write(inside.join("fake.png"), "no picture").unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink("../secret.png", inside.join("link.png")).unwrap();
        symlink("textures/noren.png", inside.join("near.png")).unwrap();
        symlink("loop.png", inside.join("loop.png")).unwrap();
    }
    let world = FolderWorld::new(vec![inside.clone(), inside.join("textures")], 1 << 20);
    let noren = world.picture("noren").unwrap();
    assert_eq!(noren.size, (3, 2));
    assert!(
        world
            .picture_bytes(&noren.path)
            .unwrap()
            .starts_with(b"\x89PNG")
    );
    assert!(world.picture("noren.png").is_some() && world.picture("sign").is_some());
    assert_eq!(
        world.picture("fake").unwrap().size,
        (1, 1),
        "found, to be complained about"
    );
    let secret = folder.path().join("secret.png");
    let absolute = secret.to_str().unwrap();
    for name in [
        "../secret",
        "../secret.png",
        "..",
        ".",
        "",
        "/",
        "\\",
        "textures/noren",
        "deep/low",
        "C:secret",
        "./noren",
        "noren\0",
        "link",
        "loop",
        &absolute[..absolute.len() - 4],
        absolute,
    ] {
        assert_eq!(world.picture(name), None, "{name:?}");
        assert!(world.picture_bytes(name).is_err(), "{name:?}");
    }
    #[cfg(unix)]
    {
        assert!(world.picture("near").is_some(), "a link within the folder");
        let link = inside.join("link.png");
        assert!(world.picture_bytes(link.to_str().unwrap()).is_err());
        let dots = inside.join("../secret.png");
        assert!(world.picture_bytes(dots.to_str().unwrap()).is_err());
    }
}

#[test]
fn watching_builds_again() {
    let folder = folder();
    let text = folder.path().join("sound.hsd");
    let mut child = Command::new(env!("CARGO_BIN_EXE_hsd"))
        .current_dir(folder.path())
        .args(["build", "sound.hsd", "-o", "x.glb", "--watch"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let output = std::io::BufReader::new(child.stderr.take().unwrap());
    let (sender, lines) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        std::io::BufRead::lines(output)
            .map_while(Result::ok)
            .try_for_each(|l| sender.send(l))
    });
    let next = || {
        lines
            .recv_timeout(std::time::Duration::from_secs(30))
            .unwrap()
    };
    let first = next(); // printed when the folder is watched already
    fs::write(&text, format!("{SOUND}%\n30 0{}", &SOUND[3..])).unwrap();
    let second = next();
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(first.starts_with("wrote x.glb: 1 house,"), "{first}");
    assert!(second.starts_with("wrote x.glb: 2 houses,"), "{second}");
}
