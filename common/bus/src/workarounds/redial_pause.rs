//! Waits before a broken link is dialled again.
//!
//! A router of Zenoh computes the trees of its network at most every tenth of a second, and declares what it has to
//! nodes that are new among its children (`Network::compute_trees`). It recognises nodes by an index, which a removed
//! node leaves to the next one. Zenoh dials a broken link again at once. So if several links break together, nodes are
//! removed and back between two computations, and most of them get nothing: they are linked, but know neither the
//! learner's token nor a way to it, until something else changes. `findings/zenoh_redial_loses_answers.sh` shows it. No
//! upstream issue is known. Delete when Zenoh compares nodes by their identity.
//!
//! Zenoh removes a link on a thread that may block, and calls listeners before it dials again.

use std::{
    sync::atomic::{AtomicU32, Ordering},
    thread,
    time::Duration,
};

use zenoh::{Session, Wait, sample::SampleKind};

use crate::error::BusError;

/// Pause after a link broke: some computations of the neighbour's trees.
const PAUSE: Duration = Duration::from_millis(400);

/// Makes a session that listens on `listen` wait before it dials again, for one link after the other.
pub(crate) fn install(session: &Session, listen: &[String]) -> Result<(), BusError> {
    let own: Vec<String> = listen.iter().filter_map(|endpoint| port(endpoint).map(str::to_string)).collect();
    let waiting = AtomicU32::new(0);
    let wait = move |is_removed: bool, source: &str| {
        // A link from this session's own port was dialled by the other side.
        if is_removed && !port(source).is_some_and(|port| own.iter().any(|known| known == port)) {
            let before = waiting.fetch_add(1, Ordering::Relaxed);
            thread::sleep(PAUSE * (before + 1));
            waiting.fetch_sub(1, Ordering::Relaxed);
        }
    };
    session
        .info()
        .link_events_listener()
        .history(false)
        .callback(move |event| wait(event.kind() == SampleKind::Delete, event.link().src().as_str()))
        .background()
        .wait()
        .map_err(BusError::flow("watching links"))
}

/// Returns the port of an endpoint.
fn port(endpoint: &str) -> Option<&str> {
    let address = endpoint.split(['?', '#']).next()?;
    address.rsplit_once(':').map(|(_, port)| port)
}

#[cfg(test)]
mod tests {
    use super::port;

    #[test]
    fn ports_are_found_before_options() {
        for endpoint in
            ["tcp/127.0.0.1:7447", "tls/[::1]:7447", "tls/host:7447#tls_handshake_timeout_ms=5", "tcp/h:7447?a=b:1"]
        {
            assert_eq!(port(endpoint), Some("7447"), "{endpoint}");
        }
        assert_eq!(port("tcp/host"), None);
    }
}
