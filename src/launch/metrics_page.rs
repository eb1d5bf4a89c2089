//! `--prometheus`: metrics and health over HTTP.

use std::{
    convert::Infallible,
    net::{SocketAddr, TcpListener},
    sync::{Arc, OnceLock},
    time::Duration,
};

use anyhow::Context;
use bytes::Bytes;
use clap::Args;
use http_body_util::Full;
use hyper::{
    Method, Request, Response, StatusCode,
    header::{ACCEPT, CONTENT_TYPE, HeaderValue},
    server::conn::http1,
    service::service_fn,
};
use hyper_util::rt::TokioIo;
use tokio::sync::Semaphore;
use treadmill_learner::{
    metrics::{PrometheusMetrics, prometheus::PageFormat},
    waiting::Heartbeat,
};

use crate::launch::exit_code::Usage;

/// Most connections at a time; further ones are closed.
const CONNECTIONS_MAX: usize = 64;
/// Time limit of a connection, against slow clients.
const CONNECTION_TIMEOUT: Duration = Duration::from_secs(5);
/// Longest request.
const REQUEST_BYTES_MAX: usize = 16 << 10;
/// Pause after a failed accept, for instance with too many open files.
const ACCEPT_PAUSE: Duration = Duration::from_millis(200);

/// Flags about the page of metrics and health, which each process of a fleet has.
#[derive(Args, Clone, Debug, Default)]
pub struct PageArgs {
    /// Serve /metrics for Prometheus, /healthz and /livez at this address, for instance 127.0.0.1:9464.
    #[arg(long, value_name = "ADDRESS")]
    prometheus: Option<SocketAddr>,
    /// Allow --prometheus beyond loopback, where anyone on the network can read the metrics.
    #[arg(long, requires = "prometheus")]
    prometheus_open: bool,
}

impl PageArgs {
    /// Opens the socket if `--prometheus` was given. Called before anything is written.
    ///
    /// # Errors
    /// If the address is refused or in use.
    pub fn listen(&self) -> anyhow::Result<Option<PageListener>> {
        let Some(address) = self.prometheus else { return Ok(None) };
        if !address.ip().is_loopback() && !self.prometheus_open {
            return Err(Usage(format!(
                "--prometheus {address}: anyone on the network can read plain HTTP beyond loopback; listen on \
                 127.0.0.1:{}, or pass --prometheus-open if the network is trusted",
                address.port()
            ))
            .into());
        }
        let listener = TcpListener::bind(address)
            .with_context(|| format!("--prometheus {address}: cannot listen on this address; choose another port"))?;
        listener.set_nonblocking(true)?;
        Ok(Some(PageListener(listener)))
    }
}

/// Flags about the page of a learner.
#[derive(Args, Clone, Debug, Default)]
pub struct MetricsArgs {
    #[command(flatten)]
    page: PageArgs,
    /// Seconds without progress after which /livez and /healthz answer 503.
    #[arg(long, value_name = "SECONDS", requires = "prometheus", default_value_t = 120,
          value_parser = clap::value_parser!(u64).range(1..=86_400))]
    stalled_after_s: u64,
}

impl MetricsArgs {
    /// Opens the socket if `--prometheus` was given, see [`PageArgs::listen`].
    ///
    /// # Errors
    /// Those of that function.
    pub fn listen(&self) -> anyhow::Result<Option<MetricsListener>> {
        let stalled_after = Duration::from_secs(self.stalled_after_s);
        Ok(self.page.listen()?.map(|listener| MetricsListener { listener, stalled_after }))
    }
}

/// What a page shows.
pub trait PageContent: Send + Sync + 'static {
    /// Returns the metrics.
    fn metrics(&self, format: PageFormat) -> String;
    /// Whether the process works, or why it should be restarted.
    fn liveness(&self) -> Result<(), String>;
    /// Whether it can also do its part of a training, or what it lacks.
    fn health(&self) -> Result<(), String>;
}

/// Socket of a page, opened before the runtime that serves it.
pub struct PageListener(TcpListener);

impl PageListener {
    /// Serves the page for as long as the runtime lives, and returns its address.
    pub fn serve(self, content: Arc<dyn PageContent>) -> anyhow::Result<SocketAddr> {
        let address = self.0.local_addr()?;
        tokio::spawn(serve(tokio::net::TcpListener::from_std(self.0)?, content));
        Ok(address)
    }
}

/// Socket of a learner's page.
pub struct MetricsListener {
    listener: PageListener,
    stalled_after: Duration,
}

impl MetricsListener {
    /// Serves the page, see [`PageListener::serve`]. `run` is unset until it is known, for instance while its store does
    /// not answer.
    pub fn serve(
        self,
        run: Arc<OnceLock<String>>,
        metrics: PrometheusMetrics,
        heartbeat: Heartbeat,
    ) -> anyhow::Result<SocketAddr> {
        let Self { listener, stalled_after } = self;
        listener.serve(Arc::new(LearnerPage { run, metrics, heartbeat, stalled_after }))
    }
}

struct LearnerPage {
    run: Arc<OnceLock<String>>,
    metrics: PrometheusMetrics,
    heartbeat: Heartbeat,
    stalled_after: Duration,
}

impl PageContent for LearnerPage {
    fn metrics(&self, format: PageFormat) -> String {
        let silence_s = self.heartbeat.silence().as_secs_f64();
        let run = self.run.get().map_or("", String::as_str);
        self.metrics.page(run, &[("learner/silence_s", silence_s)], format)
    }

    fn liveness(&self) -> Result<(), String> {
        let silence = self.heartbeat.silence();
        if silence <= self.stalled_after { Ok(()) } else { Err(format!("no progress for {} s", silence.as_secs())) }
    }

    fn health(&self) -> Result<(), String> {
        self.liveness()?;
        // Unknown while it waits for a store or for another leader.
        if self.metrics.value("actors/alive") == Some(0.0) {
            Err("no actors are connected".to_string())
        } else {
            Ok(())
        }
    }
}

async fn serve(listener: tokio::net::TcpListener, page: Arc<dyn PageContent>) {
    let permits = Arc::new(Semaphore::new(CONNECTIONS_MAX));
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(ACCEPT_PAUSE).await;
            continue;
        };
        let Ok(permit) = permits.clone().try_acquire_owned() else { continue };
        let page = page.clone();
        tokio::spawn(async move {
            let answer = service_fn(|request| {
                let page = page.clone();
                async move { Ok::<_, Infallible>(answer(&*page, &request)) }
            });
            let connection = http1::Builder::new()
                .keep_alive(false)
                .max_buf_size(REQUEST_BYTES_MAX)
                .serve_connection(TokioIo::new(stream), answer);
            // A failed connection concerns only its client.
            let _ = tokio::time::timeout(CONNECTION_TIMEOUT, connection).await;
            drop(permit);
        });
    }
}

fn answer<B>(page: &dyn PageContent, request: &Request<B>) -> Response<Full<Bytes>> {
    if request.method() != Method::GET {
        return text(StatusCode::METHOD_NOT_ALLOWED, "only GET\n".to_string());
    }
    let state = |state: Result<(), String>| match state {
        Ok(()) => text(StatusCode::OK, "ok\n".to_string()),
        Err(why) => text(StatusCode::SERVICE_UNAVAILABLE, why + "\n"),
    };
    match request.uri().path() {
        "/metrics" => {
            let accept = request.headers().get(ACCEPT).and_then(|accept| accept.to_str().ok());
            let format = PageFormat::accepted_by(accept.unwrap_or_default());
            let mut response = text(StatusCode::OK, page.metrics(format));
            response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static(format.content_type()));
            response
        }
        "/livez" => state(page.liveness()),
        "/healthz" => state(page.health()),
        _ => text(StatusCode::NOT_FOUND, "only /metrics, /healthz and /livez\n".to_string()),
    }
}

fn text(status: StatusCode, body: String) -> Response<Full<Bytes>> {
    let mut response = Response::new(Full::new(Bytes::from(body)));
    *response.status_mut() = status;
    response
}
