//! The help of `hsd town` and its steps.

use super::CommandHelp;

/// The help of these commands.
pub(in crate::language::japanese) static TOWN: &[CommandHelp] = &[
    CommandHelp {
        path: "town",
        about: "町のファイルに書いた地図のレイヤーから町を作る",
        more: "OUT は 3D Tiles を書くフォルダー(根は `tileset.json`)、一つのモデル (.glb)、タイルごとのモデル (.obj。OUT の横に OUT-TILE.obj)、建物を一つのテキストにしたもの (.hsd)、LoD 1〜3 の CityJSON 2.0 (.city.json、または建物ごとに一行の .city.jsonl。`--detail 0` なら LoD 3 なし) のどれかです。フォルダーの中、またはモデルの横に、地物ごとに一行の `decisions.csv` と `report.json` を書きます。\
               前からあって同じになるタイルはそのまま使うので、中断した実行は続きから進みます。省くと書いていない地物に建物が無ければ、終了コードは 1 です。",
        examples: "\
例:
  hsd town kyoto.hsd -o kyoto/       kyoto/tileset.json とタイル、kyoto/decisions.csv、kyoto/report.json を書く
  hsd town kyoto.hsd -o kyoto.glb --param year=1928
  hsd town kyoto.hsd -o houses.hsd   建物を一棟ずつテキストに書く。手で直せる
  hsd town kyoto.hsd -o kyoto.city.jsonl --detail 0    GIS 用に、壁と屋根を建物ごとに一行で書く",
        arguments: &[
            (
                "output",
                "タイルをこのフォルダーに、または一つのモデルをこのファイルに書く",
                "",
            ),
            (
                "detail",
                "タイルの詳細度をコンマで区切って、またはモデルの詳細度を指定する。0 は壁と屋根、1 は部材ごとにテクスチャー、\
                 2 は開口と太い桟を立体に、3 はすべてを立体に [既定値: `Tiles` のもの、なければ 0,1,3。モデルは 3]",
                "",
            ),
            ("compress", "タイルを Web 向けに圧縮する (EXT_meshopt_compression、KTX2)。大きさとグラフィックメモリーは三分の一ほどになる。`--features compress` を付けてビルドした hsd が必要", ""),
            ("stats", "タイルの三角形、バイト数、描画メモリーの見積もりを表示する", ""),
            ("quiet", "指摘だけを表示する", ""),
        ],
        values: &[],
    },
    CommandHelp {
        path: "town init",
        about: "地図から最初の町のファイルを書く。書き換えて使う",
        more: "地図の層が何か（建物、筆、道、地点）を形と属性から見分け、属性の意味（階数、高さ、種別）を推定します。図郭ごとのファイルのように、同じ種類で同じ場所にあるものは一つのレイヤーになります。地図は TOWN のフォルダーか、その下に置きます。",
        examples: "\
例:
  hsd town init buildings.geojson roads.geojson -o kyoto.hsd
  hsd town init sheets/ -o joetsu.hsd
  hsd town kyoto.hsd -o kyoto.glb",
        arguments: &[
            ("maps", "地図: GeoJSON、シェープファイル、FlatGeobuf、OpenStreetMap、登記所備付地図の XML、CityGML、地点の CSV、標高の格子(GeoTIFF、ESRI ASCII、国土地理院)。フォルダーなら、その中の地図すべて", ""),
            ("output", "町をこのファイルに書く", ""),
            ("force", "すでにあるファイルを置き換える", ""),
        ],
        values: &[],
    },
    CommandHelp {
        path: "town candidates",
        about: "一つの敷地に町が建てうるものを並べて描く。それぞれに乱数の種を書く",
        more: "割合で選ぶ型や、引いて決まるパラメーターが、種ごとに変わります。ファイルに書いてある値は変わりません。最初の候補は、町が実際に建てるものです。標準出力の各行に、種、型、パラメーターを書きます。いちばん近いものを、`test=\"{key = 'K'}\"` の規則に書いてください。",
        examples: "\
例:
  hsd town candidates kyoto.hsd --key 417 -o sheet.png",
        arguments: &[
            ("key", "敷地: `decisions.csv` にある地物のキー", ""),
            ("layer", "同じキーの地物が複数のレイヤーにあるときの、レイヤー", ""),
            ("variants", "候補の数を指定する", ""),
            ("output", "画像をこのファイルに書く (.png か .jpg)", ""),
            ("quiet", "指摘だけを表示する", ""),
        ],
        values: &[],
    },
    CommandHelp {
        path: "town plan",
        about: "町を、一枚ずつ、どの計算機でも作れるタイルに分ける。WORK と町のフォルダーが見えればよい",
        more: "地図を読み、タイルごとに、地物と、建物が依存するまわりのものすべてを WORK に置きます。あとの段階は地図を読みません。タイルごとに一行、キー、地物の数、入力のバイト数とハッシュをタブで区切って表示します。建物のない地面にもキーがあります。\
               もう一度実行すると計画し直します。入力が変わらないものは、作ったものがそのまま使われます。",
        examples: "\
例:
  hsd town plan kyoto.hsd -o work/                   タイルを準備して表示する
  hsd town tile work/ 0_0 0_1                        そのうち二枚を作る
  hsd town tile work/ --all                          足りないものを作る
  hsd town seal work/ -o kyoto/                      町にまとめる",
        arguments: &[
            ("output", "準備したものをこのフォルダーに置く", ""),
            (
                "detail",
                "タイルの詳細度をコンマで区切って指定する。0 は壁と屋根、1 は部材ごとにテクスチャー、\
                 2 は開口と太い桟を立体に、3 はすべてを立体に [既定値: `Tiles` のもの、なければ 0,1,3]",
                "",
            ),
            ("compress", "タイルを Web 向けに圧縮する (EXT_meshopt_compression、KTX2)。`--features compress` を付けてビルドした hsd が必要", ""),
            ("quiet", "指摘だけを表示する", ""),
        ],
        values: &[],
    },
    CommandHelp {
        path: "town tile",
        about: "`hsd town plan` で計画した町のタイルを作る",
        more: "いくつのプロセスが同時に作っても、同じタイルを何度作ってもかまいません。WORK には全体が置かれるか、何も置かれないかで、最初のものが残ります。タイルごとに一行、キーと、`made`(作った)、`kept`(何も変わっていない)、`there`(すでにある)のどれかを、タブで区切って表示します。誤りのある建物は `hsd town` と同じく無地の形になり、`hsd town seal` が報告します。",
        examples: "\
終了コード: 0 指定したタイルはすべてある; 1 作れないタイルがある(壊れているか、hsd が失敗する。やり直しても同じ)。ほかは作った;
2 そのようなタイルがないか、町が変わった; 3 ファイルを読み書きできない(やり直すとよい)。

例:
  hsd town tile work/ 0_0 0_1
  hsd town tile work/ --all --threads 2",
        arguments: &[
            ("work", "計画した町のフォルダー", ""),
            ("keys", "作るタイル。`hsd town plan` が表示するキー。`-` で始まるキーもあるので、オプションはその前に置く", ""),
            ("all", "足りないタイルをすべて作る", ""),
            ("threads", "N 個のスレッドを使う。一つが一度に一枚を作る。既定ではプロセッサーの数だけ", ""),
            ("quiet", "指摘だけを表示する", ""),
        ],
        values: &[],
    },
    CommandHelp {
        path: "town seal",
        about: "`hsd town tile` で作ったタイルを町にまとめる",
        more: "OUT は `hsd town TOWN -o OUT/` が書くものと一バイトも違いません。タイル、表、最後にタイルセットを書きます。OUT と WORK に残った、別の入力のものや中断されたプロセスのものは片付けます。できる所では、WORK と OUT はタイルを共有します(ハードリンク)。",
        examples: "\
終了コード: 0 成功; 1 省くと書いていない地物に建物がない; 2 足りないタイルがある(何も書かない)、WORK が計画した町のフォルダーでない、または町が変わった;
3 ファイルを読み書きできない。

例:
  hsd town seal work/ -o kyoto/
  hsd town seal work/ -o kyoto/ --lacking    作れないタイルを省く",
        arguments: &[
            ("work", "計画した町のフォルダー", ""),
            ("output", "町をこのフォルダーに書く", ""),
            ("lacking", "足りないタイルを省く。その地物は報告に載る", ""),
            ("stats", "タイルの三角形、バイト数、描画メモリーの見積もりを表示する", ""),
            ("quiet", "指摘だけを表示する", ""),
        ],
        values: &[],
    },
];
