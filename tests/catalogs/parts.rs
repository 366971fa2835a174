//! What own parts are, and what is said about those that cannot be.

use crate::catalogs::*;
use crate::support::{Words, thorough};

#[test]
fn parts_are_found_from_the_house_outwards() {
    let own = |en: &str| format!("<PartDef code='GXX' base='GSI' en='{en}'/>");
    let files = Files::default()
        .with("a/catalog.hsd", &parts(&own("beside")))
        .with("b/catalog.hsd", &parts(&own("beside b")))
        .with("a/old.hsd", &legacy("GXX"))
        .with("b/old.hsd", &legacy("GXX").replacen("0 0", "30 0", 1))
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
                xml(&own("of one"), "GXX").replacen("<House", "<House x='30'", 1)
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
            .en()
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
        told.contains(&331) && told.iter().all(|c| [331, 909].contains(c)),
        "{:?}",
        &told[..9.min(told.len())]
    );
}

/// Whatever sizes an author writes, parts are built or refused; a quarter of them are tried, all with `HSD_THOROUGH`.
#[test]
fn odd_sizes_build_or_are_refused() {
    let catalog = include_str!("../../grammar/parts.xml");
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
    // Each value still meets many parts: there are nine of them.
    let step = if thorough() { 1 } else { 4 };
    for text in texts.into_iter().step_by(step) {
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
