//! Tie beams (nageshi) in front of the posts of a storey: at the foot, over the doors, under the sills.

use super::{metres, outward, rings};
use hsd_base::geometry::SHAKU;
use hsd_ir::ast::Posts;
use hsd_ir::building::fittings::Beam;
use hsd_ir::building::{House, Storey, Wall};
use hsd_ir::catalog::Catalog;
use hsd_ir::program::{Content, Unit};

/// Foot of each row as a share of the height of the posts; parts of monuments have their doors and windows between
/// them.
const ROWS: [f64; 5] = [0.0, LINTEL, 0.36, 0.9, 0.18];

/// The row over doors.
const LINTEL: f64 = 0.74;

/// Height of a beam, as a share of the post's side.
const HEIGHT: f64 = 0.62;

/// Returns the beams of all walls; they end at voids.
pub(super) fn beams(catalog: &Catalog, house: &House, storey: &Storey, posts: &Posts) -> Vec<Beam> {
    let height = storey.wall_height();
    let post = posts.size * SHAKU;
    let mut made = vec![];
    for wall in rings(storey).flat_map(|r| &r.walls) {
        for row in ROWS.iter().take(posts.nageshi as usize) {
            // Between foot and lintel no beam crosses a door.
            let crosses = |unit: &Unit| is_wall(catalog, unit, *row > 0.1 && *row < LINTEL);
            for stretch in runs(wall, crosses) {
                made.push(beam(house, wall, stretch, (post, storey.z0 + height * row)));
            }
        }
    }
    made
}

fn beam(house: &House, wall: &Wall, (from, to): (f64, f64), (post, foot): (f64, f64)) -> Beam {
    // From the wall to slightly beyond the posts.
    let width = post / 2.0 + 0.03;
    let beyond = |at: f64, end: f64| if (at - end).abs() < 1e-6 { width } else { 0.0 };
    let length = wall.from.distance(wall.to);
    let (from, to) = (
        from - beyond(from, 0.0) / house.unit,
        to + beyond(to, length) / house.unit,
    );
    let out = outward(wall) * (width / 2.0);
    // Those along the front lie a little higher, so that at corners no two faces share a plane; none at the
    // foot shares that of the wall.
    let lift = 0.012 * wall.direction.x.abs() - 0.006;
    let at = |u: f64| (metres(house, wall.from + wall.direction * u) + out).extend(foot + lift);
    Beam {
        ends: [at(from), at(to)],
        width,
        height: post * HEIGHT,
    }
}

/// Returns the runs of bays that beams cross, U from the right end.
fn runs(wall: &Wall, crosses: impl Fn(&Unit) -> bool) -> Vec<(f64, f64)> {
    let mut at = 0.0;
    let mut runs: Vec<(f64, f64)> = vec![];
    for unit in &wall.units {
        let next = at + unit.width;
        match runs.last_mut().filter(|r| (r.1 - at).abs() < 1e-9) {
            _ if unit.width <= 0.0 || !crosses(unit) => {}
            Some(run) => run.1 = next,
            None => runs.push((at, next)),
        }
        at = next;
    }
    runs
}

/// Returns true if a beam runs through a bay: not through a void, nor, if `doors` is set, through a door.
fn is_wall(catalog: &Catalog, unit: &Unit, doors: bool) -> bool {
    match &unit.content {
        Content::Void => false,
        Content::Part(id) => {
            let part = catalog.part(*id);
            let open = part.class() == 'A' && part.code() != "APW  ";
            !(open || doors && part.class() == 'T')
        }
        Content::Picture(_) => true,
        Content::Split(split) => split.upper.iter().all(|u| is_wall(catalog, u, doors)),
    }
}
