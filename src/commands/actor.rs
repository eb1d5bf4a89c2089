//! `treadmill actor`: runs only an actor; the learner's policy bundle brings task, model and rollout settings.

use clap::{Args, builder::ArgPredicate};
use serde_json::json;
use treadmill_actor::worker::{self, ActorSummary, WorkerOptions};
use treadmill_bus::Role;
use treadmill_proto::{Malformed, ident::check_ident};
use treadmill_runtime::seeds;

use crate::{
    launch::{
        bus_client::{default_name, with_session},
        exit_code::Usage,
        output::say,
    },
    shared::network_args::NetworkArgs,
};

/// Flags of `actor`.
#[derive(Args)]
pub struct ActorArgs {
    /// Endpoint of the learner or of a router; may be repeated.
    #[arg(
        long,
        value_name = "ENDPOINT",
        default_value = "tcp/127.0.0.1:7447",
        default_value_if("discover", ArgPredicate::IsPresent, None)
    )]
    connect: Vec<String>,
    /// The run to join; may be left out if there is only one.
    #[arg(long, value_name = "NAME")]
    run: Option<String>,
    /// This actor's unique name; by default made from the host's name.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Environments of this actor.
    #[arg(long, default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    envs: u32,
    /// Threads that step the environments, 0 for one per core; by default as the run is configured.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=256))]
    threads: Option<u32>,
    /// At the end, print the numbers of fragments by outcome as one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    network: NetworkArgs,
    /// Number of this start, from which its random streams are derived; by default unique.
    #[arg(long, hide = true)]
    start_number: Option<u64>,
    /// Nice value of this process, 0 to 19.
    #[arg(long, hide = true, default_value_t = 0, value_parser = clap::value_parser!(i32).range(0..=19))]
    nice: i32,
    /// Exit when standard input closes, which happens when the parent process ends.
    #[arg(long, hide = true)]
    until_stdin_closes: bool,
}

/// Runs the actor until it is asked to stop.
pub fn run(args: ActorArgs) -> anyhow::Result<()> {
    if args.nice > 0 {
        // Set before other threads start, because each inherits it. Failure is harmless.
        // SAFETY: the call takes a number and accesses no memory of this process.
        unsafe { libc::nice(args.nice) };
    }
    let options = WorkerOptions {
        name: args.name.unwrap_or_else(default_name),
        run: args.run,
        envs: args.envs,
        threads: args.threads,
        start: args.start_number.unwrap_or_else(seeds::unique),
        endpoint: args.network.where_to(&args.connect),
    };
    let usage_error = |why: Malformed| Usage(why.to_string());
    check_ident("name", &options.name).map_err(usage_error)?;
    if let Some(run) = &options.run {
        check_ident("run", run).map_err(usage_error)?;
    }
    let bus_options = args.network.options(Role::Actor, Vec::new(), args.connect)?;
    let where_to = options.endpoint.clone();
    with_session(bus_options, &where_to, args.until_stdin_closes, |bus, shutdown| async move {
        let name = options.name.clone();
        let account = worker::run(bus, options, shutdown).await?;
        if let Some(account) = account.filter(|_| args.json) {
            say(&as_json(&name, &account));
        }
        Ok(())
    })
}

fn as_json(name: &str, account: &ActorSummary) -> String {
    let fragments = account.fragments;
    json!({
        "actor": name,
        // As text, because readers that parse numbers as doubles would lose its last digits.
        "incarnation": account.incarnation.to_string(),
        "produced": fragments.produced,
        "accepted": fragments.accepted,
        "dropped_by_rule": fragments.dropped_by_rule,
        "in_flight": fragments.in_flight,
        "resent": fragments.resent,
        "awaiting_durability": fragments.awaiting_durability,
        "settled_through": account.settled_through,
        "env_steps": account.env_steps,
    })
    .to_string()
}
