//! The tree of nodes: house, storey, facade, part; house, roof. Nodes make up most of the JSON, and a town has half a
//! million: they are written directly from the scene, in types that borrow from it.

use super::geometry::Geometry;
use crate::backend::number::Number;
use crate::backend::sound;
use crate::scene::{self, Scene};
use crate::source::Span;
use glam::DVec2;
use gltf::json::{self, Index, Mesh, Root};
use serde::{Serialize, Serializer};
use std::iter;
use std::ops::Range;

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
    span: Option<Span>,
    /// The file of the span, by its number in reading order; omitted for the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shape: Option<&'a str>,
}

/// The children of a node: the first child, and the tree with the sibling links.
struct Children<'a>(u32, &'a Tree<'a>);

impl Serialize for Children<'_> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        let Children(first, tree) = *self;
        s.collect_seq(tree.siblings(Some(first)).map(|i| tree.number(i)))
    }
}

/// The nodes to write.
pub(super) struct Tree<'a> {
    nodes: &'a [scene::Node],
    /// By the scene's number.
    links: Vec<Link>,
    first_root: Option<u32>,
}

/// The links of a node, as numbers in the scene.
#[derive(Clone, Copy, Default)]
struct Link {
    /// Its glTF number, if it is written.
    number: Option<u32>,
    first_child: Option<u32>,
    next_sibling: Option<u32>,
}

impl<'a> Tree<'a> {
    /// Numbers the nodes in preorder, all of them or those of some houses, and adds the scene of the roots if there are
    /// any.
    pub(super) fn new(
        scene: &'a Scene,
        houses: Option<&[Range<usize>]>,
        geometry: &Geometry<'_>,
        root: &mut Root,
    ) -> Tree<'a> {
        let mut kept = kept(scene, geometry);
        if let Some(houses) = houses {
            let all = std::mem::replace(&mut kept, vec![false; scene.nodes.len()]);
            for house in houses {
                kept[house.clone()].copy_from_slice(&all[house.clone()]);
            }
        }
        let mut tree = Tree {
            nodes: &scene.nodes,
            links: vec![Link::default(); kept.len()],
            first_root: None,
        };
        let written = (0..kept.len()).filter(|i| kept[*i]);
        for (number, i) in (0..).zip(written.clone()) {
            tree.links[i].number = Some(number);
        }
        // From the last to the first, so that each is put before its younger siblings.
        for i in written.rev() {
            let first = match parent(scene, i).filter(|p| kept[*p]) {
                Some(p) => &mut tree.links[p].first_child,
                None => &mut tree.first_root,
            };
            let next = first.replace(i as u32);
            tree.links[i].next_sibling = next;
        }
        let roots = tree.siblings(tree.first_root);
        let roots: Vec<_> = roots.map(|i| Index::new(tree.number(i))).collect();
        if !roots.is_empty() {
            root.scene = Some(root.push(json::Scene {
                nodes: roots,
                name: None,
                extensions: None,
                extras: None,
            }));
        }
        tree
    }

    /// Returns true if there are no nodes.
    pub(super) fn is_empty(&self) -> bool {
        self.first_root.is_none()
    }

    /// Returns an upper bound of their number, which includes nodes that are left out.
    pub(super) fn len(&self) -> usize {
        self.links.len()
    }

    /// Returns the written nodes, each with its number in the scene.
    pub(super) fn written(&self) -> impl Iterator<Item = (usize, &'a scene::Node)> + use<'a, '_> {
        let all = self.nodes.iter().enumerate().zip(&self.links);
        all.filter_map(|(both, link)| link.number.map(|_| both))
    }

    /// Returns the glTF nodes in the order of their numbers.
    pub(super) fn nodes(&self, geometry: &Geometry<'_>) -> impl Iterator<Item = Node<'_>> {
        let both = self.nodes.iter().zip(&self.links);
        let written = both.filter(|(_, link)| link.number.is_some());
        written.map(|(node, link)| {
            let children = link.first_child.map(|first| Children(first, self));
            made(node, children, geometry.mesh(node))
        })
    }

    /// Returns a node and its following siblings.
    fn siblings(&self, first: Option<u32>) -> impl Iterator<Item = u32> {
        iter::successors(first, |i| self.links[*i as usize].next_sibling)
    }

    /// Returns the glTF number of a written node.
    fn number(&self, i: u32) -> u32 {
        self.links[i as usize].number.unwrap_or_default()
    }
}

fn made<'a>(
    node: &'a scene::Node,
    children: Option<Children<'a>>,
    mesh: Option<Index<Mesh>>,
) -> Node<'a> {
    let at = [node.at.x, node.at.z, -node.at.y].map(Number);
    let stays = at.iter().all(|x| x.millionths() == 0);
    Node {
        children,
        extras: Extras {
            kind: node.kind.word(),
            code: node.code.as_deref(),
            storey: node.storey,
            span: node.span,
            file: node.span.map(|s| s.file.0).filter(|file| *file > 0),
            shape: node.shape.as_deref(),
        },
        mesh,
        name: node.called(),
        rotation: rotation(node.turn),
        translation: (!stays).then_some(at),
    }
}

fn parent(scene: &Scene, i: usize) -> Option<usize> {
    let parent = scene.nodes[i].parent.map(|p| p.0 as usize);
    parent.filter(|&p| p < i)
}

/// Returns for each node true if it is written: if it or a descendant has a mesh, or if it is a house.
fn kept(scene: &Scene, geometry: &Geometry<'_>) -> Vec<bool> {
    let count = scene.nodes.len();
    let mut sound = vec![true; count];
    for (i, node) in scene.nodes.iter().enumerate() {
        sound[i] = sound::node(node) && parent(scene, i).is_none_or(|p| sound[p]);
    }
    let mut keep = vec![false; count];
    for (i, node) in scene.nodes.iter().enumerate().rev() {
        keep[i] |= parent(scene, i).is_none() || geometry.mesh(node).is_some();
        keep[i] &= sound[i];
        if let Some(p) = parent(scene, i).filter(|_| keep[i]) {
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
