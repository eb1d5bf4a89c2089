//! `bench train`: speed of this binary's own `train` in a temporary folder.

use std::process::{Command, Stdio};

use anyhow::Context;
use clap::Args;
use serde_json::{Value, json};
use treadmill_runtime::machine;

use super::{print_result, rounded};

/// Flags of `bench train`.
#[derive(Args)]
pub struct BenchTrainArgs {
    /// Environment steps to train.
    #[arg(long, default_value_t = 500_000)]
    steps: u64,
    /// Actor processes; by default one per core.
    #[arg(long)]
    actors: Option<u32>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Runs the measurement and prints its result.
pub fn run(args: &BenchTrainArgs) -> anyhow::Result<()> {
    let folder = tempfile::tempdir().context("cannot create a temporary folder")?;
    let actors = args.actors.unwrap_or(machine::cores() as u32);
    let program = std::env::current_exe().context("the path of this program is unknown")?;
    let output = Command::new(program)
        .args(["train", "--no-progress", "--json"])
        .args(["--steps", &args.steps.to_string(), "--actors", &actors.to_string()])
        .arg("--run-dir")
        .arg(folder.path().join("bench"))
        .stderr(Stdio::inherit())
        .output()
        .context("training cannot be started")?;
    anyhow::ensure!(output.status.success(), "training ended with {}", output.status);
    let text = String::from_utf8_lossy(&output.stdout);
    let summary: Value = serde_json::from_str(text.trim_end().lines().last().unwrap_or_default())
        .context("training ended without a summary")?;
    let number = |field: &str| summary[field].as_f64().with_context(|| format!("the summary has no `{field}`"));
    let result = json!({
        "env_steps_per_s": rounded(number("env_steps_per_s")?),
        "actors": actors,
        "cores": machine::cores(),
        "cpu": machine::cpu_name(),
        "workload": format!("preset walk, {} env steps, start of the actors included", summary["env_steps"]),
        "wall_s": rounded(number("wall_s")?),
        "checksum": format!("{} updates", summary["updates"]),
    });
    print_result(&result, args.json);
    Ok(())
}
