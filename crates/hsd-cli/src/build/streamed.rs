//! `hsd build` of a model without variants, bakes or compression: houses go to the file as they are made, so that a town
//! of any size can be built.

use super::progress::Progress;
use super::statistics::{statistics, summary};
use super::{Build, Job};
use crate::Failure;
use crate::files::input::{Inputs, STDIN};
use crate::files::output::{Committer, Files, Model, folder_of};
use hsd_base::diagnostic::Diagnostics;
use hsd_driver::{Feed, Streamed};
use hsd_export::images::Library;
use hsd_export::spool::{NewSpool, Spool};
use hsd_export::{gltf, obj, stl};
use hsd_scene::{Material, Provenance, Scene, ScenePart};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tempfile::{SpooledTempFile, spooled_tempfile_in};

/// The bytes of a list or array that stay in memory; what is larger goes to a file.
const IN_MEMORY: usize = 256 << 10;

/// Bytes by kind.
type Sizes = Vec<(&'static str, u64)>;

impl Build {
    /// True if the model of a job is written house by house. Others need the whole scene.
    pub(super) fn streams(&self, job: &Job) -> bool {
        let variants = self.variants.is_some() && job.seed.is_none();
        !variants && !self.compress && !self.bake_args.bake
    }

    /// Runs one job; returns whether its source files have errors.
    pub(super) fn stream(
        &self,
        (job, committer): (&Job, &Committer),
        progress: &Progress,
    ) -> Result<bool, Failure> {
        let start = Instant::now();
        let mut out = Diagnostics::new();
        let limits = self.input_args.limits();
        let inputs = Inputs::in_pieces(&job.inputs, &limits, &mut out)?;
        let world = self.input_args.world(&job.inputs);
        let world = world.recorded_in(&committer.inputs);
        let options = hsd_driver::Options {
            own_meshes: self.join || self.format_args.has_own_meshes(job.model),
            ..self.options(job.seed, &inputs, &mut out)?
        };
        let folder = spool_folder(&job.output);
        let new = || spool(&folder);
        let failed = |error| Failure::at(job.output.display(), error);
        let mut model = Started::new(job.model, self, &new).map_err(failed)?;
        let accepted = inputs.accepted();
        let mut town = hsd_driver::stream(
            Feed {
                sources: &accepted,
                long: &inputs.long,
            },
            &world,
            &options,
            &mut out,
            (&mut |part, images| model.add(part, images), &new),
        )
        .map_err(failed)?;
        if let Started::Stl(printed) = &model {
            self.format_args.report_thin(printed.thin(), &mut out);
        }
        let list = out.into_sorted();
        let included = std::mem::take(&mut town.included);
        let read = job.files_read(&included, &town.pictures);
        let told = progress.report(&inputs.shown(included, &list)?, &list)?;
        if list.iter().any(|d| self.input_args.spoils(d.severity)) {
            progress.teller.built(&told, None, &read)?;
            return Ok(true);
        }
        let mut times = std::mem::take(&mut town.times);
        let (size, sizes) = hsd_driver::timed(&mut times, "write", || {
            self.write_town(model, &town, (job, committer))
        })?;
        progress.teller.built(&told, Some(&job.output), &read)?;
        if progress.verbose || self.stats {
            let counts = (town.houses, town.stats.triangles);
            progress.line(&summary(&job.output, counts, size, start.elapsed()))?;
        }
        if self.stats {
            let counts = (town.stats, town.materials.len());
            progress.line(&statistics(counts, &sizes, &times))?;
        }
        Ok(false)
    }

    /// Writes a model whose houses are all there; returns its bytes, in all and by kind.
    fn write_town(
        &self,
        model: Started<'_>,
        town: &Streamed,
        (job, committer): (&Job, &Committer),
    ) -> Result<(u64, Sizes), Failure> {
        let made = Finished::town(town);
        let files = model.finish(made, &job.output, self.textures_beside);
        let files = files.map_err(|error| Failure::at(job.output.display(), error))?;
        let sizes = files.sizes();
        let size = committer.write(&job.output, files)?;
        Ok((size, sizes))
    }
}

/// The inputs of a model that are known once all its houses are added.
pub(super) struct Finished<'t> {
    pub(super) materials: &'t [Material],
    pub(super) library: &'t Library,
    /// The factors by which distances from the upper edge of each baked page have grown; none of a whole scene.
    pub(super) grown: &'t [f32],
    pub(super) provenance: &'t Provenance,
}

impl<'t> Finished<'t> {
    /// Returns what is left of a streamed run.
    fn town(town: &'t Streamed) -> Finished<'t> {
        Finished {
            materials: &town.materials,
            library: &town.library,
            grown: &town.grown,
            provenance: &town.provenance,
        }
    }

    /// Returns what is known of a whole scene.
    pub(super) fn scene(scene: &'t Scene, library: &'t Library) -> Finished<'t> {
        Finished {
            materials: &scene.materials,
            library,
            grown: &[],
            provenance: &scene.provenance,
        }
    }
}

/// A model that takes houses one after another.
pub(super) enum Started<'n> {
    Glb(gltf::Writer<'n>),
    Gltf(gltf::Writer<'n>),
    Obj(obj::Writer),
    Stl(stl::Writer),
}

impl<'n> Started<'n> {
    pub(super) fn new(model: Model, build: &Build, new: NewSpool<'n>) -> io::Result<Started<'n>> {
        let format = &build.format_args;
        let nodes = || {
            let writer = gltf::Writer::new(new)?.joining(build.join);
            let writer = writer.merging(format.merge.is_some());
            let writer = writer.quantizing(format.quantize);
            Ok::<_, io::Error>(writer.without_tangents(format.no_tangents))
        };
        Ok(match model {
            Model::Glb => Started::Glb(nodes()?),
            Model::Gltf => Started::Gltf(nodes()?),
            Model::Obj => Started::Obj(obj::Writer::new(new)?),
            Model::Stl => Started::Stl(stl::Writer::new(format.print(), new)?),
        })
    }

    pub(super) fn add(&mut self, part: ScenePart<'_>, images: &Library) -> io::Result<()> {
        match self {
            Started::Glb(writer) | Started::Gltf(writer) => writer.add(part, images),
            Started::Obj(writer) => writer.add(part, images),
            Started::Stl(writer) => writer.add(part),
        }
    }

    /// Returns the files of a model whose houses are all there.
    pub(super) fn finish<'t>(
        mut self,
        made: Finished<'t>,
        output: &Path,
        beside: bool,
    ) -> io::Result<Files<'t>> {
        let Finished {
            materials,
            library: images,
            grown,
            provenance,
        } = made;
        let stem = output.file_stem().unwrap_or_default().to_string_lossy();
        if let Started::Glb(writer) | Started::Gltf(writer) = &mut self {
            writer.made_from(provenance);
        }
        Ok(match self {
            Started::Glb(writer) if beside => {
                let (glb, beside) = writer.glb_beside(materials, images, grown, &stem)?;
                Files::glb_beside(glb, beside)
            }
            Started::Glb(writer) => Files::glb(writer.glb(materials, images, grown)?),
            Started::Gltf(writer) => Files::gltf(writer.gltf(materials, images, grown, &stem)?),
            Started::Obj(writer) => Files::obj(writer.finish(materials, images, grown, &stem)),
            Started::Stl(writer) => Files::stl(writer),
        })
    }
}

/// Returns a list or array of a model that is written as it grows.
pub(crate) fn spool(folder: &Path) -> io::Result<Box<dyn Spool>> {
    let spool: SpooledTempFile = spooled_tempfile_in(IN_MEMORY, folder);
    Ok(Box::new(spool))
}

/// Returns the folder of spools: that of the output, where there is room for the model.
pub(super) fn spool_folder(output: &Path) -> PathBuf {
    let folder = folder_of(output);
    match output.as_os_str() == STDIN || !folder.is_dir() {
        true => std::env::temp_dir(),
        false => folder.to_owned(),
    }
}
