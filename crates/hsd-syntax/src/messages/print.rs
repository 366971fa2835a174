//! Messages of `hsd fmt` (HSD08xx).

use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// The name of the legacy form.
pub fn legacy_form() -> Text {
    text!("the legacy form", "旧形式")
}

/// The name of the XML form.
pub fn xml_form() -> Text {
    text!("XML", "XML ")
}

/// A layout that would change the meaning: a bug, and the file stays as it is.
#[cold]
pub fn left_alone(span: Span) -> Diagnostic {
    let message = text!(
        "the file is left unchanged: formatting would change its meaning",
        "整形すると意味が変わるため、ファイルを変更しませんでした"
    );
    Diagnostic::error(801, span, message).help(text!(
        "this is a bug in hsd; please report it with the source file",
        "hsd の不具合です。ファイルを添えて報告してください"
    ))
}

/// The other form would change the meaning.
#[cold]
pub fn not_the_same(span: Span, form: Text) -> Diagnostic {
    let message = text!([form]
        "written in {form}, this file would make another building",
        "{form}で書くと、このファイルは別の建物になります"
    );
    Diagnostic::error(802, span, message).help(text!("it contains something that form cannot express: a number out of range, a slope direction for a roof with a ridge, an image whose name reads as a turn letter", "その形式で書けないものがあります。範囲外の数値、棟のある形なのに流れ方向を持つ屋根、制御文字と読まれる画像の名前などです"))
}

/// A random choice: the legacy form has none.
#[cold]
pub fn draw(span: Span, codes: &str) -> Diagnostic {
    let message = text!([codes]
        "the legacy form cannot choose at random from {codes}",
        "旧形式では {codes} から抽選できません"
    );
    Diagnostic::error(803, span, message).help(text!(
        "write one part in its place, or keep the file in XML",
        "代わりに部材を一つ書くか、XML のままにしてください"
    ))
}

/// A part divided above and below.
#[cold]
pub fn split(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot split a part into upper and lower halves",
        "旧形式では部材を上下に分けられません"
    );
    Diagnostic::error(804, span, message).help(text!(
        "write a part of full height in its place, or keep the file in XML",
        "階の高さいっぱいの部材に替えるか、XML のままにしてください"
    ))
}

/// A courtyard, or a second walk in a storey.
#[cold]
pub fn second_walk(span: Span) -> Diagnostic {
    let message = text!(
        "a storey of the legacy form is one walk around the outside",
        "旧形式の階は、外周を一回りする壁だけです"
    );
    Diagnostic::error(805, span, message).help(text!(
        "courtyards and detached wings need XML; detached wings can be separate houses",
        "中庭や離れた棟には XML が必要です。離れた棟は別の家として書けます"
    ))
}

/// A turn that is not a right angle.
#[cold]
pub fn odd_turn(span: Span, degrees: f64) -> Diagnostic {
    let message = text!([degrees]
        "the legacy form turns by 90 degrees only, not by {degrees}",
        "旧形式で曲がれるのは 90 度だけで、{degrees} 度は書けません"
    );
    Diagnostic::error(806, span, message).help(text!(
        "make it a right angle, `turn=\"R\"` or `turn=\"L\"`, or keep the file in XML",
        "直角 (`turn=\"R\"` か `turn=\"L\"`) にするか、XML のままにしてください"
    ))
}

/// Facades whose parts are scaled in several ways.
#[cold]
pub fn facades(span: Span) -> Diagnostic {
    let message = text!(
        "the parts of these facades are scaled in several ways; in the legacy form a house has one unit",
        "これらの壁面の部材は伸び縮みの割合がそろっていません。旧形式では 1 棟に単位は 1 つです"
    );
    Diagnostic::error(807, span, message).help(text!(
        "write the walls as rows of a `Storey`, or keep the file in XML",
        "壁を `Storey` の行として書くか、XML のままにしてください"
    ))
}

/// An outline in metres.
#[cold]
pub fn outline(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no outlines in metres",
        "旧形式ではメートルの輪郭を書けません"
    );
    Diagnostic::error(818, span, message).help(text!(
        "write the walls as `Row`s in U, or keep the file in XML",
        "壁を U 単位の `Row` で書くか、XML のままにしてください"
    ))
}

/// A part with a custom width.
#[cold]
pub fn own_width(span: Span, code: &str, width: f64, usual: f64) -> Diagnostic {
    let message = text!([code, usual, width]
        "in the legacy form `{code}` is {usual} wide, not {width}",
        "旧形式の `{code}` の幅は {usual} で、{width} にはできません"
    );
    Diagnostic::error(808, span, message).help(text!(
        "use a part of that width (`hsd parts` lists them), or keep the file in XML",
        "その幅の部材 (`hsd parts` で一覧できます) を使うか、XML のままにしてください"
    ))
}

/// A part with a custom height.
#[cold]
pub fn own_height(span: Span, code: &str) -> Diagnostic {
    let message = text!([code]
        "the legacy form cannot give `{code}` a height",
        "旧形式では `{code}` の高さを書けません"
    );
    Diagnostic::error(809, span, message).help(text!(
        "its parts are as high as their storey; remove the height, or keep the file in XML",
        "旧形式の部材は階と同じ高さです。高さを消すか、XML のままにしてください"
    ))
}

/// The name of a part texture that is not a code.
#[cold]
pub fn long_name(span: Span, name: &str) -> Diagnostic {
    let message = text!([name]
        "{name:?} is not a code of five columns",
        "{name:?} は五桁の部材コードではありません"
    );
    Diagnostic::error(810, span, message).help(text!(
        "give the image a name of at most five ASCII letters and digits, or keep the file in XML",
        "画像の名前を五文字以内の半角英数字にするか、XML のままにしてください"
    ))
}

/// Settings of automatic roofs.
#[cold]
pub fn roof_style(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no settings for the look of automatic roofs",
        "旧形式では自動屋根の見え方を書けません"
    );
    Diagnostic::error(811, span, message).help(text!("write the roofs as `Roof` elements with `mode=\"explicit\"`, remove the settings, or keep the file in XML", "屋根を `mode=\"explicit\"` の `Roof` 要素で書くか、指定を消すか、XML のままにしてください"))
}

/// Attributes for the gable walls and the timber of a roof.
#[cold]
pub fn eaves_look(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot say what gable walls and timber of a roof are",
        "旧形式では屋根の妻壁や木部の種類を書けません"
    );
    Diagnostic::error(811, span, message).help(text!(
        "remove the attribute, or keep the file in XML",
        "この属性を消すか、XML のままにしてください"
    ))
}

/// A parapet.
#[cold]
pub fn parapet(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no parapets",
        "旧形式にパラペットはありません"
    );
    Diagnostic::error(812, span, message).help(text!(
        "remove it (flat roofs get a rim automatically), or keep the file in XML",
        "消すか (陸屋根には縁が付きます)、XML のままにしてください"
    ))
}

/// A start that voids cannot reach.
#[cold]
pub fn start_between(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot start here: voids are whole units wide",
        "旧形式ではここから始められません。空きでは 1 U の整数倍しか進めません"
    );
    Diagnostic::error(813, span, message).help(text!(
        "start at whole U, at most 1000 from the origin, or keep the file in XML",
        "原点から 1000 以内の整数の位置から始めるか、XML のままにしてください"
    ))
}

/// A house above the ground.
#[cold]
pub fn raised(span: Span) -> Diagnostic {
    let message = text!(
        "a house of the legacy form is at height 0: its place has no `z`",
        "旧形式の家の高さは常に 0 です。位置に `z` はありません"
    );
    Diagnostic::error(814, span, message).help(text!(
        "remove `z`, or keep the file in XML",
        "`z` を消すか、XML のままにしてください"
    ))
}

/// The reflection of a texture.
#[cold]
pub fn gloss(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no reflection of textures",
        "旧形式ではテクスチャーの映り込みを書けません"
    );
    Diagnostic::error(815, span, message).help(text!(
        "remove `Texture`, or keep the file in XML",
        "`Texture` を消すか、XML のままにしてください"
    ))
}

/// Braces, which hold expressions in XML.
#[cold]
pub fn braces(span: Span) -> Diagnostic {
    let message = text!(
        "braces cannot be used in XML, where they enclose expressions",
        "波括弧は XML では式を表すため、書けません"
    );
    Diagnostic::error(816, span, message).help(text!(
        "use other characters, `(` and `)`, or keep the file in the legacy form",
        "ほかの記号 `(` `)` を使うか、旧形式のままにしてください"
    ))
}

/// A custom part.
#[cold]
pub fn own_part(span: Span) -> Diagnostic {
    let message = text!(
        "the legacy form cannot define parts",
        "旧形式では部材を定義できません"
    );
    Diagnostic::error(817, span, message).help(text!(
        "move the part to a file `catalog.hsd` next to this file, which both forms use, or keep the file in XML",
        "部材をこのファイルと同じフォルダーの `catalog.hsd` に移すか、XML のままにしてください。`catalog.hsd` はどちらの形式からも使えます"
    ))
}

/// An element for what the legacy form does not have: what is inside of a house, around it, or on its posts.
#[cold]
pub fn no_such_element(span: Span, element: &str) -> Diagnostic {
    let message = text!([element]
        "the legacy form has outer walls and roofs only, no `{element}`",
        "旧形式で書けるのは外壁と屋根だけで、`{element}` は書けません"
    );
    Diagnostic::error(819, span, message).help(text!([element]
        "remove `{element}`, or keep the file in XML",
        "`{element}` を消すか、XML のままにしてください"
    ))
}
