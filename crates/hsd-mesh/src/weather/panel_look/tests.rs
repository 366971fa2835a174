//! Images of weathered fronts, compared with the exact weather of every triangle.

use super::*;
use crate::bake::{OLD, Picture, WALL, bake};
use crate::part;
use crate::part::bay::Bay;
use crate::weather::{Exposure, Years};
use hsd_ir::material::{Luck, dimmed};
use hsd_scene::Detail;
use hsd_scene::texture::samples::linear;
use hsd_syntax::parse;

/// Walls, lattices, doors and windows of wood, plaster, clay, stained wood and paper.
const CODES: [&str; 8] = [
    "KSK  ", "KKS  ", "KTU  ", "GSI  ", "GDE 2", "TSH 2", "MMU 2", "TIT 2",
];

/// Exposure of foot, middle and head: under eaves, below low eaves, in full rain.
const AIR: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [1.0, 0.5, 0.1], [1.0; 3]];

fn panels(code: &str) -> Vec<Panel> {
    let mut parts = parse::builtin().parts().iter();
    let part = parts
        .find(|p| p.code() == code)
        .expect("is in the catalogue");
    let size = (part.width() * 0.9, 2.7);
    let span = (part.from.unwrap_or(0.0) * 0.3, 1.8);
    let around = SurfaceId::named("plaster");
    part::build(Bay::new(part, size, span, around, Detail::Flat, None)).panels
}

fn weather(years: f64, zones: [f64; 3], luck: u8) -> Weather {
    Weather::Wall {
        years: Years::new(years),
        luck: Luck(luck),
        limits: [45, 149],
        zones: zones.map(Exposure::new),
    }
}

/// Returns the mean colour of what is no hole, linear RGB.
fn mean(picture: &Picture, light: f32) -> [f64; 3] {
    let pixels = picture.color.pixels().filter(|p| p.0[3] > 0);
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for pixel in pixels {
        count += 1.0;
        for (sum, c) in sum.iter_mut().zip(pixel.0) {
            *sum += f64::from(linear(c) * light);
        }
    }
    sum.map(|s| s / count)
}

/// Returns the largest difference of two colours in a channel, as a share of their mean.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    let channels = a.iter().zip(b);
    let shares = channels.map(|(a, b)| 2.0 * (a - b).abs() / (a + b));
    shares.fold(0.0, f64::max)
}

fn exact(panel: &Panel, weather: Weather) -> [f64; 3] {
    let worn = weather.wear(panel.soups.clone());
    let picture = bake(&worn, |id| id, panel.rect, WALL).expect("a front is seen");
    mean(&picture, 1.0)
}

fn shown(panel: &Panel, weather: Weather) -> [f64; 3] {
    let look = PanelAreas::of(panel).look(weather);
    let picture = bake(&panel.soups, |id| look.shown(id), panel.rect, OLD);
    mean(&picture.expect("a front is seen"), dimmed(look.shade))
}

#[test]
fn old_fronts_look_as_old_as_their_surfaces() {
    let mut far = vec![];
    for (code, panel) in CODES
        .iter()
        .flat_map(|c| panels(c).into_iter().map(move |p| (c, p)))
    {
        let new = exact(&panel, Weather::None);
        for years in [0.0, 12.0, 40.0, 150.0] {
            for (zones, luck) in AIR.iter().zip(0..) {
                let weather = weather(years, *zones, luck);
                let (own, image) = (exact(&panel, weather), shown(&panel, weather));
                let error = apart(own, image);
                // What has clearly changed must not look new.
                let changed = apart(new, own) > 0.10;
                if error > 0.25 || changed && apart(new, image) < 0.5 * apart(new, own) {
                    far.push(format!(
                        "{code} {years} {zones:?}: {error:.3} {new:.3?} {own:.3?} {image:.3?}"
                    ));
                }
            }
        }
    }
    assert!(far.is_empty(), "\n{}", far.join("\n"));
}

#[test]
fn old_fronts_have_few_looks() {
    let exposures = (0..=10).flat_map(|low| (0..=low).map(move |high| [10, low, high]));
    let zones: Vec<[f64; 3]> = exposures.map(|z| z.map(|e| f64::from(e) / 10.0)).collect();
    for (code, panel) in CODES
        .iter()
        .flat_map(|c| panels(c).into_iter().map(move |p| (c, p)))
    {
        let areas = PanelAreas::of(&panel);
        let (mut images, mut all) = (vec![], 0);
        for years in 0..200 {
            for (zones, luck) in zones
                .iter()
                .flat_map(|z| (0..Luck::COUNT).map(move |l| (z, l)))
            {
                let look = areas.look(weather(f64::from(years), *zones, luck));
                all += 1;
                if !images.contains(&look.surfaces) {
                    images.push(look.surfaces);
                }
            }
        }
        assert!(images.len() <= 60, "{code}: {} of {all}", images.len());
    }
}

#[test]
fn new_panels_show_their_own_surfaces() {
    for panel in panels("GSI  ") {
        let look = PanelAreas::of(&panel).look(Weather::None);
        assert_eq!(look, PanelLook::default());
        let own = panel.soups.iter().map(|(id, _)| *id);
        assert!(own.clone().map(|id| look.shown(id)).eq(own));
    }
}
