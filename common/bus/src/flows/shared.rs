//! Parts that flows share: threads, queryables, replies and small publications.

use std::time::Duration;

use bytes::Bytes;
use treadmill_proto::Malformed;
use zenoh::{
    Wait,
    bytes::ZBytes,
    handlers::FifoChannelHandler,
    qos::{CongestionControl, Priority},
    query::{ConsolidationMode, Query, Reply},
};

use crate::{error::BusError, session::Bus, workarounds::kept_queryables::declare_queryable};

/// Starts a thread.
pub(super) fn start_thread(name: &str, work: impl FnOnce() + Send + 'static) -> Result<(), BusError> {
    let started = std::thread::Builder::new().name(name.to_string()).spawn(work);
    started
        .map(drop)
        .map_err(|error| BusError::Flow { what: format!("starting thread {name}"), why: error.to_string() })
}

/// Passes queries on `key` to `callback`, which must not block, for as long as the session lasts.
pub(super) fn serve(
    bus: &Bus,
    key: String,
    what: &str,
    callback: impl Fn(Query) + Send + Sync + 'static,
) -> Result<(), BusError> {
    declare_queryable(&bus.session, key, callback).map_err(BusError::flow(what))
}

/// Sends a query. Its replies come as they arrive: by default, Zenoh holds the reply of one learner until all have answered,
/// and keeps only one, and a learner that was overtaken may be silent. `what` names the operation in errors.
pub(super) fn ask(
    bus: &Bus,
    key: String,
    payload: impl Into<ZBytes>,
    timeout: Duration,
    priority: Priority,
    what: &str,
) -> Result<FifoChannelHandler<Reply>, BusError> {
    bus.session
        .get(key)
        .payload(payload)
        .timeout(timeout)
        .consolidation(ConsolidationMode::None)
        .priority(priority)
        .congestion_control(CongestionControl::Block)
        .wait()
        .map_err(BusError::flow(what))
}

/// Answers a query on its own key; logs a failure as `what`.
pub(super) fn reply(query: &Query, payload: impl Into<ZBytes>, what: &'static str) {
    reply_on(query, query.key_expr().as_str(), payload, what);
}

/// Answers a query on `key`; logs a failure as `what`. The bus drops the reply if the requester does not read.
pub(super) fn reply_on(query: &Query, key: &str, payload: impl Into<ZBytes>, what: &'static str) {
    if let Err(error) = query.reply(key, payload).wait() {
        tracing::debug!(what, %error, "reply not sent");
    }
}

/// Returns the next valid reply to a query, or `None` if none came in time. Logs invalid replies as `what`.
pub(super) async fn next_valid<T>(
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

/// Returns a function that publishes small messages on `key`. The bus drops them if the link is busy.
pub(super) fn publisher(bus: &Bus, key: String) -> Result<impl Fn(Vec<u8>) + Send + Sync + use<>, BusError> {
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

/// Returns the part of a key after its last slash.
pub(super) fn last_part(key: &str) -> &str {
    key.rsplit('/').next().unwrap_or(key)
}
