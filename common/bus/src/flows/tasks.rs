//! The learner's desk where actors of external tasks register what they simulate, before they do anything else.

use std::{
    sync::mpsc::{Receiver, sync_channel},
    time::Duration,
};

use treadmill_proto::{Malformed, Task, TaskReceipt, TaskRegistration, ident::check_ident, limits::TASK_BYTES_MAX};
use zenoh::{
    Wait,
    query::{Query, Queryable},
};

use crate::{Bus, BusError, keys};

/// Registrations that may wait; whoever finds no room gets no answer, and asks again.
const QUEUE: usize = 64;

/// Why a task that nobody settled yet cannot be this run's, in words.
pub type Objection = Box<dyn Fn(&Task) -> Option<String> + Send + Sync>;

/// The learner's end.
pub struct TaskServer {
    settled: Receiver<Task>,
    _queryable: Queryable<()>,
}

impl TaskServer {
    /// Opens the desk. Where the run's task is not `known` yet, the first that is registered and not objected to is it.
    pub fn open(bus: &Bus, run: &str, known: Option<Task>, objection: Objection) -> Result<Self, BusError> {
        let (ask, requests) = sync_channel::<Query>(QUEUE);
        let (settle, settled) = sync_channel(1);
        std::thread::Builder::new()
            .name("task-desk".to_string())
            .spawn({
                let (run, mut known) = (run.to_string(), known);
                move || {
                    for query in requests {
                        let was_known = known.is_some();
                        let receipt = register(&query, &run, &mut known, &objection);
                        if let Some(task) = known.as_ref().filter(|_| !was_known) {
                            drop(settle.try_send(task.clone()));
                        }
                        answer(&query, &receipt);
                    }
                }
            })
            .map_err(|why| BusError::Flow { what: "starting the task desk".to_string(), why: why.to_string() })?;
        let queryable = bus
            .session
            .declare_queryable(keys::tasks(run, "*"))
            .callback(move |query| {
                let bytes = query.payload().map_or(0, zenoh::bytes::ZBytes::len);
                // Before it takes up room in the queue.
                if bytes > TASK_BYTES_MAX {
                    let why = Malformed::TooLarge { what: "task", bytes, limit: TASK_BYTES_MAX };
                    return answer(&query, &TaskReceipt { accepted: false, reason: why.to_string(), task: None });
                }
                drop(ask.try_send(query));
            })
            .wait()
            .map_err(BusError::flow("taking registrations of tasks"))?;
        Ok(Self { settled, _queryable: queryable })
    }

    /// The task that was settled by a registration, if that happens within `patience`.
    pub fn settled(&self, patience: Duration) -> Option<Task> {
        self.settled.recv_timeout(patience).ok()
    }
}

fn answer(query: &Query, receipt: &TaskReceipt) {
    if let Err(why) = query.reply(query.key_expr().clone(), receipt.encode()).wait() {
        tracing::debug!("a task receipt could not be sent: {why}");
    }
}

fn register(query: &Query, run: &str, known: &mut Option<Task>, objection: &Objection) -> TaskReceipt {
    let actor = keys::last_part(query.key_expr().as_str());
    let why = match read(query, run, actor) {
        Err(why) => Some(why.to_string()),
        Ok(task) => match known.as_ref() {
            Some(known) => known.differs_from(&task),
            None => objection(&task).or_else(|| {
                *known = Some(task);
                None
            }),
        },
    };
    if let Some(why) = &why {
        tracing::warn!("the registration of actor `{}` was refused: {why}", actor.escape_debug());
    }
    TaskReceipt { accepted: why.is_none(), reason: why.unwrap_or_default(), task: known.clone() }
}

fn read(query: &Query, run: &str, actor: &str) -> Result<Task, Malformed> {
    check_ident("actor", actor)?;
    let payload = query.payload().map(zenoh::bytes::ZBytes::to_bytes).unwrap_or_default();
    let registration = TaskRegistration::decode(&payload)?;
    for (field, found, wanted) in [("run", &registration.run[..], run), ("actor", &registration.actor[..], actor)] {
        if found != wanted {
            let (value, expected) = (format!("`{found}`"), format!("`{wanted}`, as the key says"));
            return Err(Malformed::Field { field, value, expected });
        }
    }
    Ok(registration.task)
}

/// Registers a task with the learner of `run`. `None` where nobody answered.
pub async fn register_task(
    bus: &Bus,
    registration: &TaskRegistration,
    timeout: Duration,
) -> Result<Option<TaskReceipt>, BusError> {
    let payload = registration
        .encode()
        .map_err(|why| BusError::Flow { what: "registering a task".to_string(), why: why.to_string() })?;
    let replies = bus
        .session
        .get(keys::tasks(&registration.run, &registration.actor))
        .payload(payload)
        .timeout(timeout)
        .await
        .map_err(BusError::flow("registering a task"))?;
    while let Ok(reply) = replies.recv_async().await {
        let Ok(sample) = reply.result() else { continue };
        match TaskReceipt::decode(&sample.payload().to_bytes()) {
            Ok(receipt) => return Ok(Some(receipt)),
            Err(why) => tracing::warn!("a task receipt was refused: {why}"),
        }
    }
    Ok(None)
}
