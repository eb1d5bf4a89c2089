//! What the learning curve shows, read from `metrics.jsonl`.

use std::{fs::File, io};

use super::jsonl::for_each_metric;

/// Largest number that is drawn; larger ones are omitted, because the plotter's arithmetic would overflow.
const DRAWABLE_MAX: f64 = 1e12;
/// Tag of the number of resumes.
const RESUMES_TAG: &str = "time/resumes";

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
    /// Millions of environment steps where the number of resumes grew, and that number.
    pub resumes: Vec<f64>,
    pub resumed: u64,
}

impl CurvePoints {
    /// Reads the points of some tags.
    pub fn read(file: File, tags: &[&str]) -> io::Result<Self> {
        let mut found = Self { series: vec![Vec::new(); tags.len()], ..Self::default() };
        let mut before: Option<CurvePoint> = None;
        for_each_metric(file, |metric, _| {
            let point = (metric.step as f64 / 1e6, metric.value);
            if metric.tag == RESUMES_TAG {
                found.resumes.extend(before.filter(|(_, resumes)| metric.value > *resumes).map(|(step, _)| step));
                before = Some(point);
                found.resumed = metric.value as u64;
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
