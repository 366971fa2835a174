//! Messages about platforms, verandas, finials and monuments (HSD07xx).

use hsd_base::diagnostic::{Diagnostic, Edit};
use hsd_base::source::Span;
use hsd_base::text;

/// A platform or a veranda around walls that do not close; `name` = the element.
#[cold]
pub fn nothing_to_stand_at(span: Span, name: &str) -> Diagnostic {
    let message = text!([name]
        "there are no closed walls for this `{name}` to surround",
        "この `{name}` が囲む閉じた壁がありません"
    );
    let help = text!(
        "close the walls of the storey, or remove it",
        "階の壁を閉じるか、この要素を取り除いてください"
    );
    Diagnostic::warning(701, span, message).help(help).fix(
        text!([name] "Remove the `{name}`", "`{name}` を取り除く"),
        span,
        "",
    )
}

/// A finial on a house without a roof.
#[cold]
pub fn no_roof_below(span: Span) -> Diagnostic {
    let message = text!(
        "there is no roof below this finial",
        "この屋根飾りの下に屋根がありません"
    );
    let help = text!(
        "write a roof under it, or remove `at` to set it on the highest roof",
        "その下に屋根を書くか、`at` を取り除いて最も高い屋根に載せてください"
    );
    Diagnostic::warning(702, span, message).help(help)
}

/// Something that is to stand by itself, but is no part: a picture or a void.
#[cold]
pub fn no_part_to_put(span: Span, name: &str) -> Diagnostic {
    let message = text!([name]
        "`{name}` cannot stand by itself: only parts of the catalogue can",
        "`{name}` は単独では置けません。置けるのはカタログの部材だけです"
    );
    let help = text!(
        "write a part, such as `OTO` (a stone lantern), or a `PartDef` of your own",
        "`OTO`(石灯籠)などの部材か、自作の `PartDef` を書いてください"
    );
    Diagnostic::error(705, span, message).help(help)
}

/// Something on the ground that stands within the walls of the house.
#[cold]
pub fn put_inside(span: Span) -> Diagnostic {
    let message = text!(
        "this stands on the ground inside the house",
        "建物の中の地面に立っています"
    );
    let help = text!(
        "`at` is its middle in units: to the left of the house's origin, then back; in front of the house the second number is negative",
        "`at` は中心の位置(ユニット)で、原点から左へ、次に奥へ数えます。正面の手前では二つ目が負になります"
    );
    Diagnostic::warning(706, span, message).help(help)
}

/// Storeys next to a monument: the first, and the places of all.
#[cold]
pub fn storeys_beside(span: Span, name: &str, storey: Span, all: Vec<Span>) -> Diagnostic {
    let message = text!([name]
        "`{name}` is a whole house; the storeys next to it are ignored",
        "`{name}` だけで一棟の建物になります。並べて書いた階は使いません"
    );
    let help = text!([name]
        "remove the storeys, or write all storeys instead of `{name}`",
        "階を取り除くか、`{name}` の代わりにすべての階を書いてください"
    );
    let label = text!("the storeys begin here", "階はここから始まります");
    let remove = text!("Remove the storeys", "階を取り除く");
    let edits = all.into_iter().map(|span| Edit::new(span, ""));
    Diagnostic::error(703, span, message)
        .help(help)
        .label(storey, label)
        .fix_all(remove, edits.collect())
        .fix(
            text!([name] "Remove the `{name}`", "`{name}` を取り除く"),
            span,
            "",
        )
}

/// Dimensions that leave no room for the columns of a storey.
#[cold]
pub fn no_room(span: Span, storey: Scarce, has: f64, takes: f64) -> Diagnostic {
    let (en, ja) = storey.words();
    let (has, takes) = (format!("{has:.1}"), format!("{takes:.1}"));
    let message = text!([en, has, takes, ja]
        "{en} leaves {has} shaku for its columns; {takes} shaku are used",
        "{ja}の柱に残る高さは {has} 尺しかないため、{takes} 尺とします"
    );
    let help = text!(
        "make the storeys taper less, set them back less, or make them higher",
        "逓減や後退を小さくするか、階を高くしてください"
    );
    Diagnostic::warning(704, span, message).help(help)
}

/// Where room may be scarce.
#[derive(Clone, Copy, Debug)]
pub enum Scarce {
    /// A storey of a pagoda.
    Tier,
    /// The ground storey of a gate or a hall.
    Ground,
    /// The upper storey of a gate.
    Upper,
    /// The core of a hall above its mokoshi roof.
    Core,
}

impl Scarce {
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Scarce::Tier => ("a storey of the pagoda", "塔の重"),
            Scarce::Ground => ("the lower storey", "下層"),
            Scarce::Upper => ("the upper storey", "上層"),
            Scarce::Core => ("the core above its pent-roof enclosure", "裳階の上の身舎"),
        }
    }
}
