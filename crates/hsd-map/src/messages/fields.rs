//! Messages about the fields of maps, and about what belongs to a map beside its shapes.

use crate::VertexFault;
use hsd_base::budget::{Exhausted, Resource};
use hsd_base::diagnostic::{Diagnostic, Origin, Text};
use hsd_base::text;

/// Two features of one key.
#[cold]
pub fn duplicate_key(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1009,
        origin,
        text!([at]
            "{at}another feature before has the same id",
            "{at}前の地物と同じ ID です"
        ),
    )
    .help(text!(
        "give each feature an id of its own, or name a field as `key` of the layer",
        "地物ごとに異なる ID にするか、レイヤーの `key` に列を指定してください"
    ))
}

/// A field that is written twice.
#[cold]
pub fn duplicate_field(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1010,
        origin,
        text!([at]
            "{at}the field is written twice; the second value counts",
            "{at}フィールドが2回書かれています。2つ目の値を使います"
        ),
    )
    .help(text!("remove one of them", "一方を削除してください"))
}

/// Two lists of features in one collection.
#[cold]
pub fn duplicate_list(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1010,
        origin,
        text!([at]
            "{at}the collection has two lists `features`; both are read",
            "{at}`features` の一覧が2つあります。両方を読みます"
        ),
    )
    .help(text!(
        "other programs read only the last of them; join them",
        "ほかのソフトは後の一覧だけを読みます。一つにまとめてください"
    ))
}

/// Features that were deleted in the editor.
#[cold]
pub fn deleted(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::note(
        1010,
        origin,
        text!([at]
            "{at}it was deleted in JOSM and is left out",
            "{at}JOSM で削除されているため、取り除きました"
        ),
    )
    .help(text!(
        "nothing needs to be done; JOSM keeps deleted things until they are uploaded",
        "対応は不要です。JOSM はアップロードするまで削除したものを残します"
    ))
}

/// Two columns of one name.
#[cold]
pub fn duplicate_column(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1010,
        origin,
        text!([at]
            "{at}two columns have this name; the second is called with a number behind it",
            "{at}同じ名前の列が2つあるので、2つ目の名前に番号を付けました"
        ),
    )
    .help(text!(
        "give each column a name of its own",
        "列ごとに異なる名前にしてください"
    ))
}

/// A text in a field of numbers.
#[cold]
pub fn not_a_number(origin: Origin, at: Text, words: &str) -> Diagnostic {
    Diagnostic::warning(
        1010,
        origin,
        text!([at, words]
            "{at}`{words}` stands in a field of numbers and counts as no value",
            "{at}数のフィールドに `{words}` があるので、値なしとします"
        ),
    )
    .help(text!(
        "write a number, or leave the field empty",
        "数を書くか、空にしてください"
    ))
}

/// Records of vertices that make no outline.
#[cold]
pub fn vertex(origin: Origin, at: Text, why: VertexFault) -> Diagnostic {
    let message = match why {
        VertexFault::NoOutline => text!([at]
            "{at}this vertex names no outline that it belongs to",
            "{at}この頂点には、どの輪郭のものかが書かれていません"
        ),
        VertexFault::NoOrder { records } => text!([at, records]
            "{at}{records} vertices of the outline have no number for their order",
            "{at}輪郭の頂点{records}個に、順を示す数がありません"
        ),
        VertexFault::SameOrder { at: number } => text!([at, number]
            "{at}two vertices of the outline have the same number, {number}, at different places",
            "{at}輪郭の二つの頂点が、違う位置で同じ順 {number} になっています"
        ),
    };
    Diagnostic::warning(1158, origin, message).help(text!(
        "mend the records: each needs the id of its house, and a number of its own for its place round the outline",
        "記録を直してください。各頂点には建物の番号と、輪郭の中で一つだけの順の数が要ります"
    ))
}

/// A column of a type that is read as text.
#[cold]
pub fn column_type(origin: Origin, at: Text, of: char) -> Diagnostic {
    Diagnostic::warning(
        1010,
        origin,
        text!([at, of]
            "{at}the type `{of}` of this column is read as text",
            "{at}この列の型 `{of}` は文字列として読み込みます"
        ),
    )
    .help(text!(
        "save the table with numbers and texts only",
        "表を数と文字列だけで保存してください"
    ))
}

/// A feature without a row in the table.
#[cold]
pub fn no_row(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1010,
        origin,
        text!([at]
            "{at}the table has no row for this feature, so its fields are empty",
            "{at}表にこの地物の行がないので、フィールドは空です"
        ),
    )
    .help(text!(
        "the .shp and the .dbf do not belong together; get both again",
        ".shp と .dbf が対応していません。両方を入手し直してください"
    ))
}

/// A text that is not in the encoding of the map.
#[cold]
pub fn encoding(origin: Origin, at: Text) -> Diagnostic {
    Diagnostic::warning(
        1011,
        origin,
        text!([at]
            "{at}the text holds bytes that are not in the encoding of the map",
            "{at}地図の文字コードにないバイトがあります"
        ),
    )
    .help(text!(
        "name the encoding at the layer, such as `encoding=\"cp932\"`",
        "レイヤーに `encoding=\"cp932\"` のように書いてください"
    ))
}

/// An encoding that is not known.
#[cold]
pub fn unknown_encoding(origin: Origin, at: Text, name: &str) -> Diagnostic {
    Diagnostic::warning(
        1011,
        origin,
        text!([at, name]
            "{at}there is no encoding `{name}`",
            "{at}文字コード `{name}` はありません"
        ),
    )
    .help(text!(
        "write for example `cp932`, `utf-8` or `euc-jp`",
        "`cp932`、`utf-8`、`euc-jp` などと書いてください"
    ))
}

/// A file that belongs to a map is missing.
#[cold]
pub fn missing_part(origin: Origin, at: Text, part: &str) -> Diagnostic {
    Diagnostic::warning(
        1012,
        origin,
        text!([at, part]
            "{at}the file {part} is missing beside it",
            "{at}隣に {part} ファイルがありません"
        ),
    )
    .help(text!(
        "copy all files of the shapefile: .shp is the shapes, .dbf the fields, .prj the reference system",
        "シェープファイルのすべてのファイルを写してください。.shp は形、.dbf は属性、.prj は座標系です"
    ))
}

/// A table of another length than the shapes.
#[cold]
pub fn counts_differ(origin: Origin, at: Text, said: u64, found: u64) -> Diagnostic {
    Diagnostic::warning(
        1012,
        origin,
        text!([at, said, found]
            "{at}the table has {said} rows for {found} shapes",
            "{at}{found}個の形に対して表は{said}行です"
        ),
    )
    .help(text!(
        "the .shp and the .dbf do not belong together; get both again",
        ".shp と .dbf が対応していません。両方を入手し直してください"
    ))
}

/// A feature of which the map lacks parts.
#[cold]
pub fn missing_members(origin: Origin, at: Text, members: usize) -> Diagnostic {
    Diagnostic::warning(
        1012,
        origin,
        text!([at, members]
            "{at}{members} of the points or lines of this feature are not in the map",
            "{at}この地物の点や線のうち{members}個が地図にありません"
        ),
    )
    .help(text!(
        "it lies at the edge of the extract; take a larger one",
        "切り出した範囲の端にあります。広い範囲を使ってください"
    ))
}

/// A grid with another number of cells than its head says.
#[cold]
pub fn cells_differ(origin: Origin, at: Text, said: u64, found: u64) -> Diagnostic {
    Diagnostic::warning(
        1012,
        origin,
        text!([at, said, found]
            "{at}the head of the grid says {said} cells, and {found} follow",
            "{at}格子の見出しではセルが {said} 個ですが、続くのは {found} 個です"
        ),
    )
    .help(text!(
        "get the file again; cells without a height have no ground",
        "ファイルを入手し直してください。高さのないセルは地面になりません"
    ))
}

/// A map that expands to more than its account allows.
#[cold]
pub fn exhausted(origin: Origin, at: Text, what: Exhausted) -> Diagnostic {
    let limit = what.limit;
    let (en, ja) = match what.of {
        Resource::Points => ("points", "点"),
        Resource::TextBytes => ("bytes of text", "文字列のバイト数"),
        Resource::Features => ("features", "地物"),
        Resource::InflatedBytes => ("unpacked bytes", "展開後のバイト数"),
        Resource::Pixels => ("cells", "セル"),
    };
    Diagnostic::error(
        1013,
        origin,
        text!([at, limit, en, ja]
            "{at}the map expands to more than its size and a budget of {limit} {en} allow, by repetition or compression",
            "{at}繰り返しや圧縮を展開すると、ファイルの大きさと一度の実行の上限（{ja} {limit}）から許される量を超えます"
        ),
    )
    .help(text!(
        "no map of a town does this; get the file again, split it, or raise the limit with `--max-memory`",
        "町の地図としては異常です。ファイルを入手し直すか、分けるか、`--max-memory` で上限を上げてください"
    ))
}

/// A map that exceeds a limit.
#[cold]
pub fn too_large(origin: Origin, at: Text, what: &str, limit: u64) -> Diagnostic {
    Diagnostic::error(
        1013,
        origin,
        text!([at, what, limit]
            "{at}the map has more than {limit} {what}",
            "{at}地図が上限を超えています（{what} が{limit}を超過）"
        ),
    )
    .help(text!(
        "this is no map of a town; split it, or simplify the feature",
        "町の地図ではありません。分けるか、地物を単純にしてください"
    ))
}
