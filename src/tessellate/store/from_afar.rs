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
use glam::{DVec2, dvec2};

/// Widths and heights of bays that are looked at, metres: what is seen of one in between follows from them.
const BAYS: [(f64, f64); 2] = [(3.0 * SHAKU, 4.0 * SHAKU), (9.0 * SHAKU, 12.0 * SHAKU)];

/// Ways in which a passer-by and somebody on a hill look at a wall: to the right and up on each metre into the house, metres.
const SLANTS: [DVec2; 2] = [dvec2(-0.7, -0.4), dvec2(0.7, -0.4)];

/// A part from afar.
#[derive(Clone, Copy, Debug)]
pub(in crate::tessellate) struct FromAfar {
    /// That of which most is visible.
    pub(in crate::tessellate) surface: SurfaceId,
    /// True if it is shown with its texture, toned to the mean colour: if little else is visible, or if it is glass. Otherwise
    /// the mean colour alone is as good.
    pub(in crate::tessellate) textured: bool,
    means: Means,
}

/// The mean colours, linear RGB, of what is visible between the posts in bays of the lesser and the greater height, and in
/// each of the lesser and the greater width.
type Means = [[[f32; 3]; 2]; 2];

/// The least share of what is visible that a surface has whose texture is worth showing.
const MAIN: f64 = 0.85;

impl FromAfar {
    /// Looks at a wall of one surface.
    pub(in crate::tessellate) fn of_surface(surface: SurfaceId) -> FromAfar {
        FromAfar {
            surface,
            textured: true,
            means: [[colour_of(surface); 2]; 2],
        }
    }

    /// Looks at a part; `None` if it has nothing of its own.
    pub(in crate::tessellate) fn of(part: &PartDef) -> Option<FromAfar> {
        let first = part.body.first().map(|e| match &e.shape {
            Shape::Leaf(leaf) => leaf.pane,
            _ => e.place.finish,
        });
        let usual = part.finish.or(first)?;
        let looks = BAYS.map(|(_, height)| {
            BAYS.map(|(width, _)| {
                let all = (0.0, height);
                let mut bay = Bay::new(part, (width, height), all, usual, Detail::Everything, None);
                detail::elements(&mut bay, &part.body, None);
                seen(&bay.bodies.soups, bay.clear, FAR, &SLANTS)
            })
        });
        let [[narrow, _], [_, wide]] = &looks;
        let rays = |of: &Seen| of.iter().map(|s| s.1).sum::<usize>();
        let most = wide.iter().filter(|s| s.1 > 0).max_by_key(|s| s.1);
        let Some((surface, count)) = most.filter(|_| rays(narrow) > 0) else {
            return Some(FromAfar::of_surface(usual));
        };
        Some(FromAfar {
            surface: *surface,
            textured: surface.surface().glass || *count as f64 >= MAIN * rays(wide) as f64,
            means: looks.map(|row| row.map(|seen| mean(&seen))),
        })
    }

    /// Returns the mean colour, linear RGB, of what is visible between the posts of a bay, metres. Frames keep their size, so
    /// that what is left between them goes with one over the width and the height.
    pub(in crate::tessellate) fn mean(&self, width: f64, height: f64) -> [f32; 3] {
        let share = |of: f64, [least, most]: [f64; 2]| {
            let [near, far, at] = [least, most, of].map(f64::recip);
            ((at - near) / (far - near)).clamp(0.0, 1.0) as f32
        };
        let across = share(width, BAYS.map(|b| b.0));
        let up = share(height, BAYS.map(|b| b.1));
        let between = |[a, b]: [[f32; 3]; 2], by: f32| -> [f32; 3] {
            std::array::from_fn(|k| a[k] + (b[k] - a[k]) * by)
        };
        between(self.means.map(|row| between(row, across)), up)
    }
}

/// Surfaces, and how many rays hit each.
type Seen = Vec<(SurfaceId, usize)>;

/// Returns the mean colour of surfaces of which so much is visible.
fn mean(seen: &Seen) -> [f32; 3] {
    let (mut sum, mut rays) = ([0.0; 3], 0.0);
    for (surface, count) in seen {
        let (colour, count) = (colour_of(*surface), *count as f32);
        rays += count;
        sum = std::array::from_fn(|k| sum[k] + colour[k] * count);
    }
    sum.map(|x| x / f32::max(rays, 1.0))
}
