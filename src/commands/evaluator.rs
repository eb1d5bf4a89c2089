//! `treadmill evaluator`: plays deterministic episodes with a run's policies while it trains, and reports the results.

use clap::{Args, builder::ArgPredicate};
use treadmill_actor::evaluator::{self, EvaluatorOptions};
use treadmill_bus::Role;
use treadmill_proto::{Malformed, ident::check_ident};

use crate::{
    launch::{
        bus_client::{default_name, with_session},
        exit_code::Usage,
    },
    shared::network_args::NetworkArgs,
};

/// Flags of `evaluator`.
#[derive(Args)]
pub struct EvaluatorArgs {
    /// Endpoint of the learner or of a router; may be repeated.
    #[arg(
        long,
        value_name = "ENDPOINT",
        default_value = "tcp/127.0.0.1:7447",
        default_value_if("discover", ArgPredicate::IsPresent, None)
    )]
    connect: Vec<String>,
    /// The run to evaluate; may be left out if there is only one.
    #[arg(long, value_name = "NAME")]
    run: Option<String>,
    /// This evaluator's unique name; by default made from the host's name.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    #[command(flatten)]
    network: NetworkArgs,
    /// Exit when standard input closes, which happens when the parent process ends.
    #[arg(long, hide = true)]
    until_stdin_closes: bool,
}

/// Evaluates until it is asked to stop.
pub fn run(args: EvaluatorArgs) -> anyhow::Result<()> {
    let options = EvaluatorOptions {
        run: args.run,
        name: args.name.unwrap_or_else(default_name),
        endpoint: args.network.where_to(&args.connect),
    };
    let usage_error = |why: Malformed| Usage(why.to_string());
    check_ident("name", &options.name).map_err(usage_error)?;
    if let Some(run) = &options.run {
        check_ident("run", run).map_err(usage_error)?;
    }
    let bus_options = args.network.options(Role::Evaluator, Vec::new(), args.connect)?;
    let where_to = options.endpoint.clone();
    with_session(bus_options, &where_to, args.until_stdin_closes, |bus, shutdown| {
        evaluator::run(bus, options, shutdown)
    })
}
