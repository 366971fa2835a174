//! The tree of nodes: house, storey, facade, part; house, roof. Nodes make up most of the JSON, and a town has half a
//! million: they are written directly from the scene, in types that borrow from it.

mod identity;

use crate::number::Number;
use crate::sound;
use crate::spool::{List, NewSpool};
use glam::DVec2;
use gltf::json::{self, Index, Mesh, Root};
use hsd_base::source::Span;
use hsd_scene::{Detail, MeshId, ScenePart};
use identity::{Given, identities};
use serde::{Serialize, Serializer};
use std::num::NonZeroU32;
use std::{io, iter};

/// A glTF node. Its translation is f64, unlike in the `gltf` crate: f32 would lose millimetres on a house with map
/// coordinates.
#[derive(Serialize)]
pub(super) struct Node<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    children: Option<Children<'a>>,
    extras: Extras<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mesh: Option<Index<Mesh>>,
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    rotation: Option<[f32; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    translation: Option<[Number; 3]>,
}

/// The extras of a node (docs/contract.md 6).
#[derive(Serialize)]
struct Extras<'a> {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    code: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    storey: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    facade: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ja: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    en: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    span: Option<Span>,
    /// The file of the span, by its number in reading order; omitted for the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<u32>,
    /// The name of the file, of houses and of what is written in another file than its house.
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shape: Option<&'a str>,
    /// A name that stays when neighbours change.
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<&'a str>,
}

/// The children of a node: the first child, and the links to its siblings.
struct Children<'a>(u32, &'a [Link]);

impl Serialize for Children<'_> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        let Children(first, links) = *self;
        let next = |i: &u32| links[*i as usize].next_sibling;
        let all = iter::successors(Some(first), next);
        s.collect_seq(all.map(|i| links[i as usize].number))
    }
}

/// The nodes written so far.
pub(super) struct Tree {
    pub(super) nodes: List,
    roots: Vec<Index<json::Node>>,
    given: Given,
}

/// The links of a node, as numbers in its part of the scene.
#[derive(Clone, Copy, Default)]
struct Link {
    /// Its glTF number, if it is written.
    number: u32,
    first_child: Option<u32>,
    next_sibling: Option<u32>,
}

impl Tree {
    pub(super) fn new(new: NewSpool<'_>) -> io::Result<Tree> {
        Ok(Tree {
            nodes: List::new(new)?,
            roots: vec![],
            given: Given::default(),
        })
    }

    /// Writes the nodes of some houses in preorder; `mesh` gives the glTF number of a mesh.
    pub(super) fn add(
        &mut self,
        part: ScenePart<'_>,
        mesh: impl Fn(MeshId) -> Option<u32>,
    ) -> io::Result<()> {
        let kept = kept(part, |id| mesh(id).is_some());
        let written: Vec<usize> = (0..kept.len()).filter(|i| kept[*i]).collect();
        let mut links = vec![Link::default(); kept.len()];
        let mut facades = vec![None; kept.len()];
        // Few details are for towns, in which what is told of each part would be half of the file.
        let fine = part.detail >= Detail::Openings;
        let told: Vec<bool> = (0..kept.len())
            .map(|i| kept[i] && (fine || part.parent(i).is_none()))
            .collect();
        let ids = identities(part, &told, &mut self.given);
        for (number, i) in (self.nodes.count()..).zip(&written) {
            links[*i].number = number;
            if part.parent(*i).is_none() {
                self.roots.push(Index::new(number));
            }
        }
        // From the last to the first, so that each is put before its younger siblings.
        for i in written.iter().rev() {
            if let Some(parent) = part.parent(*i) {
                links[*i].next_sibling = links[parent].first_child.replace(*i as u32);
            }
        }
        for i in written {
            let node = &part.nodes[i];
            let children = links[i].first_child.map(|first| Children(first, &links));
            let shown = node.mesh.and_then(&mesh).map(Index::new);
            let parent = part.parent(i);
            let own = node.facade.map(NonZeroU32::get);
            facades[i] = own.or_else(|| facades[parent?]).filter(|_| fine);
            self.nodes
                .push(&made((node, &ids[i], facades[i]), children, shown))?;
        }
        Ok(())
    }

    /// Makes a node that was written a root.
    pub(super) fn root(&mut self, number: u32) {
        self.roots.push(Index::new(number));
    }

    /// Adds the scene of the roots if there are any; returns the list of nodes.
    pub(super) fn into_nodes(self, root: &mut Root) -> List {
        if !self.roots.is_empty() {
            root.scene = Some(root.push(json::Scene {
                nodes: self.roots,
                name: None,
                extensions: None,
                extras: None,
            }));
        }
        self.nodes
    }
}

/// Makes a node with its name, if it has one, and the number of its facade.
fn made<'a>(
    (node, id, facade): (&'a hsd_scene::Node, &'a str, Option<u32>),
    children: Option<Children<'a>>,
    mesh: Option<Index<Mesh>>,
) -> Node<'a> {
    let at = [node.at.x, node.at.z, -node.at.y].map(Number);
    let stays = at.iter().all(|x| x.millionths() == 0);
    let told = !id.is_empty();
    let names = node.names.as_ref().filter(|_| told);
    let file = node.file.as_ref().filter(|_| told);
    let place = node.place.filter(|_| told);
    Node {
        children,
        extras: Extras {
            kind: node.kind.word(),
            code: node.code.as_deref(),
            storey: node.storey,
            facade,
            ja: names.map(|names| &*names.ja),
            en: names.map(|names| &*names.en),
            span: node.span,
            file: node.span.map(|s| s.file.0).filter(|file| *file > 0),
            source: file.map(|name| name.as_str()),
            line: place.map(|place| place.line.get()),
            column: place.map(|place| place.column),
            shape: node.shape.as_deref(),
            id: told.then_some(id),
        },
        mesh,
        name: node.called(),
        rotation: rotation(node.turn),
        translation: (!stays).then_some(at),
    }
}

/// Returns for each node true if it is written: if it or a descendant has a mesh, or if it is a house.
pub(super) fn kept(part: ScenePart<'_>, has_shape: impl Fn(MeshId) -> bool) -> Vec<bool> {
    let count = part.nodes.len();
    let mut sound = vec![true; count];
    for (i, node) in part.nodes.iter().enumerate() {
        sound[i] = sound::node(node) && part.parent(i).is_none_or(|p| sound[p]);
    }
    let mut keep = vec![false; count];
    for (i, node) in part.nodes.iter().enumerate().rev() {
        keep[i] |= part.parent(i).is_none() || node.mesh.is_some_and(&has_shape);
        keep[i] &= sound[i];
        if let Some(p) = part.parent(i).filter(|_| keep[i]) {
            keep[p] = true;
        }
    }
    keep
}

/// Returns the quaternion of a rotation (cos, sin) about the vertical by half-angle formulas: square roots are
/// correctly rounded on every machine, sines are not. `None` = no rotation.
pub(super) fn rotation(turn: DVec2) -> Option<[f32; 4]> {
    let DVec2 { x: cos, y: sin } = turn.try_normalize().unwrap_or(DVec2::X);
    let (y, w) = if cos >= 0.0 {
        let w = ((1.0 + cos) / 2.0).sqrt();
        (sin / (2.0 * w), w)
    } else {
        let y = ((1.0 - cos) / 2.0).sqrt().copysign(sin);
        (y, sin / (2.0 * y))
    };
    let (y, w) = (y as f32 + 0.0, w as f32 + 0.0);
    (y != 0.0).then_some([0.0, y, 0.0, w])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn turns_become_quaternions() {
        let half = 0.5f32.sqrt();
        assert_eq!(rotation(dvec2(1.0, 0.0)), None);
        assert_eq!(rotation(dvec2(0.0, 1.0)), Some([0.0, half, 0.0, half]));
        assert_eq!(rotation(dvec2(0.0, -1.0)), Some([0.0, -half, 0.0, half]));
        assert_eq!(rotation(dvec2(-1.0, 0.0)), Some([0.0, 1.0, 0.0, 0.0]));
        for degrees in -360..360 {
            let a = f64::from(degrees).to_radians();
            let [_, y, _, w] =
                rotation(dvec2(libm::cos(a), libm::sin(a))).unwrap_or([0.0, 0.0, 0.0, 1.0]);
            let (y, w) = (f64::from(y), f64::from(w));
            assert!((w * w - y * y - libm::cos(a)).abs() < 1e-6, "{degrees}");
            assert!((2.0 * w * y - libm::sin(a)).abs() < 1e-6, "{degrees}");
        }
    }
}
