//! The solid of plain slopes on one wall plate, before anything divides them.
//!
//! What is not upright is known from the plan: each plane shows where no other slope is higher, its lower surface
//! where it lies neither over the attic nor on another roof, and the floor under the attic. Their borders ([`areas`])
//! leave edges that no other of these faces has; upright faces close them, stretch by stretch ([`stretches`]). So no
//! slope is cut into convex pieces and no faces are merged but upright ones.
//!
//! [`areas`]: super::areas
//! [`stretches`]: super::stretches

use crate::frame::Plane;
use crate::solid::massive::closed;
use crate::solid::massive::lean::areas::{Area, Line, Lists, Plan, Region};
use crate::solid::massive::lean::corners::welded;
use crate::solid::massive::lean::faces::{self, Patches};
use crate::solid::massive::lean::heights::Heights;
use crate::solid::massive::lean::hidden::{Areas, Body, Hidden};
use crate::solid::massive::lean::plan::upward;
use crate::solid::massive::lean::stretches::{self, CORNER_BITS, Kind, Stretch, Surface};
use crate::solid::massive::lean::wings::{Plate, Wing};
use crate::solid::massive::lean::{is_seen, is_sound};
use glam::{DVec2, DVec3};
use hsd_ir::building::{Finish, Solid};
use smallvec::SmallVec;
use std::ops::Range;

/// More slopes go the general way, since every one is compared with all others here.
const MOST: usize = 48;

/// Returns the solids of the slopes of some wings; none if they meet in a way that only the general union knows.
pub(crate) fn united(wings: &[Wing], plate: &Plate) -> Option<Vec<Solid>> {
    if wings.iter().map(|w| w.slopes.len()).sum::<usize>() > MOST {
        return None;
    }
    let borders = Borders::of(wings, plate);
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

impl Borders {
    fn of(wings: &[Wing], plate: &Plate) -> Borders {
        let count = wings.iter().map(|w| w.slopes.len()).sum();
        let mut plan = Plan::with_capacity(48 * count);
        let mut planes: Vec<Plane> = Vec::with_capacity(count);
        let mut areas: Vec<Areas<'_>> = Vec::with_capacity(count);
        let mut ends: SmallVec<[usize; 8]> = SmallVec::new();
        for wing in wings {
            let own = |slope| Areas::of(slope, &mut plan, &mut planes);
            areas.extend(wing.slopes.iter().filter_map(own));
            ends.push(areas.len());
        }
        let mut bodies = Vec::with_capacity(count);
        let mut from = 0;
        for (wing, end) in wings.iter().zip(ends) {
            Body::add(wing, &areas[from..end], plate, &mut plan, &mut bodies);
            from = end;
        }
        let mut borders = Borders {
            surfaces: Vec::with_capacity(2 * planes.len() + 1),
            lines: Vec::with_capacity(24 * count),
            ends: Vec::with_capacity(2 * planes.len() + 1),
        };
        let mut hidden = Hidden::default();
        let mut scratch = (Lists::default(), Vec::with_capacity(32));
        for (number, plane) in planes.iter().enumerate() {
            hidden.find((number, *plane), (&areas, &bodies), plate.drop, &mut plan);
            borders.slope(*plane, plate.drop, &hidden, &plan, &mut scratch);
        }
        let attic: SmallVec<[Area; 16]> = bodies.iter().filter_map(|b| b.filled).collect();
        let attic = Region {
            plan: &plan,
            with: &attic,
            without: &[],
        };
        attic.border(&mut scratch.0, &mut borders.lines);
        borders.end(Plane::level(plate.floor.unwrap_or_default()), Kind::Floor);
        borders
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
