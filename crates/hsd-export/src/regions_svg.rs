//! The automatic roofs in plan as an SVG image: regions in colours, ridges, hips, valleys and falls as built, outlines
//! and courtyards. The street is at the bottom, as seen by somebody who stands in it.
//!
//! Storeys lie side by side from the ground up, one house after another, in rows of limited width; all are drawn
//! at one scale.

use super::number::Number;
use glam::{DVec2, DVec3, dvec2};
use hsd_base::diagnostic::visible;
use hsd_ir::building::{Building, Built, EdgeKind, HouseRoofs, RoofSurface, StoreyPlan};
use std::fmt::Write;

/// Fill colours of regions, cyclically.
const FILLS: [&str; 8] = [
    "#d9c8a9", "#b9c7b4", "#c9b3a5", "#aebfcb", "#e0d6bd", "#c3bdd0", "#cfd6a8", "#d6b8b8",
];
/// Margin in pixels.
const MARGIN: f64 = 12.0;
const TITLE: f64 = 20.0;
const ROW: f64 = 1000.0;
/// Pixels of the longer side of the largest plan, and of one U at most.
const EXTENT: f64 = 300.0;
const LARGEST: f64 = 16.0;
/// Length of an arrow as a share of its facet along the fall.
const ARROW: f64 = 0.5;

/// `--stage regions --format svg`. Frame: a to the left, b upwards.
pub fn regions_svg(building: &Building) -> String {
    let mut panels = vec![];
    for Built { house, roofs, .. } in &building.houses {
        for plan in &roofs.plans {
            let storey = format!("storey {}", plan.storey);
            let title = match (house.name.is_empty(), roofs.plans.len()) {
                (true, _) => storey,
                (false, 1) => visible::line(&house.name),
                (false, _) => format!("{}, {storey}", visible::line(&house.name)),
            };
            panels.push(Panel::new(plan, title, Lines::of(roofs, plan, house.unit)));
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

/// The lines of the roofs over one storey, in U.
#[derive(Default)]
struct Lines {
    /// Ridges and hips.
    ridges: Vec<[DVec2; 2]>,
    valleys: Vec<[DVec2; 2]>,
    /// Strokes of an arrow down each slope.
    falls: Vec<[DVec2; 2]>,
}

impl Lines {
    fn of(roofs: &HouseRoofs, plan: &StoreyPlan, unit: f64) -> Lines {
        let place = |p: DVec3| dvec2(-p.x, p.y) / unit + 0.0;
        let mut lines = Lines::default();
        for surface in roofs.over_regions(plan.storey) {
            let of = |kind| surface.lines(kind).into_iter();
            let in_plan = |line: [DVec3; 2]| line.map(place);
            let above = of(EdgeKind::Ridge).chain(of(EdgeKind::Hip));
            lines.ridges.extend(above.map(in_plan));
            lines.valleys.extend(of(EdgeKind::Valley).map(in_plan));
            let falls = arrows(surface);
            lines
                .falls
                .extend(falls.into_iter().map(|line| line.map(place)));
        }
        lines
    }
}

/// One storey.
struct Panel<'p> {
    plan: &'p StoreyPlan,
    title: String,
    lines: Lines,
    /// Bounds in U.
    min: DVec2,
    max: DVec2,
}

impl<'p> Panel<'p> {
    fn new(plan: &'p StoreyPlan, title: String, lines: Lines) -> Self {
        let corners = plan.outlines.iter().flatten().copied();
        let rects = plan.regions.iter().flat_map(|r| {
            let [a0, b0, a1, b1] = r.rect;
            [dvec2(a0, b0), dvec2(a1, b1)]
        });
        let drawn = lines.ridges.iter().chain(&lines.valleys).flatten().copied();
        let bounds = corners.chain(rects).chain(drawn).fold(None, |bounds, p| {
            let (min, max) = bounds.unwrap_or((p, p));
            Some((min.min(p), max.max(p)))
        });
        let (min, max) = bounds.unwrap_or_default();
        Self {
            plan,
            title,
            lines,
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
        let lines = |all: &[[DVec2; 2]]| -> String {
            let line = |[p, q]: &[DVec2; 2]| format!("M{}L{}", place(*p), place(*q));
            all.iter().map(line).collect()
        };
        let rings = self.plan.outlines.iter().chain(&self.plan.holes);
        let walls: String = rings.map(|ring| path(ring)).collect();
        for (d, stroke, width) in [
            (lines(&self.lines.falls), "#5a5048", "1"),
            (lines(&self.lines.valleys), "#2f5f7a", "1.5"),
            (lines(&self.lines.ridges), "#7a1f1f", "2"),
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

/// Returns an arrow down each slope, in the middle of its largest facet: shaft and barbs, house frame, metres.
fn arrows(surface: &RoofSurface) -> Vec<[DVec3; 2]> {
    let mut strokes = vec![];
    for slope in surface.slopes() {
        let facets = slope.iter().map(|f| &surface.facets[*f as usize]);
        let Some(facet) = facets.max_by(|f, g| surface.area(f).total_cmp(&surface.area(g))) else {
            continue;
        };
        let corners: Vec<DVec2> = facet
            .corners
            .iter()
            .map(|c| surface.at(*c).truncate())
            .collect();
        let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
        let fall = facet.fall();
        let extent = |axis: DVec2| {
            let along = corners.iter().map(|p| axis.dot(*p));
            let (lo, hi) = along.fold((f64::MAX, f64::MIN), |(lo, hi), d| (lo.min(d), hi.max(d)));
            hi - lo
        };
        let (run, width) = (extent(fall), extent(fall.perp()));
        let tip = middle + fall * run * ARROW / 2.0;
        let head = (run * ARROW).min(width) * 0.2;
        let barb = |side: f64| [tip, tip - fall * head + fall.perp() * side * head];
        let shaft = [tip - fall * run * ARROW, tip];
        let flat = [shaft, barb(1.0), barb(-1.0)].map(|line| line.map(|p| p.extend(0.0)));
        strokes.extend(flat);
    }
    strokes
}

/// Returns a length in pixels, rounded to the hundredth.
fn short(pixels: f64) -> Number {
    Number((pixels * 100.0).round() / 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_ir::ast::RoofShape;
    use hsd_ir::building::PlanRegion;

    #[test]
    fn storeys_lie_side_by_side_and_polygons_are_drawn() {
        let plan = |storey, polygon: Option<Vec<DVec2>>| StoreyPlan {
            storey,
            outlines: vec![corners_of([0.0, 0.0, 10.0, 5.0]).to_vec()],
            regions: vec![PlanRegion {
                rect: [0.0, 0.0, 10.0, 5.0],
                polygon,
                ridge: None,
                fall: None,
                role: "main",
                shape: RoofShape::Flat,
                over: None,
            }],
            ..StoreyPlan::default()
        };
        let corner = vec![dvec2(0.0, 0.0), dvec2(10.0, 0.0), dvec2(10.0, 5.0)];
        let [ground, upper] = [plan(1, None), plan(2, Some(corner))];
        let panels = [&ground, &upper]
            .map(|p| Panel::new(p, format!("a < b, {}", p.storey), Lines::default()));
        let mut drawn = String::new();
        panels[1].draw(10.0, &mut drawn);
        assert!(drawn.contains("a &lt; b, 2"));
        assert!(drawn.contains("M100 70L0 70L0 20Z"), "{drawn}");
        assert_eq!(panels[0].size(), dvec2(10.0, 5.0));
    }
}
