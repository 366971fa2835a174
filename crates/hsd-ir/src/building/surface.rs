//! The upper surface of one roof: its sloping facets and their typed edges, computed once when the roof is closed.
//! Trim, drawings and dumps read ridges, hips and valleys here; nothing infers them again.
//!
//! Frame: house frame, metres. Flat roofs have no facets.

use super::{Corners, Face, Finish, Solid};
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::POINT;
use std::collections::BTreeMap;

/// Facets whose slope rises less per metre are level and left out.
const LEVEL: f64 = 0.003;

/// Facets whose falls point the same way up to 20 degrees belong to one slope: the cosine of that angle.
pub(super) const SAME_FALL: f64 = 0.94;

/// An edge between two slopes is level if it rises less than this share of the steeper slope's rise over its length.
const LEVEL_SHARE: f64 = 0.25;

/// The kind of an edge of a roof surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum EdgeKind {
    /// A level line in which two slopes meet above (mune).
    Ridge,
    /// A sloping line in which two slopes meet above (sumi-mune).
    Hip,
    /// A line in which two slopes meet below (tani).
    Valley,
    /// The exposed low edge of a slope (noki).
    Eaves,
    /// An exposed edge along the fall of a slope (keraba).
    Verge,
    /// The exposed high edge of a slope, as on a free-standing shed roof.
    Crest,
    /// An edge at a wall or under another roof.
    Abutment,
    /// A line between two facets of one slope: a bend of curved rafters, or a division of one plane.
    Fold,
}

/// The neighbour on the other side of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beside {
    /// Another facet of this roof, by index.
    Facet(u32),
    /// Nothing; thickness of the covering's edge at both ends, metres, measured vertically.
    Open([f64; 2]),
    /// A slope of another roof of the house, by its index in [`HouseRoofs::roofs`](super::HouseRoofs::roofs).
    Roof(u32),
    /// A wall, or a roof that does not continue the surface.
    Wall,
}

/// A plane sloping piece of the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct RoofFacet {
    /// Indices of points, counter-clockwise seen from above.
    pub corners: Corners,
    /// Rise per metre in plan; points up the slope.
    pub rise: DVec2,
}

impl RoofFacet {
    /// Returns the direction down the slope in plan, unit length.
    pub fn fall(&self) -> DVec2 {
        -self.rise.normalize_or_zero()
    }
}

/// An edge of one facet or between two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoofEdge {
    /// Its kind.
    pub kind: EdgeKind,
    /// Indices of its ends; `facet` lies to the left. Hips run upwards.
    pub ends: [u32; 2],
    /// The facet to its left.
    pub facet: u32,
    /// Its neighbour to the right.
    pub beside: Beside,
}

/// The upper surface of one roof. Every side of every facet belongs to exactly one edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RoofSurface {
    /// Corners of facets.
    pub points: Vec<DVec3>,
    /// Facets in the order of the covering's faces.
    pub facets: Vec<RoofFacet>,
    /// Edges in the order of the facets.
    pub edges: Vec<RoofEdge>,
}

/// Edges of the rim with the thickness of the covering's edge at both ends, metres.
type Rims = Vec<((u32, u32), [f64; 2])>;

impl RoofSurface {
    /// Derives the surface of finished solids from the finishes of their faces. Edges without a neighbour in the same
    /// roof are [`Beside::Wall`] until the roofs of the house are known.
    pub fn of(solids: &[Solid]) -> RoofSurface {
        let mut surface = RoofSurface::default();
        let covers = |f: &Face| matches!(f.finish, Finish::Covering(_));
        let covering = |s: &&Solid| s.faces.iter().any(covers);
        let covering: Vec<&Solid> = solids.iter().filter(covering).collect();
        // Points of one solid are shared already.
        let mut known: Option<BTreeMap<[i64; 3], u32>> =
            (covering.len() > 1).then(BTreeMap::default);
        let mut rims: Rims = Vec::new();
        for solid in covering {
            surface.add(solid, known.as_mut(), &mut rims);
        }
        rims.sort_by_key(|r| r.0);
        surface.find_edges(&rims);
        surface.lengthen_hips();
        surface
    }

    fn add(
        &mut self,
        solid: &Solid,
        mut known: Option<&mut BTreeMap<[i64; 3], u32>>,
        rims: &mut Rims,
    ) {
        let mut numbers = vec![u32::MAX; solid.points.len()];
        let mut number = |surface: &mut RoofSurface, i: u32| -> Option<u32> {
            let place = numbers.get_mut(i as usize)?;
            if *place == u32::MAX {
                *place = surface.number(solid.points[i as usize], known.as_deref_mut());
            }
            Some(*place)
        };
        for face in &solid.faces {
            if !matches!(face.finish, Finish::Covering(_) | Finish::Edge(_)) {
                continue;
            }
            let corners = face.corners.iter().filter_map(|i| number(self, *i));
            let corners: Corners = corners.collect();
            match face.finish {
                Finish::Covering(_) => self.facets.extend(facet(&self.points, corners)),
                _ => rim(&self.points, &corners, rims),
            }
        }
    }

    /// Returns the index of a point, or of an existing one at the same place.
    fn number(&mut self, p: DVec3, known: Option<&mut BTreeMap<[i64; 3], u32>>) -> u32 {
        let next = self.points.len() as u32;
        let number = known.map_or(next, |known| {
            let key = p.to_array().map(|x| (x / POINT).round() as i64);
            *known.entry(key).or_insert(next)
        });
        if number == next {
            self.points.push(p);
        }
        number
    }

    fn find_edges(&mut self, rims: &Rims) {
        let mut owners: Vec<((u32, u32), u32)> = Vec::with_capacity(4 * self.facets.len());
        for (n, facet) in self.facets.iter().enumerate() {
            owners.extend(sides(&facet.corners).map(|side| (side, n as u32)));
        }
        owners.sort_unstable();
        let owner = |side: (u32, u32)| {
            let at = owners.binary_search_by_key(&side, |o| o.0).ok()?;
            Some(owners[at].1)
        };
        let depth = |side: (u32, u32)| {
            let at = rims.binary_search_by_key(&side, |r| r.0).ok()?;
            Some(rims[at].1)
        };
        let mut edges = Vec::with_capacity(owners.len());
        for (n, facet) in self.facets.iter().enumerate() {
            for (from, to) in sides(&facet.corners) {
                let beside = match owner((to, from)) {
                    // Each inner edge is visited from both sides; one is enough.
                    Some(_) if from > to => continue,
                    Some(other) => Beside::Facet(other),
                    None => depth((from, to)).map_or(Beside::Wall, Beside::Open),
                };
                edges.push(self.edge([from, to], n as u32, beside));
            }
        }
        self.edges = edges;
    }

    fn edge(&self, ends: [u32; 2], facet: u32, beside: Beside) -> RoofEdge {
        let kind = self.kind(ends, facet, beside);
        let [from, to] = ends;
        match (kind, beside) {
            (EdgeKind::Hip, Beside::Facet(other)) if self.at(from).z > self.at(to).z => RoofEdge {
                kind,
                ends: [to, from],
                facet: other,
                beside: Beside::Facet(facet),
            },
            _ => RoofEdge {
                kind,
                ends,
                facet,
                beside,
            },
        }
    }

    fn kind(&self, [from, to]: [u32; 2], facet: u32, beside: Beside) -> EdgeKind {
        let facet = &self.facets[facet as usize];
        let way = self.at(to) - self.at(from);
        let run = way.truncate().length();
        if run < POINT {
            return EdgeKind::Fold;
        }
        let out = -way.truncate().perp() / run;
        match beside {
            Beside::Facet(other) => {
                let other = &self.facets[other as usize];
                if facet.fall().dot(other.fall()) > SAME_FALL {
                    return EdgeKind::Fold;
                }
                meeting(facet.rise, other.rise, way)
            }
            Beside::Open(_) => match facet.fall().dot(out) {
                low if low > 0.5 => EdgeKind::Eaves,
                high if high < -0.5 => EdgeKind::Crest,
                _ => EdgeKind::Verge,
            },
            Beside::Roof(_) | Beside::Wall => EdgeKind::Abutment,
        }
    }

    /// Makes level edges below the foot of a hip part of it: raised corners take back most of its fall.
    fn lengthen_hips(&mut self) {
        let points = &self.points;
        let way = |[from, to]: [u32; 2]| {
            let way = points[to as usize] - points[from as usize];
            way.truncate().normalize_or_zero()
        };
        let mut ridges: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        let mut feet: Vec<(u32, DVec2)> = vec![];
        for (n, edge) in self.edges.iter().enumerate() {
            match edge.kind {
                EdgeKind::Ridge => {
                    ridges.entry(edge.ends[0]).or_default().push(n);
                    ridges.entry(edge.ends[1]).or_default().push(n);
                }
                EdgeKind::Hip => feet.push((edge.ends[0], way(edge.ends))),
                _ => {}
            }
        }
        while let Some((foot, upward)) = feet.pop() {
            for n in ridges.get(&foot).into_iter().flatten() {
                let edge = &mut self.edges[*n];
                let up = match edge.ends[1] == foot {
                    true => *edge,
                    false => edge.turned(),
                };
                if edge.kind == EdgeKind::Ridge && way(up.ends).dot(upward) > SAME_FALL {
                    *edge = RoofEdge {
                        kind: EdgeKind::Hip,
                        ..up
                    };
                    feet.push((up.ends[0], way(up.ends)));
                }
            }
        }
    }

    /// Returns a point by its index.
    pub fn at(&self, point: u32) -> DVec3 {
        self.points[point as usize]
    }

    /// Returns the ends of an edge.
    pub fn ends(&self, edge: &RoofEdge) -> [DVec3; 2] {
        edge.ends.map(|end| self.at(end))
    }

    /// Returns the plan area of a facet, square metres.
    pub fn area(&self, facet: &RoofFacet) -> f64 {
        let corners = facet.corners.iter();
        let plan: Vec<DVec2> = corners.map(|i| self.at(*i).truncate()).collect();
        hsd_base::geometry::area2(&plan) / 2.0
    }

    /// Returns the lines of one kind: edges that continue each other straight in plan are joined. Hips run upwards.
    pub fn lines(&self, kind: EdgeKind) -> Vec<[DVec3; 2]> {
        let edges = self.edges.iter().filter(|e| e.kind == kind);
        let mut lines: Vec<[DVec3; 2]> = edges.map(|e| self.ends(e)).collect();
        let mut i = 0;
        while i < lines.len() {
            let next = (i + 1..lines.len()).find_map(|j| Some((j, straight(lines[i], lines[j])?)));
            match next {
                Some((j, line)) => {
                    lines.remove(j);
                    lines[i] = line;
                }
                None => i += 1,
            }
        }
        if kind == EdgeKind::Hip {
            let falling = lines.iter_mut().filter(|[from, to]| from.z > to.z);
            falling.for_each(|line| line.reverse());
        }
        lines
    }

    /// Returns the slopes: facets joined by folds, each as a list of facet indices in order.
    pub fn slopes(&self) -> Vec<Vec<u32>> {
        let mut slope: Vec<usize> = (0..self.facets.len()).collect();
        let find = |slope: &[usize], mut f: usize| {
            while slope[f] != f {
                f = slope[f];
            }
            f
        };
        for edge in self.edges.iter().filter(|e| e.kind == EdgeKind::Fold) {
            if let Beside::Facet(other) = edge.beside {
                let (f, g) = (
                    find(&slope, edge.facet as usize),
                    find(&slope, other as usize),
                );
                slope[f.max(g)] = f.min(g);
            }
        }
        let mut slopes = vec![vec![]; slope.len()];
        for f in 0..slope.len() {
            slopes[find(&slope, f)].push(f as u32);
        }
        slopes.retain(|s| !s.is_empty());
        slopes
    }
}

impl RoofEdge {
    /// Returns the same edge from its other facet; an edge of one facet stays as it is.
    #[must_use]
    pub fn turned(self) -> RoofEdge {
        match self.beside {
            Beside::Facet(other) => RoofEdge {
                ends: [self.ends[1], self.ends[0]],
                facet: other,
                beside: Beside::Facet(self.facet),
                ..self
            },
            _ => self,
        }
    }
}

/// Returns the kind of an edge between a slope to its left and another to its right, by their rises per metre.
pub fn meeting(left: DVec2, right: DVec2, way: DVec3) -> EdgeKind {
    let run = way.truncate().length();
    let out = -way.truncate().perp() / run;
    // The sum of the falls of the surface on both sides.
    let bend = left.dot(out) - right.dot(out);
    let level = way.z.abs() < LEVEL_SHARE * left.length().max(right.length()) * run;
    match (bend > 0.0, level) {
        (false, _) => EdgeKind::Valley,
        (true, true) => EdgeKind::Ridge,
        (true, false) => EdgeKind::Hip,
    }
}

fn sides(corners: &Corners) -> impl Iterator<Item = (u32, u32)> + '_ {
    let n = corners.len();
    (0..n).map(move |i| (corners[i], corners[(i + 1) % n]))
}

/// Adds a face of the covering; level and vertical ones have no fall.
fn facet(points: &[DVec3], corners: Corners) -> Option<RoofFacet> {
    let first = points[*corners.first()? as usize];
    let at = |i: usize| points[corners[i] as usize] - first;
    let normal: DVec3 = (1..corners.len().max(1) - 1)
        .map(|i| at(i).cross(at(i + 1)))
        .sum();
    if normal.z <= 1e-9 {
        return None;
    }
    let rise = -normal.truncate() / normal.z;
    (rise.length() > LEVEL).then_some(RoofFacet { corners, rise })
}

/// Returns the edge from which a face of the rim hangs, and its depth at both ends: the edge of its two highest
/// adjacent corners with something under them.
fn rim(points: &[DVec3], corners: &Corners, rims: &mut Rims) {
    let below = |id: u32| {
        let top = points[id as usize];
        let under = corners.iter().map(|i| points[*i as usize]);
        let under = under.filter(|p| (p.truncate() - top.truncate()).length() < 1e-4);
        under.map(|p| top.z - p.z).fold(0.0, f64::max)
    };
    for (from, to) in sides(corners) {
        let depth = [below(to), below(from)];
        if depth[0] > 0.0 || depth[1] > 0.0 {
            // The face above traverses it in the opposite direction.
            rims.push(((to, from), depth));
        }
    }
}

/// Joins two lines, if they share an end and continue straight in plan.
fn straight(one: [DVec3; 2], other: [DVec3; 2]) -> Option<[DVec3; 2]> {
    let [p, q] = one;
    let [r, s] = other;
    let ways = [(p, q, r, s), (p, q, s, r), (q, p, r, s), (q, p, s, r)];
    ways.into_iter().find_map(|(from, shared, end, to)| {
        let way = |a: DVec3, b: DVec3| (b - a).truncate().normalize_or_zero();
        let goes_on = way(from, shared).dot(way(end, to)) > 1.0 - 1e-9;
        (shared.distance(end) < POINT && goes_on).then_some([from, to])
    })
}
