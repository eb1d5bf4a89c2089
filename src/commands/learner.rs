//! `treadmill learner`: runs only the learner.

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
        run_args::{AnyRunArgs, NewRunArgs},
    },
    page::flags::TrainPageArgs,
    shared::network_args::{NetworkArgs, PoolAccessArgs, check_run},
};

/// Flags of `learner`.
#[derive(Args)]
pub struct LearnerArgs {
    #[command(flatten)]
    new: NewRunArgs,
    #[command(flatten)]
    any: AnyRunArgs,
    #[command(flatten)]
    network: NetworkArgs,
    #[command(flatten)]
    pools: PoolAccessArgs,
    #[command(flatten)]
    metrics: MetricsArgs,
    #[command(flatten)]
    page: TrainPageArgs,
    /// Name of the run on the bus; by default the name of its folder.
    #[arg(long, value_name = "NAME")]
    run: Option<String>,
    /// Endpoint to listen on; may be repeated. By default port 7447 on loopback, as tls/ with --tls and else tcp/.
    #[arg(long, value_name = "ENDPOINT")]
    listen: Vec<String>,
    /// Follow the run in --store, and lead it once its leader is gone.
    #[arg(long, requires = "store")]
    standby: bool,
    /// Endpoint of a router to join; may be repeated.
    #[arg(long, value_name = "ENDPOINT")]
    connect: Vec<String>,
}

/// Runs the learner until the run reaches its number of steps.
pub fn run(args: LearnerArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    let launcher = Launcher { command: RunCommand::Learner, tasks };
    check_run(args.run.as_deref())?;
    let role = if args.standby { Role::Standby } else { Role::Learner };
    let mut options = args.network.listening_options(role, args.listen, args.connect)?;
    args.pools.add_to(&mut options)?;
    certificates::check_own(options.credentials.as_ref())?;
    let (metrics, watch) = (args.metrics.listen()?, args.page.open(args.network.tls.as_deref())?);
    let (new, any) = (&args.new, &args.any);
    let run = LearnerRun { launcher, new, any, changes: &[], name: args.run, is_standby: args.standby };
    run.run(HostOptions { any, bus: &options, command: RunCommand::Learner, actors: None, metrics, watch, tasks })
}
