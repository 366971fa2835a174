//! From the document as written to the program of steps.
//!
//! After this pass there is no `repeat`, no `random`, no `replace`, no facade and no unknown code left, and
//! every unit knows its part and its width. It is the only pass that opens the catalogue for codes. Order
//! in a row: parts and slots, then the edits of the row; then those of its loop or facade, of its storey
//! or structure, of its house.

use bounds::{Bounds, Repeated, Spent};
use codes::Codes;
use edits::Operation;
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::rng::Place;
use hsd_base::source::{Limits, Source, Span, Spanned, World};
use hsd_ir::ast::{self, Document, Era, Variant};
use hsd_ir::catalog::{Catalog, ScopeId};
use hsd_ir::messages::parts as say;
use hsd_ir::program::{Age, House, Picture, Program, Storey};
use outline::Surveyed;
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

mod bounds;
mod codes;
mod edits;
mod facades;
mod floors;
mod lists;
mod monuments;
mod images;
mod outline;
mod puts;
mod repeat;
mod roofs;
mod rows;
mod split;
mod storeys;
mod textures;

/// The options of this pass.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Overrides the seed of every house.
    pub seed: Option<u64>,
    /// Bounds on the expanded parts of a house.
    pub limits: Limits,
}

/// One U in shaku by default: Edo-ma.
const UNIT: f64 = 3.0;

/// Identity of a house for its random choices: its name counts, or this number if it has none. In a document it is the
/// house's index. A house made alone with the id that it has in a run is identical to the last bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HouseId(pub u64);

/// The surroundings of a house's syntax.
#[derive(Clone, Copy, Debug)]
pub struct HouseContext<'a> {
    /// The file that the house is written in.
    pub source: &'a Source,
    /// The custom parts that it knows.
    pub scope: ScopeId,
    /// The variant that its document belongs to, if several are made.
    pub variant: Option<Variant>,
}

/// Expands the houses of a run, one after another. It caches codes and images, which changes no house, and numbers the
/// images in the order of their first use. All houses together share two bounds: the storeys that monuments make, and the
/// parts that repetitions add.
pub struct Expander<'a> {
    codes: Codes<'a>,
    options: &'a Options,
    used: codes::UsedImages,
    /// Storeys that monuments have made so far.
    written_short: u64,
    /// Parts that repetitions have added so far, and steps of operations on them.
    repeated: Repeated,
}

impl<'a> Expander<'a> {
    /// Creates an expander that has made no house yet.
    pub fn new(catalog: &'a Catalog, world: &'a dyn World, options: &'a Options) -> Self {
        Expander {
            codes: Codes::new(catalog, world),
            options,
            used: codes::UsedImages::default(),
            written_short: 0,
            repeated: Repeated::default(),
        }
    }

    /// Expands one house; `None` where it would exceed a limit.
    pub fn house(
        &mut self,
        house: &ast::House,
        id: HouseId,
        context: HouseContext<'_>,
        out: &mut Diagnostics,
    ) -> Option<House> {
        self.codes.enter(context.scope);
        let mut pass = Pass::new(&mut self.codes, context.source, self.options, out);
        pass.written_short = self.written_short;
        pass.bounds = Bounds::new(&self.options.limits, house.span, self.repeated);
        let seed = house.settings.seed.as_ref().map(|seed| seed.value);
        let given = context.variant.map(|v| v.seed).or(self.options.seed);
        let root = Place::seed(given.or(seed).unwrap_or(0));
        let place = match &house.name {
            Some(name) => root.named(&name.value),
            None => root.at(id.0),
        };
        let made = pass.house(house, place);
        self.written_short = pass.written_short;
        self.repeated.add(pass.spent, pass.bounds.written);
        let mut made = House {
            variant: context.variant,
            ..made?
        };
        self.used.renumber(&mut made, &self.codes.pictures);
        Some(made)
    }

    /// Returns the images of all houses so far; parts refer to them by index.
    pub fn images(&self) -> &[Picture] {
        &self.used.images
    }

    /// As [`images`](Expander::images), when all houses are made.
    pub fn into_images(self) -> Vec<Picture> {
        self.used.images
    }
}

/// Makes the program of all documents. A house that would exceed the limit of parts is left out.
pub fn expand(
    documents: &[(&Source, &Document)],
    catalog: &Catalog,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Program {
    let mut expander = Expander::new(catalog, world, options);
    let mut houses = vec![];
    for (number, (source, document)) in documents.iter().enumerate() {
        for (index, house) in document.houses.iter().enumerate() {
            let context = HouseContext {
                source,
                scope: catalog.known_in(number, index),
                variant: document.variant,
            };
            houses.extend(expander.house(house, HouseId(index as u64), context, out));
        }
    }
    Program {
        houses,
        pictures: expander.into_images(),
    }
}

/// The state of the pass in one house.
struct Pass<'a, 'c> {
    codes: &'a mut Codes<'c>,
    source: &'a Source,
    out: &'a mut Diagnostics,
    /// Messages already reported, which repeated content would report again.
    said: BTreeSet<(u16, Span)>,
    operations: Vec<Rc<Operation>>,
    operation_index: HashMap<usize, usize>,
    spent: Spent,
    bounds: Bounds,
    over: bool,
    /// Storeys that the monuments of all houses so far have made.
    written_short: u64,
}

impl<'a, 'c> Pass<'a, 'c> {
    fn new(
        codes: &'a mut Codes<'c>,
        source: &'a Source,
        options: &Options,
        out: &'a mut Diagnostics,
    ) -> Self {
        Pass {
            codes,
            source,
            out,
            said: BTreeSet::new(),
            operations: vec![],
            operation_index: HashMap::new(),
            spent: Spent::default(),
            bounds: Bounds::new(&options.limits, Span::default(), Repeated::default()),
            over: false,
            written_short: 0,
        }
    }

    fn house(&mut self, house: &ast::House, place: Place) -> Option<House> {
        let settings = &house.settings;
        let unit = settings.unit.as_ref();
        let unit = unit.and_then(positive).unwrap_or(UNIT);
        self.given_pictures(house);
        let mut draft = self.monument(house, unit);
        let mut surveyed = match draft {
            Some(_) => None,
            None => self.survey(house, unit),
        };
        let mut storeys = match &mut draft {
            Some(draft) => self.own_parts(std::mem::take(&mut draft.storeys)),
            None => self.all_storeys(house, place, unit, surveyed.as_mut()),
        };
        monuments::share(&mut storeys, &house.fittings, draft.is_some());
        if self.over {
            return None;
        }
        self.report_idle_operations();
        self.textures(house, &mut storeys);
        self.pictures(&mut storeys, place);
        let number = |value: &Option<Spanned<f64>>, default| {
            value.as_ref().map_or(default, |value| value.value)
        };
        let mut made = House {
            span: house.span,
            name: house
                .name
                .as_ref()
                .map_or_else(String::new, |n| n.value.clone()),
            variant: None,
            origin: [&settings.x, &settings.y, &settings.z].map(|v| number(v, 0.0)),
            placed: house.placement.as_ref().and_then(|p| p.place),
            anchor: settings.anchor.unwrap_or_default(),
            plinth: number(&settings.plinth, 0.0),
            azimuth: number(&settings.azimuth, 180.0),
            unit_shaku: unit,
            street: settings.street.as_ref().is_some_and(|s| s.value),
            purpose: settings.purpose,
            storeys,
            platform: house.fittings.platform.clone(),
            finials: house.fittings.finials.clone(),
            puts: self.puts(&house.fittings.puts),
            grounds: house.fittings.grounds.clone(),
            outdoors: house.fittings.outdoors.clone(),
            age: self.age(settings, place),
            roofs: roofs::roofs(&house.roofs).into(),
        };
        match (draft, surveyed) {
            (Some(draft), _) => monuments::furnish(&mut made, draft),
            (None, Some(surveyed)) => surveyed.stand(&mut made),
            (None, None) => {}
        }
        Some(made)
    }

    /// Returns the age of the house, if it is given.
    fn age(&mut self, settings: &ast::Settings, place: Place) -> Option<Age> {
        let era = settings.era.as_ref();
        let Some(years) = &settings.age else {
            if let Some(era) = era {
                self.once(332, era.span, || say::era_without_age(era.span));
            }
            return None;
        };
        Some(Age {
            years: years.value,
            era: era.map_or(Era::All, |era| era.value),
            key: place.named("age").key(),
        })
    }

    fn all_storeys(
        &mut self,
        house: &ast::House,
        place: Place,
        unit: f64,
        surveyed: Option<&mut Surveyed>,
    ) -> Vec<Storey> {
        let mut storeys = self.storeys(house, place, surveyed);
        if let Some(structure) = house.structures.first().filter(|_| !storeys.is_empty()) {
            let span = self.head(structure.span);
            self.out
                .push(say::storeys_and_structure(span, storeys[0].span));
            return storeys;
        }
        for (index, structure) in house.structures.iter().enumerate() {
            let place = if index == 0 {
                place
            } else {
                place.at(index as u64).named("structure")
            };
            for (storey, made) in self
                .structure(structure, place, unit)
                .into_iter()
                .enumerate()
            {
                match storeys.get_mut(storey) {
                    Some(below) => below.loops.extend(made.loops),
                    None => storeys.push(made),
                }
            }
        }
        // A house of what stands outdoors alone is a plot, a gate or a garden.
        let outdoors = house.fittings.outdoors.is_some() || house.stands_outdoors();
        if storeys.is_empty() && !self.over && !outdoors {
            let span = house.name.as_ref().map(|name| name.span);
            let span = span.unwrap_or_else(|| self.head(house.span));
            self.out.push(say::empty_house(span));
        }
        storeys
    }

    /// Reports something once for a place, however often its content is repeated.
    fn once(&mut self, code: u16, span: Span, say: impl FnOnce() -> Diagnostic) {
        if self.is_news(code, span) {
            self.out.push(say());
        }
    }

    /// Returns true if no diagnostic with this code was reported for this place, and records it.
    fn is_news(&mut self, code: u16, span: Span) -> bool {
        self.said.insert((code, span))
    }

    /// Returns the first line of a long construct: an underlined house would show nothing.
    fn head(&self, span: Span) -> Span {
        if span.file != self.source.id() {
            return span;
        }
        let range = self.source.text_range(span);
        let text = &self.source.text()[range.clone()];
        let first = text.lines().next().unwrap_or_default().trim_end();
        self.source.span(range.start..range.start + first.len())
    }
}

/// Returns a length above zero. The readers report others; here the default takes their place.
fn positive(length: &Spanned<f64>) -> Option<f64> {
    Some(length.value).filter(|value| *value > 0.0)
}
