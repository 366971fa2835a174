//! Messages about pent roofs.

use super::{short, written};
use hsd_base::diagnostic::Diagnostic;
use hsd_base::source::Span;
use hsd_base::text;

/// A pent roof that touches no wall.
#[cold]
pub fn pent_in_the_air(line: Span) -> Diagnostic {
    let message = text!(
        "this pent roof (HIS) touches no wall to hang on",
        "この庇 (HIS) は取り付く壁に接していません"
    );
    Diagnostic::warning(512, line, message).help(text!(
        "put one side of its rectangle on a wall line: b from 0 to -1 along the first line",
        "矩形の一辺を壁の線に重ねてください。最初の行に沿う庇なら b は 0 から -1 です"
    ))
}

/// A pent roof above the wall it hangs on.
#[cold]
pub fn pent_too_high(height: Span, upper: f64, top: f64, fitting: f64) -> Diagnostic {
    let (upper, top) = (short(upper), short(top));
    let fitting = short((fitting * 100.0).floor() / 100.0);
    let message = text!([upper, top]
        "the upper edge of this pent roof is at {upper} shaku, above the top of the walls at {top}",
        "この庇の上端は {upper} 尺で、壁の上端 ({top} 尺) より高くなっています"
    );
    let title = written(&fitting);
    Diagnostic::warning(513, height, message)
        .help(text!([fitting]
            "the height is that of the eaves edge; {fitting} or less fits this wall, depth and pitch",
            "高さは軒先の高さです。この壁と出と勾配なら {fitting} 以下にしてください"
        ))
        .fix(title, height, fitting)
}

/// A pent roof over the rooms.
#[cold]
pub fn pent_over_rooms(place: Span) -> Diagnostic {
    let message = text!(
        "this pent roof (HIS) is over the rooms instead of outside the walls",
        "この庇 (HIS) の矩形が、壁の外ではなく室内にかかっています"
    );
    Diagnostic::warning(517, place, message).help(text!(
        "its rectangle is the strip outside the wall: along a front of 6 U, `0 0 6 -1` (U, not shaku)",
        "矩形には壁の外の帯を書きます。間口 6 U の正面なら `0 0 6 -1` です (尺ではなく U)"
    ))
}

/// A pent roof that slopes towards its wall or along it.
#[cold]
pub fn pent_falls_wrong(direction: Span) -> Diagnostic {
    let message = text!(
        "this pent roof (HIS) does not slope away from the wall it hangs on",
        "この庇 (HIS) は取り付く壁から外へ流れていません"
    );
    let found = Diagnostic::warning(518, direction, message).help(text!(
        "F slopes to the front, B to the back, L to the left, R to the right; `*` follows the wall",
        "F は正面、B は背面、L は左、R は右へ流れます。`*` なら壁に合わせます"
    ));
    match direction.end - direction.start {
        1 => found.fix(written("*"), direction, "*"),
        _ => found,
    }
}

/// Pent roofs as the automatic roofs of a storey.
#[cold]
pub fn automatic_pent(shape: Span, number: u32) -> Diagnostic {
    let message = text!([number]
        "a pent roof (HIS) hangs on a wall and cannot cover a storey: storey {number} gets gable roofs",
        "庇 (HIS) は壁の外に付くもので階を覆えないため、{number}階は切妻にしました"
    );
    Diagnostic::warning(519, shape, message).help(text!(
        "write the pent roof as a roof line with its rectangle outside the wall, and another shape for the storey: KIR, or KAT for a shed roof",
        "庇は壁の外の矩形を持つ屋根の行として書き、この階には別の形を指定してください。切妻なら KIR、片流れなら KAT です"
    ))
    .fix(written("KIR"), shape, "KIR")
    .fix(written("KAT"), shape, "KAT")
}
