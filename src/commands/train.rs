//! `treadmill train`: runs a learner in this process and starts actor processes, without a network beyond loopback.

use clap::Args;
use treadmill_bus::Role;
use treadmill_config::Config;

use crate::{
    launch::{
        exit_code::Usage,
        host::{self, HostOptions},
        metrics_page::MetricsArgs,
        run_args::{AnyRunArgs, NewRunArgs, changes},
        startup::{self, RunCommand, Start},
    },
    shared::network_args::NetworkArgs,
};

/// Flags of `train`.
#[derive(Args)]
pub struct TrainArgs {
    #[command(flatten)]
    new: NewRunArgs,
    #[command(flatten)]
    any: AnyRunArgs,
    #[command(flatten)]
    network: NetworkArgs,
    #[command(flatten)]
    metrics: MetricsArgs,
    /// Run one actor in lock-step: the same seed gives the same weights bit for bit.
    #[arg(long)]
    deterministic: bool,
    /// Actor processes; by default one per core.
    #[arg(long)]
    actors: Option<u32>,
    /// Environments in total, divided among the actors.
    #[arg(long)]
    envs: Option<u32>,
    /// Endpoint to listen on; by default a free port on loopback, which is written to the run's folder.
    #[arg(long, value_name = "ENDPOINT", default_value = "tcp/127.0.0.1:0")]
    listen: String,
}

/// Trains until the run reaches its number of steps.
pub fn run(args: TrainArgs) -> anyhow::Result<()> {
    let options = args.network.options(Role::Learner, vec![args.listen], Vec::new())?;
    let metrics = args.metrics.listen()?;
    let mut changes = changes(&[("rollout.envs", args.envs), ("rollout.actors", args.actors)]);
    if args.deterministic {
        if args.actors.is_some_and(|actors| actors > 1) {
            return Err(Usage("--deterministic runs one actor in lock-step; leave --actors out".to_string()).into());
        }
        changes.push(("run.deterministic", true.into()));
    }
    let start = startup::prepare(RunCommand::Train, &args.new, &args.any, &changes)?;
    let actors = match &start {
        Start::Ready(prepared, _) => processes(&prepared.config, args.actors),
        Start::Finished(..) => 0,
    };
    host::run(start, HostOptions { any: &args.any, bus: &options, actors: Some(actors), metrics })
}

fn processes(config: &Config, flag: Option<u32>) -> u32 {
    let wanted = flag.filter(|_| !config.run.deterministic).unwrap_or(config.rollout.actors);
    startup::actor_processes(wanted, config.rollout.envs)
}
