//! The tree of nodes: house, storey, facade, part; house, roof.

use super::geometry::Geometry;
use crate::backend::number::Number;
use crate::backend::sound;
use crate::scene::{self, Scene};
use crate::source::Span;
use glam::DVec2;
use gltf::json::scene::UnitQuaternion;
use gltf::json::{self, Index, Mesh, Node, Root};
use serde::Serialize;
use serde_json::value::to_raw_value;

/// language.md 6.
#[derive(Serialize)]
struct Extras<'a> {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    code: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    storey: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    span: Option<Span>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shape: Option<&'static str>,
}

/// Adds the nodes in preorder, and the scene of the roots if there are any.
pub(super) fn add(scene: &Scene, geometry: &Geometry<'_>, root: &mut Root) {
    let kept = kept(scene, geometry);
    let mut numbers = vec![None; scene.nodes.len()];
    let mut roots = vec![];
    for (i, node) in scene.nodes.iter().enumerate().filter(|(i, _)| kept[*i]) {
        let number = root.push(made(node, mesh(geometry, node)));
        numbers[i] = Some(number);
        match parent(scene, i).and_then(|p| numbers[p]) {
            Some(p) => root.nodes[p.value()]
                .children
                .get_or_insert_default()
                .push(number),
            None => roots.push(number),
        }
    }
    if !roots.is_empty() {
        root.scene = Some(root.push(json::Scene {
            nodes: roots,
            name: None,
            extensions: None,
            extras: None,
        }));
    }
}

fn made(node: &scene::Node, mesh: Option<Index<Mesh>>) -> Node {
    let kind = node.kind.word();
    let name = if node.name.is_empty() {
        kind
    } else {
        &node.name
    };
    let at = [node.at.x, node.at.z, -node.at.y].map(|x| Number(x).millionths());
    let extras = Extras {
        kind,
        code: node.code.as_deref(),
        storey: node.storey,
        span: node.span,
        shape: node.shape,
    };
    Node {
        name: Some(name.to_owned()),
        translation: (at != [0; 3]).then(|| at.map(|x| (x as f64 / 1e6) as f32)),
        rotation: rotation(node.turn).map(UnitQuaternion),
        mesh,
        extras: to_raw_value(&extras).ok(),
        ..Node::default()
    }
}

fn mesh(geometry: &Geometry<'_>, node: &scene::Node) -> Option<Index<Mesh>> {
    node.mesh
        .and_then(|m| geometry.numbers.get(m.0 as usize).copied().flatten())
}

fn parent(scene: &Scene, i: usize) -> Option<usize> {
    let parent = scene.nodes[i].parent.map(|p| p.0 as usize);
    parent.filter(|&p| p < i)
}

/// Which nodes show something, or stand above one that does, or are houses.
fn kept(scene: &Scene, geometry: &Geometry<'_>) -> Vec<bool> {
    let count = scene.nodes.len();
    let mut sound = vec![true; count];
    for (i, node) in scene.nodes.iter().enumerate() {
        sound[i] = sound::node(node) && parent(scene, i).is_none_or(|p| sound[p]);
    }
    let mut keep = vec![false; count];
    for (i, node) in scene.nodes.iter().enumerate().rev() {
        keep[i] |= parent(scene, i).is_none() || mesh(geometry, node).is_some();
        keep[i] &= sound[i];
        if let Some(p) = parent(scene, i).filter(|_| keep[i]) {
            keep[p] = true;
        }
    }
    keep
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
