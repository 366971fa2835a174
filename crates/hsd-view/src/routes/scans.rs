//! The pictures that a house was read from.

use super::{ApiError, ApiResult, Shared, work};
use crate::{model_file, scan};
use axum::extract::{Query, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;

/// A sheet of a house, by its number in the file beside it.
#[derive(Deserialize)]
pub(super) struct SheetQuery {
    file: String,
    sheet: usize,
}

/// Returns the picture of a sheet.
pub(super) async fn picture(
    State(workspace): Shared,
    Query(of): Query<SheetQuery>,
) -> ApiResult<Response> {
    let read = work(&workspace, move |workspace| {
        let document = workspace.document(&of.file)?;
        let house = workspace.path(&document.file)?;
        let missing = || ApiError(StatusCode::NOT_FOUND, "no such picture".to_owned());
        scan::picture(&house, of.sheet).ok_or_else(missing)
    });
    let bytes = read.await?;
    let kind = model_file::kind(&bytes).unwrap_or("application/octet-stream");
    Ok(([(header::CONTENT_TYPE, kind)], bytes).into_response())
}
