//! `treadmill export`: a trained policy as a file that other programs read.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use treadmill_common::atomic_file;
use treadmill_learner::checkpoint::Which;

use crate::{output::say, saved_policy};

/// Flags of `export`.
#[derive(Args)]
pub struct ExportArgs {
    /// The run: its folder, its name below runs/, a bundle file, or what `export` wrote.
    run: String,
    /// Write weights, observation statistics and task as one safetensors file.
    #[arg(long, value_name = "FILE")]
    safetensors: PathBuf,
    /// Which checkpoint: best, latest, or the number of updates of a kept one.
    #[arg(long, value_name = "WHICH", default_value = "latest")]
    checkpoint: Which,
}

/// Writes the file and tells what is in it.
pub fn run(args: &ExportArgs) -> anyhow::Result<()> {
    let policy = saved_policy::load(&args.run, args.checkpoint)?;
    let config = saved_policy::trained_under(&policy);
    if !config.is_external() {
        // Nothing is written that `eval` would refuse.
        saved_policy::environment(&args.run, &policy, &config)?;
    }
    let bytes = policy.to_bytes().with_context(|| format!("the policy of `{}` cannot be exported", args.run))?;
    let path = args.safetensors.display();
    atomic_file::write(&args.safetensors, &bytes)
        .with_context(|| format!("cannot write `{path}`; is its folder there, and may you write to it?"))?;
    let widths: Vec<String> = [policy.shape.observation]
        .iter()
        .chain(&policy.shape.hidden)
        .chain([&policy.shape.action])
        .map(ToString::to_string)
        .collect();
    say(&format!(
        "wrote {path}: actor {}, its critic and observation statistics, {} bytes",
        widths.join("-"),
        bytes.len()
    ));
    Ok(())
}
