//! The mesh of one part alone in its wall, and what tests ask of it. Lengths in millimetres.

use super::compile;
use glam::{DVec2, DVec3};
use hsd::scene::{Kind, Mesh};
use std::collections::BTreeMap;

pub type Triangle = [DVec3; 3];

pub const STOREY: f64 = 9.0;

/// A part in a wall of its own, so many shaku high.
pub fn part_mesh(code: &str, height: f64) -> Mesh {
    let run = compile(
        "part.hsd",
        format!("0 0 180\n{height}\n\n{code:5}\n").as_bytes(),
    );
    first_part(&run)
}

/// A part drawn out or pressed together to a width in metres, as on a facade of a given size.
pub fn scaled_mesh(code: &str, width: f64) -> Mesh {
    let size = width * 10.0;
    let part = format!("<Floor id=\"1\" height=\"10\"><Part code=\"{code}\"/></Floor>");
    let text = format!(
        "<Structure size=\"{size}\"><Facades><Facade ratio=\"1\">{part}</Facade></Facades></Structure>"
    );
    first_part(&compile("part.hsd", text.as_bytes()))
}

/// The mesh of the first part of a scene.
fn first_part(run: &super::Run) -> Mesh {
    let node = run.scene.nodes.iter().find(|n| n.kind == Kind::Part);
    let mesh = node.and_then(|n| n.mesh).expect("a part with a mesh");
    run.scene.meshes[mesh.0 as usize].clone()
}

/// Its triangles, millimetres: x to the right, y into the house, z up.
pub fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let mut all = vec![];
    for p in &mesh.primitives {
        let at = |i: u32| DVec3::from(p.positions[i as usize].map(|x| f64::from(x) * 1000.0));
        all.extend(p.indices.chunks(3).map(|t| [at(t[0]), at(t[1]), at(t[2])]));
    }
    all
}

/// A closed body by its box.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    pub lo: DVec3,
    pub hi: DVec3,
}

impl Body {
    pub fn size(&self) -> DVec3 {
        self.hi - self.lo
    }

    /// How far it stands out of the centre line.
    pub fn front(&self) -> f64 {
        -self.lo.y
    }
}

fn key(p: DVec3) -> [i64; 3] {
    (p * 100.0).round().to_array().map(|x| x as i64)
}

/// Triangles that hang together by their corners, as lists.
fn groups(triangles: &[Triangle]) -> Vec<Vec<Triangle>> {
    let mut numbers: BTreeMap<[i64; 3], usize> = BTreeMap::new();
    let mut parent: Vec<usize> = vec![];
    fn root(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    let mut corners = vec![];
    for t in triangles {
        let ids = t.map(|p| {
            *numbers.entry(key(p)).or_insert_with(|| {
                parent.push(parent.len());
                parent.len() - 1
            })
        });
        for i in 1..3 {
            let (a, b) = (root(&mut parent, ids[0]), root(&mut parent, ids[i]));
            parent[a] = b;
        }
        corners.push(ids[0]);
    }
    let mut groups: BTreeMap<usize, Vec<Triangle>> = BTreeMap::new();
    for (t, id) in triangles.iter().zip(corners) {
        groups.entry(root(&mut parent, id)).or_default().push(*t);
    }
    groups.into_values().collect()
}

/// The bodies of a mesh, from left to right.
pub fn bodies(mesh: &Mesh) -> Vec<Body> {
    let mut all: Vec<Body> = groups(&triangles(mesh)).iter().map(|g| bounds(g)).collect();
    all.sort_by(|a, b| a.lo.x.total_cmp(&b.lo.x));
    all
}

/// The box round triangles.
pub fn bounds(triangles: &[Triangle]) -> Body {
    let none = Body {
        lo: DVec3::INFINITY,
        hi: DVec3::NEG_INFINITY,
    };
    triangles.iter().flatten().fold(none, |b, p| Body {
        lo: b.lo.min(*p),
        hi: b.hi.max(*p),
    })
}

/// Upright bodies whose outermost plane stands so far out: bars.
pub fn bars(mesh: &Mesh, front: f64) -> Vec<Body> {
    let upright = |b: &Body| b.size().z > 1.5 * b.size().x.max(b.size().y);
    bodies(mesh)
        .into_iter()
        .filter(|b| (b.front() - front).abs() < 0.2 && upright(b))
        .collect()
}

/// Level bodies whose outermost plane stands so far out: rails.
pub fn rails(mesh: &Mesh, front: f64) -> Vec<Body> {
    let level = |b: &Body| b.size().x > 3.0 * b.size().z;
    bodies(mesh)
        .into_iter()
        .filter(|b| (b.front() - front).abs() < 0.2 && level(b))
        .collect()
}

/// What is wrong with a part's mesh: open or inside-out bodies, slivers, normals against the winding, and faces that
/// lie over each other in one plane and look the same way, so that a picture flickers.
pub fn flaws(mesh: &Mesh) -> Vec<String> {
    let mut flaws = super::flaws_of_mesh(mesh);
    for p in &mesh.primitives {
        for t in p.indices.chunks(3) {
            let at = |k: usize| DVec3::from(p.positions[t[k] as usize].map(f64::from));
            let normal = (at(1) - at(0)).cross(at(2) - at(0)).normalize_or_zero();
            for &i in t {
                let shown = DVec3::from(p.normals[i as usize].map(f64::from));
                if normal.dot(shown) < 0.9 {
                    flaws.push(format!("normal against the winding at {}", at(0)));
                }
            }
        }
    }
    let groups = groups(&triangles(mesh));
    for group in &groups {
        let mut edges: BTreeMap<_, i32> = BTreeMap::new();
        let mut volume = 0.0;
        for t in group {
            volume += t[0].dot(t[1].cross(t[2]));
            for i in 0..3 {
                let (p, q) = (key(t[i]), key(t[(i + 1) % 3]));
                *edges.entry((p.min(q), p.max(q))).or_default() += if p < q { 1 } else { -1 };
            }
        }
        let body = bounds(group);
        if edges.values().any(|n| *n != 0) {
            flaws.push(format!("open body {} to {}", body.lo, body.hi));
        }
        if volume <= 0.0 {
            flaws.push(format!("inside out {} to {}", body.lo, body.hi));
        }
    }
    flaws.extend(flicker(&groups));
    flaws
}

/// Faces over each other in one plane that look the same way, where no body covers them both. What touches a neighbour of
/// the part (posts, sill, the storey above) is covered by it.
fn flicker(groups: &[Vec<Triangle>]) -> Vec<String> {
    // Planes by their normal and their distance in fifths of a millimetre.
    let mut planes: BTreeMap<[i64; 4], Vec<(Triangle, DVec3)>> = BTreeMap::new();
    for t in groups.iter().flatten() {
        let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
        let n = (normal * 500.0).round();
        let d = (normal.dot(t[0]) * 5.0).round();
        let plane = [n.x as i64, n.y as i64, n.z as i64, d as i64];
        planes.entry(plane).or_default().push((*t, normal));
    }
    let boxes: Vec<Body> = groups.iter().map(|g| bounds(g)).collect();
    let all = boxes.iter().fold(boxes[0], |a, b| Body {
        lo: a.lo.min(b.lo),
        hi: a.hi.max(b.hi),
    });
    let covered = |p: DVec3| {
        let post = p.x < all.lo.x.max(0.0) + 60.7 || p.x > all.hi.x - 60.7;
        let ends = p.z < 0.0 || p.z > all.hi.z;
        let within = boxes.iter().zip(groups);
        (post && p.y.abs() < 60.0)
            || ends
            || within
                .into_iter()
                .any(|(b, group)| p.cmpgt(b.lo).all() && p.cmplt(b.hi).all() && inside(group, p))
    };
    let mut flaws = vec![];
    for list in planes.values() {
        for (i, (a, normal)) in list.iter().enumerate() {
            for (b, _) in &list[i + 1..] {
                let (area, middle) = overlap(a, b, *normal);
                if area > 1.0 && !covered(middle + *normal * 0.5) {
                    flaws.push(format!(
                        "{area:.0} mm2 twice in a plane {normal:.2} at {middle:.1}"
                    ));
                }
            }
        }
    }
    flaws
}

/// Whether a point lies in a closed body: how often a ray from it leaves more than it enters.
fn inside(body: &[Triangle], p: DVec3) -> bool {
    let ray = DVec3::new(0.3127, 0.5811, 0.7514);
    let mut out = 0;
    for t in body {
        let (u, v) = (t[1] - t[0], t[2] - t[0]);
        let h = ray.cross(v);
        let det = u.dot(h);
        if det.abs() < 1e-12 {
            continue;
        }
        let s = p - t[0];
        let a = s.dot(h) / det;
        let q = s.cross(u);
        let b = ray.dot(q) / det;
        if a >= 0.0 && b >= 0.0 && a + b <= 1.0 && v.dot(q) / det > 0.0 {
            out += if det < 0.0 { 1 } else { -1 };
        }
    }
    out != 0
}

/// Square millimetres that two triangles of one plane share, and the middle of what they share.
fn overlap(a: &Triangle, b: &Triangle, normal: DVec3) -> (f64, DVec3) {
    let right = normal.any_orthonormal_vector();
    let up = normal.cross(right);
    let flat = |t: &Triangle| t.map(|p| DVec2::new(right.dot(p), up.dot(p))).to_vec();
    let (clipper, mut shape) = (flat(a), flat(b));
    for i in 0..3 {
        let (p, q) = (clipper[i], clipper[(i + 1) % 3]);
        let side = |r: DVec2| (q - p).perp_dot(r - p);
        let mut kept: Vec<DVec2> = vec![];
        for (k, &r) in shape.iter().enumerate() {
            let s = shape[(k + 1) % shape.len()];
            if side(r) >= 0.0 {
                kept.push(r);
            }
            if (side(r) < 0.0) != (side(s) < 0.0) {
                kept.push(r.lerp(s, side(r) / (side(r) - side(s))));
            }
        }
        shape = kept;
        if shape.len() < 3 {
            return (0.0, a[0]);
        }
    }
    let fan = shape.windows(2).skip(1);
    let area = fan.map(|w| (w[0] - shape[0]).perp_dot(w[1] - shape[0]) / 2.0);
    let area = area.sum::<f64>().abs();
    let middle = shape.iter().sum::<DVec2>() / shape.len() as f64;
    let at = right * middle.x + up * middle.y + normal * normal.dot(a[0]);
    (area, at)
}

/// The attributes of the elements of a part in the catalogue's text that have this word, in their order.
pub fn written(code: &str, word: &str) -> Vec<BTreeMap<String, String>> {
    let text = include_str!("../../grammar/parts.xml");
    let start = text
        .find(&format!("<PartDef code=\"{code:5}\""))
        .expect("a part");
    let end = start + text[start..].find("</PartDef>").expect("its end");
    let tags = text[start..end].split('<').filter_map(|tag| {
        let (name, rest) = tag.split_once(' ')?;
        (name == word).then_some(rest)
    });
    tags.map(|rest| {
        let pairs = rest.split("\" ").filter_map(|pair| {
            let (name, value) = pair.split_once("=\"")?;
            let value = value.split('"').next().unwrap_or_default();
            Some((name.trim().to_owned(), value.to_owned()))
        });
        pairs.collect()
    })
    .collect()
}

/// The row of a part in the sheet of parts that lies beside the repository.
pub fn sheet_row(code: &str) -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/spec/parts.csv");
    let sheet = std::fs::read_to_string(path).expect("the sheet is there");
    let row = sheet.lines().find(|l| l.starts_with(&format!("{code:5},")));
    row.unwrap_or_else(|| panic!("no row of {code}")).to_owned()
}

/// What is wrong with the parts of some classes in storeys of three heights, and which have more than `most`
/// triangles.
pub fn flaws_of_classes(classes: &str, most: usize) -> Vec<String> {
    let mut found = vec![];
    let parts = hsd::parse::builtin().parts().iter();
    for part in parts.filter(|p| classes.contains(p.class())) {
        for height in [STOREY, 11.55, 5.0] {
            let mesh = part_mesh(part.code(), height);
            let flaws = flaws(&mesh).into_iter();
            found.extend(flaws.map(|f| format!("{} {height}: {f}", part.code())));
            let count = triangles(&mesh).len();
            if count > most {
                found.push(format!("{}: {count} triangles", part.code()));
            }
        }
    }
    found
}
