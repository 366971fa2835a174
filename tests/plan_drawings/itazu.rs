//! Carpenters' board plans: an inked grid on wood, dots for posts, thick lines for walls, double ones for sliding
//! doors, dashes for open beams, signs along two edges.

use super::rng::Rng;
use super::sheet::{Ink, Role, Shape, Sheet, Variant};
use super::truth::{Kind, Plan, Run};
use super::writing::{Script, write};

const SUMI: Ink = [36, 30, 26];

struct Style {
    wall: f32,
    post: f32,
    thin: f32,
    grid: Ink,
    step: i32,
    gap: f32,
    bars: i32,
    stones: bool,
}

/// Draw the plan.
pub fn sheet(plan: &Plan, variant: Variant) -> Sheet {
    let mut rng = Rng::new(variant.seed, 13);
    let unseen = variant.unseen;
    let faint = rng.whole(110, 185) as u8;
    let style = Style {
        wall: if unseen {
            rng.between(0.05, 0.26)
        } else {
            rng.between(0.09, 0.16)
        },
        post: if unseen {
            rng.between(0.08, 0.26)
        } else {
            rng.between(0.12, 0.19)
        },
        thin: rng.between(0.02, 0.038),
        grid: [faint, faint - 8, faint - 16],
        step: rng.pick(&[1, 1, 2]),
        gap: rng.between(0.05, 0.085),
        bars: rng.whole(3, 6),
        stones: rng.chance(0.3),
    };
    let margins = [0; 4].map(|_| rng.between(1.9, 3.0));
    let mut sheet = Sheet::new(plan, margins);
    sheet.by_hand(if unseen { 0.03 } else { 0.012 }, &mut rng);
    grid(&mut sheet, plan, &style, &mut rng);
    for run in plan.runs() {
        stroke(&mut sheet, &run, &style, &mut rng);
    }
    for &post in &plan.posts {
        let c = sheet.at(post);
        sheet.put(Role::Post, SUMI, 0.0, Shape::Disc(c, style.post));
    }
    for room in plan
        .rooms
        .iter()
        .filter(|room| room.area.width() * room.area.depth() >= 6)
    {
        if rng.chance(0.4) {
            continue;
        }
        let script = Script {
            ink: SUMI,
            size: 0.42,
            weight: 0.11,
            turn: 0,
            vertical: true,
        };
        let middle = sheet.near(room.area.middle());
        write(&mut sheet, &script, middle, 2, Role::Text, &mut rng);
    }
    sheet
}

/// The grid with its signs; small dots for floor posts at crossings inside.
fn grid(sheet: &mut Sheet, plan: &Plan, style: &Style, rng: &mut Rng) {
    let script = Script {
        ink: SUMI,
        size: 0.4,
        weight: 0.12,
        turn: 0,
        vertical: true,
    };
    let (w, d) = (plan.width as f32, plan.depth as f32);
    for a in (0..=plan.width).filter(|a| a % style.step == 0) {
        let (p, q) = (
            sheet.near((a as f32, -0.5)),
            sheet.near((a as f32, d + 0.5)),
        );
        sheet.line(Role::Grid, style.grid, style.thin * 0.7, p, q);
        write(sheet, &script, (q.0, q.1 - 0.5), 1, Role::Margin, rng);
    }
    for b in (0..=plan.depth).filter(|b| b % style.step == 0) {
        let (p, q) = (
            sheet.near((-0.5, b as f32)),
            sheet.near((w + 0.5, b as f32)),
        );
        sheet.line(Role::Grid, style.grid, style.thin * 0.7, p, q);
        write(sheet, &script, (p.0 + 0.5, p.1), 1, Role::Margin, rng);
    }
    let cells: Vec<_> = plan
        .rooms
        .iter()
        .flat_map(|room| room.area.cells())
        .collect();
    for cell in cells.into_iter().filter(|_| style.stones) {
        let c = sheet.at(cell);
        sheet.put(Role::Fixture, SUMI, 0.0, Shape::Disc(c, 0.05));
    }
}

fn stroke(sheet: &mut Sheet, run: &Run, style: &Style, rng: &mut Rng) {
    let frame = sheet.frame(run, !run.outer && rng.chance(0.5));
    let length = run.length as f32;
    let line = |y: f32| Shape::Line(vec![(0.0, y), (length, y)]);
    let upright = |x: f32, y: f32| Shape::Line(vec![(x, -y), (x, y)]);
    let (gap, thin) = (style.gap, style.thin);
    let ends = (frame.to((0.0, 0.0)), frame.to((length, 0.0)));
    match run.kind {
        Kind::Wall => sheet.brush(
            Role::Wall,
            SUMI,
            style.wall * rng.between(0.9, 1.1),
            ends.0,
            ends.1,
        ),
        Kind::Open => sheet.dashes(Role::Door, SUMI, thin * 1.3, ends, 0.16),
        Kind::Slide => sheet.symbol(&frame, Role::Door, SUMI, thin, &[line(-gap), line(gap)]),
        Kind::Hinged => {
            let leaf = Shape::Line(vec![(0.0, 0.0), (length * 0.62, length * 0.62)]);
            sheet.symbol(&frame, Role::Door, SUMI, thin * 1.2, &[leaf]);
        }
        Kind::Window => {
            sheet.symbol(
                &frame,
                Role::Window,
                SUMI,
                thin,
                &[line(-gap * 1.4), line(0.0), line(gap * 1.4)],
            );
        }
        Kind::Lattice => {
            let mut shapes = vec![line(0.0)];
            shapes.extend(
                (1..run.length * style.bars).map(|k| upright(k as f32 / style.bars as f32, 0.12)),
            );
            sheet.symbol(&frame, Role::Window, SUMI, thin, &shapes);
        }
    }
}
