//! Follows a run in a store, and says when to lead it.

use std::time::{Duration, Instant};

use anyhow::Context;
use treadmill_bus::{
    BusError,
    observer::{is_actor_present, is_learner_present, statuses},
};
use treadmill_learner::leadership::{
    LeadershipError, Manifest, Status,
    follower::{LeaderSight, LoadedState, Sight, StateFollower},
};
use treadmill_proto::PolicyVersion;
use treadmill_runtime::{error_chain, numbers::thousands};
use treadmill_store::{Store, StoreError};

use crate::launch::{host::Host, output::say};

/// Longest wait for tokens.
const TOKEN_TIMEOUT: Duration = Duration::from_millis(400);
/// Longest wait for an answer of the leader.
const ANSWER_TIMEOUT: Duration = Duration::from_millis(800);
/// Pause between two warnings that the store fails.
const WARN_EVERY: Duration = Duration::from_secs(30);

/// What to do after a poll.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NextMove {
    /// Poll again.
    Wait,
    /// Lead from the state that is loaded.
    Lead,
    /// The run has ended.
    End,
}

/// Warnings that the store fails.
#[derive(Default)]
pub struct StoreWarnings {
    last: Option<Instant>,
}

impl StoreWarnings {
    /// Warns, unless that was not long ago.
    pub fn warn(&mut self, why: &StoreError) {
        if self.last.is_none_or(|last| last.elapsed() >= WARN_EVERY) {
            tracing::warn!(error = %error_chain(why), "the store fails: trying again");
            self.last = Some(Instant::now());
        }
    }
}

/// Learner that follows a run.
pub struct Standby {
    follower: StateFollower,
    /// Whether a run that has ended also ends this process.
    ends_with_run: bool,
    /// Whether the run was reported.
    is_known: bool,
    /// Whether the run was trained since this process follows it.
    was_trained: bool,
    warnings: StoreWarnings,
}

impl Standby {
    /// Follows the run in `store`.
    pub fn new(store: &Store, ends_with_run: bool) -> Self {
        Self {
            follower: StateFollower::new(store),
            ends_with_run,
            is_known: false,
            was_trained: false,
            warnings: StoreWarnings::default(),
        }
    }

    /// Returns the state that was loaded last.
    pub fn into_loaded(self) -> Option<LoadedState> {
        self.follower.into_loaded()
    }

    /// Reads the store and looks for the leader.
    ///
    /// # Errors
    /// If the manifest is damaged or the bus fails. A store that fails is only reported.
    pub async fn poll(&mut self, host: &Host<'_>) -> anyhow::Result<NextMove> {
        host.heartbeat.beat();
        match self.refresh().await? {
            Ok(()) => {}
            Err(LeadershipError::Store(why)) => {
                self.warnings.warn(&why);
                return Ok(NextMove::Wait);
            }
            Err(why) => return Err(why.into()),
        }
        let Some(LoadedState { manifest, .. }) = self.follower.loaded() else { return Ok(NextMove::Wait) };
        let (run, epoch, status) = (manifest.run.clone(), manifest.epoch, manifest.status);
        let steps = thousands(manifest.env_steps);
        if !self.is_known {
            let Manifest { pid, host: leader, .. } = manifest;
            say(&format!("run `{run}` is at {steps} env steps; process {pid} on host {leader} leads in epoch {epoch}"));
            host.name_run(&run);
            self.is_known = true;
        }
        if matches!(status, Status::Stopped | Status::Finished) {
            // A run that was stopped before is to go on; one that is stopped now ends for all who follow it.
            if !self.ends_with_run && !self.was_trained {
                return Ok(NextMove::Lead);
            }
            say(&format!("run `{run}` has ended at {steps} env steps"));
            return Ok(NextMove::End);
        }
        self.was_trained |= status == Status::Training;
        let sight = look(host, &run, epoch).await?;
        if !self.follower.is_due(sight, Instant::now()) {
            return Ok(NextMove::Wait);
        }
        if sight.leader != LeaderSight::Stalled {
            say(&format!("the leader of run `{run}` is gone: taking over"));
        } else if self.can_write().await? {
            say(&format!("the leader of run `{run}` cannot save its state, but this learner can: taking over"));
        } else {
            return Ok(NextMove::Wait);
        }
        Ok(NextMove::Lead)
    }

    /// Returns whether a trial write to the store succeeds.
    async fn can_write(&self) -> anyhow::Result<bool> {
        let follower = self.follower.clone();
        let trial = tokio::task::spawn_blocking(move || follower.try_write());
        trial.await.context("the thread that writes to the store panicked")
    }

    /// Loads the newest state on a thread of its own, because the store blocks.
    async fn refresh(&mut self) -> anyhow::Result<Result<(), LeadershipError>> {
        let mut follower = self.follower.clone();
        let work = move || {
            let refreshed = follower.refresh(Instant::now());
            (follower, refreshed)
        };
        let refreshed;
        (self.follower, refreshed) =
            tokio::task::spawn_blocking(work).await.context("the thread that reads the store panicked")?;
        Ok(refreshed)
    }
}

/// Looks for the leader of this epoch and for actors.
async fn look(host: &Host<'_>, run: &str, epoch: u64) -> Result<Sight, BusError> {
    // First, so that a link that comes back in between does not show actors beside a leader that was asked before.
    let actors = is_actor_present(&host.bus, run, "*", TOKEN_TIMEOUT).await?;
    let has_token = is_learner_present(&host.bus, run, TOKEN_TIMEOUT).await?;
    let leader = match has_token {
        true => ask_leader(host, run, epoch).await?,
        false => LeaderSight::Absent,
    };
    Ok(Sight { leader, actors })
}

/// Asks the leader of this epoch for its status.
async fn ask_leader(host: &Host<'_>, run: &str, epoch: u64) -> Result<LeaderSight, BusError> {
    // The bus may take longer than its own timeout while a link fails.
    let asked = tokio::time::timeout(2 * ANSWER_TIMEOUT, statuses(&host.bus, Some(run), ANSWER_TIMEOUT)).await;
    let replies = asked.unwrap_or(Ok(Vec::new()))?;
    let of_leader = |version: Option<PolicyVersion>| version.is_some_and(|version| version.epoch == epoch);
    let status = replies.into_iter().filter_map(|reply| reply.status).find(|status| of_leader(status.version));
    Ok(match status {
        Some(status) if status.waits_for_storage => LeaderSight::Stalled,
        Some(_) => LeaderSight::Answers,
        None => LeaderSight::Silent,
    })
}
