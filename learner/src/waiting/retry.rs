//! Waits while a disk is full or a store fails, so that a run does not lose what it has learnt.

use std::{
    error::Error,
    io::{self, ErrorKind},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use treadmill_runtime::{error_chain, shutdown::Shutdown};
use treadmill_store::StoreError;

use super::{Heartbeat, PendingWrites};

/// Pause between two attempts.
const PAUSE: Duration = Duration::from_millis(500);
/// Pause between two warnings.
const WARN_EVERY: Duration = Duration::from_secs(30);

/// Obstacle that may pass by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The disk or the quota is full.
    DiskFull,
    /// The store is slow, unreachable, full or read-only, or answers with an error.
    Store,
}

/// Error whose cause may pass by itself.
pub trait MayPass: Error {
    /// Returns the cause, if it may pass.
    fn obstacle(&self) -> Option<Obstacle>;
}

impl MayPass for io::Error {
    fn obstacle(&self) -> Option<Obstacle> {
        matches!(self.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded).then_some(Obstacle::DiskFull)
    }
}

impl MayPass for StoreError {
    fn obstacle(&self) -> Option<Obstacle> {
        // A conflict without a successor is of two of this process's own requests: S3 refuses the second of two at the
        // same time.
        matches!(self, Self::Failed { .. } | Self::Conflict { .. }).then_some(Obstacle::Store)
    }
}

/// Repeats writes while an obstacle lasts.
#[derive(Clone, Debug, Default)]
pub struct Retry {
    /// A request to stop ends the wait.
    pub shutdown: Shutdown,
    /// Beats meanwhile: waiting for a disk or the store does not count as a stall, and a restart would lose the update
    /// that is not saved yet.
    pub heartbeat: Heartbeat,
    /// Writes of this run in progress.
    pub pending: PendingWrites,
    /// Whether another learner leads, which also ends the wait: the run goes on without this one.
    pub overtaken: Arc<AtomicBool>,
}

impl Retry {
    /// Calls `write` until the obstacle has passed, shutdown is requested, or another learner leads. A `write` that
    /// fails must leave no partial output.
    ///
    /// # Errors
    /// That of the last call.
    pub fn until_written<T, E: MayPass>(&self, mut write: impl FnMut() -> Result<T, E>) -> Result<T, E> {
        let mut warned: Option<Instant> = None;
        let pending = self.pending.begin();
        loop {
            let outcome = write();
            let obstacle = outcome.as_ref().err().and_then(MayPass::obstacle);
            let goes_on = !self.shutdown.asked() && !self.overtaken.load(Ordering::Relaxed);
            if let (Err(why), Some(obstacle), true) = (&outcome, obstacle, goes_on) {
                let error = error_chain(why);
                pending.record_error(&error);
                if warned.is_none_or(|warned| warned.elapsed() >= WARN_EVERY) {
                    match obstacle {
                        Obstacle::DiskFull => {
                            tracing::warn!(%error, "the disk is full: training waits until there is room")
                        }
                        Obstacle::Store => tracing::warn!(%error, "the store fails: training waits until it answers"),
                    }
                    warned = Some(Instant::now());
                }
                self.heartbeat.beat();
                std::thread::sleep(PAUSE);
                continue;
            }
            if warned.is_some() && outcome.is_ok() {
                tracing::warn!("written: training continues");
            }
            return outcome;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn full() -> io::Error {
        ErrorKind::StorageFull.into()
    }

    #[test]
    fn only_what_may_pass_is_retried() {
        let mut tries = 0;
        let retry = Retry::default();
        let written = retry.until_written(|| {
            tries += 1;
            if tries < 3 { Err(full()) } else { Ok(tries) }
        });
        assert_eq!(written.unwrap(), 3);
        let refused = retry.until_written(|| Err::<(), _>(io::Error::from(ErrorKind::PermissionDenied)));
        assert_eq!(refused.unwrap_err().kind(), ErrorKind::PermissionDenied);
    }

    #[test]
    fn a_shutdown_ends_the_wait() {
        let retry = Retry::default();
        let mut tries = 0;
        let refused = retry.until_written(|| {
            tries += 1;
            retry.shutdown.ask();
            Err::<(), _>(full())
        });
        assert_eq!(refused.unwrap_err().obstacle(), Some(Obstacle::DiskFull));
        assert_eq!(tries, 1);
    }

    #[test]
    fn a_successor_ends_the_wait() {
        let (retry, mut tries) = (Retry::default(), 0);
        let refused = retry.until_written(|| {
            tries += 1;
            if tries == 2 {
                retry.overtaken.store(true, Ordering::Relaxed);
            }
            Err::<(), _>(full())
        });
        assert_eq!((refused.unwrap_err().obstacle(), tries), (Some(Obstacle::DiskFull), 2));
    }

    #[test]
    fn a_wait_beats() {
        let retry = Retry { heartbeat: Heartbeat::silent_for(Duration::from_secs(1000)), ..Retry::default() };
        retry.until_written(|| if retry.heartbeat.silence() > PAUSE * 100 { Err(full()) } else { Ok(()) }).unwrap();
    }
}
