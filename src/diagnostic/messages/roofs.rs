//! Messages about roofs (HSD05xx).

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// The name and the letter of a covering.
fn covering(kind: char) -> &'static str {
    match kind {
        'K' => "tiles (K)",
        'I' => "boards (I)",
        'S' => "shingles (S)",
        'H' => "bark (H)",
        'Y' => "thatch (Y)",
        _ => "metal (T)",
    }
}

/// A number without needless decimals.
fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A length in units: "1 unit", "1.5 units".
fn units(value: f64) -> String {
    let number = short(value);
    let ending = if number == "1" { "" } else { "s" };
    format!("{number} unit{ending}")
}

/// Roofs over walls that bound nothing.
#[cold]
pub fn open_facade(wished: Span, walk: Span, storey: u32) -> Diagnostic {
    Diagnostic::error(
        501,
        wished,
        format!("a roof is asked for, but storey {storey} is an open facade that bounds no area"),
    )
    .help("close the walk back to its start, or take the roofs out; a facade stands without them")
    .label(walk, "this walk does not come back to its start")
}

/// A roof line beside the house.
#[cold]
pub fn over_no_wall(line: Span, shape: &str) -> Diagnostic {
    Diagnostic::warning(
        502,
        line,
        format!("this {} roof stands over no wall of its storey", shape),
    )
    .help(
        "give the rectangle in units from the house's origin: a to the left along the first line, \
         b back from it; a roof outside the walls is HIS, KAT or KAR",
    )
}

/// A roof line that leaves the walls by some units.
#[cold]
pub fn partly_outside(line: Span, share: f64) -> Diagnostic {
    Diagnostic::warning(
        503,
        line,
        format!(
            "{} % of this roof's rectangle lies outside the walls",
            short((share * 100.0).round())
        ),
    )
    .help("the rectangle is that of the walls; eaves come on top of it by E, verges by G")
}

/// Two roof lines over each other at one height.
#[cold]
pub fn overlapping(line: Span, other: Span) -> Diagnostic {
    Diagnostic::note(
        504,
        line,
        "this roof overlaps another one at the same height",
    )
    .help("where both stand, the higher one shows; change one rectangle if that is not meant")
    .label(other, "the other roof")
}

/// An upper storey that stands out far over the lower one.
#[cold]
pub fn overhang(upper: Span, lower: Span, number: u32, by: f64) -> Diagnostic {
    Diagnostic::warning(
        505,
        upper,
        format!(
            "storey {} stands out by {} beyond storey {} below it, over nothing",
            number + 1,
            units(by),
            number
        ),
    )
    .help("set the upper storey's start point, by leading blanks or start=\"a b\", or mend the length of its lines")
    .label(lower, format!("storey {number}"))
}

/// An upper storey that stands out a little (degoshi, dashigeta).
#[cold]
pub fn jutting(upper: Span, number: u32, by: f64) -> Diagnostic {
    Diagnostic::note(
        506,
        upper,
        format!(
            "storey {} juts out by {} beyond storey {}",
            number + 1,
            units(by),
            number
        ),
    )
    .help("up to one unit is common (degoshi, dashigeta); boards and brackets close it from below")
}

/// A pitch that the covering does not bear.
#[cold]
pub fn odd_pitch(span: Span, pitch: f64, kind: char, band: (f64, f64)) -> Diagnostic {
    let why = if pitch < band.0 {
        "too gentle: rain comes in"
    } else {
        "too steep: it slides off"
    };
    Diagnostic::warning(
        507,
        span,
        format!(
            "a pitch of {} sun for {} is {why}",
            short(pitch),
            covering(kind)
        ),
    )
    .help(format!(
        "choose between {} and {} sun",
        short(band.0),
        short(band.1)
    ))
}

/// A ridge across a wide roof.
#[cold]
pub fn long_span(direction: Span, span: f64) -> Diagnostic {
    Diagnostic::note(
        508,
        direction,
        format!(
            "with this ridge the roof spans {} units, more than beams of 3 ken bear",
            short(span)
        ),
    )
    .help("turn the ridge (X or Y), or divide the roof; halls of palaces and temples do span more")
}

/// A roof in the air.
#[cold]
pub fn far_from_top(height: Span, shaku: f64, storey: u32, top: f64) -> Diagnostic {
    Diagnostic::warning(
        509,
        height,
        format!(
            "this roof stands at {} shaku, far from the nearest storey's top: storey {storey} ends at {}",
            short(shaku),
            short(top)
        ),
    )
    .help(format!("write {} or `*`; heights are shaku above the ground, not above the storey", short(top)))
}

/// A shape of a later version.
#[cold]
pub fn not_built_yet(span: Span, shape: &str) -> Diagnostic {
    Diagnostic::note(
        510,
        span,
        format!("{} is built as a gable by this version", shape),
    )
    .help("write KIR if a gable is meant")
}

/// A lean-to whose outer wall gets too low.
#[cold]
pub fn low_lean_to(storey: Span, number: u32, left: f64) -> Diagnostic {
    Diagnostic::warning(
        511,
        storey,
        format!(
            "a lean-to on storey {number} would leave its outer wall only {} m high, so a gable is built",
            short(left)
        ),
    )
    .help("make the storey higher or the strip shallower, or give the strip a roof line of its own")
}

/// A pent roof away from every wall.
#[cold]
pub fn pent_in_the_air(line: Span) -> Diagnostic {
    Diagnostic::warning(512, line, "this pent roof (HIS) touches no wall to hang on").help(
        "let one side of its rectangle lie on a wall line: b from 0 to -1 along the first line",
    )
}

/// A pent roof above the wall it hangs on.
#[cold]
pub fn pent_too_high(height: Span, upper: f64, top: f64, fitting: f64) -> Diagnostic {
    Diagnostic::warning(
        513,
        height,
        format!(
            "the upper edge of this pent roof lies at {} shaku, above the walls, which end at {}",
            short(upper),
            short(top)
        ),
    )
    .help(format!(
        "the height is that of the low edge; {} or less fits this wall, depth and pitch",
        short((fitting * 100.0).floor() / 100.0)
    ))
}

/// A pent roof over the rooms.
#[cold]
pub fn pent_over_rooms(place: Span) -> Diagnostic {
    Diagnostic::warning(517, place, "this pent roof (HIS) lies over the rooms instead of outside the walls")
        .help("its rectangle is the strip outside the wall: along a front of 6 units, `0 0 6 -1`; units, not shaku")
}

/// A pent roof that slopes towards its wall, or along it.
#[cold]
pub fn pent_falls_wrong(direction: Span) -> Diagnostic {
    Diagnostic::warning(518, direction, "this pent roof (HIS) does not fall away from the wall it hangs on")
        .help("F falls to the front, B to the back, L to the left, R to the right; `*` leaves it to the wall")
}

/// A fall for a two-sided roof, or a ridge for a single slope.
#[cold]
pub fn odd_direction(direction: Span, shape: &str, one_sided: bool) -> Diagnostic {
    let (message, help) = match one_sided {
        true => (
            "has one slope and no ridge to turn",
            "write the side it falls to: F, B, L or R",
        ),
        false => (
            "has a ridge and falls to both sides",
            "write X (ridge parallel to the first line) or Y",
        ),
    };
    Diagnostic::warning(514, direction, format!("{} {message}", shape)).help(help)
}

/// A sloped roof wished for a plan that has no rectangles.
#[cold]
pub fn flat_only(span: Span, shape: &str) -> Diagnostic {
    Diagnostic::note(
        515,
        span,
        format!(
            "{} is built flat by this version where walls are not at right angles",
            shape
        ),
    )
    .help("write RIK if a flat roof is meant, or give roof lines for rectangles")
}

/// A roof line inside the storey above.
#[cold]
pub fn under_storey(line: Span, storey: u32, upper: Span) -> Diagnostic {
    Diagnostic::warning(
        516,
        line,
        format!(
            "this roof lies wholly inside storey {}: nothing of it is built",
            storey + 1
        ),
    )
    .help("give it the height of the topmost storey there, or `*`")
    .label(upper, "this storey stands there")
}

/// More roof lines than anybody means.
#[cold]
pub fn too_many_lines(first: Span, count: usize, limit: usize) -> Diagnostic {
    let message =
        format!("the house has {count} roof lines; those after the first {limit} are left out");
    Diagnostic::warning(906, first, message)
        .help("make one roof of what lies side by side, or several houses")
}

/// Roofs piled into each other.
#[cold]
pub fn too_many_meet(place: Span, storey: u32) -> Diagnostic {
    let message = format!(
        "so many roofs of storey {storey} stand in each other's way that no valleys are made between them"
    );
    Diagnostic::warning(906, place, message).help(
        "write one roof line for each rectangle, beside each other rather than one in another",
    )
}

/// A plan of very many corners.
#[cold]
pub fn too_many_corners(storey: Span, number: u32, corners: usize, limit: usize) -> Diagnostic {
    let message = format!(
        "storey {number} has {corners} corners to be roofed, more than {limit}: it gets a flat roof"
    );
    Diagnostic::warning(906, storey, message)
        .help("divide the house into several, or give it fewer corners")
}

/// The search for the best cuts of a run is used up.
#[cold]
pub fn too_much_search(storey: Span, number: u32) -> Diagnostic {
    let message = format!(
        "the best cuts of storey {number} would take longer than is left to search: its roofs, and those of plans like it from here on, are divided by a quicker rule"
    );
    Diagnostic::warning(906, storey, message)
        .help("give the plans fewer corners, write their roofs, or compile fewer of them at once")
}

/// A storey, the one above and the roof lines cut each other into too many fields.
#[cold]
pub fn too_intricate(storey: Span, number: u32) -> Diagnostic {
    let message = format!(
        "what is open of storey {number} falls into too many pieces: it gets no automatic roof"
    );
    Diagnostic::warning(906, storey, message).help(
        "let the walls of the storey above, and the roof lines, stand over walls of this storey",
    )
}
