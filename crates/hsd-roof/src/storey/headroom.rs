//! The space that the eaves of a storey leave to the roofs below: roofs that would pierce them get a gentler pitch.

use crate::frame::{Rect, metres};
use crate::plan::level::Level;
use crate::region::{Region, Ridge, Side};
use crate::shape::look::Look;
use crate::storey::placed_line::{PlacedLine, covers};
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::plan::slabs;
use hsd_ir::ast::{RoofMode, RoofShape};
use hsd_ir::building::House;

/// Clearance between two roofs, metres.
const AIR: f64 = 0.05;
/// The least pitch a roof is reduced to, rise per metre.
const GENTLEST: f64 = 0.05;
/// Overhang of wall tops without eaves, metres.
const BARE: f64 = 0.1;

/// Areas of a storey with the greatest height its roofs may reach.
#[derive(Clone, Debug, Default)]
pub(crate) struct Headroom {
    /// The areas and heights, in the house frame, metres.
    under: Vec<(Rect, f64)>,
}

impl Headroom {
    /// Returns the headroom above level `k`; `lines` are the written roofs by level.
    pub(crate) fn of(
        house: &House,
        levels: &[Level<'_>],
        k: usize,
        lines: &[Vec<&PlacedLine<'_>>],
    ) -> Headroom {
        let mut room = Headroom::default();
        // A storey that the next one repeats has no eaves.
        let open = |j: &usize| match levels.get(j + 1) {
            Some(next) => levels[*j].plan != next.plan,
            None => true,
        };
        // Nor does it need a roof itself.
        let above = || (k + 1..levels.len()).find(open);
        let Some(j) = open(&k).then(above).flatten() else {
            return room;
        };
        let (level, lines) = (&levels[j], &lines[j]);
        if level.is_open() || !level.orthogonal {
            return room;
        }
        let cells = slabs::strips(&level.plan);
        let style = &house.roofs.style;
        for line in lines.iter().filter(|l| l.covers()) {
            let (span, own) = (line.cell.width().min(line.cell.depth()), &line.line.style);
            let span = metres(span, house.unit);
            let look = Look::gable(Some(own), style, span, house.unit);
            room.add(&[line.cell], house.unit, look, line.base, None);
        }
        let all = bounds(&cells);
        if covers(lines, &all) {
            return room;
        }
        let flat = style.shape.is_some_and(|s| s.value == RoofShape::Flat) || level.parapet;
        let span = metres(all.width().min(all.depth()), house.unit);
        let mut look = Look::gable(None, style, span, house.unit);
        if flat || house.roofs.mode == RoofMode::Explicit {
            (look.eaves, look.pitch) = (BARE, 0.0);
        }
        let usual = style.shape.is_none_or(|s| s.value == RoofShape::Gable);
        let ridge = match (&cells[..], house.street) {
            ([_], true) if usual => Some(Ridge::A),
            ([cell], false) if usual => Region::main(*cell).ridge,
            _ => None,
        };
        room.add(&cells, house.unit, look, level.storey.z1, ridge);
        room
    }

    /// Adds the space under a roof over some cells on a plate; with a known ridge it has eaves along it only.
    fn add(&mut self, cells: &[Cell], unit: f64, look: Look, plate: f64, ridge: Option<Ridge>) {
        let eaves = plate - look.pitch * look.eaves - AIR;
        for cell in cells {
            let rect = Rect::of(cell, unit);
            let wide = |x: f64, y: f64| Rect {
                min: rect.min - glam::dvec2(x, y),
                max: rect.max + glam::dvec2(x, y),
            };
            match ridge {
                None => self.under.push((rect.grown(look.eaves), eaves)),
                Some(Ridge::A) => {
                    self.under.push((wide(0.0, look.eaves), eaves));
                    self.under.push((wide(look.verge, 0.0), plate - AIR));
                }
                Some(Ridge::B) => {
                    self.under.push((wide(look.eaves, 0.0), eaves));
                    self.under.push((wide(0.0, look.verge), plate - AIR));
                }
            }
        }
    }

    /// Returns the look of a roof over a rectangle on a plate, gentler if it would not fit below.
    pub(crate) fn fit(&self, rect: &Rect, region: &Region, base: f64, mut look: Look) -> Look {
        for (above, height) in self.under.iter().filter(|u| u.0.overlaps(rect)) {
            let (run, ridge) = run(rect, above, region);
            let cap = if ridge {
                look.trim().ridge_height(look.kind)
            } else {
                0.0
            };
            look.pitch = gentler(&look, run, height - base - cap);
        }
        look
    }

    /// Returns the lowest limit over a rectangle, metres; `None` if there is no limit.
    pub(crate) fn lowest(&self, rect: &Rect) -> Option<f64> {
        let over = self.under.iter().filter(|u| u.0.overlaps(rect));
        over.map(|u| u.1).reduce(f64::min)
    }
}

/// Returns the pitch of a look, gentler if its upper surface would rise by more than `room` over a run, metres.
pub(crate) fn gentler(look: &Look, run: f64, room: f64) -> f64 {
    let room = room - look.drop();
    match run > 0.0 && look.pitch * run > room {
        true => (room / run).max(GENTLEST).min(look.pitch),
        false => look.pitch,
    }
}

/// Returns the run in metres from a roof's low wall to its highest point under `above`, and true if that is the ridge.
fn run(rect: &Rect, above: &Rect, region: &Region) -> (f64, bool) {
    let (lo, hi) = (rect.min.max(above.min), rect.max.min(above.max));
    match (region.ridge, region.fall) {
        (None, Some(Side::Front)) => (hi.y - rect.min.y, false),
        (None, Some(Side::Back)) => (rect.max.y - lo.y, false),
        (None, Some(Side::Left)) => (hi.x - rect.min.x, false),
        (None, Some(Side::Right)) => (rect.max.x - lo.x, false),
        (ridge, _) => {
            let axis = usize::from(ridge != Some(Ridge::B));
            let size = rect.max[axis] - rect.min[axis];
            let (from, to) = (lo[axis] - rect.min[axis], hi[axis] - rect.min[axis]);
            let half = size / 2.0;
            match from <= half && half <= to {
                true => (half, true),
                false => (from.min(size - from).max(to.min(size - to)), false),
            }
        }
    }
}

fn bounds(cells: &[Cell]) -> Cell {
    let none = Cell {
        a0: i64::MAX,
        b0: i64::MAX,
        a1: i64::MIN,
        b1: i64::MIN,
    };
    cells.iter().fold(none, |all, c| Cell {
        a0: all.a0.min(c.a0),
        b0: all.b0.min(c.b0),
        a1: all.a1.max(c.a1),
        b1: all.b1.max(c.b1),
    })
}
