//! Messages about pictures and textures (HSD06xx), and about the output as a whole.

use crate::diagnostic::{Diagnostic, Noun};
use crate::source::Span;
use crate::text;

/// A part picture that was found cannot be read.
#[cold]
pub fn unreadable(span: Span, file: &str, why: &str) -> Diagnostic {
    let message = text!(
        "the picture {file:?} cannot be read: {why}",
        "画像 {file:?} を読めません: {why}"
    );
    Diagnostic::error(601, span, message).help(text!(
        "see that the file still exists and that you may read it",
        "ファイルがまだあるか、読み取りが許可されているかを確かめてください"
    ))
}

/// A file with the name of a picture that holds none.
#[cold]
pub fn no_picture(span: Span, file: &str) -> Diagnostic {
    let message = text!(
        "{file:?} is no picture in PNG or JPEG, or it is damaged",
        "{file:?} は PNG でも JPEG でもないか、壊れています"
    );
    Diagnostic::error(602, span, message).help(text!(
        "open it in a paint program and save it again as PNG; only renaming a BMP or TIFF is not enough",
        "画像ソフトで開き、PNG で保存し直してください。BMP や TIFF の名前を変えるだけでは読めません"
    ))
}

/// A part's texture of which there is no file.
#[cold]
pub fn no_texture(span: Span, name: &str) -> Diagnostic {
    let message = text!(
        "there is no picture `{name}` for this part",
        "この部材の画像 `{name}` がありません"
    );
    Diagnostic::error(604, span, message).help(text!(
        "put `{name}.png`, or `{name}.1.png`, `{name}.2.png` and so on, into the folder of the house or its `textures` folder, or name another folder by --textures",
        "`{name}.png`、または `{name}.1.png`、`{name}.2.png` … を家のテキストのフォルダーかその中の `textures` フォルダーに置くか、--textures で別のフォルダーを指定してください"
    ))
}

/// A picture that a model made before names, and that cannot be shown.
#[cold]
pub fn not_beside(span: Span, file: &str, why: Noun) -> Diagnostic {
    let message = text!(
        [why] "the picture {file:?} of this model cannot be shown: {why}",
        "このモデルの画像 {file:?} を表示できません: {why}"
    );
    Diagnostic::warning(605, span, message).help(text!(
        "put the picture where the model names it, below the folder that is shown, or build the model again without `--textures-beside`: then its pictures are in it",
        "モデルが指す場所 (表示しているフォルダーの中) に画像を置くか、`--textures-beside` を付けずに作り直して画像をモデルに含めてください"
    ))
}

/// A picture with more pixels than the limit.
#[cold]
pub fn too_many_pixels(span: Span, file: &str, pixels: u64, limit: u64) -> Diagnostic {
    let message = text!(
        "the picture {file:?} has {pixels} pixels, more than the limit of {limit}",
        "画像 {file:?} は {pixels} 画素あり、上限の {limit} 画素を超えています"
    );
    Diagnostic::error(905, span, message).help(text!(
        "make it smaller (1024 pixels a side are plenty for a part), or raise the limit with `--max-pixels`",
        "小さくするか (部材なら一辺 1024 画素で十分です)、`--max-pixels` で上限を上げてください"
    ))
}

/// A shape with numbers that no format takes.
#[cold]
pub fn shape_left_out(span: Span, name: &str) -> Diagnostic {
    let message = text!(
        "the shape of {name:?} came out broken and is left out",
        "{name:?} の形状が壊れているため、出力から除きました"
    );
    Diagnostic::warning(603, span, message).help(text!(
        "look for numbers beyond all measure here, in heights, widths or the place of the house; if there are none, the program is at fault: please report it together with this text",
        "ここの高さ、幅、家の位置に極端な数がないか確かめてください。見当たらなければプログラムの誤りです。このテキストを添えて報告してください"
    ))
}
