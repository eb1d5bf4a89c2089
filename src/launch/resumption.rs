//! Resumes a run: loads its checkpoint, and refuses flags that differ from what it has saved.

use std::fs;

use toml::Table;
use treadmill_config::{Config, ConfigSource};
use treadmill_humanoid::{PHYSICS_VERSION, TaskRegistry};
use treadmill_learner::checkpoint::{self, CheckpointChoice, TrainingState};
use treadmill_runtime::{numbers::thousands, run_folder::RunFolder, run_lock::RunLock, seeds};

use crate::launch::{
    exit_code::Usage,
    model,
    output::say,
    prepared::{self, FirstState, Launcher, Prepared, RunSetup, Start},
    run_args::{AnyRunArgs, NewRunArgs},
    slow_step::SlowStepNotice,
};

/// Resumes `run`, a folder or a name below `runs/`. `changes` are keys set by flags of the command.
///
/// # Errors
/// If flags differ from the saved run, another process has it, or its checkpoint cannot be used.
pub fn resume(
    launcher: Launcher<'_>,
    run: &str,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Start> {
    let folder = RunFolder::open(run)?;
    prepared::check_not_stored(&folder)?;
    check_folder(&folder, new)?;
    let lock = RunLock::take(&folder)?;
    let _step = SlowStepNotice::begin(format!("loading the checkpoint of {}", folder.root().display()));
    // With --resume-or-start, the flag chooses the checkpoint to begin from.
    let which = any.checkpoint.filter(|_| any.resume.is_some()).unwrap_or(CheckpointChoice::Latest);
    let mut state = checkpoint::load(&folder, which)?.state;
    let updates = state.counters.updates;
    if let Ok(best) = checkpoint::load(&folder, CheckpointChoice::Best)
        && best.state.counters.updates <= updates
    {
        state.adopt_best(&best.state);
    }
    let start = go_on(launcher, (folder, lock), state, new, any, changes)?;
    if let Start::Ready(prepared, _) = &start
        && let Some(aside) = checkpoint::set_aside(&prepared.setup.folder, updates)?
    {
        say(&format!("what the run saved after update {updates} is kept in {}", aside.display()));
    }
    Ok(start)
}

/// Resumes a run from a state that was read from its store; `folder` is for the logs of this machine.
///
/// # Errors
/// As [`resume`].
pub fn go_on(
    launcher: Launcher<'_>,
    (folder, lock): (RunFolder, RunLock),
    mut state: TrainingState,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Start> {
    let saved_run = state.config().map_err(anyhow::Error::msg)?.run;
    let mut config = agreed_config(launcher, &state, new, any, changes)?;
    let has_new_labels = config.run != saved_run;
    let device = prepared::open_device(&config, any.device)?;
    if !config.is_external() {
        state.adopt_physics(PHYSICS_VERSION).map_err(anyhow::Error::msg)?;
    }
    model::check_flags(any.model.as_deref(), &any.model_file)?;
    if let Some(file) = &any.model {
        model::check_same(&config, &state.model_xml, file, &any.model_file)?;
    }
    any.motion.check_same(&state.model_xml)?;
    let (reached, saved) = (state.counters.env_steps, config.run.steps);
    let goal = match any.steps {
        // A service has the same command line at each start.
        Some(steps) if any.resume_or_start => steps.max(saved),
        Some(steps) if steps <= reached => return Err(too_few(&folder, steps, reached, saved).into()),
        Some(steps) => steps,
        None => saved,
    };
    if reached >= goal {
        if has_new_labels && any.resume.is_some() {
            let why = "`--tag` and `--description` are saved when a run goes on, and this one is finished; add --steps";
            return Err(Usage(why.to_string()).into());
        }
        return Ok(Start::Finished(folder, Box::new(state)));
    }
    config.run.steps = saved.max(goal);
    config.check()?;
    state.config_toml = config.to_toml();
    config.run.steps = goal;
    state.lineage.resume(seeds::unique());
    state.counters.resumes += 1;
    let (run, store) = (state.run.clone(), any.store.clone());
    let setup = RunSetup { config, folder, device, run, origin: None, store, choice: None };
    let state = FirstState::Known(Box::new(state));
    Ok(Start::Ready(Box::new(Prepared { setup, state }), lock))
}

fn too_few(folder: &RunFolder, steps: u64, reached: u64, saved: u64) -> Usage {
    let further = if saved > reached { saved } else { reached.saturating_mul(2) };
    Usage(format!(
        "`--steps {steps}`: `{}` is already at {} steps; go on with `--steps {further}`",
        folder.root().display(),
        thousands(reached)
    ))
}

fn check_folder(folder: &RunFolder, new: &NewRunArgs) -> Result<(), Usage> {
    let Some(given) = &new.run_dir else { return Ok(()) };
    let root = folder.root();
    match fs::canonicalize(given).is_ok_and(|given| fs::canonicalize(root).is_ok_and(|root| root == given)) {
        true => Ok(()),
        false => Err(Usage(format!(
            "`--run-dir {}` is not the folder of the resumed run, `{}`; leave --run-dir out",
            given.display(),
            root.display()
        ))),
    }
}

/// Returns the saved configuration with the labels of this start.
///
/// # Errors
/// If flags differ from the saved run.
pub fn agreed_config(
    launcher: Launcher<'_>,
    state: &TrainingState,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Config> {
    let mut config = state.config().map_err(anyhow::Error::msg)?;
    prepared::check_external(launcher.command, &config, any)?;
    // Labels describe the run and may change at each start, as may the number of processes.
    for (key, value) in new.labels() {
        let mut source = ConfigSource::default();
        source.text(&config.to_toml(), "the saved configuration")?;
        source.value(key, value)?;
        config = source.build()?;
    }
    let kept: Vec<_> = changes.iter().filter(|(key, _)| *key != "rollout.actors").cloned().collect();
    check_agreement(&config, new, any, launcher.tasks, &kept)?;
    Ok(config)
}

/// Refuses flags of new runs that would change the saved configuration. The goal is not among them: only `--steps` sets it.
fn check_agreement(
    saved: &Config,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    tasks: &TaskRegistry,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<()> {
    let mut source = ConfigSource::default();
    source.text(&saved.to_toml(), "the saved configuration")?;
    if let Some(preset) = &new.preset {
        source.preset(preset)?;
    }
    new.add_to(&mut source, tasks, changes)?;
    let given = source.build()?;
    // A service has the same command line at each start, also after the goal was raised.
    let has_other_goal =
        given.run.steps != saved.run.steps && !(any.resume_or_start && given.run.steps < saved.run.steps);
    let has_other_actors = given.rollout.actors != saved.rollout.actors;
    for (key, differs, flag) in
        [("run.steps", has_other_goal, "--steps"), ("rollout.actors", has_other_actors, "--actors")]
    {
        if differs && new.gives(key) {
            return Err(Usage(format!("`{key}`: a resumed run takes it from {flag} alone; use {flag} N")).into());
        }
    }
    source.value("run.steps", i64::try_from(saved.run.steps)?)?;
    // The number of processes may change at each start, also where a preset has another one.
    source.value("rollout.actors", i64::from(saved.rollout.actors))?;
    let mut wanted = source.build()?;
    prepared::complete(&mut wanted);
    let differences = differences(saved, &wanted)?;
    if differences.is_empty() {
        return Ok(());
    }
    Err(Usage(format!(
        "{}; a resumed run keeps its configuration: leave that out, or begin another run in a new --run-dir",
        differences.join(", ")
    ))
    .into())
}

/// Describes each key in which two configurations differ.
fn differences(saved: &Config, wanted: &Config) -> anyhow::Result<Vec<String>> {
    let (saved, wanted) = (saved.to_toml().parse::<Table>()?, wanted.to_toml().parse::<Table>()?);
    let mut differences = Vec::new();
    for (section, keys) in &wanted {
        for (key, value) in keys.as_table().into_iter().flatten() {
            let before = saved.get(section).and_then(|keys| keys.get(key));
            if before != Some(value) {
                let before = before.map_or_else(|| "absent".to_string(), ToString::to_string);
                differences.push(format!("`{section}.{key}` is {value} by your flags and {before} in the saved run"));
            }
        }
    }
    Ok(differences)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn objection(saved: &[&str], given: &[&str]) -> Option<String> {
        let mut source = ConfigSource::default();
        source.preset("smoke").unwrap();
        saved.iter().for_each(|pair| source.set(pair).unwrap());
        let mut saved = source.build().unwrap();
        prepared::complete(&mut saved);
        let new = NewRunArgs {
            preset: Some("smoke".to_string()),
            set: given.iter().map(ToString::to_string).collect(),
            ..NewRunArgs::default()
        };
        let any = AnyRunArgs::default();
        check_agreement(&saved, &new, &any, &TaskRegistry::default(), &[]).err().map(|why| why.to_string())
    }

    #[test]
    fn flags_that_agree_with_the_saved_run_are_accepted() {
        assert_eq!(objection(&[], &[]), None);
        assert_eq!(objection(&["ppo.batch=1024", "run.steps=99999"], &["ppo.batch=1024"]), None);
        assert!(objection(&["run.steps=99999"], &["run.steps=88888"]).unwrap().contains("use --steps N"));
        assert!(objection(&["rollout.actors=3"], &["rollout.actors=2"]).unwrap().contains("use --actors N"));
        assert_eq!(objection(&["run.deterministic=true"], &["run.deterministic=true"]), None);
        let why = objection(&["ppo.batch=1024"], &[]).unwrap();
        assert!(why.contains("`ppo.batch` is 512 by your flags and 1024 in the saved run"), "{why}");
        let why = objection(&[], &["ppo.gamma=0.9", "run.seed=7"]).unwrap();
        assert!(why.contains("ppo.gamma") && why.contains("`run.seed` is 7"), "{why}");
    }
}
