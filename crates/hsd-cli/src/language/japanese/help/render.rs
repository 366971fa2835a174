//! Japanese help of `hsd render`.

use super::CommandHelp;

pub(in crate::language::japanese) const RENDER: &[CommandHelp] = &[CommandHelp {
    path: "render",
    about: "文書に載せる家や町の画像を作る",
    more: "`hsd view` の画面が午後の光で描きます。このマシンの Chromium、Chrome、Edge のどれかを非表示で使います。\
               HSD_CHROMIUM で別のものを指定できます。1 枚なら OUT に、複数なら OUT フォルダーに NAME-VIEW.png の名前で書きます。\
               誤りのあるテキストの画像は書きません。",
    examples: "\
例:
  hsd render shop.hsd -o shop.png                              通りからの画像を作る
  hsd render street/*.hsd -o pictures/ --view front,above      家ごとに 2 枚の画像を作る
  hsd render street.hsd -o eye.png --from 2,0,1.6 --to 60,0,3  通りに立って東を見る
  hsd render shop.hsd -o front.png --view elevation-front      正面の立面を平行投影で描く
  hsd render plot.hsd -o pictures/ --view garden,court         ファイルの視点 garden と中庭を写す
  hsd render plot.hsd -o kura.png --house kura --date 2026-12-21 --hour 9
                                                               冬の朝の土蔵を描く
  hsd render kyoto.hsd -o film/ --camera path.json --detail 1  町をカメラの道に沿って写す",
    arguments: &[
        ("inputs", "家か町のテキスト、またはモデル (.glb)", ""),
        (
            "camera",
            "このファイルのカメラで写す",
            "`[{\"from\": [2, -8, 1.6], \"to\": [2, 0, 3]}, ...]` の JSON です。位置は東、北、上(m)です。\
                 `name`、`fov`、`date`、`hour` も書けます。`frames` は前のカメラからそこまで滑らかに動く間の枚数です。",
        ),
        (
            "output",
            "画像をこのファイル (.png か .jpg) に、複数ならこのフォルダー (`pictures/`) に書く",
            "",
        ),
        (
            "views",
            "視点をコンマで区切って選ぶ。下の値か、ファイルの `View` の名",
            "",
        ),
        ("size", "幅と高さを画素数で指定する", ""),
        ("house", "ファイルの中のこの名前の家を写す", ""),
        ("date", "午後の光の代わりに、この日の京都の太陽で照らす", ""),
        ("hour", "その日の時刻を指定する [既定値: 12]", ""),
        (
            "from",
            "視点の代わりに、カメラの位置を指定する(東, 北, 上。m)",
            "",
        ),
        ("to", "カメラの見る点を指定する(東, 北, 上。m)", ""),
        ("fov", "そのカメラの縦の画角を度で指定する", ""),
        (
            "samples",
            "光源のサンプル数を指定する。多いほど影が滑らかになる",
            "",
        ),
        ("format", "フォルダーに書く画像の形式を指定する", ""),
        ("quiet", "指摘だけを表示する", ""),
    ],
    values: &[
        ("front", "通りの左から"),
        ("eaves", "front と同じ向き、軒の高さから"),
        ("above", "正面右上から"),
        ("back", "背面上から"),
        ("left", "左側面"),
        ("right", "右側面"),
        ("top", "真上から"),
        ("elevation-front", "正面の立面。平行投影"),
        ("elevation-back", "背面の立面。平行投影"),
        ("elevation-left", "左側面の立面。平行投影"),
        ("elevation-right", "右側面の立面。平行投影"),
        ("plan", "屋根伏せ。平行投影で、正面が下"),
        ("court", "建物の中庭。`court-2` は二つ目"),
        (
            "street",
            "最初の行の前、目の高さから。`side-2` は二つ目の壁の前",
        ),
        ("png", "可逆圧縮"),
        ("jpg", "非可逆圧縮、大きさは数分の一"),
    ],
}];
