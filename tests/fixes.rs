//! What the messages offer to do at a click: every mend of every fixture is done, the text compiled again, and nobody
//! may complain of the same again or find a new kind of error. A code that offers none has a reason.

mod legacy_half;
mod xml_half;

use crate::support::Words;
use crate::support::{Run, assert_none, compile_changed, compile_file, stem, texts};
use hsd::diagnostic::{Code, Diagnostic, Fix, Severity};
use hsd::print::encode;
use hsd::source::{FileId, Source};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;

const FIXTURES: &str = "tests/suite/diagnostics";

/// The code at the beginning of a name such as `HSD0401_perimeter_open`.
fn code_of(name: &str) -> u16 {
    let digits = name.strip_prefix("HSD").and_then(|rest| rest.get(..4));
    let code = digits.and_then(|digits| digits.parse().ok());
    code.unwrap_or_else(|| panic!("{name} does not begin with its code"))
}

/// The changes of a mend in each file, by their ranges of its text, from the last to the first.
fn changes<'m>(run: &Run, fix: &'m Fix) -> BTreeMap<FileId, Vec<(Range<usize>, &'m str)>> {
    let mut all = BTreeMap::<FileId, Vec<(Range<usize>, &str)>>::new();
    for edit in &fix.edits {
        let range = run.file(edit.span).text_range(edit.span);
        let of_file = all.entry(edit.span.file).or_default();
        of_file.push((range, &*edit.text));
    }
    for of_file in all.values_mut() {
        of_file.sort_by_key(|(range, _)| std::cmp::Reverse((range.start, range.end)));
    }
    all
}

/// The files that a mend changes, with the bytes they have after it.
fn fixed(run: &Run, fix: &Fix) -> Result<BTreeMap<String, Vec<u8>>, String> {
    let mut files = BTreeMap::new();
    for (id, changes) in changes(run, fix) {
        let mut all = std::iter::once(&run.source).chain(&run.included);
        let source: &Source = all
            .find(|s| s.id() == id)
            .ok_or("a file that is not there")?;
        let mut text = source.text().to_owned();
        let mut before = text.len();
        for (range, new) in changes {
            if range.end > before {
                return Err("its changes touch one another".into());
            }
            before = range.start;
            text.replace_range(range, new);
        }
        files.insert(source.name().to_owned(), encode(&text, source));
    }
    Ok(files)
}

/// How many messages of each code there are, errors alone if so wished.
fn counted(diagnostics: &[Diagnostic], errors: bool) -> BTreeMap<Code, usize> {
    let mut counts = BTreeMap::new();
    for d in diagnostics {
        if !errors || d.severity == Severity::Error {
            *counts.entry(d.code).or_default() += 1;
        }
    }
    counts
}

/// What is wrong with a mend of a message: an error is new, or the message is there still.
fn flaws(path: &Path, run: &Run, d: &Diagnostic, fix: &Fix) -> Vec<String> {
    let files = match fixed(run, fix) {
        Ok(files) => files,
        Err(flaw) => return vec![flaw],
    };
    let mut flaws = vec![];
    if fix.title.en().ends_with('.') || fix.title.en() == fix.title.ja() {
        flaws.push("its title is no imperative in two languages".into());
    }
    let after = compile_changed(path, files);
    let left = |run: &Run| counted(&run.diagnostics, false).get(&d.code).copied();
    if left(&after) >= left(run) {
        flaws.push(format!("{} is said still:\n{}", d.code, after.short()));
    }
    let known = counted(&run.diagnostics, true);
    for (code, _) in counted(&after.diagnostics, true) {
        if !known.contains_key(&code) {
            flaws.push(format!("{code} is new:\n{}", after.short()));
        }
    }
    flaws
}

/// What is wrong with all mends of a run, and how many there are.
fn all_flaws(path: &Path, run: &Run, findings: &mut Vec<String>) -> usize {
    let mut count = 0;
    for d in &run.diagnostics {
        for fix in &d.fixes {
            count += 1;
            let found = flaws(path, run, d, fix);
            let name = format!("{}: {}: {:?}", stem(path), d.code, fix.title.en());
            findings.extend(found.iter().map(|flaw| format!("{name}: {flaw}")));
        }
    }
    count
}

#[test]
fn fixes_fix() {
    let (mut findings, mut count) = (vec![], 0);
    for path in texts(FIXTURES) {
        count += all_flaws(&path, &compile_file(&path), &mut findings);
    }
    assert!(count > 80, "{count} mends");
    assert_none(&findings);
}

/// The same texts with line ends of Windows, and in UTF-16, where a column is two bytes.
#[test]
fn fixes_of_the_legacy_text_know_line_ends_and_encodings() {
    let (mut findings, mut counts) = (vec![], [0; 2]);
    for path in texts(FIXTURES) {
        let bytes = std::fs::read(&path).expect("fixtures can be read");
        let Some(text) = String::from_utf8(bytes).ok().filter(|t| !t.contains('<')) else {
            continue;
        };
        let name = path.file_name().expect("is a file").to_string_lossy();
        let marked = format!("\u{feff}{text}");
        let wide = marked.encode_utf16().flat_map(u16::to_le_bytes);
        let others = [text.replace('\n', "\r\n").into_bytes(), wide.collect()];
        for (other, count) in others.into_iter().zip(&mut counts) {
            let changed = BTreeMap::from([(name.clone().into_owned(), other)]);
            *count += all_flaws(&path, &compile_changed(&path, changed), &mut findings);
        }
    }
    assert!(counts.iter().all(|count| *count > 60), "{counts:?} mends");
    assert_none(&findings);
}

/// Slips that bring on messages of several codes.
#[test]
fn fixes_of_several_slips_do_not_hinder_one_another() {
    let walls = "KSM  KSM\nKSM  KSM\nKSM  KSM\n";
    let lines = [
        "ＫＳＭ　　ＫＳＭ\n",
        "ＫＳＭ　　KSM\n",
        "KSM  ^KSM  KSM  ^\n",
        "  KSM  ksm # door\n",
        "KSM KSM  r # front\n",
        "大戸 KSM  l\n",
        "  # the front\n",
        "// the front\n",
    ];
    let (mut findings, mut count) = (vec![], 0);
    for (i, line) in lines.iter().enumerate() {
        let name = format!("slip{i}.hsd");
        let text = format!("0 0 180\n9.0\n\n{line}{walls}").into_bytes();
        let path = Path::new(&name);
        let run = compile_changed(path, BTreeMap::from([(name.clone(), text)]));
        count += all_flaws(path, &run, &mut findings);
    }
    assert!(count >= lines.len(), "{count} mends");
    assert_none(&findings);
}

/// The letter that turns a line to the left belongs to the legacy form: behind the codes of a row it would be a code.
#[test]
fn rows_are_not_turned_by_a_letter() {
    let lengths = [6, 4, 3, 2, 3, 2]; // the third has to turn to the left
    let legacy = lengths.map(|n| "KSK  ".repeat(n) + "\n").concat();
    let rows = lengths.map(|n| format!("<Row>{}</Row>", "KSK  ".repeat(n)));
    let xml = format!("<House><Storey>{}</Storey></House>", rows.concat());
    for (text, offers) in [(format!("0 0\n9\n\n{legacy}"), 1), (xml, 0)] {
        let run = crate::support::compile("house.hsd", text.as_bytes());
        let wrong = run.diagnostics.iter().find(|d| d.code == Code(403));
        let fixes = &wrong.expect("a turn is wrong").fixes;
        assert_eq!(fixes.len(), offers, "{fixes:?}");
    }
}

#[test]
fn codes_offer_a_fix_or_have_a_reason() {
    let halves = [legacy_half::WITHOUT_FIX, xml_half::WITHOUT_FIX];
    let without = || halves.iter().flat_map(|half| half.iter());
    let mut findings = vec![];
    for half in halves {
        if !half.is_sorted_by_key(|(code, _)| *code) {
            findings.push("a table is not in order".to_owned());
        }
    }
    let (mut offering, mut all) = (BTreeSet::new(), BTreeSet::new());
    for path in texts(FIXTURES) {
        let code = code_of(&stem(&path));
        all.insert(code);
        let run = compile_file(&path);
        let of_it = run.diagnostics.iter().filter(|d| d.code == Code(code));
        if of_it.clone().any(|d| !d.fixes.is_empty()) {
            offering.insert(code);
        }
    }
    let reasons: BTreeSet<u16> = without().map(|(code, _)| *code).collect();
    for &code in &all {
        if offering.contains(&code) == reasons.contains(&code) {
            let name = Code(code);
            findings.push(format!("{name}: needs either a mend or a reason for none"));
        }
    }
    let strange = reasons.difference(&all).map(|code| Code(*code));
    findings.extend(strange.map(|name| format!("{name}: has a reason, but no fixture")));
    assert_none(&findings);
}
