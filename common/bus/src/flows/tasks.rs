//! External tasks: actors register what they simulate before they do anything else; the learner accepts or refuses.

use std::{
    sync::mpsc::{Receiver, SyncSender, sync_channel},
    time::Duration,
};

use treadmill_proto::{Malformed, Task, TaskReceipt, TaskRegistration, ident::check_ident, limits::TASK_BYTES_MAX};
use zenoh::{bytes::ZBytes, qos::Priority, query::Query};

use super::shared::{ask, last_part, next_valid, reply, serve, start_thread};
use crate::{admission::rate_limited_log::RateLimitedLog, error::BusError, session::Bus};

/// Registrations that may wait. Further ones get no answer, and the actor asks again.
const QUEUE: usize = 64;

/// Returns `treadmill/{run}/tasks/{actor}`.
fn key(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/tasks/{actor}")
}

/// Returns why a task cannot be this run's, or `None` if it can.
pub type Objection = Box<dyn Fn(&Task) -> Option<String> + Send + Sync>;

/// Receives registrations of external tasks.
pub struct TaskServer {
    accepted: Receiver<Task>,
}

impl TaskServer {
    /// Starts the server. If the run's task is not `known` yet, the first registered one without an `objection` becomes it.
    pub fn open(bus: &Bus, run: &str, known: Option<Task>, objection: Objection) -> Result<Self, BusError> {
        let (sender, requests) = sync_channel::<Query>(QUEUE);
        let (accept, accepted) = sync_channel(1);
        start_thread("task-server", {
            let run = run.to_string();
            move || answer_all(requests, &run, known, &objection, &accept)
        })?;
        serve(bus, key(run, "*"), "taking registrations of tasks", move |query| {
            let bytes = query.payload().map_or(0, ZBytes::len);
            // Checked here, so that a large registration takes no place in the queue.
            if bytes > TASK_BYTES_MAX {
                let error = Malformed::TooLarge { what: "task", bytes, limit: TASK_BYTES_MAX };
                let refusal = TaskReceipt { accepted: false, reason: error.to_string(), task: None };
                return reply(&query, refusal.to_bytes(), "task receipt");
            }
            drop(sender.try_send(query));
        })?;
        Ok(Self { accepted })
    }

    /// Returns the first accepted task, or `None` if none is accepted within `timeout`.
    pub fn accepted(&self, timeout: Duration) -> Option<Task> {
        self.accepted.recv_timeout(timeout).ok()
    }
}

fn answer_all(
    requests: Receiver<Query>,
    run: &str,
    mut known: Option<Task>,
    objection: &Objection,
    accept: &SyncSender<Task>,
) {
    let refusals = RateLimitedLog::default();
    for query in requests {
        let was_known = known.is_some();
        let receipt = register(&query, run, &mut known, objection, &refusals);
        if let Some(task) = known.as_ref().filter(|_| !was_known) {
            drop(accept.try_send(task.clone()));
        }
        reply(&query, receipt.to_bytes(), "task receipt");
    }
}

fn register(
    query: &Query,
    run: &str,
    known: &mut Option<Task>,
    objection: &Objection,
    refusals: &RateLimitedLog,
) -> TaskReceipt {
    let actor = last_part(query.key_expr().as_str());
    let refusal = match read(query, run, actor) {
        Err(error) => Some(error.to_string()),
        Ok(task) => match known.as_ref() {
            Some(known) => known.differs_from(&task),
            None => objection(&task).or_else(|| {
                *known = Some(task);
                None
            }),
        },
    };
    if let Some(error) = &refusal {
        refusals.emit(|| tracing::warn!(actor, %error, "registration refused"));
    }
    TaskReceipt { accepted: refusal.is_none(), reason: refusal.unwrap_or_default(), task: known.clone() }
}

fn read(query: &Query, run: &str, actor: &str) -> Result<Task, Malformed> {
    check_ident("actor", actor)?;
    let payload = query.payload().map(ZBytes::to_bytes).unwrap_or_default();
    let registration = TaskRegistration::decode(&payload)?;
    for (field, found, wanted) in [("run", &registration.run[..], run), ("actor", &registration.actor[..], actor)] {
        if found != wanted {
            let (value, expected) = (format!("`{found}`"), format!("`{wanted}`, as the key says"));
            return Err(Malformed::Field { field, value, expected });
        }
    }
    Ok(registration.task)
}

/// Registers a task with the learner of the run. `None` if no answer came.
pub async fn register_task(
    bus: &Bus,
    registration: &TaskRegistration,
    timeout: Duration,
) -> Result<Option<TaskReceipt>, BusError> {
    let payload = registration
        .encode()
        .map_err(|error| BusError::Flow { what: "registering a task".to_string(), why: error.to_string() })?;
    let key = key(&registration.run, &registration.actor);
    let replies = ask(bus, key, payload, timeout, Priority::Data, "registering a task")?;
    Ok(next_valid(&replies, "task receipt", |payload| TaskReceipt::decode_checked(&payload)).await)
}
