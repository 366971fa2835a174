//! Messages about maps (HSD10xx): files, features, reference systems.

mod fields;

pub use fields::*;

use crate::{OtherGrid, Outside};
use hsd_base::diagnostic::{Diagnostic, Origin, Text};
use hsd_base::text;

/// Returns the place of a fault: file, feature, field, byte; and the number of cases if there are several.
pub fn place(
    origin: &Origin,
    file: &str,
    feature: Option<&str>,
    field: Option<&str>,
    byte: Option<u64>,
    cases: usize,
) -> Text {
    let mut parts = vec![];
    if !matches!(origin, Origin::Feature { .. }) {
        parts.push(text!([file] "{file}", "{file}"));
        parts.extend(feature.map(|key| text!([key] "feature {key}", "地物 {key}")));
    }
    parts.extend(field.map(|name| text!([name] "field `{name}`", "フィールド `{name}`")));
    parts.extend(byte.map(|byte| text!([byte] "byte {byte}", "{byte}バイト目")));
    if cases > 1 {
        let more = cases - 1;
        parts.push(text!([more] "and {more} more like it", "ほか{more}件"));
    }
    if parts.is_empty() {
        return text!("", "");
    }
    let at = Text::joined(parts, ", ", "、");
    text!([at] "{at}: ", "{at}：")
}

/// A map that is not there or may not be read.
#[cold]
pub fn unreadable(origin: Origin, at: Text, why: &str) -> Diagnostic {
    Diagnostic::error(
        1001,
        origin,
        text!([at, why]
            "{at}the map cannot be read: {why}",
            "{at}地図を読み込めません（{why}）"
        ),
    )
    .help(text!(
        "check that its name is spelled right, that it lies below the folder of the town file, and that you may read it",
        "名前のつづり、町のファイルのフォルダの下にあること、読み取りの許可を確かめてください"
    ))
}

/// A map of a format that is not read.
#[cold]
pub fn unknown_format(origin: Origin, at: Text, file: &str) -> Diagnostic {
    Diagnostic::error(
        1002,
        origin,
        text!([at, file]
            "{at}this is no map of a format that is read; `ogr2ogr -f FlatGeobuf map.fgb {file}` converts many others",
            "{at}読み込める形式の地図ではありません。多くの形式は `ogr2ogr -f FlatGeobuf map.fgb {file}` で変換できます"
        ),
    )
    .help(text!(
        "GeoJSON, FlatGeobuf, shapefiles, OpenStreetMap (XML and PBF), MOJ map XML, CityGML, GeoPackage, GeoParquet and tables of points (CSV) are read",
        "GeoJSON、FlatGeobuf、シェープファイル、OpenStreetMap（XML と PBF）、法務省地図 XML、CityGML、GeoPackage、GeoParquet、点の表（CSV）を読み込みます"
    ))
}

/// A map of a format that this program was built without.
#[cold]
pub fn not_built(origin: Origin, at: Text, file: &str, feature: &str) -> Diagnostic {
    Diagnostic::error(
        1002,
        origin,
        text!([at, file]
            "{at}this hsd was built without this format; `ogr2ogr -f FlatGeobuf map.fgb {file}` converts it",
            "{at}この hsd はこの形式を含めずにビルドされています。`ogr2ogr -f FlatGeobuf map.fgb {file}` で変換できます"
        ),
    )
    .help(text!([feature]
        "or build hsd with it: `cargo build --release --features {feature}`",
        "または `cargo build --release --features {feature}` でビルドしてください"
    ))
}

/// A table of text without columns of coordinates.
#[cold]
pub fn no_coordinates(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::error(
        1002,
        origin,
        text!([at]
            "{at}no columns of coordinates in this table",
            "{at}この表には座標の列がありません"
        ),
    )
    .help(text!(
        "name two columns `lon` and `lat` (経度, 緯度), or `x` and `y` in metres",
        "2つの列の名前を「経度」「緯度」（lon、lat）、またはメートルの x、y にしてください"
    ))
}

/// A layer that the file lacks.
#[cold]
pub fn no_layer(origin: Origin, at: Text, layer: &str) -> Diagnostic {
    Diagnostic::error(
        1002,
        origin,
        text!([at, layer]
            "{at}the map has no layer `{layer}`",
            "{at}地図にレイヤー `{layer}` がありません"
        ),
    )
    .help(text!(
        "leave `layer` out, or name one that the file has",
        "`layer` を省くか、ファイルにあるレイヤーの名前にしてください"
    ))
}

/// A map that is damaged from a place on.
#[cold]
pub fn damaged(origin: Origin, at: Text, what: &str) -> Diagnostic {
    Diagnostic::error(
        1003,
        origin,
        text!([at, what]
            "{at}the map is damaged here and is read no further: {what}",
            "{at}地図がここで壊れているため、この先を読み込めません（{what}）"
        ),
    )
    .help(text!(
        "get the file again, or open and save it in a program for maps",
        "ファイルを入手し直すか、地図のソフトで開いて保存し直してください"
    ))
}

/// A map without features.
#[cold]
pub fn no_features(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::error(
        1015,
        origin,
        text!([at]
            "{at}the map is empty: it has no features",
            "{at}地図が空です。地物がありません"
        ),
    )
    .help(text!(
        "export it again with the area and the layer that you want",
        "範囲とレイヤーを確かめて書き出し直してください"
    ))
}

/// A feature that is not written as its format demands.
#[cold]
pub fn malformed(origin: Origin, at: Text, what: &str) -> Diagnostic {
    Diagnostic::warning(
        1004,
        origin,
        text!([at, what]
            "{at}the feature cannot be read: {what}",
            "{at}地物を読み込めません（{what}）"
        ),
    )
    .help(text!(
        "the features before and after it are read; correct it in a program for maps",
        "前後の地物は読み込みます。地図のソフトで直してください"
    ))
}

/// A feature without geometry.
#[cold]
pub fn no_geometry(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1005,
        origin,
        text!([at]
            "{at}the feature has no geometry",
            "{at}地物に形がありません"
        ),
    )
    .help(text!(
        "nothing can be built of it; remove it, or draw it",
        "何も建てられません。削除するか、形を描いてください"
    ))
}

/// A feature of a kind of geometry that is not read.
#[cold]
pub fn other_geometry(origin: Origin, at: Text, name: &str) -> Diagnostic {
    Diagnostic::warning(
        1005,
        origin,
        text!([at, name]
            "{at}the geometry is a {name}, which is not read",
            "{at}形の種類「{name}」は読み込みません"
        ),
    )
    .help(text!(
        "split it into points, lines or areas",
        "点、線、面に分けてください"
    ))
}

/// A feature that is no area, in a layer whose areas are divided.
#[cold]
pub fn not_divided(origin: Origin, at: Text, shape: &str) -> Diagnostic {
    let ja = if shape == "point" { "点" } else { "線" };
    Diagnostic::warning(
        1005,
        origin,
        text!([at, shape, ja]
            "{at}`Divide` divides areas, and the geometry is a {shape}: it is left out",
            "{at}`Divide` は面を町割りします。形が{ja}なので除きます"
        ),
    )
    .help(text!(
        "keep areas alone with `where`, or put the others into a layer of their own",
        "`where` で面だけを残すか、ほかの形を別のレイヤーにしてください"
    ))
}

/// A line or ring of too few points.
#[cold]
pub fn too_few_points(origin: Origin, at: Text, points: usize) -> Diagnostic {
    Diagnostic::warning(
        1005,
        origin,
        text!([at, points]
            "{at}the geometry has only {points} different points; a line needs 2, an area 3",
            "{at}形に異なる点が{points}個しかありません。線には2個、面には3個が必要です"
        ),
    )
    .help(text!(
        "remove the feature, or draw it again",
        "地物を削除するか、描き直してください"
    ))
}

/// A coordinate that is no number.
#[cold]
pub fn not_finite(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1005,
        origin,
        text!([at]
            "{at}a coordinate is not a number",
            "{at}座標に数でない値があります"
        ),
    )
    .help(text!(
        "the file was written by a program that lost the place; draw the feature again",
        "位置を失ったソフトで書かれています。地物を描き直してください"
    ))
}

/// A ring that was closed.
#[cold]
pub fn unclosed(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1006,
        origin,
        text!([at]
            "{at}the outline is not closed; it was closed by a straight side",
            "{at}輪郭が閉じていないので、直線で閉じました"
        ),
    )
    .help(text!(
        "end the ring at its first point",
        "輪を最初の点で終えてください"
    ))
}

/// A ring that crosses itself.
#[cold]
pub fn crossing(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1006,
        origin,
        text!([at]
            "{at}the outline crosses itself or its own holes",
            "{at}輪郭がそれ自身または穴と交差しています"
        ),
    )
    .help(text!(
        "draw it again, or repair it in a program for maps (in QGIS: Fix geometries)",
        "描き直すか、地図のソフトで直してください（QGIS では「ジオメトリを修復」）"
    ))
}

/// Points that stand on the one before.
#[cold]
pub fn doubled_points(origin: Origin, at: Text, points: usize) -> Diagnostic {
    Diagnostic::note(
        1006,
        origin,
        text!([at, points]
            "{at}{points} points stand on the one before and were left out",
            "{at}直前の点と重なる点{points}個を省きました"
        ),
    )
    .help(text!(
        "nothing needs to be done",
        "何もする必要はありません"
    ))
}

/// Parts of too few points.
#[cold]
pub fn dropped_parts(origin: Origin, at: Text, parts: usize) -> Diagnostic {
    Diagnostic::warning(
        1006,
        origin,
        text!([at, parts]
            "{at}{parts} parts of the geometry have too few points and were left out",
            "{at}点が足りない部分{parts}個を省きました"
        ),
    )
    .help(text!(
        "remove these parts, or draw them again",
        "その部分を削除するか、描き直してください"
    ))
}

/// A reference system that is not known.
#[cold]
pub fn unknown_crs(origin: Origin, at: Text, name: &str) -> Diagnostic {
    Diagnostic::warning(
        1008,
        origin,
        text!([at, name]
            "{at}the coordinate reference system `{name}` is not known",
            "{at}座標参照系 `{name}` が分かりません"
        ),
    )
    .help(text!(
        "name it at the layer, such as `crs=\"EPSG:6674\"`, or convert the map",
        "レイヤーに `crs=\"EPSG:6674\"` のように書くか、地図を変換してください"
    ))
}

/// A second reference system.
#[cold]
pub fn late_crs(origin: Origin, at: Text, name: &str) -> Diagnostic {
    Diagnostic::warning(
        1008,
        origin,
        text!([at, name]
            "{at}the map names a second coordinate reference system, `{name}`, which is ignored",
            "{at}地図に2つ目の座標参照系 `{name}` が書かれていますが、無視します"
        ),
    )
    .help(text!(
        "convert the map so that all of it has one system",
        "地図全体が1つの座標系になるように変換してください"
    ))
}

/// Coordinates that cannot be of the reference system.
#[cold]
pub fn outside_crs(
    origin: Origin,
    at: Text,
    x: f64,
    y: f64,
    crs: &str,
    seems: Outside,
) -> Diagnostic {
    let seems = match seems {
        Outside::Degrees => text!("they seem to be degrees", "度の値のようです"),
        Outside::Swapped => text!(
            "latitude and longitude seem to be swapped",
            "緯度と経度が逆のようです"
        ),
        Outside::Metres => text!("they seem to be metres", "メートルの値のようです"),
        Outside::Far => text!("they are too far off", "遠すぎます"),
    };
    let [x, y] = [x, y].map(shown);
    Diagnostic::error(
        1007,
        origin,
        text!([at, x, y, crs, seems]
            "{at}the coordinates {x}, {y} cannot be of {crs}: {seems}",
            "{at}座標 {x}, {y} は {crs} の値ではありません。{seems}"
        ),
    )
    .help(text!(
        "name the system that the map is in at the layer, such as `crs=\"EPSG:6674\"`",
        "地図の座標系をレイヤーに `crs=\"EPSG:6674\"` のように書いてください"
    ))
}

/// Returns a coordinate as text; a very large one with its exponent.
fn shown(coordinate: f64) -> String {
    match coordinate.abs() < 1e12 {
        true => coordinate.to_string(),
        false => format!("{coordinate:e}"),
    }
}

/// A feature far from the middle of the town.
#[cold]
pub fn outlier(origin: Origin, at: Text, kilometres: u64) -> Diagnostic {
    Diagnostic::warning(
        1007,
        origin,
        text!([at, kilometres]
            "{at}it lies {kilometres} km from the middle of the town and is left out",
            "{at}町の中央から {kilometres} km 離れているため、取り除きました"
        ),
    )
    .help(text!(
        "correct its coordinates, or leave it out with `where`",
        "座標を直すか、`where` で除いてください"
    ))
}

/// Heights that cannot be.
#[cold]
pub fn no_heights(origin: Origin, at: Text, points: usize) -> Diagnostic {
    Diagnostic::warning(
        1005,
        origin,
        text!([at, points]
            "{at}{points} points have a height below -500 m or above 9,000 m; it is taken as missing",
            "{at}{points} 個の点の高さが -500 m 未満または 9,000 m を超えるため、高さなしとして扱います"
        ),
    )
    .help(text!(
        "programs for maps write -9999 where they know no height; remove such values",
        "地図のソフトは高さが不明な点に -9999 などを書きます。そのような値を消してください"
    ))
}

/// A grid that holds no heights, or holds them in a way that is not read.
#[cold]
pub fn other_grid(origin: Origin, at: Text, what: OtherGrid) -> Diagnostic {
    let what = match what {
        OtherGrid::Colours => text!(
            "it has several bands, as a picture has",
            "画像のように複数のバンドがあります"
        ),
        OtherGrid::Bytes => text!(
            "its cells are bytes, as those of a picture are",
            "画像のようにセルが1バイトです"
        ),
        OtherGrid::NoPlace => text!("it does not say where it lies", "位置が書かれていません"),
        OtherGrid::Turned => text!(
            "its rows do not run from west to east",
            "行が西から東へ並んでいません"
        ),
        OtherGrid::Packing => text!(
            "its compression, or the form of its numbers, is none that is read",
            "圧縮または数値の形式を読めません"
        ),
        OtherGrid::Unit => text!(
            "its heights are in a unit that is not known",
            "標高の単位が分かりません"
        ),
    };
    Diagnostic::error(
        1014,
        origin,
        text!([at, what]
            "{at}this grid cannot be read as heights: {what}",
            "{at}この格子は標高として読めません（{what}）"
        ),
    )
    .help(text!(
        "`gdalwarp -t_srs EPSG:6674 -ot Float32 -co COMPRESS=DEFLATE in.tif heights.tif` makes one that is read (with the plane of the town)",
        "`gdalwarp -t_srs EPSG:6674 -ot Float32 -co COMPRESS=DEFLATE in.tif heights.tif` で読める形に変換できます（座標系は町のもの）"
    ))
}
