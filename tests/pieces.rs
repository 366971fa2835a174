//! Long files that are read in pieces give the same model and the same messages, at the same places, as in memory.

use hsd::backend::gltf::Writer;
use hsd::backend::images::Library;
use hsd::backend::spool::{NewSpool, in_memory};
use hsd::diagnostic::{Diagnostic, Diagnostics, Language};
use hsd::driver::{self, Feed, Options};
use hsd::parse::divide::{Undivided, divide};
use hsd::scene::{Detail, ScenePart};
use hsd::source::{FileId, LongFile, NoFiles, Source};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::Cursor;
use std::sync::Arc;

/// Returns a file as it is divided.
fn long(text: &str) -> Result<LongFile, Undivided> {
    let mut file = Cursor::new(text.as_bytes().to_vec());
    let size = text.len() as u64;
    let layout = divide(&mut file, size).expect("memory can be read")?;
    Ok(LongFile::new(
        FileId(0),
        "town.hsd",
        (Box::new(file), size),
        layout,
    ))
}

/// Returns the model of a feed, and the messages about it.
fn built(feed: Feed<'_>, threads: usize) -> (Vec<u8>, Vec<Diagnostic>) {
    let options = Options {
        detail: Detail::Body,
        ..Options::default()
    };
    let new: NewSpool<'_> = &in_memory;
    let mut writer = Writer::new(new).expect("memory takes every byte");
    let mut out = Diagnostics::new();
    let mut sink = |part: ScenePart<'_>, images: &Library| writer.add(part, images);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let town = pool
        .expect("threads start")
        .install(|| driver::stream(feed, &NoFiles, &options, &mut out, (&mut sink, new)));
    let town = town.expect("memory takes every byte");
    let glb = writer.glb(&town.materials, &town.library, &town.grown);
    (
        glb.expect("memory takes every byte").bytes(),
        out.into_sorted(),
    )
}

/// A town in the XML form with names, definitions and draws, and something wrong in some houses.
fn xml_town() -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<!-- a town -->\n<Houses>\n<Param name=\"h\" default=\"9\"/>\n\
         <define name=\"front\"><Row>KSK  KSK  <random><choice>KSK  </choice><choice>KKS  </choice></random>KSK  </Row></define>\n",
    );
    for n in 0..1_500 {
        let (x, y) = (n % 40 * 12, n / 40 * 12);
        let wrong = match n % 499 {
            7 => " colour=\"red\"",
            8 => " azimuth=\"north\"",
            _ => "",
        };
        let wall = ["KSK  KSK  KSK  KSK  ", "KSK  KKS  KSK  KSX  "][usize::from(n % 700 == 9)];
        write!(
            text,
            "<House x=\"{x}\" y=\"{y}\"{wrong}>\n  <Storey height=\"{{h + {}}}\">\n    <use name=\"front\"/>\n    \
             <Row>{wall}</Row>\n    <Row>{wall}</Row>\n    <Row>{wall}</Row>\n  </Storey>\n  \
             <Roofs shape=\"YOS\" pitch=\"4.{}\"/>\n</House>\n<!-- house {n}, 町家 -->\n",
            n % 7,
            n % 10
        )
        .expect("a string takes every character");
    }
    text + "</Houses>\n<!-- the end -->\n"
}

/// A town in the legacy form.
fn legacy_town() -> String {
    let mut text = String::from("# a town\n");
    for n in 0..5_000 {
        let (x, y) = (n % 70 * 9, n / 70 * 9);
        let wall = ["KSK  KSK  KSK  ", "KSK  KSX  KSK  "][usize::from(n % 900 == 9)];
        write!(
            text,
            "{x} {y} 180\n9.{}\n\n{wall}\n{wall}\n{wall}\n{wall}\n%\n",
            n % 10
        )
        .expect("a string takes every character");
    }
    text + "# nothing more\n"
}

#[test]
fn pieces_give_the_model_and_the_messages_of_the_whole() {
    for text in [xml_town(), legacy_town()] {
        let source = Source::new(FileId(0), "town.hsd", text.as_bytes());
        let (whole, found) = built(Feed::whole(&[&source]), 2);
        assert!((4..100).contains(&found.len()), "{}", found.len());
        let file = Arc::new(long(&text).expect("it can be divided"));
        assert!(file.pieces() > 1, "{}", file.pieces());
        let stub = file.stub().expect("memory can be read");
        let long = [file.clone()];
        let feed = Feed {
            sources: &[&stub],
            long: &long,
        };
        for threads in [1, 2, 7] {
            let (pieced, told) = built(feed, threads);
            assert!(whole == pieced, "another model on {threads} threads");
            assert!(
                found == told,
                "{threads}: {} and {} messages",
                found.len(),
                told.len()
            );
        }
        let checked = |feed: Feed<'_>| {
            let (options, mut out) = (Options::default(), Diagnostics::new());
            let checked = driver::inspect(feed, &NoFiles, &options, &mut out, &in_memory);
            (
                checked.expect("memory takes every byte").houses,
                out.into_sorted(),
            )
        };
        assert!(checked(Feed::whole(&[&source])) == checked(feed));
        // A report shows the same lines, and no others.
        let places = found.iter().filter_map(Diagnostic::span);
        let excerpt = file.excerpt(places.clone()).expect("memory can be read");
        assert!(excerpt.text().len() < text.len() / 4);
        for span in places {
            assert_eq!(excerpt.line_column(span), source.line_column(span));
            let written = |s: &Source| {
                s.text()[s.text_range(span)]
                    .lines()
                    .next()
                    .map(String::from)
            };
            assert_eq!(written(&excerpt), written(&source));
        }
    }
}

#[test]
fn houses_of_one_name_are_counted_through_the_whole_run() {
    let mut text = String::from("<Houses>\n");
    for n in 0..300 {
        let (x, y) = (n % 20 * 12, n / 20 * 12);
        let name = ["店", "蔵", ""][n % 3];
        writeln!(
            text,
            "<House name=\"{name}\" x=\"{x}\" y=\"{y}\"><Storey height=\"9\"><repeat num=\"4\"><Row>KSK  KSK  </Row></repeat></Storey></House>"
        )
        .expect("a string takes every character");
    }
    text += "</Houses>\n";
    let source = Source::new(FileId(0), "town.hsd", text.as_bytes());
    let (glb, _) = built(Feed::whole(&[&source]), 2);
    let size = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]);
    let model: serde_json::Value =
        serde_json::from_slice(&glb[20..20 + size as usize]).expect("the JSON of a model");
    let nodes = model["nodes"].as_array().expect("it has nodes");
    let ids: BTreeSet<_> = nodes
        .iter()
        .filter_map(|n| n["extras"]["id"].as_str())
        .collect();
    assert_eq!(ids.len(), 300);
    assert!(
        ids.contains("店") && ids.contains("店-100") && ids.contains("蔵-100"),
        "{ids:?}"
    );
}

#[test]
fn a_file_that_changes_while_it_is_read_is_named() {
    let text = xml_town();
    let file = Cursor::new(text.as_bytes().to_vec());
    let size = text.len() as u64;
    let layout = divide(&mut file.clone(), size).expect("memory can be read");
    let layout = layout.expect("it can be divided");
    let shorter = Cursor::new(text.as_bytes()[..text.len() / 2].to_vec());
    let file = LongFile::new(FileId(0), "町.hsd", (Box::new(shorter), size), layout);
    let error = file.piece(file.pieces() - 1).expect_err("its end is gone");
    assert!(
        error.to_string().starts_with("町.hsd was changed"),
        "{error}"
    );
}

#[test]
fn what_needs_all_houses_is_not_divided() {
    let town = xml_town();
    let with = |from: &str, to: &str| town.replacen(from, to, 1);
    let end = "</Houses>\n";
    let cases = [
        (
            with(
                end,
                "<View name=\"a\" from=\"0 0 1\" to=\"1 1 1\"/></Houses>\n",
            ),
            "`<View>`",
        ),
        (
            with(end, "<define name=\"late\"/></Houses>\n"),
            "`<define>`",
        ),
        (
            with("<Param", "<PartDef code=\"ABC\"/><Param"),
            "`<PartDef>`",
        ),
        (
            with("<use name=\"front\"/>", "<include href=\"a.hsd\"/>"),
            "`<include>`",
        ),
        (with("  </Storey>", ""), "in line 14"),
        (with("<Row>KSK", "<Row>＜KSK"), "in line 5"),
        (
            with(
                "<?xml version=\"1.0\"?>",
                "<?xml version=\"1.0\" encoding=\"EUC-JP\"?>",
            ),
            "UTF-8",
        ),
        (legacy_town().replacen("180\n", "180\r\n", 1), "line ends"),
        (legacy_town() + "<Houses/>\n", "`<Houses>`"),
        (legacy_town().replace('%', "#"), "no border"),
    ];
    for (text, reason) in cases {
        let why = long(&text).expect_err(reason).text();
        let why = why.in_language(Language::English).to_string();
        assert!(why.contains(reason), "{why} for {reason}");
    }
}

#[test]
fn a_town_in_districts_has_the_messages_of_one_in_memory() {
    let mut state = 7_u64;
    let mut draw = |most: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) % most
    };
    let mut text = String::new();
    // More houses than are kept in memory; here and there one stands in its neighbour or ends before it.
    for n in 0..18_000 {
        let (x, y) = (n % 150 * 9 + draw(6), n / 150 * 9 + draw(6));
        let (a, b) = (draw(4) as usize + 2, draw(4) as usize + 2);
        let [a, b] = [a, b].map(|units| "KSK  ".repeat(units));
        let walls = match n % 9 {
            0 => a,
            _ => format!("{a}\n{b}\n{a}\n{b}"),
        };
        write!(text, "{x}.{} {y} 180\n9\n\n{walls}\n%\n", draw(10)).expect("a string takes all");
    }
    let source = Source::new(FileId(0), "town.hsd", text.as_bytes());
    let of_grounds = |out: Diagnostics| {
        let counts = out
            .counts()
            .into_iter()
            .map(|((_, code, _), count)| (code.0, count));
        let counts: Vec<_> = counts
            .filter(|(code, _)| matches!(code, 420 | 437))
            .collect();
        let list = out.into_sorted().into_iter();
        let list: Vec<_> = list.filter(|d| matches!(d.code.0, 420 | 437)).collect();
        (counts, list)
    };
    let (options, mut whole) = (Options::default(), Diagnostics::new());
    let sources = [&source];
    let feed = Feed::whole(&sources);
    driver::check(&sources, &NoFiles, &options, &mut whole);
    let mut apart = Diagnostics::new();
    let mut sink = |_: ScenePart<'_>, _: &Library| Ok(());
    let body = Options {
        detail: Detail::Body,
        ..options
    };
    let run = driver::stream(feed, &NoFiles, &body, &mut apart, (&mut sink, &in_memory));
    run.expect("memory takes every byte");
    let (whole, apart) = (of_grounds(whole), of_grounds(apart));
    assert!(
        whole.0.len() == 2 && whole.0.iter().all(|(_, count)| *count > 50),
        "{:?}",
        whole.0
    );
    assert_eq!(whole, apart);
}
