//! Waits of the training thread, and how other threads see them.
//!
//! # Layout
//! - [`heartbeat`]: [`Heartbeat`] of the training thread.
//! - [`retry`]: [`Retry`] repeats writes while the disk is full or the store fails.
//! - [`pending_writes`]: [`PendingWrites`], the writes in progress.

pub mod heartbeat;
pub mod pending_writes;
pub mod retry;

use std::time::Duration;

pub use heartbeat::Heartbeat;
pub use pending_writes::PendingWrites;
pub use retry::{MayPass, Obstacle, Retry};

/// Duration of a write from which on a leader reports that it waits. A request to a store that is cut off fails only later.
pub const STALLED_AFTER: Duration = Duration::from_secs(2);
