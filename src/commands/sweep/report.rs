//! Results of a sweep: a line for each trial, tables, CSV, picture, and the schedule of the best line.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use serde_json::json;
use treadmill_learner::metrics::{SweptCurve, draw_sweep, table::format_number};
use treadmill_runtime::{
    error_chain,
    numbers::thousands,
    words::{quoted, shown},
};

use super::{
    goal::Goal,
    plan::{self, Plan, SweepFolder, Trial},
    search::Search,
    trials::{flags, last_error},
};
use crate::{
    commands::runs::{duration, print_table, record::Record},
    launch::output::{say, say_error},
};

/// Most columns of a row's keys.
const KEYS_CHARS_MAX: usize = 60;

/// Trial that has begun, with its results.
pub(crate) struct Outcome {
    index: usize,
    record: Record,
    /// What it reached.
    pub(crate) reached: Option<f64>,
}

impl Outcome {
    /// Reads the results of a trial, if it has begun.
    pub(crate) fn read(root: &Path, index: usize, goal: &Goal) -> Option<Self> {
        let run = plan::trial(root, index);
        let record = Record::read(&run).ok()?;
        Some(Self { index, record, reached: goal.reached(&run) })
    }
}

/// Prints the line of a trial that has ended.
pub(crate) fn print_trial(folder: &SweepFolder, plan: &Plan, index: usize, code: i32, goal: &Goal) {
    let Trial { seed, keys, .. } = &plan.trials[index];
    let outcome = Outcome::read(folder.root(), index, goal);
    let (steps, seconds) = outcome.as_ref().map_or((0, 0.0), |found| (found.record.env_steps, found.record.wall_s));
    let reached = value(outcome.and_then(|found| found.reached));
    let mut line = format!("trial-{} of {}: seed {seed}", index + 1, plan.trials.len());
    if !keys.is_empty() {
        line += &format!(", {}", keys_text(keys));
    }
    line += &format!(": {} steps in {}, {goal}: {reached}", thousands(steps), duration(seconds));
    if code != 0 {
        let why = last_error(&folder.log(index)).unwrap_or_else(|| folder.log(index).display().to_string());
        line += &format!(", failed with exit code {code}: {why}");
    }
    say(&shown(&line));
}

/// Writes `sweep.csv`, and of a population `lineage.csv`.
///
/// # Errors
/// If the folder cannot be written.
pub(crate) fn write_tables(folder: &SweepFolder, plan: &Plan, search: &Search, goal: &Goal) -> anyhow::Result<()> {
    let names: Vec<&str> = search.keys.iter().map(|(key, _)| key.as_str()).collect();
    let begin = "trial,setting,seed,exit,env_steps,wall_s,goal,best_distance_m,velocity_error_mps,return,fall_fraction";
    let mut text = csv_row([begin].into_iter().chain(names.iter().copied()).map(str::to_string));
    let mut lineage = csv_row(["trial,parent,env_steps,seed"].into_iter().chain(names).map(str::to_string));
    for (index, trial) in plan.trials.iter().enumerate() {
        let found = Outcome::read(folder.root(), index, goal);
        let number = |of: fn(&Record) -> Option<f64>| {
            found.as_ref().and_then(|found| of(&found.record)).map_or_else(String::new, |number| number.to_string())
        };
        let results = [
            (index + 1).to_string(),
            trial.setting.to_string(),
            trial.seed.to_string(),
            trial.exit.map_or_else(String::new, |code| code.to_string()),
            found.as_ref().map_or_else(String::new, |found| found.record.env_steps.to_string()),
            number(|record| Some(record.wall_s)),
            found.as_ref().and_then(|found| found.reached).map_or_else(String::new, |number| number.to_string()),
            number(Record::best_m),
            number(|record| record.velocity_error_mps),
            number(|record| record.training_return),
            number(|record| record.fall_fraction),
        ];
        let values = || trial.keys.iter().map(|(_, value)| csv_cell(value));
        text += &csv_row(results.into_iter().chain(values()));
        let (parent, steps) =
            trial.parent.map_or((String::new(), 0), |(parent, steps)| ((parent + 1).to_string(), steps));
        let begin = [(index + 1).to_string(), parent, steps.to_string(), trial.seed.to_string()];
        lineage += &csv_row(begin.into_iter().chain(values()));
    }
    folder.write("sweep.csv", &text)?;
    if search.interval_steps().is_some() { folder.write("lineage.csv", &lineage) } else { Ok(()) }
}

fn csv_row(cells: impl Iterator<Item = String>) -> String {
    cells.collect::<Vec<_>>().join(",") + "\n"
}

fn csv_cell(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_string() }
}

/// Setting with the results of its trials.
struct Summary {
    setting: usize,
    trials: Vec<usize>,
    reached: Vec<f64>,
}

impl Summary {
    fn mean(&self) -> Option<f64> {
        (!self.reached.is_empty()).then(|| self.reached.iter().sum::<f64>() / self.reached.len() as f64)
    }

    /// Returns the standard deviation of the sample.
    fn deviation(&self) -> Option<f64> {
        let mean = self.mean().filter(|_| self.reached.len() > 1)?;
        let squares: f64 = self.reached.iter().map(|value| (value - mean).powi(2)).sum();
        Some((squares / (self.reached.len() - 1) as f64).sqrt())
    }
}

/// Results of all trials.
pub(crate) struct Results {
    outcomes: Vec<Outcome>,
    /// Settings, the best first: those that more trials reached, then by the mean.
    summaries: Vec<Summary>,
    /// Best trial of the best setting.
    pub(crate) best: Option<usize>,
}

impl Results {
    /// Reads the results of the trials that have begun. Those of a population that were replaced only led to others.
    pub(crate) fn read(root: &Path, plan: &Plan, search: &Search, goal: &Goal) -> Self {
        let indices = if search.interval_steps().is_some() { plan.living() } else { (0..plan.trials.len()).collect() };
        let outcomes: Vec<Outcome> = indices.into_iter().filter_map(|index| Outcome::read(root, index, goal)).collect();
        let mut summaries: Vec<Summary> = Vec::new();
        for Outcome { index, reached, .. } in &outcomes {
            let setting = plan.trials[*index].setting;
            let place = summaries.iter().position(|known| known.setting == setting).unwrap_or_else(|| {
                summaries.push(Summary { setting, trials: Vec::new(), reached: Vec::new() });
                summaries.len() - 1
            });
            summaries[place].trials.push(*index);
            summaries[place].reached.extend(reached);
        }
        let missing = |found: &Summary| found.trials.len() - found.reached.len();
        summaries.sort_by(|one, other| {
            let by_mean = goal.order(one.mean()).total_cmp(&goal.order(other.mean()));
            missing(one).cmp(&missing(other)).then(by_mean)
        });
        let of_best = |found: &&Outcome| summaries.first().is_some_and(|best| best.trials.contains(&found.index));
        let by_goal = |one: &&Outcome, other: &&Outcome| goal.order(one.reached).total_cmp(&goal.order(other.reached));
        let best = outcomes.iter().filter(of_best).min_by(by_goal).map(|found| found.index);
        Self { outcomes, summaries, best }
    }

    fn as_json(&self, root: &Path, plan: &Plan, goal: &Goal) -> serde_json::Value {
        let setting = |found: &Summary| {
            json!({
                "keys": plan.trials[found.trials[0]].keys.iter().cloned().collect::<BTreeMap<_, _>>(),
                "trials": found.trials.iter().map(|index| index + 1).collect::<Vec<_>>(),
                "mean": found.mean(),
                "deviation": found.deviation(),
            })
        };
        json!({
            "sweep": root,
            "goal": goal.to_string(),
            "trials": plan.trials.len(),
            "failed": plan.failed(),
            "best": self.best.map(|index| format!("trial-{}", index + 1)),
            "settings": self.summaries.iter().map(setting).collect::<Vec<_>>(),
        })
    }

    fn print_settings(&self, plan: &Plan, goal: &Goal) {
        say(&format!("\nGoal: {goal}"));
        say("  setting  trials        mean   deviation      lowest     highest  keys");
        for found in &self.summaries {
            let Summary { setting, trials, reached } = found;
            let end = |of: fn(f64, f64) -> f64| reached.iter().copied().reduce(of);
            let cells = [found.mean(), found.deviation(), end(f64::min), end(f64::max)];
            let cells: String = cells.iter().map(|cell| format!("{:>10}  ", value(*cell))).collect();
            let (count, keys) =
                (format!("{}/{}", reached.len(), trials.len()), keys_text(&plan.trials[trials[0]].keys));
            say(&shown(format!("{setting:>9}  {count:>6}  {cells}{keys}").trim_end()));
        }
        say("trials: those that reached the goal, of all; deviation: standard deviation over their seeds.");
    }

    fn draw(&self, root: &Path, plan: &Plan, goal: &Goal) {
        let curve = |found: &Summary| SweptCurve {
            name: keys_text(&plan.trials[found.trials[0]].keys),
            lines: found.trials.iter().map(|index| line(root, plan, *index)).collect(),
        };
        let curves: Vec<SweptCurve> = self.summaries.iter().map(curve).collect();
        let title = format!("{}: {goal}", root.file_name().unwrap_or_default().to_string_lossy());
        if let Err(why) = draw_sweep(&title, &curves, &goal.tag, &root.join("sweep.png")) {
            say_error(&format!("the picture is missing: {}", error_chain(&why)));
        }
    }
}

/// Prints the tables of a sweep, draws its picture, and returns the results as JSON.
pub(crate) fn print_end(folder: &SweepFolder, plan: &Plan, search: &Search, goal: &Goal) -> serde_json::Value {
    let root = folder.root();
    let results = Results::read(root, plan, search, goal);
    results.draw(root, plan, goal);
    if let Some(best) = results.best {
        print_table(&results.outcomes.iter().map(|found| &found.record).collect::<Vec<_>>(), None);
        results.print_settings(plan, goal);
        say(&format!("\nBest: {}", shorter(&folder.trial(best)).display()));
        if search.interval_steps().is_some() {
            print_schedule(root, plan, best);
        }
        say(&format!("Written: {0}/sweep.csv, {0}/sweep.png", shorter(root).display()));
    }
    results.as_json(root, plan, goal)
}

/// Returns a path from the working directory, if it is below it.
pub(crate) fn shorter(path: &Path) -> PathBuf {
    let here = std::env::current_dir().and_then(std::fs::canonicalize).unwrap_or_default();
    path.strip_prefix(here).map_or_else(|_| path.to_path_buf(), Path::to_path_buf)
}

/// Returns the trials from which a trial descends, the first one first, each with the step at which the next one begins.
fn ancestors(plan: &Plan, index: usize) -> Vec<(usize, u64)> {
    let mut line = vec![(index, u64::MAX)];
    while let Some((parent, steps)) = line.last().and_then(|(index, _)| plan.trials.get(*index)?.parent)
        && line.len() <= plan.trials.len()
    {
        line.push((parent, steps));
    }
    line.reverse();
    line
}

/// Returns the logs of a trial and its ancestors, each with its last step.
fn line(root: &Path, plan: &Plan, index: usize) -> Vec<(PathBuf, u64)> {
    let line = ancestors(plan, index).into_iter();
    line.map(|(index, until)| (plan::trial(root, index).join("metrics.jsonl"), until)).collect()
}

/// Prints the commands that train a trial of a population anew.
pub(crate) fn print_schedule(root: &Path, plan: &Plan, best: usize) {
    say(&format!("\nSchedule of {}, as commands that train it anew:", shorter(&plan::trial(root, best)).display()));
    for (number, (index, until)) in ancestors(plan, best).into_iter().enumerate() {
        let Trial { seed, keys, .. } = &plan.trials[index];
        let mut words: Vec<String> = vec!["treadmill".into(), "train".into()];
        words.extend((number > 0).then(|| format!("--fork=runs/line-{number}")));
        words.extend(flags(plan, number > 0, true));
        words.extend(keys.iter().map(|(key, value)| format!("--set={key}={value}")));
        words.push(format!("--seed={seed}"));
        words.push(format!("--steps={}", until.min(plan.steps)));
        words.push(format!("--run-dir=runs/line-{}", number + 1));
        say(&words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" "));
    }
}

/// Prints that a trial forked another one.
pub(crate) fn print_fork(plan: &Plan, index: usize) {
    let Trial { keys, parent, .. } = &plan.trials[index];
    let (parent, steps) = parent.unwrap_or_default();
    let (name, parent, steps) = (index + 1, parent + 1, thousands(steps));
    say(&shown(&format!("trial-{name} forks trial-{parent} at {steps} steps: {}", keys_text(keys))));
}

fn value(number: Option<f64>) -> String {
    number.map_or_else(|| "–".to_string(), format_number)
}

fn keys_text(keys: &[(String, String)]) -> String {
    let text = keys.iter().map(|(key, value)| format!("{key} = {value}")).collect::<Vec<_>>().join(", ");
    if text.chars().count() <= KEYS_CHARS_MAX {
        return text;
    }
    // Sections cost the most room.
    let name = |key: &str| key.rsplit('.').next().unwrap_or_default().to_string();
    keys.iter().map(|(key, value)| format!("{} = {value}", name(key))).collect::<Vec<_>>().join(", ")
}
