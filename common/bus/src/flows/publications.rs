//! Small messages that the bus may drop: statistics, episodes and metrics.

use zenoh::{
    Wait,
    qos::{CongestionControl, Priority},
};

use crate::{Bus, BusError};

/// Returns a function that publishes small messages on `key`. The bus drops them if the link is busy.
pub fn publish_dropping(bus: &Bus, key: String) -> Result<impl Fn(Vec<u8>) + Send + Sync + use<>, BusError> {
    let publisher = bus
        .session
        .declare_publisher(key)
        .congestion_control(CongestionControl::Drop)
        .priority(Priority::DataLow)
        .wait()
        .map_err(BusError::flow("declaring a publisher"))?;
    Ok(move |payload: Vec<u8>| {
        if let Err(error) = publisher.put(payload).wait() {
            tracing::debug!(%error, "message not sent");
        }
    })
}
