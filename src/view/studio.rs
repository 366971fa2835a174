//! Pictures for documents: the page draws them where nobody looks, and hands them over here. Without somebody who takes them
//! there are no such routes.

use super::hall::Hall;
use axum::Router;
use axum::body::Bytes;
use axum::extract::Query;
use axum::http::StatusCode;
use axum::response::Json;
use axum::routing::post;
use serde::Deserialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// What comes from a page that draws pictures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Still {
    /// A picture of a view, as PNG.
    Picture {
        /// Its name, as it was asked for.
        view: String,
        /// The bytes of the file.
        png: Vec<u8>,
    },
    /// It was the last one; what went wrong.
    Done(Vec<String>),
}

#[derive(Deserialize)]
struct Of {
    view: String,
}

#[derive(Deserialize)]
struct Rendered {
    errors: Vec<String>,
}

/// What the page may hand over to somebody who takes it.
pub(super) fn routes(taker: Option<Sender<Still>>) -> Router<Arc<Hall>> {
    let Some(taker) = taker else {
        return Router::new();
    };
    let others = taker.clone();
    let picture = async move |Query(Of { view }): Query<Of>, png: Bytes| {
        let png = png.to_vec();
        hand(&taker, Still::Picture { view, png })
    };
    let rendered =
        async move |Json(Rendered { errors }): Json<Rendered>| hand(&others, Still::Done(errors));
    Router::new()
        .route("/api/picture", post(picture))
        .route("/api/rendered", post(rendered))
}

fn hand(taker: &Sender<Still>, still: Still) -> Result<Json<Value>, StatusCode> {
    match taker.send(still) {
        Ok(()) => Ok(Json(json!({}))),
        Err(_) => Err(StatusCode::GONE),
    }
}
