//! Custom parts of catalogue files, for the list and the sheet.

use crate::Failure;
use crate::files::input::Inputs;
use crate::options::report;
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::source::Limits;
use hsd_driver::fs::{FolderWorld, InputRecord};
use hsd_ir::catalog::{Catalog, PartDef};
use hsd_report::{Format, Report};
use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

/// The catalogue with the custom parts of files.
pub(super) struct CustomParts {
    catalog: Cow<'static, Catalog>,
    builtin: usize,
    /// True if the files have no errors.
    pub(super) sound: bool,
}

impl CustomParts {
    /// Returns the custom parts.
    pub(super) fn parts(&self) -> &[PartDef] {
        &self.catalog.parts()[self.builtin..]
    }
}

/// Reads catalogue files and prints their diagnostics. Adds the files that are read to the record.
pub(super) fn read(
    paths: &[PathBuf],
    record: &InputRecord,
    language: Language,
) -> Result<CustomParts, Failure> {
    let limits = Limits::default();
    let mut out = Diagnostics::new();
    let inputs = Inputs::read(paths, limits.bytes, &mut out)?;
    let folder = |p: &PathBuf| p.parent().unwrap_or(Path::new("")).to_owned();
    let folders: Vec<PathBuf> = paths.iter().map(folder).collect();
    let world = FolderWorld::new(folders.clone(), limits.pixels).with_roots(folders);
    let world = world.recorded_in(record);
    let sources = inputs.accepted();
    let mut read =
        hsd_driver::documents(&sources, &world, &hsd_driver::Options::default(), &mut out);
    let included = std::mem::take(&mut read.included);
    let sound = !out.has_errors();
    let list = out.into_sorted();
    if !list.is_empty() {
        let sources = inputs.and(included);
        let written = Report::new(&sources, &list).in_language(language);
        report(&written, Format::Human, &mut io::stderr())?;
    }
    Ok(CustomParts {
        catalog: read.catalog,
        builtin: hsd_syntax::parse::builtin().parts().len(),
        sound,
    })
}
