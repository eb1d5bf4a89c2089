//! Chooses Zenoh's threads through its environment variable, before it starts any.
//!
//! Zenoh reads and writes one TLS connection from two threads without a lock (eclipse-zenoh/zenoh#2557). Under load in both
//! directions, links break several times a second, and worse is possible. One thread for both prevents that. A router would
//! deadlock, because it would wait in that thread for data that the same thread must send. It runs on one core instead
//! ([`super::one_core`]).
//!
//! Delete `ONE` when Zenoh locks the connection. `MANY` is no workaround: fragments are decoded on the reading threads, so
//! learners and routers read unencrypted links with more threads than Zenoh's default.

use crate::role::Role;

/// Zenoh's environment variable for its threads.
pub const VARIABLE: &str = "ZENOH_RUNTIME";
/// One thread reads and writes all links.
const ONE: &str = "(rx:(handover:tx))";
/// Sixteen threads read links.
const MANY: &str = "(rx:(worker_threads:16))";

/// Returns name and value of the environment variable to set before any thread starts. `None` keeps Zenoh's default, or
/// what the user has set.
pub fn wanted(is_encrypted: bool, role: Role) -> Option<(&'static str, &'static str)> {
    let value = match (is_encrypted, role) {
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

    #[test]
    fn encrypted_links_use_one_thread_except_in_routers() {
        let value = |is_encrypted, role| wanted(is_encrypted, role).map(|(_, value)| value);
        assert_eq!(value(true, Role::Actor), Some(ONE));
        assert_eq!(value(true, Role::Learner), Some(ONE));
        assert_eq!(value(true, Role::Router), Some(MANY));
        assert_eq!(value(false, Role::Learner), Some(MANY));
        assert_eq!(value(false, Role::Actor), None);
    }
}
