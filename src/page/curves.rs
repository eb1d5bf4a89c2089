//! Metrics of runs as curves, read from their logs while they grow.

use std::{
    collections::BTreeMap,
    fs::File,
    io::{BufRead, BufReader, Seek, SeekFrom},
    path::PathBuf,
};

use treadmill_proto::{
    json::Metric,
    page::{PageCurve, PageCurves},
};

/// Most points of a curve that a page receives when it opens.
const POINTS_MAX: usize = 1000;
/// Most curves; metrics of further tags are left out.
const CURVES_MAX: usize = 512;

/// All curves so far, thinned.
#[derive(Default)]
pub struct CurveStore {
    curves: BTreeMap<(String, String), Thinned>,
}

/// Curve with every `stride`-th point.
struct Thinned {
    curve: PageCurve,
    stride: u64,
    seen: u64,
}

impl CurveStore {
    /// Adds points. Where a curve has too many, every second one is dropped.
    pub fn add(&mut self, points: &PageCurves) {
        for PageCurve { run, tag, steps, wall_s, values } in &points.curves {
            let key = (run.clone(), tag.clone());
            if !self.curves.contains_key(&key) && self.curves.len() >= CURVES_MAX {
                continue;
            }
            let new = || PageCurve { run: run.clone(), tag: tag.clone(), ..PageCurve::default() };
            let thinned = self.curves.entry(key).or_insert_with(|| Thinned { curve: new(), stride: 1, seen: 0 });
            for ((step, wall_s), value) in steps.iter().zip(wall_s).zip(values) {
                thinned.add(*step, *wall_s, *value);
            }
        }
    }

    /// Returns all curves.
    pub fn whole(&self) -> PageCurves {
        PageCurves { curves: self.curves.values().map(|thinned| thinned.curve.clone()).collect() }
    }
}

impl Thinned {
    fn add(&mut self, step: f64, wall_s: f64, value: f64) {
        self.seen += 1;
        if !(self.seen - 1).is_multiple_of(self.stride) {
            return;
        }
        let PageCurve { steps, wall_s: times_s, values, .. } = &mut self.curve;
        steps.push(step);
        times_s.push(wall_s);
        values.push(value);
        if steps.len() >= POINTS_MAX {
            for numbers in [steps, times_s, values] {
                let mut index = 0;
                numbers.retain(|_| {
                    index += 1;
                    index % 2 == 1
                });
            }
            self.stride *= 2;
        }
    }
}

/// RunLog of a run's metrics that is read as it grows.
pub struct RunLog {
    file: PathBuf,
    run: String,
    read_bytes: u64,
    begun_unix_s: Option<f64>,
}

impl RunLog {
    /// Creates the log of a run, which is read from its beginning.
    #[must_use]
    pub fn new(file: PathBuf, run: String) -> Self {
        Self { file, run, read_bytes: 0, begun_unix_s: None }
    }

    /// Returns the points that were written since the last call. A missing file has none, and so has a half line. A file
    /// that became shorter was cut by a resume; its curves go on from there.
    pub fn new_points(&mut self) -> PageCurves {
        let mut curves: BTreeMap<String, PageCurve> = BTreeMap::new();
        let Ok(mut file) = File::open(&self.file) else { return PageCurves::default() };
        let length = file.metadata().map_or(0, |found| found.len());
        if length < self.read_bytes {
            self.read_bytes = length;
        }
        if length == self.read_bytes || file.seek(SeekFrom::Start(self.read_bytes)).is_err() {
            return PageCurves::default();
        }
        let (mut reader, mut line) = (BufReader::new(file), Vec::new());
        while reader.read_until(b'\n', &mut line).is_ok_and(|bytes| bytes > 0) && line.ends_with(b"\n") {
            self.read_bytes += line.len() as u64;
            if let Ok(Metric { tag, step, value, time_unix_s, .. }) = serde_json::from_slice(&line) {
                let begun_unix_s = *self.begun_unix_s.get_or_insert(time_unix_s);
                let new = || PageCurve { run: self.run.clone(), tag: tag.clone(), ..PageCurve::default() };
                let curve = curves.entry(tag.clone()).or_insert_with(new);
                curve.steps.push(step as f64);
                curve.wall_s.push(time_unix_s - begun_unix_s);
                curve.values.push(value);
            }
            line.clear();
        }
        PageCurves { curves: curves.into_values().collect() }
    }
}

#[cfg(test)]
mod tests {
    use std::{fs::OpenOptions, io::Write};

    use super::*;

    fn curve(tag: &str, steps: impl Iterator<Item = u32>) -> PageCurve {
        let steps: Vec<f64> = steps.map(f64::from).collect();
        let values = steps.iter().map(|step| 2.0 * step).collect();
        PageCurve { run: "walk".into(), tag: tag.into(), wall_s: steps.clone(), values, steps }
    }

    #[test]
    fn long_curves_are_thinned_evenly() {
        let mut store = CurveStore::default();
        for from in (0..10_000).step_by(100) {
            store.add(&PageCurves { curves: vec![curve("long", from..from + 100)] });
        }
        store.add(&PageCurves { curves: vec![curve("short", 0..3)] });
        let [long, short] = &store.whole().curves[..] else { panic!("two curves") };
        assert!(long.steps.len() < POINTS_MAX && long.steps.len() >= POINTS_MAX / 2, "{}", long.steps.len());
        let stride = long.steps[1] - long.steps[0];
        assert!(long.steps.windows(2).all(|pair| pair[1] - pair[0] == stride));
        assert!(long.steps.iter().zip(&long.values).all(|(step, value)| *value == 2.0 * step));
        assert_eq!(short.steps, [0.0, 1.0, 2.0]);
    }

    #[test]
    fn tags_are_bounded() {
        let mut store = CurveStore::default();
        for number in 0..2 * CURVES_MAX {
            store.add(&PageCurves { curves: vec![curve(&format!("tag/{number}"), 0..1)] });
        }
        assert_eq!(store.whole().curves.len(), CURVES_MAX);
    }

    #[test]
    fn a_log_is_read_as_it_grows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("metrics.jsonl");
        let mut log = RunLog::new(path.clone(), "walk".into());
        assert_eq!(log.new_points(), PageCurves::default());
        let mut file = OpenOptions::new().create(true).append(true).open(&path).unwrap();
        let line =
            |step: u32| format!(r#"{{"run":"walk","tag":"a","step":{step},"value":1.5,"time_unix_s":{}}}"#, 100 + step);
        write!(file, "{}\nnonsense\n{}\n{}", line(1), line(2), &line(3)[..20]).unwrap();
        let first = log.new_points();
        assert_eq!((&first.curves[0].steps[..], &first.curves[0].wall_s[..]), (&[1.0, 2.0][..], &[0.0, 1.0][..]));
        assert_eq!(log.new_points(), PageCurves::default());
        writeln!(file, "{}", &line(3)[20..]).unwrap();
        assert_eq!(log.new_points().curves[0].steps, [3.0]);
        file.set_len(0).unwrap();
        assert_eq!(log.new_points(), PageCurves::default());
        writeln!(file, "{}", line(4)).unwrap();
        assert_eq!(log.new_points().curves[0].steps, [4.0]);
    }
}
