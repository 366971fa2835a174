//! Messages about the plane in which a town is built.

use hsd_base::diagnostic::Diagnostic;
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::source::Span;
use hsd_base::text;

/// A reference system that is not known.
#[cold]
pub fn unknown_crs(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "the reference system {name} is not known",
        "座標系 {name} がわかりません"
    );
    Diagnostic::error(1117, span, message).help(text!(
        "write a plane zone of Japan such as `EPSG:6674`, a UTM zone, or `local` for metres of a survey",
        "`EPSG:6674` のような平面直角座標系、UTM、そのままのメートルなら `local` と書いてください"
    ))
}

/// A reference system in which nothing is built.
#[cold]
pub fn crs_not_in_metres(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "the coordinates of {name} are not metres, in which a town is built",
        "{name} の座標は、町を作るのに要るメートルではありません"
    );
    Diagnostic::error(1117, span, message).help(text!(
        "write a plane zone of Japan such as `EPSG:6674` or a UTM zone; maps in other systems are converted",
        "`EPSG:6674` のような平面直角座標系か UTM を書いてください。ほかの座標系の地図は変換されます"
    ))
}
