//! `<Pagoda>`: square storeys that taper by a share (逓減率 teigen-ritsu), a lower roof round each, and a pyramidal roof
//! with the finial on top. Rules after Horyu-ji's (`docs/evidence.md` 4.8, S54 and S55), as shares of widths: they give
//! its documented height, and To-ji's, from the width and the taper alone.

use super::draft::{Bay, Draft, OPEN, Usual, WALL, joinery};
use super::{Pass, count, or};
use crate::messages::fittings::Scarce;
use hsd_ir::ast::{self, FinialKind, Order, Paint, Rail, RoofKind, RoofShape, RoofStyle, Side};

/// Height of the first columns, and of the brackets on them, as shares of the first width.
const COLUMNS: f64 = 0.49;
const BRACKETS: f64 = 0.265;
/// Height from one eaves plate to the next, as a share of the upper storey's width.
const RISE: f64 = 0.855;
/// Diameter of the first columns as a share of the first width, of a pagoda of three bays.
const POST: f64 = 0.085;
/// Overhang, and the purlin's position in it.
const EAVES: f64 = 0.47;
/// How much of the taper of the walls the overhang follows: the fifth roof of Horyu-ji is 0.6 as wide as the first over walls
/// half as wide.
const EAVES_FOLLOW: f64 = 0.6;
const REACH: f64 = 0.36;
/// Share of the sōrin in the whole height.
const SORIN: f64 = 0.3;
/// The middle bay is wider than the others by this factor.
const MIDDLE: f64 = 1.25;
/// The minimum height of columns, shaku.
const LEAST: f64 = 1.5;

/// One storey's measures, shaku.
struct Tier {
    width: f64,
    /// Height from plate to plate.
    height: f64,
    /// Its width as a share of the first one's.
    share: f64,
    /// Overhang of its roof, shaku.
    eaves: f64,
    /// Number of bays of a side.
    bays: u32,
}

impl Pass<'_, '_> {
    pub(super) fn pagoda(&mut self, it: &ast::Pagoda, draft: &mut Draft<'_>) {
        let (m, span) = (&it.measures, it.span);
        let first = or(it.width, 18.0);
        let paint = m.paint.map_or(Paint::Vermilion, |p| p.value);
        let tiers = tiers(it, first);
        let pitch = or(m.pitch, 5.5);
        let thickness = or(m.thickness, 0.6);
        let steps = count(m.steps, 3);
        draft.look(m, &usual(first), paint);
        // More bays of the same width between more posts.
        let slender = 3.0 / f64::from(tiers[0].bays.max(3));
        let mut plate = 0.0;
        for (i, tier) in tiers.iter().enumerate() {
            plate += tier.height;
            let inset = match i {
                0 => 0.0,
                _ => (tiers[i - 1].width - tier.width) / 2.0,
            };
            // The height hidden by the lower roof; `base` adds the part visible between it and the veranda.
            let hidden = pitch / 10.0 * inset + thickness * 1.15 + 0.4;
            let base = f64::from(u8::from(i > 0)) * (hidden + tier.width * 0.1);
            let zone = BRACKETS * tier.width;
            let columns = self.at_least(span, Scarce::Tier, tier.height - base - zone, LEAST);
            plate += base + zone + columns - tier.height;
            let order = Order {
                posts: draft.posts(or(m.post, POST * first * slender) * tier.share, paint, 3),
                veranda: match i {
                    0 => None,
                    _ => draft.veranda(tier.width * 0.1, base, Rail::Crossed, vec![]),
                },
                brackets: draft.brackets(steps, zone, REACH * tier.eaves),
            };
            let walls = side(tier.bays, tier.width, paint);
            draft.tier(&walls, (base, base + columns + zone), order);
            if let (0, [(_, aisle), core @ .., _]) = (i, &walls[..])
                && !core.is_empty()
            {
                // The four posts round the altar (四天柱 shitenbashira).
                let core = [(OPEN, core.iter().map(|bay| bay.1).sum())];
                draft.columns([*aisle; 2], [&core, &core]);
            }
            draft.roof(RoofStyle {
                shape: draft.style.shape,
                eaves: draft.say(tier.eaves),
                ..RoofStyle::default()
            });
        }
        let platform = or(m.platform, 0.215 * first);
        let stairs = (Side::ALL.map(|s| s.1).to_vec(), first * 0.35);
        draft.platform(m, platform, 0.5 * first, stairs);
        let last = tiers.last().map_or(first, |t| t.width);
        let body = platform + plate + pitch / 10.0 * last / 2.0 + thickness;
        let sorin = or(it.sorin, body * SORIN / (1.0 - SORIN));
        if sorin > 0.0 {
            draft.finial(FinialKind::Sorin, Some(sorin), None);
        }
    }
}

fn usual(first: f64) -> Usual {
    Usual {
        kind: RoofKind::CoverTiles,
        shape: RoofShape::Pyramid,
        pitch: 5.5,
        eaves: EAVES * first,
        verge: 1.0,
        thickness: 0.6,
        noshi: 3,
        sori: 4.0,
        gable: 0.25,
        plain: false,
    }
}

/// Returns the storeys; their widths decrease linearly to the share of the last one (w1 (1 - (1 - rho) (i - 1) / (n -
/// 1))), their overhangs to a share of their own.
fn tiers(it: &ast::Pagoda, first: f64) -> Vec<Tier> {
    let n = count(it.storeys, 5).max(1);
    let (taper, rise) = (or(it.taper, 0.7), or(it.rise, RISE));
    let columns = or(it.measures.columns, COLUMNS * first);
    let eaves = or(it.measures.eaves, EAVES * first);
    let eaves_taper = or(it.eaves_taper, 1.0 - EAVES_FOLLOW * (1.0 - taper));
    let bays = count(it.bays, 3);
    let tier = |i: u32| {
        let down = f64::from(i) / f64::from((n - 1).max(1));
        let share = 1.0 - (1.0 - taper) * down;
        let width = first * share;
        let height = match i {
            0 => columns + BRACKETS * width,
            _ => rise * width,
        };
        Tier {
            width,
            height,
            share,
            eaves: eaves * (1.0 - (1.0 - eaves_taper) * down),
            bays: match i + 1 == n && n > 1 {
                true => count(it.top_bays, bays),
                false => bays,
            },
        }
    };
    (0..n).map(tier).collect()
}

/// Returns the bays of a side: doors in the middle, windows beside them, walls beyond.
fn side(bays: u32, width: f64, paint: Paint) -> Vec<Bay> {
    let (door, window) = joinery(paint);
    let wide = if bays > 2 && bays % 2 == 1 {
        MIDDLE
    } else {
        1.0
    };
    let plain = width / (f64::from(bays) - 1.0 + wide);
    let bay = |i: u32| {
        let off = (2 * i).abs_diff(bays - 1);
        match off {
            0 => (door, plain * wide),
            // Two bays are two doors.
            1 if bays == 2 => (door, plain),
            1 | 2 => (window, plain),
            _ => (WALL, plain),
        }
    };
    (0..bays).map(bay).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_add_up_and_are_mirrored() {
        for bays in 1..8 {
            let side = side(bays, 21.0, Paint::Keyaki);
            let sum: f64 = side.iter().map(|b| b.1).sum();
            assert!((sum - 21.0).abs() < 1e-9);
            assert!(side.iter().eq(side.iter().rev()), "{bays}");
        }
    }
}
