//! What the page asks for. Every answer is worked out on a thread that may take its time.

use super::hall::{Eye, Hall, Listed, News, Room, TEXT};
use super::made::Made;
use super::studio::{self, Still};
use super::{beside, guard, page};
use crate::catalog::PartDef;
use crate::diagnostic::{Language, Text};
use crate::ide::card::part_picture;
use crate::ide::stroke::Stroke;
use axum::Router;
use axum::extract::{DefaultBodyLimit, Path, Query, State};
use axum::http::{StatusCode, header};
use axum::middleware;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Json, Response};
use axum::routing::{get, post};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::convert::Infallible;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use tokio_stream::wrappers::BroadcastStream;
use tokio_stream::wrappers::errors::BroadcastStreamRecvError;
use tokio_stream::{Stream, StreamExt};

/// The largest picture that `hsd render` takes from the page, bytes.
const PICTURE: usize = 256 << 20;

/// The kind of a `.glb`.
const GLB: &str = "model/gltf-binary";

type Shared = State<Arc<Hall>>;

/// All that is answered, on a port of this machine.
pub(super) fn routes(hall: Arc<Hall>, port: u16, stills: Option<Sender<Still>>) -> Router {
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
        .route("/api/houses", post(houses))
        .route("/api/events", get(events))
        .route("/api/parts", get(parts))
        .route("/api/part", get(part))
        .route("/api/open", post(open))
        .route("/api/stroke", post(stroke))
        .route("/api/undo", post(undo))
        .route("/api/redo", post(redo))
        .merge(studio::routes(stills))
        .layer(DefaultBodyLimit::max(PICTURE))
        .layer(middleware::from_fn_with_state(port, guard::guard))
        .with_state(hall)
}

/// A refusal and its reason.
struct Refused(StatusCode, String);

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        (self.0, self.1).into_response()
    }
}

impl From<io::Error> for Refused {
    fn from(error: io::Error) -> Refused {
        let status = match error.kind() {
            io::ErrorKind::NotFound => StatusCode::NOT_FOUND,
            _ => StatusCode::INTERNAL_SERVER_ERROR,
        };
        Refused(status, error.to_string())
    }
}

type Answer<T> = Result<T, Refused>;

/// Works on a thread of its own.
async fn work<T: Send + 'static>(
    hall: &Arc<Hall>,
    task: impl FnOnce(&Hall) -> Answer<T> + Send + 'static,
) -> Answer<T> {
    let hall = hall.clone();
    let done = tokio::task::spawn_blocking(move || task(&hall)).await;
    done.unwrap_or_else(|_| {
        let fault = "a fault of the program".to_owned();
        Err(Refused(StatusCode::INTERNAL_SERVER_ERROR, fault))
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
    files: Vec<Listed>,
    file: Option<String>,
    writes: bool,
    opens: bool,
}

async fn hello(State(hall): Shared) -> Answer<Json<Hello>> {
    let said = work(&hall, |hall| {
        let files = hall.files();
        let first = files.iter().find(|f| f.kind == TEXT).or(files.first());
        let name = hall.root.file_name().unwrap_or_default();
        Ok(Hello {
            version: env!("CARGO_PKG_VERSION"),
            language: match hall.language {
                Language::English => "en",
                Language::Japanese => "ja",
            },
            root: name.to_string_lossy().into_owned(),
            file: first.map(|f| f.path.clone()),
            files,
            writes: hall.desk.writes(),
            opens: hall.desk.opens(),
        })
    });
    said.await.map(Json)
}

#[derive(Deserialize)]
struct Of {
    file: String,
}

/// What a file makes now.
async fn made(hall: &Arc<Hall>, Of { file }: Of) -> Answer<Arc<Made>> {
    work(hall, move |hall| Ok(hall.made(&*hall.room(&file)?)?)).await
}

/// What a file makes, if it is still what the page asks for.
async fn made_at(hall: &Arc<Hall>, of: Of, revision: u64) -> Answer<Arc<Made>> {
    let made = made(hall, of).await?;
    match made.revision == revision {
        true => Ok(made),
        false => Err(Refused(StatusCode::GONE, "there is a newer one".to_owned())),
    }
}

async fn state(State(hall): Shared, Query(of): Query<Of>) -> Answer<Response> {
    let made = made(&hall, of).await?;
    let kind = [(header::CONTENT_TYPE, "application/json")];
    Ok((kind, made.state.clone()).into_response())
}

async fn model(
    State(hall): Shared,
    Path(revision): Path<u64>,
    Query(of): Query<Of>,
) -> Answer<Response> {
    let made = made_at(&hall, of, revision).await?;
    let bytes = work(&hall, move |_| Ok(made.whole())).await?;
    Ok(([(header::CONTENT_TYPE, GLB)], bytes).into_response())
}

/// A page that has houses of a revision before.
#[derive(Deserialize)]
struct Had {
    file: String,
    revision: u64,
    had: Vec<String>,
}

/// The houses that a page lacks, or the whole model where it has none of them: the kind of the answer says which.
async fn houses(State(hall): Shared, Json(asks): Json<Had>) -> Answer<Response> {
    let Had {
        file,
        revision,
        had,
    } = asks;
    let made = made_at(&hall, Of { file }, revision).await?;
    let answer = work(&hall, move |_| {
        Ok(match made.others(&had) {
            Some(others) => ("application/octet-stream", others),
            None => (GLB, made.whole()),
        })
    });
    let (kind, bytes) = answer.await?;
    Ok(([(header::CONTENT_TYPE, kind)], bytes).into_response())
}

/// A picture beside a model. The model names it without the query that it was fetched with, so any file of this revision
/// is meant.
async fn picture(
    State(hall): Shared,
    Path((revision, name)): Path<(u64, String)>,
) -> Answer<Response> {
    let found = work(&hall, move |hall| Ok(hall.picture(revision, &name)));
    let Some(bytes) = found.await? else {
        return Err(Refused(StatusCode::NOT_FOUND, "no such picture".to_owned()));
    };
    let kind = beside::kind(&bytes).unwrap_or("application/octet-stream");
    Ok(([(header::CONTENT_TYPE, kind)], bytes).into_response())
}

/// The parts that stand in the palette, in the order of the catalogue.
async fn parts(State(hall): Shared, Query(of): Query<Of>) -> Answer<Response> {
    let made = made(&hall, of).await?;
    let catalog = &made.catalog;
    let known = catalog.known(catalog.known_in(0, 0)).into_iter();
    let list: Vec<&PartDef> = known.map(|id| catalog.part(id)).collect();
    Ok(Json(list).into_response())
}

#[derive(Deserialize)]
struct OfPart {
    file: String,
    code: String,
}

/// What a part looks like.
async fn part(State(hall): Shared, Query(of): Query<OfPart>) -> Answer<Response> {
    let drawn = work(&hall, move |hall| {
        let made = hall.made(&*hall.room(&of.file)?)?;
        let parts = made.catalog.parts().iter();
        // Of several with one code the last is the one that counts.
        let part = parts.rev().find(|p| p.code() == of.code);
        Ok(part.and_then(part_picture))
    });
    let Some(picture) = drawn.await? else {
        return Err(Refused(StatusCode::NOT_FOUND, "nothing to see".to_owned()));
    };
    Ok(([(header::CONTENT_TYPE, "image/jpeg")], picture.to_vec()).into_response())
}

/// Keeps a page up with its file.
async fn events(State(hall): Shared, Query(Of { file }): Query<Of>) -> Answer<Response> {
    let looks = work(&hall, move |hall| {
        let room = hall.room(&file)?;
        let (eye, news) = hall.look(&room);
        // What there is now comes first, so that nothing is missed in between.
        let now = hall.made(&room).ok().map(|made| made.revision);
        Ok((room, eye, news, now))
    });
    let (room, eye, news, now) = looks.await?;
    let news = BroadcastStream::new(news);
    let first = tokio_stream::iter(now.map(state_event));
    let told = first.chain(told(room, eye, news)).map(Ok::<_, Infallible>);
    Ok(Sse::new(told)
        .keep_alive(KeepAlive::default())
        .into_response())
}

/// What a page that looks at a room hears.
fn told(
    room: Arc<Room>,
    eye: Eye,
    news: impl Stream<Item = Result<News, BroadcastStreamRecvError>>,
) -> impl Stream<Item = Event> {
    news.filter_map(move |news| {
        let _looks = &eye;
        match news {
            Ok(News::State { file, revision }) => {
                (*file == *room.file).then(|| state_event(revision))
            }
            Ok(News::Cursor { file, place }) => {
                let data = serde_json::to_string(&place).unwrap_or_default();
                (*file == *room.file).then(|| Event::default().event("cursor").data(data))
            }
            Ok(News::Files) => Some(Event::default().event("files").data("{}")),
            // The page was too slow to hear all; the newest is what counts.
            Err(BroadcastStreamRecvError::Lagged(_)) => {
                room.last().map(|made| state_event(made.revision))
            }
        }
    })
}

fn state_event(revision: u64) -> Event {
    let data = json!({ "revision": revision }).to_string();
    Event::default().event("state").data(data)
}

/// A place that the editor shall go to.
#[derive(Deserialize)]
struct Place {
    file: String,
    #[serde(default)]
    id: u16,
    span: [u32; 2],
}

async fn open(State(hall): Shared, Json(place): Json<Place>) -> Answer<Json<Value>> {
    let opened = work(&hall, move |hall| {
        let room = hall.room(&place.file)?;
        hall.open(&room, place.id, place.span)?;
        Ok(json!({}))
    });
    opened.await.map(Json)
}

/// Something drawn on the plan of a revision.
#[derive(Deserialize)]
struct Drawn {
    file: String,
    revision: u64,
    stroke: Stroke,
}

async fn stroke(State(hall): Shared, Json(drawn): Json<Drawn>) -> Answer<Json<Value>> {
    let done = work(&hall, move |hall| {
        let room = hall.room(&drawn.file)?;
        match hall.stroke(&room, drawn.revision, &drawn.stroke)? {
            Ok(revision) => Ok(json!({ "revision": revision })),
            Err(why) => Ok(refused(hall, &why)),
        }
    });
    done.await.map(Json)
}

#[derive(Deserialize)]
struct Step {
    file: String,
}

async fn undo(State(hall): Shared, Json(step): Json<Step>) -> Answer<Json<Value>> {
    take_step(&hall, step, false).await
}

async fn redo(State(hall): Shared, Json(step): Json<Step>) -> Answer<Json<Value>> {
    take_step(&hall, step, true).await
}

async fn take_step(hall: &Arc<Hall>, step: Step, redo: bool) -> Answer<Json<Value>> {
    let done = work(hall, move |hall| {
        let room = hall.room(&step.file)?;
        match hall.step(&room, redo)? {
            Ok(revision) => Ok(json!({ "revision": revision })),
            Err(why) => Ok(refused(hall, &why)),
        }
    });
    done.await.map(Json)
}

fn refused(hall: &Hall, why: &Text) -> Value {
    json!({ "refused": why.in_language(hall.language) })
}
