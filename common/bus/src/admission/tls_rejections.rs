//! Who is turned away at the door: the bus's own warnings about connections that do not prove who they are, as lines of
//! our log. Everything else that the bus logs stays off.

use std::sync::mpsc::{SyncSender, sync_channel};

use tracing::{Event, Level, Subscriber, field::Visit};
use tracing_subscriber::{Layer, filter::filter_fn, layer::Context, registry::LookupSpan};

use super::rate_limited_log::RateLimitedLog;

/// Where the bus logs about encrypted connections.
const TARGET: &str = "zenoh_link_tls";
/// Warnings that wait to be told; more of them say nothing new.
const WAITING_MAX: usize = 16;

/// A layer of the log that tells, in our words and not too often, that a connection was refused.
pub fn log_tls_rejections<S: Subscriber + for<'a> LookupSpan<'a>>() -> impl Layer<S> {
    let (sender, warnings) = sync_channel::<String>(WAITING_MAX);
    // A layer must not log itself while an event is handed round.
    std::thread::spawn(move || {
        let complaints = RateLimitedLog::default();
        for why in warnings {
            let words = in_words(&why);
            complaints.warn(|| format!("a connection was refused, since it did not prove who it is: {words} ({why})"));
        }
    });
    let ours = filter_fn(|metadata| metadata.target().starts_with(TARGET) && *metadata.level() <= Level::WARN);
    Told(sender).with_filter(ours)
}

/// What the encryption says, as whoever runs a fleet would.
fn in_words(why: &str) -> &'static str {
    const WORDS: [(&str, &str); 7] = [
        ("certificate expired", "its certificate has expired"),
        ("not valid yet", "its certificate is not valid yet; compare the clocks"),
        ("BadSignature", "its certificate is of another authority"),
        ("UnknownIssuer", "its certificate is of another authority"),
        ("sent no certificates", "it has no certificate"),
        ("corrupt message", "it does not speak TLS"),
        ("alert", "it does not trust our certificate"),
    ];
    WORDS.iter().find(|(part, _)| why.contains(part)).map_or("its handshake failed", |(_, words)| words)
}

struct Told(SyncSender<String>);

impl<S: Subscriber> Layer<S> for Told {
    fn on_event(&self, event: &Event<'_>, _: Context<'_, S>) {
        let mut message = Message(String::new());
        event.record(&mut message);
        // The bus takes every failure for a lack of open files.
        let why = message.0.split(". Hint:").next().unwrap_or_default().to_string();
        drop(self.0.try_send(why));
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
