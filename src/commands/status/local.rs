//! Runs of this machine, by their folders.

use std::{fs, path::Path};

use serde_json::json;
use treadmill_runtime::{numbers::thousands, run_folder::RunFolder, run_lock::holder};

use crate::{commands::runs::record::Record, shared::learner_address::ReachArgs};

/// Run that no process trains.
pub struct IdleRun {
    record: Record,
    root: String,
}

/// Returns the run whose folder `reach` names, if no process trains it.
pub fn idle(reach: &ReachArgs) -> Option<anyhow::Result<IdleRun>> {
    let folder = reach.idle_folder()?;
    let root = folder.root().display().to_string();
    Some(Record::read(folder.root()).map(|record| IdleRun { record, root }))
}

/// Returns the folders below `runs/` of runs that are trained now, unless `reach` names a learner.
pub fn live(reach: &ReachArgs) -> Vec<String> {
    if reach.folder.is_some() || !reach.connect.is_empty() || reach.network.discover {
        return Vec::new();
    }
    let entries = fs::read_dir(Path::new("runs")).into_iter().flatten().flatten();
    let mut folders: Vec<String> = entries.map(|entry| entry.path().display().to_string()).collect();
    folders.sort();
    folders.retain(|folder| RunFolder::open(folder).is_ok_and(|folder| holder(&folder).is_some()));
    folders
}

impl IdleRun {
    /// Returns its results and how to go on, as text or as JSON.
    pub fn describe(&self, json: bool) -> String {
        let Self { record, root } = self;
        let distance_m = record.best_eval_distance_m.or(record.training_distance_m);
        if json {
            return json!({
                "run": record.name,
                "phase": record.state(),
                "env_steps": record.env_steps,
                "return_mean": record.training_return,
                "best_distance_m": distance_m,
            })
            .to_string();
        }
        let or_unknown =
            |value: Option<f64>, decimals| value.map_or("unknown".to_string(), |v| format!("{v:.decimals$}"));
        format!(
            "run `{}` is {}: no process trains it\n  steps      {}\n  episodes   return {}, best distance {} m\n  \
             resume     treadmill train --resume {root}",
            record.name,
            record.state(),
            thousands(record.env_steps),
            or_unknown(record.training_return, 0),
            or_unknown(distance_m, 1),
        )
    }
}
