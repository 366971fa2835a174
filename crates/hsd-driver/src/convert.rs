//! Converts a source to the other form of the language, if it makes the same building there.

use super::{Options, building, documents, program};
use hsd_base::diagnostic::{Diagnostics, Severity};
use hsd_base::source::{Source, World};
use hsd_ir::program::Roofs;
use hsd_syntax::messages::print as say;
use hsd_syntax::print::{self, Form};

/// Converts a source to the other form. `world` is asked for images, since codes may name them.
///
/// # Errors `None` if the source has errors or the other form cannot express it; `out` receives the reason.
pub fn convert(
    source: &Source,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Option<String> {
    let to = Form::of(source).other();
    let mut found = Diagnostics::new();
    let made = written(source, to, world, options, &mut found);
    let errors = found.has_errors();
    let news = found.into_sorted().into_iter();
    news.filter(|d| d.severity == Severity::Error)
        .for_each(|d| out.push(d));
    let text = made.filter(|_| !errors)?;
    let again = Source::new(source.id(), source.name(), &print::encode(&text, source));
    let built = |source| walls_and_roofs(source, world, options);
    if built(source) == built(&again) {
        return Some(text);
    }
    out.push(say::not_the_same(source.span(0..0), to.name()));
    None
}

fn written(
    source: &Source,
    to: Form,
    world: &dyn World,
    options: &Options,
    out: &mut Diagnostics,
) -> Option<String> {
    let read = documents(&[source], world, &plain(options), out);
    if out.has_errors() {
        return None;
    }
    if to == Form::Xml {
        return print::to_xml(source, &options.expand.limits, out);
    }
    let (documents, catalog) = (&read.documents, &read.catalog);
    let program = program(&[source], documents, catalog, world, &options.expand, out);
    if out.has_errors() {
        return None;
    }
    let document = documents.first()?;
    print::to_legacy(source, document, &program, catalog, out)
}

/// Returns the options for reading it, with parameters at their defaults.
fn plain(options: &Options) -> Options {
    Options {
        parameters: vec![],
        ..options.clone()
    }
}

/// Returns the building without places; `None` if the source cannot be read.
fn walls_and_roofs(source: &Source, world: &dyn World, options: &Options) -> Option<Vec<u8>> {
    let mut out = Diagnostics::new();
    let read = documents(&[source], world, &plain(options), &mut out);
    if out.has_errors() {
        return None;
    }
    let (documents, catalog) = (&read.documents, &read.catalog);
    let mut program = program(
        &[source],
        documents,
        catalog,
        world,
        &options.expand,
        &mut out,
    );
    // Facades are scaled to their width, in the legacy form the unit is.
    for house in &mut program.houses {
        if let Some(own) = print::in_own_widths(house, catalog) {
            *house = own;
        }
    }
    let mut built = building(program, catalog, &mut out);
    // The roof section may be written in another way; the resulting roofs are compared.
    for built in &mut built.houses {
        built.house.roofs = Roofs::default().into();
    }
    Some(print::essence(&built))
}
