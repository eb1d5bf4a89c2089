//! Messages that the bus drops before anything of ours sees them, because the access rules or a limit on size forbid them:
//! counted, and braked like other floods.
//!
//! The bus tells of them in its log alone, from the thread that reads the link. So this is a layer of the log.

use std::sync::{
    LazyLock,
    atomic::{AtomicU64, Ordering},
};

use tokio::runtime::Handle;
use tracing::{Event, Level, Subscriber};
use tracing_subscriber::{Layer, filter::filter_fn, layer::Context, registry::LookupSpan};

use crate::admission::read_throttle::ReadThrottle;

/// Where the bus logs that it dropped a message, and nothing else at this level.
const TARGET: &str = "zenoh::net::routing::interceptor";
/// So many a second at full speed. A client of an honest role sends none, or a few when it joins.
const FORBIDDEN_PER_S: f64 = 200.0;

static FORBIDDEN: AtomicU64 = AtomicU64::new(0);

/// How many messages this process was sent, or would have sent, that are forbidden.
#[must_use]
pub fn dropped_messages() -> u64 {
    FORBIDDEN.load(Ordering::Relaxed)
}

/// A layer of the log that makes nothing of it but what this module is for.
pub fn throttle_drops<S: Subscriber + for<'a> LookupSpan<'a>>() -> impl Layer<S> {
    Counted.with_filter(filter_fn(|metadata| metadata.target() == TARGET && *metadata.level() == Level::TRACE))
}

struct Counted;

impl<S: Subscriber> Layer<S> for Counted {
    fn on_event(&self, _: &Event<'_>, _: Context<'_, S>) {
        static THROTTLE: LazyLock<ReadThrottle> = LazyLock::new(|| ReadThrottle::new(FORBIDDEN_PER_S));
        FORBIDDEN.fetch_add(1, Ordering::Relaxed);
        // In a thread of ours it is a message that we ourselves meant to send.
        if Handle::try_current().is_ok() {
            THROTTLE.pass();
        }
    }
}
