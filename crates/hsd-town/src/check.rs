//! Checks a town with its maps: evaluates its rules at every feature, and if wanted makes the houses, which nothing keeps.
//! Returns what editors ask for: the fields of the layers, and the values of expressions.

use super::layer::{Lots, as_text, is_name};
use super::plan::Plan;
use super::run::{self, TownInput};
use super::stream::TownStream;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{FileId, Source, Span};
use hsd_driver::Read;
use hsd_ir::ast::Value;
use hsd_ir::ast::town::{FieldType, Known};
use hsd_syntax::parse::Seen;
use std::collections::BTreeMap;

/// The number of different values of a field that are kept.
const EXAMPLES: usize = 5;

/// The part of a town that a check evaluates.
#[derive(Clone, Copy)]
pub enum CheckDepth<'a> {
    /// The rules at every feature, for as long as the function returns true.
    Rules(&'a dyn Fn() -> bool),
    /// The rules, then every house up to its model: reports what a build of the town reports.
    Houses,
}

/// What is known of a town that has been checked.
#[derive(Debug, Default)]
pub struct TownFacts {
    /// The number of houses that its rules ask for.
    pub houses: usize,
    /// True if something is missing that the author wanted.
    pub is_incomplete: bool,
    /// Its layers, in the order of the file; none if its maps cannot be read, or if nobody asked.
    pub layers: Vec<LayerFacts>,
    /// The values of expressions, if the options ask for them.
    pub values: BTreeMap<Span, Seen>,
}

/// What is known of a layer.
#[derive(Debug)]
pub struct LayerFacts {
    /// Its name in the town.
    pub name: String,
    /// The number of its features, after its `where`.
    pub features: usize,
    /// Its fields: those that a `Field` makes, then those of the file.
    pub fields: Vec<FieldFacts>,
}

/// What is known of a field.
#[derive(Clone, Debug, Default)]
pub struct FieldFacts {
    /// Its name.
    pub name: String,
    /// True if expressions can name it.
    pub is_name: bool,
    /// True if a `Field` of the town makes it.
    pub is_made: bool,
    /// The number of features that have it.
    pub count: usize,
    /// The type of its values; `None` if they differ.
    pub kind: Option<FieldType>,
    /// Its first few different values.
    pub examples: Vec<String>,
    /// True if it has more of them.
    pub more: bool,
}

/// Checks a town file; `None` if it is not a town, or if the function of `depth` has returned false. `included` are the files that
/// were read for it before; files in which more is found are added, with separate numbers.
pub fn check(
    input: TownInput<'_>,
    depth: CheckDepth<'_>,
    included: &mut Vec<Source>,
    out: &mut Diagnostics,
) -> Option<TownFacts> {
    let (mut known, mut found) = (Diagnostics::new(), Diagnostics::new());
    let mut read = hsd_driver::documents(&[input.source], input.world, input.options, &mut known);
    let town = read.documents.iter_mut().find_map(|d| d.town.take())?;
    let asked = input.options.notes_values;
    if known.has_errors() {
        // The rules cannot be evaluated; the maps can still be asked.
        let plan = asked.then(|| run::plan(input, &town, &mut found)).flatten();
        return Some(facts(plan.as_ref(), TownFacts::default()));
    }
    let (made, sources) = match run::plan(input, &town, &mut found) {
        Some(plan) => evaluated(input, (&plan, read), depth, &mut found)?,
        None => (TownFacts::default(), vec![]),
    };
    adopt(sources, input.source.id(), included, &mut found);
    out.append(found);
    Some(made)
}

/// Evaluates the rules at all features.
fn evaluated(
    input: TownInput<'_>,
    (plan, read): (&Plan, Read),
    depth: CheckDepth<'_>,
    out: &mut Diagnostics,
) -> Option<(TownFacts, Vec<Source>)> {
    let mut stream = TownStream::new(input, plan);
    let houses = match depth {
        CheckDepth::Rules(goes_on) => {
            let houses = stream.by_ref().take_while(|_| goes_on()).count();
            goes_on().then_some(houses)?
        }
        CheckDepth::Houses => {
            let mut houses = 0;
            stream.build(input, read, out, &mut |_| houses += 1);
            houses
        }
    };
    let (ledger, sources) = stream.finish(out);
    let made = TownFacts {
        houses,
        is_incomplete: ledger.is_incomplete(),
        layers: vec![],
        values: ledger.values.into_places(),
    };
    let asked = input.options.notes_values.then_some(plan);
    Some((facts(asked, made), sources))
}

fn facts(plan: Option<&Plan>, made: TownFacts) -> TownFacts {
    let layers = plan.into_iter().flat_map(|plan| &plan.layers);
    TownFacts {
        layers: layers.map(LayerFacts::of).collect(),
        ..made
    }
}

/// Adds the files in which something was found to those that are known, and gives the places in them their numbers there.
/// `own` is the number of the town file.
pub fn adopt(sources: Vec<Source>, own: FileId, known: &mut Vec<Source>, found: &mut Diagnostics) {
    found.renumber(&mut |file| {
        let Some(source) = sources.iter().find(|s| file != own && s.id() == file) else {
            return file;
        };
        if let Some(same) = known.iter().find(|s| s.name() == source.name()) {
            return same.id();
        }
        let last = known.iter().map(|s| s.id().0).max().unwrap_or(own.0);
        known.push(source.clone().numbered(FileId(last + 1)));
        FileId(last + 1)
    });
}

impl LayerFacts {
    fn of(lots: &Lots) -> LayerFacts {
        let made = lots.layer.fields.iter().map(|field| {
            let mut facts = FieldFacts {
                name: field.name.value.clone(),
                is_name: true,
                is_made: true,
                ..FieldFacts::default()
            };
            for lot in &lots.lots {
                if let Known::Value(value) = lots.field(lot, &facts.name) {
                    facts.add(kind_of(&value), &value.to_string());
                }
            }
            facts
        });
        LayerFacts {
            name: lots.layer.name.value.clone(),
            features: lots.lots.len(),
            fields: made.chain(columns(lots)).collect(),
        }
    }

    /// Returns a field.
    pub fn field(&self, name: &str) -> Option<&FieldFacts> {
        self.fields.iter().find(|field| field.name == name)
    }
}

/// Tells of the fields as the file has them.
fn columns(lots: &Lots) -> impl Iterator<Item = FieldFacts> + use<> {
    let mut columns: Vec<FieldFacts> = vec![];
    for (name, column) in lots.columns() {
        if columns.len() <= column {
            columns.resize_with(column + 1, FieldFacts::default);
        }
        columns[column].name = name.to_owned();
        columns[column].is_name = is_name(name);
    }
    for (column, value) in lots.lots.iter().flat_map(|lot| lot.fields()) {
        let text = as_text(value).filter(|text| !text.trim().is_empty());
        if let (Some(facts), Some(text)) = (columns.get_mut(*column), text) {
            facts.add(kind_in_file(value, &text), &text);
        }
    }
    columns.into_iter().filter(|facts| !facts.name.is_empty())
}

impl FieldFacts {
    fn add(&mut self, kind: FieldType, text: &str) {
        self.kind = match self.count {
            0 => Some(kind),
            _ => self.kind.filter(|own| *own == kind),
        };
        self.count += 1;
        if !self.examples.iter().any(|known| known == text) {
            match self.examples.len() < EXAMPLES {
                true => self.examples.push(text.to_owned()),
                false => self.more = true,
            }
        }
    }
}

fn kind_of(value: &Value) -> FieldType {
    match value {
        Value::Number(_) => FieldType::Number,
        Value::Truth(_) => FieldType::Truth,
        Value::Text(_) => FieldType::Text,
    }
}

/// Returns the type as which expressions see a value: texts such as `12` are numbers.
fn kind_in_file(value: &hsd_map::Value, text: &str) -> FieldType {
    match value {
        hsd_map::Value::Bool(_) => FieldType::Truth,
        _ => kind_of(&Value::read(text)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_of_several_types_has_none() {
        let mut facts = FieldFacts::default();
        for text in ["2", "3", "two", "2"] {
            facts.add(kind_of(&Value::read(text)), text);
        }
        assert_eq!((facts.kind, facts.count), (None, 4));
        assert_eq!(facts.examples, ["2", "3", "two"]);
        assert!(!facts.more);
    }
}
