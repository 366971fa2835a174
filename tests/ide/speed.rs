//! How long an editor waits: with `--nocapture` the times are printed.

use crate::ide::analysis;
use hsd::diagnostic::Language;
use hsd::ide::{
    Analysis, complete, folding, format, hover, inlay, names, selection, symbols, tokens,
};
use std::time::{Duration, Instant};

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

/// The shortest time of some runs of a thing that is worked out anew each time.
fn timed(text: &str, ask: &dyn Fn(&Analysis)) -> Duration {
    let runs = (0..3).map(|_| {
        let a = analysis("a.hsd", text, &[]);
        a.outline();
        let start = Instant::now();
        ask(&a);
        start.elapsed()
    });
    runs.min().unwrap()
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
#[ignore = "measures time, which needs the machine for itself"]
#[allow(clippy::print_stdout)] // for those who look at the times
fn answers_come_within_a_blink() {
    for (form, text) in [("legacy", legacy as fn(usize) -> String), ("xml", xml)] {
        for lines in [2_000, 20_000] {
            let text = text(lines);
            let start = Instant::now();
            let a = analysis("a.hsd", &text, &[]);
            println!("{form:>6} {lines:>6} analysis   {:?}", start.elapsed());
            let start = Instant::now();
            a.outline();
            println!("{form:>6} {lines:>6} outline    {:?}", start.elapsed());
            for (name, ask) in asks(&text) {
                let time = timed(&text, &ask);
                println!("{form:>6} {lines:>6} {name:<10} {time:?}");
                // Ten times what is asked of a release build: other work may go on beside this.
                let most = Duration::from_millis(lines as u64 / 100);
                let layout = name == "layout"; // it reads the text twice
                assert!(layout || time < most, "{form} {lines} {name}: {time:?}");
            }
        }
    }
}

#[test]
#[ignore = "measures time, which needs the machine for itself"]
#[allow(clippy::print_stdout)] // for those who look at the times
fn pictures_of_parts_come_within_a_blink() {
    let a = analysis("a.hsd", "0 0 180\n9\n\nGSI  KSK\n", &[]);
    let (mut all, mut worst) = (Duration::ZERO, (Duration::ZERO, String::new()));
    let parts = hsd::parse::builtin().parts();
    for part in parts {
        let code = part.code().to_owned();
        let start = Instant::now();
        let key = complete::PartKey { code: code.clone() };
        assert!(complete::documentation(&a, &key, Language::English, true).is_some());
        let time = start.elapsed();
        all += time;
        worst = worst.max((time, code));
    }
    let each = all / parts.len() as u32;
    println!("pictures: {each:?} each, at most {worst:?}");
}
