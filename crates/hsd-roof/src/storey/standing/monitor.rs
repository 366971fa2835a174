//! Monitors on a ridge: koshi-yane (越屋根, KOY), a small gable roof on walls with vents over an opening in the main roof, as
//! kemuridashi (煙出し) over the hearth of a passage.
//!
//! The rectangle of the line is that of its walls, over the ridge. These stand on the slopes below and end under a plate
//! that clears the ridge; louvres close the long sides, the wall of the house the gables. The roof below is open under it.

use crate::frame::{Frame, Rect, end_sides, near_side};
use crate::messages as say;
use crate::region::Side;
use crate::shape::end::End;
use crate::shape::form::RoofDraft;
use crate::shape::look::Look;
use crate::shape::profile::Profile;
use crate::shape::ridge_roof::RidgeRoof;
use crate::solid::{INFILL_THICKNESS, SUNK, band, prism};
use crate::storey::forms::Context;
use crate::storey::placed_line::{PlacedLine, ridge};
use crate::storey::standing::host::Slopes;
use glam::{DVec2, DVec3};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::SHAKU;
use hsd_ir::building::{Finish, Solid};

/// Clearance of the plate over the ridge below, and the least height of the vents, metres.
const OVER: f64 = 0.12;
const VENTS: f64 = 0.36;
/// Eaves and verges, metres.
const EAVES: f64 = SHAKU;
const VERGE: f64 = 0.8 * SHAKU;
/// Sill and plate are as high and thick as this, posts as wide, metres.
const BEAM: f64 = 0.09;
/// The greatest distance of posts, metres.
const POSTS: f64 = 0.95;
/// Louvres: distance, fall outwards, thickness, and how far they reach to each side of the wall line, metres.
const LOUVRE: f64 = 0.06;
const FALL: f64 = 0.055;
const THIN: f64 = 0.012;
const REACH: f64 = 0.038;
/// How far its walls reach into the covering below, metres.
const FOOT: f64 = 0.03;
/// Places at which the roof below is measured along a side.
const PLACES: u32 = 16;

/// A monitor on its roof.
struct Monitor<'s> {
    rect: Rect,
    near: Side,
    slopes: &'s Slopes,
    plate: f64,
    look: Look,
}

/// Returns the monitor of a line on the roofs planned so far; `None`, reported, if there is no roof under all of it.
pub(crate) fn planned(
    one: &PlacedLine<'_>,
    roofs: &[RoofDraft],
    context: &Context<'_>,
    out: &mut Diagnostics,
) -> Option<RoofDraft> {
    let slopes = Slopes::of(roofs);
    let rect = context.rect(&one.cell);
    let frame = Frame::new(&rect, Side::Front);
    let (mut top, mut host) = (f64::MIN, None);
    for i in 0..=PLACES {
        for j in 0..=PLACES {
            let share = |k: u32| f64::from(k) / f64::from(PLACES);
            let place = frame.at(share(i) * frame.length, share(j) * frame.depth);
            let Some((n, plane)) = slopes.over(place) else {
                let (span, letters) = (one.line.corners.span, one.shape.letters());
                out.push(say::monitor_without_roof(span, letters));
                return None;
            };
            if plane.at(place) > top {
                (top, host) = (plane.at(place), Some(n));
            }
        }
    }
    let host = &roofs[host?];
    let style = &one.line.style;
    let run = context.ridge(
        &one.cell,
        style,
        one.line.direction.and_then(|d| ridge(d.value)),
    );
    let look = look(one, host, context);
    let mut monitor = Monitor {
        rect,
        near: near_side(run),
        slopes: &slopes,
        plate: top + OVER,
        look,
    };
    let sides = [monitor.near, monitor.near.opposite()];
    let low = sides.map(|s| monitor.lowest(s));
    monitor.plate = monitor.plate.max(low[0].max(low[1]) + VENTS + 2.0 * BEAM);
    let mut draft = monitor.draft(one, host, context);
    draft.roof.span = Some(one.line.span);
    Some(draft)
}

/// Returns the look of its roof: the covering of the one below unless it is written.
fn look(one: &PlacedLine<'_>, host: &RoofDraft, context: &Context<'_>) -> Look {
    let own = &one.line.style;
    let span = context.metres(one.cell.width().min(one.cell.depth()));
    let mut look = Look::gable(Some(own), context.style, span, context.unit);
    if own.kind.is_none() {
        (look.kind, look.thickness) = (host.look.kind, host.look.thickness.min(0.1));
    }
    if own.pitch.is_none() {
        look.pitch = host.look.pitch;
    }
    if own.eaves.is_none() {
        look.eaves = EAVES;
    }
    if own.verge.is_none() {
        look.verge = VERGE;
    }
    if own.sori.is_none() {
        look.sori = 0.0;
    }
    look.noshi = own.noshi.map_or(look.noshi.min(2), |n| n.value);
    look.paint = own.paint.map(|p| p.value).or(host.look.paint);
    look
}

impl Monitor<'_> {
    /// Returns the height of the roof below at a place, metres.
    fn below(&self, place: DVec2) -> f64 {
        self.slopes.top(place).unwrap_or(self.plate - VENTS)
    }

    /// Returns the least height of the roof below along a side, metres.
    fn lowest(&self, side: Side) -> f64 {
        let frame = Frame::new(&self.rect, side);
        let place = |i: u32| frame.at(frame.length * f64::from(i) / f64::from(PLACES), 0.0);
        let heights = (0..=PLACES).map(|i| self.below(place(i)));
        heights.fold(f64::MAX, f64::min)
    }

    fn draft(&self, one: &PlacedLine<'_>, host: &RoofDraft, context: &Context<'_>) -> RoofDraft {
        let end = End {
            verge: self.look.verge,
            ..End::default()
        };
        let roof = RidgeRoof {
            rect: self.rect,
            near: self.near,
            base: self.plate,
            look: self.look,
            ends: [end; 2],
        };
        let mut form = roof.form();
        let within = self.rect.corners();
        for facet in &mut form.facets {
            facet.keep_body(&within);
        }
        form.under = host.form.under;
        form.hung = host.form.hung;
        for side in [self.near, self.near.opposite()] {
            self.vents(side, &mut form.solids);
        }
        form.solids
            .extend(end_sides(self.near).map(|side| self.gable(side)));
        let mut draft = context.of_form(form, one.shape, self.look, host.base);
        // Its timber is bare as that of its roof; gables are as the walls below.
        draft.roof.trim.lattice = false;
        draft
    }

    /// Returns the wall under a gable, from the roof below up to its own.
    fn gable(&self, side: Side) -> Solid {
        let frame = Frame::new(&self.rect, side);
        let half = frame.length / 2.0;
        let profile = Profile::new(&self.look, half, &[]);
        let knots = profile.knots.iter().map(|k| k.d).filter(|d| *d > 1e-6);
        let mut places: Vec<f64> = std::iter::once(0.0)
            .chain(knots)
            .chain((1..8).map(|i| half * f64::from(i) / 8.0))
            .collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|p, q| *p - *q < 1e-4);
        let back: Vec<f64> = places
            .iter()
            .rev()
            .skip(1)
            .map(|d| frame.length - d)
            .collect();
        places.extend(back);
        let v = -INFILL_THICKNESS / 2.0;
        let top = |u: f64| self.plate + profile.height(u.min(frame.length - u)) + SUNK;
        let upper: Vec<DVec3> = places.iter().map(|u| frame.point(*u, v, top(*u))).collect();
        let lower: Vec<f64> = places
            .iter()
            .map(|u| self.below(frame.at(*u, 0.0)) - FOOT)
            .collect();
        let by = (frame.inward() * INFILL_THICKNESS).extend(0.0);
        band(&upper, &lower, by, Finish::Gable)
    }

    /// Adds sill, posts, plate and louvres of a long side.
    fn vents(&self, side: Side, solids: &mut Vec<Solid>) {
        let frame = Frame::new(&self.rect, side);
        let low = self.lowest(side);
        let (sill, head) = (low + BEAM, self.plate - BEAM);
        // Within the gable walls, whose faces lie a little farther out.
        let ends = (0.01, frame.length - 0.01);
        let half = BEAM / 2.0;
        let mut bar = |section: [(f64, f64); 4], (from, to): (f64, f64)| {
            let profile = section.map(|(v, z)| frame.point(from, v, z));
            let by = (frame.along() * (to - from)).extend(0.0);
            solids.push(prism(&profile, by, Finish::Timber));
        };
        let upright = |z0: f64, z1: f64| [(-half, z0), (half, z0), (half, z1), (-half, z1)];
        bar(upright(low - FOOT, sill), ends);
        bar(upright(head, self.plate + SUNK), ends);
        let bays = (frame.length / POSTS).ceil().clamp(1.0, 100.0) as u32;
        let posts: Vec<f64> = (0..=bays)
            .map(|i| {
                let u = frame.length * f64::from(i) / f64::from(bays);
                u.clamp(half + 0.02, frame.length - half - 0.02)
            })
            .collect();
        for u in &posts {
            bar(upright(sill - 0.01, head + 0.01), (u - half, u + half));
        }
        let count = ((head - sill) / LOUVRE).floor().clamp(1.0, 40.0) as u32;
        let step = (head - sill) / f64::from(count);
        for i in 0..count {
            let z = sill + step * f64::from(i) - 0.2 * step;
            let section = [
                (-REACH, z),
                (REACH, z + FALL),
                (REACH, z + FALL + THIN),
                (-REACH, z + THIN),
            ];
            for bay in posts.windows(2) {
                bar(section, (bay[0] + half - 0.01, bay[1] - half + 0.01));
            }
        }
    }
}
