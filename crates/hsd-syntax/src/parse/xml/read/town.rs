//! A town: its layers, tables and tiles; and the houses that its rules make of a feature.

use crate::messages::town;
use crate::parse::schema;
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::read::houses::Around;
use crate::parse::xml::read::{AllowedChild, Attributes, Reader};
use crate::parse::xml::tree::{Child, Element};
use crate::parse::xml::written::written;
use hsd_base::diagnostic::noun;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::town::{
    Divided, DividedPart, Division, Field, FieldType, Join, Layer, Made, Rule, RuleFacts,
    SiteWalls, Stood, Table, Tiles, Town,
};
use hsd_ir::ast::{Frame, House, Outline, Stand, Value};
use hsd_ir::messages::xml as say;
use std::collections::BTreeMap;

impl<'t> Reader<'t, '_> {
    /// Reads a town.
    pub(in crate::parse::xml) fn town(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        facts: RuleFacts,
    ) -> Town {
        let of = self.attributes(schema, element);
        let origin = self.point(&of, "origin");
        let mut town = Town {
            span: self.start(element),
            name: self.text(&of, "name"),
            crs: self.text(&of, "crs"),
            seed: self.whole_number(&of, "seed").map_or(0, |seed| seed.value),
            origin,
            font: self.text(&of, "font"),
            geoid: self.yes_no(&of, "geoid").is_some_and(|g| g.value),
            fronts: facts.fronts,
            housed: facts.housed,
            roads: facts.roads,
            networks: facts.networks,
            zones: facts.zones,
            waters: facts.waters,
            ..Town::default()
        };
        let mut divides = vec![];
        for node in self.children(element, schema.content()) {
            let AllowedChild::Element(schema, child) = node else {
                continue;
            };
            match schema.tag {
                Tag::Layer => town.layers.extend(self.layer(schema, child)),
                Tag::Divide => divides.push((schema, child)),
                Tag::Table => town.tables.extend(self.table(schema, child)),
                Tag::For => town.rules.extend(self.rule(child)),
                Tag::Tiles => town.tiles = self.tiles(schema, child),
                _ => {}
            }
        }
        for (schema, child) in divides {
            let layers = self.divide(schema, child, &town.layers);
            town.layers.extend(layers);
        }
        self.check_town(&town);
        town
    }

    /// Reads a `Divide`: four layers of the map of another, which may stand behind it.
    fn divide(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        layers: &[Layer],
    ) -> Vec<Layer> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let usual = Division::default();
        let mut length = |name, usual| self.number(&of, name).map_or(usual, |n| n.value);
        let mut division = Division {
            frontage: length("frontage", usual.frontage),
            depth: length("depth", usual.depth),
            street: length("street", usual.street),
            deep: length("deep", usual.deep),
            every: usual.every,
        };
        if let Some(every) = self.point(&of, "every") {
            division.every = every.value.into();
        }
        let Some(from) = self.text(&of, "layer") else {
            return vec![];
        };
        let undivided = |layer: &&Layer| layer.divided.is_none();
        let mut known = layers.iter().filter(undivided);
        let Some(divided) = known.clone().find(|l| l.name.value == from.value) else {
            let known: Vec<String> = known.by_ref().map(|l| l.name.value.clone()).collect();
            let near = self.suggest.among(&from.value, known.iter().map(|n| &**n));
            self.reporter
                .push(|| town::unknown_layer(from.span, &from.value, near, &known));
            return vec![];
        };
        let start = self.start(element);
        let made = DividedPart::WORDS.map(|(word, part)| Layer {
            span: start,
            name: self
                .text(&of, word)
                .unwrap_or_else(|| Spanned::new(word.to_owned(), start)),
            divided: Some(Divided { part, division }),
            joins: vec![],
            ..divided.clone()
        });
        made.into()
    }

    fn layer(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Layer> {
        let of = self.attributes(schema, element);
        let (mut fields, mut joins) = (vec![], vec![]);
        for node in self.children(element, schema.content()) {
            match node {
                AllowedChild::Element(schema, child) if schema.tag == Tag::Join => {
                    joins.extend(self.join(schema, child));
                }
                AllowedChild::Element(schema, child) => fields.extend(self.field(schema, child)),
                AllowedChild::Text(_) => {}
            }
        }
        let (outline, order) = (self.text(&of, "outline"), self.text(&of, "order"));
        if let (None, Some(order)) = (&outline, &order) {
            self.reporter.push(|| town::no_vertices(order.span, true));
        }
        Some(Layer {
            span: self.start(element),
            name: self.text(&of, "name")?,
            src: self.text(&of, "src")?,
            layer: self.text(&of, "layer"),
            encoding: self.text(&of, "encoding"),
            crs: self.text(&of, "crs"),
            key: self.text(&of, "key"),
            outline,
            order,
            filter: self.text(&of, "where"),
            evidence: self.text(&of, "evidence"),
            fields,
            joins,
            divided: None,
        })
    }

    fn join(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Join> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        Some(Join {
            span: self.start(element),
            layer: self.text(&of, "layer")?,
            by: self.text(&of, "by"),
            within: self.number(&of, "within").map_or(0.0, |far| far.value),
        })
    }

    fn field(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Field> {
        let of = self.attributes(schema, element);
        let name = self.text(&of, "name")?;
        let kind = self.choice(&of, "type", &FieldType::WORDS).map(|k| k.value);
        let default = self.text(&of, "default");
        let map = self.text(&of, "map").map_or(String::new(), |map| map.value);
        let pairs = map.split(',').filter_map(|pair| pair.split_once('='));
        let pairs = pairs.map(|(from, to)| (from.trim().to_owned(), to.trim().to_owned()));
        let default = default.and_then(|default| self.default_of(&default, kind));
        Some(Field {
            span: self.start(element),
            from: self.text(&of, "from").unwrap_or_else(|| name.clone()),
            name,
            kind,
            default,
            map: pairs.collect(),
        })
    }

    /// Returns the default of a field, which must be of its type.
    fn default_of(&mut self, text: &Spanned<String>, kind: Option<FieldType>) -> Option<Value> {
        let value = Value::read(&text.value);
        let (fits, wanted) = match kind {
            Some(FieldType::Number) => {
                (matches!(value, Value::Number(_)), noun("a number", "数値"))
            }
            Some(FieldType::Truth) => (
                matches!(value, Value::Truth(_)),
                noun("`yes` or `no`", "`yes` か `no` "),
            ),
            Some(FieldType::Text) => return Some(Value::Text(text.value.clone())),
            None => return Some(value),
        };
        if !fits {
            let wanted = wanted.into();
            self.reporter
                .push(|| town::not_of_type(text.span, &text.value, &wanted));
        }
        fits.then_some(value)
    }

    fn table(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Table> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        Some(Table {
            span: self.start(element),
            name: self.text(&of, "name")?,
            src: self.text(&of, "src")?,
            key: self.text(&of, "key")?,
        })
    }

    /// Reads a `for`, whose other attributes are evaluated at each feature.
    fn rule(&mut self, element: &'t Element<'t>) -> Option<Rule> {
        let schema = schema::named("for")?;
        let of = self.attributes(schema, element);
        Some(Rule {
            span: self.start(element),
            each: self.text(&of, "each")?,
        })
    }

    fn tiles(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Tiles {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let usual = Tiles::default();
        let size = self
            .number(&of, "size")
            .map_or(usual.size, |size| size.value);
        let mut detail = vec![];
        if let Some(levels) = self.text(&of, "detail") {
            let words = levels.value.split([',', ' ']).map(str::trim);
            for word in words.filter(|word| !word.is_empty()) {
                match word.parse::<u8>() {
                    Ok(level @ 0..=3) => detail.push(level),
                    _ => self.reporter.push(|| {
                        let known = ["0", "1", "2", "3"];
                        say::not_a_choice(levels.span, "detail", word, &known, None)
                    }),
                }
            }
            detail.dedup();
        }
        Tiles {
            size,
            by: self.text(&of, "by"),
            detail: if detail.is_empty() {
                usual.detail
            } else {
                detail
            },
        }
    }

    /// Reports names that are given twice, and layers that are not there.
    fn check_town(&mut self, town_read: &Town) {
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        let layers = town_read.layers.iter().map(|l| &l.name);
        let tables = town_read.tables.iter().map(|t| &t.name);
        for name in layers.chain(tables) {
            if let Some(first) = seen.insert(&name.value, name.span) {
                self.reporter
                    .push(|| town::same_name(name.span, &name.value, first));
            }
        }
        if town_read.layers.is_empty() {
            self.reporter.push(|| town::no_layers(town_read.span));
        }
        let known: Vec<String> = town_read
            .layers
            .iter()
            .map(|l| l.name.value.clone())
            .collect();
        let joined = town_read.layers.iter().flat_map(|l| &l.joins);
        let joined = joined.map(|join| &join.layer);
        for name in town_read.rules.iter().map(|rule| &rule.each).chain(joined) {
            if !known.contains(&name.value) {
                let near = self.suggest.among(&name.value, known.iter().map(|n| &**n));
                self.reporter
                    .push(|| town::unknown_layer(name.span, &name.value, near, &known));
            }
        }
    }

    /// Reads what a rule made of a feature: the content of an element.
    pub(in crate::parse::xml) fn made(
        &mut self,
        index: usize,
        stood: &mut BTreeMap<usize, Stood>,
        given: &mut BTreeMap<usize, Vec<(String, Value)>>,
        writes: bool,
    ) -> Vec<Made> {
        let element = &self.tree.elements[index];
        let mut all = vec![];
        for child in &element.children {
            let Child::Element(index) = child else {
                continue;
            };
            let mut only = vec![];
            let child = &self.tree.elements[*index];
            self.element(child, Some("for"), &schema::FOR, &mut only);
            let Some(AllowedChild::Element(schema, child)) = only.pop() else {
                continue;
            };
            let of_child = |name: &str| {
                let found = child.attributes.iter().find(|a| a.name == name);
                found.map_or(String::new(), |a| a.value.as_str().trim().to_owned())
            };
            match schema.tag {
                Tag::Place | Tag::House | Tag::Rear => {
                    let Some(stood) = stood.remove(index) else {
                        continue;
                    };
                    let is_rear = schema.tag == Tag::Rear;
                    let (kind, evidence) = match schema.tag {
                        Tag::House => Default::default(),
                        _ => (of_child("type"), of_child("evidence")),
                    };
                    // A house behind a house has become a `Place`.
                    let read_as = schema::named("Place").filter(|_| is_rear);
                    all.push(Made::Houses {
                        span: self.start(child),
                        kind,
                        evidence,
                        written: if writes { self.written(child) } else { vec![] },
                        unit: is_rear.then(|| of_child("name")),
                        houses: self.houses_at(read_as.unwrap_or(schema), child, &stood),
                        parameters: given.remove(index).unwrap_or_default(),
                        stood: Box::new(stood),
                    });
                }
                _ => all.push(self.open_made(schema, child)),
            }
        }
        self.text_in_for(element);
        all
    }

    /// Reads what stands in a `for` and is no house.
    fn open_made(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Made {
        let span = self.start(element);
        let text = |name: &str| {
            let found = element.attributes.iter().find(|a| a.name == name);
            found.map_or(String::new(), |a| a.value.as_str().trim().to_owned())
        };
        if schema.tag == Tag::Skip {
            self.attributes(schema, element);
            return Made::Skip {
                span,
                because: text("because"),
            };
        }
        Made::Outdoor {
            span,
            evidence: text("evidence"),
            wish: self.outdoor(schema, element),
        }
    }

    /// Writes the houses in an element, or the one that it is.
    fn written(&self, element: &'t Element<'t>) -> Vec<String> {
        let is =
            |element: &Element<'_>, tag| schema::named(element.name).is_some_and(|s| s.tag == tag);
        if is(element, Tag::House) {
            let mut text = String::new();
            written(self.tree, element, &mut text);
            return vec![text];
        }
        let children = element.children.iter().filter_map(|child| match child {
            Child::Element(index) => Some(&self.tree.elements[*index]),
            Child::Text(_) => None,
        });
        children.flat_map(|child| self.written(child)).collect()
    }

    fn text_in_for(&mut self, element: &'t Element<'t>) {
        for child in &element.children {
            if let Child::Text(text) = child {
                self.misplaced(&text.whole(), text.as_str(), "for");
            }
        }
    }

    fn houses_at(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        stood: &Stood,
    ) -> Vec<House> {
        let mut houses = vec![];
        if schema.tag == Tag::Place {
            self.placed(schema, element, Around::default(), &mut houses);
        } else {
            let frame = Frame {
                origin: [stood.at.x, stood.at.y, stood.z],
                turn: stood.azimuth - 180.0,
            };
            let house = self.house(schema, element);
            houses.push(Around::of(frame).put(house));
        }
        if stood.plinth > 0.0 {
            let span = self.start(element);
            for house in &mut houses {
                house.settings.plinth = Some(Spanned::new(stood.plinth, span));
            }
        }
        if let (Some(walls), [house]) = (&stood.walls, &mut *houses) {
            let attributes: Attributes<'t> = self.attributes(schema, element);
            let span = self.start(attributes.element);
            house.outline = Some(Box::new(outline(walls, span)));
        }
        houses
    }
}

/// Returns the outline of a feature, as if it were written at `span`.
fn outline(walls: &SiteWalls, span: Span) -> Outline {
    let points = |ring: &[glam::DVec2]| {
        let points = ring.iter().map(|p| Spanned::new(*p, span)).collect();
        Spanned::new(points, span)
    };
    let numbers = |list: &[u32]| Some(Spanned::new(list.iter().map(|n| (*n, *n)).collect(), span));
    let hole = |ring: &Vec<glam::DVec2>| hsd_ir::ast::Hole {
        span,
        points: points(ring),
    };
    Outline {
        span,
        points: points(&walls.ring),
        square: None,
        join: None,
        front: Some(Spanned::new(walls.front, span)),
        street: numbers(&walls.street),
        neighbour: numbers(&walls.neighbour),
        stand: Stand::Surveyed(0.0),
        holes: walls.holes.iter().map(hole).collect(),
    }
}
