//! The common surface of vertical columns, each between two planes over a convex outline.
//!
//! Every column is a closed solid of its own; their surfaces are added up and what lies between two columns falls out.
//! All of that happens on numbers of shared points: corners are welded first, put into the edges that they lie on, and
//! edges of different height that cross get a corner there. So the sum is closed whatever the columns are.

use crate::frame::Plane;
use crate::solid::massive::closed;
use crate::solid::massive::merge::Polygon;
use crate::solid::sheet::Sorted;
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::JOINT;
use hsd_ir::building::{Corners, Finish, Solid};

/// Corners nearer in plan are one, metres.
const WELD: f64 = 2e-5;
/// The maximum number of rounds of splitting crossing edges.
const ROUNDS: usize = 4;

/// A corner of a column, and the finish of the vertical face that starts there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) at: DVec2,
    pub(super) finish: Finish,
}

/// The volume over a convex outline between two planes.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// Counter-clockwise seen from above.
    pub(super) ring: Vec<Side>,
    pub(super) top: Plane,
    pub(super) bottom: Plane,
    /// The finish of its upper face; `None` where another column continues above.
    pub(super) lid: Option<Finish>,
    /// The finish of its lower face; `None` if another column continues below.
    pub(super) floor: Option<Finish>,
}

/// Returns the union of the columns as closed solids; `None` if an edge would belong to more than two faces of one.
pub(super) fn union(columns: &[Column]) -> Option<Vec<Solid>> {
    let mut plan = Plan::of(columns);
    for _ in 0..ROUNDS {
        plan.conform();
        if !plan.cross(columns) {
            break;
        }
    }
    plan.rings.iter_mut().for_each(drop_flat);
    let heights = Heights::of(&plan, columns);
    let mut faces = heights.lids(&plan, columns);
    heights.walls(&plan, columns, &mut faces)?;
    closed::solids(heights.points, &heights.starts, faces)
}

/// A column's outline by the numbers of its corners.
type Ring = Vec<(u32, Finish)>;

/// The outlines of all columns on shared corners.
struct Plan {
    /// z is 0.
    corners: Vec<DVec3>,
    rings: Vec<Ring>,
}

/// One side of a column on a piece of an edge, starting at the corner with the lower number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Stretch {
    lo: u32,
    hi: u32,
    column: u32,
    /// True if the column lies to the left.
    left: bool,
    finish: Finish,
}

impl Plan {
    fn of(columns: &[Column]) -> Plan {
        let sides = columns.iter().flat_map(|c| &c.ring);
        let mut order: Vec<(DVec2, u32)> = sides.zip(0..).map(|(s, n)| (s.at, n)).collect();
        order.sort_by(|p, q| p.0.x.total_cmp(&q.0.x).then(p.0.y.total_cmp(&q.0.y)));
        let mut number = vec![0; order.len()];
        let mut corners: Vec<DVec3> = vec![];
        for (at, n) in order {
            let start = corners.partition_point(|c| c.x < at.x - WELD);
            let same = |c: &DVec3| (c.x - at.x).abs() < WELD && (c.y - at.y).abs() < WELD;
            let near = corners[start..].iter().position(same).map(|k| start + k);
            let id = near.unwrap_or_else(|| {
                corners.push(at.extend(0.0));
                corners.len() - 1
            });
            number[n as usize] = id as u32;
        }
        let mut numbers = number.into_iter();
        let ring = |c: &Column| {
            let mut ring: Ring = Vec::with_capacity(c.ring.len() + 2);
            for (side, id) in c.ring.iter().zip(&mut numbers) {
                // The later of two equal corners starts the edge.
                if ring.last().is_some_and(|l| l.0 == id) {
                    ring.pop();
                }
                ring.push((id, side.finish));
            }
            if ring.len() > 1 && ring[0].0 == ring[ring.len() - 1].0 {
                ring.pop();
            }
            ring
        };
        let rings = columns.iter().map(ring).collect();
        Plan { corners, rings }
    }

    /// Inserts corners into the edges that they lie on.
    fn conform(&mut self) {
        let sorted = Sorted::of(&self.corners);
        let corners = &self.corners;
        for ring in &mut self.rings {
            let mut whole = Ring::with_capacity(ring.len() + 2);
            for (i, &(from, finish)) in ring.iter().enumerate() {
                let to = ring[(i + 1) % ring.len()].0;
                whole.push((from, finish));
                let [p, q] = [from, to].map(|c| corners[c as usize].truncate());
                let way = (q - p).normalize_or_zero();
                let (lo, hi) = (p.min(q) - WELD, p.max(q) + WELD);
                let on = |id: u32| {
                    let r = corners[id as usize].truncate();
                    let inside = r.cmpge(lo).all() && r.cmple(hi).all();
                    let on = inside && way.perp_dot(r - p).abs() < WELD;
                    on.then(|| (way.dot(r - p), id))
                };
                let near = sorted.near(lo, hi).iter().map(|n| n.1);
                let mut found: Vec<(f64, u32)> = near
                    .filter(|id| *id != from && *id != to)
                    .filter_map(on)
                    .collect();
                found.sort_by(|a, b| a.0.total_cmp(&b.0));
                whole.extend(found.into_iter().map(|(_, id)| (id, finish)));
            }
            *ring = whole;
        }
    }

    fn stretches(&self) -> Vec<Stretch> {
        let mut all = Vec::with_capacity(self.rings.len() * 6);
        for (ring, column) in self.rings.iter().zip(0..) {
            for (i, &(p, finish)) in ring.iter().enumerate() {
                let q = ring[(i + 1) % ring.len()].0;
                all.push(Stretch {
                    lo: p.min(q),
                    hi: p.max(q),
                    column,
                    left: p < q,
                    finish,
                });
            }
        }
        all.sort_unstable();
        all
    }

    /// Adds corners where upper or lower edges over one stretch cross; returns whether there were any.
    fn cross(&mut self, columns: &[Column]) -> bool {
        let before = self.corners.len();
        let stretches = self.stretches();
        for same in stretches.chunk_by(|s, t| (s.lo, s.hi) == (t.lo, t.hi)) {
            let [p, q] = [same[0].lo, same[0].hi].map(|c| self.corners[c as usize].truncate());
            let of = |s: &Stretch| {
                let column = &columns[s.column as usize];
                [column.top, column.bottom].map(|plane| [plane.at(p), plane.at(q)])
            };
            let edges: Vec<[f64; 2]> = same.iter().flat_map(of).collect();
            for (i, e) in edges.iter().enumerate() {
                for f in &edges[i + 1..] {
                    let (d, g) = (e[0] - f[0], e[1] - f[1]);
                    if d * g < 0.0 && d.abs().min(g.abs()) > JOINT {
                        let at = p.lerp(q, d / (d - g));
                        let near = |c: &DVec3| c.truncate().distance(at) < WELD;
                        if !near(&p.extend(0.0))
                            && !near(&q.extend(0.0))
                            && !self.corners[before..].iter().any(near)
                        {
                            self.corners.push(at.extend(0.0));
                        }
                    }
                }
            }
        }
        self.corners.len() > before
    }
}

/// Clears an outline that welding has collapsed to a line.
fn drop_flat(ring: &mut Ring) {
    let mut ids: Vec<u32> = ring.iter().map(|c| c.0).collect();
    ids.sort_unstable();
    if ids.len() < 3 || ids.windows(2).any(|w| w[0] == w[1]) {
        ring.clear();
    }
}

/// The points over each corner, in ascending order.
struct Heights {
    points: Vec<DVec3>,
    /// The first index of the points over each corner.
    starts: Vec<u32>,
    /// The points above and below each corner of each ring.
    rings: Vec<Vec<[u32; 2]>>,
}

impl Heights {
    fn of(plan: &Plan, columns: &[Column]) -> Heights {
        let mut all: Vec<(u32, f64)> = vec![];
        let rings = || plan.rings.iter().zip(columns);
        for (ring, column) in rings() {
            for (id, _) in ring {
                let at = plan.corners[*id as usize].truncate();
                all.extend([column.top, column.bottom].map(|plane| (*id, plane.at(at))));
            }
        }
        all.sort_by(|p, q| p.0.cmp(&q.0).then(p.1.total_cmp(&q.1)));
        let mut points: Vec<DVec3> = vec![];
        let mut starts = vec![];
        let mut last = None;
        for (id, z) in all {
            while starts.len() <= id as usize {
                starts.push(points.len() as u32);
                last = None;
            }
            if last.is_none_or(|l: f64| z - l > JOINT) {
                points.push(plan.corners[id as usize].truncate().extend(z));
                last = Some(z);
            }
        }
        starts.resize(plan.corners.len() + 1, points.len() as u32);
        let point = |id: u32, plane: Plane| {
            let at = plan.corners[id as usize].truncate();
            let (from, to) = (starts[id as usize], starts[id as usize + 1]);
            let own = &points[from as usize..to as usize];
            // The last that begins no higher.
            let next = own.partition_point(|p| p.z <= plane.at(at)) as u32;
            from + next.saturating_sub(1)
        };
        let of = |(ring, column): (&Ring, &Column)| {
            let both =
                |(id, _): &(u32, Finish)| [point(*id, column.top), point(*id, column.bottom)];
            ring.iter().map(both).collect()
        };
        let numbered = rings().map(of).collect();
        Heights {
            points,
            starts,
            rings: numbered,
        }
    }

    /// Adds upper and lower faces.
    fn lids(&self, plan: &Plan, columns: &[Column]) -> Vec<Polygon> {
        let mut faces = Vec::with_capacity(columns.len() * 4);
        for (ring, column) in self.rings.iter().zip(columns) {
            if ring.is_empty() {
                continue;
            }
            if let Some(finish) = column.lid {
                faces.push((ring.iter().map(|p| p[0]).collect(), finish));
            }
            if let Some(finish) = column.floor {
                faces.push((ring.iter().rev().map(|p| p[1]).collect(), finish));
            }
        }
        debug_assert_eq!(plan.rings.len(), columns.len());
        faces
    }

    /// Adds vertical faces: over each stretch, the heights filled on one side only.
    fn walls(&self, plan: &Plan, columns: &[Column], faces: &mut Vec<Polygon>) -> Option<()> {
        debug_assert_eq!(plan.rings.len(), columns.len());
        let stretches = plan.stretches();
        for same in stretches.chunk_by(|s, t| (s.lo, s.hi) == (t.lo, t.hi)) {
            let sides: Vec<Upright> = same.iter().map(|s| self.upright(plan, s)).collect();
            let mut edges: Vec<[u32; 2]> = sides.iter().flat_map(|s| [s.top, s.bottom]).collect();
            edges.sort_unstable();
            edges.dedup();
            let mut open: Option<(i32, Finish, [u32; 2], [u32; 2])> = None;
            for pair in edges.windows(2) {
                let (low, high) = (pair[0], pair[1]);
                if low[1] > high[1] {
                    return None;
                }
                let here = |s: &&Upright| s.covers(low, high);
                let net: i32 = sides.iter().filter(here).map(|s| s.sign).sum();
                let own = sides.iter().filter(here).rfind(|s| s.sign * net > 0);
                open = match (open, own) {
                    (Some((n, f, from, to)), Some(s)) if n == net && f == s.finish && to == low => {
                        Some((n, f, from, high))
                    }
                    (before, own) => {
                        faces.extend(before.into_iter().flat_map(upright_faces));
                        own.map(|s| (net, s.finish, low, high))
                    }
                };
            }
            faces.extend(open.into_iter().flat_map(upright_faces));
        }
        Some(())
    }

    fn upright(&self, plan: &Plan, s: &Stretch) -> Upright {
        let ring = &plan.rings[s.column as usize];
        let points = &self.rings[s.column as usize];
        let n = ring.len();
        let edge = (0..n).find(|i| {
            let (p, q) = (ring[*i].0, ring[(i + 1) % n].0);
            (p.min(q), p.max(q)) == (s.lo, s.hi)
        });
        let at = edge.unwrap_or_default();
        let (p, q) = (points[at], points[(at + 1) % n]);
        let (p, q) = if s.left { (p, q) } else { (q, p) };
        Upright {
            top: [p[0], q[0]],
            bottom: [p[1], q[1]],
            sign: if s.left { 1 } else { -1 },
            finish: s.finish,
        }
    }
}

/// The vertical side of a column over a stretch.
struct Upright {
    top: [u32; 2],
    bottom: [u32; 2],
    sign: i32,
    finish: Finish,
}

impl Upright {
    fn covers(&self, low: [u32; 2], high: [u32; 2]) -> bool {
        let below = |p: [u32; 2], q: [u32; 2]| p[0] <= q[0] && p[1] <= q[1];
        below(self.bottom, low) && below(high, self.top)
    }
}

/// Adds the faces between two edges, as many as there are more columns on this side than on the other.
fn upright_faces(
    (net, finish, low, high): (i32, Finish, [u32; 2], [u32; 2]),
) -> impl Iterator<Item = Polygon> {
    let mut corners = Corners::from_slice(&low);
    corners.extend((high[1] != low[1]).then_some(high[1]));
    corners.extend((high[0] != low[0]).then_some(high[0]));
    if net < 0 {
        corners.reverse();
    }
    let face = (corners.len() > 2).then_some((corners, finish));
    face.into_iter()
        .flat_map(move |f| std::iter::repeat_n(f, net.unsigned_abs() as usize))
}
