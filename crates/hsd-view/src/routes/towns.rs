//! The files of towns in tiles, and what their tables tell.

use super::{ApiError, ApiResult, Shared, work};
use crate::model_file;
use crate::town::{BoundFace, Difference, SkippedList};
use axum::extract::{Path, Query, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Json, Response};
use glam::{dvec2, dvec3};
use hsd_map::{Crs, Datums, Transform};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs;
use std::path::{Component, Path as FilePath};

/// The extensions of the files of tiles.
const SERVED: [&str; 8] = ["json", "glb", "gltf", "bin", "png", "jpg", "jpeg", "ktx2"];

fn missing() -> ApiError {
    ApiError(StatusCode::NOT_FOUND, "no such file".to_owned())
}

/// Returns a file of a town in tiles.
pub(super) async fn file(
    State(workspace): Shared,
    Path((id, name)): Path<(u64, String)>,
) -> ApiResult<Response> {
    let read = work(&workspace, move |workspace| {
        let town = workspace.town(id).ok_or_else(missing)?;
        let folder = &town.tables.folder;
        let bytes = served(folder, &name).ok_or_else(missing)?;
        let is_json = FilePath::new(&name)
            .extension()
            .is_some_and(|e| e == "json");
        // Names of tiles that were built here are hashes of what is in them.
        let lasts = town.is_ours() && name.contains('/');
        Ok((bytes, is_json, lasts))
    });
    let (bytes, is_json, lasts) = read.await?;
    let kind = match is_json {
        true => "application/json",
        false => model_file::kind(&bytes).unwrap_or("application/octet-stream"),
    };
    let cache = match lasts {
        true => "private, max-age=86400, immutable",
        false => "no-store",
    };
    let headers = [(header::CONTENT_TYPE, kind), (header::CACHE_CONTROL, cache)];
    Ok((headers, bytes).into_response())
}

/// Reads a file below a folder; `None` if it is not there, lies elsewhere, or is of another kind.
fn served(folder: &FilePath, name: &str) -> Option<Vec<u8>> {
    let path = FilePath::new(name);
    let plain = path.components().all(|c| matches!(c, Component::Normal(_)));
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    if !plain || name.contains('\\') || !SERVED.contains(&&*ending) {
        return None;
    }
    let (root, real) = (
        folder.canonicalize().ok()?,
        folder.join(path).canonicalize().ok()?,
    );
    real.starts_with(root).then(|| fs::read(real).ok())?
}

/// A feature of a town.
#[derive(Deserialize)]
pub(super) struct FeatureQuery {
    #[serde(default)]
    layer: String,
    key: String,
}

/// Returns the line of a feature in the table of decisions; `null` if there is none.
pub(super) async fn feature(
    State(workspace): Shared,
    Path(id): Path<u64>,
    Query(of): Query<FeatureQuery>,
) -> ApiResult<Json<Option<Value>>> {
    let found = work(&workspace, move |workspace| {
        let town = workspace.town(id).ok_or_else(missing)?;
        Ok(town.tables.feature(&of.layer, &of.key)?)
    });
    found.await.map(Json)
}

/// A place of a feature, metres east, north and up in the town.
#[derive(Deserialize)]
pub(super) struct FaceQuery {
    layer: String,
    key: String,
    east: f64,
    north: f64,
    up: f64,
}

/// Returns what binds the envelope of a lot at a place; `null` if none has a face there.
pub(super) async fn face(
    State(workspace): Shared,
    Path(id): Path<u64>,
    Query(of): Query<FaceQuery>,
) -> ApiResult<Json<Option<BoundFace>>> {
    let found = work(&workspace, move |workspace| {
        let town = workspace.town(id).ok_or_else(missing)?;
        let at = dvec3(of.east, of.north, of.up);
        Ok(town.tables.face((&of.layer, &of.key), at)?)
    });
    found.await.map(Json)
}

/// Returns the skipped features of a town.
pub(super) async fn skipped(
    State(workspace): Shared,
    Path(id): Path<u64>,
) -> ApiResult<Json<SkippedList>> {
    let found = work(&workspace, move |workspace| {
        let town = workspace.town(id).ok_or_else(missing)?;
        Ok(town.tables.skipped()?)
    });
    found.await.map(Json)
}

/// Whether what is built now is kept.
#[derive(Deserialize)]
pub(super) struct KeepRequest {
    keep: bool,
}

/// Keeps a town as it is, so that the page compares with it what is built later.
pub(super) async fn keep(
    State(workspace): Shared,
    Path(id): Path<u64>,
    Json(KeepRequest { keep }): Json<KeepRequest>,
) -> ApiResult<Json<Value>> {
    let kept = work(&workspace, move |workspace| {
        workspace.numbered(id).ok_or_else(missing)?.town.keep(keep);
        Ok(())
    });
    kept.await?;
    Ok(Json(Value::Object(serde_json::Map::new())))
}

/// Returns what differs from the town that is kept; `null` if none is.
pub(super) async fn difference(
    State(workspace): Shared,
    Path(id): Path<u64>,
) -> ApiResult<Json<Option<Difference>>> {
    let found = work(&workspace, move |workspace| {
        let document = workspace.numbered(id).ok_or_else(missing)?;
        Ok(document.town.difference()?)
    });
    found.await.map(Json)
}

/// Metres east and north of a town's origin.
#[derive(Deserialize)]
pub(super) struct PlaceQuery {
    east: f64,
    north: f64,
}

/// A place in the system of a town's map: `MapPlace` in `view/src/server/api.ts`.
#[derive(Serialize)]
pub(super) struct MapPlace {
    /// `EPSG:6674`, or the name that the map gives.
    crs: Box<str>,
    /// East and north in it, metres.
    at: [f64; 2],
    /// Longitude and latitude, degrees; `None` where the system lies nowhere on the globe.
    degrees: Option<[f64; 2]>,
}

/// Returns a place in the system of a town's map; `null` for a town of which it is not known.
pub(super) async fn place(
    State(workspace): Shared,
    Path(id): Path<u64>,
    Query(of): Query<PlaceQuery>,
) -> ApiResult<Json<Option<MapPlace>>> {
    let found = work(&workspace, move |workspace| {
        let town = workspace.town(id).ok_or_else(missing)?;
        Ok(town.frame.as_ref().map(|frame| {
            let at = frame.origin + dvec2(of.east, of.north);
            let to_degrees = Transform::new(&frame.crs, &Crs::wgs84(), Datums::Exact).ok();
            let degrees = to_degrees.and_then(|t| t.apply(at));
            MapPlace {
                crs: frame.crs.name.clone(),
                at: at.into(),
                degrees: degrees.map(Into::into),
            }
        }))
    });
    found.await.map(Json)
}
