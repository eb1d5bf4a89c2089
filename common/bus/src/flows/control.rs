//! Control requests: a learner answers status requests and takes commands.

use std::{
    collections::BTreeMap,
    sync::mpsc::{Receiver, sync_channel},
    time::Duration,
};

use treadmill_proto::{Command, ControlReply, ControlRequest, RunStatus};
use zenoh::{bytes::ZBytes, qos::Priority, query::Query};

use super::shared::{self, next_valid, reply_on, serve};
use crate::{admission::rate_limited_log::RateLimitedLog, error::BusError, session::Bus};

/// Last part of the key of commands.
const CONTROL: &str = "control";
/// Last part of the key of status requests, also from peers that may not send commands.
const STATUS: &str = "status";
/// Requests that may wait. Further ones get no answer, and the client asks again.
const QUEUE: usize = 256;

/// Returns `treadmill/{run}/control` or `treadmill/{run}/status`.
fn key(run: &str, last_part: &str) -> String {
    format!("treadmill/{run}/{last_part}")
}

/// Request that waits for its answer.
pub struct PendingRequest {
    /// The request.
    pub request: ControlRequest,
    query: Query,
}

impl PendingRequest {
    /// Answers on the key of `run`, even if the request did not name a run.
    pub fn answer(self, run: &str, reply: &ControlReply) {
        let may_command = self.query.key_expr().as_str().ends_with(CONTROL);
        reply_on(&self.query, &key(run, if may_command { CONTROL } else { STATUS }), reply.to_bytes(), "control reply");
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
            serve(bus, key, "listening to commands", move |query| {
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
        };
        open(key(run, CONTROL), true)?;
        open(key(run, STATUS), false)?;
        Ok(Self { queue })
    }

    /// Returns the next request, or `None` if none comes within `timeout`.
    pub fn next(&self, timeout: Duration) -> Option<PendingRequest> {
        self.queue.recv_timeout(timeout).ok()
    }
}

/// Returns the status of every learner of `run`, or of all runs, that answers. Beside its successor, one that was
/// overtaken may answer.
pub async fn statuses(bus: &Bus, run: Option<&str>, timeout: Duration) -> Result<Vec<ControlReply>, BusError> {
    ask(bus, key(run.unwrap_or("*"), STATUS), &ControlRequest::plain(Command::Status), timeout).await
}

/// Returns one status for each run, in the order of their names: that of the newest epoch.
pub fn newest_of_each_run(replies: impl IntoIterator<Item = ControlReply>) -> Vec<RunStatus> {
    let mut runs = BTreeMap::<String, RunStatus>::new();
    for status in replies.into_iter().filter_map(|reply| reply.status) {
        let known = runs.get(&status.run);
        if known.is_none_or(|known| epoch(known) <= epoch(&status)) {
            runs.insert(status.run.clone(), status);
        }
    }
    runs.into_values().collect()
}

fn epoch(status: &RunStatus) -> u64 {
    status.version.map_or(0, |version| version.epoch)
}

/// Sends a command to the learners of `run`, and returns the answer of the newest epoch. `None` if no answer came.
pub async fn command(
    bus: &Bus,
    run: &str,
    request: &ControlRequest,
    timeout: Duration,
) -> Result<Option<ControlReply>, BusError> {
    let replies = ask(bus, key(run, CONTROL), request, timeout).await?;
    Ok(replies.into_iter().max_by_key(|reply| reply.status.as_ref().map(epoch)))
}

async fn ask(
    bus: &Bus,
    key: String,
    request: &ControlRequest,
    timeout: Duration,
) -> Result<Vec<ControlReply>, BusError> {
    let replies = shared::ask(bus, key, request.to_bytes(), timeout, Priority::InteractiveHigh, "asking the learner")?;
    let mut valid = Vec::new();
    while let Some(reply) = next_valid(&replies, "control reply", |bytes| ControlReply::decode_checked(&bytes)).await {
        valid.push(reply);
    }
    Ok(valid)
}
