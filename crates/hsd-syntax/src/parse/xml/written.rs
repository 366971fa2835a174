//! Writes an element as it is after the language has been computed: no names, no expressions.

use super::tree::{Child, Element, Tree};
use std::fmt::Write;

/// Writes an element with its content.
pub(super) fn written(tree: &Tree<'_>, element: &Element<'_>, to: &mut String) {
    let _ = write!(to, "<{}", element.name);
    for attribute in element.attributes.iter().filter(|a| !a.is_foreign()) {
        let _ = write!(
            to,
            " {}=\"{}\"",
            attribute.name,
            escaped(attribute.value.as_str())
        );
    }
    to.push('>');
    for child in &element.children {
        match child {
            Child::Element(index) => written(tree, &tree.elements[*index], to),
            Child::Text(text) => to.push_str(&escaped(text.as_str())),
        }
    }
    let _ = write!(to, "</{}>", element.name);
}

/// Returns a text as XML writes it.
pub fn escaped(text: &str) -> String {
    let mut written = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => written.push_str("&amp;"),
            '<' => written.push_str("&lt;"),
            '"' => written.push_str("&quot;"),
            c => written.push(c),
        }
    }
    written
}
