//! Roof lines as written: the storey of each, its place, its roof, and warnings about it.

use crate::messages as say;
use crate::plan::level::Level;
use crate::plan::tops::Tops;
use crate::region::{Ridge, Side};
use crate::shape::form::RoofDraft;
use crate::shape::look::{Look, band};
use crate::storey::forms::Context;
use crate::storey::placed_line::{PlacedLine, fall, falls_to, ridge};
use crate::storey::porch;
use crate::storey::skirt::Skirt;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::plan::{Cell, Plan};
use hsd_base::geometry::{SHAKU, STEPS, steps};
use hsd_ir::ast::{RoofKind, RoofLine, RoofShape};
use hsd_ir::building::House;

/// The most roof lines of one house; further ones are left out and reported.
const MOST_LINES: usize = 2000;

/// The least share of a roof's rectangle outside the walls that is reported.
const LEAST_OUTSIDE: f64 = 0.005;

/// Places all roof lines of a house.
pub(crate) fn place<'h>(
    house: &'h House,
    levels: &[Level<'h>],
    out: &mut Diagnostics,
) -> Vec<PlacedLine<'h>> {
    let lines = &house.roofs.lines;
    if let Some(beyond) = lines.get(MOST_LINES) {
        out.push(say::too_many_lines(beyond.span, lines.len(), MOST_LINES));
    }
    let tops = Tops::of(levels);
    let mut placed: Vec<PlacedLine<'h>> = Vec::with_capacity(lines.len().min(MOST_LINES));
    for line in lines.iter().take(MOST_LINES) {
        let Some(cell) = cell(line) else { continue };
        let Some(one) = place_one(house, line, cell, &tops, out) else {
            continue;
        };
        check_place(&one, &tops, out);
        check_options(house, &one, out);
        let same = |p: &&PlacedLine<'_>| {
            p.covers()
                && one.covers()
                && p.cell.overlaps(&one.cell)
                && (p.base - one.base).abs() < 1e-3
        };
        if let Some(other) = placed.iter().find(same) {
            out.push(say::overlapping(line.corners.span, other.line.corners.span));
        }
        placed.push(one);
    }
    placed
}

fn cell(line: &RoofLine) -> Option<Cell> {
    let [a0, b0, a1, b1] = line.corners.value.map(steps);
    let cell = Cell {
        a0: a0.min(a1),
        b0: b0.min(b1),
        a1: a0.max(a1),
        b1: b0.max(b1),
    };
    (cell.width() > 0 && cell.depth() > 0).then_some(cell)
}

fn place_one<'h>(
    house: &House,
    line: &'h RoofLine,
    cell: Cell,
    tops: &Tops<'_, '_>,
    out: &mut Diagnostics,
) -> Option<PlacedLine<'h>> {
    let levels = tops.levels;
    let shape = line.style.shape.map_or(RoofShape::Gable, |s| s.value);
    let placed = |(level, base): (usize, f64)| PlacedLine {
        line,
        level,
        cell,
        base,
        shape,
    };
    let Some(height) = line.height else {
        let place = topmost(house, line, &cell, shape, tops)?;
        return Some(placed(place));
    };
    let base = height.value * SHAKU;
    let gap = |top: f64| (top - base).abs();
    let tops = levels.iter().map(|l| l.storey.z1);
    let (level, top) = tops
        .enumerate()
        .min_by(|p, q| gap(p.1).total_cmp(&gap(q.1)))?;
    if gap(top) > 3.0 * SHAKU + 1e-6 && shape != RoofShape::Pent {
        let number = levels[level].storey.number;
        out.push(say::far_from_top(
            height.span,
            height.value,
            number,
            top / SHAKU,
        ));
    }
    // Sums of storeys differ from the written height in the last bit, but roofs of one height must meet.
    let base = if gap(top) < 1e-6 { top } else { base };
    Some(placed((level, base)))
}

/// Returns level and height of a line with `*`.
fn topmost(
    house: &House,
    line: &RoofLine,
    cell: &Cell,
    shape: RoofShape,
    tops: &Tops<'_, '_>,
) -> Option<(usize, f64)> {
    let levels = tops.levels;
    if shape == RoofShape::Pent {
        // Its upper edge is at the foot of the upper wall, or well under the eaves of the only one.
        let look = Look::lean_to(Some(&line.style), &house.roofs.style, 0.9);
        let depth = cell.width().min(cell.depth()) as f64 / STEPS as f64 * house.unit;
        let foot = levels.first()?.storey.z1 - if levels.len() > 1 { 0.0 } else { 0.5 };
        return Some((0, foot - look.pitch * depth));
    }
    let open = |k: usize| levels[k].orthogonal && tops.is_open(k, cell);
    let level = (0..levels.len())
        .rev()
        .find(|k| open(*k))
        .unwrap_or(levels.len().checked_sub(1)?);
    Some((level, levels[level].storey.z1))
}

fn check_place(one: &PlacedLine<'_>, tops: &Tops<'_, '_>, out: &mut Diagnostics) {
    let level = &tops.levels[one.level];
    let (line, place) = (one.line, one.line.corners.span);
    if level.is_open() || !level.orthogonal || one.shape.stands_on_another() {
        return;
    }
    if one.shape == RoofShape::Pent {
        return check_pent(one, tops, out);
    }
    let (inside, whole) = (tops.inside(one.level, &one.cell), one.cell.area());
    let may_stand_out = matches!(one.shape, RoofShape::LeanTo | RoofShape::Karahafu);
    if inside == 0 {
        if !may_stand_out {
            out.push(say::over_no_wall(place, one.shape.letters()));
        }
    } else {
        let outside = 1.0 - inside as f64 / whole as f64;
        // Less is a matter of rounding, not of drawing.
        if outside >= LEAST_OUTSIDE && !may_stand_out {
            out.push(say::partly_outside(place, outside));
        }
    }
    if let Some(upper) = tops.levels.get(one.level + 1)
        && upper.orthogonal
        && inside > 0
        && tops.inside(one.level + 1, &one.cell) == whole
    {
        out.push(say::under_storey(
            line.span,
            level.storey.number,
            upper.storey.span,
            line.height.as_ref().map(|h| h.span),
        ));
    }
}

fn check_pent(one: &PlacedLine<'_>, tops: &Tops<'_, '_>, out: &mut Diagnostics) {
    let place = one.line.corners.span;
    let outline = tops.outline(one.level);
    let hangs = |side: Side| !outline.along(&one.cell, side).is_empty();
    if tops.inside(one.level, &one.cell) > 0 {
        out.push(say::pent_over_rooms(place));
    } else if !Side::ALL.into_iter().any(hangs) {
        out.push(say::pent_in_the_air(place));
    } else if let Some(direction) = one.line.direction
        && fall(direction.value).is_some_and(|near| !hangs(near.opposite()))
    {
        out.push(say::pent_falls_wrong(direction.span));
    }
}

fn check_options(house: &House, one: &PlacedLine<'_>, out: &mut Diagnostics) {
    let (line, style) = (one.line, &one.line.style);
    let kind = style
        .kind
        .or(house.roofs.style.kind)
        .map_or(RoofKind::Tiles, |k| k.value);
    if let Some(pitch) = style.pitch {
        check_pitch(pitch, kind, out);
    }
    let Some(direction) = line.direction else {
        return;
    };
    if one.shape.is_dormer() {
        if fall(direction.value).is_none() {
            out.push(say::dormer_direction(direction.span, one.shape.letters()));
        }
        return;
    }
    let one_sided = matches!(one.shape, RoofShape::LeanTo | RoofShape::Pent);
    if one.shape != RoofShape::Flat && one_sided != fall(direction.value).is_some() {
        out.push(say::odd_direction(
            direction.span,
            one.shape.letters(),
            one_sided,
        ));
    }
    if let Some(ridge) = ridge(direction.value)
        && !one_sided
        && one.shape != RoofShape::Flat
    {
        let (width, depth) = (one.cell.width(), one.cell.depth());
        let (length, span) = if ridge == Ridge::A {
            (width, depth)
        } else {
            (depth, width)
        };
        // Hira-iri houses are commonly somewhat deeper than wide; twice as deep is probably a mistake.
        if span >= 2 * length && span > 6 * STEPS {
            let other = if ridge == Ridge::A { "Y" } else { "X" };
            let wide = span as f64 / STEPS as f64;
            out.push(say::long_span(direction.span, wide, other));
        }
    }
}

/// Warns of a pitch outside the covering's band.
pub(crate) fn check_pitch(
    pitch: hsd_base::source::Spanned<f64>,
    kind: RoofKind,
    out: &mut Diagnostics,
) {
    let band = band(kind);
    if pitch.value < band.0 - 1e-9 || pitch.value > band.1 + 1e-9 {
        let of = |k: &&(char, RoofKind)| k.1 == kind;
        let letter = RoofKind::ALL.iter().find(of).map_or('K', |k| k.0);
        out.push(say::odd_pitch(pitch.span, pitch.value, letter, band));
    }
}

/// Returns the roof of a line.
pub(crate) fn planned(
    one: &PlacedLine<'_>,
    context: &Context<'_>,
    out: &mut Diagnostics,
) -> RoofDraft {
    let ridge_wish = one.line.direction.and_then(|d| ridge(d.value));
    let fall_wish = one.line.direction.and_then(|d| fall(d.value));
    let style = Some(&one.line.style);
    let mut planned = match one.shape {
        RoofShape::LeanTo => {
            let near = falls_to(one);
            context.lean_to(one.cell, near, one.base, style)
        }
        RoofShape::Pent => {
            let near = fall_wish.unwrap_or_else(|| away_from_wall(context, &one.cell));
            let (planned, upper) = context.pent(one.cell, near, one.base, style);
            if let Some(height) = one.line.height
                && upper > context.roof_top + 1e-3
            {
                out.push(say::pent_too_high(
                    height.span,
                    upper / SHAKU,
                    context.roof_top / SHAKU,
                    (height.value * SHAKU - (upper - context.roof_top)) / SHAKU,
                ));
            }
            planned
        }
        RoofShape::Flat => {
            context.flat(&[one.cell], &Plan::from_cells(&[one.cell]), one.base, style)
        }
        RoofShape::Karahafu => {
            let run = porch::ridge(&one.cell, context, ridge_wish);
            let run = run.unwrap_or_else(|| context.ridge(&one.cell, &one.line.style, None));
            porch::planned(one, run, context)
        }
        _ => {
            let skirt = Skirt::over(one.cell, one.shape, context);
            let run = context.ridge(&one.cell, &one.line.style, ridge_wish);
            match skirt.filter(|_| stands_on(one, context)) {
                Some(skirt) => skirt.planned(context, one.base, style, one.line.span, out),
                None => context.ridge_roof(one.cell, run, one.base, style),
            }
        }
    };
    planned.roof.span = Some(one.line.span);
    planned.roof.shape = one.shape;
    planned
}

/// Returns the side opposite to the one that lies on a wall.
pub(crate) fn away_from_wall(context: &Context<'_>, cell: &Cell) -> Side {
    let on_wall = |side: &Side| !context.outline().along(cell, side.opposite()).is_empty();
    [Side::Front, Side::Back, Side::Left, Side::Right]
        .into_iter()
        .find(on_wall)
        .unwrap_or(Side::Front)
}

/// Returns true if a line's roof stands on top of its storey, not above the roofs of higher storeys.
fn stands_on(one: &PlacedLine<'_>, context: &Context<'_>) -> bool {
    one.base < context.level.storey.z1 + 0.5
}
