//! Bus session of an actor or an evaluator: dialling, stopping, default name.

use std::{io::Read, time::Duration};

use anyhow::Context;
use treadmill_actor::ActorError;
use treadmill_bus::{Bus, BusOptions};
use treadmill_runtime::{machine, seeds, shutdown::Shutdown};

use super::signals;

/// Time without an answer before the first warning: the learner may still be starting.
const FIRST_WARNING: Duration = Duration::from_secs(1);
const WARN_EVERY: Duration = Duration::from_secs(10);

/// Joins the bus as a client and runs `work` with the session. Returns early if the process is asked to stop while dialling.
pub fn with_session<W: Future<Output = Result<(), ActorError>>>(
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
            stop_when_stdin_closes(shutdown.clone())?;
        }
        let opened = tokio::task::spawn_blocking(move || Bus::open_client(&bus_options));
        tokio::pin!(opened);
        // Dialling lasts until a peer answers, which may be never.
        let mut warning = tokio::time::interval_at(tokio::time::Instant::now() + FIRST_WARNING, WARN_EVERY);
        let bus = loop {
            tokio::select! {
                bus = &mut opened => break bus??,
                () = shutdown.wait() => return Ok(()),
                _ = warning.tick() => tracing::warn!(endpoints = %where_to, "no answer; retrying"),
            }
        };
        let outcome = work(bus.clone(), shutdown).await;
        bus.close();
        Ok(outcome?)
    });
    runtime.shutdown_background();
    outcome
}

/// Returns the host's name with a random ending that makes it unique.
pub fn default_name() -> String {
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
