//! `hsd build --variants`: one model per variant, and the contact sheet.

use super::{Build, Job};
use crate::files::input::Inputs;
use crate::files::output::{Committer, Files};
use crate::options::{exit, report};
use crate::{Exit, Failure, Outcome};
use hsd_base::diagnostic::{Diagnostics, Language};
use hsd_base::text;
use hsd_render::sheet;
use hsd_report::{Format, Report};
use hsd_scene::texture;
use image::RgbImage;
use std::io::{self, Write};
use std::num::NonZeroU32;
use std::path::Path;

/// The JPEG quality of a contact sheet.
const QUALITY: u8 = 88;

/// The maximum number of variants in a contact sheet; larger images fail to open in most viewers.
const MOST: u32 = 2500;

/// Fails if the format is not supported or there are too many variants.
pub(super) fn check_sheet(sheet: &Path, variants: Option<NonZeroU32>) -> Result<(), Failure> {
    if variants.is_some_and(|count| count.get() > MOST) {
        let most = MOST;
        return Err(Failure::Usage(text!([most]
            "a contact sheet can show at most {most} variants",
            "一覧画像に並べられる変種は {most} 件までです"
        )));
    }
    match format_of(sheet) {
        Some(_) => Ok(()),
        None => {
            let shown = sheet.display();
            Err(Failure::Usage(text!([shown]
                "{shown}: the extension of a contact sheet must be .png or .jpg",
                "{shown}: 一覧画像の拡張子は .png か .jpg です"
            )))
        }
    }
}

enum SheetFormat {
    Png,
    Jpeg,
}

fn format_of(sheet: &Path) -> Option<SheetFormat> {
    let extension = sheet.extension()?.to_string_lossy().to_lowercase();
    match &*extension {
        "png" => Some(SheetFormat::Png),
        "jpg" | "jpeg" => Some(SheetFormat::Jpeg),
        _ => None,
    }
}

impl Build {
    /// Replaces each job by one per variant, named after its seed.
    pub(super) fn each_variant(&self, jobs: Vec<Job>) -> Result<Vec<Job>, Failure> {
        let Some(count) = self.variants else {
            return Ok(jobs);
        };
        let most = self.input_args.limits().variants;
        if count.get() > most {
            return Err(Failure::Usage(text!([most]
                "more than {most} variants; raise the limit with `--max-variants`",
                "変種が {most} 件を超えます。`--max-variants` で上限を上げてください"
            )));
        }
        let first = self.input_args.first_seed();
        let last = first.wrapping_add(u64::from(count.get() - 1));
        let digits = last.max(first).to_string().len();
        let several = jobs.into_iter().flat_map(|job| {
            (0..count.get()).map(move |number| {
                let seed = first.wrapping_add(u64::from(number));
                let stem = job.output.file_stem().unwrap_or_default().to_string_lossy();
                let name = format!("{stem}-{seed:0digits$}.{}", job.model.extension());
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
    pub(super) fn contact_sheet(
        &self,
        (path, committer): (&Path, &Committer),
        tell: bool,
        language: Language,
    ) -> Outcome {
        let mut out = Diagnostics::new();
        let limits = self.input_args.limits();
        let inputs = Inputs::read(&self.input_args.inputs, limits.bytes, &mut out)?;
        let world = self.input_args.world(&self.input_args.inputs);
        let world = world.recorded_in(&committer.inputs);
        let options = self.options(None, &inputs, &mut out)?;
        let made = hsd_driver::compile(&inputs.accepted(), &world, &options, &mut out);
        let list = out.into_sorted();
        let spoiled = list.iter().any(|d| self.input_args.spoils(d.severity));
        if tell && !list.is_empty() {
            let sources = inputs.and(made.included);
            let written = Report::new(&sources, &list).in_language(language);
            report(&written, Format::Human, &mut io::stderr())?;
        }
        if spoiled {
            return Ok(exit(true));
        }
        let drawn = sheet::sheet(
            &made.scene,
            &sheet::variants(&made.scene, &made.building.houses),
        );
        let committer = committer.named_by("--sheet");
        write_sheet((path, &committer), drawn, self.quiet, language)?;
        Ok(Exit::Done)
    }
}

/// Writes a contact sheet in the format of its extension.
pub(super) fn write_sheet(
    (path, committer): (&Path, &Committer),
    drawn: RgbImage,
    quiet: bool,
    language: Language,
) -> Result<(), Failure> {
    let bytes = match format_of(path) {
        Some(SheetFormat::Png) => texture::png(&drawn, texture::Packing::Tight),
        _ => texture::jpeg(&drawn, QUALITY),
    };
    committer.write(path, Files::bytes(bytes))?;
    if !quiet {
        let shown = path.display();
        let message = text!([shown] "wrote {shown}", "{shown} を書きました");
        writeln!(io::stderr(), "{}", message.in_language(language))?;
    }
    Ok(())
}
