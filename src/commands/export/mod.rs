//! `treadmill export`: writes a trained policy as a file that other programs read.
//!
//! # Layout
//! - `contract`: what a robot's controller must know of a policy of the velocity task.
//! - `deploy`: the same as `deploy.yaml`, which Unitree's controllers read.
//! - `ground`: generated ground, for MuJoCo.
//! - `walk`: what a player must know of a policy of Gymnasium's tasks.

mod contract;
mod deploy;
mod ground;
mod imitated;
mod walk;

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::{ArgGroup, Args};
use serde_json::json;
use treadmill_humanoid::TaskRegistry;
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_policy::onnx::to_onnx;
use treadmill_proto::onnx::Ports;
use treadmill_runtime::atomic_file;

use self::contract::Contract;
use crate::{
    launch::{exit_code::Usage, output::say},
    shared::saved_policy::{self, Origin, SavedPolicy},
};

/// Flags of `export`.
#[derive(Args)]
#[command(group(ArgGroup::new("files").args(["safetensors", "onnx", "deploy", "ground"]).multiple(true).required(true)))]
pub struct ExportArgs {
    /// Run folder, name below runs/, bundle file, or a file that `export` wrote.
    run: String,
    /// Write weights, observation statistics and task as one safetensors file.
    #[arg(long, value_name = "FILE")]
    safetensors: Option<PathBuf>,
    /// Write the policy as an ONNX model from raw observations to actions, normalisation included; for the velocity
    /// task with its contract. Beside --deploy its batch is 1, its input `obs` and its output `actions`, as Unitree's
    /// controllers want.
    #[arg(long, value_name = "FILE")]
    onnx: Option<PathBuf>,
    /// Write gains, default pose, action scales and observation of the velocity task as deploy.yaml, for Unitree's
    /// controllers.
    #[arg(long, value_name = "FILE")]
    deploy: Option<PathBuf>,
    /// Write the generated ground of the velocity task, for `python -m treadmill_transfer --ground FILE`.
    #[arg(long, value_name = "FILE")]
    ground: Option<PathBuf>,
    /// Checkpoint: best, latest, or the number of updates of a kept one; by default best if it exists.
    #[arg(long, value_name = "WHICH")]
    checkpoint: Option<CheckpointChoice>,
    /// Print only one JSON object.
    #[arg(long)]
    json: bool,
}

/// Writes the files and prints what they contain.
pub fn run(args: &ExportArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    let SavedPolicy { policy, config, origin, .. } = saved_policy::load(&args.run, args.checkpoint)?;
    let environment = match config.is_external() {
        true => None,
        // Refuses a policy that `eval` would refuse.
        false => Some(saved_policy::environment(tasks, &args.run, &policy, &config)?),
    };
    let contract = environment.as_ref().map(Contract::new).transpose()?.flatten();
    let ground = environment.as_ref().and_then(ground::json);
    if ground.is_none() && args.ground.is_some() {
        let why =
            format!("--ground needs a run with generated ground, and `{}` has none; leave --ground out", args.run);
        return Err(Usage(why).into());
    }
    if contract.as_ref().is_none_or(Contract::imitates) && args.deploy.is_some() {
        let (run, task) = (&args.run, config.task_name());
        let why = format!(
            "--deploy needs a policy of the velocity task, and `{run}` was trained for `{task}`; leave --deploy out"
        );
        return Err(Usage(why).into());
    }
    if let (Some(contract), Some(_)) = (&contract, &args.deploy)
        && contract.config.velocity.height_scan
    {
        let why = format!(
            "--deploy: `{}` observes the heights of the ground (velocity.height_scan), which Unitree's controllers cannot; \
             leave --deploy out",
            args.run
        );
        return Err(Usage(why).into());
    }
    if let (Some(contract), Some(_)) = (&contract, &args.deploy)
        && contract.turns_base()
    {
        let why = format!(
            "--deploy: the base of `{}` faces another way than its x axis (`forward` of its card), which Unitree's \
             controllers do not know; leave --deploy out",
            args.run
        );
        return Err(Usage(why).into());
    }
    let given = [&args.onnx, &args.safetensors, &args.deploy, &args.ground].into_iter().flatten();
    let mut paths = BTreeSet::new();
    if let Some(path) = given.into_iter().find(|path| !paths.insert(*path)) {
        let why = format!("`{}` is named for two files; name each apart", path.display());
        return Err(Usage(why).into());
    }
    // Also run for ONNX alone, because it checks that shapes match.
    let bytes = policy.to_bytes().with_context(|| format!("the policy of `{}` cannot be exported", args.run))?;
    let widths: Vec<String> = [policy.shape.seen_by_actor()]
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
        let ports = if args.deploy.is_some() { Ports::UNITREE } else { Ports::ANY_BATCH };
        let controller = contract.as_ref().map(|contract| contract.for_controller(ports)).transpose()?;
        let of_actions = if controller.is_some() { "the contract of its controller" } else { "ranges of the motors" };
        let controller = controller.or_else(|| environment.as_ref().and_then(walk::for_player));
        let what = format!("{actor}, with normalisation and {of_actions}, as ONNX");
        written.push(write(path, &to_onnx(&policy, controller.as_ref()), what)?);
    }
    if let (Some(path), Some(contract)) = (&args.deploy, &contract) {
        let what = format!("{of}gains, default pose and observation for Unitree's controllers");
        written.push(write(path, deploy::yaml(contract)?.as_bytes(), what)?);
    }
    if let (Some(path), Some(ground)) = (&args.ground, &ground) {
        written.push(write(
            path,
            ground.as_bytes(),
            format!("{of}the generated ground and the starts on its hardest level"),
        )?);
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
