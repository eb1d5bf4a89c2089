//! Metrics of runs as curves, read from their logs while they grow.

use std::{
    collections::BTreeMap,
    fs::File,
    hash::{DefaultHasher, Hash, Hasher},
    io::{BufRead, BufReader, Seek, SeekFrom},
    os::unix::fs::MetadataExt,
};

use treadmill_proto::{
    json::Metric,
    page::{PageCurve, PageCurves},
};
use treadmill_runtime::run_folder::RunFolder;

/// Most points of a curve that a page receives when it opens. For each tag, the curves of all runs together have fewer than
/// the second number, unless each has fewer than the third.
const POINTS_MAX: usize = 1000;
const POINTS_OF_RUNS_MAX: usize = 4000;
const POINTS_MIN: usize = 125;
/// Most curves of a run; metrics of further tags are left out.
const CURVES_MAX: usize = 512;

/// All curves so far, thinned: by run, then by tag.
#[derive(Default)]
pub struct CurveStore {
    runs: BTreeMap<String, BTreeMap<String, Thinned>>,
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
        for PageCurve { run, group, tag, steps, wall_s, values } in &points.curves {
            if !self.runs.contains_key(run) {
                self.runs.insert(run.clone(), BTreeMap::new());
                let most = self.points_max();
                self.runs.values_mut().flat_map(BTreeMap::values_mut).for_each(|curve| curve.thin(most));
            }
            let most = self.points_max();
            let curves = self.runs.entry(run.clone()).or_default();
            if !curves.contains_key(tag) && curves.len() >= CURVES_MAX {
                continue;
            }
            let names = [run, group, tag].map(Clone::clone);
            let new = || Thinned { curve: empty(names), stride: 1, seen: 0 };
            let thinned = curves.entry(tag.clone()).or_insert_with(new);
            for ((step, wall_s), value) in steps.iter().zip(wall_s).zip(values) {
                thinned.add([*step, *wall_s, *value], most);
            }
        }
    }

    /// Returns how many points a curve may have: fewer where there are many runs.
    fn points_max(&self) -> usize {
        (POINTS_OF_RUNS_MAX / self.runs.len().max(1)).clamp(POINTS_MIN, POINTS_MAX)
    }

    /// Removes the curves of a run. Returns whether there were any.
    pub fn remove(&mut self, run: &str) -> bool {
        self.runs.remove(run).is_some()
    }

    /// Returns the curves of a run.
    pub fn of_run(&self, run: &str) -> PageCurves {
        let own = self.runs.get(run).into_iter().flat_map(BTreeMap::values);
        PageCurves { curves: own.map(|thinned| thinned.curve.clone()).collect() }
    }

    /// Returns all curves.
    pub fn whole(&self) -> PageCurves {
        let all = self.runs.values().flat_map(BTreeMap::values);
        PageCurves { curves: all.map(|thinned| thinned.curve.clone()).collect() }
    }
}

impl Thinned {
    fn add(&mut self, [step, wall_s, value]: [f64; 3], most: usize) {
        self.seen += 1;
        if !(self.seen - 1).is_multiple_of(self.stride) {
            return;
        }
        self.curve.steps.push(step);
        self.curve.wall_s.push(wall_s);
        self.curve.values.push(value);
        self.thin(most);
    }

    fn thin(&mut self, most: usize) {
        while self.curve.steps.len() >= most {
            let PageCurve { steps, wall_s, values, .. } = &mut self.curve;
            for numbers in [steps, wall_s, values] {
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

fn empty([run, group, tag]: [String; 3]) -> PageCurve {
    PageCurve { run, group, tag, ..PageCurve::default() }
}

/// Log of a run's metrics that is read as it grows.
pub struct RunLog {
    folder: RunFolder,
    run: String,
    group: String,
    /// Number of the file: a resume that cuts the log replaces it.
    inode: u64,
    read_bytes: u64,
    begun_unix_s: Option<f64>,
}

impl RunLog {
    /// Creates the log of a run, which is read from its beginning.
    #[must_use]
    pub fn new(folder: RunFolder, run: String) -> Self {
        Self { folder, run, group: String::new(), inode: 0, read_bytes: 0, begun_unix_s: None }
    }

    /// Returns its run.
    pub fn run(&self) -> &str {
        &self.run
    }

    /// Returns the points that were written since the last call, and whether they begin the curves anew: a resume cuts the
    /// log. A missing file and a half line have none.
    pub fn new_points(&mut self) -> (PageCurves, bool) {
        let mut curves: BTreeMap<String, PageCurve> = BTreeMap::new();
        let opened = File::open(self.folder.metrics()).and_then(|file| Ok((file.metadata()?, file)));
        let Ok((found, mut file)) = opened else { return (PageCurves::default(), false) };
        let length = found.len();
        if found.ino() != self.inode || length < self.read_bytes {
            (self.inode, self.read_bytes, self.begun_unix_s) = (found.ino(), 0, None);
        }
        let is_anew = self.read_bytes == 0;
        if length == self.read_bytes || file.seek(SeekFrom::Start(self.read_bytes)).is_err() {
            return (PageCurves::default(), false);
        }
        if is_anew {
            self.group = group(&self.folder).unwrap_or_default();
        }
        let (mut reader, mut line) = (BufReader::new(file), Vec::new());
        while reader.read_until(b'\n', &mut line).is_ok_and(|bytes| bytes > 0) && line.ends_with(b"\n") {
            self.read_bytes += line.len() as u64;
            if let Ok(Metric { tag, step, value, time_unix_s, .. }) = serde_json::from_slice(&line) {
                let begun_unix_s = *self.begun_unix_s.get_or_insert(time_unix_s);
                let new = || empty([self.run.clone(), self.group.clone(), tag.clone()]);
                let curve = curves.entry(tag.clone()).or_insert_with(new);
                curve.steps.push(step as f64);
                curve.wall_s.push(time_unix_s - begun_unix_s);
                curve.values.push(value);
            }
            line.clear();
        }
        (PageCurves { curves: curves.into_values().collect() }, is_anew)
    }
}

/// Returns a text that is equal for runs of the same robot whose configurations differ in seed and labels alone; `None`
/// without a readable configuration.
fn group(folder: &RunFolder) -> Option<String> {
    let mut config: toml::Table = std::fs::read_to_string(folder.config()).ok()?.parse().ok()?;
    let run = config.get_mut("run").and_then(toml::Value::as_table_mut);
    run.into_iter().for_each(|run| ["seed", "tags", "description"].iter().for_each(|key| drop(run.remove(*key))));
    let mut hasher = DefaultHasher::new();
    (config.to_string(), std::fs::read(folder.root().join("model.xml")).ok()).hash(&mut hasher);
    Some(format!("{:016x}", hasher.finish()))
}

#[cfg(test)]
mod tests {
    use std::{fs::OpenOptions, io::Write};

    use super::*;

    fn curve(tag: &str, steps: impl Iterator<Item = u32>) -> PageCurve {
        let steps: Vec<f64> = steps.map(f64::from).collect();
        let values = steps.iter().map(|step| 2.0 * step).collect();
        PageCurve { wall_s: steps.clone(), values, steps, ..empty(["walk", "", tag].map(String::from)) }
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
    fn many_runs_have_all_their_curves_of_fewer_points() {
        let mut store = CurveStore::default();
        for run in 0..32 {
            let of_run = |tag| PageCurve { run: format!("walk-{run}"), ..curve(&format!("tag/{tag}"), 0..2000) };
            store.add(&PageCurves { curves: (0..40).map(of_run).collect() });
        }
        let whole = store.whole().curves;
        assert_eq!(whole.len(), 32 * 40);
        assert!(whole.iter().all(|curve| (POINTS_MIN / 2..=POINTS_MIN).contains(&curve.steps.len())));
        assert_eq!(store.of_run("walk-31").curves.len(), 40);
    }

    #[test]
    fn a_log_is_read_as_it_grows_and_anew_after_it_was_cut() {
        let folder = tempfile::tempdir().unwrap();
        let run = RunFolder::create(Some(&folder.path().join("run")), "walk").unwrap();
        let path = run.metrics();
        let mut log = RunLog::new(run, "walk".into());
        let mut new_steps = |is_anew: bool| -> Vec<f64> {
            let (points, found) = log.new_points();
            assert_eq!(found, is_anew && !points.curves.is_empty(), "{points:?}");
            points.curves.first().map(|curve| curve.steps.clone()).unwrap_or_default()
        };
        assert!(new_steps(false).is_empty());
        let mut file = OpenOptions::new().create(true).append(true).open(&path).unwrap();
        let line =
            |step: u32| format!(r#"{{"run":"walk","tag":"a","step":{step},"value":1.5,"time_unix_s":{}}}"#, 100 + step);
        write!(file, "{}\nnonsense\n{}\n{}", line(1), line(2), &line(3)[..20]).unwrap();
        assert_eq!(new_steps(true), [1.0, 2.0]);
        assert!(new_steps(false).is_empty());
        writeln!(file, "{}", &line(3)[20..]).unwrap();
        assert_eq!(new_steps(false), [3.0]);
        // A resume replaces the file by one without the last steps, and goes on; it may be longer by then.
        let lines: Vec<String> = [1, 2, 30, 31, 32].map(line).to_vec();
        std::fs::write(path.with_extension("new"), lines.join("\n") + "\n").unwrap();
        std::fs::rename(path.with_extension("new"), &path).unwrap();
        assert_eq!(new_steps(true), [1.0, 2.0, 30.0, 31.0, 32.0]);
    }

    #[test]
    fn runs_that_differ_in_their_seed_alone_are_of_one_group() {
        let folder = tempfile::tempdir().unwrap();
        let group_of = |name: &str, config: &str| {
            let run = RunFolder::create(Some(&folder.path().join(name)), "walk").unwrap();
            std::fs::write(run.config(), config).unwrap();
            std::fs::write(run.metrics(), "{\"run\":\"a\",\"tag\":\"b\",\"step\":1,\"value\":1,\"time_unix_s\":1}\n")
                .unwrap();
            RunLog::new(run, name.into()).new_points().0.curves[0].group.clone()
        };
        let first = group_of("first", "[run]\nseed = 1\n[ppo]\ngamma = 0.98\n");
        assert!(!first.is_empty());
        assert_eq!(first, group_of("second", "[run]\nseed = 2\n[ppo]\ngamma = 0.98\n"));
        assert_ne!(first, group_of("third", "[run]\nseed = 1\n[ppo]\ngamma = 0.99\n"));
        assert_ne!(first, group_of("longer", "[run]\nseed = 1\nsteps = 9\n[ppo]\ngamma = 0.98\n"));
        assert_eq!(group_of("fourth", "no configuration"), "");
    }

    #[test]
    fn curves_of_a_run_are_replaced() {
        let mut store = CurveStore::default();
        assert!(!store.remove("walk"));
        store.add(&PageCurves { curves: vec![curve("a", 0..3), PageCurve { run: "g1".into(), ..curve("a", 0..5) }] });
        assert_eq!(store.of_run("walk").curves.len(), 1);
        assert!(store.remove("walk"));
        assert_eq!(store.whole().curves[0].run, "g1");
    }
}
