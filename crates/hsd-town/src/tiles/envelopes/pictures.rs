//! A page with a picture of the envelope of each lot, block by block, with its scenarios side by side at one scale (002-32).

use super::{LOOKS, scenarios};
use crate::site::law::{EnvelopeFace, EnvelopeRow};
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_syntax::parse::xml::escaped;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The direction from which lots are looked at: the south-east, from above.
const FROM: DVec3 = dvec3(0.5, -0.7, 0.55);
/// The width and height of the picture of a lot, points.
const SIZE: DVec2 = dvec2(260.0, 220.0);
/// The free edge of a picture, points.
const EDGE: f64 = 12.0;

/// The page without its content.
const HEAD: &str = r#"<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Envelopes</title><style>
body { font: 14px/1.5 sans-serif; margin: 2em; color: #222; background: #fbfaf6; }
section { margin-bottom: 2em; } figure { display: inline-block; margin: 0 1em 1em 0; vertical-align: top; width: 260px; }
article { border-top: 1px solid #ccc; padding-top: .5em; } svg { background: #fff; border: 1px solid #ddd; }
figcaption { font-size: 12px; } td, th { padding: .1em .8em .1em 0; text-align: right; } td:first-child, th:first-child { text-align: left; }
path { stroke: #333; stroke-width: .7; stroke-linejoin: round; }
.above { color: #b00020; }
</style></head><body>
<h1>Envelopes エンベロープ</h1>
<p>What building law lets stand on each lot; a study of shapes and no legal opinion. 敷地に建てられる最大の立体。形の検討であって、法的な判断ではありません。</p>
"#;

/// Returns the page.
pub fn page(rows: &[EnvelopeRow]) -> String {
    let all = scenarios(rows);
    let mut blocks: BTreeMap<&str, Vec<&EnvelopeRow>> = BTreeMap::new();
    for row in rows {
        blocks.entry(&row.block).or_default().push(row);
    }
    let mut page = HEAD.to_owned();
    for (block, rows) in blocks {
        let name = if block.is_empty() { "–" } else { block };
        let _ = writeln!(page, "<section><h2>Block 街区 {}</h2>", escaped(name));
        sums(&mut page, &rows, &all);
        let mut lots: Vec<(&str, &str)> = vec![];
        for row in &rows {
            let lot = (&*row.layer, &*row.key);
            if !lots.contains(&lot) {
                lots.push(lot);
            }
        }
        for (layer, key) in lots {
            let own = rows.iter().copied();
            let own = own.filter(|row| row.layer == layer && row.key == key);
            lot(&mut page, &own.collect::<Vec<_>>());
        }
        page.push_str("</section>\n");
    }
    page + "</body></html>\n"
}

/// Adds the sums of a block, a line for each scenario.
fn sums(page: &mut String, rows: &[&EnvelopeRow], scenarios: &[&str]) {
    page.push_str("<table><tr><th></th><th>lots 敷地</th><th>volume 体積 (m³)</th><th>floor area 床面積 (m²)</th><th>highest 最高 (m)</th></tr>\n");
    for scenario in scenarios {
        let own = || rows.iter().filter(|row| row.scenario == *scenario);
        let volume: f64 = own().map(|row| row.volume).sum();
        let floors: f64 = own().map(|row| row.floor_area()).sum();
        let highest = own().map(|row| row.height).fold(0.0, f64::max);
        let (name, count) = (escaped(scenario), own().count());
        let _ = writeln!(
            page,
            "<tr><td>{name}</td><td>{count}</td><td>{volume:.0}</td><td>{floors:.0}</td><td>{highest:.2}</td></tr>"
        );
    }
    page.push_str("</table>\n");
}

/// Adds the pictures of a lot, all at the scale of the largest.
fn lot(page: &mut String, rows: &[&EnvelopeRow]) {
    let Some(first) = rows.first() else { return };
    let frame = Frame::of(rows);
    let _ = writeln!(page, "<article><h3>{}</h3>", escaped(&first.key));
    for row in rows {
        let _ = writeln!(
            page,
            "<figure><svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2} {3}\">",
            SIZE.x,
            SIZE.y,
            escaped(&row.key),
            escaped(&row.scenario),
        );
        for face in seen(&row.faces) {
            let points = face.ring.iter().map(|p| frame.place(DVec3::from(*p)));
            let points: Vec<String> = points.map(|p| format!("{:.1} {:.1}", p.x, p.y)).collect();
            let _ = writeln!(
                page,
                "<path fill=\"{}\" d=\"M{}Z\"><title>{}</title></path>",
                colour(face),
                points.join("L"),
                escaped(&face.rule)
            );
        }
        page.push_str("</svg>");
        caption(page, row);
        page.push_str("</figure>\n");
    }
    page.push_str("</article>\n");
}

/// Adds what is written under a picture.
fn caption(page: &mut String, row: &EnvelopeRow) {
    let _ = write!(
        page,
        "<figcaption><b>{}</b><br>{:.0} m³, {:.0} m² ({:.0} %), {:.2} m",
        escaped(&row.scenario),
        row.volume,
        row.floor_area(),
        100.0 * row.floor_area() / row.lot_area.max(1e-9),
        row.height
    );
    for ((rule, _), arithmetic) in row.rules.iter().zip(&row.arithmetic) {
        let _ = write!(page, "<br>{}: {}", escaped(rule), escaped(arithmetic));
    }
    if row.above > 0.01 {
        let _ = write!(
            page,
            "<br><span class=\"above\">house {:.2} m above 既存の家が超過</span>",
            row.above
        );
    }
    page.push_str("</figcaption>");
}

/// Returns the faces that look towards the eye, from the farthest to the nearest.
fn seen(faces: &[EnvelopeFace]) -> Vec<&EnvelopeFace> {
    let looks = |face: &&EnvelopeFace| normal(face).dot(FROM) > 1e-9;
    let mut seen: Vec<&EnvelopeFace> = faces.iter().filter(looks).collect();
    let near = |face: &EnvelopeFace| {
        let places = face.ring.iter().map(|p| DVec3::from(*p).dot(FROM));
        places.sum::<f64>() / face.ring.len() as f64
    };
    seen.sort_by(|a, b| near(a).total_cmp(&near(b)));
    seen
}

fn normal(face: &EnvelopeFace) -> DVec3 {
    let ring: Vec<DVec3> = face.ring.iter().copied().map(DVec3::from).collect();
    let fan = ring.get(1..).unwrap_or_default().windows(2);
    fan.map(|two| (two[0] - ring[0]).cross(two[1] - ring[0]))
        .sum::<DVec3>()
        .normalize_or_zero()
}

/// Returns the colour of a face: that of its rule, lighter the more it looks up.
fn colour(face: &EnvelopeFace) -> String {
    let kind = face.rule.strip_prefix("end of ").unwrap_or(&face.rule);
    let kind = kind.split(' ').next().unwrap_or_default();
    let look = LOOKS.iter().find(|(word, _)| *word == kind);
    let [r, g, b, _] = look.map_or(super::PLAIN, |(_, tint)| *tint);
    let light = 0.55 + 0.45 * normal(face).z.max(0.0);
    let channel = |value: f32| (255.0 * libm::sqrt(f64::from(value) * light)).round() as u8;
    format!("#{:02x}{:02x}{:02x}", channel(r), channel(g), channel(b))
}

/// Where places of a lot lie in its pictures.
struct Frame {
    low: DVec2,
    scale: f64,
}

impl Frame {
    fn of(rows: &[&EnvelopeRow]) -> Frame {
        let faces = rows.iter().flat_map(|row| &row.faces);
        let places = faces.flat_map(|face| &face.ring);
        let places = places.map(|p| flat(DVec3::from(*p)));
        let around = places.fold(None, |around: Option<[DVec2; 2]>, p| {
            let [low, high] = around.unwrap_or([p, p]);
            Some([low.min(p), high.max(p)])
        });
        let [low, high] = around.unwrap_or_default();
        let scale = (SIZE - 2.0 * EDGE) / (high - low).max(DVec2::splat(1e-6));
        let scale = scale.min_element();
        // In the middle of the picture.
        let free = (SIZE - 2.0 * EDGE) / scale - (high - low);
        Frame {
            low: low - free / 2.0,
            scale,
        }
    }

    fn place(&self, p: DVec3) -> DVec2 {
        (flat(p) - self.low) * self.scale + EDGE
    }
}

/// Returns a place as seen from [`FROM`], metres to the right and down.
fn flat(p: DVec3) -> DVec2 {
    let right = DVec3::Z.cross(FROM).normalize_or_zero();
    let up = FROM.cross(right).normalize_or_zero();
    dvec2(p.dot(right), -p.dot(up))
}
