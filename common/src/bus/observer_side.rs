//! What observers do on the bus: listen to any key.

use std::time::Duration;

use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::Subscriber,
    sample::Sample,
};

use super::{Bus, BusError};

/// Messages of one key or of all that match a key expression; older ones give way to newer.
pub struct Feed {
    ring: Subscriber<RingChannelHandler<Sample>>,
}

/// One message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Where it was published.
    pub key: String,
    /// What it says.
    pub payload: Vec<u8>,
}

impl Feed {
    /// The next message, if one comes within `patience`.
    pub fn next(&self, patience: Duration) -> Option<Message> {
        let sample = self.ring.recv_timeout(patience).ok().flatten()?;
        Some(Message { key: sample.key_expr().to_string(), payload: sample.payload().to_bytes().into_owned() })
    }
}

/// Begins to listen; at most `capacity` messages wait.
pub fn observe(bus: &Bus, key: &str, capacity: usize) -> Result<Feed, BusError> {
    let ring = bus
        .session
        .declare_subscriber(key.to_string())
        .with(RingChannel::new(capacity))
        .wait()
        .map_err(BusError::flow(format!("listening to {key}")))?;
    Ok(Feed { ring })
}
