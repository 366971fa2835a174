//! The reasons why a stroke is refused, each with an alternative.

use hsd_base::diagnostic::Text;
use hsd_base::text;

/// The place is not in the plan.
pub(super) fn no_such_place() -> Text {
    text!(
        "the text has changed meanwhile: draw that again",
        "テキストがその間に変わりました。もう一度描いてください"
    )
}

/// The stroke changes nothing.
pub(super) fn nothing() -> Text {
    text!("this changes nothing", "何も変わりません")
}

/// The distance is too large.
pub(super) fn too_far() -> Text {
    text!(
        "this is farther than a wall can be moved at once",
        "一度に動かせる距離を超えています"
    )
}

/// The distance is not a whole number of units.
pub(super) fn half_units() -> Text {
    text!(
        "walls are made longer and shorter by whole units: put a part of half a unit there first",
        "壁は一単位ごとに伸び縮みします。先に半単位の部材を置いてください"
    )
}

/// Walls would cross.
pub(super) fn walls_cross() -> Text {
    text!(
        "walls would cross or touch: move the others out of the way first",
        "壁が交わるか触れてしまいます。先に他の壁を動かしてください"
    )
}

/// Nothing would be left between two walls.
pub(super) fn vanishes() -> Text {
    text!(
        "nothing would be left between two walls: remove the storey or the house instead",
        "二枚の壁の間に何も残りません。代わりに階か家を消してください"
    )
}

/// The stroke would add or remove facades.
pub(super) fn other_facades() -> Text {
    text!(
        "every floor of a facade stands in one plane: write the new `Facade` in the text",
        "立面のすべての階は同じ面にあります。テキストに新しい Facade を書いてください"
    )
}

/// The walk begins with this wall.
pub(super) fn first_wall() -> Text {
    text!(
        "the first wall of the text would vanish, and with it the front: change the text instead",
        "テキストの最初の壁（正面）がなくなります。テキストを書き換えてください"
    )
}

/// No plain wall is left to remove.
pub(super) fn no_room() -> Text {
    text!(
        "the wall beside it is computed and cannot become shorter here: change the text instead",
        "隣の壁は計算で決まり、ここでは縮められません。テキストを書き換えてください"
    )
}

/// The wall would break within a part.
pub(super) fn through_a_part(code: &str) -> Text {
    if code.is_empty() {
        return text!(
            "the wall would break inside of what is computed: change the text instead",
            "計算で決まる部分の途中で壁が折れます。テキストを書き換えてください"
        );
    }
    text!([code]
        "the wall would break inside of `{code}`: break it beside that, or put plain wall there first",
        "「{code}」の途中で壁が折れます。その脇で折るか、先に壁に替えてください"
    )
}

/// The part of the wall is outside its length.
pub(super) fn no_such_part(length: f64) -> Text {
    text!([length]
        "the wall is {length} units long: choose a part of it",
        "この壁の長さは{length}単位です。その中で選んでください"
    )
}

/// The code is unknown.
pub(super) fn unknown_part(part: &str) -> Text {
    text!([part]
        "there is no part `{part}`: choose one of the palette",
        "「{part}」という部材はありません。一覧から選んでください"
    )
}

/// The name has no code in the legacy form.
pub(super) fn long_name(part: &str) -> Text {
    text!([part]
        "`{part}` has no code of five columns, and this form knows no others: convert the text to XML first (`hsd fmt --to xml`)",
        "「{part}」には五桁の記号がなく、この形式では書けません。先に XML へ変換してください（hsd fmt --to xml）"
    )
}

/// The part is too wide.
pub(super) fn too_wide(part: &str) -> Text {
    text!([part]
        "`{part}` is too wide for this place: put plain wall beside it first",
        "「{part}」はここには広すぎます。先に隣を壁に替えてください"
    )
}

/// A void would come first in the walk.
pub(super) fn leading_void() -> Text {
    text!(
        "a void cannot stand first in the first wall: the walk would begin behind it",
        "最初の壁の先頭は空にできません。壁の始点がずれてしまいます"
    )
}

/// The start would lie off the grid.
pub(super) fn odd_start() -> Text {
    text!(
        "the walk would begin between two lines of the grid: change the text instead",
        "壁の始点が格子から外れます。テキストを書き換えてください"
    )
}

/// The height is out of bounds.
pub(super) fn odd_height() -> Text {
    text!(
        "a storey is between 0.1 and 1000 shaku high",
        "階高は 0.1 尺から 1000 尺までです"
    )
}

/// The outline is invalid.
pub(super) fn bad_outline() -> Text {
    text!(
        "an outline goes round along the lines of the grid, in whole units, and neither crosses nor touches itself",
        "外形は格子に沿って整数単位で一周し、交わったり触れたりしてはいけません"
    )
}

/// The corners of a survey are no outline.
pub(super) fn bad_survey() -> Text {
    text!(
        "an outline has three corners or more, an area of at least one square metre, and sides that do not cross",
        "輪郭には三つ以上の隅と 1 平方メートル以上の面積が必要で、辺が交わってはいけません"
    )
}

/// The form of the file has no outlines.
pub(super) fn no_outlines() -> Text {
    text!(
        "this form knows no outlines in metres: convert the text to XML first (`hsd fmt --to xml`)",
        "この形式ではメートルの輪郭を書けません。先に XML へ変換してください（hsd fmt --to xml）"
    )
}

/// The outline lies beyond that of the storey below.
pub(super) fn outside() -> Text {
    text!(
        "the outline lies beyond the storey below: draw it inside of that",
        "外形が下の階からはみ出しています。その内側に描いてください"
    )
}

/// It is the only storey.
pub(super) fn last_storey() -> Text {
    text!(
        "this is the only storey: remove the house instead",
        "階はこれだけです。代わりに家を消してください"
    )
}

/// It is the only house.
pub(super) fn last_house() -> Text {
    text!(
        "this is the only house in the file, and a file needs at least one",
        "ファイルには少なくとも一軒の家が必要です。これが最後の一軒です"
    )
}

/// Comments would be removed.
pub(super) fn comments() -> Text {
    text!(
        "comments stand in it: remove it in the text",
        "中にコメントがあります。テキストで消してください"
    )
}

/// Facades cannot be drawn this way.
pub(super) fn structure() -> Text {
    text!(
        "facades are not drawn this way: change the text instead",
        "立面の形式ではこのようには描けません。テキストを書き換えてください"
    )
}

/// The form of the file has no rooms.
pub(super) fn no_rooms() -> Text {
    text!(
        "this form knows no rooms: convert the text to XML first (`hsd fmt --to xml`)",
        "この形式では部屋を書けません。先に XML へ変換してください（hsd fmt --to xml）"
    )
}

/// The point is on a wall.
pub(super) fn on_a_wall() -> Text {
    text!(
        "a wall stands there: choose a point between walls",
        "そこには壁があります。壁と壁の間を選んでください"
    )
}

/// The point is in no area.
pub(super) fn no_area() -> Text {
    text!(
        "this is outside of the walls, or they do not close: choose a point inside of them",
        "壁の外か、壁が閉じていません。壁の内側を選んでください"
    )
}

/// The area has a room.
pub(super) fn another_room(name: &str) -> Text {
    if name.is_empty() {
        return text!(
            "this area has a room: draw a wall between the two first",
            "ここにはもう部屋があります。先に間に壁を描いてください"
        );
    }
    text!([name]
        "this area is the room `{name}`: draw a wall between the two first",
        "ここは「{name}」です。先に間に壁を描いてください"
    )
}

/// The name cannot be written.
pub(super) fn odd_name(most: usize) -> Text {
    text!([most]
        "a name has at most {most} letters, and no braces",
        "名前は{most}字までで、波括弧は使えません"
    )
}

/// The wall in doubt is not found.
pub(super) fn no_doubtful_wall() -> Text {
    text!(
        "no wall stands at this place any more: accept it here, and draw what is right with the other tools",
        "その場所に壁はもうありません。ここでは確定し、ほかのツールで正しく描いてください"
    )
}

/// The points are no wall.
pub(super) fn bad_inner() -> Text {
    text!(
        "a wall goes along the lines of the grid, in whole units",
        "壁は格子に沿って、整数単位の長さで描いてください"
    )
}

/// A wall stands there.
pub(super) fn wall_there() -> Text {
    text!(
        "a wall stands there already: draw beside it",
        "そこにはもう壁があります。その脇に描いてください"
    )
}

/// The wall leaves the storey.
pub(super) fn wall_outside() -> Text {
    text!(
        "this leaves the storey: draw inside of its walls",
        "階の外に出ています。外壁の内側に描いてください"
    )
}

/// The wall is an outer one.
pub(super) fn outer_wall() -> Text {
    text!(
        "this is an outer wall: move it instead",
        "これは外壁です。代わりに動かしてください"
    )
}

/// The height of a ceiling is out of bounds.
pub(super) fn odd_ceiling(least: f64, most: f64) -> Text {
    text!([least, most]
        "a ceiling is between {least} and {most} shaku above the floor; leave it empty for that of the storey",
        "天井の高さは {least} 尺から {most} 尺までです。空にすると階の高さになります"
    )
}

/// The size of a fixture is out of bounds.
pub(super) fn odd_size(least: f64, most: f64) -> Text {
    text!([least, most]
        "a fixture is between {least} and {most} units wide and deep",
        "造り付けの幅と奥行は {least} から {most} ユニットまでです"
    )
}

/// The fixture is outside of the walls.
pub(super) fn fixture_outside() -> Text {
    text!(
        "this is outside of the walls, or they do not close: place it inside of them",
        "壁の外か、壁が閉じていません。壁の内側に置いてください"
    )
}

/// A wall runs through the fixture.
pub(super) fn through_a_wall() -> Text {
    text!(
        "a wall would run through it: place it beside the wall, or make it smaller",
        "壁が横切ります。壁の脇に置くか、小さくしてください"
    )
}

/// Another fixture is there.
pub(super) fn fixture_there(kind: &str) -> Text {
    text!([kind]
        "another one (`{kind}`) stands there, or stairs come up: place it beside them",
        "そこにはほかの造り付け（{kind}）があるか、階段が上がってきます。その脇に置いてください"
    )
}

/// Stairs without a storey above.
pub(super) fn no_storey_above() -> Text {
    text!(
        "no storey stands above: add one before its stairs",
        "上に階がありません。先に階を加えてください"
    )
}

/// Stairs end in a wall or outside.
pub(super) fn blocked_above() -> Text {
    text!(
        "upstairs a wall is in the way, or the stairs end outside: they rise from their front to the opposite side and need room beyond it",
        "上の階で壁に当たるか、階の外に出ます。階段は正面から反対側へ上り、その先に場所が要ります"
    )
}
