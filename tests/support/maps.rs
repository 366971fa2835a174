//! The outlines of maps: files of GeoJSON, beside the repository or in a folder of one's own.

use super::root;
use glam::{DVec2, dvec2};
use serde_json::Value;
use std::path::{Path, PathBuf};

const METRES_PER_DEGREE: f64 = 111_320.0;

/// The folder of the data beside the repository, or beside the folder that holds its worktrees.
pub fn data() -> PathBuf {
    let beside = root().join("../shared/data");
    match beside.is_dir() {
        true => beside,
        false => root().join("../../shared/data"),
    }
}

/// The maps of the folders in `../shared/data`.
pub fn maps() -> Vec<PathBuf> {
    list(&data())
        .into_iter()
        .flat_map(|set| maps_in(&set))
        .collect()
}

/// The maps of a folder.
pub fn maps_in(folder: &Path) -> Vec<PathBuf> {
    let files = list(folder).into_iter();
    files
        .filter(|f| f.extension().is_some_and(|e| e == "geojson"))
        .collect()
}

fn list(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|e| e.path()).collect();
    paths.sort();
    paths
}

/// An outline with its courts, in metres.
pub struct Plan {
    pub name: String,
    pub outline: Vec<DVec2>,
    pub courts: Vec<Vec<DVec2>>,
    /// The properties of its feature: the tags of OpenStreetMap.
    pub tags: Value,
}

impl Plan {
    /// A tag, if it has it.
    pub fn tag(&self, name: &str) -> Option<&str> {
        self.tags[name].as_str()
    }
}

/// All polygons of a map, in metres round the first corner of each.
pub fn plans(map: &Path) -> Vec<Plan> {
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
                tags: feature["properties"].clone(),
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
