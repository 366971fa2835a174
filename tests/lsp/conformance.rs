//! After each of many random edits the server says of a text what `hsd check` says of it.

use crate::lsp::client::{Client, position, range};
use crate::support::Words;
use crate::support::{Numbers, number, part_of, root, texts, texts_in_turn};
use hsd::diagnostic::{Diagnostics, Origin, Severity};
use hsd::driver::{self, Options};
use hsd::fs::FolderWorld;
use hsd::source::{FileId, Limits, Source};
use hsd::town::{self, TownInput};
use serde_json::{Value, json};
use std::path::Path;

/// Edits in all, of which a short run does a part.
const EDITS: usize = 1_600;

/// Edits after which a text is taken anew, since it has gone to pieces.
const ROUND: usize = 40;

/// What people and cats type.
#[rustfmt::skip]
const PIECES: &[&str] = &[
    "KSK  ", "2TOD ", "GSI", " ", "     ", "　", "\t", "\n", "\r\n", "\r", "R", "L", "^", "%\n", "# 町家\n", "0 0 180\n", "9.0 5.0\n", "name 家\n",
    "K X  14.0 KIR   0   0   6   8\n", "<Row>", "</Row>", "<Row>KSK  KSK</Row>", "<Storey>", "</House>", "<House name='家'>", "<", ">", "/", "\"", "'", "=",
    "<repeat num=\"3\">", "</repeat>", "{", "}", "{w + 1}", "<Param name=\"w\" default=\"3\"/>", "<use name=\"front\"/>", "<!--", "-->", "&", "&lt;", "𠮷", "ｶﾞ",
    "Ｗ", "turn=\"L\"", "<random code=\"KSK 2, TOD\"/>", "<include href=\"fronts.hsd\"/>", "<choice>", "大戸", "-1", "1e9", "\u{0}", "\u{feff}",
];

/// What `hsd check` says of a text, in the words of the protocol.
fn checked(path: &Path, text: &str, encoding: &str) -> Vec<Value> {
    let folder = path.parent().expect("is in a folder").to_owned();
    let folders = vec![folder.clone(), folder.join("textures")];
    let world = FolderWorld::new(folders, Limits::default().pixels).with_roots(vec![folder]);
    let name = path.to_str().expect("is UTF-8");
    // The editor's text has no encoding: that of a declaration does not hold.
    let marked = format!("\u{feff}{}", text.strip_prefix('\u{feff}').unwrap_or(text));
    let source = Source::new(FileId(0), name, marked.as_bytes());
    let mut out = Diagnostics::new();
    let options = Options::default();
    let mut checked = driver::check(&[&source], &world, &options, &mut out);
    let input = TownInput::new(&source, &world, &options);
    let depth = town::CheckDepth::Rules(&|| true);
    town::check(input, depth, &mut checked.included, &mut out);
    let mark = if text.starts_with('\u{feff}') { 3 } else { 0 };
    let own = out.into_sorted().into_iter();
    own.filter(|d| d.span().is_none_or(|span| span.file == FileId(0)))
        .map(|d| {
            let place = match &d.origin {
                Origin::Source(span) => source.text_range(*span),
                Origin::Feature { layer, .. } => name_of_layer(source.text(), layer),
            };
            let message = match d.help.is_empty() {
                true => d.message.en(),
                false => format!("{}\nhelp: {}", d.message.en(), d.help.en()),
            };
            json!({
                "range": range(text, place.start + mark..place.end + mark, encoding),
                "severity": match d.severity {
                    Severity::Error => 1,
                    Severity::Warning => 2,
                    Severity::Note => 3,
                },
                "code": d.code.to_string(),
                "source": "hsd",
                "message": message,
            })
        })
        .collect()
}

/// Where a layer has its name: there an editor shows what is wrong with its features.
fn name_of_layer(text: &str, layer: &str) -> std::ops::Range<usize> {
    let written = format!("<Layer name=\"{layer}\"");
    let at = text.find(&written).expect("a layer is named first");
    let end = at + written.len() - 1;
    end - layer.len()..end
}

/// What the client was told, without places in other texts.
fn told(mut list: Vec<Value>) -> Vec<Value> {
    for diagnostic in &mut list {
        let fields = diagnostic.as_object_mut().expect("is an object");
        fields.remove("relatedInformation");
    }
    list
}

fn boundary(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// One random change: the range of the text that goes, and what comes.
fn edit(text: &str, random: &mut Numbers) -> (std::ops::Range<usize>, String) {
    let start = boundary(text, random.below(text.len() + 1));
    let most = [0, 0, 1, 5, 12, 80][random.below(6)];
    let end = boundary(text, (start + random.below(most + 1)).min(text.len())).max(start);
    let piece = match random.below(8) {
        0 => String::new(),
        1 => {
            // Something from elsewhere, as by copying.
            let from = boundary(text, random.below(text.len() + 1));
            let to = boundary(text, (from + random.below(120)).min(text.len())).max(from);
            text[from..to].to_owned()
        }
        _ => PIECES[random.below(PIECES.len())].to_owned(),
    };
    // A carriage return and its line feed are one end of a line: no position lies between them.
    let split = |at: usize| text[..at].ends_with('\r') && text[at..].starts_with('\n');
    let start = start - usize::from(split(start));
    let end = end - usize::from(split(end));
    (start..end.max(start), piece)
}

/// Requests of every kind at a random place; none may fail by a fault of the program.
fn ask_everything(client: &mut Client, uri: &str, text: &str, random: &mut Numbers) {
    let at = boundary(text, random.below(text.len() + 1));
    let place = position(text, at, "utf-16");
    let document = json!({ "uri": uri });
    let here = json!({ "textDocument": document, "position": place });
    let span = json!({ "start": { "line": 0, "character": 0 }, "end": place });
    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let context = json!({ "diagnostics": [], "includeDeclaration": true });
    let ranged =
        json!({ "textDocument": document, "range": span, "context": context, "options": options });
    let mut named = here.clone();
    named["newName"] = "other".into();
    named["context"] = context.clone();
    let all = [
        ("completion", &here),
        ("hover", &here),
        ("definition", &here),
        ("references", &named),
        ("documentHighlight", &here),
        ("prepareRename", &here),
        ("rename", &named),
        ("documentSymbol", &ranged),
        ("foldingRange", &ranged),
        ("semanticTokens/full", &ranged),
        ("semanticTokens/range", &ranged),
        ("inlayHint", &ranged),
        ("codeAction", &ranged),
        ("formatting", &ranged),
        ("rangeFormatting", &ranged),
    ];
    for (method, params) in all {
        let answer = client.request(&format!("textDocument/{method}"), params.clone());
        match answer {
            Ok(_) => {}
            Err((-32803, why)) => assert!(method == "rename", "{method}: {why}"),
            Err((code, why)) => panic!("{method}: {code} {why}\n{text:?} at {at}"),
        }
    }
    let positions = json!({ "textDocument": document, "positions": [place] });
    let chains = client.request("textDocument/selectionRange", positions);
    assert_eq!(
        chains.expect("is answered").as_array().map(Vec::len),
        Some(1)
    );
}

#[test]
fn diagnostics_are_those_of_check_after_any_edit() {
    let mut paths = texts_in_turn("examples", 2);
    paths.extend(texts("library"));
    let (edits, mut random) = (
        number("HSD_EDITS", part_of(EDITS)),
        Numbers(number("HSD_SEED", 20261121) as u64),
    );
    let mut done = 0;
    for (number, encoding) in (0..).zip(["utf-16", "utf-8", "utf-32"].into_iter().cycle()) {
        if done >= edits {
            break;
        }
        let mut client = Client::start(encoding);
        for path in &paths {
            if done >= edits {
                break;
            }
            let start = std::fs::read_to_string(path).expect("is UTF-8");
            let uri = format!("file://{}", path.display());
            client.open(&uri, &start);
            let first = told(client.diagnostics(&uri, Some(1)));
            assert_eq!(first, checked(path, &start, encoding), "{uri}");
            let mut text = start;
            for version in 2..2 + ROUND as i32 {
                let mut changes = vec![];
                for _ in 0..1 + random.below(8) / 6 {
                    let (place, piece) = edit(&text, &mut random);
                    changes.push(json!({
                        "range": range(&text, place.clone(), encoding),
                        "text": piece,
                    }));
                    text.replace_range(place, &piece);
                }
                if random.below(50) == 0 {
                    changes.push(json!({ "text": text }));
                }
                client.change(&uri, version, changes.into());
                let found = told(client.diagnostics(&uri, Some(version)));
                assert_eq!(found, checked(path, &text, encoding), "{uri}\n{text:?}");
                done += 1;
                if encoding == "utf-16" && version % 5 == 0 {
                    ask_everything(&mut client, &uri, &text, &mut random);
                }
            }
            client.close(&uri);
            client.forget();
        }
        assert!(client.finish(), "round {number}");
    }
}

/// The program itself, for some of the texts: what it prints is what the server says.
#[test]
fn diagnostics_are_those_that_the_program_prints() {
    let folder = root().join("tests/suite/diagnostics");
    let mut client = Client::start("utf-8");
    for (path, number) in texts("tests/suite/diagnostics").iter().zip(0..) {
        let Ok(text) = std::fs::read_to_string(path) else {
            continue;
        };
        if number % 9 > 0 && !text.contains("<Town") {
            continue;
        }
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_hsd"));
        command
            .env("LC_ALL", "C")
            .args(["check", "--format", "json"]);
        let output = command.arg(path).output().expect("the program runs");
        let printed: Vec<Value> = serde_json::from_slice(&output.stdout).expect("is JSON");
        let own = printed
            .iter()
            .filter(|d| d["file"].as_str() == path.to_str());
        let printed: Vec<(String, Value)> = own
            .map(|d| {
                let span = |side: &str| d["span"][side].as_u64().unwrap_or(0) as usize;
                let code = d["code"].as_str().unwrap_or_default().to_owned();
                (code, range(&text, span("start")..span("end"), "utf-8"))
            })
            .collect();
        let uri = format!("file://{}", folder.join(path).display());
        client.open(&uri, &text);
        let found = client.diagnostics(&uri, Some(1));
        let found = found.iter().map(|d| {
            let code = d["code"].as_str().unwrap_or_default().to_owned();
            (code, d["range"].clone())
        });
        assert_eq!(found.collect::<Vec<_>>(), printed, "{uri}");
        client.close(&uri);
        client.forget();
    }
    assert!(client.finish());
}
