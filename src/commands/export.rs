//! `treadmill export`: writes a trained policy as a file that other programs read.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{ArgGroup, Args};
use serde_json::json;
use treadmill_learner::checkpoint::Which;
use treadmill_policy::onnx::to_onnx;
use treadmill_runtime::atomic_file;

use crate::{
    launch::output::say,
    shared::saved_policy::{self, Origin, SavedPolicy},
};

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
    /// Checkpoint: best, latest, or the number of updates of a kept one; by default best if it exists.
    #[arg(long, value_name = "WHICH")]
    checkpoint: Option<Which>,
    /// Print only one JSON object.
    #[arg(long)]
    json: bool,
}

/// Writes the files and prints what they contain.
pub fn run(args: &ExportArgs) -> anyhow::Result<()> {
    let SavedPolicy { policy, origin, .. } = saved_policy::load(&args.run, args.checkpoint)?;
    let config = policy.config();
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
    let of = origin.as_ref().map(|origin| format!("{origin}: ")).unwrap_or_default();
    let actor = format!("{of}actor {}", widths.join("-"));
    let mut written = Vec::new();
    if let Some(path) = &args.safetensors {
        let what = format!("{actor}, its critic and observation statistics");
        written.push(write(path, &bytes, what)?);
    }
    if let Some(path) = &args.onnx {
        let what = format!("{actor}, with normalisation and ranges of the motors, as ONNX");
        written.push(write(path, &to_onnx(&policy), what)?);
    }
    if args.json {
        let files: Vec<_> = written.iter().map(|file| json!({"file": file.path, "bytes": file.bytes})).collect();
        let (checkpoint, env_steps) = origin.map(|Origin { checkpoint, env_steps }| (checkpoint, env_steps)).unzip();
        say(&json!({"checkpoint": checkpoint, "checkpoint_env_steps": env_steps, "files": files}).to_string());
        return Ok(());
    }
    for Written { path, bytes, what } in &written {
        say(&format!("wrote {}: {what}, {bytes} bytes", path.display()));
    }
    Ok(())
}

/// File that was written.
struct Written<'a> {
    path: &'a Path,
    bytes: usize,
    what: String,
}

fn write<'a>(path: &'a Path, bytes: &[u8], what: String) -> anyhow::Result<Written<'a>> {
    let shown = path.display();
    atomic_file::write(path, bytes)
        .with_context(|| format!("cannot write `{shown}`; does its folder exist, and may you write to it?"))?;
    Ok(Written { path, bytes: bytes.len(), what })
}
