//! Geometry of OpenStreetMap: which closed ways are areas, and rings out of the ways of a multipolygon.

use super::{Data, Of, Picked, Tags};
use crate::fault::Kind;
use crate::feature::{Area, Chain, Geometry};
use crate::rings;
use glam::DVec2;
use hsd_base::budget::Resource;
use std::collections::HashMap;

/// Values of `natural` that are lines even where they close.
const NATURAL_LINES: [&str; 5] = ["coastline", "cliff", "ridge", "tree_row", "arete"];

/// Returns the geometry of a thing; counts the nodes and ways that the file lacks.
pub(super) fn geometry(
    data: &Data,
    picked: &Picked,
    missing: &mut usize,
) -> Result<Geometry, Kind> {
    match picked.of {
        Of::Node => {
            let place = data.place(picked.id).into_iter().collect();
            Ok(Geometry::Points(Chain::flat(place)))
        }
        Of::Way => {
            let nodes = data.ways.get(&picked.id).map(|n| &**n).unwrap_or_default();
            data.account.charge(Resource::Points, nodes.len() as u64)?;
            let mut points = places(data, nodes, missing);
            let is_closed = nodes.len() > 3 && nodes.first() == nodes.last();
            if !is_closed || !is_area(&picked.tags) {
                return Ok(Geometry::Lines(vec![Chain::flat(points)]));
            }
            if points.first() != points.last() {
                points.extend(points.first().copied());
            }
            let outline = Chain::flat(points);
            Ok(Geometry::Areas(vec![Area {
                outline,
                holes: vec![],
            }]))
        }
        Of::Relation => {
            let members = &data.members[picked.index];
            let ways: Vec<&[i64]> = members
                .iter()
                .filter_map(|way| data.ways.get(way).map(|nodes| &**nodes))
                .collect();
            let nodes: usize = ways.iter().map(|nodes| nodes.len()).sum();
            data.account.charge(Resource::Points, nodes as u64)?;
            *missing += members.len() - ways.len();
            let closed = closed_rings(&ways);
            let Some(closed) = closed.filter(|rings| !rings.is_empty()) else {
                return Err(match *missing {
                    0 => Kind::Malformed {
                        what: "its ways form no closed ring".into(),
                    },
                    count => Kind::MissingMembers { count },
                });
            };
            let chains = closed
                .iter()
                .map(|ring| Chain::flat(places(data, ring, missing)));
            Ok(Geometry::Areas(rings::areas(chains.collect())))
        }
    }
}

fn places(data: &Data, nodes: &[i64], missing: &mut usize) -> Vec<DVec2> {
    let found: Vec<DVec2> = nodes.iter().filter_map(|node| data.place(*node)).collect();
    *missing += nodes.len() - found.len();
    found
}

/// Returns true if a closed way with these tags is an area: buildings are, roads and fences are lines that return.
fn is_area(tags: &Tags) -> bool {
    let value = |key: &str| tags.iter().find(|(k, _)| **k == *key).map(|(_, v)| &**v);
    match value("area") {
        Some("yes") => return true,
        Some("no") => return false,
        _ => {}
    }
    if value("building").is_some_and(|v| v != "no") {
        return true;
    }
    let is_line = value("natural").is_some_and(|v| NATURAL_LINES.contains(&v));
    value("highway").is_none() && value("barrier").is_none() && !is_line
}

/// Returns the closed rings that ways form, joined end to end; `None` if some stay open.
fn closed_rings(ways: &[&[i64]]) -> Option<Vec<Vec<i64>>> {
    let mut at_end: HashMap<i64, Vec<usize>> = HashMap::new();
    let mut is_used = vec![false; ways.len()];
    for (number, way) in ways.iter().enumerate() {
        let (first, last) = (*way.first()?, *way.last()?);
        at_end.entry(first).or_default().push(number);
        at_end.entry(last).or_default().push(number);
    }
    let mut rings = vec![];
    for start in 0..ways.len() {
        if std::mem::replace(&mut is_used[start], true) {
            continue;
        }
        let mut ring = ways[start].to_vec();
        while ring.first() != ring.last() || ring.len() < 2 {
            let end = *ring.last()?;
            let next = at_end.get(&end)?.iter().find(|way| !is_used[**way]);
            let next = *next?;
            is_used[next] = true;
            match ways[next].first() == Some(&end) {
                true => ring.extend(&ways[next][1..]),
                false => ring.extend(ways[next].iter().rev().skip(1)),
            }
        }
        rings.push(ring);
    }
    Some(rings)
}
