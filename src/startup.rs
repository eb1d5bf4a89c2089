//! From flags to a run that is ready to begin: configuration, folder, first state.

use std::{fs, path::PathBuf};

use anyhow::Context;
use clap::Args;
use serde_json::json;
use treadmill_common::{
    bus::{BusOptions, Credentials, Role},
    config::{Config, ConfigSource, LearnerMode},
    device::{Device, DeviceKind},
    machine,
    run_folder::RunFolder,
    seeds,
};
use treadmill_learner::{
    checkpoint::{self, TrainingState, Which},
    mirror::Mirror,
};

use crate::{model, outcome::Usage};

/// Flags that say what a run is; they make no sense together with `--resume`, which has them saved.
#[derive(Args, Clone, Debug, Default)]
pub struct NewRunArgs {
    /// Starting point of the configuration: walk, walk-v5obs, walk-v4obs, smoke or sim2sim.
    #[arg(long, value_name = "NAME", default_value = "walk")]
    pub preset: String,
    /// Configuration file (TOML) laid over the preset.
    #[arg(long, value_name = "FILE", conflicts_with = "resume")]
    pub config: Option<PathBuf>,
    /// One configuration key, as in ppo.learning_rate=3e-4; may be repeated.
    #[arg(long, value_name = "KEY=VALUE", conflicts_with = "resume")]
    pub set: Vec<String>,
    /// Seed of every random stream.
    #[arg(long, conflicts_with = "resume")]
    pub seed: Option<u64>,
    /// Folder of this run; by default runs/PRESET-N with the first free N.
    #[arg(long, value_name = "DIR", conflicts_with = "resume")]
    pub run_dir: Option<PathBuf>,
}

/// Flags that make sense for a new run and for a resumed one.
#[derive(Args, Clone, Debug, Default)]
pub struct AnyRunArgs {
    /// Environment steps of the run in total.
    #[arg(long)]
    pub steps: Option<u64>,
    /// Go on with this run: its folder, or its name below runs/.
    #[arg(long, value_name = "RUN", conflicts_with = "preset")]
    pub resume: Option<String>,
    /// Another robot than the built-in humanoid, as MJCF (see docs/models.md); a resumed run keeps its own.
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// Which checkpoint to resume from: latest, best, or the number of updates of a kept one.
    #[arg(long, value_name = "WHICH", requires = "resume")]
    pub checkpoint: Option<Which>,
    /// Where the networks are computed: cpu, or cuda in a build with that feature.
    #[arg(long, value_name = "DEVICE", default_value = "cpu")]
    pub device: DeviceKind,
    /// Do not draw a progress bar.
    #[arg(long)]
    pub no_progress: bool,
    /// Print one JSON summary as the last line of standard output.
    #[arg(long)]
    pub json: bool,
}

/// Flags about the network.
#[derive(Args, Clone, Debug, Default)]
pub struct NetworkArgs {
    /// Allow plain tcp beyond loopback, where anybody on the network can read and forge it.
    #[arg(long)]
    pub insecure: bool,
    /// Folder of certificates, as `treadmill certs` makes it: links are encrypted, and only its authority's parts get in.
    #[arg(long, value_name = "DIR")]
    pub tls: Option<PathBuf>,
    /// The bus's own configuration (JSON5), under which ours is laid.
    #[arg(long, value_name = "FILE")]
    pub zenoh_config: Option<PathBuf>,
}

impl NetworkArgs {
    /// How to reach the bus; called before anything is written, so that an endpoint that is refused leaves nothing behind.
    pub fn options(&self, role: Role, listen: Vec<String>, connect: Vec<String>) -> anyhow::Result<BusOptions> {
        let options = BusOptions {
            listen,
            connect,
            insecure: self.insecure,
            credentials: self.credentials(role)?,
            zenoh_config: self.zenoh_config.clone(),
        };
        options.check()?;
        Ok(options)
    }

    fn credentials(&self, role: Role) -> Result<Option<Credentials>, Usage> {
        let Some(folder) = &self.tls else { return Ok(None) };
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.clone());
        let credentials = Credentials { folder, role };
        match credentials.missing() {
            None => Ok(Some(credentials)),
            Some(file) => Err(Usage(format!(
                "--tls {}: `{}` is not there; make it with `treadmill certs`, or copy it from where that was done",
                credentials.folder.display(),
                file.display()
            ))),
        }
    }
}

/// A run that is ready to begin.
pub struct Prepared {
    /// Its configuration.
    pub config: Config,
    /// Its folder.
    pub folder: RunFolder,
    /// Where its networks are computed.
    pub device: Device,
    /// The mirror that its updates learn with.
    pub mirror: Option<Mirror>,
    /// Its state.
    pub state: TrainingState,
}

/// Prepares a new run, or one that goes on. `changes` are keys that the command's own flags set.
pub fn prepare(new: &NewRunArgs, any: &AnyRunArgs, changes: &[(&str, toml::Value)]) -> anyhow::Result<Prepared> {
    // Before anything is written: a device that is not there leaves nothing behind.
    let device = any.device.open().map_err(|why| Usage(why.to_string()))?;
    let prepared = match &any.resume {
        Some(run) => resume(run, any, device)?,
        None => begin(new, any, changes, device)?,
    };
    write_run_files(&prepared).with_context(|| format!("cannot write to {}", prepared.folder.root().display()))?;
    Ok(prepared)
}

fn begin(
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
    device: Device,
) -> anyhow::Result<Prepared> {
    let mut source = ConfigSource::default();
    source.preset(&new.preset)?;
    if let Some(file) = &new.config {
        source.file(file)?;
    }
    for pair in &new.set {
        source.set(pair)?;
    }
    for (key, value) in changes {
        source.value(key, value.clone())?;
    }
    for (key, value) in [("run.seed", new.seed), ("run.steps", any.steps)] {
        if let Some(value) = value {
            let value = i64::try_from(value)
                .map_err(|_| Usage(format!("`{key}` is {value}; allowed: at most {}", i64::MAX)))?;
            source.value(key, value)?;
        }
    }
    let mut config = source.build()?;
    if config.run.deterministic {
        config.rollout.actors = 1;
        config.rollout.max_in_flight = 1;
        config.learner.mode = LearnerMode::Sync;
    }
    let text = model::text(any.model.as_deref())?;
    let environment = model::environment(&config, &text, any.model.as_deref())?;
    let mirror = model::mirror(&config, &text)?;
    let (observation, action) = (environment.observation_size(), environment.action_size());
    let folder = RunFolder::create(new.run_dir.as_deref(), &new.preset)?;
    let state = TrainingState::fresh(folder.name(), &config, &text, observation, action, seeds::unique());
    Ok(Prepared { config, folder, device, mirror, state })
}

fn resume(run: &str, any: &AnyRunArgs, device: Device) -> anyhow::Result<Prepared> {
    let folder = RunFolder::open(run)?;
    let mut state = checkpoint::load(&folder, any.checkpoint.unwrap_or(Which::Latest))?;
    if let Some(file) = &any.model {
        model::check_same(&state.model_xml, file)?;
    }
    let mut config = state.config().map_err(anyhow::Error::msg)?;
    if let Some(steps) = any.steps {
        config.run.steps = steps;
        config.check()?;
        state.config_toml = config.to_toml();
    }
    state.lineage.resume(seeds::unique());
    state.counters.resumes += 1;
    let mirror = model::mirror(&config, &state.model_xml)?;
    Ok(Prepared { config, folder, device, mirror, state })
}

fn write_run_files(prepared: &Prepared) -> std::io::Result<()> {
    use std::io::Write;
    let Prepared { config, folder, state, .. } = prepared;
    fs::write(folder.config(), config.to_toml())?;
    fs::write(folder.root().join("model.xml"), &state.model_xml)?;
    let mut commands = fs::OpenOptions::new().create(true).append(true).open(folder.root().join("command.txt"))?;
    writeln!(commands, "{}", std::env::args().map(|part| quoted(&part)).collect::<Vec<_>>().join(" "))?;
    let versions = json!({
        "treadmill": env!("CARGO_PKG_VERSION"),
        "checkpoint_format": checkpoint::encoding::FORMAT,
        "os": std::env::consts::OS,
        "architecture": std::env::consts::ARCH,
        "cpu": machine::cpu_name(),
        "cores": machine::cores(),
    });
    fs::write(folder.root().join("versions.json"), format!("{versions:#}\n"))
}

/// A part of a command line as a shell would take it.
fn quoted(part: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+".contains(c);
    if !part.is_empty() && part.chars().all(plain) {
        return part.to_string();
    }
    format!("'{}'", part.replace('\'', r"'\''"))
}

/// Command-line flags as configuration keys, where they were given.
pub fn changes(flags: &[(&'static str, Option<u32>)]) -> Vec<(&'static str, toml::Value)> {
    flags.iter().filter_map(|(key, value)| value.map(|value| (*key, i64::from(value).into()))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_line_can_be_pasted_into_a_shell() {
        assert_eq!(quoted("--set"), "--set");
        assert_eq!(quoted("policy.hidden=[8, 8]"), "'policy.hidden=[8, 8]'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }
}
