//! Houses: settings, storeys, loops and rows.

use crate::parse::schema;
use crate::parse::schema::vocabulary::{STOREY_KINDS, TURNS};
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::edits;
use crate::parse::xml::read::pieces::WallItems;
use crate::parse::xml::read::{AllowedChild, Attributes, ReadSoFar, Reader};
use crate::parse::xml::suggest::narrow_ascii;
use crate::parse::xml::tree::Element;
use crate::parse::xml::tree::chars::is_blank;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{Edit, Era, House, Loop, Purpose, Row, Settings, Storey, StoreyKind};
use hsd_ir::messages::xml as say;
use std::ops::RangeInclusive;

/// Heights of storeys that are plausible in metres and not in shaku.
const METRES: RangeInclusive<f64> = 2.1..=4.0;

impl<'t> Reader<'t, '_> {
    /// Reads a house.
    pub(in crate::parse::xml) fn house(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> House {
        self.again = ReadSoFar::default();
        let of = self.attributes(schema, element);
        let settings = self.settings(&of);
        self.unit = settings.unit.map_or(of.usual("unit"), |unit| unit.value);
        let mut house = House {
            span: self.whole(element),
            name: self.text(&of, "name"),
            settings: settings.into(),
            ..House::default()
        };
        let mut roofs: Option<Span> = None;
        for node in self.children(element, schema.content()) {
            let AllowedChild::Element(schema, child) = node else {
                continue;
            };
            match schema.tag {
                Tag::Structure => {
                    let (structure, textures) = self.structure(schema, child);
                    house.structures.push(structure);
                    house.textures.extend(textures);
                }
                Tag::Outline => self.only_outline(schema, child, &of, &mut house),
                Tag::PartDef => house.parts.extend(self.written_part(schema, child)),
                Tag::Texture => house.textures.extend(self.texture(schema, child)),
                Tag::Roofs => {
                    let read = self.roofs(schema, child);
                    if let Some(first) = roofs {
                        let fixes = edits::of_two(self.reporter, self.tree, first, child);
                        self.reporter.at(&child.name_range, |s| {
                            say::second_of(s, schema.name, element.name, first, fixes)
                        });
                        house.roofs.lines.extend(read.lines);
                    } else {
                        house.roofs = read.into();
                        roofs = Some(self.reporter.span(&child.name_range));
                    }
                }
                Tag::Pagoda | Tag::Gate | Tag::Hall | Tag::Shrine => {
                    self.monument(schema, child, &mut house);
                }
                _ if self.fitting(schema, child, &mut house) => {}
                _ => {
                    let item = self.item(schema, child, &schema::STOREYS, Self::storey);
                    house.storeys.extend(item);
                }
            }
        }
        house.storeys.shrink_to_fit();
        house
    }

    fn settings(&mut self, of: &Attributes<'t>) -> Settings {
        Settings {
            x: self.number(of, "x"),
            y: self.number(of, "y"),
            anchor: None,
            z: self.number(of, "z"),
            plinth: self.number(of, "plinth"),
            azimuth: self.number(of, "azimuth"),
            unit: self.number(of, "unit"),
            seed: self.whole_number(of, "seed"),
            street: self.yes_no(of, "street"),
            purpose: self.choice(of, "use", &Purpose::ALL),
            age: self.age(of),
            era: self.era(of),
        }
    }

    /// Reads the years since a house was built.
    pub(in crate::parse::xml) fn age(&mut self, of: &Attributes<'t>) -> Option<Spanned<f64>> {
        self.number(of, "age")
    }

    /// Reads the era of construction of a house.
    pub(in crate::parse::xml) fn era(&mut self, of: &Attributes<'t>) -> Option<Spanned<Era>> {
        self.choice(of, "era", &Era::WORDS)
    }

    /// Reads a structure that is a house by itself.
    pub(in crate::parse::xml) fn lone_structure(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> House {
        let (structure, textures) = self.structure(schema, element);
        House {
            span: self.whole(element),
            structures: vec![structure],
            textures,
            ..House::default()
        }
    }

    /// Reports a height without a unit that is surely meant in metres.
    fn in_metres(&mut self, of: &Attributes<'t>, storey: &Storey) {
        let bare = |text: &str| text.trim_matches(is_blank).parse::<f64>().is_ok();
        // What is computed has a name that says what it is.
        let written = of
            .get("height")
            .is_some_and(|a| bare(a.value.as_str()) && bare(self.reporter.quote(&a.value.whole())));
        let height = storey.height.as_ref();
        let height = height.filter(|_| written && storey.kind == StoreyKind::Storey);
        if let Some(height) = height.filter(|h| METRES.contains(&h.value)) {
            let (span, value) = (height.span, height.value);
            self.reporter.push(|| say::height_in_metres(span, value));
        }
    }

    fn storey(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Storey {
        let of = self.attributes(schema, element);
        let kind = self.choice(&of, "kind", &STOREY_KINDS);
        let mut storey = Storey {
            span: self.whole(element),
            height: self.number(&of, "height"),
            start: self.point(&of, "start"),
            kind: kind.map_or(StoreyKind::Storey, |k| k.value),
            ..Storey::default()
        };
        self.in_metres(&of, &storey);
        // Rows directly in the storey form its first loop.
        let mut own = Loop {
            span: storey.span,
            ..Loop::default()
        };
        for node in self.children(element, schema.content()) {
            let AllowedChild::Element(schema, child) = node else {
                continue;
            };
            match schema.tag {
                Tag::Loop => storey.loops.push(self.walk(schema, child)),
                Tag::Fixture => storey.fixtures.extend(self.fixture(schema, child)),
                Tag::Room => storey.rooms.extend(self.room(schema, child)),
                Tag::Walls => self.only_walls(schema, child, element, &mut storey),
                Tag::Random => {
                    let edit = self.random(schema, child).map(Edit::Random);
                    storey.edits.extend(edit);
                }
                Tag::Replace => {
                    let edit = self.replace(schema, child).map(Edit::Replace);
                    storey.edits.extend(edit);
                }
                _ if self.order(schema, child, &mut storey.order) => {}
                _ => {
                    let item = self.item(schema, child, &schema::ROWS, Self::row);
                    own.rows.extend(item);
                }
            }
        }
        if !own.rows.is_empty() {
            own.rows.shrink_to_fit();
            storey.loops.insert(0, own);
        }
        storey.loops.shrink_to_fit();
        storey
    }

    fn walk(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Loop {
        let of = self.attributes(schema, element);
        let (hole, inner) = (self.yes_no(&of, "hole"), self.yes_no(&of, "inner"));
        Loop {
            span: self.whole(element),
            hole: hole.is_some_and(|h| h.value),
            inner: inner.is_some_and(|i| i.value),
            start: self.point(&of, "start"),
            rows: self.items(element, schema.content(), Self::row),
        }
    }

    fn row(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Row {
        let of = self.attributes(schema, element);
        let given = of.get("turn").is_some_and(|t| {
            let text = t.value.as_str().trim_matches(is_blank);
            let letter = text.chars().next().map(|c| narrow_ascii(c).unwrap_or(c));
            letter.is_some_and(char::is_alphabetic)
        });
        let written: Option<Spanned<f64>> = if given {
            self.choice(&of, "turn", &TURNS)
        } else {
            self.number(&of, "turn")
        };
        self.turn = (!element.has_attribute("turn")).then_some(element.name_range.end);
        let WallItems { pieces, turn } = self.line(element, schema.content(), true);
        Row {
            span: self.whole(element),
            pieces,
            turn: written.or(turn),
        }
    }
}
