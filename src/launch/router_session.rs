//! Session of a learner or router, which others dial.

use treadmill_bus::{Bus, BusOptions};

/// Opens the session. Returns the endpoints on which it listens.
///
/// # Errors
/// If an endpoint is in use, or the system refuses.
pub async fn open(options: &BusOptions) -> anyhow::Result<(Bus, Vec<String>)> {
    let options = options.clone();
    Ok(tokio::task::spawn_blocking(move || Bus::open_router(&options)).await??)
}
