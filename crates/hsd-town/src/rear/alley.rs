//! The rear of a lot that is let, as in Edo (000-63, docs/evidence.md 4.6): rows of dwellings of 9 shaku by 2 ken along an
//! alley 3 to 4 shaku wide, on one side of it or both; a yard behind the house to the street with well and privies; a gate
//! where the alley leaves the street.

use super::ground::{Eaves, Facing, Ground, Local};
use super::{Found, KEN, Planned};
use crate::plot::tenths;
use hsd_base::geometry::SHAKU;
use hsd_base::rng::Place;
use hsd_base::text;
use hsd_ir::ast::Value;

/// The alley, metres: 3 to 4 shaku.
const NARROW: f64 = 3.0 * SHAKU;
const WIDE: f64 = 4.0 * SHAKU;
/// A dwelling, metres: 9 shaku by 2 ken.
const DWELLING: f64 = 9.0 * SHAKU;
const DEEP: f64 = 2.0 * KEN;
/// A row has at least 2 dwellings, the least of its type, and 6 where there is room.
const LEAST: usize = 2;
const MOST: usize = 6;
/// The yard behind the house: a way of 3 shaku, well and privies.
const YARD: f64 = 2.0 * KEN;
/// The way between rows that stand behind each other.
const BETWEEN: f64 = 3.0 * SHAKU;
/// The roof of a row: eaves of 1 shaku, gables of half a shaku.
const ROW: Eaves = Eaves {
    along: SHAKU,
    across: 0.5 * SHAKU,
};
/// Well and privies: their sizes in metres, and their roofs.
const WELL: f64 = 4.5 * SHAKU;
const STALL: f64 = 3.0 * SHAKU;
const SMALL: Eaves = Eaves {
    along: 0.8 * SHAKU,
    across: 0.4 * SHAKU,
};
/// So many dwellings share a privy; an estimate.
const SHARE: usize = 4;
/// How far a gate stands behind the front, its depth, metres, and its roof.
const GATE: [f64; 2] = [0.2, 0.35];
const GATE_ROOF: Eaves = Eaves {
    along: 0.2,
    across: 0.05,
};
/// The widest gate, metres.
const GATE_MOST: f64 = 1.9;

/// Where a row may stand.
struct Slot {
    walls: Local,
    facing: Facing,
    dwellings: usize,
}

/// Puts rows of dwellings along an alley: the given share of those that have room.
pub(super) fn rows(ground: &mut Ground<'_>, density: f64, draws: Place, found: &mut Found) {
    let passage = passage(ground);
    let right = match passage {
        Some((right, _)) => right,
        None => draws.named("side").share() < 0.5,
    };
    let slots = slots(ground, right);
    let room: usize = slots.iter().map(|slot| slot.dwellings).sum();
    let mut left = (density * room as f64).round() as usize;
    left = left.max(LEAST.min(room));
    let mut built = 0;
    for slot in &slots {
        let mut count = slot.dwellings.min(left);
        // A single dwelling is no row: the one before gives it a second.
        if left - count == 1 && count > LEAST {
            count -= 1;
        }
        if count < LEAST {
            continue;
        }
        if row(ground, slot, count, found) {
            left -= count;
            built += count;
        } else {
            let why = text!([count]
                "a row of {count} dwellings would leave the lot or meet another house",
                "{count} 戸の長屋は敷地からはみ出すか、ほかの建物に重なります"
            );
            found.refuse("row", why);
        }
    }
    if built == 0 {
        let depth = tenths(ground.depth - ground.houses.t[1]);
        let why = text!([depth]
            "no row of dwellings fits along an alley in the {depth} m behind the house",
            "家の裏の {depth} m には、路地に沿う長屋が収まりません"
        );
        // Rows that were tried have told their own reasons.
        if found.refused.is_empty() {
            found.refuse("row", why);
        }
        return;
    }
    gate(ground, passage, found);
    yard(ground, built, right, found);
}

/// Returns on which side of the houses an alley passes, and from where to where.
fn passage(ground: &Ground<'_>) -> Option<(bool, [f64; 2])> {
    let [left, right] = ground.room([GATE[0], ground.houses.t[1]])?;
    let [from, to] = ground.houses.s;
    let sides = [(false, [left, from]), (true, [to, right])];
    let width = |side: &(bool, [f64; 2])| side.1[1] - side.1[0];
    let widest = sides
        .into_iter()
        .max_by(|a, b| width(a).total_cmp(&width(b)));
    widest.filter(|side| width(side) >= NARROW - 1e-6)
}

/// Finds where rows may stand, from the street to the back, and keeps the alley between them clear.
fn slots(ground: &mut Ground<'_>, right: bool) -> Vec<Slot> {
    let behind = ground.houses.t[1];
    let mut all: Vec<Slot> = vec![];
    let mut from = behind + YARD + ROW.across;
    let last = ground.depth - ROW.across;
    while last - from >= LEAST as f64 * DWELLING {
        let fitting = (((last - from) / DWELLING + 1e-9) as usize).min(MOST);
        let found = (LEAST..=fitting).rev().find_map(|count| {
            let to = from + count as f64 * DWELLING;
            let room = ground.room([from - ROW.across, to + ROW.across])?;
            let (alley, rows) = across(room, right)?;
            Some((count, to, alley, rows))
        });
        let Some((count, to, alley, rows)) = found else {
            from += BETWEEN;
            continue;
        };
        // It goes through the yard; between rows the whole width is free.
        let start = if all.is_empty() { behind } else { from };
        ground.keep_clear(Local {
            s: alley,
            t: [start, to],
        });
        all.extend(rows.into_iter().map(|(s, facing)| Slot {
            walls: Local { s, t: [from, to] },
            facing,
            dwellings: count,
        }));
        from = to + BETWEEN + 2.0 * ROW.across;
    }
    // The way behind the house leads from the passage to the alley.
    if let Some(s) = ground.room([behind, behind + NARROW]) {
        ground.keep_clear(Local {
            s,
            t: [behind, behind + NARROW],
        });
    }
    all
}

/// The rows across a lot: from left to right, with the side that they face.
type Across = ([f64; 2], Vec<([f64; 2], Facing)>);

/// Divides the width of a lot: two rows with the alley between them, or one row with the alley at one edge.
fn across([left, right]: [f64; 2], alley_right: bool) -> Option<Across> {
    let width = right - left;
    let for_alley = |rows: usize| {
        let alley = width - rows as f64 * (DEEP + ROW.along);
        (alley >= NARROW - 1e-6).then_some(alley.min(WIDE))
    };
    if let Some(alley) = for_alley(2) {
        let from = left.midpoint(right) - alley / 2.0;
        let to = from + alley;
        let rows = vec![
            ([from - DEEP, from], Facing::Right),
            ([to, to + DEEP], Facing::Left),
        ];
        return Some(([from, to], rows));
    }
    let alley = for_alley(1)?;
    Some(match alley_right {
        false => {
            let to = left + alley;
            ([left, to], vec![([to, to + DEEP], Facing::Left)])
        }
        true => {
            let from = right - alley;
            ([from, right], vec![([from - DEEP, from], Facing::Right)])
        }
    })
}

/// Builds a row in its slot, from the street on; false if something stands there.
fn row(ground: &mut Ground<'_>, slot: &Slot, count: usize, found: &mut Found) -> bool {
    let [from, _] = slot.walls.t;
    let walls = Local {
        t: [from, from + count as f64 * DWELLING],
        ..slot.walls
    };
    let Some(rectangle) = ground.take(walls, slot.facing, ROW) else {
        return false;
    };
    let number = |n: usize| Value::Number(n as f64);
    found.planned.push(Planned {
        unit: "row".to_owned(),
        kind: "ura-nagaya",
        parameters: vec![
            ("dwellings", number(count)),
            ("width", number(3)),
            ("depth", number(4)),
            ("munewari", Value::Truth(false)),
            ("overhang", number(1)),
        ],
        rectangle,
    });
    true
}

fn gate(ground: &mut Ground<'_>, passage: Option<(bool, [f64; 2])>, found: &mut Found) {
    let Some((right, [from, to])) = passage else {
        let why = text!(
            "the house leaves no way of 3 shaku (0.91 m) beside it, and the alley runs through it: `gap` and `gap_at` leave one",
            "家の脇に 3 尺（0.91 m）の通路がなく、路地は家の中を通ります。`gap` と `gap_at` で空けられます"
        );
        return found.refuse("gate", why);
    };
    // It stands beside the house.
    let roof = GATE_ROOF.across;
    let width = ((to - from - 2.0 * roof).min(GATE_MOST) * 10.0).floor() / 10.0;
    let s = match right {
        true => [from + roof, from + roof + width],
        false => [to - roof - width, to - roof],
    };
    let walls = Local { s, t: GATE };
    let Some(rectangle) = ground.take(walls, Facing::Street, GATE_ROOF) else {
        let why = text!(
            "something stands in the way beside the house",
            "家の脇の通路に何かが立っています"
        );
        return found.refuse("gate", why);
    };
    found.planned.push(Planned {
        unit: "gate".to_owned(),
        kind: "roji",
        parameters: vec![
            ("what", Value::Text("gate".to_owned())),
            ("width", Value::Number(width)),
        ],
        rectangle,
    });
}

/// Puts well and privies into the yard behind the house.
fn yard(ground: &mut Ground<'_>, dwellings: usize, right: bool, found: &mut Found) {
    let behind = ground.houses.t[1];
    let range = [behind + NARROW, behind + YARD];
    let stalls = dwellings.div_ceil(SHARE).min(6);
    let small = [
        ("well", [WELL, WELL], vec![]),
        (
            "privy",
            [stalls as f64 * STALL, STALL],
            vec![("stalls", Value::Number(stalls as f64))],
        ),
    ];
    for (unit, size, more) in small {
        let Some(rectangle) = ground.place(size, range, SMALL, !right) else {
            let why = text!(
                "it has no room in the yard behind the house",
                "家の裏の空地に収まりません"
            );
            found.refuse(unit, why);
            continue;
        };
        let what = ("what", Value::Text(unit.to_owned()));
        found.planned.push(Planned {
            unit: unit.to_owned(),
            kind: "roji",
            parameters: std::iter::once(what).chain(more).collect(),
            rectangle,
        });
    }
}
