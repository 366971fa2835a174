//! Messages about features and layers that are left out or unused.

use hsd_base::diagnostic::messages::words::{all_of, quote};
use hsd_base::diagnostic::{Diagnostic, Origin, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// Features with the outline of another.
#[cold]
pub fn drawn_twice(layer: Span, name: &str, keys: &[&str]) -> Diagnostic {
    let (name, count, few) = (quote(name), keys.len(), few_of(keys));
    let message = text!([name, count, few]
        "{count} features of {name} have the outline of another feature and are left out, such as {few}",
        "{name} の {count} 件の地物は別の地物と同じ輪郭なので省きます（{few} など）"
    );
    Diagnostic::warning(1118, layer, message).help(text!(
        "delete the duplicates in the map",
        "地図から重複を削除してください"
    ))
}

/// A house in the place of another: the share of its outline inside the other's.
#[cold]
pub fn covered(origin: Origin, other: &str, share: f64) -> Diagnostic {
    let other = quote(other);
    if share >= 1.0 {
        let message = text!([other]
            "it is inside the outline of {other} and is left out",
            "{other} の輪郭の中にあるので省きます"
        );
        return Diagnostic::warning(1118, origin, message).help(text!(
            "draw a courtyard into the outer outline, tag the inner one `building:part=yes` with `min_height`, or delete one of them",
            "外側の輪郭に中庭を描くか、内側に `building:part=yes` と `min_height` を付けるか、一方を削除してください"
        ));
    }
    let percent = (share * 100.0).floor();
    let message = text!([other, percent]
        "{percent} % of it is inside the outline of {other}, and it is left out",
        "{percent} % が {other} の輪郭の中にあるので省きます"
    );
    Diagnostic::warning(1118, origin, message).help(text!(
        "draw the outlines side by side, or tag the upper one `building:part=yes` with `min_height`",
        "輪郭が重ならないように描くか、上にあるほうに `building:part=yes` と `min_height` を付けてください"
    ))
}

/// Features whose outline crosses itself so that its centroid is elsewhere.
#[cold]
pub fn centre_outside(layer: Span, name: &str, keys: &[&str]) -> Diagnostic {
    let (name, count, few) = (quote(name), keys.len(), few_of(keys));
    let message = text!([name, count, few]
        "{count} features of {name} cross themselves so that their centroid is outside, and are left out, such as {few}",
        "{name} の {count} 件の地物は輪郭が交差し、重心が外にあるので省きます（{few} など）"
    );
    Diagnostic::warning(1119, layer, message).help(text!(
        "draw them again, or repair them in a program for maps (in QGIS: Fix geometries)",
        "描き直すか、地図のソフトで直してください（QGIS の「ジオメトリの修復」など）"
    ))
}

/// A layer that nothing in the town depends on.
#[cold]
pub fn layer_unused(layer: Span, name: &str, count: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!([name, count]
        "no `for` names the layer {name}, and nothing is made of its {count} features",
        "レイヤー {name} を対象とする `for` がなく、{count} 件の地物からは何も作られません"
    );
    Diagnostic::note(1120, layer, message).help(text!(
        "write a `for` that takes them, or remove the layer",
        "それらを受ける `for` を書くか、レイヤーを消してください"
    ))
}

/// Returns the first few of a list of keys.
fn few_of(keys: &[&str]) -> Text {
    all_of(&keys[..keys.len().min(3)])
}
