//! Inlay hints for values that a source file does not state: the length of a line, the end point of the walk, the
//! number and height of a storey, and the gap of an open walk. All are taken from the walls as built.

use super::Analysis;
use super::walked::{self, Built, Walked, length, plain, span_of};
use glam::DVec2;
use hsd_base::diagnostic::{Language, Text};
use hsd_base::geometry::SAME;
use hsd_base::text;
use std::ops::Range;

/// A label after a place of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inlay {
    /// The offset after which it stands.
    pub at: usize,
    /// The label.
    pub label: String,
    /// Its explanation.
    pub tooltip: Text,
}

/// Returns the hints of a range, in the order of the file.
pub fn inlays(a: &Analysis, range: Range<usize>, language: Language) -> Vec<Inlay> {
    let mut found = vec![];
    // Of two hints at one place the length of the line comes first.
    for ((start, end), walls) in walked::walls(a, &range) {
        found.extend(line(a, start..end, &walls, language));
    }
    for ((start, end), storeys) in walked::storeys(a) {
        if start <= range.end && range.start <= end {
            found.extend(storey(a, start, &storeys, language));
        }
    }
    found.retain(|i| range.start <= i.at && i.at <= range.end);
    found.sort_by_key(|i| i.at);
    found
}

/// Adds the number and height of a storey: after its start tag, or after its first line, whose columns stay as they
/// are.
fn storey(a: &Analysis, start: usize, storeys: &[Built<'_>], language: Language) -> Option<Inlay> {
    let outline = a.outline();
    let elements = &outline.elements;
    let number = elements.binary_search_by_key(&start, |e| e.range.start);
    let at = number.map_or_else(|_| line_end(a.text(), start), |e| elements[e].tag.end);
    let number = walked::numbers(storeys)?;
    let heights = || storeys.iter().map(|s| s.height());
    let (height, metres) = (
        span_of(heights()),
        span_of(heights().map(|h| centi(h * hsd_base::geometry::SHAKU))),
    );
    let perimeter = span_of(storeys.iter().map(|s| s.perimeter()));
    let label = text!([number, height]
        "storey {number} · {height} shaku",
        "{number}階 · {height}尺"
    );
    Some(Inlay {
        at,
        label: label.in_language(language).into_owned(),
        tooltip: text!([number, height, metres, perimeter]
            "storey {number}: {height} shaku ({metres} m) high, {perimeter} units round",
            "{number}階: 高さ {height}尺 ({metres} m)、外周 {perimeter} U"
        ),
    })
}

/// Returns the end of the content of the line at an offset.
fn line_end(text: &str, at: usize) -> usize {
    let line = text.get(at..).and_then(|t| t.split(['\n', '\r']).next());
    at + line.map_or(0, |l| l.trim_end().len())
}

/// Rounds a length in metres to a hundredth.
fn centi(metres: f64) -> f64 {
    (metres * 100.0).round() / 100.0
}

/// Adds the length of a line, the end point of the walk and, on the last line, the gap.
fn line(
    a: &Analysis,
    range: Range<usize>,
    walls: &[Walked<'_>],
    language: Language,
) -> Option<Inlay> {
    let first = walls.first()?;
    let beside: Vec<&Walked<'_>> = walls.iter().filter(|w| w.is_beside(first)).collect();
    let last = beside.last()?;
    let alone = beside.len() == walls.len();
    let at = range.start + a.text().get(range)?.trim_end().len();
    let sum: f64 = beside.iter().map(|w| length(w.wall)).sum();
    let metres = plain(centi(sum * first.unit));
    let end = last.wall.to;
    let (x, y) = (plain(end.x), plain(end.y));
    let many = beside.len();
    let (label, tooltip) = match (alone, many) {
        // The walks of several storeys or houses end at several places.
        (false, _) => {
            let each = span_of(walls.iter().map(|w| length(w.wall)));
            let metres = span_of(walls.iter().map(|w| centi(length(w.wall) * w.unit)));
            let count = walls.len();
            (
                format!("{each} U"),
                text!([each, metres, count]
                    "{each} units = {metres} m; {count} walls come of this line",
                    "{each} U = {metres} m。この行から壁が {count} 枚できます"
                ),
            )
        }
        (true, 1) => {
            let units = plain(sum);
            (
                format!("{units} U → ({x}, {y})"),
                text!([units, metres, x, y]
                    "{units} units = {metres} m; the walk then stands {x} to the left and {y} back from its origin",
                    "{units} U = {metres} m。この行の終わりは原点から左へ {x}、奥へ {y}"
                ),
            )
        }
        (true, _) => {
            let (each, units) = (span_of(beside.iter().map(|w| length(w.wall))), plain(sum));
            (
                format!("{each} U ×{many} = {units} U → ({x}, {y})"),
                text!([many, units, metres, x, y]
                    "{many} walls, {units} units = {metres} m in all; the walk then stands {x} to the left and {y} back from its origin",
                    "壁 {many} 枚、あわせて {units} U = {metres} m。終わりは原点から左へ {x}、奥へ {y}"
                ),
            )
        }
    };
    let mut inlay = Inlay { at, label, tooltip };
    if alone && last.is_last() && !last.ring.closed && !last.ring.inner {
        let lacks = last.ring.walls.first().map(|w| w.from - end);
        lack(&mut inlay, lacks.unwrap_or_default(), language);
    }
    Some(inlay)
}

/// Adds the gap that closes an open walk.
fn lack(inlay: &mut Inlay, gap: DVec2, language: Language) {
    let sides = [
        (gap.x, text!("left", "左"), text!("right", "右")),
        (gap.y, text!("back", "奥"), text!("front", "手前")),
    ];
    let open = sides.iter().filter(|(by, ..)| by.abs() > SAME);
    let open = open.map(|(by, plus, minus)| {
        let side = if *by > 0.0 { plus } else { minus };
        let by = plain(by.abs());
        text!([by, side] "{by} {side}", "{side}へ {by}")
    });
    let open: Vec<Text> = open.collect();
    if open.is_empty() {
        return;
    }
    let open = Text::joined(open, ", ", "、");
    let words = text!([open] "open: {open}", "未完: {open}");
    inlay.label = format!("{} · {}", inlay.label, words.in_language(language));
    let said = &inlay.tooltip;
    inlay.tooltip = text!([said, open]
        "{said}. To close the walls, it lacks {open} (units)",
        "{said}。壁を閉じるには{open} (U) 足りません"
    );
}
