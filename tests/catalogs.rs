//! Own parts: where they are found, what they take over, which pictures they show, and that no text makes too much of them.

#![allow(clippy::unwrap_used)]

use hsd::ast::CodeText;
use hsd::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd::driver::{self, Compiled};
use hsd::program::{Content, PictureId, Unit};
use hsd::source::{FileId, NoText, PictureFile, Source, World};
use std::collections::{BTreeMap, BTreeSet};

/// Texts in folders and names of pictures.
#[derive(Default)]
struct Files {
    texts: BTreeMap<String, String>,
    pictures: BTreeSet<String>,
}

impl Files {
    fn with(mut self, path: &str, text: &str) -> Files {
        self.texts.insert(path.into(), text.into());
        self
    }

    fn pictured(mut self, names: &[&str]) -> Files {
        self.pictures.extend(names.iter().map(|n| (*n).to_owned()));
        self
    }
}

impl World for Files {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        let path = self.pictures.get(name)?.clone();
        let size = (200, 100);
        Some(PictureFile { path, size })
    }

    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
        Err(std::io::Error::other(path.to_owned()))
    }

    fn image(&self, from: &str, href: &str) -> Result<PictureFile, NoText> {
        let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
        let path = format!("{folder}/{href}");
        self.picture(&path).ok_or(NoText::Missing)
    }

    fn text(&self, from: &str, href: &str) -> Result<String, NoText> {
        let path = match from.rsplit_once('/') {
            Some((folder, _)) => format!("{folder}/{href}"),
            None => href.to_owned(),
        };
        let there = self.texts.contains_key(&path);
        there.then_some(path).ok_or(NoText::Missing)
    }

    fn text_bytes(&self, path: &str, _: usize) -> std::io::Result<Vec<u8>> {
        Ok(self.texts[path].clone().into_bytes())
    }
}

/// What a run makes of texts, some of them catalogues for all.
fn run(files: &Files, texts: &[&str], given: &[&str]) -> (Compiled, Vec<Diagnostic>) {
    let source = |(id, name): (usize, &&str)| {
        let id = FileId(u16::try_from(id).unwrap());
        Source::new(id, *name, files.texts[*name].as_bytes())
    };
    let all: Vec<Source> = texts.iter().chain(given).enumerate().map(source).collect();
    let (texts, given) = all.split_at(texts.len());
    let options = hsd::Options {
        catalogs: given.into(),
        ..hsd::Options::default()
    };
    let mut out = Diagnostics::new();
    let sources: Vec<&Source> = texts.iter().collect();
    let made = driver::compile(&sources, files, &options, &mut out);
    (made, out.into_sorted())
}

fn clean(files: &Files, texts: &[&str], given: &[&str]) -> Compiled {
    let (made, list) = run(files, texts, given);
    assert_eq!(list, vec![]);
    made
}

/// Codes of the messages of one text.
fn codes(text: &str) -> Vec<u16> {
    let files = Files::default().with("a.hsd", text);
    let (_, list) = run(&files, &["a.hsd"], &[]);
    list.iter().map(|d| d.code.0).collect()
}

/// The units of a house's first storey in walk order.
fn units(made: &Compiled, house: usize) -> Vec<&Unit> {
    let storey = &made.building.shell.houses[house].storeys[0];
    let walls = storey.rings.iter().flat_map(|r| &r.walls);
    walls.flat_map(|w| &w.units).collect()
}

/// The English name of a house's first part.
fn first_name(made: &Compiled, house: usize) -> String {
    let Content::Part(id) = units(made, house)[0].content else {
        panic!("a part stands first");
    };
    made.catalog.part(id).en.to_string()
}

/// A house of which the first part has this code.
fn legacy(code: &str) -> String {
    format!("0 0 180\n9\n\n{code:<5}KSK\nKSK  KSK\nKSK  KSK\nKSK  KSK\n")
}

fn xml(head: &str, code: &str) -> String {
    let wall = "<Row>KSK  KSK</Row>";
    format!(
        "<House>{head}<Storey><Row><Part code='{code}'/>KSK</Row>{wall}{wall}{wall}</Storey></House>"
    )
}

fn parts(entries: &str) -> String {
    format!("<Catalog>{entries}</Catalog>")
}

#[test]
fn parts_are_found_from_the_house_outwards() {
    let own = |en: &str| format!("<PartDef code='GXX' base='GSI' en='{en}'/>");
    let files = Files::default()
        .with("a/catalog.hsd", &parts(&own("beside")))
        .with("b/catalog.hsd", &parts(&own("beside b")))
        .with("a/old.hsd", &legacy("GXX"))
        .with("b/old.hsd", &legacy("GXX"))
        .with("c/old.hsd", &legacy("GXX"))
        .with("given.hsd", &parts(&own("given")))
        .with("a/lib.hsd", &parts(&own("included")))
        .with("a/house.hsd", &xml(&own("of the house"), "GXX"))
        .with(
            "a/both.hsd",
            &xml(
                &format!("<include href='lib.hsd'/>{}", own("of the house")),
                "GXX",
            ),
        )
        .with("a/include.hsd", &xml("<include href='lib.hsd'/>", "GXX"))
        .with(
            "a/houses.hsd",
            &format!(
                "<Houses>{}{}{}</Houses>",
                own("of all"),
                xml("", "GXX"),
                xml(&own("of one"), "GXX")
            ),
        );
    let name = |text: &str, given: &[&str]| first_name(&clean(&files, &[text], given), 0);
    assert_eq!(name("a/old.hsd", &[]), "beside");
    assert_eq!(name("a/old.hsd", &["given.hsd"]), "given");
    assert_eq!(name("c/old.hsd", &["given.hsd"]), "given");
    assert_eq!(name("a/house.hsd", &["given.hsd"]), "of the house");
    assert_eq!(name("a/include.hsd", &["given.hsd"]), "included");
    assert_eq!(name("a/both.hsd", &[]), "of the house");
    let made = clean(&files, &["a/houses.hsd"], &[]);
    assert_eq!(first_name(&made, 0), "of all");
    assert_eq!(first_name(&made, 1), "of one");
    // Texts of two folders in one run mean different parts by one code.
    let made = clean(&files, &["a/old.hsd", "b/old.hsd"], &[]);
    assert_eq!(first_name(&made, 0), "beside");
    assert_eq!(first_name(&made, 1), "beside b");
    let (_, list) = run(&files, &["c/old.hsd"], &[]);
    assert_eq!(list[0].code.0, 301);
}

#[test]
fn a_part_takes_over_what_it_does_not_say() {
    let files = Files::default().with("a.hsd", &xml(
        "<PartDef code='GXX 2' base='GXW' from='1'><change element='bars' count='5'/></PartDef>
         <PartDef code='GXW' base='GSI' en='wide' to='7'><remove element='rails'/><box thick='5'/></PartDef>",
        "GXX 2",
    ).replacen("KSK", "", 1));
    let (made, _) = run(&files, &["a.hsd"], &[]);
    let Content::Part(id) = units(&made, 0)[0].content else {
        panic!("a part");
    };
    let part = made.catalog.part(id);
    assert_eq!(
        (part.code(), part.width(), part.class()),
        ("GXX 2", 2.0, 'G')
    );
    assert_eq!(
        (&*part.en, part.from, part.to),
        ("wide", Some(1.0), Some(7.0))
    );
    let base = hsd::parse::builtin();
    let base = base.part(base.find(&CodeText::new("GSI")).unwrap());
    assert_eq!(part.era, base.era);
    // Fewer bars make a smaller mesh, which is the part's own.
    let triangles = |files: &Files| clean(files, &["a.hsd"], &[]).scene.stats().triangles;
    let house = |count: u32| {
        let head = format!(
            "<PartDef code='GXX' base='GSI'><change element='bars' count='{count}'/></PartDef>"
        );
        Files::default().with("a.hsd", &xml(&head, "GXX"))
    };
    assert!(triangles(&house(9)) > triangles(&house(3)) + 50);
}

#[test]
fn a_part_may_stand_for_a_built_in_one() {
    let head = "<PartDef code='KSK' base='KSK' en='my plaster' finish='juraku'><change element='wall' finish='juraku'/></PartDef>";
    let files = Files::default().with("a.hsd", &xml(head, "KSK"));
    let made = clean(&files, &["a.hsd"], &[]);
    assert_eq!(first_name(&made, 0), "my plaster");
    assert!(made.scene.materials.iter().any(|m| m.name == "juraku"));
    assert!(!made.scene.materials.iter().any(|m| m.name == "plaster"));
    // So it does in a house written short, whose bays nobody wrote.
    let hall = "<House><PartDef code='KSK' base='KJU' en='mine'/><Hall/></House>";
    let made = clean(&Files::default().with("a.hsd", hall), &["a.hsd"], &[]);
    let all = units(&made, 0);
    let is_mine =
        |u: &&Unit| matches!(u.content, Content::Part(id) if &*made.catalog.part(id).en == "mine");
    assert!(all.into_iter().any(|u| is_mine(&u)));
}

#[test]
fn definitions_may_be_computed() {
    let head = "<let name='n' value='4'/><if test='{n > 3}'><PartDef code='GXX' base='GSI' from='{n / 4}' en='many'/></if>
        <else><PartDef code='GXX' base='GSI' en='few'/></else>";
    let files = Files::default().with("a.hsd", &xml(head, "GXX"));
    assert_eq!(first_name(&clean(&files, &["a.hsd"], &[]), 0), "many");
}

#[test]
fn faults_name_what_is_wrong() {
    let one = |part: &str| codes(&xml(part, "KSK"));
    assert_eq!(one("<PartDef code='GXX' base='nobody'/>"), [323]);
    assert_eq!(one("<PartDef code='GXX' base='GXX'/>"), [323]);
    assert_eq!(
        one("<PartDef code='A' base='B'/><PartDef code='B' base='A'/>"),
        [324]
    );
    assert_eq!(
        one("<PartDef code='GXX' base='GSI'/><PartDef code='GXX' base='GIT'/>"),
        [325]
    );
    for width in ["wide", "-1", "101", "1e999", "NaN"] {
        assert_eq!(
            one(&format!("<PartDef code='GXX' base='GSI' width='{width}'/>")),
            [326],
            "{width}"
        );
    }
    assert_eq!(one("<PartDef code='GXX' base='GSI' width='2'/>"), [327]);
    assert_eq!(one("<PartDef code='a longer name'/>"), [224]);
    assert_eq!(one("<PartDef base='GSI'/>"), [224]);
    assert_eq!(one("<PartDef code='GXX' base='GSI' colour='red'/>"), [222]);
    assert_eq!(
        one("<PartDef code='GXX' base='GSI'><ball/></PartDef>"),
        [221]
    );
    assert_eq!(
        one("<PartDef code='GXX' base='GSI'><wall weight='3'/></PartDef>"),
        [222]
    );
    assert_eq!(
        one("<PartDef code='GXX' base='GSI'><change element='oriel' eaves='3'/></PartDef>"),
        [328]
    );
    assert_eq!(
        one("<PartDef code='GXX' base='GSI'><change element='bars' at='9'/></PartDef>"),
        [328]
    );
    assert_eq!(one("<PartDef code='GXX' base='GSI' depth='3'/>"), [328]);
    assert_eq!(
        one("<PartDef code='GXX' base='KSK'><bars count='999' children='999'/></PartDef>"),
        [329]
    );
    // The chain of a cycle is shown.
    let files = Files::default().with("a.hsd", &xml(
        "<PartDef code='first one' base='second'/><PartDef code='second' base='third'/><PartDef code='third' base='first one'/>",
        "KSK",
    ));
    let (_, list) = run(&files, &["a.hsd"], &[]);
    assert!(
        list[0]
            .message
            .en
            .contains("`first one` on `second` on `third` on `first one`"),
        "{:?}",
        list[0]
    );
}

#[test]
fn a_file_without_parts_is_told_of() {
    let files = Files::default()
        .with("empty.hsd", "<Catalog/>")
        .with("a/catalog.hsd", "<Catalog></Catalog>")
        .with("a/a.hsd", &legacy("KSK"))
        .with("b.hsd", &legacy("KSK"));
    let told = |text: &str, given: &[&str]| -> Vec<u16> {
        let (_, list) = run(&files, &[text], given);
        list.iter().map(|d| d.code.0).collect()
    };
    assert_eq!(told("b.hsd", &["empty.hsd"]), [330]);
    assert_eq!(told("a/a.hsd", &[]), [330]);
    // The file itself is no text with something beside it.
    assert_eq!(told("a/catalog.hsd", &[]), Vec::<u16>::new());
}

/// A catalogue by a stranger takes no more room and time than others.
#[test]
fn no_catalogue_is_too_much() {
    let mut chain = String::new();
    for n in 0..200 {
        chain += &format!(
            "<PartDef code='part number {n}' base='part number {}'/>",
            n + 1
        );
    }
    chain += "<PartDef code='part number 200' base='GSI'/>";
    assert!(codes(&parts(&chain)).iter().all(|code| *code == 324));
    let many: String = (0..66_000)
        .map(|n| format!("<PartDef code='number {n}' width='1'/>"))
        .collect();
    let told = codes(&parts(&many));
    assert!(
        told.contains(&331) && told.iter().all(|c| *c == 331),
        "{:?}",
        &told[..9.min(told.len())]
    );
}

/// Whatever sizes an author writes, parts are built or refused.
#[test]
fn odd_sizes_build_or_are_refused() {
    let catalog = include_str!("../grammar/parts.xml");
    let builtin = hsd::parse::builtin();
    let values = [
        "0", "-5", "1", "99999", "t5", "50%", "0.001", "1e308", "yes",
    ];
    let mut texts = vec![];
    for part in builtin.parts().iter().filter(|p| p.class() != ' ') {
        let from = catalog.find(&format!("code=\"{}\"", part.code())).unwrap();
        let body = &catalog[from..];
        let body = &body[..body.find("</PartDef>").unwrap_or(0)];
        for (n, attribute) in [
            "size", "gap", "count", "front", "thick", "from", "to", "out", "pitch", "tile", "cut",
        ]
        .iter()
        .enumerate()
        {
            for line in body
                .lines()
                .filter(|l| l.contains(&format!(" {attribute}=\"")))
            {
                let word = line
                    .trim()
                    .trim_start_matches('<')
                    .split(' ')
                    .next()
                    .unwrap();
                let value = values[(n + texts.len()) % values.len()];
                texts.push(xml(
                    &format!("<PartDef code='GXX' base='{}'><change element='{word}' {attribute}='{value}'/></PartDef>", part.code()),
                    "GXX",
                ));
            }
        }
    }
    assert!(texts.len() > 300, "{}", texts.len());
    for text in texts {
        let files = Files::default().with("a.hsd", &text);
        let (made, list) = run(&files, &["a.hsd"], &[]);
        let known = [326, 327, 328, 329, 401];
        assert!(
            list.iter()
                .all(|d| d.severity != Severity::Error || known.contains(&d.code.0)),
            "{text}: {list:?}"
        );
        let finite = made
            .scene
            .meshes
            .iter()
            .flat_map(|m| &m.primitives)
            .flat_map(|p| &p.positions)
            .flatten();
        assert!(finite.into_iter().all(|x| x.is_finite()), "{text}");
    }
}

#[test]
fn a_texture_shows_on_the_part() {
    let head = "<PartDef code='board' base='KSK' from='6' to='8' texture='SIGN' depth='120'/>";
    let files = Files::default()
        .with("a.hsd", &xml(head, "board"))
        .pictured(&["SIGN"]);
    let made = clean(&files, &["a.hsd"], &[]);
    assert_eq!(units(&made, 0)[0].picture, Some(PictureId(0)));
    assert_eq!(made.scene.pictures, ["SIGN"]);
    let mesh = made
        .scene
        .meshes
        .iter()
        .find(|m| m.name == "board")
        .unwrap();
    let shown = mesh.primitives.iter().find(|p| {
        made.scene.materials[p.material.0 as usize].image == hsd::scene::Image::Picture(0)
    });
    let shown = shown.unwrap();
    // 120 mm before the wall's centre line, six to eight shaku above the floor, between the posts.
    assert!(
        shown.positions.iter().all(|p| (p[1] + 0.120).abs() < 1e-6),
        "{:?}",
        shown.positions
    );
    let z: Vec<f32> = shown.positions.iter().map(|p| p[2]).collect();
    assert!(
        (z[0] - 1.818).abs() < 1e-3 && (z[2] - 2.424).abs() < 1e-3,
        "{z:?}"
    );
    let (_, list) = run(
        &Files::default().with("a.hsd", &xml(head, "board")),
        &["a.hsd"],
        &[],
    );
    assert_eq!(list[0].code.0, 604);
}

/// Which variant each picture of a house shows, by the names of their files.
fn variants(files: &Files, text: &str) -> Vec<String> {
    let files = Files {
        texts: BTreeMap::from([("a.hsd".to_owned(), text.to_owned())]),
        pictures: files.pictures.clone(),
    };
    let made = clean(&files, &["a.hsd"], &[]);
    let shell = &made.building.shell;
    let walls = shell.houses[0]
        .storeys
        .iter()
        .flat_map(|s| &s.rings)
        .flat_map(|r| &r.walls);
    let shown = walls
        .flat_map(|w| &w.units)
        .filter_map(|u| match u.content {
            Content::Picture(id) => Some(id),
            _ => u.picture,
        });
    shown
        .map(|id| shell.pictures[id.0 as usize].path.clone())
        .collect()
}

fn pictured_house(seed: u32, back: &str, upper: &str) -> String {
    let row = |text: &str| format!("<Row>{text}</Row>");
    let wall = "KSK  ".repeat(12);
    format!(
        "<House name='h' seed='{seed}'><Storey>{}{}{}{}</Storey><Storey>{}{}{}{}</Storey></House>",
        row("<repeat num='12'><Part code='BRICK'/></repeat>"),
        row(&wall),
        row(back),
        row(&wall),
        row(upper),
        row(&wall),
        row(&wall),
        row(&wall),
    )
}

#[test]
fn variants_are_drawn_for_each_place_and_survive_edits() {
    let wall = "KSK  ".repeat(12);
    let files = Files::default().pictured(&["BRICK", "BRICK.1", "BRICK.2"]);
    let plain = variants(&files, &pictured_house(1, &wall, &wall));
    assert_eq!(plain.len(), 12);
    let kinds: BTreeSet<&String> = plain.iter().collect();
    assert_eq!(kinds.len(), 3, "{plain:?}");
    // Edits of other walls, of other storeys, and of a part in the same row change nothing.
    let other = format!("<Part code='BRICK'/>{}", "GSI  ".repeat(11));
    let edited = variants(&files, &pictured_house(1, &other, &other));
    assert_eq!(edited[..12], plain[..]);
    let text = pictured_house(1, &wall, &wall);
    let text = text.replacen(
        "num='12'><Part code='BRICK'/>",
        "num='5'><Part code='BRICK'/>",
        1,
    );
    let text = text.replacen(
        "</repeat>",
        "</repeat>KSK  <repeat num='6'><Part code='BRICK'/></repeat>",
        1,
    );
    let edited = variants(&files, &text);
    assert_eq!(edited[..5], plain[..5]);
    assert_eq!(edited[5..], plain[6..]);
    // Another seed is another house.
    assert_ne!(variants(&files, &pictured_house(2, &wall, &wall)), plain);
    // A variant more takes places from the others, and changes no other place.
    let more = Files::default().pictured(&["BRICK", "BRICK.1", "BRICK.2", "BRICK.3"]);
    let drawn = variants(&more, &pictured_house(1, &wall, &wall));
    let moved = drawn.iter().zip(&plain).filter(|(a, b)| a != b);
    assert!(
        moved.clone().count() > 0 && moved.clone().all(|(a, _)| a == "BRICK.3"),
        "{drawn:?}"
    );
}

#[test]
fn variants_need_no_bare_name_and_end_at_a_gap() {
    let wall = "KSK  ".repeat(12);
    let files = Files::default().pictured(&["BRICK.1", "BRICK.2", "BRICK.4"]);
    let drawn: BTreeSet<String> = variants(&files, &pictured_house(1, &wall, &wall))
        .into_iter()
        .collect();
    assert_eq!(
        drawn,
        BTreeSet::from(["BRICK.1".to_owned(), "BRICK.2".to_owned()])
    );
}

#[test]
fn own_parts_draw_variants_too() {
    let wall = "KSK  ".repeat(12);
    let files = Files::default().pictured(&["CLOTH.1", "CLOTH.2"]);
    let text = pictured_house(1, &wall, &wall).replace(
        "<Storey>",
        "<PartDef code='BRICK' base='KSK' texture='CLOTH'/><Storey>",
    );
    let text = text.replacen(
        "</Storey><PartDef code='BRICK' base='KSK' texture='CLOTH'/>",
        "</Storey>",
        1,
    );
    let drawn = variants(&files, &text);
    assert_eq!(drawn.len(), 12);
    assert!(drawn.contains(&"CLOTH.1".to_owned()) && drawn.contains(&"CLOTH.2".to_owned()));
}

#[test]
fn a_texture_may_name_its_file() {
    let head = "<Texture texturecode='stone, KTU' src='photos/stone.png'/>";
    let text = xml(head, "stone").replacen("<Row>KSK  KSK</Row>", "<Row>KTU  KSK</Row>", 1);
    // `photos/stone.1.png` is another picture: a file is named as it is.
    let files = Files::default()
        .with("f/a.hsd", &text)
        .pictured(&["f/photos/stone.png", "f/photos/stone.1.png"]);
    let made = clean(&files, &["f/a.hsd"], &[]);
    assert_eq!(made.scene.pictures, ["f/photos/stone.png"]);
    // It wins over a part of the catalogue, and counts in its house only.
    let pictures = units(&made, 0)
        .into_iter()
        .filter(|u| matches!(u.content, Content::Picture(_)));
    assert_eq!(pictures.count(), 2);
    let both = format!("<Houses>{text}{}</Houses>", xml("", "KTU"));
    let files = files.with("f/a.hsd", &both);
    let made = clean(&files, &["f/a.hsd"], &[]);
    assert!(matches!(units(&made, 1)[0].content, Content::Part(_)));
    let (_, list) = run(&Files::default().with("f/a.hsd", &text), &["f/a.hsd"], &[]);
    assert!(list.iter().any(|d| d.code.0 == 243), "{list:?}");
}
