//! Subscriptions of observers to any key.

use std::time::Duration;

use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::Subscriber,
    sample::Sample,
};

use super::shared::last_part;
use crate::{error::BusError, session::Bus};

/// Subscription to a key expression. If too many messages wait, the oldest are dropped.
pub struct Feed {
    ring: Subscriber<RingChannelHandler<Sample>>,
}

/// Received message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Key on which it was published.
    pub key: String,
    /// Payload.
    pub payload: Vec<u8>,
}

impl Message {
    /// Returns the part of the key after its last slash, which names the sender of many messages.
    pub fn last_part(&self) -> &str {
        last_part(&self.key)
    }
}

impl Feed {
    /// Returns the next message that has arrived.
    pub fn try_next(&self) -> Option<Message> {
        self.ring.try_recv().ok().flatten().map(Message::from)
    }

    /// Waits for the next message. `None` if the session is closed.
    pub(super) async fn arrival(&self) -> Option<Message> {
        self.ring.recv_async().await.ok().map(Message::from)
    }

    /// Returns the next message, or `None` if none comes within `timeout`.
    pub fn next(&self, timeout: Duration) -> Option<Message> {
        self.ring.recv_timeout(timeout).ok().flatten().map(Message::from)
    }
}

impl From<Sample> for Message {
    fn from(sample: Sample) -> Self {
        Self { key: sample.key_expr().to_string(), payload: sample.payload().to_bytes().into_owned() }
    }
}

/// Subscribes to `key`; at most `capacity` messages wait.
pub fn observe(bus: &Bus, key: &str, capacity: usize) -> Result<Feed, BusError> {
    let ring = bus
        .session
        .declare_subscriber(key.to_string())
        .with(RingChannel::new(capacity))
        .wait()
        .map_err(BusError::flow(format!("listening to {key}")))?;
    Ok(Feed { ring })
}
