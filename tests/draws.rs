//! Draws while a file is read: pieces of text and parameters. Only what stands beside a draw moves it.

use hsd::diagnostic::Diagnostics;
use hsd::program::{Content, Program};
use hsd::source::{FileId, NoFiles, Source};
use hsd::{Options, driver};
use std::collections::BTreeMap;

fn program(text: &str, seed: Option<u64>) -> Program {
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "draws.hsd", text.as_bytes());
    let mut options = Options::default();
    options.expand.seed = seed;
    let read = driver::documents(&[&source], &NoFiles, &options, &mut out);
    let made = driver::program(
        &[&source],
        &read.documents,
        &read.catalog,
        &NoFiles,
        &options.expand,
        &mut out,
    );
    let list = out.into_sorted();
    assert!(list.is_empty(), "{list:?}");
    made
}

/// The codes of a row, by house, storey and number.
fn row(of: &Program, house: usize, storey: usize, row: usize) -> Vec<String> {
    let line = &of.houses[house].storeys[storey].loops[0].lines[row];
    let catalog = hsd::parse::builtin();
    let code = |c: &Content| match c {
        Content::Part(id) => catalog.part(*id).code().trim().to_owned(),
        other => format!("{other:?}"),
    };
    line.units.iter().map(|u| code(&u.content)).collect()
}

const THREE: &str = "<random><choice>KTU</choice><choice>KSK</choice><choice>KSM</choice></random>";

fn house(row: &str, before: &str, after: &str) -> String {
    format!(
        "<House name=\"h\">{before}<Storey><Row>{row}</Row><Row>APW  APW</Row><Row>MRE  MRE  MRE  MRE  MRE  MRE</Row>\
         <Row>APW  APW</Row></Storey>{after}</House>"
    )
}

#[test]
fn each_round_of_a_repetition_draws_for_itself() {
    let text = house(&format!("<repeat num=\"6\">{THREE}</repeat>"), "", "");
    let mut seen = BTreeMap::new();
    for seed in 0..200 {
        let drawn = row(&program(&text, Some(seed)), 0, 0, 0);
        assert_eq!(drawn.len(), 6);
        drawn
            .into_iter()
            .for_each(|code| *seen.entry(code).or_insert(0) += 1);
    }
    // 400 each are to be expected.
    assert_eq!(seen.len(), 3, "{seen:?}");
    assert!(seen.values().all(|n| (320..480).contains(n)), "{seen:?}");
    let unlike = (0..50).filter(|seed| {
        let drawn = row(&program(&text, Some(*seed)), 0, 0, 0);
        drawn.iter().any(|code| *code != drawn[0])
    });
    assert!(unlike.count() > 45);
}

#[test]
fn weights_count() {
    let few = "<random><choice weight=\"9\">KTU</choice><choice weight=\"1\">KSK</choice><choice weight=\"0\">KSM</choice></random>";
    let text = house(&format!("<repeat num=\"6\">{few}</repeat>"), "", "");
    let drawn: Vec<String> = (0..200)
        .flat_map(|s| row(&program(&text, Some(s)), 0, 0, 0))
        .collect();
    let of = |code: &str| drawn.iter().filter(|c| *c == code).count();
    assert_eq!(of("KSM"), 0);
    assert!((80..160).contains(&of("KSK")), "{}", of("KSK"));
}

#[test]
fn draws_survive_edits_elsewhere() {
    let drawn = format!("<repeat num=\"6\">{THREE}</repeat>");
    let plain = house(&drawn, "", "");
    let extra = "<Storey><Row>KTU</Row><Row>KTU</Row><Row>KTU</Row><Row>KTU</Row></Storey>";
    let edited = [
        house(
            &drawn,
            "<!-- a comment --><let name=\"a\" value=\"1\"/><define name=\"p\">KTU</define>",
            "",
        ),
        house(&drawn, "", extra),
        house(&drawn, "", "<Roofs pitch=\"5\"/>"),
        house(
            &drawn,
            "<if test=\"{yes}\"><let name=\"b\" value=\"2\"/></if>",
            "",
        ),
        house(&drawn, "<Texture code=\"MRE\" reflection=\"0.1\"/>", ""),
        plain.replace("MRE  MRE", "MRE  KTU"),
        plain.replace(
            "<Row>APW  APW</Row>",
            "<Row><repeat num=\"2\">APW</repeat></Row>",
        ),
        format!("<Houses><House name=\"other\">{extra}</House>{plain}</Houses>"),
        plain.replace(THREE, &format!("<if test=\"{{yes}}\">{THREE}</if>")),
        plain
            .replace(
                "<Storey>",
                &format!("<define name=\"three\">{THREE}</define><Storey>"),
            )
            .replace(&drawn, "<repeat num=\"6\"><use name=\"three\"/></repeat>"),
    ];
    for seed in [None, Some(3), Some(4)] {
        let wanted = row(&program(&plain, seed), 0, 0, 0);
        for text in &edited {
            let made = program(text, seed);
            let last = made.houses.len() - 1;
            assert_eq!(row(&made, last, 0, 0), wanted, "{text}");
        }
    }
}

#[test]
fn anything_can_be_drawn() {
    // Storeys, rows, roofs and names for the rest of the house.
    let text = "<House name=\"h\"><random><choice><let name=\"tall\" value=\"11\"/></choice><choice>\
        <let name=\"tall\" value=\"9\"/></choice></random><random><choice><Storey height=\"{tall}\"><Row>KTU</Row>\
        <Row>KTU</Row><Row>KTU</Row><Row>KTU</Row></Storey></choice><choice/></random><Storey height=\"{tall}\">\
        <random><choice><Row>KSK</Row></choice><choice><Row>KSM</Row></choice></random><Row>KTU</Row><Row>KTU</Row>\
        <Row>KTU</Row></Storey><random><choice><Roofs kind=\"K\"/></choice><choice><Roofs kind=\"I\"/></choice></random>\
        </House>";
    let (mut storeys, mut heights, mut rows, mut roofs) =
        ([0; 3], [0; 12], BTreeMap::new(), BTreeMap::new());
    for seed in 0..64 {
        let made = program(text, Some(seed));
        let house = &made.houses[0];
        storeys[house.storeys.len()] += 1;
        heights[house.storeys[0].height as usize] += 1;
        *rows
            .entry(row(&made, 0, house.storeys.len() - 1, 0))
            .or_insert(0) += 1;
        *roofs
            .entry(format!("{:?}", house.roofs.style.kind.map(|k| k.value)))
            .or_insert(0) += 1;
    }
    assert!(storeys[1] > 16 && storeys[2] > 16, "{storeys:?}");
    assert!(heights[9] > 16 && heights[11] > 16, "{heights:?}");
    assert!(rows.len() == 2 && roofs.len() == 2, "{rows:?} {roofs:?}");
}

#[test]
fn parameters_are_drawn_in_a_run_with_a_seed_alone() {
    let text = "<House name=\"h\"><Param name=\"n\" default=\"4\" min=\"2\" max=\"6\" step=\"2\" random=\"yes\"/>\
        <Param name=\"code\" default=\"KTU\" choices=\"KTU, KSK, KSM\" weights=\"0 1 3\"/>\
        <Param name=\"yes\" default=\"4\" min=\"4\" max=\"9\"/><Storey><Row><repeat num=\"{n}\">{code}</repeat></Row>\
        <Row>APW</Row><Row><repeat num=\"{n}\">KTU</repeat></Row><Row>APW</Row></Storey></House>";
    let text = &text.replace("name=\"yes\"", "name=\"other\"");
    assert_eq!(row(&program(text, None), 0, 0, 0), ["KTU"; 4]);
    let mut seen = BTreeMap::new();
    for seed in 0..300 {
        let drawn = row(&program(text, Some(seed)), 0, 0, 0);
        *seen.entry((drawn.len(), drawn[0].clone())).or_insert(0) += 1;
    }
    assert_eq!(seen.len(), 6, "{seen:?}");
    // A third of three quarters, and a third of one.
    for ((_, code), count) in &seen {
        let wanted = if code == "KSM" { 55..95 } else { 10..42 };
        assert!(wanted.contains(count), "{seen:?}");
    }
    // Another parameter before it, or its new order, draws nothing else.
    let more = text.replace(
        "<Param name=\"n\"",
        "<Param name=\"a\" default=\"yes\" random=\"yes\"/><Param name=\"n\"",
    );
    for seed in 0..20 {
        assert_eq!(
            row(&program(text, Some(seed)), 0, 0, 0),
            row(&program(&more, Some(seed)), 0, 0, 0)
        );
    }
}
