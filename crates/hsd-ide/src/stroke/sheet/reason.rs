//! The reasons why a wall cannot be edited in the plan: computed content is changed in the file.

use hsd_base::diagnostic::{Text, noun};

/// The reason why a stroke cannot change an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reason {
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
    /// It stands on the outline of the house.
    Outline,
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
    /// Returns its key, and the reason as a sentence, with an alternative, in English and Japanese.
    #[rustfmt::skip]
    fn words(self) -> [&'static str; 3] {
        match self {
            Reason::Include => ["include",
                "this stands in another file: open that one to change it",
                "これは別のファイルに書かれています。そのファイルを開いて変えてください"],
            Reason::Repeat => ["repeat",
                "this is written once and repeated: change it in the text, or write the repetition out there",
                "これは一度書かれて繰り返されています。テキストで変えるか、繰り返しを書き下してください"],
            Reason::Piece => ["piece",
                "this comes from a named piece that may be used elsewhere: change the piece in the text",
                "これは名前付きの部品（define）から来ています。テキストでその部品を変えてください"],
            Reason::Condition => ["condition",
                "this stands under a condition: change it in the text",
                "これは条件（if）の中に書かれています。テキストで変えてください"],
            Reason::Computed => ["computed",
                "this is computed or drawn by lot: change what it is computed from in the text",
                "これは計算か抽選で決まります。テキストでその元を変えてください"],
            Reason::Shared => ["shared",
                "other floors take their parts from this one: change it in the text",
                "他の階がこの階の部材を使っています。テキストで変えてください"],
            Reason::Borrowed => ["borrowed",
                "its parts are found by their names elsewhere: write them into this floor first",
                "部材は名前によって他から来ています。まずこの階に部材を書いてください"],
            Reason::Monument => ["monument",
                "this house is written short: change its measures in the text",
                "この建物は寸法だけで書かれています。テキストで寸法を変えてください"],
            Reason::Outline => ["outline",
                "this stands on the outline: change its points, or its `Walls`, in the text",
                "これは輪郭（Outline）の上に立っています。テキストで隅の座標か Walls を変えてください"],
            Reason::Mistakes => ["mistakes",
                "there is a mistake in this line: mend it first",
                "この行には誤りがあります。先に直してください"],
            Reason::Corner => ["corner",
                "lines without length stand at this corner: change it in the text",
                "この角には長さのない行があります。テキストで変えてください"],
            Reason::Open => ["open",
                "the walls do not close: close them in the text first",
                "壁が閉じていません。先にテキストで閉じてください"],
            Reason::Slanted => ["slanted",
                "the walls beside it are not at right angles to it: change it in the text",
                "隣の壁と直角ではありません。テキストで変えてください"],
            Reason::Scaled => ["scaled",
                "the facades have widths of their own: change `size` or `ratio` in the text",
                "立面に幅が与えられています。テキストで size か ratio を変えてください"],
            Reason::First => ["first",
                "the walk of the facades begins here: move the opposite wall instead",
                "ここは立面の起点です。反対側の壁を動かしてください"],
        }
    }

    /// Returns the key of the reason in a plan.
    pub(crate) fn key(self) -> &'static str {
        self.words()[0]
    }

    /// Returns the reason as a sentence, with an alternative.
    pub(crate) fn text(self) -> Text {
        let [_, en, ja] = self.words();
        noun(en, ja).into()
    }
}
