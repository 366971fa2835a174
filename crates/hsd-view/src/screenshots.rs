//! Receives the images that the page renders for documents. The routes exist only for `hsd render`.

use super::workspace::Workspace;
use axum::Router;
use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, Query};
use axum::http::StatusCode;
use axum::response::Json;
use axum::routing::post;
use serde::Deserialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// The maximum size of an image in bytes.
const PICTURE: usize = 256 << 20;

/// A message of a page that renders images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Screenshot {
    /// An image of a view, as PNG.
    Picture {
        /// The name of the view, as requested.
        view: String,
        /// The contents of the file.
        png: Vec<u8>,
    },
    /// The page has finished, with these errors.
    Done(Vec<String>),
}

#[derive(Deserialize)]
struct ViewQuery {
    view: String,
}

#[derive(Deserialize)]
struct Rendered {
    errors: Vec<String>,
}

/// Returns the routes that forward images to `sink`.
pub(super) fn routes(sink: Option<Sender<Screenshot>>) -> Router<Arc<Workspace>> {
    let Some(sink) = sink else {
        return Router::new();
    };
    let done_sink = sink.clone();
    let picture = async move |Query(ViewQuery { view }): Query<ViewQuery>, png: Bytes| {
        let png = png.to_vec();
        forward(&sink, Screenshot::Picture { view, png })
    };
    let rendered = async move |Json(Rendered { errors }): Json<Rendered>| {
        forward(&done_sink, Screenshot::Done(errors))
    };
    Router::new()
        .route("/api/picture", post(picture))
        .layer(DefaultBodyLimit::max(PICTURE))
        .route("/api/rendered", post(rendered))
}

fn forward(sink: &Sender<Screenshot>, screenshot: Screenshot) -> Result<Json<Value>, StatusCode> {
    match sink.send(screenshot) {
        Ok(()) => Ok(Json(json!({}))),
        Err(_) => Err(StatusCode::GONE),
    }
}
