//! Japanese help of `hsd draw`.

use super::CommandHelp;

pub(in crate::language::japanese) const DRAW: &[CommandHelp] = &[CommandHelp {
    path: "draw",
    about: "家の平面図、立面図、断面図を縮尺どおりに描く",
    more: "すべての図を 1 枚の用紙に並べます。図が一つだけなら、その大きさの用紙になります。平面図と断面図の切り口は、モデルを正確に切ったものです。\
           SVG と PDF の単位は用紙の上のミリメートル、DXF の単位は家の実寸のミリメートルです。",
    examples: "\
例:
  hsd draw shop.hsd -o shop.svg                               すべての図を A3 に、入る限り大きく描く
  hsd draw shop.hsd -o shop.pdf --scale 1:50                  縮尺 1:50 で、全部が入る最小の用紙に描く
  hsd draw shop.hsd -o plan.dxf --view plan-1                 1 階平面図を CAD 用に描く
  hsd draw shop.hsd -o cut.svg --section a=3.5 --view section 右端から 3.5 単位の所で切った断面図を描く",
    arguments: &[
        ("output", "図面をこのファイル (.svg、.pdf、.dxf、.png) に書く", ""),
        (
            "views",
            "図をコンマで区切って選ぶ: plan（すべての階の平面図）、plan-1、plan-2…、roof（屋根伏図）、site（配置図）、front、right、back、left（立面図）、section（断面図） [既定値: すべて]",
            "",
        ),
        (
            "sections",
            "断面の位置を指定する。`a=` は最初の行に沿って左へ、`b=` は奥への単位数。繰り返し指定できる [既定値: 中央で縦横一つずつ]",
            "",
        ),
        ("scale", "縮尺を 1:100 のように指定する [既定値: 用紙に入る最大の標準縮尺]", ""),
        ("sheet", "用紙を A4、A3、A2、A1、A0 から指定する [既定値: A3。--scale があれば全部が入る最小の用紙]", ""),
        ("house", "ファイルの中のこの名前の家だけを描く", ""),
        (
            "font",
            "文字をこのフォント (.ttf、.otf、.ttc) の輪郭で描く。どこで開いても同じに見える",
            "画像にはフォントが要ります。指定がなければ、このマシンの日本語フォントを使います。",
        ),
        ("dpi", "画像の解像度を 1 インチの画素数で指定する", ""),
        ("quiet", "指摘だけを表示する", ""),
    ],
    values: &[
        ("a4", "297 × 210 mm の用紙"),
        ("a3", "420 × 297 mm の用紙"),
        ("a2", "594 × 420 mm の用紙"),
        ("a1", "841 × 594 mm の用紙"),
        ("a0", "1189 × 841 mm の用紙"),
    ],
}];
