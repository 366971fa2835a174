//! Messages about towns (HSD11xx).

mod accounts;
mod frame;
mod law;
mod outdoors;

pub use accounts::{centre_outside, covered, drawn_twice, layer_unused};
pub use frame::{crs_not_in_metres, unknown_crs};
pub use law::no_guiding_height;
pub use outdoors::{no_font, not_laid};

use hsd_base::diagnostic::messages::words::{all_of, quote};
use hsd_base::diagnostic::{Diagnostic, Noun, Origin, Text};
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::messages::xml::{known, offer};

/// A layer that the town does not have.
#[cold]
pub fn unknown_layer(span: Span, name: &str, near: Option<&str>, layers: &[String]) -> Diagnostic {
    let name = quote(name);
    let message = text!([name] "there is no layer {name}", "{name} というレイヤーはありません");
    let all = known(layers);
    let found = Diagnostic::error(1101, span, message).help(text!([all]
        "the layers of this town are {all}",
        "この町のレイヤー: {all}"
    ));
    offer(found, span, near)
}

/// Two layers, or two tables, of one name.
#[cold]
pub fn same_name(span: Span, name: &str, first: Span) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "the name {name} is given twice",
        "{name} という名が二度使われています"
    );
    Diagnostic::error(1102, span, message)
        .label(first, text!("first given here", "最初はここ"))
        .help(text!(
            "give each layer and each table a name of its own",
            "レイヤーと表には別々の名を付けてください"
        ))
}

/// A file of a table that cannot be used.
#[cold]
pub fn no_table(span: Span, path: &str, why: &Text) -> Diagnostic {
    let path = quote(path);
    let message = text!([path, why]
        "the table {path} cannot be read: {why}",
        "表 {path} を読めません: {why}"
    );
    Diagnostic::error(1103, span, message).help(text!(
        "a table is a CSV file in UTF-8 or Shift_JIS whose first line names the columns",
        "表は UTF-8 か Shift_JIS の CSV で、最初の行に列の名を書きます"
    ))
}

/// A word that a table does not have; `argument` counts the arguments of `look` from 0.
#[cold]
pub fn not_in_table(
    span: Span,
    argument: usize,
    word: &str,
    near: Option<&str>,
    words: &[String],
) -> Diagnostic {
    let (quoted, all) = (quote(word), known(words));
    let message = match argument {
        0 => text!([quoted] "there is no table {quoted}", "{quoted} という表はありません"),
        1 => text!([quoted] "the table has no row {quoted}", "表に {quoted} の行がありません"),
        _ => text!([quoted] "the table has no column {quoted}", "表に {quoted} の列がありません"),
    };
    let found = Diagnostic::error(1104, span, message)
        .help(text!([all] "there are {all}", "あるもの: {all}"));
    match near {
        Some(near) if argument != 1 => offer(found, span, Some(near)),
        _ => found,
    }
}

/// An attribute of a `Place` whose value comes from the map.
#[cold]
pub fn place_is_given(span: Span, name: &str, whole: Span) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "{name} has no meaning in a town: the map says where a house stands",
        "町では {name} に意味がありません。建物の位置は地図が決めます"
    );
    Diagnostic::error(1105, span, message)
        .help(text!(
            "leave it out; `on`, `front`, `cap` and `gap` say how the house stands on its plot",
            "書かないでください。敷地への置き方は `on`、`front`、`cap`、`gap` で決めます"
        ))
        .fix(
            text!([name] "Remove {name}", "{name} を削除する"),
            whole,
            "",
        )
}

/// Features that lack a field that an expression asks for.
#[cold]
pub fn field_missing(span: Span, name: &str, count: usize) -> Diagnostic {
    let quoted = quote(name);
    let message = text!([quoted, count]
        "{count} features have no {quoted}: a test with it does not hold, a parameter keeps its default",
        "{count} 件の地物に {quoted} がありません。条件は成り立たず、変数は既定値のままです"
    );
    Diagnostic::warning(1106, span, message).help(text!([name]
        "say what holds then in the layer: `<Field name=\"{name}\" default=\"...\"/>`",
        "無いときの値をレイヤーに書いてください: `<Field name=\"{name}\" default=\"...\"/>`"
    ))
}

/// Features of which nothing is made, by layer.
#[cold]
pub fn nothing_made(layer: Span, name: &str, count: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!([name, count]
        "{count} features of {name} meet no rule, and nothing is made of them",
        "{name} の {count} 件の地物はどの規則にも合わず、何も作られません"
    );
    Diagnostic::warning(1107, layer, message).help(text!(
        "write a `for` that takes them, or one with `<Skip because=\"...\"/>` if nothing is wanted",
        "それらを受ける `for` を書くか、不要なら `<Skip because=\"...\"/>` を書いてください"
    ))
}

/// A house that cannot stand where its feature is.
#[cold]
pub fn refused(origin: Origin, why: &Text) -> Diagnostic {
    let message = text!([why] "no house can stand here: {why}", "ここには建物を置けません: {why}");
    Diagnostic::warning(1108, origin, message).help(text!(
        "`on=\"outline\"` follows the walls of the map whatever their shape; `Skip` says that nothing is wanted",
        "`on=\"outline\"` なら形によらず地図の壁に沿います。不要なら `Skip` と書いてください"
    ))
}

/// A house with errors, which is replaced by its plain body.
#[cold]
pub fn plain_body(origin: Origin, kind: &str, first: &Text) -> Diagnostic {
    let kind = quote(kind);
    let message = text!([kind, first]
        "the house {kind} has errors, and plain walls stand in its place: {first}",
        "建物 {kind} に誤りがあり、代わりに無地の壁を建てました: {first}"
    );
    Diagnostic::warning(1109, origin, message).help(text!(
        "mend the type or the parameters that the map gives it",
        "型か、地図から渡す変数を直してください"
    ))
}

/// A house that is larger than its outline, which is replaced by its plain body.
#[cold]
pub fn too_large(origin: Origin, kind: &str, off: f64) -> Diagnostic {
    let (kind, off) = (quote(kind), (off * 10.0).round() / 10.0);
    let message = text!([kind, off]
        "the house {kind} would leave its outline by {off} m, and plain walls stand in its place",
        "建物 {kind} が輪郭から {off} m はみ出すため、代わりに無地の壁を建てました"
    );
    Diagnostic::warning(1109, origin, message).help(text!(
        "give it a smaller size, or a `test` that takes larger features; `on=\"centre\"` puts it over the outline",
        "寸法を小さくするか、大きな地物だけを受ける `test` を書いてください。`on=\"centre\"` なら輪郭の上に置きます"
    ))
}

/// A town without streets.
#[cold]
pub fn no_streets(town: Span) -> Diagnostic {
    let message = text!(
        "no layer of this town is known to be streets: houses front the side with the longest free way before it",
        "この町には通りとわかるレイヤーがありません。建物は前がいちばん空いている辺を正面にします"
    );
    Diagnostic::note(1110, town, message).help(text!(
        "name the layer in `front`: `<Place front=\"roads\" .../>`",
        "`front` でレイヤーを指定してください: `<Place front=\"roads\" .../>`"
    ))
}

/// A town where houses are expected.
#[cold]
pub fn is_town(town: Span) -> Diagnostic {
    let message = text!(
        "this is a town, whose houses are made from maps",
        "これは町のファイルで、建物は地図から作られます"
    );
    Diagnostic::error(1111, town, message).help(text!(
        "build it with `hsd town FILE -o OUT.glb`",
        "`hsd town FILE -o OUT.glb` で作ってください"
    ))
}

/// Keys that several features of a layer share.
#[cold]
pub fn same_keys(layer: Span, name: &str, keys: &[String]) -> Diagnostic {
    let (name, count) = (quote(name), keys.len());
    let few: Vec<&str> = keys.iter().take(3).map(|k| &**k).collect();
    let few = all_of(&few);
    let message = text!([name, count, few]
        "{count} keys of {name} belong to several features, such as {few}",
        "{name} では {count} 個のキーが複数の地物に付いています（{few} など）"
    );
    Diagnostic::warning(1112, layer, message).help(text!(
        "name a field with a value for each feature in `key`, or leave `key` out",
        "地物ごとに違う値の属性を `key` に書くか、`key` を書かないでください"
    ))
}

/// A number or a truth value that a field's default or text does not give.
#[cold]
pub fn not_of_type(span: Span, text: &str, wanted: &Text) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted, wanted]
        "{quoted} is not {wanted}",
        "{quoted} は{wanted}ではありません"
    );
    Diagnostic::error(1113, span, message).help(text!(
        "change the value, or the `type` of the field",
        "値か、属性の `type` を直してください"
    ))
}

/// A town in the input that has no layers.
#[cold]
pub fn no_layers(town: Span) -> Diagnostic {
    let message = text!("this town has no layers", "この町にはレイヤーがありません");
    Diagnostic::error(1114, town, message).help(text!(
        "add a map: `<Layer name=\"houses\" src=\"buildings.geojson\"/>`",
        "地図を加えてください: `<Layer name=\"houses\" src=\"buildings.geojson\"/>`"
    ))
}

/// A map that cannot be read.
#[cold]
pub fn no_map(span: Span, path: &str, why: &Text) -> Diagnostic {
    let path = quote(path);
    let message = text!([path, why]
        "the map {path} cannot be read: {why}",
        "地図 {path} を読めません: {why}"
    );
    Diagnostic::error(1115, span, message).help(text!(
        "check the name of the file, and what the layer says of it",
        "ファイル名と、レイヤーの属性を確かめてください"
    ))
}

/// A `where` that is no test.
#[cold]
pub fn no_test(span: Span, wanted: Noun) -> Diagnostic {
    let message = text!([wanted]
        "expected {wanted} in the `where` of a layer",
        "レイヤーの `where` のここには{wanted}が要ります"
    );
    Diagnostic::error(1140, span, message).help(text!(
        "write a test on the fields of the features, such as `building = 'house' and levels > 1`",
        "`building = 'house' and levels > 1` のように、地物の属性の条件を書いてください"
    ))
}

/// A `where` that asks for a field that the layer does not have.
#[cold]
pub fn unknown_field(span: Span, name: &str, near: Option<&str>, fields: &[String]) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "no feature of this layer has a field {name}",
        "このレイヤーの地物に {name} という属性はありません"
    );
    let all = known(fields);
    let found = Diagnostic::error(1141, span, message)
        .help(text!([all] "the fields are {all}", "属性: {all}"));
    offer(found, span, near)
}

/// A layer of which the `where` passes no feature.
#[cold]
pub fn nothing_passes(span: Span, features: usize) -> Diagnostic {
    let message = text!([features]
        "none of the {features} features of this layer passes its `where`",
        "このレイヤーの地物 {features} 件のどれも `where` に合いません"
    );
    Diagnostic::warning(1142, span, message).help(text!(
        "compare the test with the values in the map; texts are compared with their case",
        "地図の値と条件を見比べてください。大文字と小文字は区別されます"
    ))
}

/// A map whose file does not say its coordinates, which are no degrees.
#[cold]
pub fn no_crs(span: Span, path: &str) -> Diagnostic {
    let path = quote(path);
    let message = text!([path]
        "the file {path} does not say what its coordinates are, and they are too large for degrees",
        "{path} には座標系の記載がなく、値は度としては大きすぎます"
    );
    Diagnostic::error(1143, span, message).help(text!(
        "say it in the layer: a plane zone such as `crs=\"EPSG:6674\"`, or `crs=\"local\"` for metres as they are",
        "レイヤーに書いてください。平面直角座標系なら `crs=\"EPSG:6674\"` など、そのままのメートルなら `crs=\"local\"`"
    ))
}

/// Outlines of features that are no points, or an order of what is no outline.
#[cold]
pub fn no_vertices(span: Span, is_order: bool) -> Diagnostic {
    let message = match is_order {
        true => text!(
            "`order` says nothing without `outline`",
            "`outline` がないので `order` に意味がありません"
        ),
        false => text!(
            "only points are joined to outlines, and this layer has other features",
            "輪郭に結べるのは点だけですが、このレイヤーには点でない地物があります"
        ),
    };
    Diagnostic::error(1157, span, message).help(text!(
        "`outline` and `order` are for records of vertices: `<Layer name=\"houses\" src=\"vertices.csv\" outline=\"house\" order=\"number\"/>`",
        "`outline` と `order` は頂点の記録に使います: `<Layer name=\"houses\" src=\"vertices.csv\" outline=\"house\" order=\"number\"/>`"
    ))
}

/// A `Rear` at features without an area.
#[cold]
pub fn rear_of_no_lot(rear: Span) -> Diagnostic {
    let message = text!(
        "only a lot has a rear: the features of this layer are lines or points",
        "裏があるのは敷地だけです。このレイヤーの地物は線か点です"
    );
    Diagnostic::error(1150, rear, message).help(text!(
        "write `Rear` in a `for` over a layer of lots, after the `Place` of the house to the street",
        "敷地のレイヤーの `for` で、通り側の家の `Place` のあとに `Rear` を書いてください"
    ))
}

/// A density that is no share.
#[cold]
pub fn no_density(span: Span, value: &str) -> Diagnostic {
    let value = quote(value);
    let message = text!([value]
        "{value} is no density: it is a share from 0 to 1",
        "{value} は密度になりません。0 から 1 の割合で書きます"
    );
    Diagnostic::error(1151, span, message).help(text!(
        "0 leaves the rear to the owner of the lot, 1 fills it with dwellings along an alley; hold a number of the map between them with `{{clamp(n, 0, 1)}}`",
        "0 なら裏は家主のもの、1 なら路地沿いに長屋が建て込みます。地図の数値は `{{clamp(n, 0, 1)}}` で範囲に収められます"
    ))
}

/// A `Rear` on lots on which no rectangle stands before it.
#[cold]
pub fn rear_of_no_house(origin: Origin) -> Diagnostic {
    let message = text!(
        "nothing stands at the rear of this lot, since no house on its front leaves it: a `Place` with `on=\"plot\"` does",
        "この敷地の裏には何も建ちません。裏を空けて通り側に立つ家（`on=\"plot\"` の `Place`）がありません"
    );
    Diagnostic::warning(1152, origin, message).help(text!(
        "write `<Place type=\"...\" on=\"plot\"/>` before the `Rear`; `on=\"outline\"` and `on=\"centre\"` leave no rear",
        "`Rear` の前に `<Place type=\"...\" on=\"plot\"/>` を書いてください。`on=\"outline\"` と `on=\"centre\"` は裏を残しません"
    ))
}

/// A layer without points where points are joined to outlines, or outlines that are none.
#[cold]
pub fn no_points(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "the features of {name} are no points: only points are joined to outlines",
        "{name} の地物は点ではありません。輪郭に結べるのは点だけです"
    );
    Diagnostic::error(1153, span, message).help(text!(
        "write the `Join` in the layer of outlines, and name the layer of points in it",
        "`Join` は輪郭のレイヤーの中に書き、点のレイヤーの名を指定してください"
    ))
}

/// Outlines to which several points belong.
#[cold]
pub fn several_points(span: Span, name: &str, outlines: usize, left: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!([name, outlines, left]
        "{outlines} outlines have several points of {name}: {left} points more than outlines, whose fields are not used",
        "{outlines} 個の輪郭に {name} の点が複数あり、余った {left} 個の点の属性は使われません"
    );
    Diagnostic::warning(1154, span, message).help(text!(
        "the point nearest to the middle of its outline counts, or the first one with its key; `where` in the layer of points leaves others out",
        "輪郭の中心にいちばん近い点（キーで結ぶときは最初の点）を使います。点のレイヤーの `where` でほかを除けます"
    ))
}

/// Points that belong to no outline.
#[cold]
pub fn points_without_outline(span: Span, name: &str, points: usize, by_key: bool) -> Diagnostic {
    let name = quote(name);
    let found = match by_key {
        true => text!([name, points]
            "{points} points of {name} have the key of no outline",
            "{name} の {points} 個の点は、どの輪郭のキーも持っていません"
        ),
        false => text!([name, points]
            "{points} points of {name} lie in no outline",
            "{name} の {points} 個の点は、どの輪郭にも入っていません"
        ),
    };
    let help = match by_key {
        true => text!(
            "compare the field with the keys in the table of decisions; the report lists the points",
            "属性の値と決定の表のキーを見比べてください。点は報告に並びます"
        ),
        false => text!(
            "`within=\"2\"` joins a point to the nearest outline up to 2 m away; the report lists the points",
            "`within=\"2\"` なら 2 m 以内のいちばん近い輪郭に結びます。点は報告に並びます"
        ),
    };
    Diagnostic::warning(1155, span, found).help(help)
}

/// Fields in which outlines and their points differ.
#[cold]
pub fn fields_differ(span: Span, name: &str, fields: &[String], outlines: usize) -> Diagnostic {
    let (name, fields) = (quote(name), known(fields));
    let message = text!([name, fields, outlines]
        "{outlines} outlines have another value than their point of {name} in {fields}: that of the outline counts",
        "{outlines} 個の輪郭では {fields} の値が {name} の点と違い、輪郭の値を使います"
    );
    Diagnostic::warning(1156, span, message).help(text!(
        "give the field of the points a name of its own in their layer: `<Field name=\"...\" from=\"...\"/>`",
        "点のレイヤーで属性に別の名を付けてください: `<Field name=\"...\" from=\"...\"/>`"
    ))
}

/// A layer of heights where features are meant.
#[cold]
pub fn heights_have_no_features(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "{name} is a grid of heights, and has no features",
        "{name} は標高の格子で、地物がありません"
    );
    Diagnostic::error(1160, span, message).help(text!(
        "leave it out: the ground is there for all features, and its height at one is `z`",
        "書かないでください。地盤はすべての地物に使われ、地物の位置の高さは `z` で分かります"
    ))
}

/// A town of heights only.
#[cold]
pub fn heights_alone(town: Span, layer: Span) -> Diagnostic {
    let message = text!(
        "the town has a ground, and no layer of features",
        "町に地盤だけがあり、地物のレイヤーがありません"
    );
    Diagnostic::error(1161, town, message)
        .label(layer, text!("the ground", "地盤"))
        .help(text!(
            "add a `Layer` of outlines, lots or points: the ground is made where they are",
            "輪郭、敷地、点の `Layer` を足してください。地盤はそのある所に作られます"
        ))
}

/// A grid of heights that has none where the town is.
#[cold]
pub fn no_ground_here(span: Span, path: &str) -> Diagnostic {
    let path = quote(path);
    let message = text!([path]
        "the grid {path} has no height where the features of the town are",
        "格子 {path} は町の地物のある所に標高を持っていません"
    );
    Diagnostic::error(1162, span, message).help(text!(
        "take the grid of this place, or name the system of its coordinates: `crs=\"EPSG:6674\"`",
        "その場所の格子を使うか、座標系を `crs=\"EPSG:6674\"` のように書いてください"
    ))
}

/// Features where the ground has no height.
#[cold]
pub fn off_the_ground(layer: Span, name: &str, count: usize, lost: usize) -> Diagnostic {
    let name = quote(name);
    let message = match lost {
        0 => text!([name, count]
            "the ground has no height at {count} features of {name}: the next one within 200 m counts",
            "{name} の {count} 件の地物の位置に標高がありません。200 m 以内の最も近い値を使います"
        ),
        lost => text!([name, count, lost]
            "the ground has no height at {count} features of {name}: the next one within 200 m counts, and {lost} of them have none and stand at their own z, or 0",
            "{name} の {count} 件の地物の位置に標高がありません。200 m 以内の最も近い値を使います。うち {lost} 件はそれもなく、地物の z か 0 に建ちます"
        ),
    };
    Diagnostic::warning(1163, layer, message).help(text!(
        "add a second `Layer` of heights behind the first, which counts where the first has none; the report lists the features",
        "二つ目の標高の `Layer` を後ろに足すと、一つ目に値がない所で使われます。地物は報告に並びます"
    ))
}
