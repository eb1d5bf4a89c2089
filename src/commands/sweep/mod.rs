//! `treadmill sweep`: trains with several seeds or settings, each trial as an ordinary run in a process of its own.
//!
//! # Layout
//! - What is tried: [`search`] (the file), [`space`] (values of a key), [`goal`] (what trials are compared by).
//! - [`planning`]: checks a new sweep; [`plan`]: trials and what has become of them, as a file.
//! - [`trials`]: runs them; [`population`]: lets the worst fork the best.
//! - [`study`]: lets Optuna propose settings and end hopeless ones, through [`proposer`], by what [`followed_log`] reads.
//! - [`results`]: what was reached; [`report`]: lines, tables, CSV and picture.

mod followed_log;
mod goal;
mod plan;
mod planning;
mod population;
mod proposer;
mod report;
mod results;
mod search;
mod space;
mod study;
mod trials;

use std::{collections::BTreeMap, path::PathBuf};

use clap::{Arg, Args};
use treadmill_humanoid::TaskRegistry;
use treadmill_runtime::{error_chain, shutdown::Shutdown, words::quoted};

use self::{
    goal::Goal,
    plan::{Plan, SweepFolder},
    proposer::Proposer,
    results::SweepResults,
    search::SweepSearch,
    study::Study,
    trials::{Ended, TrialRunner},
};
use crate::{
    launch::{
        async_runtime,
        exit_code::Usage,
        output::{say, say_error},
        run_args::{AnyRunArgs, NewRunArgs, OwnActorsArgs},
        signals,
    },
    shared::existing_file::existing_file,
};

/// Seeds without a search file: two runs can agree by chance.
const SEEDS: usize = 3;
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
    /// Settings to try, or members of a population; with --resume, more of a search by Optuna.
    #[arg(long, value_name = "N")]
    trials: Option<usize>,
    /// Database of Optuna; by default study.db in the sweep's folder.
    #[arg(long, value_name = "URL", requires = "file")]
    storage: Option<String>,
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
    let flags = planning::train_flags();
    let begun = args.new.run_dir.as_deref().filter(|root| args.any.resume_or_start && SweepFolder::is_sweep(root));
    let (opened, mut plan) = match (&args.any.resume, begun) {
        (Some(sweep), _) => {
            let has_others = args.file.is_some() || args.seeds.is_some() || args.new.seed.is_some();
            if has_others || args.new.run_dir.is_some() || !flags.is_empty() || !args.connect.is_empty() {
                let why =
                    "--resume: a sweep keeps its flags; give only --parallel, --json, and --trials of Optuna with it";
                return Err(Usage(why.to_string()).into());
            }
            let (folder, mut plan) = SweepFolder::open(sweep)?;
            if let Some(trials) = args.trials {
                planning::add_trials(&mut plan, trials)?;
            }
            (Some(folder), plan)
        }
        (None, Some(root)) => {
            let (folder, plan) = SweepFolder::open(&root.display().to_string())?;
            planning::check_same(args, &flags, &plan, root)?;
            (Some(folder), plan)
        }
        (None, None) => (None, planning::plan_sweep(args, flags, tasks)?),
    };
    if let Some(parallel) = args.parallel {
        plan.parallel = parallel as usize;
    }
    let search = plan.search()?;
    let goal = Goal::read(&plan.goal).map_err(Usage)?;
    let proposer = search.sampler().map(|sampler| Proposer::start(sampler, &plan.started_in)).transpose()?;
    let is_new = opened.is_none();
    let folder = opened.map_or_else(|| SweepFolder::create(args.new.run_dir.as_deref()), Ok)?;
    if is_new {
        plan.study = folder.root().file_name().unwrap_or_default().to_string_lossy().into_owned();
    }
    let open = |proposer| Study::open(proposer, &folder, &plan, is_new, &search, &goal);
    let mut study = proposer.map(open).transpose()?;
    folder.save(&plan)?;
    let mut results = SweepResults::of_ended(folder.root(), &plan, &goal, search.interval_steps().is_some());
    let shown = report::shorter(folder.root()).display().to_string();
    let (count, parallel) = (search.count(&plan), plan.parallel);
    say(&format!("{shown}: {count} trials, {parallel} at once; their output is in {shown}/trial-N.log"));
    let (ended, importance) = async_runtime::run(async {
        let shutdown = Shutdown::default();
        let first = "stopping: trials save after this update; press Ctrl-C again to stop at once";
        signals::listen(shutdown.clone(), first)?;
        let ended = train(&folder, &mut plan, &search, study.as_mut(), &mut results, &shutdown).await?;
        let is_whole = matches!(ended, Ended::All);
        let importance = study.as_mut().filter(|_| is_whole).map_or_else(|| Ok(BTreeMap::new()), Study::importance);
        anyhow::Ok((ended, importance))
    })?;
    let go_on = format!("treadmill sweep --resume {}", quoted(&shown));
    match ended {
        Ended::All => {}
        Ended::Stopped => {
            let count = search.count(&plan);
            let left = plan.unfinished().len() + count - plan.trials.len();
            let stopped = format!("stopped with {left} of {count} trials to go");
            // To whatever runs a service, success means that all trials have ended.
            anyhow::ensure!(!args.any.resume_or_start, "{stopped}; start it again to go on");
            say(&format!("{stopped}; go on with: {go_on}"));
            return Ok(());
        }
        Ended::NoRoom => anyhow::bail!(
            "the disk of `{shown}` is full, so no further trial begins; free some space, then go on with `{go_on}`"
        ),
    }
    let importance = importance.unwrap_or_else(|why| {
        say_error(&format!("the importance of the keys is missing: {}", error_chain(&*why)));
        BTreeMap::new()
    });
    report::print_end(&plan, &results, &importance);
    if args.any.json {
        say(&report::as_json(&plan, &results, &importance).to_string());
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
    study: Option<&mut Study<'_>>,
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
        report::print_trial(folder, plan, results, index, search.count(plan));
        Ok(())
    };
    let Some(interval_steps) = search.interval_steps() else {
        let unfinished = plan.unfinished();
        return runner.run(plan, &unfinished, study, record).await;
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
            .run(plan, &behind, None, |plan, index, code| {
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
