//! The rear of a lot whose owner keeps it, by the depth of the lot (docs/evidence.md 4.7): under 12 m a court; to 20 m a court
//! with a privy at its end; to 30 m a storehouse or a dwelling (離れ hanare) at the back line; deeper lots have both, with
//! gardens between.

use super::ground::{Eaves, Ground};
use super::{COURT, Found, KEN, Planned, shallow};
use crate::plot::tenths;
use hsd_base::geometry::SHAKU;
use hsd_base::rng::Place;
use hsd_base::text;
use hsd_ir::ast::Value;

/// The depths of lots at which more stands behind the house, metres.
const DEPTHS: [f64; 3] = [12.0, 20.0, 30.0];
/// One unit of the library, metres.
const UNIT: f64 = 3.0 * SHAKU;
/// The roofs of the types: storehouse, dwelling, privy.
const KURA: Eaves = Eaves {
    along: 1.0 * SHAKU,
    across: 1.0 * SHAKU,
};
const HANARE: Eaves = Eaves {
    along: 2.5 * SHAKU,
    across: 1.625 * SHAKU,
};
const PRIVY: Eaves = Eaves {
    along: 0.8 * SHAKU,
    across: 0.4 * SHAKU,
};
/// The sizes of a storehouse in units, from 2.5 by 4 ken to 2 by 2 ken.
const KURA_SIZES: [[f64; 2]; 5] = [[5.0, 8.0], [5.0, 6.0], [4.0, 6.0], [4.0, 5.0], [4.0, 4.0]];
/// The sizes of a dwelling, metres: 2.5 by 2 ken, and what a narrow lot takes.
const HANARE_SIZES: [[f64; 2]; 4] = [[4.9, 4.0], [4.5, 4.0], [3.9, 4.0], [2.9, 4.0]];

/// Puts what an owner has behind his house.
pub(super) fn court(ground: &mut Ground<'_>, draws: Place, found: &mut Found) {
    let depth = ground.depth;
    if depth < DEPTHS[0] {
        return found.refuse("rear", shallow(depth));
    }
    let right = draws.named("side").share() < 0.5;
    let first = ground.houses.t[1] + COURT;
    let range = [first, depth];
    let planned = if depth < DEPTHS[1] {
        vec![privy(ground, [ground.houses.t[1] + KEN, depth], right)]
    } else if depth < DEPTHS[2] {
        let kura_first = draws.named("kind").share() < 0.5;
        let one = match kura_first {
            true => kura(ground, range, draws, right).or_else(|| hanare(ground, range, right)),
            false => hanare(ground, range, right).or_else(|| kura(ground, range, draws, right)),
        };
        vec![one]
    } else {
        let kura = kura(ground, range, draws, right);
        // A garden lies between both.
        let taken = kura
            .as_ref()
            .map_or(0.0, |kura| kura.rectangle.depth + COURT);
        let hanare = hanare(ground, [first, depth - taken], !right);
        vec![kura, hanare]
    };
    found.planned.extend(planned.into_iter().flatten());
    if found.planned.is_empty() {
        let left = tenths(depth - ground.houses.t[1]);
        let why = text!([left]
            "nothing fits into the {left} m behind the house: a court stays open",
            "家の裏の {left} m に収まるものがなく、庭だけになります"
        );
        found.refuse("rear", why);
    }
}

fn kura(ground: &mut Ground<'_>, range: [f64; 2], draws: Place, right: bool) -> Option<Planned> {
    // The size that was drawn, or the next one that fits.
    let first = (draws.named("size").share() * (KURA_SIZES.len() - 1) as f64) as usize;
    KURA_SIZES[first..].iter().find_map(|[width, depth]| {
        let size = [width * UNIT, depth * UNIT];
        let rectangle = ground.place(size, range, KURA, right)?;
        let number = |n: &f64| Value::Number(*n);
        Some(Planned {
            unit: "kura".to_owned(),
            kind: "kura",
            parameters: vec![("width", number(width)), ("depth", number(depth))],
            rectangle,
        })
    })
}

fn hanare(ground: &mut Ground<'_>, range: [f64; 2], right: bool) -> Option<Planned> {
    HANARE_SIZES.iter().find_map(|size| {
        let rectangle = ground.place(*size, range, HANARE, right)?;
        Some(Planned {
            unit: "hanare".to_owned(),
            kind: "hiraya",
            parameters: vec![
                ("frontage", Value::Number(size[0])),
                ("depth", Value::Number(size[1])),
                ("front", Value::Text("dwelling".to_owned())),
                ("door", Value::Text("koshido".to_owned())),
            ],
            rectangle,
        })
    })
}

fn privy(ground: &mut Ground<'_>, range: [f64; 2], right: bool) -> Option<Planned> {
    let size = [2.0 * UNIT, UNIT];
    let rectangle = ground.place(size, range, PRIVY, right)?;
    Some(Planned {
        unit: "privy".to_owned(),
        kind: "roji",
        parameters: vec![
            ("what", Value::Text("privy".to_owned())),
            ("stalls", Value::Number(2.0)),
        ],
        rectangle,
    })
}
