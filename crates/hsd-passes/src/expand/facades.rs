//! Walls given facade by facade (003-12, 003-15): each storey becomes one walk whose lines are the rows of
//! the facades, scaled to their facades' widths.

use super::codes::{Mode, Which};
use super::edits::Strip;
use super::floors::{Bases, FloorAt};
use super::repeat::{Flat, Scoped};
use super::rows::bare_unit;
use super::split::fit;
use super::{Pass, bounds, positive};
use hsd_base::geometry::{SAME, SHAKU};
use hsd_base::rng::Place;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{self, Order, StoreyKind};
use hsd_ir::messages::parts as say;
use hsd_ir::program::{Content, Drawn, Loop, Storey, Unit, WallLine};

/// Default floor height in shaku: 3.5 m.
const HEIGHT: f64 = 11.55;

/// Metres per size unit by default (`docs/evidence.md` 8).
const SCALE: f64 = 0.1;

/// A turn beyond this many degrees was probably meant as the angle between the walls.
const STEEP: f64 = 150.0;

/// Levels of lists in the keys of random choices; the depth of repetitions is added to them.
const FLOORS: u64 = 0x100;
const FACADES: u64 = 0x200;

/// A facade without repetitions.
struct Wall<'d> {
    facade: &'d ast::Facade,
    id: String,
    floors: Flat<'d, ast::Floor>,
    /// Width in U if the author gave it.
    width: Option<f64>,
    place: Place,
    strips: Vec<Strip>,
}

/// A storey of a structure.
struct StructureStorey {
    span: Span,
    height: f64,
    kind: StoreyKind,
}

impl Pass<'_, '_> {
    /// Returns the storeys of a structure; one U is `unit` shaku.
    pub(super) fn structure(
        &mut self,
        structure: &ast::Structure,
        place: Place,
        unit: f64,
    ) -> Vec<Storey> {
        let flat = self.flatten(&structure.facades, FACADES);
        let mut walls = vec![];
        for (index, facade) in flat.ones.iter().enumerate() {
            walls.push(self.wall(structure, facade, index, place, unit));
            if self.stopped() {
                return vec![];
            }
        }
        let levels = self.levels(&walls);
        self.strips(&mut walls, &levels, unit);
        self.edit_walls(&flat.edits, &mut walls);
        if self.stopped() {
            return vec![];
        }
        for wall in &mut walls {
            settle_width(wall, structure.rightwards);
        }
        let storey = |(index, level): (usize, &StructureStorey)| Storey {
            span: level.span,
            height: level.height,
            kind: level.kind,
            order: Order::default(),
            loops: vec![ring(structure, &mut walls, index)],
            rooms: vec![],
            fixtures: vec![],
        };
        levels.iter().enumerate().map(storey).collect()
    }

    fn wall<'d>(
        &mut self,
        structure: &ast::Structure,
        facade: &'d ast::Facade,
        index: usize,
        place: Place,
        unit: f64,
    ) -> Wall<'d> {
        let id = facade.id.as_ref().map(|id| id.value.clone());
        let place = match &id {
            Some(id) => place.named(id),
            None => place.at(index as u64),
        };
        if let Some(angle) = facade.angle.as_ref().filter(|a| a.value.abs() > STEEP) {
            self.once(316, angle.span, || {
                say::steep_angle(angle.span, angle.value)
            });
        }
        let wall = Wall {
            facade,
            id: id.unwrap_or_else(|| (index + 1).to_string()),
            floors: self.flatten(&facade.floors, FLOORS),
            width: facade_width(structure, facade, unit),
            place,
            strips: vec![],
        };
        self.charge_frame(bounds::FACADE, facade.span);
        if wall.floors.ones.is_empty() && !self.stopped() {
            self.charge(1, facade.span);
            let span = self.head(facade.span);
            self.once(320, span, || say::facade_without_floors(span));
        }
        wall
    }

    /// Returns heights and kinds of the storeys. The facades of a storey must agree in height.
    fn levels(&mut self, walls: &[Wall<'_>]) -> Vec<StructureStorey> {
        let count = walls.iter().map(|w| w.floors.ones.len()).max();
        let mut levels = vec![];
        for index in 0..count.unwrap_or(0) {
            let floors = walls
                .iter()
                .filter_map(|w| w.floors.ones.get(index).copied());
            let mut level: Option<StructureStorey> = None;
            let mut known: Option<Spanned<f64>> = None;
            for floor in floors {
                let kind = floor.kind;
                let level = level.get_or_insert(StructureStorey {
                    span: floor.span,
                    height: HEIGHT,
                    kind,
                });
                if kind == StoreyKind::Storey {
                    level.kind = kind;
                }
                let given = floor.height.as_ref();
                if let Some(height) = given.and_then(positive) {
                    let span = given.map_or(floor.span, |h| h.span);
                    if let Some(other) = known.filter(|o| (o.value - height).abs() >= SAME) {
                        self.once(315, span, || {
                            say::floor_heights(span, height, other.span, other.value)
                        });
                    }
                    if known.is_none_or(|o| o.value < height) {
                        known = Some(Spanned::new(height, span));
                        level.height = height;
                    }
                }
            }
            levels.extend(level);
        }
        levels
    }

    fn strips(&mut self, walls: &mut [Wall<'_>], levels: &[StructureStorey], unit: f64) {
        let mut bases = Bases::default();
        for (index, wall) in walls.iter().enumerate() {
            for floor in &wall.floors.ones {
                bases.add(index, floor);
            }
        }
        for (facade, wall) in walls.iter_mut().enumerate() {
            let mut number = 0;
            for (index, floor) in wall.floors.ones.iter().enumerate() {
                if floor.kind == StoreyKind::Storey || index == 0 {
                    number += 1;
                }
                let at = FloorAt {
                    floor,
                    facade,
                    facade_id: &wall.id,
                    number,
                    place: wall.place.at(index as u64),
                    mode: Mode::Floor(levels[index].height / unit),
                };
                let strip = self.floor(&at, &bases);
                self.charge(u64::from(strip.units.is_empty()), floor.span);
                self.charge_frame(bounds::ROW, floor.span);
                wall.strips.push(strip);
                if self.stopped() {
                    return;
                }
            }
        }
    }

    fn edit_walls(&mut self, edits: &[Scoped<'_>], walls: &mut [Wall<'_>]) {
        for wall in walls.iter_mut() {
            for scoped in &wall.floors.edits {
                for strip in &mut wall.strips[scoped.from..scoped.to] {
                    self.edit(scoped.edit, scoped.key, strip);
                }
            }
        }
        for scoped in edits {
            for wall in &mut walls[scoped.from..scoped.to] {
                for strip in &mut wall.strips {
                    self.edit(scoped.edit, scoped.key, strip);
                }
            }
        }
    }
}

/// Scales the floors to their facade. If the author gave no width, the lowest floor that has one determines it for
/// floors whose parts have only the proportions of their images.
fn settle_width(wall: &mut Wall<'_>, rightwards: bool) {
    let lowest = wall.strips.iter().map(Strip::width).find(|w| *w > SAME);
    for strip in &mut wall.strips {
        let own = (!strip.natural && strip.width() > SAME).then(|| strip.width());
        if let Some(width) = wall.width.or(own).or(lowest) {
            fit(strip, width, wall.facade.span);
        }
        if rightwards {
            reverse(&mut strip.units);
        }
    }
    wall.width = wall.width.or(lowest);
}

fn reverse(units: &mut [Unit]) {
    units.reverse();
    for unit in units {
        if let Content::Split(split) = &mut unit.content {
            reverse(&mut split.upper);
            reverse(&mut split.lower);
        }
    }
}

/// Returns the walk of one storey. A facade that ends below it leaves its side open.
fn ring(structure: &ast::Structure, walls: &mut [Wall<'_>], storey: usize) -> Loop {
    let first = walls.first().map_or(0.0, |wall| turn(wall.facade, 0.0));
    let mut lines = vec![];
    if first != 0.0 {
        lines.push(WallLine {
            span: walls[0].facade.span,
            units: vec![],
            turn: first,
            reflection: false,
        });
    }
    let turns: Vec<f64> = walls.iter().skip(1).map(|w| turn(w.facade, 90.0)).collect();
    for (index, wall) in walls.iter_mut().enumerate() {
        let facade = wall.facade;
        let open = |width| bare_unit(facade.span, width, Which::Void);
        let (span, units) = match wall.strips.get_mut(storey) {
            Some(strip) => {
                let floor = wall.floors.ones[storey].span;
                (floor, std::mem::take(&mut strip.units))
            }
            None => (facade.span, wall.width.map(open).into_iter().collect()),
        };
        lines.push(WallLine {
            span,
            units,
            // The last turn is ignored, since the ring closes.
            turn: turns.get(index).copied().unwrap_or(0.0),
            reflection: facade.reflection,
        });
    }
    Loop {
        span: structure.span,
        hole: false,
        inner: false,
        drawn: Drawn::Facades,
        start: (0.0, 0.0),
        lines,
    }
}

fn turn(facade: &ast::Facade, default: f64) -> f64 {
    facade.angle.as_ref().map_or(default, |angle| angle.value)
}

/// Returns the width in U by size, ratio and scale, if one of the first two is given.
fn facade_width(structure: &ast::Structure, facade: &ast::Facade, unit: f64) -> Option<f64> {
    if structure.size.is_none() && facade.ratio.is_none() {
        return None;
    }
    let factor = |value: &Option<Spanned<f64>>, default| {
        value.as_ref().and_then(positive).unwrap_or(default)
    };
    let size = factor(&structure.size, 1.0) * factor(&facade.ratio, 1.0);
    Some(size * factor(&structure.scale, SCALE) / (unit * SHAKU))
}
