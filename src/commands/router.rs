//! `treadmill router`: forwards messages at a site with many machines, and hands out policies to the actors behind it.

use clap::Args;
use treadmill_bus::{Bus, PolicyCache, Role};
use treadmill_runtime::shutdown::Shutdown;

use crate::{
    diagnosis::certificates,
    launch::{async_runtime, output::say, signals},
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

/// Forwards messages until the process is asked to stop.
pub fn run(args: RouterArgs) -> anyhow::Result<()> {
    let options = args.network.options(Role::Router, args.listen, args.connect)?;
    certificates::check_own(options.credentials.as_ref())?;
    if options.credentials.is_some() {
        treadmill_bus::workarounds::one_core::keep_to_one_core();
    }
    async_runtime::run(async {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "")?;
        let dialled = options.connect.join(", ");
        let (bus, endpoints) = tokio::task::spawn_blocking(move || Bus::open_router(&options)).await??;
        say(&format!("listening {}", endpoints.join(", ")));
        if !dialled.is_empty() {
            say(&format!("dialling  {dialled}, again after each loss"));
        }
        let cache = PolicyCache::open(&bus)?;
        tokio::select! {
            () = cache.serve() => {}
            () = shutdown.wait() => {}
        }
        bus.close();
        Ok(())
    })
}
