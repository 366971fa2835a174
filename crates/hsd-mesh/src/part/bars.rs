//! Lattices: counted bars and rails, frames and studs.

use crate::mesh::panel::Rect;
use crate::mesh::smooth::soft_bar;
use crate::mesh::{Axis, Soup};
use crate::part::bay::{Bay, Layer};
use crate::part::round::arcade;
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_ir::catalog::body::{Bars, Place, Rails, Studs};
use hsd_ir::catalog::value::Sides;
use hsd_ir::material::SurfaceId;

/// The layout of bars: their left ends, widths, and whether each is short.
pub(crate) struct Row {
    pub(crate) bars: Vec<(f64, f64, bool)>,
}

/// Spreads groups of one long bar and its short ones evenly, with gaps at both ends. The count is kept: where the
/// widths do not fit (the sheet gives sizes for lattices without posts), bars and gaps shrink by the same factor.
pub(crate) fn spread(bars: &Bars, x0: f64, x1: f64) -> Row {
    let long = bars.count as usize;
    let short = bars.children as usize;
    let count = long * (1 + short);
    let (size, child) = (bars.size.0, bars.childsize.0);
    let wood = long as f64 * (size + short as f64 * child);
    let gaps = match bars.ends {
        true => count.max(2) - 1,
        false => count + 1,
    } as f64;
    // Gaps of less than a third of the bar would make a wall of it.
    let least = bars.gap.map_or(size / 3.0, |g| g.0);
    let scale = ((x1 - x0) / (wood + gaps * least)).min(1.0);
    let gap = ((x1 - x0) - wood * scale) / gaps;
    let mut row = Row {
        bars: Vec::with_capacity(count),
    };
    let mut x = if bars.ends { x0 } else { x0 + gap };
    for i in 0..count {
        let is_short = i % (1 + short) != 0;
        let width = scale * if is_short { child } else { size };
        row.bars.push((x, width, is_short));
        x += width + gap;
    }
    row
}

/// Adds vertical bars; short ones end below the top.
pub(crate) fn bars(bay: &mut Bay<'_>, bars: &Bars, place: &Place, rect: Rect) {
    let layer = Layer::from(place);
    // What is square in the catalogue stays square where bars shrink.
    let square = (bars.size.0 - layer.thick).abs() < 1e-9;
    let row = spread(bars, rect.x0, rect.x1).bars;
    for &(x, width, short) in &row {
        let cut = if short { bars.cut * rect.height() } else { 0.0 };
        let bar = Rect {
            x0: x,
            x1: x + width,
            z0: rect.z0,
            z1: rect.z1 - cut,
        };
        let thick = if square { width } else { layer.thick };
        let layer = Layer { thick, ..layer };
        match bars.edge.0 > 0.0 {
            true => shaped(bay, bars, place.finish, bar, layer),
            false => bay.block(place.finish, bar, layer),
        }
    }
    if bars.slits {
        slits(bay, bars, place, rect, &row);
    }
}

/// Adds a bar with chamfered front edges, or a round one.
fn shaped(bay: &mut Bay<'_>, bars: &Bars, finish: SurfaceId, bar: Rect, layer: Layer) {
    let (x, y) = ((bar.x0, bar.x1), (-layer.front, layer.thick - layer.front));
    // Edges shrink as the bar does.
    let edge = bars.edge.0 * (bar.width() / bars.size.0.max(1e-3)).min(1.0);
    if bars.round {
        // A bar round about is seen from behind too; a plastered one is not.
        let all = 2.0 * edge >= layer.thick.min(bar.width()) - 1e-9;
        let outline = soft_bar(x, y, edge, 2, all);
        bay.bodies
            .rounded(finish, &outline, Axis::Z, bar.z0, bar.z1);
    } else {
        let outline = soft_bar(x, y, edge, 1, false);
        bay.bodies.prism(finish, &outline, Axis::Z, bar.z0, bar.z1);
    }
}

/// Rounds the ends of the gaps between bars.
fn slits(bay: &mut Bay<'_>, bars: &Bars, place: &Place, rect: Rect, row: &[(f64, f64, bool)]) {
    // Just behind the bars' rounded edges.
    let back = bars.edge.0.min(place.thick.0 / 2.0) + 0.001;
    let layer = Layer {
        front: place.front.0 - back,
        thick: (place.thick.0 - back) * 0.6,
    };
    let mut from = rect.x0;
    let ends = row.iter().map(|(x, width, _)| (*x, x + width));
    let mut gaps = Vec::with_capacity(row.len() + 1);
    for (x0, x1) in ends.chain([(rect.x1, rect.x1)]) {
        gaps.push((from, x0));
        from = x1;
    }
    arcade(bay, place.finish, layer, rect, &gaps);
}

/// Returns the centres of a number of pieces between two ends.
pub(crate) fn middles(count: u32, lo: f64, hi: f64, ends: bool) -> impl Iterator<Item = f64> {
    let n = f64::from(count);
    (0..count).map(move |i| {
        let share = if !ends {
            (f64::from(i) + 1.0) / (n + 1.0)
        } else if count > 1 {
            f64::from(i) / (n - 1.0)
        } else {
            0.5
        };
        lo + (hi - lo) * share
    })
}

/// Adds horizontal bars.
pub(crate) fn rails(bay: &mut Bay<'_>, rails: &Rails, place: &Place, rect: Rect) {
    let half = rails.size.0 / 2.0;
    let (lo, hi) = match rails.ends {
        true => (rect.z0 + half, rect.z1 - half),
        false => (rect.z0, rect.z1),
    };
    for z in middles(rails.count, lo, hi, rails.ends) {
        bay.block(
            place.finish,
            rect.between(z - half, z + half),
            Layer::from(place),
        );
    }
}

/// Adds members along the inner edges of a rectangle; horizontal ones run through, vertical ones fit between them.
pub(crate) fn frame(bay: &mut Bay<'_>, size: f64, sides: Sides, place: &Place, rect: Rect) {
    let layer = Layer::from(place);
    let (z0, z1) = (rect.z0 + size, rect.z1 - size);
    let low = if sides.bottom { z0 } else { rect.z0 };
    let high = if sides.top { z1 } else { rect.z1 };
    if high <= low {
        bay.block(place.finish, rect, layer);
        return;
    }
    if sides.bottom {
        bay.block(place.finish, rect.between(rect.z0, z0), layer);
    }
    if sides.top {
        bay.block(place.finish, rect.between(z1, rect.z1), layer);
    }
    if sides.left {
        bay.block(
            place.finish,
            rect.across(rect.x0, rect.x0 + size).between(low, high),
            layer,
        );
    }
    if sides.right {
        bay.block(
            place.finish,
            rect.across(rect.x1 - size, rect.x1).between(low, high),
            layer,
        );
    }
}

/// Adds round heads in a grid, shaped as shallow domes.
pub(crate) fn studs(bay: &mut Bay<'_>, studs: &Studs, place: &Place, rect: Rect) {
    let r = studs.size.0 / 2.0;
    let layer = Layer::from(place);
    let (y0, y1) = (-layer.front, layer.thick - layer.front);
    for x in middles(studs.cols, rect.x0, rect.x1, false) {
        for z in middles(studs.rows, rect.z0, rect.z1, false) {
            // Foot and crown, counter-clockwise seen from outside.
            let ring = |r: f64, y: f64| octagon(r).map(|p| dvec3(x + p.x, y, z + p.y));
            let (foot, crown) = (ring(r, y1), ring(r * 0.55, y0));
            bay.bodies.face(place.finish, &crown);
            let mut back = foot;
            back.reverse();
            bay.bodies.face(place.finish, &back);
            skirt(bay.bodies.soup(place.finish), (x, z), foot, crown);
        }
    }
}

/// Adds the sides of a stud, shaded as one curve, with two vertices per corner.
fn skirt(soup: &mut Soup, (x, z): (f64, f64), foot: [DVec3; 8], crown: [DVec3; 8]) {
    let first = soup.positions.len() as u32;
    for (i, (a, b)) in foot.iter().zip(&crown).enumerate() {
        let out = dvec3(a.x - x, 0.0, a.z - z).normalize_or_zero();
        // Square to the slope from foot to crown.
        let slope = *b - *a;
        let normal = (out * -slope.y + DVec3::Y * slope.dot(out)).normalize_or_zero();
        for (point, v) in [(a, 0.0), (b, slope.length())] {
            let u = i as f64 * 0.01;
            soup.positions.push(point.as_vec3().to_array());
            soup.normals.push(normal.as_vec3().to_array());
            soup.uvs.push(dvec2(u, v).as_vec2().to_array());
        }
    }
    for i in 0..8 {
        let (a, b) = (first + 2 * i, first + 2 * ((i + 1) % 8));
        soup.indices.extend([a, b, b + 1, a, b + 1, a + 1]);
    }
}

/// Returns a regular octagon of half width `r`, counter-clockwise.
fn octagon(r: f64) -> [DVec2; 8] {
    // Half its side is 0.414 of its half width.
    let (a, b) = (r, r * 0.414_213_562_373_095);
    let ring = [
        (a, -b),
        (a, b),
        (b, a),
        (-b, a),
        (-a, b),
        (-a, -b),
        (-b, -a),
        (b, -a),
    ];
    ring.map(|(u, v)| dvec2(u, v))
}
