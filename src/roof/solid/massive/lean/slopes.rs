//! The solid of plain slopes on one wall plate, before anything divides them.
//!
//! What is not upright is known from the plan: each plane shows where no other slope is higher, its lower surface
//! where it lies neither over the attic nor on another roof, and the floor under the attic. Their borders ([`areas`])
//! leave edges that no other of these faces has; upright faces close them, stretch by stretch ([`stretches`]). So no
//! slope is cut into convex pieces and no faces are merged but upright ones.
//!
//! [`areas`]: super::areas
//! [`stretches`]: super::stretches

use crate::ast::RoofKind;
use crate::building::{Finish, Solid};
use crate::geometry::tolerance::SLIVER;
use crate::roof::facet::{Convex, Corner, HalfPlane, Higher, area};
use crate::roof::frame::Plane;
use crate::roof::solid::massive::closed;
use crate::roof::solid::massive::lean::areas::{Area, Line, Lists, Plan, Region};
use crate::roof::solid::massive::lean::corners::welded;
use crate::roof::solid::massive::lean::faces::{self, Patches};
use crate::roof::solid::massive::lean::heights::Heights;
use crate::roof::solid::massive::lean::plan::upward;
use crate::roof::solid::massive::lean::stretches::{self, CORNER_BITS, Kind, Stretch, Surface};
use crate::roof::solid::massive::lean::{is_seen, is_sound};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use std::ops::Range;

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

/// The properties that all slopes of a solid share.
pub(in crate::roof) struct Plate {
    /// Their vertical thickness, metres.
    pub(in crate::roof) drop: f64,
    /// The floor of the attic, metres; `None` if there is none below.
    pub(in crate::roof) floor: Option<f64>,
    /// Their covering.
    pub(in crate::roof) kind: RoofKind,
}

/// Returns the solids of some slopes; none if they meet in a way that only the general union knows.
pub(in crate::roof) fn united(slopes: &[Slope], plate: &Plate) -> Option<Vec<Solid>> {
    if slopes.len() > MOST {
        return None;
    }
    let borders = Borders::of(slopes, plate);
    let edges = Edges::of(&borders)?;
    let patches = edges.patches(&borders.surfaces, plate)?;
    let faces = faces::merged(&edges.points, &patches)?;
    let mut solids = closed::bounded(&edges.points, faces)?;
    solids.retain(is_seen);
    (!solids.is_empty() && solids.iter().all(is_sound)).then_some(solids)
}

/// The borders of all surfaces.
#[derive(Default)]
struct Borders {
    surfaces: Vec<Surface>,
    /// With the surface on the left, those of each surface together.
    lines: Vec<Line>,
    /// Where those of each surface end in the list of lines.
    ends: Vec<u32>,
}

/// The areas of a slope.
struct Areas<'s> {
    slope: &'s Slope,
    /// The number of its plane, and that plane.
    plane: usize,
    top: Plane,
    outline: Area,
    body: Area,
    filled: Option<Area>,
    verges: SmallVec<[Area; 2]>,
}

impl Areas<'_> {
    /// Adds the part of its body that lies above a plane and may lie over some slopes.
    fn above(&self, plane: Plane, own: &[Area], plan: &mut Plan, areas: &mut Vec<Area>) {
        let near = |area: &Area| own.iter().any(|o| o.is_near(area));
        match HalfPlane::where_higher(self.top, plane) {
            _ if !near(&self.body) => {}
            Higher::Nowhere => {}
            Higher::Everywhere => areas.push(self.body),
            Higher::Inside(side) => {
                areas.extend(plan.area(&side.inside(&self.slope.body)).filter(near));
            }
        }
    }
}

/// Where slopes in one plane are not seen.
#[derive(Default)]
struct Hidden {
    /// The outlines of the slopes.
    outlines: Vec<Area>,
    /// Where another takes their place.
    covered: Vec<Area>,
    /// Where they would lie in the thickness of a verge above them.
    within: Vec<Area>,
    /// Where their own verges lie upon another, or where they lie over the attic.
    below: Vec<Area>,
}

impl Borders {
    fn of(slopes: &[Slope], plate: &Plate) -> Borders {
        let mut plan = Plan::with_capacity(24 * slopes.len());
        let mut planes: Vec<Plane> = Vec::with_capacity(slopes.len());
        let mut areas: Vec<Areas<'_>> = Vec::with_capacity(slopes.len());
        areas.extend(
            slopes
                .iter()
                .filter_map(|slope| Borders::areas(slope, plate, &mut plan, &mut planes)),
        );
        let mut borders = Borders {
            surfaces: Vec::with_capacity(2 * planes.len() + 1),
            lines: Vec::with_capacity(24 * slopes.len()),
            ends: Vec::with_capacity(2 * planes.len() + 1),
        };
        let mut hidden = Hidden::default();
        let mut scratch = (Lists::default(), Vec::with_capacity(32));
        for (number, plane) in planes.iter().enumerate() {
            hidden.find((number, *plane), &areas, plate.drop, &mut plan);
            borders.slope(*plane, plate.drop, &hidden, &plan, &mut scratch);
        }
        let attic: SmallVec<[Area; 16]> = areas.iter().filter_map(|a| a.filled).collect();
        let attic = Region {
            plan: &plan,
            with: &attic,
            without: &[],
        };
        attic.border(&mut scratch.0, &mut borders.lines);
        borders.end(Plane::level(plate.floor.unwrap_or_default()), Kind::Floor);
        borders
    }

    /// Returns the areas of a slope; none of a sliver.
    fn areas<'s>(
        slope: &'s Slope,
        plate: &Plate,
        plan: &mut Plan,
        planes: &mut Vec<Plane>,
    ) -> Option<Areas<'s>> {
        let known = planes.iter().position(|p| is_same(*p, slope.top));
        let plane = known.unwrap_or(planes.len());
        if known.is_none() {
            planes.push(slope.top);
        }
        let low = slope.top.raised(-plate.drop);
        let filled = (plate.floor).map(|floor| higher(&slope.body, low, Plane::level(floor)));
        let outline = plan.area(&slope.outline)?;
        let body = match slope.verges.is_empty() {
            true => None,
            false => plan.area(&slope.body),
        };
        Some(Areas {
            slope,
            plane,
            top: planes[plane],
            outline,
            body: body.unwrap_or(outline),
            filled: filled.and_then(|filled| plan.area(&filled)),
            verges: slope.verges.iter().filter_map(|v| plan.area(v)).collect(),
        })
    }

    /// Adds the upper and the lower surface of all slopes in one plane, of which some is hidden.
    fn slope(
        &mut self,
        top: Plane,
        drop: f64,
        hidden: &Hidden,
        plan: &Plan,
        (lists, upper): &mut (Lists, Vec<Line>),
    ) {
        let region = Region {
            plan,
            with: &hidden.outlines,
            without: &hidden.covered,
        };
        upper.clear();
        region.border(lists, upper);
        match hidden.within.is_empty() {
            true => self.lines.extend_from_slice(upper),
            false => region.less(upper, &hidden.within, lists, &mut self.lines),
        }
        self.end(top, Kind::Top);
        region.less(upper, &hidden.below, lists, &mut self.lines);
        self.end(top.raised(-drop), Kind::Low);
    }

    /// Ends the border of a surface, whose lines have been added.
    fn end(&mut self, plane: Plane, kind: Kind) {
        self.ends.push(self.lines.len() as u32);
        self.surfaces.push(Surface { plane, kind });
    }

    /// Returns the lines of each surface, with its number.
    fn by_surface(&self) -> impl Iterator<Item = (u32, Range<usize>)> {
        let mut from = 0;
        (0..).zip(&self.ends).map(move |(number, end)| {
            let own = from..*end as usize;
            from = own.end;
            (number, own)
        })
    }
}

impl Hidden {
    /// Finds where the slopes in one plane are not seen.
    fn find(
        &mut self,
        (number, top): (usize, Plane),
        areas: &[Areas<'_>],
        drop: f64,
        plan: &mut Plan,
    ) {
        let Hidden {
            outlines,
            covered,
            within,
            below,
        } = self;
        outlines.clear();
        covered.clear();
        within.clear();
        below.clear();
        let own = || areas.iter().filter(|a| a.plane == number);
        outlines.extend(own().map(|a| a.outline));
        for other in areas.iter().filter(|a| a.plane != number) {
            if !outlines.iter().any(|o| o.is_near(&other.outline)) {
                continue;
            }
            other.above(top, outlines, plan, covered);
            for (verge, area) in other.slope.verges.iter().zip(&other.verges) {
                if outlines.iter().any(|o| o.is_near(area)) {
                    within.extend(plan.area(&between(verge, top, other.top, drop)));
                }
            }
            let verges = own().flat_map(|a| a.slope.verges.iter().zip(&a.verges));
            for (verge, _) in verges.filter(|v| other.outline.is_near(v.1)) {
                let upper = between(verge, other.top, top, drop);
                if area(&upper) > SLIVER {
                    let common = plan.common(other.outline, &upper);
                    below.extend(plan.area(&common));
                }
            }
        }
        below.extend(own().filter_map(|a| a.filled));
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
        Higher::Inside(side) => side.inside(outline),
    }
}

/// Returns the part of a convex outline where a plane lies in a slab below another.
fn between(outline: &[Corner], plane: Plane, top: Plane, drop: f64) -> Convex {
    higher(&higher(outline, top, plane), plane, top.raised(-drop))
}

/// The borders on shared corners and points.
struct Edges {
    corners: Vec<DVec2>,
    points: Vec<DVec3>,
    /// Those over one stretch of the plan together, from below.
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
    /// Puts borders on shared corners and points; none if there are too many.
    fn of(borders: &Borders) -> Option<Edges> {
        let (mut corners, ends) = welded(borders.lines.as_flattened());
        if corners.len() + borders.lines.len() >= 1 << CORNER_BITS {
            return None;
        }
        let surfaces = &borders.surfaces;
        let mut whole: Vec<Stretch> = Vec::with_capacity(borders.lines.len());
        for (surface, lines) in borders.by_surface() {
            let ends = ends[2 * lines.start..2 * lines.end].chunks_exact(2);
            let ends = ends.filter(|ends| ends[0] != ends[1]);
            whole.extend(ends.map(|ends| Stretch::new(ends[0], ends[1], surface)));
        }
        let mut stretches = stretches::passing(whole, &corners);
        stretches::divide(&mut stretches, surfaces, &mut corners);
        let mut heights = Heights::over(corners.len(), 3 * stretches.len());
        let mut all: Vec<Edge> = Vec::with_capacity(stretches.len());
        all.extend(stretches.iter().map(|stretch| {
            let (low, high) = stretch.over();
            let [z, top] = stretch.heights(surfaces, &corners);
            Edge {
                over: (low, high),
                ends: [heights.number(low, z), heights.number(high, top)],
                left: stretch.is_left(),
                surface: stretch.surface(),
            }
        }));
        let (points, number) = heights.points(&corners);
        for same in all.chunk_by_mut(|e, f| e.over == f.over) {
            for edge in &mut *same {
                edge.ends = edge.ends.map(|n| number[n as usize]);
            }
            same.sort_unstable_by_key(|e| e.ends);
        }
        Some(Edges {
            corners,
            points,
            all,
        })
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
        let mut below: Option<&[Edge]> = None;
        for level in same.chunk_by(|e, f| e.ends == f.ends) {
            let high = level[0].ends;
            if let Some(below) = below.filter(|_| net != 0) {
                let low = below[0].ends;
                let slab = level
                    .iter()
                    .any(|e| kind(e) == Kind::Top && more(e) == -net);
                if slab && below.iter().any(|e| kind(e) == Kind::Floor) {
                    // A wall without a verge over it.
                    return None;
                }
                let finish = match slab {
                    true => Finish::Edge(plate.kind),
                    false => Finish::Gable,
                };
                self.stand([low, high], net, same[0].over, finish, patches)?;
            }
            net += level.iter().map(more).sum::<i32>();
            below = Some(level);
        }
        (net == 0).then_some(())
    }

    /// Adds the upright face between two edges over a stretch that is filled on the left (1) or on the right (-1).
    fn stand(
        &self,
        [low, high]: [[u32; 2]; 2],
        net: i32,
        over: (u32, u32),
        finish: Finish,
        patches: &mut Patches,
    ) -> Option<()> {
        if net.abs() > 1 || low[1] > high[1] {
            return None;
        }
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
