//! Checks the limit on open files before Zenoh starts.
//!
//! Zenoh's threads panic if they cannot open a file, and callers that wait for them hang. No upstream issue is known;
//! raising the limit is eclipse-zenoh/zenoh#2673. Delete when opening a session returns an error instead.

use crate::error::BusError;

/// Open files below which Zenoh's threads panic; 48 were enough for a run with two actors.
const OPEN_FILES_MIN: u64 = 64;

/// Raises the limit on open files to what one session needs.
///
/// # Errors
/// [`BusError::OpenFiles`] if the system does not allow that.
pub(crate) fn check_open_files() -> Result<(), BusError> {
    // A system that reports no limit has none.
    let Ok((soft, _)) = rlimit::Resource::NOFILE.get() else { return Ok(()) };
    match soft < OPEN_FILES_MIN && rlimit::increase_nofile_limit(OPEN_FILES_MIN).unwrap_or(soft) < OPEN_FILES_MIN {
        true => Err(BusError::OpenFiles { limit: soft, needed: OPEN_FILES_MIN }),
        false => Ok(()),
    }
}
