//! Evaluates a town: reads its maps, then makes the houses of its features, a chunk of features at a time. What is made of a
//! feature depends on the town file, the feature and what stands round it; chunks only save time.

mod covered;
mod font;
mod footprints;
mod made;
mod maps;
mod outdoors;

pub use maps::{plan, plan_lodged};

use footprints::footprints;

use super::decision::{Outcome, Record};
use super::layer::KeptMaps;
use super::plan::{Covered, LotId, Plan};
use super::rear::RearDecision;
use super::shape::hull;
use super::site::LotSite;
use super::text;
use glam::DVec2;
use hsd_base::diagnostic::{Diagnostics, Origin};
use hsd_base::source::{Source, SourceCache, Spanned, World};
use hsd_driver::{FeatureHouse, Options};
use hsd_ir::ast::town::{Made, Stood};
use hsd_ir::ast::{House, Item, Outline, Stand, Storey, Value};
use hsd_syntax::messages::town as say;
use hsd_syntax::parse;
use hsd_syntax::parse::Values;
use hsd_syntax::parse::over;
use hsd_syntax::parse::xml::{self, FeatureMade, FeatureOf, MissingFields, Trees};
use hsd_syntax::templates::{EXAMPLES, GROUNDS, TYPES};
use std::sync::Arc;

/// The number of features that are evaluated together.
const CHUNK: usize = 128;

/// What a town is made from.
#[derive(Clone, Copy)]
pub struct TownInput<'a> {
    /// The town file.
    pub source: &'a Source,
    /// Where its maps are.
    pub world: &'a dyn World,
    /// The options of the run.
    pub options: &'a Options,
    /// Maps that were read before.
    pub kept: Option<&'a KeptMaps>,
    /// True if the houses are wanted as texts.
    pub texts: bool,
}

impl<'a> TownInput<'a> {
    /// Creates the input of a town that is read once, from whose houses no texts are made.
    pub fn new(source: &'a Source, world: &'a dyn World, options: &'a Options) -> TownInput<'a> {
        TownInput {
            source,
            world,
            options,
            kept: None,
            texts: false,
        }
    }
}

/// What is made of a chunk of features.
pub struct Chunk {
    /// The houses, in the order of the features.
    pub houses: Vec<FeatureHouse>,
    /// A line for each feature, and after it one for each house behind its house.
    pub records: Vec<Record>,
    /// What was found.
    pub found: Diagnostics,
    /// How many features lacked fields.
    pub missing: MissingFields,
    /// Types and files that were read.
    pub included: Vec<Source>,
    /// The values of expressions, if the options ask for them.
    pub values: Values,
}

/// The houses of a town, chunk by chunk.
pub struct TownHouses<'a> {
    input: TownInput<'a>,
    plan: &'a Plan,
    lots: Vec<LotId>,
    next: usize,
}

impl<'a> TownHouses<'a> {
    /// Begins a town.
    pub fn new(input: TownInput<'a>, plan: &'a Plan) -> TownHouses<'a> {
        TownHouses {
            input,
            plan,
            lots: plan.lots(),
            next: 0,
        }
    }

    /// Returns the number of features.
    pub fn len(&self) -> usize {
        self.lots.len()
    }

    /// Returns true if no rule names a feature.
    pub fn is_empty(&self) -> bool {
        self.lots.is_empty()
    }

    /// Returns the chunks of features, each to be evaluated by itself.
    pub fn chunks(&self) -> impl Iterator<Item = &[LotId]> {
        self.lots.chunks(CHUNK)
    }

    /// Evaluates some features.
    pub fn evaluate(&self, lots: &[LotId]) -> Chunk {
        evaluate(self.input, self.plan, lots)
    }
}

impl Iterator for TownHouses<'_> {
    type Item = Chunk;

    fn next(&mut self) -> Option<Chunk> {
        let end = (self.next + CHUNK).min(self.lots.len());
        let lots = &self.lots[self.next..end];
        self.next = end;
        (!lots.is_empty()).then(|| evaluate(self.input, self.plan, lots))
    }
}

/// Returns an empty cache of the files that rules read.
fn cache(input: TownInput<'_>) -> SourceCache {
    let limits = &input.options.expand.limits;
    let first = input.source.id().0 as usize + 1;
    let cache = SourceCache::new(first, limits.includes, limits.included_bytes);
    // In a fixed order, so that a file has the same number in every chunk.
    for template in TYPES.iter().chain(EXAMPLES).chain([&GROUNDS]) {
        let _ = cache.add_own(&template.source_name(), template.text().as_bytes());
    }
    cache
}

/// Returns what rules are read with.
fn context<'a>(
    input: TownInput<'a>,
    cache: &'a SourceCache,
    values: &'a Values,
) -> parse::ReadContext<'a> {
    parse::ReadContext {
        limits: input.options.expand.limits,
        parameters: &input.options.parameters,
        seed: input.options.expand.seed,
        world: input.world,
        cache,
        values: input.options.notes_values.then_some(values),
        before: None,
    }
}

/// Evaluates some features of a town, or of a part of one.
pub fn evaluate(input: TownInput<'_>, plan: &Plan, lots: &[LotId]) -> Chunk {
    let limits = &input.options.expand.limits;
    let (cache, values) = (cache(input), Values::default());
    let setting = context(input, &cache, &values);
    let sites: Vec<LotSite<'_>> = lots.iter().map(|id| LotSite::new(plan, *id)).collect();
    let features: Vec<FeatureOf<'_>> = sites
        .iter()
        .zip(lots)
        .map(|(site, (layer, _))| FeatureOf {
            layer: &plan.layers[*layer].layer.name.value,
            site,
        })
        .collect();
    let mut found = Diagnostics::new();
    let mut trees = Trees::default();
    let (made, missing) = xml::features(
        input.source,
        setting,
        &mut trees,
        (&features, input.texts),
        &mut found,
    );
    drop(trees);
    let (mut houses, mut records) = (vec![], vec![]);
    let covered = covered::covered((plan, input), lots, &made);
    let made = made.into_iter().zip(covered);
    for ((made, site), id) in made.zip(&sites).zip(lots) {
        let of = (plan, input);
        records.extend(record(of, *id, site, made, &mut houses, &mut found));
    }
    drop(features);
    if input.texts {
        text::check(&mut houses, limits);
    }
    drop(sites);
    Chunk {
        houses,
        records,
        found,
        missing,
        included: cache.into_sources(),
        values: values.of_file(input.source.id()),
    }
}

/// Turns what the rules made of a feature into houses, and records it: the feature, then what stands behind its house.
fn record(
    (plan, input): (&Plan, TownInput<'_>),
    id: LotId,
    site: &LotSite<'_>,
    (made, covered): (FeatureMade, Option<Covered>),
    houses: &mut Vec<FeatureHouse>,
    found: &mut Diagnostics,
) -> Vec<Record> {
    let layer: Arc<str> = plan.layers[id.0].layer.name.value.as_str().into();
    let lot = plan.lot(id);
    let mut record = Record::new(id, &layer, lot, site);
    record.problem = made.problem;
    record.outcome = match made.rules {
        0 => Outcome::NoRule,
        _ => Outcome::Nothing,
    };
    let origin = Origin::Feature {
        layer: layer.clone(),
        key: (&*lot.key).into(),
    };
    let decisions = site.decisions.borrow();
    if let Some(why) = decisions.iter().find_map(|d| d.refused.clone()) {
        let refused = say::refused(origin.clone(), &why);
        record.outcome = Outcome::Refused(refused.code, why);
        found.push(refused);
    }
    if let Some(Covered { by, share }) = covered {
        let covered = say::covered(origin, &plan.lot(by).key, share);
        record.outcome = Outcome::Refused(covered.code, covered.message.clone());
        found.push(covered);
        return vec![record];
    }
    let mut parts = parts(&record, site, origin, found);
    let (mut behind, ring) = (vec![], lot.shape.ring());
    site.built.replace(footprints(&made.made, ring, input));
    for made in made.made {
        let own = (site, &mut record);
        let Some(made) = outdoors::enter(made, own, (&layer, input), houses, found) else {
            continue;
        };
        let rule = made.rule + 1;
        let unit = match &made.made {
            Made::Houses { unit, .. } => unit.as_ref(),
            _ => None,
        };
        let Some(unit) = unit else {
            enter(made.made, rule, &mut record, (ring, &layer, input), houses);
            continue;
        };
        let key = part_key(&lot.key, unit);
        if let Some(part) = parts.iter_mut().find(|part| *part.key == *key) {
            let corners = part.corners();
            let ring = corners.as_ref().map(|c| &c[..]);
            enter(made.made, rule, part, (ring, &layer, input), &mut behind);
        }
    }
    houses.append(&mut behind);
    record.decide(&decisions);
    std::iter::once(record).chain(parts).collect()
}

/// Enters what a rule made into the record that it belongs to.
fn enter(
    made: Made,
    rule: usize,
    record: &mut Record,
    (ring, layer, input): (Option<&[DVec2]>, &Arc<str>, TownInput<'_>),
    houses: &mut Vec<FeatureHouse>,
) {
    record.rule = rule;
    match made {
        Made::Skip { because, .. } => record.outcome = Outcome::Skipped(because),
        Made::Outdoor { .. } => {}
        Made::Houses {
            kind,
            evidence,
            houses: own,
            parameters,
            stood,
            span,
            unit: _,
            written,
        } => {
            record.span = Some(span);
            record.outcome = Outcome::Built;
            record.kind = kind;
            record.evidence = evidence;
            let mut written = written.iter();
            for house in own {
                record.houses += 1;
                let plain = plain(&house, &stood, ring);
                let house = over_outline(house, &stood, &parameters);
                let name = name(layer, &record.key, record.houses);
                let told = text::Told {
                    kind: &record.kind,
                    parameters: &parameters,
                    stood: &stood,
                    written: written.next(),
                    seed: input.options.expand.seed,
                };
                houses.push(FeatureHouse {
                    feature: record.id,
                    text: input.texts.then(|| text::write(&house, &name, &told)),
                    plain,
                    within: ring.filter(|_| !stood.centred).map(hull),
                    house,
                    origin: Origin::Feature {
                        layer: layer.clone(),
                        key: (&*record.key).into(),
                    },
                    name,
                });
            }
            record.parameters = parameters;
        }
    }
}

/// Returns the key of a house behind the house of a feature.
fn part_key(key: &str, unit: &str) -> String {
    format!("{key}/{unit}")
}

/// Returns the records of the houses behind the house of a feature, and of those that have no place.
fn parts(of: &Record, site: &LotSite<'_>, origin: Origin, found: &mut Diagnostics) -> Vec<Record> {
    let part = |decision: &RearDecision| of.part(&part_key(&of.key, &decision.unit), decision);
    let parts: Vec<Record> = site.rear_decisions.borrow().iter().map(part).collect();
    let has_no_house = |part: &Record| matches!(part.outcome, Outcome::NoHouse);
    if parts.iter().any(has_no_house) {
        found.push(say::rear_of_no_house(origin));
    }
    parts
}

/// Returns the name in the model of a house of a feature, by its number there.
fn name(layer: &str, key: &str, number: usize) -> String {
    match number {
        1 => format!("{layer} {key}"),
        n => format!("{layer} {key} {n}"),
    }
}

/// Fits the rows of a house to the outline that it stands on, if it is written as rows. They are made for the frontage that the
/// type was given, which may be less than that of the feature, as in a file that places the house.
fn over_outline(mut house: House, stood: &Stood, parameters: &[(String, Value)]) -> House {
    if stood.walls.is_some() && !over::has_walls(&house) {
        let walls = stood.walls.as_ref();
        let front = walls.map_or(stood.frontage, |w| {
            let at = w.front as usize - 1;
            w.ring[at].distance(w.ring[(at + 1) % w.ring.len()])
        });
        let given = parameters.iter().find_map(|(name, value)| match value {
            Value::Number(metres) if name == "frontage" => Some(*metres),
            _ => None,
        });
        let meant = given.unwrap_or(stood.frontage);
        over::rewrite(&mut house, over::Front::of(front, meant));
    }
    house
}

/// Returns the plain body that stands in for a house with errors: two storeys of plain walls on the outline.
fn plain(house: &House, stood: &Stood, ring: Option<&[DVec2]>) -> Option<Box<House>> {
    let span = house.span;
    let ring = ring?;
    let points = ring.iter().map(|p| Spanned::new(*p - stood.at, span));
    let storey = || {
        Item::One(Storey {
            span,
            ..Storey::default()
        })
    };
    let mut plain = House {
        span,
        storeys: vec![storey(), storey()],
        outline: Some(Box::new(Outline {
            span,
            points: Spanned::new(points.collect(), span),
            square: None,
            join: None,
            front: None,
            street: None,
            neighbour: None,
            stand: Stand::Surveyed(0.0),
            holes: vec![],
        })),
        ..House::default()
    };
    let at = |value: f64| Some(Spanned::new(value, span));
    plain.settings.x = at(stood.at.x);
    plain.settings.y = at(stood.at.y);
    plain.settings.z = at(stood.z);
    plain.settings.plinth = at(stood.plinth).filter(|plinth| plinth.value > 0.0);
    Some(Box::new(plain))
}

/// Returns the path of a file that a town names.
fn path(
    input: TownInput<'_>,
    href: &hsd_base::source::Spanned<String>,
) -> Result<String, hsd_base::diagnostic::Text> {
    let found = input.world.text(input.source.name(), &href.value);
    found.map_err(|_| {
        hsd_base::text!(
            "there is no such file below the folder of the town",
            "町のファイルのフォルダーより下に、そのファイルがありません"
        )
    })
}
