//! The program in Japanese: by `--lang` and by the locale.

use super::{code, folder, hsd, stderr, stdout};
use std::process::Command;

/// The program with these variables of the locale and no others.
fn with_locale(arguments: &[&str], variables: &[(&str, &str)]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
    for name in ["LC_ALL", "LC_MESSAGES", "LANG"] {
        command.env_remove(name);
    }
    let variables = variables.iter().copied();
    let output = command.args(arguments).envs(variables).output().unwrap();
    stdout(&output) + &stderr(&output)
}

fn is_japanese(text: &str) -> bool {
    text.chars().any(|c| matches!(c, '\u{3041}'..='\u{9fff}'))
}

#[test]
fn the_locale_chooses_the_language() {
    let page = |variables| with_locale(&["explain", "HSD0401"], variables);
    assert!(is_japanese(&page(&[("LANG", "ja_JP.UTF-8")])));
    assert!(!is_japanese(&page(&[])));
    assert!(!is_japanese(&page(&[
        ("LC_ALL", "C"),
        ("LANG", "ja_JP.UTF-8")
    ])));
    let japanese = ["--lang", "ja", "explain", "HSD0401"];
    assert!(is_japanese(&with_locale(&japanese, &[("LANG", "de_DE")])));
    let english = ["explain", "HSD0401", "--lang=en"];
    assert!(!is_japanese(&with_locale(&english, &[("LANG", "ja")])));
}

#[test]
fn messages_are_in_the_language_asked_for() {
    let folder = folder();
    let check = |format| {
        let arguments = ["check", "--lang", "ja", "--format", format, "broken.hsd"];
        stdout(&hsd(folder.path(), &arguments))
    };
    let human = check("human");
    assert!(human.starts_with("エラー[HSD0121]\n"), "{human}");
    assert!(human.contains("\n  対処: タブを"), "{human}");
    assert!(human.ends_with("broken.hsd: エラー 1件\n詳しくは `hsd explain HSD0121`\n"));
    assert!(check("short").starts_with("broken.hsd:5:4: error[HSD0121]: 部材コードの並びに"));
    let json: serde_json::Value = serde_json::from_str(&check("json")).unwrap();
    assert_eq!(json[0]["message"], "部材コードの並びにタブがあります");
    let sarif: serde_json::Value = serde_json::from_str(&check("sarif")).unwrap();
    let rule = &sarif["runs"][0]["tool"]["driver"]["rules"][0];
    assert!(is_japanese(rule["help"]["markdown"].as_str().unwrap()));
}

#[test]
fn models_do_not_depend_on_the_language() {
    let folder = folder();
    for (lang, out) in [("en", "a.glb"), ("ja", "b.glb")] {
        let arguments = ["--lang", lang, "build", "sound.hsd", "-o", out];
        let output = hsd(folder.path(), &arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_eq!(is_japanese(&stderr(&output)), lang == "ja");
    }
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert_eq!(read("a.glb"), read("b.glb"));
}

#[test]
fn help_has_no_english_line() {
    let folder = folder();
    let commands = [
        "",
        "build",
        "check",
        "draw",
        "dump",
        "parts",
        "explain",
        "fmt",
        "textures",
        "completions",
        "man",
    ];
    for (name, flag) in commands.iter().flat_map(|c| [(c, "-h"), (c, "--help")]) {
        let mut arguments = vec!["--lang", "ja"];
        arguments.extend([*name, flag].iter().filter(|a| !a.is_empty()));
        let output = hsd(folder.path(), &arguments);
        let help = stdout(&output);
        assert_eq!(code(&output), 0, "{arguments:?}");
        assert!(help.contains("\n使い方: hsd "), "{help}");
        // What is left are names of options, and values that need no word beside them.
        let plain = |line: &&str| {
            let words = line.trim().trim_start_matches("- ");
            let value = !words.contains(' ') || words.starts_with("hsd ");
            !words.is_empty() && !is_japanese(words) && !words.starts_with('-') && !value
        };
        let english: Vec<&str> = help.lines().filter(plain).collect();
        assert!(english.is_empty(), "{arguments:?}: {english:?}");
    }
}

#[test]
fn wrong_usage_is_told_in_japanese() {
    let folder = folder();
    for (arguments, expected) in [
        (&["build"][..], "エラー: 引数が足りません: <IN>..."),
        (&["bild"], "エラー: 'bild' というコマンドはありません"),
        (&["bild"], "'build' のことですか"),
        (
            &["check", "--format", "xml", "a"],
            "に 'xml' は指定できません",
        ),
        (
            &["check", "--format", "xml", "a"],
            "[値: human, short, json, sarif]",
        ),
        (
            &["check", "--colour", "a"],
            "'--colour' という引数はありません",
        ),
        (&["check"], "使い方: hsd check [オプション] <IN>..."),
        (&["explain", "HSD9999"], "HSD9999 という指摘はありません"),
        (
            &["check", "missing.hsd"],
            "ファイルまたはフォルダーがありません",
        ),
        (&["sound.hsd"], "hsd: `sound.hsd` はファイルです。"),
    ] {
        let output = hsd(folder.path(), &[&["--lang", "ja"], arguments].concat());
        let said = stdout(&output) + &stderr(&output);
        assert!(said.contains(expected), "{arguments:?}: {said}");
        assert!(code(&output) >= 2, "{arguments:?}");
    }
}

#[test]
fn the_catalogue_has_japanese_heads() {
    let folder = folder();
    let table = stdout(&hsd(folder.path(), &["parts", "K", "--lang", "ja"]));
    assert!(table.starts_with("コード  幅 U  下端 尺"), "{table}");
    assert!(table.contains("E 江戸"), "{table}");
}
