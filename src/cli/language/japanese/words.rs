//! The words of help in Japanese. They stand beside the English ones that the options' own files hold; tests see that
//! nothing is missing and nothing is left over.

/// What is said of a command.
pub(super) struct Words {
    /// The names behind `hsd`; empty for the program itself.
    pub(super) path: &'static str,
    /// One line.
    pub(super) about: &'static str,
    /// What `--help` says besides.
    pub(super) more: &'static str,
    /// What stands at the end, in lines.
    pub(super) examples: &'static str,
    /// Arguments by clap's name for them: one line, and what `--help` says besides.
    pub(super) arguments: &'static [(&'static str, &'static str, &'static str)],
    /// What the values of its arguments mean.
    pub(super) values: &'static [(&'static str, &'static str)],
}

/// Arguments of several commands.
pub(super) static COMMON: &[(&str, &str, &str)] = &[
    ("help", "使い方を表示する (-h は要約、--help は全文)", ""),
    ("version", "版を表示する", ""),
    ("lang", "指摘と使い方の言語。省くとロケールに従う", ""),
    ("inputs", "家を書いたテキスト。`-` は標準入力を読む", ""),
    (
        "textures",
        "部材画像をこのフォルダーから探す。何度でも指定できる",
        "省くと、各テキストのフォルダーとその中の `textures` フォルダーから探します。",
    ),
    (
        "detail",
        "建具の細かさ: 0 壁と屋根、1 部材ごとの画像、2 開口と太い桟まで、3 すべて立体",
        "",
    ),
    (
        "parameters",
        "家の変数に値を与える。何度でも指定できる。変数は `hsd params IN` で分かる",
        "",
    ),
    (
        "catalogs",
        "このファイルの部材も使う。何度でも指定できる",
        "テキストのそばの `catalog.hsd` は指定しなくても使います。",
    ),
    (
        "root",
        "取り込むファイルを探す基準フォルダー。省くと各テキストのフォルダー",
        "",
    ),
    (
        "seed",
        "抽選をすべて、家の乱数の種の代わりにこの数で行う",
        "",
    ),
    ("deny", "警告をエラーとして扱う", ""),
    (
        "max_bytes",
        "これよりバイト数の多いファイルを受け付けない",
        "",
    ),
    ("max_nesting", "これより深い要素の入れ子を受け付けない", ""),
    (
        "max_includes",
        "これより多いファイルの取り込みを受け付けない",
        "",
    ),
    (
        "max_parts",
        "繰り返しを展開した部材がこれより多い家を受け付けない",
        "",
    ),
    ("max_pixels", "これより画素の多い画像を受け付けない", ""),
];

/// Values of several commands.
pub(super) static VALUES: &[(&str, &str)] = &[
    ("en", "英語"),
    ("ja", "日本語"),
    ("human", "該当する行を添えて"),
    ("short", "一件一行、エディター向け"),
    ("json", "ひとつの配列、プログラム向け"),
    ("sarif", "SARIF 2.1.0、コード検査サービス向け"),
];

/// All commands.
pub(super) static COMMANDS: &[Words] = &[
    Words {
        path: "",
        about: "家のコンパイラー: 部材コードのテキストから 3D モデルを作る",
        more: "",
        examples: "\
例:
  hsd build examples/machiya.hsd -o machiya.glb    モデルを作り、glTF ビューアーで見る
  hsd explain HSD0104                              指摘の意味と直し方を読む

終了状態: 0 正常、1 入力に誤りがある、2 使い方の誤り、3 ファイルを読み書きできない",
        arguments: &[],
        values: &[],
    },
    Words {
        path: "build",
        about: "家のテキストから 3D モデルを作る",
        more: "OUT の拡張子で形式が決まります: .glb (ひとつのファイルにすべて)、.gltf、.obj、.stl。-o を省くと、テキストの横に .glb を書きます。誤りのあるテキストからは何も書きません。",
        examples: "\
例:
  hsd build shop.hsd -o shop.glb          一軒の家、テクスチャーも中に
  hsd build street/*.hsd -o models/       テキストごとのモデルを `models` フォルダーに",
        arguments: &[
            (
                "output",
                "モデルのファイル、フォルダー (`models/`、テキストごとにひとつ)、または `-` (標準出力)",
                "いくつかのテキストにひとつのファイルを指定すると、ひとつの場面になります。",
            ),
            (
                "format",
                "OUT で決まらないとき (フォルダーか標準出力) の形式",
                "",
            ),
            ("textures_beside", ".glb の画像を横のフォルダーに書く", ""),
            (
                "compress",
                "Web 用の .glb を書く: 数分の一の大きさ。読む側に instances、meshopt、KTX2 が要る",
                "家、階、部材は個別のノードにならず、付加情報も付きません。画像の変換に数秒かかります。",
            ),
            (
                "variants",
                "各テキストを、乱数の種をひとつずつ進めてこの回数だけ組み立てる",
                "抽選ごとの家が列に並びます。OUT がフォルダーならモデルをひとつずつ書きます。最初の種は `--seed`、省くと 0 です。",
            ),
            (
                "sheet",
                "変種の一覧画像 (.png か .jpg) を描く。それぞれに種の番号が付く",
                "-o を省くとモデルは書きません。",
            ),
            (
                "bake",
                "`reflection` のある外壁のガラスに映る家並みと空を画像にする。鏡を知らないビューアー向け",
                "映り込みはひとつの視点のものです: ガラスの中央の前の通りに立つ高さ 1.6 m の目で、ガラス全体が 60 度に収まるまで離れ、向かいに建つものは越えません。",
            ),
            (
                "bake_eye",
                "--bake の目の位置: 東、北、上へのメートル。背を向けているガラスにはそれぞれの目を使う",
                "",
            ),
            (
                "bake_size",
                "--bake の画像の長い辺の画素数の上限。1 m あたり 48 画素を超えない",
                "",
            ),
            (
                "watch",
                "テキストか画像が変わるたびに作り直す (中断するまで)",
                "",
            ),
            ("stats", "モデルの大きさと各段階の時間を表示する", ""),
            ("quiet", "問題のないかぎり何も表示しない", ""),
        ],
        values: &[
            ("glb", "ひとつのファイルの glTF"),
            ("gltf", "テキストの glTF。バッファーと画像を横に"),
            ("obj", "OBJ。MTL と画像を横に"),
            ("stl", "3D 印刷用の STL、ミリメートル"),
        ],
    },
    Words {
        path: "check",
        about: "テキストの誤りを調べる。モデルは書かない",
        more: "終了状態は、誤りがあれば 1 (`-D warnings` では警告も)、読めないファイルがあれば 3 です。",
        examples: "\
例:
  hsd check shop.hsd                        該当する行を添えて指摘する
  hsd check -D warnings --format short *.hsd    一件一行、警告も誤りとする",
        arguments: &[("format", "標準出力に書く指摘の形式", "")],
        values: &[],
    },
    Words {
        path: "dump",
        about: "テキストからモデルまでの途中の結果を JSON か図で表示する",
        more: "",
        examples: "\
例:
  hsd dump --stage regions shop.hsd                  平面がどのように屋根に分割されたか
  hsd dump --stage regions --format svg shop.hsd     同じものを図で
  hsd dump --stage program shop.hsd | jq .houses     コードを引き、繰り返しを展開した後",
        arguments: &[("stage", "どの段階の後か", ""), ("format", "書き方", "")],
        values: &[
            ("ast", "書かれたとおり"),
            ("program", "手順だけ: 繰り返し、抽選、置き換えの後"),
            ("building", "位置の決まった壁と屋根"),
            ("regions", "平面での自動の屋根"),
            ("scene", "メッシュ、材質、ノード"),
            ("json", "一行の JSON"),
            ("svg", "図。regions だけ"),
        ],
    },
    Words {
        path: "new",
        about: "家の類型から新しいテキストを作る: 大きさや表構えを変数で変えられる写し",
        more: "TYPE を省くと類型の一覧を表示します。",
        examples: "\
例:
  hsd new                            類型の一覧
  hsd new chu-nikai -o shop.hsd      江戸時代の町家から始める
  hsd new storehouse                 呼び名は何でもよい: 蔵、kura、dozō
  hsd params shop.hsd                設定できるものを見る",
        arguments: &[
            ("kind", "類型。日本語でも英語でも、どの呼び名でもよい", ""),
            (
                "output",
                "書き込むファイル。`-` は標準出力。省くとこのフォルダーの TYPE.hsd",
                "",
            ),
            ("force", "すでにあるファイルに上書きする", ""),
        ],
        values: &[],
    },
    Words {
        path: "params",
        about: "テキストの変数を一覧にする: `--param` で何をどの範囲で与えられるか",
        more: "",
        examples: "\
例:
  hsd params machiya.hsd                         与えられる変数
  hsd build machiya.hsd --param frontage=5       値を与える",
        arguments: &[("format", "標準出力への書き方", "")],
        values: &[
            ("table", "人が読む表"),
            ("json", "プログラム向けの一つの配列"),
        ],
    },
    Words {
        path: "parts",
        about: "壁に使える部材の一覧を表示する",
        more: "部材コードは空白も含めて五桁です。幅は U (0.909 m)、高さは尺 (0.303 m) で表します。",
        examples: "\
例:
  hsd parts lattice            名前に `lattice` を含む部材
  hsd parts --format json K    すべての壁、プログラム向け
  hsd parts --sheet parts.html 部材ごとの絵のあるページ
  hsd parts --catalog own.hsd  自分のファイルで定義した部材

分類: K 壁、T 戸、M 窓、G 格子、H 柱、A 開口、N 現代",
        arguments: &[
            ("format", "一覧の書き方", ""),
            (
                "catalogs",
                "代わりに、このファイルで定義した部材を一覧にする。何度でも指定できる",
                "",
            ),
            (
                "sheet",
                "絵にして書く: .html は名前と寸法のページ、.glb は部材を並べたモデル",
                "",
            ),
            (
                "filter",
                "コードか名前(日本語、英語)がこれで始まるか、この語を含む部材だけ。大文字一字は分類を表す",
                "長音はどう書いてもかまいません。`koshi`、`koushi`、`kōshi` は同じものを見つけます。",
            ),
        ],
        values: &[("table", "表"), ("json", "配列")],
    },
    Words {
        path: "explain",
        about: "指摘の原因、例、直し方を説明する",
        more: "",
        examples: "\
例:
  hsd explain HSD0104    ひとつの指摘の説明
  hsd explain            すべての指摘の一覧",
        arguments: &[(
            "code",
            "HSD0104 のような指摘のコード。`hsd0104` や `104` でもよい",
            "",
        )],
        values: &[],
    },
    Words {
        path: "fmt",
        about: "テキストを整える: 部材コードを桁に、要素を行に",
        more: "テキストは元のファイルに、元の文字コードと改行で書き戻します。注釈とすべての順序を保ち、テキストの意味は変えません。意味の定まらないテキスト (誤りのある従来形式、整形式でない XML) はそのまま残します。",
        examples: "\
例:
  hsd fmt shop.hsd                 テキストをその場で整える
  hsd fmt --check *.hsd            変わるテキストを示し、変更しない (終了状態 1)
  hsd fmt - < shop.hsd             標準入力から標準出力へ
  hsd fmt --to xml shop.hsd -o shop-xml.hsd    同じ家をもう一方の形式で",
        arguments: &[
            (
                "output",
                "その場ではなく、このファイル、フォルダー (`tidy/`)、または標準出力 (`-`) に書く",
                "",
            ),
            (
                "check",
                "変更せず、変わるテキストとその最初の行を表示する",
                "",
            ),
            (
                "to",
                "この形式で書く。すでにその形式のテキストは整えるだけにする",
                "もう一方の形式で書けないものは、その箇所を示して誤りとします。従来形式では繰り返しを展開します。",
            ),
        ],
        values: &[("xml", "要素と属性"), ("legacy", "五桁の部材コードの行")],
    },
    Words {
        path: "textures",
        about: "すべての材料の画像をフォルダーに描く",
        more: "材料ごとに、色、法線、そして遮蔽・粗さ・金属度の画像があります。モデルに入る画像と同じもので、モデルを作るために描いておく必要はありません。",
        examples: "\
例:
  hsd textures -o materials/          すべて描く
  hsd textures --sheet materials.jpg     すべてを同じ縮尺で見る",
        arguments: &[
            ("output", "フォルダー。なければ作る", ""),
            (
                "sheet",
                "すべての材料を並べた JPEG。それぞれ半間 (0.91 m) の幅",
                "",
            ),
        ],
        values: &[],
    },
    Words {
        path: "view",
        about: "家をブラウザーに表示し、保存するたびに建て直す",
        more: "このマシンの中だけのページに、モデル、平面図、テキストの指摘が表示されます。フォルダーを指定すると、その中の\
               テキストやモデルを画面で選べます。外部とは通信しません。中断するまで動き続けます。",
        examples: "\
例:
  hsd view house.hsd                                   エディターの隣に家を
  hsd view street/                                     フォルダーのすべてのテキスト
  hsd view town.hsd --detail 1                         数百軒の町を、部材を画像にして軽く
  hsd view house.hsd --editor 'code -g {file}:{line}'  部材をクリックするとその行へ",
        arguments: &[
            (
                "input",
                "テキスト、テキストのフォルダー、またはモデル (.glb)",
                "",
            ),
            (
                "editor",
                "エディターをその場所へ移すコマンド。{file}、{line}、{column} が場所に置き換わる",
                "",
            ),
            ("read_only", "画面で何を描いてもテキストを変えない", ""),
            ("port", "ページのポート。省くと空いているもの", ""),
            ("no_open", "ブラウザーを開かず、アドレスだけを書く", ""),
        ],
        values: &[],
    },
    Words {
        path: "render",
        about: "文書に載せる家の写真を撮る",
        more: "`hsd view` の画面が午後の光で描きます。このマシンの Chromium、Chrome、Edge のどれかを見えないところで使います。\
               HSD_CHROMIUM で別のものを指定できます。一枚なら OUT に、何枚かなら OUT フォルダーに NAME-VIEW.png と書きます。\
               誤りのあるテキストの写真は撮りません。",
        examples: "\
例:
  hsd render shop.hsd -o shop.png                              通りから
  hsd render street/*.hsd -o pictures/ --view front,above      二枚ずつ",
        arguments: &[
            ("inputs", "テキスト、またはモデル (.glb)", ""),
            (
                "output",
                "画像 (.png か .jpg)、またはフォルダー (`pictures/`)",
                "",
            ),
            ("views", "どこから見るか。コンマで区切っていくつでも", ""),
            ("size", "幅と高さの画素数", ""),
            ("samples", "平均する光の位置の数。多いほど滑らか", ""),
            ("format", "フォルダーに書く画像の形式", ""),
            ("quiet", "問題がなければ何も言わない", ""),
        ],
        values: &[
            ("front", "通りの左手から"),
            ("eaves", "front と同じ向き、軒の高さから"),
            ("above", "正面右の上から"),
            ("back", "背面の上から"),
            ("left", "左側面"),
            ("right", "右側面"),
            ("top", "真上から"),
            ("png", "描いたままの画素"),
            ("jpg", "数分の一の大きさ"),
        ],
    },
    Words {
        path: "lsp",
        about: "エディターに応える: 診断、補完、説明などを Language Server Protocol で",
        more: "エディターが自分で起動します。標準入力を読み、標準出力に書きます。エディターの設定は README にあります。",
        examples: "",
        arguments: &[("stdio", "標準入力と標準出力で話す。指定しなくても同じ", "")],
        values: &[],
    },
    Words {
        path: "completions",
        about: "シェルが `hsd` のコマンドを補完するためのスクリプトを書く",
        more: "",
        examples: "\
例:
  hsd completions bash > ~/.local/share/bash-completion/completions/hsd   (bash の場合)
  hsd completions fish > ~/.config/fish/completions/hsd.fish              (fish の場合)",
        arguments: &[("shell", "シェル", "")],
        values: &[],
    },
    Words {
        path: "help",
        about: "コマンドの使い方を表示する",
        more: "",
        examples: "",
        arguments: &[],
        values: &[],
    },
];
