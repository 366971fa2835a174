//! A town as CityJSON: the houses of one tile after another, each with its levels of detail.

use super::input::{TileSalt, evaluate};
use super::make::lost_houses;
use super::mesh::tiles;
use super::run::TileJob;
use super::{piece, terrain};
use crate::Plan;
use crate::decision::problems;
use crate::stream::Ledger;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::Source;
use hsd_driver::TileDriver;
use hsd_export::cityjson::{City, CityHouse};
use hsd_export::flat::places;
use hsd_export::gltf::FeatureRow;
use hsd_export::names::Names;
use hsd_ir::ast::CodeText;
use hsd_ir::building::Built;
use hsd_scene::Detail;
use serde_json::{Map, Value};
use std::io;

/// Receives objects of a city.
type Take<'t> = dyn FnMut(CityHouse) -> io::Result<()> + 't;

/// Returns the head of a town's city.
pub fn city(plan: &Plan) -> City {
    let name = &plan.frame.crs.name;
    City {
        epsg: name.strip_prefix("EPSG:").map(str::to_owned),
        origin: plan.frame.origin,
    }
}

/// Makes the houses of a town; with openings if `openings`, else walls and roofs only. `take` gets each;
/// `progress` is called with the number of features of each tile.
///
/// # Errors
/// Those of `take`, and the one that ended the houses.
pub fn houses(
    job: TileJob<'_>,
    openings: bool,
    (take, progress): (&mut Take<'_>, &dyn Fn(usize)),
    out: &mut Diagnostics,
) -> io::Result<(Ledger, Vec<Source>)> {
    let levels: &[(&str, Detail)] = match openings {
        true => &[("2", Detail::Body), ("3", Detail::Openings)],
        false => &[("2", Detail::Body)],
    };
    let details: Vec<Detail> = levels.iter().map(|(_, detail)| *detail).collect();
    let (input, options) = (job.input, job.input.options);
    let driver = TileDriver::new(input.source, job.catalog, (input.world, options), &details);
    let salt = TileSalt::new(input, (&details, false), (job.parts, job.written));
    let mut ledger = Ledger::new(job.spool)?;
    let scope = job.catalog.known_in(0, 0);
    let opening = |code: &str| {
        let part = job.catalog.find_in(scope, &CodeText::new(code))?;
        job.catalog.part(part).opening()
    };
    // Objects of a city are told apart by their names; features of one key have the same.
    let mut unique = Names::default();
    for tile in tiles(job.plan, job.division) {
        let mut input = evaluate(&tile, (job.plan, job.input), job.year, &salt)?;
        let houses = std::mem::take(&mut input.houses);
        let names: Vec<String> = houses
            .iter()
            .map(|house| unique.unique(&house.name))
            .collect();
        let mut found = Diagnostics::new();
        let made = driver.houses(houses, &mut found)?;
        let mut all: Vec<Option<CityHouse>> = made
            .built()
            .zip(names)
            .zip(&input.row_of)
            .map(|((built, name), row)| {
                built.map(|built| begun(name, &input.rows[*row as usize], built))
            })
            .collect();
        let mut missing = vec![];
        for (lod, detail) in levels {
            let level = driver.level(&made, *detail, &mut found);
            missing.push(level.left_out);
            let places = places(level.scene.whole());
            for (house, nodes) in all.iter_mut().zip(&level.houses) {
                if let Some(house) = house {
                    house.level(lod, (&level.scene, &places), nodes.clone(), &opening);
                }
            }
        }
        ledger.add_without(input.chunk, &lost_houses(&made.left_out, &missing))?;
        ledger.report.corrected.extend(problems(&found));
        out.append(found);
        all.into_iter().flatten().try_for_each(&mut *take)?;
        progress(tile.features());
    }
    grounds(job, details[details.len() - 1], &mut unique, take)?;
    ledger.finish(job.plan, out)
}

/// Makes the ground of a town.
fn grounds(
    job: TileJob<'_>,
    detail: Detail,
    unique: &mut Names,
    take: &mut Take<'_>,
) -> io::Result<()> {
    for (patch, mesh) in terrain::meshes(job.plan, detail)? {
        let known = attributes(&piece::row((job.plan, job.input.source), patch.cell));
        let id = unique.unique(&patch.name());
        let shape = (&*mesh.positions, &*mesh.indices);
        take(CityHouse::ground(id, known, shape))?;
    }
    Ok(())
}

/// Begins an object: a building, or what a rule made of a feature beside houses.
fn begun(name: String, row: &FeatureRow, built: &Built) -> CityHouse {
    let known = attributes(row);
    let outdoors = built.house.outdoors.as_deref();
    match object(outdoors.map_or(&*row.kind, |outdoors| outdoors.word)) {
        None => CityHouse::new(name, known, built),
        Some(class) => CityHouse::open(name, known, class),
    }
}

/// Returns the class of what a rule made of a feature, by its type; `None` for a building.
fn object(kind: &str) -> Option<&'static str> {
    Some(match kind {
        "road" => "Road",
        "rail" => "Railway",
        "tree" => "SolitaryVegetationObject",
        "hedge" => "PlantCover",
        "water" => "WaterBody",
        "farmland" => "LandUse",
        "fence" | "wall" | "pole" | "network" | "wire" | "signal" | "sign" | "arcade" | "torii"
        | "lantern" => "CityFurniture",
        "envelope" => "OtherConstruction",
        _ => return None,
    })
}

/// Returns what is known of a feature; what is not known is left out.
fn attributes(row: &FeatureRow) -> Map<String, Value> {
    let texts = [
        ("key", &row.key),
        ("layer", &row.layer),
        ("type", &row.kind),
        ("year", &row.year),
        ("evidence", &row.evidence),
        ("parameters", &row.parameters),
    ];
    let texts = texts.into_iter().filter(|(_, text)| !text.is_empty());
    let mut all: Map<String, Value> = texts
        .map(|(name, text)| (name.to_owned(), Value::from(text.as_str())))
        .collect();
    all.insert("rule".into(), row.rule.into());
    all.insert("line".into(), row.line.into());
    all
}
