//! `treadmill sweep`: trains with several seeds or settings, each trial as an ordinary run in a process of its own.
//!
//! # Layout
//! - What is tried: [`search`] (the file), [`space`] (values of a key), [`goal`] (what trials are compared by).
//! - [`plan`]: trials and what has become of them, as a file.
//! - [`trials`]: runs them; [`population`]: lets the worst fork the best.
//! - [`results`]: what was reached; [`report`]: lines, tables, CSV and picture.

mod goal;
mod plan;
mod population;
mod report;
mod results;
mod search;
mod space;
mod trials;

use std::{fs, path::PathBuf};

use anyhow::Context;
use clap::{Arg, ArgAction, Args, parser::ValueSource};
use treadmill_bus::Role;
use treadmill_config::{Config, ConfigSource, given_value};
use treadmill_humanoid::TaskRegistry;
use treadmill_ppo::BatchSize;
use treadmill_runtime::{machine, shutdown::Shutdown, words::quoted};

use self::{
    goal::Goal,
    plan::{Plan, SweepFolder},
    results::SweepResults,
    search::SweepSearch,
    trials::{Ended, TrialRunner},
};
use crate::{
    commands::check::machine::{ACTOR_BYTES, LEARNER_BYTES},
    launch::{
        async_runtime, begin,
        exit_code::Usage,
        output::say,
        prepared::{self, Launcher, RunCommand},
        run_args::{AnyRunArgs, NewRunArgs, OwnActorsArgs},
        signals,
    },
    shared::{existing_file::existing_file, network_args::NetworkArgs},
};

/// Seeds without a search file: two runs can agree by chance.
const SEEDS: usize = 3;
/// Most wrong settings that a message names.
const WRONG_MAX: usize = 5;
/// Flags that are the sweep's own, or mean something else here than for a trial.
const OWN_FLAGS: [&str; 7] = ["resume", "resume_or_start", "run_dir", "seed", "store", "no_progress", "json"];

/// Flags of `sweep`.
#[derive(Args)]
pub struct SweepArgs {
    /// Search file (TOML): strategy, goal, and keys with ranges (see docs/guide/sweep.md); without it, seeds are compared.
    #[arg(value_name = "FILE", value_parser = existing_file)]
    file: Option<PathBuf>,
    /// Seeds of each setting, from --seed on; 3 without a search file.
    #[arg(long, value_name = "N")]
    seeds: Option<usize>,
    /// Settings that a random search draws, or members of a population.
    #[arg(long, value_name = "N", requires = "file")]
    trials: Option<usize>,
    /// Trials at once; by default one per core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1024))]
    parallel: Option<u64>,
    /// Train with the pool of actors behind this endpoint of a router instead of with own actors; may be repeated.
    #[arg(long, value_name = "ENDPOINT", conflicts_with_all = ["actors", "envs", "deterministic"])]
    connect: Vec<String>,
    /// Folder of certificates made by `treadmill certs`, for the links to that router.
    #[arg(long, value_name = "DIR", requires = "connect")]
    tls: Option<PathBuf>,
    /// Allow plain tcp beyond loopback, where anyone on the network can read and forge it.
    #[arg(long, requires = "connect")]
    insecure: bool,
    /// Print the schedule of the best line of this sweep, as commands.
    #[arg(long, value_name = "SWEEP", exclusive = true)]
    schedule: Option<String>,
    /// Check everything, print the plan as JSON and begin nothing, for programs that run the trials themselves.
    #[arg(long, hide = true)]
    plan: bool,
    /// Draw `sweep.png` beside this plan, whose trials another program ran.
    #[arg(long, value_name = "PLAN", hide = true, exclusive = true)]
    draw: Option<PathBuf>,
    #[command(flatten)]
    new: NewRunArgs,
    #[command(flatten)]
    any: AnyRunArgs,
    #[command(flatten)]
    actors: OwnActorsArgs,
}

/// Describes those flags that mean something else than for `train`.
pub fn describe(arg: Arg) -> Arg {
    match arg.get_id().as_str() {
        "resume" => arg.value_name("SWEEP").help("Go on with this sweep: its folder, or its name below runs/"),
        "resume_or_start" => arg.help("Go on with the sweep in --run-dir if there is one, else begin it"),
        "run_dir" => arg.help("Folder of the sweep; by default runs/sweep-N with the first free N"),
        "seed" => arg.help("Seed of the first trial, and of what is drawn"),
        "actors" => arg.help("Actor processes of each trial; by default the trials at once share the cores"),
        "motion_fps" => arg.alias("fps"),
        "store" | "no_progress" => arg.hide(true),
        _ => arg,
    }
}

/// Runs a sweep to its end, or until it is stopped.
pub fn run(args: &SweepArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    if let Some(sweep) = &args.schedule {
        return report::print_best_schedule(sweep);
    }
    if let Some(plan) = &args.draw {
        return report::draw_plan(plan);
    }
    let flags = train_flags();
    let begun = args.new.run_dir.as_deref().filter(|root| args.any.resume_or_start && SweepFolder::is_sweep(root));
    let (folder, mut plan) = match (&args.any.resume, begun) {
        (Some(sweep), _) => {
            let has_others = args.file.is_some() || args.seeds.is_some() || args.new.seed.is_some();
            if has_others || args.new.run_dir.is_some() || !flags.is_empty() || !args.connect.is_empty() {
                let why = "--resume: a sweep keeps its flags; give only --parallel and --json with it";
                return Err(Usage(why.to_string()).into());
            }
            SweepFolder::open(sweep)?
        }
        (None, Some(root)) => {
            let (folder, plan) = SweepFolder::open(&root.display().to_string())?;
            if plan.flags != flags {
                let (own, root) = (plan.flags.join(" "), root.display());
                return Err(
                    Usage(format!("`{root}` holds a sweep with the flags `{own}`; a sweep keeps its flags")).into()
                );
            }
            let file = read_file(args)?.map(|(_, text)| text);
            let is_same = plan.file.as_ref().map(|(_, text)| text) == file.as_ref()
                && plan.seeds == args.seeds.or(file.is_none().then_some(SEEDS))
                && plan.settings == args.trials
                && plan.connect == args.connect
                && args.new.seed.is_none_or(|seed| seed == plan.seed);
            if !is_same {
                let root = root.display();
                let why = format!(
                    "`{root}` holds a sweep with another file, --connect, --seeds, --trials or --seed; a sweep keeps them"
                );
                return Err(Usage(why).into());
            }
            (folder, plan)
        }
        (None, None) => {
            let plan = plan_sweep(args, flags, tasks)?;
            if args.plan {
                say(&serde_json::to_string(&plan)?);
                return Ok(());
            }
            let folder = SweepFolder::create(args.new.run_dir.as_deref())?;
            folder.save(&plan)?;
            (folder, plan)
        }
    };
    if let Some(parallel) = args.parallel {
        plan.parallel = parallel as usize;
    }
    let search = plan.search()?;
    let goal = Goal::read(&plan.goal).map_err(Usage)?;
    let mut results = SweepResults::of_ended(folder.root(), &plan, &goal, search.interval_steps().is_some());
    let shown = report::shorter(folder.root()).display().to_string();
    let (count, parallel) = (plan.trials.len(), plan.parallel);
    say(&format!("{shown}: {count} trials, {parallel} at once; their output is in {shown}/trial-N.log"));
    let ended = async_runtime::run(async {
        let shutdown = Shutdown::default();
        let first = "stopping: trials save after this update; press Ctrl-C again to stop at once";
        signals::listen(shutdown.clone(), first)?;
        train(&folder, &mut plan, &search, &mut results, &shutdown).await
    })?;
    let go_on = format!("treadmill sweep --resume {}", quoted(&shown));
    match ended {
        Ended::All => {}
        Ended::Stopped => {
            let left = plan.unfinished().len();
            let stopped = format!("stopped with {left} of {} trials to go", plan.trials.len());
            // To whatever runs a service, success means that all trials have ended.
            anyhow::ensure!(!args.any.resume_or_start, "{stopped}; start it again to go on");
            say(&format!("{stopped}; go on with: {go_on}"));
            return Ok(());
        }
        Ended::NoRoom => anyhow::bail!(
            "the disk of `{shown}` is full, so no further trial begins; free some space, then go on with `{go_on}`"
        ),
    }
    report::print_end(&plan, &results);
    if args.any.json {
        say(&report::as_json(&plan, &results).to_string());
    }
    let failed = plan.failed();
    if failed == plan.trials.len() {
        anyhow::bail!("all {failed} trials failed; `{shown}/trial-1.log` has the output of the first");
    }
    Ok(())
}

/// Trains all trials that have not ended.
async fn train(
    folder: &SweepFolder,
    plan: &mut Plan,
    search: &SweepSearch,
    results: &mut SweepResults,
    shutdown: &Shutdown,
) -> anyhow::Result<Ended> {
    let mut runner = TrialRunner { folder, shutdown, parallel: plan.parallel, pause_at: None };
    let goal = results.goal.clone();
    let mut record = |plan: &mut Plan, index: usize, code: i32| {
        plan.trials[index].exit = Some(code);
        folder.save(plan)?;
        results.read(plan, index);
        report::write_tables(folder, plan, search, results)?;
        report::print_trial(folder, plan, results, index);
        Ok(())
    };
    let Some(interval_steps) = search.interval_steps() else {
        let unfinished = plan.unfinished();
        return runner.run(plan, &unfinished, record).await;
    };
    loop {
        if shutdown.asked() {
            return Ok(Ended::Stopped);
        }
        let boundary = population::boundary(plan.intervals + 1, interval_steps, plan.steps);
        let is_last = boundary >= plan.steps;
        runner.pause_at = Some(boundary);
        let living = plan.living().into_iter();
        let behind = |index: &usize| {
            plan.trials[*index].exit.is_none() && (is_last || trials::reached(&folder.trial(*index)) < boundary)
        };
        let behind: Vec<usize> = living.filter(behind).collect();
        let ended = runner
            .run(plan, &behind, |plan, index, code| {
                population::forget_state(folder, index);
                // A member that is well goes on after the interval.
                if is_last || code != 0 { record(plan, index, code) } else { Ok(()) }
            })
            .await?;
        if ended != Ended::All || is_last {
            return Ok(ended);
        }
        let next = population::boundary(plan.intervals + 2, interval_steps, plan.steps);
        let before = plan.trials.len();
        let replaced = population::evolve(folder, plan, search, &goal, next)?;
        plan.intervals += 1;
        folder.save(plan)?;
        (before..plan.trials.len()).for_each(|index| report::print_fork(plan, index));
        replaced.into_iter().try_for_each(|index| record(plan, index, plan.trials[index].exit.unwrap_or_default()))?;
    }
}

/// Returns name and text of the search file, if one is given.
fn read_file(args: &SweepArgs) -> anyhow::Result<Option<(String, String)>> {
    let read = |path: &PathBuf| -> anyhow::Result<(String, String)> {
        let name = path.display().to_string();
        Ok((name.clone(), fs::read_to_string(path).with_context(|| format!("cannot read `{name}`"))?))
    };
    args.file.as_ref().map(read).transpose()
}

/// Checks flags and file, and returns the plan of a new sweep.
fn plan_sweep(args: &SweepArgs, flags: Vec<String>, tasks: &TaskRegistry) -> anyhow::Result<Plan> {
    if args.any.store.is_some() {
        let why = "--store: the trials of a sweep keep their states in folders; leave it out";
        return Err(Usage(why.to_string()).into());
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
fn train_flags() -> Vec<String> {
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
