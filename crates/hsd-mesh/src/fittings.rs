//! Fittings of a house: platforms, verandas, brackets, finials. Detail 0 keeps only what is visible from afar, detail 1
//! leaves out small members, and details 2 and 3 show everything.

mod brackets;
mod finial;
mod ground;
mod outdoors;
mod platform;
mod shrine;
mod sorin;
mod veranda;

use super::Walker;
use super::hasher::NumberHasher;
use super::mesh::Bodies;
use super::part;
use super::store::look::Share;
use super::store::{PartKey, tenths};
use super::weather::Weather;
use compact_str::{CompactString, format_compact};
use glam::{DVec2, DVec3};
use hsd_base::geometry::SHAKU;
use hsd_ir::building::fittings::{Beam, Brackets, Fitting, FittingKind, Head, Put};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Detail, Kind, MeshId, NodeId};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};

/// The meshes of fittings and bracket complexes made so far, by content. Never iterated, so its order cannot affect the
/// output.
#[derive(Default)]
pub(super) struct FittingMeshes<'a> {
    bodies: HashMap<FittingKey<'a>, Option<MeshId>, BuildHasherDefault<NumberHasher>>,
    heads: HashMap<(brackets::Key, Weather), Option<MeshId>, BuildHasherDefault<NumberHasher>>,
}

/// The key of a fitting's mesh: its number in the house (part of the mesh's name), its content and its weather.
#[derive(PartialEq)]
struct FittingKey<'a>(usize, &'a FittingKind, Weather);

// No length of a fitting is a NaN; were one, the fitting would have a mesh of its own.
impl Eq for FittingKey<'_> {}

impl Hash for FittingKey<'_> {
    /// A few lengths distinguish most fittings; equality does the rest.
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_usize(self.0);
        let mut point = |p: DVec3| {
            let lengths = p.to_array().into_iter();
            lengths.for_each(|x| state.write_u64(x.to_bits()));
        };
        match self.1 {
            FittingKind::Platform(it) => it.outline.iter().for_each(|p| point(p.extend(it.z.1))),
            FittingKind::Veranda(it) => it.walls.iter().for_each(|p| point(p.extend(it.top))),
            FittingKind::Brackets(it) => it.heads.iter().for_each(|h| point(h.at)),
            FittingKind::Beams(it, _) => it.iter().for_each(|b| point(b.ends[0])),
            FittingKind::Finial(it) => it.ridge.iter().for_each(|p| point(*p)),
            FittingKind::Plinth(it) => it.outlines[0].iter().for_each(|p| point(p.extend(it.z.0))),
            FittingKind::Put(it) => point(it.at),
            FittingKind::Ground(it) => point(it.at),
        }
    }
}

impl<'a> Walker<'a> {
    /// Adds the nodes of a fitting, the n-th of its house.
    pub(super) fn fitting(&mut self, root: NodeId, fitting: &'a Fitting, n: usize) {
        let detail = self.detail;
        let kind = match &fitting.what {
            FittingKind::Platform(_) | FittingKind::Plinth(_) => Kind::Platform,
            FittingKind::Veranda(_) => Kind::Veranda,
            FittingKind::Beams(..) => Kind::Member,
            FittingKind::Brackets(_) => Kind::Bracket,
            FittingKind::Finial(_) => Kind::Finial,
            FittingKind::Put(it) => return self.put(root, it, fitting, n),
            FittingKind::Ground(_) => Kind::Ground,
        };
        let name = format_compact!("{} {n}", kind.word());
        let alike = FittingKey(n, &fitting.what, self.store.weather);
        let known = self.fitting_meshes.bodies.get(&alike).copied();
        let mesh = known.unwrap_or_else(|| {
            let mesh = self.own(&name, bodies(&fitting.what, detail));
            self.fitting_meshes.bodies.insert(alike, mesh);
            mesh
        });
        self.placed(root, kind, name, mesh, fitting);
        if let FittingKind::Brackets(it) = &fitting.what
            && detail > Detail::Body
        {
            self.heads(root, it, fitting);
        }
    }

    /// Adds a part that stands by itself.
    fn put(&mut self, root: NodeId, it: &Put, fitting: &Fitting, n: usize) {
        let part = self.catalog.part(it.part);
        let [width, height] = it.size.to_array();
        let foot = part.from.map_or(0.0, |from| (from * SHAKU).min(height));
        let key = PartKey {
            part: it.part.0,
            around: part.finish.unwrap_or(SurfaceId::named("cedar")),
            share: Share::default(),
            size: [width, height, foot, height].map(tenths),
            post: 0,
            room: part::passage(part).map_or(0, tenths),
            grounded: part::is_wing(part),
            picture: 0,
        };
        let mesh = self.store.part(it.part, part, key);
        let code = part.code();
        let name = format_compact!("{} {n}", code.trim_end());
        self.placed(root, Kind::Part, name, Some(mesh), fitting);
        let node = self.nodes.last_mut().expect("just placed");
        // The frame of a part begins at its left end.
        node.at = it.at - (it.right * (width / 2.0)).extend(0.0);
        node.turn = it.right;
        node.code = Some(code.into());
    }

    /// Adds bracket complexes; equal ones share a mesh.
    fn heads(&mut self, root: NodeId, it: &Brackets, fitting: &Fitting) {
        let heads = it.heads.iter().map(|h| (brackets::Form::of(h), h));
        let struts = it.struts.iter().map(|h| (brackets::Form::Strut, h));
        for (form, head) in heads.chain(struts) {
            let key = (brackets::Key::new(it, form), self.store.weather);
            let known = self.fitting_meshes.heads.get(&key).copied();
            let mesh = known.unwrap_or_else(|| {
                let mesh = self.own("bracket", brackets::head(it, form, self.detail));
                self.fitting_meshes.heads.insert(key, mesh);
                mesh
            });
            self.placed(root, Kind::Bracket, "bracket".into(), mesh, fitting);
            let node = self.nodes.last_mut().expect("just placed");
            node.at = head.at;
            node.turn = turn(head);
        }
    }

    /// Adds an unshared mesh; `None` if it is empty.
    fn own(&mut self, name: &str, bodies: Bodies) -> Option<MeshId> {
        let mesh = self.store.finish(name.to_owned(), bodies, Share::default());
        (!mesh.is_empty()).then(|| self.store.push(mesh))
    }

    fn placed(
        &mut self,
        root: NodeId,
        kind: Kind,
        name: CompactString,
        mesh: Option<MeshId>,
        fitting: &Fitting,
    ) {
        let node = self.node(Some(root), kind, name, DVec3::ZERO);
        node.mesh = mesh;
        node.span = Some(fitting.span);
        node.storey = (fitting.storey > 0).then_some(fitting.storey);
    }
}

/// Builds all of a fitting except its bracket complexes.
fn bodies(fitting: &FittingKind, detail: Detail) -> Bodies {
    match fitting {
        FittingKind::Platform(it) => platform::bodies(it, detail),
        FittingKind::Veranda(it) => veranda::bodies(it, detail),
        FittingKind::Beams(it, paint) => {
            let mut bodies = Bodies::default();
            it.iter().for_each(|b| beam(&mut bodies, *paint, b));
            bodies
        }
        FittingKind::Brackets(it) => brackets::beams(it, detail),
        FittingKind::Finial(it) => finial::bodies(it, detail),
        FittingKind::Plinth(it) => platform::plinth(it),
        FittingKind::Ground(it) => ground::bodies(it, detail),
        // Its mesh is that of the part.
        FittingKind::Put(_) => Bodies::default(),
    }
}

/// Returns the rotation of a frame whose y axis points into the house.
fn turn(head: &Head) -> DVec2 {
    // Out of the house is -y.
    DVec2::new(-head.out.y, head.out.x)
}

/// Adds a beam with vertical sides.
fn beam(bodies: &mut Bodies, finish: SurfaceId, beam: &Beam) {
    let way = beam.ends[1] - beam.ends[0];
    let across = DVec2::new(way.y, -way.x).normalize_or_zero();
    let half = (across * (beam.width / 2.0)).extend(0.0);
    let up = DVec3::Z * beam.height;
    let foot = beam.ends[0];
    let ring = [foot - half, foot + half, foot + half + up, foot - half + up];
    if way.length() > 1e-3 && across != DVec2::ZERO {
        bodies.slide(finish, &ring, way, false);
    }
}

/// Adds a box at a point, oriented along a direction: between two distances along it, with a width, between two
/// heights.
fn block(
    bodies: &mut Bodies,
    finish: SurfaceId,
    (at, out): (DVec2, DVec2),
    (from, to): (f64, f64),
    width: f64,
    (foot, top): (f64, f64),
) {
    if to - from < 1e-3 || width < 1e-3 || top - foot < 1e-3 {
        return;
    }
    let side = DVec2::new(-out.y, out.x) * (width / 2.0);
    let near = at + out * from;
    let [left, right] = [near - side, near + side].map(|p| p.extend(foot));
    let up = DVec3::Z * (top - foot);
    let ring = [left, right, right + up, left + up];
    bodies.slide(finish, &ring, (out * (to - from)).extend(0.0), false);
}
