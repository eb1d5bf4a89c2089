//! Makes a reader of a link yield after a pause of the read throttle.
//!
//! During the pause another thread runs the links of this one and may write to the paused link. If the link is encrypted,
//! both threads would then use its TLS connection without a lock (eclipse-zenoh/zenoh#2557). So the reader yields to the
//! runtime before it reads on. It yields once its task's budget is spent ([`tokio::task::coop`]).
//!
//! Delete when Zenoh locks the connection (see `threads`). The throttle then needs another way to count pauses per read.

use std::{
    pin::pin,
    task::{Context, Waker},
};

use tokio::task::consume_budget;

/// Spends the calling task's budget, so that it yields at its next await.
pub(crate) fn yield_read() {
    // Outside of a task there is no budget and the poll never pends, hence the bound.
    for _ in 0..=u8::MAX {
        if pin!(consume_budget()).poll(&mut Context::from_waker(Waker::noop())).is_pending() {
            return;
        }
    }
}
