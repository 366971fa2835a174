//! `hsd render`: images drawn by the page in a browser without a window. They need the built page and a browser, so they run
//! when asked for: `cargo test --release -- --ignored cli::render`.

use super::*;

/// How many colours there are in a picture of this size.
fn colors(path: &Path, size: (u32, u32)) -> usize {
    let picture = image::open(path).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), size, "{}", path.display());
    let pixels = picture.pixels().map(|p| p.0);
    pixels.collect::<std::collections::BTreeSet<_>>().len()
}

#[test]
#[ignore = "needs the built page and a browser"]
fn pictures_have_their_size_and_show_something() {
    let folder = folder();
    let small = ["--size", "160x96", "--samples", "1"];
    let one = [&["sound.hsd", "-o", "one.png"][..], &small].concat();
    let output = hsd(folder.path(), &[&["render"], &one[..]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(colors(&folder.path().join("one.png"), (160, 96)) > 50);
    let views = [
        "sound.hsd",
        "-o",
        "all/",
        "--view",
        "above,left",
        "--format",
        "jpg",
        "--quiet",
    ];
    let output = hsd(folder.path(), &[&["render"], &views[..], &small].concat());
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    assert_eq!(
        names(&folder.path().join("all")),
        ["sound-above.jpg", "sound-left.jpg"]
    );
    assert!(colors(&folder.path().join("all/sound-above.jpg"), (160, 96)) > 50);
    assert_ne!(
        fs::read(folder.path().join("all/sound-above.jpg")).unwrap(),
        fs::read(folder.path().join("all/sound-left.jpg")).unwrap()
    );
}

/// The columns of a picture, from the first that differs from its upper left corner to the last.
fn columns(path: &Path) -> (u32, u32) {
    let picture = image::open(path).unwrap().into_rgb8();
    let (sky, middle) = (*picture.get_pixel(0, 0), picture.height() / 2);
    let far = |p: &image::Rgb<u8>| p.0.iter().zip(sky.0).any(|(a, b)| a.abs_diff(b) > 24);
    let differ = (0..picture.width()).filter(|x| far(picture.get_pixel(*x, middle)));
    let columns: Vec<u32> = differ.collect();
    (columns[0], columns[columns.len() - 1])
}

#[test]
#[ignore = "needs the built page and a browser"]
fn elevations_are_parallel_and_houses_have_names() {
    let folder = folder();
    let two = "<Houses><Place type='kura' name='one'/><Place type='kura' name='two' x='40' y='30'/></Houses>";
    fs::write(folder.path().join("two.hsd"), two).unwrap();
    let small = [
        "--size",
        "320x200",
        "--samples",
        "1",
        "--view",
        "elevation-front",
    ];
    let draw = |more: &[&str]| {
        let output = hsd(
            folder.path(),
            &[&["render", "two.hsd"], more, &small].concat(),
        );
        (code(&output), stderr(&output))
    };
    for house in ["one", "two"] {
        let out = format!("{house}.png");
        let (code, said) = draw(&["-o", &out, "--house", house]);
        assert_eq!(code, 0, "{said}");
    }
    // Alike, however far away: a parallel projection of each alone, in the middle of its image.
    let [one, two] = ["one.png", "two.png"].map(|name| columns(&folder.path().join(name)));
    assert_eq!(one, two);
    assert!(one.0.abs_diff(319 - one.1) <= 2, "{one:?}");
    let (code, said) = draw(&["-o", "no.png", "--house", "three"]);
    assert_ne!(code, 0);
    assert!(said.contains("there are one, two"), "{said}");
    let night = ["-o", "no.png", "--date", "2026-12-21", "--hour", "22:30"];
    let (code, said) = draw(&night);
    assert_ne!(code, 0);
    assert!(said.contains("below the horizon"), "{said}");
}

#[test]
#[ignore = "needs the built page and a browser"]
fn what_is_less_fine_has_fewer_colours() {
    let folder = folder();
    let draw = |detail: &str| {
        let out = format!("{detail}.png");
        let wishes = ["--size", "160x96", "--samples", "1", "--detail", detail];
        let output = hsd(
            folder.path(),
            &[&["render", "sound.hsd", "-o", &out], &wishes[..]].concat(),
        );
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        colors(&folder.path().join(out), (160, 96))
    };
    let (walls, all) = (draw("0"), draw("3"));
    assert!(walls < all, "{walls} colours, and {all} with everything");
}

#[test]
#[ignore = "needs the built page and a browser"]
fn texts_with_errors_have_no_picture() {
    let folder = folder();
    let output = hsd(folder.path(), &["render", "broken.hsd", "-o", "one.png"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("HSD"), "{}", stderr(&output));
    assert_eq!(names(folder.path()), ["broken.hsd", "sound.hsd"]);
}

#[test]
#[ignore = "needs the built page and a browser"]
fn pictures_that_a_model_lacks_are_told() {
    let folder = folder();
    let built = hsd(
        folder.path(),
        &["build", "sound.hsd", "-o", "m.glb", "--textures-beside"],
    );
    assert_eq!(code(&built), 0, "{}", stderr(&built));
    let small = ["m.glb", "-o", "m.png", "--size", "96x64", "--samples", "1"];
    let lost = names(&folder.path().join("m_textures")).swap_remove(0);
    fs::remove_file(folder.path().join("m_textures").join(&lost)).unwrap();
    let lacking = hsd(folder.path(), &[&["render"], &small[..]].concat());
    assert_eq!(code(&lacking), 0, "{}", stderr(&lacking));
    let said = stderr(&lacking);
    assert!(said.contains("HSD0605") && said.contains(&lost), "{said}");
    fs::remove_file(folder.path().join("m.png")).unwrap();
    let strict = [&["render"], &small[..], &["-D", "warnings"]].concat();
    assert_eq!(code(&hsd(folder.path(), &strict)), 1);
    assert!(!folder.path().join("m.png").exists());
}

#[test]
fn wishes_that_cannot_be_are_refused() {
    let folder = folder();
    for (arguments, why) in [
        (&["sound.hsd", "-o", "one.gif"][..], ".png or .jpg"),
        (
            &["sound.hsd", "broken.hsd", "-o", "one.png"],
            "name a folder",
        ),
        (
            &["sound.hsd", "-o", "one.png", "--view", "front,back"],
            "name a folder",
        ),
        (
            &["sound.hsd", "./sound.hsd", "-o", "all/"],
            "would both be written to",
        ),
        (&["sound.hsd", "-o", "one.png", "--size", "0x9"], "960x640"),
        (&["sound.hsd", "-o", "one.png", "--view", "inside"], "front"),
    ] {
        let output = hsd(folder.path(), &[&["render"], arguments].concat());
        assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
        assert!(
            stderr(&output).contains(why),
            "{arguments:?}: {}",
            stderr(&output)
        );
    }
    assert_eq!(names(folder.path()), ["broken.hsd", "sound.hsd"]);
}

#[test]
fn browsers_that_fail_are_told_of() {
    let folder = folder();
    let with = |browser: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
        let arguments = ["render", "sound.hsd", "-o", "one.png"];
        command.current_dir(folder.path()).args(arguments);
        command.env("LC_ALL", "C").env("HSD_CHROMIUM", browser);
        command.output().unwrap()
    };
    let output = with("no-such-browser");
    if stderr(&output).contains("without its page") {
        return eprintln!("left out: {}", stderr(&output));
    }
    assert_eq!(code(&output), 3);
    assert!(stderr(&output).contains("no-such-browser"));
    // A program that ends at once draws nothing.
    let output = with(env!("CARGO_BIN_EXE_hsd"));
    assert_eq!(code(&output), 3);
    assert!(
        stderr(&output).contains("the browser exited"),
        "{}",
        stderr(&output)
    );
    assert_eq!(names(folder.path()), ["broken.hsd", "sound.hsd"]);
}
