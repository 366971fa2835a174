//! Hints at the ends of lines and behind the tags of storeys.

use crate::ide::analysis;
use crate::support::Words;
use hsd::diagnostic::Language;
use hsd::ide::inlay::inlays;

/// The lines of a text with their hints behind `«`.
fn hinted(text: &str, language: Language) -> Vec<String> {
    let a = analysis("a.hsd", text, &[]);
    let mut made = text.to_owned();
    for inlay in inlays(&a, 0..text.len(), language).iter().rev() {
        made.insert_str(inlay.at, &format!("«{}»", inlay.label));
    }
    let lines = made.lines().filter(|l| l.contains('«'));
    lines.map(|l| l.trim().to_owned()).collect()
}

#[test]
fn legacy_lines_say_how_long_they_are_and_where_the_walk_stands() {
    let text = "0 0 180\n9.5 8\n\nGSI  GSI  GDE 2TOD  KKS  \nAPW  APW\n\
                KTU  TSH 2TSH 2KTU\nAPW  APW  ^\nKSK  MMU  KSK\n";
    assert_eq!(
        hinted(text, Language::English),
        [
            "GSI  GSI  GDE 2TOD  KKS«6 U → (6, 0)»«storey 1 · 9.5 shaku»",
            "APW  APW«2 U → (6, 2)»",
            "KTU  TSH 2TSH 2KTU«6 U → (0, 2)»",
            "APW  APW  ^«2 U → (0, 0)»",
            "KSK  MMU  KSK«3 U → (3, 0) · open: 3 right»«storey 2 · 8 shaku»",
        ]
    );
    let ja = hinted(text, Language::Japanese);
    assert!(ja[4].ends_with("未完: 右へ 3»«2階 · 8尺»"), "{}", ja[4]);
}

#[test]
fn repeated_lines_and_storeys_say_how_often() {
    let text = r#"<House><define name="side"><Row>APW  APW</Row></define>
<repeat num="3"><Storey height="9">
<repeat num="2"><Row turn="0">APW</Row></repeat><Row>APW</Row>
<use name="side"/>
<Row>TSH 2KTU</Row>
<use name="side"/>
</Storey></repeat></House>"#;
    assert_eq!(
        hinted(text, Language::English),
        [
            "<House><define name=\"side\"><Row>APW  APW</Row>«2 U»</define>",
            "<repeat num=\"3\"><Storey height=\"9\">«storey 1–3 · 9 shaku»",
            "<repeat num=\"2\"><Row turn=\"0\">APW</Row>«1 U»</repeat><Row>APW</Row>«1 U»",
            "<Row>TSH 2KTU</Row>«3 U»",
        ]
    );
    let one = text
        .replace("<repeat num=\"3\">", "")
        .replace("</Storey></repeat>", "</Storey>");
    let found = hinted(&one, Language::English);
    assert!(found[2].contains("«1 U ×2 = 2 U → (2, 0)»"), "{}", found[2]);
    assert!(found[2].ends_with("«1 U → (3, 0)»"), "{}", found[2]);
}

#[test]
fn hints_of_a_range_are_those_of_its_lines() {
    let text = "0 0 180\n9\n\nAPW  APW\nAPW  APW\nAPW  APW\nAPW  APW\n";
    let a = analysis("a.hsd", text, &[]);
    let third = text.match_indices("APW  APW").nth(2).unwrap().0;
    let found = inlays(&a, third..third + 8, Language::English);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].label, "2 U → (0, 2)");
    assert!(
        found[0].tooltip.en().contains("1.82 m"),
        "{:?}",
        found[0].tooltip
    );
}
