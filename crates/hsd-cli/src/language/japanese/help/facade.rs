//! Japanese help of `hsd facade`.

use super::CommandHelp;

pub(in crate::language::japanese) const FACADE: &[CommandHelp] = &[CommandHelp {
    path: "facade",
    about: "壁面の写真から部材の画像と、組み立てるテキストを作る",
    more: "壁面を正面から見た正しい縦横比に直し、階と柱間で切り分けます。同じ部材には、きれいに写った一枚を使います。樹木、電線、車は、同じ部材が別の所で隠れずに写っていれば消えます。\
           DIR に、部材の画像、テキスト DIR.hsd、部材表 parts.csv、rectified.png、facade.json、確認用の compared.png を書きます。",
    examples: "\
例:
  hsd facade front.jpg -o front                                       壁面、階、柱間を探す
  hsd facade front.jpg -o front --corners \"310,290 640,350 670,890 307,850\" --size 12.6,9.3 --grid 7x3
  hsd facade left.jpg right.jpg -o front --size 12.6,9.3              同じ壁面の写真。部材ごとによく写った方を使う
  hsd facade front.jpg -o front --mask tree.png                       tree.png の白い所は壁面の手前の物とする",
    arguments: &[
        ("photos", "一つの壁面の写真 (PNG、JPEG、TIFF、WebP)", ""),
        ("output", "部材とテキストをこのフォルダーに書く", ""),
        (
            "corners",
            "壁面の四隅を画素で、左上から時計回りに指定する。写真一枚につき一度 [既定値: 探す]",
            "",
        ),
        (
            "size",
            "壁面の幅と高さをメートルで指定する [既定値: 階高を 3.5 m とする]",
            "",
        ),
        (
            "lens",
            "レンズの歪みを指定する [既定値: 長い縁がまっすぐになる値]",
            "",
        ),
        (
            "focal",
            "焦点距離を画素で指定する [既定値: カメラの記録]",
            "",
        ),
        (
            "grid",
            "等しい柱間と階の数を指定する [既定値: 繰り返しから探す]",
            "",
        ),
        ("columns", "柱間の境目を、左からのメートルで指定する", ""),
        ("rows", "階の境目を、上からのメートルで指定する", ""),
        (
            "masks",
            "この画像の白い所を使わない。写真と同じ大きさ。写真一枚につき一度",
            "",
        ),
        (
            "variations",
            "各部材のきれいな画像をさらに N 枚まで書く。置かれる所ごとに、その中から一枚が抽選される",
            "",
        ),
        (
            "fronts",
            "壁面全体、一階、二階以上を、この名前の正面としても書く (NAME.N.png、N は次の空き番号)",
            "",
        ),
        ("quiet", "指摘だけを表示する", ""),
    ],
    values: &[],
}];
