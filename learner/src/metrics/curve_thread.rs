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

use super::{CurveError, draw_curve};

/// The first picture is due after this, so that a first try shows one within a minute.
const FIRST_AFTER: Duration = Duration::from_secs(10);
/// Each further one is due when the run is twice as old, or after this.
const EVERY_MAX: Duration = Duration::from_secs(300);
/// Between two pictures there is at least so many times what the last one took: half a percent of a core, however long the
/// metrics are.
const REST: u64 = 200;

/// Thread that draws the learning curve.
pub struct CurveThread {
    metrics_jsonl: PathBuf,
    png: PathBuf,
    orders: Option<SyncSender<()>>,
    thread: Option<JoinHandle<()>>,
    begun: Instant,
    /// When the next picture is due, counted from the beginning, and when the last was ordered.
    due: Duration,
    ordered: Duration,
    took_ms: Arc<AtomicU64>,
}

impl CurveThread {
    /// Starts the thread; it draws nothing yet.
    pub fn new(metrics_jsonl: PathBuf, png: PathBuf) -> Self {
        // Without a buffer: a thread that is still drawing takes no further order.
        let (orders, ordered) = sync_channel::<()>(0);
        let took_ms = Arc::new(AtomicU64::new(0));
        let (from, to, took) = (metrics_jsonl.clone(), png.clone(), took_ms.clone());
        let thread = std::thread::Builder::new().name("curve".to_string()).spawn(move || {
            while ordered.recv().is_ok() {
                let begun = Instant::now();
                if let Err(why) = draw_curve(&from, &to) {
                    tracing::debug!("no picture now: {why}");
                }
                took.store(begun.elapsed().as_millis() as u64, Ordering::Relaxed);
            }
        });
        if let Err(why) = &thread {
            tracing::debug!("the learning curve is drawn at the end alone: {why}");
        }
        Self {
            metrics_jsonl,
            png,
            orders: Some(orders),
            thread: thread.ok(),
            begun: Instant::now(),
            due: FIRST_AFTER,
            ordered: Duration::ZERO,
            took_ms,
        }
    }

    /// Orders a new picture if one is due; returns at once.
    pub fn poll(&mut self) {
        let elapsed = self.begun.elapsed();
        let rest = Duration::from_millis(self.took_ms.load(Ordering::Relaxed).saturating_mul(REST));
        let is_due = elapsed >= self.due && elapsed >= self.ordered + rest;
        if is_due && self.orders.as_ref().is_some_and(|orders| orders.try_send(()).is_ok()) {
            self.ordered = elapsed;
            self.due = elapsed + elapsed.min(EVERY_MAX);
        }
    }

    /// Draws the last picture.
    ///
    /// # Errors
    /// If the metrics cannot be read, or the picture cannot be written.
    pub fn finish(&mut self) -> Result<(), CurveError> {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
        draw_curve(&self.metrics_jsonl, &self.png)
    }
}
