//! Messages about images and textures (HSD06xx), and about the output as a whole.

use hsd_base::diagnostic::{Diagnostic, Noun};
use hsd_base::source::Span;
use hsd_base::text;

/// A part texture that was found but cannot be read.
#[cold]
pub fn unreadable(span: Span, file: &str, why: &str) -> Diagnostic {
    let message = text!([file, why]
        "the image {file:?} cannot be read: {why}",
        "画像 {file:?} を読めません: {why}"
    );
    Diagnostic::error(601, span, message).help(text!(
        "check that the file still exists and that you may read it",
        "ファイルがまだあるか、読み取りが許可されているかを確かめてください"
    ))
}

/// A file with the name of an image that is not one.
#[cold]
pub fn no_picture(span: Span, file: &str) -> Diagnostic {
    let message = text!([file]
        "{file:?} is not a PNG or JPEG image, or it is damaged",
        "{file:?} は PNG でも JPEG でもないか、壊れています"
    );
    Diagnostic::error(602, span, message).help(text!(
        "open it in an image editor and save it as PNG; renaming a BMP or TIFF is not enough",
        "画像ソフトで開き、PNG で保存し直してください。BMP や TIFF の名前を変えるだけでは読めません"
    ))
}

/// A texture of a custom part without a file.
#[cold]
pub fn no_texture(span: Span, name: &str) -> Diagnostic {
    let message = text!([name]
        "there is no texture `{name}` for this part",
        "この部材のテクスチャー `{name}` がありません"
    );
    Diagnostic::error(604, span, message).help(text!([name]
        "put `{name}.png`, or `{name}.1.png`, `{name}.2.png` and so on, into the folder of the house or its `textures` folder, or name another folder with --textures",
        "`{name}.png`、または `{name}.1.png`、`{name}.2.png` … を家のファイルのフォルダーかその中の `textures` フォルダーに置くか、--textures で別のフォルダーを指定してください"
    ))
}

/// A texture of an existing model that cannot be shown.
#[cold]
pub fn not_beside(span: Span, file: &str, why: Noun) -> Diagnostic {
    let message = text!([file, why]
        "the texture {file:?} of this model cannot be shown: {why}",
        "このモデルの画像 {file:?} を表示できません: {why}"
    );
    Diagnostic::warning(605, span, message).help(text!(
        "put the image at the path in the model, below the folder that is shown, or build the model again without `--textures-beside` to embed its textures",
        "モデルが指す場所 (表示しているフォルダーの中) に画像を置くか、`--textures-beside` を付けずに作り直して画像をモデルに含めてください"
    ))
}

/// An image with more pixels than the limit.
#[cold]
pub fn too_many_pixels(span: Span, file: &str, pixels: u64, limit: u64) -> Diagnostic {
    let message = text!([file, pixels, limit]
        "the image {file:?} has {pixels} pixels, more than the limit of {limit}",
        "画像 {file:?} は {pixels} 画素あり、上限の {limit} 画素を超えています"
    );
    Diagnostic::error(905, span, message).help(text!(
        "make it smaller (1024 pixels per side are enough for a part), or raise the limit with `--max-pixels`",
        "小さくするか (部材なら一辺 1024 画素で十分です)、`--max-pixels` で上限を上げてください"
    ))
}

/// Bodies of a model for printing that are thinner than the printer makes them.
#[cold]
pub fn thin_bodies(
    span: Span,
    (thin, all): (u64, u64),
    least: f64,
    (thinnest, name): (f64, &str),
) -> Diagnostic {
    let thinnest = format!("{thinnest:.2}");
    let message = text!([thin, all, least, thinnest, name]
        "{thin} of {all} bodies are thinner than {least} mm in the model; the thinnest, of {name:?}, has {thinnest} mm",
        "模型にすると、立体{all}個のうち{thin}個が {least} mm より薄くなります。最も薄いのは {name:?} の {thinnest} mm です"
    );
    Diagnostic::warning(606, span, message).help(text!(
        "print at a larger `--scale`, build with less `--detail`, where fine joinery is a panel as thick as `--min-wall`, or give what your printer makes with `--min-wall`",
        "`--scale` を大きくするか、`--detail` を下げるか (細かい建具は `--min-wall` の厚さの板になります)、プリンターの最小の厚さを `--min-wall` で指定してください"
    ))
}

/// A shape with numbers that no format can hold.
#[cold]
pub fn shape_left_out(span: Span, name: &str) -> Diagnostic {
    let message = text!([name]
        "the shape of {name:?} is broken and left out",
        "{name:?} の形状が壊れているため、出力から除きました"
    );
    Diagnostic::warning(603, span, message).help(text!(
        "look for extreme numbers here, in heights, widths or the place of the house; if there are none, this is a bug in hsd: please report it with this source file",
        "ここの高さ、幅、家の位置に極端な数がないか確かめてください。見当たらなければ hsd の不具合です。このファイルを添えて報告してください"
    ))
}
