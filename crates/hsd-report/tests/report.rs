//! Reports on small Japanese texts, and on large ones.

use hsd_base::diagnostic::{Diagnostic, Diagnostics, Edit, Language, Origin};
use hsd_base::source::{FileId, Source, Span};
use hsd_base::text;
use hsd_report::{Format, Report, Style};
use hsd_testing::cpu::assert_linear;

fn source(text: &str) -> Source {
    Source::new(FileId(0), "町家.hsd", text.as_bytes())
}

fn find(source: &Source, needle: &str) -> Span {
    let at = source.text().find(needle).unwrap();
    source.span(at..at + needle.len())
}

fn written(sources: &[Source], list: &[Diagnostic], format: Format) -> String {
    let mut out = vec![];
    let report = Report::new(sources, list);
    report.write(format, Style::default(), &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn carets_stand_under_full_width_text() {
    let source = source("# 町家\nGSI  外壁材　TSH  ＡＬＣ板\nKTU\n");
    let d = Diagnostic::error(
        104,
        find(&source, "ＡＬＣ板"),
        "no part is called \"ＡＬＣ板\"",
    )
    .help("write a code of five columns")
    .label(find(&source, "TSH"), "the part before");
    let expected = "\
error[HSD0104]

  × no part is called \"ＡＬＣ板\"
   ╭─[町家.hsd:2:15]
 1 │ # 町家
 2 │ GSI  外壁材　TSH  ＡＬＣ板
   ·              ─┬─  ────────
   ·               ╰── the part before
 3 │ KTU
   ╰────
  help: write a code of five columns

1 error in 町家.hsd
`hsd explain HSD0104` tells more about it
";
    assert_eq!(written(&[source], &[d], Format::Human), expected);
}

#[test]
fn voicing_marks_count_as_columns() {
    let source = source("ｶﾞﾗｽﾊﾟﾈﾙ WIN01 x\n");
    let d = Diagnostic::warning(301, find(&source, "WIN01"), "窓");
    let expected = "\
warning[HSD0301]

  ⚠ 窓
   ╭─[町家.hsd:1:10]
 1 │ ｶﾞﾗｽﾊﾟﾈﾙ WIN01 x
   ·          ─────
   ╰────

1 warning in 町家.hsd
`hsd explain HSD0301` tells more about it
";
    assert_eq!(written(&[source], &[d], Format::Human), expected);
}

#[test]
fn distant_labels_get_their_own_snippets() {
    let text: String = (1..=20).map(|i| format!("line {i}\r\n")).collect();
    let source = source(&text);
    let d = Diagnostic::note(1, find(&source, "line 15"), "far")
        .label(find(&source, "line 3\r\n"), "here");
    let expected = "\
note[HSD0001]

  ☞ far
   ╭─[町家.hsd:3:1]
 2 │ line 2
 3 │ line 3
   · ───┬──
   ·    ╰── here
 4 │ line 4
   ╰────
    ╭─[町家.hsd:15:1]
 14 │ line 14
 15 │ line 15
    · ───────
 16 │ line 16
    ╰────

1 note in 町家.hsd
`hsd explain HSD0001` tells more about it
";
    assert_eq!(written(&[source], &[d], Format::Human), expected);
}

#[test]
fn every_place_of_a_file_can_be_marked() {
    for text in [
        "",
        "\n",
        "a",
        "a\n",
        "a\r\n\r\nb",
        "\u{3000}\n\n\n",
        "\t\u{1b}[31m\r\u{202e}x",
    ] {
        let source = source(text);
        let ends: Vec<usize> = (0..=text.len())
            .filter(|i| text.is_char_boundary(*i))
            .collect();
        let pairs = ends.iter().flat_map(|a| ends.iter().map(move |b| (*a, *b)));
        for (from, to) in pairs.filter(|(a, b)| a <= b) {
            let d =
                Diagnostic::error(1, source.span(from..to), "m").label(source.span(to..to), "l");
            let report = written(std::slice::from_ref(&source), &[d], Format::Human);
            assert!(
                report.contains("╭─[町家.hsd:"),
                "{text:?} {from}..{to}: {report}"
            );
            assert!(
                !report.contains("Failed") && !report.contains('\u{1b}'),
                "{report}"
            );
        }
    }
}

#[test]
fn tall_marks_show_their_first_line() {
    let source = source(&"KTU  TSH\n".repeat(100));
    let d = Diagnostic::error(401, source.span(0..900), "does not close");
    let report = written(&[source], &[d], Format::Human);
    assert!(report.lines().count() < 12, "{report}");
    assert!(
        report.contains(" 1 │ KTU  TSH\n   · ────────\n"),
        "{report}"
    );
}

#[test]
fn long_lines_are_cut_round_the_marks() {
    let long = |count: usize| {
        let (before, between) = ("KTU  ".repeat(count), " ".repeat(300));
        let source = source(&format!("{before}外{between}WIN01{}\n", "x".repeat(9999)));
        let d =
            Diagnostic::error(104, find(&source, "WIN01"), "m").label(find(&source, "外"), "here");
        (source, d)
    };
    let report = |(source, d): &(Source, Diagnostic)| {
        let (source, d) = (source.clone(), d.clone());
        written(&[source], &[d], Format::Human)
    };
    assert_linear("a report", 100_000, long, report);
    let report = report(&long(100_000));
    let line = report.lines().find(|l| l.contains("WIN01")).unwrap();
    assert!(line.starts_with(" 1 │ …") && line.ends_with("x…") && line.chars().count() < 300);
    assert_eq!(line.matches('…').count(), 3, "{line}");
    assert!(report.contains("[町家.hsd:1:500302]"), "{report}");
}

#[test]
fn colours_are_asked_for() {
    let source = source("GSI\n");
    let d = [Diagnostic::error(104, find(&source, "GSI"), "m")];
    let sources = [source];
    let style = Style {
        color: true,
        width: 80,
    };
    let mut out = vec![];
    Report::new(&sources, &d)
        .write(Format::Human, style, &mut out)
        .unwrap();
    assert!(String::from_utf8(out).unwrap().contains("\u{1b}[31m"));
}

#[test]
fn at_most_fifty_are_shown_errors_first() {
    let source = source(&"GSI\n".repeat(200));
    let at = |i: usize| source.span(4 * i..4 * i + 3);
    let mut all = Diagnostics::new();
    (0..100).for_each(|i| all.push(Diagnostic::warning(301, at(i), "w")));
    (100..140).for_each(|i| all.push(Diagnostic::error(104, at(i), "e")));
    let list = all.into_sorted();
    let sources = [source.clone()];
    let report = written(&sources, &list, Format::Human);
    assert_eq!(report.matches("error[HSD0104]").count(), 40);
    assert_eq!(report.matches("warning[HSD0301]").count(), 10);
    assert!(report.contains("... and 90 more; `--format short` lists all of them\n"));
    assert!(report.contains("\n40 errors, 100 warnings in 町家.hsd\n"));
    assert!(
        report.ends_with("`hsd explain HSD0104` tells more, as for HSD0301\n"),
        "{report}"
    );
    assert_eq!(written(&sources, &list, Format::Short).lines().count(), 140);
}

#[test]
fn short_lines_are_for_editors() {
    let source = source("# 町家\n家 GSI\u{1b}\n");
    let wrong = find(&source, "GSI\u{1b}");
    let d = [
        Diagnostic::warning(6, find(&source, "家 "), "odd"),
        Diagnostic::error(104, wrong, "unknown \"GSI\u{1b}\"").help("mend\nit"),
    ];
    let expected = "\
町家.hsd:2:1: warning[HSD0006]: odd
町家.hsd:2:3: error[HSD0104]: unknown \"GSI␛\" (help: mend␊it)
";
    assert_eq!(written(&[source], &d, Format::Short), expected);
}

#[test]
fn json_has_the_fields_of_the_contract() {
    let (bytes, ..) = encoding_rs::SHIFT_JIS.encode("# 町家\nGSI  \"\n");
    let sources = [Source::new(FileId(0), "家.hsd", &bytes)];
    let d = Diagnostic::error(104, find(&sources[0], "GSI  "), "a \u{1} \"quoted\" text")
        .help("mend")
        .label(find(&sources[0], "町家"), "name");
    let text = written(&sources, &[d], Format::Json);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let expected = serde_json::json!([{
        "code": "HSD0104", "severity": "error", "message": "a \u{1} \"quoted\" text", "file": "家.hsd",
        "line": 2, "column": 1, "span": {"start": 7, "end": 12}, "help": "mend",
        "labels": [
            {"message": "name", "file": "家.hsd", "line": 1, "column": 3, "span": {"start": 2, "end": 6}},
        ],
    }]);
    assert_eq!(json, expected);
    assert_eq!(written(&sources, &[], Format::Json), "[]\n");
}

/// Features have no place in a file: their layer and key stand in the text.
#[test]
fn features_are_named() {
    let origin = |key: &str| Origin::Feature {
        layer: "bldg".into(),
        key: key.into(),
    };
    let list = [
        Diagnostic::error(410, origin("b1"), text!("no wall", "壁がありません")).help("mend"),
        Diagnostic::warning(413, origin("b2"), text!("too large", "大きすぎます")),
    ];
    let short = "bldg, feature b1: no wall";
    let written = |format, language| {
        let (mut out, style) = (vec![], Style::default());
        let report = Report::new(&[], &list).in_language(language);
        report.write(format, style, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    };
    let lines = written(Format::Short, Language::English);
    assert!(
        lines.starts_with(&format!("error[HSD0410]: {short} (help: mend)\n")),
        "{lines}"
    );
    let lines = written(Format::Short, Language::Japanese);
    assert!(
        lines.contains("warning[HSD0413]: bldg の地物 b2: 大きすぎます\n"),
        "{lines}"
    );
    let human = written(Format::Human, Language::English);
    assert!(
        human.contains(short) && human.contains("1 error, 1 warning in bldg\n"),
        "{human}"
    );
    let json: serde_json::Value =
        serde_json::from_str(&written(Format::Json, Language::English)).unwrap();
    assert_eq!(
        json[0]["feature"],
        serde_json::json!({"layer": "bldg", "key": "b1"})
    );
    assert!(json[0]["span"].is_null() && json[0]["file"].is_null());
    assert_eq!(json[0]["message"], "no wall");
    let sarif: serde_json::Value =
        serde_json::from_str(&written(Format::Sarif, Language::English)).unwrap();
    let result = &sarif["runs"][0]["results"][0];
    assert_eq!(result["message"]["text"], format!("{short} (help: mend)"));
    let place = &result["locations"][0];
    assert_eq!(
        place["logicalLocations"][0]["fullyQualifiedName"],
        "bldg/b1"
    );
    assert!(place.get("physicalLocation").is_none());
}

#[test]
fn sarif_is_minimal_and_valid() {
    let source = source("# 町家\nGSI  x\n");
    let d = [
        Diagnostic::error(104, find(&source, "GSI  "), "wrong").help("mend"),
        Diagnostic::note(1, find(&source, "町家"), "name").label(find(&source, "x"), "there"),
    ];
    let text = written(&[source], &d, Format::Sarif);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["version"], "2.1.0");
    let run = &json["runs"][0];
    let driver = &run["tool"]["driver"];
    assert_eq!(
        (&driver["name"], &driver["rules"][1]["id"]),
        (&"hsd".into(), &"HSD0104".into())
    );
    let result = &run["results"][0];
    assert_eq!(
        result["ruleId"],
        driver["rules"][result["ruleIndex"].as_u64().unwrap() as usize]["id"]
    );
    assert_eq!(
        (&result["level"], &result["message"]["text"]),
        (&"error".into(), &"wrong (help: mend)".into())
    );
    let location = &result["locations"][0]["physicalLocation"];
    assert_eq!(
        location["artifactLocation"]["uri"],
        "%E7%94%BA%E5%AE%B6.hsd"
    );
    let region = serde_json::json!({
        "startLine": 2, "startColumn": 1, "endLine": 2, "endColumn": 6,
        "byteOffset": 9, "byteLength": 5, "charOffset": 5, "charLength": 5,
    });
    assert_eq!(location["region"], region);
    let related = &run["results"][1]["relatedLocations"][0];
    assert_eq!(related["message"]["text"], "there");
    assert_eq!(related["physicalLocation"]["region"]["startColumn"], 6);
}

#[test]
fn sarif_offers_fixes_as_fixes() {
    let source = source("# 町家\nGSI  x\n");
    let (code, end) = (find(&source, "GSI  "), find(&source, "x").after());
    let edits = vec![Edit::new(code, "KSK  "), Edit::new(end, "L")];
    let d = [
        Diagnostic::error(104, code, "wrong")
            .fix(text!("Write `GSB  `", "`GSB  ` と書く"), code, "GSB  ")
            .fix_all("Do both", edits),
        Diagnostic::note(1, end, "no mend"),
    ];
    let sources = [source];
    let json: serde_json::Value =
        serde_json::from_str(&written(&sources, &d, Format::Sarif)).unwrap();
    let results = &json["runs"][0]["results"];
    // SARIF 2.1.0, 3.55 to 3.57: a fix has changes of files, each with replacements of regions in the units of the
    // run. A region of no length is a place to put something in.
    let region = |from: u32, to: u32| {
        serde_json::json!({
            "startLine": 2, "startColumn": from, "endLine": 2, "endColumn": to,
            "byteOffset": 8 + from, "byteLength": to - from, "charOffset": 4 + from, "charLength": to - from,
        })
    };
    let replaced = |region: serde_json::Value, text: &str| serde_json::json!({"deletedRegion": region, "insertedContent": {"text": text}});
    let fix = |description: &str, replacements: &[serde_json::Value]| {
        serde_json::json!({
            "description": {"text": description},
            "artifactChanges": [{
                "artifactLocation": {"uri": "%E7%94%BA%E5%AE%B6.hsd"},
                "replacements": replacements,
            }],
        })
    };
    let expected = [
        fix("Write `GSB  `", &[replaced(region(1, 6), "GSB  ")]),
        fix(
            "Do both",
            &[replaced(region(1, 6), "KSK  "), replaced(region(7, 7), "L")],
        ),
    ];
    assert_eq!(results[0]["fixes"], serde_json::json!(expected));
    assert_eq!(
        results[1].get("fixes"),
        None,
        "an array of fixes is never empty"
    );
    // Other forms say nothing of mends.
    for format in [Format::Human, Format::Short, Format::Json] {
        let bare = d.clone().map(|d| Diagnostic { fixes: vec![], ..d });
        assert_eq!(
            written(&sources, &d, format),
            written(&sources, &bare, format)
        );
    }
}

#[test]
fn many_messages_on_one_line_take_linear_time() {
    let many = |count: usize| {
        let source = source(&"家GSI  ".repeat(count));
        let span = |i: usize| source.span(8 * i..8 * i + 3);
        let list = (0..count).map(|i| Diagnostic::error(104, span(i), "m"));
        let list: Vec<_> = list.collect();
        ([source], list)
    };
    for format in [Format::Human, Format::Short, Format::Json, Format::Sarif] {
        let report =
            |(sources, list): &([Source; 1], Vec<Diagnostic>)| written(sources, list, format).len();
        assert_linear(&format!("{format:?}"), 10_000, many, report);
    }
}

#[test]
fn reports_speak_japanese() {
    let source = source("# 町家\nGSI  外壁材　TSH  ＡＬＣ板\n");
    let quoted = "`ＡＬＣ板`";
    let d = Diagnostic::error(
        104,
        find(&source, "ＡＬＣ板"),
        text!([quoted]
            "no part is called {quoted}",
            "{quoted} という部材はありません"
        ),
    )
    .help(text!(
        "  help: write a code",
        "五桁の部材コードを書いてください"
    ))
    .label(find(&source, "TSH"), text!("the part before", "直前の部材"));
    let list = [d, Diagnostic::warning(6, find(&source, "家"), "odd")];
    let sources = [source];
    let written = |format| {
        let mut out = vec![];
        let report = Report::new(&sources, &list).in_language(Language::Japanese);
        report.write(format, Style::default(), &mut out).unwrap();
        String::from_utf8(out).unwrap()
    };
    let expected = "\
エラー[HSD0104]

  × `ＡＬＣ板` という部材はありません
   ╭─[町家.hsd:2:15]
 1 │ # 町家
 2 │ GSI  外壁材　TSH  ＡＬＣ板
   ·              ─┬─  ────────
   ·               ╰── 直前の部材
   ╰────
  対処: 五桁の部材コードを書いてください
";
    let human = written(Format::Human);
    assert!(human.starts_with(expected), "{human}");
    assert!(human.contains("\n警告[HSD0006]\n"), "{human}");
    assert!(
        human.ends_with(
            "町家.hsd: エラー 1件、警告 1件\n詳しくは `hsd explain HSD0006` (HSD0104 も同様)\n"
        ),
        "{human}"
    );
    let style = Style {
        color: true,
        width: 80,
    };
    let mut coloured = vec![];
    let report = Report::new(&sources, &list).in_language(Language::Japanese);
    report.write(Format::Human, style, &mut coloured).unwrap();
    let coloured = String::from_utf8(coloured).unwrap();
    assert!(
        coloured.contains("  対処: \u{1b}[0m五桁") && !coloured.contains("help: \u{1b}"),
        "{coloured}"
    );
    let short = written(Format::Short);
    let line = "町家.hsd:2:15: error[HSD0104]: `ＡＬＣ板` という部材はありません \
                (対処: 五桁の部材コードを書いてください) (2行目: 直前の部材)\n";
    assert!(short.starts_with(line), "{short}");
    let json: serde_json::Value = serde_json::from_str(&written(Format::Json)).unwrap();
    assert_eq!(json[0]["severity"], "error");
    assert_eq!(json[0]["help"], "五桁の部材コードを書いてください");
    let sarif: serde_json::Value = serde_json::from_str(&written(Format::Sarif)).unwrap();
    let result = &sarif["runs"][0]["results"][0];
    assert_eq!(
        result["message"]["text"],
        "`ＡＬＣ板` という部材はありません (対処: 五桁の部材コードを書いてください)"
    );
}
