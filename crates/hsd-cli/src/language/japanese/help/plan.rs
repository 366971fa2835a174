//! Japanese help of `hsd plan`.

use super::CommandHelp;

pub(in crate::language::japanese) const PLAN: &[CommandHelp] = &[CommandHelp {
    path: "plan",
    about: "間取り図の画像や図面から家のテキストを作る",
    more: "実測図、江戸の指図、大工の板図の写真やスキャンと、SVG、DXF、PDF の図面を読みます。ファイルは一階につき一つ、下の階から並べます。確かでない所は、テキストのその壁に注釈を付け、OUT.review.png に赤い丸で示し、指摘として表示します。\
           一緒に書く OUT.plan.json と OUT.sheet-1.jpg は、`hsd view` が家の下に図面を敷くのに使います。前に読んで手で直した OUT は、直した所がそのまま残ります。",
    examples: "\
例:
  hsd plan scan.jpg -o house.hsd                                      一階の図面を読む
  hsd plan ground.png upper.png -o house.hsd --unit kyo-ma            二階建てを読む。半間は 3.25 尺
  hsd plan sheet.png -o house.hsd --region \"40,60 900,700\" --region \"950,60 1800,700\"
  hsd plan photo.jpg -o house.hsd --corners \"80,60 900,70 880,1240 90,1220\"
  hsd plan plan.dxf -o house.hsd                                      線の図面を、レイヤとブロックに従って読む
  hsd plan scan.jpg -o house.hsd --steps steps/                       段階ごとに見つけたものも描く",
    arguments: &[
        (
            "inputs",
            "間取り図 (PNG、JPEG、TIFF、WebP、SVG、DXF、PDF)。一階につき一つ、下の階から",
            "",
        ),
        ("output", "家をこのファイルに書く", ""),
        (
            "legends",
            "この凡例で読む: survey（実測図）、sashizu（指図）、itazu（板図）、cad、またはファイル。繰り返し指定できる [既定値: いちばんよく合うもの]",
            "",
        ),
        ("unit_px", "画像での半間の長さを画素数で指定する", ""),
        ("ken", "縮尺を、画像の二点とその間の間数で指定する", ""),
        (
            "pages",
            "PDF のこのページを読む。PDF 一つにつき一度 [既定値: 1]",
            "",
        ),
        (
            "corners",
            "紙の四隅を画像の画素で、左上から時計回りに指定する",
            "",
        ),
        (
            "regions",
            "この枠の中の平面図だけを読む。枠は向かい合う二つの角で指定する。一枚に描かれた階は、一階から順に繰り返す",
            "",
        ),
        ("turn", "画像の傾きを時計回りの度数で指定する", ""),
        ("front", "図面で通りのある側を指定する", ""),
        (
            "registered",
            "上の階を、最初の画像の点と、同じ位置にあたるその階の画像の点が重なるように置く。二枚目から順に、一枚につき一度",
            "",
        ),
        ("era", "壁、戸、窓に使う部材の時代を選ぶ", ""),
        (
            "unit",
            "半間の長さ: edo-ma（3 尺）、kyo-ma（3.25 尺）、または尺の数 [既定値: 図面にあればその値、なければ edo-ma]",
            "",
        ),
        (
            "heights",
            "階の高さを尺で指定する。下の階から、一階につき一度",
            "",
        ),
        (
            "steps",
            "段階ごとに見つけたものを、このフォルダーに描く",
            "",
        ),
        (
            "force",
            "手で直した家や、図面から読んだのではない家も置き換える",
            "",
        ),
        ("quiet", "指摘だけを表示する", ""),
    ],
    values: &[
        ("bottom", "下"),
        ("left", "左"),
        ("top", "上"),
        ("right", "右"),
        ("edo", "土壁と障子"),
        ("meiji", "板壁と障子"),
        ("showa", "板壁とガラス戸"),
    ],
}];
