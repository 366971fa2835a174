//! Messages about parts and operations (HSD03xx).

use hsd_base::diagnostic::messages::words::any_of;
use hsd_base::diagnostic::{Diagnostic, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// A width as an author would write it.
fn units(width: f64) -> String {
    // Adding nothing makes -0 plain 0.
    let rounded = (width * 1000.0).round() / 1000.0 + 0.0;
    format!("{rounded} U")
}

/// The title of a fix that replaces a code.
pub fn written(code: &str) -> Text {
    text!([code] "Write `{code}`", "`{code}` と書く")
}

/// A code as it stands in a place: in five columns, or without its last blanks where what stood there had none.
pub fn in_cells(place: Span, code: &str) -> &str {
    match place.end - place.start {
        0..5 => code.trim_end(),
        _ => code,
    }
}

/// A code that is neither a part nor a part texture.
#[cold]
pub fn unknown_code(span: Span, code: &str, near: &[String]) -> Diagnostic {
    let message = text!([code]
        "`{code}` is neither a part nor a part texture",
        "`{code}` という部材も部材のテクスチャーもありません"
    );
    let any = any_of(near);
    let help = if near.is_empty() {
        text!([code]
            "put the image `{code}.png` into the folder of this file or its `textures` folder, or name another folder with --textures",
            "画像 `{code}.png` をこのファイルのフォルダーかその中の `textures` フォルダーに置くか、--textures で別のフォルダーを指定してください"
        )
    } else {
        text!([any]
            "did you mean {any}? `hsd parts` lists all parts",
            "{any} ではありませんか。部材の一覧は `hsd parts` で見られます"
        )
    };
    let mut found = Diagnostic::error(301, span, message).help(help);
    // A part of another width would open the walls.
    let width = |code: &str| code.chars().nth(4).unwrap_or(' ');
    for meant in near.iter().filter(|n| width(n) == width(code)) {
        let meant_here = in_cells(span, meant);
        let whole = span.end - span.start >= 5 || !meant_here.contains(' ');
        if whole && !code.contains('_') {
            found = found.fix(written(meant), span, meant_here);
        }
    }
    found
}

/// The name of a part in place of its code; `cells` has the blanks that fill it up.
#[cold]
pub fn part_name(span: Span, name: &str, code: &str, cells: Span) -> Diagnostic {
    let message = text!([name]
        "`{name}` is the name of a part, not its code",
        "`{name}` は部材の名前で、部材コードではありません"
    );
    Diagnostic::error(301, span, message)
        .help(text!([name, code]
            "`{name}` is the part `{code}`: write its code in five columns",
            "`{name}` の部材コードは `{code}` です。五桁で書いてください"
        ))
        .fix(written(code), cells, in_cells(cells, code))
}

/// A turn letter that slipped into a code whose blanks were lost; `ends`: a turn may be written there.
#[cold]
pub fn lost_blanks(span: Span, text: &str, code: &str, control: char, ends: bool) -> Diagnostic {
    let message = text!([text, control]
        "`{text}` is not a part; the blanks before `{control}` seem to be missing",
        "`{text}` という部材はありません。`{control}` の前の空白が抜けたようです"
    );
    let fixed = format!("{code:<5}{control}");
    let found = Diagnostic::error(302, span, message).help(text!([fixed]
        "did you mean `{fixed}`? A code fills five columns, and the turn follows it",
        "`{fixed}` ではありませんか。部材コードは五桁を占め、曲がりはその次に書きます"
    ));
    match ends {
        true => found.fix(written(&fixed), span, &*fixed),
        false => found,
    }
}

/// Small letters in a code.
#[cold]
pub fn lower_case(span: Span, text: &str, code: &str) -> Diagnostic {
    let code = code.trim_end();
    let message = text!([text, code]
        "`{text}` is not a part, but `{code}` is",
        "`{text}` という部材はありませんが、`{code}` はあります"
    );
    Diagnostic::error(303, span, message)
        .help(text!([code]
            "write capital letters: `{code}`; only the `h` of half a unit is small",
            "大文字で `{code}` と書いてください。小文字は 0.5 U を表す `h` だけです"
        ))
        .fix(written(code), span, in_cells(span, &format!("{code:<5}")))
}

/// Nothing between two commas, or nothing at all; `comma` is a removable comma with the white space around it.
#[cold]
pub fn empty_code(span: Span, comma: Option<Span>) -> Diagnostic {
    let message = text!("a code is missing here", "ここに部材コードがありません");
    let found = Diagnostic::error(304, span, message).help(text!(
        "write a code, or remove the comma; a void is written `.....`",
        "部材コードを書くか、コンマを削除してください。空きは `.....` と書きます"
    ));
    match comma {
        Some(comma) => found.fix(text!("Remove the comma", "コンマを削除する"), comma, ""),
        None => found,
    }
}

/// Not one weight for each code; `all` is the attribute.
#[cold]
pub fn weight_count(span: Span, weights: usize, codes: usize, all: Option<Span>) -> Diagnostic {
    let message = text!([weights, codes]
        "{weights} weights for {codes} codes",
        "部材コード{codes}個に対して重みが{weights}個あります"
    );
    let found = Diagnostic::error(305, span, message).help(text!([codes]
        "give {codes} weights, one for each code, or none",
        "重みは部材コードごとにひとつ、あわせて{codes}個書くか、すべて省いてください"
    ));
    match all {
        Some(all) => found.fix(text!("Delete the weights", "重みを省く"), all, ""),
        None => found,
    }
}

/// A random choice that would move the rest of the wall.
#[cold]
pub fn drawn_widths(span: Span, width: f64, first: Span, usual: f64) -> Diagnostic {
    let (width, usual) = (units(width), units(usual));
    let message = text!([usual, width]
        "the codes of this random choice differ in width: {usual} and {width}",
        "抽選する部材の幅が揃っていません: {usual} と {width}"
    );
    let label = text!([usual]
        "{usual} wide; this width is used",
        "幅 {usual}。この幅を使います"
    );
    Diagnostic::error(306, span, message)
        .label(first, label)
        .help(text!(
            "use codes of one width, so that the outline does not depend on the choice",
            "外周が抽選で変わらないよう、同じ幅の部材を選んでください"
        ))
}

/// A replacement that would move the rest of the wall.
#[cold]
pub fn replaced_width(span: Span, code: &str, new: f64, there: Span, old: f64) -> Diagnostic {
    let (new, old) = (units(new), units(old));
    let message = text!([code, new, old]
        "`{code}` is {new} wide, but the part it replaces is {old} wide",
        "`{code}` の幅は {new} ですが、置き換えられる部材の幅は {old} です"
    );
    Diagnostic::error(307, span, message)
        .label(there, text!([old] "{old} wide", "幅 {old}"))
        .help(text!([old]
            "use a part {old} wide, so that the outline stays closed",
            "外周が閉じたままになるよう、幅 {old} の部材を選んでください"
        ))
}

/// A `random` that finds no code to choose again.
#[cold]
pub fn idle_random(span: Span) -> Diagnostic {
    let message = text!(
        "no code of this `random` occurs in its element, so nothing is chosen",
        "この `random` の部材コードが要素の中にないため、抽選されません"
    );
    Diagnostic::warning(308, span, message).help(text!(
        "next to parts, `random` chooses again wherever a code of its list is written: write one of its codes where the choice should be made",
        "部材と並ぶ `random` は、その一覧にある部材コードの場所を抽選し直します。抽選したい場所に一覧のコードをひとつ置いてください"
    ))
}

/// A substitution that finds nothing.
#[cold]
pub fn idle_replace(span: Span) -> Diagnostic {
    let message = text!(
        "nothing in its element matches this `replace`, so nothing is replaced",
        "この `replace` に当てはまるものが要素の中になく、何も置き換わりません"
    );
    Diagnostic::warning(309, span, message).help(text!(
        "`code` is the code to be replaced, `with` the code that replaces it",
        "`code` には今ある部材コード、`with` には置き換える部材コードを書きます"
    ))
}

/// A position where no part is.
#[cold]
pub fn beyond_the_row(span: Span, position: u32, longest: usize) -> Diagnostic {
    let message = text!([position, longest]
        "position {position} is beyond the end of the row, which has {longest} parts",
        "位置 {position} は行の外です。この行の部材は{longest}個です"
    );
    Diagnostic::warning(310, span, message).help(text!([longest]
        "positions count from 1 to {longest}; a split counts as one",
        "位置は 1 から {longest} まで数えます。`split` はひとつと数えます"
    ))
}

/// The halves of a split do not fit.
#[cold]
pub fn unequal_halves(span: Span, halves: (Span, Span), upper: f64, lower: f64) -> Diagnostic {
    let (above, below) = (units(upper), units(lower));
    let wide = units(upper.max(lower));
    let message = text!([above, below]
        "the upper half of this split is {above} wide, the lower half {below} wide",
        "この `split` は上段の幅が {above}、下段の幅が {below} です"
    );
    Diagnostic::error(311, span, message)
        .label(halves.0, text!([above] "{above} wide", "幅 {above}"))
        .label(halves.1, text!([below] "{below} wide", "幅 {below}"))
        .help(text!([wide]
            "make the parts of both halves {wide} wide in total",
            "上段も下段も、部材の幅の合計を {wide} にしてください"
        ))
}

/// A floor without parts and without textures.
#[cold]
pub fn floor_without_parts(span: Span, id: &str, picture: &str) -> Diagnostic {
    let message = text!([id, picture]
        "floor `{id}` has no parts, no other floor `{id}` has any, and there is no image `{picture}.png`",
        "`Floor` の `{id}` に部材がなく、同じ名前のほかの `Floor` にも部材がなく、画像 `{picture}.png` もありません"
    );
    Diagnostic::error(312, span, message).help(text!([picture]
        "write parts into the floor, or put `{picture}.png` and the images that belong to it into the folder of this file, its `textures` folder, or the one named with --textures",
        "`Floor` に部材を書くか、`{picture}.png` と対になる画像を、このファイルのフォルダー、その中の `textures` フォルダー、または --textures で指定したフォルダーに置いてください"
    ))
}

/// A courtyard without a place.
#[cold]
pub fn hole_without_start(span: Span) -> Diagnostic {
    let message = text!(
        "this courtyard needs `start`, the place where its walk begins",
        "位置の指定がないため、この中庭は作りません"
    );
    Diagnostic::error(313, span, message).help(text!(
        "give its right rear corner, for example start=\"2 5\": a to the left and b to the back, in U from the origin of the house",
        "中庭の右奥の隅を start=\"2 5\" のように書いてください。家の原点から左へ a、奥へ b を U で数えます"
    ))
}

/// The facades of a storey disagree.
#[cold]
pub fn floor_heights(span: Span, height: f64, there: Span, other: f64) -> Diagnostic {
    let message = text!([height, other]
        "this floor is {height} shaku high, but {other} shaku in another facade of the storey",
        "ここの階高は {height} 尺ですが、同じ階のほかの壁面では {other} 尺です"
    );
    let label = text!([other]
        "{other} shaku; the largest height is used",
        "{other} 尺。最も大きい階高を使います"
    );
    let (largest, place) = match height > other {
        true => (height, there),
        false => (other, span),
    };
    let title = text!([largest]
        "Write {largest} shaku in both",
        "どちらも {largest} 尺にする"
    );
    Diagnostic::warning(315, span, message)
        .label(there, label)
        .help(text!(
            "give all floors of a storey the same height",
            "同じ階の `Floor` には同じ階高を書いてください"
        ))
        .fix(title, place, largest.to_string())
}

/// A turn that is probably the angle between two walls.
#[cold]
pub fn steep_angle(span: Span, angle: f64) -> Diagnostic {
    let interior = 180.0 - angle.abs();
    let message = text!([angle]
        "the walls turn by {angle} degrees here, almost back the way they came",
        "ここで {angle} 度曲がり、ほとんど来た方へ折り返しています"
    );
    let meant = interior.copysign(angle).to_string();
    Diagnostic::note(316, span, message).help(text!([angle, interior]
        "`angle` is the turn from the previous facade; if {angle} is the angle between the two walls, write {interior}",
        "`angle` は前の壁面から曲がる角度です。{angle} が二つの壁のなす角なら {interior} と書いてください"
    ))
    .fix(written(&meant), span, meant)
}

/// A `Texture` of no part.
#[cold]
pub fn idle_texture(span: Span, code: &str, near: &[String]) -> Diagnostic {
    let message = text!([code]
        "no part of this house has the code `{code}`",
        "この家に `{code}` という部材はありません"
    );
    let any = any_of(near);
    let mut found = Diagnostic::warning(317, span, message).help(if near.is_empty() {
        text!(
            "name a part or a part texture that the house uses",
            "家の中にある部材か部材のテクスチャーを指定してください"
        )
    } else {
        text!([any] "did you mean {any}?", "{any} ではありませんか")
    });
    for meant in near {
        // Blanks would divide a list.
        let meant = meant.trim_end().replace(' ', "_");
        found = found.fix(written(&meant), span, meant);
    }
    found
}

/// A house without content.
#[cold]
pub fn empty_house(span: Span) -> Diagnostic {
    let message = text!(
        "this house has no storey and no facade",
        "この家には階も壁面もありません"
    );
    Diagnostic::error(318, span, message).help(text!(
        "write a `Storey` with `Row`s, or a `Structure` with `Facade`s",
        "`Row` の入った `Storey` か、`Facade` の入った `Structure` を書いてください"
    ))
}

/// Upper textures without lower ones.
#[cold]
pub fn no_lower_picture(span: Span, name: &str) -> Diagnostic {
    let message = text!([name]
        "there is an image `{name}u1.png` but no `{name}l1.png`: the upper textures fill the whole height",
        "画像 `{name}u1.png` はありますが `{name}l1.png` がないため、上段の画像を全高に貼ります"
    );
    Diagnostic::note(319, span, message).help(text!([name]
        "add `{name}l1.png` for the lower half, or name the image `{name}.png` if it is not divided",
        "下段の画像 `{name}l1.png` を加えるか、上下に分けないなら画像の名前を `{name}.png` にしてください"
    ))
}

/// A wall without a storey.
#[cold]
pub fn facade_without_floors(span: Span) -> Diagnostic {
    let message = text!(
        "this facade has no `Floor`; its side stays open",
        "この壁面には `Floor` がなく、この面は開いたままになります"
    );
    Diagnostic::warning(320, span, message).help(text!(
        "write a `Floor` for each storey",
        "階ごとに `Floor` を書いてください"
    ))
}

/// Two ways of writing at once.
#[cold]
pub fn storeys_and_structure(span: Span, storey: Span) -> Diagnostic {
    let message = text!(
        "a house is written in storeys or in facades, not both; the facades are ignored",
        "家は階で書くか壁面で書くかのどちらかです。壁面の方は読みません"
    );
    Diagnostic::error(321, span, message)
        .label(
            storey,
            text!("the storeys begin here", "階はここから始まります"),
        )
        .help(text!(
            "split it into two houses, or write the facades as `Row`s",
            "二軒の家に分けるか、壁面を `Row` で書いてください"
        ))
}

/// More than one replacement.
#[cold]
pub fn several_withs(span: Span) -> Diagnostic {
    let message = text!(
        "`with` takes one code; the first is used",
        "`with` に書ける部材コードはひとつです。最初のものを使います"
    );
    Diagnostic::error(322, span, message).help(text!(
        "use `random` to choose among several codes",
        "いくつかの部材から選ぶには `random` を使ってください"
    ))
}

/// A code that is divided by its blanks.
#[cold]
pub fn torn_code(span: Span, code: &str) -> Diagnostic {
    let joined = code.replace(' ', "_");
    let message = text!([code]
        "blanks separate the codes of this list, so `{code}` is read as two",
        "この一覧は空白で区切られるため、`{code}` が二つに分かれてしまいます"
    );
    let title = written(&joined);
    Diagnostic::error(314, span, message).help(text!([joined]
        "separate the codes by commas, or write the blanks in a code as `_`: `{joined}`",
        "部材コードをコンマで区切るか、コードの中の空白を `_` にして `{joined}` と書いてください"
    ))
    .fix(title, span, joined)
}

/// An era of a house without an age.
#[cold]
pub fn era_without_age(span: Span) -> Diagnostic {
    let message = text!(
        "`era` has no effect without `age`",
        "`age` がなければ `era` には効果がありません"
    );
    Diagnostic::warning(332, span, message).help(text!(
        "give the years since the house was built, as in `age=\"80\"`",
        "`age=\"80\"` のように、建ってからの年数を書いてください"
    ))
}
