//! Messages of `hsd fmt` (HSD08xx).

use crate::diagnostic::{Diagnostic, Text};
use crate::source::Span;
use crate::text;

/// What the legacy form is called.
pub fn legacy_form() -> Text {
    text!("legacy text", "従来形式")
}

/// What the XML form is called.
pub fn xml_form() -> Text {
    text!("XML", "XML ")
}

/// A layout that would not say the same: a fault of ours, and no harm is done.
#[cold]
pub fn left_alone(span: Span) -> Diagnostic {
    let message = text!(
        "the text is left as it is: laid out, it would not say the same",
        "整形すると意味が変わるため、テキストをそのままにしました"
    );
    Diagnostic::error(801, span, message).help(text!(
        "this is a fault of hsd; please report it, with the text",
        "hsd の誤りです。テキストを添えて報告してください"
    ))
}

/// The other form would say something else.
#[cold]
pub fn not_the_same(span: Span, form: Text) -> Diagnostic {
    let message = text!(
        [form]
        "written as {form}, this file would make another building",
        "{form}で書くと、このファイルは別の建物になります"
    );
    Diagnostic::error(802, span, message).help(text!("something in it is beyond what that form takes: a number out of its bounds, a roof that falls where its shape has a ridge, a picture whose name reads as a control letter", "その形式で書けないものがあります。範囲外の数値、棟のある形なのに流れ方向を持つ屋根、制御文字と読まれる画像の名前などです"))
}

/// A draw: the legacy form has none.
#[cold]
pub fn draw(span: Span, codes: &str) -> Diagnostic {
    let message = text!(
        "the legacy form cannot draw one of {codes}",
        "従来形式では {codes} から抽選できません"
    );
    Diagnostic::error(803, span, message).help(text!(
        "put the part in its place that is to stand there, or keep the file in XML",
        "そこに置く部材を一つ書くか、XML のままにしてください"
    ))
}

/// A part divided above and below.
#[cold]
pub fn split(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot divide a part above and below",
        "従来形式では部材を上下に分けられません"
    );
    Diagnostic::error(804, span, message).help(text!(
        "put a part of full height in its place, or keep the file in XML",
        "階の高さいっぱいの部材に替えるか、XML のままにしてください"
    ))
}

/// A courtyard, or a second walk in a storey.
#[cold]
pub fn second_walk(span: Span) -> Diagnostic {
    let message = text!(
        "a storey of the legacy form is one walk round the outside",
        "従来形式の階は、外周を一回りする壁だけです"
    );
    Diagnostic::error(805, span, message).help(text!(
        "courtyards and wings that stand apart need XML; wings may be houses of their own",
        "中庭や離れた棟には XML が必要です。離れた棟は別の家として書けます"
    ))
}

/// A turn that is no right angle.
#[cold]
pub fn odd_turn(span: Span, degrees: f64) -> Diagnostic {
    let message = text!(
        "the legacy form turns by 90 degrees only, not by {degrees}",
        "従来形式で曲がれるのは 90 度だけで、{degrees} 度は書けません"
    );
    Diagnostic::error(806, span, message).help(text!(
        "make it a right angle, `turn=\"R\"` or `turn=\"L\"`, or keep the file in XML",
        "直角 (`turn=\"R\"` か `turn=\"L\"`) にするか、XML のままにしてください"
    ))
}

/// Walls given facade by facade.
#[cold]
pub fn facades(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no facades: their parts are scaled to a width, codes are not",
        "従来形式に立面はありません。立面の部材は幅に合わせて伸び縮みしますが、部材コードは伸び縮みしません"
    );
    Diagnostic::error(807, span, message).help(text!(
        "write the walls as rows of a `Storey`, or keep the file in XML",
        "壁を `Storey` の行として書くか、XML のままにしてください"
    ))
}

/// A part with a width of its own.
#[cold]
pub fn own_width(span: Span, code: &str, width: f64, usual: f64) -> Diagnostic {
    let message = text!(
        "in the legacy form `{code}` is {usual} wide, not {width}",
        "従来形式の `{code}` の幅は {usual} で、{width} にはできません"
    );
    Diagnostic::error(808, span, message).help(text!(
        "take a part of that width (`hsd parts` lists them), or keep the file in XML",
        "その幅の部材 (`hsd parts` で一覧できます) を使うか、XML のままにしてください"
    ))
}

/// A part with a height of its own.
#[cold]
pub fn own_height(span: Span, code: &str) -> Diagnostic {
    let message = text!(
        "the legacy form cannot say how high this `{code}` is",
        "従来形式では `{code}` の高さを書けません"
    );
    Diagnostic::error(809, span, message).help(text!(
        "parts are as high as their storey there; leave the height out, or keep the file in XML",
        "従来形式の部材は階と同じ高さです。高さを消すか、XML のままにしてください"
    ))
}

/// The name of a picture that is no code.
#[cold]
pub fn long_name(span: Span, name: &str) -> Diagnostic {
    let message = text!(
        "{name:?} is no code of five columns",
        "{name:?} は 5 桁の部材コードではありません"
    );
    Diagnostic::error(810, span, message).help(text!(
        "give the picture a name of at most five plain letters and digits, or keep the file in XML",
        "画像の名前を 5 文字以内の英数字にするか、XML のままにしてください"
    ))
}

/// A style of the automatic roofs.
#[cold]
pub fn roof_style(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot say what automatic roofs look like",
        "従来形式では自動屋根の見え方を書けません"
    );
    Diagnostic::error(811, span, message).help(text!("write the roofs as `Roof` elements with `mode=\"explicit\"`, leave the style out, or keep the file in XML", "屋根を `mode=\"explicit\"` の `Roof` 要素で書くか、指定を消すか、XML のままにしてください"))
}

/// A wall round a flat roof.
#[cold]
pub fn parapet(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no parapets",
        "従来形式にパラペットはありません"
    );
    Diagnostic::error(812, span, message).help(text!(
        "leave it out (flat roofs get a rim of their own), or keep the file in XML",
        "消すか (陸屋根には縁が付きます)、XML のままにしてください"
    ))
}

/// A start that no walk over voids leads to.
#[cold]
pub fn start_between(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot start here: voids lead whole units only",
        "従来形式ではここから始められません。空きでは 1 U の整数倍しか進めません"
    );
    Diagnostic::error(813, span, message).help(text!(
        "start at whole units, at most 1000 from the origin, or keep the file in XML",
        "原点から 1000 以内の整数の位置から始めるか、XML のままにしてください"
    ))
}

/// A house above the ground.
#[cold]
pub fn raised(span: Span) -> Diagnostic {
    let message = text!(
        "a house of the legacy form stands at height 0: its place has no `z`",
        "従来形式の家は高さ 0 に建ちます。位置に `z` はありません"
    );
    Diagnostic::error(814, span, message).help(text!(
        "leave `z` out, or keep the file in XML",
        "`z` を消すか、XML のままにしてください"
    ))
}

/// The gloss of a texture.
#[cold]
pub fn gloss(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot say how much a texture mirrors",
        "従来形式ではテクスチャの映り込みを書けません"
    );
    Diagnostic::error(815, span, message).help(text!(
        "leave `Texture` out, or keep the file in XML",
        "`Texture` を消すか、XML のままにしてください"
    ))
}

/// Braces, which hold expressions in XML.
#[cold]
pub fn braces(span: Span) -> Diagnostic {
    let message = text!(
        "braces cannot be written in XML: they hold expressions there",
        "波括弧は XML では式を表すため、書けません"
    );
    Diagnostic::error(816, span, message).help(text!(
        "use other signs, `(` and `)`, or keep the file in the legacy form",
        "ほかの記号 `(` `)` を使うか、従来形式のままにしてください"
    ))
}

/// A part of one's own.
#[cold]
pub fn own_part(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot define parts",
        "従来形式では部材を定義できません"
    );
    Diagnostic::error(817, span, message).help(text!(
        "put the part into a file `catalog.hsd` beside the text, which both forms use, or keep the file in XML",
        "部材をテキストのそばの `catalog.hsd` に移すか、XML のままにしてください。`catalog.hsd` はどちらの形式からも使えます"
    ))
}
