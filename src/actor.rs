//! `treadmill actor`: only an actor; task, model and rollout settings come from the learner with the policy bundle.

use std::{io::Read, time::Duration};

use anyhow::Context;
use clap::{Args, builder::ArgPredicate};
use serde_json::json;
use treadmill_actor::{
    ActorError,
    worker::{self, Account, WorkerOptions},
};
use treadmill_bus::{Bus, BusOptions, Role};
use treadmill_runtime::{machine, seeds, shutdown::Shutdown};

use crate::{outcome::Usage, output::say, signals, startup::NetworkArgs};

/// A learner that is just starting is no news.
const FIRST_COMPLAINT: Duration = Duration::from_secs(1);
const COMPLAIN_EVERY: Duration = Duration::from_secs(10);

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
        where_to: args.network.where_to(&args.connect),
    };
    let wrong = |why: treadmill_proto::Malformed| Usage(why.to_string());
    treadmill_proto::ident::check_ident("name", &options.name).map_err(wrong)?;
    if let Some(run) = &options.run {
        treadmill_proto::ident::check_ident("run", run).map_err(wrong)?;
    }
    let bus_options = args.network.options(Role::Actor, Vec::new(), args.connect)?;
    let where_to = options.where_to.clone();
    on_the_bus(bus_options, &where_to, args.until_stdin_closes, |bus, shutdown| async move {
        let name = options.name.clone();
        let account = worker::run(bus, options, shutdown).await?;
        if let Some(account) = account.filter(|_| args.json) {
            say(&as_json(&name, &account));
        }
        Ok(())
    })
}

fn as_json(name: &str, account: &Account) -> String {
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

/// Joins the bus as a client and does `work` there until it is done or somebody asks to stop.
pub fn on_the_bus<W: Future<Output = Result<(), ActorError>>>(
    bus_options: BusOptions,
    where_to: &str,
    until_stdin_closes: bool,
    work: impl FnOnce(Bus, Shutdown) -> W,
) -> anyhow::Result<()> {
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().context("no runtime")?;
    let outcome = runtime.block_on(async {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "")?;
        if until_stdin_closes {
            follow_standard_input(shutdown.clone())?;
        }
        let opened = tokio::task::spawn_blocking(move || Bus::open_client(&bus_options));
        tokio::pin!(opened);
        // The bus dials for as long as nobody answers; somebody who asks to stop does not wait for that.
        let mut silence = tokio::time::interval_at(tokio::time::Instant::now() + FIRST_COMPLAINT, COMPLAIN_EVERY);
        let bus = loop {
            tokio::select! {
                bus = &mut opened => break bus??,
                () = shutdown.wait() => return Ok(()),
                _ = silence.tick() => tracing::warn!("nobody answers at {where_to}; trying on until somebody does"),
            }
        };
        let outcome = work(bus.clone(), shutdown).await;
        bus.close();
        Ok(outcome?)
    });
    runtime.shutdown_background();
    outcome
}

/// A name that no other process has.
pub fn default_name() -> String {
    let host: String = machine::host_name()
        .to_lowercase()
        .chars()
        .map(|c| if c.is_ascii_lowercase() || c.is_ascii_digit() { c } else { '-' })
        .take(40)
        .collect();
    format!("{host}-{:08x}", seeds::unique() as u32)
}

/// The parent holds the other end of standard input open and sends nothing.
fn follow_standard_input(shutdown: Shutdown) -> std::io::Result<()> {
    std::thread::Builder::new().name("parent-watch".to_string()).spawn(move || {
        let mut bytes = [0; 64];
        while matches!(std::io::stdin().read(&mut bytes), Ok(count) if count > 0) {}
        shutdown.ask();
        // A process that does not come to an end by itself is of no use to a parent that is gone.
        std::thread::sleep(Duration::from_secs(5));
        std::process::exit(1);
    })?;
    Ok(())
}
