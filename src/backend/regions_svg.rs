//! The automatic roofs in plan as an SVG picture: regions in colours, ridges and hips, the way lean-tos fall,
//! outlines and courtyards. The street is below, as a reader who stands in it sees the house.
//!
//! Storeys lie side by side from the ground up, one house after another, in rows of limited width; all are drawn
//! at one scale.

use super::number::Number;
use crate::ast::RoofShape;
use crate::building::{Building, PlanRegion, StoreyPlan};
use glam::{DVec2, dvec2};
use std::fmt::Write;

/// Fills of regions, in turn.
const FILLS: [&str; 8] = [
    "#d9c8a9", "#b9c7b4", "#c9b3a5", "#aebfcb", "#e0d6bd", "#c3bdd0", "#cfd6a8", "#d6b8b8",
];
/// Pixels.
const MARGIN: f64 = 12.0;
const TITLE: f64 = 20.0;
const ROW: f64 = 1000.0;
/// Pixels of the longer side of the largest plan, and of one U at most.
const EXTENT: f64 = 300.0;
const LARGEST: f64 = 16.0;

/// `--stage regions --format svg`. Frame: a to the left, b upwards.
pub fn regions_svg(building: &Building) -> String {
    let mut panels = vec![];
    for (house, roofs) in building.shell.houses.iter().zip(&building.roofs) {
        for plan in &roofs.plans {
            let storey = format!("storey {}", plan.storey);
            let title = match (house.name.is_empty(), roofs.plans.len()) {
                (true, _) => storey,
                (false, 1) => house.name.clone(),
                (false, _) => format!("{}, {storey}", house.name),
            };
            panels.push(Panel::new(plan, title));
        }
    }
    let extent = panels.iter().map(|p| p.size().max_element());
    let scale = (EXTENT / extent.fold(1.0, f64::max)).min(LARGEST);
    let (mut at, mut row, mut size) = (dvec2(MARGIN, MARGIN), 0.0, DVec2::ZERO);
    let mut drawn = String::new();
    for panel in &panels {
        let area = panel.size() * scale + dvec2(0.0, TITLE);
        if at.x > MARGIN && at.x + area.x > ROW {
            (at, row) = (dvec2(MARGIN, at.y + row + MARGIN), 0.0);
        }
        let (x, y) = (short(at.x), short(at.y));
        drawn += &format!("<g transform=\"translate({x} {y})\">\n");
        panel.draw(scale, &mut drawn);
        drawn += "</g>\n";
        row = f64::max(row, area.y);
        size = size.max(at + area + MARGIN);
        // A title may be wider than a small plan.
        at.x += area.x.max(7.0 * panel.title.chars().count() as f64) + 2.0 * MARGIN;
        size.x = size.x.max(at.x - MARGIN);
    }
    let (w, h) = (short(size.x), short(size.y));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n{drawn}</svg>\n"
    )
}

/// One storey.
struct Panel<'p> {
    plan: &'p StoreyPlan,
    title: String,
    /// Bounds in U.
    min: DVec2,
    max: DVec2,
}

impl<'p> Panel<'p> {
    fn new(plan: &'p StoreyPlan, title: String) -> Self {
        let corners = plan.outlines.iter().flatten().copied();
        let rects = plan.regions.iter().flat_map(|r| {
            let [a0, b0, a1, b1] = r.rect;
            [dvec2(a0, b0), dvec2(a1, b1)]
        });
        let bounds = corners.chain(rects).fold(None, |bounds, p| {
            let (min, max) = bounds.unwrap_or((p, p));
            Some((min.min(p), max.max(p)))
        });
        let (min, max) = bounds.unwrap_or_default();
        Self {
            plan,
            title,
            min,
            max,
        }
    }

    fn size(&self) -> DVec2 {
        self.max - self.min
    }

    fn draw(&self, scale: f64, out: &mut String) {
        let place = |p: DVec2| {
            let (x, y) = (
                (self.max.x - p.x) * scale,
                (self.max.y - p.y) * scale + TITLE,
            );
            format!("{} {}", short(x), short(y))
        };
        let title = self.title.replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(out, "<text y=\"12\">{title}</text>");
        let path = |corners: &[DVec2]| {
            let points: Vec<String> = corners.iter().map(|p| place(*p)).collect();
            format!("M{}Z", points.join("L"))
        };
        for (n, region) in self.plan.regions.iter().enumerate() {
            let corners = region.polygon.clone();
            let corners = corners.unwrap_or_else(|| corners_of(region.rect).to_vec());
            let (d, fill) = (path(&corners), FILLS[n % FILLS.len()]);
            let _ = writeln!(out, "<path d=\"{d}\" fill=\"{fill}\" stroke=\"#fff\"/>");
        }
        let lines = |all: Vec<[DVec2; 2]>| -> String {
            let line = |[p, q]: &[DVec2; 2]| format!("M{}L{}", place(*p), place(*q));
            all.iter().map(line).collect()
        };
        let (mut ridges, mut falls) = (vec![], vec![]);
        for region in &self.plan.regions {
            ridges.extend(ridge_lines(region, &self.plan.regions));
            falls.extend(fall_arrow(region));
        }
        let rings = self.plan.outlines.iter().chain(&self.plan.holes);
        let walls: String = rings.map(|ring| path(ring)).collect();
        for (d, stroke, width) in [
            (lines(falls), "#5a5048", "1"),
            (lines(ridges), "#7a1f1f", "2"),
            (walls, "#222", "1.5"),
        ] {
            if !d.is_empty() {
                let _ = writeln!(
                    out,
                    "<path d=\"{d}\" fill=\"none\" stroke=\"{stroke}\" stroke-width=\"{width}\"/>"
                );
            }
        }
    }
}

fn corners_of([a0, b0, a1, b1]: [f64; 4]) -> [DVec2; 4] {
    [dvec2(a0, b0), dvec2(a1, b0), dvec2(a1, b1), dvec2(a0, b1)]
}

/// The ridge of a region and its hips. A branch runs on to its trunk's ridge.
fn ridge_lines(region: &PlanRegion, all: &[PlanRegion]) -> Vec<[DVec2; 2]> {
    let Some(ridge) = region.ridge else {
        return vec![];
    };
    // As if it ran along a; turned back at the end.
    let turned = |[a0, b0, a1, b1]: [f64; 4]| {
        if ridge == "a" {
            [a0, b0, a1, b1]
        } else {
            [b0, a0, b1, a1]
        }
    };
    let [a0, b0, a1, b1] = turned(region.rect);
    let (middle, half) = ((b0 + b1) / 2.0, (b1 - b0) / 2.0);
    let trunk = region.over.and_then(|over| all.get(over));
    let hip = match region.shape {
        RoofShape::Hip | RoofShape::Pyramid => half,
        // The gable stands halfway up the hip.
        RoofShape::HipAndGable | RoofShape::Temple | RoofShape::HalfHip => half / 2.0,
        _ => 0.0,
    };
    let hip = hip.min((a1 - a0) / 2.0);
    let mut lines = vec![];
    // From an end wall to where the ridge ends: out over the trunk, or in behind a hip.
    let mut end = |wall: f64, out: f64| {
        let over = trunk
            .map(|t| (turned(t.rect), t.ridge))
            .filter(
                |([t0, _, t1, _], _)| {
                    if out > 0.0 { *t0 >= wall } else { *t1 <= wall }
                },
            );
        match over {
            Some(([t0, _, t1, _], across)) if across.is_some_and(|a| a != ridge) => {
                wall + out * (t1 - t0) / 2.0
            }
            Some(_) => wall,
            None => {
                let top = wall - out * hip;
                if hip > 0.0 {
                    lines.extend([b0, b1].map(|b| {
                        let inward = (middle - b).signum() * hip;
                        [dvec2(wall, b), dvec2(top, b + inward)]
                    }));
                }
                top
            }
        }
    };
    let (from, to) = (end(a0, -1.0), end(a1, 1.0));
    lines.push([dvec2(from, middle), dvec2(to, middle)]);
    let back = |p: DVec2| if ridge == "a" { p } else { dvec2(p.y, p.x) };
    lines.into_iter().map(|line| line.map(back)).collect()
}

/// An arrow down the slope of a lean-to.
fn fall_arrow(region: &PlanRegion) -> Vec<[DVec2; 2]> {
    let way = match region.fall {
        Some("F") => dvec2(0.0, -1.0),
        Some("B") => dvec2(0.0, 1.0),
        Some("L") => dvec2(1.0, 0.0),
        Some("R") => dvec2(-1.0, 0.0),
        _ => return vec![],
    };
    let [a0, b0, a1, b1] = region.rect;
    let (middle, size) = (dvec2(a0 + a1, b0 + b1) / 2.0, dvec2(a1 - a0, b1 - b0));
    let tip = middle + way * (size * way).length() * 0.35;
    let head = size.min_element() * 0.12;
    let barb = |side: f64| [tip, tip - way * head + way.perp() * side * head];
    vec![[middle * 2.0 - tip, tip], barb(1.0), barb(-1.0)]
}

/// A length in pixels, to the hundredth.
fn short(pixels: f64) -> Number {
    Number((pixels * 100.0).round() / 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn region(rect: [f64; 4], ridge: Option<&'static str>, shape: RoofShape) -> PlanRegion {
        PlanRegion {
            rect,
            polygon: None,
            ridge,
            fall: None,
            role: "main",
            shape,
            over: None,
        }
    }

    #[test]
    fn branches_run_to_the_ridge_of_their_trunk() {
        let trunk = region([0.0, 0.0, 14.0, 6.0], Some("a"), RoofShape::Gable);
        let wing = PlanRegion {
            over: Some(0),
            ..region([0.0, 6.0, 6.0, 12.0], Some("b"), RoofShape::Gable)
        };
        let lines = ridge_lines(&wing, &[trunk.clone(), wing.clone()]);
        assert_eq!(lines, [[dvec2(3.0, 3.0), dvec2(3.0, 12.0)]]);
        // Against a gable it ends at the wall.
        let turned = PlanRegion {
            ridge: Some("b"),
            ..trunk
        };
        let lines = ridge_lines(&wing, &[turned, wing.clone()]);
        assert_eq!(lines, [[dvec2(3.0, 6.0), dvec2(3.0, 12.0)]]);
    }

    #[test]
    fn hips_run_to_the_corners_of_free_ends() {
        let hipped = region([0.0, 0.0, 4.0, 10.0], Some("b"), RoofShape::Hip);
        let lines = ridge_lines(&hipped, &[]);
        assert_eq!(lines.len(), 5);
        assert!(lines.contains(&[dvec2(2.0, 2.0), dvec2(2.0, 8.0)]));
        assert!(lines.contains(&[dvec2(0.0, 0.0), dvec2(2.0, 2.0)]));
        assert!(lines.contains(&[dvec2(4.0, 10.0), dvec2(2.0, 8.0)]));
    }

    #[test]
    fn arrows_point_the_way_a_lean_to_falls() {
        let strip = PlanRegion {
            fall: Some("F"),
            ..region([0.0, 0.0, 8.0, 2.0], None, RoofShape::LeanTo)
        };
        let [[from, to], ..] = fall_arrow(&strip)[..] else {
            panic!("no arrow");
        };
        assert!(to.y < from.y && to.x == from.x);
        assert!(fall_arrow(&region([0.0; 4], None, RoofShape::Flat)).is_empty());
    }

    #[test]
    fn storeys_lie_side_by_side_and_polygons_are_drawn() {
        let plan = |storey, polygon: Option<Vec<DVec2>>| StoreyPlan {
            storey,
            outlines: vec![corners_of([0.0, 0.0, 10.0, 5.0]).to_vec()],
            regions: vec![PlanRegion {
                polygon,
                ..region([0.0, 0.0, 10.0, 5.0], None, RoofShape::Flat)
            }],
            ..StoreyPlan::default()
        };
        let corner = vec![dvec2(0.0, 0.0), dvec2(10.0, 0.0), dvec2(10.0, 5.0)];
        let [ground, upper] = [plan(1, None), plan(2, Some(corner))];
        let panels = [&ground, &upper].map(|p| Panel::new(p, format!("a < b, {}", p.storey)));
        let mut drawn = String::new();
        panels[1].draw(10.0, &mut drawn);
        assert!(drawn.contains("a &lt; b, 2"));
        assert!(drawn.contains("M100 70L0 70L0 20Z"), "{drawn}");
        assert_eq!(panels[0].size(), dvec2(10.0, 5.0));
    }
}
