//! Flags of `train` and `learner`, and the configuration keys that they set.

use std::{fs, path::PathBuf};

use clap::Args;
use treadmill_config::{ConfigSource, EnvTask, given_value};
use treadmill_humanoid::TaskRegistry;
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_ppo::device::DeviceKind;
use treadmill_runtime::{numbers::parse_count, words::nearest};

use crate::{
    launch::exit_code::Usage,
    shared::{existing_file::existing_file, model_file::ModelFileArgs, motion_file::MotionArgs},
};

/// Preset of the velocity task for any robot.
pub const OF_ANY_ROBOT: &str = "velocity";
/// Preset of tasks that are not built in.
const OF_OWN_TASK: &str = "own-task";
/// Preset of the motion task.
const OF_MOTIONS: &str = "motion";

/// Flags that configure a new run. A resumed run has them saved and accepts those that agree.
#[derive(Args, Clone, Debug, Default)]
pub struct NewRunArgs {
    /// Preset to start the configuration from: walk (the default), walk-v5obs, walk-v4obs, sim2sim, smoke, own-task (the
    /// default for tasks that are not built in), or that of a robot, which --model gives: g1, g1-29, g1-rough, g1-motion,
    /// h1, t1, or velocity and motion (the defaults with --task velocity and --task motion) for any.
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Configuration file (TOML), applied over the preset.
    #[arg(long, value_name = "FILE", value_parser = existing_file)]
    pub config: Option<PathBuf>,
    /// Set a configuration key, as in ppo.learning_rate=3e-4; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Task: humanoid-v5, humanoid-v4, velocity, motion, `external` for the task that the first actor registers, or the name
    /// of such a task, with a slash, as in gymnasium/Humanoid-v5 (see docs/guide/external-tasks.md).
    #[arg(long, value_name = "NAME")]
    pub task: Option<String>,
    /// Seed of every random stream.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Folder of the run; by default runs/PRESET-N with the first free N.
    #[arg(long, value_name = "DIR")]
    pub run_dir: Option<PathBuf>,
    /// Begin with weights and statistics of another policy, and new counters: a run, a checkpoint or an exported file.
    #[arg(long, value_name = "POLICY", group = "saved")]
    pub init_from: Option<String>,
    /// Branch off from another run: its configuration and whole learning state, in a new folder; --set changes keys.
    #[arg(long, value_name = "RUN", group = "saved", conflicts_with = "preset")]
    pub fork: Option<String>,
    /// Word that groups runs, for `treadmill runs` and TensorBoard; may be repeated.
    #[arg(long = "tag", value_name = "WORD")]
    pub tags: Vec<String>,
    /// Free text about the run, for `treadmill runs` and TensorBoard.
    #[arg(long, value_name = "TEXT")]
    pub description: Option<String>,
}

impl NewRunArgs {
    /// Returns the name of the preset.
    pub fn preset(&self) -> &str {
        self.preset.as_deref().unwrap_or_else(|| match self.task_name().as_deref() {
            None => "walk",
            Some(task) if task == EnvTask::Velocity.name() => OF_ANY_ROBOT,
            Some(task) if task == EnvTask::Motion.name() => OF_MOTIONS,
            Some(task) if task != EnvTask::External.name() && EnvTask::NAMES.contains(&task) => "walk",
            Some(_) => OF_OWN_TASK,
        })
    }

    /// Returns the task that flags or configuration file choose, if they do.
    fn task_name(&self) -> Option<String> {
        let given = |key| self.given(key)?.as_str().filter(|name| !name.is_empty()).map(str::to_owned);
        self.task.clone().or_else(|| given("env.own_task")).or_else(|| given("env.task"))
    }

    /// Adds the file, the keys and the task, in this order, then `changes`, which are keys of other flags, and the seed.
    pub fn add_to(
        &self,
        source: &mut ConfigSource,
        tasks: &TaskRegistry,
        changes: &[(&str, toml::Value)],
    ) -> anyhow::Result<()> {
        if let Some(file) = &self.config {
            source.file(file)?;
        }
        for pair in &self.set {
            source.set(pair)?;
        }
        let task = self.task.as_deref().map(|name| task_keys(name, tasks)).transpose()?;
        for (key, value) in task.unwrap_or_default().iter().chain(changes) {
            source.value(key, value.clone())?;
        }
        for (key, value) in self.labels() {
            source.value(key, value)?;
        }
        self.seed.map_or(Ok(()), |seed| add_count(source, "run.seed", seed))
    }

    /// Returns whether `--set` or the configuration file has a key, whatever its value.
    pub fn gives(&self, key: &str) -> bool {
        self.given(key).is_some()
    }

    /// Returns the value of a key that `--set` or else the configuration file has.
    fn given(&self, key: &str) -> Option<toml::Value> {
        let by_set = self.set.iter().rev().filter_map(|pair| pair.split_once('=')).find(|(name, _)| name.trim() == key);
        let in_file = || {
            let table: toml::Table = fs::read_to_string(self.config.as_ref()?).ok()?.parse().ok()?;
            let (section, name) = key.split_once('.')?;
            table.get(section)?.get(name).cloned()
        };
        by_set.map(|(_, text)| given_value(text)).or_else(in_file)
    }

    /// Refuses a key of new networks, which networks of `flag` have learnt already.
    ///
    /// # Errors
    /// If the key was given.
    pub fn check_noise(&self, flag: &str) -> Result<(), Usage> {
        const KEY: &str = "policy.init_log_std";
        match self.gives(KEY) {
            true => {
                Err(Usage(format!("`{KEY}` has no effect with {flag}, whose policy has its own noise; leave it out")))
            }
            false => Ok(()),
        }
    }

    /// Returns the keys that only describe the run, if they were given.
    pub fn labels(&self) -> Vec<(&'static str, toml::Value)> {
        let tags = (!self.tags.is_empty()).then(|| ("run.tags", self.tags.clone().into()));
        tags.into_iter().chain(self.description.clone().map(|text| ("run.description", text.into()))).collect()
    }
}

/// Flags of new and resumed runs.
#[derive(Args, Clone, Debug, Default)]
pub struct AnyRunArgs {
    /// Total number of environment steps of the run, as in 8000000, 8M or 1e6.
    #[arg(long, value_parser = parse_count)]
    pub steps: Option<u64>,
    /// Resume this run: its folder, or its name below runs/.
    #[arg(long, value_name = "RUN", group = "saved")]
    pub resume: Option<String>,
    /// Resume the run in --run-dir if it has a checkpoint, else begin it: one command line for a service. With --store,
    /// resume the run there once no other learner leads it.
    #[arg(long, conflicts_with = "resume")]
    pub resume_or_start: bool,
    /// Keep the run's state in this store instead of the run's folder: file:///FOLDER, s3://BUCKET/PATH, gs://BUCKET/PATH or
    /// az://CONTAINER/PATH. Credentials come from the environment (see docs/operations/failover.md).
    #[arg(long, value_name = "URL", conflicts_with_all = ["resume", "fork", "init_from"])]
    pub store: Option<String>,
    /// MJCF or URDF file, or card, of a robot other than the built-in humanoid (see docs/guide/robots.md); a resumed run
    /// keeps its own.
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// Flags about that file.
    #[command(flatten)]
    pub model_file: ModelFileArgs,
    /// Motions to imitate.
    #[command(flatten)]
    pub motion: MotionArgs,
    /// Checkpoint to resume, fork or begin from: latest, best, or the number of updates of a kept one.
    #[arg(long, value_name = "WHICH", requires = "saved")]
    pub checkpoint: Option<CheckpointChoice>,
    /// Device of the updates: cpu, cuda (an NVIDIA GPU), or candle (Candle's tensors on the processor, slow).
    #[arg(long, value_name = "DEVICE", default_value = "cpu")]
    pub device: DeviceKind,
    /// Do not show progress.
    #[arg(long)]
    pub no_progress: bool,
    /// Print all metrics every `learner.table_every_updates` updates.
    #[arg(long)]
    pub log_metrics: bool,
    /// Print one JSON summary as the last line of standard output.
    #[arg(long)]
    pub json: bool,
}

/// Flags of commands that start the actors of a run themselves.
#[derive(Args, Clone, Debug, Default)]
pub struct OwnActorsArgs {
    /// Run one actor in lock-step: the same seed gives the same weights bit for bit.
    #[arg(long)]
    pub deterministic: bool,
    /// Actor processes; by default one per core.
    #[arg(long)]
    pub actors: Option<u32>,
    /// Environments in total, divided among the actors.
    #[arg(long)]
    pub envs: Option<u32>,
}

impl OwnActorsArgs {
    /// Returns the configuration keys that these flags set.
    ///
    /// # Errors
    /// If they contradict each other.
    pub fn changes(&self) -> Result<Vec<(&'static str, toml::Value)>, Usage> {
        let counts = [("rollout.envs", self.envs), ("rollout.actors", self.actors)];
        let mut changes: Vec<(_, toml::Value)> =
            counts.into_iter().filter_map(|(key, count)| Some((key, count?.into()))).collect();
        if self.deterministic {
            if self.actors.is_some_and(|actors| actors > 1) {
                return Err(Usage("--deterministic runs one actor in lock-step; leave --actors out".to_string()));
            }
            changes.push(("run.deterministic", true.into()));
        }
        Ok(changes)
    }
}

/// Adds a count to a configuration.
pub fn add_count(source: &mut ConfigSource, key: &str, count: u64) -> anyhow::Result<()> {
    let count =
        i64::try_from(count).map_err(|_| Usage(format!("`{key}` is {count}; allowed: at most {}", i64::MAX)))?;
    Ok(source.value(key, count)?)
}

/// Returns the keys that `--task NAME` sets: the built-in task, that of this program, or the name of an external one.
fn task_keys(name: &str, tasks: &TaskRegistry) -> Result<Vec<(&'static str, toml::Value)>, Usage> {
    if EnvTask::NAMES.contains(&name) {
        return Ok(vec![("env.task", name.into())]);
    }
    if tasks.own_names().contains(&name) {
        return Ok(vec![("env.own_task", name.into())]);
    }
    if !name.contains('/') {
        let known: Vec<&str> = EnvTask::NAMES.iter().copied().chain(tasks.own_names()).collect();
        let meant =
            nearest(name, known.iter().copied()).map(|near| format!("did you mean `{near}`? ")).unwrap_or_default();
        let known = known.join(", ");
        return Err(Usage(format!(
            "--task {name}: there is no such task; {meant}Tasks of this program: {known}. Tasks that other programs simulate \
             have a slash, as in `gymnasium/{name}`; for others give --task external --set task.name={name}"
        )));
    }
    Ok(vec![("env.task", EnvTask::External.name().into()), ("task.name", name.into())])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_humanoid_begins_with_its_own_recipe() {
        for (task, set, preset) in [
            (None, &[][..], "walk"),
            (None, &["env.task=humanoid-v4", "env.own_task="], "walk"),
            (Some("humanoid-v5"), &["env.task=velocity"], "walk"),
            (None, &["env.task=velocity"], "velocity"),
            (Some("external"), &[], "own-task"),
            (Some("gymnasium/Humanoid-v5"), &[], "own-task"),
            (None, &["env.own_task=squat"], "own-task"),
        ] {
            let set = set.iter().map(ToString::to_string).collect();
            let args = NewRunArgs { task: task.map(str::to_owned), set, ..NewRunArgs::default() };
            assert_eq!(args.preset(), preset, "{args:?}");
        }
        let args = NewRunArgs { preset: Some("g1".into()), task: Some("external".into()), ..NewRunArgs::default() };
        assert_eq!(args.preset(), "g1");
    }
}
