//! `treadmill runs`: compares trained runs and their configurations.

pub(crate) mod record;

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::Args;
use serde_json::json;
use treadmill_runtime::{
    numbers::thousands,
    words::{quoted, shown},
};

use self::record::Record;
use crate::{
    launch::{
        exit_code::Usage,
        output::{say, say_error},
    },
    shared::foreign_text::shorten,
};

/// Flags of `runs`.
#[derive(Args)]
pub struct RunsArgs {
    /// Run folders, or folders that contain run folders.
    #[arg(default_value = "runs")]
    paths: Vec<PathBuf>,
    /// Also print the configuration keys whose values differ between the runs.
    #[arg(long)]
    keys: bool,
    /// Print only one JSON object per run.
    #[arg(long)]
    json: bool,
}

/// Reads and prints the runs, sorted by distance, farthest first.
pub fn run(args: &RunsArgs) -> anyhow::Result<()> {
    let (mut records, mut damaged) = (Vec::new(), Vec::new());
    for path in &args.paths {
        if let Some(url) = path.to_str().filter(|path| path.contains("://")) {
            records.push(Record::of_store(url)?.0);
            continue;
        }
        for folder in runs_in(path)? {
            match Record::read(&folder) {
                Ok(record) => records.push(record),
                Err(why) => damaged.push(why),
            }
        }
    }
    if records.is_empty()
        && let Some(why) = damaged.pop()
    {
        return Err(why);
    }
    // One damaged run must not hide the others.
    damaged.iter().for_each(|why| say_error(&format!("left out: {why:#}")));
    if records.is_empty() {
        let shown: Vec<_> = args.paths.iter().map(|path| format!("`{}`", path.display())).collect();
        return Err(Usage(format!("there is no run in {}; name a folder that contains one", shown.join(", "))).into());
    }
    records.sort_by(|one, other| {
        let ((one, by), (other, to)) = (one.order(), other.order());
        one.cmp(&other).then(by.total_cmp(&to))
    });
    let differences = differences(&records);
    if args.json {
        records.iter().zip(&differences).for_each(|(record, changes)| say(&as_json(record, changes)));
    } else {
        print_table(&records.iter().collect::<Vec<_>>(), args.keys.then_some(&differences));
        if !args.keys && records.len() > 1 {
            let paths: String =
                args.paths.iter().map(|path| format!(" {}", quoted(&path.display().to_string()))).collect();
            say(&format!("Configuration keys that differ: treadmill runs{paths} --keys"));
        }
    }
    Ok(())
}

/// Returns the folder if it is a run's, else the runs directly in it, sorted by name.
fn runs_in(path: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let is_run = |folder: &Path| folder.join("config.toml").is_file();
    if is_run(path) {
        return Ok(vec![path.to_path_buf()]);
    }
    let entries = fs::read_dir(path).with_context(|| format!("cannot read the folder `{}`", path.display()))?;
    let mut found: Vec<_> = entries.flatten().map(|entry| entry.path()).filter(|folder| is_run(folder)).collect();
    found.sort();
    Ok(found)
}

/// Returns for each run its values of those keys whose values differ between runs.
fn differences(records: &[Record]) -> Vec<BTreeMap<&str, &str>> {
    let keys: BTreeSet<&str> = records.iter().flat_map(|record| record.config.keys().map(String::as_str)).collect();
    let differs = |key: &&str| records.iter().any(|record| record.config.get(*key) != records[0].config.get(*key));
    let differing: Vec<&str> = keys.into_iter().filter(differs).collect();
    let value = |record, key: &str| Record::config_value(record, key);
    records.iter().map(|record| differing.iter().map(|key| (*key, value(record, key))).collect()).collect()
}

fn as_json(record: &Record, changes: &BTreeMap<&str, &str>) -> String {
    json!({
        "run": record.name,
        "folder": record.folder,
        "task": record.task(),
        "state": record.state(),
        "tags": record.tags,
        "description": record.description,
        "env_steps": record.env_steps,
        "wall_s": record.wall_s,
        "env_steps_per_s": record.env_steps_per_s(),
        "best_eval_distance_m": record.best_eval_distance_m,
        "best_eval_at_env_steps": record.best_eval_at,
        "training_distance_m": record.training_distance_m,
        "training_return": record.training_return,
        "fall_fraction": record.fall_fraction,
        "velocity_error_mps": record.velocity_error_mps,
        "done_share": record.done_share,
        "body_error_m": record.body_error_m,
        "config_differences": changes,
    })
    .to_string()
}

const HEADINGS: [&str; 8] = ["run", "task", "env steps", "reached", "return", "falls", "time", "state"];
/// Longest name that is shown, so that a row fits into 100 columns.
const NAME_CHARS_MAX: usize = 28;
const TASK_CHARS_MAX: usize = 14;
/// Most characters of a row.
const ROW_CHARS_MAX: usize = 100;

/// Prints a table of runs, with a legend.
pub(crate) fn print_table(records: &[&Record], differences: Option<&[BTreeMap<&str, &str>]>) {
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "–".to_string());
    let rows: Vec<[String; 8]> = records
        .iter()
        .map(|record| {
            // Without an evaluation, the distance in training, in brackets because exploration shortens it.
            let tracked = record.velocity_error_mps.map(|error| format!("± {error:.2} m/s"));
            let imitated = record.done_share.zip(record.body_error_m);
            let imitated = imitated.map(|(done, error_m)| format!("{:.0} % ± {:.1} cm", 100.0 * done, 100.0 * error_m));
            let evaluated =
                tracked.or(imitated).or_else(|| record.best_eval_distance_m.map(|metres| format!("{metres:.1} m")));
            let distance = evaluated.or_else(|| record.training_distance_m.map(|metres| format!("({metres:.1} m)")));
            [
                shorten(&record.name, NAME_CHARS_MAX),
                shorten(&record.task(), TASK_CHARS_MAX),
                thousands(record.env_steps),
                or_none(distance),
                or_none(record.training_return.map(|sum| format!("{sum:.0}"))),
                or_none(record.fall_fraction.map(|share| format!("{:.0} %", share * 100.0))),
                duration(record.wall_s),
                record.state().to_string(),
            ]
        })
        .collect();
    let width = |column: usize| {
        rows.iter().map(|row| row[column].chars().count()).chain([HEADINGS[column].len()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..HEADINGS.len()).map(width).collect();
    let line = |cells: [&str; 8]| {
        let cell = |(column, (cell, width)): (usize, (&&str, &usize))| match column {
            0 => format!("{cell:<width$}"),
            1 => format!("  {cell:<width$}"),
            7 => format!("  {cell}"),
            _ => format!("  {cell:>width$}"),
        };
        cells.iter().zip(&widths).enumerate().map(cell).collect::<String>()
    };
    say(&shown(&line(HEADINGS)));
    for (number, row) in rows.iter().enumerate() {
        say(&shown(&line(row.each_ref().map(String::as_str))));
        let Record { tags, description, .. } = records[number];
        let labels: String = tags.iter().map(|tag| format!("[{tag}] ")).collect::<String>() + description;
        if !labels.is_empty() {
            say(&shown(&shorten(&format!("    {}", labels.trim_end()), ROW_CHARS_MAX)));
        }
        for (key, value) in differences.and_then(|all| all.get(number)).into_iter().flatten() {
            say(&format!("    {key} = {value}"));
        }
    }
    say("");
    say("reached: mean distance of the best evaluation, in brackets that of the last training episodes;");
    say("with commands (±) the mean velocity error of the last evaluation, with motions the share done");
    say("and the error of the links (±).");
    say("return, falls: of the last training episodes.");
}

/// Formats a duration.
pub(crate) fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes} min {seconds:02} s"),
        (hours, minutes, _) => format!("{hours} h {minutes:02} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_formatted() {
        assert_eq!(
            [4.2, 59.6, 61.0, 3599.0, 3660.0].map(duration),
            ["4 s", "1 min 00 s", "1 min 01 s", "59 min 59 s", "1 h 01 min"]
        );
    }
}
