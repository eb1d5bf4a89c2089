//! Runs that no process here trains, by their folders and stores.

use std::fs;

use serde_json::json;
use treadmill_learner::{
    leadership::{Manifest, Status, read_manifest},
    metrics::progress::imitation,
};
use treadmill_runtime::{numbers::thousands, run_lock::killed, words::quoted};
use treadmill_store::Store;

use crate::{commands::runs::record::Record, launch::resume_line, shared::learner_address::ReachArgs};

/// Text about a run that no process trains by this folder.
pub struct Idle {
    /// Text or JSON.
    pub text: String,
    /// Whether its process was killed.
    pub was_killed: bool,
}

/// Returns the results of the run whose folder or store `reach` names, and how to go on, if no process here trains it:
/// as text or as JSON.
pub fn idle(reach: &ReachArgs, json: bool) -> Option<anyhow::Result<Idle>> {
    if let Some(url) = reach.folder.as_ref().filter(|run| run.contains("://")) {
        return Some(Record::of_store(url).map(|(record, manifest)| {
            let resumed_by = format!("treadmill train --store {} --resume-or-start", quoted(url));
            Idle { text: describe(&record, &resumed_by, Some(&manifest), json), was_killed: false }
        }));
    }
    let folder = reach.idle_folder()?;
    // Another machine may lead a run whose state is in a store.
    let url = fs::read_to_string(folder.store()).ok();
    let manifest = url.and_then(|url| Some(read_manifest(&Store::open(url.trim()).ok()?).ok()??.0));
    // The store may still name the process that was killed here.
    let killed = killed(&folder);
    let manifest =
        manifest.filter(|of| killed.as_ref().is_none_or(|last| (last.pid, &last.host) != (Some(of.pid), &of.host)));
    Some(Record::read(folder.root()).map(|record| {
        let was_killed = record.state() == "killed" && manifest.is_none();
        Idle { text: describe(&record, &resume_line::of_folder(&folder), manifest.as_ref(), json), was_killed }
    }))
}

fn describe(record: &Record, resumed_by: &str, manifest: Option<&Manifest>, json: bool) -> String {
    let leader = manifest.filter(|manifest| manifest.status == Status::Training);
    let distance_m = record.best_m();
    if json {
        return json!({
            "run": record.name,
            "phase": record.state(),
            "env_steps": record.env_steps,
            "return_mean": record.training_return,
            "best_distance_m": distance_m,
            "velocity_error_mps": record.velocity_error_mps,
            "done_share": record.done_share,
            "body_error_m": record.body_error_m,
            "fall_fraction": record.fall_fraction,
            "leader": leader.map(|leader| json!({"host": leader.host, "pid": leader.pid, "epoch": leader.epoch})),
        })
        .to_string();
    }
    let or_unknown = |value: Option<f64>, decimals| value.map_or("unknown".to_string(), |v| format!("{v:.decimals$}"));
    let (state, who) = match leader {
        Some(Manifest { host, pid, epoch, .. }) => {
            ("led elsewhere", format!("its store names process {pid} on host {host}, in epoch {epoch}"))
        }
        None if record.state() == "killed" => {
            ("killed", "its process ended without saving what followed the last checkpoint".to_string())
        }
        None => (record.state(), "no process trains it".to_string()),
    };
    let imitated = record.done_share.zip(record.body_error_m).map(<[f64; 2]>::from);
    let moved = match (record.has_commands(), record.velocity_error_mps) {
        (true, error_mps) => format!("velocity error {} m/s", or_unknown(error_mps, 2)),
        (false, _) => imitated.map_or_else(|| format!("best distance {} m", or_unknown(distance_m, 1)), imitation),
    };
    format!(
        "run `{}` is {state}: {who}\n  steps      {}\n  episodes   return {}, {moved}\n  \
         resume     {resumed_by}",
        record.name,
        thousands(record.env_steps),
        or_unknown(record.training_return, 0),
    )
}
