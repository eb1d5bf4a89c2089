//! Whether learner and actors find room in memory.

use super::{
    finding::{Finding, actors as counted},
    system::System,
};

const NAME: &str = "memory";

/// What a learner takes at the default sizes, and what an actor takes, each with some air. docs/reference/metrics.md has
/// measurements: `learner/memory_mb`, `actors/memory_max_mb`.
const LEARNER_BYTES: u64 = 128 << 20;
const ACTOR_BYTES: u64 = 64 << 20;

/// Of this machine or container.
pub fn diagnose(system: &System, actors: u64) -> Finding {
    let (machine, group) = (system.memory_available(), system.memory_left_to_group());
    let needed = LEARNER_BYTES.saturating_add(ACTOR_BYTES.saturating_mul(actors));
    let (available, whose) = match (machine, group) {
        (None, None) => {
            return Finding::note(NAME, "the system does not tell how much there is", "look whether /proc is mounted");
        }
        (Some(machine), Some(group)) if group < machine => (group, "left to its control group"),
        (Some(machine), _) => (machine, "available"),
        (None, Some(group)) => (group, "left to its control group"),
    };
    let seen = format!("{} {whose}; a learner and {} take about {}", mb(available), counted(actors), mb(needed));
    if available < needed {
        let remedy = match whose {
            "available" => "end other programs, or start fewer actors: --actors N",
            _ => "raise the container's limit (docker run --memory, resources.limits.memory), or start fewer actors",
        };
        return Finding::problem(NAME, seen, remedy);
    }
    Finding::ok(NAME, seen)
}

fn mb(bytes: u64) -> String {
    format!("{} MB", bytes / 1_000_000)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::{finding::Severity, system::tests::made_of};

    #[test]
    fn a_tight_container_is_a_problem_on_a_large_machine() {
        let large = ("proc/meminfo", "MemAvailable: 64000000 kB");
        let root = made_of(&[large, ("proc/self/cgroup", "0::/"), ("sys/fs/cgroup/memory.max", "200000000")]);
        let found = diagnose(&System::at(root.path()), 2);
        assert_eq!(found.severity, Severity::Problem);
        assert!(found.seen.starts_with("200 MB left to its control group"), "{}", found.seen);
        assert!(found.remedy.unwrap().contains("--memory"));
        let root = made_of(&[large]);
        assert_eq!(diagnose(&System::at(root.path()), 2).severity, Severity::Ok);
        let found = diagnose(&System::at(root.path()), 100_000);
        assert!(found.severity == Severity::Problem && found.remedy.unwrap().contains("--actors"));
        assert_eq!(diagnose(&System::at(std::path::Path::new("/nowhere")), 2).severity, Severity::Note);
    }
}
