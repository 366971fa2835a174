//! The building in triangles: walls and parts in the tree house > storey > facade > part, roofs beside the
//! storeys. After this no code, unit or region is left, only meshes with names.
//!
//! Houses are tessellated by a [`Tessellator`] as drafts, on any thread and in any order; a [`SceneBuilder`] puts the
//! drafts together in the order of the houses. A mesh is made once for each part, width, height and neighbourhood, and
//! the scene keeps one of equal meshes, so it is shown as often as it stands somewhere.

mod assembly;
mod bake;
mod budget;
mod trim;
mod wall;
mod fittings;
mod rooms;
mod hasher;
mod lean;
mod mesh;
mod part;
pub mod part_sheet;
mod roof;
mod roofs;
mod store;
mod weather;

use crate::roof::bulk::Bulk;
use crate::roof::mesh_key::Roofs;
use crate::wall::Line;
use crate::wall::index::WallIndex;
use crate::wall::room::Rooms;
use crate::weather::exposure::{Aged, WallExposure};
pub use assembly::{GroundMesh, HouseDrafts, SceneBuilder, ground};
use budget::Budget;
use compact_str::{CompactString, format_compact};
use fittings::FittingMeshes;
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_base::geometry::{Heading, SAME};
use hsd_base::source::Limits;
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::fittings::{Fitting, FittingKind};
use hsd_ir::building::{Building, Built, Ceiling, Fixture, House, Ring, Room, Soffit, Storey};
use hsd_ir::catalog::{Catalog, PartId};
use hsd_scene::{Detail, Kind, Node, NodeId, PartNames, Scene, Shown};
use rayon::prelude::*;
use rooms::{FixtureMeshes, MatMeshes};
use std::cell::OnceCell;
use std::collections::HashMap;
use std::sync::Arc;
use store::Store;
use store::bank::Bank;
use weather::Weather;

/// The number of houses that one thread tessellates at a time. What they share is made once, and nothing else depends on
/// it.
const TOGETHER: usize = 64;

/// The number of houses of which drafts are kept until the scene takes them.
const BATCH: usize = 512;

/// Returns the houses of a building as a scene, except those that exceed a limit. Pure; shares meshes among all houses and
/// runs on the threads of the current `rayon` pool.
pub fn tessellate(building: &Building, catalog: &Catalog, options: Options) -> Scene {
    let tessellator = Tessellator::new(catalog, options);
    let mut scene = SceneBuilder::new(options.detail);
    for (batch, number) in building.houses.chunks(BATCH).zip(0..) {
        let first = |group: usize| 1 + number * BATCH + group * TOGETHER;
        let groups = batch.par_chunks(TOGETHER).enumerate();
        let drafts = groups.map(|(group, houses)| tessellator.houses(houses, first(group)));
        let drafts: Vec<HouseDrafts> = drafts.collect();
        drafts.into_iter().for_each(|houses| scene.add(houses));
    }
    let pictures = building.images.iter();
    scene.finish(pictures.map(|p| p.path.clone()).collect())
}

/// How houses are tessellated.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The level of detail.
    pub detail: Detail,
    /// How much of each house is shown.
    pub shown: Shown,
    /// The most triangles that a house may show.
    pub triangles: usize,
    /// True in a town: joinery that is shown by images shares few of them, which are coarser.
    pub town: bool,
}

impl From<Detail> for Options {
    /// Returns options with the default limit.
    fn from(detail: Detail) -> Options {
        Options {
            detail,
            shown: Shown::Whole,
            triangles: Limits::default().triangles,
            town: false,
        }
    }
}

/// Tessellates houses at one level of detail, on any number of threads at once.
#[derive(Debug)]
pub struct Tessellator<'c> {
    catalog: &'c Catalog,
    options: Options,
    bank: Bank,
}

impl<'c> Tessellator<'c> {
    /// Creates one for houses with these parts.
    pub fn new(catalog: &'c Catalog, options: Options) -> Tessellator<'c> {
        Tessellator {
            catalog,
            options,
            bank: Bank::default(),
        }
    }

    /// Returns its options.
    pub fn options(&self) -> Options {
        self.options
    }

    /// Tessellates some houses, the first of which has this number in the run, counted from 1.
    pub fn houses(&self, houses: &[Built], first: usize) -> HouseDrafts {
        let Options {
            detail,
            town,
            shown,
            ..
        } = self.options;
        let triangles = self.options.triangles;
        let mut walker = Walker {
            catalog: self.catalog,
            detail,
            shown,
            storeys: 0,
            furnished: false,
            store: Store::new((detail, town), &self.bank),
            roofs: Roofs::default(),
            fitting_meshes: FittingMeshes::default(),
            rooms: Rooms::default(),
            fixtures: FixtureMeshes::default(),
            mats: MatMeshes::default(),
            names: HashMap::new(),
            aged: None,
            air: None,
            nodes: Vec::with_capacity(budget::nodes(houses, detail)),
            root: NodeId(0),
            budget: Budget::default(),
        };
        let mut oversized = vec![];
        for (built, number) in houses.iter().zip(first..) {
            let before = walker.nodes.len();
            walker.budget = Budget::new(before, triangles);
            // Those that no house can have are not begun.
            walker.budget.exceeded = budget::parts(&built.house) * Budget::NODE > triangles;
            walker.house(built, number);
            if walker.is_full() {
                walker.nodes.truncate(before);
                oversized.push((number - first, built.house.span));
            } else if detail == Detail::Body && built.house.outdoors.is_none() {
                lean::join(&mut walker.nodes, walker.root, &mut walker.store);
            }
        }
        let (mut nodes, all) = (walker.nodes, walker.store.into_drafts());
        let (drafts, joined) = match detail {
            Detail::Body => lean::shown(&mut nodes, &all),
            _ => (all, 0),
        };
        HouseDrafts {
            nodes,
            drafts,
            joined,
            oversized,
        }
    }
}

/// Walks over houses and writes nodes.
struct Walker<'a> {
    catalog: &'a Catalog,
    detail: Detail,
    shown: Shown,
    /// The number of storeys of the house in the making.
    storeys: u32,
    /// True if it has rooms.
    furnished: bool,
    store: Store<'a>,
    roofs: Roofs<'a>,
    fitting_meshes: FittingMeshes<'a>,
    rooms: Rooms,
    fixtures: FixtureMeshes,
    mats: MatMeshes,
    /// The names of the parts so far.
    names: HashMap<PartId, Arc<PartNames>>,
    nodes: Vec<Node>,
    /// The house in the making.
    root: NodeId,
    /// Its age, if specified.
    aged: Option<Aged>,
    /// Exposure of the current wall, if the house has an age.
    air: Option<WallExposure>,
    budget: Budget,
}

/// Data shared by the walls of a storey.
#[derive(Clone, Copy)]
struct Level<'a> {
    house: &'a House,
    storey: &'a Storey,
    ceilings: &'a [Ceiling],
    /// Positions of its walls, computed on first use.
    standing: &'a OnceCell<WallIndex>,
    /// Metres from floor to top.
    height: f64,
    /// The storey's node.
    node: NodeId,
}

/// What the author has written into a storey.
struct Inside<'a> {
    rooms: Vec<&'a Room>,
    fixtures: Vec<&'a Fixture>,
}

impl Level<'_> {
    /// True if a roof slopes over it, so that no ceiling hangs at its top.
    fn is_under_a_slope(&self) -> bool {
        let mut ceilings = self.ceilings.iter();
        ceilings.any(|c| c.storey == self.storey.number)
    }

    /// True if posts, plates and other framing are visible.
    fn framed(&self) -> bool {
        self.storey.kind == StoreyKind::Storey
    }

    /// True if the storey stands on the ground.
    fn grounded(&self) -> bool {
        let low = self.storey.number == 1 && self.storey.z0.abs() < SAME;
        self.framed() && low && self.house.raised == 0.0
    }

    /// True if its posts stand on a platform or the ground, not on a raised floor.
    fn on_stone(&self) -> bool {
        let veranda = self.storey.order.veranda.as_ref();
        veranda.is_none_or(|v| v.height == 0.0)
    }

    /// Metres from its foot to its floor: upstairs a veranda may lie higher, and its doors lead to the boards of that.
    fn floor_rise(&self) -> f64 {
        let veranda = self.storey.order.veranda.as_ref();
        let upstairs = veranda.filter(|_| self.storey.number > 1);
        upstairs.map_or(0.0, |v| v.height * hsd_base::geometry::SHAKU)
    }

    /// The posts that the author asked for: half the width that they take from joinery, metres. A round column, which is
    /// drawn with sixteen sides, is narrower at the face of the joinery than in the middle.
    fn post(&self) -> Option<f64> {
        let posts = self.storey.order.posts.as_ref()?;
        let half = posts.size * hsd_base::geometry::SHAKU / 2.0;
        let face = part::bay::HALF_POST.min(half * 0.7);
        Some(match posts.round {
            true => ((half * 0.98).powi(2) - face * face).sqrt(),
            false => half,
        })
    }
}

impl<'a> Walker<'a> {
    /// Adds a node without a label.
    fn node(
        &mut self,
        parent: Option<NodeId>,
        kind: Kind,
        name: CompactString,
        at: DVec3,
    ) -> &mut Node {
        self.nodes.push(Node::new(parent, kind, name, at));
        self.nodes.last_mut().expect("just pushed")
    }

    /// The number of the node added last.
    fn last(&self) -> NodeId {
        NodeId(self.nodes.len() as u32 - 1)
    }

    /// Returns true once the house in the making shows more triangles than it may. What follows is then not made.
    fn is_full(&mut self) -> bool {
        let new = &self.nodes[self.budget.counted..];
        let meshes = new.iter().filter_map(|node| node.mesh);
        let drafts = meshes.map(|id| self.store.draft(id));
        let (mut shown, mut is_cut) = (0, false);
        for draft in drafts {
            shown += draft.triangles();
            is_cut |= draft.is_cut();
        }
        let triangles = shown + Budget::NODE * new.len();
        self.budget.counted = self.nodes.len();
        self.budget.exceeded |= is_cut || triangles > self.budget.left;
        self.budget.left = self.budget.left.saturating_sub(triangles);
        self.budget.exceeded
    }

    fn house(&mut self, built: &'a Built, number: usize) {
        if self.is_full() {
            return;
        }
        let (house, roofs) = (&built.house, &built.roofs);
        let name = match house.name.as_str() {
            "" => format_compact!("house {number}"),
            name if house.outdoors.is_some() => name.into(),
            name => format_compact!("house {name}"),
        };
        let [x, y, z] = house.origin;
        let kind = match house.outdoors {
            Some(_) => Kind::Outdoors,
            None => Kind::House,
        };
        let node = self.node(None, kind, name, dvec3(x, y, z));
        // The compass runs clockwise, rotations run the other way; 180 is a front to the south.
        node.turn = Heading::new(180.0 - house.azimuth).vector();
        node.span = Some(house.placed.map_or(house.span, |by| by.span));
        let root = self.last();
        self.root = root;
        self.aged = Aged::of(house, roofs);
        self.weather(|aged| aged.even("house", 0.5));
        let standing: Vec<OnceCell<WallIndex>> =
            house.storeys.iter().map(|_| OnceCell::new()).collect();
        let whole = self.shown;
        self.storeys = house.storeys.last().map_or(0, |s| s.number);
        self.furnished = !built.rooms.is_empty();
        let standing_storeys = house.storeys.iter().zip(&standing).enumerate();
        for (i, (storey, standing)) in
            standing_storeys.filter(|(_, (s, _))| whole.has_storey(s.number))
        {
            let inside = Inside {
                rooms: built.rooms.iter().filter(|r| r.level == i).collect(),
                fixtures: built.fixtures.iter().filter(|f| f.level == i).collect(),
            };
            self.storey((root, house), storey, &roofs.ceilings, standing, &inside);
            if self.is_full() {
                return;
            }
        }
        self.weather(|aged| aged.even("soffits", 0.0));
        let soffits = roofs.soffits.iter().enumerate();
        for (i, soffit) in soffits.filter(|(_, s)| whole.has_storey(s.storey)) {
            self.soffit(root, soffit, i + 1);
        }
        self.roofs(root, built, &standing);
        self.weather(|aged| aged.even("fittings", 0.5));
        let fittings = built.fittings.iter().zip(1..);
        let seen = |f: &Fitting| match f.what {
            FittingKind::Finial(_) => whole == Shown::Whole,
            _ => whole.has_storey(f.storey),
        };
        for (fitting, number) in fittings.filter(|(f, _)| seen(f)) {
            self.fitting(root, fitting, number);
        }
        if let Some(outdoors) = &house.outdoors {
            self.outdoors(root, outdoors);
        }
    }

    /// From now on meshes have the weather of the house in the making, if it has had any.
    fn weather(&mut self, of: impl FnOnce(&Aged) -> Weather) {
        self.store.weather = self.aged.as_ref().map_or(Weather::None, of);
    }

    fn storey(
        &mut self,
        (root, house): (NodeId, &House),
        storey: &Storey,
        ceilings: &[Ceiling],
        standing: &OnceCell<WallIndex>,
        inside: &Inside<'_>,
    ) {
        let word = match storey.kind {
            StoreyKind::Storey => "storey",
            StoreyKind::Parapet => "parapet",
        };
        let name = format_compact!("{word} {}", storey.number);
        let at = dvec3(0.0, 0.0, storey.z0);
        let node = self.node(Some(root), Kind::Storey, name, at);
        node.storey = Some(storey.number);
        node.span = Some(storey.span);
        let level = Level {
            house,
            storey,
            ceilings,
            standing,
            height: storey.z1 - storey.z0,
            node: self.last(),
        };
        if self.detail == Detail::Body {
            let mesh = self.body(level);
            self.nodes[level.node.0 as usize].mesh = mesh;
            if level.post().is_some() {
                self.bare_posts(level);
            }
            return;
        }
        let rings: Vec<(&Ring, Vec<Line<'_>>)> = storey
            .rings
            .iter()
            .map(|ring| (ring, self.lines(level, ring)))
            .collect();
        for (_, lines) in &rings {
            self.ring(level, lines);
        }
        match inside.rooms.is_empty() {
            true => self.interior(level, &rings),
            false => self.rooms(level, &inside.rooms),
        }
        self.fixtures(level, &inside.fixtures, &inside.rooms);
    }

    /// The posts of a storey without its walls: what an open hall is from afar.
    fn bare_posts(&mut self, level: Level<'_>) {
        for ring in &level.storey.rings {
            let lines = self.lines(level, ring);
            for (i, line) in lines.iter().enumerate() {
                let (before, after) = Line::beside(&lines, i);
                let facade = self.facade_node(level, line);
                self.air = self.air_before(level, line.wall);
                self.posts(level, facade, line, before, after);
                self.air = None;
            }
        }
    }

    /// The walls of a ring with their units in place.
    fn lines<'b>(&self, level: Level<'b>, ring: &'b Ring) -> Vec<Line<'b>>
    where
        Self: 'b,
    {
        let bounds = ring.closed && !ring.inner;
        let walls = ring.walls.iter();
        walls
            .map(|wall| Line {
                bounds,
                ..Line::new(self.catalog, level, wall)
            })
            .collect()
    }

    /// The walls of a ring; each draws the corner at its start.
    fn ring(&mut self, level: Level<'_>, lines: &[Line<'_>]) {
        for (i, line) in lines.iter().enumerate() {
            let (before, after) = Line::beside(lines, i);
            self.facade(level, line, before, after);
            if self.is_full() {
                return;
            }
        }
    }

    /// Writes the soffit of an overhanging storey.
    fn soffit(&mut self, root: NodeId, soffit: &Soffit, number: usize) {
        let name = format_compact!("soffit {number}");
        let mesh = self.store.solids(&name, &Bulk::plain(&soffit.solids), &[]);
        let node = self.node(Some(root), Kind::Member, name, DVec3::ZERO);
        node.mesh = mesh;
        node.storey = Some(soffit.storey);
    }
}

/// The rotation of a wall's frame in the house: x to the right seen from outside.
fn turn_of(direction: DVec2) -> DVec2 {
    // The walk runs to the left: right is (-east, north) of its mirrored direction.
    dvec2(direction.x, -direction.y)
}
