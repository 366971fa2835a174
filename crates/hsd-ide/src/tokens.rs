//! Semantic tokens: the kind of each word of a source file.
//!
//! | file | reads |
//! |---|---|
//! | `legacy` | lines of the legacy form |
//! | `xml` | elements, attributes, codes |
//! | `braces` | expressions |

mod braces;
mod legacy;
mod xml;

use super::Analysis;
use hsd_ir::ast::CodeText;
use hsd_ir::catalog::Catalog;
use hsd_syntax::parse;
use std::collections::BTreeSet;
use std::ops::Range;

/// The kind of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TokenKind {
    /// A comment.
    Comment,
    /// A word of the language: a setting of the legacy form, a covering, a shape; `and`, `yes` in expressions.
    Keyword,
    /// The name of an element (LSP `type`).
    Element,
    /// The name of an attribute (LSP `property`).
    Attribute,
    /// A string value.
    String,
    /// A number.
    Number,
    /// The code of a part (LSP `enumMember`).
    Code,
    /// A parameter of a definition.
    Parameter,
    /// A name in an expression, of a `let` or a `Param` (LSP `variable`).
    Variable,
    /// A definition, or a function of an expression (LSP `function`).
    Function,
    /// A turn, the end of a storey or a house, an operator in an expression.
    Operator,
}

/// Modifiers of a token.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    /// It declares a name.
    pub declaration: bool,
    /// It is built in.
    pub default_library: bool,
    /// It is a custom part.
    pub own: bool,
    /// Unknown.
    pub unknown: bool,
}

/// A token; it lies on one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// Its range.
    pub range: Range<usize>,
    /// The kind.
    pub kind: TokenKind,
    /// Its modifiers.
    pub modifiers: Modifiers,
}

/// Returns the tokens of a source file in order, without overlaps.
pub fn tokens(a: &Analysis) -> Vec<Token> {
    let mut list = List::new(a);
    for comment in &a.outline().comments {
        list.add(comment.clone(), TokenKind::Comment);
    }
    legacy::tokens(a.outline(), &mut list);
    xml::tokens(a.outline(), &mut list);
    list.finish()
}

/// The tokens collected so far.
struct List<'a> {
    text: &'a str,
    builtin: &'static Catalog,
    /// The codes of custom parts, and the names of images that are shown.
    own: BTreeSet<&'a str>,
    found: Vec<Token>,
}

impl<'a> List<'a> {
    fn new(a: &'a Analysis) -> List<'a> {
        let builtin = parse::builtin();
        let own = a.catalog().parts().iter().skip(builtin.parts().len());
        let pictures = a.checked.building.images.iter();
        let own = own.map(|p| p.code().trim());
        List {
            text: a.text(),
            builtin,
            own: own.chain(pictures.map(|p| &*p.name)).collect(),
            found: vec![],
        }
    }

    fn add(&mut self, range: Range<usize>, kind: TokenKind) {
        self.put(range, kind, Modifiers::default());
    }

    fn declare(&mut self, range: Range<usize>, kind: TokenKind) {
        let modifiers = Modifiers {
            declaration: true,
            ..Modifiers::default()
        };
        self.put(range, kind, modifiers);
    }

    fn put(&mut self, range: Range<usize>, kind: TokenKind, modifiers: Modifiers) {
        if !range.is_empty() {
            self.found.push(Token {
                range,
                kind,
                modifiers,
            });
        }
    }

    /// Returns the modifiers of a code; `None` = unknown.
    fn known(&self, code: &str) -> Option<Modifiers> {
        let (own, code) = (self.own.contains(code.trim()), CodeText::new(code.trim()));
        let default_library = !own && self.builtin.find(&code).is_some();
        (own || default_library).then_some(Modifiers {
            own,
            default_library,
            ..Modifiers::default()
        })
    }

    /// Adds a code; padding blanks do not belong to its token.
    fn code(&mut self, range: &Range<usize>) {
        let text = self.text;
        let written = &text[range.clone()];
        let known = self.known(written).unwrap_or(Modifiers {
            unknown: true,
            ..Modifiers::default()
        });
        let end = range.start + written.trim_end().len();
        self.put(range.start..end, TokenKind::Code, known);
    }

    /// Returns the tokens in order; those of several lines are divided, and of two that overlap the first one counts.
    fn finish(self) -> Vec<Token> {
        let (text, mut found) = (self.text, self.found);
        found.sort_by_key(|t| (t.range.start, std::cmp::Reverse(t.range.end)));
        let mut made: Vec<Token> = Vec::with_capacity(found.len());
        let mut end = 0;
        for token in found {
            if token.range.start < end {
                continue;
            }
            end = token.range.end;
            let written = &text[token.range.clone()];
            if !written.contains(['\n', '\r']) {
                made.push(token);
                continue;
            }
            let mut at = token.range.start;
            for line in written.split(['\n', '\r']) {
                let start = at + line.len() - line.trim_start().len();
                let range = start..start + line.trim().len();
                at += line.len() + 1;
                if !range.is_empty() {
                    made.push(Token {
                        range,
                        ..token.clone()
                    });
                }
            }
        }
        made
    }
}
