//! `treadmill evaluator`: plays deterministic episodes with a run's policies while it trains, and reports the results.

use clap::Args;
use treadmill_actor::evaluator::{self, EvaluatorOptions};
use treadmill_bus::Role;
use treadmill_humanoid::TaskRegistry;

use crate::{
    launch::bus_client::{ClientArgs, Next, with_session},
    shared::network_args::NetworkArgs,
};

/// Flags of `evaluator`.
#[derive(Args)]
pub struct EvaluatorArgs {
    #[command(flatten)]
    client: ClientArgs,
    #[command(flatten)]
    network: NetworkArgs,
}

/// Evaluates until it is asked to stop.
pub fn run(args: EvaluatorArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    let options = EvaluatorOptions {
        name: args.client.name()?,
        run: args.client.run()?,
        tasks: tasks.clone(),
        explain: args.client.explain(&args.network, Role::Evaluator)?,
    };
    with_session(args.client, &args.network, Role::Evaluator, |bus, shutdown| async {
        evaluator::run(bus, options.clone(), shutdown).await?;
        Ok(Next::End)
    })
}
