//! The built-in catalogue: every part is there with its name and width, and codes are found.

use hsd::ast::CodeText;
use hsd::catalog::{Catalog, Era, Opening, Query};
use hsd::diagnostic::Diagnostics;
use hsd::source::{FileId, Limits, Source};

fn codes(catalog: &Catalog, ids: &[hsd::catalog::PartId]) -> Vec<String> {
    let code = |id: &hsd::catalog::PartId| catalog.part(*id).code().to_owned();
    ids.iter().map(code).collect()
}

#[test]
fn every_part_is_found_by_its_code() {
    let catalog = hsd::parse::builtin();
    // Those of the specification; behind them those of monuments, fusuma with and without a transom, more windows, blinds and
    // fences, what stands outdoors, a hanging sign, doors and a stone of palaces, doors and windows of bare wood.
    assert_eq!(catalog.parts().len(), 82 + 7 + 2 + 9 + 11 + 6 + 2 + 2 + 2);
    for part in catalog.parts() {
        let id = catalog.find(&CodeText::new(part.code())).expect("found");
        assert_eq!(catalog.part(id).code(), part.code());
        assert_eq!(part.code().len(), 5);
        assert!(
            [0.0, 0.5, 1.0, 2.0, 4.0].contains(&part.width()),
            "{part:?}"
        );
        assert!("KTMGHANO ".contains(part.class()));
        assert!(!part.ja.is_empty() && !part.romaji.is_empty() && !part.en.is_empty());
    }
}

/// CityJSON tells doors and windows from walls; modern parts have no class for either.
#[test]
fn doors_and_windows_are_known_as_such() {
    let of = |wanted: Opening| -> Vec<&str> {
        let modern = hsd::parse::builtin().parts().iter();
        let modern = modern.filter(|part| part.class() == 'N');
        let own = modern.filter(|part| part.opening() == Some(wanted));
        own.map(|part| part.code().trim_end()).collect()
    };
    assert_eq!(of(Opening::Door), ["NSH 2", "NAD 2"]);
    assert_eq!(
        of(Opening::Window),
        ["NAS 2", "NGC", "NWI", "NSW 2", "NBA 2"]
    );
    let of = |code: &str| {
        let catalog = hsd::parse::builtin();
        let part = catalog.find(&CodeText::new(code)).expect("is there");
        catalog.part(part).opening()
    };
    assert_eq!(of("TKD 2"), Some(Opening::Door));
    assert_eq!([of("MKU"), of("GDE")], [Some(Opening::Window); 2]);
    assert_eq!([of("KSK"), of("AKI"), of("NSP")], [None; 3]);
}

#[test]
fn the_fifth_column_is_the_width() {
    for part in hsd::parse::builtin().parts() {
        let width = match part.code().chars().nth(4).expect("five columns") {
            ' ' => 1.0,
            'h' => 0.5,
            digit => f64::from(digit.to_digit(10).expect("a digit")),
        };
        assert_eq!(part.width(), width, "{}", part.code());
    }
}

#[test]
fn the_void_has_two_spellings() {
    let catalog = hsd::parse::builtin();
    let void = catalog.find(&CodeText::new("")).expect("void");
    assert_eq!(catalog.find(&CodeText::new(".....")), Some(void));
    assert!(catalog.is_void(void));
    assert_eq!(
        catalog.parts().iter().filter(|p| p.class() == ' ').count(),
        1
    );
    assert_eq!(catalog.find(&CodeText::new("XYZ")), None);
    assert_eq!(catalog.find(&CodeText::new("a long name")), None);
}

#[test]
fn spellings_are_guessed() {
    let catalog = hsd::parse::builtin();
    let nearest = |code: &str| codes(catalog, &catalog.nearest(code));
    assert_eq!(nearest("gsi")[0], "GSI  ");
    assert_eq!(nearest("TIT2")[0], "TIT 2");
    assert_eq!(nearest("GKK")[0], "GKK h");
    assert_eq!(nearest("KSN")[0], "KSK  ");
    assert!(nearest("GIS").contains(&"GSI  ".to_owned()));
    assert!(nearest("KSN").len() <= 3);
    assert!(nearest("Q%&/x").is_empty());
    assert!(nearest("").is_empty());
    assert!(nearest("    ").is_empty());
}

#[test]
fn eras_and_extents() {
    let catalog = hsd::parse::builtin();
    let part = |code: &str| catalog.part(catalog.find(&CodeText::new(code)).expect("known"));
    assert_eq!(part("NGC").era, Era::Modern);
    assert_eq!(part("MGA").era, Era::Meiji);
    assert_eq!((part("GSI").from, part("GSI").to), (Some(0.8), Some(5.8)));
    assert_eq!(part("KSK").from, None);
    // Metres become shaku: 0.9 m = 2.97 shaku.
    assert!((part("NAS 2").from.expect("a window") - 2.97).abs() < 1e-9);
    let json = serde_json::to_value(part("GSI")).expect("json");
    assert_eq!(json["code"], "GSI  ");
    assert_eq!(json["era"], "E");
    assert_eq!(json["weathering"], "WB");
}

/// The page on shapes shows a part of one's own; it is one.
#[test]
fn the_part_on_the_page_is_read() {
    let page = include_str!("../grammar/parts.md");
    let part = page
        .split("```")
        .nth(1)
        .and_then(|block| block.strip_prefix("xml"));
    let text = format!("<Catalog>{}</Catalog>", part.expect("an example"));
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "parts.hsd", text.as_bytes());
    let parts = hsd::parse::parse(&source, &Limits::default(), &mut out).parts;
    let catalog = Catalog::new(&parts, &mut out);
    assert_eq!(out.into_sorted(), vec![]);
    assert_eq!(catalog.parts()[0].code(), "GXX  ");
}

/// Parts whose names on the sheet are not the field's.
const CORRECTED: [&str; 14] = [
    "KSKK ", "KSM  ", "KTI  ", "KDB  ", "KUD 0", "KCH  ", "TCH  ", "MMU 2", "AKI 2", "NGC  ",
    "NWI  ", "NMO  ", "NRC  ", "AFU  ",
];

/// Compares with the sheet of parts that lies beside the repository.
#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_sheet_agrees() {
    let sheet = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/spec/parts.csv");
    let sheet = std::fs::read_to_string(sheet).expect("the sheet is there");
    let catalog = hsd::parse::builtin();
    let mut rows = 0;
    for row in sheet.lines().skip(1) {
        let fields = fields(row);
        let part = catalog.parts().iter().find(|p| p.code() == fields[0]);
        let part = part.unwrap_or_else(|| panic!("a part for {row}"));
        if !CORRECTED.contains(&part.code()) {
            assert_eq!(fields[1], &*part.ja);
            assert_eq!(fields[2], &*part.romaji);
        }
        assert_eq!(fields[4].parse(), Ok(part.width()), "{row}");
        assert_eq!(fields[8], part.era.word(), "{row}");
        assert_eq!(fields[9].trim_matches('-'), &*part.weathering, "{row}");
        rows += 1;
    }
    assert_eq!(rows, 82);
}

/// The fields of a row of comma-separated values.
fn fields(row: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for c in row.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().expect("one").push(c),
        }
    }
    fields
}

/// Words that people type, and codes that must be among the answers.
#[test]
fn parts_are_found_by_what_people_call_them() {
    let found = |word: &str| -> Vec<String> {
        let query = Query::new(word);
        let parts = hsd::parse::builtin().parts().iter();
        let found = parts.filter(|p| p.is_found_by(&query));
        found.map(|p| p.code().to_owned()).collect()
    };
    for (words, codes) in [
        ("なまこ壁 海鼠壁 namako なまこ", "KNA  |KNB  "),
        ("むしこ窓 虫籠窓 mushiko むしこ", "MMU  |MMU 2"),
        ("簓子 ささら子 sasarako", "KSS  "),
        ("潜り戸 くぐり戸 潜戸 kuguri wicket", "TCH  "),
        ("ガラス戸 硝子戸 garasu", "TGL 2"),
        ("引戸 引き戸 hikido", "TIT  |TKD  |TSH  |TGL 2"),
        ("明障子 akarishouji", "TSH  |TSH 2"),
        ("障子 shouji shōji syouzi", "TSH  |TSH 2"),
        ("袖卯建 卯建 うだつ sodeudatsu udatsu", "KUD 0"),
        ("通り庭 通庭 toriniwa", "ATN  "),
        ("築地塀 築地 土塀 tsuiji", "KDB  "),
        ("幕掛 makukake", "ANM  "),
        ("与力窓 yoriki", "MMS 2"),
        ("揚見世 agemise", "ASH  "),
        ("半蔀 hajitomi", "TST  |TAG 2"),
        ("観音扉 kannon", "TKR  |TIK  |TSK  "),
        ("竪羽目 縦羽目 tatehame", "KTI  |KYI  "),
        ("平格子 hiragoushi", "GSB  |GSI  "),
        ("京格子 kyogoshi", "GSB  |GIT  "),
        ("格子 こうし koushi kōshi koshi", "TKD  |GSB  |GDE  |GKK h"),
        ("暖簾 のれん noren", "ANO  |ANL  |ANM  "),
        ("窓 mado", "MRE  |MMU  |NWI  "),
        ("連窓 水平連続窓 renzoku ribbon", "NWI  "),
        ("塀 hei", "KTB  |KDB  |KIB  "),
        ("fence", "KTB  |KIB  "),
        ("門 もん mon gate", "TKI  |TIT 2|TIK  |TIH  "),
        ("木戸 kido 木戸門", "TKI  "),
        ("丸窓 marumado", "MMR  "),
        ("花頭窓 火灯窓 katomado", "MKA  |MKA 2"),
        ("突上窓 tsukiagemado", "MTU  "),
        ("簾 すだれ sudare", "ASU  "),
        ("忍返し", "KTBS "),
        ("吊看板", "KKA  "),
        ("物干し", "OMH 4"),
        ("玉垣 tamagaki", "KTG  "),
        ("生垣 ikegaki hedge", "KIK  "),
        ("竹垣 takegaki", "KTK  "),
        ("石灯籠 灯籠 ishidourou tōrō lantern", "OTO  "),
        ("鳥居 torii", "ORI 4"),
        ("松 木 tree", "OMA 4"),
    ] {
        for word in words.split(' ') {
            let found = found(word);
            for code in codes.split('|') {
                assert!(
                    found.iter().any(|c| c == code),
                    "{word} finds {found:?}, not {code}"
                );
            }
        }
    }
    for absent in
        "越屋根 煙出し 千鳥破風 軒唐破風 降棟 稚児棟 本卯建 かまど 唐破風 懸魚 鬼瓦".split(' ')
    {
        assert_eq!(found(absent), [""; 0], "{absent}");
    }
}
