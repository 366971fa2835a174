//! Messages about pictures and textures (HSD06xx), and about the output as a whole.

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// A part picture that was found cannot be read.
#[cold]
pub fn unreadable(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::error(
        601,
        span,
        format!("the picture {file:?} cannot be read: {why}"),
    )
    .help("see that the file still exists and that you may read it")
}

/// A file with the name of a picture that holds none.
#[cold]
pub fn no_picture(span: Span, file: &str) -> Diagnostic {
    let message = format!("{file:?} is no picture in PNG or JPEG, or it is damaged");
    Diagnostic::error(602, span, message)
        .help("open it in a paint program and save it again as PNG; only renaming a BMP or TIFF is not enough")
}

/// A picture with more pixels than the limit.
#[cold]
pub fn too_many_pixels(span: Span, file: &str, pixels: u64, limit: u64) -> Diagnostic {
    let message =
        format!("the picture {file:?} has {pixels} pixels, more than the limit of {limit}");
    Diagnostic::error(905, span, message)
        .help("make it smaller (1024 pixels a side are plenty for a part), or raise the limit with `--max-pixels`")
}

/// A shape with numbers that no format takes.
#[cold]
pub fn shape_left_out(span: Span, name: &str) -> Diagnostic {
    let message = format!("the shape of {name:?} came out broken and is left out");
    Diagnostic::warning(603, span, message).help(
        "look for numbers beyond all measure here, in heights, widths or the place of the house; if there are none, the program is at fault: please report it together with this text",
    )
}
