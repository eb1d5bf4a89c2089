//! `treadmill router`: forwards messages at a site with many machines, and hands out policies to the actors behind it.

use std::time::Duration;

use clap::Args;
use treadmill_bus::{PolicyCache, Role, SilentLearner};
use treadmill_runtime::shutdown::Shutdown;

use crate::{
    diagnosis::certificates,
    launch::{async_runtime, memory, output::say, router_session, signals},
    shared::network_args::NetworkArgs,
};

/// Flags of `router`.
#[derive(Args)]
pub struct RouterArgs {
    /// Endpoint to listen on; may be repeated.
    #[arg(long, value_name = "ENDPOINT", default_value = "tcp/127.0.0.1:7447")]
    listen: Vec<String>,
    /// Endpoint of the learner, or of a router on the way to it; may be repeated.
    #[arg(long, value_name = "ENDPOINT")]
    connect: Vec<String>,
    #[command(flatten)]
    network: NetworkArgs,
}

/// Silence of a learner after which the session is opened anew, longer than most takeovers; doubled after each session without
/// any answer.
const PATIENCE: Duration = Duration::from_secs(8);
const PATIENCE_MAX: Duration = Duration::from_secs(240);
/// Time between the two sessions, in which actors that have another endpoint go there.
const PAUSE: Duration = Duration::from_secs(2);

/// Forwards messages until the process is asked to stop.
pub fn run(args: RouterArgs) -> anyhow::Result<()> {
    let options = args.network.options(Role::Router, args.listen, args.connect)?;
    certificates::check_own(options.credentials.as_ref())?;
    memory::use_one_arena();
    if options.credentials.is_some() {
        treadmill_bus::workarounds::one_core::keep_to_one_core();
    }
    async_runtime::run(async {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "")?;
        let (mut bus, endpoints) = router_session::open(&options).await?;
        say(&format!("listening {}", endpoints.join(", ")));
        if !options.connect.is_empty() {
            say(&format!("dialling  {}, again after each loss", options.connect.join(", ")));
        }
        let (mut patience, mut expects_answers) = (PATIENCE, false);
        loop {
            let cache = PolicyCache::open(&bus)?;
            let silent = tokio::select! {
                silent = cache.serve(patience, expects_answers) => silent,
                () = shutdown.wait() => None,
            };
            let Some(SilentLearner { run, has_answers }) = silent else { break };
            // After faults of the network Zenoh may lose the way to the learner. A new session may find it, and another router
            // has it.
            tracing::warn!(run, "the link is there, but no answers of the learner arrive; opening the session anew");
            expects_answers |= has_answers;
            patience = if has_answers { PATIENCE } else { (2 * patience).min(PATIENCE_MAX) };
            bus = tokio::select! {
                bus = router_session::reopen(&bus, &options, &endpoints, PAUSE) => bus?,
                () = shutdown.wait() => break,
            };
        }
        bus.close();
        Ok(())
    })
}
