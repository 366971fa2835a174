//! Keys by which equal roofs share one mesh, as parts do: the houses of a row often have the same plan.

use crate::hasher::NumberHasher;
use crate::roof::bulk::{Bulk, Walls};
use crate::trim::{Beyond, Run, Twist};
use crate::weather::Weather;
use glam::DVec3;
use hsd_ir::ast::{RoofKind, RoofShape};
use hsd_ir::building::{Face, Roof, RoofSurface, Solid, Trim};
use hsd_scene::{Detail, MeshId};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};
use std::rc::Rc;

/// The meshes of all roofs so far. Never iterated, so its order cannot affect the output.
pub(crate) type Roofs<'a> = HashMap<MeshKey<'a>, Shown, BuildHasherDefault<NumberHasher>>;

/// The output of a roof: its mesh, and the rows of tiles and rafters on and under it.
pub(crate) type Shown = (Option<MeshId>, Rc<[(Run, MeshId)]>);

/// The key of a roof's mesh: its number in the house (part of the mesh's name), its trim, and the solids of it and of
/// the roofs it shows, compared exactly.
#[derive(Clone, Debug)]
pub(crate) struct MeshKey<'a> {
    number: usize,
    kind: RoofKind,
    shape: RoofShape,
    trim: Trim,
    beyond: Beyond,
    weather: Weather,
    solids: &'a [Solid],
    /// The roofs whose solids it shows.
    shown: &'a [Roof],
    walls: Walls,
}

impl<'a> MeshKey<'a> {
    pub(crate) fn new(
        roof: &'a Roof,
        shown: &'a [Roof],
        walls: Walls,
        beyond: Beyond,
        weather: Weather,
        number: usize,
    ) -> MeshKey<'a> {
        MeshKey {
            number,
            kind: roof.kind,
            shape: roof.shape,
            trim: roof.trim,
            beyond,
            weather,
            solids: &roof.solids,
            shown,
            walls,
        }
    }

    pub(crate) fn beyond(&self) -> &Beyond {
        &self.beyond
    }

    /// Returns the solids it shows; `surfaces` are those of its house, from its own on.
    pub(crate) fn bulk(&self, surfaces: &[RoofSurface], detail: Detail) -> Bulk<'_> {
        let shown = surfaces.iter().take(self.shown.len());
        let twists = shown.flat_map(Twist::all).collect();
        Bulk::of(self.shown, &self.walls, twists, detail)
    }

    pub(crate) fn walls(&self) -> &Walls {
        &self.walls
    }
}

fn bits(p: &DVec3) -> [u64; 3] {
    p.to_array().map(f64::to_bits)
}

impl Hash for MeshKey<'_> {
    /// The first and the last points distinguish most roofs, except for their coverings; equality compares all.
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_usize(self.number);
        let whole = self.shown.iter().filter_map(|roof| roof.whole.as_ref());
        for solid in self.solids.iter().chain(whole.flatten()) {
            for point in [solid.points.first(), solid.points.last()]
                .into_iter()
                .flatten()
            {
                bits(point)
                    .into_iter()
                    .for_each(|word| state.write_u64(word));
            }
            state.write_usize(solid.faces.len());
        }
        state.write_usize(self.shown.len());
    }
}

impl PartialEq for MeshKey<'_> {
    fn eq(&self, other: &Self) -> bool {
        let face = |a: &Face, b: &Face| a.finish == b.finish && *a.corners == *b.corners;
        let solid = |(a, b): (&Solid, &Solid)| {
            a.points.len() == b.points.len()
                && a.faces.len() == b.faces.len()
                && a.points.iter().map(bits).eq(b.points.iter().map(bits))
                && a.faces.iter().zip(&b.faces).all(|(a, b)| face(a, b))
        };
        let same = |a: &[Solid], b: &[Solid]| a.len() == b.len() && a.iter().zip(b).all(solid);
        let shown = |(a, b): (&Roof, &Roof)| {
            let whole = match (&a.whole, &b.whole) {
                (Some(a), Some(b)) => same(a, b),
                (a, b) => a.is_none() && b.is_none(),
            };
            whole && a.kind == b.kind && a.attic == b.attic && same(&a.solids, &b.solids)
        };
        self.number == other.number
            && self.kind == other.kind
            && self.shape == other.shape
            && self.trim == other.trim
            && self.beyond == other.beyond
            && self.walls == other.walls
            && self.weather == other.weather
            && same(self.solids, other.solids)
            && self.shown.len() == other.shown.len()
            && self.shown.iter().zip(other.shown).all(shown)
    }
}

impl Eq for MeshKey<'_> {}
