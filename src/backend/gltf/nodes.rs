//! The tree of nodes: house, storey, facade, part; house, roof.

use super::document::{Extras, Node};
use super::geometry::Geometry;
use crate::backend::number::Number;
use crate::backend::sound;
use crate::scene::{self, Scene};
use glam::DVec2;

/// The nodes that are written, and who stands below whom.
pub(super) struct Tree<'a> {
    scene: &'a Scene,
    geometry: &'a Geometry<'a>,
    /// glTF numbers of the roots.
    pub(super) roots: Vec<u32>,
    /// The glTF number of each node of the scene.
    numbers: Vec<Option<u32>>,
    /// glTF numbers of children, those of one parent together.
    children: Vec<u32>,
    /// Where the children of a node of the scene begin; one more at the end.
    starts: Vec<u32>,
}

impl<'a> Tree<'a> {
    pub(super) fn new(scene: &'a Scene, geometry: &'a Geometry<'a>) -> Tree<'a> {
        let count = scene.nodes.len();
        let parent = |i: usize| {
            scene.nodes[i]
                .parent
                .map(|p| p.0 as usize)
                .filter(|&p| p < i)
        };
        let numbers = numbers(scene, geometry, &parent);
        let mut starts = vec![0u32; count + 1];
        for p in (0..count)
            .filter(|&i| numbers[i].is_some())
            .filter_map(parent)
        {
            starts[p + 1] += 1;
        }
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut children = vec![0; starts[count] as usize];
        let mut roots = vec![];
        for (i, number) in numbers
            .iter()
            .enumerate()
            .filter_map(|(i, n)| Some((i, (*n)?)))
        {
            match parent(i) {
                Some(p) => {
                    children[next[p] as usize] = number;
                    next[p] += 1;
                }
                None => roots.push(number),
            }
        }
        Tree {
            scene,
            geometry,
            roots,
            numbers,
            children,
            starts,
        }
    }

    /// In preorder.
    pub(super) fn nodes(&self) -> Vec<Node<'_>> {
        let all = self.scene.nodes.iter().enumerate();
        let kept = all.filter(|(i, _)| self.numbers[*i].is_some());
        kept.map(|(i, node)| self.node(i, node)).collect()
    }

    fn node(&self, i: usize, node: &'a scene::Node) -> Node<'_> {
        let word = node.kind.word();
        let at = [node.at.x, node.at.z, -node.at.y].map(Number);
        Node {
            name: if node.name.is_empty() {
                word
            } else {
                &node.name
            },
            translation: at.iter().any(|n| n.millionths() != 0).then_some(at),
            rotation: rotation(node.turn),
            mesh: self.mesh(node),
            children: &self.children[self.starts[i] as usize..self.starts[i + 1] as usize],
            extras: Extras {
                kind: word,
                code: node.code.as_deref(),
                storey: node.storey,
                span: node.span,
                shape: node.shape,
            },
        }
    }

    fn mesh(&self, node: &scene::Node) -> Option<u32> {
        mesh(self.geometry, node)
    }
}

fn mesh(geometry: &Geometry<'_>, node: &scene::Node) -> Option<u32> {
    node.mesh
        .and_then(|m| geometry.numbers.get(m.0 as usize).copied().flatten())
}

/// Numbers the nodes that show something, or stand above one that does, and the houses.
fn numbers(
    scene: &Scene,
    geometry: &Geometry<'_>,
    parent: &impl Fn(usize) -> Option<usize>,
) -> Vec<Option<u32>> {
    let count = scene.nodes.len();
    let mut sound = vec![true; count];
    for (i, node) in scene.nodes.iter().enumerate() {
        sound[i] = sound::node(node) && parent(i).is_none_or(|p| sound[p]);
    }
    let mut keep = vec![false; count];
    for (i, node) in scene.nodes.iter().enumerate().rev() {
        keep[i] |= parent(i).is_none() || mesh(geometry, node).is_some();
        keep[i] &= sound[i];
        if let Some(p) = parent(i).filter(|_| keep[i]) {
            keep[p] = true;
        }
    }
    let mut next = 0;
    let mut number = |keep: bool| {
        keep.then(|| {
            next += 1;
            next - 1
        })
    };
    keep.into_iter().map(&mut number).collect()
}

/// The quaternion of a turn (cos, sin) about the vertical by half-angle formulas: square roots are exact to
/// the last bit on every machine, sines are not. `None` = no turn.
fn rotation(turn: DVec2) -> Option<[f32; 4]> {
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
