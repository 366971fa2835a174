//! The covering of one roof as trim walks over it: the typed surface of the roof with its joints counted.

use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::POINT;
use hsd_ir::building::{Beside as Across, EdgeKind, RoofEdge, RoofFacet, RoofSurface};

/// The covering of one roof.
#[derive(Clone, Debug, Default)]
pub(super) struct Surface {
    pub(super) points: Vec<DVec3>,
    pub(super) facets: Vec<RoofFacet>,
    /// Each inner edge once, outer ones with their facet on the left.
    pub(super) sides: Vec<Side>,
}

/// An edge of a facet, with the facet on its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) kind: EdgeKind,
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) facet: u32,
    pub(super) beside: Beside,
}

/// The surface or void that adjoins an edge on its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Beside {
    /// Another facet.
    Facet(u32),
    /// The open; thickness of the covering's edge at both ends, metres.
    Rim([f64; 2]),
    /// A wall or another roof, numbered in the order of edges.
    Joint(u32),
}

impl Surface {
    /// The covering with this surface.
    pub(super) fn of(surface: &RoofSurface) -> Surface {
        let mut joints = 0..;
        let side = |edge: &RoofEdge| Side {
            kind: edge.kind,
            from: edge.ends[0],
            to: edge.ends[1],
            facet: edge.facet,
            beside: match edge.beside {
                Across::Facet(other) => Beside::Facet(other),
                Across::Open(depth) => Beside::Rim(depth),
                Across::Roof(_) | Across::Wall => Beside::Joint(joints.next().unwrap_or(u32::MAX)),
            },
        };
        Surface {
            points: surface.points.clone(),
            facets: surface.facets.clone(),
            sides: surface.edges.iter().map(side).collect(),
        }
    }

    /// Returns pairs of facets that belong to one slope.
    pub(super) fn kinks(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.sides.iter().filter_map(|side| match side.beside {
            Beside::Facet(other) if side.kind == EdgeKind::Fold => {
                Some((side.facet as usize, other as usize))
            }
            _ => None,
        })
    }

    /// Returns the area of a facet in plan, square metres.
    pub(super) fn area(&self, facet: usize) -> f64 {
        let corners = &self.facets[facet].corners;
        let plan: Vec<DVec2> = corners.iter().map(|i| self.at(*i).truncate()).collect();
        hsd_base::geometry::area2(&plan) / 2.0
    }

    /// Edges of the rim: from, to, thickness at both ends, metres.
    pub(super) fn rim_sides(&self) -> impl Iterator<Item = (u32, u32, [f64; 2])> + '_ {
        self.sides.iter().filter_map(|side| match side.beside {
            Beside::Rim(deep) => Some((side.from, side.to, deep)),
            _ => None,
        })
    }

    /// The thickness of the rim at a point on it, metres.
    pub(super) fn deep_at(&self, p: DVec3) -> Option<f64> {
        let mut sides = self.rim_sides();
        let found = sides.find(|(from, _, _)| self.at(*from).distance(p) < POINT)?;
        Some(found.2[0])
    }

    /// Returns the height of the covering over a place in plan; `None` outside of it.
    pub(super) fn height(&self, plan: DVec2) -> Option<f64> {
        let over = |facet: &&RoofFacet| {
            let corners: Vec<DVec2> = facet
                .corners
                .iter()
                .map(|i| self.at(*i).truncate())
                .collect();
            hsd_base::geometry::holds(&corners, plan)
        };
        let facet = self.facets.iter().find(over)?;
        let at = self.at(facet.corners[0]);
        Some(at.z + facet.rise.dot(plan - at.truncate()))
    }

    /// Returns a point by its number.
    pub(super) fn at(&self, id: u32) -> DVec3 {
        self.points[id as usize]
    }

    /// Returns the ends of edges at joints, in order.
    pub(super) fn joints(&self) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
        let joints = self
            .sides
            .iter()
            .filter(|s| matches!(s.beside, Beside::Joint(_)));
        joints.map(|s| (self.at(s.from), self.at(s.to)))
    }
}
