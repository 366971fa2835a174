//! How the time that an editor waits grows with the text. The times themselves: `cargo bench --bench ide`.

use crate::ide::analysis;
use crate::support::cpu::assert_linear;
use hsd::diagnostic::Language;
use hsd::ide::{
    Analysis, complete, folding, format, hover, inlay, names, selection, symbols, tokens,
};

/// A street of houses of 20 lines in the legacy form.
fn legacy(lines: usize) -> String {
    let house = "# 町家\n0 0 180\n9 8\nname 町家\n\nGSI  GSI  GDE 2TOD  KKS\nAPW  APW  APW\nKTU  TSH 2TSH 2KTU\n\
                 APW  APW  APW  ^\nKSK  MMU 2MMU 2KSK\nAPW  APW  APW\nKTU  MMU 2MMU 2KTU\nAPW  APW  APW\n\n\
                 K X * KIR 0 0 6 3 P4.0\n\n\n\n%\n";
    house.repeat(lines / 20)
}

/// The same in XML with names in it.
fn xml(lines: usize) -> String {
    let house = "<House name=\"町家\">\n<let name=\"幅\" value=\"6\"/>\n<define name=\"側\" n=\"3\">\n\
                 <Row><repeat num=\"{n}\">APW</repeat></Row>\n</define>\n<Storey height=\"9\">\n\
                 <Row>GSI  GSI  GDE 2TOD  KKS</Row>\n<use name=\"側\"/>\n<Row><repeat num=\"{幅}\">KTU</repeat></Row>\n\
                 <use name=\"側\"/>\n</Storey>\n<Storey height=\"{幅 + 2}\">\n<Row>KSK  MMU 2MMU 2KSK</Row>\n\
                 <use name=\"側\"/>\n<Row>KTU  MMU 2MMU 2KTU</Row>\n<use name=\"側\" n=\"3\"/>\n</Storey>\n\n\
                 <!-- 次 -->\n</House>\n";
    format!("<Houses>\n{}</Houses>\n", house.repeat(lines / 20))
}

type Ask = (&'static str, Box<dyn Fn(&Analysis)>);

fn asks(text: &str) -> Vec<Ask> {
    let codes: Vec<usize> = text.match_indices("KTU").map(|(i, _)| i).collect();
    let at = codes[codes.len() / 2];
    let named = text.rfind("側").or(text.rfind("MMU")).unwrap();
    let braces = text.rfind("{幅").map_or(at, |i| i + 1);
    let all = text.len();
    vec![
        ("tokens", Box::new(|a| drop(tokens::tokens(a)))),
        ("folds", Box::new(|a| drop(folding::folds(a)))),
        ("symbols", Box::new(|a| drop(symbols::symbols(a)))),
        (
            "hints",
            Box::new(move |a| drop(inlay::inlays(a, 0..all, Language::English))),
        ),
        (
            "selection",
            Box::new(move |a| drop(selection::selection(a, at))),
        ),
        (
            "highlights",
            Box::new(move |a| drop(names::highlights(a, at))),
        ),
        (
            "references",
            Box::new(move |a| drop(names::references(a, named, true))),
        ),
        (
            "definition",
            Box::new(move |a| drop(names::definition(a, named))),
        ),
        (
            "complete",
            Box::new(move |a| drop(complete::complete(a, at + 1, &|_| vec![]))),
        ),
        (
            "names",
            Box::new(move |a| drop(complete::complete(a, braces, &|_| vec![]))),
        ),
        (
            "hover",
            Box::new(move |a| drop(hover::hover(a, at + 1, Language::English, true))),
        ),
        ("layout", Box::new(|a| drop(format::format(a)))),
    ]
}

#[test]
fn answers_take_linear_time() {
    for (form, text) in [("legacy", legacy as fn(usize) -> String), ("XML", xml)] {
        let make = |lines| {
            let text = text(lines);
            let a = analysis("a.hsd", &text, &[]);
            a.outline();
            (a, asks(&text))
        };
        assert_linear(&format!("{form}: analysis"), 500, text, |text| {
            analysis("a.hsd", text, &[]).outline();
        });
        for (k, (name, _)) in asks(&text(20)).iter().enumerate() {
            let ask = |(a, asks): &(Analysis, Vec<Ask>)| asks[k].1(a);
            assert_linear(&format!("{form}: {name}"), 500, make, ask);
        }
    }
}

#[test]
fn every_part_has_a_page_with_its_image() {
    let a = analysis("a.hsd", "0 0 180\n9\n\nGSI  KSK\n", &[]);
    for part in hsd::parse::builtin().parts() {
        if part.code().trim().is_empty() {
            continue; // a void has nothing to show
        }
        let code = part.code().to_owned();
        let key = complete::PartKey { code: code.clone() };
        let page = complete::documentation(&a, &key, Language::English, true);
        let page = page.unwrap_or_else(|| panic!("{code} has no page"));
        assert!(page.contains("data:image/"), "{code}: {page}");
    }
}
