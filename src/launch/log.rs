//! Warnings on standard error; `TREADMILL_LOG` asks for more.

use tracing_subscriber::{Layer, layer::SubscriberExt, util::SubscriberInitExt};
use treadmill_bus as bus;

use crate::launch::output;

/// From now on. `more` is added to what is said where `TREADMILL_LOG` is not set, as in `,wgpu=off`.
pub fn begin(more: &str) {
    let filter = tracing_subscriber::EnvFilter::try_from_env("TREADMILL_LOG")
        .unwrap_or_else(|_| tracing_subscriber::EnvFilter::new(format!("warn,zenoh=off{more}")));
    let log = tracing_subscriber::fmt::layer()
        .with_writer(|| output::Log)
        .with_ansi(std::io::IsTerminal::is_terminal(&std::io::stderr()))
        .with_target(false)
        .with_filter(filter);
    tracing_subscriber::registry().with(log).with(bus::log_tls_rejections()).with(bus::throttle_drops()).init();
}
