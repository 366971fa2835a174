//! What elements and texts become in the document.

use super::*;
use hsd_testing::Words;

#[test]
fn a_house_is_read() {
    let text = "<?xml version=\"1.0\"?>\n<Houses xmlns:xsi='x' xsi:y='z'>\
        <House name=' 山田 &amp; 子 ' unit='3.25' seed='18446744073709551615' azimuth='90' x='1' y='-2e1' z='.5' \
        street='true'><Storey height='9.5' start='2 -1.5' kind='parapet'>\
        <Row turn='L'>GSI</Row><repeat num='2'><Row turn='45.5'/></repeat>\
        <Loop hole='yes' start='4,8'><Row turn='R'/><random code='a b'/></Loop>\
        <random code='A, B' weights='1 2.5'/><replace with='B' at='2, 5-7'/>\
        </Storey></House><House/></Houses>";
    let document = clean(text);
    assert_eq!(document.houses.len(), 2);
    let house = &document.houses[0];
    let name = house.name.as_ref().unwrap();
    assert_eq!(name.value, "山田 & 子");
    assert_eq!(
        &text[name.span.start as usize..name.span.end as usize],
        "山田 &amp; 子"
    );
    let s = &house.settings;
    assert_eq!(s.unit.unwrap().value, 3.25);
    assert_eq!(s.seed.unwrap().value, u64::MAX);
    assert_eq!(s.azimuth.unwrap().value, 90.0);
    assert_eq!(
        (s.x.unwrap().value, s.y.unwrap().value, s.z.unwrap().value),
        (1.0, -20.0, 0.5)
    );
    assert!(s.street.unwrap().value);
    let [Item::One(storey)] = &house.storeys[..] else {
        panic!("one storey")
    };
    assert_eq!(storey.height.unwrap().value, 9.5);
    assert_eq!(storey.start.unwrap().value, (2.0, -1.5));
    assert_eq!(storey.kind, StoreyKind::Parapet);
    let [own, hole] = &storey.loops[..] else {
        panic!("two loops")
    };
    let [Item::One(first), Item::Repeat(more)] = &own.rows[..] else {
        panic!("a row and a repetition")
    };
    assert_eq!(first.turn.unwrap().value, -90.0);
    assert_eq!(more.num.value, 2);
    assert!(!own.hole && hole.hole);
    assert_eq!(hole.start.unwrap().value, (4.0, 8.0));
    let [Edit::Random(random), Edit::Replace(replace)] = &storey.edits[..] else {
        panic!("two edits")
    };
    assert_eq!(random.weights.as_ref().unwrap().value, [1.0, 2.5]);
    assert_eq!(replace.at.as_ref().unwrap().value, [(2, 2), (5, 7)]);
    assert!(replace.codes.is_none());
}

#[test]
fn repeated_storeys_and_loops_without_defaults() {
    let document = clean(
        "<House><repeat num='3'><Storey><Loop hole='no'><Row>KTU</Row></Loop></Storey></repeat></House>",
    );
    let [Item::Repeat(repeat)] = &document.houses[0].storeys[..] else {
        panic!("a repetition")
    };
    let [Item::One(storey)] = &repeat.body[..] else {
        panic!("a storey")
    };
    assert!(storey.height.is_none() && storey.loops.len() == 1);
    assert!(storey.loops[0].start.is_none() && !storey.loops[0].hole);
}

#[test]
fn splits_nest() {
    let document = clean(&row(
        "<split ratio='0.6'><lower>AAA  <random code='B'/></lower><upper><split><upper>C</upper>\
         <lower><repeat num='2'><Part texturecode='窓-上' width='2' height='3.5'/></repeat></lower></split></upper></split>",
    ));
    let [Item::One(Piece::Split(split))] = &first_row(&document).pieces[..] else {
        panic!("a split")
    };
    assert_eq!(split.ratio.unwrap().value, 0.6);
    assert_eq!(codes_of(&split.lower.pieces), ["AAA  "]);
    let [Item::One(Piece::Split(inner))] = &split.upper.pieces[..] else {
        panic!("a split in it")
    };
    let [Item::Repeat(repeat)] = &inner.lower.pieces[..] else {
        panic!("a repetition")
    };
    let [Item::One(Piece::Part(part))] = &repeat.body[..] else {
        panic!("a part")
    };
    assert_eq!(part.code.value, CodeText::new("窓-上"));
    assert_eq!(
        (part.width.unwrap().value, part.height.unwrap().value),
        (2.0, 3.5)
    );
}

#[test]
fn structures_and_textures_are_read() {
    let document = clean(
        "<House><Structure size='180' scale='0.2' order='right'><Facades><repeat num='2'>\
         <Facade reflection='disable'><Floor height='12' kind='parapet'><Row>NWI  NWI</Row></Floor></Facade></repeat>\
         </Facades><Texture code='A' reflection='0.7'/></Structure><Texture texturecode='B'/></House>",
    );
    let house = &document.houses[0];
    let structure = &house.structures[0];
    assert!(structure.rightwards);
    assert_eq!(structure.scale.unwrap().value, 0.2);
    let [Item::Repeat(repeat)] = &structure.facades[..] else {
        panic!("a repetition")
    };
    let [Item::One(facade)] = &repeat.body[..] else {
        panic!("a facade")
    };
    let [Item::One(floor)] = &facade.floors[..] else {
        panic!("a floor")
    };
    assert_eq!(floor.kind, StoreyKind::Parapet);
    assert_eq!(codes_of(&floor.pieces), ["NWI  ", "NWI  "]);
    assert_eq!(house.textures.len(), 2);
    assert_eq!(house.textures[0].reflection.unwrap().value, 0.7);
}

#[test]
fn roofs_are_read() {
    let document = clean(
        "<House><Roofs mode='explicit' method='kd' kind='H' shape='IRI' pitch='6' eaves='4' verge='1' thickness='0.6' \
         noshi='5' sori='-2' gable='0.25' plain_ridge='yes'><Roof a0='0' b0='1' a1='6.5' b1='-8' ridge='Y' height='*'/>\
         <Roof a0='0' b0='1' a1='6' b1='8' height='14' kind='K'/></Roofs></House>",
    );
    let roofs = &document.houses[0].roofs;
    assert_eq!(roofs.mode.unwrap().value, RoofMode::Explicit);
    assert_eq!(roofs.method.unwrap().value, RoofMethod::Kd);
    let style = &roofs.style;
    assert_eq!(style.kind.unwrap().value, RoofKind::Bark);
    assert_eq!(style.shape.unwrap().value, RoofShape::HipAndGable);
    assert_eq!(style.noshi.unwrap().value, 5);
    assert_eq!(style.sori.unwrap().value, -2.0);
    assert!(style.plain_ridge.unwrap().value);
    let [first, second] = &roofs.lines[..] else {
        panic!("two roofs")
    };
    assert_eq!(first.corners.value, [0.0, 1.0, 6.5, -8.0]);
    assert_eq!(first.direction.unwrap().value, RoofDirection::AcrossFront);
    assert!(first.height.is_none() && first.style.kind.is_none());
    assert_eq!(second.height.unwrap().value, 14.0);
}

#[test]
fn text_is_cut_into_codes() {
    assert_eq!(codes("GSI  GDE 2TSH"), ["GSI  ", "GDE 2", "TSH  "]);
    // Blanks on the line of the tag are columns, those round line breaks are not.
    assert_eq!(codes("     GSI  "), ["     ", "GSI  "]);
    assert_eq!(
        codes("\n    GSI\n    GDE 2TSH \r\n\t\n    KTU  \n  "),
        ["GSI  ", "GDE 2", "TSH  ", "KTU  "]
    );
    assert_eq!(codes("GSI       KTU  "), ["GSI  ", "     ", "KTU  "]);
    assert_eq!(
        codes("GSI  .....KTU     "),
        ["GSI  ", ".....", "KTU  ", "     "][..3].to_vec()
    );
    assert_eq!(codes("GSI  <!-- here -->GDE 2"), ["GSI  ", "GDE 2"]);
    assert_eq!(codes("GSI  <![CDATA[GDE 2]]>"), ["GSI  ", "GDE 2"]);
    assert_eq!(codes("A&amp;B C&#x44;E"), ["A&B C", "DE   "]);
    // Each run is taken alone, and one of white space only is nothing.
    assert_eq!(
        codes("GS <Part code='X'/>GD\n  <Part code='Y'/>     <Part code='Z'/>"),
        ["GS   ", "X    ", "GD   ", "Y    ", "Z    "]
    );
    assert!(faults(&row("GSI  \n　　GDE 2　\n")).is_empty());
}

#[test]
fn spans_of_codes_are_exact() {
    let text = row("\n  A&amp;B&lt;&#x44;GD\n  TSH");
    let document = clean(&text);
    let span = |i: usize| {
        let Item::One(piece) = &first_row(&document).pieces[i] else {
            panic!("a part")
        };
        let span = piece.code().expect("a code").span;
        &text[span.start as usize..span.end as usize]
    };
    assert_eq!(
        (span(0), span(1), span(2)),
        ("A&amp;B&lt;&#x44;", "GD", "TSH")
    );
}

#[test]
fn text_that_is_no_code_is_named() {
    let text = row("KTU　KTU");
    assert_eq!(faults(&text), [(233, "　")]);
    assert_eq!(codes("KTU　KTU"), ["KTU  ", "KTU  "]);
    assert_eq!(faults(&row("KTU\tKTU")), [(233, "\t")]);
    assert_eq!(codes("KTU\tKTU"), ["KTU  ", "KTU  "]);
    let (_, list) = read(&row("ＫＴＵ  "));
    assert!(list[0].help.en().contains("`KTU`"));
    assert_eq!(codes("ＫＴＵ  "), ["KTU  "]);
    assert_eq!(faults(&row("窓戸   KTU")), [(233, "窓戸")]);
    assert_eq!(codes("窓戸   KTU"), ["     ", "KTU  "]);
    assert_eq!(faults(&row("KTU  L")), [(232, "L")]);
    assert_eq!(faults(&row("KTU  ^")), [(232, "^")]);
    let (document, list) = read(&row("\n  KTU  \n  L\n"));
    assert!(list.len() == 1 && list[0].message.en().contains("`turn`"));
    assert_eq!(first_row(&document).turn.unwrap().value, -90.0);
    // The letter of a code is none.
    assert!(faults(&row("KTU L")).is_empty());
    assert_eq!(
        faults(
            "<Structure><Facades><Facade><Floor><Row turn='L'>A</Row></Floor></Facade></Facades></Structure>"
        ),
        [(232, "turn")]
    );
}
