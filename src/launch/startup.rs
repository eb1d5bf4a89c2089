//! Preparation of a run from its flags, and the files that say how it was made.

use std::{fs, path::PathBuf};

use anyhow::Context;
use serde_json::json;
use treadmill_config::Config;
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_learner::checkpoint;
use treadmill_proto::WIRE_VERSION;
use treadmill_runtime::{atomic_file, machine, program, run_folder::RunFolder, words};

use crate::{
    launch::{
        begin,
        exit_code::Usage,
        prepared::{Launcher, Prepared, RunSetup, Start},
        resume_line, resumption,
        run_args::{AnyRunArgs, NewRunArgs},
    },
    shared::model_file::ModelSource,
};

/// Prepares a new or resumed run. `changes` are keys set by flags of the command.
///
/// # Errors
/// If flags or configuration are refused, another process has the run, or its folder cannot be read or written.
pub fn prepare(
    launcher: Launcher<'_>,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Start> {
    if any.resume_or_start && new.run_dir.is_none() {
        let why = "--resume-or-start needs the folder of the run: pass --run-dir DIR, or --store URL".to_string();
        return Err(Usage(why).into());
    }
    let begun = new.run_dir.as_deref().filter(|root| any.resume_or_start && RunFolder::has_checkpoint(root));
    let saved = any.resume.clone().or(begun.map(|root| root.display().to_string()));
    let start = match saved {
        Some(run) => resumption::resume(launcher, &run, new, any, changes)?,
        None => begin::begin(launcher, new, any, changes)?,
    };
    write_files(launcher, new, any, &start)?;
    Ok(start)
}

/// Writes the files of a run that is ready, besides its state.
///
/// # Errors
/// If its folder cannot be written; a new one is removed then.
pub fn write_files(launcher: Launcher<'_>, new: &NewRunArgs, any: &AnyRunArgs, start: &Start) -> anyhow::Result<()> {
    let Start::Ready(prepared, _) = start else { return Ok(()) };
    let stale = prepared.setup.folder.remove_stale_files()?;
    if stale > 0 {
        tracing::info!(stale, "removed temporary files that a killed process left");
    }
    write_run_files(launcher, prepared)
        .and_then(|()| write_model_source(new, any, &prepared.setup.folder))
        .inspect_err(|_| prepared.setup.folder.discard())
        .with_context(|| format!("cannot write to {}", prepared.setup.folder.root().display()))
}

fn write_run_files(launcher: Launcher<'_>, prepared: &Prepared) -> std::io::Result<()> {
    use std::io::Write;
    let Prepared { setup: RunSetup { config, folder, store, .. }, state } = prepared;
    // Atomically: on a full disk, the files of the previous start remain.
    let write = |path: PathBuf, text: &str| atomic_file::write(&path, text.as_bytes());
    // The saved configuration, whose goal may be beyond that of this start.
    let state = state.known();
    let saved = state.map_or_else(|| config.to_toml(), |state| state.config_toml.clone());
    write(folder.config(), &saved)?;
    if let Some(text) = state.map(|state| &state.model_xml).filter(|text| !text.is_empty()) {
        write(folder.root().join("model.xml"), text)?;
    }
    let Launcher { command, .. } = launcher;
    let resumed_by = resume_line::of_this_process(command.name(), folder, store.as_deref());
    write(folder.resume(), &(resumed_by + "\n"))?;
    let mut commands = fs::OpenOptions::new().create(true).append(true).open(folder.root().join("command.txt"))?;
    writeln!(commands, "{}", command_line())?;
    let versions: serde_json::Map<_, _> = facts().into_iter().map(|(name, value)| (name.to_string(), value)).collect();
    write(folder.root().join("versions.json"), &format!("{:#}\n", json!(versions)))
}

/// Notes where the file of the robot is: that of a flag, or else that of the run that this one begins from.
fn write_model_source(new: &NewRunArgs, any: &AnyRunArgs, folder: &RunFolder) -> std::io::Result<()> {
    let source = match &any.model {
        Some(file) => Some(ModelSource::given(file, &any.model_file)?),
        None => new.fork.iter().chain(&new.init_from).find_map(|run| ModelSource::of_run(run)),
    };
    source.map_or(Ok(()), |source| source.write(folder))
}

/// Returns this process's command line, quoted for a shell.
pub fn command_line() -> String {
    std::env::args().map(|part| words::quoted(&part)).collect::<Vec<_>>().join(" ")
}

/// Returns facts about this program and this machine.
fn facts() -> [(&'static str, serde_json::Value); 8] {
    [
        ("treadmill", program::version().into()),
        ("checkpoint_format", checkpoint::encoding::FORMAT.into()),
        ("wire_version", WIRE_VERSION.into()),
        ("physics_version", PHYSICS_VERSION.into()),
        ("os", std::env::consts::OS.into()),
        ("architecture", std::env::consts::ARCH.into()),
        ("cpu", machine::cpu_name().into()),
        ("cores", machine::cores().into()),
    ]
}

/// Returns facts about program and machine as text, with the host and the run's seed.
pub fn versions(config: &Config) -> Vec<(String, String)> {
    let plain = |value: serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_string);
    let mut versions: Vec<_> = facts().into_iter().map(|(name, value)| (name.to_string(), plain(value))).collect();
    versions.push(("host".to_string(), machine::host_name()));
    versions.push(("seed".to_string(), config.run.seed.to_string()));
    versions
}
