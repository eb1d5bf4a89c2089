//! A disk that is full is waited for: what a run has learnt is worth more than the time until somebody, or a rotation of
//! logs, makes room.

use std::{
    io::{self, ErrorKind},
    time::{Duration, Instant},
};

use treadmill_runtime::shutdown::Shutdown;

use crate::checkpoint::CheckpointError;

/// Between two tries.
const RETRY: Duration = Duration::from_millis(500);
/// Between two messages.
const REPEAT: Duration = Duration::from_secs(30);

/// An error that may say that there is no room.
pub trait OutOfRoom: std::fmt::Display {
    /// Whether more room would help.
    fn is_out_of_room(&self) -> bool;
}

impl OutOfRoom for io::Error {
    fn is_out_of_room(&self) -> bool {
        matches!(self.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded)
    }
}

impl OutOfRoom for CheckpointError {
    fn is_out_of_room(&self) -> bool {
        matches!(self, Self::Write { source, .. } if source.is_out_of_room())
    }
}

/// Writes, again and again for as long as the disk is full; not once somebody asked to stop. `write` must leave things as
/// they were when it fails.
pub fn wait_for_room<T, E: OutOfRoom>(shutdown: &Shutdown, mut write: impl FnMut() -> Result<T, E>) -> Result<T, E> {
    let mut told: Option<Instant> = None;
    loop {
        match write() {
            Err(why) if why.is_out_of_room() && !shutdown.asked() => {
                if told.is_none_or(|told| told.elapsed() >= REPEAT) {
                    tracing::warn!("{why}; training waits until there is room");
                    told = Some(Instant::now());
                }
                std::thread::sleep(RETRY);
            }
            outcome => {
                if told.is_some() && outcome.is_ok() {
                    tracing::warn!("there is room again, and training goes on");
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
    fn a_full_disk_is_waited_for_and_nothing_else() {
        let mut tries = 0;
        let written = wait_for_room(&Shutdown::default(), || {
            tries += 1;
            if tries < 3 { Err(full()) } else { Ok(tries) }
        });
        assert_eq!(written.unwrap(), 3);
        let refused =
            wait_for_room(&Shutdown::default(), || Err::<(), _>(io::Error::from(ErrorKind::PermissionDenied)));
        assert_eq!(refused.unwrap_err().kind(), ErrorKind::PermissionDenied);
        let source = CheckpointError::Write { path: "latest.bundle".into(), source: full() };
        assert!(source.is_out_of_room());
    }

    #[test]
    fn whoever_asks_to_stop_does_not_wait_for_room() {
        let shutdown = Shutdown::default();
        let mut tries = 0;
        let refused = wait_for_room(&shutdown, || {
            tries += 1;
            shutdown.ask();
            Err::<(), _>(full())
        });
        assert!(refused.unwrap_err().is_out_of_room());
        assert_eq!(tries, 1);
    }
}
