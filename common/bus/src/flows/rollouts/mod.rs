//! Rollouts: fragments on their way from actors to the learner, and their receipts.
//!
//! - [`intake`]: sends fragments, queues them, and answers them.
//! - [`received`]: decodes them from the bus's buffers.
//! - [`copies`]: sends copies to recorders.

pub mod copies;
pub mod intake;
pub mod received;
