//! Flows of the bus, one file for each kind of message.

pub(crate) mod control;
pub(crate) mod copies;
pub(crate) mod evaluation;
pub(crate) mod observer;
pub(crate) mod policies;
pub(crate) mod policy_cache;
pub(crate) mod policy_fetch;
pub(crate) mod policy_pieces;
pub(crate) mod poses;
pub(crate) mod presence;
pub(crate) mod publications;
pub(crate) mod received;
pub(crate) mod rollouts;
mod silences;
pub(crate) mod standby_mark;
pub(crate) mod stats;
pub(crate) mod tasks;
pub(crate) mod watched;

use bytes::Bytes;
use treadmill_proto::Malformed;
use zenoh::{
    Wait,
    bytes::ZBytes,
    handlers::FifoChannelHandler,
    query::{Query, Reply},
};

use crate::BusError;

/// Starts a thread.
fn start_thread(name: &str, work: impl FnOnce() + Send + 'static) -> Result<(), BusError> {
    let started = std::thread::Builder::new().name(name.to_string()).spawn(work);
    started
        .map(drop)
        .map_err(|error| BusError::Flow { what: format!("starting thread {name}"), why: error.to_string() })
}

/// Answers a query on its own key; logs a failure as `what`.
fn reply(query: &Query, payload: impl Into<ZBytes>, what: &'static str) {
    reply_on(query, query.key_expr().as_str(), payload, what);
}

/// Answers a query on `key`; logs a failure as `what`. The bus drops the reply if the requester does not read.
fn reply_on(query: &Query, key: &str, payload: impl Into<ZBytes>, what: &'static str) {
    if let Err(error) = query.reply(key, payload).wait() {
        tracing::debug!(what, %error, "reply not sent");
    }
}

/// Returns the next valid reply to a query, or `None` if none came in time. Logs invalid replies as `what`.
///
/// The query must ask for replies as they come. By default, Zenoh holds the reply of one learner until all have
/// answered, and a learner that was overtaken may be silent.
async fn next_valid<T>(
    replies: &FifoChannelHandler<Reply>,
    what: &'static str,
    decode: impl Fn(Bytes) -> Result<T, Malformed>,
) -> Option<T> {
    while let Ok(reply) = replies.recv_async().await {
        let Ok(sample) = reply.result() else { continue };
        match decode(Bytes::from(sample.payload().to_bytes().into_owned())) {
            Ok(value) => return Some(value),
            Err(error) => tracing::warn!(what, %error, "reply rejected"),
        }
    }
    None
}
