//! Task of a run that other programs simulate. The first actor to register defines it.

use std::time::Duration;

use treadmill_bus::{Bus, learner::TaskServer};
use treadmill_learner::checkpoint::TrainingState;
use treadmill_proto::Task;
use treadmill_runtime::shutdown::Shutdown;

use crate::launch::{
    output::say,
    prepared::{FirstState, RunSetup},
};

/// Interval at which the wait for a task checks for a request to stop.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// Opens the server where actors register. If the run's task is unknown, waits until an actor registers it. Returns the
/// server and the run's state, or `None` after a request to stop.
pub async fn open_server(
    bus: &Bus,
    setup: &mut RunSetup,
    state: FirstState,
    shutdown: &Shutdown,
) -> anyhow::Result<Option<(TaskServer, TrainingState)>> {
    let known = state.known().map(TrainingState::task).transpose().map_err(anyhow::Error::msg)?;
    let init_from = match &state {
        FirstState::Known(_) => None,
        FirstState::AwaitsTask(init_from) => init_from.clone(),
    };
    let (config, begins_with) = (setup.config.clone(), init_from.clone());
    let objection = Box::new(move |task: &Task| {
        let misfit = || begins_with.as_ref()?.objection(&TrainingState::shape_for(&config, task));
        TrainingState::objection(&config, task).or_else(misfit)
    });
    let server = TaskServer::open(bus, &setup.run, known, objection)?;
    if let FirstState::Known(state) = state {
        return Ok(Some((server, *state)));
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
    let state = setup.set_task(task, init_from.as_deref())?;
    if let Some(origin) = &setup.origin {
        say(&format!("  begins    with the policy of {origin}"));
    }
    Ok(Some((server, state)))
}
