//! What is told of the place at the cursor.

use crate::ide::marked;
use hsd::diagnostic::Language;
use hsd::ide::hover::{Hover, hover};

fn told_among(files: &[(&str, &str)], language: Language) -> (String, String) {
    let (a, at) = marked(files);
    let Some(Hover { range, markdown }) = hover(&a, at, language, false) else {
        return (String::new(), String::new());
    };
    assert!(
        range.start <= at && at <= range.end,
        "{range:?} without {at}"
    );
    (a.text()[range].to_owned(), markdown)
}

/// What is told, and of what.
fn told(text: &str) -> (String, String) {
    told_among(&[("家.hsd", text)], Language::English)
}

#[track_caller]
fn says(text: &str, of: &str, words: &[&str]) {
    let (range, markdown) = told(text);
    assert_eq!(range, of, "{markdown}");
    for word in words {
        assert!(markdown.contains(word), "no {word:?} in {markdown}");
    }
}

const HOUSE: &str = "0 0 180\n9.0 7.5\nunit 3.25\n\nKKS  TKD 2KKS\nAPW  APW\nKTU  KTU  KTU  KTU\nAPW  APW  ^\nKSK  KSK  KSK  KSK\nAPW  APW\nKSK  KSK  KSK  KSK\nAPW  APW\n\nK X * KIR 0 0 4 2 P4.0 M3\n";

fn house(from: &str, to: &str) -> String {
    assert!(HOUSE.contains(from), "{from}");
    HOUSE.replacen(from, to, 1)
}

#[test]
fn codes_have_cards() {
    says(
        &house("TKD 2", "TK‸D 2"),
        "TKD 2",
        &[
            "格子戸引違い",
            "*kōshi-do*",
            "width 2 U = 6.5 shaku = 1.97 m",
            "0 to 5.8 shaku",
            "Edo",
            "hsd parts T",
        ],
    );
    let (a, at) = marked(&[("家.hsd", &house("TKD 2", "T‸KD 2"))]);
    let card = hover(&a, at, Language::Japanese, true).unwrap().markdown;
    assert!(
        card.contains("](data:image/jpeg;base64,") && card.contains("時代: 江戸"),
        "{card}"
    );
}

#[test]
fn wall_lines_tell_their_length_and_place() {
    says(
        &house("KKS  TKD 2", "KKS ‸ TKD 2"),
        "KKS  TKD 2KKS",
        &[
            "front wall",
            "4 U = 13 shaku = 3.94 m",
            "from (0, 0) to (4, 0)",
            "3 parts",
            "storey 9 shaku high",
        ],
    );
    says(
        &house("APW  ^", "APW  ‸^"),
        "^",
        &["the storey ends", "right wall", "2 U = 6.5 shaku"],
    );
}

#[test]
fn headers_and_roof_lines_are_explained() {
    says(&house("180", "18‸0"), "180", &["front looks"]);
    says(
        &house("7.5", "7‸.5"),
        "7.5",
        &["height of storey 2", "2.27 m", "16.5 shaku"],
    );
    says(&house("unit", "un‸it"), "unit", &["Kyo-ma"]);
    says(
        &house("KIR", "K‸IR"),
        "KIR",
        &["gable", "pitch 4 sun", "m²"],
    );
    says(&house("X *", "‸X *"), "X", &["ridge along the first line"]);
    says(&house("M3", "M‸3"), "M3", &["courses of ridge tiles"]);
    says(&house(" 2 P4", " 2‸ P4"), "2", &["b1", "back"]);
}

const XML: &str = "<House name=\"家\">\n<Param name=\"間口\" default=\"4\" min=\"2\" max=\"9\" doc=\"width\"/>\n\
    <define name=\"表\" n=\"\" code=\"GSI\"><repeat num=\"{n}\"><Part code=\"{code}\"/></repeat></define>\n\
    <Storey height=\"9\">\n<Row><use name=\"表\" n=\"{間口 - 1}\"/>TOD</Row>\n<Row>APW  APW</Row>\n\
    <Row><repeat num=\"{間口}\">KTU</repeat></Row>\n<Row>APW  APW</Row>\n</Storey>\n<Roofs shape=\"YOS\"/></House>";

fn xml(from: &str, to: &str) -> String {
    assert!(XML.contains(from), "{from}");
    XML.replacen(from, to, 1)
}

#[test]
fn expressions_tell_what_they_came_to() {
    says(&xml("- 1}", "‸- 1}"), "{間口 - 1}", &["`間口 - 1` = `3`"]);
    says(
        &xml("{間口 -", "{間‸口 -"),
        "間口",
        &["`間口` = `4`", "Param", "width", "2..9"],
    );
    says(
        &xml("num=\"{n}", "num=\"{‸n}"),
        "n",
        &["`n` = `3`", "parameter of `表`"],
    );
    says(
        &xml("Param name=\"間口", "Param name=\"間‸口"),
        "間口",
        &["`間口` = `4`"],
    );
    says(
        "<House><Storey><Row><repeat num=\"{‸k + 1}\">KKS</repeat></Row></Storey></House>",
        "k",
        &["k = `1`"],
    );
    let broken = xml("</House>", "").replace("</Storey>", "");
    says(
        &broken.replacen("- 1}", "‸- 1}", 1),
        "{間口 - 1}",
        &["= `3`"],
    );
}

#[test]
fn pieces_and_files_tell_what_they_are() {
    says(
        &xml("use name=\"表", "use name=\"‸表"),
        "表",
        &["piece **表**", "`n`", "must be given", "GSI unless given"],
    );
    let lib = "<Catalog><let name=\"奥行\" value=\"3\"/><define name=\"横\"/></Catalog>";
    let text = "<House><include href=\"lib‸.hsd\"/></House>";
    let (range, words) = told_among(&[("家.hsd", text), ("lib.hsd", lib)], Language::English);
    assert_eq!(range, "lib.hsd");
    assert!(
        words.contains("let `奥行`") && words.contains("define `横`"),
        "{words}"
    );
}

#[test]
fn elements_attributes_and_words_are_explained() {
    says(
        &xml("<Storey", "<Sto‸rey"),
        "Storey",
        &["a storey", "perimeter 12 U", "6.6 m²", "2 tsubo"],
    );
    says(&xml("<House", "<‸House"), "House", &["1 storeys", "roofs"]);
    says(&xml("<Roofs", "<Roo‸fs"), "Roofs", &["`YOS` hip", "m²"]);
    says(
        &xml("<Row>APW", "<R‸ow>APW"),
        "Row",
        &["a wall line", "left wall", "2 U"],
    );
    says(
        &xml("height=\"9", "hei‸ght=\"9"),
        "height",
        &["shaku", "`9` without"],
    );
    says(&xml("YOS", "Y‸OS"), "YOS", &["hip (yosemune)"]);
    says(&xml("APW  APW", "AP‸W  APW"), "APW  ", &["界壁"]);
    let (_, words) = told_among(&[("家.hsd", &xml("YOS", "Y‸OS"))], Language::Japanese);
    assert!(words.contains("寄棟"), "{words}");
}

#[test]
fn every_place_of_every_example_can_be_asked() {
    let mut told = 0;
    for name in ["machiya", "param-machiya", "kanban", "tea-shop", "tower"] {
        let text = std::fs::read_to_string(format!("examples/{name}.hsd")).unwrap();
        let (a, _) = marked(&[("家.hsd", &text)]);
        for (at, _) in text.char_indices() {
            for language in [Language::English, Language::Japanese] {
                if let Some(h) = hover(&a, at, language, false) {
                    assert!(h.range.start <= at && at <= h.range.end && h.range.end <= text.len());
                    assert!(!h.markdown.is_empty());
                    told += 1;
                }
            }
        }
    }
    assert!(told > 5_000, "{told}");
}

#[test]
fn cards_speak_in_the_language_of_the_reader_and_in_numbers_of_the_text() {
    let (a, at) = marked(&[("家.hsd", &house("KKS  ", "G‸SI  "))]);
    let card = hover(&a, at, Language::Japanese, false).unwrap().markdown;
    assert!(card.contains("材料: 杉、弁柄塗"), "{card}");
    let pitched = house("P4.0", "P3‸.5 E2.5");
    says(&pitched, "P3.5", &["pitch of 3.5 sun: rises 3.5 in 10"]);
    let wide = house("P4.0", "P3.5 E‸2.5");
    says(&wide, "E2.5", &["overhang at the eaves", "2.5 = 0.76 m"]);
}

#[test]
fn cards_name_files_without_their_folders() {
    let text = "<House><include href=\"lib/parts.hsd\"/><Storey height=\"9\"><Row>GX‸X</Row></Storey></House>";
    let parts = "<Catalog><PartDef code=\"GXX  \" base=\"GSI\" ja=\"自作格子\"/></Catalog>";
    let files = [("家.hsd", text), ("lib/parts.hsd", parts)];
    let (_, card) = told_among(&files, Language::English);
    assert!(card.contains("own part (parts.hsd, line 1)"), "{card}");
    let named = "<House><Param name=\"w\" default=\"2\"/><Storey height=\"{w‸}\"/></House>";
    let (_, card) = told_among(&[("/home/花子/家.hsd", named)], Language::English);
    assert!(card.contains("`Param` (line 1)"), "{card}");
}

#[test]
fn an_open_facade_has_no_area() {
    let text = "<House><Storey‸ height=\"9\"><Row>GSI  GSI</Row></Storey></House>";
    let (_, card) = told(text);
    assert!(
        card.contains("perimeter 2 U") && !card.contains("area"),
        "{card}"
    );
    let bounds = "<House><Storey hei‸ght=\"9\"/></House>";
    says(bounds, "height", &["from 0.001 to 100000"]);
}
