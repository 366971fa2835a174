//! Options of single formats: how a `.glb` or `.gltf` is divided, and how an `.stl` is printed.

use super::Job;
use crate::Failure;
use crate::files::output::Model;
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::text;
use hsd_export::spool::in_memory;
use hsd_export::stl::{self, Print, ThinBodies};
use hsd_passes::messages::pictures::thin_bodies;
use hsd_scene::ScenePart;
use std::io;

/// The options of formats.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct FormatArgs {
    /// Merge each house of a .glb or .gltf into one mesh: for game engines, which draw each mesh and material by itself.
    ///
    /// Nodes of houses stay, with their extras; storeys, walls and parts have no nodes any more, so their extras (codes,
    /// lines, names) are lost. Shapes that many parts shared are written for each of them: the file grows.
    #[arg(long, value_enum, value_name = "BY", conflicts_with_all = ["compress", "join"])]
    pub(super) merge: Option<Merge>,

    /// Leave tangents out of a .glb or .gltf: a third of the vertices of surfaces with relief.
    ///
    /// Programs that show relief compute them then.
    #[arg(long, conflicts_with_all = ["compress", "join"])]
    pub(super) no_tangents: bool,

    /// Write normals and tangents of a .glb or .gltf as bytes (KHR_mesh_quantization): their vertices take about 40 % less.
    ///
    /// Directions are at most 0.4 degrees off. Positions stay exact. Programs must know the extension; Blender, three.js,
    /// Babylon.js and CesiumJS do.
    #[arg(long, conflicts_with_all = ["compress", "join"])]
    pub(super) quantize: bool,

    /// Print an .stl to this scale, as 1:100 or 1/100.
    #[arg(long, value_name = "1:N", value_parser = scale)]
    scale: Option<f64>,

    /// Warn of bodies of an .stl thinner than this in the model, millimetres [default: 0.4].
    ///
    /// A front without a back (joinery at details 1 and 2, walls at detail 0) becomes at least as thick. Every body is closed;
    /// bodies overlap and are not united, which slicers do.
    #[arg(long, value_name = "MM", value_parser = thickness)]
    min_wall: Option<f64>,
}

/// How houses are merged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Merge {
    /// One mesh for each house, with a primitive for each material.
    Material,
}

impl FormatArgs {
    /// Fails if an option is given that the format of a model does not have.
    pub(super) fn check(&self, job: &Job) -> Result<(), Failure> {
        let nodes = matches!(job.model, Model::Glb | Model::Gltf);
        if (self.merge.is_some() || self.no_tangents || self.quantize) && !nodes {
            return Err(Failure::Usage(text!(
                "--merge, --no-tangents and --quantize are for .glb and .gltf",
                "--merge、--no-tangents、--quantize は .glb と .gltf のためのものです"
            )));
        }
        if (self.scale.is_some() || self.min_wall.is_some()) && job.model != Model::Stl {
            return Err(Failure::Usage(text!(
                "--scale and --min-wall are for .stl; the other formats are in metres",
                "--scale と --min-wall は .stl のためのものです。ほかの形式はメートル単位です"
            )));
        }
        Ok(())
    }

    /// Returns true if a model needs meshes of its own for each house.
    pub(super) fn has_own_meshes(&self, model: Model) -> bool {
        self.merge.is_some() || matches!(model, Model::Obj | Model::Stl)
    }

    /// Returns how an `.stl` is printed.
    pub(super) fn print(&self) -> Print {
        let usual = Print::default();
        Print {
            scale: self.scale.unwrap_or(usual.scale),
            min_wall: self.min_wall.unwrap_or(usual.min_wall),
        }
    }

    /// Reports bodies of a scene that are too thin.
    pub(super) fn print_scene(
        &self,
        scene: ScenePart<'_>,
        out: &mut Diagnostics,
    ) -> io::Result<()> {
        let mut printed = stl::Writer::new(self.print(), &in_memory)?;
        printed.add(scene)?;
        self.report_thin(printed.thin(), out);
        Ok(())
    }

    /// Reports bodies that are too thin.
    pub(super) fn report_thin(&self, bodies: &ThinBodies, out: &mut Diagnostics) {
        if let Some((least, name, span)) = &bodies.thinnest {
            let place = span.unwrap_or_default();
            let counts = (bodies.thin, bodies.all);
            let min_wall = self.print().min_wall;
            out.push(thin_bodies(place, counts, min_wall, (*least, name)));
        }
    }
}

/// Parses a scale: the length in reality of one unit of the model.
fn scale(text: &str) -> Result<f64, &'static str> {
    let wrong = "expected a scale, as in 1:100 or 1/100";
    let (model, real) = text.split_once([':', '/']).ok_or(wrong)?;
    let number = |t: &str| {
        t.trim()
            .parse()
            .ok()
            .filter(|x: &f64| (1e-6..1e9).contains(x))
    };
    match (number(model), number(real)) {
        (Some(model), Some(real)) => Ok(real / model),
        _ => Err(wrong),
    }
}

/// Parses a thickness in millimetres.
fn thickness(text: &str) -> Result<f64, &'static str> {
    let number = text.trim().parse().ok();
    let sound = number.filter(|x: &f64| (0.0..=1000.0).contains(x));
    sound.ok_or("expected millimetres, as in 0.4")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_read_in_both_forms() {
        assert_eq!(scale("1:100"), Ok(100.0));
        assert_eq!(scale("1/87"), Ok(87.0));
        assert_eq!(scale("2 : 1"), Ok(0.5));
        for wrong in ["100", "1:0", "0:1", "1:x", "1:inf", "-1:5"] {
            assert!(scale(wrong).is_err(), "{wrong}");
        }
    }
}
