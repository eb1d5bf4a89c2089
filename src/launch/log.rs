//! Log on standard error: warnings and links of a router, or the levels that `TREADMILL_LOG` sets.

use tracing_subscriber::{Layer, layer::SubscriberExt, util::SubscriberInitExt};
use treadmill_bus::log_tls_rejections;

use crate::launch::output;

/// Starts the log. Appends `more`, such as `,wgpu=off`, to the default filter, which applies unless `TREADMILL_LOG` is set.
pub fn begin(more: &str) {
    let filter = tracing_subscriber::EnvFilter::try_from_env("TREADMILL_LOG").unwrap_or_else(|_| {
        tracing_subscriber::EnvFilter::new(format!("warn,treadmill_bus::session::links=info,zenoh=off{more}"))
    });
    let log = tracing_subscriber::fmt::layer()
        .with_writer(|| output::Log)
        .with_ansi(std::io::IsTerminal::is_terminal(&std::io::stderr()))
        .with_target(false)
        .with_filter(filter);
    tracing_subscriber::registry().with(log).with(log_tls_rejections()).init();
}
