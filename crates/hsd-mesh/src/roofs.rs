//! The roofs of a house as nodes: each with what its storey's walls give it, and with its rows of tiles.

use crate::Walker;
use crate::roof::bulk::Walls;
use crate::roof::infill::{Infill, is_fill};
use crate::roof::mesh_key::MeshKey;
use crate::roof::plaster;
use crate::trim::Neighbours;
use crate::wall::index::{Place, WallIndex};
use compact_str::format_compact;
use glam::DVec3;
use hsd_ir::ast::{RoofKind, RoofShape};
use hsd_ir::building::{Built, House, HouseRoofs, Roof, Solid};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Detail, Kind, NodeId};
use std::cell::OnceCell;
use std::collections::hash_map::Entry;

impl<'a> Walker<'a> {
    /// Writes the roofs of a house as far as they are shown.
    pub(crate) fn roofs(
        &mut self,
        root: NodeId,
        built: &'a Built,
        standing: &[OnceCell<WallIndex>],
    ) {
        let (house, roofs, whole) = (&built.house, &*built.roofs, self.shown);
        // Only trim needs them.
        let neighbours = match self.detail {
            Detail::Body => Neighbours::default(),
            _ => Neighbours::of(roofs),
        };
        let shares = crate::roof::bulk::shares(&roofs.roofs, self.detail);
        let shared = roofs.roofs.iter().zip(shares).enumerate();
        for (i, (roof, shown)) in shared.filter(|(_, (r, _))| whole.has_roof(r.storey)) {
            let walls = self.below(house, roof, shown, standing);
            let beyond = neighbours.beyond(i, roof);
            self.weather(|aged| aged.roof(i));
            let weather = self.store.weather;
            let alike = MeshKey::new(roof, shown, walls, beyond, weather, i + 1);
            self.roof((root, roofs), i, alike);
            if self.is_full() {
                return;
            }
        }
    }

    /// Returns what a roof takes from its storey's walls: what its visible gable fills have of them, empty where there
    /// are none, and whether it is plastered.
    fn below(
        &self,
        house: &House,
        roof: &Roof,
        shown: &[Roof],
        standing: &[OnceCell<WallIndex>],
    ) -> Walls {
        let solids = || shown.iter().flat_map(|r| &r.solids);
        // Numbers rise, and a parapet follows the storey whose number it shares.
        let below = house.storeys.partition_point(|s| s.number < roof.storey);
        let timber = roof.trim.timber;
        let Some(storey) = house.storeys.get(below) else {
            return Walls {
                timber,
                ..Walls::default()
            };
        };
        let tiled = matches!(roof.kind, RoofKind::Tiles | RoofKind::CoverTiles);
        let plastered = tiled && crate::wall::index::is_plastered(self.catalog, storey);
        if !solids().any(is_fill) {
            return Walls {
                gables: vec![],
                plastered,
                timber,
            };
        }
        let standing = standing[below].get_or_init(|| WallIndex::of(storey));
        // From afar the lattice hides the boards behind it.
        let latticed = match self.detail {
            Detail::Everything => SurfaceId::named("boards_dark"),
            _ => timber.unwrap_or_else(|| SurfaceId::named("cedar")),
        };
        let of = |solid: &Solid| match is_fill(solid) {
            true if roof.trim.lattice => Infill::plain(latticed),
            // Fire walls are plastered, whatever the walls below are.
            true if roof.shape == RoofShape::FireWall => Infill::plain(plaster()),
            true => standing.gable(self.catalog, house, Place { solid, storey }),
            false => Infill::plain(plaster()),
        };
        let gables = solids().map(of).collect();
        Walls {
            gables,
            plastered,
            timber,
        }
    }

    /// Writes a roof of a house.
    fn roof(&mut self, (root, roofs): (NodeId, &HouseRoofs), index: usize, alike: MeshKey<'a>) {
        let (roof, number) = (&roofs.roofs[index], index + 1);
        let name = format_compact!("roof {number}");
        let (mesh, rows) = match self.roofs.entry(alike) {
            Entry::Occupied(known) => known.get().clone(),
            Entry::Vacant(new) => {
                let walls = new.key().walls();
                let worn = crate::trim::build(
                    (roofs, index),
                    new.key().beyond(),
                    walls.plastered,
                    self.detail,
                );
                // The plainest roofs have no picture that could be askew.
                let surfaces = match self.detail {
                    Detail::Body => &[],
                    _ => &roofs.surfaces()[index..],
                };
                let bulk = new.key().bulk(surfaces, self.detail);
                let mesh = self.store.solids(&name, &bulk, &worn.bodies);
                let runs = worn.runs.into_iter();
                let rows = runs.map(|run| (run.clone(), self.store.row(run.row, run.right)));
                new.insert((mesh, rows.collect())).clone()
            }
        };
        let node = self.node(Some(root), Kind::Roof, name, DVec3::ZERO);
        node.mesh = mesh;
        node.storey = Some(roof.storey);
        node.span = roof.span;
        node.shape = Some(roof.shape.letters().into());
        let own = self.last();
        for (run, mesh) in rows.iter() {
            let node = self.node(Some(own), Kind::Member, run.row.name.into(), run.at);
            node.turn = run.right;
            node.mesh = Some(*mesh);
            node.storey = Some(roof.storey);
        }
    }
}
