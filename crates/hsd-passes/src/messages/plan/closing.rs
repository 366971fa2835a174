//! Fixes for a walk that does not close.

use super::units;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostic, Edit, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// A wall whose length, changed by `by` units, closes the gap along its direction.
pub(crate) struct ClosingFix {
    /// Line to change.
    pub(crate) line: Span,
    /// Length of the line as written, U.
    pub(crate) length: f64,
    /// Change of the length, positive if longer, U.
    pub(crate) by: f64,
    /// Text edit that applies the change; `None` if the line cannot be edited that way.
    pub(crate) edit: Option<Edit>,
}

/// A gap as "2 U to the left and 1 U to the front".
pub(super) fn gap_words(gap: DVec2) -> Text {
    let across = if gap.x > 0.0 {
        text!("to the left", "左")
    } else {
        text!("to the right", "右")
    };
    let along = if gap.y > 0.0 {
        text!("to the back", "奥")
    } else {
        text!("to the front", "手前")
    };
    let words = [(gap.x, across), (gap.y, along)];
    let words: Vec<Text> = words
        .iter()
        .filter(|(by, _)| by.abs() > hsd_base::geometry::SAME)
        .map(|(by, side)| {
            let far = units(by.abs());
            text!([far, side] "{far} {side}", "{side}へ {far}")
        })
        .collect();
    Text::joined(words, " and ", "、")
}

/// The change of a line: "the line of 3 U 1 U longer", and "1 U longer".
pub(super) fn change(fix: &ClosingFix) -> (Text, Text) {
    let (by, length) = (units(fix.by.abs()), units(fix.length));
    let words = if fix.by > 0.0 {
        text!([by] "{by} longer", "{by} 長く")
    } else {
        text!([by] "{by} shorter", "{by} 短く")
    };
    let line =
        text!([length, words] "the line of {length} {words}", "長さ {length} の行を {words}");
    (line, words)
}

/// Offers to change one line for each direction of the gap: the first that serve, then the second.
pub(super) fn closing(mut found: Diagnostic, axes: &[Vec<ClosingFix>]) -> Diagnostic {
    let most = axes.iter().map(Vec::len).max().unwrap_or(0);
    for n in 0..most {
        let lines = axes
            .iter()
            .map(|axis| axis.get(n.min(axis.len().max(1) - 1)));
        let chosen: Option<Vec<(Text, Edit)>> = lines
            .map(|fix| Some((change(fix?).0, fix?.edit.clone()?)))
            .collect();
        if let Some(chosen) = chosen {
            let (words, edits): (Vec<Text>, Vec<Edit>) = chosen.into_iter().unzip();
            let lines = Text::joined(words, " and ", "、");
            let title = text!([lines] "Make {lines}", "{lines}する");
            found = found.fix_all(title, edits);
        }
    }
    found
}
