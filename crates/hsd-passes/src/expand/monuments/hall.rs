//! `<Hall>` and `<Shrine>`: one model (000-79, 000-80); slope, thickness and covering of the roof, paint and floor make
//! it a temple hall or a shrine. With an aisle, the core has a roof of its own above that of the aisle.

use super::draft::{Bay, Draft, DraftStorey, OPEN, Usual, WALL, bays, joinery};
use super::{Pass, count, or};
use crate::messages::fittings::Scarce;
use hsd_ir::ast::{self, FinialKind, Order, Paint, Rail, RoofKind, RoofShape, RoofStyle, Side};

/// The minimum height of columns, shaku.
const LEAST: f64 = 2.0;

/// Halls of as many bays each way have columns inside.
const BROAD: u32 = 4;

/// Defaults of a hall or a shrine; lengths in shaku, shares of a bay.
struct Kind {
    bays: [u32; 2],
    bay: f64,
    columns: f64,
    post: f64,
    paint: Paint,
    steps: u32,
    veranda: f64,
    floor: f64,
    platform: f64,
    usual: Usual,
}

fn kind(shrine: bool, bay: f64) -> Kind {
    match shrine {
        false => Kind {
            bays: [5, 5],
            bay: 10.0,
            columns: 1.25,
            post: 0.12,
            paint: Paint::Keyaki,
            steps: 1,
            veranda: 0.55,
            floor: 3.0,
            platform: 1.5,
            usual: Usual {
                kind: RoofKind::CoverTiles,
                shape: RoofShape::Temple,
                pitch: 6.0,
                eaves: 0.85 * bay,
                verge: 2.0,
                thickness: 0.7,
                noshi: 7,
                sori: 5.0,
                gable: 0.25,
                plain: false,
            },
        },
        true => Kind {
            bays: [3, 2],
            bay: 7.0,
            columns: 1.4,
            post: 0.11,
            paint: Paint::Hinoki,
            steps: 0,
            veranda: 0.6,
            floor: 3.5,
            platform: 1.0,
            usual: Usual {
                kind: RoofKind::Bark,
                shape: RoofShape::Gable,
                pitch: 7.5,
                eaves: 0.85 * bay,
                verge: 0.6 * bay,
                thickness: 1.2,
                noshi: 1,
                sori: 6.0,
                gable: 0.25,
                plain: true,
            },
        },
    }
}

impl Pass<'_, '_> {
    pub(super) fn hall(&mut self, it: &ast::Hall, draft: &mut Draft<'_>) {
        let m = &it.measures;
        let [bx, by] = it.bay.map_or([kind(it.shrine, 1.0).bay; 2], |b| b.value);
        let kind = kind(it.shrine, bx);
        let [nx, ny] = it.bays.map_or(kind.bays, |b| b.value.map(|n| n as u32));
        let paint = m.paint.map_or(kind.paint, |p| p.value);
        let steps = count(m.steps, kind.steps);
        // As many doors as there are bays in the middle of the front.
        let half = nx.div_ceil(2);
        let doors = count(it.doors, half - (nx - half) % 2).min(nx);
        let columns = self.at_least(
            it.span,
            Scarce::Ground,
            or(m.columns, kind.columns * bx),
            LEAST,
        );
        let zone = bx * (0.16 + 0.11 * f64::from(steps));
        let eaves = or(m.eaves, kind.usual.eaves);
        let (veranda, floor) = (or(it.veranda, kind.veranda * bx), or(it.floor, kind.floor));
        let floor = if veranda > 0.0 { floor } else { 0.0 };
        let post = or(m.post, kind.post * bx);
        let brackets = draft.brackets(steps, zone, 0.3 * eaves);
        let order = Order {
            posts: draft.posts(post, paint, 3),
            veranda: draft.veranda(veranda, floor, Rail::Knobbed, vec![Side::Front]),
            brackets,
        };
        let codes = Codes::of(it.shrine, paint);
        let front = bays(nx, bx, codes.window, (codes.door, doors));
        let back = bays(nx, bx, codes.wall, (codes.door, nx % 2));
        let mut side: Vec<Bay> = bays(ny, by, codes.wall, (codes.wall, 0));
        // A window beside the front on either side.
        let mut other = side.clone();
        if ny > 1 {
            side[0].0 = codes.window;
            other[ny as usize - 1].0 = codes.window;
        }
        draft.storey(&DraftStorey {
            walls: [&front, &side, &back, &other],
            height: columns + zone,
            base: 0.0,
            order: order.clone(),
        });
        let margin = veranda + (0.3 * bx).max(2.0);
        draft.platform(m, kind.platform, margin, (vec![Side::Front], bx));
        draft.look(m, &kind.usual, paint);
        self.core(it, draft, &codes, ([nx, ny], [bx, by]), order);
        self.crown(it, draft);
    }

    /// Adds the columns of the core (身舎 moya), and above the roof of an aisle its walls.
    fn core(
        &mut self,
        it: &ast::Hall,
        draft: &mut Draft<'_>,
        codes: &Codes,
        (count, bay): ([u32; 2], [f64; 2]),
        order: Order,
    ) {
        let size = [0, 1].map(|k| f64::from(count[k]) * bay[k]);
        let open = |n: u32, width: f64| bays(n, width, OPEN, (OPEN, 0));
        let most = size[0].min(size[1]) / 2.0 - 1.0;
        let aisle = or(it.aisle, 0.0).min(most);
        if aisle < 0.05 {
            // One bay inside the walls, so that no ceiling spans a broad hall.
            if !it.shrine && count.iter().all(|n| *n >= BROAD) {
                let [front, side] = [0, 1].map(|k| open(count[k] - 2, bay[k]));
                draft.columns(bay, [&front, &side]);
            }
            return;
        }
        let m = &it.measures;
        draft.roof(RoofStyle {
            shape: draft.say(RoofShape::Hip),
            ..RoofStyle::default()
        });
        let size = size.map(|s| s - 2.0 * aisle);
        let pitch = draft.style.pitch.map_or(5.0, |p| p.value);
        let thick = draft.style.thickness.map_or(0.7, |t| t.value);
        let hidden = pitch / 10.0 * aisle + thick * 1.15 + 0.5;
        let zone = order.brackets.as_ref().map_or(0.0, |b| b.zone());
        let wish = or(it.upper, or(m.columns, 12.0) * 0.35);
        let clear = self.at_least(it.span, Scarce::Core, wish, 1.0);
        let [nx, ny] = size.map(|length| ((length / 9.0).round() as u32).clamp(1, 60));
        let wall =
            |n: u32, length: f64| bays(n, length / f64::from(n), codes.wall, (codes.wall, 0));
        let (front, side) = (wall(nx, size[0]), wall(ny, size[1]));
        let below =
            [(nx, size[0]), (ny, size[1])].map(|(n, length)| open(n, length / f64::from(n)));
        draft.columns([aisle; 2], [&below[0], &below[1]]);
        draft.storey(&DraftStorey {
            walls: [&front, &side, &front, &side],
            height: hidden + clear + zone,
            base: 0.0,
            order: Order {
                veranda: None,
                ..order
            },
        });
    }

    /// Adds the finial.
    fn crown(&mut self, it: &ast::Hall, draft: &mut Draft<'_>) {
        // Pyramidal roofs have a jewel by default.
        let pyramid = draft
            .style
            .shape
            .is_some_and(|s| s.value == RoofShape::Pyramid);
        let logs = count(it.katsuogi, if it.shrine { 5 } else { 0 });
        if logs > 0 && !pyramid {
            draft.finial(FinialKind::Chigi, None, Some(logs));
        }
    }
}

/// The parts of its walls.
struct Codes {
    wall: &'static str,
    door: &'static str,
    window: &'static str,
}

impl Codes {
    fn of(shrine: bool, paint: Paint) -> Codes {
        let (wall, door, window) = match (shrine, paint) {
            (_, Paint::Vermilion | Paint::Bengara) => {
                let (door, window) = joinery(paint);
                (WALL, door, window)
            }
            (true, _) => ("KOB", "TIH", "KOB"),
            (false, _) => (WALL, "TSK", "TST"),
        };
        Codes { wall, door, window }
    }
}
