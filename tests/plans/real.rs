//! Plans that nobody drew for this program, where `../shared/data/plans_real` has them with their labels.

use super::legends;
use crate::support::on_all_processors;
use glam::{DVec2, dvec2};
use hsd::plan::legend::Role;
use hsd::plan::text::Era;
use hsd::plan::walls::openings::pieces;
use hsd::plan::walls::{Found, writing};
use hsd::plan::{self, Picture, Plan};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A reading beside the label of its plan.
#[derive(Debug)]
struct Judged {
    name: String,
    /// The area that both outlines share, of that of either.
    outline: f64,
    /// Metres that were read for metres that are true, if that is known.
    scale: Option<f64>,
    rooms: usize,
    /// The share of rooms that are labelled ones and of labelled ones that were found, as one figure (F1).
    f1: f64,
    /// The share of labelled doors and windows that were found, if all are labelled.
    openings: Option<f64>,
}

fn points(of: &Value) -> Vec<DVec2> {
    let corner = |p: &Value| dvec2(p[0].as_f64().unwrap(), p[1].as_f64().unwrap());
    of.as_array().unwrap().iter().map(corner).collect()
}

fn inside(around: &[DVec2], at: DVec2) -> bool {
    let next = around.iter().cycle().skip(1);
    let crossed = around.iter().zip(next).filter(|(a, b)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

/// The area that two polygons share, of that of either, by places every three pixels.
fn shared_area(a: &[DVec2], b: &[DVec2], (width, height): (f64, f64)) -> f64 {
    let (mut both, mut either) = (0, 0);
    for y in 0..(height / 3.0) as usize {
        for x in 0..(width / 3.0) as usize {
            let at = dvec2(x as f64 * 3.0 + 1.3, y as f64 * 3.0 + 1.3);
            let (p, q) = (inside(a, at), inside(b, at));
            both += usize::from(p && q);
            either += usize::from(p || q);
        }
    }
    both as f64 / either.max(1) as f64
}

/// Compares the rooms of a reading with those of a label, by places every three pixels. Two are one room if they share half of both.
fn rooms(found: &Found, label: &Value) -> f64 {
    let labelled = label["rooms"].as_array().unwrap();
    let around: Vec<_> = labelled
        .iter()
        .map(|room| points(&room["polygon"]))
        .collect();
    let (mut of_read, mut of_label) = (BTreeMap::new(), vec![0; around.len()]);
    let mut shared: BTreeMap<(u32, usize), usize> = BTreeMap::new();
    let faces = &found.reading.divided.faces.of;
    for y in (0..faces.height).step_by(3) {
        for x in (0..faces.width).step_by(3) {
            let face = faces[(x, y)];
            let at = found.in_picture(dvec2(x as f64, y as f64));
            *of_read.entry(face).or_insert(0) += 1;
            for k in (0..around.len()).filter(|k| inside(&around[*k], at)) {
                of_label[k] += 1;
                *shared.entry((face, k)).or_default() += 1;
            }
        }
    }
    let is_one = |((face, k), both): (&(u32, usize), &usize)| {
        let either = of_read[face] + of_label[*k] - both;
        (*face != 0 && 2 * both >= either).then_some((*face, *k))
    };
    let pairs: BTreeSet<(u32, usize)> = shared.iter().filter_map(is_one).collect();
    let is_optional = |k: usize| labelled[k]["optional"] == true;
    let hit = (0..around.len()).filter(|k| !is_optional(*k) && pairs.iter().any(|p| p.1 == *k));
    let hit = hit.count() as f64;
    let asked = (0..around.len()).filter(|k| !is_optional(*k)).count() as f64;
    let optional = pairs
        .iter()
        .filter(|p| is_optional(p.1))
        .map(|p| p.0)
        .collect::<BTreeSet<u32>>();
    let read = found.reading.rooms() as f64 - optional.len() as f64;
    2.0 * hit / (asked + read)
}

/// Returns the share of labelled openings that were found: in their place, about as wide, windows as windows.
fn openings(found: &Found, label: &Value) -> f64 {
    let (divided, graph) = (&found.reading.divided, &found.reading.graph);
    let mut read = vec![];
    for line in &graph.lines {
        let [a, b] = line.ends.map(|k| found.in_picture(graph.corners[k]));
        let length = graph.corners[line.ends[0]].distance(graph.corners[line.ends[1]]);
        let mut from = 0.0;
        for piece in pieces((divided, graph), line, found.scale.metres) {
            let [p, q] = [from, piece.to].map(|along| a.lerp(b, along / length));
            read.push((piece.role, p.midpoint(q), p.distance(q)));
            from = piece.to;
        }
    }
    let labelled = label["openings"].as_array().unwrap();
    let is_found = |of: &&Value| {
        let (at, width) = (&of["at"], of["width"].as_f64().unwrap());
        let at = dvec2(at[0].as_f64().unwrap(), at[1].as_f64().unwrap());
        let is_window = of["kind"] == "window";
        read.iter().any(|(role, middle, length)| {
            let is_kind = match role {
                Role::Wall => false,
                Role::Window => is_window,
                _ => !is_window,
            };
            is_kind && middle.distance(at) < 0.3 * width && (0.7..1.4).contains(&(length / width))
        })
    };
    labelled.iter().filter(is_found).count() as f64 / labelled.len() as f64
}

/// Reads a plan wall by wall; `None` if it was refused, or read on a grid.
fn judge(label: &Value, folder: &Path) -> Option<Judged> {
    let bytes = std::fs::read(folder.join("inputs").join(label["input"].as_str()?)).ok()?;
    let picture = Picture::decode(&bytes).ok()?;
    let plan = plan::read(&picture, &legends(), &plan::Options::default()).ok()?;
    let Plan::Walls(found) = plan else {
        return None;
    };
    let head = ("a", &[][..], Era::named("edo")?);
    let traced = writing::write(&[found.storey(10.0)], head)?;
    let outline: Vec<DVec2> = traced.storeys[0]
        .outline
        .iter()
        .map(|p| found.in_picture(*p))
        .collect();
    let frame = &label["frame"];
    let size = (frame["width"].as_f64()?, frame["height"].as_f64()?);
    let all = label["outlines"].as_array()?.iter();
    let best = all.map(|o| shared_area(&outline, &points(&o["polygon"]), size));
    let metres = label["size"]["m_per_unit"].as_f64();
    Some(Judged {
        name: label["name"].as_str()?.to_owned(),
        outline: best.fold(0.0, f64::max),
        scale: metres.map(|m| found.scale.metres / m),
        rooms: found.reading.rooms(),
        f1: rooms(&found, label),
        openings: (label["openings_complete"] == true).then(|| openings(&found, label)),
    })
}

#[test]
fn real_plans_are_read_wall_by_wall() {
    let folder = Path::new("../shared/data/plans_real");
    let Ok(labels) = std::fs::read_dir(folder.join("labels")) else {
        return;
    };
    let mut labels: Vec<Value> = labels
        .map(|entry| std::fs::read(entry.unwrap().path()).unwrap())
        .map(|bytes| serde_json::from_slice(&bytes).unwrap())
        .collect();
    labels.retain(|label: &Value| {
        let is_picture = |name: &str| name.ends_with(".png") || name.ends_with(".jpg");
        label["input"].as_str().is_some_and(is_picture)
    });
    labels.sort_by_key(|label| label["name"].as_str().unwrap().to_owned());
    let judged = std::sync::Mutex::new(vec![]);
    on_all_processors(labels.len(), |k| {
        judged.lock().unwrap().extend(judge(&labels[k], folder));
        Vec::<String>::new()
    });
    let judged = judged.into_inner().unwrap();
    assert!(judged.len() >= 8, "{judged:#?}");
    for plan in &judged {
        let is_silent = plan.outline < 0.7 || plan.scale.is_some_and(|s| (s - 1.0).abs() > 0.3);
        assert!(!is_silent, "a wrong house without an error: {plan:?}");
    }
    let sharp = judged.iter().filter(|plan| plan.outline >= 0.95).count();
    assert!(sharp >= 7, "{judged:#?}");
    let is_right = |plan: &&Judged| {
        let is_scaled = plan.scale.is_none_or(|s| (s - 1.0).abs() <= 0.05);
        plan.outline >= 0.95 && plan.f1 >= 0.9 && is_scaled
    };
    assert!(judged.iter().filter(is_right).count() >= 5, "{judged:#?}");
    let f1 = judged.iter().map(|plan| plan.f1).sum::<f64>() / judged.len() as f64;
    assert!(f1 >= 0.85, "{f1}: {judged:#?}");
    // Printed dimensions say how large they are, between walls or by their own lines, and all their rooms are found.
    for name in ["own_h2_quarter", "own_h3_daime"] {
        let printed = judged.iter().find(|plan| plan.name == name);
        let printed = printed.expect("the plan is read");
        assert!(
            printed.scale.is_some_and(|s| (s - 1.0).abs() < 0.01),
            "{printed:?}"
        );
        assert_eq!(printed.rooms, 7);
    }
    // The windows of these plans are stretches of walls in another colour.
    for name in ["madori_c1_png", "madori_hiraya_png"] {
        let coloured = judged.iter().find(|plan| plan.name == name);
        let coloured = coloured.expect("the plan is read");
        assert_eq!(coloured.openings, Some(1.0), "{coloured:?}");
    }
}
