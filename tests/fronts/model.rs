//! Walls of our own models, as photographs see them: a text of the language is compiled, its front is seen straight on, with the
//! relief of its parts in slanting light, and stands where scenes have the wall that they draw. So truth is known to the pixel.

use super::scene::{Dice, Facade, Kind};
use hsd::geometry::SHAKU;
use hsd::glam::{DVec2, DVec3, dvec2, dvec3};
use hsd::render::raster::Grid;
use hsd::render::view::{Frame, Triangle, View, triangles};
use hsd::scene::{Image, NodeId, Scene};
use hsd::texture::samples::{linear, samples};
use std::fmt::Write;

/// Pixels of a metre of the wall.
const FINE: f64 = 60.0;
/// Where light comes from.
const LIGHT: DVec3 = dvec3(-0.35, -0.80, 0.48);
/// What panes show, and how much of it.
const PANE: (DVec3, f64) = (dvec3(0.10, 0.14, 0.19), 0.45);

/// The code of a kind between its bits of wall, and its width in units.
fn code(kind: Kind) -> (&'static str, f64) {
    match kind {
        Kind::Sashes => ("NAS 2", 1.9),
        Kind::Pair => ("NWI", 1.6),
        Kind::Curtained => ("NGC", 1.2),
        Kind::Shuttered => ("NAP", 1.6),
        Kind::Wall => ("", 0.0),
        Kind::Shop => ("NSW 2", 2.4),
        Kind::Door => ("NAD 2", 1.8),
    }
}

/// A facade with the bays and storeys of a drawn one, of the parts of the catalogue.
pub fn facade(seed: u64) -> Facade {
    let mut facade = Facade::new(seed);
    let mut dice = Dice::new(seed ^ 0x3D);
    let wall = ["NRC", "NMO", "NTI"][dice.below(3)];
    let text = text(&mut facade, wall);
    let run = crate::support::compile("wall.hsd", text.as_bytes());
    assert!(!run.has_errors(), "{}", run.short());
    facade.model = Some(seen(&run.scene, dvec2(facade.width, facade.height)));
    facade
}

/// The text of a facade, whose lengths become those of the text.
fn text(facade: &mut Facade, wall: &str) -> String {
    let rounded = |metres: f64, unit: f64| ((metres / unit * 100.0).round() / 100.0).max(0.1);
    let bay = rounded(facade.columns[1], 3.0 * SHAKU).max(2.8);
    facade.columns = (0..facade.columns.len())
        .map(|k| bay * 3.0 * SHAKU * k as f64)
        .collect();
    facade.width = facade.columns[facade.columns.len() - 1];
    let heights: Vec<f64> = facade
        .rows
        .windows(2)
        .map(|r| rounded(r[1] - r[0], SHAKU))
        .collect();
    facade.rows = vec![0.0];
    for height in &heights {
        facade
            .rows
            .push(facade.rows[facade.rows.len() - 1] + height * SHAKU);
    }
    facade.height = facade.rows[heights.len()];
    let mut text = format!(
        "<Structure size=\"{}\" order=\"right\"><Facades><Facade id=\"1\" ratio=\"1\" angle=\"0\">\n",
        facade.width * 10.0
    );
    for (row, height) in heights.iter().enumerate().rev() {
        let _ = writeln!(
            text,
            "<Floor id=\"{}\" height=\"{height}\">",
            heights.len() - row
        );
        for kind in &facade.kinds[row] {
            let (code, width) = code(*kind);
            let side = (bay - width) / 2.0;
            let _ = match code {
                "" => writeln!(text, "<Part code=\"{wall}\" width=\"{bay}\"/>"),
                _ => writeln!(
                    text,
                    "<Part code=\"{wall}\" width=\"{side}\"/><Part code=\"{code}\" width=\"{width}\"/><Part code=\"{wall}\" width=\"{side}\"/>"
                ),
            };
        }
        text += "</Floor>\n";
    }
    text + "</Facade></Facades></Structure>\n"
}

/// A wall seen straight on: linear light, row by row from above.
#[derive(Clone, Debug)]
pub struct Straight {
    width: usize,
    tones: Vec<[f64; 3]>,
}

impl Straight {
    /// The colour at a place, metres from the upper left corner, between the four pixels round it.
    pub fn tone(&self, x: f64, y: f64) -> [f64; 3] {
        let height = self.tones.len() / self.width;
        let (x, y) = ((x * FINE - 0.5).max(0.0), (y * FINE - 0.5).max(0.0));
        let at =
            |x: usize, y: usize| self.tones[y.min(height - 1) * self.width + x.min(self.width - 1)];
        let (left, top) = (x as usize, y as usize);
        let (fx, fy) = (x - left as f64, y - top as f64);
        let (a, b, c, d) = (
            at(left, top),
            at(left + 1, top),
            at(left, top + 1),
            at(left + 1, top + 1),
        );
        [0, 1, 2].map(|k| {
            let (upper, lower) = (a[k] + (b[k] - a[k]) * fx, c[k] + (d[k] - c[k]) * fx);
            upper + (lower - upper) * fy
        })
    }
}

fn seen(scene: &Scene, size: DVec2) -> Straight {
    let roots = (0..).zip(&scene.nodes).filter(|(_, n)| n.parent.is_none());
    let roots: Vec<NodeId> = roots.map(|(n, _)| NodeId(n)).collect();
    let all = triangles(scene, &roots);
    let frame = Frame::new(DVec3::Y);
    // Two by two rays a pixel.
    let (width, height) = (
        (size.x * FINE).round() as usize,
        (size.y * FINE).round() as usize,
    );
    let step = 0.5 / FINE;
    let grid = Grid {
        origin: dvec2(step / 2.0 - size.x, step / 2.0),
        step,
        width: 2 * width,
        height: 2 * height,
    };
    let view = View::of(&all, frame, grid, |_, _| false);
    let color = |x: usize, row: usize| {
        let hit = view.hits[row * 2 * width + x].as_ref();
        hit.map_or(DVec3::ZERO, |hit| {
            dye(
                scene,
                &all[hit.triangle as usize],
                hit.weights.map(f64::from),
            )
        })
    };
    let tones = (0..width * height).map(|k| {
        let (x, row) = (2 * (k % width), 2 * (height - 1 - k / width));
        let sum = color(x, row) + color(x + 1, row) + color(x, row + 1) + color(x + 1, row + 1);
        (sum / 4.0).to_array()
    });
    let tones = tones.collect();
    Straight { width, tones }
}

/// The light from a place of a triangle.
fn dye(scene: &Scene, triangle: &Triangle, weights: [f64; 3]) -> DVec3 {
    let Some(material) = triangle.material.map(|id| &scene.materials[id.0 as usize]) else {
        return DVec3::ZERO;
    };
    let of = |k: usize| triangle.uvs[k] * weights[k];
    let uv = of(0) + of(1) + of(2);
    let plain = match material.image {
        Image::Surface(name) => samples(name).map(|s| s.at(uv.x, uv.y).color.map(f64::from)),
        _ => None,
    };
    let [red, green, blue, opacity] = material.tint.map(f64::from);
    let own = plain.map_or(DVec3::ONE, DVec3::from_array) * dvec3(red, green, blue);
    let own = match material.reflection.is_some() || opacity < 1.0 {
        true => own.lerp(PANE.0, PANE.1),
        false => own,
    };
    let turned = triangle.normals[0].dot(LIGHT).max(0.0);
    own * (0.35 + 0.75 * turned) * f64::from(linear(255))
}
