//! `treadmill actor`: runs only an actor; the learner's policy bundle brings task, model and rollout settings.

use clap::Args;
use serde_json::json;
use treadmill_actor::worker::{self, ActorSummary, BehindStandby, Ending, WorkerOptions};
use treadmill_bus::Role;
use treadmill_humanoid::TaskRegistry;
use treadmill_runtime::seeds;

use crate::{
    launch::{
        bus_client::{ClientArgs, Next, with_session},
        output::say,
    },
    shared::network_args::NetworkArgs,
};

/// Flags of `actor`.
#[derive(Args)]
pub struct ActorArgs {
    #[command(flatten)]
    client: ClientArgs,
    /// Belong to no run: join the run on the bus that lacks environments most, and move on when another one needs them more.
    #[arg(long, conflicts_with = "run")]
    pool: bool,
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
}

/// Runs the actor until it is asked to stop.
pub fn run(args: ActorArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    if args.nice > 0 {
        // Set before other threads start, because each inherits it. Failure is harmless.
        // SAFETY: the call takes a number and accesses no memory of this process.
        unsafe { libc::nice(args.nice) };
    }
    let options = WorkerOptions {
        name: args.client.name()?,
        run: args.client.run()?,
        is_pooled: args.pool,
        tasks: tasks.clone(),
        envs: args.envs,
        threads: args.threads,
        start: args.start_number.unwrap_or_else(seeds::unique),
        behind_standby: match &args.client.endpoints(&args.network)[..] {
            endpoints if !endpoints.iter().any(|endpoint| endpoint.starts_with("tls/")) => BehindStandby::Stay,
            [_] => BehindStandby::Warn,
            _ => BehindStandby::End,
        },
        explain: args.client.explain(&args.network, Role::Actor)?,
        // The parent of a supervised actor reports to the user.
        notify: if args.client.until_stdin_closes { |_| {} } else { say },
    };
    let (options, json) = (&options, args.json);
    with_session(args.client, &args.network, Role::Actor, |bus, shutdown| async move {
        let summary = match worker::run(&bus, options, &shutdown).await? {
            Ending::BehindStandby => return Ok(Next::Move),
            Ending::Stopped(summary) => summary,
        };
        if let Some(summary) = summary.filter(|_| json) {
            say(&as_json(&options.name, &summary));
        }
        Ok(Next::End)
    })
}

fn as_json(name: &str, summary: &ActorSummary) -> String {
    let fragments = summary.fragments;
    json!({
        "actor": name,
        // As text, because readers that parse numbers as doubles would lose its last digits.
        "incarnation": summary.incarnation.to_string(),
        "produced": fragments.produced,
        "accepted": fragments.accepted,
        "dropped_by_rule": fragments.dropped_by_rule,
        "in_flight": fragments.in_flight,
        "resent": fragments.resent,
        "awaiting_durability": fragments.awaiting_durability,
        "settled_through": summary.settled_through,
        "env_steps": summary.env_steps,
    })
    .to_string()
}
