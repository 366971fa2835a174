//! Whatever stands in a text, nothing panics and every range lies in it.

use crate::ide::analysis;
use crate::support;
use hsd::diagnostic::Language;
use hsd::ide::Analysis;
use hsd::ide::{folding, format, inlay, names, selection, symbols, tokens};
use std::ops::Range;

fn holds(a: &Analysis, range: &Range<usize>) {
    assert!(
        a.text().get(range.clone()).is_some(),
        "{range:?} of {:?}",
        a.text()
    );
}

fn tree(a: &Analysis, list: &[symbols::Symbol]) {
    for symbol in list {
        holds(a, &symbol.range);
        holds(a, &symbol.selection);
        tree(a, &symbol.children);
    }
}

/// Everything that is asked of a text, and of some places in it.
fn ask(a: &Analysis, places: &[usize]) {
    let length = a.text().len();
    let mut end = 0;
    for token in tokens::tokens(a) {
        holds(a, &token.range);
        assert!(end <= token.range.start && !token.range.is_empty());
        assert!(!a.text()[token.range.clone()].contains('\n'));
        end = token.range.end;
    }
    folding::folds(a).iter().for_each(|f| holds(a, &f.range));
    tree(a, &symbols::symbols(a));
    for language in [Language::English, Language::Japanese] {
        for hint in inlay::inlays(a, 0..length, language) {
            holds(a, &(hint.at..hint.at));
        }
    }
    for edit in format::format(a).into_iter().flatten() {
        holds(a, &edit.range);
    }
    for &at in places {
        selection::selection(a, at).iter().for_each(|r| holds(a, r));
        names::highlights(a, at)
            .iter()
            .for_each(|(r, _)| holds(a, r));
        for place in names::definition(a, at)
            .iter()
            .chain(&names::references(a, at, true))
        {
            let text = a.file(place.file).unwrap().text();
            assert!(text.get(place.range.clone()).is_some());
        }
        if let Some(symbol) = names::symbol_at(a, at) {
            names::uses_of(a, &symbol);
        }
        if let Some((range, _)) = names::prepare_rename(a, at) {
            holds(a, &range);
            let _ = names::rename(a, at, "新しい名");
            let _ = names::rename(a, at, "ZZ  2");
        }
    }
}

/// Some places of a text, its end and one behind it included.
fn places(text: &str, step: usize) -> Vec<usize> {
    let all = text.char_indices().map(|(i, _)| i);
    let mut places: Vec<usize> = all.step_by(step.max(1)).collect();
    places.extend([text.len(), text.len() + 7]);
    places
}

#[test]
fn cut_texts_are_borne() {
    for folder in ["examples", "library", "tests/corpus"] {
        let step = if support::thorough() { 1 } else { 2 };
        for path in support::texts_in_turn(folder, 1).iter().step_by(step) {
            let bytes = std::fs::read(path).unwrap();
            let text = String::from_utf8_lossy(&bytes);
            let cuts: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
            for cut in cuts.iter().skip(cuts.len() / 9).step_by(cuts.len() / 4 + 1) {
                let cut = &text[..*cut];
                let a = analysis("a.hsd", cut, &[]);
                ask(&a, &places(cut, cut.len() / 5 + 1));
            }
        }
    }
}

#[test]
fn strange_texts_are_borne() {
    let texts = [
        "",
        "\u{feff}",
        "<",
        "<House",
        "<House name=",
        "<House name=\"",
        "<House name=\"{",
        "<House name=\"{'",
        "<use name='{'/><define name='' =''/>",
        "<House><let name='&lt;' value='{&lt;'/><Row>{&#x5bb6;}&amp;KSK</Row>",
        "＜House＞<Row>ＫＳＫ　</Row>",
        "<House><include href=''/><include href='..'/><include href='a.hsd'/></House>",
        "<a><b></a></b><House></Hause></House>",
        "<Facade id='k'><Floor id='t'/><random code='f f f,ff,fff,fkfkf'/></Facade>",
        "<define name='p'><use name='p' p='{p}'/></define><use name='{p}{q}'/>",
        "0 0 180\r9\r\rKSK  KSK\r%\r%\r\r",
        "家\n%\n\u{3000}\nＫＳＫ  Ｌ\n<House><Row>KSK",
        "# 家\n0 0 180\n9\n\nKSK\tKSK  家  L\n^\n^\n",
        "K X * KIR\nK\n* * *\n",
        "<!-- <!-- --> --><!--",
        "<House><PartDef code='KSK' base='KSK'/><PartDef code='' base=''/><Row>KSK</Row></House>",
    ];
    for text in texts {
        let a = analysis("a.hsd", text, &[("catalog.hsd", text), ("b.hsd", text)]);
        ask(&a, &places(text, 1));
    }
}
