//! What a part shows from afar, where it is a few stripes of a wall: of each its main surface, in the mean colour of all that is
//! visible of it.

use crate::bake::{FAR, seen};
use crate::part::bay::Bay;
use crate::part::detail;
use crate::store::look::colour_of;
use glam::{DVec2, dvec2};
use hsd_base::geometry::SHAKU;
use hsd_ir::catalog::PartDef;
use hsd_ir::catalog::body::Shape;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
use smallvec::{SmallVec, smallvec};
use std::ops::Range;

/// Widths and heights of bays that are looked at, metres: what is seen of one in between follows from them.
const BAYS: [(f64, f64); 2] = [(3.0 * SHAKU, 4.0 * SHAKU), (6.0 * SHAKU, 9.0 * SHAKU)];

/// Ways in which a passer-by and somebody on a hill look at a wall: to the right and up on each metre into the house, metres.
const SLANTS: [DVec2; 2] = [dvec2(-0.7, -0.4), dvec2(0.7, -0.4)];

/// Rows into which the height of a part is divided; those that look alike are one stripe.
const ROWS: usize = 8;

/// The most stripes of a part.
const MOST: usize = 3;

/// The greatest difference of a channel, linear, of rows that look alike.
const ALIKE: f32 = 0.12;

/// The least share of what is visible that a surface has whose texture is worth showing.
const MAIN: f32 = 0.85;

/// A part from afar: its stripes from the foot to the top.
pub(crate) type FromAfar = SmallVec<[Stripe; 1]>;

/// A horizontal stripe of a part.
#[derive(Clone, Debug)]
pub(crate) struct Stripe {
    /// Its foot and its top as shares of the part's height.
    pub(crate) z: (f64, f64),
    /// That of which most is visible.
    pub(crate) surface: SurfaceId,
    /// True if little else is visible, so that its texture is worth showing.
    pub(crate) textured: bool,
    /// What is visible between the posts, by height and width of the bay, in the order of [`BAYS`].
    bays: [[Shares; 2]; 2],
}

/// Surfaces and the share of each in what is visible.
type Shares = SmallVec<[(SurfaceId, f32); 4]>;

/// Surfaces, and how many rays hit each.
type Seen = Vec<(SurfaceId, usize)>;

impl Stripe {
    /// Returns that of a wall of one surface.
    pub(crate) fn of_surface(surface: SurfaceId) -> Stripe {
        let all = || smallvec![(surface, 1.0)];
        Stripe {
            z: (0.0, 1.0),
            surface,
            textured: true,
            bays: [[all(), all()], [all(), all()]],
        }
    }

    /// Returns that of rows, as what is seen of them in the bays of [`BAYS`]; `None` if nothing is.
    fn of_rows(rows: Range<usize>, bays: &[[Vec<Seen>; 2]; 2]) -> Option<Stripe> {
        let of = |bay: &Vec<Seen>| shares(&bay[rows.clone()]);
        let bays = bays.each_ref().map(|row| row.each_ref().map(of));
        let most = bays[1][1].iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let (surface, share) = *most?;
        let height = |row: usize| row as f64 / ROWS as f64;
        Some(Stripe {
            z: (height(rows.start), height(rows.end)),
            surface,
            textured: share >= MAIN,
            bays,
        })
    }

    /// Returns the mean colour, linear RGB, of what is visible between the posts of a bay, metres, by the colours of surfaces.
    /// Frames keep their size, so that what is left between them goes with one over the width and the height.
    pub(crate) fn mean(
        &self,
        (width, height): (f64, f64),
        colour: impl Fn(SurfaceId) -> [f32; 3],
    ) -> [f32; 3] {
        let share = |of: f64, [least, most]: [f64; 2]| {
            let [near, far, at] = [least, most, of].map(f64::recip);
            ((at - near) / (far - near)).clamp(0.0, 1.0) as f32
        };
        let across = share(width, BAYS.map(|b| b.0));
        let up = share(height, BAYS.map(|b| b.1));
        let mut mean = [0.0; 3];
        for (row, by) in self.bays.iter().zip([1.0 - up, up]) {
            for (bay, of_row) in row.iter().zip([1.0 - across, across]) {
                for (surface, share) in bay {
                    let (part, light) = (by * of_row * share, colour(*surface));
                    mean = std::array::from_fn(|k| mean[k] + light[k] * part);
                }
            }
        }
        mean
    }

    /// Returns how far the colours of two are apart in a large bay.
    fn apart(&self, other: &Stripe) -> f32 {
        let large = BAYS[1];
        let (a, b) = (self.mean(large, colour_of), other.mean(large, colour_of));
        (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max)
    }
}

/// Looks at a part; `None` if it has nothing of its own.
pub(super) fn of(part: &PartDef) -> Option<FromAfar> {
    let first = part.body.first().map(|e| match &e.shape {
        Shape::Leaf(leaf) => leaf.pane,
        _ => e.place.finish,
    });
    let usual = part.finish.or(first)?;
    let bays = BAYS.map(|(_, height)| {
        BAYS.map(|(width, _)| {
            let all = (0.0, height);
            let mut bay = Bay::new(part, (width, height), all, usual, Detail::Everything, None);
            detail::elements(&mut bay, &part.body, None);
            seen(&bay.bodies.soups, bay.clear, FAR, &SLANTS, ROWS)
        })
    });
    let hit = |bay: &Vec<Seen>| bay.iter().all(|row| row.iter().any(|s| s.1 > 0));
    if !bays.iter().flatten().all(hit) {
        return Some(smallvec![Stripe::of_surface(usual)]);
    }
    let rows = |rows: Range<usize>| Stripe::of_rows(rows, &bays);
    let mut stripes: FromAfar = (0..ROWS).filter_map(|n| rows(n..n + 1)).collect();
    loop {
        let pairs = stripes.windows(2).map(|w| w[0].apart(&w[1]));
        let nearest = pairs.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((n, _)) = nearest.filter(|(_, by)| *by < ALIKE || stripes.len() > MOST) else {
            return Some(stripes);
        };
        let row = |share: f64| (share * ROWS as f64).round() as usize;
        if let Some(both) = rows(row(stripes[n].z.0)..row(stripes[n + 1].z.1)) {
            stripes[n] = both;
        }
        stripes.remove(n + 1);
    }
}

/// Returns what is seen of several rows.
fn shares(rows: &[Seen]) -> Shares {
    let all: usize = rows.iter().flatten().map(|s| s.1).sum();
    let surfaces = rows.first().into_iter().flatten().map(|s| s.0).enumerate();
    let shares = surfaces.map(|(n, surface)| {
        let count: usize = rows.iter().map(|row| row[n].1).sum();
        (surface, count as f32 / all.max(1) as f32)
    });
    shares.filter(|s| s.1 > 0.0).collect()
}
