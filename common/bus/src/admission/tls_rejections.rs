//! Logs connections that were rejected because the peer did not authenticate. Zenoh's other log events stay off.

use std::sync::mpsc::{SyncSender, sync_channel};

use tracing::{Event, Level, Subscriber, field::Visit};
use tracing_subscriber::{Layer, filter::filter_fn, layer::Context, registry::LookupSpan};

use super::{closed_peers, rate_limited_log::RateLimitedLog};

/// Target under which Zenoh logs encrypted connections.
const TARGET: &str = "zenoh_link_tls";
/// Warnings that may wait for the logging thread; further ones are dropped.
const QUEUE: usize = 16;

/// Log layer that reports rejected connections with the likely cause, rate-limited.
pub fn log_tls_rejections<S: Subscriber + for<'a> LookupSpan<'a>>() -> impl Layer<S> {
    let (sender, errors) = sync_channel::<String>(QUEUE);
    // A layer must not log while it handles an event, so a thread does.
    std::thread::spawn(move || {
        let log = RateLimitedLog::default();
        for error in errors {
            log.emit(|| {
                let (reason, peers) = (likely_cause(&error), closed_peers::just_closed());
                match peers.is_empty() {
                    true => tracing::warn!(reason, %error, "connection rejected"),
                    false => tracing::warn!(reason, %error, peer = %peers.join(" or "), "connection rejected"),
                }
            });
        }
    });
    let tls_warnings = filter_fn(|metadata| metadata.target().starts_with(TARGET) && *metadata.level() <= Level::WARN);
    TlsWarnings(sender).with_filter(tls_warnings)
}

/// Returns the likely cause of a TLS error, as an operator would name it.
fn likely_cause(error: &str) -> &'static str {
    const CAUSES: [(&str, &str); 7] = [
        ("certificate expired", "its certificate has expired"),
        ("not valid yet", "its certificate is not valid yet; compare the clocks"),
        ("BadSignature", "its certificate is from another authority"),
        ("UnknownIssuer", "its certificate is from another authority"),
        ("sent no certificates", "it has no certificate"),
        ("corrupt message", "it does not speak TLS"),
        ("alert", "it does not trust our certificate"),
    ];
    CAUSES.iter().find(|(part, _)| error.contains(part)).map_or("its handshake failed", |(_, cause)| cause)
}

struct TlsWarnings(SyncSender<String>);

impl<S: Subscriber> Layer<S> for TlsWarnings {
    fn on_event(&self, event: &Event<'_>, _: Context<'_, S>) {
        let mut message = Message(String::new());
        event.record(&mut message);
        // Zenoh appends a hint about open files to every failure.
        let error = message.0.split(". Hint:").next().unwrap_or_default().to_string();
        drop(self.0.try_send(error));
    }
}

struct Message(String);

impl Visit for Message {
    fn record_debug(&mut self, field: &tracing::field::Field, value: &dyn std::fmt::Debug) {
        if field.name() == "message" {
            self.0 = format!("{value:?}");
        }
    }
}
