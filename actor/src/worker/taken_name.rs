//! An actor's name that another one in the run may have.

use std::time::{Duration, Instant};

use treadmill_bus::{
    Bus,
    actor::is_actor_present,
    observer::{newest_of_each_run, statuses},
};
use treadmill_proto::RunStatus;
use treadmill_runtime::shutdown::Shutdown;

use super::WorkerOptions;
use crate::ActorError;

/// Longest wait for the answer whether an actor of this name is in the run.
const TOKEN_TIMEOUT: Duration = Duration::from_secs(2);
/// Longest wait for a predecessor of the same name to go: Zenoh gives up a silent link after ten seconds.
const NAME_TIMEOUT: Duration = Duration::from_secs(15);
const NAME_RETRY: Duration = Duration::from_millis(500);

/// Waits until no other actor of this name is in the run: a predecessor may have ended without notice. Returns false after a
/// request to stop.
///
/// # Errors
/// [`ActorError::NameTaken`] if another one stays and the learner hears of it.
pub(super) async fn wait_for_name(
    bus: &Bus,
    options: &WorkerOptions,
    run: &str,
    shutdown: &Shutdown,
) -> Result<bool, ActorError> {
    let begun = Instant::now();
    while is_actor_present(bus, run, &options.name, TOKEN_TIMEOUT).await? {
        if begun.elapsed() > NAME_TIMEOUT {
            if is_heard(bus, run, &options.name).await? == Some(false) {
                let actor = &options.name;
                tracing::warn!(%actor, "the token of an actor of this name is there, but it sends nothing: joining");
                return Ok(true);
            }
            return Err(ActorError::NameTaken { run: run.to_string(), name: options.name.clone() });
        }
        tokio::select! {
            () = shutdown.wait() => return Ok(false),
            () = tokio::time::sleep(NAME_RETRY) => {}
        }
    }
    Ok(true)
}

/// Returns whether the learner has heard of an actor of this name lately. Routers were seen to keep the token of a
/// killed actor for minutes, so the token alone proves nothing. `None` if no learner answers.
async fn is_heard(bus: &Bus, run: &str, name: &str) -> Result<Option<bool>, ActorError> {
    let replies = statuses(bus, Some(run), TOKEN_TIMEOUT).await?;
    let newest = newest_of_each_run(replies).pop();
    let heard_s = |status: RunStatus| status.actors.into_iter().find(|actor| actor.name == name)?.since_contact_s;
    Ok(newest.map(|status| heard_s(status).is_some_and(|seconds| seconds < NAME_TIMEOUT.as_secs_f64())))
}
