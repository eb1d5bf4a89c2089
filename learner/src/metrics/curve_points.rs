//! What the learning curve shows, read from `metrics.jsonl`.

use std::{fs::File, io};

use super::jsonl::for_each_metric;

/// Largest number that is drawn; larger ones are omitted, because the plotter's arithmetic would overflow.
const DRAWABLE_MAX: f64 = 1e12;
/// Tag of the time that the learner ran.
const RAN_TAG: &str = "time/time_elapsed";
/// Time that passed while the learner did not run (s) from which the run was resumed. Within a start, the two clocks differ
/// by up to 0.2 s.
const RESUME_S: f64 = 0.5;

/// Millions of environment steps, and a value.
pub type CurvePoint = (f64, f64);

/// Metrics of a run.
#[derive(Debug, Default, PartialEq)]
pub struct CurvePoints {
    /// Points of each tag, in the order of the tags.
    pub series: Vec<Vec<CurvePoint>>,
    /// Name of the run; empty without a metric.
    pub run: String,
    /// Time of the last metric (s since 1970).
    pub last_unix_s: f64,
    /// Millions of environment steps at each resume.
    pub resumes: Vec<f64>,
}

impl CurvePoints {
    /// Reads the points of some tags. A resume shows in that more time passed than the learner ran.
    pub fn read(file: File, tags: &[&str]) -> io::Result<Self> {
        let mut found = Self { series: vec![Vec::new(); tags.len()], ..Self::default() };
        let (mut rested_s, mut last_step) = (None, 0.0);
        for_each_metric(file, |metric, _| {
            let point = (metric.step as f64 / 1e6, metric.value);
            if metric.tag == RAN_TAG {
                let now_s = metric.time_unix_s - metric.value;
                if rested_s.is_some_and(|before_s| now_s - before_s > RESUME_S) {
                    found.resumes.push(last_step);
                }
                (rested_s, last_step) = (Some(now_s), point.0);
            }
            if let Some(tag) = tags.iter().position(|tag| *tag == metric.tag)
                && point.0 <= DRAWABLE_MAX
                && point.1.abs() <= DRAWABLE_MAX
            {
                found.series[tag].push(point);
            }
            found.last_unix_s = metric.time_unix_s;
            found.run = metric.run;
            Ok(())
        })?;
        found.resumes.retain(|step| *step <= DRAWABLE_MAX);
        Ok(found)
    }
}
