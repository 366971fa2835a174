//! What a part shows from afar, where it is one stripe of a wall: its main surface, in the mean colour of all that is visible
//! of it.

use crate::catalog::PartDef;
use crate::catalog::body::Shape;
use crate::geometry::SHAKU;
use crate::material::SurfaceId;
use crate::scene::Detail;
use crate::tessellate::bake::{FAR, seen};
use crate::tessellate::part::bay::Bay;
use crate::tessellate::part::detail;
use crate::tessellate::store::look::colour_of;

/// Width and height of a usual bay, metres: an Edo ken each.
const USUAL: (f64, f64) = (6.0 * SHAKU, 6.0 * SHAKU);

/// A part from afar.
#[derive(Clone, Copy, Debug)]
pub(in crate::tessellate) struct FromAfar {
    /// That of which most is visible where the part fills a usual bay.
    pub(in crate::tessellate) surface: SurfaceId,
    /// True if it is shown with its texture, toned to the mean colour: if little else is visible, or if it is glass. Otherwise
    /// the mean colour alone is as good.
    pub(in crate::tessellate) textured: bool,
    /// The mean colour of what is visible between the posts, linear RGB, if those of all surfaces are known.
    pub(in crate::tessellate) mean: Option<[f32; 3]>,
}

/// The least share of what is visible that a surface has whose texture is worth showing.
const MAIN: f64 = 0.85;

impl FromAfar {
    /// Looks at a wall of one surface.
    pub(in crate::tessellate) fn of_surface(surface: SurfaceId) -> FromAfar {
        FromAfar {
            surface,
            textured: true,
            mean: colour_of(surface),
        }
    }

    /// Looks at a part; `None` if it has nothing of its own.
    pub(in crate::tessellate) fn of(part: &PartDef) -> Option<FromAfar> {
        let first = part.body.first().map(|e| match &e.shape {
            Shape::Leaf(leaf) => leaf.pane,
            _ => e.place.finish,
        });
        let usual = part.finish.or(first)?;
        let all = (0.0, USUAL.1);
        let mut bay = Bay::new(part, USUAL, all, usual, Detail::Everything, None);
        detail::elements(&mut bay, &part.body, None);
        let seen = seen(&bay.bodies.soups, bay.clear, FAR);
        let rays: usize = seen.iter().map(|s| s.1).sum();
        let most = seen.iter().filter(|s| s.1 > 0).max_by_key(|s| s.1);
        let Some((surface, count)) = most else {
            return Some(FromAfar::of_surface(usual));
        };
        Some(FromAfar {
            surface: *surface,
            textured: surface.surface().glass || *count as f64 >= MAIN * rays as f64,
            mean: mean(&seen),
        })
    }
}

/// Returns the mean colour of surfaces of which so much is visible; `None` if one of them has none.
fn mean(seen: &[(SurfaceId, usize)]) -> Option<[f32; 3]> {
    let mut sum = [0.0; 3];
    for (surface, rays) in seen.iter().filter(|s| s.1 > 0) {
        let colour = colour_of(*surface)?;
        sum = std::array::from_fn(|k| sum[k] + colour[k] * *rays as f32);
    }
    let rays: usize = seen.iter().map(|s| s.1).sum();
    Some(sum.map(|x| x / rays as f32))
}
