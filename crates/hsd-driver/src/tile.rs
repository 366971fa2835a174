//! The houses of a tile: made once, and shown at each level of detail. A tile is small, so its houses are kept while its
//! levels are made; what they look like is made some houses at a time.

use super::Options;
use super::house::{Expansion, FeatureHouse, LeftOut, OnFeature};
use super::models::{not_shown, use_by};
use super::plainer::plainer;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Source, World};
use hsd_export::images::Library;
use hsd_export::sound;
use hsd_ir::building::Built;
use hsd_ir::catalog::Catalog;
use hsd_ir::program::PictureId;
use hsd_mesh::{SceneBuilder, Tessellator};
use hsd_passes::messages::pictures as say;
use hsd_scene::{Detail, Material, Scene, ScenePart};
use std::collections::BTreeMap;
use std::ops::Range;
use std::{io, slice};

/// The bytes of meshes that are kept at a time where houses are handed on: about what caches of a processor hold.
const BYTES: usize = 2 << 20;

/// What the tiles of a town have in common.
pub struct TileDriver<'a> {
    source: &'a Source,
    catalog: &'a Catalog,
    world: &'a dyn World,
    options: &'a Options,
    /// One for each level of detail; they share the parts of all tiles.
    tessellators: Vec<(Detail, Tessellator<'a>)>,
}

/// The houses of a tile.
pub struct TileHouses {
    /// In their order; `None` for one that would exceed a limit.
    houses: Vec<(Option<Built>, OnFeature)>,
    /// Those that would, by number.
    pub left_out: BTreeMap<usize, LeftOut>,
    /// The images of their parts.
    pub library: Library,
    /// The paths of these images.
    pub pictures: Vec<String>,
}

/// A level of a tile.
pub struct TileScene {
    /// Its houses.
    pub scene: Scene,
    /// The nodes of each house, by its number in the tile; empty for one that is left out.
    pub houses: Vec<Range<usize>>,
    /// The houses that would have too many triangles, by number.
    pub left_out: BTreeMap<usize, LeftOut>,
    /// The images, with the pages that were baked for this level.
    pub library: Library,
}

/// The materials and images of the houses of a level that have been handed on.
pub struct TileLooks {
    /// Their materials.
    pub materials: Vec<Material>,
    /// The factor by which distances from the upper edge of each baked page have grown.
    pub grown: Vec<f32>,
    /// The houses that would have too many triangles, by number.
    pub left_out: BTreeMap<usize, LeftOut>,
    /// The images, with the pages that were baked for this level.
    pub library: Library,
}

impl TileHouses {
    /// Returns the houses in their order; `None` for one that would exceed a limit.
    pub fn built(&self) -> impl Iterator<Item = Option<&Built>> {
        self.houses.iter().map(|(built, _)| built.as_ref())
    }
}

impl<'a> TileDriver<'a> {
    /// Creates one for a town of these levels of detail.
    pub fn new(
        source: &'a Source,
        catalog: &'a Catalog,
        (world, options): (&'a dyn World, &'a Options),
        levels: &[Detail],
    ) -> TileDriver<'a> {
        let tessellator = |detail: &Detail| {
            let shapes = hsd_mesh::Options {
                detail: *detail,
                town: true,
                ..options.shapes()
            };
            (*detail, Tessellator::new(catalog, shapes))
        };
        TileDriver {
            source,
            catalog,
            world,
            options,
            tessellators: levels.iter().map(tessellator).collect(),
        }
    }

    /// Makes the houses of a tile.
    ///
    /// # Errors
    /// The one that ended the houses.
    pub fn houses(
        &self,
        houses: Vec<FeatureHouse>,
        out: &mut Diagnostics,
    ) -> io::Result<TileHouses> {
        let on = |house: &FeatureHouse| OnFeature {
            feature: house.feature,
            origin: house.origin.clone(),
            name: house.name.clone(),
        };
        let features: Vec<OnFeature> = houses.iter().map(on).collect();
        let mut left_out = BTreeMap::new();
        let (world, options) = (self.world, &self.options.expand);
        let houses = houses.into_iter();
        let mut expansion = Expansion::of_town(houses, self.catalog, self.source, world, options);
        let cache = || self.options.all_roofs();
        let mut made: Vec<Option<Built>> = vec![];
        while let Some(batch) = expansion.batch(usize::MAX) {
            let finished = batch.finish(self.catalog, &cache, |_, houses| houses);
            for house in finished.into_iter().flatten() {
                left_out.extend(house.left_out().map(|left| (made.len(), left)));
                made.push(house.built);
                out.append(house.found);
            }
        }
        let pictures = expansion.into_images()?;
        let mut library = Library::default();
        let limits = &options.limits;
        for (id, picture) in (0..).zip(&pictures) {
            library.add(&picture.path, world, limits.pixels, |error| {
                let uses = |b: &Built| use_by(b, PictureId(id));
                let used = made.iter().flatten().find_map(uses).unwrap_or_default();
                out.push(not_shown(error, &picture.path, used, limits));
            });
        }
        Ok(TileHouses {
            houses: made.into_iter().zip(features).collect(),
            left_out,
            library,
            pictures: pictures.into_iter().map(|p| p.path).collect(),
        })
    }

    /// Returns the houses of a tile at a level of detail.
    pub fn level(&self, made: &TileHouses, detail: Detail, out: &mut Diagnostics) -> TileScene {
        let tessellator = self.tessellator(detail);
        let mut scene = SceneBuilder::new(detail).without_relief();
        let (mut houses, mut left_out) = (vec![], BTreeMap::new());
        for number in 0..made.houses.len() {
            let before = scene.part().nodes.len();
            self.add(
                made,
                number,
                (tessellator, &mut scene),
                (out, &mut left_out),
            );
            houses.push((number, before..scene.part().nodes.len()));
        }
        tell_flaws(made, scene.part(), &houses, out);
        let scene = scene.finish(made.pictures.clone());
        let mut library = made.library.clone();
        library.bake(&scene.baked);
        TileScene {
            scene,
            houses: houses.into_iter().map(|(_, nodes)| nodes).collect(),
            left_out,
            library,
        }
    }

    /// Hands the houses of a tile on at a level of detail, each with its number in the tile, and keeps only some at a time;
    /// returns what they look like.
    pub fn hand_on(
        &self,
        made: &TileHouses,
        detail: Detail,
        take: &mut dyn FnMut(usize, ScenePart<'_>),
        out: &mut Diagnostics,
    ) -> TileLooks {
        let tessellator = self.tessellator(detail);
        let mut scene = SceneBuilder::new(detail).without_relief();
        scene.forget_twins();
        let (mut houses, mut bytes) = (vec![], 0);
        let mut left_out = BTreeMap::new();
        for number in 0..made.houses.len() {
            let before = scene.part().nodes.len();
            let told = (&mut *out, &mut left_out);
            bytes += self.add(made, number, (tessellator, &mut scene), told);
            houses.push((number, before..scene.part().nodes.len()));
            if bytes < BYTES && number + 1 < made.houses.len() {
                continue;
            }
            let part = ScenePart {
                sound: tell_flaws(made, scene.part(), &houses, out),
                ..scene.part()
            };
            for (number, nodes) in houses.drain(..) {
                take(number, part.part(nodes));
            }
            scene.forget();
            bytes = 0;
        }
        let (materials, baked, grown) = scene.into_images();
        let mut library = made.library.clone();
        library.bake(&baked);
        TileLooks {
            materials,
            grown,
            left_out,
            library,
        }
    }

    fn tessellator(&self, detail: Detail) -> &Tessellator<'a> {
        let found = self.tessellators.iter().find(|(own, _)| *own == detail);
        &found.expect("levels are those of the town").1
    }

    /// Adds a house to a scene, plainer if it has too many triangles; returns about how many bytes it takes there.
    fn add(
        &self,
        made: &TileHouses,
        number: usize,
        (tessellator, scene): (&Tessellator<'_>, &mut SceneBuilder),
        (out, left_out): (&mut Diagnostics, &mut BTreeMap<usize, LeftOut>),
    ) -> usize {
        let (Some(built), on) = &made.houses[number] else {
            return 0;
        };
        let mut drafts = tessellator.houses(slice::from_ref(built), number + 1);
        if !drafts.take_oversized().is_empty() {
            let house = (built, number + 1);
            match plainer(house, on, (self.catalog, tessellator.options()), out) {
                Ok(plainer) => drafts = plainer,
                Err(left) => {
                    left_out.insert(number, left);
                }
            }
        }
        let bytes = drafts.bytes();
        scene.add(drafts);
        bytes
    }
}

/// Tells of houses that have shapes which no file can take, given by their numbers and nodes; returns true if none has.
fn tell_flaws(
    made: &TileHouses,
    part: ScenePart<'_>,
    houses: &[(usize, Range<usize>)],
    out: &mut Diagnostics,
) -> bool {
    // To look at a house is to look at all meshes; nearly always nothing is wrong with any.
    if sound::flaws(part).next().is_none() {
        return true;
    }
    for (number, nodes) in houses {
        if let Some(flaw) = sound::flaws(part.part(nodes.clone())).next() {
            let mut found = Diagnostics::new();
            let place = flaw.span.unwrap_or_default();
            found.push(say::shape_left_out(place, &flaw.name));
            out.append(found.of_feature(&made.houses[*number].1.origin));
        }
    }
    false
}
