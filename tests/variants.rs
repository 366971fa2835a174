//! Many houses of one text: alike where nothing is drawn, each what its seed makes of it, in rows apart.

use crate::support::assert_none;
use crate::support::cpu::assert_linear;
use hsd::building::Built;
use hsd::diagnostic::Diagnostics;
use hsd::driver::Compiled;
use hsd::render::sheet::{sheet, variants};
use hsd::scene::Detail;
use hsd::source::{FileId, NoFiles, Source};
use hsd::templates::Template;
use hsd::{Options, backend};
use std::collections::BTreeSet;
use std::num::NonZeroU32;

fn built(text: &str, seed: Option<u64>, variants: Option<u32>) -> Compiled {
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "variants.hsd", text.as_bytes());
    let mut options = Options {
        detail: Detail::Body,
        variants: variants.and_then(NonZeroU32::new),
        ..Options::default()
    };
    options.expand.seed = seed;
    let made = hsd::compile(&[&source], &NoFiles, &options, &mut out);
    assert!(!out.has_errors(), "{:?}", out.into_sorted());
    made
}

/// What stands in a house: the contents of its walls, its heights and its roofs, without its name and place.
fn essence(made: &Compiled, house: usize) -> String {
    let of = &made.building.houses[house].house;
    let storeys: Vec<String> = of
        .storeys
        .iter()
        .map(|s| {
            let walls = s.rings.iter().flat_map(|r| &r.walls);
            let units = walls
                .flat_map(|w| &w.units)
                .map(|u| (u.content.clone(), u.width));
            format!("{} {:?}", s.z1, units.collect::<Vec<_>>())
        })
        .collect();
    let roofs = made.building.houses[house].roofs.roofs.iter();
    let solids: Vec<_> = roofs
        .flat_map(|r| &r.solids)
        .map(|s| s.points.clone())
        .collect();
    format!("{} {storeys:?} {solids:?}", of.unit)
}

#[test]
fn there_are_no_more_variants_than_the_limit() {
    let made = |text: &str, most: u32, asked: u32| {
        let mut out = Diagnostics::new();
        let source = Source::new(FileId(0), "variants.hsd", text.as_bytes());
        let mut options = Options {
            detail: Detail::Body,
            variants: NonZeroU32::new(asked),
            ..Options::default()
        };
        options.expand.limits.variants = most;
        let made = hsd::compile(&[&source], &NoFiles, &options, &mut out);
        let codes: Vec<u16> = out.iter().map(|d| d.code.0).collect();
        (made.building.houses.len(), codes)
    };
    let wall = "0 0\n9\n\nKSK  \nKSK  \nKSK  \nKSK  \n";
    assert_eq!(made(wall, 4, 4), (4, vec![]));
    assert_eq!(made(wall, 4, u32::MAX), (4, vec![908]));
    let long = format!("{wall}\n{}", "# as written in 1706\n".repeat(1_600));
    assert_eq!(made(&long, 8, 9), (3, vec![908]), "larger files have fewer");
}

#[test]
fn a_variant_is_the_text_built_with_its_seed() {
    for word in ["chu-nikai", "ura-nagaya", "office"] {
        let text = Template::named(word).expect("is a type").text();
        let all = built(&text, Some(40), Some(12));
        let houses = &all.building.houses;
        assert_eq!(houses.len(), 12);
        let mut seen = BTreeSet::new();
        for (number, house) in houses.iter().map(|b| &b.house).enumerate() {
            let seed = 40 + number as u64;
            assert_eq!(house.variant.map(|v| v.seed), Some(seed));
            assert_eq!(house.name, format!("{word} {seed}"));
            let alone = built(&text, Some(seed), None);
            assert_eq!(essence(&all, number), essence(&alone, 0), "{word} {seed}");
            seen.insert(essence(&all, number));
        }
        assert!(seen.len() >= 11, "{word}: only {} are unlike", seen.len());
    }
}

/// Where each variant stands: its ground with the eaves.
fn grounds(made: &Compiled) -> Vec<(u32, [f64; 4])> {
    let mut found: Vec<(u32, [f64; 4])> = vec![];
    for Built { house, roofs, .. } in &made.building.houses {
        let number = house.variant.expect("is a variant").number;
        let walls = house
            .storeys
            .iter()
            .flat_map(|s| &s.rings)
            .flat_map(|r| &r.walls);
        let walls = walls
            .flat_map(|w| [w.from, w.to])
            .map(|p| [-p.x * house.unit, p.y * house.unit]);
        let roofs = roofs
            .roofs
            .iter()
            .flat_map(|r| &r.solids)
            .flat_map(|s| &s.points);
        let [x, y, _] = house.origin;
        for [px, py] in walls.chain(roofs.map(|p| [p.x, p.y])) {
            let at = [px + x, py + y];
            match found.last_mut().filter(|(n, _)| *n == number) {
                Some((_, box_)) => {
                    *box_ = [
                        box_[0].min(at[0]),
                        box_[1].min(at[1]),
                        box_[2].max(at[0]),
                        box_[3].max(at[1]),
                    ];
                }
                None => found.push((number, [at[0], at[1], at[0], at[1]])),
            }
        }
    }
    found
}

#[test]
fn variants_stand_apart_in_rows() {
    // Of the high fence with its house and gate each variant is three houses, which stay together.
    for (word, count) in [
        ("chu-nikai", 40),
        ("hei-tsuki", 12),
        ("taka-bei", 9),
        ("kura", 1),
    ] {
        let text = Template::named(word).expect("is a type").text();
        let made = built(&text, None, Some(count));
        let grounds = grounds(&made);
        assert_eq!(grounds.len(), count as usize, "{word}");
        let mut findings = vec![];
        for (k, (a, p)) in grounds.iter().enumerate() {
            for (b, q) in &grounds[k + 1..] {
                let apart = (q[0] - p[2])
                    .max(p[0] - q[2])
                    .max((q[1] - p[3]).max(p[1] - q[3]));
                if apart < 1.49 {
                    findings.push(format!("{word}: {a} and {b} stand {apart} m apart"));
                }
            }
        }
        assert_none(&findings);
        let wide = grounds.iter().map(|g| g.1[2]).fold(0.0, f64::max);
        let deep = grounds.iter().map(|g| g.1[3]).fold(0.0, f64::max);
        assert!(
            count < 9 || (wide / deep > 0.4 && wide / deep < 2.5),
            "{word}: {wide} x {deep}"
        );
    }
}

#[test]
fn the_same_run_makes_the_same_bytes() {
    let text = Template::named("so-nikai").expect("is a type").text();
    let bytes = || {
        let made = built(&text, None, Some(10));
        backend::gltf::glb(&made.scene, &backend::images::Library::default())
    };
    assert_eq!(bytes(), bytes());
}

#[test]
fn what_is_said_of_one_is_not_said_again_of_the_next() {
    let text = "<House><Storey><Row>KTU  QQQ  </Row><Row>APW</Row><Row>KTU  KTU</Row><Row>APW</Row></Storey></House>";
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "variants.hsd", text.as_bytes());
    let options = Options {
        variants: NonZeroU32::new(50),
        ..Options::default()
    };
    hsd::compile(&[&source], &NoFiles, &options, &mut out);
    assert_eq!(out.into_sorted().len(), 1);
}

#[test]
fn a_contact_sheet_shows_every_variant() {
    let text = Template::named("kura").expect("is a type").text();
    let made = built(&text, None, Some(5));
    let sheet = sheet(&made.scene, &variants(&made.scene, &made.building.houses));
    // Three columns and two rows of 360 by 270 pixels, six between them; the last place is free.
    assert_eq!(sheet.dimensions(), (3 * 366 + 6, 2 * 276 + 6));
    let paper = sheet.get_pixel(0, 0);
    for k in 0..6 {
        let (x, y) = (6 + k % 3 * 366, 6 + k / 3 * 276);
        let cell = (0..270).flat_map(|j| (0..360).map(move |i| (i, j)));
        let colors: BTreeSet<[u8; 3]> =
            cell.map(|(i, j)| sheet.get_pixel(x + i, y + j).0).collect();
        match k {
            5 => assert_eq!(colors, BTreeSet::from([paper.0])),
            // White walls in the sun, tiles, ground and shadow.
            _ => assert!(colors.len() > 500, "{k}: {}", colors.len()),
        }
    }
    let ink = sheet.pixels().filter(|p| p.0 == [0x2b, 0x27, 0x24]).count();
    assert!(ink > 100, "{ink}");
}

#[test]
fn variants_take_linear_time() {
    let text = Template::named("chu-nikai").expect("is a type").text();
    let source = Source::new(FileId(0), "variants.hsd", text.as_bytes());
    let make = |count: usize| Options {
        variants: NonZeroU32::new(count as u32),
        ..Options::default()
    };
    assert_linear("variants", 50, make, |options| {
        let made = hsd::compile(&[&source], &NoFiles, options, &mut Diagnostics::new());
        let houses = made.building.houses.len();
        assert_eq!(Some(houses), options.variants.map(|n| n.get() as usize));
    });
}

#[test]
fn variants_go_into_a_file_a_folder_or_a_sheet() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = Template::named("kura").expect("is a type").text();
    std::fs::write(folder.path().join("kura.hsd"), text).expect("can be written");
    let hsd = |words: &[&str]| {
        let made = std::process::Command::new(env!("CARGO_BIN_EXE_hsd"))
            .args(["build", "kura.hsd", "--detail", "0", "--variants", "3"])
            .args(words)
            .current_dir(folder.path())
            .output()
            .expect("hsd runs");
        assert!(
            made.status.success(),
            "{}",
            String::from_utf8_lossy(&made.stderr)
        );
    };
    let there = || {
        let files = std::fs::read_dir(folder.path())
            .expect("is there")
            .map(|f| f.expect("is there").path());
        let inside = |f: std::path::PathBuf| match f.is_dir() {
            true => std::fs::read_dir(f)
                .expect("is there")
                .map(|f| f.expect("is there").path())
                .collect(),
            false => vec![f],
        };
        let name = |f: std::path::PathBuf| {
            let below = f.strip_prefix(folder.path()).expect("is below");
            below.to_string_lossy().replace('\\', "/")
        };
        files
            .flat_map(inside)
            .map(name)
            .collect::<BTreeSet<String>>()
    };
    hsd(&["--sheet", "kura.png"]);
    assert_eq!(
        there(),
        BTreeSet::from(["kura.hsd", "kura.png"].map(String::from))
    );
    assert!(image::image_dimensions(folder.path().join("kura.png")).is_ok_and(|(w, _)| w > 700));
    hsd(&["-o", "all.glb"]);
    hsd(&["-o", "each/", "--seed", "8"]);
    let models = [
        "all.glb",
        "each/kura-08.glb",
        "each/kura-09.glb",
        "each/kura-10.glb",
        "kura.hsd",
        "kura.png",
    ];
    assert_eq!(there(), BTreeSet::from(models.map(String::from)));
    // Each is the house that its seed makes.
    let one = folder.path().join("each/kura-09.glb");
    let before = std::fs::read(&one).expect("is there");
    hsd(&["-o", "each/", "--seed", "9"]);
    assert_eq!(
        before,
        std::fs::read(folder.path().join("each/kura-09.glb")).expect("is there")
    );
}
