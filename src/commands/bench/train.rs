//! `bench train`: speed of this binary's own `train` in a temporary folder.

use std::{ffi::OsStr, fs, path::PathBuf, process::Stdio};

use anyhow::Context;
use clap::Args;
use serde_json::{Value, json};
use treadmill_config::Config;
use treadmill_runtime::{machine, seeds};

use super::rounded;
use crate::launch::{child, output::say_result, prepared};

/// Flags of `bench train`.
#[derive(Args)]
pub struct BenchTrainArgs {
    /// Environment steps to train.
    #[arg(long, default_value_t = 500_000)]
    steps: u64,
    /// Actor processes; by default one per core.
    #[arg(long)]
    actors: Option<u32>,
    /// Preset to train.
    #[arg(long, default_value = "walk")]
    preset: String,
    /// Model file, as of `train`.
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// Set a configuration key, as in ppo.batch=4096; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Train a second time with the state below this store, and report what that adds to a round.
    #[arg(long, value_name = "URL")]
    store: Option<String>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// What one training took.
struct Measured {
    summary: Value,
    /// Mean time of an update's checkpoint (ms).
    checkpoint_ms: f64,
    /// Mean time between two updates (ms).
    round_ms: f64,
    /// Environment steps per second that each part would allow alone, the ideal speed, and the efficiency.
    parts: serde_json::Map<String, Value>,
}

/// Runs the measurement and prints its result.
pub fn run(args: &BenchTrainArgs) -> anyhow::Result<()> {
    let actors = prepared::actor_processes(args.actors.unwrap_or(0), Config::default().rollout.envs);
    let Measured { summary, checkpoint_ms, round_ms, mut parts } = train(args, actors, None)?;
    let number = |field: &str| summary[field].as_f64().with_context(|| format!("the summary has no `{field}`"));
    let mut result = json!({
        "env_steps_per_s": rounded(number("env_steps_per_s")?),
        "actors": actors,
        "cores": machine::cores(),
        "cpu": machine::cpu_name(),
        "workload": format!("preset {}, {} env steps, start of the actors included", args.preset, summary["env_steps"]),
        "ideal_steps_per_s": parts.remove("ideal"),
        "efficiency": parts.remove("efficiency"),
        "parts": parts,
        "limit": summary["limit"],
        "limit_help": summary["limit_help"],
        "wall_s": rounded(number("wall_s")?),
        "round_ms": rounded(round_ms),
        "checkpoint_ms": rounded(checkpoint_ms),
        "checksum": format!("{} updates", summary["updates"]),
    });
    if let Some(url) = &args.store {
        // A store may keep the run of an earlier benchmark.
        let url = format!("{}/bench-{:016x}", url.trim_end_matches('/'), seeds::unique());
        let stored = train(args, actors, Some(&url))?;
        result["store"] = url.into();
        result["store_env_steps_per_s"] =
            rounded(stored.summary["env_steps_per_s"].as_f64().unwrap_or_default()).into();
        result["store_round_ms"] = rounded(stored.round_ms).into();
        result["store_checkpoint_ms"] = rounded(stored.checkpoint_ms).into();
        let added = (stored.checkpoint_ms - checkpoint_ms) / round_ms;
        result["store_adds_to_round"] = ((added * 1e4).round() / 1e4).into();
    }
    say_result(&result, args.json);
    Ok(())
}

fn train(args: &BenchTrainArgs, actors: u32, store: Option<&str>) -> anyhow::Result<Measured> {
    let folder = tempfile::tempdir().context("cannot create a temporary folder")?;
    let run = folder.path().join("bench");
    let program = std::env::current_exe().context("this program's own path is unknown")?;
    let output = child::command(&program, 0)
        .args(["train", "--no-progress", "--json"])
        .args(["--steps", &args.steps.to_string(), "--actors", &actors.to_string(), "--preset", &args.preset])
        .args(args.set.iter().flat_map(|pair| ["--set", pair]))
        .args(args.model.iter().flat_map(|file| [OsStr::new("--model"), file.as_os_str()]))
        .args(store.into_iter().flat_map(|url| ["--store", url]))
        .arg("--run-dir")
        .arg(&run)
        .stderr(Stdio::inherit())
        .output()
        .context("training cannot be started")?;
    anyhow::ensure!(output.status.success(), "training ended with {}", output.status);
    let text = String::from_utf8_lossy(&output.stdout);
    let summary: Value = serde_json::from_str(text.trim_end().lines().last().unwrap_or_default())
        .context("training ended without a summary")?;
    let updates = summary["updates"].as_f64().context("the summary has no `updates`")?.max(1.0);
    let wall_s = summary["wall_s"].as_f64().context("the summary has no `wall_s`")?;
    let metrics = run.join("metrics.jsonl");
    let text = fs::read_to_string(&metrics).with_context(|| format!("cannot read {}", metrics.display()))?;
    let lines: Vec<Value> = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let checkpoints: Vec<f64> = lines
        .iter()
        .filter(|line| line["tag"] == "time/checkpoint_s")
        .filter_map(|line| line["value"].as_f64())
        .collect();
    anyhow::ensure!(!checkpoints.is_empty(), "{} has no checkpoints", metrics.display());
    // The newest value of each.
    let parts = lines.iter().filter_map(|line| {
        let name = line["tag"].as_str()?.strip_prefix("parts/")?;
        let value = line["value"].as_f64()?;
        Some((name.to_string(), if name == "efficiency" { (value * 1e3).round() / 1e3 } else { rounded(value) }.into()))
    });
    let parts = parts.collect();
    let checkpoint_ms = 1e3 * checkpoints.iter().sum::<f64>() / checkpoints.len() as f64;
    Ok(Measured { summary, checkpoint_ms, round_ms: 1e3 * wall_s / updates, parts })
}
