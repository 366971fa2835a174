//! Access control: only the page itself is served. Other pages in the browser can send requests too, and their host names
//! can resolve to loopback (DNS rebinding); both are recognized by their headers and rejected. Local programs can set any
//! header and are not kept out.

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// The content security policy of the page: only its own files, and WebAssembly for decoding models.
const PAGE: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' blob: data:; \
    connect-src 'self' blob:; worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The content security policy of the texture decoding workers: `eval`, and nothing else.
const WORKER: &str = "default-src 'none'; script-src 'unsafe-eval'";

/// Returns the content security policy of a file of the page.
pub(super) fn allowed(name: &str) -> &'static str {
    if name == "unpack.js" { WORKER } else { PAGE }
}

/// Security headers of all responses.
const HEADERS: [(HeaderName, &str); 5] = [
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::X_FRAME_OPTIONS, "DENY"),
    (header::REFERRER_POLICY, "no-referrer"),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        "same-origin",
    ),
    (
        HeaderName::from_static("cross-origin-opener-policy"),
        "same-origin",
    ),
];

/// Middleware that rejects requests of other pages.
pub(super) async fn guard(State(port): State<u16>, request: Request, next: Next) -> Response {
    let mut response = match refusal(request.method(), request.headers(), port) {
        Some(why) => (StatusCode::FORBIDDEN, why).into_response(),
        None => next.run(request).await,
    };
    let headers = response.headers_mut();
    for (name, value) in HEADERS {
        headers.insert(name, HeaderValue::from_static(value));
    }
    headers
        .entry(header::CONTENT_SECURITY_POLICY)
        .or_insert(HeaderValue::from_static(PAGE));
    headers
        .entry(header::CACHE_CONTROL)
        .or_insert(HeaderValue::from_static("no-store"));
    response
}

/// Returns the reason why a request is rejected; `None` if it comes from the page, or is a read by a local program.
fn refusal(method: &Method, headers: &HeaderMap, port: u16) -> Option<&'static str> {
    let names = ["127.0.0.1", "localhost", "[::1]"];
    let own = |host: &str| names.iter().any(|n| host == format!("{n}:{port}"));
    let word = |name| {
        headers
            .get(name)
            .and_then(|v: &HeaderValue| v.to_str().ok())
    };
    if headers.get_all(header::HOST).iter().count() != 1 || !word(header::HOST).is_some_and(own) {
        return Some("this server accepts requests to 127.0.0.1 and localhost only");
    }
    let origin = headers.get(header::ORIGIN).map(HeaderValue::to_str);
    let same = |o: &str| o.strip_prefix("http://").is_some_and(own);
    match origin {
        Some(Ok(origin)) if same(origin) => None,
        Some(_) => Some("this server accepts requests of its own page only"),
        None if method == Method::GET || method == Method::HEAD => {
            let foreign = ["cross-site", "same-site"];
            // Other sites may link to the page, but not request its data.
            let site = word(HeaderName::from_static("sec-fetch-site")).unwrap_or_default();
            let mode = word(HeaderName::from_static("sec-fetch-mode")).unwrap_or_default();
            (foreign.contains(&site) && mode != "navigate")
                .then_some("this server accepts requests of its own page only")
        }
        None => Some("requests that change something need an Origin header"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(method: Method, headers: &[(&'static str, &'static str)]) -> bool {
        let pairs = headers.iter().map(|(name, value)| {
            let name = HeaderName::from_static(name);
            (name, HeaderValue::from_static(value))
        });
        refusal(&method, &pairs.collect(), 4000).is_none()
    }

    #[test]
    fn only_the_page_itself_is_served() {
        let own = ("host", "127.0.0.1:4000");
        let good: [&[_]; 5] = [
            &[own],
            &[("host", "localhost:4000")],
            &[("host", "[::1]:4000")],
            &[own, ("origin", "http://127.0.0.1:4000")],
            &[
                own,
                ("sec-fetch-site", "cross-site"),
                ("sec-fetch-mode", "navigate"),
            ],
        ];
        for headers in good {
            assert!(asked(Method::GET, headers), "{headers:?}");
        }
        let bad: [&[_]; 8] = [
            &[],
            &[("host", "127.0.0.1")],
            &[("host", "127.0.0.1:4001")],
            &[("host", "evil.example:4000")],
            &[("host", "127.0.0.1.evil.example:4000")],
            &[own, ("origin", "http://evil.example")],
            &[own, ("origin", "null")],
            &[
                own,
                ("sec-fetch-site", "cross-site"),
                ("sec-fetch-mode", "no-cors"),
            ],
        ];
        for headers in bad {
            assert!(!asked(Method::GET, headers), "{headers:?}");
        }
        assert!(!asked(Method::POST, &[own]));
        assert!(!asked(
            Method::POST,
            &[own, ("origin", "https://127.0.0.1:4000")]
        ));
        assert!(asked(
            Method::POST,
            &[own, ("origin", "http://localhost:4000")]
        ));
    }
}
