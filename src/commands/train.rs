//! `treadmill train`: runs a learner in this process and starts actor processes, without a network beyond loopback.

use clap::Args;
use treadmill_bus::Role;
use treadmill_humanoid::TaskRegistry;

use crate::{
    diagnosis::certificates,
    launch::{
        durability::LearnerRun,
        host::HostOptions,
        metrics_page::MetricsArgs,
        prepared::{Launcher, RunCommand},
        run_args::{AnyRunArgs, NewRunArgs, OwnActorsArgs},
    },
    page::flags::TrainPageArgs,
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
    #[command(flatten)]
    page: TrainPageArgs,
    #[command(flatten)]
    actors: OwnActorsArgs,
    /// Endpoint to listen on; by default a free port on loopback, which is written to the run's folder.
    #[arg(long, value_name = "ENDPOINT")]
    listen: Option<String>,
}

/// Trains until the run reaches its number of steps.
pub fn run(args: TrainArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    let launcher = Launcher { command: RunCommand::Train, tasks };
    let listen = args.listen.unwrap_or_else(|| args.network.loopback(0));
    let options = args.network.options(Role::Learner, vec![listen], Vec::new())?;
    certificates::check_own(options.credentials.as_ref())?;
    let (metrics, watch) = (args.metrics.listen()?, args.page.open(args.network.tls.as_deref())?);
    let changes = args.actors.changes()?;
    let (new, any) = (&args.new, &args.any);
    let run = LearnerRun { launcher, new, any, changes: &changes, name: None, is_standby: false };
    run.run(HostOptions {
        any,
        bus: &options,
        command: RunCommand::Train,
        actors: args.actors.actors,
        metrics,
        watch,
        tasks,
    })
}
