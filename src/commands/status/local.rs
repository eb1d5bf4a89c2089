//! Runs of this machine, by their folders.

use serde_json::json;
use treadmill_runtime::numbers::thousands;

use crate::{commands::runs::record::Record, launch::resume_line, shared::learner_address::ReachArgs};

/// Returns the results of the run whose folder `reach` names, and how to go on, if no process trains it: as text or as
/// JSON.
pub fn idle(reach: &ReachArgs, json: bool) -> Option<anyhow::Result<String>> {
    let folder = reach.idle_folder()?;
    Some(Record::read(folder.root()).map(|record| describe(&record, &resume_line::of_folder(&folder), json)))
}

fn describe(record: &Record, resumed_by: &str, json: bool) -> String {
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
    let or_unknown = |value: Option<f64>, decimals| value.map_or("unknown".to_string(), |v| format!("{v:.decimals$}"));
    format!(
        "run `{}` is {}: no process trains it\n  steps      {}\n  episodes   return {}, best distance {} m\n  \
         resume     {resumed_by}",
        record.name,
        record.state(),
        thousands(record.env_steps),
        or_unknown(record.training_return, 0),
        or_unknown(distance_m, 1),
    )
}
