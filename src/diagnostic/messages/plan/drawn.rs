//! Messages about drawn plans that `hsd plan` reads (HSD12xx).

use crate::diagnostic::{Diagnostic, Noun, Text};
use crate::source::Span;
use crate::text;

/// A wall that was read with doubt; `x` and `y` are its pixels in `sheet`.
#[cold]
pub fn doubtful(span: Span, what: Noun, sheet: &str, (x, y): (i64, i64)) -> Diagnostic {
    let message = text!([what, sheet, x, y]
        "this was read as {what}, with doubt; it is drawn at {x}, {y} in {sheet}",
        "{what}と読みましたが、確かではありません（{sheet} の {x}, {y}）"
    );
    Diagnostic::warning(1201, span, message).help(text!(
        "compare the red rings of the review picture with the plan; correct the part, or delete its entry from the comment if it is right",
        "確認用の画像の赤い丸を図面と見比べ、違っていれば部材を直し、合っていれば注釈からその項目を消してください"
    ))
}

/// A gap between two walls that was closed.
#[cold]
pub fn joined(span: Span, sheet: &str, (x, y): (i64, i64)) -> Diagnostic {
    let message = text!([sheet, x, y]
        "nothing is drawn here between two walls, at {x}, {y} in {sheet}; it became an open way, so that the outline closes",
        "二つの壁の間に何も描かれていません（{sheet} の {x}, {y}）。外周を閉じるために開口としました"
    );
    Diagnostic::warning(1202, span, message).help(text!(
        "write the wall that stands there, or keep `AKI` if it is a way in",
        "そこに壁があるなら書き直し、出入り口なら `AKI` のままにしてください"
    ))
}

/// A picture without a plan that can be read, for a reason.
#[cold]
fn no_plan(span: Span, why: Text) -> Diagnostic {
    let message =
        text!([why] "there is no plan in this picture: {why}", "この画像に図面がありません。{why}");
    Diagnostic::error(1203, span, message).help(text!(
        "crop the picture to one plan; if it is one, give the length of half a ken in pixels with --unit-px, the corners of the sheet with --corners, or the legend with --legend",
        "画像を一つの平面図に切り抜いてください。平面図なら、半間の画素数を --unit-px で、紙の四隅を --corners で、凡例を --legend で指定してください"
    ))
}

/// A picture with nearly no ink; `share` is how much of it is ink.
#[cold]
pub fn blank(span: Span, share: f64) -> Diagnostic {
    let share = (share * 10_000.0).round() / 100.0;
    no_plan(
        span,
        text!([share] "only {share} % of it is ink", "インクの部分が {share} % しかありません"),
    )
}

/// A picture whose strokes keep to no grid; `share` is how far they agree with the best.
#[cold]
pub fn no_grid(span: Span, share: f64) -> Diagnostic {
    let share = (share * 100.0).round();
    no_plan(
        span,
        text!([share]
            "its strokes keep to no grid of half ken (agreement {share} %)",
            "線が半間の格子に合いません（一致 {share} %）"
        ),
    )
}

/// A picture whose strokes are those of no legend; `share` is how far they agree with the best.
#[cold]
pub fn no_symbols(span: Span, share: f64) -> Diagnostic {
    let share = (share * 100.0).round();
    no_plan(
        span,
        text!([share]
            "its strokes lie on a grid, but look like the walls of no known legend (agreement {share} %)",
            "線は格子に合いますが、どの凡例の壁にも似ていません（一致 {share} %）"
        ),
    )
}

/// A picture whose walls enclose nothing.
#[cold]
pub fn no_house(span: Span) -> Diagnostic {
    no_plan(
        span,
        text!("its walls enclose no house", "壁が家を囲んでいません"),
    )
}

/// A file that is no picture, or one that cannot be read, for a reason.
#[cold]
fn unreadable(span: Span, message: Text) -> Diagnostic {
    Diagnostic::error(1204, span, message).help(text!(
        "open it in an image editor and save it as PNG",
        "画像ソフトで開き、PNG で保存し直してください"
    ))
}

/// A file of another format.
#[cold]
pub fn no_picture(span: Span) -> Diagnostic {
    unreadable(
        span,
        text!(
            "this is no picture that can be read: not PNG, JPEG, TIFF or WebP",
            "読める画像ではありません（PNG、JPEG、TIFF、WebP のどれでもない）"
        ),
    )
}

/// A picture of too many pixels.
#[cold]
pub fn too_large(span: Span) -> Diagnostic {
    let message = text!(
        "this picture has more than 100 million pixels",
        "この画像は1億画素を超えています"
    );
    Diagnostic::error(1204, span, message).help(text!(
        "make it smaller; 60 pixels for half a ken are enough",
        "縮小してください。半間が60画素あれば足ります"
    ))
}

/// A damaged picture.
#[cold]
pub fn damaged(span: Span, why: &str) -> Diagnostic {
    unreadable(
        span,
        text!([why] "this picture is damaged: {why}", "この画像は壊れています: {why}"),
    )
}

/// A legend that cannot be read; `what` is in English, as it names elements and attributes.
#[cold]
pub fn legend(span: Span, what: &str) -> Diagnostic {
    let message = text!([what]
        "this is no legend of a plan: {what}",
        "図面の凡例として読めません: {what}"
    );
    Diagnostic::error(1205, span, message).help(text!(
        "grammar/plans.md lists the elements of a legend; `grammar/legend-survey.xml` is one to copy",
        "凡例の要素は grammar/plans.ja.md にあります。`grammar/legend-survey.xml` を写して書き換えられます"
    ))
}

/// A place that the author has changed and that is read otherwise now.
#[cold]
pub fn kept(span: Span) -> Diagnostic {
    Diagnostic::warning(1206, span, text!(
        "the plan is read otherwise here than before, but you have changed this; your change stays",
        "ここは前回と違う読みになりましたが、書き換えられているため、そのまま残しました"
    ))
    .help(text!(
        "compare it with the plan; `--force` takes the new reading everywhere",
        "図面と見比べてください。`--force` を付けると、すべて新しい読みになります"
    ))
}
