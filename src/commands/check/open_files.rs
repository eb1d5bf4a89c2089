//! How many files may be open: each link takes one.

use super::finding::{Finding, actors as counted};

const NAME: &str = "open files";

/// What checkpoints, logs and connections that have not said who they are may take together (`common/src/bus/session.rs`).
const OTHERS: u64 = 512;
/// What one process takes before anybody joins.
const OWN: u64 = 128;

/// Of this process.
pub fn diagnose(actors: u64) -> Finding {
    match rlimit::Resource::NOFILE.get() {
        Ok((soft, hard)) => assess(soft, hard, actors),
        Err(why) => Finding::note(NAME, format!("the limit is not told: {why}"), "none, where nothing else is wrong"),
    }
}

/// The learner raises the soft limit to the hard one by itself.
fn assess(soft: u64, hard: u64, actors: u64) -> Finding {
    let seen = format!("{soft} now and {hard} at most, for {}", counted(actors));
    let remedy = format!(
        "raise the limit: ulimit -Hn {0}, LimitNOFILE={0} in systemd, or docker run --ulimit nofile={0}",
        (OTHERS + actors).next_power_of_two().max(4096)
    );
    match hard {
        hard if hard < OWN + actors => Finding::problem(NAME, seen, remedy),
        hard if hard < OTHERS + actors => Finding::note(NAME, seen, remedy),
        _ => Finding::ok(NAME, seen),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn every_actor_needs_one() {
        let severity = |hard, actors| assess(64, hard, actors).severity;
        assert_eq!(severity(4096, 2), Severity::Ok);
        assert_eq!(severity(300, 2), Severity::Note);
        assert_eq!(severity(64, 2), Severity::Problem);
        assert_eq!(severity(1024, 2000), Severity::Problem);
        assert!(assess(64, 1024, 5000).remedy.unwrap().contains("ulimit -Hn 8192"));
    }
}
