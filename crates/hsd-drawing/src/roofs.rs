//! Ridges, hips, valleys and falls of roofs as the compiler knows them, where nothing above hides them.

use crate::Settings;
use crate::dimension::short;
use crate::paper::{Anchor, Mark, Role, Shape, arrow};
use crate::seen::Depths;
use crate::subject::Subject;
use glam::{DVec2, DVec3};
use hsd_ir::building::EdgeKind;

/// Ridge tiles and their courses stand as high above the lines they cover, metres.
const COVER: f64 = 0.8;

/// The size of a slope that has an arrow, square metres in plan.
const LARGE: f64 = 3.0;

/// Returns the lines on all roofs, and an arrow down each slope with its rise.
pub(super) fn lines(subject: &Subject<'_>, depths: &Depths<'_>, settings: &Settings) -> Vec<Mark> {
    let mut marks = vec![];
    let kinds = [
        (EdgeKind::Valley, Role::Valley),
        (EdgeKind::Hip, Role::Ridge),
        (EdgeKind::Ridge, Role::Ridge),
    ];
    for (kind, role) in kinds {
        let found = edges(subject, depths, &[kind]);
        if !found.is_empty() {
            marks.push(Mark::new(role, Shape::Lines(found)));
        }
    }
    for built in &subject.houses {
        for surface in built.roofs.surfaces() {
            for facet in &surface.facets {
                let corners = facet.corners.iter().map(|c| surface.points[*c as usize]);
                let place = |p| subject.point(&built.house, p);
                let corners: Vec<DVec3> = corners.map(place).collect();
                marks.extend(fall(&corners, depths, settings));
            }
        }
    }
    marks
}

/// Returns the outlines of all roofs and their ridges.
pub(super) fn outlines(subject: &Subject<'_>, depths: &Depths<'_>) -> Vec<Mark> {
    let kinds = [
        EdgeKind::Ridge,
        EdgeKind::Hip,
        EdgeKind::Valley,
        EdgeKind::Eaves,
        EdgeKind::Verge,
        EdgeKind::Crest,
    ];
    let found = edges(subject, depths, &kinds);
    match found.is_empty() {
        true => vec![],
        false => vec![Mark::new(Role::Ridge, Shape::Lines(found))],
    }
}

/// Returns the edges of some kinds as they are seen.
fn edges(subject: &Subject<'_>, depths: &Depths<'_>, kinds: &[EdgeKind]) -> Vec<[DVec2; 2]> {
    let mut found = vec![];
    for built in &subject.houses {
        for surface in built.roofs.surfaces() {
            for line in kinds.iter().flat_map(|k| surface.lines(*k)) {
                let raised = line.map(|p| subject.point(&built.house, p) + DVec3::Z * COVER);
                depths.visible(raised, &mut found);
            }
        }
    }
    crate::merge::merged(found)
}

/// Returns an arrow down a slope from the middle of it, with its rise over ten.
fn fall(corners: &[DVec3], depths: &Depths<'_>, settings: &Settings) -> Vec<Mark> {
    let normal: DVec3 = (1..corners.len().max(2) - 1)
        .map(|k| (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]))
        .sum();
    if normal.z.abs() / 2.0 < LARGE {
        return vec![];
    }
    let down = normal.truncate() / normal.z;
    let Some(way) = down.try_normalize() else {
        return vec![];
    };
    let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
    if !depths.is_seen(middle + DVec3::Z * COVER) {
        return vec![];
    }
    let along = corners.iter().map(|c| way.dot((c - middle).truncate()));
    let most = along.fold(0.0, f64::max) * settings.millimetres();
    let from = middle.truncate() * settings.millimetres();
    let tip = from + way * (most * 0.6);
    let rise = format!("{}/10", short(down.length() * 10.0, 1));
    vec![
        Mark::new(Role::Fall, Shape::Lines(arrow(from, tip))),
        Mark::label(
            Role::Text,
            from + DVec2::new(0.8, 0.8),
            1.8,
            Anchor::Start,
            rise,
        ),
    ]
}
