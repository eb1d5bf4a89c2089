//! On which threads the bus works: said in the environment, before it starts any.
//!
//! The bus's TLS reads and writes one connection from two threads without a lock (eclipse-zenoh/zenoh#2557). Under load in both
//! directions links break off by that, several times a second, and worse is possible. Where one thread does both, it cannot
//! happen. A router is the exception: it would wait, in that thread, for what that thread itself must send first.

use super::{BusOptions, Role};

/// Name and value of the variable that makes one thread read and write all links, where these need it: to be set before any
/// other thread runs, unless the user has set it.
pub fn one_for_both_directions(options: &BusOptions, role: Role) -> Option<(&'static str, &'static str)> {
    const NAME: &str = "ZENOH_RUNTIME";
    let encrypted = options.listen.iter().chain(&options.connect).any(|endpoint| endpoint.starts_with("tls/"));
    (encrypted && role != Role::Router && std::env::var_os(NAME).is_none()).then_some((NAME, "(rx:(handover:tx))"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_encrypted_links_need_it_and_routers_cannot_have_it() {
        let options = |endpoint: &str| BusOptions { connect: vec![endpoint.to_string()], ..BusOptions::default() };
        assert!(one_for_both_directions(&options("tls/localhost:1"), Role::Actor).is_some());
        assert!(one_for_both_directions(&options("tls/localhost:1"), Role::Router).is_none());
        assert!(one_for_both_directions(&options("tcp/localhost:1"), Role::Learner).is_none());
    }
}
