//! The reasons why a wall cannot be edited in the plan: computed content is changed in the file.

use crate::diagnostic::Text;
use crate::text;

/// The reason why a stroke cannot change an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::ide) enum Reason {
    /// It is in another file.
    Include,
    /// It is in a `repeat`.
    Repeat,
    /// It is in a `define`, or comes from one.
    Piece,
    /// It is in an `if`.
    Condition,
    /// It is made by an expression, a random choice or a substitution.
    Computed,
    /// Another facade or floor uses its parts.
    Shared,
    /// Its parts come from images or from another floor.
    Borrowed,
    /// The house is a monument.
    Monument,
    /// The line has syntax errors.
    Mistakes,
    /// Lines without length stand between its walls.
    Corner,
    /// The walls do not close.
    Open,
    /// The walls beside it are not at right angles to it.
    Slanted,
    /// The facades have widths of their own.
    Scaled,
    /// It is where the walk of the facades begins.
    First,
}

impl Reason {
    /// Returns the key of the reason in a plan.
    pub(in crate::ide) fn key(self) -> &'static str {
        match self {
            Reason::Include => "include",
            Reason::Repeat => "repeat",
            Reason::Piece => "piece",
            Reason::Condition => "condition",
            Reason::Computed => "computed",
            Reason::Shared => "shared",
            Reason::Borrowed => "borrowed",
            Reason::Monument => "monument",
            Reason::Mistakes => "mistakes",
            Reason::Corner => "corner",
            Reason::Open => "open",
            Reason::Slanted => "slanted",
            Reason::Scaled => "scaled",
            Reason::First => "first",
        }
    }

    /// Returns the reason as a sentence, with an alternative.
    pub(in crate::ide) fn text(self) -> Text {
        match self {
            Reason::Include => text!(
                "this stands in another file: open that one to change it",
                "これは別のファイルに書かれています。そのファイルを開いて変えてください"
            ),
            Reason::Repeat => text!(
                "this is written once and repeated: change it in the text, or write the repetition out there",
                "これは一度書かれて繰り返されています。テキストで変えるか、繰り返しを書き下してください"
            ),
            Reason::Piece => text!(
                "this comes from a named piece that may be used elsewhere: change the piece in the text",
                "これは名前付きの部品（define）から来ています。テキストでその部品を変えてください"
            ),
            Reason::Condition => text!(
                "this stands under a condition: change it in the text",
                "これは条件（if）の中に書かれています。テキストで変えてください"
            ),
            Reason::Computed => text!(
                "this is computed or drawn by lot: change what it is computed from in the text",
                "これは計算か抽選で決まります。テキストでその元を変えてください"
            ),
            Reason::Shared => text!(
                "other floors take their parts from this one: change it in the text",
                "他の階がこの階の部材を使っています。テキストで変えてください"
            ),
            Reason::Borrowed => text!(
                "its parts are found by their names elsewhere: write them into this floor first",
                "部材は名前によって他から来ています。まずこの階に部材を書いてください"
            ),
            Reason::Monument => text!(
                "this house is written short: change its measures in the text",
                "この建物は寸法だけで書かれています。テキストで寸法を変えてください"
            ),
            Reason::Mistakes => text!(
                "there is a mistake in this line: mend it first",
                "この行には誤りがあります。先に直してください"
            ),
            Reason::Corner => text!(
                "lines without length stand at this corner: change it in the text",
                "この角には長さのない行があります。テキストで変えてください"
            ),
            Reason::Open => text!(
                "the walls do not close: close them in the text first",
                "壁が閉じていません。先にテキストで閉じてください"
            ),
            Reason::Slanted => text!(
                "the walls beside it are not at right angles to it: change it in the text",
                "隣の壁と直角ではありません。テキストで変えてください"
            ),
            Reason::Scaled => text!(
                "the facades have widths of their own: change `size` or `ratio` in the text",
                "立面に幅が与えられています。テキストで size か ratio を変えてください"
            ),
            Reason::First => text!(
                "the walk of the facades begins here: move the opposite wall instead",
                "ここは立面の起点です。反対側の壁を動かしてください"
            ),
        }
    }
}
