//! The solid of plain slopes on one wall plate, before anything divides them.
//!
//! What is not upright is known from the plan: each plane shows where no other slope is higher, its lower surface
//! where it lies neither over the attic nor on another roof, and the floor under the attic. Their borders ([`areas`])
//! leave edges that no other of these faces has; upright faces close them, stretch by stretch. So no slope is cut into
//! convex pieces and no faces are merged but upright ones.
//!
//! [`areas`]: super::areas

use crate::ast::RoofKind;
use crate::building::{Finish, Solid};
use crate::geometry::tolerance::{JOINT, SLIVER};
use crate::roof::facet::{Convex, Corner, HalfPlane, Higher, area, sides_of};
use crate::roof::frame::Plane;
use crate::roof::solid::massive::closed;
use crate::roof::solid::massive::lean::areas::{Area, Region};
use crate::roof::solid::massive::lean::faces::{self, Patches};
use crate::roof::solid::massive::lean::heights::Heights;
use crate::roof::solid::massive::lean::plan::{WELD, upward};
use crate::roof::solid::massive::lean::{is_seen, is_sound};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

/// More slopes go the general way, since every one is compared with all others here.
const MOST: usize = 48;

/// A slope of a roof over an attic.
pub(in crate::roof) struct Slope {
    /// Its convex outline, counter-clockwise.
    pub(in crate::roof) outline: Convex,
    /// The convex part of it that takes the place of lower slopes: without verges, with its gable walls.
    pub(in crate::roof) body: Convex,
    /// The parts of it beyond, which stand over lower slopes.
    pub(in crate::roof) verges: SmallVec<[Convex; 2]>,
    /// Its upper surface.
    pub(in crate::roof) top: Plane,
}

/// What all slopes have in common.
pub(in crate::roof) struct Plate {
    /// Their vertical thickness, metres.
    pub(in crate::roof) drop: f64,
    /// The floor of the attic, metres.
    pub(in crate::roof) floor: f64,
    /// Their covering.
    pub(in crate::roof) kind: RoofKind,
}

/// Returns the solids of some slopes; none if they meet in a way that only the general union knows.
pub(in crate::roof) fn united(slopes: &[Slope], plate: &Plate) -> Option<Vec<Solid>> {
    if slopes.len() > MOST {
        return None;
    }
    let borders = Borders::of(slopes, plate);
    let edges = Edges::of(&borders);
    let patches = edges.patches(&borders.surfaces, plate)?;
    let faces = faces::merged(&edges.points, &patches)?;
    let mut solids = closed::bounded(&edges.points, faces)?;
    solids.retain(is_seen);
    (!solids.is_empty() && solids.iter().all(is_sound)).then_some(solids)
}

/// A surface that is not upright.
struct Surface {
    plane: Plane,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// The upper surface of slopes.
    Top,
    /// Their lower surface.
    Low,
    Floor,
}

/// The borders of all surfaces.
#[derive(Default)]
struct Borders {
    surfaces: Vec<Surface>,
    /// From and to, with the surface on the left.
    lines: Vec<(DVec2, DVec2, u32)>,
}

/// The areas of a slope.
struct Areas {
    /// The number of its plane.
    plane: usize,
    top: Plane,
    outline: Area,
    filled: Option<Area>,
}

impl Borders {
    fn of(slopes: &[Slope], plate: &Plate) -> Borders {
        let floor = Plane::level(plate.floor);
        let mut planes: Vec<Plane> = Vec::with_capacity(8);
        let of = |slope: &Slope| {
            let known = planes.iter().position(|p| is_same(*p, slope.top));
            let plane = known.unwrap_or(planes.len());
            if known.is_none() {
                planes.push(slope.top);
            }
            let filled = higher(&slope.body, slope.top.raised(-plate.drop), floor);
            Some(Areas {
                plane,
                top: planes[plane],
                outline: Area::of(&slope.outline)?,
                filled: Area::of(&filled),
            })
        };
        let areas: Vec<Option<Areas>> = slopes.iter().map(of).collect();
        let mut borders = Borders::default();
        for (number, plane) in planes.iter().enumerate() {
            borders.slope((number, *plane), slopes, &areas, plate.drop);
        }
        let all = areas.iter().flatten().filter_map(|a| a.filled.as_ref());
        let attic = Region {
            with: all.collect(),
            ..Region::default()
        };
        borders.add(floor, Kind::Floor, &attic);
        borders
    }

    /// Adds the upper and the lower surface of all slopes in one plane.
    fn slope(
        &mut self,
        (number, top): (usize, Plane),
        slopes: &[Slope],
        areas: &[Option<Areas>],
        drop: f64,
    ) {
        let all = || slopes.iter().zip(areas);
        let all = || all().filter_map(|(s, a)| Some((s, a.as_ref()?)));
        let own = || all().filter(|(_, a)| a.plane == number);
        let near = |a: &Areas| own().any(|(_, o)| o.outline.is_near(&a.outline));
        let others = || all().filter(|(_, a)| a.plane != number && near(a));
        // Where another takes its place.
        let covered = others().filter_map(|(s, a)| Area::of(&higher(&s.body, a.top, top)));
        let covered: SmallVec<[Area; 8]> = covered.collect();
        // Where it would lie in the thickness of a verge above it.
        let within = others().flat_map(|(s, a)| {
            let verges = s.verges.iter();
            verges.filter_map(|v| Area::of(&between(v, top, a.top, drop)))
        });
        let within: SmallVec<[Area; 4]> = within.collect();
        // Where its own verges lie upon another.
        let upon = own().flat_map(|(s, _)| s.verges.iter()).flat_map(|v| {
            let touched = others().filter_map(|(s, a)| {
                let both = common(v, &s.outline)?;
                Area::of(&between(&both, a.top, top, drop))
            });
            touched.collect::<SmallVec<[Area; 4]>>()
        });
        let upon: SmallVec<[Area; 4]> = upon.collect();
        let outlines = || own().map(|(_, a)| &a.outline).collect();
        let upper = Region {
            with: outlines(),
            without: covered.iter().chain(&within).collect(),
        };
        self.add(top, Kind::Top, &upper);
        let filled = own().filter_map(|(_, a)| a.filled.as_ref());
        let lower = Region {
            with: outlines(),
            without: covered.iter().chain(&upon).chain(filled).collect(),
        };
        self.add(top.raised(-drop), Kind::Low, &lower);
    }

    fn add(&mut self, plane: Plane, kind: Kind, region: &Region<'_>) {
        let number = self.surfaces.len() as u32;
        region.border(|from, to| self.lines.push((from, to, number)));
        self.surfaces.push(Surface { plane, kind });
    }
}

fn is_same(one: Plane, other: Plane) -> bool {
    let slope = (one.slope - other.slope).abs().max_element();
    slope < 1e-9 && (one.z - other.z).abs() < 1e-6
}

/// Returns the part of a convex outline where one plane is higher than another.
fn higher(outline: &[Corner], upper: Plane, lower: Plane) -> Convex {
    match HalfPlane::where_higher(upper, lower) {
        Higher::Everywhere => Convex::from_slice(outline),
        Higher::Nowhere => Convex::new(),
        Higher::Inside(side) => {
            let [inside, _] = side.halves(outline);
            inside
        }
    }
}

/// Returns the part of a convex outline where a plane lies in a slab below another.
fn between(outline: &[Corner], plane: Plane, top: Plane, drop: f64) -> Convex {
    higher(&higher(outline, top, plane), plane, top.raised(-drop))
}

/// Returns what two convex outlines have in common; none if that is a sliver.
fn common(one: &[Corner], other: &[Corner]) -> Option<Convex> {
    let inside = sides_of(other)
        .iter()
        .fold(Convex::from_slice(one), |rest, side| {
            let [inside, _] = side.halves(&rest);
            inside
        });
    (area(&inside) > SLIVER).then_some(inside)
}

/// The borders on shared corners and points.
struct Edges {
    corners: Vec<DVec2>,
    points: Vec<DVec3>,
    /// Those over one stretch of the plan together.
    all: Vec<Edge>,
}

/// A part of a border between two corners.
#[derive(Clone, Copy)]
struct Edge {
    /// The lower corner, then the higher one.
    over: (u32, u32),
    /// The points over both.
    ends: [u32; 2],
    /// True if the surface lies to the left of the way from the lower corner to the higher one.
    left: bool,
    surface: u32,
}

impl Edges {
    fn of(borders: &Borders) -> Edges {
        let (corners, ends) = welded(&borders.lines);
        let mut heights = Heights::over(corners.len(), 3 * borders.lines.len());
        let mut all: Vec<Edge> = Vec::with_capacity(2 * borders.lines.len());
        let mut way: Vec<(f64, u32)> = Vec::with_capacity(8);
        for ((_, _, surface), [from, to]) in borders.lines.iter().zip(ends) {
            if from == to {
                continue;
            }
            let plane = borders.surfaces[*surface as usize].plane;
            stops(&corners, from, to, &mut way);
            for pair in way.windows(2) {
                let (p, q) = (pair[0].1, pair[1].1);
                let over = (p.min(q), p.max(q));
                let z = |c: u32| plane.at(corners[c as usize]);
                all.push(Edge {
                    over,
                    ends: [
                        heights.number(over.0, z(over.0)),
                        heights.number(over.1, z(over.1)),
                    ],
                    left: p < q,
                    surface: *surface,
                });
            }
        }
        let (points, number) = heights.points(&corners);
        for edge in &mut all {
            edge.ends = edge.ends.map(|n| number[n as usize]);
        }
        all.sort_unstable_by_key(|e| (e.over, e.ends));
        Edges {
            corners,
            points,
            all,
        }
    }

    /// Returns the faces of all surfaces, and the upright ones that close them; none if some edges find no other.
    fn patches(&self, surfaces: &[Surface], plate: &Plate) -> Option<Patches> {
        let mut patches = Patches::with_capacity(4 * self.all.len());
        let mut groups: SmallVec<[Option<u64>; 32]> = SmallVec::from_elem(None, surfaces.len());
        for edge in &self.all {
            let surface = &surfaces[edge.surface as usize];
            let group = *groups[edge.surface as usize].get_or_insert_with(|| {
                let up = upward(surface.plane);
                let at = self.points[edge.ends[0] as usize];
                match surface.kind {
                    Kind::Top => patches.group(up, at, Finish::Covering(plate.kind)),
                    Kind::Low | Kind::Floor => patches.group(-up, at, Finish::Soffit),
                }
            });
            let [p, q] = edge.ends;
            // Seen from below, the other way round.
            match edge.left == (surface.kind == Kind::Top) {
                true => patches.edge(p, q, group),
                false => patches.edge(q, p, group),
            }
        }
        for same in self.all.chunk_by(|e, f| e.over == f.over) {
            self.upright(same, surfaces, plate, &mut patches)?;
        }
        Some(patches)
    }

    /// Adds the upright faces over one stretch: the heights filled on one side only.
    fn upright(
        &self,
        same: &[Edge],
        surfaces: &[Surface],
        plate: &Plate,
        patches: &mut Patches,
    ) -> Option<()> {
        let kind = |e: &Edge| surfaces[e.surface as usize].kind;
        // What is filled to the left less what is filled to the right, above an edge.
        let more = |e: &Edge| match e.left == (kind(e) == Kind::Top) {
            true => -1,
            false => 1,
        };
        let mut net = 0_i32;
        let mut below: Option<[u32; 2]> = None;
        for level in same.chunk_by(|e, f| e.ends == f.ends) {
            let high = level[0].ends;
            if let Some(low) = below.filter(|_| net != 0) {
                let slab = level.iter().any(|e| kind(e) == Kind::Top && more(e) == -net);
                self.stand([low, high], net, same[0].over, (slab, plate), patches)?;
            }
            net += level.iter().map(more).sum::<i32>();
            below = Some(high);
        }
        (net == 0).then_some(())
    }

    /// Adds the upright face between two edges over a stretch that is filled on the left (1) or on the right (-1).
    fn stand(
        &self,
        [low, high]: [[u32; 2]; 2],
        net: i32,
        over: (u32, u32),
        (slab, plate): (bool, &Plate),
        patches: &mut Patches,
    ) -> Option<()> {
        if net.abs() > 1 || low[1] > high[1] {
            return None;
        }
        let tall = |k: usize| self.points[high[k] as usize].z - self.points[low[k] as usize].z;
        let finish = match slab {
            // A wall without a verge over it.
            true if tall(0).max(tall(1)) > plate.drop + JOINT => return None,
            true => Finish::Edge(plate.kind),
            false => Finish::Gable,
        };
        // Along the foot, up, back, down, through every point over both ends.
        let mut ring: SmallVec<[u32; 16]> = SmallVec::new();
        ring.push(low[0]);
        ring.extend(low[1]..=high[1]);
        ring.extend((low[0]..=high[0]).rev());
        ring.dedup();
        if ring.last() == ring.first() {
            ring.pop();
        }
        if ring.len() < 3 {
            return Some(());
        }
        if net < 0 {
            ring.reverse();
        }
        let (p, q) = (self.corners[over.0 as usize], self.corners[over.1 as usize]);
        let right = (q - p).normalize_or_zero().perp() * -1.0;
        let outward = (right * f64::from(net)).extend(0.0);
        let group = patches.group(outward, self.points[low[0] as usize], finish);
        patches.add(ring.iter().copied(), group);
        Some(())
    }
}

/// Returns the corners of all lines in ascending order of x, and the numbers of the ends of each line.
fn welded(lines: &[(DVec2, DVec2, u32)]) -> (Vec<DVec2>, Vec<[u32; 2]>) {
    let ends = lines.iter().flat_map(|(from, to, _)| [*from, *to]);
    let mut order: Vec<(DVec2, u32)> = ends.zip(0..).collect();
    order.sort_unstable_by(|p, q| p.0.x.total_cmp(&q.0.x).then(p.0.y.total_cmp(&q.0.y)));
    let mut numbers = vec![[0; 2]; lines.len()];
    let mut corners: Vec<DVec2> = Vec::with_capacity(lines.len());
    for (at, n) in order {
        let near = corners.iter().rev().take_while(|c| at.x - c.x < WELD);
        let same = near.enumerate().find(|(_, c)| (c.y - at.y).abs() < WELD);
        let number = match same.map(|s| s.0) {
            Some(back) => corners.len() - 1 - back,
            None => {
                corners.push(at);
                corners.len() - 1
            }
        };
        numbers[n as usize / 2][n as usize % 2] = number as u32;
    }
    (corners, numbers)
}

/// Replaces a list by the corners that a line passes through, its ends included, in their order with their places on it.
fn stops(corners: &[DVec2], from: u32, to: u32, way: &mut Vec<(f64, u32)>) {
    let (p, q) = (corners[from as usize], corners[to as usize]);
    let along = q - p;
    let (lo, hi) = (p.min(q) - WELD, p.max(q) + WELD);
    let most = WELD * WELD * along.length_squared();
    way.clear();
    way.push((0.0, from));
    let first = corners.partition_point(|c| c.x < lo.x);
    for (c, n) in corners[first..].iter().zip(first as u32..) {
        if c.x > hi.x {
            break;
        }
        if c.y < lo.y || c.y > hi.y || n == from || n == to {
            continue;
        }
        let off = along.perp_dot(c - p);
        if off * off < most {
            way.push((along.dot(c - p), n));
        }
    }
    if way.len() > 2 {
        way.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    }
    way.push((f64::INFINITY, to));
}
