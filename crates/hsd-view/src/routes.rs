//! The API of the page. Requests are handled on blocking threads.

mod fronts;
mod scans;
mod towns;

use super::locked::lock;
use super::screenshots::{self, Screenshot};
use super::snapshot::Snapshot;
use super::snapshot::parameters::Given;
use super::town::TownProgress;
use super::workspace::{Document, FileEntry, TEXT, Update, Viewer, Workspace};
use super::{guard, model_file, page};
use axum::Router;
use axum::extract::{DefaultBodyLimit, Path, Query, State};
use axum::http::{StatusCode, header};
use axum::middleware;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Json, Response};
use axum::routing::{get, post};
use hsd_base::diagnostic::{Language, Text};
use hsd_ide::card::part_picture;
use hsd_ide::stroke::Stroke;
use hsd_ir::catalog::PartDef;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::convert::Infallible;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use tokio_stream::wrappers::BroadcastStream;
use tokio_stream::wrappers::errors::BroadcastStreamRecvError;
use tokio_stream::{Stream, StreamExt};

/// The maximum size of a request, in bytes: a stroke, or the list of houses that a page of a large town has.
const REQUEST: usize = 8 << 20;

/// The media type of `.glb`.
const GLB: &str = "model/gltf-binary";

type Shared = State<Arc<Workspace>>;

/// Returns all routes, for a server on `port`.
pub(super) fn routes(
    workspace: Arc<Workspace>,
    port: u16,
    screenshots: Option<Sender<Screenshot>>,
) -> Router {
    Router::new()
        .route("/", get(async || asset("index.html")))
        .route(
            "/{name}",
            get(async |Path(name): Path<String>| asset(&name)),
        )
        .route("/api/hello", get(hello))
        .route("/api/state", get(state))
        .route("/api/model/{revision}/house.glb", get(model))
        .route("/api/model/{revision}/{*name}", get(picture))
        .route("/api/scan", get(scans::picture))
        .route("/api/front", get(fronts::about))
        .route("/api/front/photo", get(fronts::photo))
        .route("/api/front/straight", post(fronts::straight))
        .route("/api/front/build", post(fronts::build))
        .route("/api/houses", post(houses))
        .route("/api/town/{id}/files/{*name}", get(towns::file))
        .route("/api/town/{id}/feature", get(towns::feature))
        .route("/api/town/{id}/face", get(towns::face))
        .route("/api/town/{id}/skipped", get(towns::skipped))
        .route("/api/town/{id}/place", get(towns::place))
        .route("/api/town/{id}/keep", post(towns::keep))
        .route("/api/town/{id}/difference", get(towns::difference))
        .route("/api/events", get(events))
        .route("/api/parts", get(parts))
        .route("/api/part", get(part))
        .route("/api/parameters", post(set_parameters))
        .route("/api/open", post(open))
        .route("/api/stroke", post(stroke))
        .route("/api/undo", post(undo))
        .route("/api/redo", post(redo))
        .merge(screenshots::routes(screenshots))
        .layer(DefaultBodyLimit::max(REQUEST))
        .layer(middleware::from_fn_with_state(port, guard::guard))
        .with_state(workspace)
}

/// An error response and its reason.
struct ApiError(StatusCode, String);

impl IntoResponse for ApiError {
    fn into_response(self) -> Response {
        (self.0, self.1).into_response()
    }
}

impl From<io::Error> for ApiError {
    fn from(error: io::Error) -> ApiError {
        let status = match error.kind() {
            io::ErrorKind::NotFound => StatusCode::NOT_FOUND,
            _ => StatusCode::INTERNAL_SERVER_ERROR,
        };
        ApiError(status, error.to_string())
    }
}

type ApiResult<T> = Result<T, ApiError>;

/// Runs a task on a blocking thread.
async fn work<T: Send + 'static>(
    workspace: &Arc<Workspace>,
    task: impl FnOnce(&Workspace) -> ApiResult<T> + Send + 'static,
) -> ApiResult<T> {
    let workspace = workspace.clone();
    let done = tokio::task::spawn_blocking(move || task(&workspace)).await;
    done.unwrap_or_else(|_| {
        let fault = "internal error".to_owned();
        Err(ApiError(StatusCode::INTERNAL_SERVER_ERROR, fault))
    })
}

fn asset(name: &str) -> Response {
    let Some((kind, bytes)) = page::file(name) else {
        return StatusCode::NOT_FOUND.into_response();
    };
    let headers = [
        (header::CONTENT_TYPE, kind),
        (header::CONTENT_ENCODING, "gzip"),
        (header::CONTENT_SECURITY_POLICY, guard::allowed(name)),
    ];
    (headers, bytes).into_response()
}

/// `Hello` in `view/src/server/api.ts`.
#[derive(Serialize)]
struct Hello {
    version: &'static str,
    language: &'static str,
    root: String,
    files: Vec<FileEntry>,
    file: Option<String>,
    writes: bool,
    opens: bool,
    front: bool,
}

async fn hello(State(workspace): Shared) -> ApiResult<Json<Hello>> {
    let hello = work(&workspace, |workspace| {
        let files = workspace.files();
        let first = files.iter().find(|f| f.kind == TEXT).or(files.first());
        let name = workspace.root.file_name().unwrap_or_default();
        Ok(Hello {
            version: env!("CARGO_PKG_VERSION"),
            language: match workspace.language {
                Language::English => "en",
                Language::Japanese => "ja",
            },
            root: name.to_string_lossy().into_owned(),
            file: first.map(|f| f.path.clone()),
            files,
            writes: workspace.host.writes(),
            opens: workspace.host.opens(),
            front: workspace.front.is_some(),
        })
    });
    hello.await.map(Json)
}

#[derive(Deserialize)]
struct FileQuery {
    file: String,
}

/// Returns the current snapshot of a file.
async fn snapshot(
    workspace: &Arc<Workspace>,
    FileQuery { file }: FileQuery,
) -> ApiResult<Arc<Snapshot>> {
    work(workspace, move |workspace| {
        Ok(workspace.snapshot(&*workspace.document(&file)?)?)
    })
    .await
}

/// Returns the snapshot of a file if it still has the requested revision.
async fn snapshot_at(
    workspace: &Arc<Workspace>,
    of: FileQuery,
    revision: u64,
) -> ApiResult<Arc<Snapshot>> {
    let snapshot = snapshot(workspace, of).await?;
    match snapshot.revision == revision {
        true => Ok(snapshot),
        false => Err(ApiError(
            StatusCode::GONE,
            "there is a newer revision".to_owned(),
        )),
    }
}

async fn state(State(workspace): Shared, Query(of): Query<FileQuery>) -> ApiResult<Response> {
    let snapshot = snapshot(&workspace, of).await?;
    let kind = [(header::CONTENT_TYPE, "application/json")];
    Ok((kind, snapshot.state.clone()).into_response())
}

async fn model(
    State(workspace): Shared,
    Path(revision): Path<u64>,
    Query(of): Query<FileQuery>,
) -> ApiResult<Response> {
    let snapshot = snapshot_at(&workspace, of, revision).await?;
    let bytes = work(&workspace, move |_| Ok(snapshot.whole())).await?;
    Ok(([(header::CONTENT_TYPE, GLB)], bytes).into_response())
}

/// A request for the houses that a page does not have yet; `had` holds the keys of those it has.
#[derive(Deserialize)]
struct HousesRequest {
    file: String,
    revision: u64,
    had: Vec<String>,
}

/// Returns the houses that a page does not have, or the whole model if it has none; the media type tells which.
async fn houses(State(workspace): Shared, Json(asks): Json<HousesRequest>) -> ApiResult<Response> {
    let HousesRequest {
        file,
        revision,
        had,
    } = asks;
    let snapshot = snapshot_at(&workspace, FileQuery { file }, revision).await?;
    let answer = work(&workspace, move |_| {
        Ok(match snapshot.others(&had) {
            Some(others) => ("application/octet-stream", others),
            None => (GLB, snapshot.whole()),
        })
    });
    let (kind, bytes) = answer.await?;
    Ok(([(header::CONTENT_TYPE, kind)], bytes).into_response())
}

/// Returns an external texture of a model. The URI has no query, so the texture is searched in all documents with this
/// revision.
async fn picture(
    State(workspace): Shared,
    Path((revision, name)): Path<(u64, String)>,
) -> ApiResult<Response> {
    let found = work(&workspace, move |workspace| {
        Ok(workspace.picture(revision, &name))
    });
    let Some(bytes) = found.await? else {
        return Err(ApiError(
            StatusCode::NOT_FOUND,
            "no such texture".to_owned(),
        ));
    };
    let kind = model_file::kind(&bytes).unwrap_or("application/octet-stream");
    Ok(([(header::CONTENT_TYPE, kind)], bytes).into_response())
}

/// Returns the parts of the palette, in the order of the catalogue.
async fn parts(State(workspace): Shared, Query(of): Query<FileQuery>) -> ApiResult<Response> {
    let snapshot = snapshot(&workspace, of).await?;
    let catalog = &snapshot.catalog;
    let known = catalog.known(catalog.known_in(0, 0)).into_iter();
    let list: Vec<&PartDef> = known.map(|id| catalog.part(id)).collect();
    Ok(Json(list).into_response())
}

#[derive(Deserialize)]
struct PartQuery {
    file: String,
    code: String,
}

/// Returns an image of a part.
async fn part(State(workspace): Shared, Query(of): Query<PartQuery>) -> ApiResult<Response> {
    let drawn = work(&workspace, move |workspace| {
        let snapshot = workspace.snapshot(&*workspace.document(&of.file)?)?;
        let parts = snapshot.catalog.parts().iter();
        // The last definition of a code overrides the others.
        let part = parts.rev().find(|p| p.code() == of.code);
        Ok(part.and_then(part_picture))
    });
    let Some(picture) = drawn.await? else {
        return Err(ApiError(
            StatusCode::NOT_FOUND,
            "the part is invisible".to_owned(),
        ));
    };
    Ok(([(header::CONTENT_TYPE, "image/jpeg")], picture.to_vec()).into_response())
}

/// The parameters of a file that a page sets; those it leaves out have the values of the text.
#[derive(Deserialize)]
struct ParametersRequest {
    file: String,
    values: Given,
}

async fn set_parameters(
    State(workspace): Shared,
    Json(asks): Json<ParametersRequest>,
) -> ApiResult<Response> {
    let ParametersRequest { file, values } = asks;
    let set = work(&workspace, move |workspace| {
        Ok(workspace.set_parameters(&*workspace.document(&file)?, values)?)
    });
    set.await?;
    Ok(Json(json!({})).into_response())
}

/// Streams updates of a file to a page.
async fn events(
    State(workspace): Shared,
    Query(FileQuery { file }): Query<FileQuery>,
) -> ApiResult<Response> {
    let viewing = work(&workspace, move |workspace| {
        let document = workspace.document(&file)?;
        let (viewer, updates) = workspace.add_viewer(&document);
        // Before the state, which may start the build: what follows comes as updates.
        let town = *lock(&document.town.progress);
        // Sends the current state first, so that no update is missed.
        let now = workspace
            .snapshot(&document)
            .ok()
            .map(|snapshot| snapshot.revision);
        Ok((document, viewer, updates, (now, town)))
    });
    let (document, viewer, updates, (now, town)) = viewing.await?;
    let updates = BroadcastStream::new(updates);
    let first = now.map(state_event).into_iter();
    let first = tokio_stream::iter(first.chain(town.map(town_event)));
    let events = first
        .chain(update_events(document, viewer, updates))
        .map(Ok::<_, Infallible>);
    Ok(Sse::new(events)
        .keep_alive(KeepAlive::default())
        .into_response())
}

/// Returns the events for a page that shows a document.
fn update_events(
    document: Arc<Document>,
    viewer: Viewer,
    updates: impl Stream<Item = Result<Update, BroadcastStreamRecvError>>,
) -> impl Stream<Item = Event> {
    updates.filter_map(move |update| {
        let _viewing = &viewer;
        match update {
            Ok(Update::State { file, revision }) => {
                (*file == *document.file).then(|| state_event(revision))
            }
            Ok(Update::Cursor { file, place }) => {
                let data = serde_json::to_string(&place).unwrap_or_default();
                (*file == *document.file).then(|| Event::default().event("cursor").data(data))
            }
            Ok(Update::Town { file, progress }) => {
                (*file == *document.file).then(|| town_event(progress))
            }
            Ok(Update::Files) => Some(Event::default().event("files").data("{}")),
            // The page missed updates; only the newest matters.
            Err(BroadcastStreamRecvError::Lagged(_)) => document
                .last()
                .map(|snapshot| state_event(snapshot.revision)),
        }
    })
}

fn town_event(progress: TownProgress) -> Event {
    let data = serde_json::to_string(&progress).unwrap_or_default();
    Event::default().event("town").data(data)
}

fn state_event(revision: u64) -> Event {
    let data = json!({ "revision": revision }).to_string();
    Event::default().event("state").data(data)
}

/// A location to open in the editor.
#[derive(Deserialize)]
struct Location {
    file: String,
    #[serde(default)]
    id: u32,
    span: [u32; 2],
}

async fn open(State(workspace): Shared, Json(place): Json<Location>) -> ApiResult<Json<Value>> {
    let opened = work(&workspace, move |workspace| {
        let document = workspace.document(&place.file)?;
        workspace.open(&document, place.id, place.span)?;
        Ok(json!({}))
    });
    opened.await.map(Json)
}

/// A stroke drawn on the plan of a revision.
#[derive(Deserialize)]
struct StrokeRequest {
    file: String,
    revision: u64,
    stroke: Stroke,
}

async fn stroke(
    State(workspace): Shared,
    Json(drawn): Json<StrokeRequest>,
) -> ApiResult<Json<Value>> {
    let done = work(&workspace, move |workspace| {
        let document = workspace.document(&drawn.file)?;
        match workspace.stroke(&document, drawn.revision, &drawn.stroke)? {
            Ok(revision) => Ok(json!({ "revision": revision })),
            Err(why) => Ok(refusal(workspace, &why)),
        }
    });
    done.await.map(Json)
}

#[derive(Deserialize)]
struct StepRequest {
    file: String,
}

async fn undo(State(workspace): Shared, Json(step): Json<StepRequest>) -> ApiResult<Json<Value>> {
    take_step(&workspace, step, false).await
}

async fn redo(State(workspace): Shared, Json(step): Json<StepRequest>) -> ApiResult<Json<Value>> {
    take_step(&workspace, step, true).await
}

async fn take_step(
    workspace: &Arc<Workspace>,
    step: StepRequest,
    redo: bool,
) -> ApiResult<Json<Value>> {
    let done = work(workspace, move |workspace| {
        let document = workspace.document(&step.file)?;
        match workspace.step(&document, redo)? {
            Ok(revision) => Ok(json!({ "revision": revision })),
            Err(why) => Ok(refusal(workspace, &why)),
        }
    });
    done.await.map(Json)
}

fn refusal(workspace: &Workspace, why: &Text) -> Value {
    json!({ "refused": why.in_language(workspace.language) })
}
