//! `hsd build --bake`: what glass mirrors, as pictures for viewers that know no mirrors.

use crate::backend::images::Library;
use crate::render::mirror;
use crate::render::mirror::Wishes;
use crate::scene::Scene;
use clap::Args;
use glam::DVec3;

/// The options of `--bake`.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct Baking {
    /// Draw what the glass of each facade with `reflection` mirrors of houses and sky, for viewers that know no mirrors.
    ///
    /// It is right for one eye: somebody 1.6 m tall in the street before the middle of the glass, so far away that
    /// all of it is seen within 60 degrees, but on this side of what stands opposite.
    #[arg(long)]
    pub(super) bake: bool,

    /// Where the eye of --bake stands: metres to the east, to the north and up. Glass that turns its back on it keeps
    /// an eye of its own.
    #[arg(long, value_name = "E,N,U", requires = "bake", value_parser = point, allow_hyphen_values = true)]
    bake_eye: Option<DVec3>,

    /// Most pixels of the longer side of a picture of --bake; 48 a metre are enough.
    #[arg(long, value_name = "PIXELS", requires = "bake", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=4096))]
    bake_size: u32,
}

impl Baking {
    /// Draws the pictures, if they are wished for.
    pub(super) fn run(&self, scene: &mut Scene, library: &mut Library) {
        if self.bake {
            let wishes = Wishes {
                eye: self.bake_eye,
                longest: self.bake_size,
            };
            mirror::bake(scene, wishes, &|number| library.pixels(number));
            library.mirror(&scene.mirrored);
        }
    }
}

/// Three numbers with commas between them.
fn point(text: &str) -> Result<DVec3, &'static str> {
    let number = |t: &str| t.trim().parse().ok().filter(|x: &f64| x.abs() < 1e6);
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    let numbers = numbers.and_then(|n| <[f64; 3]>::try_from(n).ok());
    numbers
        .map(DVec3::from_array)
        .ok_or("three numbers, as in 0,-8,1.6")
}
