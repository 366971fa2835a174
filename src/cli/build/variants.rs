//! `hsd build --variants`: one model per variant, and the contact sheet.

use super::{Build, Job};
use crate::cli::files::input::Inputs;
use crate::cli::files::output;
use crate::cli::files::output::Files;
use crate::cli::options::{exit, report};
use crate::cli::{Exit, Outcome, Stop};
use crate::diagnostic::{Diagnostics, Language};
use crate::driver;
use crate::render::sheet;
use crate::report::{Format, Report};
use crate::text;
use crate::texture;
use image::DynamicImage;
use std::io::{self, Write};
use std::num::NonZeroU32;
use std::path::Path;

/// The JPEG quality of a contact sheet.
const QUALITY: u8 = 88;

/// The maximum number of variants in a contact sheet; larger images fail to open in most viewers.
const MOST: u32 = 2500;

/// Fails if the format is not supported or there are too many variants.
pub(super) fn check_sheet(sheet: &Path, variants: Option<NonZeroU32>) -> Result<(), Stop> {
    if variants.is_some_and(|count| count.get() > MOST) {
        return Err(Stop::Usage(text!(
            "a contact sheet can show at most {MOST} variants",
            "一覧画像に並べられる変種は {MOST} 件までです"
        )));
    }
    match kind(sheet) {
        Some(_) => Ok(()),
        None => {
            let shown = sheet.display();
            Err(Stop::Usage(text!(
                "{shown}: the extension of a contact sheet must be .png or .jpg",
                "{shown}: 一覧画像の拡張子は .png か .jpg です"
            )))
        }
    }
}

enum Kind {
    Png,
    Jpeg,
}

fn kind(sheet: &Path) -> Option<Kind> {
    let ending = sheet.extension()?.to_string_lossy().to_lowercase();
    match &*ending {
        "png" => Some(Kind::Png),
        "jpg" | "jpeg" => Some(Kind::Jpeg),
        _ => None,
    }
}

impl Build {
    /// Replaces each job by one per variant, named after its seed.
    pub(super) fn each_variant(&self, jobs: Vec<Job>) -> Result<Vec<Job>, Stop> {
        let Some(count) = self.variants else {
            return Ok(jobs);
        };
        let first = self.reading.first_seed();
        let last = first.wrapping_add(u64::from(count.get() - 1));
        let digits = last.max(first).to_string().len();
        let several = jobs.into_iter().flat_map(|job| {
            (0..count.get()).map(move |number| {
                let seed = first.wrapping_add(u64::from(number));
                let stem = job.output.file_stem().unwrap_or_default().to_string_lossy();
                let name = format!("{stem}-{seed:0digits$}.{}", job.model.ending());
                Job {
                    inputs: job.inputs.clone(),
                    output: job.output.with_file_name(name),
                    model: job.model,
                    seed: Some(seed),
                }
            })
        });
        Ok(several.collect())
    }

    /// Draws all variants into one image. `tell` prints the diagnostics, for runs that build no model.
    pub(super) fn contact_sheet(&self, path: &Path, tell: bool, language: Language) -> Outcome {
        let mut out = Diagnostics::new();
        let limits = self.reading.limits();
        let inputs = Inputs::read(&self.reading.inputs, limits.bytes, &mut out)?;
        let world = self.reading.world(&self.reading.inputs);
        let options = self.options(None, &inputs, &mut out)?;
        let made = driver::compile(&inputs.accepted(), &world, &options, &mut out);
        let list = out.into_sorted();
        let spoiled = list.iter().any(|d| self.reading.spoils(d.severity));
        if tell && !list.is_empty() {
            let sources = inputs.and(made.included);
            let report_ = Report::new(&sources, &list).in_language(language);
            report(&report_, Format::Human, &mut io::stderr())?;
        }
        if spoiled {
            return Ok(exit(true));
        }
        let drawn = sheet::sheet(&made.scene, &made.building.houses);
        let bytes = match kind(path) {
            Some(Kind::Png) => texture::png(DynamicImage::ImageRgb8(drawn), true),
            _ => texture::jpeg(&drawn, QUALITY),
        };
        output::write(path, Files::bytes(bytes))?;
        if !self.quiet {
            let shown = path.display();
            let said = text!("wrote {shown}", "{shown} を書きました");
            writeln!(io::stderr(), "{}", said.in_language(language))?;
        }
        Ok(Exit::Done)
    }
}
