//! The items of a wall line: parts, codes, and the operations on them.

use crate::parse::schema;
use crate::parse::schema::{Content, Schema, Tag};
use crate::parse::xml::edits;
use crate::parse::xml::read::{AllowedChild, Attributes, Reader};
use crate::parse::xml::tree::Element;
use crate::parse::xml::tree::chars::is_blank;
use hsd_base::source::Spanned;
use hsd_ir::ast::{CodeText, Half, Item, Part, Piece, Random, Repeat, Replace, Split};
use hsd_ir::messages::xml as say;

/// The content of a wall line.
#[derive(Default)]
pub(in crate::parse::xml) struct WallItems {
    pub(in crate::parse::xml) pieces: Vec<Item<Piece>>,
    /// The turn of a control letter.
    pub(in crate::parse::xml) turn: Option<Spanned<f64>>,
}

impl<'t> Reader<'t, '_> {
    /// Reads the pieces of a row, a floor or a half; `turns` = the row has a `turn`.
    pub(in crate::parse::xml) fn line(
        &mut self,
        element: &'t Element<'t>,
        content: &'static Content,
        turns: bool,
    ) -> WallItems {
        let mut line = WallItems::default();
        for node in self.children(element, content) {
            match node {
                AllowedChild::Text(text) => {
                    let turn = self.codes(text, turns, &mut line.pieces);
                    line.turn = turn.or(line.turn);
                }
                AllowedChild::Element(schema, child) if schema.tag == Tag::Row => {
                    let of = self.attributes(schema, child);
                    if let Some(turn) = of.get("turn") {
                        let whole = self.reporter.with_gap(&turn.range);
                        self.reporter
                            .at(&turn.name_range, |s| say::turn_in_floor(s, whole));
                    }
                    line.pieces
                        .extend(self.line(child, schema.content(), false).pieces);
                }
                AllowedChild::Element(schema, child) => {
                    line.pieces.extend(self.piece(schema, child, turns));
                }
            }
        }
        line
    }

    /// Reads a piece, or an operation beside it.
    pub(in crate::parse::xml) fn piece(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        turns: bool,
    ) -> Option<Item<Piece>> {
        if let Some(known) = self.again.piece(element) {
            return known;
        }
        let piece = self.piece_anew(schema, element, turns);
        self.again.keep_piece(element, &piece);
        piece
    }

    fn piece_anew(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        turns: bool,
    ) -> Option<Item<Piece>> {
        match schema.tag {
            Tag::Part => Some(Item::One(self.part(schema, element))),
            Tag::Split => {
                let split = self.split(schema, element);
                Some(Item::One(Piece::Split(Box::new(split))))
            }
            Tag::Repeat => {
                let num = self.repeat_num(schema, element);
                let line = self.line(element, schema::FLOOR.repeated(), turns);
                Some(Item::Repeat(Box::new(Repeat {
                    span: self.start(element),
                    num,
                    body: line.pieces,
                })))
            }
            _ => self.operation(schema, element),
        }
    }

    fn part(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Piece {
        let of = self.attributes(schema, element);
        self.no_children(element);
        // A part without a code becomes a void, so that the row keeps its length.
        let code = match self.text(&of, "code") {
            Some(text) => Spanned::new(CodeText::new(&text.value), text.span),
            None => Spanned::new(CodeText::new(""), self.start(element)),
        };
        let width = self.number(&of, "width");
        let height = self.number(&of, "height");
        if width.is_none() && height.is_none() {
            return Piece::new(code.value, code.span);
        }
        Piece::Part(Box::new(Part {
            code,
            width,
            height,
        }))
    }

    fn split(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Split {
        let of = self.attributes(schema, element);
        let ratio = self.number(&of, "ratio");
        let mut halves: [Option<Half>; 2] = [None, None];
        for node in self.children(element, schema.content()) {
            let AllowedChild::Element(schema, child) = node else {
                continue;
            };
            self.attributes(schema, child);
            let half = Half {
                span: self.whole(child),
                pieces: self.line(child, schema.content(), false).pieces,
            };
            let place = &mut halves[usize::from(schema.tag == Tag::Lower)];
            if let Some(first) = place {
                let before = first.span;
                let fixes = edits::of_two(self.reporter, self.tree, before, child);
                self.reporter.at(&child.name_range, |s| {
                    say::second_of(s, schema.name, element.name, before, fixes)
                });
            } else {
                *place = Some(half);
            }
        }
        for (half, name) in halves.iter().zip(["upper", "lower"]) {
            if half.is_none() && !element.cut {
                self.reporter.at(&element.name_range, |s| {
                    say::child_missing(s, element.name, name)
                });
            }
        }
        let span = self.start(element);
        let nothing = || Half {
            span,
            pieces: vec![],
        };
        let [upper, lower] = halves.map(|h| h.unwrap_or_else(nothing));
        Split {
            span,
            ratio,
            upper,
            lower,
        }
    }

    /// Returns the number of a `repeat`; 1 if it is invalid.
    pub(in crate::parse::xml) fn repeat_num(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Spanned<u32> {
        let of = self.attributes(schema, element);
        let num = self.whole_number(&of, "num");
        if num.is_some() && element.children.is_empty() && !element.cut {
            self.reporter.at(&element.range, say::repeats_nothing);
        }
        num.map_or(Spanned::new(1, self.start(element)), |n| {
            Spanned::new(u32::try_from(n.value).unwrap_or(u32::MAX), n.span)
        })
    }

    /// Reads a `repeat` whose content is read by `each`.
    pub(in crate::parse::xml) fn repeat<T>(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        content: &'static Content,
        each: fn(&mut Self, &'static Schema, &'t Element<'t>) -> T,
    ) -> Repeat<T> {
        let num = self.repeat_num(schema, element);
        Repeat {
            span: self.start(element),
            num,
            body: self.items(element, content, each),
        }
    }

    /// Reads items of a kind, and the operations among them.
    pub(in crate::parse::xml) fn items<T>(
        &mut self,
        element: &'t Element<'t>,
        content: &'static Content,
        each: fn(&mut Self, &'static Schema, &'t Element<'t>) -> T,
    ) -> Vec<Item<T>> {
        let mut items = vec![];
        for node in self.children(element, content) {
            if let AllowedChild::Element(schema, child) = node {
                items.extend(self.item(schema, child, content, each));
            }
        }
        items
    }

    /// Reads an item, or an operation beside it.
    pub(in crate::parse::xml) fn item<T>(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        content: &'static Content,
        each: fn(&mut Self, &'static Schema, &'t Element<'t>) -> T,
    ) -> Option<Item<T>> {
        match schema.tag {
            Tag::Repeat => {
                let repeat = self.repeat(schema, element, content, each);
                Some(Item::Repeat(Box::new(repeat)))
            }
            Tag::Random | Tag::Replace => self.operation(schema, element),
            _ => Some(Item::One(each(self, schema, element))),
        }
    }

    fn operation<T>(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<Item<T>> {
        if schema.tag == Tag::Random {
            let random = self.random(schema, element);
            random.map(|r| Item::Random(Box::new(r)))
        } else {
            let replace = self.replace(schema, element);
            replace.map(|r| Item::Replace(Box::new(r)))
        }
    }

    /// Reads a `random`; nothing if it has no codes.
    pub(in crate::parse::xml) fn random(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<Random> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        Some(Random {
            span: self.whole(element),
            weights: self.weights(&of),
            codes: self.text(&of, "code")?,
        })
    }

    fn weights(&mut self, of: &Attributes<'t>) -> Option<Spanned<Vec<f64>>> {
        let weights = self.numbers(of, "weights")?;
        if weights.value.iter().any(|w| *w > 0.0) {
            return Some(weights);
        }
        let (span, count) = (weights.span, weights.value.len());
        self.reporter.push(|| say::no_weight(span, Some(count)));
        None
    }

    /// Reads a `replace`; nothing if it has no replacement.
    pub(in crate::parse::xml) fn replace(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Option<Replace> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let attribute_schema = |name: &str| of.element.attributes.iter().any(|a| a.name == name);
        if !["code", "texturecode", "at"]
            .into_iter()
            .any(attribute_schema)
        {
            self.reporter.at(&element.name_range, say::replaces_nothing);
        }
        let at = self.positions(&of, "at");
        let codes = self.text(&of, "code");
        let with = self.text(&of, "with")?;
        let given = codes.is_some() || at.is_some();
        debug_assert!(!with.value.starts_with(is_blank) || with.value == "     ");
        given.then(|| Replace {
            span: self.whole(element),
            codes,
            with,
            at,
        })
    }
}
