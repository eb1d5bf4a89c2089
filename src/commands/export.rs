//! `treadmill export`: writes a trained policy as a file that other programs read.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{ArgGroup, Args};
use treadmill_learner::checkpoint::Which;
use treadmill_policy::onnx::to_onnx;
use treadmill_runtime::atomic_file;

use crate::{launch::output::say, shared::saved_policy};

/// Flags of `export`.
#[derive(Args)]
#[command(group(ArgGroup::new("files").args(["safetensors", "onnx"]).multiple(true).required(true)))]
pub struct ExportArgs {
    /// Run folder, name below runs/, bundle file, or a file that `export` wrote.
    run: String,
    /// Write weights, observation statistics and task as one safetensors file.
    #[arg(long, value_name = "FILE")]
    safetensors: Option<PathBuf>,
    /// Write the policy as an ONNX model from raw observations to actions, normalisation included.
    #[arg(long, value_name = "FILE")]
    onnx: Option<PathBuf>,
    /// Checkpoint: best, latest, or the number of updates of a kept one.
    #[arg(long, value_name = "WHICH", default_value = "latest")]
    checkpoint: Which,
}

/// Writes the files and prints what they contain.
pub fn run(args: &ExportArgs) -> anyhow::Result<()> {
    let policy = saved_policy::load(&args.run, args.checkpoint)?;
    let config = saved_policy::trained_under(&policy);
    if !config.is_external() {
        // Refuses a policy that `eval` would refuse.
        saved_policy::environment(&args.run, &policy, &config)?;
    }
    // Also run for ONNX alone, because it checks that shapes match.
    let bytes = policy.to_bytes().with_context(|| format!("the policy of `{}` cannot be exported", args.run))?;
    let widths: Vec<String> = [policy.shape.observation]
        .iter()
        .chain(&policy.shape.hidden)
        .chain([&policy.shape.action])
        .map(ToString::to_string)
        .collect();
    let actor = format!("actor {}", widths.join("-"));
    if let Some(path) = &args.safetensors {
        write(path, &bytes, &format!("{actor}, its critic and observation statistics"))?;
    }
    if let Some(path) = &args.onnx {
        write(path, &to_onnx(&policy), &format!("{actor}, with normalisation and ranges of the motors, as ONNX"))?;
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8], what: &str) -> anyhow::Result<()> {
    let shown = path.display();
    atomic_file::write(path, bytes)
        .with_context(|| format!("cannot write `{shown}`; does its folder exist, and may you write to it?"))?;
    say(&format!("wrote {shown}: {what}, {} bytes", bytes.len()));
    Ok(())
}
