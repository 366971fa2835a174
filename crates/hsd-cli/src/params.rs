//! `hsd params`: lists the parameters of source files.

use super::options::{InputArgs, exit, report};
use super::{Failure, Outcome};
use crate::files::input::Inputs;
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::{Diagnostics, Language, Severity, visible};
use hsd_ir::ast::{Document, Parameter};
use hsd_ir::messages::xml::bounds;
use hsd_report::{Format, Report};
use serde::Serialize;
use std::io::{self, Write};

/// List the parameters of source files and their allowed values.
///
/// `--param` sets them.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd params machiya.hsd                         list the parameters
  hsd build machiya.hsd --param frontage=5       set one of them")]
pub(super) struct Params {
    #[command(flatten)]
    input_args: InputArgs,

    /// Set the output format.
    #[arg(long, value_enum, default_value_t)]
    format: ParamsFormat,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum ParamsFormat {
    /// A table.
    #[default]
    Table,
    /// A JSON array, for programs.
    Json,
}

/// A parameter and the file that declares it.
#[derive(Serialize)]
struct ParameterRow<'a> {
    file: &'a str,
    #[serde(flatten)]
    parameter: &'a Parameter,
}

impl Params {
    pub(super) fn run(&self, language: Language) -> Outcome {
        self.input_args.check_folders()?;
        let limits = self.input_args.limits();
        let mut out = Diagnostics::new();
        let inputs = Inputs::read(&self.input_args.inputs, limits.bytes, &mut out)?;
        let options = self.input_args.options(&inputs, &mut out)?;
        let world = self.input_args.world(&self.input_args.inputs);
        let sources = inputs.accepted();
        let read = hsd_driver::documents(&sources, &world, &options, &mut out);
        let names = sources.iter().map(|s| s.name());
        let text = match self.format {
            ParamsFormat::Table => table(&read.documents, language),
            ParamsFormat::Json => {
                let rows: Vec<ParameterRow<'_>> = names
                    .zip(&read.documents)
                    .flat_map(|(file, d)| of(d).into_iter().map(move |p| (file, p)))
                    .map(|(file, parameter)| ParameterRow { file, parameter })
                    .collect();
                let text = serde_json::to_string_pretty(&rows);
                text.map_err(|e| Failure::json(&e))? + "\n"
            }
        };
        let mut list = out.into_sorted();
        list.retain(|d| d.severity == Severity::Error);
        let sources = inputs.and(read.included);
        if !list.is_empty() {
            report(
                &Report::new(&sources, &list).in_language(language),
                Format::Human,
                &mut io::stderr(),
            )?;
        }
        let mut stdout = io::stdout().lock();
        stdout.write_all(text.as_bytes())?;
        stdout.flush()?;
        Ok(exit(!list.is_empty()))
    }
}

/// Returns the parameters of a document without duplicate names.
fn of(document: &Document) -> Vec<&Parameter> {
    let mut found: Vec<&Parameter> = vec![];
    for parameter in &document.parameters {
        if !found.iter().any(|p| p.name == parameter.name) {
            found.push(parameter);
        }
    }
    found
}

/// Formats the parameters as an aligned table.
fn table(documents: &[Document], language: Language) -> String {
    let head = language.choose(
        ["name", "value", "allowed", "unit", "description"],
        ["名前", "値", "取りうる値", "単位", "説明"],
    );
    let mut rows = vec![head.map(str::to_owned)];
    for parameter in documents.iter().flat_map(of) {
        let value = parameter.value.as_ref().or(parameter.default.as_ref());
        let words = |words: &Option<String>| words.clone().unwrap_or_default();
        rows.push([
            parameter.name.clone(),
            value.map_or_else(String::new, ToString::to_string),
            bounds(parameter).in_language(language).replace('`', ""),
            words(&parameter.unit),
            words(
                language.choose(
                    &parameter.doc,
                    parameter
                        .doc_ja
                        .as_ref()
                        .map_or(&parameter.doc, |_| &parameter.doc_ja),
                ),
            ),
        ]);
    }
    if rows.len() == 1 {
        return language
            .choose("no parameters\n", "パラメーターはありません\n")
            .into();
    }
    let width =
        |text: &str| -> usize { text.chars().map(|c| 1 + usize::from(c > '\u{2e7f}')).sum() };
    let widths: Vec<usize> = (0..5)
        .map(|c| rows.iter().map(|r| width(&r[c])).max().unwrap_or(0))
        .collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, wide) in row.iter().zip(&widths) {
            let cell = visible::line(cell);
            line += &cell;
            line += &" ".repeat(wide.saturating_sub(width(&cell)) + 2);
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}
