//! `treadmill watch`: the page in the browser, with trained policies or an actor that trains.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use treadmill_humanoid::{TaskRegistry, mjcf::visual_meshes};
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_runtime::{run_folder::RunFolder, shutdown::Shutdown};

use crate::{
    launch::{async_runtime, exit_code::Usage, output::say, signals},
    page::{
        OpenPage, Served,
        flags::ServeArgs,
        fleet::LocalRun,
        live::Live,
        player::Player,
        recorded::Recorded,
        show::{POLICIES_MAX, Show, short},
    },
    shared::{
        learner_address::ReachArgs,
        model_file::{ModelFileArgs, ModelSource, meshes},
    },
};

/// Most runs whose curves a page shows.
const RUNS_MAX: usize = 32;

/// Flags of `watch`.
#[derive(Args, Clone, Debug)]
pub struct WatchArgs {
    #[command(flatten)]
    reach: ReachArgs,
    /// Further policies, which move beside the first one under the same commands; of more than four only the curves.
    #[arg(value_name = "RUN", index = 2, conflicts_with_all = ["live", "connect"])]
    more: Vec<String>,
    /// Watch an actor of a run while it trains. RUN is its folder on this machine; on other machines pass --connect.
    #[arg(long, conflicts_with = "steer")]
    live: bool,
    /// Actor to watch; by default the first one seen.
    #[arg(long, value_name = "NAME", requires = "live")]
    actor: Option<String>,
    /// Checkpoint: best, latest, or the number of updates of a kept one; by default best if it exists.
    #[arg(long, value_name = "WHICH", conflicts_with = "live")]
    checkpoint: Option<CheckpointChoice>,
    /// Play the steps that `eval --trace` wrote to this file, on the robot of RUN.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["live", "connect", "more", "checkpoint", "steer", "seed"])]
    trace: Option<PathBuf>,
    /// Seed of the resets, as for `eval`.
    #[arg(long, default_value_t = 1, conflicts_with = "live")]
    seed: u64,
    /// MJCF or URDF file, or card, whose visual meshes are shown; by default the one that the run was begun with, if that is
    /// on this machine.
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    #[command(flatten)]
    model_file: ModelFileArgs,
    #[command(flatten)]
    serve: ServeArgs,
}

/// Help for RUN, which `watch` takes in more forms than `status`.
pub const RUN_HELP: &str = "\
    Folder of a run, its name below runs/, a bundle file or an exported policy; with --live the folder of a run that \
    trains on this machine";

/// Serves the page until Ctrl-C.
pub fn run(args: &WatchArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    let WatchArgs { reach, more, live, actor, checkpoint, trace, seed, model, model_file, serve } = args;
    // Meshes that were asked for and cannot be read are an error.
    let visuals = model.as_deref().map(|file| visual_meshes(file, &model_file.files())).transpose()?;
    let of_first = |run: Option<&str>| visuals.clone().unwrap_or_else(|| meshes(run.and_then(ModelSource::of_run)));
    let (shutdown, tls) = (Shutdown::default(), reach.network.tls.as_deref());
    if *live || reach.folder.is_none() && !reach.connect.is_empty() {
        let served = serve.open(tls)?;
        let visuals = of_first(reach.folder.as_deref());
        return Live { reach, actor: actor.as_deref(), visuals }.run(served, &shutdown);
    }
    let Some(first) = reach.folder.clone() else {
        let why =
            "watch needs a RUN, as in `treadmill watch runs/walk-1`; or --live and, from another machine, --connect";
        return Err(Usage(why.to_string()).into());
    };
    let runs: Vec<String> = std::iter::once(first).chain(more.iter().cloned()).collect();
    if runs.len() > RUNS_MAX {
        return Err(Usage(format!("{} runs are too many to watch; name at most {RUNS_MAX}", runs.len())).into());
    }
    let (mut named, played) = (runs.clone(), &runs[..runs.len().min(POLICIES_MAX)]);
    if played.len() < runs.len() {
        say(&format!("the first {POLICIES_MAX} policies move; of the other runs the page shows the curves"));
    }
    if let Some(trace) = trace {
        let recorded = Recorded::open(tasks, &runs[0], trace, of_first(Some(&runs[0])))?;
        return serve_until_stop(serve.open(tls)?, &shutdown, |page| page.replay(recorded, &shutdown));
    }
    // A policy that cannot be played is an error now, not a notice on the page.
    for run in played {
        let player = Player::load(tasks, run, *checkpoint, *seed)?;
        if serve.steer && player.command().is_none() {
            say(&format!("`{run}` has no commands: --steer only pushes it and changes its world"));
        }
    }
    named.sort();
    named.dedup();
    // The last part of a path is the run's name on the bus; equal ones are distinguished by their paths.
    let is_alone = |run: &str| named.iter().filter(|other| short(other) == short(run)).count() == 1;
    let name = |run: &str| if is_alone(run) { short(run).to_string() } else { run.to_string() };
    let logs = named.iter().filter_map(|run| Some((RunFolder::open(run).ok()?, name(run)))).collect();
    let local: Vec<_> = named.iter().filter_map(|run| LocalRun::new(reach, run)).collect();
    let title = played.iter().map(|run| short(run)).collect::<Vec<_>>().join(", ");
    let runs = played.to_vec();
    let show = Show { title, runs, which: *checkpoint, seed: *seed, visuals, logs, tasks: tasks.clone() };
    serve_until_stop(serve.open(tls)?, &shutdown, |page| {
        local.into_iter().try_for_each(|run| run.follow(page.hub.clone(), shutdown.clone()))?;
        page.play(show, &shutdown)
    })
}

/// Serves a page until Ctrl-C, with what `begin` shows on it.
fn serve_until_stop(
    served: Served,
    shutdown: &Shutdown,
    begin: impl FnOnce(OpenPage) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    async_runtime::run(async {
        signals::listen(shutdown.clone(), "").context("signals cannot be caught")?;
        let link = served.link.clone();
        begin(served.serve(shutdown)?)?;
        say(&format!("watch at {link}"));
        shutdown.wait().await;
        Ok(())
    })
}
