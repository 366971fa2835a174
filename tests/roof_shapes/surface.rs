//! The typed surface of every shape: each side of a facet in one edge, level ridges, sloping hips and valleys, and the
//! images and dumps that read it.

use crate::roof_shapes::common::*;
use crate::roof_shapes::halls::{FOOTPRINTS, PITCHES, under};
use glam::{DVec2, DVec3};
use hsd::ast::{RoofMethod, RoofShape};
use hsd::building::{Beside, Building, EdgeKind, House, RoofSurface};
use hsd::{backend::regions_svg::regions_svg, dump};

const L: [(f64, f64); 6] = [
    (0.0, 0.0),
    (10.0, 0.0),
    (10.0, 5.0),
    (4.0, 5.0),
    (4.0, 12.0),
    (0.0, 12.0),
];

fn length(lines: &[[DVec3; 2]]) -> f64 {
    lines.iter().map(|[p, q]| p.distance(*q)).sum()
}

/// Every side of a facet belongs to one edge, areas agree, and edges are what their kinds say.
fn assert_typed(surface: &RoofSurface, raised: bool) {
    let mut sides: Vec<(u32, u32, u32)> = vec![];
    for (f, facet) in surface.facets.iter().enumerate() {
        let next = facet.corners.iter().cycle().skip(1);
        let of = facet.corners.iter().zip(next);
        sides.extend(of.map(|(p, q)| (f as u32, *p, *q)));
    }
    let mut owned: Vec<(u32, u32, u32)> = vec![];
    let mut outline = 0.0;
    for edge in &surface.edges {
        let [p, q] = edge.ends;
        owned.push((edge.facet, p, q));
        let [from, to] = surface.ends(edge);
        match edge.beside {
            Beside::Facet(other) => owned.push((other, q, p)),
            _ => outline += from.truncate().perp_dot(to.truncate()) / 2.0,
        }
        let rise = to.z - from.z;
        match edge.kind {
            EdgeKind::Ridge => assert!(rise.abs() < 1e-3, "a ridge rises by {rise}"),
            EdgeKind::Hip if !raised => assert!(rise > 0.0, "a hip falls by {rise}"),
            EdgeKind::Valley => assert!(rise.abs() > 1e-3, "a level valley"),
            _ => {}
        }
    }
    sides.sort_unstable();
    owned.sort_unstable();
    assert_eq!(sides, owned);
    let facets: f64 = surface.facets.iter().map(|f| surface.area(f)).sum();
    near(facets, outline);
    let slopes: usize = surface.slopes().iter().map(Vec::len).sum();
    assert_eq!(slopes, surface.facets.len());
}

fn assert_all_typed(building: &Building) {
    for surface in surfaces(building) {
        assert_typed(surface, false);
    }
}

fn lines(building: &Building, kind: EdgeKind) -> Vec<[DVec3; 2]> {
    let surfaces = surfaces(building).iter();
    surfaces.flat_map(|surface| surface.lines(kind)).collect()
}

fn hipped(shape: RoofShape, ratio: Option<f64>) -> House {
    let mut house = under(shape, (10.0, 6.0), 4.0, 0.0, false);
    house.roofs.style.ratio = ratio.map(spanned);
    house
}

#[test]
fn every_shape_has_a_surface_of_typed_edges() {
    for shape in [
        RoofShape::Gable,
        RoofShape::Hip,
        RoofShape::BroadGable,
        RoofShape::HipAndGable,
        RoofShape::HalfHip,
        RoofShape::Pyramid,
        RoofShape::Temple,
        RoofShape::LeanTo,
    ] {
        for size in FOOTPRINTS {
            for pitch in PITCHES {
                for sori in [0.0, 4.0] {
                    let (building, _) = build(under(shape, size, pitch, sori, false));
                    for surface in surfaces(&building) {
                        assert!(!surface.facets.is_empty());
                        assert_typed(surface, sori > 0.0);
                    }
                }
            }
        }
    }
}

#[test]
fn a_ratio_and_half_hips_give_ridges_as_long_as_built() {
    for (shape, ratio, share) in [
        (RoofShape::Hip, Some(0.2), 0.2),
        (RoofShape::Hip, Some(0.8), 0.8),
        (RoofShape::Hip, None, 0.4),
        // Half-hips cut a fifth of the span off each end.
        (RoofShape::HalfHip, None, 0.76),
    ] {
        let building = quiet(hipped(shape, ratio));
        let ridges = lines(&building, EdgeKind::Ridge);
        assert_eq!(ridges.len(), 1);
        near(length(&ridges), share * 10.0 * U);
        let hips = lines(&building, EdgeKind::Hip);
        assert_eq!(hips.len(), 4);
        assert!(hips.iter().all(|[from, to]| from.z < to.z));
        assert_eq!(surfaces(&building)[0].slopes().len(), 4);
    }
}

#[test]
fn hips_and_gables_cover_their_outline_with_the_overhangs() {
    for shape in [RoofShape::Hip, RoofShape::Gable] {
        let building = quiet(hipped(shape, None));
        let surface = &surfaces(&building)[0];
        let min = surface.points.iter().copied().fold(DVec3::MAX, DVec3::min);
        let max = surface.points.iter().copied().fold(DVec3::MIN, DVec3::max);
        let area: f64 = surface.facets.iter().map(|f| surface.area(f)).sum();
        let size: DVec2 = (max - min).truncate();
        near(area, size.x * size.y);
    }
}

#[test]
fn images_and_dumps_show_ridges_as_built() {
    let built = |ratio| quiet(hipped(RoofShape::Hip, Some(ratio)));
    let (short, long) = (built(0.2), built(0.8));
    assert_ne!(regions_svg(&short), regions_svg(&long));
    let text = dump::regions(&short).unwrap();
    // 0.2 of 10 U in the middle of a house 6 U deep.
    assert!(
        text.contains(r#""lines":[{"kind":"ridge","from":["#),
        "{text}"
    );
    for a in ["[4,3,", "[6,3,"] {
        assert!(text.contains(a), "{text}");
    }
    assert_eq!(text.matches(r#""kind":"hip""#).count(), 4);
    assert!(text.starts_with(r#"{"version":1,"#));
}

#[test]
fn valleys_run_between_roofs_that_meet_and_in_skeletons() {
    let wings = quiet(house(vec![vec![ring(&L)]]));
    assert_all_typed(&wings);
    let meeting = surfaces(&wings).iter().flat_map(|surface| &surface.edges);
    let meeting = meeting.filter(|e| matches!(e.beside, Beside::Roof(_)));
    let valleys = meeting.filter(|e| e.kind == EdgeKind::Valley);
    assert!(valleys.count() >= 2);
    let mut house = house(vec![vec![ring(&L)]]);
    house.roofs.method = RoofMethod::Skeleton;
    let whole = quiet(house);
    assert_all_typed(&whole);
    assert_eq!(lines(&whole, EdgeKind::Valley).len(), 1);
    assert_eq!(lines(&whole, EdgeKind::Eaves).len(), 6);
    assert!(regions_svg(&whole).contains("#7a1f1f"));
}
