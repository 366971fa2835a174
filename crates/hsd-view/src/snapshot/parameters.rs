//! The parameters of a file as the page shows and sets them. What a page sets holds while the preview runs, for all its pages;
//! the text keeps its defaults.

use hsd_base::diagnostic::Language;
use hsd_driver::Options;
use hsd_ir::ast::{Parameter, Value};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Values that were set, by the names of their parameters.
pub(crate) type Given = BTreeMap<String, String>;

/// A parameter: `Parameter` in `view/src/server/api.ts`.
#[derive(Debug, Hash, Serialize)]
pub(crate) struct ShownParameter {
    name: String,
    /// The kind of its value: `number`, `truth` or `text`.
    kind: &'static str,
    value: String,
    default: String,
    min: Option<String>,
    max: Option<String>,
    step: Option<String>,
    choices: Vec<String>,
    unit: Option<String>,
    doc: Option<String>,
}

/// Returns the options with what was set in place of what the command line gives.
pub(crate) fn with(options: &Options, given: &Given) -> Options {
    let mut options = options.clone();
    options
        .parameters
        .retain(|(name, _)| !given.contains_key(name));
    let given = given
        .iter()
        .map(|(name, value)| (name.clone(), value.clone()));
    options.parameters.extend(given);
    options
}

/// Returns their names.
pub(crate) fn names(parameters: &[Parameter]) -> BTreeSet<String> {
    parameters.iter().map(|p| p.name.clone()).collect()
}

/// Returns the parameters of a file that have a value, each name once.
pub(crate) fn shown(parameters: &[Parameter], language: Language) -> Vec<ShownParameter> {
    let mut list: Vec<ShownParameter> = vec![];
    for parameter in parameters {
        let Some(default) = &parameter.default else {
            continue;
        };
        if list.iter().any(|own| own.name == parameter.name) {
            continue;
        }
        let value = parameter.value.as_ref().unwrap_or(default);
        let number = |n: f64| Value::Number(n).to_string();
        let doc = match language {
            Language::Japanese => parameter.doc_ja.as_ref().or(parameter.doc.as_ref()),
            Language::English => parameter.doc.as_ref(),
        };
        list.push(ShownParameter {
            name: parameter.name.clone(),
            kind: match default {
                Value::Number(_) => "number",
                Value::Truth(_) => "truth",
                Value::Text(_) => "text",
            },
            value: value.to_string(),
            default: default.to_string(),
            min: parameter.min.map(number),
            max: parameter.max.map(number),
            step: parameter.step.map(number),
            choices: parameter.choices.iter().map(Value::to_string).collect(),
            unit: parameter.unit.clone(),
            doc: doc.cloned(),
        });
    }
    list
}
