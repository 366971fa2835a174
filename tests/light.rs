//! Rooms keep the light out: no ray from a point in a room leaves through a corner or a joint while doors are shut. Where bays
//! stand open, the catalogue says so.

use crate::support::depths::{Triangle, skins_below};
use crate::support::{Run, assert_none, compile, on_all_processors};
use glam::{DVec2, DVec3};
use hsd::ast::RoomCeiling;
use hsd::building::{House, Room};
use hsd::program::{Content, Unit};
use hsd::scene::{Kind, NodeId};

/// What a ray meets this far outside of a room belongs to its walls, metres: half an earth wall, a window's box.
const WALL: f64 = 0.35;

/// Rays beside a corner, metres: as wide as a crack, as a post, as what stands before it.
const BESIDE: [f64; 7] = [-0.12, -0.04, -0.004, 0.0, 0.004, 0.04, 0.12];

/// The house's triangles within reach of a room, in its frame.
struct Near<'a>(Vec<&'a Triangle>);

impl Near<'_> {
    /// How far along a ray the first of them is.
    fn first(&self, from: DVec3, way: DVec3) -> f64 {
        self.0
            .iter()
            .filter_map(|t| meets(t, from, way))
            .fold(f64::INFINITY, f64::min)
    }
}

/// Where a ray meets a triangle, from either side.
fn meets([p, q, r]: &Triangle, from: DVec3, way: DVec3) -> Option<f64> {
    let (u, v) = (*q - *p, *r - *p);
    let across = way.cross(v);
    let det = u.dot(across);
    if det.abs() < 1e-12 {
        return None;
    }
    let s = from - *p;
    let a = s.dot(across) / det;
    let around = s.cross(u);
    let b = way.dot(around) / det;
    let at = v.dot(around) / det;
    // A hair more than the triangle: rays through an edge meet one of the two beside it.
    (a >= -1e-9 && b >= -1e-9 && a + b <= 1.0 + 1e-9 && at > 1e-6).then_some(at)
}

fn sides(ring: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    ring.iter()
        .copied()
        .zip(ring.iter().copied().cycle().skip(1))
}

/// How far a point is from a stretch.
fn off(p: DVec2, (a, b): (DVec2, DVec2)) -> f64 {
    let along = b - a;
    let share = ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
    p.distance(a + along * share)
}

fn cross(a: DVec2, b: DVec2) -> f64 {
    a.perp_dot(b)
}

/// How far along a level ray the outline of a room is first crossed.
fn leaves(area: &[Vec<DVec2>], from: DVec2, way: DVec2) -> Option<f64> {
    let all = area.iter().flat_map(|ring| sides(ring));
    let cuts = all.filter_map(|(a, b)| {
        let (side, turn) = (b - a, cross(way, b - a));
        let at = cross(a - from, side) / turn;
        let along = cross(a - from, way) / turn;
        (turn.abs() > 1e-12 && at > 1e-9 && (-1e-9..=1.0 + 1e-9).contains(&along)).then_some(at)
    });
    cuts.min_by(f64::total_cmp)
}

/// True if a unit keeps the light out.
fn closes(unit: &Unit, run: &Run) -> bool {
    match &unit.content {
        Content::Void => false,
        Content::Picture(_) => true,
        Content::Part(id) => run.catalog.part(*id).closes(),
        Content::Split(split) => split
            .upper
            .iter()
            .chain(&split.lower)
            .all(|u| closes(u, run)),
    }
}

/// Bays of a storey that stand open, in the house's frame.
fn openings(house: &House, room: &Room, run: &Run) -> Vec<(DVec2, DVec2)> {
    let mut open = vec![];
    for wall in house.storeys[room.level]
        .rings
        .iter()
        .flat_map(|r| &r.walls)
    {
        let mut offset = 0.0;
        for unit in &wall.units {
            let ends = [offset, offset + unit.width]
                .map(|o| house.place(wall.from + wall.direction * o, 0.0).truncate());
            offset += unit.width;
            if unit.width > 0.0 && !closes(unit, run) {
                open.push((ends[0], ends[1]));
            }
        }
    }
    open
}

/// The rays that leave the rooms of a house.
fn light(run: &Run, house: usize, rays: &mut usize) -> Vec<String> {
    let scene = &run.scene;
    let hsd::building::Built {
        house: built,
        rooms,
        ..
    } = &run.building.houses[house];
    let roots: Vec<usize> = (0..scene.nodes.len())
        .filter(|i| scene.nodes[*i].kind == Kind::House)
        .collect();
    let triangles: Vec<Triangle> = skins_below(scene, NodeId(roots[house] as u32))
        .into_iter()
        .map(|s| s.0)
        .collect();
    let mut found = vec![];
    for room in rooms {
        let storey = &built.storeys[room.level];
        let area: Vec<Vec<DVec2>> = room
            .area
            .iter()
            .map(|ring| {
                ring.iter()
                    .map(|p| built.place(*p, 0.0).truncate())
                    .collect()
            })
            .collect();
        let open = openings(built, room, run);
        let corners = || area.iter().flatten().copied();
        let low = corners().reduce(DVec2::min).expect("corners") - 2.0;
        let high = corners().reduce(DVec2::max).expect("corners") + 2.0;
        let reach = |t: &&Triangle| {
            let (lo, hi) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
            hi.truncate().cmpge(low).all()
                && lo.truncate().cmple(high).all()
                && hi.z > storey.z0 - 1.0
                && lo.z < storey.z1 + 2.0
        };
        let near = Near(triangles.iter().filter(reach).collect());
        let floor = storey.z0;
        let whole = storey.wall_height();
        let top = floor + room.height.unwrap_or(whole).min(whole);
        let covered = room.ceiling != RoomCeiling::None && room.ceilings.is_none();
        // Eyes at two heights, for what is behind fixtures.
        for eyes in [0.35, 0.8].map(|share| floor + (top - floor) * share) {
            let from = built.place(room.at, eyes);
            let mut aims: Vec<DVec3> = vec![];
            for corner in corners() {
                for step in 0..5 {
                    let z = floor + 0.02 + (top - floor - 0.24) * f64::from(step) / 4.0;
                    let across = (corner - from.truncate()).perp().normalize_or_zero();
                    aims.extend(BESIDE.map(|by| (corner + across * by).extend(z)));
                }
            }
            for ring in &area {
                for (a, b) in sides(ring) {
                    let count = (a.distance(b) / 0.25).ceil().max(1.0);
                    for i in 0..count as u32 {
                        let at = a.lerp(b, (f64::from(i) + 0.5) / count);
                        aims.extend(
                            [0.02, 0.06, 0.5, 0.93]
                                .map(|share| at.extend(floor + (top - floor) * share)),
                        );
                    }
                }
            }
            for aim in aims {
                let way = (aim - from).normalize();
                let level = way.truncate().length();
                if level < 1e-6 {
                    continue;
                }
                *rays += 1;
                let Some(out) = leaves(&area, from.truncate(), way.truncate()) else {
                    continue;
                };
                let exit = from + way * out;
                if open.iter().any(|o| off(exit.truncate(), *o) < 0.15) {
                    continue;
                }
                // Up into the roof, or up and down by stairs.
                let above = exit.z > top - 0.02 && !covered
                    || exit.z < floor + 0.01 && room.floors.is_some();
                if above {
                    continue;
                }
                let met = from + way * near.first(from, way).min(1e3);
                let beyond = area
                    .iter()
                    .flat_map(|ring| sides(ring))
                    .map(|s| off(met.truncate(), s))
                    .fold(f64::INFINITY, f64::min);
                if (met - from).length() > out && beyond > WALL {
                    let mm = |p: DVec3| p.to_array().map(|x| (x * 1000.0).round());
                    found.push(format!(
                        "storey {}, {} at {}: from {:?} towards {:?}, {beyond:.2} m beyond",
                        room.storey,
                        room.name,
                        room.at,
                        mm(from),
                        mm(exit)
                    ));
                }
            }
        }
    }
    found
}

/// The types of one house that have rooms, as they are and with other parameters.
#[test]
fn no_light_comes_into_the_rooms_of_types() {
    let types = crate::types::with_rooms();
    assert!(types.len() >= 10, "{} types", types.len());
    // A short run builds half of the types unchanged, the others with another parameter.
    let times = if crate::support::thorough() { 2 } else { 1 };
    assert_none(&on_all_processors(times * types.len(), |i| {
        let (word, other) = (types[i % types.len()], (i + i / types.len()) % 2 == 1);
        let run = crate::types::roomy(word, other);
        let (mut found, mut rays) = (vec![], 0);
        for house in 0..run.building.houses.len() {
            let seen = light(&run, house, &mut rays);
            found.extend(
                seen.iter()
                    .take(3)
                    .map(|s| format!("{word} {other}: {} such, {s}", seen.len())),
            );
        }
        if rays < 500 {
            found.push(format!("{word}: {rays} rays only"));
        }
        found
    }));
}

/// Houses that are divided at random.
#[test]
fn no_light_comes_into_divided_houses() {
    assert_none(&on_all_processors(crate::support::part_of(60), |seed| {
        let (text, ..) = crate::rooms::divided(seed);
        let run = compile("divided.hsd", text.as_bytes());
        let mut rays = 0;
        let seen = light(&run, 0, &mut rays);
        assert!(rays > 0);
        seen.iter()
            .take(1)
            .map(|s| format!("seed {seed}: {} such, {s}\n{text}", seen.len()))
            .collect()
    }));
}

/// The rays find a bay that is taken out of a wall, and a strip of a hand's width beside a corner.
#[test]
fn a_gap_lets_light_in() {
    let side = format!("<Row>{}</Row>", "KTU  ".repeat(5));
    let text = format!(
        "<House><Storey height=\"9\">{}<Room at=\"2 2\"/></Storey></House>",
        side.repeat(4)
    );
    let whole = compile("gap.hsd", text.as_bytes());
    assert_eq!(light(&whole, 0, &mut 0), Vec::<String>::new());
    let mut less = compile("gap.hsd", text.as_bytes());
    let bay = less.scene.nodes.iter().position(|n| n.kind == Kind::Part);
    less.scene.nodes[bay.expect("a bay")].mesh = None;
    assert!(!light(&less, 0, &mut 0).is_empty(), "a bay");
    let mut ajar = compile("gap.hsd", text.as_bytes());
    // The first facade moves aside, its corner posts with it.
    let facade = ajar.scene.nodes.iter().position(|n| n.kind == Kind::Facade);
    ajar.scene.nodes[facade.expect("a facade")].at.x -= 0.25;
    assert!(!light(&ajar, 0, &mut 0).is_empty(), "a corner ajar");
}
