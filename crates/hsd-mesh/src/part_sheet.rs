//! The catalogue for viewing: every part in a storey of three metres, as a scene in rows or as an image.
//!
//! Images use an oblique projection, as joiners do: the front to scale, depth shifted to the left and down, so that
//! right sides and tops show.

use crate::assembly::{HouseDrafts, SceneBuilder};
use crate::bake::{Lens, Picture, bake};
use crate::mesh::panel::extent;
use crate::mesh::{Bodies, Soup};
use crate::part::bay::{Bay, HALF_POST, Layer};
use crate::part::detail;
use crate::part::names_of;
use crate::store::Store;
use crate::store::bank::Bank;
use crate::store::look::Share;
use compact_str::CompactString;
use glam::{DVec3, dvec3};
use hsd_base::geometry::SHAKU;
use hsd_ir::catalog::{PartDef, Stance};
use hsd_ir::material::SurfaceId;
use hsd_scene::{Detail, Kind, Node, NodeId, Scene};
use image::{Rgb, RgbImage};
use std::sync::Arc;

/// Width of one U, metres: three shaku.
const UNIT: f64 = 3.0 * SHAKU;

/// Height of the storey in which parts are shown, metres: ten shaku.
const STOREY: f64 = 10.0 * SHAKU;

/// Distance between two parts, metres.
const APART: f64 = 0.6;

/// Distance from one row of parts to the next, metres.
const ROW: f64 = 5.0;

/// Shift to the left and down for one metre of depth.
const OBLIQUE: (f64, f64) = (0.35, 0.25);

/// Background colour of images.
const PAPER: [u8; 3] = [0xf6, 0xf3, 0xec];

/// Returns a scene of all parts, one row per class, from the front row to the back.
pub fn scene(parts: &[&PartDef], detail: Detail) -> Scene {
    let bank = Bank::default();
    let mut store = Store::new((detail, false), &bank);
    let mut nodes = vec![Node::new(None, Kind::House, "parts".into(), DVec3::ZERO)];
    let classes = parts.chunk_by(|a, b| a.class() == b.class());
    for (row, class) in classes.enumerate() {
        let at = dvec3(0.0, row as f64 * ROW, 0.0);
        let name = CompactString::from(String::from(class[0].class()));
        nodes.push(Node::new(Some(NodeId(0)), Kind::Facade, name, at));
        let facade = NodeId(nodes.len() as u32 - 1);
        let mut x = 0.0;
        for definition in class {
            let code = definition.code();
            let made = bodies(definition, detail);
            let mesh = store.finish(code.trim_end().to_owned(), made, share(definition));
            if mesh.is_empty() {
                continue; // the void
            }
            let mut part = Node::new(
                Some(facade),
                Kind::Part,
                code.trim_end().into(),
                dvec3(x, 0.0, 0.0),
            );
            part.code = Some(code.into());
            part.names = Some(Arc::new(names_of(definition)));
            part.mesh = Some(store.push(mesh));
            nodes.push(part);
            x += definition.width() * UNIT + APART;
        }
    }
    let mut scene = SceneBuilder::new(detail);
    scene.add(HouseDrafts {
        nodes,
        drafts: store.into_drafts(),
        joined: 0,
        oversized: vec![],
    });
    scene.finish(vec![])
}

fn share(part: &PartDef) -> Share {
    Share::new(part.reflection.unwrap_or_default())
}

/// Builds a part with its posts.
fn bodies(definition: &PartDef, detail: Detail) -> Bodies {
    let height = definition.to.map_or(STOREY, |to| STOREY.max(to * SHAKU));
    let (z0, z1) = match (definition.from, definition.to) {
        (Some(from), Some(to)) => (from * SHAKU, to * SHAKU),
        _ => (0.0, height),
    };
    let width = definition.width() * UNIT;
    let around = definition.finish.unwrap_or(SurfaceId::named("plaster"));
    let mut bay = Bay::new(definition, (width, height), (z0, z1), around, detail, None);
    detail::build(&mut bay);
    if definition.stance == Stance::Posts && width > 0.0 {
        let layer = Layer {
            front: HALF_POST,
            thick: 2.0 * HALF_POST,
        };
        for x in [0.0, width] {
            let post = bay.whole().across(x - HALF_POST, x + HALF_POST);
            bay.block(SurfaceId::named("cedar"), post, layer);
        }
    }
    bay.bodies
}

/// Returns an oblique image of a part, `density` pixels per metre; `None` for the void.
pub fn picture(definition: &PartDef, density: f64) -> Option<RgbImage> {
    let mut soups = bodies(definition, Detail::Everything).soups;
    soups.iter_mut().for_each(|(_, soup)| slant(soup));
    let (rect, _) = extent(&soups)?;
    let lens = Lens {
        density,
        panes: true,
    };
    Some(lit(&bake(&soups, |id| id, rect, lens)?))
}

/// Shears a soup into the oblique projection, with its normals.
fn slant(soup: &mut Soup) {
    for p in &mut soup.positions {
        p[0] += (f64::from(p[1]) * OBLIQUE.0) as f32;
        p[2] += (f64::from(p[1]) * OBLIQUE.1) as f32;
    }
    for triangle in soup.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| {
            let p = soup.positions[triangle[k] as usize];
            DVec3::from(p.map(f64::from))
        });
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for i in triangle {
            soup.normals[*i as usize] = normal.as_vec3().to_array();
        }
    }
}

/// Renders an image on paper, lit by a sun from the upper left.
fn lit(picture: &Picture) -> RgbImage {
    let sun = dvec3(-0.45, 0.55, 0.70).normalize();
    RgbImage::from_fn(picture.color.width(), picture.color.height(), |x, y| {
        let [r, g, b, a] = picture.color.get_pixel(x, y).0;
        if a == 0 {
            return Rgb(PAPER);
        }
        let n = picture
            .normal
            .get_pixel(x, y)
            .0
            .map(|c| f64::from(c) / 127.5 - 1.0);
        let light = 0.55 + 0.60 * DVec3::from(n).dot(sun).max(0.0);
        Rgb([r, g, b].map(|c| (f64::from(c) * light).min(255.0) as u8))
    })
}
