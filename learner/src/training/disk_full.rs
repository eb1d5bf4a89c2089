//! Waits while the disk is full, so that a run does not lose what it has learnt.

use std::{
    error::Error,
    io::{self, ErrorKind},
    time::{Duration, Instant},
};

use treadmill_runtime::{error_chain, shutdown::Shutdown};

use crate::checkpoint::CheckpointError;

/// Pause between two attempts.
const RETRY: Duration = Duration::from_millis(500);
/// Pause between two warnings.
const WARN_EVERY: Duration = Duration::from_secs(30);

/// Error that may mean that the disk is full.
pub trait MayBeDiskFull: Error {
    /// Whether the disk or the quota is full.
    fn is_disk_full(&self) -> bool;
}

impl MayBeDiskFull for io::Error {
    fn is_disk_full(&self) -> bool {
        matches!(self.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded)
    }
}

impl MayBeDiskFull for CheckpointError {
    fn is_disk_full(&self) -> bool {
        matches!(self, Self::Write { source, .. } if source.is_disk_full())
    }
}

/// Calls `write` until the disk is no longer full or shutdown is requested. A `write` that fails must leave no partial
/// output.
pub fn wait_for_disk_space<T, E: MayBeDiskFull>(
    shutdown: &Shutdown,
    mut write: impl FnMut() -> Result<T, E>,
) -> Result<T, E> {
    let mut warned: Option<Instant> = None;
    loop {
        match write() {
            Err(why) if why.is_disk_full() && !shutdown.asked() => {
                if warned.is_none_or(|warned| warned.elapsed() >= WARN_EVERY) {
                    tracing::warn!(error = %error_chain(&why), "the disk is full: training waits until there is room");
                    warned = Some(Instant::now());
                }
                std::thread::sleep(RETRY);
            }
            outcome => {
                if warned.is_some() && outcome.is_ok() {
                    tracing::warn!("there is room on the disk again: training continues");
                }
                return outcome;
            }
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
    fn only_a_full_disk_is_retried() {
        let mut tries = 0;
        let written = wait_for_disk_space(&Shutdown::default(), || {
            tries += 1;
            if tries < 3 { Err(full()) } else { Ok(tries) }
        });
        assert_eq!(written.unwrap(), 3);
        let refused =
            wait_for_disk_space(&Shutdown::default(), || Err::<(), _>(io::Error::from(ErrorKind::PermissionDenied)));
        assert_eq!(refused.unwrap_err().kind(), ErrorKind::PermissionDenied);
        let source = CheckpointError::Write { path: "latest.bundle".into(), source: full() };
        assert!(source.is_disk_full());
    }

    #[test]
    fn a_shutdown_ends_the_wait() {
        let shutdown = Shutdown::default();
        let mut tries = 0;
        let refused = wait_for_disk_space(&shutdown, || {
            tries += 1;
            shutdown.ask();
            Err::<(), _>(full())
        });
        assert!(refused.unwrap_err().is_disk_full());
        assert_eq!(tries, 1);
    }
}
