//! Gates, halls, shrines and pagodas of random measures, three hundred in a thorough run: one does not see through their closed
//! bays, each storey has a floor and a ceiling, and faces of unlike materials share a plane by rare chance only.

use crate::coplanar::told;
use crate::see_through::{cut, gap};
use crate::support::coplanar::fights;
use crate::support::depths::{Skin, Triangle, skins_below, skins_of};
use crate::support::{Numbers, Run, assert_none, compile, on_all_processors, part_of};
use glam::{DVec2, DVec3, dvec2};
use hsd::ast::StoreyKind;
use hsd::building::{Built, Storey, Wall};
use hsd::geometry::SHAKU;
use hsd::program::Content;
use hsd::scene::{Detail, Kind, NodeId, Scene};

/// Number of monuments, of which a short run looks at a part.
const COUNT: usize = 600;

/// Among how many of them there may be one in which two random measures meet, so that faces share a plane.
const CHANCE: usize = 20;

/// The height of an eye above the floor, metres.
const EYE: f64 = 1.5;

/// The short form of a monument, from its number.
fn text(number: usize) -> String {
    let mut numbers = Numbers(number as u64 * 31 + 7);
    let paint = *numbers.of(&["vermilion", "keyaki", "hinoki"]);
    let steps = numbers.below(4);
    let mut between = |low: f64, high: f64| {
        let share = numbers.below(1001) as f64 / 1000.0;
        ((low + (high - low) * share) * 100.0).round() / 100.0
    };
    let (bay, platform, pitch) = (between(6.0, 17.0), between(0.0, 6.0), between(4.5, 7.0));
    let (setback, share) = (between(0.6, 3.0), between(0.5, 0.9));
    let (veranda, floor, sori) = (between(0.0, 6.0), between(1.0, 4.0), between(0.0, 5.0));
    let look = format!(
        "paint=\"{paint}\" steps=\"{steps}\" platform=\"{platform}\" pitch=\"{pitch}\" sori=\"{sori}\""
    );
    match number % 4 {
        0 => {
            let (bays, deep) = (1 + numbers.below(4), 1 + numbers.below(3));
            let storeys = 1 + numbers.below(2);
            let shape = numbers.of(&["IRI", "YOS", "KIR"]);
            format!(
                "<Gate bays=\"{bays} {deep}\" bay=\"{bay}\" storeys=\"{storeys}\" inset=\"{setback}\" shape=\"{shape}\" {look}/>"
            )
        }
        1 => {
            let (storeys, bays) = (1 + numbers.below(3), 1 + numbers.below(3));
            format!(
                "<Pagoda storeys=\"{storeys}\" width=\"{}\" bays=\"{bays}\" taper=\"{share}\" {look}/>",
                bay * 1.5
            )
        }
        2 => {
            let (bays, deep) = (3 + numbers.below(3), 2 + numbers.below(3));
            let aisle = *numbers.of(&[0.0, 0.5 * bay]);
            let shape = numbers.of(&["IRI", "TER", "YOS"]);
            format!(
                "<Hall bays=\"{bays} {deep}\" bay=\"{bay}\" aisle=\"{aisle}\" veranda=\"{veranda}\" floor=\"{floor}\" shape=\"{shape}\" {look}/>"
            )
        }
        _ => {
            let (bays, deep) = (1 + numbers.below(3), 1 + numbers.below(2));
            let kind = numbers.of(&["H", "S", "I"]);
            format!(
                "<Shrine bays=\"{bays} {deep}\" bay=\"{bay}\" veranda=\"{veranda}\" floor=\"{floor}\" kind=\"{kind}\" {look}/>"
            )
        }
    }
}

/// Checks each monument; a finding is reported with the source text.
fn findings(look: impl Fn(&Run, &Scene) -> Vec<String> + Sync) -> Vec<String> {
    on_all_processors(part_of(COUNT), |number| {
        let text = text(number);
        let run = compile("monument.hsd", format!("<House>{text}</House>").as_bytes());
        assert!(!run.has_errors(), "{text}{}", run.short());
        let scene = hsd::driver::scene(&run.building, &run.catalog, Detail::Openings);
        let told = look(&run, &scene).into_iter();
        told.map(|f| format!("{number} {text}: {f}")).collect()
    })
}

#[test]
fn one_does_not_see_through_monuments() {
    assert_none(&findings(|run, scene| {
        let house = &run.building.houses[0];
        let mut found = vec![];
        for (i, node) in scene.nodes.iter().enumerate() {
            let (Kind::Facade, Some(storey), Some(facade)) = (node.kind, node.storey, node.facade)
            else {
                continue;
            };
            let storeys = &house.house.storeys;
            let storey = storeys.iter().find(|s| s.number == storey).unwrap();
            let mut walls = storey.rings.iter().flat_map(|r| &r.walls);
            let wall = walls.find(|w| w.facade == facade.get()).unwrap();
            let skins = skins_below(scene, NodeId(i as u32));
            let own: Vec<Triangle> = skins.into_iter().map(|s| s.0).collect();
            found.extend(gaps(run, house, (storey, wall), &own));
        }
        found
    }));
}

/// Where one sees through the closed bays of a wall at the height of an eye, and halfway up.
fn gaps(
    run: &Run,
    house: &Built,
    (storey, wall): (&Storey, &Wall),
    own: &[Triangle],
) -> Vec<String> {
    let unit = house.house.unit;
    let high = storey.wall_height();
    // The post at a corner belongs to one of its walls.
    let posts = storey.order.posts.as_ref();
    let post = posts.map_or(0.0, |p| p.size * SHAKU / 2.0);
    let length = wall.from.distance(wall.to) * unit;
    let mut found = vec![];
    for z in [EYE.min(high * 0.6), high * 0.5] {
        let segments: Vec<[DVec2; 2]> = own.iter().filter_map(|t| cut(t, z)).collect();
        for (from, to) in closed(run, wall) {
            // In the frame of the facade x runs from minus its length to zero. Beside an opening one looks past the post.
            let (left, right) = ((-to * unit).max(post - length), (-from * unit).min(-post));
            let beside = 0.25_f64.min((right - left) / 4.0);
            for (angle, less) in [(0.0, 0.0), (0.41, beside), (-0.41, beside)] {
                if let Some((a, b)) = gap(&segments, angle, (left + less, right - less)) {
                    found.push(format!(
                        "storey {} wall {} at height {z:.2}: {a:.4} to {b:.4}, {angle}",
                        storey.number, wall.facade
                    ));
                }
            }
        }
    }
    found
}

/// The stretches of a wall that are closed, in units from its right end.
fn closed(run: &Run, wall: &Wall) -> Vec<(f64, f64)> {
    let closes = |content: &Content| match content {
        Content::Part(id) => run.catalog.part(*id).closes(),
        Content::Split(split) => split
            .lower
            .iter()
            .chain(&split.upper)
            .all(|u| matches!(&u.content, Content::Part(id) if run.catalog.part(*id).closes())),
        Content::Void | Content::Picture(_) => false,
    };
    let (mut stretches, mut at): (Vec<(f64, f64)>, f64) = (vec![], 0.0);
    for unit in &wall.units {
        if closes(&unit.content) {
            match stretches.last_mut().filter(|s| (s.1 - at).abs() < 1e-9) {
                Some(last) => last.1 = at + unit.width,
                None => stretches.push((at, at + unit.width)),
            }
        }
        at += unit.width;
    }
    stretches
}

#[test]
fn every_storey_of_a_monument_has_a_floor_and_a_ceiling() {
    assert_none(&findings(|run, scene| {
        let house = &run.building.houses[0].house;
        let skins = skins_of(scene);
        let root = scene.nodes[0].at;
        let mut found = vec![];
        let storeys = house.storeys.iter();
        for storey in storeys.filter(|s| s.kind == StoreyKind::Storey) {
            let walls = &storey.rings[0].walls;
            let corners = || walls.iter().map(|w| w.from);
            let low = corners().reduce(DVec2::min).unwrap();
            let high = corners().reduce(DVec2::max).unwrap();
            for share in [
                (0.2, 0.3),
                (0.5, 0.3),
                (0.8, 0.3),
                (0.2, 0.7),
                (0.5, 0.8),
                (0.8, 0.7),
            ] {
                let plan = low + (high - low) * dvec2(share.0, share.1);
                // Upstairs doors lead to the boards of the veranda.
                let veranda = storey.order.veranda.as_ref();
                let rise = veranda
                    .filter(|_| storey.number > 1)
                    .map_or(0.0, |v| v.height * SHAKU);
                let at = root + house.place(plan, 0.0).truncate().extend(storey.z0);
                let eye = rise + EYE.min((storey.wall_height() - rise) / 2.0);
                let (down, up) = beside(&skins, at + DVec3::Z * eye);
                let (floor, ceiling) = (eye - down - rise, up + eye);
                if !(-0.31..0.05).contains(&floor) {
                    found.push(format!(
                        "storey {} at {share:?}: floor at {floor:.2}",
                        storey.number
                    ));
                }
                if ceiling > storey.wall_height() + 1e-6 {
                    found.push(format!(
                        "storey {} at {share:?}: one looks up to {ceiling:.2} of {:.2}",
                        storey.number,
                        storey.wall_height()
                    ));
                }
            }
        }
        found
    }));
}

/// The distance from a point down and up to the next face.
fn beside(skins: &[Skin], p: DVec3) -> (f64, f64) {
    let (mut down, mut up) = (f64::MAX, f64::MAX);
    // Beside the edges of triangles.
    let p = p + DVec3::new(1.3e-4, 0.7e-4, 0.0);
    for ([a, b, c], _) in skins {
        let part = |a: DVec3, b: DVec3| (b - a).truncate().perp_dot((p - a).truncate());
        let parts = [part(*b, *c), part(*c, *a), part(*a, *b)];
        let whole: f64 = parts.iter().sum();
        if whole.abs() < 1e-12 || parts.iter().any(|x| x * whole.signum() < 0.0) {
            continue;
        }
        let z = (parts[0] * a.z + parts[1] * b.z + parts[2] * c.z) / whole - p.z;
        match z > 0.0 {
            true => up = up.min(z),
            false => down = down.min(-z),
        }
    }
    (down, up)
}

#[test]
fn no_two_materials_of_a_monument_share_a_plane() {
    let found = findings(|_, scene| {
        let skins = skins_of(scene);
        told(scene, &skins, &fights(&skins))
    });
    let most = part_of(COUNT).div_ceil(CHANCE);
    assert!(found.len() <= most, "{most} at most: {found:#?}");
}
