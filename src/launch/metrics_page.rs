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
use hyper::{Method, Request, Response, StatusCode, header::CONTENT_TYPE, server::conn::http1, service::service_fn};
use hyper_util::rt::TokioIo;
use tokio::sync::Semaphore;
use treadmill_learner::{
    metrics::{PrometheusMetrics, prometheus},
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

/// Flags about the metrics page.
#[derive(Args, Clone, Debug, Default)]
pub struct MetricsArgs {
    /// Serve /metrics for Prometheus and /healthz at this address, for instance 127.0.0.1:9464.
    #[arg(long, value_name = "ADDRESS")]
    prometheus: Option<SocketAddr>,
    /// Allow --prometheus beyond loopback, where anyone on the network can read the metrics.
    #[arg(long, requires = "prometheus")]
    prometheus_open: bool,
    /// Seconds without progress after which /healthz answers 503.
    #[arg(long, value_name = "SECONDS", requires = "prometheus", default_value_t = 120,
          value_parser = clap::value_parser!(u64).range(1..=86_400))]
    stalled_after_s: u64,
}

impl MetricsArgs {
    /// Opens the socket if `--prometheus` was given. Called before anything is written.
    ///
    /// # Errors
    /// If the address is refused or in use.
    pub fn listen(&self) -> anyhow::Result<Option<MetricsListener>> {
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
        Ok(Some(MetricsListener { listener, stalled_after: Duration::from_secs(self.stalled_after_s) }))
    }
}

/// Socket of the page, opened before the runtime that serves it.
pub struct MetricsListener {
    listener: TcpListener,
    stalled_after: Duration,
}

/// Content of the page.
struct Page {
    /// Unset until the run is known, for instance while its store does not answer.
    run: Arc<OnceLock<String>>,
    metrics: PrometheusMetrics,
    heartbeat: Heartbeat,
    stalled_after: Duration,
}

impl MetricsListener {
    /// Serves the page for as long as the runtime lives, and returns its address.
    pub fn serve(
        self,
        run: Arc<OnceLock<String>>,
        metrics: PrometheusMetrics,
        heartbeat: Heartbeat,
    ) -> anyhow::Result<SocketAddr> {
        let address = self.listener.local_addr()?;
        let listener = tokio::net::TcpListener::from_std(self.listener)?;
        let page = Arc::new(Page { run, metrics, heartbeat, stalled_after: self.stalled_after });
        tokio::spawn(serve(listener, page));
        Ok(address)
    }
}

async fn serve(listener: tokio::net::TcpListener, page: Arc<Page>) {
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
                async move { Ok::<_, Infallible>(page.answer(&request)) }
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

impl Page {
    fn answer<B>(&self, request: &Request<B>) -> Response<Full<Bytes>> {
        if request.method() != Method::GET {
            return text(StatusCode::METHOD_NOT_ALLOWED, "only GET\n".to_string());
        }
        match request.uri().path() {
            "/metrics" => self.metrics(),
            "/healthz" => self.health(),
            _ => text(StatusCode::NOT_FOUND, "only /metrics and /healthz\n".to_string()),
        }
    }

    fn metrics(&self) -> Response<Full<Bytes>> {
        let silence_s = self.heartbeat.silence().as_secs_f64();
        let page = self.metrics.page(self.run.get().map_or("", String::as_str), &[("learner/silence_s", silence_s)]);
        let mut response = text(StatusCode::OK, page);
        response.headers_mut().insert(CONTENT_TYPE, hyper::header::HeaderValue::from_static(prometheus::CONTENT_TYPE));
        response
    }

    fn health(&self) -> Response<Full<Bytes>> {
        let silence = self.heartbeat.silence();
        if silence <= self.stalled_after {
            return text(StatusCode::OK, "ok\n".to_string());
        }
        text(StatusCode::SERVICE_UNAVAILABLE, format!("no progress for {} s\n", silence.as_secs()))
    }
}

fn text(status: StatusCode, body: String) -> Response<Full<Bytes>> {
    let mut response = Response::new(Full::new(Bytes::from(body)));
    *response.status_mut() = status;
    response
}
