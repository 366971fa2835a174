//! The roofs of one house, storey by storey: the area that the storey above leaves uncovered is roofed at the top
//! (docs/evidence.md 3.8), roof lines first, automatic regions for the rest.

use super::partition::{Method, partition_broad, partition_within};
use crate::budget::SearchBudget;
use crate::frame::near_side;
use crate::join::assemble;
use crate::messages as say;
use crate::plan::level::{Level, first_line, is_facade, levels};
use crate::plan::necks::{self, Necks};
use crate::plan::roles::regions_by;
use crate::plan::{MOST_CORNERS, report, spans, street};
use crate::region::{Region, Ridge, Role};
use crate::shape::form::RoofDraft;
use crate::shape::look::Look;
use crate::storey::automatic::Automatic;
use crate::storey::explicit;
use crate::storey::forms::Context;
use crate::storey::headroom::Headroom;
use crate::storey::placed_line::PlacedLine;
use crate::storey::polygonal;
use crate::storey::polygonal::Polygonal;
use crate::storey::skirt::Skirt;
use crate::storey::street_pent::street_pent;
use crate::storey::written::Written;
use crate::storey::{overhang, standing, written};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::STEPS;
use hsd_base::geometry::plan::slabs;
use hsd_base::geometry::plan::{Cell, Plan};
use hsd_base::source::Span;
use hsd_ir::ast::{RoofMethod, RoofMode, RoofShape};
use hsd_ir::building::{House, HouseRoofs};
use std::cell::{OnceCell, RefCell};

/// Houses with more roof lines get no fix that removes them if they bound no area.
const MOST_TAKEN_OUT: usize = 16;

/// Roofs are not narrower where another division avoids it, metres.
const NARROW: f64 = 0.5;

/// Roofs a house, without a cache; for what is seen of it from afar if asked.
pub(super) fn roofs(house: &House, afar: bool, out: &mut Diagnostics) -> HouseRoofs {
    let budget = &SearchBudget::default();
    let levels = levels(house);
    let mut done = HouseRoofs::default();
    let lines = explicit::place(house, &levels, out);
    report_house(house, &levels, out);
    for pair in levels.windows(2) {
        overhang::close(house, &pair[0], &pair[1], &mut done.soffits, out);
    }
    let pent = street_pent(house, &levels);
    let top = levels.iter().map(|l| l.storey.z1).fold(f64::MIN, f64::max);
    let mut on_level: Vec<Vec<&PlacedLine<'_>>> = vec![vec![]; levels.len()];
    for line in &lines {
        on_level[line.level].push(line);
    }
    for (k, lines) in on_level.iter().enumerate() {
        let lines = lines.clone();
        let headroom = Headroom::of(house, &levels, k, &on_level);
        let pent = pent.filter(|_| k == 0);
        let afar = afar && lines.is_empty();
        Storey {
            house,
            levels: &levels,
            k,
            top,
            lines,
            pent,
            afar,
            budget,
            headroom,
        }
        .roof(&mut done, out);
    }
    done
}

/// Reports errors of a house as a whole.
fn report_house(house: &House, levels: &[Level<'_>], out: &mut Diagnostics) {
    let style = &house.roofs.style;
    let wish = house
        .roofs
        .wished
        .or_else(|| house.roofs.lines.first().map(|l| l.span));
    for level in levels {
        if let (Some(wish), true) = (wish, level.is_open())
            && let Some(ring) = level.storey.rings.iter().find(|r| !r.inner && is_facade(r))
        {
            let lines = &house.roofs.lines;
            let all = match house.roofs.wished {
                Some(wished) => vec![wished],
                None if lines.len() > MOST_TAKEN_OUT => vec![],
                None => lines.iter().map(|l| l.span).collect(),
            };
            out.push(say::open_facade(wish, ring.span, level.storey.number, all));
        }
    }
    if let Some(pitch) = style.pitch {
        let kind = style.kind.map_or(hsd_ir::ast::RoofKind::Tiles, |k| k.value);
        explicit::check_pitch(pitch, kind, out);
    }
}

/// The data for roofing one storey.
struct Storey<'a, 'h> {
    house: &'a House,
    levels: &'a [Level<'h>],
    k: usize,
    /// Top of the house's walls, metres.
    top: f64,
    lines: Vec<&'a PlacedLine<'a>>,
    /// The street pent roof.
    pent: Option<Cell>,
    /// True if only what is seen from afar is asked for.
    afar: bool,
    /// The budget for the best cuts.
    budget: &'a SearchBudget,
    headroom: Headroom,
}

impl Storey<'_, '_> {
    fn roof(mut self, done: &mut HouseRoofs, out: &mut Diagnostics) {
        let upper = self.levels.get(self.k + 1).filter(|u| !u.is_open());
        let plain = |l: &Level<'_>| l.orthogonal;
        let necks = self.necks(upper);
        let rest = necks.as_ref().map(|necks| Level {
            plan: necks.rest.clone(),
            orthogonal: true,
            ..self.levels[self.k].clone()
        });
        let level = rest.as_ref().unwrap_or(&self.levels[self.k]);
        let context = Context {
            unit: self.house.unit,
            style: &self.house.roofs.style,
            corridors: self.house.roofs.method != RoofMethod::Kd,
            level,
            above: upper.filter(|u| plain(u)),
            upper: upper.filter(|u| plain(u)).map(|u| &u.plan),
            roof_top: self.top,
            headroom: std::mem::take(&mut self.headroom),
            fire_walls: self.fire_walls(),
            outline: OnceCell::new(),
            upper_outline: OnceCell::new(),
        };
        let rectangular = plain(level) && upper.is_none_or(plain);
        let mut planned = match level.is_open() {
            true => vec![],
            false if rectangular && !self.wants_skeleton() => self.orthogonal(&context, done, out),
            false => {
                let of = Polygonal {
                    house: self.house,
                    context: &context,
                    upper,
                    lines: &self.lines,
                };
                of.roofs(done, out)
            }
        };
        let own = (self.lines.iter()).filter(|line| !line.shape.stands_on_another());
        planned.extend(own.map(|line| explicit::planned(line, &context, out)));
        planned.extend(self.pent.map(|cell| self.hang_pent(&context, cell)));
        if let Some(necks) = necks {
            let of = Polygonal {
                house: self.house,
                context: &context,
                upper,
                lines: &[],
            };
            planned.extend(of.wings(&necks, done, out));
        }
        let standing = standing::planned(&self.lines, &planned, &context, out);
        planned.extend(standing);
        let walls = upper.map_or(vec![], |u| polygonal::walls(self.house, u));
        if !assemble(planned, &walls, self.afar, &mut done.roofs) {
            let place = self
                .lines
                .first()
                .map_or(level.storey.span, |l| l.line.span);
            out.push(say::too_many_meet(place, level.storey.number));
        }
    }

    fn fire_walls(&self) -> Vec<Cell> {
        let walls = self.lines.iter();
        let walls = walls.filter(|line| line.shape == RoofShape::FireWall);
        walls.map(|line| line.cell).collect()
    }

    /// Returns the storey divided at the necks of its wings at odd angles; none if it has none, or if one roof over all of it
    /// is asked for.
    fn necks(&self, upper: Option<&Level<'_>>) -> Option<Necks> {
        let (level, roofs) = (&self.levels[self.k], &self.house.roofs);
        let whole = [RoofShape::Hip, RoofShape::Pyramid, RoofShape::Mansard];
        let asked = roofs.style.shape.is_some_and(|s| whole.contains(&s.value));
        let skeleton = roofs.method == RoofMethod::Skeleton || asked;
        let covered = upper.is_some() || self.lines.iter().any(|l| l.covers());
        if level.orthogonal || level.is_open() || skeleton || covered {
            return None;
        }
        let automatic = roofs.mode == RoofMode::Auto && !polygonal::is_flat(self.house, level);
        automatic.then(|| necks::divided(&level.plan)).flatten()
    }

    /// Returns true if the author requests one hipped roof over the whole plan rather than a flat one.
    fn wants_skeleton(&self) -> bool {
        let roofs = &self.house.roofs;
        let many = self.levels[self.k].plan.corners() > MOST_CORNERS;
        roofs.method == RoofMethod::Skeleton
            && !polygonal::is_flat(self.house, &self.levels[self.k])
            && !many
    }

    fn hang_pent(&self, context: &Context<'_>, cell: Cell) -> RoofDraft {
        let outward = explicit::away_from_wall(context, &cell);
        let depth = context.metres(outward.measure(&cell).1);
        let pitch = Look::lean_to(None, context.style, depth).pitch;
        context
            .pent(cell, outward, context.level.storey.z1 - pitch * depth, None)
            .0
    }

    fn orthogonal(
        &self,
        context: &Context<'_>,
        done: &mut HouseRoofs,
        out: &mut Diagnostics,
    ) -> Vec<RoofDraft> {
        let level = context.level;
        let mut found = Vec::new();
        let wanted = self.house.roofs.mode == RoofMode::Auto;
        if let Some(skirt) = self.skirt(context).filter(|_| wanted) {
            done.plans.push(report::skirt(level, skirt.strips()));
            return vec![skirt.planned(context, level.storey.z1, None, first_wall(level), out)];
        }
        let open = self.open(context).filter(|_| wanted);
        if wanted && open.is_none() {
            out.push(say::too_intricate(level.storey.span, level.storey.number));
        }
        let open = open.unwrap_or_default();
        let trunks = written::trunks(&self.lines, context);
        let corners = open.corners();
        let many = corners > MOST_CORNERS;
        if many {
            let (span, number) = (first_wall(level), level.storey.number);
            out.push(say::too_many_corners(span, number, corners, MOST_CORNERS));
            found = strips(&open);
        } else if !open.loops.is_empty() {
            found = self.regions(context, &open, &trunks, out);
            if self.budget.is_news() {
                out.push(say::too_much_search(first_wall(level), level.storey.number));
            }
        }
        let shape = self.shape(level);
        let flat = many || shape == RoofShape::Flat;
        let ratio = self.house.roofs.style.ratio.is_some();
        turn(&mut found, shape, shape.has_equal_slopes(ratio));
        self.refuse(&found, shape, out);
        let shape = if flat { RoofShape::Flat } else { shape };
        if found.is_empty() || flat {
            done.plans.push(report::plan(level, &found, shape));
        }
        if found.is_empty() {
            return vec![];
        }
        if flat {
            let cells: Vec<Cell> = found.iter().map(|r| r.cell).collect();
            // One loop is clean except for corners in mid-wall, which an upstand ignores.
            let border = if many && open.loops.len() == 1 {
                open
            } else {
                open.clean()
            };
            return vec![context.flat(&cells, &border, level.storey.z1, None)];
        }
        let automatic = Automatic::new(context, found, &trunks);
        automatic.report(out);
        let built = automatic.own_regions();
        done.plans.push(report::plan(level, built, shape));
        automatic.roofs(&mut done.ceilings)
    }

    /// Returns the shape of automatic roofs; behind a parapet it is flat unless the author gives another.
    fn shape(&self, level: &Level<'_>) -> RoofShape {
        let usual = match level.parapet {
            true => RoofShape::Flat,
            false => RoofShape::Gable,
        };
        self.house.roofs.style.shape.map_or(usual, |s| s.value)
    }

    /// Reports a shape of single slopes that these regions cannot have.
    fn refuse(&self, found: &[Region], shape: RoofShape, out: &mut Diagnostics) {
        let Some(wish) = self.house.roofs.style.shape else {
            return;
        };
        let number = self.levels[self.k].storey.number;
        let gables = found.iter().any(|r| r.ridge.is_some());
        match shape {
            RoofShape::Pent => out.push(say::automatic_pent(wish.span, number)),
            shape if shape.stands_on_another() => {
                out.push(say::automatic_dormer(wish.span, shape.letters(), number));
            }
            RoofShape::LeanTo if gables => out.push(say::joined_slopes(wish.span, number)),
            _ => {}
        }
    }

    /// Returns the lower roof of a storey that carries a smaller one and has no roof lines.
    fn skirt<'c>(&self, context: &Context<'c>) -> Option<Skirt<'c>> {
        let shape = self.house.roofs.style.shape?.value;
        let covered = self.lines.iter().any(|l| l.covers());
        let cell = context.level.plan.as_cell().filter(|_| !covered)?;
        Skirt::over(cell, shape, context)
    }

    /// Returns the area that neither the storey above nor a roof line covers; `None` if their walls and this storey's
    /// cross in too many places.
    fn open(&self, context: &Context<'_>) -> Option<Plan> {
        let plan = &context.level.plan;
        let taken: Vec<Cell> = self
            .lines
            .iter()
            .filter(|l| l.covers())
            .map(|l| l.cell)
            .collect();
        let open = match context.upper {
            Some(upper) if upper == plan => return Some(Plan::default()),
            Some(upper) if !plan.fits(Some(upper)) => return None,
            Some(upper) => plan.difference(upper),
            None => plan.clone(),
        };
        let covering = Plan::from_cells(&taken);
        let open = match taken.is_empty() {
            true => open,
            false if !open.fits(Some(&covering)) => return None,
            false => open.minus_cells(&taken),
        };
        // Combs laid across each other leave a piece for every two of their teeth.
        let written = [Some(plan), context.upper, Some(&covering)];
        let written: usize = written.into_iter().flatten().map(Plan::corners).sum();
        (open.corners() <= 2 * written + MOST_CORNERS).then_some(open)
    }

    fn regions(
        &self,
        context: &Context<'_>,
        open: &Plan,
        trunks: &[Written],
        out: &mut Diagnostics,
    ) -> Vec<Region> {
        let method = match self.house.roofs.method {
            RoofMethod::Kd => {
                let cells = partition_within(open, Method::Kd, self.budget);
                return cells.into_iter().map(Region::main).collect();
            }
            RoofMethod::KdBranches => Method::Kd,
            RoofMethod::BranchCut => Method::BranchCut,
            RoofMethod::LeastCut | RoofMethod::Skeleton => Method::LeastCut,
        };
        let line = self
            .house
            .street
            .then(|| first_line(context.level.storey))
            .flatten();
        let front = line.and_then(|line| street::street_front(open, line));
        let strips = RefCell::new(vec![]);
        let most = self.widest_span(context.level);
        let narrow = match method {
            Method::LeastCut if self.house.roofs.style.shape.is_none() => {
                (NARROW / self.house.unit * STEPS as f64).floor() as i64
            }
            _ => 0,
        };
        let cut = |open: &Plan| {
            let cells = partition_broad(open, method, self.budget, narrow);
            let (cells, divided) = spans::divided(cells, most);
            strips.borrow_mut().extend(divided);
            cells
        };
        let beside: Vec<_> = trunks.iter().map(|t| t.beside).collect();
        let mut found = regions_by(open, context.upper, cut, front, STEPS, &beside);
        let strips = strips.into_inner();
        if !strips.is_empty() {
            stand_alone(&mut found, &strips);
            let storey = context.level.storey;
            out.push(say::several_ridges(
                first_wall(context.level),
                storey.number,
            ));
        }
        found
    }

    /// Returns the widest span of one roof in steps; a shape that is asked for has no limit.
    fn widest_span(&self, level: &Level<'_>) -> i64 {
        match self.house.roofs.style.shape {
            None if self.shape(level) == RoofShape::Gable => {
                (spans::WIDEST / self.house.unit * STEPS as f64).round() as i64
            }
            _ => i64::MAX,
        }
    }
}

/// Makes the strips of a divided hall roofs of their own; they differ by a step at most, which is no reason to run into
/// each other.
fn stand_alone(regions: &mut [Region], strips: &[Cell]) {
    for region in regions.iter_mut().filter(|r| strips.contains(&r.cell)) {
        *region = Region {
            against_wall: region.against_wall,
            ..Region::main(region.cell)
        };
    }
}

/// Returns the first wall's place: a diagnostic about a storey of a thousand lines marks it.
fn first_wall(level: &Level<'_>) -> Span {
    let wall = level.storey.rings.first().and_then(|r| r.walls.first());
    wall.map_or(level.storey.span, |w| w.span)
}

/// Returns the regions of a plan without a search: strips along a.
fn strips(open: &Plan) -> Vec<Region> {
    let mut cells = slabs::strips(open);
    cells.sort_unstable_by_key(Cell::key);
    cells.into_iter().map(Region::main).collect()
}

/// Turns main roofs as their shape requires: ridges along the short side (YOK), or along the long side even on a street
/// if all slopes are equal; single slopes that fall over their long side.
fn turn(regions: &mut [Region], shape: RoofShape, equal_slopes: bool) {
    let joined: Vec<usize> = regions
        .iter()
        .filter_map(|r| r.over.or(r.through))
        .collect();
    let (wide, deep) = match shape {
        RoofShape::BroadGable => (Ridge::B, Ridge::A),
        RoofShape::LeanTo => (Ridge::A, Ridge::B),
        _ if equal_slopes => (Ridge::A, Ridge::B),
        _ => return,
    };
    for (n, region) in regions.iter_mut().enumerate() {
        if region.role != Role::Main || region.joins.is_some() || region.against_wall.is_some() {
            continue;
        }
        region.ridge = match region.cell.width().cmp(&region.cell.depth()) {
            std::cmp::Ordering::Greater => Some(wide),
            std::cmp::Ordering::Less => Some(deep),
            std::cmp::Ordering::Equal => region.ridge,
        };
        // A branch runs into a gable's slope, not into a wall above a single one.
        if shape == RoofShape::LeanTo && !joined.contains(&n) {
            region.fall = region.ridge.take().map(near_side);
            region.role = Role::LeanTo;
        }
    }
}
