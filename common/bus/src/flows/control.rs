//! Control requests: a learner answers status requests and takes commands.

use std::{
    sync::mpsc::{Receiver, sync_channel},
    time::Duration,
};

use treadmill_proto::{Command, ControlReply, ControlRequest};
use zenoh::{
    Wait,
    bytes::ZBytes,
    qos::{CongestionControl, Priority},
    query::Query,
};

use crate::{
    Bus, BusError, admission::rate_limited_log::RateLimitedLog, keys, workarounds::kept_queryables::declare_queryable,
};

/// Requests that may wait. Further ones get no answer, and the client asks again.
const QUEUE: usize = 256;

/// Request that waits for its answer.
pub struct PendingRequest {
    /// The request.
    pub request: ControlRequest,
    query: Query,
}

impl PendingRequest {
    /// Answers on the key of `run`, even if the request did not name a run.
    pub fn answer(self, run: &str, reply: &ControlReply) {
        let key = match self.query.key_expr().as_str().ends_with("/control") {
            true => keys::control(run),
            false => keys::status(run),
        };
        if let Err(error) = self.query.reply(key, reply.to_bytes()).wait() {
            tracing::debug!(what = "control reply", %error, "reply not sent");
        }
    }
}

/// Receives control requests on the learner's side.
pub struct ControlServer {
    queue: Receiver<PendingRequest>,
}

impl ControlServer {
    /// Opens two keys of a run: one for all commands, one for status requests only.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let (sender, queue) = sync_channel(QUEUE);
        let open = |key: String, may_command: bool| {
            let (sender, refusals) = (sender.clone(), RateLimitedLog::default());
            declare_queryable(&bus.session, key, move |query| {
                let payload = query.payload().map(ZBytes::to_bytes).unwrap_or_default();
                match ControlRequest::decode_checked(&payload) {
                    Ok(request) if may_command || request.command() == Command::Status => {
                        drop(sender.try_send(PendingRequest { request, query }));
                    }
                    Ok(request) => {
                        let command = request.command().as_str_name();
                        refusals.emit(|| {
                            tracing::warn!(command, key = %query.key_expr(), "command refused on the status key");
                        });
                    }
                    Err(error) => refusals.emit(|| tracing::warn!(%error, "control request rejected")),
                }
            })
            .map_err(BusError::flow("listening to commands"))
        };
        open(keys::control(run), true)?;
        open(keys::status(run), false)?;
        Ok(Self { queue })
    }

    /// Returns the next request, or `None` if none comes within `timeout`.
    pub fn next(&self, timeout: Duration) -> Option<PendingRequest> {
        self.queue.recv_timeout(timeout).ok()
    }
}

/// Returns the status of `run`, or of every run that answers.
pub async fn statuses(bus: &Bus, run: Option<&str>, timeout: Duration) -> Result<Vec<ControlReply>, BusError> {
    ask(bus, keys::status(run.unwrap_or("*")), &ControlRequest::plain(Command::Status), timeout).await
}

/// Sends a command to the learner of `run`. `None` if no answer came.
pub async fn command(
    bus: &Bus,
    run: &str,
    request: &ControlRequest,
    timeout: Duration,
) -> Result<Option<ControlReply>, BusError> {
    Ok(ask(bus, keys::control(run), request, timeout).await?.pop())
}

async fn ask(
    bus: &Bus,
    key: String,
    request: &ControlRequest,
    timeout: Duration,
) -> Result<Vec<ControlReply>, BusError> {
    let replies = bus
        .session
        .get(key)
        .payload(request.to_bytes())
        .timeout(timeout)
        .priority(Priority::InteractiveHigh)
        .congestion_control(CongestionControl::Block)
        .await
        .map_err(BusError::flow("asking the learner"))?;
    let mut valid = Vec::new();
    while let Ok(reply) = replies.recv_async().await {
        let Ok(sample) = reply.result() else { continue };
        match ControlReply::decode_checked(&sample.payload().to_bytes()) {
            Ok(reply) => valid.push(reply),
            Err(error) => tracing::warn!(what = "control reply", %error, "reply rejected"),
        }
    }
    Ok(valid)
}
