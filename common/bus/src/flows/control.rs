//! Commands to a learner and questions about it: a desk on its side, callers on the other.

use std::{
    sync::mpsc::{Receiver, sync_channel},
    time::Duration,
};

use treadmill_proto::{Command, ControlReply, ControlRequest};
use zenoh::{
    Wait,
    qos::{CongestionControl, Priority},
    query::{Query, Queryable},
};

use crate::{Bus, BusError, keys};

/// Questions that may wait; whoever finds no room gets no answer, and asks again.
const QUEUE: usize = 256;

/// A request that waits for its answer.
pub struct PendingRequest {
    /// What is asked.
    pub request: ControlRequest,
    query: Query,
}

impl PendingRequest {
    /// Answers on the run's own key, also where the question left the run open.
    pub fn answer(self, run: &str, reply: &ControlReply) {
        let key = match self.query.key_expr().as_str().ends_with("/control") {
            true => keys::control(run),
            false => keys::status(run),
        };
        if let Err(why) = self.query.reply(key, reply.to_bytes()).wait() {
            tracing::debug!("an answer could not be sent: {why}");
        }
    }
}

/// Where requests come in.
pub struct ControlServer {
    queue: Receiver<PendingRequest>,
    _queryables: [Queryable<()>; 2],
}

impl ControlServer {
    /// Opens the desk of a run: every command on one key, and on another the question how it goes.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let (sender, queue) = sync_channel(QUEUE);
        let open = |key: String, may_command: bool| {
            let sender = sender.clone();
            bus.session
                .declare_queryable(key)
                .callback(move |query: Query| {
                    let payload = query.payload().map_or_else(Vec::new, |payload| payload.to_bytes().into_owned());
                    match ControlRequest::decode_checked(&payload) {
                        Ok(request) if may_command || request.command() == Command::Status => {
                            drop(sender.try_send(PendingRequest { request, query }));
                        }
                        Ok(request) => {
                            let (asked, key) = (request.command().as_str_name(), query.key_expr().clone());
                            tracing::warn!(
                                "`{asked}` was asked on {key}, which only tells; the key for commands ends in control"
                            );
                        }
                        Err(why) => tracing::warn!("a request to the learner was refused: {why}"),
                    }
                })
                .wait()
                .map_err(BusError::flow("listening to commands"))
        };
        let queryables = [open(keys::control(run), true)?, open(keys::status(run), false)?];
        Ok(Self { queue, _queryables: queryables })
    }

    /// The next request, if one comes within `patience`.
    pub fn next(&self, patience: Duration) -> Option<PendingRequest> {
        self.queue.recv_timeout(patience).ok()
    }
}

/// How every run goes that answers, or the one that is named.
pub async fn statuses(bus: &Bus, run: Option<&str>, timeout: Duration) -> Result<Vec<ControlReply>, BusError> {
    ask(bus, keys::status(run.unwrap_or("*")), &ControlRequest::plain(Command::Status), timeout).await
}

/// Commands the learner of `run`; `None` where nobody answered.
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
    let mut sound = Vec::new();
    while let Ok(reply) = replies.recv_async().await {
        let Ok(sample) = reply.result() else { continue };
        match ControlReply::decode_checked(&sample.payload().to_bytes()) {
            Ok(reply) => sound.push(reply),
            Err(why) => tracing::warn!("an answer was refused: {why}"),
        }
    }
    Ok(sound)
}
