//! Hon-udatsu (本卯建, UDA): a party wall raised over the roof against fire, plastered, under small tiles of its own that follow
//! the slopes below.
//!
//! The rectangle of the line is the wall in plan. It goes through the roof, as far as there is a roof, and rises above it by the
//! same height everywhere; a ridge runs along its middle.

use crate::facet::Facet;
use crate::frame::{Frame, Plane, Rect, near_side};
use crate::messages as say;
use crate::region::{Ridge, Side};
use crate::shape::form::{Form, RoofDraft};
use crate::shape::look::Look;
use crate::solid::{SUNK, band};
use crate::storey::forms::Context;
use crate::storey::placed_line::{PlacedLine, ridge};
use crate::storey::standing::host::Slopes;
use glam::{DVec2, DVec3};
use hsd_base::diagnostic::Diagnostics;
use hsd_ir::ast::RoofKind;
use hsd_ir::building::{Finish, Solid};

/// Height of the wall above the roof, metres.
const HEIGHT: f64 = 0.45;
/// Pitch of its tiles across the wall, their overhang and thickness, metres.
const PITCH: f64 = 0.5;
const OVER: f64 = 0.10;
const THICK: f64 = 0.06;
/// The step at which the roof below is measured, and what a straight piece may miss of it, metres.
const STEP: f64 = 0.02;
const MISS: f64 = 0.006;
/// The shortest wall, metres.
const SHORTEST: f64 = 0.6;
/// How far its faces lie before the edges of the opening in the roof, and its foot below that, metres.
const BEFORE: f64 = 0.004;
const BELOW: f64 = 0.012;
/// Distance from a wall's line to the face of its plaster, and how far beyond a side a roof is looked for, metres.
const FACE: f64 = 0.09;
const BEYOND: f64 = 0.15;

/// Returns the wall of a line on the roofs planned so far; `None`, reported, if there is no roof under it.
pub(crate) fn planned(
    one: &PlacedLine<'_>,
    roofs: &[RoofDraft],
    context: &Context<'_>,
    out: &mut Diagnostics,
) -> Option<RoofDraft> {
    let slopes = Slopes::of(roofs);
    let wish = one.line.direction.and_then(|d| ridge(d.value));
    let run = wish.unwrap_or(match one.cell.depth() > one.cell.width() {
        true => Ridge::B,
        false => Ridge::A,
    });
    // Its ends are the near sides of the frame: v runs along the wall.
    let near = match near_side(run) {
        Side::Front => Side::Right,
        _ => Side::Front,
    };
    let own = context.rect(&one.cell);
    let frame = Frame::new(&own, near);
    let found = line(&frame, &slopes).and_then(|line| {
        let middle = frame.at(
            frame.length / 2.0,
            (line[0].0 + line[line.len() - 1].0) / 2.0,
        );
        Some((line, slopes.over(middle)?.0))
    });
    let Some((line, host)) = found else {
        let (span, letters) = (one.line.corners.span, one.shape.letters());
        out.push(say::monitor_without_roof(span, letters));
        return None;
    };
    let host = &roofs[host];
    let look = look(one, host, context);
    let rect = flush(&frame, &line, &slopes);
    let at_end = rect.max - rect.min != own.max - own.min;
    let wall = Wall {
        foot: at_end.then_some(host.base - SUNK),
        frame: Frame::new(&rect, near),
        line,
    };
    let mut form = wall.form(host);
    let within = rect.corners();
    for facet in &mut form.facets {
        facet.keep_body(&within);
    }
    let mut draft = context.of_form(form, one.shape, look, host.base);
    draft.roof.span = Some(one.line.span);
    draft.roof.trim.lattice = false;
    // Its two ridges meet in a point, which is no apex for a jewel.
    draft.roof.trim.crowned = true;
    Some(draft)
}

/// Returns the wall in plan: at an end of the roof it goes out to the face of plaster on the wall below, so that no ledge shows.
fn flush(frame: &Frame, line: &[(f64, f64)], slopes: &Slopes) -> Rect {
    let middle = f64::midpoint(line[0].0, line[line.len() - 1].0);
    let by = |u: f64| match slopes.top(frame.at(u, middle)) {
        Some(_) => 0.0,
        None => FACE,
    };
    let (p, q) = (
        frame.at(-by(-BEYOND), 0.0),
        frame.at(frame.length + by(frame.length + BEYOND), frame.depth),
    );
    Rect {
        min: p.min(q),
        max: p.max(q),
    }
}

/// Returns the look of its tiles.
fn look(one: &PlacedLine<'_>, host: &RoofDraft, context: &Context<'_>) -> Look {
    let own = &one.line.style;
    let look = Look::gable(Some(own), context.style, 1.0, context.unit);
    let usual = match host.look.kind {
        RoofKind::CoverTiles => RoofKind::CoverTiles,
        _ => RoofKind::Tiles,
    };
    Look {
        kind: own.kind.map_or(usual, |k| k.value),
        eaves: 0.0,
        verge: 0.0,
        noshi: own.noshi.map_or(1, |n| n.value),
        thickness: THICK,
        pitch: PITCH,
        sori: 0.0,
        lattice: false,
        ..look
    }
}

/// Returns the roof below the middle of a wall as a line of (place along it, height), in straight pieces, over the stretch that
/// has a roof; `None` if that is short.
fn line(frame: &Frame, slopes: &Slopes) -> Option<Vec<(f64, f64)>> {
    let count = (frame.depth / STEP).ceil().clamp(1.0, 5000.0) as u32;
    let place = |i: u32| frame.depth * f64::from(i) / f64::from(count);
    let top = |v: f64| slopes.top(frame.at(frame.length / 2.0, v));
    let all: Vec<(f64, f64)> = (0..=count)
        .filter_map(|i| Some((place(i), top(place(i))?)))
        .collect();
    let (first, last) = (all.first()?, all.last()?);
    if last.0 - first.0 < SHORTEST {
        return None;
    }
    let mut line = vec![*first];
    let mut from = 0;
    for to in 2..all.len() {
        let [p, q] = [all[from], all[to]];
        let on = |v: f64| p.1 + (q.1 - p.1) * (v - p.0) / (q.0 - p.0);
        let far = all[from..to].iter().any(|r| (on(r.0) - r.1).abs() > MISS);
        if far {
            from = to - 1;
            line.push(all[from]);
        }
    }
    line.push(*last);
    Some(line)
}

/// A wall on its line.
struct Wall {
    frame: Frame,
    line: Vec<(f64, f64)>,
    /// The height that its foot at least reaches down to at an end of the roof: that of the wall below.
    foot: Option<f64>,
}

impl Wall {
    /// Returns the height of its ridge above the roof below.
    fn rise(&self) -> f64 {
        HEIGHT + PITCH * self.frame.length / 2.0 + THICK - SUNK
    }

    /// Returns the form: two slopes along the wall, and the wall itself.
    fn form(&self, host: &RoofDraft) -> Form {
        let pieces = self.line.windows(2).enumerate();
        let last = self.line.len() - 2;
        let facets = pieces.flat_map(|(i, piece)| {
            [false, true].map(|far| self.slope(piece, far, [i == 0, i == last]))
        });
        Form {
            facets: facets.flatten().collect(),
            drop: THICK,
            floor: f64::MIN,
            solids: vec![self.wall(host.form.drop)],
            under: host.form.under,
            hung: host.form.hung,
            walls: None,
        }
    }

    /// Returns one slope over a piece of the line; `ends` are true where the wall ends.
    fn slope(&self, piece: &[(f64, f64)], far: bool, ends: [bool; 2]) -> Option<Facet> {
        let (frame, middle) = (&self.frame, self.frame.length / 2.0);
        let out = if far { frame.length + OVER } else { -OVER };
        let ridge = |(v, z): (f64, f64)| frame.point(middle, v, z + self.rise());
        let fall = PITCH * (middle + OVER);
        let (p, q) = (ridge(piece[0]), ridge(piece[1]));
        let foot = |(v, z): (f64, f64)| frame.point(out, v, z + self.rise() - fall);
        let (r, s) = (foot(piece[1]), foot(piece[0]));
        let plane = Plane::through([p, q, r])?;
        // Counter-clockwise from above: along the ridge and back along the edge, or the other way round.
        let corners: [(DVec3, bool); 4] = match far {
            false => [(p, false), (q, ends[1]), (r, true), (s, ends[0])],
            true => [(q, false), (p, ends[0]), (s, true), (r, ends[1])],
        };
        let outline = corners.map(|(at, rim)| (at.truncate(), rim));
        let turn = hsd_base::geometry::area2(&outline.map(|c| c.0));
        let outline = match turn > 0.0 {
            true => outline,
            // Edges belong to their first corner, which is the other one after turning round.
            false => {
                let [a, b, c, d] = outline;
                [(d.0, c.1), (c.0, b.1), (b.0, a.1), (a.0, d.1)]
            }
        };
        let body: Vec<DVec2> = outline.iter().map(|c| c.0).collect();
        Some(Facet::new(&outline, &body, plane))
    }

    /// Returns the wall, through the roof of this thickness.
    fn wall(&self, through: f64) -> Solid {
        let frame = &self.frame;
        let upper: Vec<DVec3> = self
            .line
            .iter()
            .map(|(v, z)| frame.point(-BEFORE, *v, z + HEIGHT))
            .collect();
        let low = |z: f64| (z - through - BELOW).min(self.foot.unwrap_or(f64::MAX));
        let lower: Vec<f64> = self.line.iter().map(|(_, z)| low(*z)).collect();
        let by = (frame.along() * (frame.length + 2.0 * BEFORE)).extend(0.0);
        band(&upper, &lower, by, Finish::Gable)
    }
}
