//! Outlines of files: lines, elements, codes, expressions.

use hsd_base::source::{FileId, Limits, Source};
use hsd_syntax::parse::outline::of;
use hsd_syntax::parse::syntax::{LineKind, Outline};

fn outline(text: &str) -> Outline {
    let source = Source::new(FileId(0), "家.hsd", text.as_bytes());
    of(&source, &Limits::default())
}

#[test]
fn lines_have_codes_and_turns() {
    let text = "# 町家\n0 0 180\n9.0\n\nGSI  2TOD L\nKKS\n";
    let outline = outline(text);
    let kinds: Vec<LineKind> = outline.lines.iter().map(|l| l.kind).collect();
    use LineKind::{Blank, Comment, Header, Wall};
    assert_eq!(kinds, [Comment, Header, Header, Blank, Wall, Wall]);
    let wall = &outline.lines[4];
    let codes: Vec<&str> = wall.codes.iter().map(|c| &text[c.clone()]).collect();
    assert_eq!(codes, ["GSI  ", "2TOD "]);
    assert_eq!(wall.turn.clone().map(|t| &text[t]), Some("L"));
    assert_eq!(outline.comments.first(), Some(&(0..8)));
}

#[test]
fn elements_have_places_even_in_broken_files() {
    let text = "<House name='家'><Storey><Row>KSK  {a + b}<!-- x --></Row><use name='&lt;{n}' w=\"{2 * d}\"";
    let outline = outline(text);
    let names: Vec<&str> = outline
        .elements
        .iter()
        .map(|e| &text[e.name.clone()])
        .collect();
    assert_eq!(names, ["House", "Storey", "Row", "use"]);
    let row = &outline.elements[2];
    assert_eq!(row.parent, Some(1));
    assert_eq!(row.end_name.clone().map(|n| &text[n]), Some("Row"));
    assert_eq!(&text[row.words[0].codes[0].clone()], "KSK  ");
    let names = &row.words[0].expressions[0].names;
    let names: Vec<&str> = names.iter().map(|n| &text[n.clone()]).collect();
    assert_eq!(names, ["a", "b"]);
    let used = &outline.elements[3];
    assert_eq!(used.value("name"), Some("<{n}"));
    let name = used.attribute("w").expect("is there").expressions[0].names[0].clone();
    assert_eq!(&text[name], "d");
    assert_eq!(outline.comments.len(), 1);
    assert_eq!(outline.element_at(row.words[0].range.start), Some(2));
}
