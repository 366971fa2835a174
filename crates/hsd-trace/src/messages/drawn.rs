//! Messages about drawn plans that `hsd plan` reads (HSD12xx).

use hsd_base::diagnostic::{Diagnostic, Noun, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// A wall that was read with doubt; `x` and `y` are its pixels in `sheet`.
#[cold]
pub fn doubtful(span: Span, what: Noun, sheet: &str, (x, y): (i64, i64)) -> Diagnostic {
    let message = text!([what, sheet, x, y]
        "this was read as {what}, with doubt; it is drawn at {x}, {y} in {sheet}",
        "{what}と読みましたが、確かではありません（{sheet} の {x}, {y}）"
    );
    Diagnostic::warning(1201, span, message).help(text!(
        "compare the red rings of the review picture with the plan; correct the part, or delete its entry from the comment if it is right",
        "確認用の画像の赤い丸を図面と見比べ、違っていれば部材を直し、合っていれば注釈からその項目を消してください"
    ))
}

/// A gap between two walls that was closed.
#[cold]
pub fn joined(span: Span, sheet: &str, (x, y): (i64, i64)) -> Diagnostic {
    let message = text!([sheet, x, y]
        "nothing is drawn here between two walls, at {x}, {y} in {sheet}; it became an open way, so that the outline closes",
        "二つの壁の間に何も描かれていません（{sheet} の {x}, {y}）。外周を閉じるために開口としました"
    );
    Diagnostic::warning(1202, span, message).help(text!(
        "write the wall that stands there, or keep `AKI` if it is a way in",
        "そこに壁があるなら書き直し、出入り口なら `AKI` のままにしてください"
    ))
}

/// A picture without a plan that can be read, for a reason.
#[cold]
fn no_plan(span: Span, why: Text) -> Diagnostic {
    let message =
        text!([why] "there is no plan in this picture: {why}", "この画像に図面がありません。{why}");
    Diagnostic::error(1203, span, message).help(text!(
        "crop the picture to one plan; if it is one, give the length of half a ken in pixels with --unit-px, the corners of the sheet with --corners, or the legend with --legend",
        "画像を一つの平面図に切り抜いてください。平面図なら、半間の画素数を --unit-px で、紙の四隅を --corners で、凡例を --legend で指定してください"
    ))
}

/// A picture with nearly no ink; `share` is how much of it is ink.
#[cold]
pub fn blank(span: Span, share: f64) -> Diagnostic {
    let share = (share * 10_000.0).round() / 100.0;
    no_plan(
        span,
        text!([share] "only {share} % of it is ink", "インクの部分が {share} % しかありません"),
    )
}

/// A picture whose strokes keep to no grid; `share` is how far they agree with the best.
#[cold]
pub fn no_grid(span: Span, share: f64) -> Diagnostic {
    let share = (share * 100.0).round();
    no_plan(
        span,
        text!([share]
            "its strokes keep to no grid of half ken (agreement {share} %)",
            "線が半間の格子に合いません（一致 {share} %）"
        ),
    )
}

/// An image whose strokes keep to a grid of `cells` cells; at most `most` are read.
#[cold]
pub fn too_fine(span: Span, cells: i64, most: i64) -> Diagnostic {
    no_plan(
        span,
        text!([cells, most]
            "its strokes keep to a grid of {cells} cells, and at most {most} are read",
            "線が {cells} マスの格子に合いますが、読めるのは {most} マスまでです"
        ),
    )
}

/// A picture whose strokes are those of no legend; `share` is how far they agree with the best.
#[cold]
pub fn no_symbols(span: Span, share: f64) -> Diagnostic {
    let share = (share * 100.0).round();
    no_plan(
        span,
        text!([share]
            "its strokes lie on a grid, but look like the walls of no known legend (agreement {share} %)",
            "線は格子に合いますが、どの凡例の壁にも似ていません（一致 {share} %）"
        ),
    )
}

/// A picture whose walls enclose nothing.
#[cold]
pub fn no_house(span: Span) -> Diagnostic {
    no_plan(
        span,
        text!("its walls enclose no house", "壁が家を囲んでいません"),
    )
}

/// A plan without anything that says how large it is.
#[cold]
pub fn no_size(span: Span) -> Diagnostic {
    let message = text!(
        "nothing on this plan says how large the house is: no dimensions, doors or grid of half ken were found",
        "この図面には大きさの手がかりがありません（寸法、戸、半間の格子のどれも見つかりません）"
    );
    Diagnostic::error(1203, span, message).help(text!(
        "measure two points whose distance is known and give them as --ken \"X,Y X,Y N\", N in ken of 1.818 m",
        "距離のわかる二点を測り、--ken \"X,Y X,Y 間数\" で指定してください（1間は1.818 m）"
    ))
}

/// A box that holds nothing of the image.
#[cold]
pub fn outside(span: Span) -> Diagnostic {
    let message = text!(
        "the box given by `--region` lies outside the image",
        "`--region` の枠が画像の外にあります"
    );
    Diagnostic::error(1203, span, message).help(text!(
        "give two opposite corners in pixels of the file, from its upper left corner",
        "向かい合う二つの角を、ファイルの左上の隅から数えた画素で指定してください"
    ))
}

/// A storey on a grid that cannot be read wall by wall, as another storey of its house is.
#[cold]
pub fn not_by_walls(span: Span) -> Diagnostic {
    let message = text!(
        "this storey keeps to a grid and cannot be read wall by wall, as another storey of the house is",
        "この階は格子に沿っていて、ほかの階のように壁ごとに読むことができません"
    );
    Diagnostic::error(1203, span, message).help(text!(
        "read each storey alone, or all with `--legend`, on a grid",
        "階を一つずつ読むか、`--legend` を付けてすべてを格子で読んでください"
    ))
}

/// A file that is no picture, or one that cannot be read, for a reason.
#[cold]
fn unreadable(span: Span, message: Text) -> Diagnostic {
    Diagnostic::error(1204, span, message).help(text!(
        "open it in an image editor and save it as PNG",
        "画像ソフトで開き、PNG で保存し直してください"
    ))
}

/// A file of another format.
#[cold]
pub fn no_picture(span: Span) -> Diagnostic {
    unreadable(
        span,
        text!(
            "this is no plan that can be read: not PNG, JPEG, TIFF, WebP, SVG, DXF or PDF",
            "読める図面ではありません（PNG、JPEG、TIFF、WebP、SVG、DXF、PDF のどれでもない）"
        ),
    )
}

/// A picture of too many pixels.
#[cold]
pub fn too_large(span: Span) -> Diagnostic {
    let message = text!(
        "this picture has more than 100 million pixels",
        "この画像は1億画素を超えています"
    );
    Diagnostic::error(1204, span, message).help(text!(
        "make it smaller; 60 pixels for half a ken are enough",
        "縮小してください。半間が60画素あれば足ります"
    ))
}

/// A damaged picture.
#[cold]
pub fn damaged(span: Span, why: &str) -> Diagnostic {
    unreadable(
        span,
        text!([why] "this picture is damaged: {why}", "この画像は壊れています: {why}"),
    )
}

/// A drawing that cannot be read, and how it can be made so that it can.
#[cold]
fn unreadable_drawing(span: Span, message: Text) -> Diagnostic {
    Diagnostic::error(1204, span, message).help(text!(
        "open it in the program that made it and save it again, as SVG, DXF (R12 to 2018) or PDF",
        "作ったソフトで開き、SVG、DXF（R12から2018）、PDF のどれかで保存し直してください"
    ))
}

/// A file that begins like an SVG and is damaged; `what` is in English, from the reader of XML.
#[cold]
pub fn no_svg(span: Span, what: &str) -> Diagnostic {
    unreadable_drawing(
        span,
        text!([what] "this SVG is damaged: {what}", "この SVG は壊れています: {what}"),
    )
}

/// A file that is no DXF at a line; `what` is in English, as it names parts of the format.
#[cold]
pub fn no_dxf(span: Span, what: &str) -> Diagnostic {
    unreadable_drawing(
        span,
        text!([what] "this is no DXF that can be read: {what}", "DXF として読めません: {what}"),
    )
}

/// A DXF that ends without its `EOF`; `lines` is how many lines it has.
#[cold]
pub fn dxf_ends(span: Span, lines: usize) -> Diagnostic {
    unreadable_drawing(
        span,
        text!([lines]
            "this DXF ends too early, after line {lines}: `EOF` is missing",
            "この DXF は {lines} 行目で途切れています（`EOF` がありません）"
        ),
    )
}

/// A file that begins like a PDF and cannot be read; `what` is in English, from the reader of PDFs.
#[cold]
pub fn no_pdf(span: Span, what: &str) -> Diagnostic {
    unreadable_drawing(
        span,
        text!([what] "this PDF cannot be read: {what}", "この PDF は読めません: {what}"),
    )
}

/// A drawing with more than `most` of something; `what` is in English.
#[cold]
pub fn large_drawing(span: Span, what: &str, most: usize) -> Diagnostic {
    let message = text!([what, most]
        "this drawing has more than {most} {what}",
        "この図面は大きすぎます（{most} を超えるもの: {what}）"
    );
    Diagnostic::error(1204, span, message).help(text!(
        "save the plan alone, without other sheets, hatching and furniture",
        "ほかの図、ハッチング、家具を除き、平面図だけを保存してください"
    ))
}

/// A PDF without the page that is asked for.
#[cold]
pub fn no_page(span: Span, asked: usize, pages: usize) -> Diagnostic {
    let message = text!([asked, pages]
        "this PDF has no page {asked}; it has {pages}",
        "この PDF に {asked} ページ目はありません（全 {pages} ページ）"
    );
    Diagnostic::error(1204, span, message).help(text!(
        "give the page of the plan with --page, counted from 1",
        "平面図のページを --page で、1から数えて指定してください"
    ))
}

/// A plan of `hsd draw` that was changed so that it cannot be read; `what` is in English.
#[cold]
pub fn unclear(span: Span, what: &str) -> Diagnostic {
    let message = text!([what]
        "`hsd draw` made this plan, and it was changed so that the house cannot be told: {what}",
        "`hsd draw` の図面ですが、変更されたため家を読めません: {what}"
    );
    Diagnostic::error(1204, span, message).help(text!(
        "draw it again with `hsd draw`, or save it without its groups, so that it is read like any other drawing",
        "`hsd draw` で描き直すか、グループを解除して保存し、ほかの図面と同じように読ませてください"
    ))
}

/// A drawing of whole houses among the sheets of storeys.
#[cold]
pub fn whole_house(span: Span) -> Diagnostic {
    Diagnostic::error(1204, span, text!(
        "`hsd draw` made this plan; it holds all storeys of its house, so it is no sheet of one storey",
        "`hsd draw` の図面です。家のすべての階を含むので、一つの階の図面にはなりません"
    ))
    .help(text!(
        "read it alone: `hsd plan PLAN.svg -o OUT.hsd`",
        "この図面だけを読ませてください: `hsd plan PLAN.svg -o OUT.hsd`"
    ))
}

/// A drawing without a plan that can be read, for a reason.
#[cold]
fn no_plan_drawn(span: Span, why: Text) -> Diagnostic {
    let message = text!([why] "there is no plan in this drawing: {why}", "この図面から平面図を読めません。{why}");
    Diagnostic::error(1203, span, message)
}

/// A drawing in which nothing is drawn.
#[cold]
pub fn nothing_drawn(span: Span) -> Diagnostic {
    no_plan_drawn(span, text!("it has no lines", "線がありません")).help(text!(
        "switch on the layers of the plan and save it again",
        "平面図のレイヤを表示して保存し直してください"
    ))
}

/// Layers or groups of a message, the most.
const LAYERS: usize = 12;

/// A drawing of which nothing says what walls are; `names` are those of its layers, blocks and groups.
#[cold]
pub fn no_roles(span: Span, names: &[String]) -> Diagnostic {
    let quoted = names.iter().filter(|n| !n.is_empty()).take(LAYERS);
    let names: Vec<String> = quoted.map(|n| format!("`{n}`")).collect();
    let names = names.join(", ");
    let why = match names.is_empty() {
        true => text!(
            "its lines are on no layers, and look like the walls of no known legend",
            "線がレイヤに分かれておらず、どの凡例の壁にも似ていません"
        ),
        false => text!([names]
            "no legend says which of its layers and blocks are walls ({names}), and its lines look like those of no known legend",
            "どのレイヤやブロックが壁かわかりません（{names}）。線もどの凡例の壁にも似ていません"
        ),
    };
    no_plan_drawn(span, why).help(text!(
        "write a legend with lines like `<Layer name=\"A-WALL\" role=\"wall\"/>` and give it with --legend; grammar/legend-cad.xml is one to copy",
        "`<Layer name=\"A-WALL\" role=\"wall\"/>` のような行の凡例を書き、--legend で指定してください。`grammar/legend-cad.xml` を写して書き換えられます"
    ))
}

/// A drawing whose walls keep to no grid; `strokes` is the number of strokes in its walls.
#[cold]
pub fn drawn_off_grid(span: Span, strokes: usize) -> Diagnostic {
    let why = text!([strokes]
        "its walls ({strokes} strokes) keep to no grid of half ken",
        "壁（線 {strokes} 本）が半間の格子に合いません"
    );
    no_plan_drawn(span, why).help(text!(
        "give the length of half a ken with --unit, in shaku",
        "半間の長さを --unit で、尺で指定してください"
    ))
}

/// A drawing whose walls enclose nothing.
#[cold]
pub fn drawn_open(span: Span) -> Diagnostic {
    no_plan_drawn(
        span,
        text!("its walls enclose no house", "壁が家を囲んでいません"),
    )
    .help(text!(
        "close the outline where walls, doors or windows are missing, or name the layers that they are on in a legend",
        "欠けている壁、戸、窓を描いて外周を閉じるか、それらのレイヤを凡例に加えてください"
    ))
}

/// A legend that cannot be read; `what` is in English, as it names elements and attributes.
#[cold]
pub fn legend(span: Span, what: &str) -> Diagnostic {
    let message = text!([what]
        "this is no legend of a plan: {what}",
        "図面の凡例として読めません: {what}"
    );
    Diagnostic::error(1205, span, message).help(text!(
        "grammar/plans.md lists the elements of a legend; `grammar/legend-survey.xml` is one to copy",
        "凡例の要素は grammar/plans.ja.md にあります。`grammar/legend-survey.xml` を写して書き換えられます"
    ))
}

/// A place that the author has changed and that is read otherwise now.
#[cold]
pub fn kept(span: Span) -> Diagnostic {
    Diagnostic::warning(1206, span, text!(
        "the plan is read otherwise here than before, but you have changed this; your change stays",
        "ここは前回と違う読みになりましたが、書き換えられているため、そのまま残しました"
    ))
    .help(text!(
        "compare it with the plan; `--force` takes the new reading everywhere",
        "図面と見比べてください。`--force` を付けると、すべて新しい読みになります"
    ))
}

/// A plan whose size was taken from its doors, walls or mats; `by` says from which.
#[cold]
pub fn assumed_size(span: Span, by: Text, [width, depth]: [f64; 2]) -> Diagnostic {
    let [width, depth] = [width, depth].map(|m| (m * 10.0).round() / 10.0);
    let message = text!([by, width, depth]
        "no dimensions on the sheet say how large the house is; {by} make it {width} x {depth} m",
        "図面に寸法がありません。{by}から {width} x {depth} m としました"
    );
    Diagnostic::warning(1207, span, message).help(text!(
        "measure two points whose distance is known and give them as --ken \"X,Y X,Y N\", N in ken of 1.818 m",
        "距離のわかる二点を測り、--ken \"X,Y X,Y N\" で指定してください（N は間、1 間は 1.818 m）"
    ))
}

/// Separate plans on one sheet, of which one was read, or none; `regions` are the boxes of all as `--region` takes them.
#[cold]
pub fn several(span: Span, regions: &[String], is_read: bool) -> Diagnostic {
    let count = regions.len();
    let message = match is_read {
        true => text!([count]
            "the sheet shows {count} separate plans; one of them was read",
            "紙に離れた平面図が {count} つあります。そのうち一つだけを読みました"
        ),
        false => text!([count]
            "the sheet shows {count} separate plans; the largest cannot be read",
            "紙に離れた平面図が {count} つあります。最も大きいものが読めません"
        ),
    };
    let options: Vec<String> = regions
        .iter()
        .map(|r| format!("--region \"{r}\""))
        .collect();
    let options = options.join(" ");
    Diagnostic::error(1208, span, message).help(text!([options]
        "to read the storeys of one house, give their boxes in order, the ground storey first; to read one plan, give only its box: `{options}`",
        "一軒の家の階として読むときは、一階から順に枠を指定してください。一つだけ読むときは、その枠だけを指定してください: `{options}`"
    ))
}

/// Houses on a sheet beside the one that was read, with their area in square metres.
#[cold]
pub fn left_out(span: Span, area: f64) -> Diagnostic {
    let area = area.round();
    let message = text!([area]
        "the sheet shows more than one plan; {area} m2 beside the largest were left out",
        "紙に平面図が二つ以上あります。最も大きいもののほかの {area} m2 は読んでいません"
    );
    Diagnostic::error(1208, span, message).help(text!(
        "give the box of one plan with `--region`; repeat it for the storeys of one house, the ground storey first",
        "読む平面図の枠を `--region` で指定してください。一軒の家の階なら、一階から順に繰り返してください"
    ))
}
