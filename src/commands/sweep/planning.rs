//! Plan of a new sweep: its flags, its file and the configuration of every trial are checked before anything is written.

use std::{
    fs,
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::{ArgAction, parser::ValueSource};
use treadmill_bus::Role;
use treadmill_config::{Config, ConfigSource, given_value};
use treadmill_humanoid::TaskRegistry;
use treadmill_ppo::BatchSize;
use treadmill_runtime::machine;

use super::{
    OWN_FLAGS, SEEDS, SweepArgs,
    goal::Goal,
    plan::{self, Plan},
    search, space,
};
use crate::{
    commands::check::machine::{ACTOR_BYTES, LEARNER_BYTES},
    launch::{
        begin,
        exit_code::Usage,
        prepared::{self, Launcher, RunCommand},
    },
    shared::network_args::NetworkArgs,
};

/// Most wrong settings that a message names.
const WRONG_MAX: usize = 5;

/// Returns name and text of the search file, if one is given.
fn read_file(args: &SweepArgs) -> anyhow::Result<Option<(String, String)>> {
    let read = |path: &PathBuf| -> anyhow::Result<(String, String)> {
        let name = path.display().to_string();
        Ok((name.clone(), fs::read_to_string(path).with_context(|| format!("cannot read `{name}`"))?))
    };
    args.file.as_ref().map(read).transpose()
}

/// Checks flags and file, and returns the plan of a new sweep.
pub(super) fn plan_sweep(args: &SweepArgs, flags: Vec<String>, tasks: &TaskRegistry) -> anyhow::Result<Plan> {
    if args.any.store.is_some() {
        let why = "--store: the trials of a sweep keep their states in folders; leave it out";
        return Err(Usage(why.to_string()).into());
    }
    if args.trials.is_some() && args.file.is_none() {
        return Err(Usage("--trials needs a search: pass its FILE".to_string()).into());
    }
    if args.any.resume_or_start && args.new.run_dir.is_none() {
        return Err(Usage("--resume-or-start needs the folder of the sweep: pass --run-dir DIR".to_string()).into());
    }
    let command = if args.connect.is_empty() { RunCommand::Train } else { RunCommand::Learner };
    let launcher = Launcher { command, tasks };
    // Before anything is written.
    let network = NetworkArgs { tls: args.tls.clone(), insecure: args.insecure, ..NetworkArgs::default() };
    network.options(Role::Learner, Vec::new(), args.connect.clone())?;
    let changes = args.actors.changes()?;
    let source = begin::sources(launcher, &args.new, &args.any, &changes)?.source;
    let config = source.build()?;
    prepared::check_external(command, &config, &args.any)?;
    let file = read_file(args)?;
    let mut plan = Plan {
        started_in: std::env::current_dir().context("the working directory is unknown")?,
        flags,
        seeds: args.seeds.or(file.is_none().then_some(SEEDS)),
        file,
        settings: args.trials,
        storage: args.storage.clone(),
        study: String::new(),
        parallel: args.parallel.map_or_else(trials_at_once, |parallel| parallel as usize),
        deterministic: config.run.deterministic,
        connect: args.connect.clone(),
        bus_name: plan::bus_name(args.new.run_dir.as_deref()),
        goal: String::new(),
        seed: config.run.seed,
        steps: config.run.steps,
        intervals: 0,
        trials: Vec::new(),
    };
    let search = plan.search()?;
    if plan.storage.is_some() && search.sampler().is_none() {
        return Err(Usage("--storage is for a search by Optuna; leave it out".to_string()).into());
    }
    if let Some(interval_steps) = search.interval_steps() {
        let batch = BatchSize::of(&config.ppo).transitions as u64;
        if interval_steps < batch || interval_steps >= plan.steps {
            let steps = plan.steps;
            let why = format!(
                "`interval_steps` is {interval_steps}; allowed: {batch}, a batch, to less than --steps, {steps}"
            );
            return Err(Usage(why).into());
        }
    }
    plan.goal = search.goal.clone().unwrap_or_else(|| Goal::of(&config, search.interval_steps().is_some())).to_string();
    plan.propose(&search);
    check_trials(&plan, &source, &changes)?;
    if search.sampler().is_some() {
        // These only show what the ranges allow.
        plan.trials.clear();
    }
    Ok(plan)
}

/// Returns how many trials this machine trains at once: with one core each they are together faster than one after the
/// other with all cores, because nothing waits for another process.
fn trials_at_once() -> usize {
    let by_memory =
        machine::memory_bytes().map_or(usize::MAX, |bytes| (bytes / (LEARNER_BYTES + ACTOR_BYTES)) as usize);
    machine::cores().min(by_memory).max(1)
}

/// Returns why a run takes no actors of a pool, if so.
fn takes_no_pool(config: &Config) -> Option<&'static str> {
    match (config.run.deterministic, config.is_external(), config.run.share == 0.0) {
        (true, ..) => Some("`run.deterministic` is true, and such a run takes no actors of a pool"),
        (_, true, _) => Some("`env.task` is \"external\", and such a run takes no actors of a pool"),
        (.., true) => Some("`run.share` is 0, and such a run takes no actors of a pool"),
        _ => None,
    }
}

/// Checks the configuration of every trial. `changes` are keys of flags, which come after those of the search.
fn check_trials(plan: &Plan, source: &ConfigSource, changes: &[(&str, toml::Value)]) -> Result<(), Usage> {
    let wrong = |keys: &search::Setting| -> Option<String> {
        let mut source = source.clone();
        let searched = keys.iter().map(|(key, value)| (key.as_str(), given_value(value)));
        let set = searched.chain(changes.iter().cloned()).try_for_each(|(key, value)| source.value(key, value));
        let config: Config = match set.and_then(|()| source.build()) {
            Ok(config) => config,
            Err(why) => return Some(why.to_string()),
        };
        if let (false, Some(why)) = (plan.connect.is_empty(), takes_no_pool(&config)) {
            return Some(format!("--connect: {why}; set another value, or leave --connect out"));
        }
        let lost = keys.iter().find(|(key, value)| !space::is_same(&config.value_of(key), value));
        lost.map(|(key, _)| format!("`{key}` is set by another flag too; leave that out"))
    };
    let mut found: Vec<String> = plan.trials.iter().filter_map(|trial| wrong(&trial.keys)).collect();
    found.dedup();
    let count = found.len();
    found.truncate(WRONG_MAX);
    match count {
        0 => Ok(()),
        _ => Err(Usage(format!("{count} settings of the search are not allowed: {}", found.join("; ")))),
    }
}

/// Returns the flags of this process's command line that `train` has too, each as one word.
pub(super) fn train_flags() -> Vec<String> {
    let program = crate::command_line();
    let (Some(sweep), Some(train)) = (program.find_subcommand("sweep"), program.find_subcommand("train")) else {
        return Vec::new();
    };
    let Ok(matches) = program.clone().try_get_matches() else { return Vec::new() };
    let Some(("sweep", given)) = matches.subcommand() else { return Vec::new() };
    let known: Vec<&str> = train.get_arguments().map(|arg| arg.get_id().as_str()).collect();
    let mut flags = Vec::new();
    for arg in sweep.get_arguments() {
        let id = arg.get_id().as_str();
        let is_kept = known.contains(&id) && !OWN_FLAGS.contains(&id);
        if !is_kept || given.value_source(id) != Some(ValueSource::CommandLine) {
            continue;
        }
        let Some(name) = arg.get_long() else { continue };
        if matches!(arg.get_action(), ArgAction::SetTrue) {
            flags.push(format!("--{name}"));
        } else {
            let values = given.get_raw(id).into_iter().flatten();
            flags.extend(values.map(|value| format!("--{name}={}", value.to_string_lossy())));
        }
    }
    flags
}

/// Checks that flags and file are those of a sweep that has begun.
pub(super) fn check_same(args: &SweepArgs, flags: &[String], plan: &Plan, root: &Path) -> anyhow::Result<()> {
    let root = root.display();
    if plan.flags != flags {
        let own = plan.flags.join(" ");
        return Err(Usage(format!("`{root}` holds a sweep with the flags `{own}`; a sweep keeps its flags")).into());
    }
    let file = read_file(args)?.map(|(_, text)| text);
    let is_same = plan.file.as_ref().map(|(_, text)| text) == file.as_ref()
        && plan.seeds == args.seeds.or(file.is_none().then_some(SEEDS))
        && plan.settings == args.trials
        && plan.connect == args.connect
        && plan.storage == args.storage
        && args.new.seed.is_none_or(|seed| seed == plan.seed);
    let others = "file, --connect, --storage, --seeds, --trials or --seed";
    match is_same {
        true => Ok(()),
        false => Err(Usage(format!("`{root}` holds a sweep with another {others}; a sweep keeps them")).into()),
    }
}

/// Sets how many settings a sweep that has begun tries.
pub(super) fn add_trials(plan: &mut Plan, trials: usize) -> Result<(), Usage> {
    let search = plan.search()?;
    let begun = plan.trials.len() / search.seeds;
    if search.sampler().is_none() {
        return Err(Usage("--trials with --resume is for a search by Optuna; leave it out".to_string()));
    }
    if trials < begun {
        return Err(Usage(format!("--trials is {trials}, and the sweep has begun {begun}; give more")));
    }
    plan.settings = Some(trials);
    Ok(())
}
