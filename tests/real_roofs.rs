//! Hipped roofs over every outline of the real maps: houses, roofs as measured, lots, blocks and roads. The maps lie
//! beside the repository, not in it; without them the test is reported as ignored.
use crate::support::{assert_none, root};
use glam::{DVec2, dvec2};
use hsd::building::{Finish, Roof};
use hsd::check::solid_flaws;
use hsd::roof::shape::hipped::over;
use hsd::roof::shape::look::Look;
use serde_json::Value;
use std::path::{Path, PathBuf};

const METRES_PER_DEGREE: f64 = 111_320.0;

fn maps() -> Vec<PathBuf> {
    let folder = root().join("../shared/data");
    let list = |folder: &Path| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries.map(|e| e.path()).collect();
        paths.sort();
        paths
    };
    let files = list(&folder).into_iter().flat_map(|set| list(&set));
    files
        .filter(|f| f.extension().is_some_and(|e| e == "geojson"))
        .collect()
}

/// An outline with its courts, in metres.
struct Plan {
    name: String,
    outline: Vec<DVec2>,
    courts: Vec<Vec<DVec2>>,
}

/// All polygons of a map, in metres round the first corner of each.
fn plans(map: &Path) -> Vec<Plan> {
    let text = std::fs::read_to_string(map).expect("can be read");
    let json: Value = serde_json::from_str(&text).expect("is JSON");
    let mut plans = vec![];
    for (n, feature) in json["features"]
        .as_array()
        .into_iter()
        .flatten()
        .enumerate()
    {
        let geometry = &feature["geometry"];
        let one = std::slice::from_ref(&geometry["coordinates"]);
        let polygons: &[Value] = match geometry["type"].as_str() {
            Some("Polygon") => one,
            Some("MultiPolygon") => geometry["coordinates"]
                .as_array()
                .map_or(&[], Vec::as_slice),
            _ => &[],
        };
        for polygon in polygons {
            let first = &polygon[0][0];
            let origin = (first[0].as_f64(), first[1].as_f64());
            let (Some(x), Some(y)) = origin else { continue };
            let mut rings = polygon
                .as_array()
                .into_iter()
                .flatten()
                .map(|r| ring(r, dvec2(x, y)));
            let outline = rings.next().unwrap_or_default();
            plans.push(Plan {
                name: format!(
                    "{} {n}",
                    map.file_name().map_or("".into(), |f| f.to_string_lossy())
                ),
                outline,
                courts: rings.collect(),
            });
        }
    }
    plans
}

fn ring(ring: &Value, origin: DVec2) -> Vec<DVec2> {
    let degrees = origin.x.abs() <= 180.0 && origin.y.abs() <= 90.0;
    let shrink = origin.y.to_radians().cos();
    let place = |p: &Value| {
        let by = dvec2(p[0].as_f64()?, p[1].as_f64()?) - origin;
        let metres = METRES_PER_DEGREE * by * dvec2(shrink, 1.0);
        Some(if degrees { metres } else { by })
    };
    let mut ring: Vec<DVec2> = ring
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(place)
        .collect();
    if ring.len() > 1 && ring[0] == ring[ring.len() - 1] {
        ring.pop();
    }
    ring
}

fn area(ring: &[DVec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    (ring
        .iter()
        .zip(next)
        .map(|(p, q)| p.perp_dot(*q))
        .sum::<f64>()
        / 2.0)
        .abs()
}

/// The area in plan of a roof's covering and its height over the plate, in sum over the area: without eaves the
/// first is the area of the walls.
fn covered(roof: &Roof) -> f64 {
    let faces = roof
        .solids
        .iter()
        .flat_map(|s| s.faces.iter().map(move |f| (s, f)));
    let tops = faces.filter(|(_, f)| matches!(f.finish, Finish::Covering(_)));
    tops.map(|(s, f)| {
        let ring: Vec<DVec2> = f
            .corners
            .iter()
            .map(|c| s.points[*c as usize].truncate())
            .collect();
        area(&ring)
    })
    .sum()
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_outlines_all_get_a_whole_roof() {
    let maps = maps();
    assert!(!maps.is_empty(), "there are no maps in ../shared/data");
    let style = Default::default();
    let look = Look::gable(None, &style, 6.0, 0.909);
    let bare = Look { eaves: 0.0, ..look };
    let (mut all, mut roofed, mut refused, mut findings) = (0, 0, vec![], vec![]);
    for map in &maps {
        let plans = plans(map);
        let before = roofed;
        for plan in &plans {
            let (outline, courts, name) = (&plan.outline, &plan.courts, &plan.name);
            let roof = match over(outline, courts, 3.0, &look) {
                Ok(roof) => roof,
                Err(why) => {
                    refused.push(format!("{name}: {why}"));
                    continue;
                }
            };
            roofed += 1;
            for solid in &roof.solids {
                findings.extend(solid_flaws(solid).map(|flaw| format!("{name}: {flaw:?}")));
            }
            let whole = area(outline) - courts.iter().map(|c| area(c)).sum::<f64>();
            let cover = over(outline, courts, 3.0, &bare).map_or(0.0, |r| covered(&r));
            if (cover - whole).abs() > 1e-3 * whole.max(1.0) {
                findings.push(format!("{name}: covers {cover:.4} of {whole:.4} m2"));
            }
            let wide = covered(&roof);
            if wide < 0.999 * whole {
                findings.push(format!("{name}: eaves take {wide:.4} from {whole:.4} m2"));
            }
        }
        all += plans.len();
        eprintln!("{} of {} {}", roofed - before, plans.len(), map.display());
    }
    eprintln!(
        "{roofed} of {all} outlines have a roof; the others:\n{}",
        refused.join("\n")
    );
    assert_none(&findings);
    assert!(all > 6000, "{all}");
    assert!(1000 * roofed >= 995 * all, "{roofed} of {all}");
}
