//! The files of a piece of ground.

use super::make::{FOLDER, Files, MadeTile, TileImages};
use super::record::TileRecord;
use super::terrain::{Cell, Patch};
use crate::Plan;
use hsd_base::source::Source;
use hsd_export::gltf::{FeatureRow, TileWriter};
use hsd_export::images::Library;
use hsd_mesh::{GroundMesh, SceneBuilder, ground};
use hsd_scene::Detail;

/// Returns what the table tells of a piece: the layers of heights and where they come from.
pub(super) fn row((plan, source): (&Plan, &Source), (east, north): Cell) -> FeatureRow {
    let layers = || plan.ground.layers().iter().map(|ground| &ground.layer);
    let joined = |words: Vec<&str>| words.join(", ");
    let evidence = layers().filter_map(|layer| layer.evidence.as_ref());
    let line = layers()
        .next()
        .map_or(0, |layer| source.line_column(layer.span).0);
    FeatureRow {
        key: format!("{east}_{north}"),
        layer: joined(layers().map(|layer| &*layer.name.value).collect()),
        kind: "ground".to_owned(),
        year: String::new(),
        evidence: joined(evidence.map(|text| &*text.value).collect()),
        parameters: String::new(),
        rule: 0,
        line: line as u32,
    }
}

/// Makes the files of a piece at each level of detail, given from far to near; a level that is no coarser than the next is left
/// out. Their arrays may be packed.
pub(super) fn make(
    patch: &Patch,
    row: FeatureRow,
    hash: &str,
    (levels, packed): (&[Detail], bool),
) -> MadeTile {
    let stem = patch.name();
    let meshes: Vec<GroundMesh> = levels
        .iter()
        .map(|detail| patch.mesh(detail.ground_tolerance()))
        .collect();
    let rows = [row];
    // Its images are the program's own.
    let library = Library::default();
    let shown = TileImages(&library);
    let mut files = Files::default();
    for (number, (detail, mesh)) in levels.iter().zip(&meshes).enumerate() {
        if meshes.get(number + 1) == Some(mesh) || mesh.indices.is_empty() {
            continue;
        }
        let centre = patch.centre();
        let mut scene = SceneBuilder::new(*detail).without_relief();
        scene.add(ground(&stem, centre, mesh));
        let scene = scene.finish(vec![]);
        // With normals, whatever the level: a slope is to look smooth.
        let mut writer = TileWriter::packed(Detail::Flat, centre, packed);
        writer.add(scene.whole(), 0, &shown);
        if let Some(content) = writer.content((&scene.materials, &[]), &shown, &rows, FOLDER) {
            files.add(
                format!("tiles/{stem}-{hash}-{}.glb", *detail as u8),
                *detail,
                content,
            );
        }
    }
    files.finish(TileRecord {
        tile: stem,
        inputs: hash.to_owned(),
        ..TileRecord::default()
    })
}
