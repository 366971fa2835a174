//! Messages about the elements, attributes and codes of the XML form.

use super::quote;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// Words as a list for a help text.
fn list(words: &[&str], last: &str) -> String {
    let quoted: Vec<String> = words.iter().map(|w| format!("`{w}`")).collect();
    match quoted.split_last() {
        Some((end, [])) => end.clone(),
        Some((end, rest)) => format!("{} {last} {end}", rest.join(", ")),
        None => "nothing".to_owned(),
    }
}

/// Text in an element that holds elements only.
#[cold]
pub fn text_not_allowed(span: Span, text: &str, parent: &str) -> Diagnostic {
    let (text, parent) = (quote(text), quote(parent));
    Diagnostic::error(
        209,
        span,
        format!("the text {text} has no place in {parent}"),
    )
    .help("codes belong in `Row`, `Floor`, `upper` or `lower`; make it a comment if it is a remark")
}

/// A name that the language does not know.
#[cold]
pub fn unknown_element(
    span: Span,
    name: &str,
    near: Option<&str>,
    parent: Option<&str>,
) -> Diagnostic {
    let found = Diagnostic::error(221, span, format!("{} is no element", quote(name)));
    match (near, parent) {
        (Some(near), _) => found.help(format!("write `{near}`; capitals matter")),
        (None, Some(_)) => found
            .help("remove it; what stands in it is read as if it stood in the element round it"),
        (None, None) => found.help("the outermost element is `House`, `Houses` or `Structure`"),
    }
}

/// A name that the element does not bear.
#[cold]
pub fn unknown_attribute(
    span: Span,
    name: &str,
    element: &str,
    near: Option<&str>,
    known: &[&str],
) -> Diagnostic {
    let text = format!("{} is no attribute of `{element}`", quote(name));
    let found = Diagnostic::error(222, span, text);
    match near {
        Some(near) => found.help(format!("write `{near}`")),
        None => found.help(format!("`{element}` bears {}", list(known, "and"))),
    }
}

/// A known element where it has no meaning.
#[cold]
pub fn wrong_place(span: Span, name: &str, parent: Option<&str>, home: &str) -> Diagnostic {
    let text = match parent {
        Some(parent) => format!("`{name}` has no place in {}", quote(parent)),
        None => format!("`{name}` cannot be the outermost element"),
    };
    Diagnostic::error(223, span, text)
        .help(format!("`{name}` belongs in {home}; it is not read here"))
}

/// `Roof` without a rectangle beside the storeys.
#[cold]
pub fn roof_for_roofs(span: Span) -> Diagnostic {
    let text = "`Roof` has no place in `House`; the element for all roofs of a house is `Roofs`";
    Diagnostic::error(223, span, text).help("write `Roofs`")
}

/// An attribute that must be there.
#[cold]
pub fn attribute_missing(span: Span, element: &str, name: &str) -> Diagnostic {
    Diagnostic::error(
        224,
        span,
        format!("`{element}` needs the attribute `{name}`"),
    )
    .help(format!("write `<{element} {name}=\"...\">`"))
}

/// A value that is no number.
#[cold]
pub fn not_a_number(span: Span, name: &str, text: &str, mend: Option<&str>) -> Diagnostic {
    let found = Diagnostic::error(
        225,
        span,
        format!("{} is no number for {}", quote(text), quote(name)),
    );
    match mend {
        Some(mend) => found.help(format!("write {}", quote(mend))),
        None => found.help("write plain digits with a point, such as `9.5`, without a unit"),
    }
}

/// A number that makes no sense.
#[cold]
pub fn out_of_range(span: Span, name: &str, text: &str, bounds: &str) -> Diagnostic {
    let (name, text) = (quote(name), quote(text));
    Diagnostic::error(226, span, format!("{text} is out of range for {name}"))
        .help(format!("write {bounds}"))
}

/// A word that is none of those asked for.
#[cold]
pub fn not_a_choice(
    span: Span,
    name: &str,
    text: &str,
    all: &[&str],
    near: Option<&str>,
) -> Diagnostic {
    let text = format!("{} is no value of {}", quote(text), quote(name));
    let found = Diagnostic::error(227, span, text);
    match near {
        Some(near) => found.help(format!("write `{near}`")),
        None => found.help(format!("write {}", list(all, "or"))),
    }
}

/// An element of a later version.
#[cold]
pub fn not_yet(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error(
        228,
        span,
        format!("`{name}` is not supported by this version yet"),
    )
    .help("write out what it stands for; it is left out with all that it holds")
}

/// An expression in braces.
#[cold]
pub fn expression_not_yet(span: Span, text: &str) -> Diagnostic {
    let text = format!(
        "the expression {} is not supported by this version yet",
        quote(text)
    );
    Diagnostic::error(229, span, text)
        .help("write the value itself; `{k}` in codes and ids is the only one that is read")
}

/// A split without one of its halves.
#[cold]
pub fn child_missing(span: Span, parent: &str, name: &str) -> Diagnostic {
    Diagnostic::error(230, span, format!("{} has no `{name}`", quote(parent)))
        .help(format!("write `<{name}>...</{name}>` in it"))
}

/// Two of something of which there is one.
#[cold]
pub fn second_of(span: Span, name: &str, parent: &str, before: Span) -> Diagnostic {
    let text = format!("{} has a second `{name}`", quote(parent));
    Diagnostic::error(231, span, text)
        .help("join the two")
        .label(before, "the first is here")
}

/// `L` at the end of a row's text.
#[cold]
pub fn control_letter(span: Span, letter: char, turns: bool) -> Diagnostic {
    let help = match (letter, turns) {
        ('^', _) => {
            "remove it and write the next storey as a `Storey` or `Floor` of its own".into()
        }
        (_, true) => format!("remove it and write `<Row turn=\"{letter}\">`"),
        (_, false) => "remove it: the `angle` of the next `Facade` turns the wall".into(),
    };
    let text =
        format!("the control letter `{letter}` has no meaning in XML; a row turns by `turn`");
    Diagnostic::error(232, span, text).help(help)
}

/// `turn` on the base row of a floor.
#[cold]
pub fn turn_in_floor(span: Span) -> Diagnostic {
    Diagnostic::error(232, span, "`turn` has no meaning in a `Floor`")
        .help("remove it: the `angle` of the next `Facade` turns the wall")
}

/// Characters that no code holds.
#[cold]
pub fn not_a_column(span: Span, text: &str, plain: &str) -> Diagnostic {
    let blank = text.starts_with('\u{3000}');
    let what = if blank {
        "a full-width blank stands among the codes".to_owned()
    } else {
        format!("{} cannot stand in a code of five columns", quote(text))
    };
    let found = Diagnostic::error(233, span, what);
    if blank {
        found.help("replace each full-width blank by two blanks")
    } else if plain.is_empty() {
        found.help("codes are plain ASCII; name an own part by `<Part code=\"...\"/>`")
    } else {
        found.help(format!("replace it by {}", quote(plain)))
    }
}

/// A tab among codes: in which column, from the first code of the line, and how many blanks reach the next code.
#[cold]
pub fn tab_in_codes(span: Span, column: usize, blanks: usize) -> Diagnostic {
    let text = format!("a tab stands among the codes, in column {column} of this line of codes");
    let plural = if blanks == 1 { "" } else { "s" };
    let found = Diagnostic::error(233, span, text);
    found.help(format!(
        "replace it by {blanks} blank{plural}, so that the next code begins in column {}",
        column + blanks
    ))
}

/// A share above 1.
#[cold]
pub fn per_cent(span: Span, given: f64, share: f64) -> Diagnostic {
    let text = format!("the reflection {given} is read as {given} per cent");
    Diagnostic::warning(234, span, text)
        .help(format!("write the share of light from 0 to 1: `{share}`"))
}

/// A bad piece of `at`; `read` = what it is taken for.
#[cold]
pub fn not_a_position(span: Span, text: &str, read: Option<(u32, u32)>) -> Diagnostic {
    let found = Diagnostic::error(235, span, format!("{} is no position", quote(text)));
    match read {
        Some((first, last)) if first < last => found.help(format!("write `{first}-{last}`")),
        Some((first, _)) => found.help(format!("write `{first}`")),
        None => found.help("positions count from 1; write for example `2,5-7`"),
    }
}

/// An empty value.
#[cold]
pub fn value_empty(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error(237, span, format!("the value of {} is empty", quote(name)))
        .help("write a value, or remove the attribute")
}

/// A point that is not two numbers.
#[cold]
pub fn not_a_point(span: Span, name: &str, count: usize) -> Diagnostic {
    let text = format!("{} takes two numbers, not {count}", quote(name));
    Diagnostic::error(238, span, text).help("write units to the left and units back, such as `4 8`")
}

/// Weights that are all nought.
#[cold]
pub fn no_weight(span: Span) -> Diagnostic {
    Diagnostic::error(239, span, "all weights are 0, so nothing can be drawn")
        .help("give at least one code a weight above 0")
}

/// A `replace` that says neither what nor where.
#[cold]
pub fn replaces_nothing(span: Span) -> Diagnostic {
    Diagnostic::error(
        240,
        span,
        "`replace` says neither which code nor which position",
    )
    .help("write `code=\"...\"`, `at=\"...\"` or both")
}

/// A `repeat` without content.
#[cold]
pub fn repeats_nothing(span: Span) -> Diagnostic {
    Diagnostic::warning(242, span, "`repeat` holds nothing to repeat").help(
        "put the parts between `<repeat num=\"...\">` and `</repeat>`; a void is `<Part code=\"     \"/>`",
    )
}

/// The file of a texture, which this version finds by its name.
#[cold]
pub fn src_not_yet(span: Span, file: &str, code: &str) -> Diagnostic {
    let ending = file.rsplit_once('.').map_or("png", |(_, ending)| ending);
    let message = "`src` is not read by this version: a part picture is found by its name";
    Diagnostic::warning(243, span, message).help(format!(
        "name the file `{code}.{ending}` and put it into the folder of this file or its `textures` folder, or take `src` away"
    ))
}
