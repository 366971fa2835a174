//! Messages about photographs that `hsd facade` reads (HSD13xx).

use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// A photograph without a wall, for a reason.
#[cold]
fn no_wall(span: Span, why: Text) -> Diagnostic {
    let message = text!([why] "no wall was found in this photograph: {why}", "この写真に壁面が見つかりません。{why}");
    Diagnostic::error(1301, span, message).help(text!(
        "give its four corners in pixels, clockwise from the upper left, with --corners",
        "壁面の四隅を左上から時計回りの画素で --corners に指定してください"
    ))
}

/// A photograph with few straight edges.
#[cold]
pub fn few_edges(span: Span, edges: usize) -> Diagnostic {
    no_wall(
        span,
        text!([edges] "it has only {edges} straight edges", "まっすぐな縁が {edges} 本しかありません"),
    )
}

/// A photograph whose edges are no parallels of a wall.
#[cold]
pub fn no_meeting(span: Span) -> Diagnostic {
    no_wall(
        span,
        text!(
            "its edges are not those of a wall, level and upright",
            "水平と垂直の縁が揃っていません"
        ),
    )
}

/// A photograph without four sides of a wall; `share` is how far the best are seen.
#[cold]
pub fn no_sides(span: Span, share: f64) -> Diagnostic {
    let share = (share * 100.0).round();
    no_wall(
        span,
        text!([share]
            "it has level and upright edges, but not the four sides of a wall (seen {share} %)",
            "水平と垂直の縁はありますが、壁面の四辺が揃いません（見える割合 {share} %）"
        ),
    )
}

/// A photograph that cannot be read, for a reason.
#[cold]
fn unreadable(span: Span, message: Text, help: Text) -> Diagnostic {
    Diagnostic::error(1302, span, message).help(help)
}

/// A file of another format.
#[cold]
pub fn no_picture(span: Span) -> Diagnostic {
    unreadable(
        span,
        text!(
            "this is no photograph that can be read: not PNG, JPEG, TIFF or WebP",
            "読める写真ではありません（PNG、JPEG、TIFF、WebP のどれでもない）"
        ),
        text!(
            "open it in an image editor and save it as JPEG or PNG",
            "画像ソフトで開き、JPEG か PNG で保存し直してください"
        ),
    )
}

/// A photograph of too many pixels.
#[cold]
pub fn too_large(span: Span) -> Diagnostic {
    unreadable(
        span,
        text!(
            "this photograph has more than 100 million pixels",
            "この写真は1億画素を超えています"
        ),
        text!(
            "make it smaller; 3000 pixels for the wall are enough",
            "縮小してください。壁面が3000画素あれば足ります"
        ),
    )
}

/// A damaged photograph; `why` is in English, from the reader of pictures.
#[cold]
pub fn damaged(span: Span, why: &str) -> Diagnostic {
    unreadable(
        span,
        text!([why] "this photograph is damaged: {why}", "この写真は壊れています: {why}"),
        text!(
            "copy it from the camera again",
            "カメラから取り込み直してください"
        ),
    )
}

/// Proportions that hang on a guessed lens.
#[cold]
pub fn guessed(span: Span) -> Diagnostic {
    Diagnostic::warning(1303, span, text!(
        "the proportions of this wall are a guess: neither its size nor the focal length is known",
        "壁面の縦横比は推定です。大きさも焦点距離もわかりません"
    ))
    .help(text!(
        "give width and height in metres with --size, or the focal length in pixels with --focal",
        "幅と高さをメートルで --size に、または焦点距離を画素で --focal に指定してください"
    ))
}

/// A part that is hidden and of which nothing clean is seen.
#[cold]
pub fn spoiled(span: Span, part: &str) -> Diagnostic {
    Diagnostic::warning(1304, span, text!([part]
        "something stands before {part}, and the same part is seen nowhere without it",
        "{part} は手前の物に隠れており、同じ部材が隠れずに写っている所がありません"
    ))
    .help(text!(
        "take a second photograph from another place and give both, or replace the picture of the part by hand",
        "別の場所から撮った写真を加えて指定するか、部材の画像を手で差し替えてください"
    ))
}

/// A wall on which nothing repeats.
#[cold]
pub fn no_lattice(span: Span) -> Diagnostic {
    Diagnostic::warning(1305, span, text!(
        "nothing repeats on this wall, so it is not cut into bays and storeys",
        "この壁面には繰り返しがなく、柱間や階に分けていません"
    ))
    .help(text!(
        "give the number of bays and storeys with --grid, or lines in metres with --columns and --rows",
        "柱間と階の数を --grid に、または境目をメートルで --columns と --rows に指定してください"
    ))
}

/// A lattice that a wall cannot have; `most` is the largest number of places.
#[cold]
pub fn lattice(span: Span, most: usize) -> Diagnostic {
    Diagnostic::error(1306, span, text!([most]
        "the lines of this lattice lie beyond the wall or on each other, or it has more than {most} places",
        "格子の境目が壁面の外にあるか重なっているか、区画が {most} を超えています"
    ))
    .help(text!(
        "give lines between 0 and the size of the wall, in metres, or fewer bays and storeys",
        "境目は 0 と壁面の大きさの間のメートルで指定するか、柱間と階の数を減らしてください"
    ))
}
