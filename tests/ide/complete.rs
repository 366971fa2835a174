//! What may stand at the cursor, and what the text is after it was taken.

use crate::ide::{analysis, marked};
use crate::support::Words;
use hsd::diagnostic::{Language, Severity};
use hsd::ide::Analysis;
use hsd::ide::complete::{Completion, CompletionKind, PartKey, complete, documentation};

/// A text, the files beside it, and what may stand at its mark.
struct Asked {
    a: Analysis,
    beside: Vec<(String, String)>,
    found: Vec<Completion>,
}

fn ask(text: &str) -> Asked {
    ask_among(&[("家.hsd", text)])
}

fn ask_among(files: &[(&str, &str)]) -> Asked {
    let (a, at) = marked(files);
    let names = |ending: &str| match ending {
        "hsd" => vec!["lib/表.hsd".to_owned(), "家.hsd".to_owned()],
        "png" => vec!["textures/noren.png".to_owned()],
        _ => vec![],
    };
    let found = complete(&a, at, &names);
    for c in &found {
        assert!(c.replace.start <= at && at <= c.replace.end, "{c:?}");
        assert!(!a.text()[c.replace.clone()].contains('\n'), "{c:?}");
        // A client compares what stands before the cursor with the filter.
        let typed = a.text()[c.replace.start..at].trim().to_lowercase();
        let mut letters = c.filter.to_lowercase();
        for letter in typed.chars() {
            let at = letters.find(letter);
            let at = at.unwrap_or_else(|| panic!("{typed} is not in {}", c.filter));
            letters.drain(..at + letter.len_utf8());
        }
    }
    let beside = files[1..].iter();
    let beside = beside.map(|(n, t)| ((*n).to_owned(), (*t).to_owned()));
    Asked {
        a,
        beside: beside.collect(),
        found,
    }
}

impl Asked {
    fn labels(&self) -> Vec<&str> {
        self.found.iter().map(|c| c.label.as_str()).collect()
    }

    fn has(&self, label: &str) -> bool {
        self.labels().contains(&label)
    }

    fn find(&self, label: &str) -> &Completion {
        let found = self.found.iter().find(|c| c.label == label);
        found.unwrap_or_else(|| panic!("no {label} among {:?}", self.labels()))
    }

    /// The text with a proposal in it.
    fn take(&self, label: &str) -> String {
        let c = self.find(label);
        let mut text = self.a.text().to_owned();
        text.replace_range(c.replace.clone(), &c.insert);
        text
    }

    /// The same, of which the compiler has nothing to say.
    fn clean(&self, label: &str) -> String {
        let text = self.take(label);
        assert_eq!(faults(&text, &self.beside), Vec::<String>::new(), "{text}");
        text
    }

    /// The line of the text that a proposal is in, then.
    fn line(&self, label: &str) -> String {
        let text = self.take(label);
        let number = text[..self.find(label).replace.start].matches('\n').count();
        text.lines().nth(number).unwrap_or_default().to_owned()
    }
}

/// What is said of a text beyond notes.
fn faults(text: &str, beside: &[(String, String)]) -> Vec<String> {
    let beside: Vec<(&str, &str)> = beside.iter().map(|(n, t)| (&**n, &**t)).collect();
    let a = analysis("家.hsd", text, &beside);
    let serious = a
        .diagnostics
        .iter()
        .filter(|d| d.severity != Severity::Note);
    serious
        .map(|d| format!("{}: {}", d.code, d.message.en()))
        .collect()
}

/// A house whose first line is this, closed by lines of two units.
fn wall(line: &str) -> Asked {
    ask(&format!(
        "0 0 180\n9.0\nname 家\n\n{line}\nAPW  APW\nKTU  KTU\nAPW  APW\n"
    ))
}

#[test]
fn codes_come_by_code_by_japanese_name_by_reading_and_in_english() {
    let asked = wall("KKS  GS‸");
    let mut labels = asked.labels();
    labels.sort_unstable();
    assert_eq!(labels, ["GSA", "GSB", "GSI", "GSU"]);
    for typed in ["格子", "koshi", "kōshi", "koushi", "lat"] {
        let asked = wall(&format!("KKS  {typed}‸"));
        for code in ["GSI", "GSB", "GIT", "GDE 2", "TKD"] {
            assert!(asked.find(code).filter.starts_with(typed), "{typed}");
        }
        assert!(!asked.has("KSK"), "{typed}: {:?}", asked.labels());
        assert_eq!(asked.line("GSI"), "KKS  GSI  ");
        asked.clean("GSI");
    }
    for typed in ["大戸", "odo", "ōdo", "Odo", "great"] {
        let asked = wall(&format!("KKS  {typed}‸"));
        assert_eq!(asked.line("TOD"), "KKS  TOD  ", "{typed}");
        assert_eq!(asked.found[0].label, "TOD", "{typed}");
        asked.clean("TOD");
    }
}

#[test]
fn codes_come_by_kana_and_in_full_width_letters() {
    for (typed, code) in [
        ("こうしど", "TKD"),
        ("おおど", "TOD"),
        ("ムシコ", "MMU"),
        ("しっくい", "KSK"),
        ("ＫＫＳ", "KKS"),
        ("ｋｋｓ", "KKS"),
    ] {
        let asked = wall(&format!("KKS  {typed}‸"));
        let best = asked.found.iter().min_by_key(|c| &c.sort);
        assert_eq!(best.map(|c| &*c.label), Some(code), "{typed}");
        assert!(asked.find(code).filter.starts_with(typed), "{typed}");
        assert_eq!(asked.line(code), format!("KKS  {code}  "), "{typed}");
        asked.clean(code);
    }
    let lattices = wall("こうし‸");
    assert!(lattices.has("GSI") && lattices.has("TKD") && !lattices.has("KSK"));
}

#[test]
fn codes_behind_keep_their_columns() {
    assert_eq!(wall("KKS  ‸").line("GSI"), "KKS  GSI  ");
    assert_eq!(wall("G‸X   KKS").line("GSI"), "GSI  KKS");
    assert_eq!(wall("‸GDE 2").line("KKS"), "KKS  GDE 2");
    assert_eq!(wall("G‸GDE 2").line("GSI"), "GSI  GDE 2");
    assert_eq!(wall("格子‸KKS").line("GSI"), "GSI  KKS");
    assert_eq!(wall("KKS ko‸").line("GSI"), "KKS  GSI  ");
    assert_eq!(wall("KKSko‸").line("GSI"), "KKS  GSI  ");
    assert_eq!(wall("GDE‸").line("GDE 2"), "GDE 2");
    let cut = ask("0 0 180\n9\n\nKKS  KKS  ^\nKKS  kos‸");
    assert!(cut.take("GSI").ends_with("KKS  GSI  "));
}

#[test]
fn what_stands_in_the_text_and_own_parts_come_first() {
    let asked = wall("K‸    APW");
    assert_eq!(asked.found[0].label, "KTU");
    let own = "<Catalog><PartDef code=\"GXX  \" base=\"GSI\" ja=\"自作格子\"/></Catalog>";
    let text = "0 0 180\n9.0\n\nKKS  格‸\nAPW  APW\nKTU  KTU\nAPW  APW\n";
    let asked = ask_among(&[("家.hsd", text), ("catalog.hsd", own)]);
    assert_eq!(asked.found[0].label, "GXX");
    assert_eq!(asked.found[0].kind, CompletionKind::OwnPart);
    assert!(asked.clean("GXX").contains("KKS  GXX  \n"));
}

#[test]
fn parts_have_cards_with_pictures_when_one_is_chosen() {
    let asked = wall("KKS  格子‸");
    let key = asked.find("GSI").part.clone().unwrap();
    let card = documentation(&asked.a, &key, Language::English, true).unwrap();
    assert!(
        card.contains("仕舞屋格子") && card.contains("shimotaya-gōshi"),
        "{card}"
    );
    assert!(card.contains("width 1 U = 3 shaku = 0.91 m"), "{card}");
    assert!(card.contains("(data:image/jpeg;base64,/9j/"), "{card}");
    for part in asked.a.catalog().parts() {
        let key = PartKey {
            code: part.code().to_owned(),
        };
        let card = documentation(&asked.a, &key, Language::Japanese, true).unwrap();
        assert!(card.len() < 13_000, "{}: {}", part.code(), card.len());
        let made = card.lines().find_map(|l| l.strip_prefix("- 材料: "));
        let english = made.is_some_and(|m| m.contains(|c: char| c.is_ascii_alphabetic()));
        assert!(!english, "{}: {made:?}", part.code());
        assert_eq!(
            card.contains("data:image"),
            part.class() != ' ',
            "{}",
            part.code()
        );
    }
    let plain = documentation(&asked.a, &key, Language::Japanese, false).unwrap();
    assert!(
        plain.contains("幅 1 U = 3 尺") && !plain.contains("data:"),
        "{plain}"
    );
}

#[test]
fn wall_lines_end_with_turns() {
    let asked = wall("KKS  KKS  ‸");
    assert_eq!(asked.line("L"), "KKS  KKS  L");
    assert_eq!(asked.line("^"), "KKS  KKS  ^");
    assert!(!wall("KKS  ‸KKS").has("L"));
    assert!(!wall("KKS  K‸").has("L"));
}

#[test]
fn the_header_has_keys_and_they_have_values() {
    let asked = ask("0 0 180\n9.0\nst‸\n\nKKS\n");
    assert_eq!(asked.labels(), ["street"]);
    assert!(
        asked
            .find("street")
            .snippet
            .as_deref()
            .unwrap()
            .contains("yes,no")
    );
    let asked = ask("0 0 180\n9.0\nname 家\n‸\n\nKKS\n");
    assert!(
        asked.has("seed") && !asked.has("name"),
        "{:?}",
        asked.labels()
    );
    assert_eq!(ask("0 0 180\n9.0\nunit ‸\n").line("3.25"), "unit 3.25");
    assert_eq!(ask("0 0 180\n9.0\nmethod k‸\n").line("kd"), "method kd");
    assert_eq!(ask("‸").found[0].label, "0 0 180");
    assert_eq!(ask("0 0 180\n‸").found[0].label, "9.0 7.5");
}

#[test]
fn roof_lines_have_words_in_their_order() {
    let house = "0 0 180\n9.0\n\nKKS  KKS\nAPW  APW\nKTU  KTU\nAPW  APW\n\n";
    let roof = |line: &str| ask(&format!("{house}{line}\n"));
    assert!(roof("‸").has("K") && roof("瓦‸").has("K"));
    assert_eq!(roof("K ‸").labels()[..2], ["X", "Y"]);
    assert!(!roof("K ‸ 9 HIS").has("X"));
    let heights = roof("K X ‸");
    assert!(
        heights.has("*") && heights.has("9.0"),
        "{:?}",
        heights.labels()
    );
    assert_eq!(roof("K X * kiri‸").line("KIR"), "K X * KIR");
    assert_eq!(roof("K X * 切妻‸").line("KIR"), "K X * KIR");
    let clean = roof("K X * KIR ‸").clean("0 0 2 2");
    assert!(clean.contains("K X * KIR 0 0 2 2"));
    let options = roof("K X * KIR 0 0 2 2 P4.0 ‸");
    assert!(options.has("E") && !options.has("P") && !options.has("C"));
    options.clean("E");
}

/// A house in the XML form with this in its first row.
fn row(inner: &str) -> Asked {
    ask(&format!(
        "<House name=\"家\"><Storey height=\"9\">\n  <Row>{inner}</Row>\n  <Row>APW  APW</Row>\n  <Row>KTU  KTU</Row>\n  <Row>APW  APW</Row>\n</Storey></House>\n"
    ))
}

#[test]
fn rows_of_the_xml_form_have_codes() {
    for typed in ["GS", "格子", "koshi"] {
        let asked = row(&format!("KKS  {typed}‸"));
        assert_eq!(asked.line("GSI"), "  <Row>KKS  GSI  </Row>");
        asked.clean("GSI");
    }
    assert_eq!(row("\n    格子‸\n    KKS").line("GSI"), "    GSI  ");
    row("\n    格子‸\n    KKS").clean("GSI");
    let asked = row("KKS  <Part code=\"大戸‸\"/>");
    assert_eq!(asked.line("TOD"), "  <Row>KKS  <Part code=\"TOD\"/></Row>");
    asked.clean("TOD");
    let asked = row("KKS  <random code=\"TSH, ko‸\"/>");
    assert_eq!(
        asked.line("TKD"),
        "  <Row>KKS  <random code=\"TSH, TKD\"/></Row>"
    );
    asked.clean("TKD");
}

#[test]
fn elements_stand_where_they_may() {
    let asked = ask("<House>\n  <‸\n</House>");
    assert!(asked.has("Storey") && asked.has("Param") && asked.has("let"));
    assert!(
        !asked.has("Row") && !asked.has("else"),
        "{:?}",
        asked.labels()
    );
    assert_eq!(asked.line("Storey"), "  <Storey></Storey>");
    assert_eq!(asked.find("</House>").insert, "</House>");
    let asked = ask("<House><Storey><repeat num=\"2\"><‸");
    assert!(
        asked.has("Row") && !asked.has("Posts"),
        "{:?}",
        asked.labels()
    );
    let asked = ask("<House><Storey><if test=\"yes\"><Row/></if><‸</Storey></House>");
    assert_eq!(asked.found[0].label, "</Storey>");
    assert!(asked.has("else") && asked.has("Veranda"));
    let asked = ask("<House><random><‸</random></House>");
    assert_eq!(asked.labels(), ["</random>", "choice"]);
    let asked = ask("<House><Storey><random><choice><‸");
    assert!(
        asked.has("Row") && !asked.has("choice"),
        "{:?}",
        asked.labels()
    );
    assert!(ask("<‸").has("House") && ask("<‸").has("Catalog"));
    assert_eq!(
        ask("<House><Storey><Row>KKS  </‸").line("</Row>"),
        "<House><Storey><Row>KKS  </Row>"
    );
    assert_eq!(
        ask("<House><Sto‸ height=\"9\"></House>").line("Storey"),
        "<House><Storey height=\"9\"></House>"
    );
    let asked = ask("<Catalog><PartDef code=\"GXX  \" width=\"1\"><‸</PartDef></Catalog>");
    assert!(asked.has("bars") && asked.has("change") && !asked.has("Row"));
    asked.clean("wall");
    let repeated = row("KKS  <‸").take("repeat");
    assert!(
        repeated.contains("KKS  <repeat num=\"2\"></repeat></Row>"),
        "{repeated}"
    );
}

#[test]
fn attributes_come_with_what_they_may_say() {
    let asked = ask("<House><Roofs kind=\"K\" ‸/></House>");
    assert!(asked.has("pitch") && !asked.has("kind"));
    assert!(
        asked
            .find("mode")
            .snippet
            .as_deref()
            .unwrap()
            .contains("${1|auto,explicit|}")
    );
    let asked = ask("<House><Storey><Row><repeat ‸><Part code=\"KKS\"/></repeat></Row>");
    assert_eq!(asked.found[0].label, "num");
    assert_eq!(
        ask("<House na‸=\"a\"/>").line("name"),
        "<House name=\"a\"/>"
    );
    let asked = ask("<House><Roofs shape=\"‸\"/></House>");
    assert!(asked.has("IRI") && asked.find("IRI").detail.ja().contains("入母屋"));
    assert_eq!(
        ask("<House street=‸/>").line("yes"),
        "<House street=\"yes\"/>"
    );
    let broken = ask("<House>\n<Storey>\n<Row turn=\"‸\n<Row>KKS  </Row>");
    assert_eq!(broken.line("L"), "<Row turn=\"L");
    let asked = ask("<Catalog><PartDef code=\"GXX  \" base=\"仕舞‸\"/></Catalog>");
    assert_eq!(
        asked.line("GSI"),
        "<Catalog><PartDef code=\"GXX  \" base=\"GSI\"/></Catalog>"
    );
    asked.clean("GSI");
    let asked = ask("<Catalog><PartDef code=\"GXX  \" width=\"1\"><bars ‸/></PartDef></Catalog>");
    assert!(
        asked.has("count") && asked.has("finish"),
        "{:?}",
        asked.labels()
    );
}

const PIECES: &str = "<Catalog><let name=\"間口\" value=\"3\"/><define name=\"表構え\" code=\"GSI\" n=\"\"><repeat num=\"{n}\"><Part code=\"{code}\"/></repeat></define></Catalog>";

#[test]
fn types_of_houses_and_their_parameters_are_known() {
    let asked = ask_among(&[
        (
            "town.hsd",
            "<Houses><define name=\"own\"><House/></define><Place type=\"‸\"/></Houses>",
        ),
        ("lib.hsd", PIECES),
    ]);
    assert!(
        asked.has("own") && asked.has("so-nikai") && asked.has("kura"),
        "{:?}",
        asked.labels()
    );
    assert!(asked.find("kura").detail.ja().contains("土蔵"));
    let asked = ask("<Houses><Place type=\"kura\" ‸/></Houses>");
    assert!(asked.has("x") && asked.has("azimuth") && asked.has("entrance"));
    assert!(asked.find("entrance").detail.en().contains("gable"));
    let asked = ask("<Houses><Place type=\"kura\" entrance=\"‸\"/></Houses>");
    assert_eq!(asked.labels(), ["eaves", "gable"]);
    asked.clean("eaves");
    let asked = ask(
        "<Houses><repeat num=\"2\" index=\"nth\"><Place type=\"kura\" x=\"{20 * ‸}\"/></repeat></Houses>",
    );
    assert!(asked.has("nth"), "{:?}", asked.labels());
    asked.clean("nth");
}

#[test]
fn names_and_pieces_are_known_where_they_are() {
    let text = "<House name=\"家\"><include href=\"lib.hsd\"/><Param name=\"奥行\" default=\"2\" min=\"1\" max=\"9\" doc=\"depth\"/>\
        <Storey><Row><repeat num=\"{‸}\">KKS</repeat></Row><let name=\"later\" value=\"1\"/></Storey></House>";
    let asked = ask_among(&[("家.hsd", text), ("lib.hsd", PIECES)]);
    assert!(asked.has("奥行") && asked.has("間口") && asked.has("max") && asked.has("k"));
    assert!(!asked.has("later"), "{:?}", asked.labels());
    assert!(asked.find("奥行").detail.en().contains("depth"));
    assert!(asked.take("奥行").contains("num=\"{奥行}\""));
    let text =
        "<House><include href=\"lib.hsd\"/><Storey><Row><use name=\"表‸\"/></Row></Storey></House>";
    let asked = ask_among(&[("家.hsd", text), ("lib.hsd", PIECES)]);
    assert_eq!(asked.labels(), ["表構え"]);
    let text = "<House><include href=\"lib.hsd\"/><Storey><Row><use name=\"表構え\" ‸/></Row></Storey></House>";
    let asked = ask_among(&[("家.hsd", text), ("lib.hsd", PIECES)]);
    assert_eq!(asked.labels(), ["code", "n"]);
    assert!(asked.take("code").contains("code=\"GSI\""));
    let text =
        "<House><define name=\"b\" w=\"2\"><Part code=\"KKS\" width=\"{‸\"/></define></House>";
    assert!(ask(text).has("w"));
}

#[test]
fn files_are_listed() {
    let asked = ask("<House><include href=\"‸\"/></House>");
    assert_eq!(asked.labels(), ["lib/表.hsd"]);
    let asked = ask("<House><Texture code=\"X\" src=\"tex‸\"/></House>");
    assert!(
        asked
            .take("textures/noren.png")
            .contains("src=\"textures/noren.png\"")
    );
    let asked = ask(
        "<Structure><Facades><Facade><Floor id=\"一階\"/></Facade><Facade><Floor id=\"‸\"/></Facade></Facades></Structure>",
    );
    assert_eq!(asked.labels(), ["一階"]);
}

#[test]
fn nothing_is_proposed_where_nothing_stands() {
    for text in [
        "<House><!-- <‸ --></House>",
        "# ‸\n0 0 180\n",
        "<House></House ‸>",
        "<?xml ‸?><House/>",
    ] {
        assert_eq!(ask(text).labels(), Vec::<&str>::new(), "{text}");
    }
}

#[test]
fn every_cut_of_every_example_can_be_asked() {
    for name in ["machiya", "param-machiya", "kanban", "tea-shop"] {
        let text = std::fs::read_to_string(format!("examples/{name}.hsd")).unwrap();
        let cuts: Vec<usize> = text.char_indices().map(|(i, _)| i).step_by(11).collect();
        for cut in cuts {
            ask(&format!("{}‸", &text[..cut]));
            ask(&format!("{}‸{}", &text[..cut], &text[cut..]));
        }
    }
}
