//! Walls that cross or touch: within a walk, or those of two.

use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// The walks to which two walls belong that cross or touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meeting {
    /// The same walk.
    Itself,
    /// Two courtyards.
    Courtyards,
    /// A courtyard and the walls around it.
    Courtyard,
    /// Two outlines.
    Outlines,
}

/// Two walls cross or touch.
#[cold]
pub(crate) fn walls_meet(second: Span, first: Span, crossing: bool, of: Meeting) -> Diagnostic {
    let (code, message) = match crossing {
        true => (405, message(of, true)),
        false => (406, message(of, false)),
    };
    Diagnostic::error(code, second, message)
        .label(first, text!("the other wall", "相手の壁"))
        .help(help(of))
}

fn message(of: Meeting, crossing: bool) -> Text {
    match (of, crossing) {
        (Meeting::Courtyards, true) => text!("two courtyards cross", "中庭どうしが交差しています"),
        (Meeting::Courtyards, false) => text!("two courtyards touch", "中庭どうしが接しています"),
        (Meeting::Courtyard, true) => text!(
            "a courtyard crosses the outer walls",
            "中庭が外周と交差しています"
        ),
        (Meeting::Courtyard, false) => text!(
            "a courtyard touches the outer walls",
            "中庭が外周に接しています"
        ),
        (_, true) => text!(
            "this wall crosses an earlier one",
            "この壁は前の壁と交差しています"
        ),
        (_, false) => text!(
            "this wall touches an earlier one",
            "この壁は前の壁に接しています"
        ),
    }
}

fn help(of: Meeting) -> Text {
    match of {
        Meeting::Itself => text!(
            "an outline must not touch itself: check the lengths and turns between these two lines",
            "外周は自分自身と交わることも接することもできません。この二行のあいだの長さと曲がりを確かめてください"
        ),
        Meeting::Courtyards => text!(
            "leave a part of the house between them (move one by its `start`), or write them as one courtyard",
            "あいだに建物を残すように一方の `start` を動かすか、一つの中庭として書いてください"
        ),
        Meeting::Courtyard => text!(
            "leave a part of the house around it: move it by its `start`, make it smaller, or walk the outer walls round it",
            "まわりに建物が残るように `start` を動かすか、小さくしてください。外へ開いた庭なら外周の壁で囲んでください"
        ),
        Meeting::Outlines => text!(
            "leave space between the two outlines (move one by its `start`), or write them as one",
            "二つの外周のあいだを空けるように一方の `start` を動かすか、一つの外周として書いてください"
        ),
    }
}
