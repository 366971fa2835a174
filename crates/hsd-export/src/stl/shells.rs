//! The bodies of a mesh, each closed. Pictures of joinery, and walls seen from afar, are sheets without a back: a sheet gets
//! a back behind it and edges between both, whatever its shape.
//!
//! Bodies of one house overlap and are not united: slicers do that themselves, and a robust union of a hundred thousand
//! bodies needs a library of its own.

use glam::DVec3;
use std::collections::{BTreeMap, HashMap};

/// Points nearer than this are one, metres.
const WELD: f64 = 1e-5;

/// The number of directions of faces along which the thickness of a body is measured.
const DIRECTIONS: usize = 48;

/// The closed bodies of a mesh.
#[derive(Debug, Default)]
pub(super) struct Shells {
    /// Corners, metres.
    pub(super) points: Vec<DVec3>,
    /// Triangles, counter-clockwise seen from outside.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The thickness of each body, metres: the least of its extents along the normals of its faces.
    pub(super) thicknesses: Vec<f64>,
}

impl Shells {
    /// Finds the bodies of triangles and closes those that are open. Sheets become this thick, metres.
    pub(super) fn of<'p>(
        primitives: impl Iterator<Item = (&'p [[f32; 3]], &'p [u32])>,
        sheet: f64,
    ) -> Shells {
        let mut weld = Weld::default();
        let mut triangles: Vec<[u32; 3]> = vec![];
        for (positions, indices) in primitives {
            let numbers: Vec<u32> = positions
                .iter()
                .map(|p| weld.number(DVec3::from(p.map(f64::from))))
                .collect();
            let corners = indices.chunks_exact(3);
            let corners = corners.map(|t| [0, 1, 2].map(|k| numbers[t[k] as usize]));
            triangles.extend(corners.filter(|[a, b, c]| a != b && b != c && c != a));
        }
        let mut shells = Shells {
            points: weld.points,
            ..Shells::default()
        };
        for body in bodies(&triangles) {
            shells.add(body, sheet);
        }
        shells
    }

    fn add(&mut self, body: Vec<[u32; 3]>, sheet: f64) {
        let open = open_edges(&body);
        let thickness = match open.is_empty() {
            true => thickness(&self.points, &body),
            false => sheet,
        };
        self.thicknesses.push(thickness);
        self.triangles.extend_from_slice(&body);
        if !open.is_empty() {
            self.back(&body, open, sheet);
        }
    }

    /// Adds the back of a sheet, and its edges.
    fn back(&mut self, front: &[[u32; 3]], open: Vec<([u32; 2], i32)>, sheet: f64) {
        let mut normals: HashMap<u32, (DVec3, Vec<DVec3>)> = HashMap::new();
        for triangle in front {
            let normal = self.normal(*triangle);
            for corner in triangle {
                let (sum, all) = normals.entry(*corner).or_default();
                if !all.iter().any(|other| other.dot(normal) > 0.9999) {
                    *sum += normal;
                    all.push(normal);
                }
            }
        }
        let mut behind: HashMap<u32, u32> = HashMap::new();
        let mut order: Vec<u32> = normals.keys().copied().collect();
        order.sort_unstable();
        for corner in order {
            let (sum, all) = &normals[&corner];
            let way = sum.normalize_or(all[0]);
            // In a corner of two walls the back keeps its distance from both.
            let share = all.iter().map(|n| n.dot(way)).fold(1.0, f64::min).max(0.5);
            behind.insert(corner, self.points.len() as u32);
            self.points
                .push(self.points[corner as usize] - way * (sheet / share));
        }
        let back = front
            .iter()
            .map(|[a, b, c]| [behind[a], behind[c], behind[b]]);
        self.triangles.extend(back);
        for ([a, b], times) in open {
            let (a, b) = if times > 0 { (a, b) } else { (b, a) };
            let edge = [[b, a, behind[&a]], [b, behind[&a], behind[&b]]];
            for _ in 0..times.abs() {
                self.triangles.extend(edge);
            }
        }
    }

    fn normal(&self, [a, b, c]: [u32; 3]) -> DVec3 {
        let [a, b, c] = [a, b, c].map(|i| self.points[i as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    }
}

/// Numbers points, those that are nearly the same alike.
#[derive(Default)]
struct Weld {
    points: Vec<DVec3>,
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl Weld {
    fn number(&mut self, point: DVec3) -> u32 {
        // Whatever is near lies in one of the eight cells round the nearest corner of cells.
        let scaled = point / (2.0 * WELD);
        let [x, y, z] = scaled.round().to_array().map(|x| x as i64);
        for n in 0..8 {
            let cell = [x - (n & 1), y - ((n >> 1) & 1), z - (n >> 2)];
            let near = self.cells.get(&cell).into_iter().flatten();
            for known in near {
                if self.points[*known as usize].distance_squared(point) <= WELD * WELD {
                    return *known;
                }
            }
        }
        let number = self.points.len() as u32;
        self.points.push(point);
        let cell = scaled.floor().to_array().map(|x| x as i64);
        self.cells.entry(cell).or_default().push(number);
        number
    }
}

/// Returns the edges without a neighbour: how often each is used in its direction more than in the other.
fn open_edges(triangles: &[[u32; 3]]) -> Vec<([u32; 2], i32)> {
    let mut sums: HashMap<[u32; 2], i32> = HashMap::new();
    for ([a, b], way) in triangles.iter().flat_map(edges) {
        *sums.entry([a, b]).or_insert(0) += way;
    }
    let mut open: Vec<_> = sums.into_iter().filter(|(_, sum)| *sum != 0).collect();
    open.sort_unstable();
    open
}

/// Returns the edges of a triangle, from the lower to the higher number, with 1 if it runs that way, otherwise -1.
fn edges([a, b, c]: &[u32; 3]) -> [([u32; 2], i32); 3] {
    [[*a, *b], [*b, *c], [*c, *a]].map(|[p, q]| match p < q {
        true => ([p, q], 1),
        false => ([q, p], -1),
    })
}

/// Divides triangles into bodies: those that meet at an edge that only two of them have belong together. Pieces of a
/// body that touches itself are joined where that closes it.
fn bodies(triangles: &[[u32; 3]]) -> Vec<Vec<[u32; 3]>> {
    let mut uses: BTreeMap<[u32; 2], Vec<(u32, i32)>> = BTreeMap::new();
    for (number, triangle) in (0..).zip(triangles) {
        for (edge, way) in edges(triangle) {
            uses.entry(edge).or_default().push((number, way));
        }
    }
    let mut groups = Groups((0..triangles.len() as u32).collect());
    for list in uses.values() {
        if let [(a, way), (b, other)] = list[..]
            && way + other == 0
        {
            groups.join(a, b);
        }
    }
    // What is closed stands for itself.
    let mut sums: BTreeMap<([u32; 2], u32), i32> = BTreeMap::new();
    for (edge, list) in uses.iter().filter(|(_, list)| list.len() != 2) {
        for (number, way) in list {
            *sums.entry((*edge, groups.of(*number))).or_insert(0) += way;
        }
    }
    let mut crowded: BTreeMap<[u32; 2], (i32, Vec<u32>)> = BTreeMap::new();
    for ((edge, group), sum) in sums.into_iter().filter(|(_, sum)| *sum != 0) {
        let (whole, list) = crowded.entry(edge).or_default();
        *whole += sum;
        list.push(group);
    }
    for (_, list) in crowded.into_values().filter(|(whole, _)| *whole == 0) {
        for pair in list.windows(2) {
            groups.join(pair[0], pair[1]);
        }
    }
    let mut numbers: HashMap<u32, usize> = HashMap::new();
    let mut bodies: Vec<Vec<[u32; 3]>> = vec![];
    for (number, triangle) in (0..).zip(triangles) {
        let body = *numbers.entry(groups.of(number)).or_insert(bodies.len());
        if body == bodies.len() {
            bodies.push(vec![]);
        }
        bodies[body].push(*triangle);
    }
    bodies
}

/// Disjoint sets of triangles, each named by its least.
struct Groups(Vec<u32>);

impl Groups {
    fn of(&mut self, member: u32) -> u32 {
        let mut at = member;
        while self.0[at as usize] != at {
            let above = self.0[self.0[at as usize] as usize];
            self.0[at as usize] = above;
            at = above;
        }
        at
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

/// Returns the least extent of a body along the normals of its faces, metres.
fn thickness(points: &[DVec3], body: &[[u32; 3]]) -> f64 {
    let at = |i: &u32| points[*i as usize];
    let mut ways: Vec<DVec3> = vec![];
    for [a, b, c] in body {
        let normal = (at(b) - at(a)).cross(at(c) - at(a)).normalize_or_zero();
        let known = |way: &DVec3| way.dot(normal).abs() > 0.999;
        if normal != DVec3::ZERO && !ways.iter().any(known) {
            ways.push(normal);
            if ways.len() == DIRECTIONS {
                break;
            }
        }
    }
    let extent = |way: &DVec3| {
        let along = body.iter().flatten().map(|i| way.dot(at(i)));
        let (least, most) = along.fold((f64::MAX, f64::MIN), |(l, m), x| (l.min(x), m.max(x)));
        most - least
    };
    ways.iter().map(extent).reduce(f64::min).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: [[f32; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 3.0],
        [1.0, 0.0, 3.0],
        [1.0, 2.0, 3.0],
        [0.0, 2.0, 3.0],
    ];

    /// The sides of the block, each as two triangles: below, above, south, east, north, west.
    const SIDES: [[u32; 6]; 6] = [
        [0, 2, 1, 0, 3, 2],
        [4, 5, 6, 4, 6, 7],
        [0, 1, 5, 0, 5, 4],
        [1, 2, 6, 1, 6, 5],
        [2, 3, 7, 2, 7, 6],
        [3, 0, 4, 3, 4, 7],
    ];

    fn shells(sides: &[usize], others: &[[f32; 3]]) -> Shells {
        let indices: Vec<u32> = sides.iter().flat_map(|s| SIDES[*s]).collect();
        let moved: Vec<[f32; 3]> = CUBE.iter().chain(others).copied().collect();
        Shells::of([(&moved[..], &indices[..])].into_iter(), 0.1)
    }

    #[test]
    fn closed_bodies_stay_as_they_are() {
        let block = shells(&[0, 1, 2, 3, 4, 5], &[]);
        assert_eq!(block.triangles.len(), 12);
        assert_eq!(block.thicknesses, [1.0]);
    }

    #[test]
    fn sheets_get_a_back() {
        for sides in [&[2][..], &[2, 3], &[2, 3, 4, 5], &[1, 2, 3, 4, 5], &[2, 4]] {
            let sheet = shells(sides, &[]);
            assert!(open_edges(&sheet.triangles).is_empty(), "{sides:?}");
            let bodies = if sides == [2, 4] { 2 } else { 1 };
            assert_eq!(sheet.thicknesses, vec![0.1; bodies], "{sides:?}");
        }
        let pane = shells(&[2], &[]);
        assert_eq!(pane.triangles.len(), 2 + 2 + 2 * 4);
        let behind = pane.points.iter().filter(|p| (p.y - 0.1).abs() < 1e-9);
        assert_eq!(behind.count(), 4);
    }

    #[test]
    fn blocks_that_share_an_edge_are_closed_each() {
        let other: Vec<[f32; 3]> = CUBE
            .iter()
            .map(|[x, y, z]| [x + 1.0, y + 2.0, *z])
            .collect();
        let mut indices: Vec<u32> = SIDES.iter().flatten().copied().collect();
        indices.extend(SIDES.iter().flatten().map(|i| i + 8));
        let points: Vec<[f32; 3]> = CUBE.into_iter().chain(other).collect();
        let both = Shells::of([(&points[..], &indices[..])].into_iter(), 0.1);
        assert_eq!((both.triangles.len(), both.points.len()), (24, 14));
        assert_eq!(both.thicknesses, [1.0, 1.0]);
    }
}
