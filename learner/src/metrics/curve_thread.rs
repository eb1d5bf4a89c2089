//! Draws the learning curve at intervals during training, on a separate thread.

use std::{
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
        mpsc::{SyncSender, sync_channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

use treadmill_runtime::error_chain;

use super::{CurveError, CurveFacts, draw_curve};

/// The first image is due after this time, so that a short run shows one.
const FIRST_AFTER: Duration = Duration::from_secs(10);
/// The next is due when the run is twice as old, or after this time.
const EVERY_MAX: Duration = Duration::from_secs(300);
/// Shortest pause between two images, in durations of the last drawing: at most half a percent of a core.
const PAUSE_DURATIONS: u64 = 200;

/// Thread that draws the learning curve.
pub struct CurveThread {
    metrics_jsonl: PathBuf,
    facts: CurveFacts,
    png: PathBuf,
    requests: Option<SyncSender<()>>,
    thread: Option<JoinHandle<()>>,
    begun: Instant,
    /// Time from `begun` at which the next image is due.
    due: Duration,
    /// Time from `begun` at which the last image was requested.
    requested: Duration,
    took_ms: Arc<AtomicU64>,
}

impl CurveThread {
    /// Starts the thread; it draws nothing yet.
    pub fn new(metrics_jsonl: PathBuf, facts: CurveFacts, png: PathBuf) -> Self {
        // Without a buffer, so that requests fail while the thread is drawing.
        let (requests, receiver) = sync_channel::<()>(0);
        let took_ms = Arc::new(AtomicU64::new(0));
        let (from, shown, to, took) = (metrics_jsonl.clone(), facts.clone(), png.clone(), took_ms.clone());
        let thread = std::thread::Builder::new().name("curve".to_string()).spawn(move || {
            while receiver.recv().is_ok() {
                let begun = Instant::now();
                if let Err(why) = draw_curve(&from, &shown, &to) {
                    tracing::debug!(error = %error_chain(&why), "learning curve not drawn");
                }
                took.store(begun.elapsed().as_millis() as u64, Ordering::Relaxed);
            }
        });
        if let Err(why) = &thread {
            tracing::debug!(error = %why, "no thread: the learning curve is drawn only at the end");
        }
        Self {
            metrics_jsonl,
            facts,
            png,
            requests: Some(requests),
            thread: thread.ok(),
            begun: Instant::now(),
            due: FIRST_AFTER,
            requested: Duration::ZERO,
            took_ms,
        }
    }

    /// Requests a new image if one is due; does not block.
    pub fn poll(&mut self) {
        let elapsed = self.begun.elapsed();
        let pause = Duration::from_millis(self.took_ms.load(Ordering::Relaxed).saturating_mul(PAUSE_DURATIONS));
        let is_due = elapsed >= self.due && elapsed >= self.requested + pause;
        if is_due && self.requests.as_ref().is_some_and(|requests| requests.try_send(()).is_ok()) {
            self.requested = elapsed;
            self.due = elapsed + elapsed.min(EVERY_MAX);
        }
    }

    /// Ends the thread and draws the last image.
    ///
    /// # Errors
    /// If the metrics cannot be read or the image cannot be written.
    pub fn finish(&mut self) -> Result<(), CurveError> {
        self.requests = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
        draw_curve(&self.metrics_jsonl, &self.facts, &self.png)
    }
}
