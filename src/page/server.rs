//! HTTP and WebSockets of the page.

use std::{net::TcpListener, time::Duration};

use anyhow::Context;
use axum::{
    Router,
    body::Body,
    extract::{
        Request, State, WebSocketUpgrade,
        ws::{CloseFrame, Message, WebSocket, close_code},
    },
    http::{
        StatusCode,
        header::{CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName},
    },
    middleware::{self, Next},
    response::{IntoResponse, Response},
    routing::get,
};
use tokio::sync::broadcast::error::RecvError;
use treadmill_proto::page::{FROM_PAGE_BYTES_MAX, FromPage, ToPageKind};
use treadmill_runtime::shutdown::Shutdown;

use super::{
    doors::{BoundedListener, Door, TlsListener},
    hub::{Hub, PAGES_MAX, PageView},
};

/// Nothing comes from elsewhere, and no script is written into the page.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
                      connect-src 'self'; media-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// Files of the page, as `npm run build` in `page/` writes them.
const FILES: [(&str, &str, &[u8]); 4] = [
    ("/", "text/html; charset=utf-8", include_bytes!("../../page/dist/index.html")),
    ("/page.js", "text/javascript; charset=utf-8", include_bytes!("../../page/dist/page.js")),
    ("/style.css", "text/css; charset=utf-8", include_bytes!("../../page/dist/style.css")),
    ("/licences.txt", "text/plain; charset=utf-8", include_bytes!("../../page/dist/licences.txt")),
];
/// Longest time that one message may take, as the meshes of a robot through a slow tunnel.
const SEND_TIMEOUT: Duration = Duration::from_secs(120);
/// Longest time that the end of the program waits for a page.
const CLOSE_TIMEOUT: Duration = Duration::from_millis(200);

/// Serves the page until the stop.
///
/// # Errors
/// If the socket fails.
pub async fn serve(listener: TcpListener, door: Door, hub: Hub, shutdown: Shutdown) -> anyhow::Result<()> {
    let listener = tokio::net::TcpListener::from_std(listener).context("the page cannot be served")?;
    let mut router = Router::new().route("/socket", get(open_socket));
    for (path, kind, bytes) in FILES {
        router = router.route(path, get(move || async move { ([(CONTENT_TYPE, kind)], bytes) }));
    }
    let guarded = middleware::from_fn_with_state(door.clone(), guard);
    let router = router.layer(guarded).with_state((hub, shutdown.clone()));
    let stopped = async move { shutdown.wait().await };
    let served = match door {
        Door::Loopback => axum::serve(BoundedListener::new(listener), router).with_graceful_shutdown(stopped).await,
        Door::Token(_, config, _) => {
            let listener = BoundedListener::new(TlsListener::new(listener, config)?);
            axum::serve(listener, router).with_graceful_shutdown(stopped).await
        }
    };
    served.context("the page cannot be served")
}

/// Answers only requests that the door admits, and adds the headers that every answer has.
async fn guard(State(door): State<Door>, request: Request, next: Next) -> Response {
    let uri = request.uri();
    let mut response = match door.admits(request.headers(), uri.path(), uri.query().unwrap_or_default()) {
        true => next.run(request).await,
        false => (StatusCode::FORBIDDEN, "open the page by the link that the program prints").into_response(),
    };
    let added = [
        (CONTENT_SECURITY_POLICY, POLICY),
        (CACHE_CONTROL, "no-cache"),
        (HeaderName::from_static("x-content-type-options"), "nosniff"),
        (HeaderName::from_static("referrer-policy"), "no-referrer"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    ];
    for (name, value) in added {
        response.headers_mut().insert(name, value.parse().expect("a plain value"));
    }
    response
}

async fn open_socket(State((hub, shutdown)): State<(Hub, Shutdown)>, upgrade: WebSocketUpgrade) -> Response<Body> {
    let upgrade = upgrade.max_message_size(FROM_PAGE_BYTES_MAX).max_frame_size(FROM_PAGE_BYTES_MAX);
    upgrade.on_upgrade(async move |mut socket| {
        tokio::select! {
            () = converse(&mut socket, hub) => return,
            () = shutdown.wait() => {}
        }
        // Otherwise the page takes it for a fault. It connects again if the run is resumed here.
        let reason = "The program has ended; `treadmill watch RUN` shows a run again".into();
        let close = Message::Close(Some(CloseFrame { code: close_code::AWAY, reason }));
        let _ = tokio::time::timeout(CLOSE_TIMEOUT, socket.send(close)).await;
    })
}

/// Sends what is shown and takes what is asked, until the page closes or stops to listen.
async fn converse(socket: &mut WebSocket, hub: Hub) {
    let Some(seat) = hub.seat() else {
        let full = ToPageKind::Notice(format!("{PAGES_MAX} pages are open already; close one"));
        send(socket, full.to_bytes().into()).await;
        return;
    };
    let PageView { mut scene, mut frames, mut news, curves, notice, mut generation, mut steerer } = hub.view();
    steerer.mark_changed();
    let newest = scene.borrow_and_update().clone();
    for message in [newest, curves, notice] {
        if !message.is_empty() && !send(socket, message).await {
            return;
        }
    }
    loop {
        let message = tokio::select! {
            // The page connects again, and receives the curves as they are now.
            _ = generation.changed() => return,
            changed = scene.changed() => match changed {
                Ok(()) => scene.borrow_and_update().clone(),
                Err(_) => return,
            },
            frame = frames.recv() => match frame {
                Ok(frame) => frame,
                Err(RecvError::Lagged(_)) => {
                    frames = frames.resubscribe();
                    continue;
                }
                Err(RecvError::Closed) => return,
            },
            changed = steerer.changed() => match changed {
                Ok(()) => {
                    let seen = seat.sees(*steerer.borrow_and_update());
                    ToPageKind::Steerer(seen.into()).to_bytes().into()
                }
                Err(_) => return,
            },
            // A page that connects again receives all curves.
            new = news.recv() => match new {
                Ok(new) => new,
                Err(_) => return,
            },
            asked = socket.recv() => match asked {
                Some(Ok(Message::Binary(bytes))) => match FromPage::decode_checked(&bytes) {
                    Ok(request) => {
                        seat.ask(request);
                        continue;
                    }
                    Err(why) => {
                        tracing::debug!(%why, "message of a page refused");
                        return;
                    }
                },
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => continue,
                _ => return,
            },
        };
        if !send(socket, message).await {
            return;
        }
    }
}

/// Sends a message; returns false if the page takes none.
async fn send(socket: &mut WebSocket, message: bytes::Bytes) -> bool {
    matches!(tokio::time::timeout(SEND_TIMEOUT, socket.send(Message::Binary(message))).await, Ok(Ok(())))
}
