//! The XML form: the paper's figure, every element, and what is wrong in every way.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use hsd::ast::*;
use hsd::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd::parse::xml;
use hsd::source::{FileId, Limits, Source};

fn read(text: &str) -> (Document, Vec<Diagnostic>) {
    let source = Source::new(FileId(0), "test.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    let document = xml::parse(&source, &Limits::default(), &mut out);
    let list = out.into_sorted();
    for d in &list {
        for span in d.labels.iter().map(|l| l.span).chain([d.span]) {
            assert!(
                span.start <= span.end && span.end as usize <= text.len(),
                "{d:?} in {text:?}"
            );
            assert!(text.is_char_boundary(span.start as usize), "{d:?}");
            assert!(text.is_char_boundary(span.end as usize), "{d:?}");
        }
        assert!(!d.message.is_empty() && !d.message.ends_with('.') && !d.help.is_empty());
    }
    (document, list)
}

fn clean(text: &str) -> Document {
    let (document, list) = read(text);
    assert!(list.is_empty(), "{list:#?}");
    document
}

/// Code and offending text of each message.
fn faults(text: &str) -> Vec<(u16, &str)> {
    let (_, list) = read(text);
    list.iter()
        .map(|d| (d.code.0, &text[d.span.start as usize..d.span.end as usize]))
        .collect()
}

fn row(content: &str) -> String {
    format!("<House><Storey><Row>{content}</Row></Storey></House>")
}

fn first_row(document: &Document) -> &Row {
    let Item::One(storey) = &document.houses[0].storeys[0] else {
        panic!("no storey")
    };
    let Item::One(row) = &storey.loops[0].rows[0] else {
        panic!("no row")
    };
    row
}

fn codes_of(pieces: &[Item<Piece>]) -> Vec<String> {
    let part = |p: &Item<Piece>| match p {
        Item::One(piece) => Some(piece.code()?.value.as_str().to_owned()),
        _ => None,
    };
    pieces.iter().filter_map(part).collect()
}

/// The codes of a row, which may hold faults.
fn codes(content: &str) -> Vec<String> {
    let (document, _) = read(&row(content));
    let row = first_row(&document);
    codes_of(&row.pieces)
}

const FIGURE_4: &str = r#"<!--壁面構造情報-->
<Structure size="100">
  <Facades>
    <!--比率と角度を立面に与える。-->
    <Facade id="1" ratio="1" angle="0" reflection="enable">
      <Floor id="1"/>
      <repeat num="8">
        <Floor id="k">
          <random texturecode="f1fkf1,f1fkf3"/>
          <random
            texturecode="f1fkf2u1,f1fkf2u3,f1fkf4u1,f1fkf4u3"/>
        </Floor>
      </repeat>
      <Floor id="top">
        <replace texturecode="f1ftf1" with="f1ftf3"/>
        <replace texturecode="f1ftf2" with="f1ftf4"/>
      </Floor>
    </Facade>
  </Facades>
</Structure>
"#;

#[test]
fn the_figure_is_read_as_printed() {
    let document = clean(FIGURE_4);
    let [house] = &document.houses[..] else {
        panic!("one house")
    };
    let [structure] = &house.structures[..] else {
        panic!("one structure")
    };
    assert_eq!(structure.size.unwrap().value, 100.0);
    let [Item::One(facade)] = &structure.facades[..] else {
        panic!("one facade")
    };
    assert_eq!(facade.id.as_ref().unwrap().value, "1");
    assert_eq!(facade.ratio.unwrap().value, 1.0);
    assert_eq!(facade.angle.unwrap().value, 0.0);
    assert!(facade.reflection);
    let [Item::One(ground), Item::Repeat(middle), Item::One(top)] = &facade.floors[..] else {
        panic!("three rows")
    };
    assert!(ground.pieces.is_empty());
    assert_eq!(middle.num.value, 8);
    let [Item::One(floor)] = &middle.body[..] else {
        panic!("one floor")
    };
    assert_eq!(floor.id.as_ref().unwrap().value, "k");
    let [Item::Random(first), Item::Random(second)] = &floor.pieces[..] else {
        panic!("two draws")
    };
    assert_eq!(first.codes.value, "f1fkf1,f1fkf3");
    assert_eq!(second.codes.value, "f1fkf2u1,f1fkf2u3,f1fkf4u1,f1fkf4u3");
    assert_eq!(top.id.as_ref().unwrap().value, "top");
    let [Item::Replace(one), Item::Replace(two)] = &top.pieces[..] else {
        panic!("two substitutions")
    };
    assert_eq!(one.codes.as_ref().unwrap().value, "f1ftf1");
    assert_eq!(one.with.value, "f1ftf3");
    assert_eq!(two.with.value, "f1ftf4");
    let span = two.with.span;
    assert_eq!(&FIGURE_4[span.start as usize..span.end as usize], "f1ftf4");
}

#[test]
fn the_examples_are_clean() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "hsd") {
            continue;
        }
        let text = std::fs::read_to_string(path).unwrap();
        if text.trim_start().starts_with('<') {
            clean(&text);
            count += 1;
        }
    }
    assert!(count >= 5);
}

#[test]
fn every_fixture_shows_its_code_and_no_other() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/diagnostics");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let ours = name.starts_with("HSD02") || name.starts_with("HSD0902");
        if !ours || !name.ends_with(".hsd") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let (document, list) = read(&text);
        let found: Vec<String> = list.iter().map(|d| d.code.to_string()).collect();
        assert!(!found.is_empty(), "{name} shows nothing");
        assert!(
            found.iter().all(|c| name.starts_with(c)),
            "{name}: {list:#?}"
        );
        assert_eq!(found.len(), 1, "{name}: {list:#?}");
        assert!(name.contains("no_element") || !document.houses.is_empty());
        let page = format!(
            "{}/grammar/diagnostics/{}.md",
            env!("CARGO_MANIFEST_DIR"),
            found[0]
        );
        let page = std::fs::read_to_string(page).unwrap();
        assert!(page.starts_with(&format!("# {}: ", found[0])));
        count += 1;
    }
    assert!(count >= 39, "{count}");
}

#[test]
fn broken_markup_is_named_exactly() {
    for (text, expected) in [
        ("<House><Storey></House>", vec![(204, "Storey")]),
        (
            "<House><Storey><Row>KTU",
            vec![(204, "House"), (204, "Storey"), (204, "Row")],
        ),
        ("<House></Storey></House>", vec![(206, "</Storey>")]),
        ("<House></Houes>", vec![(205, "</Houes>")]),
        ("<House></x>", vec![(205, "</x>")]),
        ("<House></>", vec![(205, "</>")]),
        ("<House/><House/>", vec![(207, "House")]),
        ("a<House/>b c\n", vec![(208, "a"), (208, "b c")]),
        ("<House name='a' name='b'/>", vec![(210, "name")]),
        ("<House name=shop/>", vec![(211, "shop")]),
        ("<House name=/>", vec![(212, "name")]),
        ("<House street/>", vec![(212, "street")]),
        ("<House name'a' street=\"yes\"/>", vec![(212, "name")]),
        ("<House name=\"a/>", vec![(202, "\"")]),
        (
            "<House name=\"a\n  street='yes'>\n</House>",
            vec![(202, "\"")],
        ),
        ("<House name=\"a street=\"yes\"/>", vec![(202, "\"")]),
        ("<House name='a\"/>\n", vec![(202, "'")]),
        (
            "<House>\n<Storey\n</House>",
            vec![(201, "<Storey"), (204, "Storey")],
        ),
        (
            "<House><Storey <Row>KTU</Row></Storey></House>",
            vec![(201, "<Storey")],
        ),
        (
            "<House><Storey><Row><Part code='KTU' </Row></Storey></House>",
            vec![(201, "<Part")],
        ),
        ("<House", vec![(201, "<House"), (204, "House")]),
        ("<House>\n<!-- x\n</House>", vec![(203, "<!--")]),
        ("<House>\n<![CDATA[ x\n</House>", vec![(203, "<![CDATA[")]),
        ("<?xml version='1.0'\n<House/>", vec![(203, "<?")]),
        ("<House><></House>", vec![(213, "<>")]),
        ("<House name='a<b'/>", vec![(214, "<")]),
        (
            "<House name='&nbsp;&#0;&amp;&#x5bb6;'/>",
            vec![(216, "&nbsp;"), (216, "&#0;")],
        ),
        (
            "<House name='a & b &; &c'/>",
            vec![(215, "&"), (215, "&"), (215, "&")],
        ),
        (
            "<!DOCTYPE a [<!ENTITY b \"]>\"> <!-- ]> ' -->]><House/>",
            vec![(217, "<!DOCTYPE")],
        ),
        ("<!DOCTYPE a [\n<House/>", vec![(217, "<!DOCTYPE")]),
        ("< House/>", vec![(219, " ")]),
        ("<House / >", vec![(219, " "), (204, "House")][..1].to_vec()),
        ("<House name='a'street='yes'/>", vec![(219, "")]),
        ("<House 'a'/>", vec![(219, "'a'")]),
        ("<House = name='a'/>", vec![(219, "=")]),
        ("<House></House x>", vec![(219, "x")]),
        ("<!-- a -->", vec![(220, "")]),
        ("<!-- a --- b <!-- c --><House/>", vec![(236, "--")]),
        ("<!-- a <!-- c --><House/>", vec![(236, "<!--")]),
        ("<House name='a\u{7}'/>", vec![(6, "\u{7}")]),
    ] {
        assert_eq!(faults(text), expected, "{text}");
    }
}

#[test]
fn tags_that_nearly_match_get_one_message() {
    let storey = "<House><Story height=\"8.5\"><Row>KTU  </Row></Storey></House>";
    assert_eq!(faults(storey), vec![(221, "Story")]);
    let cases = [
        (
            "KTU  <repeat num=\"5\">KTU  <repeat>",
            vec![(241, "<repeat>")],
        ),
        (
            "<repeat num=\"5\">KTU  <repeat>KSM  </repeat></repeat>",
            vec![(224, "repeat")],
        ),
        (
            "KTU  <Row></Storey><Storey><Row>KTU  ",
            vec![(241, "<Row>")],
        ),
        ("KTU  <Row>KTU  ", vec![(204, "Row")]),
        ("KTU  <Row turn=\"L\">KTU  ", vec![(204, "Row")]),
    ];
    for (content, expected) in cases {
        let text = row(content);
        assert_eq!(faults(&text), expected, "{content}");
    }
}

/// The only message, and the document.
fn only(text: &str) -> (Document, Diagnostic) {
    let (document, mut list) = read(text);
    assert_eq!(list.len(), 1, "{list:#?}");
    (document, list.remove(0))
}

#[test]
fn words_of_other_programs_are_understood() {
    let (document, d) = only("<House name=「裏長屋」><Storey><Row>KTU  </Row></Storey></House>");
    assert_eq!(d.code.0, 211);
    assert!(d.help.ends_with("`name=\"裏長屋\"`"), "{}", d.help);
    let name = document.houses[0].name.as_ref();
    assert_eq!(name.map(|n| n.value.as_str()), Some("裏長屋"));
    let (document, d) = only(&row("<repeat count=\"5\">KTU  </repeat>"));
    assert_eq!((d.code.0, d.help.as_str()), (222, "write `num`"));
    let Item::Repeat(repeat) = &first_row(&document).pieces[0] else {
        panic!("no repeat")
    };
    assert_eq!(repeat.num.value, 5);
    let (document, d) = only("<House><Roof kind=\"I\"/></House>");
    assert_eq!((d.code.0, d.help.as_str()), (223, "write `Roofs`"));
    let kind = document.houses[0].roofs.style.kind.map(|k| k.value);
    assert_eq!(kind, Some(RoofKind::Boards));
    let (_, d) = only(&row("<repeat num=\"5\"/>"));
    assert_eq!((d.code.0, d.severity), (242, Severity::Warning));
    let (document, d) = only(&row("KTU  KSM\tKTU  "));
    assert!(
        d.help
            .starts_with("replace it by 2 blanks, so that the next code begins in column 11")
    );
    assert_eq!(
        codes_of(&first_row(&document).pieces),
        ["KTU  ", "KSM  ", "KTU  "]
    );
}

#[test]
fn both_places_are_named() {
    let label = |text: &str| {
        let (_, list) = read(text);
        let label = &list[0].labels[0];
        text[label.span.start as usize..label.span.end as usize].to_owned()
    };
    assert_eq!(label("<House>\n<Storey>\n</House>"), "</House>");
    assert_eq!(label("<House>\n</house>"), "House");
    assert_eq!(label("<House/><Houses/>"), "House");
    assert_eq!(label("<House name='a' name='b'/>"), "name");
    assert_eq!(label("<House><Storey></Row></Storey></House>"), "Storey");
    assert_eq!(
        label("<House><Storey><Row>A\n<Row>B</Row></Storey></House>"),
        "Row"
    );
}

#[test]
fn full_width_markup_is_read_and_named() {
    let text = "＜House　name＝“店” street=\"no”＞\n＜Storey／＞＜／House＞";
    let expected = [
        "＜", "　", "＝", "“", "”", "”", "＞", "＜", "／", "＞", "＜", "／", "＞",
    ];
    let found = faults(text);
    assert_eq!(found.iter().map(|f| f.1).collect::<Vec<_>>(), expected);
    assert!(found.iter().all(|f| f.0 == 218));
    let (document, list) = read(text);
    assert_eq!(document.houses[0].name.as_ref().unwrap().value, "店");
    assert_eq!(document.houses[0].storeys.len(), 1);
    assert!(list[0].help.contains("`<`"), "{:?}", list[0]);
    assert_eq!(faults("<House name=\"a” street=\"yes\"/>"), [(218, "”")]);
    assert_eq!(faults("<Ｈｏｕｓｅ/>"), [(221, "Ｈｏｕｓｅ")]);
    // Quotes of any kind are plain characters inside a value.
    clean("<House name=\"“鶴” と ‘亀’ ＝\"/>");
}

#[test]
fn unknown_words_get_the_nearest_known_one() {
    let help = |text: &str| {
        let (_, list) = read(text);
        (list[0].code.0, list[0].help.clone())
    };
    let (code, text) = help("<Structure><Facades><facade id='1'/></Facades></Structure>");
    assert!(code == 221 && text.contains("`Facade`"), "{text}");
    let (code, text) = help(&row("<Repeat num='2'>KTU</Repeat>"));
    assert!(code == 221 && text.contains("`repeat`"), "{text}");
    let (code, text) = help("<House nmae='a'/>");
    assert!(code == 222 && text.contains("`name`"), "{text}");
    let (code, text) = help("<House colour='red'/>");
    assert!(code == 222 && text.contains("`azimuth`"), "{text}");
    let (code, text) = help("<House><Row/></House>");
    assert!(code == 223 && text.contains("`Storey` or `Loop`"), "{text}");
    let (code, text) = help("<Row/>");
    assert!(code == 223 && text.contains("`Storey` or `Loop`"), "{text}");
    assert_eq!(help("<div/>").0, 221);
    // What stands in them is read.
    let (document, list) = read("<House><div><storey><Row>KTU</Row></storey></div></House>");
    assert_eq!(list.len(), 2);
    assert_eq!(codes_of(&first_row(&document).pieces), ["KTU  "]);
    let (document, _) = read("<house Name='a'/>");
    assert_eq!(document.houses[0].name.as_ref().unwrap().value, "a");
}

#[test]
fn later_elements_are_known() {
    for name in [
        "Param", "let", "define", "use", "if", "else", "include", "PartDef",
    ] {
        let text = format!("<House><{name} x='1'>text<b/></{name}></House>");
        assert_eq!(faults(&text), [(228, name)], "{name}");
    }
    assert_eq!(faults("<Catalog><PartDef/></Catalog>"), [(228, "Catalog")]);
    assert_eq!(faults("<House name='{a}'/>"), [(229, "{a}")]);
    assert_eq!(
        faults(&row("<repeat num=\"{n}\">KTU</repeat>")),
        [(229, "{n}")]
    );
    assert_eq!(faults(&row("KTU  {a}KTU")), [(229, "{a}")]);
    clean(&row("<Part code='f1f{k}f2'/><Part code='GDE_2'/>"));
}

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
         </Facades><Texture code='A' reflection='0.7' src='a.png'/></Structure><Texture texturecode='B'/></House>",
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
    assert_eq!(house.textures[0].src.as_ref().unwrap().value, "a.png");
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
    assert!(list[0].help.contains("`KTU`"));
    assert_eq!(codes("ＫＴＵ  "), ["KTU  "]);
    assert_eq!(faults(&row("窓戸   KTU")), [(233, "窓戸")]);
    assert_eq!(codes("窓戸   KTU"), ["     ", "KTU  "]);
    assert_eq!(faults(&row("KTU  L")), [(232, "L")]);
    assert_eq!(faults(&row("KTU  ^")), [(232, "^")]);
    let (document, list) = read(&row("\n  KTU  \n  L\n"));
    assert!(list.len() == 1 && list[0].message.contains("`turn`"));
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

#[test]
fn values_are_checked() {
    let house = |attribute: &str| faults_owned(&format!("<House {attribute}/>"));
    assert_eq!(house("unit='three'"), [(225, "three".into())]);
    assert_eq!(house("unit='３．０'"), [(225, "３．０".into())]);
    assert_eq!(house("x='1,5'"), [(225, "1,5".into())]);
    assert_eq!(house("x='NaN'"), [(225, "NaN".into())]);
    assert_eq!(house("x='inf'"), [(225, "inf".into())]);
    assert_eq!(house("x='1e999'"), [(225, "1e999".into())]);
    assert_eq!(house("unit='0'"), [(226, "0".into())]);
    assert_eq!(house("seed='-1'"), [(226, "-1".into())]);
    assert_eq!(house("seed='1.5'"), [(226, "1.5".into())]);
    assert_eq!(house("seed='x'"), [(225, "x".into())]);
    assert_eq!(house("street='maybe'"), [(227, "maybe".into())]);
    assert_eq!(house("name=''"), [(237, "name=''".into())]);
    assert_eq!(faults("<House><Storey start='1'/></House>"), [(238, "1")]);
    assert_eq!(faults("<House><Storey start='1 x'/></House>"), [(225, "x")]);
    assert_eq!(
        faults(&row("<replace with='a' at='0,2,7-5,x,３－４'/>")).len(),
        4
    );
    assert_eq!(
        faults(&row("<random code='a' weights='1 -1'/>")),
        [(226, "-1")]
    );
    assert_eq!(faults(&row("<repeat/>")), [(224, "repeat")]);
    assert_eq!(faults(&row("<Part/>")), [(224, "Part")]);
    assert_eq!(
        faults(&row("<Part code='a' texturecode='b'/>")),
        [(210, "texturecode")]
    );
    assert_eq!(faults(&row("<split/>")), [(230, "split"), (230, "split")]);
    assert_eq!(
        faults("<House><Storey><Row turn='l'/></Storey></House>"),
        [(227, "l")]
    );
    let (document, list) = read("<House><Texture code='a' reflection='70'/></House>");
    assert_eq!(list[0].severity, Severity::Warning);
    assert_eq!(
        document.houses[0].textures[0].reflection.unwrap().value,
        0.7
    );
}

fn faults_owned(text: &str) -> Vec<(u16, String)> {
    let found = faults(text);
    found.into_iter().map(|(c, s)| (c, s.to_owned())).collect()
}

#[path = "parse_xml/hostile.rs"]
mod hostile;

/// The token streams of this reader and of quick-xml agree on what is well-formed.
#[test]
fn well_formed_texts_are_read_as_quick_xml_does() {
    use quick_xml::{Reader, events::Event};
    let text = row(
        "KTU  <!-- > --><repeat\n num = \"2\" >A&lt;<![CDATA[<&]]></repeat ><?x <y>?><Part code='>\"/'/>B&#x41;",
    );
    let mut reader = Reader::from_str(&text);
    let (mut names, mut values) = (vec![], vec![]);
    loop {
        match reader.read_event().unwrap() {
            Event::Eof => break,
            Event::Start(tag) | Event::Empty(tag) => {
                names.push(tag.name().as_ref().to_owned());
                for attribute in tag.attributes() {
                    values.push(attribute.unwrap().value.to_string());
                }
            }
            _ => {}
        }
    }
    assert_eq!(names, ["House", "Storey", "Row", "repeat", "Part"]);
    assert_eq!(values, ["2", ">\"/"]);
    let document = clean(&text);
    let [_, Item::Repeat(repeat), Item::One(Piece::Code(code, _)), _] =
        &first_row(&document).pieces[..]
    else {
        panic!("four pieces")
    };
    assert_eq!(repeat.num.value, 2);
    assert_eq!(codes_of(&repeat.body), ["A<<& "]);
    assert_eq!(code, b">\"/  ");
}
