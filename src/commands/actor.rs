//! `treadmill actor`: only an actor; task, model and rollout settings come from the learner with the policy bundle.

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
    /// Where the learner or a router listens; may be repeated.
    #[arg(
        long,
        value_name = "ENDPOINT",
        default_value = "tcp/127.0.0.1:7447",
        default_value_if("discover", ArgPredicate::IsPresent, None)
    )]
    connect: Vec<String>,
    /// The run to join; may be left out where there is only one.
    #[arg(long, value_name = "NAME")]
    run: Option<String>,
    /// This actor's name, unlike that of any other; by default made from the host's name.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// Environments of this actor.
    #[arg(long, default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    envs: u32,
    /// Threads that the environments are spread over, 0 for one per core; by default what the run says.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=256))]
    threads: Option<u32>,
    /// At the end, print what became of all fragments as one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    network: NetworkArgs,
    /// Number of this start, from which its random streams are derived; without it, unlike that of any other start.
    #[arg(long, hide = true)]
    start_number: Option<u64>,
    /// How much less urgent than others this process is, 0 to 19.
    #[arg(long, hide = true, default_value_t = 0, value_parser = clap::value_parser!(i32).range(0..=19))]
    nice: i32,
    /// End when standard input closes, which it does when the parent process is gone.
    #[arg(long, hide = true)]
    until_stdin_closes: bool,
}

/// Runs the actor until it is told to stop.
pub fn run(args: ActorArgs) -> anyhow::Result<()> {
    if args.nice > 0 {
        // Before any other thread is there: each thread has its own, and inherits it. Being refused is no harm.
        // SAFETY: it takes a number and touches no memory of ours.
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
    let wrong = |why: Malformed| Usage(why.to_string());
    check_ident("name", &options.name).map_err(wrong)?;
    if let Some(run) = &options.run {
        check_ident("run", run).map_err(wrong)?;
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
        // As text: readers that take every number for a double would lose its last digits.
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
