//! `<Gate>`: a gate house of one or two storeys. The ground storey is open, with doors in the middle row of columns; a
//! veranda runs round the upper storey. Defaults after Suzakumon (`docs/evidence.md` 4.8, S30): bays of 17 shaku, eaves
//! of 12, set back a little upstairs; heights as shares of the bay.

use super::draft::{Draft, DraftStorey, OPEN, Usual, WALL, bays, joinery};
use super::{Pass, count, or};
use crate::messages::fittings::Scarce;
use hsd_ir::ast::{self, FinialKind, Order, Paint, Rail, RoofKind, RoofShape, RoofStyle, Side};

/// Shares of a bay: height of columns, diameter of one, height of brackets, setback of upper walls, height of upper
/// columns.
const COLUMNS: f64 = 1.03;
const POST: f64 = 0.135;
const BRACKETS: f64 = 0.40;
const INSET: f64 = 0.16;
const UPPER: f64 = 0.68;
/// Overhang as a share of a bay, and the purlin's position in it.
const EAVES: f64 = 0.706;
const REACH: f64 = 0.36;
/// The main roof is steeper than the lower roof by this many sun.
const STEEPER: f64 = 1.2;
/// The minimum height of columns, shaku.
const LEAST: f64 = 2.0;

impl Pass<'_, '_> {
    pub(super) fn gate(&mut self, it: &ast::Gate, draft: &mut Draft<'_>) {
        let m = &it.measures;
        let [nx, ny] = it.bays.map_or([5, 2], |b| b.value.map(|n| n as u32));
        let [bx, by] = it.bay.map_or([17.0; 2], |b| b.value);
        let paint = m.paint.map_or(Paint::Vermilion, |p| p.value);
        let steps = count(m.steps, 3);
        let doors = count(it.doors, nx.saturating_sub(2).max(1)).min(nx);
        let two = count(it.storeys, 2) == 2;
        let size = [f64::from(nx) * bx, f64::from(ny) * by];
        let columns = self.at_least(it.span, Scarce::Ground, or(m.columns, COLUMNS * bx), LEAST);
        let eaves = or(m.eaves, EAVES * bx);
        let zone = BRACKETS * bx * (0.25 + 0.25 * f64::from(steps.min(3)));
        let post = or(m.post, POST * bx);
        draft.look(m, &usual(bx), paint);
        let order = |draft: &Draft<'_>| Order {
            posts: draft.posts(post, paint, 3),
            veranda: None,
            brackets: draft.brackets(steps, zone, REACH * eaves),
        };
        // Doors hang in the middle row, or in front if there is none.
        let row = if ny > 1 { ny / 2 } else { 0 };
        let leaves = bays(nx, bx, WALL, (joinery(paint).0, doors));
        let open = bays(nx, bx, OPEN, (OPEN, 0));
        let front = if row == 0 { &leaves } else { &open };
        let side = bays(ny, by, WALL, (WALL, 0));
        draft.storey(&DraftStorey {
            walls: [front, &side, &open, &side],
            height: columns + zone,
            base: 0.0,
            order: order(draft),
        });
        if two {
            // A hipped lower roof, which the upper walls cut.
            draft.roof(RoofStyle {
                shape: draft.say(RoofShape::Hip),
                ..RoofStyle::default()
            });
        }
        if row > 0 {
            draft.inner(f64::from(row) * by, &leaves);
        }
        if two {
            let most = size[0].min(size[1]) / 2.0 - 1.0;
            let up = Upper {
                size,
                bays: [nx, ny],
                inset: or(it.inset, INSET * bx).clamp(0.05, most.max(0.05)),
                doors,
                joinery: joinery(paint),
                order: order(draft),
            };
            self.upper(it, draft, up);
        }
        let margin = or(m.eaves, EAVES * bx);
        let stairs = (vec![Side::Front, Side::Back], bx * f64::from(doors.max(1)));
        draft.platform(m, 0.29 * bx, margin, stairs);
        if m.shape.is_none_or(|s| s.value != RoofShape::Pyramid) {
            draft.finial(FinialKind::Shibi, None, None);
        }
    }

    /// Adds the upper storey, and its roof of steeper pitch.
    fn upper(&mut self, it: &ast::Gate, draft: &mut Draft<'_>, up: Upper) {
        let m = &it.measures;
        let pitch = or(m.pitch, 5.0);
        let [nx, ny] = up.bays;
        let size = up.size.map(|s| s - 2.0 * up.inset);
        let hidden = pitch / 10.0 * up.inset + or(m.thickness, 0.7) * 1.15 + 0.5;
        let bay = up.size[0] / f64::from(nx);
        let base = hidden + bay * 0.16;
        let zone = up.order.brackets.as_ref().map_or(0.0, |b| b.zone());
        let wish = or(it.upper, UPPER * bay);
        let columns = self.at_least(it.span, Scarce::Upper, wish, LEAST);
        let (bx, by) = (size[0] / f64::from(nx), size[1] / f64::from(ny));
        let (door, window) = up.joinery;
        let front = bays(nx, bx, window, (door, up.doors));
        let side = bays(ny, by, window, (window, 0));
        let order = Order {
            veranda: draft.veranda(bay * 0.19, base, Rail::Crossed, vec![]),
            ..up.order
        };
        let height = base + columns + zone;
        draft.storey(&DraftStorey {
            walls: [&front, &side, &front, &side],
            height,
            base,
            order,
        });
        draft.roof(RoofStyle {
            shape: draft.style.shape,
            pitch: draft.say(pitch + STEEPER),
            ..RoofStyle::default()
        });
    }
}

/// The values the upper storey takes over from the lower one.
struct Upper {
    size: [f64; 2],
    bays: [u32; 2],
    inset: f64,
    doors: u32,
    /// Doors and windows.
    joinery: (&'static str, &'static str),
    order: Order,
}

fn usual(bay: f64) -> Usual {
    Usual {
        kind: RoofKind::CoverTiles,
        shape: RoofShape::HipAndGable,
        pitch: 5.0,
        eaves: EAVES * bay,
        verge: 2.0,
        thickness: 0.7,
        noshi: 9,
        sori: 4.0,
        gable: 0.2,
        plain: true,
    }
}
