//! Pieces, repetitions and texts that would grow beyond all measure end with a message. What doubles fifty times would not end
//! at all if it was made first.

use super::read;
use crate::support::Words;
use crate::support::cpu::assert_linear;
use std::fmt::Write;

/// The codes of the messages on a text.
fn codes(text: &str) -> Vec<u16> {
    let done = read(text);
    let mut codes: Vec<u16> = done.list.iter().map(|d| d.code.0).collect();
    codes.dedup();
    codes
}

#[test]
fn doubling_pieces_end() {
    let mut text = String::from("<House><define name='p0'>KSK</define>");
    for n in 0..60 {
        let _ = write!(
            text,
            "<define name='p{}'><use name='p{n}'/><use name='p{n}'/></define>",
            n + 1
        );
    }
    let house = text + "<Storey><Row><use name='p50'/></Row></Storey></House>";
    let done = read(&house);
    assert_eq!(done.list.len(), 1);
    assert_eq!(done.list[0].code.0, 904);
    assert!(done.list[0].message.en().contains("`p50` in which `p49`"));
    assert!(done.document.houses.is_empty());
    assert_eq!(
        codes(&house.replace("'p50'/></Row>", "'p60'/></Row>")),
        [904]
    );
}

#[test]
fn uses_nest_no_deeper_than_elements() {
    let mut text = String::from("<House><define name='p0'>KSK</define>");
    for n in 0..1000 {
        let _ = write!(
            text,
            "<define name='p{}'><use name='p{n}'/></define>",
            n + 1
        );
    }
    text += "<Storey><Row><use name='p1000'/></Row></Storey></House>";
    assert_eq!(codes(&text), [902]);
}

#[test]
fn repetitions_of_numbered_storeys_end() {
    let text = "<House><repeat num='10000000'><Storey height='{k}'><Row>KSK</Row></Storey></repeat></House>";
    assert!(codes(text).contains(&904));
    let nested = "<House><repeat num='9999'><repeat num='9999'><Storey height='{8 + 1 / k}'>\
        <Row>KSK</Row></Storey></repeat></repeat></House>";
    assert_eq!(codes(nested), [904]);
}

#[test]
fn texts_that_double_end() {
    let mut text = String::from("<House><let name='a0' value='xxxxxxxx'/>");
    for n in 0..64 {
        let _ = write!(text, "<let name='a{}' value='{{a{n}}}{{a{n}}}'/>", n + 1);
        let _ = write!(text, "<let name='b{}' value='{{a{n} + a{n}}}'/>", n + 1);
    }
    assert!(codes(&(text + "</House>")).contains(&271));
}

#[test]
fn many_braces_and_names_take_linear_time() {
    let braces = |count: usize| "{".repeat(count);
    let quotes = |count: usize| "{&#34;".repeat(count / 6);
    let lets = |count: usize| {
        let mut lets = String::new();
        for n in 0..count / 15 {
            let _ = write!(lets, "<let name='a{n}' value='{{b{n}}}'/>");
        }
        lets
    };
    type Make<'a> = (&'a dyn Fn(usize) -> String, &'a str, &'a str, u16);
    let all: [Make<'_>; 4] = [
        (&braces, "<House name='", "'/>", 251),
        (
            &braces,
            "<House><Storey><Row>",
            "</Row></Storey></House>",
            251,
        ),
        (&quotes, "<House name='", "'/>", 251),
        (&lets, "<House>", "</House>", 252),
    ];
    for (middle, before, after, code) in all {
        let make = |count| format!("{before}{}{after}", middle(count));
        assert_linear(before, 75_000, make, |text| {
            assert!(codes(text).contains(&code));
        });
    }
}

#[test]
fn a_file_may_place_many_houses() {
    let place = "<Place type='so-nikai' frontage='6' rooms='yes'/>";
    let done = read(&format!("<Houses>{}</Houses>", place.repeat(1600)));
    assert_eq!(done.list.len(), 0);
    assert_eq!(done.document.houses.len(), 1600);
    // Places that are repeated are not written: they share what the one that is may have.
    let repeated = format!(
        "<Houses><repeat num='2000'><let name='n' value='{{k}}'/>{place}</repeat></Houses>"
    );
    assert!(codes(&repeated).contains(&904));
}
