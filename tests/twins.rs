//! Houses of one plan share the work of roofing: what is built and said is as if each stood alone.

use crate::support::{Run, assert_none, compile, texts};
use hsd::building::HouseRoofs;
use hsd::diagnostic::Diagnostic;
use hsd::source::Span;

/// A legacy text of one house, twice in one file, with the offset of the second.
fn twice(text: &str) -> (String, u32) {
    let between = if text.ends_with('\n') { "%\n" } else { "\n%\n" };
    let offset = text.len() + between.len();
    (format!("{text}{between}{text}"), offset as u32)
}

/// What is said about the roofs, with every place moved to the front by `by`.
fn said(run: &Run, from: u32, to: u32) -> Vec<Diagnostic> {
    let roofs = run.diagnostics.iter().filter(|d| d.code.0 / 100 == 5);
    let here = roofs.filter(|d| (from..to).contains(&d.span().unwrap().start));
    here.map(|d| {
        let moved = |span: Span| Span {
            start: span.start - from,
            end: span.end - from,
            ..span
        };
        let mut moved_here = d.clone();
        moved_here.origin = moved(d.span().unwrap()).into();
        for label in &mut moved_here.labels {
            label.span = moved(label.span);
        }
        for edit in moved_here.fixes.iter_mut().flat_map(|f| &mut f.edits) {
            edit.span = moved(edit.span);
        }
        moved_here
    })
    .collect()
}

/// Roofs without their places in the text.
pub(crate) fn built(roofs: &HouseRoofs) -> String {
    let mut roofs = roofs.clone();
    roofs.surfaces();
    roofs.roofs.iter_mut().for_each(|r| r.span = None);
    format!("{roofs:?}")
}

#[test]
fn twins_are_built_and_told_as_if_each_stood_alone() {
    let mut findings = vec![];
    let mut shown = 0;
    let mut files = texts("examples");
    files.extend(texts("tests/suite/diagnostics"));
    for path in files {
        let name = crate::support::stem(&path);
        let Ok(text) = std::fs::read_to_string(&path) else {
            continue; // Shift_JIS
        };
        if text
            .trim_start_matches('\u{feff}')
            .trim_start()
            .starts_with('<')
            || text.contains('%')
        {
            continue;
        }
        let alone = compile("alone.hsd", text.as_bytes());
        let (both, offset) = twice(&text);
        let run = compile("both.hsd", both.as_bytes());
        let roofs: Vec<&HouseRoofs> = run.building.houses.iter().map(|b| &*b.roofs).collect();
        if alone.building.houses.len() != 1 || roofs.len() != 2 {
            continue;
        }
        let once = said(&alone, 0, u32::MAX);
        shown += usize::from(!once.is_empty());
        for (nth, from, to) in [(0, 0, offset), (1, offset, u32::MAX)] {
            if said(&run, from, to) != once {
                findings.push(format!("{name}: other things are said of house {nth}"));
            }
            if built(roofs[nth]) != built(&alone.building.houses[0].roofs) {
                findings.push(format!("{name}: house {nth} has other roofs"));
            }
            let strange = roofs[nth].roofs.iter().filter_map(|r| r.span);
            if strange.into_iter().any(|s| !(from..to).contains(&s.start)) {
                findings.push(format!(
                    "{name}: a roof of house {nth} lies elsewhere in the text"
                ));
            }
        }
    }
    assert_none(&findings);
    assert!(
        shown > 10,
        "only {shown} texts have something said about their roofs"
    );
}
