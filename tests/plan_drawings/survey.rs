//! Modern survey drawings: double walls, posts as squares, doors as offset parallels, arcs, mats, dimensions, a title.

use super::furniture::{dimensions, fixture_symbol, surroundings};
use super::rng::Rng;
use super::sheet::{Ink, Place, Role, Shape, Sheet, Variant};
use super::symbols::{hinged, lattice, slide, window};
use super::truth::{Area, Floor, Kind, Plan, Run};
use super::writing::{Script, write};
use std::f32::consts::FRAC_PI_2;

/// Habits of a draughtsman.
pub struct Style {
    pub(super) wall: f32,
    pub(super) post: f32,
    thin: f32,
    bold: f32,
    body: Option<Ink>,
    hollow_posts: bool,
    pub(super) leaf: i32,
    pub(super) sill: bool,
    pub(super) bars: i32,
    pub(super) projecting: bool,
    pub(super) panes: i32,
    pub(super) swing: f32,
    mats: bool,
    boards: bool,
    earth: i32,
    signs: f32,
    dims: i32,
    site: bool,
    ink: Ink,
}

impl Style {
    /// Habits by seed.
    pub fn new(variant: Variant, rng: &mut Rng) -> Self {
        let unseen = variant.unseen;
        let wall = if unseen {
            rng.between(0.07, 0.32)
        } else {
            rng.between(0.11, 0.2)
        };
        let grey = rng.whole(90, 190) as u8;
        let dark = rng.whole(0, 45) as u8;
        Self {
            wall,
            post: wall + rng.between(0.02, 0.09),
            thin: if unseen {
                rng.between(0.008, 0.05)
            } else {
                rng.between(0.014, 0.03)
            },
            bold: rng.between(0.025, 0.045),
            body: rng.pick(&[Some([dark; 3]), Some([dark; 3]), Some([grey; 3]), None]),
            hollow_posts: rng.chance(if unseen { 0.4 } else { 0.12 }),
            leaf: rng.whole(0, if unseen { 3 } else { 1 }),
            sill: rng.chance(0.6),
            bars: rng.whole(4, 9),
            projecting: rng.chance(if unseen { 0.6 } else { 0.2 }),
            panes: rng.whole(0, if unseen { 3 } else { 1 }),
            swing: if unseen {
                rng.pick(&[0.5, 0.785, FRAC_PI_2])
            } else {
                rng.pick(&[FRAC_PI_2, FRAC_PI_2, 1.2])
            },
            mats: rng.chance(0.75),
            boards: rng.chance(0.55),
            earth: rng.whole(0, 3),
            signs: rng.between(0.28, 0.5),
            dims: rng.whole(0, 3),
            site: rng.chance(0.6),
            ink: [dark, dark, dark.saturating_add(rng.whole(0, 12) as u8)],
        }
    }
}

/// Draw the plan.
pub fn sheet(plan: &Plan, variant: Variant) -> Sheet {
    let mut rng = Rng::new(variant.seed, 11);
    let style = Style::new(variant, &mut rng);
    let least = if style.dims > 0 { 3.0 } else { 1.8 };
    let margins = [0; 4].map(|_| rng.between(least, least + 1.6));
    let mut sheet = Sheet::new(plan, margins);
    floors(&mut sheet, plan, &style, &mut rng);
    for fixture in &plan.fixtures {
        fixture_symbol(&mut sheet, fixture, style.ink, style.thin, &mut rng);
    }
    walls(&mut sheet, plan, &style);
    for run in plan.runs() {
        opening(&mut sheet, &run, &style, &mut rng);
    }
    posts(&mut sheet, plan, &style);
    names(&mut sheet, plan, &style, &mut rng);
    if style.dims > 0 {
        dimensions(
            &mut sheet, plan, style.ink, style.thin, style.dims, &mut rng,
        );
    }
    surroundings(&mut sheet, style.ink, style.thin, style.site, &mut rng);
    sheet
}

fn floors(sheet: &mut Sheet, plan: &Plan, style: &Style, rng: &mut Rng) {
    for room in &plan.rooms {
        match room.floor {
            Floor::Tatami if style.mats => {
                for mat in &room.mats {
                    let outline = inside(sheet, mat, &room.area, style.wall / 2.0 + style.thin);
                    sheet.put(Role::Mat, style.ink, style.thin, Shape::Loop(outline));
                }
            }
            Floor::Board | Floor::Veranda if style.boards => boards(
                sheet,
                &room.area,
                style.ink,
                style.thin * 0.8,
                style.wall / 2.0,
            ),
            Floor::Earth => earth(sheet, &room.area, style, rng),
            _ => {}
        }
    }
}

/// A mat, cut back where it meets the walls of its room: mats lie between sills, not under them.
fn inside(sheet: &Sheet, mat: &Area, room: &Area, inset: f32) -> Vec<Place> {
    let low = |at: i32, edge: i32| at as f32 + if at == edge { inset } else { 0.0 };
    let high = |at: i32, edge: i32| at as f32 - if at == edge { inset } else { 0.0 };
    let (a0, b0) = (low(mat.from.0, room.from.0), low(mat.from.1, room.from.1));
    let (a1, b1) = (high(mat.to.0, room.to.0), high(mat.to.1, room.to.1));
    [(a0, b0), (a1, b0), (a1, b1), (a0, b1)]
        .map(|p| sheet.near(p))
        .to_vec()
}

/// Boards along the longer side, from sill to sill.
fn boards(sheet: &mut Sheet, area: &Area, ink: Ink, width: f32, inset: f32) {
    let along_a = area.width() >= area.depth();
    let (from, to) = if along_a {
        (area.from.1, area.to.1)
    } else {
        (area.from.0, area.to.0)
    };
    let (start, end) = if along_a {
        (area.from.0, area.to.0)
    } else {
        (area.from.1, area.to.1)
    };
    let (start, end) = (start as f32 + inset, end as f32 - inset);
    for k in 1..(to - from) * 4 {
        let c = from as f32 + k as f32 / 4.0;
        let (p, q) = if along_a {
            ((start, c), (end, c))
        } else {
            ((c, start), (c, end))
        };
        let (p, q) = (sheet.near(p), sheet.near(q));
        sheet.line(Role::Floor, ink, width, p, q);
    }
}

/// Earth: slanting lines, dots, or nothing.
fn earth(sheet: &mut Sheet, area: &Area, style: &Style, rng: &mut Rng) {
    let (w, d) = (area.width() as f32, area.depth() as f32);
    match style.earth {
        1 => {
            let step = rng.between(0.22, 0.45);
            let mut c = step;
            while c < w + d {
                let (a0, a1) = ((c - d).max(0.0), c.min(w));
                let place =
                    |a: f32| sheet.near((area.from.0 as f32 + a, area.from.1 as f32 + c - a));
                let (p, q) = (place(a0), place(a1));
                sheet.line(Role::Floor, style.ink, style.thin * 0.8, p, q);
                c += step;
            }
        }
        2 => {
            for _ in 0..(w * d * 6.0) as i32 {
                let p = sheet.near((
                    area.from.0 as f32 + rng.between(0.1, w - 0.1),
                    area.from.1 as f32 + rng.between(0.1, d - 0.1),
                ));
                sheet.put(
                    Role::Floor,
                    style.ink,
                    0.0,
                    Shape::Disc(p, style.thin * 1.2),
                );
            }
        }
        _ => {}
    }
}

fn walls(sheet: &mut Sheet, plan: &Plan, style: &Style) {
    let walls: Vec<Run> = plan
        .runs()
        .into_iter()
        .filter(|run| run.kind == Kind::Wall)
        .collect();
    let solid = style.body.is_some_and(|ink| ink[0] < 60);
    let body = style.body.unwrap_or([255; 3]);
    let passes: &[(f32, Ink)] = if solid {
        &[(style.wall, body)]
    } else {
        &[
            (style.wall, style.ink),
            (style.wall - 2.0 * style.bold, body),
        ]
    };
    for &(thick, ink) in passes {
        for run in &walls {
            let half = thick / 2.0;
            let (start, end) = (-half, run.length as f32 + half);
            let quad = vec![(start, -half), (end, -half), (end, half), (start, half)];
            let frame = sheet.frame(run, false);
            sheet.symbol(&frame, Role::Wall, ink, 0.0, &[Shape::Fill(quad)]);
        }
    }
}

fn posts(sheet: &mut Sheet, plan: &Plan, style: &Style) {
    for &post in &plan.posts {
        let c = sheet.at(post);
        let square = |half: f32| {
            Shape::Fill(vec![
                (c.0 - half, c.1 - half),
                (c.0 + half, c.1 - half),
                (c.0 + half, c.1 + half),
                (c.0 - half, c.1 + half),
            ])
        };
        sheet.put(Role::Post, style.ink, 0.0, square(style.post / 2.0));
        if style.hollow_posts {
            sheet.put(
                Role::Post,
                [255; 3],
                0.0,
                square(style.post / 2.0 - style.bold),
            );
        }
    }
}

fn opening(sheet: &mut Sheet, run: &Run, style: &Style, rng: &mut Rng) {
    let frame = sheet.frame(run, !run.outer && rng.chance(0.5));
    let length = run.length as f32;
    let (role, shapes) = match run.kind {
        Kind::Wall | Kind::Open => return,
        Kind::Slide => (Role::Door, slide(length, style)),
        Kind::Hinged => (
            Role::Door,
            hinged(length, style, rng.chance(0.5), run.outer && rng.chance(0.6)),
        ),
        Kind::Window => (Role::Window, window(length, style)),
        Kind::Lattice => (Role::Window, lattice(length, style, run.outer)),
    };
    sheet.symbol(&frame, role, style.ink, style.thin, &shapes);
}

/// Names in rooms, clear of nothing: real ones lie over mats too.
fn names(sheet: &mut Sheet, plan: &Plan, style: &Style, rng: &mut Rng) {
    for room in plan
        .rooms
        .iter()
        .filter(|room| room.area.width() * room.area.depth() >= 4)
    {
        let vertical = rng.chance(0.3);
        let script = Script {
            ink: style.ink,
            size: style.signs,
            weight: 0.08,
            turn: 0,
            vertical,
        };
        let room_for = if vertical {
            room.area.depth()
        } else {
            room.area.width()
        };
        let count = rng
            .whole(1, 4)
            .min((room_for as f32 / style.signs / 1.3) as i32)
            .max(1);
        let middle = sheet.near(room.area.middle());
        write(sheet, &script, middle, count, Role::Text, rng);
    }
}

/// How thick a draughtsman's walls are.
pub fn wall_of(variant: Variant) -> f32 {
    Style::new(variant, &mut Rng::new(variant.seed, 11)).wall
}

/// The symbol of an opening along +x, as a block of a CAD drawing has it.
pub fn local(run: &Run, variant: Variant) -> Vec<Shape> {
    let style = Style::new(variant, &mut Rng::new(variant.seed, 11));
    let length = run.length as f32;
    match run.kind {
        Kind::Wall | Kind::Open => Vec::new(),
        Kind::Slide => slide(length, &style),
        Kind::Hinged => hinged(length, &style, false, false),
        Kind::Window => window(length, &style),
        Kind::Lattice => lattice(length, &style, false),
    }
}
