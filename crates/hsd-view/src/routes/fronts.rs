//! The photographs of a front.

use super::{ApiError, ApiResult, Shared, Workspace, work};
use crate::editor_host::FrontHost;
use axum::extract::{Query, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Json, Response};
use serde::Deserialize;
use serde_json::{Value, json};

/// The host of the photographs.
fn host(workspace: &Workspace) -> ApiResult<&dyn FrontHost> {
    let none = || ApiError(StatusCode::NOT_FOUND, "no photographs".to_owned());
    workspace.front.as_deref().ok_or_else(none)
}

/// What the host answers; a reason in words is no failure of the request.
fn answered(answer: Result<Value, String>) -> Value {
    answer.unwrap_or_else(|why| json!({ "refused": why }))
}

/// Returns what is known of the photographs.
pub(super) async fn about(State(workspace): Shared) -> ApiResult<Json<Value>> {
    let about = work(&workspace, |workspace| Ok(host(workspace)?.about()));
    about.await.map(Json)
}

/// A photograph, by its number.
#[derive(Deserialize)]
pub(super) struct PhotoQuery {
    number: usize,
}

/// Returns a photograph.
pub(super) async fn photo(
    State(workspace): Shared,
    Query(of): Query<PhotoQuery>,
) -> ApiResult<Response> {
    let read = work(&workspace, move |workspace| {
        let missing = || ApiError(StatusCode::NOT_FOUND, "no such photograph".to_owned());
        host(workspace)?.photo(of.number).ok_or_else(missing)
    });
    let kind = [(header::CONTENT_TYPE, "image/jpeg")];
    Ok((kind, read.await?).into_response())
}

/// Returns the wall of a photograph seen straight.
pub(super) async fn straight(
    State(workspace): Shared,
    Json(asked): Json<Value>,
) -> ApiResult<Json<Value>> {
    let seen = work(&workspace, move |workspace| {
        Ok(answered(host(workspace)?.straight(asked)))
    });
    seen.await.map(Json)
}

/// Writes the front.
pub(super) async fn build(
    State(workspace): Shared,
    Json(told): Json<Value>,
) -> ApiResult<Json<Value>> {
    let built = work(&workspace, move |workspace| {
        let built = answered(host(workspace)?.build(told));
        workspace.changed();
        Ok(built)
    });
    built.await.map(Json)
}
