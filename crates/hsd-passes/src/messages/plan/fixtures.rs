//! Messages about fixtures (HSD0447 to 0451).

use glam::DVec2;
use hsd_base::diagnostic::{Diagnostic, Noun, noun};
use hsd_base::text;
use hsd_ir::ast::{Fixture as Written, FixtureKind};
use hsd_ir::building::Fixture;

/// Returns what a kind is called.
fn called(kind: FixtureKind) -> Noun {
    match kind {
        FixtureKind::Tokonoma => noun("tokonoma", "床の間"),
        FixtureKind::Chigaidana => noun("chigaidana", "違い棚"),
        FixtureKind::Butsudan => noun("butsudan", "仏壇"),
        FixtureKind::OshiIre => noun("oshi-ire", "押入"),
        FixtureKind::Stairs => noun("flight of stairs", "階段"),
        FixtureKind::HakoKaidan => noun("hako-kaidan", "箱階段"),
        FixtureKind::Kamado => noun("kamado", "竈"),
        FixtureKind::Well => noun("well", "井戸"),
        FixtureKind::Sink => noun("sink", "流し"),
    }
}

/// A fixture outside of the walls.
#[cold]
pub(crate) fn outside(fixture: &Written, [low, high]: [DVec2; 2]) -> Diagnostic {
    let kind = called(fixture.kind);
    let message = text!([kind]
        "this {kind} stands outside of the storey's walls, so it is left out",
        "この{kind}は階の壁の外にあるため、省きました"
    );
    let [a, b, c, d] = [low.x, high.x, low.y, high.y].map(|n| (n * 100.0).round() / 100.0);
    Diagnostic::warning(447, fixture.at.span, message).help(text!([a, b, c, d]
        "`at` is its corner nearest to the house's origin, in units to the left, then back: the walls stand between {a} and {b}, and between {c} and {d}; courtyards are outside too",
        "`at` は原点に近い角で、左へ、奥へのユニット数です。壁は左へ {a} から {b}、奥へ {c} から {d} の範囲にあります。中庭も外です"
    ))
}

/// A fixture with a wall in it.
#[cold]
pub(crate) fn through_a_wall(fixture: &Written) -> Diagnostic {
    let kind = called(fixture.kind);
    let message = text!([kind]
        "a wall runs through this {kind}, so it is left out",
        "この{kind}を壁が横切るため、省きました"
    );
    let span = fixture.size.as_ref().map_or(fixture.at.span, |s| s.span);
    Diagnostic::warning(447, span, message).help(text!(
        "it reaches from `at` to the left and back by `size`: move it, make it smaller, or move the wall",
        "`at` から左と奥へ `size` だけ占めます。動かすか、小さくするか、壁を動かしてください"
    ))
}

/// Two fixtures in one place.
#[cold]
pub(crate) fn in_one_place(second: &Written, first: &Fixture) -> Diagnostic {
    let [one, two] = [first.kind, second.kind].map(called);
    let message = text!([one, two]
        "this {two} stands where a {one} is already, so it is left out",
        "この{two}の場所にはすでに{one}があるため、省きました"
    );
    Diagnostic::warning(448, second.at.span, message)
        .help(text!(
            "move one of them; stairs take up as much of the storey above as of their own",
            "どちらかを動かしてください。階段は上の階でも同じ広さを占めます"
        ))
        .label(first.span, text!([one] "{one}", "{one}"))
}

/// A fixture whose front one cannot stand before.
#[cold]
pub(crate) fn front_against(fixture: &Fixture) -> Diagnostic {
    let kind = called(fixture.kind);
    let message = text!([kind]
        "nobody can stand before this {kind}: its front is at a wall or another fixture",
        "この{kind}の前に立てません。正面が壁か、ほかの造り付けに接しています"
    );
    Diagnostic::warning(449, fixture.span, message).help(text!(
        "`faces` names the side of the house that its front looks to: F front, B back, L left, R right",
        "`faces` は正面の向く側です。F 前、B 奥、L 左、R 右"
    ))
}

/// Stairs under a roof.
#[cold]
pub(crate) fn no_storey_above(stairs: &Written) -> Diagnostic {
    let message = text!(
        "these stairs lead nowhere: no storey stands above, so they are left out",
        "上の階がなく、この階段はどこにも通じないため、省きました"
    );
    Diagnostic::warning(450, stairs.span, message).help(text!(
        "write them in the storey that they start from, and the storey above after it",
        "階段は上り始める階に書き、その後に上の階を書いてください"
    ))
}

/// Stairs that end in a wall or outside.
#[cold]
pub(crate) fn blocked_above(stairs: &Written) -> Diagnostic {
    let message = text!(
        "these stairs lead nowhere: in the storey above a wall is in their way, or they end outside of it; they are left out",
        "上の階で壁に当たるか、階の外に出るため、この階段はどこにも通じません。省きました"
    );
    Diagnostic::warning(450, stairs.span, message).help(text!(
        "they rise from the side that `faces` names to the opposite one, and need room beyond it upstairs",
        "`faces` の側から反対の側へ上ります。上の階では、上り切った先に場所が要ります"
    ))
}

/// Stairs that are steeper than any.
#[cold]
pub(crate) fn too_steep(stairs: &Written, needed: f64) -> Diagnostic {
    let message = text!(
        "these stairs are steeper than 60 degrees",
        "この階段の勾配は 60 度を超えています"
    );
    let span = stairs.size.as_ref().map_or(stairs.span, |s| s.span);
    Diagnostic::warning(451, span, message).help(text!([needed]
        "for the height of this storey give them a length of {needed} units or more by `size`",
        "この階の高さなら、`size` で長さを {needed} ユニット以上にしてください"
    ))
}
