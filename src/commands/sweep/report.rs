//! Results of a sweep: a line for each trial, tables, CSV, picture, and the schedule of the best line.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use serde_json::json;
use treadmill_learner::metrics::{GoalCost, SweptCurve, draw_sweep, table::format_number};
use treadmill_runtime::{
    error_chain,
    numbers::thousands,
    words::{quoted, shown},
};

use super::{
    goal::Goal,
    plan::{self, Plan, SweepFolder, Trial},
    results::{SettingResult, SweepResults, TrialResult},
    search::SweepSearch,
    trials::{flags, last_error},
};
use crate::{
    commands::runs::{duration, print_table, record::Record},
    launch::{
        exit_code::Usage,
        output::{say, say_error},
    },
};

/// Most columns of a row's keys.
const KEYS_CHARS_MAX: usize = 60;

/// Prints the line of a trial that has ended.
pub(crate) fn print_trial(folder: &SweepFolder, plan: &Plan, results: &SweepResults, index: usize, count: usize) {
    let Trial { seed, keys, exit, is_pruned, .. } = &plan.trials[index];
    let found = results.of(index);
    let (steps, seconds) = found.map_or((0, 0.0), |found| (found.record.env_steps, found.record.wall_s));
    let mut line = format!("trial-{} of {count}: seed {seed}", index + 1);
    if !keys.is_empty() {
        line += &format!(", {}", keys_text(keys));
    }
    line += &format!(": {} steps in {}", thousands(steps), duration(seconds));
    line += &match exit {
        _ if *is_pruned => ", pruned".to_string(),
        Some(0) | None => format!(", {}: {}", results.goal, value(found.and_then(|found| found.reached))),
        Some(code) => {
            let why = last_error(&folder.log(index)).unwrap_or_else(|| folder.log(index).display().to_string());
            format!(", failed with exit code {code}: {why}")
        }
    };
    say(&shown(&line));
}

/// Writes `sweep.csv`, and of a population `lineage.csv`.
///
/// # Errors
/// If the folder cannot be written.
pub(crate) fn write_tables(
    folder: &SweepFolder,
    plan: &Plan,
    search: &SweepSearch,
    results: &SweepResults,
) -> anyhow::Result<()> {
    let names: Vec<&str> = search.keys.iter().map(|(key, _)| key.as_str()).collect();
    let begin = "trial,setting,seed,exit,env_steps,wall_s,goal,best_distance_m,velocity_error_mps,return,fall_fraction";
    let mut text = csv_row([begin].into_iter().chain(names.iter().copied()).chain(["state"]).map(str::to_string));
    let mut lineage = csv_row(["trial,parent,env_steps,seed"].into_iter().chain(names).map(str::to_string));
    for (index, trial) in plan.trials.iter().enumerate() {
        let Trial { seed, setting, keys, exit, parent, .. } = trial;
        let found = results.of(index);
        let record = found.map(|found| &found.record);
        let numbers = [
            record.map(|record| record.env_steps as f64),
            record.map(|record| record.wall_s),
            found.and_then(|found| found.reached),
            record.and_then(Record::best_m),
            record.and_then(|record| record.velocity_error_mps),
            record.and_then(|record| record.training_return),
            record.and_then(|record| record.fall_fraction),
        ];
        let (number, state) = ((index + 1).to_string(), state(trial, found).to_string());
        let begin = [number.clone(), setting.to_string(), seed.to_string(), shown_or_empty(*exit)];
        let numbers = numbers.map(shown_or_empty);
        let values = || keys.iter().map(|(_, value)| csv_cell(value));
        text += &csv_row(begin.into_iter().chain(numbers).chain(values()).chain([state]));
        let (parent, steps) =
            (shown_or_empty(parent.map(|(parent, _)| parent + 1)), parent.map_or(0, |(_, steps)| steps));
        lineage += &csv_row([number, parent, steps.to_string(), seed.to_string()].into_iter().chain(values()));
    }
    folder.write("sweep.csv", &text)?;
    if search.interval_steps().is_some() { folder.write("lineage.csv", &lineage) } else { Ok(()) }
}

/// Returns what has become of a trial; nothing before its end.
fn state(trial: &Trial, found: Option<&TrialResult>) -> &'static str {
    match trial.exit {
        None => "",
        _ if trial.is_pruned => "pruned",
        Some(0) if found.is_some_and(|found| found.reached.is_some()) => "complete",
        Some(0) => "not reached",
        Some(_) => "failed",
    }
}

fn shown_or_empty<T: ToString>(number: Option<T>) -> String {
    number.map(|number| number.to_string()).unwrap_or_default()
}

fn csv_row(cells: impl Iterator<Item = String>) -> String {
    cells.collect::<Vec<_>>().join(",") + "\n"
}

fn csv_cell(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_string() }
}

/// Prints the tables of a sweep and draws its picture. `importance` is that of each key, if a study has it.
pub(crate) fn print_end(plan: &Plan, results: &SweepResults, importance: &BTreeMap<String, f64>) {
    let (settings, root) = (results.settings(plan), &results.root);
    if let Err(why) = draw(plan, results, &settings) {
        say_error(&format!("the picture is missing: {}", error_chain(&*why)));
    }
    let Some(best) = results.best(plan) else { return };
    print_table(&results.counted(plan).into_iter().map(|(_, found)| &found.record).collect::<Vec<_>>(), None);
    say(&format!("\nGoal: {}", results.goal));
    say("  setting  trials        mean   deviation      lowest     highest  keys");
    for found in &settings {
        let SettingResult { setting, trials, reached } = found;
        let end = |of: fn(f64, f64) -> f64| reached.iter().copied().reduce(of);
        let cells = [found.mean(), found.deviation(), end(f64::min), end(f64::max)];
        let cells: String = cells.iter().map(|cell| format!("{:>10}  ", value(*cell))).collect();
        let (count, keys) = (format!("{}/{}", reached.len(), trials.len()), keys_text(&plan.trials[trials[0]].keys));
        say(&shown(format!("{setting:>9}  {count:>6}  {cells}{keys}").trim_end()));
    }
    say("trials: those that reached the goal, of all; deviation: standard deviation over their seeds.");
    if !importance.is_empty() {
        let mut shares: Vec<(&String, &f64)> = importance.iter().collect();
        shares.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        say("\nImportance of each key by PED-ANOVA, from the settings that reached the goal:");
        shares.into_iter().for_each(|(key, share)| say(&format!("{:>8.1} %  {key}", share * 100.0)));
    }
    say(&format!("\nBest: {}", shorter(&plan::trial(root, best)).display()));
    if plan.trials[best].parent.is_some() {
        print_schedule(root, plan, best);
    }
    say(&format!("Written: {0}/sweep.csv, {0}/sweep.png", shorter(root).display()));
}

/// Returns the results as JSON.
pub(crate) fn as_json(plan: &Plan, results: &SweepResults, importance: &BTreeMap<String, f64>) -> serde_json::Value {
    let setting = |found: SettingResult| {
        json!({
            "setting": found.setting,
            "keys": plan.trials[found.trials[0]].keys.iter().cloned().collect::<BTreeMap<_, _>>(),
            "trials": found.trials.iter().map(|index| index + 1).collect::<Vec<_>>(),
            "mean": found.mean(),
            "deviation": found.deviation(),
        })
    };
    let states: Vec<&str> =
        plan.trials.iter().enumerate().map(|(index, trial)| state(trial, results.of(index))).collect();
    let count = |wanted: &str| states.iter().filter(|state| **state == wanted).count();
    json!({
        "sweep": results.root,
        "goal": results.goal.to_string(),
        "trials": states.len(),
        "complete": count("complete"),
        "not_reached": count("not reached"),
        "failed": count("failed"),
        "pruned": count("pruned"),
        "best": results.best(plan).map(|index| format!("trial-{}", index + 1)),
        "settings": results.settings(plan).into_iter().map(setting).collect::<Vec<_>>(),
        "importance": importance,
    })
}

fn draw(plan: &Plan, results: &SweepResults, settings: &[SettingResult]) -> anyhow::Result<()> {
    let SweepResults { root, goal, .. } = results;
    let curve = |found: &SettingResult| SweptCurve {
        name: keys_text(&plan.trials[found.trials[0]].keys),
        lines: found.trials.iter().map(|index| line(root, plan, *index)).collect(),
    };
    let curves: Vec<SweptCurve> = settings.iter().map(curve).collect();
    let title = format!("{}: {goal}", root.file_name().unwrap_or_default().to_string_lossy());
    Ok(draw_sweep(&title, &curves, &goal.tag, &cost(plan, results), &root.join("sweep.png"))?)
}

/// Returns what the trials reached, in their order, against what they cost.
fn cost(plan: &Plan, results: &SweepResults) -> GoalCost {
    let goal = &results.goal;
    let mut cost = GoalCost { goal: goal.to_string(), ..GoalCost::default() };
    let mut steps_m = 0.0;
    for (index, trial) in plan.trials.iter().enumerate() {
        let Some(found) = results.of(index) else { continue };
        // A fork begins with the steps of its parent.
        let begun = trial.parent.map_or(0, |(_, steps)| steps);
        steps_m += found.record.env_steps.saturating_sub(begun) as f64 / 1e6;
        let Some(reached) = found.reached else { continue };
        cost.trials.push((steps_m, reached));
        if cost.best.last().is_none_or(|(_, best)| goal.order(Some(reached)) < goal.order(Some(*best))) {
            cost.best.push((steps_m, reached));
        }
    }
    cost
}

/// Returns a path from the working directory, if it is below it.
pub(crate) fn shorter(path: &Path) -> PathBuf {
    let here = std::env::current_dir().and_then(std::fs::canonicalize).unwrap_or_default();
    path.strip_prefix(here).map_or_else(|_| path.to_path_buf(), Path::to_path_buf)
}

/// Returns the trials from which a trial descends, the first one first, each with the step at which the next one begins.
fn ancestors(plan: &Plan, index: usize) -> Vec<(usize, u64)> {
    let mut line = vec![(index, u64::MAX)];
    // A parent is older than its fork.
    while let Some((parent, steps)) =
        line.last().and_then(|(index, _)| plan.trials[*index].parent.filter(|(parent, _)| parent < index))
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

/// Prints the commands that train the best line of a sweep anew.
///
/// # Errors
/// If there is no sweep or no result.
pub(crate) fn print_best_schedule(sweep: &str) -> anyhow::Result<()> {
    let root = plan::find(sweep)?;
    let plan = plan::read(&root)?;
    let (search, goal) = (plan.search()?, Goal::read(&plan.goal).map_err(Usage)?);
    let mut results = SweepResults::of_ended(&root, &plan, &goal, search.interval_steps().is_some());
    plan.unfinished().into_iter().for_each(|index| results.read(&plan, index));
    match results.best(&plan) {
        Some(best) => print_schedule(&root, &plan, best),
        None => anyhow::bail!("no trial of `{sweep}` has reached anything yet; wait for its first results"),
    }
    Ok(())
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
