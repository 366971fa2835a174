//! Houses made straight from corners, and ways to look at their roofs.

use glam::{DVec2, DVec3, dvec2};
use hsd::ast::{
    Order, RoofDirection, RoofKind, RoofLine, RoofMode, RoofShape, RoofStyle, StoreyKind,
};
use hsd::building::{Building, House, Ring, Roof, RoofSurface, Shell, Solid, Storey, Wall};
use hsd::check::solid_flaws;
use hsd::diagnostic::Diagnostics;
use hsd::geometry::SHAKU;
use hsd::program::Roofs;
use hsd::source::{Span, Spanned};

pub const U: f64 = 3.0 * SHAKU;
pub const H: f64 = 9.0 * SHAKU;

pub fn spanned<T>(value: T) -> Spanned<T> {
    Spanned::new(value, Span::default())
}

pub fn walk(corners: &[(f64, f64)], closed: bool) -> Vec<Wall> {
    let n = corners.len();
    let edges = if closed { n } else { n - 1 };
    (0..edges)
        .map(|i| {
            let (p, q) = (corners[i], corners[(i + 1) % n]);
            let (from, to) = (dvec2(p.0, p.1), dvec2(q.0, q.1));
            let raw = (to - from).normalize();
            let direction = if raw.x.abs() < 1e-12 || raw.y.abs() < 1e-12 {
                raw.round()
            } else {
                raw
            };
            Wall {
                span: Span {
                    start: i as u32,
                    end: i as u32 + 1,
                    ..Span::default()
                },
                facade: i as u32 + 1,
                from,
                to,
                direction,
                units: vec![],
                reflection: false,
            }
        })
        .collect()
}

pub fn ring(corners: &[(f64, f64)]) -> Ring {
    Ring {
        span: Span::default(),
        hole: false,
        closed: true,
        inner: false,
        walls: walk(corners, true),
    }
}

pub fn hole(corners: &[(f64, f64)]) -> Ring {
    let reversed: Vec<(f64, f64)> = corners.iter().rev().copied().collect();
    Ring {
        hole: true,
        ..ring(&reversed)
    }
}

pub fn rect(a0: f64, b0: f64, a1: f64, b1: f64) -> Vec<(f64, f64)> {
    vec![(a0, b0), (a1, b0), (a1, b1), (a0, b1)]
}

/// A house of storeys, each of some rings, each 9 shaku high.
pub fn house(storeys: Vec<Vec<Ring>>) -> House {
    let storeys = storeys.into_iter().enumerate().map(|(k, rings)| Storey {
        span: Span {
            start: 100 + k as u32,
            end: 101 + k as u32,
            ..Span::default()
        },
        number: k as u32 + 1,
        kind: StoreyKind::Storey,
        z0: k as f64 * H,
        z1: (k + 1) as f64 * H,
        order: Order::default(),
        rings,
        rooms: vec![],
        fixtures: vec![],
    });
    House {
        span: Span::default(),
        name: String::new(),
        variant: None,
        placed: None,
        origin: [0.0; 3],
        azimuth: 180.0,
        unit: U,
        street: false,
        age: None,
        storeys: storeys.collect(),
        raised: 0.0,
        plinth: 0.0,
        platform: None,
        finials: vec![],
        puts: vec![],
        grounds: vec![],
        outdoors: None,
        roofs: Roofs::default().into(),
    }
}

pub fn line(
    shape: RoofShape,
    direction: Option<RoofDirection>,
    height: Option<f64>,
    corners: [f64; 4],
) -> RoofLine {
    RoofLine {
        span: Span {
            start: 500,
            end: 540,
            ..Span::default()
        },
        style: RoofStyle {
            kind: Some(spanned(RoofKind::Tiles)),
            shape: Some(spanned(shape)),
            ..RoofStyle::default()
        },
        direction: direction.map(spanned),
        height: height.map(spanned),
        corners: spanned(corners),
    }
}

pub fn build(house: House) -> (Building, Diagnostics) {
    let mut out = Diagnostics::new();
    let shell = Shell {
        houses: vec![house],
        images: vec![],
    };
    (hsd::roof::roof(shell, &mut out), out)
}

pub fn quiet(house: House) -> Building {
    let (building, out) = build(house);
    // What these tests expect: one hip roof where walls slant, several gables over what is very wide.
    let told = codes(&out)
        .into_iter()
        .filter(|code| ![520, 521].contains(code));
    assert_eq!(told.collect::<Vec<_>>(), Vec::<u16>::new());
    building
}

pub fn codes(out: &Diagnostics) -> Vec<u16> {
    out.iter().map(|d| d.code.0).collect()
}

pub fn roofs(building: &Building) -> &[Roof] {
    &building.houses[0].roofs.roofs
}

pub fn surfaces(building: &Building) -> &[RoofSurface] {
    building.houses[0].roofs.surfaces()
}

pub fn all_solids(building: &Building) -> impl Iterator<Item = &Solid> {
    building.houses[0]
        .roofs
        .roofs
        .iter()
        .flat_map(|r| &r.solids)
}

/// Every solid is sound.
pub fn assert_sound(building: &Building) {
    for (n, roof) in roofs(building).iter().enumerate() {
        for (m, solid) in roof.solids.iter().enumerate() {
            let flaws: Vec<_> = solid_flaws(solid).collect();
            assert!(
                flaws.is_empty(),
                "roof {n} ({:?}) solid {m}: {flaws:?}\n{solid:?}",
                roof.shape
            );
        }
    }
    for solid in building.houses[0]
        .roofs
        .soffits
        .iter()
        .flat_map(|s| &s.solids)
    {
        let flaws: Vec<_> = solid_flaws(solid).collect();
        assert!(flaws.is_empty(), "soffit: {flaws:?}\n{solid:?}");
    }
}

/// The height of the topmost face over a plan point in U, if any.
pub fn top_at(building: &Building, a: f64, b: f64) -> Option<f64> {
    let p = dvec2(-a * U, b * U);
    all_solids(building)
        .filter_map(|s| top_of(s, p))
        .reduce(f64::max)
}

pub fn top_of(solid: &Solid, p: DVec2) -> Option<f64> {
    let mut best: Option<f64> = None;
    for face in &solid.faces {
        let at = |i: usize| solid.points[face.corners[i] as usize];
        for i in 1..face.corners.len() - 1 {
            if let Some(z) = over([at(0), at(i), at(i + 1)], p) {
                best = Some(best.map_or(z, |b| b.max(z)));
            }
        }
    }
    best
}

fn over([p, q, r]: [DVec3; 3], at: DVec2) -> Option<f64> {
    let (u, v, w) = (q - p, r - p, at - p.truncate());
    let area = u.truncate().perp_dot(v.truncate());
    if area.abs() < 1e-12 {
        return None;
    }
    let s = w.perp_dot(v.truncate()) / area;
    let t = u.truncate().perp_dot(w) / area;
    (s >= -1e-9 && t >= -1e-9 && s + t <= 1.0 + 1e-9).then_some(p.z + s * u.z + t * v.z)
}

pub fn explicit_only(mut house: House) -> House {
    house.roofs.mode = RoofMode::Explicit;
    house
}

pub fn near(p: f64, q: f64) {
    assert!((p - q).abs() < 1e-6, "{p} is not {q}");
}
