//! Session of a learner or router, which others dial, and which may be opened anew.

use std::time::{Duration, Instant};

use treadmill_bus::{Bus, BusOptions};

use super::memory;

/// Longest wait for the endpoints of a closed session to become free.
const REOPEN_TIMEOUT: Duration = Duration::from_secs(10);
const REOPEN_RETRY: Duration = Duration::from_millis(200);

/// Opens the session. Returns the endpoints on which it listens.
///
/// # Errors
/// If an endpoint is in use, or the system refuses.
pub async fn open(options: &BusOptions) -> anyhow::Result<(Bus, Vec<String>)> {
    let options = options.clone();
    Ok(tokio::task::spawn_blocking(move || Bus::open_router(&options)).await??)
}

/// Closes a session and opens another one on the same endpoints after a pause, as soon as they are free. Returns what the closed
/// one left of memory to the system.
///
/// # Errors
/// As [`open`].
pub async fn reopen(bus: &Bus, options: &BusOptions, endpoints: &[String], pause: Duration) -> anyhow::Result<Bus> {
    let closed = bus.clone();
    tokio::task::spawn_blocking(move || closed.close()).await?;
    tokio::time::sleep(pause).await;
    let options = BusOptions { listen: endpoints.to_vec(), ..options.clone() };
    let begin = Instant::now();
    loop {
        match open(&options).await {
            Ok((bus, _)) => {
                memory::return_freed();
                return Ok(bus);
            }
            Err(why) if begin.elapsed() > REOPEN_TIMEOUT => return Err(why),
            Err(why) => tracing::debug!(%why, "endpoints not free yet"),
        }
        tokio::time::sleep(REOPEN_RETRY).await;
    }
}
