//! Included files: what comes from them, how often they are read, where messages point.

use super::{Texts, codes, options, read_in, rows, storeys};
use crate::support::Words;
use hsd::diagnostic::Diagnostics;
use hsd::driver;
use hsd::report::{Format, Report, Style};
use hsd::source::{FileId, Source};

const MAIN: &str = "<House><include href='a.hsd'/><include href='b.hsd'/>\
    <Storey><Row><use name='a'/><use name='b'/>{door}</Row></Storey></House>";

#[test]
fn definitions_names_and_parameters_come_from_files_that_are_read_once() {
    let world = Texts::default()
        .with(
            "a.hsd",
            "<Catalog><include href='c.hsd'/><define name='a'>{wall}</define></Catalog>",
        )
        .with(
            "b.hsd",
            "<House><include href='c.hsd'/><define name='b'>{wall}</define></House>",
        )
        .with(
            "c.hsd",
            "<Catalog><Param name='wall' default='KSK'/><let name='door' value='TOD'/></Catalog>",
        );
    let done = read_in(&world, MAIN, &[("wall", "KTU")]);
    assert!(done.list.is_empty(), "{:#?}", done.list);
    let row = rows(storeys(&done.document)[0])[0];
    assert_eq!(codes(row), ["KTU", "KTU", "TOD"]);
    assert_eq!(world.read.load(std::sync::atomic::Ordering::Relaxed), 3);
    let names: Vec<&str> = done.included.iter().map(Source::name).collect();
    assert_eq!(names, ["a.hsd", "c.hsd", "b.hsd"]);
}

#[test]
fn several_texts_share_what_they_include() {
    let world = Texts::default().with(
        "a.hsd",
        "<Catalog><define name='a'>{wlal}</define></Catalog>",
    );
    let text = "<House><include href='a.hsd'/><Storey><Row><use name='a'/></Row></Storey></House>";
    let sources = [0, 1].map(|i| Source::new(FileId(i), format!("{i}.hsd"), text.as_bytes()));
    let (options, mut out) = (hsd::Options::default(), Diagnostics::new());
    let both = [&sources[0], &sources[1]];
    let read = hsd::driver::documents(&both, &world, &options, &mut out);
    assert_eq!(world.read.load(std::sync::atomic::Ordering::Relaxed), 1);
    assert_eq!(read.included[0].id(), FileId(2));
    assert_eq!(out.into_sorted().len(), 1);
}

#[test]
fn messages_point_into_the_included_file_in_its_own_bytes() {
    let library = "<?xml version='1.0' encoding='Shift_JIS'?>\n<Catalog><!-- 町家 -->\
        <define name='格子'><repeat num='{間口}'>GSI</repeat></define></Catalog>";
    let (bytes, ..) = encoding_rs::SHIFT_JIS.encode(library);
    let world = Texts::default().with("町家.hsd", &bytes);
    let text = "<House><include href='町家.hsd'/><Storey><Row><use name='格子'/>\
        <use name='格子'/></Row></Storey></House>";
    let done = read_in(&world, text, &[]);
    let unknown: Vec<_> = done.list.iter().filter(|d| d.code.0 == 252).collect();
    assert_eq!(unknown.len(), 1, "said once, though used twice");
    let (span, name) = (
        unknown[0].span().unwrap(),
        encoding_rs::SHIFT_JIS.encode("間口").0,
    );
    assert_eq!(&bytes[span.start as usize..span.end as usize], &*name);
    assert_eq!(span.file, FileId(1));

    let mut sources = vec![done.source];
    sources.extend(done.included);
    for (format, wanted) in [
        (Format::Json, r#""file":"町家.hsd","line":2"#),
        (Format::Sarif, "%E7%94%BA%E5%AE%B6.hsd"),
        (Format::Short, "町家.hsd:2:"),
        (Format::Human, "町家.hsd:2:"),
    ] {
        let mut told = vec![];
        let report = Report::new(&sources, &done.list);
        report.write(format, Style::default(), &mut told).unwrap();
        let told = String::from_utf8(told).unwrap();
        assert!(told.contains(wanted), "{told}");
    }
}

#[test]
fn cycles_are_shown_and_what_is_sound_is_taken() {
    let world = Texts::default()
        .with("a.hsd", "<Catalog><include href='b.hsd'/><define name='a'>KSK</define></Catalog>")
        .with("b.hsd", "<Catalog><include href='a.hsd'/><define name='b'>GSI</define><let name='door' value='TOD'/></Catalog>");
    let done = read_in(&world, MAIN, &[]);
    assert_eq!(done.faults(), [(269, "a.hsd".to_owned())]);
    let chain = "`a.hsd`, which includes `b.hsd`, which includes `a.hsd`";
    assert!(
        done.list[0].message.en().contains(chain),
        "{:?}",
        done.list[0]
    );
    assert_eq!(done.list[0].span().unwrap().file, FileId(2));
    assert_eq!(
        codes(rows(storeys(&done.document)[0])[0]),
        ["KSK", "GSI", "TOD"]
    );
}

#[test]
fn no_more_files_than_the_limit() {
    let mut world = Texts::default();
    let mut text = String::from("<Catalog>");
    for n in 0..300 {
        world = world.with(
            &format!("{n}.hsd"),
            "<Catalog><let name='a' value='1'/></Catalog>",
        );
        text += &format!("<include href='{n}.hsd'/>");
    }
    let done = read_in(&world, &(text + "</Catalog>"), &[]);
    assert_eq!(done.faults()[0], (903, "256.hsd".to_owned()));
    assert_eq!(done.list.len(), 300 - 256);
    assert_eq!(done.included.len(), 256);
}

#[test]
fn included_files_have_no_more_bytes_than_the_limit() {
    let file = |name: &str| format!("<Catalog><define name='{name}'>KSK</define></Catalog>");
    let mut world = Texts::default();
    for name in ["a", "b", "c"] {
        world = world.with(&format!("{name}.hsd"), file(name));
    }
    let text = "<House><include href='a.hsd'/><include href='b.hsd'/><include href='a.hsd'/>\
        <Storey><Row><use name='a'/></Row></Storey></House>";
    let source = Source::new(FileId(0), "test.hsd", text.as_bytes());
    let told = |bytes: usize| {
        let mut options = options(&[]);
        options.expand.limits.included_bytes = bytes;
        let mut out = Diagnostics::new();
        let read = driver::documents(&[&source], &world, &options, &mut out);
        let codes: Vec<u16> = out.into_sorted().iter().map(|d| d.code.0).collect();
        (read.included.len(), codes)
    };
    let one = file("a").len();
    assert_eq!(told(2 * one), (2, vec![]));
    assert_eq!(told(2 * one - 1), (1, vec![910]), "the second has no room");
}

#[test]
fn files_that_are_no_texts_are_told_of() {
    let world = Texts::default()
        .with("a.hsd", [0u8; 100])
        .with("b.hsd", "<Catalog><define name='b'>KSK")
        .with("c.hsd", "");
    let text = "<Catalog><include href='a.hsd'/><include href='b.hsd'/><include href='c.hsd'/>\
        <include href='http://x/y.hsd'/><include href='C:/y.hsd'/><include href='x\\y.hsd'/></Catalog>";
    let done = read_in(&world, text, &[]);
    let mut codes: Vec<u16> = done.list.iter().map(|d| d.code.0).collect();
    codes.sort_unstable();
    assert_eq!(codes, [5, 204, 204, 268, 268, 268, 270]);
}
