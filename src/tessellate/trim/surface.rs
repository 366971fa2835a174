//! The covering of one roof: its sloping facets and what lies beside each of their edges, read off the faces of its
//! solids by their finishes alone.

use crate::building::{Corners, Face, Finish, Solid};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Slopes gentler than this are level and have no seams.
const LEVEL: f64 = 0.003;

/// Falls that point the same way as far as this, in the cosine, belong to one slope: 20 degrees.
pub(super) const SAME_FALL: f64 = 0.94;

/// Points nearer than this are one, metres.
pub(super) const WELD: f64 = 1e-6;

/// A plane sloping piece of the covering.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Indices of points, counter-clockwise seen from above.
    pub(super) corners: Corners,
    /// Rise per metre in plan: points up the slope.
    pub(super) rise: DVec2,
}

impl Facet {
    /// Down the slope in plan, unit length.
    pub(super) fn fall(&self) -> DVec2 {
        -self.rise.normalize_or_zero()
    }
}

/// The covering of one roof.
#[derive(Clone, Debug, Default)]
pub(super) struct Surface {
    pub(super) points: Vec<DVec3>,
    pub(super) facets: Vec<Facet>,
    pub(super) sides: Vec<Side>,
}

/// An edge of a facet, with the facet on its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) facet: u32,
    pub(super) beside: Beside,
}

/// What lies to the right of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Beside {
    /// Another facet.
    Facet(u32),
    /// The open; how deep the edge of the covering is at both ends, metres.
    Rim([f64; 2]),
    /// A wall or another roof; which of them in the order of edges.
    Joint(u32),
}

/// Edges of rims with how deep they are at both ends, metres.
type Rims = Vec<((u32, u32), [f64; 2])>;

impl Surface {
    /// The covering of some solids.
    pub(super) fn of(solids: &[Solid]) -> Surface {
        let mut surface = Surface::default();
        let covers = |f: &Face| matches!(f.finish, Finish::Covering(_));
        let covering = |s: &&Solid| s.faces.iter().any(covers);
        let covering: Vec<&Solid> = solids.iter().filter(covering).collect();
        // Points of one solid are shared already.
        let mut known: Option<BTreeMap<[i64; 3], u32>> =
            (covering.len() > 1).then(BTreeMap::default);
        let mut rims: Rims = Vec::new();
        for solid in covering {
            let mut numbers = vec![u32::MAX; solid.points.len()];
            let mut number = |i: u32| -> Option<u32> {
                let place = numbers.get_mut(i as usize)?;
                if *place == u32::MAX {
                    *place = surface.number(solid.points[i as usize], known.as_mut());
                }
                Some(*place)
            };
            let mut faces: Vec<(Corners, Finish)> = Vec::with_capacity(solid.faces.len());
            for face in &solid.faces {
                if matches!(face.finish, Finish::Covering(_) | Finish::Edge(_)) {
                    let corners: Corners = face.corners.iter().filter_map(|i| number(*i)).collect();
                    faces.push((corners, face.finish));
                }
            }
            for (corners, finish) in faces {
                match finish {
                    Finish::Covering(_) => surface.facets.extend(facet(&surface.points, corners)),
                    _ => rim(&surface.points, &corners, &mut rims),
                }
            }
        }
        rims.sort_by_key(|r| r.0);
        surface.find_sides(&rims);
        surface
    }

    /// The number of a point, that of the one at the same place if there is one.
    fn number(&mut self, p: DVec3, known: Option<&mut BTreeMap<[i64; 3], u32>>) -> u32 {
        let next = self.points.len() as u32;
        let number = known.map_or(next, |known| {
            let key = p.to_array().map(|x| (x / WELD).round() as i64);
            *known.entry(key).or_insert(next)
        });
        if number == next {
            self.points.push(p);
        }
        number
    }

    /// All edges of facets with what lies beside them.
    fn find_sides(&mut self, rims: &Rims) {
        let mut owners: Vec<((u32, u32), u32)> = Vec::with_capacity(4 * self.facets.len());
        for (n, facet) in self.facets.iter().enumerate() {
            owners.extend(edges(&facet.corners).map(|edge| (edge, n as u32)));
        }
        owners.sort_unstable();
        let owner = |edge: (u32, u32)| {
            let at = owners.binary_search_by_key(&edge, |o| o.0).ok()?;
            Some(owners[at].1)
        };
        let deep = |edge: (u32, u32)| {
            let at = rims.binary_search_by_key(&edge, |r| r.0).ok()?;
            Some(rims[at].1)
        };
        let mut joints = 0;
        for (n, facet) in self.facets.iter().enumerate() {
            for (from, to) in edges(&facet.corners) {
                let beside = match owner((to, from)) {
                    Some(other) => Beside::Facet(other),
                    None => deep((from, to)).map_or_else(
                        || {
                            joints += 1;
                            Beside::Joint(joints - 1)
                        },
                        Beside::Rim,
                    ),
                };
                let facet = n as u32;
                self.sides.push(Side {
                    from,
                    to,
                    facet,
                    beside,
                });
            }
        }
    }

    /// Pairs of facets that belong to one slope.
    pub(super) fn kinks(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.sides.iter().filter_map(|side| {
            let Beside::Facet(other) = side.beside else {
                return None;
            };
            let (f, g) = (side.facet as usize, other as usize);
            let alike = self.facets[f].fall().dot(self.facets[g].fall()) > SAME_FALL;
            alike.then_some((f, g))
        })
    }

    /// The area of a facet in plan, square metres.
    pub(super) fn area(&self, facet: usize) -> f64 {
        let corners = &self.facets[facet].corners;
        let plan: Vec<DVec2> = corners.iter().map(|i| self.at(*i).truncate()).collect();
        crate::geometry::area2(&plan) / 2.0
    }

    /// Edges of the rim: from, to, how deep it is at both.
    pub(super) fn rim_sides(&self) -> impl Iterator<Item = (u32, u32, [f64; 2])> + '_ {
        self.sides.iter().filter_map(|side| match side.beside {
            Beside::Rim(deep) => Some((side.from, side.to, deep)),
            _ => None,
        })
    }

    /// How deep the rim of the covering is at a point on it.
    pub(super) fn deep_at(&self, p: DVec3) -> Option<f64> {
        let mut sides = self.rim_sides();
        let found = sides.find(|(from, _, _)| self.at(*from).distance(p) < WELD)?;
        Some(found.2[0])
    }

    /// A point by its number.
    pub(super) fn at(&self, id: u32) -> DVec3 {
        self.points[id as usize]
    }

    /// The ends of edges at joints, in their order.
    pub(super) fn joints(&self) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
        let joints = self
            .sides
            .iter()
            .filter(|s| matches!(s.beside, Beside::Joint(_)));
        joints.map(|s| (self.at(s.from), self.at(s.to)))
    }
}

fn edges(corners: &Corners) -> impl Iterator<Item = (u32, u32)> + '_ {
    let n = corners.len();
    (0..n).map(move |i| (corners[i], corners[(i + 1) % n]))
}

/// A face of the covering; level and upright ones have no fall.
fn facet(points: &[DVec3], corners: Corners) -> Option<Facet> {
    let first = points[*corners.first()? as usize];
    let at = |i: usize| points[corners[i] as usize] - first;
    let normal: DVec3 = (1..corners.len().max(1) - 1)
        .map(|i| at(i).cross(at(i + 1)))
        .sum();
    if normal.z <= 1e-9 {
        return None;
    }
    let rise = -normal.truncate() / normal.z;
    (rise.length() > LEVEL).then_some(Facet { corners, rise })
}

/// The edge that a face of the rim hangs on, and how deep it hangs at both ends: its two highest corners beside
/// each other with something under them.
fn rim(points: &[DVec3], corners: &Corners, rims: &mut Rims) {
    let below = |id: u32| {
        let top = points[id as usize];
        let under = corners.iter().map(|i| points[*i as usize]);
        let under = under.filter(|p| (p.truncate() - top.truncate()).length() < 1e-4);
        under.map(|p| top.z - p.z).fold(0.0, f64::max)
    };
    for (from, to) in edges(corners) {
        let deep = [below(to), below(from)];
        if deep[0] > 0.0 || deep[1] > 0.0 {
            // Run the other way by the face above.
            rims.push(((to, from), deep));
        }
    }
}
