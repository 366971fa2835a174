//! Converts the paths of the vertices to one polygon per edge.

use super::contour::Contours;
use super::wave::Wave;
use super::{Face, Skeleton};

/// Returns the faces bounded by the arcs of a finished sweep; `None` if an arc is left over or missing.
pub(super) fn faces(contours: &Contours, wave: Wave) -> Option<Skeleton> {
    let n = contours.edges();
    // For each face its directed borders, the face on their left.
    let mut borders: Vec<Vec<(u32, u32)>> = vec![Vec::with_capacity(6); n];
    for arc in &wave.arcs {
        borders[arc.left as usize].push((arc.from, arc.to));
        borders[arc.right as usize].push((arc.to, arc.from));
    }
    let mut next = vec![0; n];
    for (i, (_, _, before)) in contours.each().enumerate() {
        next[before as usize] = i as u32;
    }
    let mut faces = Vec::with_capacity(n);
    for (i, (_, tag, before)) in contours.each().enumerate() {
        faces.push(Face {
            line: wave.lines[i],
            tag,
            before,
            nodes: round(i as u32, next[i], std::mem::take(&mut borders[i]))?,
        });
    }
    Some(Skeleton {
        nodes: wave.nodes,
        faces,
    })
}

/// Returns the nodes of a face from the start of its edge, if its borders form one ring.
fn round(start: u32, end: u32, mut borders: Vec<(u32, u32)>) -> Option<Vec<u32>> {
    let mut nodes = Vec::with_capacity(borders.len() + 1);
    nodes.push(start);
    borders.sort_unstable();
    if borders.windows(2).any(|w| w[0].0 == w[1].0) {
        return None;
    }
    let mut at = end;
    let count = borders.len();
    while at != start {
        nodes.push(at);
        let place = borders.binary_search_by_key(&at, |b| b.0).ok()?;
        at = borders[place].1;
        if nodes.len() > count + 1 {
            return None;
        }
    }
    (nodes.len() == count + 1).then_some(nodes)
}
