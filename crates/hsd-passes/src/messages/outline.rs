//! Outlines as surveyed, and what stands on their sides.

use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Millimetres of a length in metres, rounded up; what lies beyond by less than a micrometre is rounding.
fn millimetres(length: f64) -> f64 {
    (length * 1000.0 - 1e-3).ceil()
}

/// An outline whose walls were made square, and put on common lines: the farthest moves, metres.
#[cold]
pub fn squared(points: Span, squared: f64, joined: f64) -> Diagnostic {
    let (squared, joined) = (millimetres(squared), millimetres(joined));
    let message = match (squared > 1.0, joined > 1.0) {
        (true, true) => text!([squared, joined]
            "the outline is squared, corners moving by up to {squared} mm, and walls nearly in line are put on one, moving by up to {joined} mm",
            "輪郭を直角に直し(隅は最大 {squared} mm 動きます)、ほぼ一直線に並ぶ壁を揃えました(壁は最大 {joined} mm 動きます)"
        ),
        (false, true) => text!([joined]
            "walls nearly in line are put on one, moving by up to {joined} mm",
            "ほぼ一直線に並ぶ壁を揃えました。壁は最大 {joined} mm 動きます"
        ),
        _ => text!([squared]
            "the outline is squared; corners move by up to {squared} mm",
            "輪郭を直角に直しました。隅は最大 {squared} mm 動きます"
        ),
    };
    Diagnostic::note(421, points, message).help(text!(
        "to keep the walls where they are, write `square=\"no\"`, and `join=\"0\"`",
        "壁を動かしたくなければ `square=\"no\"` と `join=\"0\"` を書いてください"
    ))
}

/// A side that slants too much for the outline to be squared: its angle and the greatest that would do, degrees. If the
/// other walls are squared, how far corners moved for that, metres.
#[cold]
pub fn slants(
    side: Span,
    number: usize,
    (angle, most): (f64, f64),
    moved: Option<f64>,
) -> Diagnostic {
    let angle = angle.round();
    let message = match moved.map(millimetres) {
        None => text!([number, angle]
            "the outline is not squared: side {number} slants by {angle} degrees",
            "辺 {number} が {angle} 度傾いているため、輪郭を直角に直していません"
        ),
        Some(moved) if moved <= 1.0 => text!([number, angle]
            "the outline is not square as a whole: side {number} slants by {angle} degrees",
            "辺 {number} が {angle} 度傾いているため、輪郭は全体としては直角ではありません"
        ),
        Some(moved) => text!([number, angle, moved]
            "the outline is not squared as a whole: side {number} slants by {angle} degrees; where it does not slant it is squared, corners moving by up to {moved} mm",
            "辺 {number} が {angle} 度傾いているため、輪郭全体は直角に直していません。傾いていない壁だけを直しました(隅は最大 {moved} mm 動きます)"
        ),
    };
    let keep = match moved.is_some_and(|m| millimetres(m) > 1.0) {
        true => text!(
            "; `square=\"no\"` keeps the walls where they are",
            "。壁を動かしたくなければ `square=\"no\"` と書いてください"
        ),
        false => Text::default(),
    };
    Diagnostic::note(422, side, message).help(text!([most, keep]
        "roofs are divided into rectangles where every side lies within {most} degrees of right angles; divide the house, or keep the hip roof{keep}",
        "すべての辺が直角から {most} 度以内なら、屋根を矩形に分けて架けます。建物を分けるか、このまま寄棟にしてください{keep}"
    ))
}

/// A corner that would move too far for the outline to be squared.
#[cold]
pub fn moves(corner: Span, number: usize, moved: f64, most: f64) -> Diagnostic {
    let (moved, most) = (millimetres(moved), millimetres(most));
    let message = text!([number, moved, most]
        "the outline is not squared: corner {number} would move by {moved} mm, more than {most} mm",
        "隅 {number} が {moved} mm 動くことになり、{most} mm を超えるため、輪郭を直角に直していません"
    );
    Diagnostic::note(422, corner, message).help(text!([moved]
        "allow it with `square` if the survey is that rough: {moved} mm or more",
        "測量がそれほど粗いなら、`square` に {moved} mm 以上を書いてください"
    ))
}

/// An outline whose walls would cross if they were squared.
#[cold]
pub fn would_cross(points: Span) -> Diagnostic {
    let message = text!(
        "the outline is not squared: its walls would cross or touch",
        "壁が交わるか接してしまうため、輪郭を直角に直していません"
    );
    Diagnostic::note(422, points, message).help(text!(
        "check the corners for narrow gaps, or divide the house",
        "狭い隙間がないか隅を確かめるか、建物を分けてください"
    ))
}

/// Points that are no corners, and were removed.
#[cold]
pub fn cleaned(points: Span, doubled: usize, spikes: usize) -> Diagnostic {
    let message = if spikes == 0 {
        text!([doubled]
            "{doubled} corners stand on others and are left out",
            "ほかの隅と重なる隅を{doubled}個除きました"
        )
    } else if doubled == 0 {
        text!([spikes]
            "{spikes} corners to which a wall goes and comes back are left out",
            "壁が行って戻るだけの隅を{spikes}個除きました"
        )
    } else {
        text!([doubled, spikes]
            "{doubled} corners that stand on others, and {spikes} to which a wall goes and comes back, are left out",
            "ほかの隅と重なる隅を{doubled}個、壁が行って戻るだけの隅を{spikes}個除きました"
        )
    };
    Diagnostic::note(423, points, message).help(text!(
        "nothing needs to change; numbers of sides count all corners as written",
        "このままでかまいません。辺の番号は書いたとおりの隅で数えます"
    ))
}

/// An outline or a courtyard without an area, or hardly any. Degrees of longitude and latitude are the usual reason.
#[cold]
pub fn no_area(points: Span, degrees: bool) -> Diagnostic {
    let message = match degrees {
        true => text!(
            "this outline is less than half a metre wide",
            "この輪郭の幅は 50 cm もありません"
        ),
        false => text!(
            "these corners enclose no area",
            "これらの隅は面を囲んでいません"
        ),
    };
    Diagnostic::error(424, points, message).help(match degrees {
        true => text!(
            "they look like degrees of longitude and latitude; give metres east and north",
            "経度と緯度のようです。東へ、北へのメートルで書いてください"
        ),
        false => text!(
            "give at least three corners that are not in line, such as `0 0, 9.5 0, 9.5 6, 0 6`",
            "一直線に並ばない三つ以上の隅を `0 0, 9.5 0, 9.5 6, 0 6` のように書いてください"
        ),
    })
}

/// A number of a side that the outline does not have.
#[cold]
pub fn no_such_side(span: Span, number: u32, sides: usize) -> Diagnostic {
    let message = text!([number, sides]
        "there is no side {number}; the outline has {sides}",
        "辺 {number} はありません。輪郭の辺は{sides}本です"
    );
    Diagnostic::error(425, span, message).help(text!(
        "side 1 runs from the first corner to the second",
        "辺 1 は最初の隅から次の隅までです"
    ))
}

/// A side that is too short for the parts written for it.
#[cold]
pub fn side_too_short(wall: Span, number: usize, length: f64, needed: f64) -> Diagnostic {
    let [length, needed] = [length, needed].map(|l| (l * 100.0).round() / 100.0);
    let message = text!([number, length, needed]
        "side {number} is {length} U long, but these parts need {needed} U; a plain wall stands there",
        "辺 {number} は {length} U ですが、これらの部材には {needed} U 要ります。代わりに無地の壁を置きます"
    );
    Diagnostic::warning(426, wall, message).help(text!(
        "put the parts that may be missing into `fill`, or choose narrower ones",
        "無くてもよい部材を `fill` に入れるか、幅の狭い部材を選んでください"
    ))
}

/// Walls of an outline that the house does not have.
#[cold]
pub fn walls_without_outline(walls: Span) -> Diagnostic {
    let message = text!(
        "this house has no outline on whose sides these walls could stand",
        "この建物には、壁を立てる輪郭がありません"
    );
    Diagnostic::error(427, walls, message).help(text!(
        "write `<Outline points=\"0 0, 9.5 0, 9.5 6, 0 6\"/>` in the house, or `Row`s in this storey",
        "建物に `<Outline points=\"0 0, 9.5 0, 9.5 6, 0 6\"/>` を書くか、この階に `Row` を書いてください"
    ))
}

/// Walls on a part of the outline in which nothing lies.
#[cold]
pub fn nothing_there(walls: Span) -> Diagnostic {
    let message = text!(
        "no part of the outline lies there, so this storey stands on the whole outline",
        "そこには輪郭がないため、この階は輪郭全体の上に立てます"
    );
    Diagnostic::warning(1144, walls, message).help(text!(
        "set larger shares in `long` and `short`, or move the part with `at`: 0 is the front or the right end, 1 the other",
        "`long` と `short` の割合を大きくするか、`at` で位置を動かしてください。0 は正面側か右端、1 は反対側です"
    ))
}

/// A storey that has rows of its own besides the walls of the outline.
#[cold]
pub fn rows_and_walls(walls: Span, rows: Span) -> Diagnostic {
    let message = text!(
        "this storey has rows of its own, so these walls of the outline are not built",
        "この階には行があるため、輪郭の壁は作りません"
    );
    Diagnostic::error(428, walls, message)
        .help(text!(
            "keep the rows or the walls",
            "行と輪郭の壁の、どちらかだけを書いてください"
        ))
        .label(rows, text!("the rows are here", "行はここです"))
}
