//! Finished episodes, which actors publish for observers.

use super::shared::publisher;
use crate::{error::BusError, session::Bus};

/// Returns a function that publishes finished episodes on `treadmill/{run}/episodes/{actor}`. The bus may drop them.
pub fn publish_episodes(bus: &Bus, run: &str, actor: &str) -> Result<impl Fn(Vec<u8>) + Send + Sync + use<>, BusError> {
    publisher(bus, format!("treadmill/{run}/episodes/{actor}"))
}
