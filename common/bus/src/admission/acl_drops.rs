//! Counts and throttles messages that Zenoh drops because the access rules or a size limit forbid them.
//!
//! Zenoh reports these drops only in its log, on the thread that reads the link. So a layer of the log counts them.

use std::sync::{
    LazyLock,
    atomic::{AtomicU64, Ordering},
};

use tokio::runtime::Handle;
use tracing::{Event, Level, Subscriber};
use tracing_subscriber::{Layer, filter::filter_fn, layer::Context, registry::LookupSpan};

use crate::admission::read_throttle::ReadThrottle;

/// Target under which Zenoh logs dropped messages, and nothing else at this level.
const TARGET: &str = "zenoh::net::routing::interceptor";
/// Dropped messages per second above which the link is throttled. An honest client causes none, or a few when it joins.
const DROPS_PER_S: f64 = 200.0;

static DROPPED: AtomicU64 = AtomicU64::new(0);

/// Returns how many forbidden messages this process has dropped, incoming and outgoing.
#[must_use]
pub fn dropped_messages() -> u64 {
    DROPPED.load(Ordering::Relaxed)
}

/// Log layer that counts dropped messages and throttles the links they come from. It logs nothing.
pub fn throttle_drops<S: Subscriber + for<'a> LookupSpan<'a>>() -> impl Layer<S> {
    DropCounter.with_filter(filter_fn(|metadata| metadata.target() == TARGET && *metadata.level() == Level::TRACE))
}

struct DropCounter;

impl<S: Subscriber> Layer<S> for DropCounter {
    fn on_event(&self, _: &Event<'_>, _: Context<'_, S>) {
        static THROTTLE: LazyLock<ReadThrottle> = LazyLock::new(|| ReadThrottle::new(DROPS_PER_S));
        DROPPED.fetch_add(1, Ordering::Relaxed);
        // Outside of a runtime this is one of our own threads, and the message one that this process sends.
        if Handle::try_current().is_ok() {
            THROTTLE.pass();
        }
    }
}
