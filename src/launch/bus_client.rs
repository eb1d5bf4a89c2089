//! Flags and bus session of an actor or an evaluator.

use std::{io::Read, sync::Arc, time::Duration};

use clap::Args;
use tokio::task::spawn_blocking;
use treadmill_actor::{ActorError, policy_fetcher::Explain};
use treadmill_bus::{Bus, BusOptions, Role};
use treadmill_proto::ident::check_ident;
use treadmill_runtime::{machine, seeds, shutdown::Shutdown};

use super::{
    async_runtime, exit_code::Usage, link_page::LinkPage, memory, metrics_page::PageArgs, output::say, signals,
};
use crate::{
    diagnosis::{Silence, certificates},
    shared::network_args::{DEFAULT_PORT, NetworkArgs, check_run},
};

/// Time without an answer before the first warning: the learner may still be starting.
const FIRST_WARNING: Duration = Duration::from_secs(1);
const WARN_EVERY: Duration = Duration::from_secs(10);

/// Flags of an actor or an evaluator.
#[derive(Args)]
pub struct ClientArgs {
    /// Endpoint of the learner or of a router; may be repeated. By default port 7447 on loopback, as tls/ with --tls
    /// and else tcp/; none with --discover.
    #[arg(long, value_name = "ENDPOINT")]
    connect: Vec<String>,
    /// The run to join; may be left out if there is only one.
    #[arg(long, value_name = "NAME")]
    run: Option<String>,
    /// Unique name of this process; by default made from the host's name.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    #[command(flatten)]
    page: PageArgs,
    /// Exit when standard input closes, which happens when the parent process ends.
    #[arg(long, hide = true)]
    pub until_stdin_closes: bool,
}

impl ClientArgs {
    /// Returns the name of this process. Without the flag, each call makes another one.
    pub fn name(&self) -> Result<String, Usage> {
        let name = self.name.clone().unwrap_or_else(default_name);
        check_ident("name", &name).map_err(|why| Usage(why.to_string()))?;
        Ok(name)
    }

    /// Returns the endpoints to dial: those given, or the default.
    pub fn endpoints(&self, network: &NetworkArgs) -> Vec<String> {
        match self.connect.is_empty() && !network.discover {
            true => vec![network.loopback(DEFAULT_PORT)],
            false => self.connect.clone(),
        }
    }

    /// Returns the run to join, if given.
    pub fn run(&self) -> Result<Option<String>, Usage> {
        check_run(self.run.as_deref())?;
        Ok(self.run.clone())
    }

    /// Returns a function that finds out why the run does not answer a process of this role.
    pub fn explain(&self, network: &NetworkArgs, role: Role) -> anyhow::Result<Explain> {
        let options = network.options(role, Vec::new(), self.endpoints(network))?;
        let run = self.run.clone();
        Ok(Arc::new(move |bus| {
            let (options, run) = (options.clone(), run.clone());
            Box::pin(async move { Silence::of_run(&bus, &options, run.as_deref()).await.in_one_line() })
        }))
    }
}

/// What to do after the work with a session.
pub enum Next {
    /// End.
    End,
    /// Work again with a session at the next endpoint.
    Move,
}

/// Joins the bus as a client and runs `work` with the session. Returns early if the process is asked to stop while dialling.
pub fn with_session<W: Future<Output = Result<Next, ActorError>>>(
    client: ClientArgs,
    network: &NetworkArgs,
    role: Role,
    work: impl Fn(Bus, Shutdown) -> W,
) -> anyhow::Result<()> {
    let run = client.run.clone();
    let mut bus_options = network.options(role, Vec::new(), client.endpoints(network))?;
    certificates::check_own(bus_options.credentials.as_ref())?;
    let page = Arc::new(LinkPage::dialling(run.as_deref().unwrap_or_default(), &bus_options.connect));
    let listener = client.page.listen()?;
    memory::use_one_arena();
    async_runtime::run(async {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "")?;
        if client.until_stdin_closes {
            stop_when_stdin_closes(shutdown.clone())?;
        }
        if let Some(listener) = listener {
            say(&format!("metrics   http://{}/metrics", listener.serve(page.clone())?));
        }
        loop {
            let where_to = network.where_to(&bus_options.connect);
            let Some(bus) = dial(&bus_options, run.as_deref(), &where_to, &shutdown).await? else { return Ok(()) };
            page.set(&bus);
            let outcome = work(bus.clone(), shutdown.clone()).await;
            bus.close();
            match outcome? {
                Next::End => return Ok(()),
                Next::Move => {
                    bus_options.connect.rotate_left(1);
                    let next = bus_options.connect.join(", ");
                    tracing::warn!(
                        next,
                        "the endpoint is a standby's, which may not pass fragments on; trying the next one"
                    );
                }
            }
        }
    })
}

/// Opens a session. Returns `None` after a request to stop: dialling lasts until a peer answers, which may be never.
async fn dial(
    bus_options: &BusOptions,
    run: Option<&str>,
    where_to: &str,
    shutdown: &Shutdown,
) -> anyhow::Result<Option<Bus>> {
    let dialled = bus_options.clone();
    let opened = spawn_blocking(move || Bus::open_client(&dialled));
    tokio::pin!(opened);
    let mut warning = tokio::time::interval_at(tokio::time::Instant::now() + FIRST_WARNING, WARN_EVERY);
    // A diagnosis may take longer than the interval.
    warning.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
    loop {
        tokio::select! {
            bus = &mut opened => return Ok(Some(bus??)),
            () = shutdown.wait() => return Ok(None),
            _ = warning.tick() => {
                let (options, run) = (bus_options.clone(), run.map(str::to_string));
                let silence = spawn_blocking(move || Silence::of_endpoints(&options, run.as_deref()));
                tokio::select! {
                    bus = &mut opened => return Ok(Some(bus??)),
                    () = shutdown.wait() => return Ok(None),
                    silence = silence => {
                        let cause = silence?.in_one_line();
                        tracing::warn!(endpoints = %where_to, %cause, "no answer; retrying");
                    }
                }
            }
        }
    }
}

/// Returns the host's name with a random ending that makes it unique.
fn default_name() -> String {
    let host: String = machine::host_name()
        .to_lowercase()
        .chars()
        .map(|c| if c.is_ascii_lowercase() || c.is_ascii_digit() { c } else { '-' })
        .take(40)
        .collect();
    format!("{host}-{:08x}", seeds::unique() as u32)
}

/// Requests a stop when standard input closes: the parent holds the other end open and sends nothing.
fn stop_when_stdin_closes(shutdown: Shutdown) -> std::io::Result<()> {
    std::thread::Builder::new().name("parent-watch".to_string()).spawn(move || {
        let mut bytes = [0; 64];
        while matches!(std::io::stdin().read(&mut bytes), Ok(count) if count > 0) {}
        shutdown.ask();
        // The parent is gone, so this process must not outlive it even if stopping hangs.
        std::thread::sleep(Duration::from_secs(5));
        std::process::exit(1);
    })?;
    Ok(())
}
