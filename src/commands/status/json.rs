//! Statuses of runs as JSON objects.

use serde_json::json;
use treadmill_proto::{Phase, PoolDemand, RunStatus};

use super::plain::state;

/// Returns a line with one object for each run.
pub fn as_json(runs: &[RunStatus]) -> String {
    runs.iter().map(|run| json_of(run).to_string() + "\n").collect()
}

fn json_of(run: &RunStatus) -> serde_json::Value {
    let version = |version: Option<treadmill_proto::PolicyVersion>| version.map(|version| version.number);
    let actors: Vec<_> = run
        .actors
        .iter()
        .map(|actor| {
            let stats = actor.stats.as_ref();
            json!({
                "name": actor.name,
                "state": state(actor),
                "host": stats.map(|stats| &stats.host),
                "pid": stats.map(|stats| stats.pid),
                "program_version": stats.map(|stats| &stats.program_version),
                "policy_version": stats.and_then(|stats| version(stats.version)),
                "lag_versions": actor.lag_versions,
                "envs": stats.map(|stats| stats.envs),
                "env_steps": stats.map(|stats| stats.env_steps),
                "env_steps_per_s": stats.map(|stats| stats.env_steps_per_s),
                "since_contact_s": actor.since_contact_s,
                "produced": stats.map(|stats| stats.produced),
                "accepted": stats.map(|stats| stats.accepted),
                "dropped_by_rule": stats.map(|stats| stats.dropped_by_rule),
                "in_flight": stats.map(|stats| stats.in_flight),
                "resent": stats.map(|stats| stats.resent),
                "resident_bytes": stats.map(|stats| stats.resident_bytes),
            })
        })
        .collect();
    let parts = run.parts.iter().map(|part| (part.name.clone(), part.share.into()));
    let parts: serde_json::Map<String, serde_json::Value> = parts.collect();
    json!({
        "run": run.run,
        "phase": match run.phase() {
            Phase::Paused => "paused",
            Phase::Stopping => "stopping",
            Phase::Training | Phase::Unspecified => "training",
        },
        "host": run.host,
        "pid": run.pid,
        "program_version": run.program_version,
        "policy_version": version(run.version),
        "epoch": run.version.map(|version| version.epoch),
        "env_steps": run.env_steps,
        "env_steps_wanted": run.env_steps_wanted,
        "env_steps_per_s": run.env_steps_per_s,
        "updates": run.updates,
        "since_update_s": run.since_update_s,
        "wall_s": run.wall_s,
        "return_mean": run.return_mean,
        "length_mean": run.length_mean,
        "distance_mean_m": run.distance_mean_m,
        "velocity_mean_mps": run.velocity_mean_mps,
        "velocity_error_mps": run.velocity_error_mps,
        "yaw_rate_error_radps": run.yaw_rate_error_radps,
        "done_share": run.done_share,
        "body_error_m": run.body_error_m,
        "fall_fraction": run.fall_fraction,
        "accepted_bytes": run.accepted_bytes,
        "policy_lag_mean": run.policy_lag_mean,
        "resident_bytes": run.resident_bytes,
        "fragments": {
            "accepted": run.accepted, "duplicate": run.duplicate, "too_old": run.too_old, "vanished": run.vanished,
            "malformed": run.malformed, "quarantined": run.quarantined,
        },
        "used_share": run.used_share,
        "idle_share": run.idle_share,
        "parts": parts,
        "limit": run.limit,
        "limit_help": run.limit_help,
        "undone_updates": run.undone_updates,
        "alarms": run.alarms,
        "waits_for_storage": run.waits_for_storage,
        "actors": actors,
        "pool": run.pool.as_ref().map(of_pool),
    })
}

fn of_pool(pool: &PoolDemand) -> serde_json::Value {
    json!({
        "share": pool.share,
        "is_open": pool.open,
        "envs_min": pool.envs_min,
        "envs_max": pool.envs_max,
        "envs_own": pool.envs_own,
        "envs_target": pool.envs_target,
        "envs": pool.envs,
        "actors": pool.actors,
        "pool_actors": pool.pool_actors,
        "pool_envs": pool.pool_envs,
    })
}
