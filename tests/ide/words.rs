//! Colours that know the language.

use crate::ide::analysis;
use crate::support;
use hsd::ide::Analysis;
use hsd::ide::tokens::{TokenKind, tokens};

/// The words and what they are, with `!` behind what is named there, `+` behind own parts, `?` behind what nobody knows.
fn told(a: &Analysis) -> Vec<String> {
    let found = tokens(a).into_iter();
    found
        .map(|t| {
            let m = t.modifiers;
            let marks = [(m.declaration, "!"), (m.own, "+"), (m.unknown, "?")];
            let marks: String = marks
                .iter()
                .filter(|(on, _)| *on)
                .map(|(_, s)| *s)
                .collect();
            format!("{:?}{marks} {}", t.kind, &a.text()[t.range])
        })
        .collect()
}

#[test]
fn legacy_words() {
    let text = "# 家\n0 0 180\n9 8\nname 表 店\nstreet yes\n\nKSK  TOD  XYZ 2.....L\nAPW  ^\n\nK X 14.0 KIR 0 0 6 8 P4.0 O\n%\n";
    let a = analysis("a.hsd", text, &[]);
    let expected = [
        "Comment # 家",
        "Number 0",
        "Number 0",
        "Number 180",
        "Number 9",
        "Number 8",
        "Keyword name",
        "String 表 店",
        "Keyword street",
        "Keyword yes",
        "Code KSK",
        "Code TOD",
        "Code? XYZ 2",
        "Code .....",
        "Operator L",
        "Code APW",
        "Operator ^",
        "Keyword K",
        "Keyword X",
        "Number 14.0",
        "Keyword KIR",
        "Number 0",
        "Number 0",
        "Number 6",
        "Number 8",
        "Attribute P",
        "Number 4.0",
        "Keyword O",
        "Operator %",
    ];
    assert_eq!(told(&a), expected);
}

#[test]
fn xml_words() {
    let text = r#"<!-- 二
  行 --><House name="店" street="yes"><PartDef code="KXX" base="KSK"/><let name="幅" value="3"/>
<define name="戸" n=""><repeat num="{max(n, 1) + 幅}">KXX</repeat></define>
<Storey height="9"><Row><use name="戸" n="{2}"/>GSI  ZZZ  <random code="KSK, GDE 2"/>{'TOD'}</Row></Storey></House>"#;
    let a = analysis("a.hsd", text, &[]);
    let expected = [
        "Comment <!-- 二",
        "Comment 行 -->",
        "Element House",
        "Attribute name",
        "String 店",
        "Attribute street",
        "Keyword yes",
        "Element PartDef",
        "Attribute code",
        "Code! KXX",
        "Attribute base",
        "Code KSK",
        "Element let",
        "Attribute name",
        "Variable! 幅",
        "Attribute value",
        "Number 3",
        "Element define",
        "Attribute name",
        "Function! 戸",
        "Parameter! n",
        "Element repeat",
        "Attribute num",
        "Operator {",
        "Function max",
        "Operator (",
        "Variable n",
        "Operator ,",
        "Number 1",
        "Operator )",
        "Operator +",
        "Variable 幅",
        "Operator }",
        "Code+ KXX",
        "Element repeat",
        "Element define",
        "Element Storey",
        "Attribute height",
        "Number 9",
        "Element Row",
        "Element use",
        "Attribute name",
        "Function 戸",
        "Parameter n",
        "Operator {",
        "Number 2",
        "Operator }",
        "Code GSI",
        "Code? ZZZ",
        "Element random",
        "Attribute code",
        "Code KSK",
        "Code GDE 2",
        "Operator {",
        "Code 'TOD'",
        "Operator }",
        "Element Row",
        "Element Storey",
        "Element House",
    ];
    assert_eq!(told(&a), expected);
}

#[test]
fn no_example_has_an_unknown_word() {
    for folder in ["examples", "library"] {
        for path in support::texts(folder) {
            // Pictures and files of parts lie beside these.
            let name = support::stem(&path);
            if matches!(&*name, "tea-shop" | "figure4" | "years") {
                continue;
            }
            let a = analysis("a.hsd", &std::fs::read_to_string(&path).unwrap(), &[]);
            let unknown = tokens(&a).into_iter().find(|t| t.modifiers.unknown);
            let unknown = unknown.map(|t| a.text()[t.range].to_owned());
            assert_eq!(unknown, None, "{name}");
            assert!(tokens(&a).iter().any(|t| t.kind != TokenKind::Comment));
        }
    }
}
