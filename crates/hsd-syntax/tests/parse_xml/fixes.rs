//! Broken markup and wrong words: what is said, and what is read all the same.

use super::*;
use hsd_testing::Words;

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

#[test]
fn words_of_other_programs_are_understood() {
    let (document, d) = only("<House name=「裏長屋」><Storey><Row>KTU  </Row></Storey></House>");
    assert_eq!(d.code.0, 211);
    assert!(
        d.help.en().ends_with("`name=\"裏長屋\"`"),
        "{}",
        d.help.en()
    );
    let name = document.houses[0].name.as_ref();
    assert_eq!(name.map(|n| n.value.as_str()), Some("裏長屋"));
    let (document, d) = only(&row("<repeat count=\"5\">KTU  </repeat>"));
    assert_eq!((d.code.0, d.help.en().as_str()), (222, "write `num`"));
    let Item::Repeat(repeat) = &first_row(&document).pieces[0] else {
        panic!("no repeat")
    };
    assert_eq!(repeat.num.value, 5);
    let (document, d) = only("<House><Roof kind=\"I\"/></House>");
    assert_eq!((d.code.0, d.help.en().as_str()), (223, "write `Roofs`"));
    let kind = document.houses[0].roofs.style.kind.map(|k| k.value);
    assert_eq!(kind, Some(RoofKind::Boards));
    let (_, d) = only(&row("<repeat num=\"5\"/>"));
    assert_eq!((d.code.0, d.severity), (242, Severity::Warning));
    let (document, d) = only(&row("KTU  KSM\tKTU  "));
    assert!(
        d.help
            .en()
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
    assert!(list[0].help.en().contains("`<`"), "{:?}", list[0]);
    assert_eq!(faults("<House name=\"a” street=\"yes\"/>"), [(218, "”")]);
    assert_eq!(faults("<Ｈｏｕｓｅ/>"), [(221, "Ｈｏｕｓｅ")]);
    // Quotes of any kind are plain characters inside a value.
    clean("<House name=\"“鶴” と ‘亀’ ＝\"/>");
}

#[test]
fn unknown_words_get_the_nearest_known_one() {
    let help = |text: &str| {
        let (_, list) = read(text);
        (list[0].code.0, list[0].help.en())
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
fn elements_of_the_language_are_known() {
    let text = "<House><PartDef x='1'>text<b/></PartDef></House>";
    assert_eq!(faults(text), [(224, "PartDef"), (222, "x"), (209, "text")]);
    assert_eq!(faults("<Catalog><PartDef/></Catalog>"), [(224, "PartDef")]);
    assert_eq!(faults("<House name='{a}'/>"), [(252, "a")]);
    assert_eq!(
        faults(&row("<repeat num=\"{n}\">KTU</repeat>")),
        [(252, "n")]
    );
    assert_eq!(faults(&row("KTU  {a}KTU")), [(252, "a")]);
    clean(&row("<Part code='f1f{k}f2'/><Part code='GDE_2'/>"));
}
