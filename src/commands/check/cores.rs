//! How many cores there are, and how much of them a container may use.

use treadmill_runtime::machine;

use super::{finding::Finding, system::System};

const NAME: &str = "cores";

/// Of this machine.
pub fn diagnose(system: &System) -> Finding {
    assess(std::thread::available_parallelism().map_or(1, Into::into), system.cpu_quota(), machine::cores())
}

/// `usable` are the cores that this process may run on; `quota` is how much of them it may take in all.
fn assess(usable: usize, quota: Option<f64>, threads: usize) -> Finding {
    match quota {
        Some(quota) if quota < 1.0 => Finding::problem(
            NAME,
            format!("a control group allows {quota:.2} of a core, which learner and actors have to share"),
            "give the container two cores or more: docker run --cpus 2, or resources.limits.cpu in Kubernetes",
        ),
        Some(quota) if (quota.floor() as usize) < threads => Finding::note(
            NAME,
            format!("a control group allows {quota:.2} cores, and {threads} threads would share them"),
            format!("start no more actors than that: --actors {}", quota.floor()),
        ),
        _ if usable < 2 => Finding::note(
            NAME,
            "one core, which learner and actors have to share",
            "training works and takes about twice as long; let actors join from other machines",
        ),
        Some(quota) => Finding::ok(NAME, format!("{usable}; a control group allows {quota:.2} of them")),
        None => Finding::ok(NAME, usable.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::{finding::Severity, system::tests::made_of};

    #[test]
    fn half_a_core_is_a_problem_and_a_quota_below_the_threads_a_note() {
        let root = made_of(&[("proc/self/cgroup", "0::/"), ("sys/fs/cgroup/cpu.max", "50000 100000")]);
        let found = diagnose(&System::at(root.path()));
        assert_eq!(found.severity, Severity::Problem);
        assert!(found.seen.contains("0.50 of a core") && found.remedy.unwrap().contains("--cpus"));
        let found = assess(8, Some(2.5), 8);
        assert_eq!(
            (found.severity, found.remedy),
            (Severity::Note, Some("start no more actors than that: --actors 2".into()))
        );
        assert_eq!(assess(1, None, 1).severity, Severity::Note);
        assert_eq!(assess(4, Some(4.0), 4).severity, Severity::Ok);
        assert_eq!(assess(4, None, 4), Finding::ok(NAME, "4"));
    }
}
