//! `hsd build --bake`: reflections of glass baked into textures, for viewers that cannot draw reflections.

use clap::Args;
use glam::DVec3;
use hsd_export::images::Library;
use hsd_render::mirror;
use hsd_render::mirror::BakeOptions;
use hsd_scene::Scene;

/// The options of `--bake`.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct BakeArgs {
    /// Bake reflections of houses and sky into the glass of facades with `reflection`, for viewers that cannot draw
    /// reflections.
    ///
    /// The result is correct for a single viewpoint: 1.6 m above the street in front of the centre of the glass, far
    /// enough away to see all of it within 60 degrees but not beyond the building opposite.
    #[arg(long)]
    pub(super) bake: bool,

    /// Set the viewpoint of --bake in metres east, north and up.
    ///
    /// Glass that faces away from it keeps its default viewpoint.
    #[arg(long, value_name = "E,N,U", requires = "bake", value_parser = point, allow_hyphen_values = true)]
    bake_eye: Option<DVec3>,

    /// Limit the longer side of baked images to this many pixels.
    ///
    /// The resolution never exceeds 48 pixels per metre.
    #[arg(long, value_name = "PIXELS", requires = "bake", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=4096))]
    bake_size: u32,
}

impl BakeArgs {
    /// Bakes the reflections if `--bake` was given.
    pub(super) fn run(&self, scene: &mut Scene, library: &mut Library) {
        if self.bake {
            let options = BakeOptions {
                eye: self.bake_eye,
                longest: self.bake_size,
            };
            mirror::bake(scene, options, &|number| library.pixels(number));
            library.mirror(&scene.mirrored);
        }
    }
}

/// Parses three comma-separated numbers.
fn point(text: &str) -> Result<DVec3, &'static str> {
    let number = |t: &str| t.trim().parse().ok().filter(|x: &f64| x.abs() < 1e6);
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    let numbers = numbers.and_then(|n| <[f64; 3]>::try_from(n).ok());
    numbers
        .map(DVec3::from_array)
        .ok_or("expected three numbers, as in 0,-8,1.6")
}
