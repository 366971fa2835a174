//! The houses of a file, alone and in groups: `Houses`, `Group`, and what a `Place` has become.

use crate::parse::over;
use crate::parse::schema;
use crate::parse::schema::vocabulary::ANCHORS;
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::read::{AllowedChild, Attributes, Reader};
use crate::parse::xml::tree::{Child, Element, MEANT};
use crate::templates::Template;
use hsd_base::geometry::Heading;
use hsd_base::source::Spanned;
use hsd_ir::ast::town::{RuleFacts, Town};
use hsd_ir::ast::{Era, Frame, House, Outline, PlacedBy, Placement, Stand, WrittenPart};
use hsd_ir::messages::xml as say;

/// What the elements around a house say of it.
#[derive(Clone, Copy, Default)]
pub(super) struct Around {
    /// The groups around it together, if there are any.
    frame: Option<Frame>,
    /// The innermost `Place`.
    place: Option<PlacedBy>,
    age: Option<Spanned<f64>>,
    era: Option<Spanned<Era>>,
}

impl<'t> Reader<'t, '_> {
    /// Returns the houses of the file, and the custom parts that all of them know.
    pub(in crate::parse::xml) fn houses(
        &mut self,
        parts: &mut Vec<WrittenPart>,
        (town, facts): (&mut Option<Box<Town>>, RuleFacts),
    ) -> Vec<House> {
        let mut facts = Some(facts);
        let mut houses = vec![];
        for node in self.roots() {
            let AllowedChild::Element(schema, element) = node else {
                continue;
            };
            match schema.tag {
                Tag::House => houses.push(self.house(schema, element)),
                Tag::Structure => houses.push(self.lone_structure(schema, element)),
                Tag::Town => {
                    let facts = facts.take().unwrap_or_default();
                    *town = Some(Box::new(self.town(schema, element, facts)));
                }
                Tag::Catalog => {
                    self.attributes(schema, element);
                    for node in self.children(element, schema.content()) {
                        if let AllowedChild::Element(schema, element) = node {
                            parts.extend(self.written_part(schema, element));
                        }
                    }
                }
                _ => {
                    let of = self.attributes(schema, element);
                    let around = self.aged(Around::default(), &of);
                    self.members(element, schema.content(), around, &mut houses, parts);
                }
            }
        }
        houses
    }

    /// Reads the content of `Houses`, of a group or of a `Place`.
    fn members(
        &mut self,
        element: &'t Element<'t>,
        content: &'static schema::Content,
        around: Around,
        houses: &mut Vec<House>,
        parts: &mut Vec<WrittenPart>,
    ) {
        // What stands outdoors beside the houses is a house without storeys.
        let mut outdoors = House::default();
        for node in self.children(element, content) {
            let AllowedChild::Element(schema, child) = node else {
                continue;
            };
            match schema.tag {
                Tag::PartDef => parts.extend(self.written_part(schema, child)),
                Tag::House => {
                    let house = self.house(schema, child);
                    houses.push(around.put(house));
                }
                Tag::Group => {
                    let of = self.attributes(schema, child);
                    let mut inner = self.aged(around, &of);
                    let turn = self.usual(&of, "turn");
                    inner.enter(Frame {
                        origin: self.origin(&of),
                        turn,
                    });
                    self.members(child, schema.content(), inner, houses, parts);
                }
                Tag::Place => self.placed(schema, child, around, houses),
                // Those of a file that is placed are views of that file.
                Tag::View if around.place.is_some() => {}
                // That of a house that is placed has been read with its place.
                Tag::Outline => {}
                Tag::View => self.view(schema, child, around.frame),
                Tag::Put | Tag::Ground => {
                    if !outdoors.stands_outdoors() {
                        outdoors.span = self.whole(child);
                    }
                    self.fitting(schema, child, &mut outdoors);
                }
                // Repetitions and choices are written out already; what is left draws codes.
                _ => {
                    let home = "`Storey`, `Row`, `Facade` or `Floor`";
                    self.reporter.at(&child.name_range, |s| {
                        say::wrong_place(s, child.name, Some(element.name), home)
                    });
                }
            }
        }
        if outdoors.stands_outdoors() {
            houses.push(around.put(outdoors));
        }
    }

    /// Reads the houses that a `Place` has become. A lone one stands at the place, whatever its own says; several keep
    /// their places to each other.
    pub(super) fn placed(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        around: Around,
        houses: &mut Vec<House>,
    ) {
        let of = self.attributes(schema, element);
        let mut inner = self.aged(around, &of);
        let anchor = self.choice(&of, "at", &ANCHORS);
        let azimuth = self.usual(&of, "azimuth");
        let plinth = self.number(&of, "plinth").filter(|p| p.value > 0.0);
        let written = element.children.first().and_then(|child| match child {
            Child::Element(index) => Some(self.tree.elements[*index].range.start),
            Child::Text(_) => None,
        });
        let source = written.map(|at| self.reporter.source_at(at).1);
        let source = source.filter(|source| Template::is_source(source.name()));
        let span = self.start(element);
        inner.place = Some(PlacedBy {
            span,
            library: source.is_some(),
        });
        let before = source.map(|source| self.reporter.instead(Some((source.id(), span))));
        inner.enter(Frame {
            origin: self.origin(&of),
            turn: azimuth - 180.0,
        });
        let (mut own, mut parts) = (vec![], vec![]);
        // They are put where they stand once their number is known.
        let first = Around {
            frame: None,
            ..inner
        };
        self.members(element, &schema::PLACED, first, &mut own, &mut parts);
        if let Some(before) = before {
            self.reporter.instead(before);
        }
        let lone = own.len() == 1;
        if let (Some(anchor), Some(attribute), count @ 2..) = (anchor, of.get("at"), own.len()) {
            let whole = self.reporter.with_gap(&attribute.range);
            self.reporter
                .push(|| say::anchor_of_several(anchor.span, count, whole));
        }
        for mut house in own {
            if lone {
                let settings = &mut house.settings;
                settings.anchor = anchor.map(|a| a.value);
                [settings.x, settings.y, settings.z] = [None; 3];
                settings.azimuth = None;
                if let Some(outline) = &mut house.outline {
                    outline.stand = Stand::Facing;
                }
                self.on_outline_of_place(element, &of, &mut house);
            }
            house.settings.plinth = plinth.or(house.settings.plinth);
            house.parts.extend(parts.iter().cloned());
            houses.push(inner.put(house));
        }
    }

    /// Puts a house on the outline that its `Place` gives to it.
    fn on_outline_of_place(
        &mut self,
        element: &'t Element<'t>,
        of: &Attributes<'t>,
        house: &mut House,
    ) {
        if let Some(outline) = self.outline_of_place(element, of) {
            let meant = element.attributes.iter().find(|a| a.name == MEANT);
            let meant = meant.and_then(|a| a.value.as_str().parse().ok());
            over::stand_on(house, outline, meant);
        }
    }

    /// Reads the outline that a `Place` gives to its house.
    fn outline_of_place(
        &mut self,
        element: &'t Element<'t>,
        of: &Attributes<'t>,
    ) -> Option<Outline> {
        let schema = schema::named("Outline")?;
        let mut children = element.children.iter().filter_map(|child| match child {
            Child::Element(index) => Some(&self.tree.elements[*index]),
            Child::Text(_) => None,
        });
        let child = children.find(|child| child.name == schema.name)?;
        let outline = self.outline(schema, child, of);
        Some(Outline {
            stand: Stand::Surveyed(0.0),
            ..outline
        })
    }

    fn origin(&mut self, of: &Attributes<'t>) -> [f64; 3] {
        ["x", "y", "z"].map(|name| self.usual(of, name))
    }

    /// Returns what the houses in an element inherit.
    fn aged(&mut self, around: Around, of: &Attributes<'t>) -> Around {
        Around {
            age: self.age(of).or(around.age),
            era: self.era(of).or(around.era),
            ..around
        }
    }
}

impl Around {
    /// Returns what a frame alone says.
    pub(super) fn of(frame: Frame) -> Around {
        Around {
            frame: Some(frame),
            ..Around::default()
        }
    }

    /// Enters a frame inside those entered so far.
    fn enter(&mut self, inner: Frame) {
        self.frame = Some(match self.frame {
            Some(outer) => outer.within(inner),
            None => inner,
        });
    }

    /// Returns a house at its place in the world, with the age that it has not said itself.
    pub(super) fn put(self, mut house: House) -> House {
        let span = house.span;
        let settings = &mut house.settings;
        settings.age = settings.age.or(self.age);
        // For a house without an age it would have no effect.
        if settings.age.is_some() {
            settings.era = settings.era.or(self.era);
        }
        let Some(frame) = self.frame else {
            return house;
        };
        let number = |value: Option<Spanned<f64>>, usual| value.map_or(usual, |v| v.value);
        let local = [settings.x, settings.y, settings.z].map(|v| number(v, 0.0));
        let at = |value: f64| Some(Spanned::new(value, span));
        let [x, y, z] = frame.point(local);
        (settings.x, settings.y, settings.z) = (at(x), at(y), at(z));
        let azimuth = number(settings.azimuth, 180.0) + frame.turn;
        settings.azimuth = at(Heading::new(azimuth).degrees());
        if let Some(Stand::Surveyed(turn)) = house.outline.as_mut().map(|o| &mut o.stand) {
            *turn += frame.turn;
        }
        let inner = house.placement.take().map_or(Placement::default(), |p| *p);
        house.placement = Some(Box::new(Placement {
            frame: frame.within(inner.frame),
            place: inner.place.or(self.place),
        }));
        house
    }
}
