//! `treadmill router`: forwards messages at a site with many machines, and hands out policies to the actors behind it.

use std::{sync::Arc, time::Duration};

use anyhow::Context;
use clap::Args;
use treadmill_bus::{
    Role,
    learner::{PolicyCache, SilentLearner},
};
use treadmill_runtime::shutdown::Shutdown;

use crate::{
    diagnosis::certificates,
    launch::{
        async_runtime, link_page::LinkPage, memory, metrics_page::PageArgs, output::say, restart::restart,
        router_session, signals,
    },
    shared::network_args::{NetworkArgs, PoolAccessArgs},
};

/// Flags of `router`.
#[derive(Args)]
pub struct RouterArgs {
    /// Endpoint to listen on; may be repeated. By default port 7447 on loopback, as tls/ with --tls and else tcp/.
    #[arg(long, value_name = "ENDPOINT")]
    listen: Vec<String>,
    /// Endpoint of the learner, or of a router on the way to it; may be repeated.
    #[arg(long, value_name = "ENDPOINT")]
    connect: Vec<String>,
    #[command(flatten)]
    network: NetworkArgs,
    #[command(flatten)]
    pools: PoolAccessArgs,
    #[command(flatten)]
    page: PageArgs,
    /// Silence of a learner after which the router starts anew (s).
    #[arg(
        long, hide = true, default_value_t = PATIENCE_S,
        value_parser = clap::value_parser!(u64).range(1..=PATIENCE_MAX_S)
    )]
    patience_s: u64,
    /// Whether a learner has answered before.
    #[arg(long, hide = true, default_value_t = false, action = clap::ArgAction::Set)]
    expects_answers: bool,
}

/// Silence of a learner after which the router starts anew, longer than most takeovers; doubled after each start without any
/// answer.
const PATIENCE_S: u64 = 8;
const PATIENCE_MAX_S: u64 = 240;
/// Time between the two sessions, in which actors that have another endpoint go there.
const PAUSE: Duration = Duration::from_secs(2);

/// Forwards messages until the process is asked to stop.
pub fn run(args: RouterArgs) -> anyhow::Result<()> {
    let mut options = args.network.listening_options(Role::Router, args.listen, args.connect)?;
    args.pools.add_to(&mut options)?;
    certificates::check_own(options.credentials.as_ref())?;
    let page = args.page.listen()?;
    memory::use_one_arena();
    if options.credentials.is_some() {
        treadmill_bus::workarounds::one_core::keep_to_one_core();
    }
    async_runtime::run(async {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "")?;
        let (bus, endpoints) = router_session::open(&options).await?;
        say(&format!("listening {}", endpoints.join(", ")));
        if !options.connect.is_empty() {
            say(&format!("dialling  {}, again after each loss", options.connect.join(", ")));
        }
        bus.log_links(shutdown.clone())?;
        let page = page.map(|page| page.serve(Arc::new(LinkPage::of(&bus, &options.connect)?))).transpose()?;
        if let Some(address) = page {
            say(&format!("metrics   http://{address}/metrics"));
        }
        let cache = PolicyCache::open(&bus)?;
        let silent = tokio::select! {
            silent = cache.serve(Duration::from_secs(args.patience_s), args.expects_answers) => silent,
            () = shutdown.wait() => None,
        };
        let Some(SilentLearner { run, has_answers }) = silent else {
            bus.close();
            return Ok(());
        };
        // After faults of the network Zenoh may lose the way to the learner. A new session may find it, and another
        // router has it. A session that is closed can panic, and then keeps its memory.
        tracing::warn!(run, "the link is there, but no answers of the learner arrive; starting anew");
        let patience_s = if has_answers { PATIENCE_S } else { (2 * args.patience_s).min(PATIENCE_MAX_S) };
        let values = [
            ("--listen", endpoints),
            ("--prometheus", page.iter().map(ToString::to_string).collect()),
            ("--patience-s", vec![patience_s.to_string()]),
            ("--expects-answers", vec![(args.expects_answers | has_answers).to_string()]),
        ];
        Err(restart(&values, PAUSE)).context("the router cannot start anew")
    })
}
