//! The XML form: the paper's figure, every element, and what is wrong in every way.

use hsd_base::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd_base::source::{FileId, Limits, Source};
use hsd_ir::ast::*;
use hsd_syntax::parse::xml;
use hsd_testing::Words;

fn read(text: &str) -> (Document, Vec<Diagnostic>) {
    let source = Source::new(FileId(0), "test.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    let document = xml::parse(&source, &Limits::default(), &mut out);
    let list = out.into_sorted();
    for d in &list {
        for span in d.labels.iter().map(|l| l.span).chain([d.span().unwrap()]) {
            assert!(
                span.start <= span.end && span.end as usize <= text.len(),
                "{d:?} in {text:?}"
            );
            assert!(text.is_char_boundary(span.start as usize), "{d:?}");
            assert!(text.is_char_boundary(span.end as usize), "{d:?}");
        }
        assert!(!d.message.is_empty() && !d.message.en().ends_with('.') && !d.help.is_empty());
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
        .map(|d| {
            (
                d.code.0,
                &text[d.span().unwrap().start as usize..d.span().unwrap().end as usize],
            )
        })
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
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "hsd") {
            continue;
        }
        let text = std::fs::read_to_string(path).unwrap();
        // What others include is read with them in tests/examples.rs.
        if text.trim_start().starts_with('<') && !text.contains("<include") {
            clean(&text);
            count += 1;
        }
    }
    assert!(count >= 5);
}

#[test]
fn every_fixture_shows_its_code_and_no_other() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/suite/diagnostics");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let ours = name.starts_with("HSD02") || name.starts_with("HSD0902");
        // Those of several files are read with them in tests/diagnostics.rs.
        let files = ["HSD0243", "HSD0268_above", "HSD0269", "HSD0270", "HSD0272"];
        if files.iter().any(|f| name.starts_with(f)) {
            continue;
        }
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
        let houseless = ["<Catalog>", "<Place"].iter().any(|tag| text.contains(tag))
            || name.contains("no_element");
        assert!(houseless || !document.houses.is_empty());
        let page = format!(
            "{}/../../grammar/diagnostics/{}.md",
            env!("CARGO_MANIFEST_DIR"),
            found[0]
        );
        let page = std::fs::read_to_string(page).unwrap();
        assert!(page.starts_with(&format!("# {}: ", found[0])));
        count += 1;
    }
    assert!(count >= 39, "{count}");
}

/// The only message, and the document.
fn only(text: &str) -> (Document, Diagnostic) {
    let (document, mut list) = read(text);
    assert_eq!(list.len(), 1, "{list:#?}");
    (document, list.remove(0))
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

mod hostile;
mod fixes;
mod tree;

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
