//! Pieces, repetitions and texts that would grow beyond all measure end soon, with a message.

use super::read;
use std::fmt::Write;
use std::time::{Duration, Instant};

/// The codes of the messages on a text, which must come soon.
fn soon(text: &str) -> Vec<u16> {
    let start = Instant::now();
    let done = read(text);
    // The tests are not optimised and share the machine; a run of the program takes a tenth of it.
    assert!(start.elapsed() < Duration::from_secs(20));
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
    assert!(done.list[0].message.contains("`p50` in which `p49`"));
    assert!(done.document.houses.is_empty());
    assert_eq!(
        soon(&house.replace("'p50'/></Row>", "'p60'/></Row>")),
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
    assert_eq!(soon(&text), [902]);
}

#[test]
fn repetitions_of_numbered_storeys_end() {
    let text = "<House><repeat num='10000000'><Storey height='{k}'><Row>KSK</Row></Storey></repeat></House>";
    assert!(soon(text).contains(&904));
    let nested = "<House><repeat num='9999'><repeat num='9999'><Storey height='{8 + 1 / k}'>\
        <Row>KSK</Row></Storey></repeat></repeat></House>";
    assert_eq!(soon(nested), [904]);
}

#[test]
fn texts_that_double_end() {
    let mut text = String::from("<House><let name='a0' value='xxxxxxxx'/>");
    for n in 0..64 {
        let _ = write!(text, "<let name='a{}' value='{{a{n}}}{{a{n}}}'/>", n + 1);
        let _ = write!(text, "<let name='b{}' value='{{a{n} + a{n}}}'/>", n + 1);
    }
    assert!(soon(&(text + "</House>")).contains(&271));
}

#[test]
fn many_braces_and_names_take_no_long_time() {
    let braces = "{".repeat(300_000);
    assert!(soon(&format!("<House name='{braces}'/>")).contains(&251));
    assert!(
        soon(&format!(
            "<House><Storey><Row>{braces}</Row></Storey></House>"
        ))
        .contains(&251)
    );
    let quotes = "{&#34;".repeat(50_000);
    assert!(soon(&format!("<House name='{quotes}'/>")).contains(&251));
    let mut lets = String::new();
    for n in 0..20_000 {
        let _ = write!(lets, "<let name='a{n}' value='{{b{n}}}'/>");
    }
    assert!(soon(&format!("<House>{lets}</House>")).contains(&252));
}
