//! Task of a run that other programs simulate. The first actor to register defines it.

use std::time::Duration;

use treadmill_bus::{Bus, TaskServer};
use treadmill_learner::checkpoint::TrainingState;
use treadmill_proto::Task;
use treadmill_runtime::shutdown::Shutdown;

use crate::launch::{output::say, startup::Prepared};

/// Interval at which the wait for a task checks for a request to stop.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// Opens the server where actors register. If the run's task is unknown, waits until an actor registers it. Returns `None` after
/// a request to stop.
pub async fn open_server(
    bus: &Bus,
    prepared: &mut Prepared,
    shutdown: &Shutdown,
) -> anyhow::Result<Option<TaskServer>> {
    let known = prepared.state.as_ref().map(TrainingState::task).transpose().map_err(anyhow::Error::msg)?;
    let (config, init_from) = (prepared.config.clone(), prepared.init_from.clone());
    let objection = Box::new(move |task: &Task| {
        let begins_with = || init_from.as_ref()?.objection(&TrainingState::shape_for(&config, task));
        TrainingState::objection(&config, task).or_else(begins_with)
    });
    let server = TaskServer::open(bus, &prepared.run, known, objection)?;
    if prepared.state.is_some() {
        return Ok(Some(server));
    }
    let waiting = tokio::task::spawn_blocking({
        let shutdown = shutdown.clone();
        move || {
            while !shutdown.asked() {
                if let Some(task) = server.accepted(POLL_INTERVAL) {
                    return Some((server, task));
                }
            }
            None
        }
    });
    let Some((server, task)) = waiting.await? else { return Ok(None) };
    say(&format!("  task      {task}, as its first actor registered it"));
    prepared.set_task(task)?;
    if let Some(origin) = &prepared.origin {
        say(&format!("  begins    with the policy of {origin}"));
    }
    Ok(Some(server))
}
