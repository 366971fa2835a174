//! A town as scenes, one for each tile and each piece of its ground: for back ends that write a file a tile.

use super::input::{TileSalt, evaluate};
use super::make::lost_houses;
use super::mesh::tiles;
use super::run::TileJob;
use super::terrain;
use crate::decision::problems;
use crate::stream::Ledger;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::Source;
use hsd_driver::TileDriver;
use hsd_export::images::Library;
use hsd_mesh::{SceneBuilder, ground};
use hsd_scene::{Detail, Scene};
use std::io;

/// Receives the name of a tile, its scene and the images of that.
pub type Take<'t> = dyn FnMut(&str, &Scene, &Library) -> io::Result<()> + 't;

/// Makes a town at a level of detail, tile by tile, then its ground, piece by piece; tiles without houses are left out.
/// `progress` is called with the number of features of each.
///
/// # Errors
/// Those of `take`, and the one that ended the houses.
pub fn scenes(
    job: TileJob<'_>,
    detail: Detail,
    (take, progress): (&mut Take<'_>, &dyn Fn(usize)),
    out: &mut Diagnostics,
) -> io::Result<(Ledger, Vec<Source>)> {
    let (input, details) = (job.input, [detail]);
    let of_world = (input.world, input.options);
    let driver = TileDriver::new(input.source, job.catalog, of_world, &details);
    let salt = TileSalt::new(input, (&details, false), (job.parts, job.written));
    let mut ledger = Ledger::new(job.spool)?;
    for tile in tiles(job.plan, job.division) {
        let mut made = evaluate(&tile, (job.plan, input), job.year, &salt)?;
        let houses = std::mem::take(&mut made.houses);
        if houses.is_empty() {
            ledger.add(made.chunk)?;
            progress(tile.features());
            continue;
        }
        let mut found = Diagnostics::new();
        let houses = driver.houses(houses, &mut found)?;
        let level = driver.level(&houses, detail, &mut found);
        let missing = [level.left_out.clone()];
        let lost = lost_houses(&houses.left_out, &missing);
        ledger.add_without(made.chunk, &lost)?;
        ledger.report.corrected.extend(problems(&found));
        out.append(found);
        take(&tile.key.stem(), &level.scene, &level.library)?;
        progress(tile.features());
    }
    for (patch, mesh) in terrain::meshes(job.plan, detail)? {
        let mut scene = SceneBuilder::new(detail);
        scene.add(ground(&patch.name(), patch.centre(), &mesh));
        take(&patch.name(), &scene.finish(vec![]), &Library::default())?;
    }
    ledger.finish(job.plan, out)
}
