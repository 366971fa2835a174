//! Messages of `hsd fmt` (HSD08xx).

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// A layout that would not say the same: a fault of ours, and no harm is done.
#[cold]
pub fn left_alone(span: Span) -> Diagnostic {
    Diagnostic::error(
        801,
        span,
        "the text is left as it is: laid out, it would not say the same",
    )
    .help("this is a fault of hsd; please report it, with the text")
}

/// The other form would say something else.
#[cold]
pub fn not_the_same(span: Span, form: &str) -> Diagnostic {
    Diagnostic::error(802, span, format!("written as {form}, this file would make another building"))
        .help("something in it is beyond what that form takes: a number out of its bounds, a roof that falls where its shape has a ridge, a picture whose name reads as a control letter")
}

/// A draw: the legacy form has none.
#[cold]
pub fn draw(span: Span, codes: &str) -> Diagnostic {
    let message = format!("the legacy form cannot draw one of {codes}");
    Diagnostic::error(803, span, message)
        .help("put the part in its place that is to stand there, or keep the file in XML")
}

/// A part divided above and below.
#[cold]
pub fn split(span: Span) -> Diagnostic {
    Diagnostic::error(
        804,
        span,
        "the legacy form cannot divide a part above and below",
    )
    .help("put a part of full height in its place, or keep the file in XML")
}

/// A courtyard, or a second walk in a storey.
#[cold]
pub fn second_walk(span: Span) -> Diagnostic {
    Diagnostic::error(
        805,
        span,
        "a storey of the legacy form is one walk round the outside",
    )
    .help("courtyards and wings that stand apart need XML; wings may be houses of their own")
}

/// A turn that is no right angle.
#[cold]
pub fn odd_turn(span: Span, degrees: f64) -> Diagnostic {
    let message = format!("the legacy form turns by 90 degrees only, not by {degrees}");
    Diagnostic::error(806, span, message)
        .help("make it a right angle, `turn=\"R\"` or `turn=\"L\"`, or keep the file in XML")
}

/// Walls given facade by facade.
#[cold]
pub fn facades(span: Span) -> Diagnostic {
    Diagnostic::error(
        807,
        span,
        "the legacy form has no facades: their parts are scaled to a width, codes are not",
    )
    .help("write the walls as rows of a `Storey`, or keep the file in XML")
}

/// A part with a width of its own.
#[cold]
pub fn own_width(span: Span, code: &str, width: f64, usual: f64) -> Diagnostic {
    let message = format!("in the legacy form `{code}` is {usual} wide, not {width}");
    Diagnostic::error(808, span, message)
        .help("take a part of that width (`hsd parts` lists them), or keep the file in XML")
}

/// A part with a height of its own.
#[cold]
pub fn own_height(span: Span, code: &str) -> Diagnostic {
    let message = format!("the legacy form cannot say how high this `{code}` is");
    Diagnostic::error(809, span, message).help(
        "parts are as high as their storey there; leave the height out, or keep the file in XML",
    )
}

/// The name of a picture that is no code.
#[cold]
pub fn long_name(span: Span, name: &str) -> Diagnostic {
    let message = format!("{name:?} is no code of five columns");
    Diagnostic::error(810, span, message).help(
        "give the picture a name of at most five plain letters and digits, or keep the file in XML",
    )
}

/// A style of the automatic roofs.
#[cold]
pub fn roof_style(span: Span) -> Diagnostic {
    Diagnostic::error(811, span, "the legacy form cannot say what automatic roofs look like")
        .help("write the roofs as `Roof` elements with `mode=\"explicit\"`, leave the style out, or keep the file in XML")
}

/// A wall round a flat roof.
#[cold]
pub fn parapet(span: Span) -> Diagnostic {
    Diagnostic::error(812, span, "the legacy form has no parapets")
        .help("leave it out (flat roofs get a rim of their own), or keep the file in XML")
}

/// A start that no walk over voids leads to.
#[cold]
pub fn start_between(span: Span) -> Diagnostic {
    Diagnostic::error(
        813,
        span,
        "the legacy form cannot start here: voids lead whole units only",
    )
    .help("start at whole units, at most 1000 from the origin, or keep the file in XML")
}

/// A house above the ground.
#[cold]
pub fn raised(span: Span) -> Diagnostic {
    Diagnostic::error(
        814,
        span,
        "a house of the legacy form stands at height 0: its place has no `z`",
    )
    .help("leave `z` out, or keep the file in XML")
}

/// The gloss of a texture.
#[cold]
pub fn gloss(span: Span) -> Diagnostic {
    Diagnostic::error(
        815,
        span,
        "the legacy form cannot say how much a texture mirrors",
    )
    .help("leave `Texture` out, or keep the file in XML")
}

/// Braces, which hold expressions in XML.
#[cold]
pub fn braces(span: Span) -> Diagnostic {
    Diagnostic::error(
        816,
        span,
        "braces cannot be written in XML: they hold expressions there",
    )
    .help("use other signs, `(` and `)`, or keep the file in the legacy form")
}
