//! Messages about walls, outlines and storeys (HSD04xx).

use crate::diagnostic::Diagnostic;
use crate::lower::Mend;
use crate::source::Span;
use glam::DVec2;

/// A number of units without needless decimals.
fn units(n: f64) -> String {
    let n = (n * 1000.0).round() / 1000.0;
    if n == 1.0 {
        "1 unit".into()
    } else {
        format!("{n} units")
    }
}

/// A gap as "2 units to the left and 1 unit to the front".
fn gap_words(gap: DVec2) -> String {
    let sides = [
        (gap.x, "to the left", "to the right"),
        (gap.y, "to the back", "to the front"),
    ];
    let words: Vec<String> = sides
        .iter()
        .filter(|(by, ..)| by.abs() > crate::geometry::SAME)
        .map(|(by, more, less)| {
            format!(
                "{} {}",
                units(by.abs()),
                if *by > 0.0 { more } else { less }
            )
        })
        .collect();
    words.join(" and ")
}

/// The walk ends beside its start.
#[cold]
pub(crate) fn open_perimeter(last: Span, gap: DVec2, mends: &[Mend]) -> Diagnostic {
    let message = format!(
        "the walls do not close: they end {} of where they began",
        gap_words(gap)
    );
    let mut diagnostic = Diagnostic::error(401, last, message);
    let mut advice = vec![];
    for mend in mends {
        let verb = if mend.by > 0.0 { "longer" } else { "shorter" };
        let words = format!("{} {verb}", units(mend.by.abs()));
        advice.push(format!("the line of {} {words}", units(mend.length)));
        if mend.line != last {
            diagnostic = diagnostic.label(mend.line, format!("{words} here would close it"));
        }
    }
    diagnostic.help(if advice.is_empty() {
        "lengthen or shorten a line that runs in the direction of the gap".to_owned()
    } else if gap.x.abs() > crate::geometry::SAME && gap.y.abs() > crate::geometry::SAME {
        format!(
            "one line for each direction must change: make {}",
            advice.join(", or ")
        )
    } else {
        format!("make {}", advice.join(", or "))
    })
}

/// The walk is back at its start but turned too often or too seldom.
#[cold]
pub(crate) fn wrong_turns(span: Span, missing: f64) -> Diagnostic {
    let closing = 1.0;
    let n = ((missing - closing) / 2.0).round();
    let (count, letter) = (
        n.abs().max(1.0),
        if missing > 0.0 { "left" } else { "right" },
    );
    Diagnostic::error(
        402,
        span,
        format!("the turns do not go once round the house: about {count} too many to the {letter}"),
    )
    .help(format!(
        "a closed storey has four right turns more than left turns; look for {} that should not be there",
        if missing > 0.0 { "an `L`" } else { "a line end (right turn) without its `L`" }
    ))
}

/// One line end turned the other way would close the walk.
#[cold]
pub(crate) fn turn_to_flip(line: Span, is_left: bool, open: bool) -> Diagnostic {
    let (message, help) = if is_left {
        (
            "one `L` too many: the walls do not close",
            "remove the `L` at the end of this line",
        )
    } else {
        (
            "an `L` is missing: the walls do not close",
            "write `L` at the end of this line",
        )
    };
    let new = if open {
        Diagnostic::warning
    } else {
        Diagnostic::error
    };
    new(403, line, message.to_owned()).help(format!(
        "{help}: with this one turn the other way the walls close exactly"
    ))
}

/// An `L` that stands one line too early or too late.
#[cold]
pub(crate) fn turn_to_move(line: Span, next: Span, is_left: bool, open: bool) -> Diagnostic {
    let (here, there, way) = if is_left {
        (line, next, "next")
    } else {
        (next, line, "previous")
    };
    let new = if open {
        Diagnostic::warning
    } else {
        Diagnostic::error
    };
    new(
        418,
        here,
        "the `L` stands at the wrong line: the walls do not close".to_owned(),
    )
    .label(there, "with the `L` here the walls close exactly")
    .help(format!(
        "move the `L` from the end of this line to the end of the {way} one"
    ))
}

/// A facade that stands alone.
#[cold]
pub(crate) fn open_facade(span: Span, gap: DVec2) -> Diagnostic {
    Diagnostic::note(
        404,
        span,
        format!(
            "an open facade: the walls end {} of where they began",
            gap_words(gap)
        ),
    )
    .help("it gets no roof; to make it a house, go on until the walls close")
}

/// Two walls cross or touch.
#[cold]
pub(crate) fn walls_meet(second: Span, first: Span, crossing: bool) -> Diagnostic {
    let (code, verb) = if crossing {
        (405, "crosses")
    } else {
        (406, "touches")
    };
    Diagnostic::error(code, second, format!("this wall {verb} an earlier one"))
        .label(first, "the other wall")
        .help("an outline may meet itself nowhere: check the lengths and turns between these two lines")
}

/// A courtyard that lies in no house.
#[cold]
pub(crate) fn hole_outside(span: Span) -> Diagnostic {
    Diagnostic::error(407, span, "this courtyard does not lie inside the walls").help(
        "set `start` to the courtyard's corner with the least a and the greatest b, inside the outer walls",
    )
}

/// An outer loop inside another.
#[cold]
pub(crate) fn loop_inside(span: Span) -> Diagnostic {
    Diagnostic::error(408, span, "this loop lies inside another one")
        .help("write `hole=\"yes\"` if it is a courtyard, or move it outside by `start`")
}

/// Facades that do not close.
#[cold]
pub(crate) fn ring_open(span: Span, last: Span, percent: f64, gap: f64) -> Diagnostic {
    let share = (percent * 10.0).round() / 10.0;
    let message = format!(
        "the ring of facades does not close: {} are missing, {share} % of its length",
        units(gap)
    );
    Diagnostic::error(409, span, message).label(last, "the last facade ends away from the first").help(
        "at most 1 % is spread over the ring; correct a `ratio` or an `angle` (the turns of a closed ring add up to 360)",
    )
}

/// A walk without a part.
#[cold]
pub(crate) fn no_wall(span: Span) -> Diagnostic {
    Diagnostic::error(
        410,
        span,
        "nothing is built here: the walk has no part with a width",
    )
    .help("write at least one part such as `KSK  `, or remove it")
}

/// A turn of half a circle.
#[cold]
pub(crate) fn turns_back(line: Span, next: Span) -> Diagnostic {
    Diagnostic::error(411, next, "this wall runs back along the one before")
        .label(line, "the wall before")
        .help("between two lines with parts one turn of 90 degrees is usual; a lone `R` or `L` adds another")
}

/// A walk with the house on the wrong side.
#[cold]
pub(crate) fn wrong_way_round(span: Span, hole: bool) -> Diagnostic {
    if hole {
        return Diagnostic::error(417, span, "the courtyard is walked the wrong way round")
            .help("walk a courtyard with its walls' house on the right: its corners turn left (`turn=\"L\"`)");
    }
    Diagnostic::error(412, span, "the walls run the wrong way round: the house lies on their left")
        .help("parts follow each other to the LEFT as seen from outside and corners turn right: remove the `L`s")
}

/// A plan beyond all measure.
#[cold]
pub(crate) fn too_large(line: Span, largest: f64) -> Diagnostic {
    Diagnostic::error(
        413,
        line,
        format!("this wall ends more than {largest} units from the start"),
    )
    .help("check the widths and repeats before it")
}
