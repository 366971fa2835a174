//! Hipped roofs over any outline: one slope over each wall, all of one pitch, from the straight skeleton.
//!
//! As with gables the LOWER surface passes through the wall plate, the upper one lies one drop higher. Every slope is z
//! = plate + pitch * distance from its wall, inside and out, so that a rectangle gets the yosemune of
//! `docs/evidence.md` 7.10, a square its hogyo, and any other outline a carpenter's roof of equal slopes.

use crate::facet::Facet;
use crate::frame::Plane;
use crate::shape::form::Form;
use crate::shape::look::Look;
use crate::skeleton::eaves::Eaves;
use crate::skeleton::{Contours, FLUSH, Face, Invalid, Skeleton, skeleton};
use crate::solid::sheet::sheet;
use glam::{DVec2, DVec3};
use hsd_base::geometry::convex::parts;
use hsd_base::geometry::tolerance::CUT;
use hsd_base::geometry::triangulate::ears;
use hsd_ir::ast::RoofShape;
use hsd_ir::building::{Attic, Roof};

/// Nodes nearer to each other become one, metres.
const NEAR: f64 = 0.001;
/// Slopes whose nodes leave the plane by more are divided into triangles, metres.
const PLANE: f64 = 2e-7;
/// The least area of a facet, square metres.
const LEAST_AREA: f64 = 1e-6;

/// Returns the roof over a simple outline with courts, in metres and in any frame; rings may turn either way. `base` is the
/// height of the wall plate. Takes some ten microseconds for the plan of a house.
///
/// # Errors
/// The reason why the outline bounds no area that could be roofed.
///
/// ```
/// use glam::dvec2;
/// use hsd_roof::shape::{hipped, look::Look};
/// let house = [dvec2(0.0, 0.0), dvec2(9.0, 1.0), dvec2(8.0, 6.0), dvec2(0.5, 6.5)];
/// let look = Look::gable(None, &Default::default(), 6.0, 0.909);
/// let roof = hipped::over(&house, &[], 3.0, &look).expect("is a simple polygon");
/// assert_eq!(roof.solids.len(), 1);
/// ```
pub fn over(
    outline: &[DVec2],
    courts: &[Vec<DVec2>],
    base: f64,
    look: &Look,
) -> Result<Roof, Invalid> {
    let plain = |ring: &[DVec2]| ring.iter().map(|p| (*p, 0)).collect::<Vec<_>>();
    let courts: Vec<_> = courts.iter().map(|c| plain(c)).collect();
    let hipped = Hipped::new(&Contours::new(&plain(outline), &courts)?)?;
    let form = hipped.form(base, look);
    let whole: Vec<_> = form
        .facets
        .into_iter()
        .map(|f| (f.outline, f.plane))
        .collect();
    let solids = sheet(&whole, form.drop, &look.coat(), form.floor);
    Ok(Roof {
        storey: 1,
        span: None,
        shape: RoofShape::Hip,
        kind: look.kind,
        trim: look.trim(),
        attic: Attic {
            plate: base,
            filled: true,
            ..Attic::default()
        },
        whole: None,
        solids,
    })
}

/// A hipped roof before it has a pitch.
#[derive(Clone, Debug)]
pub struct Hipped {
    skeleton: Skeleton,
    /// For each node its representative.
    stands: Vec<u32>,
}

impl Hipped {
    /// Creates the roof over contours whose edges are tagged [`FLUSH`] or 0.
    ///
    /// # Errors [`Invalid::NotFound`] if no skeleton passed its own checks.
    pub fn new(contours: &Contours) -> Result<Hipped, Invalid> {
        let skeleton = skeleton(contours).ok_or(Invalid::NotFound)?;
        let stands = drawn_together(&skeleton);
        Ok(Hipped { skeleton, stands })
    }

    /// Returns twice the distance of the ridge from its walls, the span of an equally high gable, metres.
    pub fn span(&self) -> f64 {
        2.0 * self.skeleton.depth()
    }

    /// Returns the form on a wall plate at this height.
    pub fn form(&self, base: f64, look: &Look) -> Form {
        let faces = &self.skeleton.faces;
        let over = |f: &Face| if f.tag == FLUSH { 0.0 } else { look.eaves };
        let eaves = Eaves::of(&self.skeleton, &faces.iter().map(over).collect::<Vec<_>>());
        let drop = look.drop();
        let mut facets = Vec::with_capacity(faces.len());
        for (i, face) in faces.iter().enumerate() {
            let plane = Plane {
                z: base + drop - look.pitch * face.line.at,
                slope: face.line.normal * look.pitch,
            };
            let slope = self.slope(face, eaves.run(i), plane, |time| {
                base + drop + look.pitch * time
            });
            slope.facets(&mut facets);
        }
        Form {
            facets,
            drop,
            floor: base + drop + 1e-4,
            ..Form::default()
        }
    }

    /// Returns the slope of a face with its lower end.
    fn slope(
        &self,
        face: &Face,
        run: impl Iterator<Item = DVec2>,
        plane: Plane,
        height: impl Fn(f64) -> f64,
    ) -> Slope {
        let mut slope = Slope {
            places: vec![],
            tops: vec![],
            rims: vec![],
            plane,
        };
        for at in run {
            slope.add(at, plane.at(at), true);
        }
        if let Some(last) = slope.rims.last_mut() {
            *last = false;
        }
        for n in &face.nodes[2..] {
            let node = self.skeleton.nodes[self.stands[*n as usize] as usize];
            slope.add(node.at, height(node.time), false);
        }
        slope.straighten();
        slope
    }
}

/// One slope as a polygon.
struct Slope {
    places: Vec<DVec2>,
    tops: Vec<f64>,
    rims: Vec<bool>,
    plane: Plane,
}

impl Slope {
    fn add(&mut self, at: DVec2, top: f64, rim: bool) {
        if self.places.last().is_some_and(|p| p.distance(at) < CUT) {
            return;
        }
        self.places.push(at);
        self.tops.push(top);
        self.rims.push(rim);
    }

    fn remove(&mut self, i: usize) {
        self.places.remove(i);
        self.tops.remove(i);
        self.rims.remove(i);
    }

    /// Removes corners in mid-edge, duplicate points and spikes; slabs restore a neighbour's corners.
    fn straighten(&mut self) {
        let mut i = 0;
        let mut kept = 0;
        while self.places.len() > 2 && kept < self.places.len() {
            let n = self.places.len();
            let (before, i_at, after) = ((i + n - 1) % n, i % n, (i + 1) % n);
            let [p, q, r] = [before, i_at, after].map(|k| self.places[k]);
            let way = (r - p).normalize_or_zero();
            let twice = q.distance(r) < CUT;
            let off = if p.distance(r) < CUT {
                0.0
            } else {
                way.perp_dot(q - p).abs()
            };
            if twice || (off < CUT && self.rims[before] == self.rims[i_at]) {
                self.remove(i_at);
                i = (i_at + n - 2) % (n - 1);
                kept = 0;
            } else {
                i = after;
                kept += 1;
            }
        }
    }

    /// Adds convex facets under one plane, or triangles if merged nodes bend it.
    fn facets(&self, facets: &mut Vec<Facet>) {
        if self.places.len() < 3 {
            return;
        }
        let even = |(at, top): (&DVec2, &f64)| (self.plane.at(*at) - top).abs() < PLANE;
        if self.places.iter().zip(&self.tops).all(even) {
            let whole = parts(&self.places).into_iter();
            facets.extend(whole.filter_map(|part| self.facet(&part, self.plane)));
        } else {
            let point = |i: usize| self.places[i].extend(self.tops[i]);
            ears(&self.places, |triangle| {
                let corners = triangle.map(|i| i as usize);
                let plane = plane_through(corners.map(point));
                facets.extend(plane.and_then(|plane| self.facet(&corners, plane)));
            });
        }
    }

    fn facet(&self, part: &[usize], plane: Plane) -> Option<Facet> {
        let n = self.places.len();
        let next = part.iter().cycle().skip(1);
        let corner = |(i, j): (&usize, &usize)| {
            let border = (i + 1) % n == *j;
            (self.places[*i], border && self.rims[*i])
        };
        let outline: Vec<(DVec2, bool)> = part.iter().zip(next).map(corner).collect();
        let body: Vec<DVec2> = outline.iter().map(|c| c.0).collect();
        let fan = body
            .windows(2)
            .map(|w| (w[0] - body[0]).perp_dot(w[1] - body[0]));
        (fan.sum::<f64>() > 2.0 * LEAST_AREA).then(|| Facet::new(&outline, &body, plane))
    }
}

/// Returns the plane through three points.
fn plane_through([p, q, r]: [DVec3; 3]) -> Option<Plane> {
    let normal = (q - p).cross(r - p);
    let slope = -normal.truncate() / normal.z;
    let z = p.z - slope.dot(p.truncate());
    (slope.is_finite() && z.is_finite()).then_some(Plane { z, slope })
}

/// Returns for each node its representative: nodes at the two ends of a border shorter than a millimetre become one,
/// the corner of the plan if one of them is a corner.
fn drawn_together(skeleton: &Skeleton) -> Vec<u32> {
    let corners = skeleton.faces.len() as u32;
    let mut stands: Vec<u32> = (0..skeleton.nodes.len() as u32).collect();
    let find = |stands: &[u32], mut n: u32| {
        while stands[n as usize] != n {
            n = stands[n as usize];
        }
        n
    };
    for face in &skeleton.faces {
        let next = face.nodes.iter().cycle().skip(1);
        for (i, j) in face.nodes.iter().zip(next).skip(1) {
            let (p, q) = (find(&stands, *i), find(&stands, *j));
            let gap = skeleton.nodes[*i as usize]
                .at
                .distance(skeleton.nodes[*j as usize].at);
            let (lo, hi) = (p.min(q), p.max(q));
            if gap < NEAR && lo != hi && hi >= corners {
                stands[hi as usize] = lo;
            }
        }
    }
    (0..stands.len() as u32).map(|n| find(&stands, n)).collect()
}
