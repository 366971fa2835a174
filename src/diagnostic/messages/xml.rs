//! Messages about the XML form (HSD02xx): its markup here, its elements in [`elements`].

mod elements;

pub use elements::*;

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// The author's words, shortened so that a file without line breaks does not fill the message.
fn quote(text: &str) -> String {
    let mut chars = text.chars();
    let head: String = chars.by_ref().take(40).collect();
    let end = if chars.next().is_some() { "…" } else { "" };
    format!("`{}{end}`", head.replace(['\n', '\r', '\t'], " "))
}

/// Elements nest deeper than the limit.
#[cold]
pub fn nested_too_deep(span: Span, limit: usize) -> Diagnostic {
    Diagnostic::error(
        902,
        span,
        format!("elements nest deeper than {limit}; this one is left out"),
    )
    .help("use fewer elements inside one another, or raise the limit for nesting")
}

/// `<Row` without `>`.
#[cold]
pub fn tag_not_closed(span: Span, name: &str, slash: bool) -> Diagnostic {
    let end = if slash { "`/>` or `>`" } else { "`>`" };
    let tag = quote(name);
    Diagnostic::error(201, span, format!("the tag of {tag} is not closed by `>`"))
        .help(format!("write {end} behind the last attribute"))
}

/// A value without its second quote.
#[cold]
pub fn quote_not_closed(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    Diagnostic::error(
        202,
        span,
        format!("the value of {name} has no closing quote"),
    )
    .help("close it with the same quote that opens it")
}

/// A comment, text section or processing instruction without its end.
#[cold]
pub fn not_ended(span: Span, what: &str, end: &str) -> Diagnostic {
    Diagnostic::error(203, span, format!("the {what} has no end")).help(format!(
        "write `{end}` where it ends; reading goes on at the next line that begins with `<`"
    ))
}

/// An element without its end tag; `before` = the tag before which it should stand, and that tag's name.
#[cold]
pub fn not_closed(span: Span, name: &str, before: Option<(Span, &str)>) -> Diagnostic {
    let name = quote(name).replace('`', "");
    let text = format!("`{name}` has no end tag");
    let found = Diagnostic::error(204, span, text);
    match before {
        Some((place, tag)) => found
            .help(format!("write `</{name}>` before this tag"))
            .label(place, format!("this tag of {} comes first", quote(tag))),
        None => found.help(format!(
            "write `</{name}>`, at the end of the file at the latest"
        )),
    }
}

/// `</Rwo>` for `</Row>`.
#[cold]
pub fn end_differs(span: Span, name: &str, open: &str, start: Span) -> Diagnostic {
    let (name, open) = (quote(name).replace('`', ""), quote(open).replace('`', ""));
    let text = format!("the end tag `</{name}>` does not match `<{open}>`");
    Diagnostic::error(205, span, text)
        .help(format!("write `</{open}>`"))
        .label(start, format!("`{open}` begins here"))
}

/// `<Row>` for `</Row>`.
#[cold]
pub fn slash_forgotten(span: Span, name: &str, start: Span) -> Diagnostic {
    let name = quote(name).replace('`', "");
    Diagnostic::error(241, span, format!("`<{name}>` should be `</{name}>`"))
        .help(format!("write the slash: `</{name}>`"))
        .label(start, format!("this `{name}` is still open"))
}

/// An end tag that closes nothing; `inside` = the element it stands in.
#[cold]
pub fn stray_end(span: Span, name: &str, inside: Option<(&str, Span)>) -> Diagnostic {
    let name = quote(name).replace('`', "");
    let found = Diagnostic::error(206, span, format!("`</{name}>` closes nothing")).help(format!(
        "remove it, or write `<{name}>` where it should begin"
    ));
    match inside {
        Some((open, place)) => {
            found.label(place, format!("the open element here is {}", quote(open)))
        }
        None => found,
    }
}

/// A second outermost element.
#[cold]
pub fn second_root(span: Span, name: &str, first: Span) -> Diagnostic {
    let text = format!(
        "{} stands behind the end of the outermost element",
        quote(name)
    );
    Diagnostic::error(207, span, text)
        .help("put several houses into one `<Houses>`")
        .label(first, "the outermost element is this one")
}

/// Text before or behind the outermost element.
#[cold]
pub fn text_outside(span: Span) -> Diagnostic {
    Diagnostic::error(208, span, "text stands outside the outermost element")
        .help("remove it, or make it a comment: `<!-- ... -->`")
}

/// The same attribute twice.
#[cold]
pub fn attribute_twice(span: Span, name: &str, first: &str, before: Span) -> Diagnostic {
    let text = if name == first {
        format!("{} is given twice", quote(name))
    } else {
        format!("`{name}` and `{first}` are the same attribute")
    };
    Diagnostic::error(210, span, text)
        .help("remove one of them; the first one is read")
        .label(before, "the first is here")
}

/// `turn=L`.
#[cold]
pub fn value_not_quoted(span: Span, name: &str, value: &str) -> Diagnostic {
    let (name, value) = (quote(name), quote(value));
    let (plain, inner) = (name.replace('`', ""), value.replace('`', ""));
    Diagnostic::error(211, span, format!("the value of {name} has no quotes"))
        .help(format!("write `{plain}=\"{inner}\"`"))
}

/// `name=「裏長屋」`.
#[cold]
pub fn value_in_brackets(span: Span, name: &str, value: &str) -> Diagnostic {
    let (name, inner) = (quote(name), quote(value).replace('`', ""));
    let plain = name.replace('`', "");
    let text = format!("the value of {name} stands in brackets, not in quotes");
    Diagnostic::error(211, span, text).help(format!(
        "replace the brackets by quotes: `{plain}=\"{inner}\"`"
    ))
}

/// `<Loop hole>`.
#[cold]
pub fn value_missing(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let plain = name.replace('`', "");
    Diagnostic::error(212, span, format!("{name} has no value"))
        .help(format!("write `{plain}=\"...\"`, or remove it"))
}

/// `<Row turn "L">`.
#[cold]
pub fn equals_missing(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    Diagnostic::error(
        212,
        span,
        format!("`=` is missing between {name} and its value"),
    )
    .help("write `=` between the name and the quote")
}

/// `<1st>`.
#[cold]
pub fn bad_name(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error(213, span, format!("{} is no name in XML", quote(name)))
        .help("names begin with a letter or `_` and go on with letters, digits, `_`, `-` and `.`")
}

/// `<>`.
#[cold]
pub fn nameless_tag(span: Span) -> Diagnostic {
    Diagnostic::error(213, span, "the tag has no name")
        .help("write the element's name between `<` and `>`")
}

/// `name="a<b"`.
#[cold]
pub fn less_than_in_value(span: Span) -> Diagnostic {
    Diagnostic::error(214, span, "`<` stands in the value of an attribute")
        .help("write `&lt;`; or is the closing quote missing before it?")
}

/// `a < b` in text.
#[cold]
pub fn bare_less_than(span: Span) -> Diagnostic {
    Diagnostic::error(214, span, "`<` begins no tag").help("write `&lt;` for the character `<`")
}

/// `]]>` in text.
#[cold]
pub fn stray_cdata_end(span: Span) -> Diagnostic {
    Diagnostic::error(214, span, "`]]>` ends no text section").help("remove it")
}

/// `&` that begins no reference.
#[cold]
pub fn bare_ampersand(span: Span) -> Diagnostic {
    Diagnostic::error(215, span, "`&` stands alone").help("write `&amp;` for the character `&`")
}

/// `&nbsp;` or `&#0;`.
#[cold]
pub fn unknown_entity(span: Span, reference: &str) -> Diagnostic {
    let text = format!("{} stands for no character", quote(reference));
    Diagnostic::error(216, span, text).help(
        "write the character itself; only `&lt;` `&gt;` `&amp;` `&quot;` `&apos;` and numbers such as `&#23478;` are read",
    )
}

/// A document type or another declaration.
#[cold]
pub fn document_type(span: Span) -> Diagnostic {
    Diagnostic::error(
        217,
        span,
        "declarations such as a document type are refused",
    )
    .help("remove it: a house needs no document type and no entities")
}

/// `＝` in a tag.
#[cold]
pub fn full_width_markup(span: Span, wide: char, narrow: char) -> Diagnostic {
    Diagnostic::error(
        218,
        span,
        format!("`{wide}` stands in a tag in place of `{narrow}`"),
    )
    .help(format!("replace it by `{narrow}` (half width, straight)"))
}

/// U+3000 in a tag.
#[cold]
pub fn full_width_blank(span: Span) -> Diagnostic {
    Diagnostic::error(218, span, "a full-width blank stands in a tag")
        .help("replace it by a plain blank")
}

/// A quote, `=` or `/` that belongs to no attribute.
#[cold]
pub fn stray_in_tag(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error(
        219,
        span,
        format!("{} belongs to no attribute", quote(what)),
    )
    .help("remove it, or write an attribute as `name=\"value\"`")
}

/// `</Row turn="L">`.
#[cold]
pub fn junk_in_end_tag(span: Span) -> Diagnostic {
    Diagnostic::error(219, span, "an end tag holds nothing but the name")
        .help("move it into the start tag")
}

/// `< Row>`.
#[cold]
pub fn blank_before_name(span: Span) -> Diagnostic {
    Diagnostic::error(219, span, "a blank stands before the name of the element")
        .help("remove the blank")
}

/// `/ >`.
#[cold]
pub fn blank_before_closing(span: Span) -> Diagnostic {
    Diagnostic::error(219, span, "a blank stands between `/` and `>`").help("write `/>`")
}

/// `a="1"b="2"`.
#[cold]
pub fn no_blank_between(span: Span) -> Diagnostic {
    Diagnostic::error(219, span, "no blank stands between two attributes").help("put a blank here")
}

/// `--` in a comment.
#[cold]
pub fn dashes_in_comment(span: Span) -> Diagnostic {
    Diagnostic::warning(236, span, "`--` stands in a comment")
        .help("use another character: other XML programs refuse the whole file for it")
}

/// `<!--` in a comment.
#[cold]
pub fn comment_in_comment(span: Span, open: Span) -> Diagnostic {
    Diagnostic::warning(236, span, "a comment begins inside a comment")
        .help("write `-->` where the first comment ends: everything between the two is not read")
        .label(open, "the first comment begins here")
}

/// A file of comments only.
#[cold]
pub fn no_element(span: Span) -> Diagnostic {
    Diagnostic::error(220, span, "the file holds no element").help("write `<House>...</House>`")
}
