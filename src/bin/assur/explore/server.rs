//! Who may ask: requests of this machine, with the token, and for a conversation only from a page of this server.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use axum::Router;
use axum::body::Body;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{FromRequestParts, Request, State};
use axum::http::{HeaderMap, HeaderName, Method, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::serve::ListenerExt;
use tokio::net::TcpListener;

use super::address::Address;
use super::start::Start;
use super::{assets, socket};

/// The longest path asked for, in bytes: the page's own are a tenth of it.
const LONGEST_PATH: usize = 512;
/// The largest message, in bytes: a model with room for a hundred legs. The page refuses larger files itself, with a sentence.
pub(crate) const LARGEST_MESSAGE: usize = 256 * 1024;
/// Conversations at once: more tabs than anybody keeps.
const MOST_SOCKETS: usize = 32;

/// Nothing from elsewhere is loaded, nothing is kept by the browser, and the address with its token is told to nobody.
const HEADERS: [(HeaderName, &str); 5] = [
    (
        header::CONTENT_SECURITY_POLICY,
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; \
         base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (header::REFERRER_POLICY, "no-referrer"),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::CACHE_CONTROL, "no-store"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
];

#[derive(Clone)]
struct Served {
    address: Address,
    start: Arc<Start>,
    sockets: Arc<AtomicUsize>,
}

pub(crate) async fn serve(listener: TcpListener, address: Address, start: Arc<Start>) -> std::io::Result<()> {
    let served = Served { address, start, sockets: Arc::default() };
    // Answers are small and waited for.
    let listener = listener.tap_io(|connection| {
        let _ = connection.set_nodelay(true);
    });
    axum::serve(listener, Router::new().fallback(answer).with_state(served)).await
}

async fn answer(State(served): State<Served>, request: Request) -> Response {
    let mut response = match admitted(&served, request).await {
        Ok(response) => response,
        Err((status, reason)) => {
            let (kind, text) = assets::refusal(reason);
            (status, [(header::CONTENT_TYPE, kind)], text).into_response()
        }
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(name, header::HeaderValue::from_static(value));
    }
    response
}

type Refused = (StatusCode, &'static str);

async fn admitted(served: &Served, request: Request) -> Result<Response, Refused> {
    let (mut parts, _) = request.into_parts();
    let host = text(&parts.headers, header::HOST).unwrap_or_default();
    if !served.address.is_host(host) {
        return Err((StatusCode::FORBIDDEN, "This server answers to 127.0.0.1 only."));
    }
    if parts.method != Method::GET {
        return Err((StatusCode::METHOD_NOT_ALLOWED, "Only GET."));
    }
    if parts.uri.path_and_query().is_some_and(|path| path.as_str().len() > LONGEST_PATH) {
        return Err((StatusCode::URI_TOO_LONG, "The address is too long."));
    }
    let has_body = text(&parts.headers, header::CONTENT_LENGTH).is_some_and(|length| length != "0")
        || parts.headers.contains_key(header::TRANSFER_ENCODING);
    if has_body {
        return Err((StatusCode::PAYLOAD_TOO_LARGE, "A request carries no body here."));
    }
    let path = parts.uri.path().to_owned();
    let Some(name) = served.address.inside(&path) else {
        return Err((
            StatusCode::FORBIDDEN,
            "The address lacks its token. Take the one that <code>assur explore</code> prints.",
        ));
    };
    if name != "socket" {
        let (kind, text) = assets::find(name).ok_or((StatusCode::NOT_FOUND, "There is no such file."))?;
        return Ok(([(header::CONTENT_TYPE, kind)], Body::from(text)).into_response());
    }
    if !text(&parts.headers, header::ORIGIN).is_some_and(|origin| served.address.is_origin(origin)) {
        return Err((StatusCode::FORBIDDEN, "Only pages of this server may ask."));
    }
    let upgrade = WebSocketUpgrade::from_request_parts(&mut parts, &())
        .await
        .map_err(|_| (StatusCode::UPGRADE_REQUIRED, "This is for a WebSocket."))?;
    let place = Place::take(&served.sockets);
    let start = Arc::clone(&served.start);
    let upgrade = upgrade.max_message_size(LARGEST_MESSAGE).max_frame_size(LARGEST_MESSAGE);
    Ok(upgrade.on_upgrade(async move |socket| match place {
        Some(_place) => socket::converse(socket, start).await,
        // A page learns why from a close code only.
        None => socket::turn_away(socket).await,
    }))
}

fn text(headers: &HeaderMap, name: HeaderName) -> Option<&str> {
    headers.get(name)?.to_str().ok()
}

/// One of the places for conversations; free again when it is dropped.
struct Place(Arc<AtomicUsize>);

impl Place {
    fn take(sockets: &Arc<AtomicUsize>) -> Option<Self> {
        let place = Self(Arc::clone(sockets));
        (sockets.fetch_add(1, Ordering::Relaxed) < MOST_SOCKETS).then_some(place)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}
