//! Diagnoses of this machine: vector instructions, disk, memory, open files, clock and ports.

use std::{io::Write, path::Path};

use time::OffsetDateTime;
use treadmill_bus::{BusError, endpoint};
use treadmill_runtime::{error_chain, machine};

use crate::{
    diagnosis::{certificates::date_text, finding::Finding},
    shared::network_args::NetworkArgs,
};

/// Free disk space below which one run, or several, may not reach their end: a run takes some tens of megabytes.
const FREE_MIN_BYTES: u64 = 200_000_000;
const FREE_BYTES: u64 = 1_000_000_000;
/// Memory of a learner and of an actor with 64 robots, which their own metrics show, rounded up.
pub(crate) const LEARNER_BYTES: u64 = 150_000_000;
pub(crate) const ACTOR_BYTES: u64 = 60_000_000;
/// Open files of a process before actors join, without and with checkpoints, logs and unidentified connections.
const OWN_FILES: u64 = 128;
const ALL_FILES: u64 = 512;
/// Years in which the clock may be right.
const YEARS: std::ops::Range<i32> = 2025..2100;

/// Names the kernels that compute the networks, by the features that `common/policy/src/elementwise.rs` compiles for.
#[cfg(target_arch = "x86_64")]
pub fn cpu() -> Finding {
    let has_avx2_fma = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    let has_avx512 = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512cd")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl");
    assess_cpu(&machine::cpu_name(), has_avx2_fma, has_avx512)
}

/// Names the processor; its kernels need no optional feature.
#[cfg(not(target_arch = "x86_64"))]
pub fn cpu() -> Finding {
    Finding::ok("cpu", format!("{}: kernels for {}", machine::cpu_name(), std::env::consts::ARCH))
}

#[cfg(any(target_arch = "x86_64", test))]
fn assess_cpu(name: &str, has_avx2_fma: bool, has_avx512: bool) -> Finding {
    match (has_avx2_fma, has_avx512) {
        (_, true) => Finding::ok("cpu", format!("{name}: kernels for AVX-512")),
        (true, false) => Finding::ok("cpu", format!("{name}: kernels for AVX2 and FMA")),
        (false, false) => Finding::note(
            "cpu",
            format!("{name}: neither AVX2 with FMA nor AVX-512, so portable kernels compute the networks"),
            "expect a several times slower update; in a virtual machine, expose the host's processor (QEMU: -cpu host)",
        ),
    }
}

/// Tests that runs can be written to `run_dir`, or to the nearest folder above it that exists, and measures free space.
pub fn disk(run_dir: &Path) -> Finding {
    let whole = std::path::absolute(run_dir).unwrap_or_default();
    let Some(folder) = whole.ancestors().find(|folder| folder.is_dir()) else {
        let seen = format!("no folder above {} exists", run_dir.display());
        return Finding::problem("disk", seen, "name an existing folder with --run-dir");
    };
    let shown = folder.display();
    if let Err(why) = tempfile::tempfile_in(folder).and_then(|mut file| file.write_all(&[0; 4096])) {
        return Finding::problem(
            "disk",
            format!("{shown} cannot be written to: {why}"),
            "free some space, give this user write permission, or choose another folder with --run-dir",
        );
    }
    match rustix::fs::statvfs(folder) {
        Ok(space) => assess_disk(&shown.to_string(), space.f_bavail.saturating_mul(space.f_frsize)),
        Err(why) => Finding::note("disk", format!("free space of {shown} is unknown: {why}"), "check it with df"),
    }
}

fn assess_disk(folder: &str, free_bytes: u64) -> Finding {
    let seen = format!("{} MB free in {folder}", free_bytes / 1_000_000);
    match free_bytes {
        0..FREE_MIN_BYTES => Finding::problem(
            "disk",
            seen,
            "training waits while the disk is full: free some space, or choose another folder with --run-dir",
        ),
        FREE_MIN_BYTES..FREE_BYTES => Finding::note("disk", seen, "enough for a few runs; delete old ones"),
        _ => Finding::ok("disk", seen),
    }
}

/// Compares the memory, which a container may limit, with what a learner and its actors need.
pub fn memory(actors: u64) -> Finding {
    match machine::memory_bytes() {
        Some(bytes) => assess_memory(bytes, actors),
        None => Finding::note("memory", "its size is unknown", "check it with free -m"),
    }
}

fn assess_memory(bytes: u64, actors: u64) -> Finding {
    let needed = LEARNER_BYTES + actors.saturating_mul(ACTOR_BYTES);
    let (has_mb, needed_mb) = (bytes / 1_000_000, needed / 1_000_000);
    let seen =
        format!("{has_mb} MB for this machine or container; a learner and its actors here need about {needed_mb} MB");
    match bytes {
        bytes if bytes < needed => {
            Finding::problem("memory", seen, "start fewer actors here with --actors, or raise the container's limit")
        }
        _ => Finding::ok("memory", seen),
    }
}

/// Compares the limit of open files with one connection per actor.
pub fn open_files(actors: u64) -> Finding {
    match rlimit::Resource::NOFILE.get() {
        Ok((soft, hard)) => assess_open_files(soft, hard, actors),
        Err(why) => Finding::note("open files", format!("the limit is unknown: {why}"), "check it with ulimit -Hn"),
    }
}

/// Assesses the hard limit, because the learner raises the soft limit to it.
fn assess_open_files(soft: u64, hard: u64, actors: u64) -> Finding {
    let seen = format!("{soft} now and {hard} at most, for {actors} {}", if actors == 1 { "actor" } else { "actors" });
    let remedy = format!(
        "raise the limit: ulimit -Hn {0}, LimitNOFILE={0} in systemd, or docker run --ulimit nofile={0}",
        (ALL_FILES + actors).next_power_of_two().max(4096)
    );
    match hard {
        hard if hard < OWN_FILES + actors => Finding::problem("open files", seen, remedy),
        hard if hard < ALL_FILES + actors => Finding::note("open files", seen, remedy),
        _ => Finding::ok("open files", seen),
    }
}

/// Tests that the clock is plausible: validity of certificates depends on it.
pub fn clock(now_unix_s: f64) -> Finding {
    let now = OffsetDateTime::from_unix_timestamp(now_unix_s as i64).unwrap_or(OffsetDateTime::UNIX_EPOCH);
    let seen = format!("{} UTC", date_text(now));
    if YEARS.contains(&now.year()) {
        return Finding::ok("clock", seen);
    }
    let remedy = "set it (timedatectl set-ntp true): with a wrong clock, certificates are expired or not valid yet";
    Finding::problem("clock", seen, remedy)
}

/// Tests that a learner could listen at an endpoint.
pub fn listen(given: &str, network: &NetworkArgs) -> Finding {
    let has_certificates = network.tls.is_some() || network.zenoh_config.is_some();
    let checked = endpoint::check(given, network.insecure, has_certificates);
    let Err(why) = checked.and_then(|()| endpoint::check_free(given)) else {
        return Finding::ok("listen", format!("{given} is free"));
    };
    let remedy = match why {
        BusError::Listen { .. } => "end the process that uses it (ss -ltnp), or choose another port with --listen",
        _ => "write tcp/127.0.0.1:PORT, or tls/HOST:PORT with --tls DIR",
    };
    Finding::problem("listen", error_chain(&why), remedy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::finding::Severity;

    #[test]
    fn memory_must_suffice_for_the_actors() {
        assert_eq!(assess_memory(4_000_000_000, 8).severity, Severity::Ok);
        let found = assess_memory(256_000_000, 8);
        assert!(found.severity == Severity::Problem && found.seen.contains("630 MB"), "{found:?}");
    }

    #[test]
    fn widest_kernels_are_named() {
        assert!(assess_cpu("box", true, true).seen.contains("AVX-512"));
        assert_eq!(assess_cpu("box", true, false).seen, "box: kernels for AVX2 and FMA");
        let old = assess_cpu("box", false, false);
        assert_eq!(old.severity, Severity::Note);
        assert!(old.seen.contains("portable") && old.remedy.unwrap().contains("-cpu host"));
    }

    #[test]
    fn severity_follows_free_space() {
        let severity = |bytes| assess_disk("runs", bytes).severity;
        assert_eq!(
            [0, 199_999_999, 200_000_000, 1_000_000_000].map(severity),
            [Severity::Problem, Severity::Problem, Severity::Note, Severity::Ok]
        );
    }

    #[test]
    fn every_actor_needs_an_open_file() {
        let severity = |hard, actors| assess_open_files(64, hard, actors).severity;
        assert_eq!([severity(4096, 2), severity(300, 2)], [Severity::Ok, Severity::Note]);
        assert_eq!([severity(64, 2), severity(1024, 2000)], [Severity::Problem; 2]);
        assert!(assess_open_files(64, 1024, 5000).remedy.unwrap().contains("ulimit -Hn 8192"));
    }

    #[test]
    fn implausible_clock_is_a_problem() {
        // 1_767_225_600 s is 2026-01-01 00:00 UTC: 56 years of 365 days and 14 leap days.
        assert_eq!(clock(f64::from((56 * 365 + 14) * 86_400) + 125.0), Finding::ok("clock", "2026-01-01 00:02 UTC"));
        assert_eq!([clock(0.0).severity, clock(1e12).severity], [Severity::Problem; 2]);
    }
}
