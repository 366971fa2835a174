//! Texts that nobody means: prefixes, mutations, bombs, and a heap of every fault.

use super::{FIGURE_4, read, row};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{FileId, Limits, Source};
use hsd_syntax::parse::xml;
use hsd_testing::assert_none;
use hsd_testing::cpu::growth;

const SAMPLE: &str = "<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY b 'c'>]>\n<!-- 町家 -->\n\
    <Houses><House name=\"shop &amp; home\" street='yes'>\n  <Storey height=\"9.0\" start='0 0'>\n    \
    <Row turn=\"L\">GSI  <![CDATA[GDE 2]]>TSH&#x20; </Row>\n    <Row><repeat num='8'><Part code='窓'/>　KTU</repeat>\n\
    <split ratio='0.5'><upper>NWI</upper><lower>NSP</lower></split><random code='A, B' weights='1 2'/>\n\
    <replace code='A' with='B' at='2,5-7'/></Row></Storey>\n  <Roofs kind='K'><Roof a0='0' b0='0' a1='6' b1='8' \
    ridge='X' height='*'/></Roofs>\n</House></Houses>\n";

#[test]
fn every_prefix_and_suffix_is_survived() {
    for text in [SAMPLE, FIGURE_4] {
        for (at, _) in text.char_indices() {
            read(&text[..at]);
            read(&text[at..]);
        }
    }
}

#[test]
fn ten_thousand_mutations_are_survived() {
    let bits = [
        "<",
        ">",
        "/",
        "\"",
        "'",
        "=",
        "&",
        ";",
        "<!--",
        "-->",
        "<![CDATA[",
        "]]>",
        "<!DOCTYPE",
        "<?",
        "?>",
        "\n",
        " ",
        "　",
        "＜",
        "＞",
        "＝",
        "／",
        "“",
        "”",
        "{",
        "}",
        "L",
        "^",
        "</Row>",
        "<Row>",
        "</",
        "<Part",
        "\u{0}",
        "&#",
        "\t",
        "家",
        "-",
        "]",
        "[",
        "<repeat num='2'>",
        "\r",
        "\u{fffd}",
        "<House>",
        "name=",
        "turn='R'",
    ];
    let mut state = 0x2545_f491_4f6c_dd1du64;
    let mut next = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    for round in 0..10_000 {
        let text = if round % 2 == 0 { SAMPLE } else { FIGURE_4 };
        let mut chars: Vec<char> = text.chars().collect();
        for _ in 0..=next(6) {
            let at = next(chars.len());
            match next(4) {
                0 => drop(chars.remove(at)),
                1 => drop(chars.drain(at..(at + next(20)).min(chars.len()))),
                2 => {
                    let bit = bits[next(bits.len())];
                    chars.splice(at..at, bit.chars());
                }
                _ => {
                    let end = (at + next(40)).min(chars.len());
                    let copy = chars[at..end].to_vec();
                    let to = next(chars.len());
                    chars.splice(to..to, copy);
                }
            }
            if chars.is_empty() {
                break;
            }
        }
        read(&chars.into_iter().collect::<String>());
    }
}

/// An eighth of a mebibyte of one thing: linear time, and a bounded number of messages.
#[test]
fn a_heap_of_anything_is_read_in_linear_time() {
    let mut findings = vec![];
    let bits = [
        "<a b=\"\n",
        "<a b='\n",
        "<!--\n",
        "<![CDATA[\n",
        "<?\n",
        "<!DOCTYPE [\n",
        "<a>\n<!DOCTYPE [\n",
        "<",
        "&",
        "&a;",
        "&#65;",
        "<a ",
        "<a",
        "<Row>",
        "<a>",
        "</a>",
        "<a></b>",
        "<a/>",
        "<a b c d=e f='g' ",
        "a='1' ",
        "<a b=\"c d=\"e ",
        "＜",
        "<a b=“c”>\n",
        "　",
        "]]>",
        "{",
        "}",
        "\t",
        "家",
        "L\n",
        "\u{1}",
        "<House a='<'>",
        "=",
        " ",
        "\n",
        "\r",
        "<x1 y2='3'/>",
        "<Part code='KTU'/>",
        "KTU  ",
        "</",
        "< ",
        "/ ",
        "\"",
        "<!---",
        "<Rwo>\n</Rwo",
        "<a x='\n<",
        "<a\nb\nc",
        "＜/a",
        "<!D",
        "<!-",
        "<![",
        "<?>",
        "<!DOCTYPE>",
        "&a b ",
    ];
    for bit in bits {
        for (before, after) in [
            ("", ""),
            ("<House><Storey><Row>", "</Row>"),
            ("<House x=\"", "\"/>"),
        ] {
            let make = |bytes: usize| {
                let text = format!("{before}{}{after}", bit.repeat(bytes / bit.len()));
                Source::new(FileId(0), "big", text.as_bytes())
            };
            let read = |source: &Source| {
                let mut out = Diagnostics::new();
                xml::parse(source, &Limits::default(), &mut out);
                assert!(out.iter().count() <= 501);
            };
            let faster = growth(1 << 15, make, read);
            findings.extend(faster.map(|f| format!("{before:?} {bit:?} {f}")));
        }
    }
    assert_none(&findings);
}

#[test]
fn nesting_is_bounded() {
    let depth = |n: usize| {
        let inner = "<split><upper>NWI</upper><lower>".repeat(n);
        row(&format!("{inner}NSP{}", "</lower></split>".repeat(n)))
    };
    assert!(read(&depth(30)).1.is_empty());
    let (_, list) = read(&depth(31));
    assert!(
        !list.is_empty() && list.iter().all(|d| d.code.0 == 902),
        "{list:?}"
    );
    // Whatever the limit is raised to, the stack holds.
    let text = depth(100_000);
    let source = Source::new(FileId(0), "deep", text.as_bytes());
    let mut out = Diagnostics::new();
    let limits = Limits {
        nesting: usize::MAX,
        ..Limits::default()
    };
    let document = xml::parse(&source, &limits, &mut out);
    assert!(out.iter().all(|d| d.code.0 == 902));
    assert_eq!(document.houses.len(), 1);
}

#[test]
fn nothing_is_joined_to_a_tag_that_is_not_closed() {
    for attribute in ["あ", "a"] {
        let (_, list) = read(&format!("<House><Posts {attribute}<Posts/></House>"));
        let second = list.iter().find(|d| d.code.0 == 231).expect("is reported");
        assert_eq!(second.fixes.len(), 1, "only removing it is left");
    }
}

#[test]
fn a_flood_of_faults_ends() {
    let text = row(&"&".repeat(30_000));
    let (_, list) = read(&text);
    assert_eq!(list.len(), 501);
    assert!(list.iter().any(|d| d.code.0 == 909));
}

#[test]
fn places_count_bytes_of_the_original_file() {
    let text = "<House name='町家'><Storey><Row>KTU　</Row></Storey></House>";
    let (bytes, ..) = encoding_rs::SHIFT_JIS.encode(text);
    let source = Source::new(FileId(0), "sjis", &bytes);
    let mut out = Diagnostics::new();
    let document = xml::parse(&source, &Limits::default(), &mut out);
    let list = out.into_sorted();
    let span = list[0].span().unwrap();
    assert_eq!(&bytes[span.start as usize..span.end as usize], b"\x81\x40");
    assert_eq!(document.houses[0].name.as_ref().unwrap().value, "町家");
}
