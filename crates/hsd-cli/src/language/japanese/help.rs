//! The Japanese help texts. The English ones are doc comments of the options; tests check that both have the same
//! entries.

pub(super) mod draw;
pub(super) mod facade;
pub(super) mod plan;
pub(super) mod render;
pub(super) mod town;

/// The help of a command.
pub(super) struct CommandHelp {
    /// The subcommand path after `hsd`; empty for the program itself.
    pub(super) path: &'static str,
    /// The summary, one line.
    pub(super) about: &'static str,
    /// The additional text of `--help`.
    pub(super) more: &'static str,
    /// The examples at the end.
    pub(super) examples: &'static str,
    /// Arguments: clap's id, the summary and the additional text of `--help`.
    pub(super) arguments: &'static [(&'static str, &'static str, &'static str)],
    /// Descriptions of argument values.
    pub(super) values: &'static [(&'static str, &'static str)],
}

/// Arguments shared by several commands.
pub(super) static COMMON: &[(&str, &str, &str)] = &[
    ("help", "ヘルプを表示する (-h は要約、--help は全文)", ""),
    ("version", "バージョンを表示する", ""),
    (
        "lang",
        "指摘とヘルプの言語を指定する [既定値: ロケールに従う]",
        "",
    ),
    ("inputs", "家のテキスト。`-` は標準入力", ""),
    (
        "textures",
        "部材の画像をこのフォルダーから探す。複数回指定できる",
        "省略すると、各テキストのフォルダーとその中の `textures` フォルダーから探します。",
    ),
    (
        "detail",
        "詳細度を指定する: 0 壁と屋根、1 部材ごとのテクスチャー、2 開口と太い桟まで立体、3 すべて立体",
        "",
    ),
    ("cutaway", "屋根と、最上階の天井を省く", ""),
    ("storey", "下から数えてこの階までを、上を開けて表示する", ""),
    (
        "parameters",
        "テキストのパラメーターを指定する。複数回指定できる",
        "パラメーターは `hsd params IN` で一覧できます。",
    ),
    ("year", "パラメーター `year`(町を見る年)を指定する", ""),
    (
        "catalogs",
        "このファイルの自作部材を読み込む。複数回指定できる",
        "テキストと同じフォルダーの `catalog.hsd` は、指定しなくても読み込みます。",
    ),
    (
        "root",
        "取り込みをこのフォルダーの中のファイルに限る [既定値: 各テキストのフォルダー]",
        "",
    ),
    ("seed", "すべての家の乱数の種をこの値に置き換える", ""),
    (
        "messages",
        "指摘の形を指定する",
        "`json` はほかに何も書きません。出力ごとに `{\"kind\":\"built\",\"output\",\"messages\",\"files\"}`: 指摘は `hsd check --format json` と同じ、書かなかった出力は `null`、もとになったファイルも付きます。時間のかかるものは、その前に `{\"kind\":\"progress\",\"done\",\"of\"}` を書きます。読み書きできないものは標準エラー出力に書きます。",
    ),
    ("deny", "警告をエラーとして扱う", ""),
    ("max_bytes", "N バイトより大きいファイルを拒否する", ""),
    ("max_nesting", "N 段より深い要素の入れ子を拒否する", ""),
    (
        "max_includes",
        "N 個より多くのファイルを取り込むテキストを拒否する",
        "",
    ),
    (
        "max_included_bytes",
        "合わせて N バイトより多くを取り込むファイルを拒否する",
        "",
    ),
    (
        "max_repeated_parts",
        "すべての家で繰り返しが加える部材を N 個より多くする家を拒否する",
        "",
    ),
    (
        "max_triangles",
        "詳細度での三角形が N 個より多い家を拒否する",
        "",
    ),
    (
        "max_variants",
        "変種を N 件まで作る。16 KiB より大きいファイルでは少なくなる",
        "",
    ),
    ("max_parts", "展開後の部材が N 個より多い家を拒否する", ""),
    ("max_pixels", "N 画素より大きい画像を拒否する", ""),
    (
        "max_memory",
        "書かれた量を超えておよそ N バイトより大きなメモリに展開される地図と図面を拒否する",
        "",
    ),
    (
        "threads",
        "N 本のスレッドを使う。指定がなければプロセッサーごとに一本",
        "結果は何本でも同じです。",
    ),
];

/// Values shared by several commands.
pub(super) static VALUES: &[(&str, &str)] = &[
    ("en", "英語"),
    ("ja", "日本語"),
    ("human", "該当する行を添えた形式"),
    ("short", "1 件 1 行、エディター向け"),
    ("json", "JSON、プログラム向け"),
    ("sarif", "SARIF 2.1.0、コードスキャンサービス向け"),
];

/// The help of all commands.
pub(super) static COMMANDS: &[CommandHelp] = &[
    CommandHelp {
        path: "",
        about: "家のテキストをテクスチャー付きの 3D モデルにコンパイルする",
        more: "",
        examples: "\
例:
  hsd build examples/machiya.hsd -o machiya.glb    glTF ビューアーで開けるモデルを作る
  hsd explain HSD0104                              指摘の意味と直し方を表示する

終了ステータス: 0 正常終了、1 入力に誤りがある、2 使い方の誤り、3 ファイルを読み書きできない",
        arguments: &[],
        values: &[],
    },
    CommandHelp {
        path: "build",
        about: "家のテキストから 3D モデルを作る",
        more: "形式は OUT の拡張子で決まります: .glb (すべてをひとつのファイルに)、.gltf、.obj、.stl。-o を省略すると、テキストと同じフォルダーに .glb を書きます。誤りのあるテキストのモデルは書きません。",
        examples: "\
例:
  hsd build shop.hsd -o shop.glb          一軒の家、テクスチャーは埋め込み
  hsd build street/*.hsd -o models/       テキストごとのモデルを `models` フォルダーに",
        arguments: &[
            (
                "output",
                "モデルをこのファイル、フォルダー (`models/`、テキストごとにひとつ)、または標準出力 (`-`) に書く",
                "複数のテキストにひとつのファイルを指定すると、ひとつのシーンになります。",
            ),
            (
                "format",
                "OUT がフォルダーか標準出力のときの形式を指定する",
                "",
            ),
            ("textures_beside", ".glb のテクスチャーを埋め込まず、横のフォルダーに書く", ""),
            (
                "compress",
                "Web 用の .glb を書く: 大きさは数分の一。表示にはインスタンス、meshopt、KTX2 への対応が必要",
                "家、階、部材は個別のノードにならず、extras も付きません。テクスチャーの変換に数秒かかります。Blender (5.1 まで) では開けません。",
            ),
            (
                "join",
                "--detail 0 の家をまとめる: .glb の数百軒をひとつのメッシュにし、家ごとに番号を付ける",
                "都市向け。ノードは数百分の一、大きさは半分ほど。頂点が家の番号 (EXT_mesh_features) を持ち、名前とテキスト中の位置はノードの extras にあります。",
            ),
            (
                "variants",
                "各テキストから、連続する乱数の種で N 個の変種を作る",
                "変種はひとつのモデルに列をなして並びます。OUT がフォルダーなら、変種ごとにモデルを書きます。最初の種は --seed の値か 0 です。",
            ),
            (
                "sheet",
                "変種の一覧画像 (.png か .jpg) を、種の番号を付けて描く",
                "-o を省略すると、モデルは書きません。",
            ),
            (
                "bake",
                "`reflection` のある壁面のガラスに、映り込む家並みと空をベイクする。鏡面反射を描けないビューアー向け",
                "映り込みはひとつの視点で正しくなります: ガラスの中央の前、通りから高さ 1.6 m で、ガラス全体が 60 度に収まるまで離れ、向かいの建物は越えない位置です。",
            ),
            (
                "bake_eye",
                "--bake の視点を東、北、上へのメートルで指定する",
                "この視点に面していないガラスには、既定の視点を使います。",
            ),
            (
                "bake_size",
                "ベイクする画像の長辺をこの画素数までにする",
                "解像度は 1 m あたり 48 画素を超えません。",
            ),
            (
                "merge",
                ".glb か .gltf の家をそれぞれひとつのメッシュにまとめる。メッシュとマテリアルごとに描くゲームエンジン向け",
                "家のノードと extras は残ります。階、壁、部材のノードはなくなり、その extras (コード、行、名前) は失われます。多くの部材が共有していた形も部材ごとに書くので、ファイルは大きくなります。",
            ),
            (
                "no_tangents",
                ".glb か .gltf に接線を書かない: 凹凸のある面の頂点データの三分の一",
                "凹凸を表示するプログラムは、接線を自分で計算します。",
            ),
            (
                "quantize",
                ".glb か .gltf の法線と接線をバイトで書く (KHR_mesh_quantization): その頂点データは約 40 % 小さくなる",
                "方向の誤差は 0.4 度以下、位置は正確なままです。読むプログラムは拡張に対応している必要があります。Blender、three.js、Babylon.js、CesiumJS は対応しています。",
            ),
            ("scale", ".stl を 1:100 や 1/100 のような縮尺で書く", ""),
            (
                "min_wall",
                ".stl の立体が、模型でこのミリメートルより薄いときに知らせる [default: 0.4]",
                "表だけのもの (詳細度 1 と 2 の建具、詳細度 0 の壁) には、少なくともこの厚さを付けます。立体はすべて閉じています。重なり合う立体は合体しません。それはスライサーが行います。",
            ),
            (
                "watch",
                "テキストか画像が変わるたびに、中断するまで作り直す",
                "",
            ),
            ("stats", "モデルの大きさと各段階の所要時間を表示する", ""),
            ("quiet", "指摘だけを表示する", ""),
        ],
        values: &[
            ("glb", "バイナリー glTF、すべてをひとつのファイルに"),
            ("gltf", "JSON の glTF。バッファーとテクスチャーは別ファイル"),
            ("obj", "OBJ。MTL とテクスチャーは別ファイル"),
            ("stl", "3D プリント用の STL、ミリメートル"),
            ("material", "家ごとにひとつのメッシュ、マテリアルごとにひとつのプリミティブ"),
        ],
    },
    CommandHelp {
        path: "check",
        about: "モデルを作らずに、テキストの誤りを調べる",
        more: "終了ステータスは、誤りがあるか (`-D warnings` では警告も)、町で作れない地物があれば 1、読めないファイルがあれば 3 です。",
        examples: "\
例:
  hsd check shop.hsd                        該当する行を添えて指摘を表示する
  hsd check -D warnings --format short *.hsd    1 件 1 行、警告もエラーとして扱う",
        arguments: &[("format", "標準出力に書く指摘の形式を指定する", "")],
        values: &[],
    },
    CommandHelp {
        path: "dump",
        about: "コンパイラーの段階の結果を JSON で、屋根伏図は SVG で出力する",
        more: "",
        examples: "\
例:
  hsd dump --stage regions shop.hsd                  平面がどのように屋根に分割されたかを出力する
  hsd dump --stage regions --format svg shop.hsd     同じものを図にする
  hsd dump --stage program shop.hsd | jq .houses     コードを解決し、繰り返しを展開した後",
        arguments: &[("stage", "段階を選ぶ", ""), ("format", "出力形式を指定する", "")],
        values: &[
            ("ast", "構文解析したテキスト"),
            ("program", "繰り返し、抽選、置き換えを展開した後の命令"),
            ("building", "位置の決まった壁と屋根"),
            ("regions", "自動の屋根の、平面での領域"),
            ("scene", "メッシュ、材質、ノード"),
            ("json", "1 行の JSON"),
            ("svg", "図。regions のみ"),
        ],
    },
    CommandHelp {
        path: "new",
        about: "ひな形からテキストを作る",
        more: "家の大きさや表構えはパラメーターで変えられます。TYPE を省略すると、ひな形の一覧を表示します。",
        examples: "\
例:
  hsd new                            ひな形の一覧を表示する
  hsd new chu-nikai -o shop.hsd      江戸時代の町家を作る
  hsd new storehouse                 どの呼び名でもよい: 蔵、kura、dozō
  hsd params shop.hsd                パラメーターを一覧にする",
        arguments: &[
            ("kind", "家の類型。日本語でも英語でも、どの呼び名でもよい", ""),
            (
                "output",
                "このファイルに書く。`-` は標準出力 [既定値: TYPE.hsd]",
                "",
            ),
            ("force", "既存のファイルを上書きする", ""),
        ],
        values: &[],
    },
    CommandHelp {
        path: "params",
        about: "テキストのパラメーターと、取りうる値を一覧にする",
        more: "値は `--param` で指定します。",
        examples: "\
例:
  hsd params machiya.hsd                         パラメーターを一覧にする
  hsd build machiya.hsd --param frontage=5       値を指定する",
        arguments: &[("format", "出力形式を指定する", "")],
        values: &[
            ("table", "表"),
            ("json", "JSON の配列、プログラム向け"),
        ],
    },
    CommandHelp {
        path: "parts",
        about: "壁に使える部材を一覧にする",
        more: "部材コードは空白も含めて五文字です。幅は U (0.909 m)、高さは尺 (0.303 m) で表します。",
        examples: "\
例:
  hsd parts lattice                名前に `lattice` を含む部材を一覧にする
  hsd parts --format json K        すべての壁を JSON で出力する
  hsd parts --sheet parts.html     部材ごとの画像のあるページを書く
  hsd parts --catalog custom.hsd   ファイルの自作部材を一覧にする

分類: K 壁、T 戸、M 窓、G 格子、H 柱、A 開口、N 現代",
        arguments: &[
            ("format", "出力形式を指定する", ""),
            (
                "catalogs",
                "代わりに、このファイルの自作部材を一覧にする。複数回指定できる",
                "",
            ),
            (
                "sheet",
                "図録を書く: .html は名前と寸法のページ、.glb は部材を並べたモデル",
                "",
            ),
            (
                "filter",
                "コードか名前がこれで始まるか、この語を含む部材だけを一覧にする。大文字 1 字は分類を表す",
                "長音の書き方は問いません。`koshi`、`koushi`、`kōshi` は同じ部材に一致します。",
            ),
        ],
        values: &[("table", "表"), ("json", "JSON の配列、プログラム向け")],
    },
    CommandHelp {
        path: "explain",
        about: "指摘の原因、例、直し方を説明する",
        more: "",
        examples: "\
例:
  hsd explain HSD0104    指摘を説明する
  hsd explain            すべての指摘を一覧にする",
        arguments: &[(
            "code",
            "HSD0104 のような指摘のコード。`hsd0104` や `104` でもよい",
            "",
        )],
        values: &[],
    },
    CommandHelp {
        path: "fmt",
        about: "テキストを整形する",
        more: "部材コードを桁にそろえ、要素を行に分けます。元のファイルに書き戻し、文字コード、改行コード、コメント、順序、意味は変えません。確実に解釈できないテキスト (誤りのある旧形式、整形式でない XML) は変更しません。",
        examples: "\
例:
  hsd fmt shop.hsd                 テキストを整形して元のファイルに書き戻す
  hsd fmt --check *.hsd            変わるファイルを一覧にする (終了ステータス 1)
  hsd fmt - < shop.hsd             標準入力を整形して標準出力に書く
  hsd fmt --to xml shop.hsd -o shop-xml.hsd    XML 形式に変換する",
        arguments: &[
            (
                "output",
                "元のファイルではなく、このファイル、フォルダー (`tidy/`)、または標準出力 (`-`) に書く",
                "",
            ),
            (
                "check",
                "何も書かずに、変わるファイルと最初の違いを表示する",
                "",
            ),
            (
                "to",
                "この形式に変換する。すでにその形式のテキストは整形だけする",
                "その形式で表せないものはエラーになります。旧形式には繰り返しがないので、展開します。",
            ),
        ],
        values: &[("xml", "要素と属性"), ("legacy", "五文字の部材コードの行")],
    },
    CommandHelp {
        path: "textures",
        about: "すべての材料のテクスチャーをフォルダーに書く",
        more: "材料ごとに、色、法線、遮蔽・粗さ・金属度のマップがあります。モデルに入るテクスチャーと同じもので、モデルを作るときに必要なコマンドではありません。",
        examples: "\
例:
  hsd textures -o materials/          すべて書く
  hsd textures --sheet materials.jpg     すべての材料を同じ縮尺で描く",
        arguments: &[
            ("output", "このフォルダーに書く。なければ作る", ""),
            (
                "sheet",
                "すべての材料を、それぞれ半間 (0.91 m) の幅で並べた JPEG を書く",
                "",
            ),
        ],
        values: &[],
    },
    CommandHelp {
        path: "view",
        about: "家をブラウザーでプレビューし、保存するたびに更新する",
        more: "このマシンだけで開けるページに、モデル、平面図、指摘を表示します。フォルダーを指定すると、その中の\
               テキストやモデルを画面で選べます。町はタイルに作り、画面が順に読みます。データが外部に送られることはありません。中断するまで動き続けます。",
        examples: "\
例:
  hsd view house.hsd                                   エディターの隣に家を表示する
  hsd view street/                                     フォルダーのテキストを表示する
  hsd view town.hsd --detail 1                         数百軒の町を、部材をテクスチャーにして表示する
  hsd view --facade front.jpg                          写真から正面を作る。四隅、格子、マスクを画面で直す
  hsd view kyoto/                                      `hsd town` が書いたタイルの町を表示する
  hsd view house.hsd --editor 'code -g {file}:{line}'  部材のクリックでその行に移動する",
        arguments: &[
            (
                "input",
                "テキスト、町、テキストかタイルのフォルダー、またはモデル (.glb)",
                "",
            ),
            (
                "facade",
                "一つの壁面の写真から、画面で正面を作る。作り方は hsd facade と同じ",
                "",
            ),
            (
                "output",
                "正面をこのフォルダーに書く [既定値: 最初の写真と同じ場所の、同じ名前のフォルダー]",
                "",
            ),
            (
                "editor",
                "エディターでその位置を開くコマンドを指定する。{file}、{line}、{column} は置き換えられる",
                "",
            ),
            ("read_only", "画面での編集を無効にする", ""),
            ("port", "ページのポートを指定する [既定値: 空いているポート]", ""),
            ("no_open", "ブラウザーを開かずに、アドレスを表示する", ""),
        ],
        values: &[],
    },
    CommandHelp {
        path: "lsp",
        about: "エディターと通信する言語サーバーを起動する",
        more: "Language Server Protocol により、標準入力と標準出力で診断、補完、ホバーなどを提供します。エディターが起動します。設定方法は README にあります。",
        examples: "",
        arguments: &[("stdio", "標準入力と標準出力を使う。既定の動作で、クライアントとの互換のためにある", "")],
        values: &[],
    },
    CommandHelp {
        path: "completions",
        about: "シェルの補完スクリプトを出力する",
        more: "",
        examples: "\
例:
  hsd completions bash > ~/.local/share/bash-completion/completions/hsd   (bash の場合)
  hsd completions fish > ~/.config/fish/completions/hsd.fish              (fish の場合)",
        arguments: &[("shell", "対象のシェル", "")],
        values: &[],
    },
    CommandHelp {
        path: "man",
        about: "`man` のページを `--lang` の言語でフォルダーに書く: hsd.1 と、コマンドごとに一つ",
        more: "",
        examples: "\
例:
  hsd man ~/.local/share/man/man1    hsd.1、hsd-build.1 などを書く。`man hsd-build` で読める
  hsd --lang ja man ~/.local/share/man/ja/man1    日本語のページ。日本語のロケールで `man` が表示する",
        arguments: &[("folder", "フォルダー。なければ作る", "")],
        values: &[],
    },
    CommandHelp {
        path: "help",
        about: "コマンドのヘルプを表示する",
        more: "",
        examples: "",
        arguments: &[],
        values: &[],
    },
];
