//! Scalars and histograms of each update, and their outputs.
//!
//! # Layout
//! - [`catalogue`]: [`METRICS`](catalogue::METRICS), the table of all metrics: tag, unit, help and source of the value.
//! - `parts`: [`PartMeter`], the speed that each part of training would allow alone.
//! - [`scalars`]: what the scalars of an update are computed from; [`histograms`]: distributions of actions and lags.
//! - [`reward_terms`]: [`RewardTerms`], the terms of the reward over a batch.
//! - [`films`]: [`FilmSlot`], films of the robot for TensorBoard.
//! - [`report`]: [`MetricsReport`], which writes to every output below.
//! - [`progress`]: [`Console`], progress on standard output.
//! - [`table`]: scalars as text, pure functions.
//! - [`jsonl`]: [`JsonLines`], `metrics.jsonl`.
//! - [`tensorboard`]: [`EventWriter`], `events.out.tfevents.…`.
//! - [`history`]: [`History`], return and distance over the run in few points.
//! - [`sparkline`]: a curve in one line of text.
//! - [`prometheus`]: [`PrometheusMetrics`], the newest values in Prometheus's text format.
//! - [`curve`]: [`draw_curve`], the learning curve as a PNG, drawn from `metrics.jsonl`.
//! - `curve_points`: what the curve shows; `curve_marks`: marks, legends and soft edges.
//! - `sweep_curve`: [`draw_sweep`], the curves of several runs as a PNG.
//! - [`curve_thread`]: [`CurveThread`], which draws the curve at intervals during training.
//!
//! The caller passes the time of each scalar. Only [`Console`] and [`CurveThread`] read the clock themselves.

pub mod catalogue;
pub mod curve;
mod curve_marks;
mod curve_points;
pub mod curve_thread;
mod efficiency;
pub mod films;
pub mod histograms;
pub mod history;
pub mod jsonl;
mod parts;
pub mod progress;
pub mod prometheus;
pub mod report;
pub mod reward_terms;
pub mod scalars;
pub mod sparkline;
mod sweep_curve;
pub mod table;
pub mod tensorboard;

pub use curve::{CurveError, CurveFacts, draw_curve};
pub use curve_thread::CurveThread;
pub use efficiency::{Efficiency, EfficiencyMeter};
pub use films::{FilmOfPolicy, FilmSlot};
pub use history::{History, RunFigures};
pub use jsonl::JsonLines;
pub use parts::{PARTS, PartMeter, PartTimes, TrainingPart};
pub use progress::{Console, ConsoleOptions};
pub use prometheus::PrometheusMetrics;
pub use report::{MetricsReport, ReportOptions};
pub use reward_terms::RewardTerms;
pub use sweep_curve::{GoalCost, SweptCurve, draw_sweep};
pub use tensorboard::{EventWriter, Histogram};

use std::fs::File;
use std::io::{self, Write};

/// Scalars of one update by tag, such as `rollout/ep_rew_mean`.
pub type Scalars = [(String, f64)];

/// Appends all of `bytes` to a file opened for appending, or none: after an error such as a full disk, it truncates a
/// partial record, so that the next one starts at a record boundary.
fn append_whole(file: &mut File, bytes: &[u8]) -> io::Result<()> {
    let before = file.metadata()?.len();
    let written = file.write_all(bytes);
    if written.is_err() {
        // Truncating may also fail; the first error is returned.
        let _ = file.set_len(before);
    }
    written
}

#[cfg(test)]
mod curve_tests;
#[cfg(test)]
mod jsonl_tests;
