//! Scalars and histograms of each update, and where they are logged.
//!
//! # Layout
//! - [`scalars`]: the scalars of each update; [`histograms`]: distributions of actions and lags.
//! - [`episodes`]: the window of episodes that means are taken over.
//! - [`report`]: [`MetricsReport`], which writes to every output below.
//! - [`progress`]: [`Console`], what the user sees while it trains.
//! - [`table`]: scalars as text, pure functions.
//! - [`jsonl`]: [`JsonLines`], `metrics.jsonl`.
//! - [`tensorboard`]: [`EventWriter`], `events.out.tfevents.…`.
//! - [`history`]: [`History`], how return and distance developed, in few points.
//! - [`sparkline`]: a curve in one line of text.
//! - [`prometheus`]: [`PrometheusMetrics`], the newest values in Prometheus's text format.
//! - [`curve`]: [`draw_curve`], the learning curve as a PNG, drawn from `metrics.jsonl`.
//! - [`curve_thread`]: [`CurveThread`], which draws it at intervals during training.
//!
//! None of these reads the clock for what it writes: the caller says when a scalar was measured. Only [`Console`]
//! looks at it, for the speed it shows.

pub mod curve;
pub mod curve_thread;
pub mod episodes;
pub mod histograms;
pub mod history;
pub mod jsonl;
pub mod progress;
pub mod prometheus;
pub mod report;
pub mod scalars;
pub mod sparkline;
pub mod table;
pub mod tensorboard;

pub use curve::{CurveError, draw_curve};
pub use curve_thread::CurveThread;
pub use history::History;
pub use jsonl::JsonLines;
pub use progress::Console;
pub use prometheus::PrometheusMetrics;
pub use report::MetricsReport;
pub use tensorboard::{EventWriter, Histogram};

use std::fs::File;
use std::io::{self, Write};

/// One scalar per tag at one number of environment steps; tags are like `rollout/ep_rew_mean`.
pub type Scalars = [(String, f64)];

/// Appends all of `bytes` to a file opened for appending, or none of them: after an error (a full disk), what was
/// half written is cut off again, so that the next record starts where one may start.
fn append_whole(file: &mut File, bytes: &[u8]) -> io::Result<()> {
    let before = file.metadata()?.len();
    let written = file.write_all(bytes);
    if written.is_err() {
        // Cutting off may fail as well; the first error is the one to return.
        let _ = file.set_len(before);
    }
    written
}

#[cfg(test)]
mod curve_tests;
#[cfg(test)]
mod jsonl_tests;
