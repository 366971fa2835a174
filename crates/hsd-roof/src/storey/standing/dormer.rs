//! Gables on the slope of another roof: chidori-hafu (千鳥破風, CHI) and noki-karahafu (軒唐破風, NOK).
//!
//! The rectangle of the line gives place and width: its side towards the eaves is the gable, as wide at its foot as the
//! rectangle, where the dormer's upper surface meets that of the slope. The ridge runs back level until it dies in the
//! slope, whatever the depth of the rectangle, so that valleys follow from the pitches. A karahafu whose gable lies at
//! the walls or before them stands in the eaves: their edge itself swells, level at both feet.

use hsd_ir::ast::{RoofShape, RoofStyle};

use crate::frame::{Frame, Rect, end_sides, near_side};
use crate::messages as say;
use crate::region::Side;
use crate::shape::board::upright;
use crate::shape::end::End;
use crate::shape::form::RoofDraft;
use crate::shape::look::Look;
use crate::shape::profile::Profile;
use crate::shape::ridge_roof::RidgeRoof;
use crate::solid::{INFILL_THICKNESS, SUNK, curtain};
use crate::storey::forms::Context;
use crate::storey::placed_line::{PlacedLine, fall};
use crate::storey::standing::host::Slopes;
use glam::{DVec2, DVec3};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::SHAKU;
use hsd_ir::building::{Arch, Finish, Solid};

/// Pitch of the gable: at least this, and steeper than its slope by a factor; of a karahafu (rise over half the width).
const PITCH: f64 = 0.6;
const STEEPER: f64 = 1.25;
const KARAHAFU: f64 = 0.45;
/// Overhang of the gable as a share of its width, and its bounds, metres.
const VERGE: f64 = 0.08;
const VERGES: (f64, f64) = (0.2, 0.7);
/// Eaves of a karahafu on a slope as a share of its width, and the most, metres.
const EAVES: f64 = 0.08;
const MOST_EAVES: f64 = 0.3;
/// Room for the boards of a karahafu in the eaves, metres.
const IN_EAVES: f64 = 0.3;
/// The least distance of a gable's front from the edge of its slope, metres.
const INSIDE: f64 = 0.1;
/// How far below the top of its slope its ridge ends, metres.
const BELOW: f64 = 0.05;
/// How far it extends into the slope at its back, and how far its feet lie below it, metres.
const INTO: f64 = 0.05;
/// How far inside of an edge heights are taken, metres.
const HAIR: f64 = 1e-5;
/// The step of searches along a slope, metres.
const STEP: f64 = 0.02;
/// The longest way along a slope, metres.
const FARTHEST: f64 = 60.0;
/// The least fall of a slope towards its side, rise per metre, and the least width of a gable, metres.
const LEAST_FALL: f64 = 0.05;
const LEAST_WIDTH: f64 = 0.6;

/// A dormer on its slope.
struct Dormer<'a, 'h> {
    one: &'a PlacedLine<'h>,
    slopes: &'a Slopes,
    host: &'a RoofDraft,
    /// The side that its gable faces.
    side: Side,
    /// From its gable inwards, as wide as its feet.
    frame: Frame,
    /// Distance of the gable behind the front of the rectangle, metres; negative before it.
    at: f64,
    /// Height of the slope's upper surface at its feet, metres.
    foot: f64,
    /// True if it stands in the eaves.
    in_eaves: bool,
}

/// Returns the roof of a dormer on the roofs planned so far; `None`, reported, if there is no slope under it.
pub(crate) fn planned(
    one: &PlacedLine<'_>,
    roofs: &[RoofDraft],
    context: &Context<'_>,
    out: &mut Diagnostics,
) -> Option<RoofDraft> {
    let slopes = Slopes::of(roofs);
    let Some(dormer) = Dormer::on(one, &slopes, roofs, context) else {
        out.push(say::dormer_without_slope(
            one.line.corners.span,
            one.shape.letters(),
        ));
        return None;
    };
    Some(dormer.draft(context, out))
}

/// Returns true if the front of a rectangle lies over the walls below the roof there or before them.
fn at_walls(frame: &Frame, slopes: &Slopes, roofs: &[RoofDraft]) -> bool {
    let front = slopes.over(frame.at(frame.length / 2.0, 0.0));
    front.is_none_or(|(n, plane)| {
        let host = &roofs[n];
        plane.at(frame.at(frame.length / 2.0, 0.0)) < host.base + host.form.drop + INTO
    })
}

/// Returns the side to which a slope falls most.
fn falling(rise: DVec2) -> Side {
    match rise.x.abs() > rise.y.abs() {
        true if rise.x > 0.0 => Side::Left,
        true => Side::Right,
        false if rise.y > 0.0 => Side::Front,
        false => Side::Back,
    }
}

impl<'a, 'h> Dormer<'a, 'h> {
    /// Finds the slope under a line; `None` if there is none that falls to its side.
    fn on(
        one: &'a PlacedLine<'h>,
        slopes: &'a Slopes,
        roofs: &'a [RoofDraft],
        context: &Context<'_>,
    ) -> Option<Dormer<'a, 'h>> {
        let rect = context.rect(&one.cell);
        let middle = (rect.min + rect.max) / 2.0;
        let wish = one.line.direction.and_then(|d| fall(d.value));
        let side = match wish {
            Some(side) => side,
            None => falling(slopes.over(middle)?.1.slope),
        };
        let frame = Frame::new(&rect, side);
        let height = |u: f64, v: f64| slopes.top(frame.at(u, v));
        let centre = frame.length / 2.0;
        let curved = one.shape == RoofShape::EavesKarahafu;
        let in_eaves = curved && at_walls(&frame, slopes, roofs);
        let at = match in_eaves {
            true => edge(|v| height(centre, v), frame.depth)?,
            false => 0.0,
        };
        // A hair inside, since the edge of a covering belongs to it hardly.
        let inside = at + HAIR;
        let feet = [0.0, centre, frame.length].map(|u| height(u, inside));
        let [Some(left), Some(foot), Some(right)] = feet else {
            return None;
        };
        let (n, plane) = slopes.over(frame.at(centre, inside))?;
        let fall = plane.slope.dot(frame.inward());
        (fall > LEAST_FALL && frame.length > LEAST_WIDTH).then(|| Dormer {
            one,
            slopes,
            host: &roofs[n],
            side,
            frame,
            at,
            // The slope ends exactly in the foot of the gable.
            foot: foot.min(left).min(right) - fall * HAIR,
            in_eaves,
        })
    }

    /// Returns the height of the slope over the middle of the dormer, `v` metres behind its gable.
    fn slope(&self, v: f64) -> Option<f64> {
        let centre = self.frame.length / 2.0;
        self.slopes.top(self.frame.at(centre, self.at + v))
    }

    /// Returns the distance behind the gable at which the slope is as high as `ridge`, or the top of the slope if it is lower.
    fn dies(&self, ridge: f64) -> Result<f64, f64> {
        let mut best = self.foot;
        let mut v = STEP;
        while v < FARTHEST {
            match self.slope(v) {
                Some(z) if z >= ridge => return Ok(self.refined(ridge, v)),
                Some(z) if z > best - 1e-6 => best = z.max(best),
                _ => break,
            }
            v += STEP;
        }
        Err(best)
    }

    /// Returns the place before `v` at which the slope is as high as `ridge`, to a hundredth of a millimetre.
    fn refined(&self, ridge: f64, v: f64) -> f64 {
        let (mut low, mut high) = (v - STEP, v);
        for _ in 0..12 {
            let middle = f64::midpoint(low, high);
            match self.slope(middle) {
                Some(z) if z < ridge => low = middle,
                _ => high = middle,
            }
        }
        high
    }

    /// Returns its look, with a pitch at which its ridge ends in the slope.
    fn look(&self, context: &Context<'_>, out: &mut Diagnostics) -> (Look, f64) {
        let own: &RoofStyle = &self.one.line.style;
        let (width, host) = (self.frame.length, &self.host.look);
        let mut look = Look::gable(Some(own), context.style, width, context.unit);
        if own.kind.is_none() {
            (look.kind, look.thickness) = (host.kind, host.thickness);
        }
        if own.gable_wall.is_none() {
            look.lattice = host.lattice;
        }
        look.paint = own.paint.map(|p| p.value).or(host.paint);
        let curved = self.one.shape == RoofShape::EavesKarahafu;
        look.shape = match curved {
            true => RoofShape::Karahafu,
            false => RoofShape::Gable,
        };
        look.sori = own
            .sori
            .map_or(host.sori, |s| s.value / 100.0)
            .clamp(-0.5, 0.5);
        let usual = match curved {
            true => KARAHAFU,
            false => PITCH.max(host.pitch * STEEPER),
        };
        look.pitch = own.pitch.map_or(usual, |sun| sun.value / 10.0);
        look.pitch = look.pitch.clamp(0.05, 5.0);
        let half = width / 2.0;
        let depth = self
            .dies(self.foot + look.pitch * half)
            .unwrap_or_else(|top| {
                let wish = look.pitch;
                look.pitch = ((top - BELOW - self.foot) / half).clamp(0.02, wish);
                let place = own.pitch.map_or(self.one.line.corners.span, |p| p.span);
                out.push(say::dormer_too_high(place, wish * 10.0, look.pitch * 10.0));
                self.dies(self.foot + look.pitch * half).unwrap_or(STEP)
            });
        look.verge = self.verge(own);
        look.barge = look.verge;
        look.eaves = match curved {
            true => own
                .eaves
                .map_or((EAVES * width).min(MOST_EAVES), |e| e.value * SHAKU),
            false => 0.0,
        };
        if self.in_eaves {
            look.eaves = 0.0;
            // As thick upright as the roof whose edge it lifts.
            look.thickness = self.host.form.drop / upright(1.0, look.pitch);
        }
        if !curved {
            look.eaves = self.feet(&look, half);
        }
        (look, depth)
    }

    /// Returns how far the gable's slopes go on before its wall, metres: as far as the slope lies under them.
    fn verge(&self, own: &RoofStyle) -> f64 {
        let usual = (VERGE * self.frame.length).clamp(VERGES.0, VERGES.1);
        let mut verge = own
            .verge
            .map_or(usual, |g| g.value * SHAKU)
            .clamp(0.02, 10.0);
        while verge > 2.0 * STEP && self.slope(-verge - INSIDE).is_none() {
            verge -= STEP;
        }
        verge
    }

    /// Returns how far the slopes go on beyond the feet of the gable, metres, until they lie in the slope before it.
    fn feet(&self, look: &Look, half: f64) -> f64 {
        let front = self.slope(-look.verge).unwrap_or(self.foot);
        let mut beyond = 0.0;
        for i in 1..100 {
            beyond = STEP * f64::from(i);
            let wider = Look {
                eaves: beyond,
                ..*look
            };
            let foot = Profile::new(&wider, half, &[]).height(-beyond);
            if self.foot + foot < front - INTO {
                break;
            }
        }
        beyond
    }

    /// Returns the roof.
    fn draft(&self, context: &Context<'_>, out: &mut Diagnostics) -> RoofDraft {
        let (look, depth) = self.look(context, out);
        let base = self.foot - look.drop();
        let near = near_side(self.side.ridge_into());
        let front = End {
            verge: if self.in_eaves { 0.0 } else { look.verge },
            wall: !self.in_eaves,
            ..End::default()
        };
        let rect = self.rect(depth + INTO);
        let roof = RidgeRoof {
            rect,
            near,
            base,
            look,
            ends: end_sides(near).map(|s| match s == self.side {
                true => front,
                false => End::default(),
            }),
        };
        let mut form = roof.form();
        form.under = self.host.form.under;
        form.hung = self.host.form.hung;
        match self.in_eaves {
            true => form.solids.extend(self.over_the_wall(&look, base)),
            false => {
                let within = rect.corners();
                form.facets.iter_mut().for_each(|f| f.keep_body(&within));
            }
        }
        let mut draft = context.of_form(form, self.one.shape, look, self.host.base);
        let trim = &mut draft.roof.trim;
        trim.pendant = true;
        trim.lattice = look.lattice && !self.in_eaves;
        // The boards of a karahafu in the eaves stand before its rafters.
        trim.verge = if self.in_eaves { IN_EAVES } else { look.verge };
        trim.arch = (self.one.shape == RoofShape::EavesKarahafu).then(|| self.arch(&look));
        trim.noshi = self
            .one
            .line
            .style
            .noshi
            .map_or(look.noshi.min(3), |n| n.value);
        draft.roof.span = Some(self.one.line.span);
        draft
    }

    /// Returns the room for the bent rafters of a karahafu.
    fn arch(&self, look: &Look) -> Arch {
        match self.in_eaves {
            true => Arch {
                depth: self.host.roof.trim.eaves,
                fall: self.host.look.pitch,
            },
            false => Arch {
                depth: look.verge,
                fall: 0.0,
            },
        }
    }

    /// Returns its rectangle from the gable back over `depth` metres.
    fn rect(&self, depth: f64) -> Rect {
        let (p, q) = (
            self.frame.at(0.0, self.at),
            self.frame.at(self.frame.length, self.at + depth),
        );
        Rect {
            min: p.min(q),
            max: p.max(q),
        }
    }

    /// Returns the wall between the plate and a karahafu in the eaves, where it is higher than the roof beside it.
    fn over_the_wall(&self, look: &Look, base: f64) -> Option<Solid> {
        let plate = self.host.base;
        // A pent roof has its walls at its back.
        let wall = self
            .dies(plate + self.host.form.drop)
            .ok()
            .filter(|_| !self.host.form.hung)?;
        let half = self.frame.length / 2.0;
        let profile = Profile::new(look, half, &[]);
        let from = profile.reach(plate - base + SUNK)?;
        let knots = profile
            .knots
            .iter()
            .map(|k| k.d)
            .filter(|d| *d > from + 0.01);
        let rising: Vec<(f64, f64)> = std::iter::once(from)
            .chain(knots)
            .map(|d| (d, base + profile.height(d) + SUNK))
            .collect();
        let falling = rising.iter().rev().skip(1);
        let back: Vec<_> = falling.map(|(d, z)| (2.0 * half - d, *z)).collect();
        let v = self.at + wall - INFILL_THICKNESS / 2.0;
        let chain = rising.into_iter().chain(back);
        let upper: Vec<DVec3> = chain.map(|(u, z)| self.frame.point(u, v, z)).collect();
        let by = (self.frame.inward() * INFILL_THICKNESS).extend(0.0);
        Some(curtain(&upper, plate - SUNK, by, Finish::Gable))
    }
}

/// Returns the outer edge of the covering along a line: the least `v` at which there is a height, from the first one between 0
/// and `depth` outwards.
fn edge(height: impl Fn(f64) -> Option<f64>, depth: f64) -> Option<f64> {
    let places = (0..=(depth / STEP) as u32).map(|i| 1e-4 + STEP * f64::from(i));
    let mut inside = places.into_iter().find(|v| height(*v).is_some())?;
    let mut outside = inside;
    while height(outside).is_some() {
        inside = outside;
        outside -= 0.1;
        if outside < -FARTHEST {
            return None;
        }
    }
    for _ in 0..40 {
        let middle = f64::midpoint(inside, outside);
        match height(middle) {
            Some(_) => inside = middle,
            None => outside = middle,
        }
    }
    Some(inside)
}
