//! Messages about walls, outlines and storeys (HSD04xx).

mod closing;
mod meeting;
mod purpose;
pub(crate) mod fixtures;
pub(crate) mod rooms;

pub(crate) use closing::ClosingFix;
pub(crate) use meeting::{Meeting, walls_meet};
pub use purpose::no_use;

use closing::{change, closing, gap_words};
use glam::DVec2;
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Edit, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// A number of units without needless decimals.
pub(super) fn units(n: f64) -> Text {
    let n = (n * 1000.0).round() / 1000.0;
    text!([n] "{n} U", "{n} U")
}

/// The walk ends beside its start; `axes` are the lines that could change, for each direction of the gap.
#[cold]
pub(crate) fn open_perimeter(last: Span, gap: DVec2, axes: &[Vec<ClosingFix>]) -> Diagnostic {
    let away = gap_words(gap);
    let message = text!([away]
        "the walls do not close: they end {away} of their start",
        "外周が閉じていません。壁の終点が始点から{away} ずれています"
    );
    let mut diagnostic = Diagnostic::error(401, last, message);
    let mut advice = vec![];
    for fix in axes.iter().flatten() {
        let (line, words) = change(fix);
        advice.push(line);
        if fix.line != last {
            diagnostic = diagnostic.label(
                fix.line,
                text!([words] "{words} here would close them", "ここを {words}すると閉じます"),
            );
        }
    }
    let both = gap.x.abs() > hsd_base::geometry::SAME && gap.y.abs() > hsd_base::geometry::SAME;
    let none = advice.is_empty();
    let lines = Text::joined(advice, ", or ", "、または");
    let diagnostic = closing(diagnostic, axes);
    diagnostic.help(if none {
        text!(
            "lengthen or shorten a line in the direction of the gap",
            "ずれの方向に延びる行を長くするか短くしてください"
        )
    } else if both {
        text!([lines]
            "change one line for each direction: make {lines}",
            "それぞれの方向で行をひとつ直します。{lines}してください"
        )
    } else {
        text!([lines] "make {lines}", "{lines}してください")
    })
}

/// The walk is back at its start but turned too often or too seldom.
#[cold]
pub(crate) fn wrong_turns(span: Span, missing: f64) -> Diagnostic {
    let closing = 1.0;
    let n = ((missing - closing) / 2.0).round();
    let count = n.abs().max(1.0);
    let (message, help) = if missing > 0.0 {
        (
            text!([count]
                "the turns do not make one full circle: about {count} too many to the left",
                "曲がりの合計がちょうど一周になっていません。左折がおよそ{count}回多すぎます"
            ),
            text!(
                "a closed storey has four right turns more than left turns; look for an `L` that should not be there",
                "閉じた階では右折が左折より四回多くなります。余分な `L` がないか調べてください"
            ),
        )
    } else {
        (
            text!([count]
                "the turns do not make one full circle: about {count} too many to the right",
                "曲がりの合計がちょうど一周になっていません。右折がおよそ{count}回多すぎます"
            ),
            text!(
                "a closed storey has four right turns more than left turns; look for a line end (right turn) without its `L` that should not be there",
                "閉じた階では右折が左折より四回多くなります。`L` を書き忘れた行末 (右折になります) がないか調べてください"
            ),
        )
    };
    Diagnostic::error(402, span, message).help(help)
}

/// A walk may be open on purpose; what would close it is only a warning then.
fn graded(open: bool) -> fn(u16, Span, Text) -> Diagnostic {
    if open {
        Diagnostic::warning
    } else {
        Diagnostic::error
    }
}

/// The diagnostic with a fix, if there is one.
fn offering(found: Diagnostic, title: Text, fix: Vec<Edit>) -> Diagnostic {
    match fix.is_empty() {
        true => found,
        false => found.fix_all(title, fix),
    }
}

/// One line end turned the other way would close the walk.
#[cold]
pub(crate) fn turn_to_flip(line: Span, is_left: bool, open: bool, fix: Option<Edit>) -> Diagnostic {
    let (message, help) = if is_left {
        (
            text!(
                "one `L` too many: the walls do not close",
                "`L` がひとつ多く、外周が閉じません"
            ),
            text!(
                "remove the `L` at the end of this line: with that turn to the right the walls close exactly",
                "この行の末尾の `L` を削除してください。ここを右折にすると外周がちょうど閉じます"
            ),
        )
    } else {
        (
            text!(
                "an `L` is missing: the walls do not close",
                "`L` がひとつ足りず、外周が閉じません"
            ),
            text!(
                "write `L` at the end of this line: with that turn to the left the walls close exactly",
                "この行の末尾に `L` と書いてください。ここを左折にすると外周がちょうど閉じます"
            ),
        )
    };
    let title = if is_left {
        text!("Remove the `L`", "`L` を削除する")
    } else {
        text!("Write `L` at the end of the line", "行末に `L` と書く")
    };
    offering(
        graded(open)(403, line, message).help(help),
        title,
        fix.into_iter().collect(),
    )
}

/// An `L` that stands one line too early or too late.
#[cold]
pub(crate) fn turn_to_move(
    line: Span,
    next: Span,
    is_left: bool,
    open: bool,
    fix: Vec<Edit>,
) -> Diagnostic {
    let (here, there, help) = if is_left {
        let help = text!(
            "move the `L` from the end of this line to the end of the next one",
            "`L` をこの行の末尾から次の行の末尾へ移してください"
        );
        (line, next, help)
    } else {
        let help = text!(
            "move the `L` from the end of this line to the end of the previous one",
            "`L` をこの行の末尾から前の行の末尾へ移してください"
        );
        (next, line, help)
    };
    let message = text!(
        "the `L` is at the wrong line: the walls do not close",
        "`L` のある行が違うため、外周が閉じません"
    );
    let label = text!(
        "with the `L` here the walls close exactly",
        "`L` がここにあれば外周がちょうど閉じます"
    );
    let found = graded(open)(418, here, message)
        .label(there, label)
        .help(help);
    offering(found, text!("Move the `L`", "`L` を移す"), fix)
}

/// A facade that stands alone.
#[cold]
pub(crate) fn open_facade(span: Span, gap: DVec2) -> Diagnostic {
    let away = gap_words(gap);
    let message = text!([away]
        "an open facade: the walls end {away} of their start",
        "閉じていない壁面です。壁の終点が始点から{away} 離れています"
    );
    Diagnostic::note(404, span, message).help(text!(
        "it gets no roof; to make it a house, continue until the walls close",
        "屋根は架かりません。家にするには、外周が閉じるまで壁を続けてください"
    ))
}

/// A courtyard outside the walls.
#[cold]
pub(crate) fn hole_outside(span: Span) -> Diagnostic {
    let message = text!(
        "this courtyard is not inside the walls",
        "この中庭は外周の内側にありません"
    );
    Diagnostic::error(407, span, message).help(text!(
        "set `start` to the courtyard's corner with the least a and the greatest b, inside the outer walls",
        "`start` には、外周の内側で、中庭の a が最も小さく b が最も大きい隅を書いてください"
    ))
}

/// An outer loop inside another.
#[cold]
pub(crate) fn loop_inside(span: Span) -> Diagnostic {
    let message = text!(
        "this loop is inside another one",
        "この外周は別の外周の内側にあります"
    );
    Diagnostic::error(408, span, message).help(text!(
        "write `hole=\"yes\"` if it is a courtyard, or move it outside by `start`",
        "中庭なら `hole=\"yes\"` と書き、そうでなければ `start` で外へ移してください"
    ))
}

/// Facades that do not close.
#[cold]
pub(crate) fn ring_open(span: Span, last: Span, percent: f64, gap: f64) -> Diagnostic {
    let share = (percent * 10.0).round() / 10.0;
    let missing = units(gap);
    let message = text!([missing, share]
        "the ring of facades does not close: a gap of {missing} remains, {share} % of its length",
        "壁面が一周して閉じていません。{missing} (全長の {share} %) ずれています"
    );
    let label = text!(
        "the last facade does not reach the first",
        "最後の壁面が最初の壁面に届いていません"
    );
    Diagnostic::error(409, span, message)
        .label(last, label)
        .help(text!(
            "only up to 1 % is distributed over the ring; correct a `ratio` or an `angle` (the turns of a closed ring add up to 360)",
            "全体に割り振るのは 1 % までで、ずれがこれを超えています。`ratio` か `angle` を直してください (閉じた一周の曲がりの和は 360 度です)"
        ))
}

/// Files whose houses stand at the same place, and are put side by side.
#[cold]
pub fn side_by_side(second: Span, files: usize) -> Diagnostic {
    let message = text!([files]
        "{files} files do not say where their houses stand, so these are put side by side",
        "{files}個のファイルに建物の位置が書かれていないため、並べて置きました"
    );
    Diagnostic::note(431, second, message).help(text!(
        "give each house its place: `x` and `y` in metres, or the first two numbers of the legacy form",
        "建物ごとに位置を書いてください。`x` と `y`(メートル)、旧形式では最初の二つの数値です"
    ))
}

/// Facades whose angles are those between the walls; `turn` is one of them.
#[cold]
pub(crate) fn interior_angles(span: Span, turn: f64) -> Diagnostic {
    let [written, meant] = [turn, 180.0 - turn].map(|a| (a * 1000.0).round() / 1000.0);
    let message = text!(
        "the angles of the facades are those between the walls: read so, the ring closes",
        "壁面の角度が壁と壁の間の角度になっています。そう読めば一周が閉じます"
    );
    Diagnostic::error(429, span, message).help(text!([written, meant]
        "`angle` is the turn from one facade to the next: write 180 minus the angle between them, such as `{meant}` for `{written}`",
        "`angle` は前の壁面からの曲がりです。180 から壁の間の角度を引いた値を書いてください（`{written}` なら `{meant}`）"
    ))
}

/// Voids before the first part that were meant as an open bay.
#[cold]
pub(crate) fn void_moves_start(void: Span, by: f64) -> Diagnostic {
    let by = units(by);
    let message = text!([by]
        "a void at the beginning of the first line is no open bay: it moves the start by {by}",
        "最初の行の頭にある空きは開口ではなく、始点を {by} 動かします"
    );
    Diagnostic::error(430, void, message).help(text!(
        "write `AKI  ` in its place for an open bay, or delete it if the walls begin there",
        "開口にするなら空きの代わりに `AKI  ` と書き、そこから壁が始まるなら空きを消してください"
    ))
}

/// A first line of voids on a ground floor that closes without them.
#[cold]
pub(crate) fn voids_before_front(void: Span, by: f64) -> Diagnostic {
    let by = units(by);
    let message = text!([by]
        "the first line is only voids: it moves the start by {by} and turns, so the next line is a side of the house, not its front",
        "最初の行は空きだけです。始点を {by} 動かして曲がるので、次の行は正面ではなく側面になります"
    );
    Diagnostic::note(430, void, message).help(text!(
        "for an open front write `AKI  ` instead of each void; if the walls begin at the next line, delete this one",
        "正面を開けるなら空きの代わりに `AKI  ` と書き、次の行から壁が始まるならこの行を消してください"
    ))
}

/// A walk without a part.
#[cold]
pub(crate) fn no_wall(span: Span) -> Diagnostic {
    let message = text!(
        "nothing is built here: the walk has no part with a width",
        "幅のある部材がないため、ここには何もできません"
    );
    Diagnostic::error(410, span, message).help(text!(
        "write at least one part such as `KSK  `, or remove it",
        "`KSK  ` のような部材を少なくともひとつ書くか、削除してください"
    ))
}

/// A turn of half a circle.
#[cold]
pub(crate) fn turns_back(line: Span, next: Span) -> Diagnostic {
    let message = text!(
        "this wall runs back along the previous one",
        "この壁は直前の壁に沿って折り返しています"
    );
    Diagnostic::error(411, next, message)
        .label(line, text!("the previous wall", "直前の壁"))
        .help(text!(
            "between two lines with parts there is usually one turn of 90 degrees; a line with `R` or `L` alone adds another",
            "部材のある二行のあいだの曲がりはふつう 90 度一回です。`R` や `L` だけの行は、もう一回曲げます"
        ))
}

/// A walk with the house on the wrong side.
#[cold]
pub(crate) fn wrong_way_round(span: Span, hole: bool, fix: Vec<Edit>) -> Diagnostic {
    if hole {
        let message = text!(
            "the walls of this courtyard run the wrong way round",
            "中庭を回る向きが逆です"
        );
        return Diagnostic::error(417, span, message).help(text!(
            "the walls of a courtyard run with the house on their right: turn left at its corners (`turn=\"L\"`)",
            "中庭は家を右に見て回ります。隅は左折 (`turn=\"L\"`) にしてください"
        ));
    }
    let message = text!(
        "the walls run the wrong way round: the house lies on their left",
        "外周を回る向きが逆です。家が進行方向の左側にあります"
    );
    let found = Diagnostic::error(412, span, message).help(text!(
        "parts are written from right to left as seen from outside, and corners turn right: remove the `L`s",
        "部材は外から見て左へ並び、隅では右折します。`L` を削除してください"
    ));
    offering(
        found,
        text!(
            "Turn the other way at each corner",
            "すべての隅を逆に曲げる"
        ),
        fix,
    )
}

/// A plan that is too large.
#[cold]
pub(crate) fn too_large(line: Span, largest: f64) -> Diagnostic {
    let message = text!([largest]
        "this wall ends more than {largest} U from the start",
        "この壁の終点は始点から {largest} U より遠くにあります"
    );
    Diagnostic::error(413, line, message).help(text!(
        "check the widths and repeats before it",
        "これより前の幅と繰り返しを確かめてください"
    ))
}

/// Two houses that stand in each other: the later one first, each with where it is written or placed and its name.
#[cold]
pub fn in_each_other(spans: [Span; 2], names: [&str; 2], shared: f64) -> Diagnostic {
    let shared = (shared * 10.0).round() / 10.0;
    let [(one, own), (other, there)] = called(names);
    let own = own.trim_start();
    let message = text!([one, own, other, there, shared]
        "{one} and {other} stand in each other over {shared} m2",
        "{own}は{there}と {shared} m2 重なっています"
    );
    let found = Diagnostic::warning(420, spans[0], message).help(text!(
        "give one of them another `x` and `y` (metres); in the legacy form they are the first two numbers of the header",
        "どちらかの `x` と `y` (m) を変えてください。旧形式では見出しの最初の二つの数です"
    ));
    match spans[0] == spans[1] {
        true => found,
        false => found.label(spans[1], text!("the other one", "もう一方の建物")),
    }
}

/// A wall or corridor that ends a little before another house; the gap in metres.
#[cold]
pub fn gap_in_wall(spans: [Span; 2], names: [&str; 2], gap: f64) -> Diagnostic {
    let gap = (gap * 100.0).round() / 100.0;
    let [(one, own), (other, there)] = called(names);
    let own = own.trim_start();
    let message = text!([one, own, other, there, gap]
        "{one} ends {gap} m before {other}: there is a gap in the wall",
        "{own}は{there}の {gap} m 手前で終わり、隙間が空いています"
    );
    let found = Diagnostic::note(437, spans[0], message).help(text!(
        "lengthen it, or move one of them (`x`, `y` in metres), until they touch; a gap of a metre or more is a passage",
        "延ばすか、どちらかの `x` と `y` (m) を変えて接するようにしてください。1 m 以上空ければ通路とみなします"
    ));
    match spans[0] == spans[1] {
        true => found,
        false => found.label(spans[1], text!("the other one", "もう一方の建物")),
    }
}

/// Returns how two houses are called in both languages.
fn called(names: [&str; 2]) -> [(String, String); 2] {
    let called = |name: &str, en, ja: &str| match name {
        "" => (String::from(en), ja.to_owned()),
        name => (quote(name), format!(" {} ", quote(name))),
    };
    [
        called(names[0], "this house", "この建物"),
        called(names[1], "another one", "別の建物"),
    ]
}

/// A ring that was squared: its largest angle to a right one, degrees, and the farthest move of a corner, metres.
#[cold]
pub fn squared(wall: Span, angle: f64, farthest: f64) -> Diagnostic {
    let angle = (angle * 1000.0).ceil() / 1000.0;
    let moved = (farthest * 1000.0).ceil();
    let message = text!([angle, moved]
        "the walls miss right angles by up to {angle} degrees; the plan is squared, and corners move by up to {moved} mm",
        "壁が直角から最大 {angle} 度ずれています。平面を直角に直し、隅は最大 {moved} mm 動きます"
    );
    Diagnostic::note(419, wall, message).help(text!(
        "write right angles (`turn=\"R\"`, `angle=\"90\"`), or an angle of more than a degree if it is meant",
        "直角なら `turn=\"R\"` や `angle=\"90\"` と、わざと斜めにするなら一度より大きい角度を書いてください"
    ))
}
