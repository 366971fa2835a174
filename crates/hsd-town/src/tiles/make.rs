//! Makes the files of a tile.

use super::input::TileInput;
use super::mesh::Tile;
use super::record::{LevelRecord, MM, TextureRecord, TileRecord};
use crate::decision::{LostHouse, problems};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::World;
use hsd_driver::{LeftOut, TileDriver};
#[cfg(feature = "compress")]
use hsd_export::gltf::Ktx2;
use hsd_export::gltf::{SpareArrays, TileContent, TileWriter, graphics_bytes};
use hsd_export::images::Library;
use hsd_export::pieces::Pieces;
use hsd_export::{Images, OutFile, PictureBytes, SurfaceFiles};
use hsd_scene::{Detail, ScenePart};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use twox_hash::XxHash3_128;

/// The folder of images, as tiles name it.
pub(super) const FOLDER: &str = "../textures";

/// A tile that has been made.
#[derive(Debug)]
pub struct MadeTile {
    /// What is known of it.
    pub record: TileRecord,
    /// Its files, those that others name first.
    pub files: Vec<(String, Pieces)>,
    /// Its diagnostics.
    pub found: Diagnostics,
}

/// Makes the files of a tile at each level of detail, given from far to near, in the memory of arrays that are spare; they may
/// be packed.
///
/// # Errors
/// The one that ended its houses.
pub fn make(
    driver: &TileDriver<'_>,
    tile: &Tile,
    input: TileInput,
    (levels, packed): (&[Detail], bool),
    (world, spare): (&dyn World, &SpareArrays),
) -> io::Result<MadeTile> {
    let mut found = Diagnostics::new();
    let (row_of, rows, hash) = (input.row_of, input.rows, input.hash);
    let centre = input.centre;
    let made = driver.houses(input.houses, &mut found)?;
    let (mut files, mut missing) = (Files::default(), vec![]);
    for detail in levels {
        let mut writer = TileWriter::over(spare, *detail, centre, packed);
        let mut take = |number: usize, part: ScenePart<'_>| {
            writer.add(part, row_of[number], &TileImages(&made.library));
        };
        let looks = driver.hand_on(&made, *detail, &mut take, &mut found);
        missing.push(looks.left_out.clone());
        let plain = TileImages(&looks.library);
        #[cfg(feature = "compress")]
        let small = packed.then(|| Ktx2::of_tile(&looks.materials, &plain, *detail > Detail::Flat));
        #[cfg(not(feature = "compress"))]
        let small: Option<TileImages<'_>> = None;
        let shown: &dyn Images = match &small {
            Some(small) => small,
            None => &plain,
        };
        let looks = (&*looks.materials, &*looks.grown);
        let content = writer.content(looks, shown, &rows, FOLDER);
        if let Some(content) = content {
            let name = format!("tiles/{}-{hash}-{}.glb", tile.key.stem(), *detail as u8);
            files.add(name, *detail, content);
        }
    }
    let lost = left_everywhere(&made.left_out, &missing);
    let known = TileRecord {
        tile: tile.key.stem(),
        inputs: hash,
        houses: row_of.len() - lost.len(),
        pictures: picture_hashes(&made.pictures, world),
        left_out: lost
            .into_iter()
            .map(|(number, left)| {
                let lost = LostHouse::from(left);
                (number, lost.code, lost.reason)
            })
            .collect(),
        corrected: problems(&found),
        ..TileRecord::default()
    };
    Ok(MadeTile {
        found,
        ..files.finish(known)
    })
}

/// Returns the houses of which no level shows anything, since each would exceed a limit, by number.
fn left_everywhere<'l>(
    made: &'l BTreeMap<usize, LeftOut>,
    levels: &'l [BTreeMap<usize, LeftOut>],
) -> BTreeMap<usize, &'l LeftOut> {
    let first = levels.first().into_iter().flatten();
    let everywhere = first.filter(|(n, _)| levels.iter().all(|level| level.contains_key(n)));
    let all = made.iter().chain(everywhere);
    all.map(|(number, left)| (*number, left)).collect()
}

/// Returns the same for the ledger.
pub(super) fn lost_houses(
    made: &BTreeMap<usize, LeftOut>,
    levels: &[BTreeMap<usize, LeftOut>],
) -> Vec<LostHouse> {
    let all = left_everywhere(made, levels).into_values();
    all.map(LostHouse::from).collect()
}

/// The files of a tile so far.
#[derive(Default)]
pub(super) struct Files {
    levels: Vec<LevelRecord>,
    contents: Vec<(String, Pieces)>,
    /// The images of all levels, and the same with their bytes.
    textures: Vec<TextureRecord>,
    images: Vec<(String, Pieces)>,
}

impl Files {
    /// Returns the tile of these files, of which the rest is known.
    pub(super) fn finish(self, known: TileRecord) -> MadeTile {
        MadeTile {
            record: TileRecord {
                levels: self.levels,
                textures: self.textures,
                ..known
            },
            files: self.images.into_iter().chain(self.contents).collect(),
            found: Diagnostics::new(),
        }
    }

    /// Adds a level.
    pub(super) fn add(&mut self, file: String, detail: Detail, content: TileContent<'_>) {
        let [low, high] = content.bounds;
        let image = |texture: OutFile<'_>| {
            let file = texture.name.trim_start_matches("../").to_owned();
            let known = self.textures.iter().position(|t| t.file == file);
            known.unwrap_or_else(|| {
                self.textures.push(TextureRecord {
                    file: file.clone(),
                    graphics: graphics_bytes(&texture.bytes),
                });
                self.images.push((file, texture.bytes.into_owned().into()));
                self.textures.len() - 1
            })
        };
        self.levels.push(LevelRecord {
            detail: detail as u8,
            file: file.clone(),
            bytes: content.glb.len() as u64,
            triangles: content.triangles,
            arrays: content.arrays as u64,
            low: (low * MM).floor().to_array().map(|x| x as i64),
            high: (high * MM).ceil().to_array().map(|x| x as i64),
            textures: content.textures.into_iter().map(image).collect(),
        });
        self.contents.push((file, content.glb));
    }
}

/// Returns the paths of images with the hashes of their bytes.
fn picture_hashes(paths: &[String], world: &dyn World) -> Vec<(String, String)> {
    let hash = |path: &String| (path.clone(), picture_hash(path, world));
    paths.iter().map(hash).collect()
}

/// Returns the hash of an image; empty if it cannot be read.
pub fn picture_hash(path: &str, world: &dyn World) -> String {
    let bytes = world.picture_bytes(path);
    bytes.map_or(String::new(), |bytes| named_by(&bytes))
}

/// Returns a name for some bytes.
fn named_by(bytes: &[u8]) -> String {
    format!("{:016x}", XxHash3_128::oneshot(bytes) as u64)
}

/// The images of a tile under names that are the same in all tiles of a town: those of surfaces have their own, others that
/// of their content. Pages of joinery have no relief, which is nothing from where they are shown.
pub(super) struct TileImages<'a>(pub(super) &'a Library);

impl TileImages<'_> {
    fn named<'p>(picture: PictureBytes<'p>) -> PictureBytes<'p> {
        let (stem, extension) = picture.name.rsplit_once('.').unwrap_or((&picture.name, ""));
        let stem = stem.split('_').next().unwrap_or_default();
        let name = format!("{stem}-{}.{extension}", named_by(picture.bytes));
        PictureBytes {
            name: Cow::Owned(name),
            bytes: picture.bytes,
        }
    }
}

impl Images for TileImages<'_> {
    fn files(&self, look: &str) -> Option<SurfaceFiles<'_>> {
        self.0.files(look)
    }

    fn picture(&self, index: u32) -> Option<PictureBytes<'_>> {
        self.0.picture(index).map(TileImages::named)
    }

    fn baked(&self, index: u32) -> Option<SurfaceFiles<'_>> {
        let page = self.0.baked(index)?;
        Some(SurfaceFiles {
            color: TileImages::named(page.color),
            normal: None,
            orm: None,
            ..page
        })
    }
}
