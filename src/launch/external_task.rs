//! Task of a run that other programs simulate: the first actor that registers determines it.

use std::time::Duration;

use treadmill_bus::{Bus, TaskServer};
use treadmill_learner::checkpoint::TrainingState;
use treadmill_proto::Task;
use treadmill_runtime::shutdown::Shutdown;

use crate::launch::{output::say, startup::Prepared};

/// How often the wait for a task looks up.
const TICK: Duration = Duration::from_millis(100);

/// Opens the desk where actors register, and waits, where the run's task is not known yet, until one of them did; `None` once
/// somebody asked to stop.
pub async fn settle(bus: &Bus, prepared: &mut Prepared, shutdown: &Shutdown) -> anyhow::Result<Option<TaskServer>> {
    let known = prepared.state.as_ref().map(TrainingState::task).transpose().map_err(anyhow::Error::msg)?;
    let config = prepared.config.clone();
    let objection = Box::new(move |task: &Task| TrainingState::objection(&config, task));
    let desk = TaskServer::open(bus, &prepared.run, known, objection)?;
    if prepared.state.is_some() {
        return Ok(Some(desk));
    }
    let waiting = tokio::task::spawn_blocking({
        let shutdown = shutdown.clone();
        move || {
            while !shutdown.asked() {
                if let Some(task) = desk.accepted(TICK) {
                    return Some((desk, task));
                }
            }
            None
        }
    });
    let Some((desk, task)) = waiting.await? else { return Ok(None) };
    say(&format!("  task      {task}, as its first actor registered it"));
    prepared.settle(task)?;
    Ok(Some(desk))
}
