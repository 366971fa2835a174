//! Messages about roofs (HSD05xx).

mod angles;
mod dormers;
mod pents;

pub use angles::{deck, wings_at_angles};
pub use dormers::*;
pub use pents::*;

use hsd_base::diagnostic::messages::words::short;
use hsd_base::diagnostic::{Diagnostic, Edit, Noun, Text, noun};
use hsd_base::source::Span;
use hsd_base::text;

/// The name and the letter of a covering.
fn covering(kind: char) -> Noun {
    match kind {
        'K' => noun("pantiles (K)", "桟瓦葺 (K)"),
        'G' => noun("hon-gawara tiles (G)", "本瓦葺 (G)"),
        'I' => noun("boards (I)", "板葺 (I)"),
        'S' => noun("shingles (S)", "杮葺 (S)"),
        'H' => noun("bark (H)", "檜皮葺 (H)"),
        'Y' => noun("thatch (Y)", "茅葺 (Y)"),
        _ => noun("sheet metal (T)", "金属板葺 (T)"),
    }
}

/// A length: "1.5 U".
fn units(value: f64) -> Text {
    let number = short(value);
    text!([number] "{number} U", "{number} U")
}

/// The title of a fix that replaces a word.
fn written(word: &str) -> Text {
    text!([word] "Write `{word}`", "`{word}` と書く")
}

/// Roofs over walls that do not close; `all` are their places.
#[cold]
pub fn open_facade(wished: Span, walk: Span, storey: u32, all: Vec<Span>) -> Diagnostic {
    let message = text!([storey]
        "a roof is written, but storey {storey} is an open facade that encloses no area",
        "屋根の指定がありますが、{storey}階は閉じていない壁面で、囲む面積がありません"
    );
    let label = text!(
        "this walk does not return to its start",
        "この壁は始点に戻っていません"
    );
    let none = all.is_empty();
    let edits = all.into_iter().map(|span| Edit::new(span, ""));
    let found = Diagnostic::error(501, wished, message)
        .help(text!(
            "close the walk, or remove the roofs; an open facade needs none",
            "外周を始点まで戻して閉じるか、屋根を削除してください。閉じていない壁面に屋根は要りません"
        ))
        .label(walk, label);
    match none {
        true => found,
        false => found.fix_all(text!("Remove the roofs", "屋根を削除する"), edits.collect()),
    }
}

/// A roof line beside the house.
#[cold]
pub fn over_no_wall(line: Span, shape: &str) -> Diagnostic {
    let message = text!([shape]
        "there is no wall of its storey below this {shape} roof",
        "この {shape} の屋根の下に、その階の壁がありません"
    );
    Diagnostic::warning(502, line, message).help(text!(
        "give the rectangle in U from the origin of the house: a to the left along the first line, b back from it; a roof outside the walls is HIS, KAT or KAR",
        "矩形は家の原点から U で書いてください。a は最初の行に沿って左へ、b は奥へ測ります。壁の外に架ける屋根は HIS、KAT、KAR です"
    ))
}

/// A roof line that leaves the walls by some units.
#[cold]
pub fn partly_outside(line: Span, share: f64) -> Diagnostic {
    let share = short((share * 100.0).round());
    let message = text!([share]
        "{share} % of this roof's rectangle lies outside the walls",
        "この屋根の矩形の {share} % が壁の外に出ています"
    );
    Diagnostic::warning(503, line, message).help(text!(
        "give the rectangle of the walls; E adds the eaves to it, G the verges",
        "矩形には壁の範囲を書いてください。軒の出は E、けらばの出は G で加わります"
    ))
}

/// Two roof lines that overlap at one height.
#[cold]
pub fn overlapping(line: Span, other: Span) -> Diagnostic {
    let message = text!(
        "this roof overlaps another one at the same height",
        "この屋根は同じ高さの別の屋根と重なっています"
    );
    Diagnostic::note(504, line, message)
        .help(text!(
            "where they overlap, the higher one shows; change one rectangle if that is not intended",
            "重なるところでは高い方の屋根が見えます。意図と違うときは一方の矩形を直してください"
        ))
        .label(other, text!("the other roof", "もう一方の屋根"))
}

/// An upper storey that projects far beyond the lower one.
#[cold]
pub fn overhang(upper: Span, lower: Span, number: u32, by: f64) -> Diagnostic {
    let (above, by) = (number + 1, units(by));
    let message = text!([above, by, number]
        "storey {above} projects {by} beyond storey {number}, with nothing below it",
        "{above}階が{number}階より {by} 張り出し、下に何もありません"
    );
    Diagnostic::warning(505, upper, message)
        .help(text!(
            "set the start of the upper storey with leading voids or start=\"a b\", or correct the length of its lines",
            "上の階の始点を行頭の空きか start=\"a b\" で決めるか、行の長さを直してください"
        ))
        .label(lower, text!([number] "storey {number}", "{number}階"))
}

/// An upper storey that projects a little (dashibari-zukuri).
#[cold]
pub fn jutting(upper: Span, number: u32, by: f64) -> Diagnostic {
    let (above, by) = (number + 1, units(by));
    let message = text!([above, by, number]
        "storey {above} projects {by} beyond storey {number}",
        "{above}階が{number}階より {by} 張り出しています"
    );
    Diagnostic::note(506, upper, message).help(text!(
        "up to one unit is common (degoshi, dashigeta); boards and brackets close it from below",
        "二階が 1 U まで張り出すことはよくあります (出梁造など)。下は板と腕木で塞ぎます"
    ))
}

/// A pitch that does not suit the covering.
#[cold]
pub fn odd_pitch(span: Span, pitch: f64, kind: char, band: (f64, f64)) -> Diagnostic {
    let (pitch_text, least, most) = (short(pitch), short(band.0), short(band.1));
    let kind = covering(kind);
    let message = if pitch < band.0 {
        text!([pitch_text, kind]
            "a pitch of {pitch_text} sun is too low for {kind}: rain gets in",
            "{kind} に {pitch_text} 寸勾配は緩すぎて雨が漏ります"
        )
    } else {
        text!([pitch_text, kind]
            "a pitch of {pitch_text} sun is too steep for {kind}: the covering slides off",
            "{kind} に {pitch_text} 寸勾配は急すぎて葺き材が滑り落ちます"
        )
    };
    Diagnostic::warning(507, span, message).help(text!([least, most]
        "write a pitch from {least} to {most} sun",
        "{least} 寸から {most} 寸までの勾配にしてください"
    ))
}

/// A roof with too wide a span, and the other direction letter.
#[cold]
pub fn long_span(direction: Span, span: f64, other: &str) -> Diagnostic {
    let wide = short(span);
    let message = text!([wide]
        "with this ridge the roof spans {wide} U, too far for beams of 3 ken",
        "この棟の向きでは梁間が {wide} U になり、三間梁では支えられません"
    );
    let found = Diagnostic::note(508, direction, message).help(text!(
        "turn the ridge (X or Y), or divide the roof; only halls of palaces and temples span more",
        "棟の向き (X か Y) を変えるか、屋根を分けてください。御殿や寺の堂にはこれを超えるものもあります"
    ));
    // Glued to the kind, the direction has no place of its own.
    match direction.end - direction.start {
        1 => found.fix(written(other), direction, other),
        _ => found,
    }
}

/// A roof far from the top of every storey.
#[cold]
pub fn far_from_top(height: Span, shaku: f64, storey: u32, top: f64) -> Diagnostic {
    let (shaku, top) = (short(shaku), short(top));
    let message = text!([shaku, storey, top]
        "this roof is at {shaku} shaku, far from the top of the nearest storey: storey {storey} ends at {top}",
        "この屋根は {shaku} 尺の高さにあり、最も近い{storey}階の上端 ({top} 尺) から離れています"
    );
    let title = written(&top);
    Diagnostic::warning(509, height, message)
        .help(text!([top]
            "write {top} or `*`; heights are in shaku above the ground sill, not above the storey",
            "{top} か `*` と書いてください。高さは階の床からではなく、土台から尺で測ります"
        ))
        .fix(title, height, top)
        .fix(written("*"), height, "*")
}

/// A lower roof that would rise above the storey it surrounds.
#[cold]
pub fn high_skirt(span: Span, rise: f64, storey: u32, top: f64, pitch: f64) -> Diagnostic {
    // Roofs round an upper storey are often gentle; below one sun they drain no more than a flat roof.
    let severity = if pitch < 1.0 {
        Diagnostic::warning
    } else {
        Diagnostic::note
    };
    let (rise, top, pitch) = (short(rise), short(top), short(pitch));
    let message = text!([rise, storey, top, pitch]
        "this lower roof would rise to {rise} shaku around storey {storey}, where there is room up to {top}, so its pitch is reduced to {pitch} sun",
        "この下層の屋根は{storey}階の周りで {rise} 尺まで上がりますが、納まる高さは {top} 尺までなので、{pitch} 寸勾配にしました"
    );
    severity(510, span, message).help(text!(
        "make the storey above higher, set its walls back less, or write a lower pitch",
        "上の階を高くするか、その壁の後退を小さくするか、緩い勾配にしてください"
    ))
}

/// A lean-to whose outer wall gets too low.
#[cold]
pub fn low_lean_to(storey: Span, number: u32, left: f64) -> Diagnostic {
    let left = short(left);
    let message = text!([number, left]
        "a lean-to on storey {number} would leave its outer wall only {left} m high, so it gets a gable roof",
        "{number}階に下屋を架けると外壁の高さが {left} m しか残らないため、切妻にしました"
    );
    Diagnostic::warning(511, storey, message).help(text!(
        "make the storey higher or the lean-to shallower, or write a roof line for it",
        "階高を上げるか、下屋を浅くするか、その屋根の行を書いてください"
    ))
}

/// Shed roofs as automatic roofs that join each other.
#[cold]
pub fn joined_slopes(shape: Span, number: u32) -> Diagnostic {
    let message = text!([number]
        "roofs of storey {number} join each other, which shed roofs (KAT) cannot: those become gable roofs",
        "{number}階では屋根どうしが取り合うため、その部分は片流れ (KAT) にできず、切妻にしました"
    );
    Diagnostic::warning(519, shape, message).help(text!(
        "write a roof line for each part, with the side it slopes to and its height",
        "部分ごとに屋根の行を書き、流れる側と高さを指定してください"
    ))
}

/// A slope direction for a roof with a ridge, or a ridge direction for a shed roof.
#[cold]
pub fn odd_direction(direction: Span, shape: &str, one_sided: bool) -> Diagnostic {
    let (message, help) = if one_sided {
        (
            text!([shape]
                "{shape} has one slope and no ridge",
                "{shape} は片流れで、向きを決める棟がありません"
            ),
            text!(
                "write the side it slopes to: F, B, L or R",
                "流れる側を F、B、L、R のどれかで書いてください"
            ),
        )
    } else {
        (
            text!([shape]
                "{shape} has a ridge and slopes to both sides",
                "{shape} は棟があり、両側へ流れます"
            ),
            text!(
                "write X (ridge parallel to the first line) or Y",
                "X (棟が最初の行と平行) か Y と書いてください"
            ),
        )
    };
    let mut found = Diagnostic::warning(514, direction, message).help(help);
    let letters: &[&str] = match one_sided {
        true => &["F", "B", "L", "R"],
        false => &["X", "Y"],
    };
    for letter in letters {
        found = found.fix(written(letter), direction, *letter);
    }
    found
}

/// A shape for rectangles as the roof of a whole outline.
#[cold]
pub fn hipped_only(span: Span, shape: &str) -> Diagnostic {
    let message = text!([shape]
        "{shape} needs rectangles: a whole outline gets a hip roof (YOS)",
        "{shape} には矩形が要ります。平面全体に架ける屋根は寄棟 (YOS) です"
    );
    Diagnostic::note(515, span, message).help(text!(
        "write YOS for a hip roof, RIK for a flat roof, or roof lines for rectangles",
        "寄棟でよければ YOS、陸屋根なら RIK と書き、そうでなければ矩形ごとに屋根の行を書いてください"
    ))
    .fix(written("YOS"), span, "YOS")
    .fix(written("RIK"), span, "RIK")
}

/// A plan that is not at right angles, and gets one hip roof; `wall` is one that slants, of this storey or the one
/// above.
#[cold]
pub fn whole_hip(wall: Span, storey: u32) -> Diagnostic {
    let message = text!([storey]
        "not all walls are at right angles, so storey {storey} gets one hip roof over its whole outline",
        "直角でない壁があるため、{storey}階は平面全体に一つの寄棟屋根を架けます"
    );
    Diagnostic::note(520, wall, message).help(text!(
        "if that is meant, say so: `<Roofs method=\"skeleton\"/>`; for other roofs make the walls square, or write roof lines",
        "それでよければ `<Roofs method=\"skeleton\"/>` と書き、ほかの屋根なら壁を直角にするか、屋根の行を書いてください"
    ))
}

/// A hall too wide for one gable.
#[cold]
pub fn several_ridges(wall: Span, storey: u32) -> Diagnostic {
    let message = text!([storey]
        "storey {storey} is wider than 15 ken (27 m), so it gets several gables side by side with valleys between them",
        "{storey}階は幅が十五間(27 m)を超えるため、谷を挟んで切妻屋根を並べて架けます"
    );
    Diagnostic::note(521, wall, message).help(text!(
        "for one roof over the whole width give it a shape, as in `<Roofs shape=\"KIR\"/>`",
        "全体に一つの屋根を架けるには、`<Roofs shape=\"KIR\"/>` のように形を書いてください"
    ))
}

/// A roof line inside the storey above; `height` is the place of its height.
#[cold]
pub fn under_storey(line: Span, storey: u32, upper: Span, height: Option<Span>) -> Diagnostic {
    let above = storey + 1;
    let message = text!([above]
        "this roof is entirely inside storey {above} and is not built",
        "この屋根は全体が{above}階の中にあるため、架けません"
    );
    let found = Diagnostic::warning(516, line, message)
        .help(text!(
            "write the height of the topmost storey there, or `*`",
            "そこで最も上の階の高さか `*` を書いてください"
        ))
        .label(
            upper,
            text!("this storey is there", "ここにこの階があります"),
        );
    match height {
        Some(height) => found.fix(written("*"), height, "*"),
        None => found,
    }
}

/// Too many roof lines.
#[cold]
pub fn too_many_lines(first: Span, count: usize, limit: usize) -> Diagnostic {
    let message = text!([count, limit]
        "the house has {count} roof lines; those after the first {limit} are ignored",
        "この家には屋根の行が{count}行あります。{limit}行より後は読みません"
    );
    Diagnostic::warning(906, first, message).help(text!(
        "join adjacent roofs into one, or split the house into several",
        "並んだ屋根をひとつにまとめるか、何軒かに分けてください"
    ))
}

/// Too many roofs that meet.
#[cold]
pub fn too_many_meet(place: Span, storey: u32) -> Diagnostic {
    let message = text!([storey]
        "too many roofs of storey {storey} meet, so no valleys are made between them",
        "{storey}階で取り合う屋根が多すぎるため、谷を作りません"
    );
    Diagnostic::warning(906, place, message).help(text!(
        "write one roof line for each rectangle, side by side without overlaps",
        "屋根の行は矩形ごとにひとつ、重ねずに並べて書いてください"
    ))
}

/// A plan of very many corners.
#[cold]
pub fn too_many_corners(storey: Span, number: u32, corners: usize, limit: usize) -> Diagnostic {
    let message = text!([number, corners, limit]
        "storey {number} has {corners} corners under its roof, more than the limit of {limit}: it gets a flat roof",
        "{number}階は屋根を架ける外周の隅が{corners}か所あり、上限の{limit}か所を超えるため陸屋根にします"
    );
    Diagnostic::warning(906, storey, message).help(text!(
        "split the house into several, or give it fewer corners",
        "何軒かに分けるか、隅を減らしてください"
    ))
}

/// An outline without a hip roof; `touching`: because its walls touch.
#[cold]
pub fn no_hipped_roof(storey: Span, number: u32, touching: bool) -> Diagnostic {
    let message = if touching {
        text!([number]
            "storey {number} gets a flat roof instead of a hip roof: its walls touch each other",
            "{number}階は壁どうしが接しているため、寄棟ではなく陸屋根になります"
        )
    } else {
        text!([number]
            "storey {number} gets a flat roof instead of a hip roof: its outline is too small or too intricate",
            "{number}階は平面が小さすぎるか入り組みすぎているため、寄棟ではなく陸屋根になります"
        )
    };
    Diagnostic::warning(906, storey, message).help(text!(
        "keep the walls farther apart, or give the outline fewer corners",
        "壁の間をもっと離すか、角を減らしてください"
    ))
}

/// The search budget of a house is used up.
#[cold]
pub fn too_much_search(storey: Span, number: u32) -> Diagnostic {
    let message = text!([number]
        "the search budget does not suffice for the best partition of storey {number}: it is divided by a faster rule",
        "{number}階の平面の最良の分割は探索の上限を超えるため、速い規則で分割します"
    );
    Diagnostic::warning(906, storey, message).help(text!(
        "give the plan fewer corners, or write its roofs",
        "平面の隅を減らすか、屋根を書いてください"
    ))
}

/// A storey cut into too many pieces by the storey above and the roof lines.
#[cold]
pub fn too_intricate(storey: Span, number: u32) -> Diagnostic {
    let message = text!([number]
        "the open part of storey {number} consists of too many pieces: it gets no automatic roof",
        "{number}階の屋根を架ける部分が細かく分かれすぎるため、自動では屋根を架けません"
    );
    Diagnostic::warning(906, storey, message).help(text!(
        "align the walls of the storey above, and the roof lines, with the walls of this storey",
        "上の階の壁と屋根の行を、この階の壁の上に揃えてください"
    ))
}
