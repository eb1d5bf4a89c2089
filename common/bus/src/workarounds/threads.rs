//! On which threads the bus works: said in the environment, before it starts any.
//!
//! The bus's TLS reads and writes one connection from two threads without a lock (eclipse-zenoh/zenoh#2557). Under load in both
//! directions links break off by that, several times a second, and worse is possible. Where one thread does both, it cannot
//! happen. A router is the exception: it would wait, in that thread, for what that thread itself must send first; its threads take
//! turns on one core instead (`one_core.rs`).
//!
//! Where links are not encrypted, the learner and routers read with more threads than the bus would by itself: fragments are
//! decoded there. Links that are read slowly, because they flood (see `brake`), need a thread each for as long as they nap.

use crate::{BusOptions, Role};

/// The variable by which the bus is told.
pub const VARIABLE: &str = "ZENOH_RUNTIME";
/// One thread reads and writes all links; as many others may nap meanwhile.
const ONE: &str = "(rx:(handover:tx),tx:(max_blocking_threads:256))";
/// Links are read by several at a time.
const MANY: &str = "(rx:(worker_threads:16,max_blocking_threads:256))";

/// Name and value of the variable that says on which threads the bus of this process works: to be set before any other thread
/// runs. `None` where it works as it does by itself, or as the user has said.
pub fn wanted(options: &BusOptions, role: Role) -> Option<(&'static str, &'static str)> {
    // Whoever is to find others by multicast names no endpoint, but has certificates.
    let is_named = options.listen.iter().chain(&options.connect).any(|endpoint| endpoint.starts_with("tls/"));
    let value = match (is_named || options.credentials.is_some(), role) {
        (true, Role::Learner | Role::Actor | Role::Evaluator | Role::Observer | Role::Operator) => ONE,
        (_, Role::Learner | Role::Router) => MANY,
        (false, _) => return None,
    };
    std::env::var_os(VARIABLE).is_none().then_some((VARIABLE, value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Credentials;

    #[test]
    fn only_encrypted_links_need_it_and_routers_cannot_have_it() {
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
