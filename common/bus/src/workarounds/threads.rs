//! Chooses Zenoh's threads through its environment variable, before it starts any.
//!
//! Zenoh reads and writes one TLS connection from two threads without a lock (eclipse-zenoh/zenoh#2557). Under load in both
//! directions, links break several times a second, and worse is possible. One thread for both prevents that. A router would
//! deadlock, because it would wait in that thread for data that the same thread must send. It runs on one core instead
//! ([`super::one_core`]).
//!
//! Delete `ONE` when Zenoh locks the connection. `MANY` is no workaround: fragments are decoded on the reading threads, so
//! learners and routers read unencrypted links with more threads than Zenoh's default.

use crate::{BusOptions, Role};

/// Zenoh's environment variable for its threads.
pub const VARIABLE: &str = "ZENOH_RUNTIME";
/// One thread reads and writes all links.
const ONE: &str = "(rx:(handover:tx))";
/// Sixteen threads read links.
const MANY: &str = "(rx:(worker_threads:16))";

/// Returns the name and value of the environment variable to set before any thread starts. `None` keeps Zenoh's default, or
/// what the user has set.
pub fn wanted(options: &BusOptions, role: Role) -> Option<(&'static str, &'static str)> {
    // With --discover no endpoint is given, but there are certificates.
    let has_tls_endpoint = options.listen.iter().chain(&options.connect).any(|endpoint| endpoint.starts_with("tls/"));
    let value = match (has_tls_endpoint || options.credentials.is_some(), role) {
        (true, Role::Learner | Role::Standby | Role::Actor | Role::Evaluator | Role::Observer | Role::Operator) => ONE,
        (_, Role::Learner | Role::Standby | Role::Router) => MANY,
        (false, _) => return None,
    };
    std::env::var_os(VARIABLE).is_none().then_some((VARIABLE, value))
}

/// Whether this process reads and writes all links on one thread, which therefore must not wait for space on a link.
pub(crate) fn is_one() -> bool {
    std::env::var(VARIABLE).is_ok_and(|value| value == ONE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Credentials;

    #[test]
    fn encrypted_links_use_one_thread_except_in_routers() {
        let options = |endpoint: &str| BusOptions { connect: vec![endpoint.to_string()], ..BusOptions::default() };
        let value = |endpoint, role| wanted(&options(endpoint), role).map(|(_, value)| value);
        assert_eq!(value("tls/localhost:1", Role::Actor), Some(ONE));
        assert_eq!(value("tls/localhost:1", Role::Learner), Some(ONE));
        assert_eq!(value("tls/localhost:1", Role::Router), Some(MANY));
        assert_eq!(value("tcp/localhost:1", Role::Learner), Some(MANY));
        assert_eq!(value("tcp/localhost:1", Role::Actor), None);
        let credentials = Credentials { folder: "certs".into(), role: Role::Actor };
        let searching = BusOptions { discover: true, credentials: Some(credentials), ..BusOptions::default() };
        assert_eq!(wanted(&searching, Role::Actor), Some((VARIABLE, ONE)));
    }
}
