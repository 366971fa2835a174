//! Texts laid out anew say the same, look as they should, and are laid out once and for all.

use hsd_base::diagnostic::{Code, Diagnostics};
use hsd_base::source::{FileId, Limits, Source};
use hsd_syntax::print::{encode, essence, format};
use hsd_testing::cpu::assert_linear;
use std::fs;
use std::path::{Path, PathBuf};

fn source(bytes: &[u8]) -> Source {
    Source::new(FileId(0), "a.hsd", bytes)
}

/// Lays out a text and checks what holds for every layout.
fn laid_out(name: &str, bytes: &[u8]) -> Option<String> {
    let before = source(bytes);
    let limits = Limits::default();
    let mut out = Diagnostics::new();
    let text = format(&before, &limits, &mut out);
    let fault = out.iter().any(|d| d.code == Code(801));
    assert!(!fault, "{name}: {}", before.text());
    let Some(text) = text else {
        assert!(out.has_errors(), "{name}: refused without a word");
        return None;
    };
    let bytes = encode(&text, &before);
    let after = source(&bytes);
    assert_eq!(after.text(), text, "{name}");
    assert_eq!(after.encoding(), before.encoding(), "{name}");
    let parsed = |s| {
        essence(&hsd_syntax::parse::parse(
            s,
            &limits,
            &mut Diagnostics::new(),
        ))
    };
    assert!(parsed(&before) == parsed(&after), "{name}: {text}");
    let again = format(&after, &limits, &mut Diagnostics::new()).unwrap();
    assert_eq!(again, text, "{name}: laid out twice");
    Some(text)
}

fn texts_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            texts_below(&path, found);
        } else if path.extension().is_some_and(|e| e == "hsd") {
            found.push(path);
        }
    }
}

fn texts(folders: &[&str]) -> Vec<PathBuf> {
    let mut found = vec![];
    for folder in folders {
        texts_below(&hsd_testing::root().join(folder), &mut found);
    }
    found.sort();
    found
}

#[test]
fn every_text_of_the_project_keeps_its_meaning() {
    let mut sound = 0;
    for path in texts(&["examples", "library", "tests"]) {
        let bytes = fs::read(&path).unwrap();
        sound += usize::from(laid_out(&path.display().to_string(), &bytes).is_some());
    }
    assert!(sound > 100, "{sound}");
}

#[test]
fn the_examples_are_laid_out() {
    for path in texts(&["examples", "library"]) {
        if path.ends_with("figure4.hsd") {
            continue; // stands as it is printed in the paper
        }
        let text = fs::read_to_string(&path).unwrap();
        let after = laid_out(&path.display().to_string(), text.as_bytes()).unwrap();
        assert_eq!(text, after, "{}: run `hsd fmt`", path.display());
    }
}

#[test]
fn legacy_texts_are_laid_out_in_columns() {
    let before = "\n\n# 町家  \n0   0\t180\n  9.0 5\nname   a  b \nunit 3.0\n\n\n# walls\n\
        GSI       KKS  \nAPW  APW  L   \n\nR\n^\n";
    assert_eq!(laid_out("errors", before.as_bytes()), None);
    let before = "\n\n# 町家  \n0   0\t180\n  9.0 5\nname   a  b \nunit 3.0\n\n\n# walls\n\
        GSI       KKS  \nAPW  APW  L   \n     GSI  TSH 2\nR\nGSI  ^\n.....GSI  \n\n\n# roofs\n\n\
        K X 14 KIR 0 0 6 8 P4.0   E2.5\n\nI * * HIS 0.25 0 6 -1.5\n%\n0 0\n\nKSM\n\n";
    let after = "# 町家\n0 0 180\n9.0 5\nname a  b\nunit 3.0\n\n# walls\n\
        GSI  .....KKS\nAPW  APW  L\n.....GSI  TSH 2\nR\nGSI  ^\n.....GSI\n\n# roofs\n\n\
        K X  14.0 KIR    0   0   6    8  P4.0 E2.5\n\nI *     * HIS 0.25   0   6 -1.5\n%\n0 0\n\nKSM\n";
    assert_eq!(
        laid_out("legacy", before.as_bytes()).as_deref(),
        Some(after)
    );
}

#[test]
fn a_last_code_of_one_letter_keeps_its_blanks() {
    let before = "0 0\n9\n\nKSK  K \n";
    let after = "0 0\n9\n\nKSK  K    \n";
    assert_eq!(
        laid_out("letter", before.as_bytes()).as_deref(),
        Some(after)
    );
}

#[test]
fn xml_texts_are_laid_out_by_levels() {
    for (before, after) in [
        (
            "<House><Storey height = '9'  ><Row>GSI  TOD</Row></Storey></House>",
            "<House>\n  <Storey height='9'><Row>GSI  TOD</Row></Storey>\n</House>\n",
        ),
        (
            "<House>\n<!-- a\n     b --><Storey> <!-- c -->\n\n\n<Row>GSI  <random code=\"A, B\"/>TIT 2KTU</Row>\n\n\n<Row></Row></Storey></House>",
            "<House>\n  <!-- a\n       b -->\n  <Storey> <!-- c -->\n\n    <Row>GSI  <random code=\"A, B\"/>TIT 2KTU</Row>\n\n    <Row/>\n  </Storey>\n</House>\n",
        ),
        (
            "<House><Storey><Row>GSI\n        TOD  <Part code='KKS'/>\n\n\n   KSM</Row>\n<Row>     GSI\nKSM  </Row>\n</Storey></House>",
            "<House>\n  <Storey>\n    <Row>\n      GSI\n      TOD  <Part code='KKS'/>\n\n      KSM\n    </Row>\n    <Row>     GSI\n      KSM  </Row>\n  </Storey>\n</House>\n",
        ),
        (
            "<?xml version=\"1.0\"?><House><Row><Part code=\"A\"/> <Part code=\"B\"/> <!-- x --> GSI</Row><own:thing xmlns:own='u'><b>1 &amp; 2</b> </own:thing></House>",
            "<?xml version=\"1.0\"?>\n<House>\n  <Row><Part code=\"A\"/><Part code=\"B\"/> <!-- x --> GSI</Row>\n  <own:thing xmlns:own='u'>\n    <b>1 &amp; 2</b>\n  </own:thing>\n</House>\n",
        ),
    ] {
        assert_eq!(laid_out(before, before.as_bytes()).as_deref(), Some(after));
    }
}

#[test]
fn long_tags_and_long_rows_are_broken() {
    let tag = "<Roof kind=\"K\" ridge=\"X\" height=\"18.5\" shape=\"KIR\" a0=\"0\" b0=\"0\" a1=\"5\" b1=\"8\" pitch=\"4.0\" eaves=\"0.2\"/>";
    let parts = "<Part code=\"TSH 2\"/>".repeat(6);
    let text = format!("<House><Storey><Row>{parts}</Row></Storey><Roofs>{tag}</Roofs></House>");
    let text = laid_out("long", text.as_bytes()).unwrap();
    assert!(text.lines().all(|l| l.len() <= 100), "{text}");
    assert_eq!(text.matches("\n      <Part").count(), 6, "{text}");
    assert!(
        text.contains(" pitch=\"4.0\"\n        eaves=\"0.2\"/>\n"),
        "{text}"
    );
}

#[test]
fn encodings_and_line_ends_stay() {
    let legacy = "# 町家\n0 0\n\n\nGSI  GSI  \n";
    let xml = "<?xml version=\"1.0\" encoding=\"Shift_JIS\"?>\n<House name=\"町家\"><Storey><Row>GSI</Row>\n</Storey></House>";
    for text in [legacy, xml] {
        let windows = text.replace('\n', "\r\n");
        let old = text.replace('\n', "\r");
        for text in [text, &windows, &old] {
            let (shift_jis, ..) = encoding_rs::SHIFT_JIS.encode(text);
            let marked = ["\u{feff}", text].concat();
            let utf16: Vec<u8> = marked.encode_utf16().flat_map(u16::to_be_bytes).collect();
            for bytes in [&shift_jis[..], marked.as_bytes(), &utf16] {
                let after = laid_out(text, bytes).unwrap();
                assert_eq!(after.matches("\r\n").count() > 0, text.contains("\r\n"));
                assert_eq!(after.contains('\n'), text.contains('\n'));
                assert_eq!(encode(&after, &source(bytes))[..2], bytes[..2]);
            }
        }
    }
}

/// A generator of numbers without a seed from outside, so that a failure can be found again.
struct Draws(u64);

impl Draws {
    fn next(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below as u64) as usize
    }
}

const BITS: [&str; 26] = [
    "\n",
    "\r\n",
    "\r",
    "\n\n\n",
    " ",
    "     ",
    ".....",
    "L\n",
    "^\n",
    "# c\n",
    "%\n",
    "KSM  ",
    "TSH 2",
    "0.5 ",
    "name x\n",
    "K X * KIR 0 0 1 1\n",
    "<!-- a\n   b -->",
    "<Part code=\"KSM\"/>",
    "<Row>",
    "</Row>",
    "&amp;",
    "　",
    "町",
    "<![CDATA[KSM  ]]>",
    " x=\"a\n b\"",
    "{k}",
];

fn mutate(text: &mut String, draws: &mut Draws) {
    let mut place = |most: usize| {
        let mut at = draws.next(most + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let (from, to) = (place(text.len()), place(text.len()));
    let (from, to) = (from.min(to), from.max(to).min(from.min(to) + 40));
    let to = (to..=text.len())
        .find(|at| text.is_char_boundary(*at))
        .unwrap();
    match draws.next(4) {
        0 | 1 => text.insert_str(from, BITS[draws.next(BITS.len())]),
        2 => text.replace_range(from..to, ""),
        _ => {
            let copy = text[from..to].to_owned();
            text.insert_str(to, &copy);
        }
    }
}

#[test]
fn random_texts_keep_their_meaning() {
    let mut draws = Draws(0x9e37_79b9_7f4a_7c15);
    let mut sound = 0;
    let samples: Vec<String> = texts(&["examples"])
        .iter()
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    for round in 0..4000 {
        let mut text = samples[round % samples.len()].clone();
        for _ in 0..=draws.next(4) {
            mutate(&mut text, &mut draws);
        }
        sound += usize::from(laid_out(&format!("round {round}"), text.as_bytes()).is_some());
    }
    assert!(sound > 1000, "{sound}");
}

#[test]
fn formatting_takes_linear_time() {
    let split = ("<split>".repeat(200), "</split>".repeat(200));
    let nested = ("<x>".repeat(200), "</x>".repeat(200));
    let row = "<Row>GSI  <Part code='KSM'/>TSH 2</Row><Row>\n<Part code='A'/>\n</Row>\n";
    for (head, piece, tail) in [
        ("0 0\n\n", "GSI  GSI  TSH 2.....KKS\nAPW  APW  L\n", ""),
        ("<House><Storey>", row, "</Storey></House>"),
        ("<House>", &*[&*nested.0, &*nested.1].concat(), "</House>"),
        (&*split.0, "<Part code='A'/>", &*split.1),
        ("", "<!--", ""),
        ("", "<a b='c' ", ""),
    ] {
        let make = |bytes: usize| {
            let text = [head, &piece.repeat(bytes / piece.len()), tail].concat();
            source(text.as_bytes())
        };
        assert_linear(
            &format!("formatting {piece:.40}"),
            250_000,
            make,
            |source| format(source, &Limits::default(), &mut Diagnostics::new()),
        );
    }
}

/// What a rule of a town writes is read with its features; a start tag that differs from its end is told all the same.
#[test]
fn a_misspelt_start_tag_in_a_rule_is_told() {
    let text = "<Town>\n  <Layer name=\"h\" src=\"h.geojson\"/>\n  <for each=\"h\">\n    <randomx></random>\n  </for>\n</Town>\n";
    assert_eq!(laid_out("a rule", text.as_bytes()), None);
}
