//! Messages about parts and operations (HSD03xx), and the limit on parts (HSD0904).

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// A width as an author would write it.
fn units(width: f64) -> String {
    let rounded = (width * 1000.0).round() / 1000.0;
    format!("{rounded} U")
}

/// A code is neither a part nor a picture.
#[cold]
pub fn unknown_code(span: Span, code: &str, near: &[String]) -> Diagnostic {
    let help = if near.is_empty() {
        format!(
            "put the picture `{code}.png` into the folder of this file or its `textures` folder, or \
             name another folder by --textures"
        )
    } else {
        format!("did you mean {}? `hsd parts` lists all parts", any_of(near))
    };
    let message = format!("`{code}` is neither a part nor a part picture");
    Diagnostic::error(301, span, message).help(help)
}

/// The name of a part where its code should stand.
#[cold]
pub fn part_name(span: Span, name: &str, code: &str) -> Diagnostic {
    let message = format!("`{name}` is the name of a part, not its code");
    Diagnostic::error(301, span, message).help(format!(
        "`{name}` is the part `{code}`: write its code in five columns"
    ))
}

fn any_of(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

/// A control letter slipped into a code whose blanks were lost.
#[cold]
pub fn lost_blanks(span: Span, text: &str, code: &str, control: char) -> Diagnostic {
    let mended = format!("{code:<5}{control}");
    let message = format!("`{text}` is not a part; the blanks before `{control}` seem to be lost");
    Diagnostic::error(302, span, message).help(format!(
        "did you mean `{mended}`? A code fills five columns, the turn follows it"
    ))
}

/// Small letters in a code.
#[cold]
pub fn lower_case(span: Span, text: &str, code: &str) -> Diagnostic {
    let message = format!("`{text}` is not a part, but `{}` is", code.trim_end());
    Diagnostic::error(303, span, message).help(format!(
        "write capital letters: `{}`; only the `h` of half a unit is small",
        code.trim_end()
    ))
}

/// Nothing between two commas, or nothing at all.
#[cold]
pub fn empty_code(span: Span) -> Diagnostic {
    Diagnostic::error(304, span, "a code is missing here")
        .help("write a code, or take the comma away; an open bay is written `.....`")
}

/// Not one weight for each code.
#[cold]
pub fn weight_count(span: Span, weights: usize, codes: usize) -> Diagnostic {
    let message = format!("{weights} weights for {codes} codes");
    Diagnostic::error(305, span, message)
        .help(format!("give {codes} weights, one for each code, or none"))
}

/// A draw that would move the rest of the wall.
#[cold]
pub fn drawn_widths(span: Span, width: f64, first: Span, usual: f64) -> Diagnostic {
    let (width, usual) = (units(width), units(usual));
    let message = format!("the codes of this draw differ in width: {usual} and {width}");
    Diagnostic::error(306, span, message)
        .label(first, format!("{usual} wide; this width counts"))
        .help("choose codes of one width, so that the outline does not depend on the draw")
}

/// A replacement that would move the rest of the wall.
#[cold]
pub fn replaced_width(span: Span, code: &str, new: f64, there: Span, old: f64) -> Diagnostic {
    let (new, old) = (units(new), units(old));
    let message = format!("`{code}` is {new} wide, but the part it replaces {old}");
    Diagnostic::error(307, span, message)
        .label(there, format!("{old} wide"))
        .help(format!(
            "choose a part of {old}, so that the outline stays closed"
        ))
}

/// A draw that finds nothing to draw again.
#[cold]
pub fn idle_random(span: Span) -> Diagnostic {
    let message = "no code of this `random` stands in its element, so nothing is drawn";
    Diagnostic::warning(308, span, message).help(
        "beside parts, `random` draws again where a code of its list stands: put one of its codes \
         where the draw shall be",
    )
}

/// A substitution that finds nothing.
#[cold]
pub fn idle_replace(span: Span) -> Diagnostic {
    let message = "nothing in its element fits this `replace`, so nothing is replaced";
    Diagnostic::warning(309, span, message)
        .help("`code` names what stands there now, `with` what shall come instead")
}

/// A position where no part is.
#[cold]
pub fn beyond_the_row(span: Span, position: u32, longest: usize) -> Diagnostic {
    let message = format!("position {position} lies beyond the row, which has {longest} parts");
    Diagnostic::warning(310, span, message).help(format!(
        "positions count from 1 to {longest}; a split counts as one"
    ))
}

/// The halves of a split do not fit.
#[cold]
pub fn unequal_halves(span: Span, halves: (Span, Span), upper: f64, lower: f64) -> Diagnostic {
    let (above, below) = (units(upper), units(lower));
    let wide = units(upper.max(lower));
    let message = format!("the upper half of this split is {above} wide, the lower half {below}");
    Diagnostic::error(311, span, message)
        .label(halves.0, format!("{above} wide"))
        .label(halves.1, format!("{below} wide"))
        .help(format!("give both halves parts of {wide} in all"))
}

/// Nobody says what stands in a floor.
#[cold]
pub fn floor_without_parts(span: Span, id: &str, picture: &str) -> Diagnostic {
    let message = format!(
        "floor `{id}` has no parts, no other floor `{id}` has any, and there is no picture \
         `{picture}.png`"
    );
    Diagnostic::error(312, span, message).help(format!(
        "write parts into the floor, or put `{picture}.png` and its neighbours into the folder of \
         this file, its `textures` folder, or the one named by --textures"
    ))
}

/// Nobody can guess where a courtyard lies.
#[cold]
pub fn hole_without_start(span: Span) -> Diagnostic {
    Diagnostic::error(313, span, "a hole must say where its walk starts").help(
        "give the corner at its right and back, for example start=\"2 5\": a to the left and b to \
         the back, in units from the house's origin",
    )
}

/// The facades of a storey disagree.
#[cold]
pub fn floor_heights(span: Span, height: f64, there: Span, other: f64) -> Diagnostic {
    let message = format!("this floor is {height} shaku high, its storey elsewhere {other}");
    Diagnostic::warning(315, span, message)
        .label(there, format!("{other} shaku; the largest height counts"))
        .help("give all floors of a storey the same height")
}

/// A turn that looks like the angle between two walls.
#[cold]
pub fn steep_angle(span: Span, angle: f64) -> Diagnostic {
    let interior = 180.0 - angle.abs();
    let message =
        format!("the walk turns by {angle} degrees here, nearly back to where it came from");
    Diagnostic::note(316, span, message).help(format!(
        "`angle` is the turn from the facade before; if {angle} is the angle between the two walls, \
         write {interior}"
    ))
}

/// Gloss for nothing.
#[cold]
pub fn idle_texture(span: Span, code: &str, near: &[String]) -> Diagnostic {
    let message = format!("no part of this house is called `{code}`");
    Diagnostic::warning(317, span, message).help(if near.is_empty() {
        "name a part or a part picture that stands in the house".to_owned()
    } else {
        format!("did you mean {}?", any_of(near))
    })
}

/// A house of nothing.
#[cold]
pub fn empty_house(span: Span) -> Diagnostic {
    Diagnostic::error(318, span, "this house has no storey and no facade")
        .help("give it a Storey with Rows, or a Structure with Facades")
}

/// Upper pictures without lower ones.
#[cold]
pub fn no_lower_picture(span: Span, name: &str) -> Diagnostic {
    let message = format!(
        "there is a picture `{name}u1.png` but no `{name}l1.png`: the upper pieces fill the whole \
         height"
    );
    Diagnostic::note(319, span, message).help(format!(
        "add `{name}l1.png` for what is below, or call the picture `{name}.png` if it is undivided"
    ))
}

/// A wall without a storey.
#[cold]
pub fn facade_without_floors(span: Span) -> Diagnostic {
    Diagnostic::warning(320, span, "this facade has no floor; its side stays open")
        .help("write a Floor for each storey")
}

/// Two ways of writing at once.
#[cold]
pub fn storeys_and_structure(span: Span, storey: Span) -> Diagnostic {
    let message = "a house is written by storeys or by facades, not both; the facades are left out";
    Diagnostic::error(321, span, message)
        .label(storey, "the storeys begin here")
        .help("make two houses of it, or write the facades as Rows")
}

/// More than one replacement.
#[cold]
pub fn several_withs(span: Span) -> Diagnostic {
    let message = "`with` takes one code; the first counts";
    Diagnostic::error(322, span, message).help("use `random` to choose among several codes")
}

/// A code that white space tore in two.
#[cold]
pub fn torn_code(span: Span, code: &str) -> Diagnostic {
    let message = format!("white space divides this list, so `{code}` falls in two");
    Diagnostic::error(314, span, message).help(format!(
        "put commas between the codes, or write the blanks in a code as `_`: `{}`",
        code.replace(' ', "_")
    ))
}

/// Too many parts, or too much work on them.
#[cold]
pub fn too_many_parts(span: Span, limit: u64) -> Diagnostic {
    let message = format!("this house would exceed {limit} parts, or too much work on them");
    Diagnostic::error(904, span, message)
        .help("repeat less often, make several houses of it, or raise the limit for parts")
}
